#include <cmath>

#include "grammar/resolve.h"

namespace gramap {
namespace {

/// Weights of values joined by `or`: all given or none; scaled to sum to 1.
std::vector<double> weights(Resolver& r, const std::vector<syntax::Alternative>& alternatives) {
  std::vector<double> result;
  double sum = 0;
  bool sound = true;
  for (const syntax::Alternative& alternative : alternatives) {
    const bool given = alternative.weight.has_value();
    if (given != alternatives[0].weight.has_value()) {
      r.error("E0403", alternative.span, "of several values joined by `or`, all have a probability or none",
              "write `: 50 %` behind each, or behind none");
      return std::vector<double>(alternatives.size(), 1.0);
    }
    const std::optional<double> weight =
        given ? r.quantities.weight(*alternative.weight) : std::optional(1.0);
    sound = sound && weight.has_value();
    result.push_back(weight.value_or(1));
    sum += result.back();
  }
  if (sound && !(sum > 0)) {
    r.error("E0402", alternatives[0].weight->span,
            "these probabilities are all zero, so none of the values can be chosen",
            "give at least one a probability above zero");
    sum = 0;
  }
  for (double& weight : result) weight = sum > 0 ? weight / sum : 1;
  return result;
}

void resolve_width(Resolver& r, const syntax::RoomItem& item, RoomType& room) {
  const std::vector<double> share = weights(r, item.alternatives);
  for (std::size_t i = 0; i < item.alternatives.size(); ++i) {
    const syntax::Alternative& alternative = item.alternatives[i];
    if (alternative.from_end)
      r.error("E0104", alternative.span, "`from` belongs to a door's place, not to a width", "remove it");
    if (const auto normal = r.quantities.normal(alternative.quantity, "a width"))
      if (share[i] > 0) room.width.components.push_back({share[i], *normal});
  }
}

void resolve_door(Resolver& r, const syntax::RoomItem& item, RoomType& room) {
  DoorHabit door;
  r.quantities.expect_same_unit(item.sizes[0], item.sizes[1]);
  door.width_m = r.quantities.positive_length(item.sizes[0], "a door's width").value_or(1);
  door.height_m = r.quantities.positive_length(item.sizes[1], "a door's height").value_or(2);
  const std::vector<double> share =
      item.alternatives.empty() ? std::vector<double>() : weights(r, item.alternatives);
  for (std::size_t i = 0; i < item.alternatives.size(); ++i) {
    const syntax::Alternative& place = item.alternatives[i];
    const std::optional<double> mean = r.quantities.length(place.quantity.mean);
    const std::optional<double> sd =
        place.quantity.sd ? r.quantities.length(*place.quantity.sd) : std::optional(0.0);
    if (!mean || !sd || share[i] == 0) continue;
    if (*mean < 0 || *sd < 0)
      r.error("E0306", place.quantity.span, "a door's distance from the wall cannot be negative",
              "write `from end` to measure from the room's other end");
    else
      door.places.push_back({share[i], {*mean, *sd}, place.from_end});
  }
  room.door = door;
}

void resolve_windows(Resolver& r, const syntax::RoomItem& item, RoomType& room) {
  WindowHabit windows;
  r.quantities.expect_same_unit(item.sizes[0], item.sizes[1]);
  windows.width_m = r.quantities.positive_length(item.sizes[0], "a window's width").value_or(1);
  windows.height_m = r.quantities.positive_length(item.sizes[1], "a window's height").value_or(1);
  const std::optional<double> sill = r.quantities.length(item.sizes[2]);
  const std::optional<double> spacing =
      r.quantities.positive_length(item.sizes[3], "the distance between windows");
  if (sill && *sill < 0) r.error("E0306", item.sizes[2].span, "a sill's height cannot be negative");
  windows.sill_m = sill.value_or(0);
  windows.spacing_m = spacing.value_or(2);
  if (spacing && windows.spacing_m <= windows.width_m)
    r.error("E0309", item.sizes[3].span,
            "windows this close together would overlap: `every` is the distance from centre to centre",
            "make it greater than the windows' width");
  room.windows.push_back(windows);
}

void resolve_furniture(Resolver& r, const syntax::RoomItem& item, RoomType& room) {
  for (const syntax::Furniture& furniture : item.furniture) {
    const std::optional<Value> count =
        furniture.count ? r.quantities.evaluate(*furniture.count) : Value{Value::Kind::plain, 1};
    if (!count) continue;
    if (count->kind != Value::Kind::plain || count->number != std::floor(count->number) ||
        count->number < 1 || count->number > 100) {
      r.error("E0310", furniture.count->span, "a number of pieces is a whole number from 1 to 100",
              "write `2 " + furniture.name.text + "`");
      continue;
    }
    room.furniture.insert(room.furniture.end(), static_cast<std::size_t>(count->number), furniture.name.text);
  }
}

}  // namespace

void resolve_rooms(Resolver& r) {
  for (const syntax::Room& source : r.file.rooms) {
    RoomType room;
    room.name = source.name.text;
    std::map<std::string, Span> seen;
    for (const syntax::RoomItem& item : source.items) {
      const auto [it, fresh] = seen.try_emplace(item.word.text, item.word.span);
      if (!fresh && item.word.text != "windows") {
        r.error("E0203", item.word.span, "the room `" + room.name + "` has a second `" + item.word.text + "`",
                item.word.text == "width" ? "join several widths by `or`" : "keep one of them")
            .labels.push_back({it->second, "the first one"});
        continue;
      }
      r.said.emplace(room.name, item.word.text);
      if (item.word.text == "width") resolve_width(r, item, room);
      if (item.word.text == "depth") room.depth = r.quantities.normal(*item.quantity, "a depth");
      if (item.word.text == "door") resolve_door(r, item, room);
      if (item.word.text == "windows") resolve_windows(r, item, room);
      if (item.word.text == "furniture") resolve_furniture(r, item, room);
    }
    if (room.name == "Unknown")
      r.error("E0206", source.name.span, "`Unknown` is the name of the room that `background` stands for",
              "choose another name");
    const auto [it, fresh] = r.defined.try_emplace(room.name, source.name.span);
    if (!fresh) {
      r.error("E0203", source.name.span, "the room `" + room.name + "` is defined twice",
              "give one of them another name")
          .labels.push_back({it->second, "first defined here"});
      continue;
    }
    r.rooms[room.name] = static_cast<int>(r.rules.rooms.size());
    r.rules.rooms.push_back(std::move(room));
  }
}

}  // namespace gramap
