#include "perception/observation.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/error.h"

namespace gramap {
namespace {

using Json = nlohmann::ordered_json;

/// Tenths of a millimetre are beyond any scan, and short numbers are easier to read and to compare.
double rounded(double value) {
  return std::round(value * 1e5) / 1e5;
}

template <typename Vector>
Json numbers(const Vector& v) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) list.push_back(rounded(v[i]));
  return list;
}

Json measured(const Measured& m) {
  return {{"value_m", rounded(m.value_m)}, {"sigma_m", rounded(m.sigma_m)}};
}

Json ring(const Polygon& polygon) {
  Json list = Json::array();
  for (const Vec2& p : polygon) list.push_back(numbers(p));
  return list;
}

/// Looks members up and says which one is missing or wrong.
class Reader {
 public:
  Reader(const Json& json, std::string path, const std::string& file)
      : json_(json), path_(std::move(path)), file_(file) {}

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError({file_}, "expected " + expected + " at '" + path_ + "'",
                     "write the file with gramap perceive");
  }
  Reader member(const char* key) const {
    if (!json_.is_object()) fail("an object");
    const auto found = json_.find(key);
    if (found == json_.end()) Reader(Json(), path_ + "/" + key, file_).fail("a member");
    return Reader(*found, path_ + "/" + key, file_);
  }
  std::vector<Reader> items() const {
    if (!json_.is_array()) fail("a list");
    std::vector<Reader> list;
    for (std::size_t i = 0; i < json_.size(); ++i)
      list.emplace_back(json_[i], path_ + "/" + std::to_string(i), file_);
    return list;
  }
  double number() const {
    if (!json_.is_number()) fail("a number");
    return json_.get<double>();
  }
  int integer() const {
    if (!json_.is_number_integer()) fail("a whole number");
    const auto value = json_.get<std::int64_t>();
    if (value < -2000000000 || value > 2000000000) fail("a whole number of nine digits at most");
    return static_cast<int>(value);
  }
  std::size_t count() const {
    if (!json_.is_number_unsigned()) fail("a whole number that is not negative");
    return json_.get<std::size_t>();
  }
  std::string text() const {
    if (!json_.is_string()) fail("a text");
    return json_.get<std::string>();
  }
  template <int N>
  Eigen::Matrix<double, N, 1> vector() const {
    const std::vector<Reader> list = items();
    if (list.size() != N) fail(std::to_string(N) + " numbers");
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) v[i] = list[static_cast<std::size_t>(i)].number();
    return v;
  }
  Polygon polygon() const {
    Polygon result;
    for (const Reader& item : items()) result.push_back(item.vector<2>());
    return result;
  }
  Measured measured() const { return {member("value_m").number(), member("sigma_m").number()}; }

 private:
  const Json& json_;
  std::string path_;
  const std::string& file_;
};

}  // namespace

std::string to_json(const RoomObservation& room) {
  Json json;
  json["gramap"] = "room observation 1";
  json["room"] = room.room;
  json["outline"] = ring(room.outline);
  json["walls"] = Json::array();
  for (const WallObservation& wall : room.walls)
    json["walls"].push_back({{"a", numbers(wall.a)},
                             {"b", numbers(wall.b)},
                             {"sigma_m", rounded(wall.sigma_m)},
                             {"seen_share", rounded(wall.seen_share)},
                             {"plane_rms_m", rounded(wall.plane_rms_m)},
                             {"support", wall.support}});
  json["floor_z_m"] = rounded(room.floor_z_m);
  json["ceiling_z_m"] = rounded(room.ceiling_z_m);
  json["height"] = measured(room.height);
  json["width"] = measured(room.width);
  json["depth"] = measured(room.depth);
  json["axis"] = Json::array({room.axis.x(), room.axis.y()});
  json["openings"] = Json::array();
  for (const OpeningObservation& opening : room.openings)
    json["openings"].push_back({{"kind", opening.kind},
                                {"wall", opening.wall},
                                {"start_m", rounded(opening.start_m)},
                                {"width_m", rounded(opening.width_m)},
                                {"sill_m", rounded(opening.sill_m)},
                                {"head_m", rounded(opening.head_m)},
                                {"confidence", rounded(opening.confidence)}});
  json["furniture"] = Json::array();
  for (const FurnitureObservation& item : room.furniture)
    json["furniture"].push_back({{"type", item.type},
                                 {"footprint", ring(item.footprint)},
                                 {"bottom_m", rounded(item.bottom_m)},
                                 {"top_m", rounded(item.top_m)},
                                 {"confidence", rounded(item.confidence)}});
  json["scanner_positions"] = Json::array();
  for (const Vec3& position : room.scanner_positions) json["scanner_positions"].push_back(numbers(position));
  json["points"] = room.points;
  json["remarks"] = room.remarks;
  return json.dump(1) + "\n";
}

RoomObservation observation_from_json(const std::string& text, const std::filesystem::path& name) {
  const std::string file = name.string();
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    int line = 1;
    for (std::size_t i = 0; i + 1 < error.byte && i < text.size(); ++i) line += text[i] == '\n';
    throw InputError({file, line}, "this is no JSON", "write the file with gramap perceive");
  } catch (const Json::out_of_range&) {
    throw InputError({file}, "a number in the file is too large", "write the file with gramap perceive");
  }
  const Reader all(json, "", file);
  if (all.member("gramap").text() != "room observation 1")
    throw InputError({file}, "this is no room observation of this version",
                     "write the file with gramap perceive");
  RoomObservation room;
  room.room = all.member("room").text();
  room.outline = all.member("outline").polygon();
  for (const Reader& item : all.member("walls").items())
    room.walls.push_back({item.member("a").vector<2>(), item.member("b").vector<2>(),
                          item.member("sigma_m").number(), item.member("seen_share").number(),
                          item.member("plane_rms_m").number(), item.member("support").integer()});
  if (room.walls.size() != room.outline.size())
    all.member("walls").fail("as many walls as the outline has corners");
  room.floor_z_m = all.member("floor_z_m").number();
  room.ceiling_z_m = all.member("ceiling_z_m").number();
  room.height = all.member("height").measured();
  room.width = all.member("width").measured();
  room.depth = all.member("depth").measured();
  room.axis = all.member("axis").vector<2>();
  for (const Reader& item : all.member("openings").items()) {
    room.openings.push_back({item.member("kind").text(), item.member("wall").integer(),
                             item.member("start_m").number(), item.member("width_m").number(),
                             item.member("sill_m").number(), item.member("head_m").number(),
                             item.member("confidence").number()});
    if (room.openings.back().wall < 0 || room.openings.back().wall >= static_cast<int>(room.walls.size()))
      item.member("wall").fail("the number of a wall");
  }
  for (const Reader& item : all.member("furniture").items())
    room.furniture.push_back({item.member("type").text(), item.member("footprint").polygon(),
                              item.member("bottom_m").number(), item.member("top_m").number(),
                              item.member("confidence").number()});
  for (const Reader& item : all.member("scanner_positions").items())
    room.scanner_positions.push_back(item.vector<3>());
  room.points = all.member("points").count();
  for (const Reader& item : all.member("remarks").items()) room.remarks.push_back(item.text());
  return room;
}

}  // namespace gramap
