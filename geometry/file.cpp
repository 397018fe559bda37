#include "geometry/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "geometry/error.h"

namespace gramap {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  std::string advice;
  if (error == ENOENT) advice = "check the spelling of the path";
  if (error == EACCES || error == EROFS) advice = "check the permissions of the file and its folder";
  if (error == ENOSPC || error == EDQUOT) advice = "make room on the disk and run again";
  throw InputError({path.string()}, what + ": " + std::strerror(error), advice);
}

void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      fail(path, "cannot be written", errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A file beside `target` that is not yet there: without a name where the system can do so, so that a kill
/// while it is written leaves nothing behind; else under a temporary name.
class Unfinished {
 public:
  explicit Unfinished(const std::filesystem::path& target) : temporary_(target.string() + ".partXXXXXX") {
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    if (::access("/proc/self/fd", X_OK) == 0)  // by which it gets its name
      descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    has_name_ = descriptor < 0;
    if (has_name_) descriptor = ::mkstemp(temporary_.data());
  }
  ~Unfinished() {
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (descriptor >= 0 && has_name_) ::unlink(temporary_.c_str());
    errno = error;
  }
  Unfinished(const Unfinished&) = delete;

  /// Puts the file in the place of `target`, at once. False, and errno, when that fails.
  bool replace(const std::filesystem::path& target) {
    if (!has_name_) {
      if (link_to(target)) return true;
      if (errno != EEXIST || !give_name()) return false;
    }
    if (::rename(temporary_.c_str(), target.c_str()) != 0) return false;
    has_name_ = false;
    return true;
  }

  int descriptor = -1;

 private:
  bool link_to(const std::filesystem::path& name) const {
    const std::string self = "/proc/self/fd/" + std::to_string(descriptor);
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  }

  /// A name for the moment before it replaces another file: there is no way to do both at once.
  bool give_name() {
    const std::string stem = temporary_.substr(0, temporary_.size() - 6);
    for (int attempt = 0; attempt < 100; ++attempt) {
      temporary_ = stem + std::to_string(::getpid()) + "_" + std::to_string(attempt);
      has_name_ = link_to(temporary_);
      if (has_name_ || errno != EEXIST) break;
    }
    return has_name_;
  }

  std::string temporary_;
  bool has_name_ = false;
};

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be read", errno);
  std::string bytes;
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode))
    bytes.reserve(static_cast<std::size_t>(status.st_size));
  char buffer[1 << 16];
  for (;;) {
    const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
    if (got < 0) {
      if (errno == EINTR) continue;
      const int error = errno;
      ::close(descriptor);
      fail(path, "cannot be read", error);
    }
    if (got == 0) break;
    bytes.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(descriptor);
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  if (path == "-") {
    write_all(STDOUT_FILENO, bytes, "standard output");
    return;
  }
  // A link is followed, so that renaming replaces what it points to and not the link.
  std::error_code ignored;
  const std::filesystem::path target =
      std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path, ignored) : path;
  if (std::filesystem::is_directory(target, ignored)) fail(path, "cannot be written", EISDIR);
  if (std::filesystem::exists(target, ignored) && !std::filesystem::is_regular_file(target, ignored)) {
    // A device or a pipe, /dev/null say, is written to and never replaced.
    const int device = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (device < 0) fail(path, "cannot be written", errno);
    write_all(device, bytes, path);
    ::close(device);
    return;
  }
  Unfinished file(target);
  if (file.descriptor < 0) fail(path, "cannot be written", errno);
  struct stat old {};
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(file.descriptor, ::stat(target.c_str(), &old) == 0 ? old.st_mode & 07777 : 0666 & ~mask);
  write_all(file.descriptor, bytes, path);
  if (::fsync(file.descriptor) != 0 && errno != EINVAL) fail(path, "cannot be written", errno);
  if (!file.replace(target)) fail(path, "cannot be written", errno);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError({folder.string()}, "the folder cannot be made: " + error.message());
}

void check_file_name(const std::string& name, const std::string& place) {
  const bool odd = std::any_of(name.begin(), name.end(), [](unsigned char c) { return c == '/' || c < 32; });
  if (name.empty() || name == "." || name == ".." || odd)
    throw InputError({place}, "'" + name + "' cannot be the name of a file or folder",
                     "give it an id of letters, digits and - or _");
}

std::string hash_hex(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 1099511628211ull;
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace gramap
