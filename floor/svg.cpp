#include "floor/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "floor/global_id.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

std::string format(const char* pattern, double a, double b = 0, double c = 0, double d = 0) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, a, b, c, d);
  return text;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) safe += c;
    }
  }
  return safe;
}

constexpr char kStyle[] = R"(
text { font-family: "Helvetica Neue", Arial, "Liberation Sans", sans-serif; fill: #222; text-anchor: middle; paint-order: stroke; stroke: #ffffffb0; stroke-width: 0.5 }
.room { fill: #f6efe2 } .derived { fill: #dfe9f4 } .hallway { fill: #eeeeec } .fixed { fill: #e4e2df }
.hatch { fill: url(#derived-hatch) }
.wall { fill: #33322f; fill-rule: evenodd } .mass { fill: #8d8b87; fill-rule: evenodd }
.opening { fill: #fff; stroke: #33322f; stroke-width: 0.15 } .glass { stroke: #3b7ea6; stroke-width: 0.25 }
.leaf { stroke: #7a4a22; stroke-width: 0.35; fill: none } .swing { stroke: #7a4a22; stroke-width: 0.13; fill: none }
.furniture { fill: #fffdf8; stroke: #8a7a63; stroke-width: 0.15 } .furniture.derived { stroke-dasharray: 0.8 0.5; fill: #eef3f8 }
.sigma { opacity: 0.4 } .band { fill: #d1495b } .bar { stroke: #a8172d; stroke-width: 0.4 } .name { font-weight: 600 } .faint { fill: #666 } .title { text-anchor: start; font-weight: 600 }
)";

class Plan {
 public:
  Plan(const FloorModel& model, const SvgOptions& options)
      : model_(model), options_(options), mm_per_m_(1000.0 / options.scale) {
    low_ = Vec2::Constant(1e300);
    high_ = -low_;
    for (const Polygon& ring : model.outline)
      for (const Vec2& p : ring) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
  }

  std::string draw() {
    rooms();
    furniture();
    walls();
    openings();
    if (options_.uncertainty) uncertainty();
    labels();
    legend();
    const Vec2 size = (high_ - low_) * mm_per_m_ + Vec2(2 * kMargin_mm, 2 * kMargin_mm + kLegend_mm);
    std::string head = "<svg xmlns=\"http://www.w3.org/2000/svg\" ";
    head += format("width=\"%.2fmm\" height=\"%.2fmm\" viewBox=\"0 0 %.2f %.2f\">\n", size.x(), size.y(),
                   size.x(), size.y());
    head += "<title>" + escaped(model_.name.empty() ? "Floor plan" : model_.name) + "</title>\n<style>" +
            kStyle + "</style>\n";
    head +=
        "<defs><pattern id=\"derived-hatch\" width=\"1.6\" height=\"1.6\" patternUnits=\"userSpaceOnUse\" "
        "patternTransform=\"rotate(45)\"><path d=\"M0 0V1.6\" stroke=\"#9db6cf\" "
        "stroke-width=\"0.2\"/></pattern></defs>\n";
    head += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    return head + body_ + "</svg>\n";
  }

 private:
  static constexpr double kMargin_mm = 10;
  static constexpr double kLegend_mm = 14;

  Vec2 paper(const Vec2& p) const {
    return {kMargin_mm + (p.x() - low_.x()) * mm_per_m_, kMargin_mm + (high_.y() - p.y()) * mm_per_m_};
  }

  std::string path(const std::vector<Polygon>& rings) const {
    std::string d;
    for (const Polygon& ring : rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 p = paper(ring[i]);
        d += format(i == 0 ? "M%.3f %.3f" : "L%.3f %.3f", p.x(), p.y());
      }
      d += "Z";
    }
    return d;
  }

  void add_path(const std::string& css, const std::vector<Polygon>& rings) {
    body_ += "<path class=\"" + css + "\" d=\"" + path(rings) + "\"/>\n";
  }

  void add_line(const char* css, const Vec2& a, const Vec2& b) {
    const Vec2 p = paper(a), q = paper(b);
    body_ += std::string("<path class=\"") + css + "\" d=\"" +
             format("M%.3f %.3fL%.3f %.3f", p.x(), p.y(), q.x(), q.y()) + "\"/>\n";
  }

  static bool is_derived(const ModelRoom& room) {
    return room.kind == ModelRoom::Kind::room && room.fitted.origin == Origin::derived;
  }

  void rooms() {
    for (const ModelRoom& room : model_.rooms) {
      const char* css = room.kind == ModelRoom::Kind::hallway ? "hallway"
                        : room.kind == ModelRoom::Kind::fixed ? "fixed"
                        : is_derived(room)                    ? "derived"
                                                              : "room";
      add_path(css, {room.fitted.outline});
      if (is_derived(room)) add_path("hatch", {room.fitted.outline});
    }
  }

  void walls() {
    std::vector<Triangle> walls, masses;
    for (const PlanCell& cell : model_.plan.cells) {
      if (cell.kind == PlanCell::Kind::room || cell.opening >= 0) continue;
      std::vector<Triangle>& into = cell.kind == PlanCell::Kind::mass ? masses : walls;
      into.insert(into.end(), cell.triangles.begin(), cell.triangles.end());
    }
    add_path("wall", border(model_.plan.points, walls));
    if (!masses.empty()) add_path("mass", border(model_.plan.points, masses));
  }

  void furniture() {
    for (const ModelFurniture& piece : model_.furniture)
      add_path(piece.fitted.origin == Origin::derived ? "furniture derived" : "furniture",
               {piece.fitted.outline});
  }

  void openings() {
    for (const ModelOpening& opening : model_.openings) {
      const Polygon& f = opening.footprint;
      if (opening.fitted.kind == "window") {
        add_path("opening", {f});
        add_line("glass", (f[0] + f[3]) / 2, (f[1] + f[2]) / 2);
        continue;
      }
      const Vec2 along = (f[1] - f[0]).normalized(), into_room(along.y(), -along.x());
      if (opening.width_m > 1.4) {
        swing(f[0], along, into_room, opening.width_m / 2);
        swing(f[1], -along, into_room, opening.width_m / 2);
      } else {
        swing(f[0], along, into_room, opening.width_m);
      }
    }
  }

  /// A leaf that stands open into the room, and the arc it sweeps.
  void swing(const Vec2& hinge, const Vec2& along, const Vec2& into_room, double width_m) {
    add_line("leaf", hinge, hinge + into_room * width_m);
    const Vec2 from = paper(hinge + into_room * width_m), to = paper(hinge + along * width_m);
    const Vec2 u = from - paper(hinge), v = to - paper(hinge);
    const bool clockwise = u.x() * v.y() - u.y() * v.x() > 0;  // on paper y runs down
    const double radius = width_m * mm_per_m_;
    body_ += "<path class=\"swing\" d=\"" +
             format("M%.3f %.3fA%.3f %.3f", from.x(), from.y(), radius, radius) +
             (clockwise ? " 0 0 1 " : " 0 0 0 ") + format("%.3f %.3f", to.x(), to.y()) + "\"/>\n";
  }

  /// ±2σ about the wall behind each room of a space: a band within the space, or, where it would cover much
  /// of the room before or behind, a bar at one of three heights, so that the bars of walls side by side can
  /// be told apart.
  void uncertainty() {
    for (const Space& space : model_.fitted.floor.spaces) {
      std::vector<const FittedRoom*> rooms;
      for (const ModelRoom& room : model_.rooms)
        if (room.kind == ModelRoom::Kind::room && room.fitted.space == space.id)
          rooms.push_back(&room.fitted);
      const std::string clip =
          "clip-" + global_id(model_.name + "/" + space.id);  // unique in a page of storeys
      // One group a space: bands that overlap do not add up to a darker one.
      body_ += "<clipPath id=\"" + clip + "\"><path d=\"" + path({space.outline}) + "\"/></clipPath>\n" +
               "<g class=\"sigma\" clip-path=\"url(#" + clip + ")\">\n";
      for (std::size_t i = 0; i < rooms.size(); ++i) wall_uncertainty(space, *rooms[i], rooms, i % 3);
      body_ += "</g>\n";
    }
  }

  void wall_uncertainty(const Space& space, const FittedRoom& room,
                        const std::vector<const FittedRoom*>& rooms, std::size_t level) {
    const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
    const auto at = [&](double along_m, double left_m) -> Vec2 {
      return space.start + along * along_m + left * left_m;
    };
    const auto depths = [&](const FittedRoom& of) {
      std::pair range(1e300, -1e300);
      for (const Vec2& p : of.outline) {
        const double depth_m = (p - space.start).dot(left);
        range = {std::min(range.first, depth_m), std::max(range.second, depth_m)};
      }
      return range;
    };
    const double length_m = (space.end - space.start).norm(), from_m = room.start_m + room.width_m;
    const double to_m = from_m + model_.fitted.inner_wall_m, reach_m = 2 * room.end_sigma_m;
    if (to_m >= length_m || reach_m * mm_per_m_ < 0.2) return;
    const auto [low_m, high_m] = depths(room);
    double narrowest_m = room.width_m;
    for (const FittedRoom* next : rooms)
      if (std::abs(next->start_m - to_m) < 0.05 && depths(*next).first < high_m &&
          depths(*next).second > low_m)
        narrowest_m = std::min(narrowest_m, next->width_m);
    if (reach_m <= narrowest_m / 4) {
      add_path("band", {{at(from_m - reach_m, low_m), at(to_m + reach_m, low_m), at(to_m + reach_m, high_m),
                         at(from_m - reach_m, high_m)}});
      return;
    }
    constexpr double kTick_m = 0.12;
    const double start_m = std::max(0.0, from_m - reach_m), end_m = std::min(length_m, to_m + reach_m);
    const double across_m = low_m + (high_m - low_m) * (0.12 + 0.06 * static_cast<double>(level));
    add_line("bar", at(start_m, across_m), at(end_m, across_m));
    for (const double tip_m : {start_m, end_m})
      add_line("bar", at(tip_m, across_m - kTick_m), at(tip_m, across_m + kTick_m));
  }

  void labels() {
    for (int i = 0; i < static_cast<int>(model_.rooms.size()); ++i) {
      const ModelRoom& room = model_.rooms[i];
      const OrientedBox box = oriented_box(room.fitted.outline);
      Vec2 at = centroid(room.fitted.outline);
      if (!contains(room.fitted.outline, at)) at = inner_point(i);
      std::vector<std::pair<std::string, std::string>> lines;
      lines.emplace_back("name", escaped(room.fitted.name.empty() ? room.fitted.id : room.fitted.name));
      if (room.kind == ModelRoom::Kind::room) {
        lines.emplace_back("", escaped(room.fitted.type));
        std::string width = format("%.2f m", room.fitted.width_m);
        if (is_derived(room)) width += format(" ± %.0f cm", 100 * room.fitted.width_sigma_m);
        lines.emplace_back("", width);
      }
      lines.emplace_back("faint", format("%.1f m²", std::abs(signed_area(room.fitted.outline))));
      std::size_t longest = 1;
      for (const auto& line : lines) longest = std::max(longest, line.second.size());
      const Vec2 extent =
          (low_high(room.fitted.outline).second - low_high(room.fitted.outline).first) * mm_per_m_;
      const double size = std::clamp(
          std::min({extent.x() / (0.6 * static_cast<double>(longest)),
                    extent.y() / (1.3 * static_cast<double>(lines.size())), box.breadth_m * mm_per_m_ / 3}),
          0.7, 2.6);
      Vec2 p = paper(at);
      p.y() -= size * 1.25 * (static_cast<double>(lines.size()) / 2 - 0.75);
      for (const auto& [css, text] : lines) {
        body_ += "<text" + (css.empty() ? std::string() : " class=\"" + css + "\"") +
                 format(" x=\"%.2f\" y=\"%.2f\" font-size=\"%.2f\">", p.x(), p.y(), size) + text +
                 "</text>\n";
        p.y() += size * 1.25;
      }
    }
  }

  static std::pair<Vec2, Vec2> low_high(const Polygon& ring) {
    Vec2 low = ring.front(), high = ring.front();
    for (const Vec2& p : ring) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return {low, high};
  }

  Vec2 inner_point(int room) const {
    double largest = -1;
    Vec2 best = Vec2::Zero();
    for (const PlanCell& cell : model_.plan.cells) {
      if (cell.room != room || cell.kind != PlanCell::Kind::room) continue;
      for (const Triangle& t : cell.triangles) {
        const Polygon corners{model_.plan.points[t[0]], model_.plan.points[t[1]], model_.plan.points[t[2]]};
        if (signed_area(corners) > largest) largest = signed_area(corners), best = centroid(corners);
      }
    }
    return best;
  }

  void legend() {
    const double y = kMargin_mm + (high_.y() - low_.y()) * mm_per_m_ + 7;
    double metres = 5;
    while (metres * mm_per_m_ > (high_.x() - low_.x()) * mm_per_m_ && metres > 1) metres -= 1;
    body_ +=
        format("<path d=\"M%.2f %.2fv1.5h%.2fv-1.5\" fill=\"none\" stroke=\"#222\" stroke-width=\"0.25\"/>\n",
               kMargin_mm, y, metres * mm_per_m_);
    body_ += format("<text class=\"title\" x=\"%.2f\" y=\"%.2f\" font-size=\"2.4\">", kMargin_mm, y + 5) +
             format("%.0f m", metres) + " · 1:" + std::to_string(options_.scale) + " · " +
             escaped(model_.name) + "</text>\n";
    double x = kMargin_mm + metres * mm_per_m_ + 6;
    for (const auto& [css, label] : {std::pair("room", "known or observed"), std::pair("derived", "derived"),
                                     std::pair("band sigma", "wall ± 2σ")}) {
      body_ += std::string("<rect class=\"") + css +
               format("\" x=\"%.2f\" y=\"%.2f\" width=\"4\" height=\"2.4\"/>", x, y - 0.6);
      if (std::string(css) == "derived")
        body_ +=
            format("<rect class=\"hatch\" x=\"%.2f\" y=\"%.2f\" width=\"4\" height=\"2.4\"/>", x, y - 0.6);
      body_ +=
          format("<text class=\"title\" x=\"%.2f\" y=\"%.2f\" font-size=\"2\" style=\"font-weight:400\">",
                 x + 5, y + 1.4) +
          label + "</text>\n";
      x += 32;
    }
  }

  const FloorModel& model_;
  const SvgOptions& options_;
  double mm_per_m_;
  Vec2 low_, high_;
  std::string body_;
};

}  // namespace

std::string to_svg(const FloorModel& model, const SvgOptions& options) {
  return Plan(model, options).draw();
}

}  // namespace gramap
