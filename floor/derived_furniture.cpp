#include "floor/derived_furniture.h"

#include <algorithm>

#include "geometry/polygon.h"

namespace gramap {
namespace {

/// Usual sizes, metres: along the hallway, away from it, height.
struct PieceSize {
  double length_m, breadth_m, height_m;
};
constexpr PieceSize kTable{1.40, 0.70, 0.74};
constexpr PieceSize kChair{0.45, 0.45, 0.45};
constexpr PieceSize kOther{0.80, 0.40, 1.80};

constexpr double kStep_m = 0.10;   // of the search for a place
constexpr double kSpare_m = 0.10;  // between pieces, and between a piece and the wall

Polygon box(const Vec2& corner, const Vec2& u, const PieceSize& size) {
  const Vec2 v(-u.y(), u.x());
  return {corner, corner + u * size.length_m, corner + u * size.length_m + v * size.breadth_m,
          corner + v * size.breadth_m};
}

/// True when all of the box lies in the room with some air around it, and clear of the others. Boxes share
/// one pair of axes.
bool is_free(const Polygon& piece, const Polygon& room, const std::vector<FittedFurniture>& others,
             const Vec2& u) {
  for (const Vec2& corner : piece)
    if (!contains(room, corner) || distance_to_border(room, corner) < kSpare_m) return false;
  const Vec2 v(-u.y(), u.x());
  const auto apart = [&](const Polygon& other, const Vec2& axis) {
    const auto less = [&](const Vec2& p, const Vec2& q) { return p.dot(axis) < q.dot(axis); };
    const auto [low, high] = std::minmax_element(piece.begin(), piece.end(), less);
    const auto [other_low, other_high] = std::minmax_element(other.begin(), other.end(), less);
    return high->dot(axis) + kSpare_m / 2 < other_low->dot(axis) ||
           other_high->dot(axis) + kSpare_m / 2 < low->dot(axis);
  };
  return std::all_of(others.begin(), others.end(), [&](const FittedFurniture& other) {
    return apart(other.outline, u) || apart(other.outline, v);
  });
}

}  // namespace

std::vector<FittedFurniture> derived_furniture(const FittedRoom& room, const Vec2& along,
                                               const std::vector<std::string>& names) {
  std::vector<FittedFurniture> placed;
  const Vec2 u = along.normalized(), v(-u.y(), u.x());
  double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (const Vec2& point : room.outline) {
    u0 = std::min(u0, point.dot(u)), u1 = std::max(u1, point.dot(u));
    v0 = std::min(v0, point.dot(v)), v1 = std::max(v1, point.dot(v));
  }
  std::vector<Polygon> tables_without_chair;
  for (const std::string& name : names) {
    const PieceSize size = name == "table" ? kTable : name == "chair" ? kChair : kOther;
    const auto put = [&](const Vec2& corner) {
      const Polygon piece = box(corner, u, size);
      if (!is_free(piece, room.outline, placed, u)) return false;
      placed.push_back(
          {name == "table" || name == "chair" ? name : "other", Origin::derived, piece, 0, size.height_m, 1});
      if (name == "table") tables_without_chair.push_back(piece);
      return true;
    };
    // A chair belongs in front of a table, on the side of the hallway.
    if (name == "chair" && !tables_without_chair.empty()) {
      const Polygon table = tables_without_chair.front();
      tables_without_chair.erase(tables_without_chair.begin());
      if (put(table[0] + u * (kTable.length_m - size.length_m) / 2 - v * (size.breadth_m + kSpare_m)))
        continue;
    }
    bool done = false;
    for (double y = v1 - 2 * kSpare_m - size.breadth_m; !done && y > v0; y -= kStep_m)
      for (double x = u0 + 2 * kSpare_m; !done && x + size.length_m < u1; x += kStep_m)
        done = put(u * x + v * y);
  }
  return placed;
}

}  // namespace gramap
