// An evaluation for people (text), for programs (JSON), and for the eye (HTML with the plan).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "floor/evaluate.h"
#include "geometry/say.h"

namespace gramap {
namespace {

using json = nlohmann::ordered_json;

template <class... Values>
std::string print(const char* format, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string optional_length(const std::optional<double>& value) {
  return value ? print("%8.3f", *value) : std::string("       -");
}

const char* or_dash(const std::string& text) {
  return text.empty() ? "-" : text.c_str();
}

std::string summary_line(const char* what, const ErrorSummary& s) {
  if (s.count == 0) return print("  %-34s none\n", what);
  return print(
      "  %-34s %4d   mean %6.3f   median %6.3f   rms %6.3f   worst %6.3f   <=2 cm %3.0f %%   <=10 cm %3.0f "
      "%%\n",
      what, s.count, s.mean_abs_m, s.median_abs_m, s.rms_m, s.worst_m, 100 * s.within_2cm,
      100 * s.within_10cm);
}

std::string detection_line(const std::string& what, const DetectionScore& s) {
  return print("  %-34s recall %5.3f (%d of %d)   precision %5.3f (%d of %d)\n", what.c_str(), s.recall(),
               s.matched, s.truth, s.precision(), s.matched, s.model);
}

double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

json summary_json(const ErrorSummary& s) {
  return {{"count", s.count},
          {"mean_abs", rounded(s.mean_abs_m)},
          {"median_abs", rounded(s.median_abs_m)},
          {"rms", rounded(s.rms_m)},
          {"worst", rounded(s.worst_m)},
          {"within_2cm", rounded(s.within_2cm)},
          {"within_10cm", rounded(s.within_10cm)}};
}

json detection_json(const DetectionScore& s) {
  return {{"kind", s.kind},   {"matched", s.matched},          {"truth", s.truth},
          {"model", s.model}, {"recall", rounded(s.recall())}, {"precision", rounded(s.precision())}};
}

json wall_json(const WallScore& s) {
  return {{"buffer", s.buffer_m},
          {"completeness", rounded(s.completeness)},
          {"correctness", rounded(s.correctness)}};
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

/// From green (no error) over yellow (10 cm) to red (30 cm and more); violet for what does not exist, grey
/// for what is missing.
std::string colour(const RoomScore& room) {
  if (room.id.empty()) return "#bbbbbb";
  if (room.true_id.empty()) return "#b388eb";
  const double share = std::min(1.0, std::abs(room.error_m()) / 0.3);
  return print("hsl(%.0f 70%% 70%%)", 120 * (1 - share));
}

std::string plan_svg(const Evaluation& evaluation) {
  Vec2 least = Vec2::Constant(1e300), most = Vec2::Constant(-1e300);
  for (const RoomScore& room : evaluation.rooms)
    for (const Vec2& point : room.outline) least = least.cwiseMin(point), most = most.cwiseMax(point);
  if (least.x() > most.x()) return "";
  const Vec2 size = most - least;
  std::string svg = print("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-0.5 -0.5 %.2f %.2f\">\n",
                          size.x() + 1, size.y() + 1);
  for (const RoomScore& room : evaluation.rooms) {
    std::string points;
    Vec2 middle = Vec2::Zero();
    for (const Vec2& point : room.outline) {
      points += print("%.3f,%.3f ", point.x() - least.x(), most.y() - point.y());
      middle += Vec2(point.x() - least.x(), most.y() - point.y()) / static_cast<double>(room.outline.size());
    }
    const std::string name = room.id.empty() ? room.true_id : room.id;
    const std::string title =
        room.matched()
            ? print("%s: width %.3f m, true %.3f m, error %+.3f m, sigma %.3f m, IoU %.2f", or_dash(name),
                    room.width_m, room.true_width_m, room.error_m(), room.sigma_m, room.iou)
            : name + (room.id.empty() ? ": missing in the model" : ": does not exist");
    svg += "<g><title>" + escaped(title) + "</title><polygon points=\"" + points + "\" fill=\"" +
           colour(room) + "\" stroke=\"#333\" stroke-width=\"0.04\"" +
           (room.origin == Origin::derived ? " stroke-dasharray=\"0.2 0.12\"" : "") + "/>";
    svg += print("<text x=\"%.2f\" y=\"%.2f\" font-size=\"0.55\" text-anchor=\"middle\">", middle.x(),
                 middle.y()) +
           escaped(name) + "</text>";
    if (room.matched())
      svg += print("<text x=\"%.2f\" y=\"%.2f\" font-size=\"0.45\" text-anchor=\"middle\">%+.1f cm</text>",
                   middle.x(), middle.y() + 0.6, 100 * room.error_m());
    svg += "</g>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace

std::string to_text(const Evaluation& evaluation) {
  std::string text = print("%-14s %-10s %-10s %-9s %8s %8s %8s %8s %7s %5s\n", "room", "true room", "type",
                           "origin", "extract.", "width", "true", "error", "sigma", "IoU");
  for (const RoomScore& room : evaluation.rooms) {
    text += print("%-14s %-10s %-10s %-9s ", or_dash(room.id), or_dash(room.true_id),
                  or_dash(room.id.empty() ? room.true_type : room.type),
                  room.id.empty() ? "missing" : to_string(room.origin));
    text += optional_length(room.extracted_width_m);
    if (room.matched())
      text += print(" %8.3f %8.3f %+8.3f %7.3f %5.2f\n", room.width_m, room.true_width_m, room.error_m(),
                    room.sigma_m, room.iou);
    else if (room.id.empty())
      text += print(" %8s %8.3f\n", "-", room.true_width_m);
    else
      text += print(" %8.3f %8s %8s %7.3f\n", room.width_m, "-", "-", room.sigma_m);
  }
  text += "\nspaces\n";
  for (const SpaceScore& space : evaluation.spaces)
    text += print("  %-34s %d of %s%s\n", or_dash(space.id), space.rooms,
                  said_count(static_cast<std::size_t>(space.true_rooms), "room").c_str(),
                  space.in_order ? ", all in order" : ", not all in place");
  text += "widths, metres\n";
  text += summary_line("extracted, before the grammar", evaluation.extracted);
  text += summary_line("observed rooms, after the grammar", evaluation.observed);
  text += summary_line("derived rooms", evaluation.derived);
  text += "walls\n";
  for (std::size_t i = 0; i < evaluation.walls.size(); ++i)
    text += print("  buffer %2.0f cm: completeness %5.3f  correctness %5.3f   observed rooms: %5.3f  %5.3f\n",
                  100 * evaluation.walls[i].buffer_m, evaluation.walls[i].completeness,
                  evaluation.walls[i].correctness, evaluation.observed_walls[i].completeness,
                  evaluation.observed_walls[i].correctness);
  text += print("  median distance of found walls %.3f m\n", evaluation.wall_median_m);
  text += "openings and furniture (IoU >= 0.5)\n";
  for (const DetectionScore& score : evaluation.openings)
    text += detection_line(score.kind + "s, all rooms", score);
  for (const DetectionScore& score : evaluation.observed_openings)
    text += detection_line(score.kind + "s, seen in scans", score);
  for (const DetectionScore& score : evaluation.furniture)
    text += detection_line("furniture: " + score.kind, score);
  text += print("  furniture class right %.3f\n", evaluation.furniture_class_right);
  text += print("calibration: true width within 1 sigma %.0f %%, 2 sigma %.0f %%, 3 sigma %.0f %%\n",
                100 * evaluation.within_1_sigma, 100 * evaluation.within_2_sigma,
                100 * evaluation.within_3_sigma);
  for (const ReliabilityBin& bin : evaluation.reliability)
    if (bin.count > 0)
      text += print("  rooms called %.2f to %.2f sure: %d, right %.0f %% (said: %.0f %%)\n", bin.least,
                    bin.most, bin.count, 100.0 * bin.right / bin.count, 100 * bin.mean_probability);
  return text;
}

std::string to_json(const Evaluation& evaluation) {
  json root;
  for (const RoomScore& room : evaluation.rooms) {
    json item = {{"room", room.id},   {"true_room", room.true_id},   {"space", room.space},
                 {"type", room.type}, {"true_type", room.true_type}, {"origin", to_string(room.origin)}};
    if (room.extracted_width_m) item["extracted_width"] = rounded(*room.extracted_width_m);
    if (!room.id.empty()) item["width"] = rounded(room.width_m), item["sigma"] = rounded(room.sigma_m);
    if (!room.true_id.empty()) item["true_width"] = rounded(room.true_width_m);
    if (room.matched()) item["error"] = rounded(room.error_m()), item["iou"] = rounded(room.iou);
    root["rooms"].push_back(item);
  }
  for (const SpaceScore& space : evaluation.spaces)
    root["spaces"].push_back({{"id", space.id},
                              {"rooms", space.rooms},
                              {"true_rooms", space.true_rooms},
                              {"in_order", space.in_order}});
  root["widths"] = {{"extracted", summary_json(evaluation.extracted)},
                    {"observed", summary_json(evaluation.observed)},
                    {"derived", summary_json(evaluation.derived)}};
  for (const WallScore& score : evaluation.walls) root["walls"]["all"].push_back(wall_json(score));
  for (const WallScore& score : evaluation.observed_walls)
    root["walls"]["observed"].push_back(wall_json(score));
  root["walls"]["median_distance"] = rounded(evaluation.wall_median_m);
  for (const DetectionScore& score : evaluation.openings)
    root["openings"]["all"].push_back(detection_json(score));
  for (const DetectionScore& score : evaluation.observed_openings)
    root["openings"]["observed"].push_back(detection_json(score));
  for (const DetectionScore& score : evaluation.furniture)
    root["furniture"]["classes"].push_back(detection_json(score));
  root["furniture"]["class_right"] = rounded(evaluation.furniture_class_right);
  root["calibration"] = {{"within_1_sigma", rounded(evaluation.within_1_sigma)},
                         {"within_2_sigma", rounded(evaluation.within_2_sigma)},
                         {"within_3_sigma", rounded(evaluation.within_3_sigma)}};
  for (const ReliabilityBin& bin : evaluation.reliability)
    root["calibration"]["reliability"].push_back({{"least", bin.least},
                                                  {"most", bin.most},
                                                  {"count", bin.count},
                                                  {"right", bin.right},
                                                  {"mean_probability", rounded(bin.mean_probability)}});
  return root.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string to_html(const Evaluation& evaluation, const std::string& title) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title) +
      "</title>\n<style>body{font-family:sans-serif;margin:2em;max-width:1400px}svg{width:100%;"
      "max-height:70vh}pre{font-size:90%;overflow-x:auto}.key span{padding:0 .6em;margin-right:1em}"
      "</style></head><body>\n<h1>" +
      escaped(title) + "</h1>\n";
  html +=
      "<p class=\"key\"><span style=\"background:hsl(120 70% 70%)\">width right</span>"
      "<span style=\"background:hsl(80 70% 70%)\">10 cm off</span>"
      "<span style=\"background:hsl(0 70% 70%)\">30 cm off or more</span>"
      "<span style=\"background:#b388eb\">does not exist</span><span style=\"background:#bbb\">missing</span>"
      "dashed: derived, nobody scanned it</p>\n";
  html += plan_svg(evaluation);
  html += "<pre>\n" + escaped(to_text(evaluation)) + "</pre>\n</body></html>\n";
  return html;
}

}  // namespace gramap
