#include "floor/rls_floor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "floor/place.h"
#include "floor/rls_csv.h"

namespace gramap {
namespace {

/// The narrowest width that some room type has with any likelihood (4 standard deviations below its mean).
double narrowest_room_m(const RuleSet& rules) {
  double least = std::numeric_limits<double>::infinity();
  for (const RoomType& room : rules.rooms)
    for (const Mixture::Component& component : room.width.components)
      least = std::min(least, component.normal.mean_m - 4 * component.normal.sd_m);
  return std::isfinite(least) ? std::max(0.0, least) : rules.background.least_m;
}

double usual_depth_m(const RuleSet& rules, double otherwise) {
  double sum = 0;
  int count = 0;
  for (const RoomType& room : rules.rooms)
    if (room.depth) sum += room.depth->mean_m, ++count;
  return count ? sum / count : otherwise;
}

/// Distance from a segment to the nearest end of a segment across it, on its left; `otherwise` when there is
/// none.
double depth_m(const std::vector<RlsSegment>& segments, const RlsSegment& segment, double otherwise) {
  const Vec2 along = (segment.end - segment.start).normalized(), left(-along.y(), along.x());
  double nearest = std::numeric_limits<double>::infinity();
  for (const RlsSegment& other : segments) {
    if (std::abs((other.end - other.start).normalized().dot(along)) > 0.9) continue;
    for (const Vec2& end : {other.start, other.end}) {
      const double distance = (end - segment.start).dot(left);
      if (distance > 1) nearest = std::min(nearest, distance);
    }
  }
  return std::isfinite(nearest) ? nearest : otherwise;
}

std::string gap_name(const RlsSegment& segment, std::size_t gap) {
  return "rls_" + std::to_string(segment.index) + "_gap_" + std::to_string(gap + 1);
}

}  // namespace

RlsFloor rls_floor(const std::filesystem::path& rls, const std::filesystem::path& rules_csv,
                   const RuleSet& rules, const RlsOptions& options) {
  const std::vector<RlsSegment> segments = read_rls(rls, rules_csv);
  const double wall = rules.inner_wall_m, least = narrowest_room_m(rules);
  RlsFloor result;
  result.floor.name = rls.stem().string();
  for (const RlsSegment& segment : segments) {
    const Vec2 along = (segment.end - segment.start).normalized(), left(-along.y(), along.x());
    // The wall lines that bound the space: shared ones replace the segment's own ends.
    double first = segment.shares_first_wall ? segment.walls_m.front() : 0;
    const double last = segment.shares_last_wall ? segment.walls_m.back() : segment.length_m();
    if (!segment.shares_first_wall && !segment.walls_m.empty() && segment.walls_m.front() > 0 &&
        segment.walls_m.front() - wall < least) {
      first = segment.walls_m.front();
      char text[160];
      std::snprintf(
          text, sizeof text,
          "rls_%d: the %.3f m before its first wall are too narrow for any room of the rules; the space "
          "begins at that wall",
          segment.index, first);
      result.floor.remarks.emplace_back(text);
    }

    Space space;
    space.id = "rls_" + std::to_string(segment.index);
    const double depth = depth_m(segments, segment, usual_depth_m(rules, options.default_depth_m)) - wall;
    space.start = segment.start + along * (first + wall / 2) + left * (wall / 2);
    space.end = segment.start + along * (last - wall / 2) + left * (wall / 2);
    space.outline = {space.start, space.end, space.end + left * depth, space.start + left * depth};
    result.floor.spaces.push_back(space);

    SpaceProblem problem;
    problem.id = space.id;
    problem.length_m = clear_length_m(space);
    problem.depth_m = depth;
    // Wall lines from the bounding first one on; what lies before it belongs to the neighbour.
    std::vector<double> lines{first};
    for (const double line : segment.walls_m)
      if (line > first + 1e-6) lines.push_back(line);
    for (std::size_t gap = 0; gap + 1 < lines.size(); ++gap) {
      // Without a shared or first wall, the space's own start is no wall that anyone has measured.
      if (gap == 0 && segment.walls_m.front() > first + 1e-6 && segment.walls_m.front() - wall < least)
        continue;
      const double width = lines[gap + 1] - lines[gap];
      RoomEvidence evidence;
      evidence.id = gap_name(segment, gap);
      evidence.width_m = width - wall;
      evidence.width_sigma_m = std::hypot(options.width_sigma_m, options.relative_sigma * width);
      evidence.centre_m = (lines[gap] + lines[gap + 1]) / 2 - first - wall / 2;
      // Errors of the gaps before it add up.
      evidence.centre_sigma_m =
          std::hypot(2 * options.width_sigma_m, options.relative_sigma * (lines[gap + 1] - first));
      problem.rooms.push_back(evidence);
    }
    result.problems.push_back(problem);
  }
  return result;
}

}  // namespace gramap
