// Readers of single point files, one function a format. All of them give points in the file's own units and
// axes, take every column after the coordinates as something they need not know, and refuse what is not a
// finite number.
#pragma once

#include <filesystem>
#include <string_view>
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

/// Reads one number at `at` and moves `at` behind it; nothing when there is none. Decimal, as every program
/// writes them; "nan" and "inf" are read as such, so that the caller can name them.
bool parse_number(const char*& at, const char* end, double& value);

}  // namespace gramap
