#include "floor/explain.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geometry/error.h"
#include "geometry/say.h"

namespace gramap {
namespace {

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

const FittedRoom& find_room(const FittedFloor& floor, const std::string& id) {
  std::string names;
  for (const auto* rooms : {&floor.rooms, &floor.hallways, &floor.fixed})
    for (const FittedRoom& room : *rooms) {
      if (room.id == id) return room;
      names += (names.empty() ? "" : ", ") + room.id;
    }
  throw InputError({}, "this model has no room \"" + id + "\"", "its rooms are: " + names);
}

/// The room of an alternative that lies at a position along the reference line, and where it starts.
struct Other {
  std::string type;
  double start_m = 0, width_m = 0;
};
Other room_at(const FittedSpace::Alternative& layout, double position_m, double wall_m) {
  Other other;
  double start = 0;
  for (std::size_t i = 0; i < layout.types.size(); ++i) {
    other = {layout.types[i], start, layout.widths_m[i]};
    start += layout.widths_m[i] + wall_m;
    if (position_m < start) break;
  }
  return other;
}

std::string runner_up(const FittedFloor& floor, const FittedRoom& room) {
  const auto space = std::find_if(floor.spaces.begin(), floor.spaces.end(),
                                  [&](const FittedSpace& s) { return s.id == room.space; });
  if (space == floor.spaces.end() || space->alternatives.empty())
    return "  runner-up      none was kept with the model (fit with --alternatives 1 or more)\n";
  for (const FittedSpace::Alternative& layout : space->alternatives) {
    const Other other = room_at(layout, room.start_m + room.width_m / 2, floor.inner_wall_m);
    if (other.type == room.type && std::abs(other.width_m - room.width_m) < 0.05 &&
        std::abs(other.start_m - room.start_m) < 0.05)
      continue;
    return format(
        "  runner-up      %s of %.3f m from %.3f m, in a layout of %s whose score is lower by %.2f "
        "(probability %.3g against %.3g)\n",
        other.type.c_str(), other.width_m, other.start_m, said_count(layout.types.size(), "room").c_str(),
        space->score - layout.score, layout.probability, space->probability);
  }
  return format(
      "  runner-up      all %zu next best layouts of the space have this room too; the first scores lower by "
      "%.2f\n",
      space->alternatives.size(), space->score - space->alternatives.front().score);
}

}  // namespace

std::string explain_room(const FittedFloor& floor, const std::string& id) {
  const FittedRoom& room = find_room(floor, id);
  std::string text = "room " + room.id + ": " + room.type + ", " + to_string(room.origin) + "\n";
  if (room.origin == Origin::given) {
    text += "  given by the floor file; no rule made it\n";
    if (room.extracted_width_m)
      text += format("  observed       longer side %.3f m, given %.3f m, difference %+.1f cm\n",
                     *room.extracted_width_m, room.width_m, 100 * (room.width_m - *room.extracted_width_m));
    return text;
  }
  text +=
      format("  place          space %s, %.3f m to %.3f m along its reference line (± %.1f cm, ± %.1f cm)\n",
             room.space.c_str(), room.start_m, room.start_m + room.width_m, 100 * room.start_sigma_m,
             100 * room.end_sigma_m);
  text += format("  width          %.3f m ± %.1f cm\n", room.width_m, 100 * room.width_sigma_m);
  text += format("  type           %s with probability %.3f\n", room.type.c_str(), room.type_probability);
  text += format("  sure           %.3f that it is this room: its type, and its width to 10 cm\n",
                 room.room_probability);
  text += "  rules          ";
  for (const std::string& rule : room.rule_path) text += rule + (rule == room.rule_path.back() ? "" : " > ");
  if (room.rule_path.empty()) text += room.rule;
  text += "\n";
  if (room.extracted_width_m) {
    const double residual = room.width_m - *room.extracted_width_m,
                 sigma = room.extracted_sigma_m.value_or(0);
    text += format("  observed       %.3f m ± %.1f cm; the fit differs by %+.1f cm", *room.extracted_width_m,
                   100 * sigma, 100 * residual);
    if (sigma > 0) text += format(" (%.1f sigma)", std::abs(residual) / sigma);
    text += ", in ";
    for (const std::string& scan : room.scans) text += scan + (scan == room.scans.back() ? "\n" : ", ");
  } else {
    text += "  observed       not; its width follows from the rules and its neighbours\n";
  }
  return text + runner_up(floor, room);
}

}  // namespace gramap
