#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "geometry/error.h"
#include "perception/point_reader.h"

namespace gramap {
namespace {

/// The number types of PLY, under both of their names.
std::optional<NumberType> type_of(const std::string& name) {
  if (name == "char" || name == "int8") return NumberType{'i', 1};
  if (name == "uchar" || name == "uint8") return NumberType{'u', 1};
  if (name == "short" || name == "int16") return NumberType{'i', 2};
  if (name == "ushort" || name == "uint16") return NumberType{'u', 2};
  if (name == "int" || name == "int32") return NumberType{'i', 4};
  if (name == "uint" || name == "uint32") return NumberType{'u', 4};
  if (name == "float" || name == "float32") return NumberType{'f', 4};
  if (name == "double" || name == "float64") return NumberType{'f', 8};
  return std::nullopt;
}

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::size_t size = 0;  ///< bytes, when no property is a list
  bool has_list = false;
  int properties = 0;
  int axis_property[3] = {-1, -1, -1};
  std::size_t axis_offset[3] = {0, 0, 0};
  NumberType axis_type[3];
};

struct Header {
  bool is_text = false, big_endian = false;
  std::vector<Element> elements;
};

Header read_header(LineReader& lines) {
  const auto fail = [&](const std::string& message) -> void {
    throw InputError({lines.path().string(), lines.number()}, message, "export the cloud again as PLY");
  };
  std::string line;
  if (!lines.next(line) || line != "ply") fail("expected 'ply' on the first line");
  Header header;
  bool has_format = false;
  while (true) {
    if (!lines.next(line)) fail("the header ends without 'end_header'");
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format" && words.size() >= 2) {
      has_format = true;
      header.is_text = words[1] == "ascii";
      header.big_endian = words[1] == "binary_big_endian";
      if (!header.is_text && !header.big_endian && words[1] != "binary_little_endian")
        fail("expected the format ascii, binary_little_endian or binary_big_endian, found '" + words[1] +
             "'");
    } else if (words[0] == "element" && words.size() == 3) {
      Element element;
      element.name = words[1];
      const char* at = words[2].data();
      double count = 0;
      if (!parse_number(at, at + words[2].size(), count) || !(count >= 0 && count < 1e12))
        fail("expected a number of elements, found '" + words[2] + "'");
      element.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(element);
    } else if (words[0] == "property" && words.size() >= 3 && !header.elements.empty()) {
      Element& element = header.elements.back();
      if (words[1] == "list") {
        element.has_list = true;
        continue;
      }
      const std::optional<NumberType> type = type_of(words[1]);
      if (!type) fail("unknown property type '" + words[1] + "'");
      for (int axis = 0; axis < 3; ++axis)
        if (words[2] == std::string(1, static_cast<char>('x' + axis))) {
          element.axis_property[axis] = element.properties;
          element.axis_offset[axis] = element.size;
          element.axis_type[axis] = *type;
        }
      ++element.properties;
      element.size += type->size;
    } else {
      fail("a line that no PLY header has: '" + words[0] + "'");
    }
  }
  if (!has_format) fail("the header has no 'format' line");
  return header;
}

void read_text(LineReader& lines, const Element& vertices, std::vector<Point>& points) {
  std::string line;
  for (std::uint64_t i = 0; i < vertices.count; ++i) {
    if (!lines.next(line))
      throw InputError(
          {lines.path().string(), lines.number()},
          "the file ends after " + std::to_string(i) + " of " + std::to_string(vertices.count) + " points",
          "the file was cut short; copy it again");
    const std::vector<std::string> words = words_of(line);
    Point point;
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = static_cast<std::size_t>(vertices.axis_property[axis]);
      double value = 0;
      const char* at = column < words.size() ? words[column].data() : nullptr;
      if (!at || !parse_number(at, at + words[column].size(), value) || *at)
        throw InputError({lines.path().string(), lines.number()},
                         "expected the " + std::to_string(vertices.properties) + " numbers of a point");
      point[axis] = static_cast<float>(value);
    }
    keep_finite(points, point);
  }
}

void read_binary(LineReader& lines, const Element& vertices, bool big_endian, std::vector<Point>& points) {
  constexpr std::uint64_t kRecords = 4096;
  std::vector<char> buffer;
  for (std::uint64_t done = 0; done < vertices.count;) {
    const std::uint64_t count = std::min(kRecords, vertices.count - done);
    buffer.resize(count * vertices.size);
    const std::size_t got = lines.bytes(buffer.data(), buffer.size());
    if (got < buffer.size())
      throw InputError({lines.path().string()},
                       "the file ends after " + std::to_string(done + got / vertices.size) + " of " +
                           std::to_string(vertices.count) + " points",
                       "the file was cut short; copy it again");
    for (std::uint64_t i = 0; i < count; ++i) {
      Point point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] =
            static_cast<float>(number_at(buffer.data() + i * vertices.size + vertices.axis_offset[axis],
                                         vertices.axis_type[axis], big_endian));
      keep_finite(points, point);
    }
    done += count;
  }
}

}  // namespace

std::vector<Point> read_ply(const std::filesystem::path& path) {
  ByteSource source(path);
  LineReader lines(source);
  const Header header = read_header(lines);
  std::vector<Point> points;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      for (int axis = 0; axis < 3; ++axis)
        if (element.axis_property[axis] < 0 || element.has_list)
          throw InputError({path.string()},
                           "the element 'vertex' must have properties x, y and z, and no list",
                           "export the cloud again as PLY");
      if (header.is_text)
        read_text(lines, element, points);
      else
        read_binary(lines, element, header.big_endian, points);
      return points;
    }
    // An element before the points: skipped line by line, or by its size when that is known.
    std::string skipped;
    if (header.is_text) {
      for (std::uint64_t i = 0; i < element.count; ++i)
        if (!lines.next(skipped)) break;
    } else if (element.has_list) {
      throw InputError({path.string()},
                       "the element '" + element.name + "' with lists comes before the points",
                       "export the cloud alone as PLY");
    } else if (element.size > 0) {
      std::vector<char> buffer(element.size);
      for (std::uint64_t i = 0; i < element.count; ++i)
        if (lines.bytes(buffer.data(), buffer.size()) < buffer.size()) break;
    }
  }
  throw InputError({path.string()}, "there is no element 'vertex'", "export the cloud again as PLY");
}

}  // namespace gramap
