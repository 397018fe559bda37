#include "app/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace gramap {

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (!quiet_ && terminal_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::step(const std::string& name, std::size_t total) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  if (quiet_) return;
  std::fprintf(stderr, terminal_ ? "\r\033[K%s: %zu/%zu %s" : "%s: %zu/%zu %s\n", what_.c_str(), done_, total,
               name.c_str());
  std::fflush(stderr);
}

}  // namespace gramap
