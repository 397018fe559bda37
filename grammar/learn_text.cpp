// Learned rules as a file that a person reads and goes on with.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "grammar/format.h"
#include "grammar/learn.h"

namespace gramap {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

std::string number(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// 2.80 m; with millimetres only where they are needed.
std::string metres(double value_m) {
  const bool fine = std::abs(value_m * 100 - std::round(value_m * 100)) > 0.05;
  return number(value_m, fine ? 3 : 2) + " m";
}

std::string spread(double sd_m) {
  return " +- " + number(sd_m * 100, 0) + " cm";
}

std::string percent(double share) {
  const double value = 100 * share;
  return number(value, value < 0.095 ? 4 : value < 0.95 ? 2 : value < 9.5 ? 1 : 0) + " %";
}

std::string counted(double count, const std::string& one, const std::string& many) {
  return number(count, count == std::floor(count) ? 0 : 1) + " " + (count == 1 ? one : many);
}

/// Rules for rooms never seen that are used more rarely than this are left out.
constexpr double kLeastProbability = 0.0001;

/// The constants that the widths are written with.
std::string axes_name(int axes) {
  static const char* const words[] = {"", "one_axis", "two_axes", "three_axes", "four_axes", "five_axes"};
  return axes <= 5 ? words[axes] : "axes_" + std::to_string(axes);
}

std::string mean_text(const WidthClass& width) {
  if (width.axes == 0) return metres(width.mean_m);
  if (width.offset_m == 0) return axes_name(width.axes);
  return axes_name(width.axes) + (width.offset_m < 0 ? " - " : " + ") + metres(std::abs(width.offset_m));
}

std::string width_text(const WidthClass& width) {
  return mean_text(width) + spread(width.sd_m);
}

class Writer {
 public:
  explicit Writer(const LearnedRules& rules) : rules_(rules) {
    std::set<std::string> types;
    for (const LearnedType& type : rules.types) types.insert(type.name);
    while (types.contains(start_)) start_ += "_";
    while (types.contains(rest_)) rest_ += "_";
  }

  std::string write() {
    head();
    for (const LearnedType& type : rules_.types) room(type);
    text_ += "start " + start_ + ";\n";
    text_ +=
        "\n// A room that nothing below foresees, so that one unusual room never makes a space impossible.\n";
    text_ += "background " + percent(rules_.background) + " width " + metres(rules_.least_width_m) + " .. " +
             metres(rules_.most_width_m) + ";\n";
    rules();
    afters();
    return text_;
  }

 private:
  void head() {
    double rooms = 0;
    for (const KnownRow& row : rules_.data.rows) rooms += static_cast<double>(row.rooms.size());
    text_ += "// Learned from";
    for (std::size_t i = 0; i < rules_.data.sources.size(); ++i)
      text_ += (i == 0 ? " " : ", ") + rules_.data.sources[i];
    text_ += ": " + counted(static_cast<double>(rules_.data.rows.size()), "space", "spaces") + ", " +
             counted(rooms, "room", "rooms") + ".\n";
    text_ += "grammar " + rules_.options.name + ";\n\n";
    std::set<int> axes;
    for (const LearnedType& type : rules_.types)
      for (const WidthClass& width : type.widths) axes.insert(width.axes);
    axes.erase(0);
    if (!axes.empty()) {
      text_ +=
          "// The structural axis: from one inner wall's middle to another's lie whole numbers of it, to " +
          number(100 * rules_.axis_sd_m, 0) + " cm.\n";
      text_ += "let axis = " + metres(rules_.axis_m) + ";\n";
    }
    text_ += "let partition = " + metres(rules_.data.inner_wall_m) + ";\n";
    for (const int k : axes)
      text_ +=
          "let " + axes_name(k) + " = " + (k == 1 ? "" : std::to_string(k) + " * ") + "axis - partition;\n";
    text_ += "\nwall inner partition, outer " + metres(rules_.data.outer_wall_m) + ";\n";
    text_ += "height " + metres(rules_.data.height_m) + ";\n\n";
  }

  void room(const LearnedType& type) {
    text_ += "// " + counted(type.count, "room", "rooms") + ".\n";
    text_ += "room " + type.name + " {\n  width ";
    double total = 0;
    for (const WidthClass& width : type.widths) total += width.count;
    for (std::size_t i = 0; i < type.widths.size(); ++i) {
      if (i > 0) text_ += " or ";
      text_ += width_text(type.widths[i]);
      if (type.widths.size() > 1) text_ += " : " + percent(type.widths[i].count / total);
    }
    text_ += ";\n";
    if (type.depth_mean_m > 0)
      text_ +=
          "  depth " + metres(std::round(100 * type.depth_mean_m) / 100) + spread(type.depth_sd_m) + ";\n";
    if (type.door) door(*type.door);
    if (type.windows)
      text_ += "  windows " + number(type.windows->width_m, 2) + " x " + metres(type.windows->height_m) +
               " sill " + metres(type.windows->sill_m) + " every " + metres(type.windows->spacing_m) + ";\n";
    if (!type.furniture.empty()) {
      std::map<std::string, int> counts;
      for (const std::string& piece : type.furniture) ++counts[piece];
      text_ += "  furniture ";
      bool first = true;
      for (const auto& [piece, count] : counts) {
        text_ += (first ? "" : ", ") + (count > 1 ? std::to_string(count) + " " : "") + piece;
        first = false;
      }
      text_ += ";\n";
    }
    text_ += "}\n\n";
  }

  void door(const LearnedDoor& door) {
    text_ += "  door " + number(door.width_m, 2) + " x " + metres(door.height_m);
    for (std::size_t i = 0; i < door.places.size(); ++i) {
      const LearnedDoor::Place& place = door.places[i];
      text_ += i == 0 ? " at " : " or ";
      text_ += metres(std::round(100 * place.mean_m) / 100) + spread(place.sd_m) +
               (place.from_end ? " from end" : "");
      if (door.places.size() > 1) text_ += " : " + percent(place.share);
    }
    text_ += ";\n";
  }

  /// A class as a piece of a body: by its type's name alone when the type has this one width only.
  bool is_plain(int index) const {
    return rules_.types[at(rules_.classes[at(index)].type)].widths.size() == 1;
  }
  std::string piece(int index) const {
    const WidthClass& width = rules_.classes[at(index)];
    const std::string& name = rules_.types[at(width.type)].name;
    return is_plain(index) ? name : width_text(width) + " : " + name;
  }

  std::string body(const LearnedRule& rule) const {
    if (rule.other_width)
      return "split x { " + width_text(*rule.other_width) + " : " + rules_.types[at(rule.any_type)].name +
             ", ~ : " + rest_ + " }";
    if (rule.any_type >= 0) return rules_.types[at(rule.any_type)].name + " " + rest_;
    std::string pieces;
    bool plain = true;
    for (const int index : rule.classes) {
      pieces += (pieces.empty() ? "" : ", ") + piece(index);
      plain = plain && is_plain(index);
    }
    if (rule.most > 0)
      return "repeat " + std::to_string(rule.least) + ".." + std::to_string(rule.most) + " { " + pieces +
             " } " + rest_;
    if (plain && rule.classes.size() == 1) return pieces + (rule.last_only ? "" : " " + rest_);
    if (plain && !rule.last_only) return "string { " + pieces + " } " + rest_;
    return "split x { " + pieces + (rule.last_only ? "" : ", ~ : " + rest_) + " }";
  }

  void rules() {
    for (const bool first : {true, false}) {
      text_ += first ? "\n// The first room of a space; the number behind // is how often it was seen.\n"
                     : "\n// What follows, from room to room, until the space is full.\n";
      for (const LearnedRule& rule : rules_.rules) {
        if (rule.first != first || rule.probability < (rule.any_type < 0 ? 0 : kLeastProbability)) continue;
        const std::string& symbol = first ? start_ : rest_;
        text_ += rule.name + ": " + symbol + (rule.last_only ? " > |" : "") + " -> " + body(rule) + " : " +
                 percent(rule.probability) + ";";
        if (rule.any_type < 0)
          text_ += "  // " + number(rule.count, rule.count == std::floor(rule.count) ? 0 : 1);
        text_ += "\n";
      }
    }
  }

  void afters() {
    bool first = true;
    for (const LearnedRule& rule : rules_.rules) {
      if (rule.after.empty()) continue;
      if (first) text_ += "\n// What follows what, where it matters.\n";
      first = false;
      double others = 1;
      text_ += "after " + rule.name + " { ";
      for (const auto& [next, share] : rule.after) {
        text_ += rules_.rules[at(next)].name + " " + percent(share) + ", ";
        others -= share;
      }
      text_ += "others " + percent(std::max(0.001, others)) + " }\n";
    }
  }

  const LearnedRules& rules_;
  std::string start_ = "Space";
  std::string rest_ = "Rest";
  std::string text_;
};

}  // namespace

std::string to_text(const LearnedRules& rules) {
  const std::string text = Writer(rules).write();
  return format_rules(text).text.value_or(text);
}

}  // namespace gramap
