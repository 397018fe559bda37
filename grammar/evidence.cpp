#include "grammar/evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace gramap {
namespace {

constexpr double kDepthShare = 0.9;       // rooms that are as deep as their space
constexpr double kDepthSd_m = 0.1;        // their spread
constexpr double kThirdDoorShare = 0.2;   // of rooms with n doors, those that have one more
constexpr double kLeastPlaceSd_m = 0.01;  // nobody builds doors to better than that
constexpr double kElsewhereShare = 0.05;  // doors that are not where their room's type has them
constexpr double kOtherWidthShare = 0.1;  // doors that are not as wide as their room's type has them
constexpr double kDoorWidthSd_m = 0.03;   // spread of those that are
constexpr double kDoorWidths_m = 2;       // range of the others, and of what is taken for a door
constexpr double kDoorFrame_m = 0.05;     // least wall between a door and its room's corner
constexpr double kSmallestSlack_m = 0.1;  // a door in a room of its own width still has some play

double gauss(double x, double mean, double sd) {
  const double u = (x - mean) / sd;
  if (std::abs(u) > kGateSigmas) return 0;
  return std::exp(-0.5 * u * u) / (sd * std::sqrt(2 * std::numbers::pi));
}

double cumulative(double u) {
  return 0.5 * std::erfc(-u / std::numbers::sqrt2);
}

/// Density of the dimension across the line.
double across_density(double value_m, double sd_m, double depth_m, double range_m) {
  if (depth_m <= 0) return 1 / range_m;
  return kDepthShare * gauss(value_m, depth_m, std::hypot(sd_m, kDepthSd_m)) + (1 - kDepthShare) / range_m;
}

int to_cell(double position_m, const Grid& grid) {
  return static_cast<int>(std::lround(std::clamp(position_m / grid.step_m, -1e9, 1e9)));
}

/// The cells at which a room may start that explains the evidence in one of the ways `Evidence::reading`
/// knows.
void set_window(PreparedEvidence& e, const Grid& grid) {
  if (!e.has_centre) {
    e.first_start = 0;
    e.last_start = grid.cells - 1;
    return;
  }
  const double wall_gate = kGateSigmas * e.wall_sd_m;
  double first =
      std::min(e.start_wall_m() - wall_gate, e.end_wall_m() - wall_gate - e.width_m - kMostCutOff_m);
  double last = std::max(e.start_wall_m() + wall_gate, e.end_wall_m() + wall_gate - e.width_m);
  const auto widen = [&](double width, double sd) {
    const double reach = kGateSigmas * (e.centre_sd_m + 0.5 * sd);
    first = std::min(first, e.centre_m - 0.5 * width - reach);
    last = std::max(last, e.centre_m - 0.5 * width + reach);
  };
  widen(e.width_m, e.width_sd_m);
  if (e.has_other) widen(e.other_m, e.other_sd_m);
  e.first_start = std::clamp(to_cell(first, grid) - 1, 0, grid.cells - 1);
  e.last_start = std::clamp(to_cell(last, grid) + 1, -1, grid.cells - 1);
}

/// f(first), …, f(last), and what it is before and after these.
template <class Function>
WindowTable tabulated(int first, int last, double before, double after, Function f) {
  WindowTable table{first, {}, before, after};
  for (int i = first; i <= last; ++i) table.values.push_back(f(i));
  return table;
}

/// The Gaussians of all readings; see `Evidence::reading`, which says the same for any extent.
void set_densities(PreparedEvidence& e, const Grid& grid) {
  const double h = grid.step_m;
  /// Of a quantity that is `least_m` at 0 and grows by `pace_m` with each cell.
  const auto density = [](double read_m, double sd_m, double least_m, double pace_m, int most) {
    const auto index = [&](double value_m) {
      return std::clamp((value_m - least_m) / pace_m, -1.0, most + 1.0);
    };
    return tabulated(static_cast<int>(index(read_m - kGateSigmas * sd_m)),
                     static_cast<int>(index(read_m + kGateSigmas * sd_m)) + 1, 0, 0,
                     [&](int i) { return gauss(read_m, least_m + i * pace_m, sd_m); });
  };
  e.width_density = density(e.width_m, e.width_sd_m, -grid.wall_m, h, grid.cells);
  if (e.has_other) e.other_density = density(e.other_m, e.other_sd_m, -grid.wall_m, h, grid.cells);
  e.centre_density = {0, {}, 1, 1};
  if (!e.has_centre) return;
  e.start_density = density(e.start_wall_m(), e.wall_sd_m, 0, h, grid.cells);
  e.end_density = density(e.end_wall_m(), e.wall_sd_m, -grid.wall_m, h, grid.cells);
  e.centre_density = density(e.centre_m, e.centre_sd_m, -0.5 * grid.wall_m, 0.5 * h, 2 * grid.cells);
}

}  // namespace

