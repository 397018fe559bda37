#include <charconv>
#include <cmath>
#include <cstring>

#include "geometry/error.h"
#include "perception/point_reader.h"

namespace gramap {
namespace {

bool separates(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
}

/// The start of a line as it can be shown in a message.
std::string shown(const char* begin, const char* end) {
  std::string text(begin, std::min<std::ptrdiff_t>(end - begin, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return text;
}

/// Reads the point on the line [at, end); false for a line without one.
bool parse_line(const char* at, const char* end, Point& point, const std::filesystem::path& path, int line) {
  const char* const begin = at;
  while (at != end && separates(*at)) ++at;
  if (at == end || *at == '#' || (*at == '/' && end - at > 1 && at[1] == '/')) return false;
  for (int axis = 0; axis < 3; ++axis) {
    while (at != end && separates(*at)) ++at;
    const int column = static_cast<int>(at - begin) + 1;
    double value = 0;
    if (!parse_number(at, end, value) || (at != end && !separates(*at)))
      throw InputError({path.string(), line, column},
                       "expected three coordinates 'x y z', found '" + shown(begin, end) + "'",
                       "a point a line: three numbers in metres, then anything");
    if (!std::isfinite(value) || std::abs(value) > 1e9)
      throw InputError({path.string(), line, column}, "the coordinate is not a finite number",
                       "drop invalid points when exporting the scan");
    point[axis] = static_cast<float>(value);
  }
  return true;
}

}  // namespace

bool parse_number(const char*& at, const char* end, double& value) {
  // Up to 15 digits and a small power of ten: both are exact doubles, so one division rounds correctly.
  // Everything else is left to the library.
  static constexpr double powers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                      1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* p = at;
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* const digits = p;
  std::uint64_t mantissa = 0;
  while (p != end && *p >= '0' && *p <= '9')
    mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
  std::ptrdiff_t count = p - digits, decimals = 0;
  if (p != end && *p == '.') {
    const char* const point = ++p;
    while (p != end && *p >= '0' && *p <= '9')
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
    decimals = p - point;
    count += decimals;
  }
  if (count > 0 && count <= 15 && (p == end || (*p != 'e' && *p != 'E'))) {
    value = static_cast<double>(mantissa) / powers[decimals];
    if (negative) value = -value;
    at = p;
    return true;
  }
  const char* const start = at != end && *at == '+' ? at + 1 : at;
  const auto [stop, error] = std::from_chars(start, end, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) value = HUGE_VAL;
  at = stop;
  return true;
}

std::vector<Point> read_xyz(const std::filesystem::path& path) {
  constexpr std::size_t kChunk = 1 << 20, kLongestLine = 1 << 16;
  ByteSource source(path);
  std::vector<Point> points;
  std::vector<char> buffer(kChunk + kLongestLine);
  std::size_t kept = 0;
  int line = 0;
  while (true) {
    const std::size_t got = source.read(buffer.data() + kept, kChunk);
    const char* at = buffer.data();
    const char* const end = at + kept + got;
    const auto parse = [&](const char* stop) {
      ++line;
      Point point;
      if (parse_line(at, stop, point, path, line)) points.push_back(point);
    };
    while (const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(end - at))) {
      const char* const stop = static_cast<const char*>(newline);
      parse(stop);
      at = stop + 1;
    }
    kept = static_cast<std::size_t>(end - at);
    if (got == 0) {
      if (kept > 0) parse(end);
      break;
    }
    if (kept > kLongestLine)
      throw InputError({path.string(), line + 1},
                       "the line is longer than 64 KiB: this is no text file of points",
                       "a point a line: three numbers in metres, then anything");
    std::memmove(buffer.data(), at, kept);
  }
  points.shrink_to_fit();
  return points;
}

}  // namespace gramap
