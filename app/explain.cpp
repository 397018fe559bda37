#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "app/verbs.h"
#include "floor/explain.h"
#include "floor/read_model.h"

namespace gramap {

Verb declare_explain(CLI::App& gramap) {
  struct Options {
    std::string model, room;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand(
      "explain", "Say why a room is what it is: its rules, what was observed, and the runner-up");
  verb->add_option("model", options->model, "A model that gramap fit wrote (.glb or .gltf)")->required();
  verb->add_option("room", options->room, "The room's id, as in the table of rooms")->required();
  return [options] {
    std::fputs(explain_room(read_model(options->model).floor, options->room).c_str(), stdout);
    return static_cast<int>(kDone);
  };
}

}  // namespace gramap
