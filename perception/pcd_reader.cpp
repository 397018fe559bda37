#include <algorithm>
#include <cmath>
#include <cstring>

#include "geometry/error.h"
#include "perception/point_reader.h"

namespace gramap {
namespace {

struct Header {
  std::vector<std::string> fields;
  std::vector<NumberType> types;
  std::vector<std::size_t> counts;
  std::uint64_t points = 0;
  std::string data;
};

[[noreturn]] void fail(const LineReader& lines, const std::string& message) {
  throw InputError({lines.path().string(), lines.number()}, message, "export the cloud again as PCD");
}

std::uint64_t whole_number(const LineReader& lines, const std::string& word) {
  double value = -1;
  const char* at = word.data();
  if (!parse_number(at, at + word.size(), value) || !(value >= 0 && value < 1e12))
    fail(lines, "expected a whole number, found '" + word + "'");
  return static_cast<std::uint64_t>(value);
}

Header read_header(LineReader& lines) {
  Header header;
  std::vector<std::string> sizes, kinds;
  std::uint64_t width = 0, height = 1;
  bool has_points = false;
  std::string line;
  while (header.data.empty()) {
    if (!lines.next(line)) fail(lines, "the header ends without a 'DATA' line");
    std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    const std::string key = words[0];
    words.erase(words.begin());
    if (words.empty()) fail(lines, "expected values after '" + key.substr(0, 40) + "'");
    if (key == "FIELDS") {
      header.fields = words;
    } else if (key == "SIZE") {
      sizes = words;
    } else if (key == "TYPE") {
      kinds = words;
    } else if (key == "COUNT") {
      for (const std::string& word : words) header.counts.push_back(whole_number(lines, word));
    } else if (key == "WIDTH") {
      width = whole_number(lines, words[0]);
    } else if (key == "HEIGHT") {
      height = whole_number(lines, words[0]);
    } else if (key == "POINTS") {
      header.points = whole_number(lines, words[0]);
      has_points = true;
    } else if (key == "DATA") {
      header.data = words[0];
    } else if (key != "VERSION" && key != "VIEWPOINT") {
      fail(lines, "a line that no PCD header has: '" + key.substr(0, 40) + "'");
    }
  }
  if (!has_points) header.points = width * height;
  if (header.counts.empty()) header.counts.assign(header.fields.size(), 1);
  if (header.fields.empty() || sizes.size() != header.fields.size() || kinds.size() != header.fields.size() ||
      header.counts.size() != header.fields.size())
    fail(lines, "FIELDS, SIZE, TYPE and COUNT must have as many values as one another");
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::uint64_t size = whole_number(lines, sizes[i]);
    const char kind = kinds[i][0] == 'F' ? 'f' : kinds[i][0] == 'I' ? 'i' : kinds[i][0] == 'U' ? 'u' : 0;
    if (!kind || (size != 1 && size != 2 && size != 4 && size != 8) || (kind == 'f' && size < 4) ||
        header.counts[i] == 0 || header.counts[i] > 65536)
      fail(lines, "a field of type " + kinds[i].substr(0, 8) + ", size " + sizes[i].substr(0, 8) +
                      " and count " + std::to_string(header.counts[i]) + " is not known");
    header.types.push_back({kind, static_cast<std::size_t>(size)});
  }
  return header;
}

/// Unpacks LZF (Marc Lehmann's format): runs of literal bytes and references back into what was written.
bool unpack_lzf(const std::vector<std::uint8_t>& in, std::vector<char>& out) {
  std::size_t from = 0, to = 0;
  while (from < in.size()) {
    const std::size_t control = in[from++];
    if (control < 32) {
      const std::size_t length = control + 1;
      if (from + length > in.size() || to + length > out.size()) return false;
      std::memcpy(out.data() + to, in.data() + from, length);
      from += length;
      to += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (from >= in.size()) return false;
      length += in[from++];
    }
    length += 2;
    if (from >= in.size()) return false;
    const std::size_t back = ((control & 31) << 8) + in[from++] + 1;
    if (back > to || to + length > out.size()) return false;
    for (std::size_t i = 0; i < length; ++i, ++to)
      out[to] = out[to - back];  // may overlap itself: byte by byte
  }
  return to == out.size();
}

}  // namespace

