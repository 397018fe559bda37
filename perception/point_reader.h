// Readers of single point files, one function a format. All of them give points in the file's own units and
// axes, take every column after the coordinates as something they need not know, and refuse what is not a
// finite number.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "perception/scan.h"

namespace gramap {

/// Hands over a file's bytes piece by piece, unpacking gzip on the way, so that no text is ever held whole.
class ByteSource {
 public:
  explicit ByteSource(const std::filesystem::path& path);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  /// Fills at most `size` bytes; 0 at the end. Throws InputError when the file is damaged.
  std::size_t read(char* to, std::size_t size);
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  void* handle_ = nullptr;
};

/// Text, a point a line: three numbers separated by blanks, tabs, commas or semicolons, then anything. Empty
/// lines and lines that begin with '#' or "//" are skipped.
std::vector<Point> read_xyz(const std::filesystem::path& path);

/// The points of a PLY file (ascii, binary of either byte order) and of a PCD file (ascii, binary,
/// compressed). Points that are not finite are left out: organised clouds mark the places where nothing was
/// measured that way.
std::vector<Point> read_ply(const std::filesystem::path& path);
std::vector<Point> read_pcd(const std::filesystem::path& path);

/// Any of the formats, by the file's name; a further ".gz" is allowed. A PLY or PCD file without a finite
/// point is refused.
std::vector<Point> read_points(const std::filesystem::path& path);

/// Lines and then bytes of a source: what formats with a text header and a binary body need.
class LineReader {
 public:
  explicit LineReader(ByteSource& source) : source_(source), buffer_(1 << 16) {}
  /// The next line without its end; false at the end of the file. Throws InputError for a line of over 64
  /// KiB.
  bool next(std::string& line);
  /// Fills `size` bytes unless the file ends before; how many there were.
  std::size_t bytes(char* to, std::size_t size);
  int number() const { return number_; }  ///< of the line last read
  const std::filesystem::path& path() const { return source_.path(); }

 private:
  bool fill();
  ByteSource& source_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;
  int number_ = 0;
};

/// How a number lies in a binary file: 'f' floating point, 'i' signed, 'u' unsigned, and its size in bytes.
struct NumberType {
  char kind = 'f';
  std::size_t size = 4;
};
double number_at(const char* bytes, NumberType type, bool big_endian);

/// The words of a line, separated by blanks and tabs.
std::vector<std::string> words_of(const std::string& line);

/// Adds a point unless one of its coordinates is not a finite number or absurdly large.
inline void keep_finite(std::vector<Point>& points, const Point& point) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() < 1e9f) points.push_back(point);
}

/// Reads one number at `at` and moves `at` behind it; nothing when there is none. Decimal, as every program
/// writes them; "nan" and "inf" are read as such, so that the caller can name them.
bool parse_number(const char*& at, const char* end, double& value);

}  // namespace gramap
