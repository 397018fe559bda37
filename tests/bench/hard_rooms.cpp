// Rooms that are hard to perceive, simulated as a hand-held depth sensor takes them: how many come out right,
// and how far off their widths are, by kind and noise.
//
// usage: hard_rooms [ROOMS_PER_KIND] [KIND] [DEBUG_FOLDER]
// Right: every point of the true outline lies within 5 cm of the outline found and the other way round (no
// wall missing, none too many, nothing of another room), and the height is right within 3 cm. With a folder,
// the rooms that are not right are written there for looking at.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "geometry/error.h"
#include "geometry/polygon.h"
#include "perception/debug.h"
#include "perception/perceive.h"
#include "perception/random.h"
#include "perception/simulate.h"

using namespace gramap;

namespace {

struct Trial {
  BuildingRoom room;
  std::vector<BuildingRoom> others;
  SimulateOptions sensor;
  std::function<void(RoomScans&, Random&)> spoil;  // what the simulator does not do
};

BuildingRoom room_of(Polygon ring, Random& random) {
  BuildingRoom room;
  room.id = "room";
  room.outline = std::move(ring);
  room.ceiling_m = random.uniform(2.4, 3.2);
  return room;
}

Polygon box(double w, double d) {
  return {{0, 0}, {w, 0}, {w, d}, {0, d}};
}

/// A cupboard against a wall of the room, from `from` to `to` metres along it.
void add_cupboard(BuildingRoom& room, std::size_t wall, double from, double to, double depth, double top) {
  const Vec2 a = room.outline[wall], b = room.outline[(wall + 1) % room.outline.size()];
  const Vec2 along = (b - a).normalized(), in(-along.y(), along.x());
  const Vec2 p = a + along * from + in * 0.01, q = a + along * to + in * 0.01;
  room.furniture.push_back({"cupboard", {p, q, q + depth * in, p + depth * in}, 0, top});
}

void add_door(Trial& trial, std::size_t wall, double start) {
  BuildingRoom& room = trial.room;
  const Vec2 a = room.outline[wall], b = room.outline[(wall + 1) % room.outline.size()];
  const Vec2 along = (b - a).normalized(), out(along.y(), -along.x());
  const Vec2 p = a + along * start, q = p + along * 0.9;
  room.openings.push_back({"door", p, q, 0, 2.05});
  BuildingRoom hallway;
  hallway.id = "hallway";
  const Vec2 from = a - along * 3 + out * 0.15, to = b + along * 3 + out * 0.15;
  hallway.outline = {to, from, from + out * 2, to + out * 2};
  if (signed_area(hallway.outline) < 0) std::reverse(hallway.outline.begin(), hallway.outline.end());
  hallway.ceiling_m = room.ceiling_m;
  hallway.openings.push_back({"door", p + out * 0.15, q + out * 0.15, 0, 2.05});
  trial.others.push_back(hallway);
}

struct Kind {
  const char* name;
  std::function<void(Trial&, Random&)> make;
};

const std::vector<Kind> kKinds = {
    {"box", [](Trial& t, Random& r) { t.room = room_of(box(r.uniform(2.5, 8), r.uniform(2.5, 6)), r); }},
    {"hallway",
     [](Trial& t, Random& r) { t.room = room_of(box(r.uniform(10, 25), r.uniform(1.5, 2.5)), r); }},
    {"L",
     [](Trial& t, Random& r) {
       const double w = r.uniform(4, 8), d = r.uniform(4, 7), u = w * r.uniform(0.4, 0.6),
                    v = d * r.uniform(0.4, 0.6);
       t.room = room_of({{0, 0}, {w, 0}, {w, v}, {u, v}, {u, d}, {0, d}}, r);
     }},
    {"T",
     [](Trial& t, Random& r) {
       const double w = r.uniform(5, 8), d = r.uniform(4, 6), v = d * 0.45, a = w * 0.3, b = w * 0.7;
       t.room = room_of({{0, 0}, {w, 0}, {w, v}, {b, v}, {b, d}, {a, d}, {a, v}, {0, v}}, r);
     }},
    {"U",
     [](Trial& t, Random& r) {
       const double w = r.uniform(6, 9), d = r.uniform(4, 6), v = d * 0.5, a = w * 0.35, b = w * 0.65;
       t.room = room_of({{0, 0}, {w, 0}, {w, d}, {b, d}, {b, v}, {a, v}, {a, d}, {0, d}}, r);
     }},
    {"oblique wall",
     [](Trial& t, Random& r) {
       const double w = r.uniform(4, 8), d = r.uniform(3, 5);
       t.room = room_of({{0, 0}, {w, 0}, {w * r.uniform(0.7, 0.85), d}, {0, d * r.uniform(0.75, 1.0)}}, r);
     }},
    {"column at a wall",
     [](Trial& t, Random& r) {
       const double w = r.uniform(4, 8), d = r.uniform(3, 5), a = w * r.uniform(0.3, 0.6),
                    s = r.uniform(0.3, 0.5);
       t.room = room_of({{0, 0}, {w, 0}, {w, d}, {a + s, d}, {a + s, d - s}, {a, d - s}, {a, d}, {0, d}}, r);
     }},
    {"20-60 % hidden",
     [](Trial& t, Random& r) {
       const double w = r.uniform(4, 7), d = r.uniform(3.5, 5);
       t.room = room_of(box(w, d), r);
       for (std::size_t wall = 0; wall < 4; ++wall) {
         const double length = wall % 2 ? d : w, part = length * r.uniform(0.2, 0.6),
                      free = length - part - 1.4;
         const double from = 0.7 + (free > 0 ? r.uniform(0, free) : 0);
         add_cupboard(t.room, wall, from, std::min(from + part, length - 0.7), r.uniform(0.3, 0.6),
                      r.uniform(1.2, 2.0));
       }
     }},
    {"80 % of a wall hidden",
     [](Trial& t, Random& r) {
       const double w = r.uniform(4, 7), d = r.uniform(3.5, 5);
       t.room = room_of(box(w, d), r);
       add_cupboard(t.room, 0, 0.1 * w, 0.9 * w, r.uniform(0.4, 0.6), 2.0);
     }},
    {"open door",
     [](Trial& t, Random& r) {
       const double w = r.uniform(3, 7), d = r.uniform(3, 5);
       t.room = room_of(box(w, d), r);
       add_door(t, static_cast<std::size_t>(r.below(4)), r.uniform(0.3, 1.8));
     }},
    {"10x uneven",
     [](Trial& t, Random& r) {
       t.room = room_of(box(r.uniform(3, 7), r.uniform(3, 5)), r);
       t.spoil = [](RoomScans& scans, Random& random) {
         for (Scan& scan : scans.scans)
           std::erase_if(scan.points_m, [&](const Point& p) {
             const Vec3 place = scan.room_from_scanner * p.cast<double>();
             return place.x() > 2 && random.chance(0.9);
           });
       };
     }},
    {"leaning by 1 degree",
     [](Trial& t, Random& r) {
       t.room = room_of(box(r.uniform(3, 7), r.uniform(3, 5)), r);
       const double heading = r.uniform(0, 6.28);
       t.spoil = [heading](RoomScans& scans, Random&) {
         const Eigen::AngleAxisd lean(M_PI / 180, Vec3(std::cos(heading), std::sin(heading), 0));
         Vec3 middle = Vec3::Zero();
         for (const Scan& scan : scans.scans)
           middle += scan.room_from_scanner.translation() / static_cast<double>(scans.scans.size());
         for (Scan& scan : scans.scans)
           scan.room_from_scanner =
               Eigen::Translation3d(middle) * lean * Eigen::Translation3d(-middle) * scan.room_from_scanner;
       };
     }},
    {"2 % stray",
     [](Trial& t, Random& r) {
       t.room = room_of(box(r.uniform(3, 7), r.uniform(3, 5)), r);
       t.sensor.stray_share = 0.02;
     }},
};

/// The greatest distance of a point of one ring from the other ring.
double farthest(const Polygon& from, const Polygon& to) {
  double worst = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    for (double t = 0; t < 1; t += 0.02)
      worst = std::max(worst, distance_to_border(to, from[i] + t * (from[(i + 1) % from.size()] - from[i])));
  return worst;
}

struct Score {
  int rooms = 0, right = 0;
  std::vector<double> width_errors;
};

void run(const Kind& kind, int noise, int number, const std::string& debug, Score& score) {
  Random random(seed_for(static_cast<std::uint64_t>(number), kind.name));
  Trial trial;
  kind.make(trial, random);
  trial.sensor.seed = random.next();
  trial.sensor.noise_m *= noise;
  trial.sensor.noise_growth_per_m *= noise;
  trial.sensor.drift_sd_m = trial.sensor.drift_sd_deg = 0;
  Building building;
  building.rooms.push_back(trial.room);
  building.rooms.insert(building.rooms.end(), trial.others.begin(), trial.others.end());
  const SimulatedRoom simulated = simulate_rooms(building, {0}, trial.sensor)[0];
  RoomScans scans;
  scans.room = std::string(kind.name) + " " + std::to_string(number);
  for (const SimulatedScan& from : simulated.scans) {
    Scan scan;
    scan.room_from_scanner = from.frame_from_scanner;
    for (const Vec3& p : from.points) scan.points_m.push_back(p.cast<float>());
    scans.scans.push_back(std::move(scan));
  }
  if (trial.spoil) trial.spoil(scans, random);
  ++score.rooms;
  PerceptionOptions options;
  bool right = false;
  Perception last;
  std::string why;
  options.on_found = [&](const Perception& found) { last = found; };
  try {
    const RoomObservation room = perceive_structure(registered(scans), scans.room, options).observation;
    const double missing = farthest(trial.room.outline, room.outline),
                 wrong = farthest(room.outline, trial.room.outline);
    right = missing < 0.05 && wrong < 0.05 && std::abs(room.height.value_m - trial.room.ceiling_m) < 0.03;
    why = "missing " + std::to_string(missing) + " wrong " + std::to_string(wrong) + " walls " +
          std::to_string(room.walls.size());
    if (right) {
      Vec2 low = trial.room.outline[0], high = low;
      for (const Vec2& corner : trial.room.outline) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
      // Walls that stand across the axes in truth; an oblique room's extent is a corner's place, not a width.
      if (std::string(kind.name) != "oblique wall") {
        score.width_errors.push_back(std::abs(room.width.value_m - (high - low).x()));
        score.width_errors.push_back(std::abs(room.depth.value_m - (high - low).y()));
      }
    }
  } catch (const InputError& error) {
    why = error.what();
  }
  score.right += right;
  if (!right && !debug.empty()) {
    std::printf("    %s, noise x%d: %s\n", scans.room.c_str(), noise, why.c_str());
    write_debug(debug + "/" + scans.room + " x" + std::to_string(noise), last);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 20;
  const std::string only = argc > 2 ? argv[2] : "", debug = argc > 3 ? argv[3] : "";
  std::printf("%-24s", "kind");
  for (const int noise : {1, 2, 3}) std::printf("  noise x%d: right   width error mean / max mm", noise);
  std::printf("\n");
  Score all[4];
  for (const Kind& kind : kKinds) {
    if (!only.empty() && only != kind.name) continue;
    std::string row;
    for (const int noise : {1, 2, 3}) {
      Score score;
      for (int number = 1; number <= count; ++number) run(kind, noise, number, debug, score);
      double sum = 0, worst = 0;
      for (const double error : score.width_errors) {
        sum += error;
        worst = std::max(worst, error);
      }
      char text[100];
      std::snprintf(
          text, sizeof text, "  %9d of %-3d  %13.1f / %-11.1f", score.right, score.rooms,
          score.width_errors.empty() ? 0 : 1e3 * sum / static_cast<double>(score.width_errors.size()),
          1e3 * worst);
      row += text;
      all[noise].right += score.right;
      all[noise].rooms += score.rooms;
    }
    std::printf("%-24s%s\n", kind.name, row.c_str());
  }
  for (const int noise : {1, 2, 3})
    std::printf("noise x%d: %.1f %% of %d rooms right\n", noise,
                100.0 * all[noise].right / std::max(1, all[noise].rooms), all[noise].rooms);
}