std::vector<Point> read_pcd(const std::filesystem::path& path) {
  ByteSource source(path);
  LineReader lines(source);
  const Header header = read_header(lines);
  std::size_t record = 0, columns = 0;
  std::size_t offset[3], column[3];
  NumberType type[3];
  bool found[3] = {false, false, false};
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      if (header.fields[i] == std::string(1, static_cast<char>('x' + axis))) {
        found[axis] = true;
        offset[axis] = record;
        column[axis] = columns;
        type[axis] = header.types[i];
      }
    record += header.types[i].size * header.counts[i];
    columns += header.counts[i];
  }
  if (!found[0] || !found[1] || !found[2]) fail(lines, "the fields x, y and z are not all there");

  std::vector<Point> points;
  const auto cut_short = [&](std::uint64_t count) {
    throw InputError(
        {path.string()},
        "the file ends after " + std::to_string(count) + " of " + std::to_string(header.points) + " points",
        "the file was cut short; copy it again");
  };
  if (header.data == "ascii") {
    std::string line;
    for (std::uint64_t i = 0; i < header.points; ++i) {
      if (!lines.next(line)) cut_short(i);
      const std::vector<std::string> words = words_of(line);
      Point point;
      for (int axis = 0; axis < 3; ++axis) {
        double value = 0;
        const char* at = column[axis] < words.size() ? words[column[axis]].data() : nullptr;
        if (!at || !parse_number(at, at + words[column[axis]].size(), value) || *at)
          fail(lines, "expected the " + std::to_string(columns) + " numbers of a point");
        point[axis] = static_cast<float>(value);
      }
      keep_finite(points, point);
    }
  } else if (header.data == "binary") {
    std::vector<char> buffer(record);
    for (std::uint64_t i = 0; i < header.points; ++i) {
      if (lines.bytes(buffer.data(), record) < record) cut_short(i);
      Point point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = static_cast<float>(number_at(buffer.data() + offset[axis], type[axis], false));
      keep_finite(points, point);
    }
  } else if (header.data == "binary_compressed") {
    char sizes[8];
    if (lines.bytes(sizes, 8) < 8) cut_short(0);
    const auto packed = static_cast<std::size_t>(number_at(sizes, {'u', 4}, false));
    const auto unpacked = static_cast<std::size_t>(number_at(sizes + 4, {'u', 4}, false));
    if (unpacked != header.points * record)
      fail(lines, "the size of the compressed data contradicts the header");
    // Bytes are taken as they come, so that a wrong size cannot ask for more memory than there is data.
    std::vector<std::uint8_t> in;
    char piece[1 << 16];
    while (in.size() < packed) {
      const std::size_t got = lines.bytes(piece, std::min(sizeof piece, packed - in.size()));
      if (got == 0) cut_short(0);
      in.insert(in.end(), piece, piece + got);
    }
    // LZF never makes more than 264 bytes of two.
    if (unpacked / 133 > packed + 1) fail(lines, "the compressed data is damaged");
    std::vector<char> out(unpacked);
    if (!unpack_lzf(in, out)) fail(lines, "the compressed data is damaged");
    // Compressed clouds are stored field by field.
    for (std::uint64_t i = 0; i < header.points; ++i) {
      Point point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = static_cast<float>(
            number_at(out.data() + offset[axis] * header.points + i * type[axis].size, type[axis], false));
      keep_finite(points, point);
    }
  } else {
    fail(lines, "expected the data to be ascii, binary or binary_compressed, found '" +
                    header.data.substr(0, 40) + "'");
  }
  return points;
}

}  // namespace gramap
