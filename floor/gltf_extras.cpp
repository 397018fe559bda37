#include "floor/gltf_extras.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace gramap {
namespace {

using json = nlohmann::json;
using ordered = nlohmann::ordered_json;

ordered points(const Polygon& ring) {
  ordered array = ordered::array();
  for (const Vec2& p : ring) array.push_back({p.x(), p.y()});
  return array;
}

const json& member(const json& object, const char* key) {
  static const json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

double number(const json& object, const char* key, double otherwise = 0) {
  const json& value = member(object, key);
  return value.is_number() && std::isfinite(value.get<double>()) ? value.get<double>() : otherwise;
}

std::optional<double> optional_number(const json& object, const char* key) {
  if (!member(object, key).is_number()) return std::nullopt;
  return number(object, key);
}

Origin origin_of(const json& about) {
  const std::string origin = text(about, "origin");
  return origin == to_string(Origin::observed) ? Origin::observed
         : origin == to_string(Origin::given)  ? Origin::given
                                               : Origin::derived;
}

template <typename Use>
void each(const json& array, Use use) {
  if (array.is_array())
    for (const json& item : array) use(item);
}

std::vector<std::string> texts(const json& array) {
  std::vector<std::string> list;
  each(array, [&list](const json& item) {
    if (item.is_string()) list.push_back(item.get<std::string>());
  });
  return list;
}

FittedRoom room_of(const json& about, const std::string& name) {
  FittedRoom room;
  room.id = text(about, "id");
  room.name = name == room.id ? "" : name;
  room.type = text(about, "type");
  room.origin = origin_of(about);
  room.outline = plan_points(member(about, "outline"));
  room.space = text(about, "space");
  room.start_m = number(about, "start");
  room.width_m = number(about, "width");
  room.width_sigma_m = number(about, "width_sigma");
  room.start_sigma_m = number(about, "start_sigma");
  room.end_sigma_m = number(about, "end_sigma");
  room.depth_m = number(about, "depth");
  room.height_m = number(about, "height");
  room.extracted_width_m = optional_number(about, "extracted_width");
  room.extracted_sigma_m = optional_number(about, "extracted_sigma");
  room.type_probability = number(about, "type_probability", 1);
  room.room_probability = number(about, "room_probability", 1);
  room.rule = text(about, "rule");
  room.rule_path = texts(member(about, "rule_path"));
  room.scans = texts(member(about, "scans"));
  return room;
}

FittedRoom* room_named(FittedFloor& floor, const std::string& id) {
  for (std::vector<FittedRoom>* rooms : {&floor.rooms, &floor.hallways, &floor.fixed})
    for (FittedRoom& room : *rooms)
      if (room.id == id) return &room;
  return nullptr;
}

}  // namespace

std::string text(const json& object, const char* key) {
  const json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::vector<Vec2> plan_points(const json& array) {
  std::vector<Vec2> list;
  each(array, [&list](const json& item) {
    if (item.is_array() && item.size() == 2 && item[0].is_number() && item[1].is_number())
      list.emplace_back(item[0].get<double>(), item[1].get<double>());
  });
  return list;
}

ordered extras_of_floor(const FittedFloor& floor) {
  ordered about = {{"kind", "floor"},
                   {"id", floor.floor.name.empty() ? "floor" : floor.floor.name},
                   {"type", "Floor"},
                   {"origin", "given"},
                   {"elevation", floor.floor.elevation_m},
                   {"height", floor.height_m},
                   {"inner_wall", floor.inner_wall_m},
                   {"outer_wall", floor.outer_wall_m}};
  about["given_outline"] = points(floor.floor.outline);
  about["courtyards"] = ordered::array();
  for (const Polygon& ring : floor.floor.courtyards) about["courtyards"].push_back(points(ring));
  if (floor.floor.origin)
    about["origin_degrees"] = {floor.floor.origin->longitude_deg, floor.floor.origin->latitude_deg};
  about["spaces"] = ordered::array();
  for (const Space& space : floor.floor.spaces) {
    ordered said = {{"id", space.id},
                    {"hallway", space.hallway},
                    {"outline", points(space.outline)},
                    {"line", points({space.start, space.end})}};
    for (const FittedSpace& fitted : floor.spaces) {
      if (fitted.id != space.id) continue;
      said["length"] = fitted.length_m;
      said["score"] = fitted.score;
      said["probability"] = fitted.probability;
      said["alternatives"] = ordered::array();
      for (const auto& other : fitted.alternatives)
        said["alternatives"].push_back({{"score", other.score},
                                        {"probability", other.probability},
                                        {"types", other.types},
                                        {"widths", other.widths_m}});
    }
    about["spaces"].push_back(std::move(said));
  }
  about["pins"] = ordered::array();
  for (const Pin& pin : floor.floor.pins)
    about["pins"].push_back({{"room", pin.room}, {"at", {pin.at.x(), pin.at.y()}}, {"sigma", pin.sigma_m}});
  about["set_aside"] = ordered::array();
  for (const SetAsideInput& aside : floor.set_aside)
    about["set_aside"].push_back({{"what", aside.what}, {"reason", aside.reason}});
  return about;
}

ordered extras_of_room(const FittedRoom& room, const char* kind) {
  ordered about = {{"kind", kind},
                   {"id", room.id},
                   {"type", room.type},
                   {"origin", to_string(room.origin)},
                   {"width", room.width_m},
                   {"depth", room.depth_m},
                   {"height", room.height_m},
                   {"width_sigma", room.width_sigma_m},
                   {"type_probability", room.type_probability},
                   {"room_probability", room.room_probability},
                   {"rule", room.rule},
                   {"outline", points(room.outline)}};
  if (!room.space.empty()) {
    about["space"] = room.space;
    about["start"] = room.start_m;
    about["start_sigma"] = room.start_sigma_m;
    about["end_sigma"] = room.end_sigma_m;
  }
  if (room.extracted_width_m) about["extracted_width"] = *room.extracted_width_m;
  if (room.extracted_sigma_m) about["extracted_sigma"] = *room.extracted_sigma_m;
  if (!room.rule_path.empty()) about["rule_path"] = room.rule_path;
  if (!room.scans.empty()) about["scans"] = room.scans;
  return about;
}

ordered extras_of_opening(const FittedOpening& opening, const std::string& room) {
  return {{"kind", opening.kind},
          {"type", opening.kind},
          {"origin", to_string(opening.origin)},
          {"room", room},
          {"width", (opening.b - opening.a).norm()},
          {"sill", opening.sill_m},
          {"head", opening.head_m},
          {"confidence", opening.confidence},
          {"line", points({opening.a, opening.b})}};
}

ordered extras_of_furniture(const FittedFurniture& piece, const std::string& room) {
  return {{"kind", "furniture"},
          {"type", piece.type},
          {"class", piece.type},
          {"origin", to_string(piece.origin)},
          {"room", room},
          {"outline", points(piece.outline)},
          {"bottom", piece.bottom_m},
          {"top", piece.top_m},
          {"confidence", piece.confidence}};
}

FittedFloor floor_of_extras(const json& about) {
  FittedFloor floor;
  floor.floor.name = text(about, "id");
  floor.floor.elevation_m = number(about, "elevation");
  floor.height_m = number(about, "height");
  floor.inner_wall_m = number(about, "inner_wall");
  floor.outer_wall_m = number(about, "outer_wall");
  floor.floor.ceiling_height_m = floor.height_m;
  floor.floor.inner_wall_m = floor.inner_wall_m;
  floor.floor.outer_wall_m = floor.outer_wall_m;
  floor.floor.outline = plan_points(member(about, "given_outline"));
  each(member(about, "courtyards"),
       [&floor](const json& ring) { floor.floor.courtyards.push_back(plan_points(ring)); });
  const std::vector<Vec2> degrees = plan_points(json::array({member(about, "origin_degrees")}));
  if (degrees.size() == 1) {
    floor.floor.origin.emplace();
    floor.floor.origin->longitude_deg = degrees[0].x();
    floor.floor.origin->latitude_deg = degrees[0].y();
  }
  each(member(about, "spaces"), [&floor](const json& said) {
    const std::vector<Vec2> line = plan_points(member(said, "line"));
    if (line.size() != 2) return;
    floor.floor.spaces.push_back(
        {text(said, "id"), text(said, "hallway"), plan_points(member(said, "outline")), line[0], line[1]});
    if (!member(said, "length").is_number()) return;
    FittedSpace space;
    space.id = text(said, "id");
    space.length_m = number(said, "length");
    space.score = number(said, "score");
    space.probability = number(said, "probability");
    each(member(said, "alternatives"), [&space](const json& other) {
      FittedSpace::Alternative alternative{
          number(other, "score"), number(other, "probability"), texts(member(other, "types")), {}};
      each(member(other, "widths"), [&alternative](const json& width) {
        if (width.is_number()) alternative.widths_m.push_back(width.get<double>());
      });
      space.alternatives.push_back(std::move(alternative));
    });
    floor.spaces.push_back(std::move(space));
  });
  each(member(about, "pins"), [&floor](const json& pin) {
    const std::vector<Vec2> at = plan_points(json::array({member(pin, "at")}));
    if (at.size() == 1 && number(pin, "sigma") > 0)
      floor.floor.pins.push_back({text(pin, "room"), at[0], number(pin, "sigma")});
  });
  each(member(about, "set_aside"), [&floor](const json& aside) {
    floor.set_aside.push_back({text(aside, "what"), text(aside, "reason")});
  });
  return floor;
}

void add_extras(FittedFloor& floor, const json& about, const std::string& name) {
  const std::string kind = text(about, "kind");
  if (kind == "room") {
    floor.rooms.push_back(room_of(about, name));
  } else if (kind == "hallway") {
    floor.hallways.push_back(room_of(about, name));
    floor.floor.hallways.push_back(
        {floor.hallways.back().id, floor.hallways.back().name, floor.hallways.back().outline});
  } else if (kind == "fixed") {
    floor.fixed.push_back(room_of(about, name));
    const FittedRoom& room = floor.fixed.back();
    floor.floor.fixed.push_back({room.id, room.type, room.name, room.outline});
  } else if (kind == "door" || kind == "window") {
    FittedRoom* room = room_named(floor, text(about, "room"));
    const std::vector<Vec2> line = plan_points(member(about, "line"));
    if (room != nullptr && line.size() == 2)
      room->openings.push_back({kind, origin_of(about), line[0], line[1], number(about, "sill"),
                                number(about, "head"), number(about, "confidence", 1)});
  } else if (kind == "furniture") {
    if (FittedRoom* room = room_named(floor, text(about, "room")))
      room->furniture.push_back({text(about, "class"), origin_of(about),
                                 plan_points(member(about, "outline")), number(about, "bottom"),
                                 number(about, "top"), number(about, "confidence", 1)});
  }
}

}  // namespace gramap
