#include "app/derive_svg.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>

#include "floor/fit_floor.h"

namespace gramap {
namespace {

constexpr double kUnitsPerMetre = 20;
constexpr double kMargin_m = 1;

/// The part of a ring where (p - at) . normal >= 0 (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& ring, const Vec2& at, const Vec2& normal) {
  Polygon kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& a = ring[i];
    const Vec2& b = ring[(i + 1) % ring.size()];
    const double da = (a - at).dot(normal);
    const double db = (b - at).dot(normal);
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

Polygon room_outline(const DerivedSpace& derived, const PlacedRoom& room) {
  Polygon outline = slab(derived.space, room.start_m, room.start_m + room.width_m);
  if (room.depth_m < 0) return outline;
  const Vec2 along = (derived.space.end - derived.space.start).normalized();
  const Vec2 away(-along.y(), along.x());
  outline = cut(outline, derived.space.start + away * room.depth_start_m, away);
  return cut(outline, derived.space.start + away * (room.depth_start_m + room.depth_m), -away);
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

class Drawing {
 public:
  void add(const Polygon& outline, const std::string& fill, const std::string& label) {
    if (outline.size() < 3) return;
    Vec2 least = outline.front();
    Vec2 most = outline.front();
    std::string points;
    for (const Vec2& p : outline) {
      least = least.cwiseMin(p);
      most = most.cwiseMax(p);
      points += number(p.x()) + "," + number(-p.y()) + " ";
    }
    least_ = least_.cwiseMin(least);
    most_ = most_.cwiseMax(most);
    body_ += "<polygon points=\"" + points + "\" fill=\"" + fill + "\" stroke=\"#333\"/>\n";
    if (label.empty()) return;
    const Vec2 middle = 0.5 * (least + most);
    body_ += "<text x=\"" + number(middle.x()) + "\" y=\"" + number(-middle.y()) +
             "\" text-anchor=\"middle\" font-size=\"9\" font-family=\"sans-serif\">" + escaped(label) +
             "</text>\n";
  }

  std::string text() const {
    const Vec2 size = most_ - least_ + Vec2(2 * kMargin_m, 2 * kMargin_m);
    const std::string box = number(least_.x() - kMargin_m) + " " + number(-most_.y() - kMargin_m) + " " +
                            number(size.x()) + " " + number(size.y());
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + box + "\" width=\"" + number(size.x()) +
           "\" height=\"" + number(size.y()) + "\">\n<rect x=\"" + number(least_.x() - kMargin_m) +
           "\" y=\"" + number(-most_.y() - kMargin_m) + "\" width=\"" + number(size.x()) + "\" height=\"" +
           number(size.y()) + "\" fill=\"white\"/>\n" + body_ + "</svg>\n";
  }

 private:
  static std::string number(double metres) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", kUnitsPerMetre * metres);
    return text;
  }

  Vec2 least_ = Vec2::Constant(std::numeric_limits<double>::max());
  Vec2 most_ = Vec2::Constant(std::numeric_limits<double>::lowest());
  std::string body_;
};

}  // namespace

std::string derivation_svg(const std::vector<DerivedSpace>& spaces, const std::vector<Hallway>& hallways) {
  static constexpr const char* kFills[] = {"#a6cee3", "#fdbf6f", "#b2df8a", "#cab2d6", "#fb9a99",
                                           "#ffff99", "#d9d9d9", "#bc80bd", "#ccebc5", "#ffed6f"};
  Drawing drawing;
  for (const Hallway& hallway : hallways) drawing.add(hallway.outline, "#f7f7f7", hallway.name);
  std::map<std::string, std::size_t> types;
  for (const DerivedSpace& derived : spaces) {
    for (const PlacedRoom& room : derived.rooms) {
      const std::size_t type = types.try_emplace(room.type, types.size()).first->second;
      char label[96];
      std::snprintf(label, sizeof label, "%s %.2f", room.type.c_str(), room.width_m);
      drawing.add(room_outline(derived, room), kFills[type % std::size(kFills)], label);
    }
  }
  return drawing.text();
}

}  // namespace gramap
