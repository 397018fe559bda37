#include "floor/clear_area.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kTouch_m = 1e-6;       ///< what overlaps by less only touches
constexpr std::size_t kMostLines = 64;  ///< of an outline's corners, so many coordinates are told apart
constexpr double kFar_m = 1e9;
constexpr double kLine_m = 1e-3;  ///< half the breadth of a line that walls may block

Vec2 quarter_turned(const Vec2& v, int quarters) {
  switch (quarters & 3) {
    case 0:
      return v;
    case 1:
      return {-v.y(), v.x()};
    case 2:
      return -v;
    default:
      return {v.y(), -v.x()};
  }
}

/// The part of a..b with y between `low` and `high`: its least and greatest x. None when it only touches the
/// band.
std::optional<std::pair<double, double>> extent_in_band(Vec2 a, Vec2 b, double low, double high) {
  if (a.y() > b.y()) std::swap(a, b);
  if (b.y() <= low + kTouch_m || a.y() >= high - kTouch_m) return std::nullopt;
  const auto at = [&](double y) {
    const double rise = b.y() - a.y();
    return rise < kTouch_m ? a.x() : a.x() + (b.x() - a.x()) * (y - a.y()) / rise;
  };
  double first = a.y() < low ? at(low) : a.x(), second = b.y() > high ? at(high) : b.x();
  if (first > second) std::swap(first, second);
  return std::pair(first, second);
}

/// Sorted, without near repeats, and not more than kMostLines.
std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  if (values.empty()) return values;
  const double step = std::max(0.01, (values.back() - values.front()) / static_cast<double>(kMostLines));
  std::vector<double> kept{values.front()};
  for (const double value : values)
    if (value - kept.back() > step) kept.push_back(value);
  if (kept.size() > 1) kept.back() = values.back();
  return kept;
}

}  // namespace

Vec2 Heading::point(double along_m, double left_m) const {
  return at + quarter_turned({along_m, left_m}, heading);
}

Vec2 Heading::local(const Vec2& point) const {
  return quarter_turned(point - at, 4 - heading);
}

ClearArea::ClearArea(const FloorGroundTruth& floor, double inner_wall_m, double outer_wall_m) {
  double longest = 0;
  for (std::size_t i = 0; i < floor.outline.size(); ++i) {
    const Vec2 edge = floor.outline[(i + 1) % floor.outline.size()] - floor.outline[i];
    if (edge.norm() > longest + 1e-6) longest = edge.norm(), axis_ = edge / edge.norm();
  }
  add(grown(floor.outline, -outer_wall_m), walls_);
  for (Polygon court : floor.courtyards) {
    if (signed_area(court) < 0) std::reverse(court.begin(), court.end());
    add(grown(court, outer_wall_m), walls_);
  }
  for (const FixedRoom& room : floor.fixed) add(grown(room.outline, inner_wall_m), fixed_);
}

void ClearArea::add(const Polygon& ring, std::vector<Edge>& edges) const {
  const auto turned = [this](const Vec2& p) {
    return Vec2(axis_.x() * p.x() + axis_.y() * p.y(), axis_.x() * p.y() - axis_.y() * p.x());
  };
  for (std::size_t i = 0; i < ring.size(); ++i)
    edges.push_back({turned(ring[i]), turned(ring[(i + 1) % ring.size()])});
}

Vec2 ClearArea::to_plan(const Vec2& p) const {
  return {axis_.x() * p.x() - axis_.y() * p.y(), axis_.y() * p.x() + axis_.x() * p.y()};
}

double ClearArea::first_hit(const std::vector<Edge>& edges, const Heading& from, double right_m,
                            double left_m) const {
  double nearest = kFar_m;
  for (const Edge& edge : edges) {
    const auto extent = extent_in_band(from.local(edge.a), from.local(edge.b), -right_m, left_m);
    if (extent && extent->second > kTouch_m) nearest = std::min(nearest, std::max(0.0, extent->first));
  }
  return nearest;
}

double ClearArea::free_of_walls(const Heading& from, double right_m, double left_m) const {
  return first_hit(walls_, from, right_m, left_m);
}

