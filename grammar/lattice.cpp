#include "grammar/lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gramap {
namespace {

constexpr double kCoarseStep_m = 0.1;  // of rooms of any width, where no evidence asks for better
constexpr double kFineSigmas = 4;      // what counts as near an evidence
constexpr std::size_t kMostKeptValues = 16u << 20;  // of priors: 128 MB
constexpr int kSmallGap = 4;                        // of cells that are not alive, too small to go round

double cumulative(double u) {
  return 0.5 * std::erfc(-u / std::numbers::sqrt2);
}

/// Adds `weight` x the mass of a normal to stretches sorted by their first width, merging those that touch.
void add_normal(std::vector<WidthMass>& stretches, double weight, const Normal& normal, const Grid& grid,
                int longest) {
  const double h = grid.step_m;
  const double sd_m = std::max(normal.sd_m, 0.5 * h);
  const double reach = kMassSigmas * sd_m;
  const auto cells = [&](double width_m) { return (width_m + grid.wall_m) / h; };
  const int least = std::max(1, static_cast<int>(std::floor(grid.wall_m / h)) + 1);
  const int first =
      std::max(least, static_cast<int>(std::lround(std::max(0.0, cells(normal.mean_m - reach)))));
  const int last =
      std::min<int>(longest, static_cast<int>(std::lround(std::min(1e8, cells(normal.mean_m + reach)))));
  if (last < first) return;
  WidthMass made{first, {}};
  double before = cumulative((grid.width_m(first) - 0.5 * h - normal.mean_m) / sd_m);
  for (int k = first; k <= last; ++k) {
    const double now = cumulative((grid.width_m(k) + 0.5 * h - normal.mean_m) / sd_m);
    made.mass.push_back(weight * (now - before));
    before = now;
  }
  for (std::size_t i = 0; i < stretches.size();) {
    WidthMass& other = stretches[i];
    const int made_end = made.first + static_cast<int>(made.mass.size());
    const int other_end = other.first + static_cast<int>(other.mass.size());
    if (other.first > made_end || made.first > other_end) {
      ++i;
      continue;
    }
    WidthMass both{std::min(made.first, other.first), {}};
    both.mass.assign(static_cast<std::size_t>(std::max(made_end, other_end) - both.first), 0);
    for (const WidthMass* part : {&made, &other})
      for (std::size_t k = 0; k < part->mass.size(); ++k)
        both.mass[static_cast<std::size_t>(part->first - both.first) + k] += part->mass[k];
    made = std::move(both);
    stretches.erase(stretches.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const auto place = std::find_if(stretches.begin(), stretches.end(),
                                  [&](const WidthMass& other) { return other.first > made.first; });
  stretches.insert(place, std::move(made));
}

int coarse_step(const Grid& grid) {
  return std::max(1, static_cast<int>(std::lround(kCoarseStep_m / grid.step_m)));
}

/// The least and the most cells of an element of uniform width.
std::pair<int, int> uniform_cells(const Element& element, const Grid& grid) {
  const auto cells = [&](double width_m) { return (width_m + grid.wall_m) / grid.step_m; };
  return {std::max(1, static_cast<int>(std::ceil(cells(element.least_m) - 1e-9))),
          static_cast<int>(std::floor(cells(element.most_m) + 1e-9))};
}

}  // namespace

std::vector<WidthMass> mixture_mass(const Mixture& mixture, const Grid& grid) {
  std::vector<WidthMass> stretches;
  for (const Mixture::Component& component : mixture.components)
    if (component.weight > 0) add_normal(stretches, component.weight, component.normal, grid, grid.cells);
  return stretches;
}

Lattice::Lattice(const Row& row, const Grid& grid, const Evidence& evidence, Passes passes)
    : row_(row), grid_(grid), evidence_(evidence), passes_(passes) {
  const int n = grid.cells;
  const auto& rooms = evidence.rooms();
  const int count = static_cast<int>(rooms.size());

  for (const Element& element : row.elements) {
    masses_.emplace_back();
    even_.emplace_back();
    if (element.kind == Element::Width::mixture) {
      masses_.back() = mixture_mass(element.mixture, grid);
      for (const WidthMass& mass : masses_.back())
        longest_ = std::max(longest_, mass.first + static_cast<int>(mass.mass.size()));
    } else if (element.kind == Element::Width::uniform) {
      longest_ = std::max(longest_, static_cast<int>((element.most_m + grid.wall_m) / grid.step_m) + 1);
      const auto [least, most] = uniform_cells(element, grid);
      const double fine = 1.0 / (most - least + 1);
      const auto widths = static_cast<std::size_t>(std::max(0, std::min(most, n) - least + 1));
      even_.back() = {std::vector<double>(widths, fine),
                      std::vector<double>(widths, fine * coarse_step(grid))};
    } else {
      longest_ = n;
    }
  }
  longest_ = std::min(longest_, n);
  shortest_ = n;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const Element& element = row.elements[i];
    if (element.kind == Element::Width::share) shortest_ = 1;
    if (element.kind == Element::Width::uniform)
      shortest_ = std::min(shortest_, static_cast<int>((element.least_m + grid.wall_m) / grid.step_m));
    for (const WidthMass& mass : masses_[i]) shortest_ = std::min(shortest_, mass.first);
  }

  fine_before_.assign(static_cast<std::size_t>(n) + 2, 0);
  const auto mark = [&](double position_m, double sd_m) {
    const double reach = kFineSigmas * sd_m;
    const int first = std::clamp(
        static_cast<int>(std::floor(std::clamp((position_m - reach) / grid.step_m, -1e8, 1e8))), 0, n + 1);
    const int last = std::clamp(
        static_cast<int>(std::ceil(std::clamp((position_m + reach) / grid.step_m, -1e8, 1e8))), -1, n);
    for (int i = first; i <= last; ++i) fine_before_[static_cast<std::size_t>(i) + 1] = 1;
  };
  for (const PreparedEvidence& e : rooms) {
    if (e.has_centre) {
      mark(e.start_wall_m(), e.wall_sd_m);
      mark(e.end_wall_m() + grid.wall_m, e.wall_sd_m);
    } else {
      const auto cells = [&](double width_m) {
        return static_cast<int>(std::lround(std::clamp((width_m + grid.wall_m) / grid.step_m, -1e8, 1e8)));
      };
      fine_widths_.emplace_back(cells(e.width_m - kFineSigmas * e.width_sd_m),
                                cells(e.width_m + kFineSigmas * e.width_sd_m));
      if (e.has_other)
        fine_widths_.emplace_back(cells(e.other_m - kFineSigmas * e.other_sd_m),
                                  cells(e.other_m + kFineSigmas * e.other_sd_m));
    }
  }
  fine_before_[static_cast<std::size_t>(n) + 1] = 1;  // the end of the space
  for (std::size_t i = 1; i < fine_before_.size(); ++i) fine_before_[i] += fine_before_[i - 1];

  for (int j = 0; j <= count; ++j) {
    const PreparedEvidence* e = j < count ? &rooms[static_cast<std::size_t>(j)] : nullptr;
    const PreparedEvidence* before = j > 0 ? &rooms[static_cast<std::size_t>(j - 1)] : nullptr;
    const int first = before != nullptr ? std::min(before->first_start, before->last_start) + 1 : 0;
    first_cell_.push_back(first);
    last_cell_.push_back(std::max(first - 1, e != nullptr ? e->last_start : n));
    if (e == nullptr) break;
    const int opened = e->first_start + 1;
    int closing = opened - 1;
    if (e->has_centre)
      closing = static_cast<int>(
          std::clamp((e->end_wall_m() + kGateSigmas * e->wall_sd_m) / grid.step_m, 0.0, n - 1.0));
    first_cell_.push_back(opened);
    last_cell_.push_back(std::max(opened - 1, closing));
  }
  alive_.assign(static_cast<std::size_t>(n) + 1, {evidence_states(), -1});
  for (int e = 0; e < evidence_states(); ++e) {
    const auto id = static_cast<std::size_t>(e);
    offset_.push_back(nodes_);
    nodes_ += static_cast<std::size_t>(last_cell_[id] - first_cell_[id] + 1) * row.arcs.size();
    for (int cell = first_cell_[id]; cell <= last_cell_[id]; ++cell) {
      auto& [least, most] = alive_[static_cast<std::size_t>(cell)];
      least = std::min(least, e);
      most = std::max(most, e);
    }
  }
  reach_.assign(static_cast<std::size_t>(n) + 1, 0);
  for (int j = 0; j < count; ++j) {
    int& reach = reach_[static_cast<std::size_t>(rooms[static_cast<std::size_t>(j)].first_start)];
    reach = std::max(reach, j + 1);
  }
  for (std::size_t i = 1; i < reach_.size(); ++i) reach_[i] = std::max(reach_[i], reach_[i - 1]);
}

void Lattice::restrict(NodeMask mask) {
  mask_ = std::move(mask);
  next_alive_.clear();
  kept_.clear();
  priors_.clear();
  last_.clear();
  kept_values_ = 0;
  if (mask_.alive.empty()) return;
  const int n = grid_.cells;
  next_alive_.assign(static_cast<std::size_t>(n) + 2, n + 1);
  for (int cell = n; cell >= 0; --cell) {
    const auto [first, last] = alive(cell);
    bool any = false;
    for (int e = first; e <= last && !any; ++e) any = is_alive(cell, e);
    next_alive_[static_cast<std::size_t>(cell)] =
        any ? cell : next_alive_[static_cast<std::size_t>(cell) + 1];
  }
}

std::pair<int, double> Lattice::start() const {
  double weight = 1;
  int next = 0;
  const auto& rooms = evidence_.rooms();
  while (next < static_cast<int>(rooms.size()) && rooms[static_cast<std::size_t>(next)].last_start < 0)
    weight *= rooms[static_cast<std::size_t>(next++)].aside;
  return {2 * next, weight};
}

bool Lattice::needs_fine_steps(int cell, int first, int last) const {
  const auto from = static_cast<std::size_t>(std::min(cell + first, grid_.cells + 1));
  const auto to = static_cast<std::size_t>(std::min(cell + last, grid_.cells)) + 1;
  if (to > from && fine_before_[to] > fine_before_[from]) return true;
  return std::any_of(fine_widths_.begin(), fine_widths_.end(),
                     [&](const auto& fine) { return fine.first <= last && first <= fine.second; });
}

/// Widths that are all alike, in coarse steps where nothing tells them apart.
void Lattice::add_uniform(int cell, int element, Prior& prior) const {
  const Element& placed = row_.elements[static_cast<std::size_t>(element)];
  const Even& even = even_[static_cast<std::size_t>(element)];
  const int coarse = coarse_step(grid_);
  const auto [first, last] = uniform_cells(placed, grid_);
  Prior::Stretch run;
  const auto add = [&](int begin, int stride, int count, const std::vector<double>& mass) {
    if (run.count > 0 && run.stride == stride && run.first + run.count * stride == begin) {
      run.count += count;
      return;
    }
    add_alive(cell, run, prior);
    run = {begin, stride, count, mass.data()};
  };
  for (int begin = first; begin <= std::min(last, grid_.cells - cell); begin += coarse) {
    const int ahead = next_alive(cell + begin) - cell - begin;
    if (ahead >= coarse) {
      begin += (ahead / coarse - 1) * coarse;
      continue;
    }
    const int stop = std::min(begin + coarse - 1, last);
    if (coarse > 1 && stop - begin + 1 == coarse && !needs_fine_steps(cell, begin, stop))
      add(begin + (coarse - 1) / 2, coarse, 1, even.coarse);
    else
      add(begin, 1, stop - begin + 1, even.fine);
  }
  add_alive(cell, run, prior);
}

/// Likelihood of the doors seen in the element's hallway wall.
double Lattice::doors(int cell, const Element& element, int width) const {
  double likelihood = 1;
  for (const ElementRoom& room : element.rooms) {
    if (!room.at_hallway) continue;
    const double clear_m = grid_.width_m(width);
    const double start = room.start.at(clear_m);
    const double end = start + room.width.at(clear_m) + grid_.wall_m;
    const int first = std::clamp(static_cast<int>(std::lround(start / grid_.step_m)), 0, width);
    const int last = std::clamp(static_cast<int>(std::lround(end / grid_.step_m)), first, width);
    likelihood *= evidence_.doors(room.type, cell + first, cell + last);
  }
  return likelihood;
}

void Lattice::add_alive(int cell, const WidthMass& mass, Prior& prior) const {
  add_alive(cell, {mass.first, mass.stride, static_cast<int>(mass.mass.size()), mass.mass.data()}, prior);
}

/// Adds the parts of the stretch that end where something is alive.
void Lattice::add_alive(int cell, const Prior::Stretch& stretch, Prior& prior) const {
  const int room = grid_.cells - cell - stretch.first;
  const int count = room < 0 ? 0 : std::min(stretch.count, room / stretch.stride + 1);
  const auto cell_of = [&](int i) { return cell + stretch.first + i * stretch.stride; };
  /// The first index from `i` on whose cell is alive.
  const auto alive_from = [&](int i) {
    while (i < count) {
      const int ahead = next_alive(cell_of(i)) - cell_of(i);
      if (ahead == 0) return i;
      i += (ahead + stretch.stride - 1) / stretch.stride;
    }
    return count;
  };
  for (int begin = alive_from(0); begin < count;) {
    int end = begin + 1;
    int next = alive_from(end);
    while (next < count && next - end <= kSmallGap) {
      end = next + 1;
      next = alive_from(end);
    }
    prior.stretches.push_back(
        {stretch.first + begin * stretch.stride, stretch.stride, end - begin, stretch.mass + begin});
    begin = next;
  }
}

/// Multiplies every mass by the likelihood of the doors.
void Lattice::weigh_doors(int cell, const Element& element, Prior& prior) const {
  const ElementRoom& room = element.rooms.front();
  const bool plain = element.rooms.size() == 1 && room.at_hallway && room.start.constant == 0 &&
                     room.start.slope == 0 && room.width.constant == 0 && room.width.slope == 1;
  std::size_t count = 0;
  for (const Prior::Stretch& stretch : prior.stretches) count += static_cast<std::size_t>(stretch.count);
  prior.seen.assign(count, 0);
  double* seen = prior.seen.data();
  for (Prior::Stretch& stretch : prior.stretches) {
    if (plain)
      evidence_.doors(room.type, cell, stretch.first, stretch.stride, stretch.count, seen);
    else
      for (int i = 0; i < stretch.count; ++i)
        seen[i] = doors(cell, element, stretch.first + i * stretch.stride);
    for (int i = 0; i < stretch.count; ++i) seen[i] *= stretch.mass[i];
    stretch.mass = seen;
    seen += stretch.count;
  }
}

/// Returns how many values it takes.
std::size_t Lattice::make_prior(int cell, int element, Prior& prior) const {
  const Element& placed = row_.elements[static_cast<std::size_t>(element)];
  prior.stretches.clear();
  prior.made.clear();
  if (placed.kind == Element::Width::uniform) {
    add_uniform(cell, element, prior);
  } else {
    if (placed.kind == Element::Width::share)
      add_normal(prior.made, 1, {placed.share.at(grid_.remaining_m(cell)), placed.share_sd_m}, grid_,
                 grid_.cells - cell);
    const auto& masses =
        placed.kind == Element::Width::share ? prior.made : masses_[static_cast<std::size_t>(element)];
    for (const WidthMass& mass : masses) add_alive(cell, mass, prior);
  }
  if (evidence_.has_doors()) weigh_doors(cell, placed, prior);
  std::size_t made = sizeof(Prior) / sizeof(double) +
                     prior.stretches.size() * sizeof(Prior::Stretch) / sizeof(double) + prior.seen.size();
  for (const WidthMass& mass : prior.made) made += mass.mass.size();
  return made;
}

const Prior& Lattice::prior(int cell, int element) const {
  const std::size_t elements = row_.elements.size();
  if (passes_ == Passes::several) {
    if (kept_.empty()) kept_.resize((static_cast<std::size_t>(grid_.cells) + 1) * elements);
    const Prior*& kept = kept_[static_cast<std::size_t>(cell) * elements + static_cast<std::size_t>(element)];
    if (kept != nullptr) return *kept;
    if (kept_values_ < kMostKeptValues) {
      Prior& prior = priors_.emplace_back();
      kept_values_ += make_prior(cell, element, prior);
      kept = &prior;
      return prior;
    }
  }
  last_.resize(elements);
  LastPrior& last = last_[static_cast<std::size_t>(element)];
  if (last.cell != cell) make_prior(cell, element, last.prior);
  last.cell = cell;
  return last.prior;
}

Extent element_extent(const Grid& grid, int cell, int width) {
  return {grid.position_m(cell), grid.position_m(cell) + grid.width_m(width)};
}

Extent room_extent(const Grid& grid, int cell, int width, const ElementRoom& room) {
  const double clear_m = grid.width_m(width);
  const double start = grid.position_m(cell) + room.start.at(clear_m);
  return {start, start + room.width.at(clear_m)};
}

double belongs(const Lattice& lattice, int cell, int width, const Element& element,
               const PreparedEvidence& e) {
  double sum = 0;
  for (const ElementRoom& room : element.rooms)
    sum += lattice.evidence().type_factor(e, room.type) *
           lattice.evidence().belongs(e, room_extent(lattice.grid(), cell, width, room));
  return sum / static_cast<double>(element.rooms.size());
}

double* Edges::store(int count) {
  if (buffer_count_ == buffers_.size()) buffers_.emplace_back();
  std::vector<double>& buffer = buffers_[buffer_count_++];
  buffer.resize(static_cast<std::size_t>(count));
  return buffer.data();
}

/// Adds edges to the cells of a stretch; evidence that has passed by there is skipped.
void Edges::add(std::vector<Move>& moves, int evidence_state, const Stretch& sum, const double* max,
                int matched) {
  const int base = cell_ + sum.first;
  const auto cell_of = [&](int i) { return base + i * sum.stride; };
  const auto put = [&](int target, int from, int to, double factor) {  // stretch indices, inclusive
    Move move;
    move.target_evidence = target;
    move.first_cell = cell_of(from);
    move.stride = sum.stride;
    move.count = to - from + 1;
    move.matched = matched;
    const auto weights = [&](const double* given) {
      if (factor == 1) return given + from;
      double* scaled = store(move.count);
      for (int i = 0; i < move.count; ++i) scaled[i] = factor * given[from + i];
      return static_cast<const double*>(scaled);
    };
    move.sum = weights(sum.mass);
    move.max = sum.mass == max ? move.sum : weights(max);
    moves.push_back(move);
  };
  if (evidence_state % 2 == 1) {
    int from = 0;
    int to = sum.count - 1;
    while (from <= to && cell_of(from) < lattice_.first_cell(evidence_state)) ++from;
    while (from <= to && cell_of(to) > lattice_.last_cell(evidence_state)) --to;
    if (from <= to) put(evidence_state, from, to, 1);
    return;
  }
  const auto& rooms = lattice_.evidence().rooms();
  int next = evidence_state / 2;
  double factor = 1;
  for (int from = 0; from < sum.count;) {
    while (next < static_cast<int>(rooms.size()) &&
           cell_of(from) > rooms[static_cast<std::size_t>(next)].last_start)
      factor *= rooms[static_cast<std::size_t>(next++)].aside;
    int to = sum.count - 1;
    if (next < static_cast<int>(rooms.size()))
      to = std::min(to, (rooms[static_cast<std::size_t>(next)].last_start - base) / sum.stride);
    put(2 * next, from, to, factor);
    from = to + 1;
  }
}

/// Weights of the evidence belonging to the element at each width; whether any is above zero.
bool Edges::weigh(const PreparedEvidence& e, const Element& element, const Stretch& widths,
                  double* weights) const {
  if (element.rooms.size() == 1) {
    const double factor = lattice_.evidence().type_factor(e, element.rooms.front().type);
    const bool any =
        lattice_.evidence().belongs(e, cell_, widths.first, widths.stride, widths.count, weights);
    for (int i = 0; any && i < widths.count; ++i) weights[i] *= factor;
    return any;
  }
  bool any = false;
  for (int i = 0; i < widths.count; ++i) {
    weights[i] = belongs(lattice_, cell_, widths.first + i * widths.stride, element, e);
    any = any || weights[i] > 0;
  }
  return any;
}

/// Edges on which the room explains evidence `next` or later ones.
void Edges::add_matches(std::vector<Move>& moves, const Element& element, const Stretch& prior, int next) {
  const auto& rooms = lattice_.evidence().rooms();
  const int reach = lattice_.reach(cell_);
  const double* sum = prior.mass;
  const double* max = prior.mass;
  const auto scaled = [&](const double* weights, double factor) {
    double* made = store(prior.count);
    for (int i = 0; i < prior.count; ++i) made[i] = factor * weights[i];
    return made;
  };
  for (int j = next; j < reach; ++j) {
    const PreparedEvidence& e = rooms[static_cast<std::size_t>(j)];
    const bool near = e.first_start <= cell_ && cell_ <= e.last_start;
    if (!near) {
      const double* next_sum = scaled(sum, e.aside);
      max = sum == max ? next_sum : scaled(max, e.aside);
      sum = next_sum;
      continue;
    }
    double* weight = store(prior.count);
    const bool any = weigh(e, element, prior, weight);
    int first = 0;
    int last = any ? prior.count - 1 : -1;
    while (first <= last && weight[first] <= 0) ++first;
    while (first <= last && weight[last] <= 0) --last;
    const double opens =
        lattice_.evidence().reading(e, Reading::opens, element_extent(lattice_.grid(), cell_, 1));
    if (opens > 0) {
      const double* opened_sum = scaled(sum, opens);
      const double* opened_max = sum == max ? opened_sum : scaled(max, opens);
      add(moves, 2 * j + 1, {prior.first, prior.stride, prior.count, opened_sum}, opened_max, j);
    }
    if (first <= last) {
      const int count = last - first + 1;
      double* matched_sum = store(count);
      double* matched_max = sum == max ? matched_sum : store(count);
      for (int i = 0; i < count; ++i) {
        matched_sum[i] = sum[first + i] * weight[first + i];
        matched_max[i] = max[first + i] * weight[first + i];
      }
      add(moves, 2 * (j + 1), {prior.first + first * prior.stride, prior.stride, count, matched_sum},
          matched_max, j);
    }
    if (j + 1 == reach) break;
    double* next_sum = store(prior.count);
    double* next_max = store(prior.count);
    for (int i = 0; i < prior.count; ++i) {
      next_sum[i] = sum[i] * (e.again * weight[i] + e.aside);
      next_max[i] = max[i] * std::max(e.again * weight[i], e.aside);
    }
    sum = next_sum;
    max = next_max;
  }
}

const std::vector<Move>& Edges::moves(int cell, int element, int evidence_state) {
  if (cell != cell_) {
    cell_ = cell;
    buffer_count_ = 0;
    known_count_ = 0;
  }
  for (std::size_t i = 0; i < known_count_; ++i)
    if (known_[i].element == element && known_[i].evidence_state == evidence_state) return known_[i].moves;
  if (known_count_ == known_.size()) known_.emplace_back();
  Known& known = known_[known_count_++];
  known.element = element;
  known.evidence_state = evidence_state;
  known.moves.clear();

  const Element& placed = lattice_.row().elements[static_cast<std::size_t>(element)];
  const int next = evidence_state / 2;
  for (const Stretch& stretch : lattice_.prior(cell, element).stretches) {
    if (evidence_state % 2 == 0) {
      add(known.moves, evidence_state, stretch, stretch.mass, -1);
      add_matches(known.moves, placed, stretch, next);
      continue;
    }
    const PreparedEvidence& e = lattice_.evidence().rooms()[static_cast<std::size_t>(next)];
    double* closed = store(stretch.count);
    for (int i = 0; i < stretch.count; ++i)
      closed[i] = stretch.mass[i] * e.end_density.at(cell_ + stretch.first + i * stretch.stride);
    Stretch read = stretch;
    read.mass = closed;
    add(known.moves, 2 * (next + 1), read, closed, next);
  }
  return known.moves;
}

}  // namespace gramap
