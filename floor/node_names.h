// Names of nodes in the model's tree: [A-Za-z0-9_-] only, each once, the same from run to run.
#pragma once

#include <map>
#include <set>
#include <string>

namespace gramap {

class NodeNames {
 public:
  /// `wish` with other characters made '_', and "_2", "_3", ... behind it when it is taken.
  std::string name(const std::string& wish);

  /// The same with a number from the first: "wish_1", "wish_2", ...
  std::string numbered(const std::string& wish);

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> last_;  ///< number given, by wish
};

}  // namespace gramap
