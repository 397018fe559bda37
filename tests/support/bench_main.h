// The end of every benchmark that reads files: what is at fault with the input, in one line.
#pragma once

#include <cstdio>

#include "geometry/error.h"

namespace gramap::test {

template <class Run>
int bench_main(const char* name, Run run) {
  try {
    return run();
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s: %s\n", name, to_string(error.place).c_str(), error.what());
    return 1;
  }
}

}  // namespace gramap::test