Evidence::Evidence(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                   const Grid& grid)
    : rules_(rules), options_(options), grid_(grid), depth_m_(problem.depth_m) {
  width_range_m_ = std::max(rules.background.most_m, 1.0);
  const double h = grid.step_m;
  const double range = width_range_m_;
  const std::size_t types = rules.rooms.size();
  bool in_order = false;  // as given
  for (std::size_t i = 0; i < problem.rooms.size(); ++i) {
    const RoomEvidence& given = problem.rooms[i];
    PreparedEvidence e;
    e.original = static_cast<int>(i);
    e.width_m = given.width_m;
    e.width_sd_m = std::sqrt(given.width_sigma_m * given.width_sigma_m + h * h / 6);
    e.of_two_rooms = given.of_two_rooms;
    e.has_other = given.other_width_m.has_value();
    e.other_m = given.other_width_m.value_or(0);
    e.other_sd_m = std::sqrt(given.other_sigma_m * given.other_sigma_m + h * h / 6);
    e.has_centre = given.centre_m.has_value();
    in_order = in_order || !e.has_centre;
    e.centre_m = given.centre_m.value_or(0);
    e.centre_sd_m = std::sqrt(given.centre_sigma_m * given.centre_sigma_m + h * h / 24);
    e.wall_sd_m = std::sqrt(given.centre_sigma_m * given.centre_sigma_m +
                            0.25 * given.width_sigma_m * given.width_sigma_m + h * h / 12);
    e.aside = options.outlier_share / range;
    if (e.has_centre) e.aside /= problem.length_m;
    if (e.has_other) {
      e.aside /= range;
      e.depth_factor = across_density(e.other_m, e.other_sd_m, depth_m_, range);
      e.swapped_depth_factor = across_density(e.width_m, e.width_sd_m, depth_m_, range);
    }
    e.type_factor.assign(types + 1, 1);
    const auto known = std::find_if(rules.rooms.begin(), rules.rooms.end(),
                                    [&](const RoomType& room) { return room.name == given.type; });
    if (!given.type.empty() && known != rules.rooms.end()) {
      const double even = 1.0 / static_cast<double>(types + 1);
      const double sure = std::clamp(given.type_confidence, 0.0, 0.999);
      e.type_factor.assign(types + 1, (1 - sure) * even);
      e.type_factor[static_cast<std::size_t>(known - rules.rooms.begin())] += sure;
      e.type_even = even;
      e.aside *= even;
    }
    set_window(e, grid);
    set_densities(e, grid);
    rooms_.push_back(std::move(e));
  }
  if (!in_order)
    std::stable_sort(rooms_.begin(), rooms_.end(), [](const PreparedEvidence& a, const PreparedEvidence& b) {
      if (a.centre_m != b.centre_m) return a.centre_m < b.centre_m;
      return a.width_m < b.width_m;
    });
  for (std::size_t i = 0; i + 1 < rooms_.size(); ++i) {
    const auto& id = [&](std::size_t e) -> const std::string& {
      return problem.rooms[static_cast<std::size_t>(rooms_[e].original)].id;
    };
    rooms_[i].again = id(i) == id(i + 1) ? 1 : options.duplicate_share;
  }

  if (problem.doors_visible.empty()) return;
  doors_ = problem.doors;
  std::sort(doors_.begin(), doors_.end(),
            [](const DoorEvidence& a, const DoorEvidence& b) { return a.centre_m < b.centre_m; });
  for (DoorEvidence& door : doors_) door.sigma_m = std::sqrt(door.sigma_m * door.sigma_m + h * h / 12);
  for (const DoorEvidence& door : doors_) door_tables_.push_back(door_tables(door));
  // Stretches may overlap; each counts.
  std::vector<double> starts, ends;
  for (const Stretch& stretch : problem.doors_visible) {
    if (stretch.end_m <= stretch.start_m) continue;
    starts.push_back(stretch.start_m);
    ends.push_back(stretch.end_m);
  }
  std::sort(starts.begin(), starts.end());
  std::sort(ends.begin(), ends.end());
  std::size_t door = 0;
  std::size_t started = 0;
  std::size_t ended = 0;
  double closed_m = 0;  // of the stretches that began or ended, ends - starts
  for (int n = 0; n <= grid.cells; ++n) {
    const double edge = n == grid.cells ? 1e9 : n == 0 ? -1e9 : grid.position_m(n) - 0.5 * grid.wall_m;
    while (door < doors_.size() && doors_[door].centre_m < edge) ++door;
    doors_before_.push_back(static_cast<int>(door));
    while (started < starts.size() && starts[started] < edge) closed_m -= starts[started++];
    while (ended < ends.size() && ends[ended] < edge) closed_m += ends[ended++];
    visible_.push_back(started == ended ? closed_m : closed_m + edge * static_cast<double>(started - ended));
  }
}

