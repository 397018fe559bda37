#include "floor/shapes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

namespace gramap {
namespace {

using Heights = std::vector<std::array<double, 2>>;

/// Prisms over the fields of a grid: field (i, j) lies between xs[i], xs[i+1] and ys[j], ys[j+1].
Mesh grid_solid(const std::vector<double>& xs, const std::vector<double>& ys,
                const std::function<Heights(int, int)>& heights) {
  std::vector<Vec2> points;
  const int columns = static_cast<int>(xs.size());
  for (const double y : ys)
    for (const double x : xs) points.emplace_back(x, y);
  std::vector<PrismCell> cells;
  for (int j = 0; j + 1 < static_cast<int>(ys.size()); ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + columns;
      if (Heights h = heights(i, j); !h.empty())
        cells.push_back({{{a, a + 1, b + 1}, {a, b + 1, b}}, std::move(h)});
    }
  return extrude(points, cells);
}

Mesh block(double x0, double x1, double y0, double y1, double z0, double z1) {
  return grid_solid({x0, x1}, {y0, y1}, [&](int, int) { return Heights{{z0, z1}}; });
}

double whole_mm(double length_m) {
  return std::floor(length_m * 1000 + 1e-6) / 1000;
}

/// A lever on a spindle: from the leaf's face at y0 away to y1.
Mesh handle(double x, double toward, double y0, double y1, double z) {
  const double bar = y1 + (y1 > y0 ? -0.015 : 0.015);  // the lever's own thickness at the far end
  const double x1 = x + toward * 0.02, x2 = x + toward * 0.13;
  std::vector<double> xs{x, x1, x2}, ys{y0, bar, y1};
  std::sort(xs.begin(), xs.end());
  std::sort(ys.begin(), ys.end());
  return grid_solid(xs, ys, [&](int i, int j) {
    const bool spindle =
        (xs[i] + xs[i + 1]) / 2 > std::min(x, x1) && (xs[i] + xs[i + 1]) / 2 < std::max(x, x1);
    const bool lever =
        (ys[j] + ys[j + 1]) / 2 > std::min(bar, y1) && (ys[j] + ys[j + 1]) / 2 < std::max(bar, y1);
    return spindle || lever ? Heights{{z, z + 0.02}} : Heights{};
  });
}

bool any_of(const std::string& type, std::initializer_list<const char*> words) {
  std::string lower = type;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(),
                     [&lower](const char* word) { return lower.find(word) != std::string::npos; });
}

/// A top on four legs at its corners.
Mesh table(double length, double breadth, double height, double board, double leg) {
  return grid_solid({0, leg, length - leg, length}, {0, leg, breadth - leg, breadth}, [&](int i, int j) {
    return Heights{{i != 1 && j != 1 ? 0 : height - board, height}};
  });
}

Mesh chair(double length, double breadth, double height) {
  const double leg = 0.04, seat = std::min(0.46, height * 0.55), board = 0.05, back = 0.05;
  return grid_solid({0, leg, length - leg, length}, {0, leg, breadth - back, breadth}, [&](int i, int j) {
    const double bottom = i != 1 && j != 1 ? 0 : seat - board;
    if (j != 2) return Heights{{bottom, seat}};
    return Heights{{bottom, height}};  // the back
  });
}

/// A body on a set-back plinth, with a groove where its doors meet.
Mesh cupboard(double length, double breadth, double height) {
  const double plinth = std::min(0.08, height / 5), recess = std::min(0.04, breadth / 5), groove = 0.008,
               depth = 0.015;
  const double middle = length / 2;
  if (length < 0.5)
    return grid_solid({0, length}, {0, recess, breadth}, [&](int, int j) {
      return Heights{{j == 0 ? plinth : 0, height}};
    });
  return grid_solid({0, middle - groove / 2, middle + groove / 2, length}, {0, depth, recess, breadth},
                    [&](int i, int j) {
                      if (j == 2) return Heights{{0, height}};
                      if (i == 1 && j == 0) return Heights{{height - 0.03, height}};
                      return Heights{{plinth, height}};
                    });
}

}  // namespace

