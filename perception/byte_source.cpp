#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "geometry/error.h"
#include "perception/compressed_cloud.h"
#include "perception/point_reader.h"

namespace gramap {

ByteSource::ByteSource(const std::filesystem::path& path) : path_(path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError({path.string()}, "this is a folder, not a file");
  errno = 0;
  gzFile file = gzopen(path.c_str(), "rb");
  if (!file)
    throw InputError({path.string()},
                     std::string("cannot be read: ") + std::strerror(errno ? errno : ENOMEM));
  gzbuffer(file, 1 << 18);
  handle_ = file;
}

ByteSource::~ByteSource() {
  gzclose(static_cast<gzFile>(handle_));
}

std::size_t ByteSource::read(char* to, std::size_t size) {
  gzFile file = static_cast<gzFile>(handle_);
  const int got = gzread(file, to, static_cast<unsigned>(size));
  int code = Z_OK;
  const char* const reason = gzerror(file, &code);
  if (got < 0 || (code != Z_OK && code != Z_STREAM_END))
    throw InputError({path_.string()},
                     std::string("cannot be unpacked: ") + (code == Z_ERRNO ? std::strerror(errno) : reason),
                     "the file is damaged or was cut short; copy it again");
  return static_cast<std::size_t>(got);
}

bool LineReader::fill() {
  if (at_ < end_) return true;
  at_ = 0;
  end_ = source_.read(buffer_.data(), buffer_.size());
  return end_ > 0;
}

bool LineReader::next(std::string& line) {
  line.clear();
  bool any = false;
  while (fill()) {
    any = true;
    const char* const begin = buffer_.data() + at_;
    const void* const newline = std::memchr(begin, '\n', end_ - at_);
    const std::size_t length =
        newline ? static_cast<std::size_t>(static_cast<const char*>(newline) - begin) : end_ - at_;
    line.append(begin, length);
    if (line.size() > (1 << 16))
      throw InputError({path().string(), number_ + 1}, "the line is longer than 64 KiB");
    at_ += length + (newline ? 1 : 0);
    if (newline) break;
  }
  if (!any) return false;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  ++number_;
  return true;
}

std::size_t LineReader::bytes(char* to, std::size_t size) {
  std::size_t done = 0;
  while (done < size && fill()) {
    const std::size_t count = std::min(size - done, end_ - at_);
    std::memcpy(to + done, buffer_.data() + at_, count);
    at_ += count;
    done += count;
  }
  return done;
}

double number_at(const char* bytes, NumberType type, bool big_endian) {
  static_assert(std::endian::native == std::endian::little);
  char own[8];
  for (std::size_t i = 0; i < type.size; ++i) own[i] = bytes[big_endian ? type.size - 1 - i : i];
  const auto as = [&](auto value) {
    std::memcpy(&value, own, sizeof value);
    return static_cast<double>(value);
  };
  if (type.kind == 'f') return type.size == 8 ? as(double{}) : as(float{});
  const bool is_signed = type.kind == 'i';
  if (type.size == 1) return is_signed ? as(std::int8_t{}) : as(std::uint8_t{});
  if (type.size == 2) return is_signed ? as(std::int16_t{}) : as(std::uint16_t{});
  if (type.size == 4) return is_signed ? as(std::int32_t{}) : as(std::uint32_t{});
  return is_signed ? as(std::int64_t{}) : as(std::uint64_t{});
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::vector<Point> read_points(const std::filesystem::path& path) {
  std::filesystem::path name = path;
  if (name.extension() == ".gz") name = name.stem();
  const std::string kind = name.extension().string();
  if (kind == ".ply" || kind == ".pcd") {
    std::vector<Point> points = kind == ".ply" ? read_ply(path) : read_pcd(path);
    if (points.empty())
      throw InputError({path.string()}, "the scan has no points with finite coordinates",
                       "remove the file, or export the scan again");
    return points;
  }
  if (kind == ".gpc") {
    ByteSource source(path);
    std::string bytes;
    char buffer[1 << 16];
    while (const std::size_t got = source.read(buffer, sizeof buffer)) bytes.append(buffer, got);
    return decompress_points(bytes, path);
  }
  std::vector<Point> points = read_xyz(path);
  // 3DTK's own: centimetres in its left-handed frame.
  if (kind == ".3d")
    for (Point& p : points) p = Point(p.z(), -p.x(), p.y()) / 100;
  return points;
}

}  // namespace gramap
