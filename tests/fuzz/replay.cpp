// Runs a fuzzer's function on files, each once: `replay FILE-OR-FOLDER...`. What it finds, it finds as the
// fuzzer does, by an abort or a sanitizer.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "geometry/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** arguments) {
  int files = 0;
  const auto run = [&](const std::filesystem::path& path) {
    const std::string bytes = gramap::read_file(path);
    std::printf("%s\n", path.string().c_str());
    std::fflush(stdout);  // so that the last line names the culprit
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++files;
  };
  for (int i = 1; i < count; ++i) {
    if (!std::filesystem::is_directory(arguments[i])) {
      run(arguments[i]);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i]))
      if (entry.is_regular_file()) run(entry.path());
  }
  std::printf("%d inputs\n", files);
  return files > 0 ? 0 : 1;
}
