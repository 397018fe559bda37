// Any bytes as rls.csv and rules.csv, parted by the ASCII record separator: read, or refused with a message;
// what is read can be written and read again.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "floor/rls_csv.h"
#include "geometry/error.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramap;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t parting = text.find('\x1e');
  const fuzz::MemoryFile rls(text.substr(0, parting));
  const fuzz::MemoryFile rules(parting == std::string::npos ? "" : text.substr(parting + 1));
  try {
    const auto segments = read_rls(rls.path(), rules.path());
    if (to_rls_csv(segments).rls.empty()) std::abort();
  } catch (const InputError& error) {
    if (!*error.what()) std::abort();
  }
  return 0;
}
