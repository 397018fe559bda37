#include "floor/cross.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <random>

#include "geometry/error.h"
#include "geometry/random.h"
#include "grammar/like_scanned.h"
#include "grammar/likelihood.h"
#include "grammar/row_evidence.h"
#include "grammar/space.h"

namespace gramap {
namespace {

constexpr double kTold_m = 0.05;  // standard deviation of widths and places where rooms are to be foretold

struct Interval {
  double start_m = 0, end_m = 0;
  double width_m() const { return end_m - start_m; }
};

std::vector<Interval> true_rooms(const KnownRow& row, double wall_m) {
  std::vector<Interval> rooms;
  double start = 0;
  for (const KnownRoom& room : row.rooms) {
    rooms.push_back({start, start + room.width_m});
    start += room.width_m + wall_m;
  }
  return rooms;
}

double normal(std::mt19937_64& generator) {
  const double u = unit_interval(generator()) + 0x1p-54;  // never 0
  return box_muller(u, unit_interval(generator()) + 0x1p-54);
}

/// `count` of `total` places, all choices alike.
std::vector<bool> choose(std::size_t total, std::size_t count, std::mt19937_64& generator) {
  std::vector<bool> chosen(total, false);
  for (std::size_t i = 0, left = count; i < total && left > 0; ++i) {
    if (generator() % (total - i) >= left) continue;
    chosen[i] = true;
    --left;
  }
  return chosen;
}

void add_doors(const KnownRow& row, const std::vector<Interval>& rooms, std::mt19937_64& generator,
               SpaceProblem& problem) {
  constexpr double sigma_m = 0.05;
  for (std::size_t i = 0; i < rooms.size(); ++i)
    for (const KnownDoor& door : row.rooms[i].doors)
      problem.doors.push_back(
          {rooms[i].start_m + (door.start_m + door.end_m) / 2 + sigma_m * normal(generator), sigma_m,
           door.end_m - door.start_m});
  std::sort(problem.doors.begin(), problem.doors.end(),
            [](const DoorEvidence& a, const DoorEvidence& b) { return a.centre_m < b.centre_m; });
  problem.doors_visible = {{0, row.length_m}};
}

std::vector<Interval> divide_equally(const SpaceProblem& problem, double wall_m, double usual_width_m) {
  std::vector<Interval> scanned;
  double sum = 0;
  for (const RoomEvidence& room : problem.rooms) {
    scanned.push_back({*room.centre_m - room.width_m / 2, *room.centre_m + room.width_m / 2});
    sum += room.width_m;
  }
  std::sort(scanned.begin(), scanned.end(),
            [](const Interval& a, const Interval& b) { return a.start_m < b.start_m; });
  const double usual = scanned.empty() ? usual_width_m : sum / static_cast<double>(scanned.size());
  std::vector<Interval> rooms;
  double from = 0;
  const auto fill = [&](double to) {
    const int count = static_cast<int>(std::lround((to - from + wall_m) / (usual + wall_m)));
    const double width = count > 0 ? (to - from - (count - 1) * wall_m) / count : 0;
    for (int i = 0; i < count; ++i)
      rooms.push_back({from + i * (width + wall_m), from + i * (width + wall_m) + width});
  };
  for (const Interval& room : scanned) {
    fill(room.start_m - wall_m);
    rooms.push_back(room);
    from = room.end_m + wall_m;
  }
  fill(problem.length_m);
  return rooms;
}

std::vector<Interval> fit_rooms(const RuleSet& rules, const SpaceProblem& problem,
                                const FitOptions& options) {
  try {
    std::vector<Interval> rooms;
    for (const PlacedRoom& room : fit_space(rules, problem, options).best.rooms)
      if (room.depth_start_m == 0) rooms.push_back({room.start_m, room.start_m + room.width_m});
    return rooms;
  } catch (const InputError&) {
    return {};  // counted as failed, all of its rooms missing
  }
}

struct Sums {
  double rooms = 0, present = 0, spaces = 0, spaces_right = 0, unscanned = 0, error = 0, within = 0, nats = 0,
         failed = 0;
  Sums& operator+=(const Sums& other) {
    rooms += other.rooms, present += other.present, spaces += other.spaces,
        spaces_right += other.spaces_right;
    unscanned += other.unscanned, error += other.error, within += other.within, nats += other.nats;
    failed += other.failed;
    return *this;
  }
};

Sums compare(const std::vector<Interval>& truth, const std::vector<Interval>& found,
             const std::vector<bool>& scanned) {
  Sums sums;
  sums.spaces = 1;
  sums.spaces_right = truth.size() == found.size();
  sums.failed = found.empty();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    double best = 0, width = 0;
    for (const Interval& room : found) {
      const double shared = std::min(room.end_m, truth[i].end_m) - std::max(room.start_m, truth[i].start_m);
      if (shared <= 0) continue;
      const double iou = shared / (room.width_m() + truth[i].width_m() - shared);
      if (iou <= best) continue;
      best = iou;
      width = room.width_m();
    }
    sums.rooms += 1;
    sums.present += best >= 0.5;  // two rooms of a row cannot both be the best half of a third: order is kept
    if (scanned[i]) continue;
    const double error = std::abs(width - truth[i].width_m());
    sums.unscanned += 1;
    sums.error += error;
    sums.within += error <= 0.1;
  }
  return sums;
}

LearnData without(const LearnData& data, const std::string& floor) {
  LearnData rest = data;
  std::erase_if(rest.rows, [&](const KnownRow& row) { return row.floor == floor; });
  std::erase(rest.sources, floor);
  return rest;
}

std::vector<std::string> floors_of(const LearnData& data) {
  std::vector<std::string> floors;
  for (const KnownRow& row : data.rows)
    if (std::find(floors.begin(), floors.end(), row.floor) == floors.end()) floors.push_back(row.floor);
  if (floors.size() < 2)
    throw InputError({data.sources.empty() ? "" : data.sources[0]}, "leave-one-out needs two floors or more",
                     "give a folder with several floors");
  return floors;
}

struct Job {
  const KnownRow* row = nullptr;
  SpaceProblem problem;
  std::vector<Interval> truth;
  std::vector<bool> scanned;
  std::vector<RoomEvidence> unscanned;  ///< as a scan would see them
  Sums sums[3];
};

/// All draws of one floor at one of the shares, made one after the other so that they do not depend on the
/// threads.
std::vector<Job> draw_jobs(const std::vector<const KnownRow*>& rows, double wall_m,
                           const CrossOptions& options, std::size_t s, std::uint64_t seed) {
  std::vector<Job> jobs;
  std::size_t total = 0;
  for (const KnownRow* row : rows) total += row->rooms.size();
  for (int draw = 0; draw < options.draws; ++draw) {
    std::mt19937_64 generator(seed + 1000003 * (s + 1) + static_cast<std::uint64_t>(draw));
    const std::size_t count =
        static_cast<std::size_t>(std::lround(options.shares[s] * static_cast<double>(total)));
    const std::vector<bool> chosen = choose(total, count, generator);
    std::size_t next = 0;
    for (const KnownRow* row : rows) {
      Job job{row, bare_problem(*row), true_rooms(*row, wall_m), {}, {}, {}};
      const std::vector<RoomEvidence> rooms = row_evidence(*row, wall_m, kTold_m, kTold_m);
      for (std::size_t i = 0; i < row->rooms.size(); ++i) {
        job.scanned.push_back(chosen[next++]);
        if (!job.scanned.back()) {
          job.unscanned.push_back(rooms[i]);
          continue;
        }
        const double sigma = options.width_error * job.truth[i].width_m();
        RoomEvidence evidence;
        evidence.id = row->rooms[i].id;
        evidence.width_m = std::max(0.3, job.truth[i].width_m() + sigma * normal(generator));
        evidence.width_sigma_m = sigma;
        evidence.centre_m =
            (job.truth[i].start_m + job.truth[i].end_m) / 2 + options.place_sigma_m * normal(generator);
        evidence.centre_sigma_m = options.place_sigma_m;
        job.problem.rooms.push_back(evidence);
      }
      if (options.doors) add_doors(*row, job.truth, generator, job.problem);
      jobs.push_back(std::move(job));
    }
  }
  return jobs;
}

/// How each draw of a floor is fitted: its scans say whether its rooms are alike.
std::vector<FitOptions> fit_options(const RuleSet& rules, const std::vector<Job>& jobs, std::size_t spaces,
                                    const CrossOptions& crossing) {
  std::vector<FitOptions> options;
  for (std::size_t begin = 0; begin < jobs.size(); begin += spaces) {
    std::vector<SpaceProblem> problems;
    for (std::size_t i = begin; i < begin + spaces; ++i) problems.push_back(jobs[i].problem);
    options.emplace_back();
    options.back().grid_m = crossing.grid_m;
    options.back().least_error = crossing.least_error;
    options.back().likeness = likeness_of(rules, problems, crossing.likeness);
  }
  return options;
}

/// Of the rooms that were not scanned.
double foretold(const RuleSet& rules, const SpaceProblem& problem, const std::vector<RoomEvidence>& rooms,
                const FitOptions& options) {
  try {
    return rooms.empty() ? 0 : log_predictive(rules, problem, rooms, options);
  } catch (const InputError&) {
    return -std::numeric_limits<double>::infinity();
  }
}

/// Rules that cannot be laid into a space at all, say because a unit is too deep for it, make it impossible.
double likelihood_or_none(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  try {
    return log_likelihood(rules, problem, options);
  } catch (const InputError&) {
    return -std::numeric_limits<double>::infinity();
  }
}

/// One floor, and what the others teach.
struct LeftOut {
  std::string name;
  std::vector<const KnownRow*> rows;
  RuleSet learned, uniform;
  double usual_width_m = 0;
};

std::vector<LeftOut> leave_out_each(const LearnData& data, const LearnOptions& learning,
                                    const RuleMaker& make) {
  LearnOptions uniform = learning;
  uniform.uniform = true;
  std::vector<LeftOut> floors;
  for (const std::string& name : floors_of(data)) {
    const LearnData rest = without(data, name);
    LeftOut floor{name, {}, make(learn_rules(rest, learning)), make(learn_rules(rest, uniform)), 0};
    double sum = 0, count = 0;
    for (const KnownRow& row : rest.rows)
      for (const KnownRoom& room : row.rooms) sum += room.width_m, count += 1;
    floor.usual_width_m = sum / count;
    for (const KnownRow& row : data.rows)
      if (row.floor == name && row.whole) floor.rows.push_back(&row);
    floors.push_back(std::move(floor));
  }
  return floors;
}

/// From the sums of each draw.
CrossScore score_of(const std::vector<Sums>& draws, CrossMethod method, double share) {
  Sums sum;
  for (const Sums& draw : draws) sum += draw;
  CrossScore score;
  score.method = method;
  score.share = share;
  score.present = sum.present / std::max(1.0, sum.rooms);
  score.spaces_right = sum.spaces_right / std::max(1.0, sum.spaces);
  score.unscanned_error_m = sum.error / std::max(1.0, sum.unscanned);
  score.unscanned_within_10cm = sum.within / std::max(1.0, sum.unscanned);
  score.unscanned_nats = sum.nats / std::max(1.0, sum.unscanned);
  double squares = 0;  // of what a draw adds to the ratio's numerator: the deviation of a ratio of sums
  for (const Sums& draw : draws) {
    const double residual = draw.error - score.unscanned_error_m * draw.unscanned;
    squares += residual * residual;
  }
  const auto count = static_cast<double>(draws.size());
  score.unscanned_error_deviation_m =
      count > 1 ? std::sqrt(squares * count / (count - 1)) / std::max(1.0, sum.unscanned) : 0;
  score.unscanned = static_cast<int>(sum.unscanned);
  score.failed = static_cast<int>(sum.failed);
  return score;
}

}  // namespace

