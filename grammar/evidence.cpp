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

double place_sd_m(const DoorHabit::Place& place, const DoorEvidence& door) {
  return std::hypot(std::max(place.offset.sd_m, kLeastPlaceSd_m), door.sigma_m);
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
                   const Grid& grid, const std::vector<double>& whole_factor)
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
    if (!whole_factor.empty()) e.whole_factor = whole_factor[i];
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
  for (std::size_t type = 0; type <= types; ++type) {
    std::vector<DoorTables>& tables = door_tables_.emplace_back();
    for (const DoorEvidence& door : doors_)
      tables.push_back(door_tables(door, type < types ? &rules.rooms[type] : nullptr));
  }
  double usual_width_m = 0;
  for (const DoorEvidence& door : doors_) usual_width_m += door.width_m / static_cast<double>(doors_.size());
  for (int cells = 0; cells <= grid.cells; ++cells)
    door_anywhere_.push_back(1 / std::max(grid.width_m(cells) - usual_width_m, kSmallestSlack_m));
  all_false_.push_back(1);
  for (std::size_t i = 0; i < doors_.size(); ++i)
    all_false_.push_back(all_false_.back() * options.false_door_share / (grid.cells * h));
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
      return (e.has_other ? 0.5 : 1) * e.whole_factor * e.depth_factor * fits(e.width_m, e.width_sd_m);
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
  add_whole(e.width_density, (e.has_other ? 0.5 : 1) * e.whole_factor * e.depth_factor * whole);
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

/// `type` may be null: a room of which nothing is known.
Evidence::DoorTables Evidence::door_tables(const DoorEvidence& door, const RoomType* type) const {
  const double near_m = door.centre_m - 0.5 * door.width_m;
  const double far_m = door.centre_m + 0.5 * door.width_m;
  const DoorHabit* habit = type != nullptr && type->door ? &*type->door : nullptr;
  DoorTables tables;
  if (habit != nullptr && door.width_sigma_m > 0)
    tables.width = kOtherWidthShare +
                   (1 - kOtherWidthShare) * kDoorWidths_m *
                       gauss(door.width_m, habit->width_m, std::hypot(door.width_sigma_m, kDoorWidthSd_m));

  double frame_m = kDoorFrame_m;  // unless the rules say that doors are nearer to the corner
  if (habit != nullptr)
    for (const DoorHabit::Place& place : habit->places) frame_m = std::min(frame_m, place.offset.mean_m);
  const double frame_reach_m = kGateSigmas * door.sigma_m + kDoorFrame_m;
  tables.starts_before = tabulate(near_m - frame_reach_m, near_m + frame_reach_m, 1, 0, [&](double start_m) {
    return cumulative((near_m - frame_m - start_m) / door.sigma_m);
  });
  // The room ends a wall before the next one starts.
  const double next_m = far_m + grid_.wall_m;
  tables.ends_after = tabulate(next_m - frame_reach_m, next_m + frame_reach_m, 0, 1, [&](double start_m) {
    return cumulative((start_m - next_m - frame_m) / door.sigma_m);
  });
  if (habit == nullptr || habit->places.empty()) return tables;

  double weights = 0;
  double reach_m = 0;
  for (const DoorHabit::Place& place : habit->places) {
    weights += place.weight;
    reach_m = std::max(reach_m, std::abs(place.offset.mean_m) + kGateSigmas * place_sd_m(place, door));
  }
  const auto density = [&](bool end, double offset_m) {
    double sum = 0;
    for (const DoorHabit::Place& place : habit->places)
      if (place.from_end == end)
        sum += place.weight / weights * gauss(offset_m, place.offset.mean_m, place_sd_m(place, door));
    return sum;
  };
  tables.from_start = tabulate(near_m - reach_m, near_m + reach_m, 0, 0,
                               [&](double start_m) { return density(false, near_m - start_m); });
  tables.from_end = tabulate(next_m - reach_m, next_m + reach_m, 0, 0,
                             [&](double start_m) { return density(true, start_m - next_m); });
  return tables;
}

double Evidence::doors(int type, int first_cell, int last_cell) const {
  double likelihood = 0;
  doors(type, first_cell, last_cell - first_cell, 1, 1, &likelihood);
  return likelihood;
}

/// Of a room's doors one is where its type has it, or anywhere in the room; of its other doors only the width
/// is known beforehand. What was taken for a door may be none, or all but one, or all may be real.
void Evidence::doors(int type, int cell, int first, int stride, int count, double* likelihoods) const {
  const std::size_t t = type < 0 ? rules_.rooms.size() : static_cast<std::size_t>(type);
  const bool has_habit = type >= 0 && rules_.rooms[t].door && !rules_.rooms[t].door->places.empty();
  const double elsewhere = has_habit ? kElsewhereShare : 1;
  const double one = 1 - options_.doorless_share - options_.second_door_share;
  const std::vector<DoorTables>& tables = door_tables_[t];
  const auto first_door = static_cast<std::size_t>(doors_before_[static_cast<std::size_t>(cell)]);
  const double seen_before_m = visible_[static_cast<std::size_t>(cell)];

  struct Sums {
    double anywhere = 0;  // of the doors' weights as far as they may be anywhere,
    double habit = 0;     // of those where the type has its door,
    double all = 1;       // and the product of the former
    void add(const DoorTables& door, int start, int end) {
      const double fits = door.starts_before.at(start) * door.ends_after.at(end) * door.width;
      anywhere += fits;
      habit += fits * (door.from_start.at(start) + door.from_end.at(end));
      all *= fits;
    }
  };
  Sums settled;  // of doors that lie before the room's end, whatever the width from here on
  std::size_t next = first_door;
  for (int i = 0; i < count; ++i) {
    const int width = first + i * stride;
    const int end = cell + width;
    const auto last_door = static_cast<std::size_t>(doors_before_[static_cast<std::size_t>(end)]);
    const double seen_m = visible_[static_cast<std::size_t>(end)] - seen_before_m;
    const double seen = std::clamp(seen_m / (width * grid_.step_m), 0.0, 1.0);
    const double none = 1 - (1 - options_.doorless_share) * seen;
    if (last_door <= first_door) {
      likelihoods[i] = none;
      continue;
    }
    for (; next < last_door && tables[next].settled() < end; ++next) settled.add(tables[next], cell, end);
    Sums sums = settled;
    for (std::size_t door = next; door < last_door; ++door) sums.add(tables[door], cell, end);

    const std::size_t doors = last_door - first_door;
    const double anywhere = door_anywhere_[static_cast<std::size_t>(width)];
    likelihoods[i] =
        none * all_false_[doors] +
        one * all_false_[doors - 1] * (elsewhere * anywhere * sums.anywhere + (1 - elsewhere) * sums.habit);
    if (doors < 2 || sums.all <= 0) continue;
    double all_real = options_.second_door_share * sums.all * anywhere * anywhere;
    for (std::size_t door = 2; door < doors; ++door) all_real *= kThirdDoorShare * anywhere;
    likelihoods[i] += all_real;
  }
}

}  // namespace gramap
