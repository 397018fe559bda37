#include "floor/place.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace gramap;

namespace {

/// A hallway between two spaces, 20 m long; the lower space's reference line runs towards -x.
FloorGroundTruth two_spaces() {
  FloorGroundTruth floor;
  floor.hallways.push_back({"H", "Hall", {{0, 5}, {20, 5}, {20, 7}, {0, 7}}});
  floor.spaces.push_back({"north", "H", {{0, 7.2}, {20, 7.2}, {20, 12}, {0, 12}}, {0, 7.2}, {20, 7.2}});
  floor.spaces.push_back({"south", "H", {{0, 0}, {20, 0}, {20, 4.8}, {0, 4.8}}, {20, 4.8}, {0, 4.8}});
  return floor;
}

/// A room seen with its whole frame turned by `angle` and shifted by `shift` (drift).
RoomObservation seen_room(const std::string& name, const Vec2& low, const Vec2& high, double angle,
                          const Vec2& shift) {
  const auto moved = [&](double x, double y) {
    const Vec2 middle = (low + high) / 2, p = Vec2(x, y) - middle;
    return Vec2(middle + shift +
                Vec2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                     std::sin(angle) * p.x() + std::cos(angle) * p.y()));
  };
  RoomObservation room;
  room.room = name;
  room.outline = {moved(low.x(), low.y()), moved(high.x(), low.y()), moved(high.x(), high.y()),
                  moved(low.x(), high.y())};
  room.axis = Vec2(std::cos(angle), std::sin(angle));
  room.width = {high.x() - low.x(), 0.01};
  room.depth = {high.y() - low.y(), 0.02};
  return room;
}

}  // namespace

TEST_CASE("a drifted room goes to the space it overlaps, with the width along that space's line") {
  const FloorGroundTruth floor = two_spaces();
  const auto north = seen_room("a", {3, 7.2}, {6, 12}, 0.02, {0.15, -0.1});
  const auto south = seen_room("b", {3, 0}, {6, 4.8}, -0.02, {0.1, 0.1});
  const auto hall = seen_room("H", {0, 5}, {20, 7}, 0.01, {0, 0});
  const Placement placement = place_observations(floor, {north, south, hall});
  REQUIRE(placement.placed.size() == 3);
  CHECK(placement.set_aside.empty());
  CHECK(placement.placed[0].index == 0);
  CHECK(placement.placed[0].evidence.width_m == doctest::Approx(3));
  CHECK(placement.placed[0].evidence.width_sigma_m == doctest::Approx(0.01));
  CHECK(*placement.placed[0].evidence.centre_m == doctest::Approx(4.65));
  CHECK(placement.placed[1].index == 1);
  CHECK(*placement.placed[1].evidence.centre_m == doctest::Approx(20 - 4.6));
  CHECK(placement.placed[2].on == PlacedObservation::On::hallway);
}

TEST_CASE("an observation whose own axis runs across the line gives its depth as the width along it") {
  RoomObservation room = seen_room("a", {3, 7.2}, {6, 12}, 0, {0, 0});
  room.axis = Vec2::UnitY();
  room.width = {4.8, 0.01}, room.depth = {3, 0.02};
  const Placement placement = place_observations(two_spaces(), {room});
  REQUIRE(placement.placed.size() == 1);
  CHECK(placement.placed[0].evidence.width_m == doctest::Approx(3));
  CHECK(placement.placed[0].evidence.width_sigma_m == doctest::Approx(0.02));
}

TEST_CASE("a pin places a room of unknown heading, the dimension like the space's depth taken across") {
  FloorGroundTruth floor = two_spaces();
  floor.pins.push_back({"a", {15, 3}, 0.6});
  const Placement placement = place_observations(floor, {seen_room("a", {0, 0}, {4.8, 3}, 1.2, {100, 100})});
  REQUIRE(placement.placed.size() == 1);
  const RoomEvidence& evidence = placement.placed[0].evidence;
  CHECK(placement.placed[0].index == 1);
  CHECK(evidence.width_m == doctest::Approx(3));
  CHECK(*evidence.other_width_m == doctest::Approx(4.8));
  CHECK(*evidence.centre_m == doctest::Approx(5));
  CHECK(evidence.centre_sigma_m == doctest::Approx(0.6));
}

TEST_CASE("rooms that lie nowhere are set aside with their reason, and cost nothing else") {
  FloorGroundTruth floor = two_spaces();
  floor.pins.push_back({"c", {15, 30}, 0.6});
  const auto far = seen_room("a", {50, 50}, {53, 54}, 0, {0, 0});
  const auto good = seen_room("b", {3, 7.2}, {6, 12}, 0, {0, 0});
  const auto lost = seen_room("c", {3, 7.2}, {6, 12}, 0, {0, 0});
  const Placement placement = place_observations(floor, {far, good, lost});
  CHECK(placement.placed.size() == 1);
  REQUIRE(placement.set_aside.size() == 2);
  CHECK(placement.set_aside[0].what == "a");
  CHECK(placement.set_aside[0].reason.find("no space") != std::string::npos);
  CHECK(placement.set_aside[1].what == "c");
}