const char* to_string(CrossMethod method) {
  switch (method) {
    case CrossMethod::learned:
      return "learned rules";
    case CrossMethod::uniform:
      return "made uniform";
    case CrossMethod::equal_division:
      return "equal division";
  }
  return "";
}

std::vector<CrossScore> cross_validate(const LearnData& data, const LearnOptions& learning,
                                       const RuleMaker& make, const CrossOptions& options,
                                       const CrossListener& listener) {
  const std::vector<LeftOut> floors = leave_out_each(data, learning, make);
  std::mutex reporting;
  std::vector<CrossScore> scores;
  for (std::size_t s = 0; s < options.shares.size(); ++s) {
    std::vector<Sums> sums[3];
    for (auto& of_method : sums) of_method.resize(static_cast<std::size_t>(options.draws));
    for (std::size_t f = 0; f < floors.size(); ++f) {
      const LeftOut& floor = floors[f];
      std::vector<Job> jobs = draw_jobs(floor.rows, data.inner_wall_m, options, s, options.seed + 7919 * f);
      const std::vector<FitOptions> by_learned = fit_options(floor.learned, jobs, floor.rows.size(), options),
                                    by_uniform = fit_options(floor.uniform, jobs, floor.rows.size(), options);
      tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
        Job& job = jobs[i];
        const std::size_t draw = i / floor.rows.size();
        job.sums[0] =
            compare(job.truth, fit_rooms(floor.learned, job.problem, by_learned[draw]), job.scanned);
        job.sums[1] =
            compare(job.truth, fit_rooms(floor.uniform, job.problem, by_uniform[draw]), job.scanned);
        job.sums[2] = compare(job.truth, divide_equally(job.problem, data.inner_wall_m, floor.usual_width_m),
                              job.scanned);
        job.sums[0].nats = foretold(floor.learned, job.problem, job.unscanned, by_learned[draw]);
        job.sums[1].nats = foretold(floor.uniform, job.problem, job.unscanned, by_uniform[draw]);
        if (!listener.step) return;
        const std::lock_guard<std::mutex> lock(reporting);
        listener.step(floor.name + ", " + std::to_string(std::lround(100 * options.shares[s])) +
                          " % scanned: " + job.row->space,
                      floors.size() * options.shares.size() * jobs.size());
      });
      for (std::size_t i = 0; i < jobs.size(); ++i)
        for (std::size_t m = 0; m < 3; ++m) sums[m][i / floor.rows.size()] += jobs[i].sums[m];
    }
    for (std::size_t m = 0; m < 3; ++m) {
      scores.push_back(score_of(sums[m], static_cast<CrossMethod>(m), options.shares[s]));
      if (listener.score) listener.score(scores.back());
    }
  }
  return scores;
}

