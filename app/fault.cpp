#include "app/fault.h"

#include <cstdio>

namespace gramap {

void print_fault(const InputError& error) {
  const std::string place = to_string(error.place);
  std::fprintf(stderr, "gramap: %s%s%s\n", place.c_str(), place.empty() ? "" : ": ", error.what());
  if (!error.advice.empty()) std::fprintf(stderr, "  help: %s\n", error.advice.c_str());
}

}  // namespace gramap
