// Names of nodes in the model's tree: [A-Za-z0-9_-] only, each once, the same from run to run.
#pragma once

#include <set>
#include <string>

namespace gramap {

class NodeNames {
 public:
  /// `wish` with other characters made '_', and "_2", "_3", ... behind it when it is taken.
  std::string name(const std::string& wish);

 private:
  std::set<std::string> taken_;
};

}  // namespace gramap