double Evidence::reading(const PreparedEvidence& e, Reading how, const Extent& room) const {
  const double known = 1 - options_.outlier_share;
  const double whole_share = 1 - options_.cut_off_share - options_.missed_wall_share;
  const double width = room.width_m();
  const auto fits = [&](double read_m, double sd_m) {
    const double position = e.has_centre ? gauss(e.centre_m, room.centre_m(), e.centre_sd_m) : 1;
    return position > 0 ? known * whole_share * position * gauss(read_m, width, sd_m) : 0;
  };
  if (e.of_two_rooms && how != Reading::aside && how != Reading::opens && how != Reading::closes) return 0;
  switch (how) {
    case Reading::aside:
      return e.aside;
    case Reading::whole:
      return (e.has_other ? 0.5 : 1) * e.depth_factor * fits(e.width_m, e.width_sd_m);
    case Reading::swapped:
      return e.has_other ? 0.5 * e.swapped_depth_factor * fits(e.other_m, e.other_sd_m) : 0;
    default:
      break;
  }
  if (!e.has_centre) return 0;
  if (how == Reading::opens)
    return known * options_.missed_wall_share * e.depth_factor * e.type_even *
           gauss(e.start_wall_m(), room.start_m, e.wall_sd_m);
  if (how == Reading::closes) return gauss(e.end_wall_m(), room.end_m, e.wall_sd_m);
  const double cut_off_m = width - e.width_m;
  if (cut_off_m <= 0 || cut_off_m > kMostCutOff_m) return 0;
  const double wall = how == Reading::start_only ? gauss(e.start_wall_m(), room.start_m, e.wall_sd_m)
                                                 : gauss(e.end_wall_m(), room.end_m, e.wall_sd_m);
  return known * options_.cut_off_share * 0.5 * e.depth_factor * wall / kMostCutOff_m;
}

double Evidence::belongs(const PreparedEvidence& e, const Extent& room) const {
  return reading(e, Reading::whole, room) + reading(e, Reading::swapped, room) +
         reading(e, Reading::start_only, room) + reading(e, Reading::end_only, room);
}

