// A copy of the shipped example to run the command on, and to spoil.
#pragma once

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/file.h"

namespace gramap::test {

namespace fs = std::filesystem;

/// A copy of the shipped example in a folder of its own, so that tests can spoil it.
class Project {
 public:
  Project() {
    std::string name = (fs::temp_directory_path() / "gramap test äXXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    fs::copy(GRAMAP_SOURCE_DIR "/examples/office", folder_ / "office", fs::copy_options::recursive);
  }
  ~Project() { fs::remove_all(folder_); }
  fs::path folder() const { return folder_; }
  fs::path office() const { return folder_ / "office"; }
  fs::path scans(const std::string& room) const { return office() / "scans" / room; }
  fs::path model() const { return folder_ / "model.glb"; }
  fs::path rules() const { return office() / "office.grammar"; }

  struct Result {
    int code;
    std::string out, error;
  };
  /// Runs `gramap ARGUMENTS` in a shell, after `before`: "ulimit -f 1;", "LC_ALL=de_DE.UTF-8".
  Result run(const std::string& arguments, const std::string& before = "") const {
    const std::string out = (folder_ / "out").string(), error = (folder_ / "error").string();
    const std::string command = before + " '" GRAMAP_COMMAND "' " + arguments;
    const int status = std::system((command + " >'" + out + "' 2>'" + error + "'").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(out),
            read_file(error)};
  }
  std::string fit_arguments(const std::string& output) const {
    return "fit '" + office().string() + "' --rules '" + rules().string() + "' -o '" + output + "' ";
  }
  Result fit(const std::string& more = "") const { return run(fit_arguments(model().string()) + more); }
  void write(const fs::path& path, const std::string& text) const { std::ofstream(path) << text; }
  void replace(const fs::path& path, const std::string& from, const std::string& to) const {
    std::string text = read_file(path);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    write(path, text);
  }

 private:
  fs::path folder_;
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace gramap::test
