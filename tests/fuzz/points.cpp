// Any bytes as a file of points, of every format in turn, and as a pose. What has to hold: a cloud of finite
// points or one InputError that names the file.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "geometry/error.h"
#include "perception/compressed_cloud.h"
#include "perception/point_reader.h"

namespace {

using namespace gramap;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// A file that is there while the bytes are read; a format's reader takes a path.
class File {
 public:
  File(const char* suffix, const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() /
              ("gramap_fuzz_" + std::to_string(::getpid()) + suffix)) {
    std::FILE* file = std::fopen(path_.c_str(), "wb");
    require(file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(), "a place to write to");
    std::fclose(file);
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <typename Read>
void try_to_read(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    require(!error.place.file.empty() && error.what()[0] != 0, "a message with its place");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  // A file's first bytes say what it is; what does not say is text.
  const char* kind = ".xyz";
  if (bytes.starts_with("ply")) kind = ".ply";
  if (bytes.starts_with("# .PCD") || bytes.starts_with("VERSION")) kind = ".pcd";
  if (bytes.starts_with("GRAMAPC")) kind = ".gpc";
  if (bytes.starts_with("#3d")) kind = ".3d";
  try_to_read([&] {
    const File file(kind, bytes);
    for (const Point& point : read_points(file.path())) require(point.allFinite(), "finite points");
  });
  try_to_read([&] { require(pose_from_text(bytes, "pose").matrix().allFinite(), "a finite pose"); });
  return 0;
}