bool Evidence::belongs(const PreparedEvidence& e, int cell, int first, int stride, int count,
                       double* weights) const {
  const double known = 1 - options_.outlier_share;
  const double whole = known * (1 - options_.cut_off_share - options_.missed_wall_share);
  bool any = false;
  std::fill(weights, weights + count, 0);
  if (e.of_two_rooms) return any;
  // Each reading is possible for a short stretch of widths only.
  const auto add = [&](int least, int most, auto&& density) {
    const int from = std::max(0, (least - first + stride - 1) / stride);
    const int to = std::min(count - 1, (most - first) / stride);
    for (int i = from; i <= to; ++i) {
      const double weight = density(first + i * stride);
      weights[i] += weight;
      any = any || weight > 0;
    }
  };
  const auto add_whole = [&](const WindowTable& widths, double factor) {
    add(widths.first, widths.last(),
        [&](int width) { return factor * widths.at(width) * e.centre_density.at(2 * cell + width); });
  };
  add_whole(e.width_density, (e.has_other ? 0.5 : 1) * e.depth_factor * whole);
  if (e.has_other) add_whole(e.other_density, 0.5 * e.swapped_depth_factor * whole);
  if (!e.has_centre) return any;
  const double cut_off = known * options_.cut_off_share * 0.5 * e.depth_factor / kMostCutOff_m;
  const auto is_cut_off = [&](int width) {
    const double cut_off_m = grid_.width_m(width) - e.width_m;
    return cut_off_m > 0 && cut_off_m <= kMostCutOff_m;
  };
  const auto width_cells = [&](double width_m) {
    return static_cast<int>(std::min((width_m + grid_.wall_m) / grid_.step_m, 1e8));
  };
  const int narrowest = width_cells(e.width_m);
  const int widest = width_cells(e.width_m + kMostCutOff_m) + 1;
  const double at_start = cut_off * e.start_density.at(cell);
  if (at_start > 0) add(narrowest, widest, [&](int width) { return is_cut_off(width) ? at_start : 0; });
  add(std::max(narrowest, e.end_density.first - cell), std::min(widest, e.end_density.last() - cell),
      [&](int width) { return is_cut_off(width) ? cut_off * e.end_density.at(cell + width) : 0; });
  return any;
}

template <class Function>
WindowTable Evidence::tabulate(double least_m, double most_m, double before, double after, Function f) const {
  return tabulated(std::clamp(to_cell(least_m, grid_) - 1, 0, grid_.cells + 1),
                   std::clamp(to_cell(most_m, grid_) + 1, -1, grid_.cells), before, after,
                   [&](int cell) { return f(grid_.position_m(cell)); });
}

Evidence::DoorTables Evidence::door_tables(const DoorEvidence& door) const {
  const double near_m = door.centre_m - 0.5 * door.width_m;
  const double far_m = door.centre_m + 0.5 * door.width_m;
  const double reach_m = kGateSigmas * door.sigma_m + kDoorFrame_m;
  DoorTables tables;
  const auto add_fits = [&](double frame_m) {
    tables.starts_before.push_back(tabulate(near_m - reach_m, near_m + reach_m, 1, 0, [&](double start_m) {
      return cumulative((near_m - frame_m - start_m) / door.sigma_m);
    }));
    // The room ends a wall before the next one starts.
    tables.ends_after.push_back(tabulate(
        far_m - reach_m + grid_.wall_m, far_m + reach_m + grid_.wall_m, 0, 1,
        [&](double next_m) { return cumulative((next_m - grid_.wall_m - far_m - frame_m) / door.sigma_m); }));
  };
  for (const RoomType& type : rules_.rooms) {
    tables.width.push_back(1);
    if (type.door && door.width_sigma_m > 0)
      tables.width.back() = kOtherWidthShare + (1 - kOtherWidthShare) * kDoorWidths_m *
                                                   gauss(door.width_m, type.door->width_m,
                                                         std::hypot(door.width_sigma_m, kDoorWidthSd_m));
    WindowTable& from_start = tables.from_start.emplace_back();
    WindowTable& from_end = tables.from_end.emplace_back();
    double frame_m = kDoorFrame_m;  // unless the rules say that doors are nearer to the corner
    if (type.door)
      for (const DoorHabit::Place& place : type.door->places)
        frame_m = std::min(frame_m, place.offset.mean_m);
    add_fits(frame_m);
    tables.has_habit.push_back(type.door && !type.door->places.empty());
    if (!tables.has_habit.back()) continue;
    double weights = 0;
    double reach = 0;
    double farthest = 0;
    for (const DoorHabit::Place& place : type.door->places) {
      weights += place.weight;
      reach = std::max(reach,
                       kGateSigmas * std::hypot(std::max(place.offset.sd_m, kLeastPlaceSd_m), door.sigma_m));
      farthest = std::max(farthest, std::abs(place.offset.mean_m));
    }
    const auto density = [&](bool end, double offset_m) {
      double sum = 0;
      for (const DoorHabit::Place& place : type.door->places)
        if (place.from_end == end)
          sum += place.weight / weights *
                 gauss(offset_m, place.offset.mean_m,
                       std::hypot(std::max(place.offset.sd_m, kLeastPlaceSd_m), door.sigma_m));
      return sum;
    };
    from_start = tabulate(near_m - farthest - reach, near_m + farthest + reach, 0, 0,
                          [&](double start_m) { return density(false, near_m - start_m); });
    from_end = tabulate(far_m + grid_.wall_m - farthest - reach, far_m + grid_.wall_m + farthest + reach, 0,
                        0, [&](double next_m) { return density(true, next_m - grid_.wall_m - far_m); });
  }
  add_fits(kDoorFrame_m);
  return tables;
}

