// Is learning consistent? Floors derived from every rule file, rules learned from these, floors derived from
// those: numbers and widths of rooms of either, and the structural axis. A Markdown table.
//
// usage: bench_consistency FOLDER_OF_RULES [FLOORS]     (200, of three lengths each)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/grammar/learn_back.h"
#include "tests/support/bench_main.h"

using namespace gramap;
using namespace gramap::test;

namespace {

/// Of a difference, in standard errors.
double z(const Tally& a, const Tally& b) {
  const double error = standard_error(a, b);
  return error > 0 ? (b.mean() - a.mean()) / error : 0;
}

int run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_consistency FOLDER_OF_RULES [FLOORS]\n");
    return 2;
  }
  const int floors = argc > 2 ? std::max(2, std::atoi(argv[2])) : 200;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
    if (entry.path().extension() == ".grammar") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::printf(
      "| rules | axis learned m | type | rooms a row | again | z | width m | again | z |\n"
      "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const std::filesystem::path& file : files) {
    const Consistency found = learn_back(file, floors);
    for (const TypeConsistency& type : found.types) {
      if (type.width_m.count < 5 || type.width_again_m.count < 5) continue;
      std::printf("| %s | %.3f | %s | %.3f | %.3f | %.1f | %.3f | %.3f | %.1f |\n", file.stem().c_str(),
                  found.axis_m, type.type.c_str(), type.rooms.mean(), type.rooms_again.mean(),
                  z(type.rooms, type.rooms_again), type.width_m.mean(), type.width_again_m.mean(),
                  z(type.width_m, type.width_again_m));
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return test::bench_main("consistency", [&] { return run(argc, argv); });
}
