// `gramap verify`: the proof on a model file.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "app/verbs.h"
#include "floor/verify_file.h"

namespace gramap {

Verb declare_verify(CLI::App& gramap) {
  struct Options {
    std::string model;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand(
      "verify", "Prove that a model is gap-free, watertight and outward, on the triangles in its file");
  verb->add_option("model", options->model, "A .glb or .gltf that gramap wrote")->required();
  verb->add_flag("--json", options->json, "Report as JSON");
  return [options] {
    const VerifyReport report = verify_file(read_model(options->model));
    std::fputs((options->json ? to_json(report) : to_text(report)).c_str(), stdout);
    return static_cast<int>(report.ok() ? kDone : kInputFault);
  };
}

}  // namespace gramap
