// Zip archives: what was packed comes out, an IMDF archive is read as its folder would be, and what is
// damaged is refused.
#include "floor/zip.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <random>
#include <utility>
#include <vector>

#include "floor/read_indoor.h"
#include "geometry/error.h"
#include "tests/floor/drawn_plan.h"
#include "tests/floor/temporary_file.h"

using namespace gramap;
using test::DrawnPlan;

namespace {

std::string little(unsigned long value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string deflated(const std::string& text) {
  std::string packed(text.size() + 100, '\0');
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// A zip archive: the first file stored, the others deflated; a comment at its end.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& files, unsigned long flags = 0) {
  std::string all, directory;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [name, text] = files[i];
    const std::string packed = i == 0 ? text : deflated(text);
    const unsigned long checksum =
        crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    const std::string common = little(20, 2) + little(flags, 2) + little(i == 0 ? 0 : 8, 2) + little(0, 4) +
                               little(checksum, 4) + little(packed.size(), 4) + little(text.size(), 4) +
                               little(name.size(), 2) + little(0, 2);
    directory += "PK\x01\x02" + little(20, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(0, 4) + little(all.size(), 4) + name;
    all += "PK\x03\x04" + common + name + packed;
  }
  return all + directory + "PK\x05\x06" + little(0, 4) + little(files.size(), 2) + little(files.size(), 2) +
         little(directory.size(), 4) + little(all.size(), 4) + little(5, 2) + "hello";
}

bool any(const std::string&) {
  return true;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_zip(path, any);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string unit(const std::string& id, const std::string& category, const std::string& geometry) {
  return R"({"type":"Feature","id":")" + id +
         R"(","feature_type":"unit","properties":{"level_id":"L","category":")" + category + "\"}," +
         geometry + "}";
}

}  // namespace

TEST_CASE("files come out of a zip archive as they were, stored and deflated, large and empty") {
  const test::TemporaryFolder folder;
  std::string large;
  for (int i = 0; i < 20000; ++i) large += std::to_string(i) + ",";
  const auto path = folder.write("a.zip", zipped({{"first", "stored"}, {"in/second", large}, {"third", ""}}));
  const auto files = read_zip(path, any);
  REQUIRE(files.size() == 3);
  CHECK(files.at("first") == "stored");
  CHECK(files.at("in/second") == large);
  CHECK(files.at("third").empty());
  CHECK(read_zip(path, [](const std::string& name) { return name == "first"; }).size() == 1);
}

TEST_CASE("zip archives that are cut off, damaged or encrypted are refused") {
  const test::TemporaryFolder folder;
  const std::string good = zipped({{"first", "stored"}, {"second", std::string(1000, 'x')}});
  const auto refused = [&](std::string bytes) { return refusal(folder.write("a.zip", std::move(bytes))); };
  CHECK(refused(good).empty());
  CHECK(refused(good.substr(0, good.size() - 20)) == "the zip archive has no directory");
  CHECK(refused(good.substr(40)) != "");
  std::string other = good;
  other[other.find("stored")] = 'S';
  CHECK(refused(other) == "'first' is damaged");
  CHECK(refused(zipped({{"first", "stored"}}, 1)) == "'first' is encrypted");
  // Any bytes changed: read, or refused, never more.
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string spoilt = good;
    for (int k = 0; k < 3; ++k) spoilt[random() % spoilt.size()] = static_cast<char>(random());
    refused(std::move(spoilt));
  }
}

TEST_CASE("a zipped IMDF archive is the floor that it would be as a folder") {
  const DrawnPlan plan;
  const std::string units = DrawnPlan::collection(
      unit("F", "walkway", plan.box(0, 0, 12, 2)) + "," + unit("a", "office", plan.box(0, 2, 6, 7)) + "," +
      unit("b", "office", plan.box(6, 2, 12, 7)) + "," + unit("bad", "office", R"("geometry":null)"));
  const std::string levels = DrawnPlan::collection(
      R"({"type":"Feature","id":"L","feature_type":"level","properties":{"ordinal":3},"geometry":null})");
  const test::TemporaryFolder folder;
  folder.write("unit.geojson", units);
  folder.write("level.geojson", levels);
  const IndoorFloor unpacked = only_level(folder.path());
  const auto zip = folder.write("venue.zip", zipped({{"venue/manifest.json", "{}"},
                                                     {"__MACOSX/venue/._unit.geojson", "junk"},
                                                     {"__MACOSX/venue/unit.geojson", "junk"},
                                                     {"venue/level.geojson", levels},
                                                     {"venue/unit.geojson", units}}));
  REQUIRE(is_indoor_plan(zip));
  const IndoorFloor packed = only_level(zip.string() + "#3");
  CHECK(packed.floor.name == "venue level 3");
  const auto unnamed = [](IndoorFloor indoor) {
    indoor.floor.name = "";
    return to_geojson(indoor.floor, indoor.truth);
  };
  CHECK(unnamed(packed) == unnamed(unpacked));
  REQUIRE(packed.floor.set_aside.size() == 1);
  CHECK(packed.floor.set_aside[0].what == "unit.geojson feature 4 ('bad')");
  CHECK_FALSE(is_indoor_plan(folder.write("other.zip", zipped({{"readme", "no floor"}}))));
}
