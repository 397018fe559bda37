#include "floor/reachable.h"

#include <algorithm>
#include <map>
#include <set>

namespace gramap {

bool has_door(const FittedRoom& room) {
  return std::any_of(room.openings.begin(), room.openings.end(),
                     [](const FittedOpening& opening) { return opening.kind == "door"; });
}

std::vector<std::string> unreachable(const std::vector<std::string>& ids,
                                     const std::vector<std::pair<std::string, std::string>>& passages,
                                     const std::vector<std::string>& from) {
  std::map<std::string, std::vector<std::string>> next;
  for (const auto& [a, b] : passages) {
    next[a].push_back(b);
    next[b].push_back(a);
  }
  std::vector<std::string> queue = from;
  std::set<std::string> reached(from.begin(), from.end());
  while (!queue.empty()) {
    const std::string place = queue.back();
    queue.pop_back();
    for (const std::string& other : next[place])
      if (reached.insert(other).second) queue.push_back(other);
  }
  std::vector<std::string> rest;
  for (const std::string& id : ids)
    if (!reached.count(id)) rest.push_back(id);
  return rest;
}

}  // namespace gramap
