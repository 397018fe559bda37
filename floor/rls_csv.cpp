#include "floor/rls_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>

#include "geometry/error.h"
#include "geometry/file.h"

namespace gramap {
namespace {

constexpr double kSamePlace_m = 0.05;  // neighbours' common end
constexpr double kSameWall_m = 0.01;

struct Field {
  std::string_view text;
  Place place;
};

Field trimmed(std::string_view text, Place place) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1), ++place.column;
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return {text, place};
}

std::vector<Field> split(const Field& whole, char separator) {
  std::vector<Field> fields;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = std::min(whole.text.find(separator, begin), whole.text.size());
    Place place = whole.place;
    place.column += static_cast<int>(begin);
    fields.push_back(trimmed(whole.text.substr(begin, end - begin), place));
    if (end == whole.text.size()) return fields;
    begin = end + 1;
  }
}

std::optional<double> as_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double number(const Field& field, const char* what) {
  const std::optional<double> value = as_number(field.text);
  if (!value || std::abs(*value) > 1e7)
    throw InputError(field.place,
                     std::string(what) + " is no number in metres: '" + std::string(field.text) + "'",
                     "write plain numbers with a decimal point, fields separated by commas");
  return *value;
}

int index_of(const Field& field) {
  const double value = number(field, "the index");
  if (value != std::floor(value) || std::abs(value) > 1e9)
    throw InputError(field.place, "the index is not a whole number", "number the segments 1, 2, 3, …");
  return static_cast<int>(value);
}

struct Row {
  Place place;
  std::vector<Field> fields;
};

/// The rows of a CSV text, without blank lines and without a header: a first row whose first field is no
/// number.
std::vector<Row> rows_of(std::string_view text, const std::string& name, std::size_t least) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<Row> rows;
  bool first = true;
  for (const Field& line : split({text, {name, 0, 1}}, '\n')) {
    Row row{{name, static_cast<int>(std::count(text.data(), line.text.data(), '\n')) + 1, 1}, {}};
    if (line.text.empty()) continue;
    row.fields = split({line.text, row.place}, ',');
    const bool header = first && !as_number(row.fields[0].text);
    first = false;
    if (header) continue;
    if (row.fields.size() < least)
      throw InputError(row.place,
                       "the row has " + std::to_string(row.fields.size()) + " fields, expected " +
                           std::to_string(least) + " or more",
                       least == 5 ? "a row is index,startX,startY,endX,endY"
                                  : "a row is index,rlsStartX,rlsStartY,rlsEndX,rlsEndY,Reversed,rules,");
    rows.push_back(std::move(row));
  }
  return rows;
}

void read_segment(const Row& row, RlsSegment& segment) {
  segment.index = index_of(row.fields[0]);
  segment.start = Vec2(number(row.fields[1], "startX"), number(row.fields[2], "startY"));
  segment.end = Vec2(number(row.fields[3], "endX"), number(row.fields[4], "endY"));
  if (segment.length_m() < 1e-6)
    throw InputError(row.place, "the segment has no length", "give two different end points");
}

bool read_reversed(const Field& field) {
  std::string text(field.text);
  for (char& letter : text) letter = static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + 32 : letter);
  if (text == "no" || text == "false" || text == "0" || text.empty()) return false;
  if (text == "yes" || text == "true" || text == "1") return true;
  throw InputError(field.place, "Reversed is '" + std::string(field.text) + "'", "write Yes or No");
}

std::vector<double> read_lengths(const Field& field) {
  std::vector<double> lengths;
  for (const Field& item : split(field, ';')) {
    if (item.text.empty()) continue;
    lengths.push_back(number(item, "a length"));
    if (lengths.back() < 0 || (lengths.size() > 1 && lengths.back() == 0))
      throw InputError(item.place, "a length is not positive",
                       "give distances between successive wall lines, each ended by ';'");
  }
  return lengths;
}

Vec2 direction(const RlsSegment& segment) {
  return (segment.end - segment.start).normalized();
}

void find_neighbours(std::vector<RlsSegment>& segments) {
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = 0; j < segments.size(); ++j) {
      if (i == j || segments[i].next >= 0 || segments[j].previous >= 0) continue;
      if ((segments[i].end - segments[j].start).norm() > kSamePlace_m) continue;
      if (direction(segments[i]).dot(direction(segments[j])) < 0.9998) continue;  // 1 degree
      segments[i].next = static_cast<int>(j);
      segments[j].previous = static_cast<int>(i);
    }
}

/// The wall lines from the segment's start, with the sign that the file has lost.
void place_walls(RlsSegment& segment, double sign) {
  segment.walls_m.clear();
  double along = 0;
  for (std::size_t i = 0; i < segment.lengths_m.size(); ++i) {
    along += i == 0 ? sign * segment.lengths_m[i] : segment.lengths_m[i];
    segment.walls_m.push_back(segment.reversed ? segment.length_m() - along : along);
  }
  if (segment.reversed) std::reverse(segment.walls_m.begin(), segment.walls_m.end());
}

