// Progress of long work on standard error: one line that rewrites itself on a terminal, plain lines in a log.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

namespace gramap {

class Progress {
 public:
  /// Of `what`, e.g. "perceiving rooms". A quiet progress prints nothing.
  explicit Progress(std::string what, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more of `total` steps done; safe to call from any thread.
  void step(const std::string& name, std::size_t total);

 private:
  std::string what_;
  std::size_t done_ = 0;
  bool quiet_;
  bool terminal_;
  std::mutex mutex_;
};

}  // namespace gramap
