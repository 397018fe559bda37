// A small floor, a model of it with a fault of every kind, and what `evaluate` has to say of them, computed
// on paper. Metres; the reference line is y = 0 from x = 0 to 9.4.
//
//   true rooms, y 0..5:       A 0..3        B 3.2..6.2     C 6.4..9.4     E 30..32 (the model lacks it)
//   the model's, y 0.01..5.01: A 0..3.04    B 3.24..6.28   C 6.48..9.4    D 20..23 (does not exist)
//
// WALLS are sampled in the middle of every 2 cm.
// True walls to the model's, samples by distance:
//   upright, 250 each:  A 0 and 0.04;  B 0.04 and 0.08;  C 0.08 and 0
//   level, 2 x 150 each: 0.01, but for those before the model's wall begins:
//     B: 3.21, 3.23 are 0.03, 0.01 before it: with the 0.01 across 0.0316, 0.0141
//     C: 6.41, 6.43, 6.45, 6.47 are 0.07, 0.05, 0.03, 0.01 before it: 0.0707, 0.0510, 0.0316, 0.0141
//   E: 2 (100 + 250) = 700, none near.
//   All: 3 · 800 + 700 = 3100. Farther than 5 cm: 250 + 250 + 2 · 2 + 700; than 10 cm: 700.
//   completeness 1896/3100 and 2400/3100. Of the 2400 within 10 cm 500 are at 0, the next 888 at 0.01:
//   the median (1200th) is 0.01.
// The model's to the true walls:
//   A 2 (152 + 250) = 804, B 804, C 2 (146 + 250) = 792, D 800 of which none is near: 3200.
//   Farther than 5 cm: B's right and C's left 250 each; of B's level walls beyond 6.2 those at 0.05 and 0.07,
//   twice; D. correctness 1896/3200 and 2400/3200.
// Observed is A alone: all within 5 cm, both ways.
//
// IoU, heights 4.99 in common: A 3 · 4.99 / (15 + 15.2 - 14.97), B 2.96 · 4.99 / (15 + 15.2 - 14.7704),
//   C 2.92 · 4.99 / (15 + 14.6 - 14.5708).
//
// WIDTHS: A scanned 3.05: +0.05; fitted +0.04. Derived: B +0.04, C -0.08: mean 0.06, median 0.06,
//   root of mean square sqrt((0.0016 + 0.0064) / 2).
// CALIBRATION: A 0.04/0.03 = 1.33, B 0.04/0.05 = 0.8, C 0.08/0.03 = 2.67 sigma: 1/3, 2/3, 1. D is no room.
// TYPES: A 0.97 right; B 0.85 wrong (Lab for Office), D 0.9 wrong (no such room); C 0.6 right.
//
// OPENINGS, intersection over union: door A 0.8/1.2 (found), door B 0.6/1.4 (not), door C 2.0/2.1 by its
//   height (found), door E missing: 2 of 4 true, 2 of the model's 3. Window A 1, another of the model's
//   besides: 1 of 1, 1 of 2. Observed, against A's: door 1 of 1 and 1; window 1 of 1, 1 of 2.
// FURNITURE: A's table 0.8/1.2, A's chair 0.2/0.25 but called a cupboard.
#pragma once

#include "floor/fitted_floor.h"

namespace gramap::test {

inline Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

struct JudgedByHand {
  FloorGroundTruth floor;
  FloorTruth truth;
  FittedFloor fitted;
};

inline JudgedByHand judged_by_hand() {
  JudgedByHand all;
  FloorGroundTruth& floor = all.floor;
  floor.name = "by hand";
  floor.inner_wall_m = 0.2;
  floor.hallways = {{"H", "", rectangle(0, -2, 9.4, -0.2)}};
  floor.spaces = {{"S", "H", rectangle(0, 0, 9.4, 5.02), {0, 0}, {9.4, 0}}};

  FloorTruth& truth = all.truth;
  truth.rooms = {{"A", "Office", "", rectangle(0, 0, 3, 5), 0, 2.7},
                 {"B", "Office", "", rectangle(3.2, 0, 6.2, 5), 0, 2.7},
                 {"C", "Office", "", rectangle(6.4, 0, 9.4, 5), 0, 2.7},
                 {"E", "Office", "", rectangle(30, 0, 32, 5), 0, 2.7}};
  truth.openings = {{"door", "A", {1, 0}, {2, 0}, 1, 0, 2.1},
                    {"door", "B", {4, 0}, {5, 0}, 1, 0, 2.1},
                    {"door", "C", {7, 0}, {8, 0}, 1, 0, 2.1},
                    {"door", "E", {30.5, 0}, {31.5, 0}, 1, 0, 2.1},
                    {"window", "A", {2, 5}, {1, 5}, 1, 0.9, 2.1}};
  truth.furniture = {{"A", "table", rectangle(1, 3, 2, 4), 0, 0.7},
                     {"A", "chair", rectangle(0.1, 0.2, 0.6, 0.7), 0, 0.4}};

  FittedFloor& fitted = all.fitted;
  fitted.floor = floor;
  fitted.inner_wall_m = 0.2;
  fitted.outer_wall_m = 0.3;
  fitted.height_m = 2.7;
  const auto add = [&](const std::string& id, const std::string& type, Origin origin, double from, double to,
                       double sigma_m, double type_probability) -> FittedRoom& {
    FittedRoom& room = fitted.rooms.emplace_back();
    room.id = id;
    room.type = type;
    room.origin = origin;
    room.outline = rectangle(from, 0.01, to, 5.01);
    room.space = "S";
    room.start_m = from;
    room.width_m = to - from;
    room.width_sigma_m = sigma_m;
    room.depth_m = 5;
    room.height_m = 2.7;
    room.type_probability = type_probability;
    return room;
  };
  fitted.rooms.reserve(4);
  FittedRoom& a = add("a", "Office", Origin::observed, 0, 3.04, 0.03, 0.97);
  a.extracted_width_m = 3.05;
  a.openings = {{"door", Origin::observed, {1.2, 0.01}, {2.2, 0.01}, 0, 2.1, 1},
                {"window", Origin::observed, {2, 5.01}, {1, 5.01}, 0.9, 2.1, 1},
                {"window", Origin::observed, {2.8, 5.01}, {2.2, 5.01}, 0.9, 2.1, 1}};
  a.furniture = {{"table", Origin::observed, rectangle(1.2, 3, 2.2, 4), 0, 0.7, 1},
                 {"cupboard", Origin::observed, rectangle(0.1, 0.3, 0.6, 0.7), 0, 0.4, 1}};
  FittedRoom& b = add("b", "Lab", Origin::derived, 3.24, 6.28, 0.05, 0.85);
  b.openings = {{"door", Origin::derived, {4.4, 0.01}, {5.4, 0.01}, 0, 2.1, 1}};
  FittedRoom& c = add("c", "Office", Origin::derived, 6.48, 9.4, 0.03, 0.6);
  c.openings = {{"door", Origin::derived, {7, 0.01}, {8, 0.01}, 0, 2.0, 1}};
  add("d", "Office", Origin::derived, 20, 23, 0.03, 0.9);
  return all;
}

}  // namespace gramap::test