double ClearArea::free_of_fixed(const Heading& from, double right_m, double left_m) const {
  return first_hit(fixed_, from, right_m, left_m);
}

/// Even-odd over all rings: courtyards are holes.
bool ClearArea::is_inside(const Vec2& point) const {
  bool inside = false;
  for (const Edge& edge : walls_) {
    if ((edge.a.y() > point.y()) == (edge.b.y() > point.y())) continue;
    const double x =
        edge.a.x() + (edge.b.x() - edge.a.x()) * (point.y() - edge.a.y()) / (edge.b.y() - edge.a.y());
    if (x > point.x()) inside = !inside;
  }
  return inside;
}

std::vector<Strip> ClearArea::strips() const {
  std::vector<Strip> found;
  for (const int heading : {0, 1}) {
    const Heading frame{Vec2::Zero(), heading};
    std::vector<double> lines;
    for (const Edge& edge : walls_) lines.push_back(frame.local(edge.a).y());
    lines = distinct(std::move(lines));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::size_t j = i + 1; j < lines.size(); ++j) {
        std::vector<std::pair<double, double>> blocks;
        for (const Edge& edge : walls_)
          if (const auto extent =
                  extent_in_band(frame.local(edge.a), frame.local(edge.b), lines[i], lines[j]))
            blocks.push_back(*extent);
        std::sort(blocks.begin(), blocks.end());
        double end = kFar_m;
        const double middle = (lines[i] + lines[j]) / 2;
        for (const auto& [first, second] : blocks) {
          if (first > end + kTouch_m && is_inside(frame.point((end + first) / 2, middle)))
            found.push_back({{frame.point(end, middle), heading}, first - end, lines[j] - lines[i]});
          end = end == kFar_m ? second : std::max(end, second);
        }
      }
    }
  }
  return found;
}

std::vector<Bay> ClearArea::bays(const Heading& from, double at_m) const {
  std::vector<double> lines;
  for (const Edge& edge : walls_) lines.push_back(from.local(edge.a).x());
  // Only as far as the line itself is free: what lies beyond a wall is no bay.
  const Heading on{from.point(at_m, 0), from.heading}, back{on.at, (from.heading + 2) & 3};
  const double least_m = at_m - first_hit(walls_, back, kLine_m, kLine_m);
  const double most_m = at_m + first_hit(walls_, on, kLine_m, kLine_m);
  std::erase_if(lines, [&](double line) { return line < least_m || line > most_m; });
  lines.insert(lines.end(), {least_m, most_m});
  lines = distinct(std::move(lines));
  if (lines.size() < 2 || most_m - least_m >= kFar_m) return {};
  const Heading away{from.at, (from.heading + 1) & 3};
  std::vector<double> free_m;  // by stretch between neighbouring lines
  for (std::size_t i = 0; i + 1 < lines.size(); ++i)
    free_m.push_back(first_hit(walls_, away, lines[i + 1], -lines[i]));
  const auto above = std::upper_bound(lines.begin(), lines.end() - 1, at_m - kTouch_m);
  std::size_t first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, above - lines.begin()) - 1);
  std::size_t last = first;  // stretches first..last are free for `length`
  double length = free_m[first];
  std::vector<Bay> found;
  while (true) {
    while (first > 0 && free_m[first - 1] >= length - 0.01) --first;
    while (last + 1 < free_m.size() && free_m[last + 1] >= length - 0.01) ++last;
    found.push_back({lines[first], lines[last + 1], length});
    const double before = first > 0 ? free_m[first - 1] : 0;
    const double behind = last + 1 < free_m.size() ? free_m[last + 1] : 0;
    length = std::max(before, behind);
    if (length <= 0) return found;
  }
}

std::vector<double> ClearArea::beside_fixed(const Heading& from, double width_m) const {
  std::vector<double> places;
  for (const Edge& edge : fixed_)
    for (const double side : {-0.5, 0.5}) places.push_back(from.local(edge.a).y() + side * width_m);
  return places;
}

}  // namespace gramap
