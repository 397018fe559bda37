#include "grammar/placed_rooms.h"

#include "grammar/explanation.h"
#include "grammar/trace.h"

namespace gramap {

bool is_whole(const ElementRoom& room) {
  return room.start.constant == 0 && room.start.slope == 0 && room.width.constant == 0 &&
         room.width.slope == 1;
}

std::string rule_name(const RuleSet& rules, int rule) {
  return rule < 0 ? "background" : rules.rules[static_cast<std::size_t>(rule)].name;
}

std::vector<PlacedRoom> placed_rooms(const RuleSet& rules, const Lattice& lattice,
                                     const std::vector<PathStep>& path, const std::vector<double>& starts_m,
                                     double length_m) {
  std::vector<PlacedRoom> placed;
  const Trace derivation = trace(rules, lattice, path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double start = starts_m[i];
    const double end = i + 1 == path.size() ? length_m : starts_m[i + 1] - lattice.grid().wall_m;
    std::size_t place = 0;
    for (const ElementRoom& inner : placed_element(lattice, path[i]).rooms) {
      PlacedRoom room;
      room.type = inner.type < 0 ? "Unknown" : rules.rooms[static_cast<std::size_t>(inner.type)].name;
      room.start_m = start + inner.start.at(end - start);
      room.width_m = is_whole(inner) ? end - start : inner.width.at(end - start);
      room.rule = rule_name(rules, inner.rule);
      for (const int rule : rules_down_to(derivation, derivation.rooms[i][place++]))
        room.rule_path.push_back(rule_name(rules, rule));
      if (room.rule_path.empty() || room.rule_path.back() != room.rule) room.rule_path.push_back(room.rule);
      room.depth_start_m = inner.depth_start_m;
      room.depth_m = inner.depth_m;
      placed.push_back(std::move(room));
    }
  }
  return placed;
}

}  // namespace gramap
