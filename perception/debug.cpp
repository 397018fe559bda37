#include "perception/debug.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string>

#include "geometry/error.h"
#include "geometry/file.h"

namespace gramap {
namespace {

constexpr std::size_t kPlyPoints = 500000, kSvgPoints = 20000;

[[gnu::format(printf, 2, 3)]] void print(std::string& text, const char* format, ...) {
  char line[400];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

/// Colours far apart for neighbouring numbers: the golden angle round the colour circle.
std::array<std::uint8_t, 3> colour(std::size_t number) {
  const double hue = std::fmod(static_cast<double>(number) * 0.381966, 1.0) * 6;
  std::array<std::uint8_t, 3> rgb{};
  for (int channel = 0; channel < 3; ++channel) {
    const double place = std::fmod(hue + 2 * channel, 6.0);
    rgb[static_cast<std::size_t>(channel)] =
        static_cast<std::uint8_t>(40 + 200 * std::clamp(std::abs(place - 3) - 1, 0.0, 1.0));
  }
  return rgb;
}

std::string ply_of(const Perception& found) {
  const std::vector<Point>& points = found.cloud.points_m;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kPlyPoints),
                    count = (points.size() + step - 1) / step;
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nend_header\n";
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Vec3 p = points[i].cast<double>();
    std::array<std::uint8_t, 3> rgb = {120, 120, 120};
    for (std::size_t k = 0; k < found.planes.size(); ++k)
      if (std::abs(found.planes[k].distance(p)) <= found.planes[k].band_m && found.planes[k].covers(p)) {
        rgb = colour(k);
        break;
      }
    char record[15];
    std::memcpy(record, points[i].data(), 12);
    std::memcpy(record + 12, rgb.data(), 3);
    text.append(record, sizeof record);
  }
  return text;
}

std::string list_of(const Perception& found) {
  std::string text = "plane  normal                     rho_m    rms_mm  points    area_m2  what it is\n";
  for (std::size_t k = 0; k < found.planes.size(); ++k) {
    const PlanePatch& plane = found.planes[k];
    const double slope = std::abs(plane.normal.z());
    std::string fate = "slanted: neither wall nor level";
    if (slope > 0.98) {
      const double z = plane.rho_m / plane.normal.z();
      fate = std::abs(z - found.storey.floor_z_m) < 0.1     ? "floor"
             : std::abs(z - found.storey.ceiling_z_m) < 0.1 ? "ceiling"
                                                            : "level, between floor and ceiling or outside";
    } else if (slope < 0.1) {
      fate = "vertical, does not reach the ceiling: no wall";
      for (std::size_t w = 0; w < found.walls.size(); ++w) {
        const WallLine& wall = found.walls[w];
        const Vec3 middle = plane.corner + plane.u * (plane.columns * plane.cell_m / 2);
        if (std::abs(wall.normal.dot(plane.normal.head<2>())) > 0.98 &&
            std::abs(wall.distance(middle.head<2>())) < 0.1) {
          const bool used =
              std::count(found.outline.lines.begin(), found.outline.lines.end(), static_cast<int>(w)) > 0;
          fate = "wall line " + std::to_string(w) + (used ? ", in the outline" : ", not in the outline");
          break;
        }
      }
    }
    print(text, "%5zu  %7.4f %7.4f %7.4f  %8.3f  %6.1f  %8zu  %7.2f  %s\n", k, plane.normal.x(),
          plane.normal.y(), plane.normal.z(), plane.rho_m, plane.rms_m * 1e3, plane.support, plane.area_m2,
          fate.c_str());
  }
  return text;
}

std::string svg_of(const Perception& found) {
  const FreeSpace& free = found.free;
  Vec2 low = free.corner_m, high = free.corner_m + free.pixel_m * Vec2(free.columns, free.rows);
  for (const Vec2& corner : found.outline.ring) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  low -= Vec2::Constant(1);
  high += Vec2::Constant(1);
  const double scale = 1100 / std::max({(high - low).x(), (high - low).y(), 1.0});
  const auto at = [&](const Vec2& p) { return Vec2((p.x() - low.x()) * scale, (high.y() - p.y()) * scale); };
  std::string text;
  print(text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\">\n<rect width=\"100%%\" "
        "height=\"100%%\" fill=\"white\"/>\n",
        (high - low).x() * scale, (high - low).y() * scale);
  text += "<path fill=\"#dff0df\" d=\"";
  for (int row = 0; row < free.rows; ++row)
    for (int column = 0; column < free.columns; ++column) {
      const auto seen = [&](int c) {
        return free.seen[static_cast<std::size_t>(row) * static_cast<std::size_t>(free.columns) +
                         static_cast<std::size_t>(c)] != 0;
      };
      if (!seen(column)) continue;
      const int first = column;
      while (column + 1 < free.columns && seen(column + 1)) ++column;
      const Vec2 p = at(free.corner_m + free.pixel_m * Vec2(first, row + 1));
      print(text, "M%.1f %.1fh%.1fv%.2fh-%.1fz", p.x(), p.y(), (column + 1 - first) * free.pixel_m * scale,
            free.pixel_m * scale, (column + 1 - first) * free.pixel_m * scale);
    }
  text += "\"/>\n<path stroke=\"#888\" stroke-width=\"1\" d=\"";
  const std::size_t step = std::max<std::size_t>(1, found.cloud.points_m.size() / kSvgPoints);
  for (std::size_t i = 0; i < found.cloud.points_m.size(); i += step) {
    const Point& point = found.cloud.points_m[i];
    if (point.z() < found.storey.floor_z_m + 0.1 || point.z() > found.storey.ceiling_z_m - 0.1) continue;
    const Vec2 p = at(Vec2(point.x(), point.y()));
    if (p.minCoeff() >= 0 && p.x() < 5000 && p.y() < 5000) print(text, "M%.1f %.1fh1", p.x(), p.y());
  }
  text += "\"/>\n";
  for (std::size_t k = 0; k < found.walls.size(); ++k) {
    const WallLine& wall = found.walls[k];
    const auto on_line = [&](double along) {
      return at(wall.normal * wall.rho_m + wall.direction() * along);
    };
    const double reach = (high - low).norm(), middle = wall.direction().dot((low + high) / 2);
    const Vec2 a = on_line(middle - reach), b = on_line(middle + reach);
    print(text,
          "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ccd\" stroke-width=\"0.5\"/>\n",
          a.x(), a.y(), b.x(), b.y());
    const std::array<std::uint8_t, 3> c = colour(k);
    for (std::size_t column = 0; column < wall.wall.size(); ++column) {
      if (!wall.wall[column]) continue;
      const std::size_t first = column;
      while (column + 1 < wall.wall.size() && wall.wall[column + 1]) ++column;
      const Vec2 p = on_line(wall.start_m + static_cast<double>(first) * wall.column_m);
      const Vec2 q = on_line(wall.start_m + static_cast<double>(column + 1) * wall.column_m);
      print(text,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#%02x%02x%02x\" "
            "stroke-width=\"4\" stroke-opacity=\"0.6\"/>\n",
            p.x(), p.y(), q.x(), q.y(), c[0], c[1], c[2]);
    }
  }
  text += "<path fill=\"none\" stroke=\"#c00\" stroke-width=\"2\" d=\"";
  for (std::size_t i = 0; i < found.outline.ring.size(); ++i) {
    const Vec2 p = at(found.outline.ring[i]);
    print(text, "%c%.1f %.1f", i ? 'L' : 'M', p.x(), p.y());
  }
  text += found.outline.ring.empty() ? "\"/>\n" : "z\"/>\n";
  const Vec2 origin = found.cloud.origin_m.head<2>();
  for (const OpeningObservation& opening : found.observation.openings) {
    const WallObservation& wall = found.observation.walls[static_cast<std::size_t>(opening.wall)];
    const Vec2 along = (wall.b - wall.a).normalized(), start = wall.a - origin + opening.start_m * along;
    const Vec2 a = at(start), b = at(start + opening.width_m * along);
    print(text,
          "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"9\" "
          "stroke-opacity=\"0.6\"><title>%s, %.2f</title></line>\n",
          a.x(), a.y(), b.x(), b.y(), opening.kind == "door" ? "#b50" : "#09c", opening.kind.c_str(),
          opening.confidence);
  }
  for (const FurnitureObservation& piece : found.observation.furniture) {
    text += "<path fill=\"#fa0\" fill-opacity=\"0.35\" stroke=\"#a60\" d=\"";
    Vec2 middle = Vec2::Zero();
    for (std::size_t i = 0; i < piece.footprint.size(); ++i) {
      const Vec2 p = at(piece.footprint[i] - origin);
      middle += p / static_cast<double>(piece.footprint.size());
      print(text, "%c%.1f %.1f", i ? 'L' : 'M', p.x(), p.y());
    }
    print(text, "z\"/>\n<text x=\"%.1f\" y=\"%.1f\" font-size=\"13\" text-anchor=\"middle\">%s %.2f</text>\n",
          middle.x(), middle.y(), piece.type.c_str(), piece.top_m);
  }
  for (const RegisteredCloud::Part& part : found.cloud.parts) {
    const Vec2 p = at(part.scanner_m.head<2>());
    print(text, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"#00c\"/>\n", p.x(), p.y());
  }
  return text + "</svg>\n";
}

}  // namespace

void write_debug(const std::filesystem::path& folder, const Perception& perception) {
  make_folder(folder);
  write_file(folder / "planes.ply", ply_of(perception));
  write_file(folder / "planes.txt", list_of(perception));
  write_file(folder / "plan.svg", svg_of(perception));
}

}  // namespace gramap