/// A first distance is counted from an end that a collinear neighbour may share: when the neighbour's wall
/// nearest to that end lies at the same distance, its side gives the sign. A chain of neighbours settles in
/// as many rounds as it has segments.
void recover_signs(std::vector<RlsSegment>& segments) {
  for (RlsSegment& segment : segments) place_walls(segment, 1);
  for (std::size_t round = 0; round < segments.size(); ++round) {
    bool changed = false;
    for (RlsSegment& segment : segments) {
      const int other = segment.reversed ? segment.next : segment.previous;
      if (segment.lengths_m.empty() || other < 0) continue;
      const RlsSegment& neighbour = segments[static_cast<std::size_t>(other)];
      if (neighbour.walls_m.empty()) continue;
      // Seen from the common end, positive into this segment.
      const double wall =
          segment.reversed ? -neighbour.walls_m.front() : neighbour.walls_m.back() - neighbour.length_m();
      if (std::abs(std::abs(wall) - segment.lengths_m[0]) > kSameWall_m) continue;
      const std::vector<double> before = segment.walls_m;
      place_walls(segment, wall < 0 ? -1 : 1);
      changed = changed || before != segment.walls_m;
    }
    if (!changed) break;
  }
  for (RlsSegment& segment : segments) {
    if (segment.next < 0 || segment.walls_m.empty()) continue;
    RlsSegment& next = segments[static_cast<std::size_t>(segment.next)];
    if (next.walls_m.empty()) continue;
    const double gap = next.walls_m.front() - (segment.walls_m.back() - segment.length_m());
    segment.shares_last_wall = next.shares_first_wall = std::abs(gap) <= kSameWall_m;
  }
}

std::string fixed(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.6f", value);
  return std::string_view(text) == "-0.000000" ? "0.000000" : text;
}

}  // namespace

std::vector<RlsSegment> read_rls(const std::filesystem::path& rls, const std::filesystem::path& rules) {
  std::vector<RlsSegment> segments;
  std::map<int, std::size_t> by_index;
  const std::string rls_text = read_file(rls);
  for (const Row& row : rows_of(rls_text, rls.string(), 5)) {
    RlsSegment segment;
    read_segment(row, segment);
    if (!by_index.insert({segment.index, segments.size()}).second)
      throw InputError(row.place, "segment " + std::to_string(segment.index) + " is there twice",
                       "number the segments 1, 2, 3, …");
    segments.push_back(segment);
  }
  if (segments.empty())
    throw InputError({rls.string()}, "there is no reference line segment in the file",
                     "a row is index,startX,startY,endX,endY");

  std::map<int, bool> seen;
  const std::string rules_text = read_file(rules);
  for (const Row& row : rows_of(rules_text, rules.string(), 7)) {
    RlsSegment observed;
    read_segment(row, observed);
    const auto found = by_index.find(observed.index);
    if (found == by_index.end())
      throw InputError(row.place, "segment " + std::to_string(observed.index) + " is not in " + rls.string(),
                       "give both files the same indices");
    if (!seen.insert({observed.index, true}).second)
      throw InputError(row.place, "segment " + std::to_string(observed.index) + " has a second row",
                       "keep one row for each segment");
    RlsSegment& segment = segments[found->second];
    if ((segment.start - observed.start).norm() > kSamePlace_m ||
        (segment.end - observed.end).norm() > kSamePlace_m)
      throw InputError(row.place,
                       "segment " + std::to_string(observed.index) + " lies elsewhere in " + rls.string(),
                       "use two files that were written together");
    segment.reversed = read_reversed(row.fields[5]);
    segment.lengths_m = read_lengths(row.fields[6]);
    for (std::size_t i = 7; i < row.fields.size(); ++i)
      if (!row.fields[i].text.empty())
        throw InputError(row.fields[i].place, "there is something behind the lengths",
                         "separate the lengths by ';', not by ','");
  }
  find_neighbours(segments);
  recover_signs(segments);
  return segments;
}

RlsCsv to_rls_csv(const std::vector<RlsSegment>& segments) {
  RlsCsv csv;
  csv.rls = "index,startX,startY,endX,endY\n";
  csv.rules = "index,rlsStartX,rlsStartY,rlsEndX,rlsEndY,Reversed,rules,\n";
  for (const RlsSegment& segment : segments) {
    const std::string line = std::to_string(segment.index) + "," + fixed(segment.start.x()) + "," +
                             fixed(segment.start.y()) + "," + fixed(segment.end.x()) + "," +
                             fixed(segment.end.y());
    csv.rls += line + "\n";
    csv.rules += line + (segment.reversed ? ",Yes," : ",No,");
    for (const double length : segment.lengths_m) csv.rules += fixed(length) + ";";
    csv.rules += ",\n";
  }
  return csv;
}

RlsCsv to_rls_csv(const FittedFloor& floor) {
  std::vector<RlsSegment> segments;
  for (const Space& space : floor.floor.spaces) {
    RlsSegment segment;
    segment.index = static_cast<int>(segments.size()) + 1;
    segment.start = space.start;
    segment.end = space.end;
    std::vector<const FittedRoom*> rooms;
    for (const FittedRoom& room : floor.rooms)
      if (room.space == space.id) rooms.push_back(&room);
    std::stable_sort(rooms.begin(), rooms.end(),
                     [](const FittedRoom* a, const FittedRoom* b) { return a->start_m < b->start_m; });
    double last = 0;
    if (!rooms.empty()) segment.lengths_m.push_back(0);
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      const double room_end = rooms[i]->start_m + rooms[i]->width_m;
      // Rooms one behind the other (nested splits) share their walls along the hallway.
      if (i + 1 < rooms.size() && rooms[i + 1]->start_m < room_end - 1e-6) continue;
      const double wall = i + 1 < rooms.size() ? (room_end + rooms[i + 1]->start_m) / 2 : room_end;
      segment.lengths_m.push_back(wall - last);
      last = wall;
    }
    segments.push_back(std::move(segment));
  }
  return to_rls_csv(segments);
}

}  // namespace gramap
