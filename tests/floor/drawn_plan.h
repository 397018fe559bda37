// Indoor plans for tests, as WGS84 GeoJSON: shapes of a plan in metres that is turned by 0.3 rad about an
// origin, features and collections.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "floor/projection.h"

namespace gramap::test {

struct DrawnPlan {
  GeoOrigin origin{13.7, 51.0};

  std::string position(double x, double y) const {
    const Vec2 turned(std::cos(0.3) * x - std::sin(0.3) * y, std::sin(0.3) * x + std::cos(0.3) * y);
    const Vec2 degrees = wgs84_from_plan(origin, turned);
    char text[64];
    std::snprintf(text, sizeof text, "[%.10f,%.10f]", degrees.x(), degrees.y());
    return text;
  }
  std::string positions(const std::vector<Vec2>& points) const {
    std::string text;
    for (const Vec2& point : points) text += (text.empty() ? "" : ",") + position(point.x(), point.y());
    return "[" + text + "]";
  }
  std::string ring(double x0, double y0, double x1, double y1) const {
    return positions({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}});
  }
  std::string box(double x0, double y0, double x1, double y1) const {
    return geometry("Polygon", "[" + ring(x0, y0, x1, y1) + "]");
  }
  std::string point(double x, double y) const { return geometry("Point", position(x, y)); }
  std::string line(const std::vector<Vec2>& points) const {
    return geometry("LineString", positions(points));
  }

  static std::string geometry(const std::string& type, const std::string& coordinates) {
    return R"("geometry":{"type":")" + type + R"(","coordinates":)" + coordinates + "}";
  }
  static std::string feature(const std::string& properties, const std::string& geometry) {
    return R"({"type":"Feature","properties":{)" + properties + "}," + geometry + "}";
  }
  static std::string collection(const std::string& features) {
    return R"({"type":"FeatureCollection","features":[)" + features + "]}";
  }
};

}  // namespace gramap::test
