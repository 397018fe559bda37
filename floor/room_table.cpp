#include "floor/room_table.h"
#include "geometry/say.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <vector>

namespace gramap {
namespace {

std::string format(const char* pattern, ...) {
  char text[128];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

/// Columns as wide as their widest cell: text to the left, numbers to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows, const std::vector<bool>& numeric) {
  std::vector<std::size_t> widths(numeric.size(), 0);
  const auto glyphs = [](const std::string& text) {  // UTF-8: continuation bytes take no room
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  };
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], glyphs(row[i]));
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - glyphs(row[i]), ' ');
      line += (i ? "  " : "") + (numeric[i] ? padding + row[i] : row[i] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::vector<std::string> row(const FittedRoom& room, const std::string& where) {
  const bool observed = room.extracted_width_m.has_value();
  return {where,
          room.id,
          room.type,
          to_string(room.origin),
          observed ? format("%.3f", *room.extracted_width_m) : "-",
          format("%.3f", room.width_m),
          room.origin == Origin::given ? "-" : format("%.3f", room.width_sigma_m),
          observed ? format("%+.1f", 100 * (room.width_m - *room.extracted_width_m)) : "-",
          room.origin == Origin::given ? "-" : format("%.0f%%", 100 * room.type_probability),
          room.rule.empty() ? "-" : room.rule};
}

}  // namespace

std::string room_table(const FittedFloor& floor) {
  std::vector<std::vector<std::string>> rows{{"space", "room", "type", "origin", "extracted m", "fitted m",
                                              "± m", "change cm", "type sure", "rule"}};
  for (const FittedRoom& room : floor.rooms) rows.push_back(row(room, room.space));
  for (const FittedRoom& room : floor.hallways) rows.push_back(row(room, "(hallway)"));
  for (const FittedRoom& room : floor.fixed) rows.push_back(row(room, "(fixed)"));
  std::string text = aligned(rows, {false, false, false, false, true, true, true, true, true, false});
  for (const FittedSpace& space : floor.spaces) {
    double sum = 0;
    std::size_t rooms = 0;
    for (const FittedRoom& room : floor.rooms)
      if (room.space == space.id) sum += room.width_m, ++rooms;
    const std::size_t walls = rooms > 0 ? rooms - 1 : 0;
    text += "space " + space.id + ": " + said_count(rooms, "room") + " " + format("%.3f m", sum) + " + " +
            said_count(walls, "wall") + " " +
            format("%.3f m", static_cast<double>(walls) * floor.inner_wall_m) + " = " +
            format("%.3f m", space.length_m) + "\n";
  }
  for (const std::string& remark : floor.floor.remarks) text += "note: " + remark + "\n";
  for (const SetAsideInput& aside : floor.set_aside)
    text += "set aside: " + aside.what + ": " + aside.reason + "\n";
  return text;
}

}  // namespace gramap
