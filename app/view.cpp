// `gramap view`: a model as one HTML page.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/verbs.h"
#include "floor/gltf.h"
#include "floor/read_model.h"
#include "floor/stack.h"
#include "floor/svg.h"
#include "floor/viewer.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "version.h"

namespace gramap {

Verb declare_view(CLI::App& gramap) {
  struct Options {
    std::string model, output;
    GltfOptions gltf;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand("view",
                                         "Write one self-contained HTML page that shows a model: to orbit, "
                                         "to walk, as a plan, with its numbers");
  verb->add_option("model", options->model, "A .glb or .gltf that gramap wrote")->required();
  verb->add_option("-o,--output", options->output,
                   "The page to write; the model's name with .html when not given");
  verb->add_flag(
      "--confidence", options->gltf.confidence_colours,
      "Colour the rooms' floors by the standard deviation of their widths, green 1 cm to red 50 cm");
  return [options] {
    if (!viewer_built())
      throw InputError({}, "this gramap was built without three.js, which its viewer needs",
                       "install libjs-three and build gramap again");
    const std::vector<FloorModel> storeys = build_storeys(read_model(options->model).storeys);
    std::vector<std::string> plans;
    for (const FloorModel& storey : storeys) plans.push_back(to_svg(storey));
    const std::filesystem::path model(options->model);
    const std::string output = options->output.empty()
                                   ? std::filesystem::path(model).replace_extension(".html").string()
                                   : options->output;
    // The file's own bytes, unless they are to look different.
    std::string glb = read_file(options->model);
    if (options->gltf.confidence_colours || glb.compare(0, 4, "glTF") != 0) {
      RunInfo run;
      run.version = GRAMAP_VERSION;
      glb = to_glb(storeys, run, options->gltf);
    }
    write_file(output, viewer_page(model.stem().string(), glb, plans));
    std::fprintf(stderr, "gramap: wrote %s; open it in a browser\n", output.c_str());
    return static_cast<int>(kDone);
  };
}

}  // namespace gramap