/// Density of the door's place in a room of the type that takes [first_cell, last_cell), times what its width
/// says. Of a room's second door only the width is known beforehand.
Evidence::DoorPlace Evidence::door_place(std::size_t door, int type, int first_cell, int last_cell) const {
  const DoorTables& tables = door_tables_[door];
  const std::size_t t = type < 0 ? rules_.rooms.size() : static_cast<std::size_t>(type);
  const double fits = tables.starts_before[t].at(first_cell) * tables.ends_after[t].at(last_cell);
  if (fits <= 0) return {};
  const double width_m = grid_.width_m(last_cell - first_cell);
  const double anywhere = 1 / std::max(width_m - doors_[door].width_m, kSmallestSlack_m);
  if (type < 0) return {fits * anywhere, fits * anywhere};
  const double fitting = fits * tables.width[t];
  if (!tables.has_habit[t]) return {fitting * anywhere, fitting * anywhere};
  const double habit = tables.from_start[t].at(first_cell) + tables.from_end[t].at(last_cell);
  return {fitting * (kElsewhereShare * anywhere + (1 - kElsewhereShare) * habit), fitting * anywhere};
}

double Evidence::doors(int type, int first_cell, int last_cell) const {
  const double gross_m = (last_cell - first_cell) * grid_.step_m;
  const auto first = static_cast<std::size_t>(doors_before_[static_cast<std::size_t>(first_cell)]);
  const auto last = static_cast<std::size_t>(doors_before_[static_cast<std::size_t>(last_cell)]);
  const double seen_m =
      visible_[static_cast<std::size_t>(last_cell)] - visible_[static_cast<std::size_t>(first_cell)];
  const double seen = std::clamp(seen_m / gross_m, 0.0, 1.0);
  const double none = options_.doorless_share + (1 - options_.doorless_share) * (1 - seen);
  if (first == last) return none;

  const double one = 1 - options_.doorless_share - options_.second_door_share;
  const double lone_false = options_.false_door_share / (grid_.cells * grid_.step_m);
  double all_false = 1;
  double one_real = 0;
  double all_real = options_.second_door_share;
  for (std::size_t i = first; i < last; ++i) {
    const DoorPlace place = door_place(i, type, first_cell, last_cell);
    one_real = one_real * lone_false + all_false * place.first;
    all_false *= lone_false;
    all_real *= place.other;
    if (i >= first + 2) all_real *= kThirdDoorShare;
  }
  return none * all_false + one * one_real + (last - first >= 2 ? all_real : 0);
}

}  // namespace gramap
