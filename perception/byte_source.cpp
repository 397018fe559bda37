#include <zlib.h>

#include <cerrno>
#include <cstring>

#include "geometry/error.h"
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

}  // namespace gramap
