#include "floor/place.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floor/facade.h"
#include "geometry/polygon.h"
#include "geometry/say.h"

namespace gramap {
namespace {

/// Points spread evenly over the polygon's inside.
std::vector<Vec2> samples(const Polygon& polygon) {
  constexpr int kSteps = 24;
  Vec2 low = polygon.front(), high = polygon.front();
  for (const Vec2& point : polygon) low = low.cwiseMin(point), high = high.cwiseMax(point);
  std::vector<Vec2> inside;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Vec2 share((i + 0.5) / kSteps, (j + 0.5) / kSteps);
      const Vec2 point = low + share.cwiseProduct(high - low);
      if (contains(polygon, point)) inside.push_back(point);
    }
  return inside;
}

struct Target {
  PlacedObservation::On on;
  int index;
  const Polygon* outline;
};

std::vector<Target> targets(const FloorGroundTruth& floor) {
  std::vector<Target> all;
  for (std::size_t i = 0; i < floor.spaces.size(); ++i)
    all.push_back({PlacedObservation::On::space, static_cast<int>(i), &floor.spaces[i].outline});
  for (std::size_t i = 0; i < floor.hallways.size(); ++i)
    all.push_back({PlacedObservation::On::hallway, static_cast<int>(i), &floor.hallways[i].outline});
  for (std::size_t i = 0; i < floor.fixed.size(); ++i)
    all.push_back({PlacedObservation::On::fixed, static_cast<int>(i), &floor.fixed[i].outline});
  return all;
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double size() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

Extent extent(const Polygon& polygon, const Vec2& direction) {
  Extent result;
  for (const Vec2& point : polygon) {
    const double value = point.dot(direction);
    result.low = std::min(result.low, value), result.high = std::max(result.high, value);
  }
  return result;
}

struct Box {
  Extent x, y;
  explicit Box(const Polygon& polygon) : x(extent(polygon, {1, 0})), y(extent(polygon, {0, 1})) {}
  bool meets(const Box& other) const {
    return x.low <= other.x.high && other.x.low <= x.high && y.low <= other.y.high && other.y.low <= y.high;
  }
};

/// What an observation in the building's frame says of the space it lies in. A whole room is turned by up to
/// a few degrees (drift), so its width is taken along its own axis that runs nearest to the reference line.
RoomEvidence evidence_in_building(const RoomObservation& room, const Space& space,
                                  const PlacementOptions& options) {
  const Vec2 along = (space.end - space.start).normalized();
  const Vec2 across(-room.axis.y(), room.axis.x());
  const bool on_axis = std::abs(room.axis.dot(along)) >= std::abs(across.dot(along));
  Vec2 u = on_axis ? room.axis : across;
  // Beyond 20 degrees it is an oblique room and not drift: what counts is its extent along the line.
  if (std::abs(u.dot(along)) < std::cos(20 * M_PI / 180)) u = along;
  const Vec2 v(-u.y(), u.x());
  const Extent length = extent(room.outline, u), breadth = extent(room.outline, v);
  RoomEvidence evidence;
  evidence.id = room.room;
  evidence.width_m = length.size();
  evidence.width_sigma_m = std::max(options.least_sigma_m, on_axis ? room.width.sigma_m : room.depth.sigma_m);
  evidence.centre_m = (u * length.middle() + v * breadth.middle() - space.start).dot(along);
  evidence.centre_sigma_m = options.pose_sigma_m;
  return evidence;
}

/// What an observation in a frame of its own says: its two dimensions, either of which may lie along the
/// line.
RoomEvidence evidence_at_pin(const RoomObservation& room, const Space& space, const Pin& pin,
                             const PlacementOptions& options) {
  const double depth = clear_depth_m(space);
  Measured along = room.width, other = room.depth;
  if (std::abs(along.value_m - depth) < std::abs(other.value_m - depth)) std::swap(along, other);
  RoomEvidence evidence;
  evidence.id = room.room;
  evidence.width_m = along.value_m;
  evidence.width_sigma_m = std::max(options.least_sigma_m, along.sigma_m);
  evidence.other_width_m = other.value_m;
  evidence.other_sigma_m = std::max(options.least_sigma_m, other.sigma_m);
  evidence.centre_m = (pin.at - space.start).dot((space.end - space.start).normalized());
  evidence.centre_sigma_m = pin.sigma_m;
  return evidence;
}

}  // namespace

bool lies_on(const Polygon& outline, const Polygon& target, const PlacementOptions& options) {
  const std::vector<Vec2> inside = samples(outline);
  const auto hits =
      std::count_if(inside.begin(), inside.end(), [&](const Vec2& point) { return contains(target, point); });
  return static_cast<double>(hits) >=
         options.least_overlap * static_cast<double>(std::max<std::size_t>(1, inside.size()));
}

double clear_length_m(const Space& space) {
  return (space.end - space.start).norm();
}

double clear_depth_m(const Space& space) {
  const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
  double depth = 0;
  for (const Vec2& point : space.outline) depth = std::max(depth, (point - space.start).dot(left));
  return depth;
}

SpaceProblem bare_problem(const FloorGroundTruth& floor, double outer_wall_m, const Space& space) {
  SpaceProblem problem;
  problem.id = space.id;
  problem.length_m = clear_length_m(space);
  problem.depth_m = clear_depth_m(space);
  problem.hallway = space.hallway;
  problem.facade = has_facade(floor, outer_wall_m, space);
  return problem;
}

Placement place_observations(const FloorGroundTruth& floor, const std::vector<RoomObservation>& observations,
                             const PlacementOptions& options) {
  Placement placement;
  const std::vector<Target> all = targets(floor);
  std::vector<Box> boxes;
  for (const Target& target : all) boxes.emplace_back(*target.outline);
  for (std::size_t number = 0; number < observations.size(); ++number) {
    const RoomObservation& room = observations[number];
    PlacedObservation placed;
    placed.observation = static_cast<int>(number);

    const auto pin =
        std::find_if(floor.pins.begin(), floor.pins.end(), [&](const Pin& p) { return p.room == room.room; });
    const bool own_frame = options.frame == ScanFrame::room ||
                           (options.frame == ScanFrame::automatic && pin != floor.pins.end());

    // A scan folder named like a hallway or a fixed room is that one, whatever frame it is in.
    const Target* named = nullptr;
    for (const Target& target : all) {
      if (target.on == PlacedObservation::On::space) continue;
      const auto index = static_cast<std::size_t>(target.index);
      const std::string& id =
          target.on == PlacedObservation::On::hallway ? floor.hallways[index].id : floor.fixed[index].id;
      if (id == room.room) named = &target;
    }
    if (named) {
      placed.on = named->on, placed.index = named->index;
      placement.placed.push_back(placed);
      continue;
    }

    if (own_frame) {
      if (pin == floor.pins.end()) {
        placement.set_aside.push_back(
            {room.room,
             "its scans are in a frame of their own and the floor file has no pin for it; add a "
             "Point of kind \"scan\" with this room's name"});
        continue;
      }
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < floor.spaces.size(); ++i) {
        const Polygon& outline = floor.spaces[i].outline;
        const double distance = contains(outline, pin->at) ? 0 : distance_to_border(outline, pin->at);
        if (distance < nearest) nearest = distance, placed.index = static_cast<int>(i);
      }
      if (nearest > std::max(options.pin_reach_m, 3 * pin->sigma_m)) {
        placement.set_aside.push_back({room.room, "its pin at " + said_point(pin->at) +
                                                      " lies in no space of the floor; move the pin"});
        continue;
      }
      placed.evidence =
          evidence_at_pin(room, floor.spaces[static_cast<std::size_t>(placed.index)], *pin, options);
      placement.placed.push_back(placed);
      continue;
    }

    const std::vector<Vec2> inside = samples(room.outline);
    const Box box(room.outline);
    std::size_t most = 0;
    for (std::size_t t = 0; t < all.size(); ++t) {
      const Target& target = all[t];
      if (!box.meets(boxes[t])) continue;
      const auto hits = static_cast<std::size_t>(std::count_if(
          inside.begin(), inside.end(), [&](const Vec2& point) { return contains(*target.outline, point); }));
      if (hits > most) most = hits, placed.on = target.on, placed.index = target.index;
    }
    if (static_cast<double>(most) <
        options.least_overlap * static_cast<double>(std::max<std::size_t>(1, inside.size()))) {
      placement.set_aside.push_back(
          {room.room, "it lies in no space of the floor: its middle is at " +
                          said_point(centroid(room.outline)) +
                          "; check the poses, or say --frame room and give it a pin"});
      continue;
    }
    if (placed.on == PlacedObservation::On::space)
      placed.evidence =
          evidence_in_building(room, floor.spaces[static_cast<std::size_t>(placed.index)], options);
    placement.placed.push_back(placed);
  }
  return placement;
}

}  // namespace gramap
