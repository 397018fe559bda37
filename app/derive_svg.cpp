#include "app/derive_svg.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <map>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kUnitsPerMetre = 20;
constexpr double kMargin_m = 1;
constexpr double kLargestFont = 9;
constexpr double kSmallestFont = 4;   // smaller labels are left out
constexpr double kLetterWidth = 0.6;  // of the font's size

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
  void add(const Polygon& outline, const std::string& fill) {
    if (outline.size() < 3) return;
    std::string points;
    for (const Vec2& p : outline) {
      least_ = least_.cwiseMin(p);
      most_ = most_.cwiseMax(p);
      points += number(p.x()) + "," + number(-p.y()) + " ";
    }
    body_ += "<polygon points=\"" + points + "\" fill=\"" + fill + "\" stroke=\"#333\"/>\n";
  }

  void line(const Vec2& a, const Vec2& b, const std::string& stroke, double width) {
    char text[64];
    std::snprintf(text, sizeof text, "\" stroke=\"%s\" stroke-width=\"%.1f\"/>\n", stroke.c_str(), width);
    body_ += "<line x1=\"" + number(a.x()) + "\" y1=\"" + number(-a.y()) + "\" x2=\"" + number(b.x()) +
             "\" y2=\"" + number(-b.y()) + text;
  }

  /// Two words in the middle of an outline, on one line or two, across or upright: as large as has room.
  void label(const Polygon& outline, const std::string& first, const std::string& second) {
    Vec2 least = outline.front(), most = outline.front();
    for (const Vec2& p : outline) least = least.cwiseMin(p), most = most.cwiseMax(p);
    const Vec2 middle = 0.5 * (least + most), size = kUnitsPerMetre * (most - least);
    if (!contains(outline, middle)) return;
    double best = 0;
    bool best_is_upright = false, best_has_two = false;
    for (const bool upright : {false, true})
      for (const bool two : {false, true}) {
        const std::size_t letters =
            two ? std::max(first.size(), second.size()) : first.size() + second.size() + 1;
        const double along = upright ? size.y() : size.x(), across = upright ? size.x() : size.y();
        const double font = std::min({kLargestFont, along / (kLetterWidth * static_cast<double>(letters)),
                                      across / (two ? 2.6 : 1.4)});
        if (font <= best) continue;
        best = font, best_is_upright = upright, best_has_two = two;
      }
    if (best < kSmallestFont) return;
    char font[160];
    std::snprintf(font, sizeof font,
                  "<g transform=\"translate(%s %s)%s\" text-anchor=\"middle\" font-size=\"%.1f\" "
                  "font-family=\"sans-serif\">",
                  number(middle.x()).c_str(), number(-middle.y()).c_str(),
                  best_is_upright ? " rotate(-90)" : "", best);
    const auto text = [&](const std::string& words, double down) {
      char y[32];
      std::snprintf(y, sizeof y, "%.1f", down * best);
      body_ += "<text y=\"" + std::string(y) + "\">" + escaped(words) + "</text>";
    };
    body_ += font;
    if (best_has_two)
      text(first, -0.15), text(second, 0.95);
    else
      text(second.empty() ? first : first + " " + second, 0.35);
    body_ += "</g>\n";
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

std::string derivation_svg(const FittedFloor& floor) {
  static constexpr const char* kFills[] = {"#a6cee3", "#fdbf6f", "#b2df8a", "#cab2d6", "#fb9a99",
                                           "#ffff99", "#d9d9d9", "#bc80bd", "#ccebc5", "#ffed6f"};
  Drawing drawing;
  for (const FittedRoom& hallway : floor.hallways) drawing.add(hallway.outline, "#f7f7f7");
  std::map<std::string, std::size_t> types;
  for (const FittedRoom& room : floor.rooms) {
    const std::size_t type = types.try_emplace(room.type, types.size()).first->second;
    drawing.add(room.outline, kFills[type % std::size(kFills)]);
  }
  for (const FittedRoom& room : floor.rooms)
    for (const FittedOpening& opening : room.openings) {
      const Vec2 across = opening.b - opening.a, inward(-across.y(), across.x());
      if (opening.kind == "door") {
        drawing.line(opening.a, opening.b, "white", 2.5);
        drawing.line(opening.a, opening.a + 0.8 * inward, "#777", 0.6);
      } else {
        drawing.line(opening.a, opening.b, "#1f78b4", 2.5);
      }
    }
  for (const FittedRoom& hallway : floor.hallways) drawing.label(hallway.outline, hallway.name, "");
  for (const FittedRoom& room : floor.rooms) {
    char width[32];
    std::snprintf(width, sizeof width, "%.2f", room.width_m);
    drawing.label(room.outline, room.type, width);
  }
  return drawing.text();
}

}  // namespace gramap