std::vector<HeldOutLikelihood> held_out_likelihoods(
    const LearnData& data, const LearnOptions& learning, const RuleMaker& make,
    const std::vector<std::pair<std::string, RuleSet>>& others, double grid_m) {
  FitOptions options;
  options.grid_m = grid_m;
  std::vector<HeldOutLikelihood> result;
  for (const std::string& floor : floors_of(data)) {
    const LearnData rest = without(data, floor);
    LearnOptions uniform = learning;
    uniform.uniform = true;
    std::vector<std::pair<std::string, RuleSet>> candidates = {
        {"learned on the others", make(learn_rules(rest, learning))},
        {"made uniform", make(learn_rules(rest, uniform))}};
    candidates.insert(candidates.end(), others.begin(), others.end());
    std::vector<SpaceProblem> problems;
    double rooms = 0;
    for (const KnownRow& row : data.rows) {
      if (row.floor != floor || !row.whole) continue;
      SpaceProblem problem = bare_problem(row);
      problem.rooms = row_evidence(row, data.inner_wall_m, kTold_m, kTold_m);
      rooms += static_cast<double>(problem.rooms.size());
      problems.push_back(std::move(problem));
    }
    for (const auto& [name, rules] : candidates) {
      std::vector<double> logs(problems.size());
      tbb::parallel_for(std::size_t{0}, problems.size(), [&, &rules = rules](std::size_t i) {
        logs[i] = likelihood_or_none(rules, problems[i], options);
      });
      double sum = 0;
      for (const double value : logs) sum += value;
      result.push_back({floor, name, sum / std::max(1.0, rooms)});
    }
  }
  return result;
}

}  // namespace gramap
