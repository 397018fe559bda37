// One self-contained HTML page that shows a model: works from disk, without a network.
#pragma once

#include <string>
#include <vector>

namespace gramap {

/// Whether three.js was there when gramap was built.
bool viewer_built();

/// The page. `glb`: the model's bytes. `plans`: SVG drawings, a storey each. Throws std::logic_error when not
/// viewer_built().
std::string viewer_page(const std::string& title, const std::string& glb,
                        const std::vector<std::string>& plans);

}  // namespace gramap