std::vector<Part> door_parts(double width_m, double height_m, double thickness_m) {
  const double w = whole_mm(width_m), h = whole_mm(height_m), t = whole_mm(thickness_m);
  const double jamb = std::min(0.04, w / 8), gap = 0.003, leaf = std::min(0.04, t / 2),
               set_back = std::min(0.015, t / 4);
  std::vector<Part> parts;
  parts.push_back({"frame", Material::frame, grid_solid({0, jamb, w - jamb, w}, {0, t}, [&](int i, int) {
                     return i == 1 ? Heights{{h - jamb, h}} : Heights{{0, h}};
                   })});
  const bool two = w > 1.4;
  const double top = h - jamb - gap, y0 = set_back, y1 = set_back + leaf, level = std::min(1.05, h / 2);
  const auto add_leaf = [&](const std::string& suffix, double x0, double x1, double handle_x, double toward) {
    parts.push_back({"leaf" + suffix, Material::door, block(x0, x1, y0, y1, 0.006, top)});
    parts.push_back({"handle" + suffix, Material::metal, handle(handle_x, toward, y0, y0 - 0.055, level)});
    parts.push_back(
        {"handle" + suffix + "_far", Material::metal, handle(handle_x, toward, y1, y1 + 0.055, level)});
  };
  if (two) {
    add_leaf("", jamb + gap, w / 2 - gap / 2, w / 2 - 0.07, -1);
    add_leaf("_2", w / 2 + gap / 2, w - jamb - gap, w / 2 + 0.07, 1);
  } else {
    add_leaf("", jamb + gap, w - jamb - gap, w - jamb - 0.07, -1);
  }
  return parts;
}

std::vector<Part> window_parts(double width_m, double height_m, double thickness_m) {
  const double w = whole_mm(width_m), h = whole_mm(height_m), t = whole_mm(thickness_m);
  const double bar = std::min({0.06, w / 6, h / 6}), depth = std::min(0.07, t / 2);
  const double y0 = (t - depth) * 0.65, y1 = y0 + depth;
  std::vector<Part> parts;
  std::vector<double> xs{0, bar, w - bar, w};
  const bool two = w > 1.3;
  if (two) xs = {0, bar, (w - bar) / 2, (w + bar) / 2, w - bar, w};
  parts.push_back({"frame", Material::frame, grid_solid(xs, {y0, y1}, [&](int i, int) {
                     return i % 2 == 0 ? Heights{{0, h}} : Heights{{0, bar}, {h - bar, h}};
                   })});
  const double glass = 0.012, middle = (y0 + y1) / 2;
  for (std::size_t i = 1; i + 1 < xs.size(); i += 2)
    parts.push_back({i == 1 ? "pane" : "pane_2", Material::glass,
                     block(xs[i], xs[i + 1], middle - glass / 2, middle + glass / 2, bar, h - bar)});
  parts.push_back({"sill", Material::sill, block(0, w, -0.03, y0, 0, std::min(0.025, bar / 2))});
  if (t - y1 > 0.02)
    parts.push_back({"sill_far", Material::metal, block(0, w, y1, t + 0.03, 0, std::min(0.015, bar / 2))});
  return parts;
}

std::vector<Part> furniture_parts(const std::string& type, double length_m, double breadth_m, double height_m,
                                  bool derived) {
  const double l = std::max(whole_mm(length_m), 0.01), b = std::max(whole_mm(breadth_m), 0.01),
               h = std::max(whole_mm(height_m), 0.01);
  const Material wood = derived ? Material::furniture_derived : Material::furniture;
  const Material cloth = derived ? Material::furniture_derived : Material::seat;
  if (any_of(type, {"table", "desk", "tisch"}) && std::min(l, b) > 0.35 && h > 0.3)
    return {{"table", wood, table(l, b, h, 0.03, 0.05)}};
  if (any_of(type, {"chair", "stool", "stuhl"}) && std::min(l, b) > 0.25 && h > 0.3)
    return {{"chair", cloth, chair(l, b, h)}};
  if (any_of(type, {"cupboard", "cabinet", "wardrobe", "shelf", "schrank", "locker"}) &&
      std::min(l, b) > 0.15 && h > 0.3)
    return {{"cupboard", wood, cupboard(l, b, h)}};
  if (any_of(type, {"bed", "bett"}) && std::min(l, b) > 0.5 && h > 0.25)
    return {{"bed", wood, table(l, b, h * 0.55, h * 0.3, 0.08)},
            {"mattress", cloth, block(0.03, l - 0.03, 0.03, b - 0.03, h * 0.55, h)}};
  return {{"block", wood, block(0, l, 0, b, 0, h)}};
}

}  // namespace gramap
