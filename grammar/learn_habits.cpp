#include "grammar/learn_habits.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "grammar/learn_width.h"

namespace gramap {
namespace {

/// A door's place as the distance to one end of its room.
struct Offset {
  double value_m = 0;
  bool from_end = false;
};

/// Doors' places under one way of measuring them: which group of distances each belongs to, and at what
/// length.
struct PlaceModel {
  std::vector<LearnedDoor::Place> places;
  double length = 0;  ///< nats
};

PlaceModel describe_places(const std::vector<Offset>& offsets, bool side_is_free) {
  constexpr double resolution_m = 0.02;  // to which doors are drawn and built
  PlaceModel model;
  const double n = static_cast<double>(offsets.size());
  for (const bool from_end : {false, true}) {
    std::vector<double> values;
    for (const Offset& offset : offsets)
      if (offset.from_end == from_end) values.push_back(offset.value_m);
    if (values.empty()) continue;
    const std::vector<LengthGroup> groups = group_lengths(values, resolution_m, 3);
    const double share = static_cast<double>(values.size()) / n;
    model.length += code_length(values, groups, resolution_m);
    if (side_is_free) model.length -= static_cast<double>(values.size()) * std::log(share);
    for (const LengthGroup& group : groups)
      model.places.push_back({static_cast<double>(group.members.size()) / n, std::max(0.0, group.mean_m),
                              std::max(group.sd_m, resolution_m), from_end});
  }
  std::stable_sort(model.places.begin(), model.places.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return model;
}

/// Places that were seen once are no habit: they, and half a door for every place seen, go to one wide place,
/// so that a door elsewhere is unusual and not impossible. `free_m`: mean length of wall beside the door.
void leave_room(double doors, double free_m, double widest_m, std::vector<LearnedDoor::Place>& places) {
  const double seen = static_cast<double>(places.size());
  if (doors > 2) std::erase_if(places, [&](const auto& place) { return place.share * doors < 1.5; });
  double total = 0;
  for (LearnedDoor::Place& place : places) total += place.share *= doors / (doors + seen / 2);
  places.push_back({1 - total, free_m / 2, std::max(0.3, widest_m / 2), false});
}

std::optional<LearnedDoor> learn_door(const std::vector<const KnownRoom*>& rooms) {
  std::vector<double> widths, heights;
  std::vector<Offset> from_start, from_end, nearer;
  double with_door = 0, known = 0, anywhere = 0, widest_m = 0, free_m = 0;
  for (const KnownRoom* room : rooms) {
    known += room->doors_known;
    with_door += !room->doors.empty();
    for (const KnownDoor& door : room->doors) {
      widths.push_back(door.end_m - door.start_m);
      heights.push_back(door.height_m);
      const double start = std::max(0.0, door.start_m), end = std::max(0.0, room->width_m - door.end_m);
      from_start.push_back({start, false});
      from_end.push_back({end, true});
      nearer.push_back(end < start ? Offset{end, true} : Offset{start, false});
      anywhere += std::log(std::max(0.1, start + end));
      widest_m = std::max(widest_m, start + end);
      free_m += start + end;
    }
  }
  if (widths.empty() || with_door < known / 2) return std::nullopt;
  LearnedDoor door;
  door.width_m = median(widths);
  door.height_m = median(heights);
  if (door.width_m < 0.3 || door.height_m < 1) return std::nullopt;
  double least = anywhere;
  for (const PlaceModel& model : {describe_places(from_start, false), describe_places(from_end, false),
                                  describe_places(nearer, true)}) {
    if (model.length >= least) continue;
    least = model.length;
    door.places = model.places;
  }
  if (!door.places.empty())
    leave_room(static_cast<double>(widths.size()), free_m / static_cast<double>(widths.size()), widest_m,
               door.places);
  return door;
}

std::optional<LearnedType::Windows> learn_windows(const std::vector<const KnownRoom*>& rooms) {
  std::vector<double> widths, heights, sills, steps;
  double with_window = 0;
  for (const KnownRoom* room : rooms) {
    with_window += !room->windows.empty();
    std::vector<double> centres;
    for (const KnownWindow& window : room->windows) {
      widths.push_back(window.width_m);
      heights.push_back(window.head_m - window.sill_m);
      sills.push_back(window.sill_m);
      centres.push_back(window.centre_m);
    }
    std::sort(centres.begin(), centres.end());
    for (std::size_t i = 0; i + 1 < centres.size(); ++i) steps.push_back(centres[i + 1] - centres[i]);
  }
  if (widths.empty() || with_window < 0.5 * static_cast<double>(rooms.size())) return std::nullopt;
  LearnedType::Windows windows;
  windows.width_m = median(widths);
  windows.height_m = median(heights);
  windows.sill_m = std::max(0.0, median(sills));
  windows.spacing_m = steps.empty() ? 0 : median(steps);
  if (windows.width_m < 0.1 || windows.height_m < 0.1) return std::nullopt;
  if (windows.spacing_m < windows.width_m + 0.05) windows.spacing_m = 1.5 * windows.width_m;
  return windows;
}

std::vector<std::string> learn_furniture(const std::vector<const KnownRoom*>& rooms) {
  std::map<std::string, std::vector<double>> counts;
  for (const KnownRoom* room : rooms)
    for (const std::string& piece : room->furniture) counts[piece];
  std::vector<std::string> usual;
  for (auto& [piece, numbers] : counts) {
    for (const KnownRoom* room : rooms)
      numbers.push_back(
          static_cast<double>(std::count(room->furniture.begin(), room->furniture.end(), piece)));
    for (int i = 0; i < static_cast<int>(median(numbers)); ++i) usual.push_back(piece);
  }
  return usual;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

void learn_habits(const std::vector<const KnownRoom*>& rooms, double resolution_m, LearnedType& type) {
  double sum = 0, squares = 0, n = 0;
  for (const KnownRoom* room : rooms) {
    if (room->depth_m <= 0) continue;
    sum += room->depth_m;
    squares += room->depth_m * room->depth_m;
    n += 1;
  }
  if (n > 0) {
    type.depth_mean_m = sum / n;
    type.depth_sd_m =
        std::max(resolution_m, std::sqrt(std::max(0.0, squares / n - type.depth_mean_m * type.depth_mean_m)));
  }
  type.door = learn_door(rooms);
  type.windows = learn_windows(rooms);
  type.furniture = learn_furniture(rooms);
}

}  // namespace gramap
