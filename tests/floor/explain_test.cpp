#include "floor/explain.h"

#include <doctest/doctest.h>

#include "geometry/error.h"

using namespace gramap;

namespace {

FittedFloor floor_of_two() {
  FittedFloor floor;
  floor.inner_wall_m = 0.2;
  FittedRoom a, b;
  a.id = "101", a.type = "Office", a.origin = Origin::observed, a.space = "s", a.width_m = 3.0,
  a.width_sigma_m = 0.01;
  a.extracted_width_m = 3.02, a.extracted_sigma_m = 0.01, a.scans = {"101"}, a.rule = "cells",
  a.rule_path = {"row", "cells"};
  b.id = "s_2", b.type = "WC", b.space = "s", b.start_m = 3.2, b.width_m = 2.0, b.rule = "wet";
  floor.rooms = {a, b};
  floor.spaces.push_back({"s", 5.2, -3, 0.9, {{-5, 0.1, {"Office", "Store"}, {3.0, 2.0}}}});
  return floor;
}

}  // namespace

TEST_CASE("an observed room is explained by its rules, its scan and the runner-up's score") {
  const std::string text = explain_room(floor_of_two(), "101");
  CHECK(text.find("row > cells") != std::string::npos);
  CHECK(text.find("differs by -2.0 cm (2.0 sigma)") != std::string::npos);
  CHECK(text.find("lower by 2.00") != std::string::npos);
}

TEST_CASE("a derived room names the other type that could be there") {
  const std::string text = explain_room(floor_of_two(), "s_2");
  CHECK(text.find("observed       not") != std::string::npos);
  CHECK(text.find("Store of 2.000 m from 3.200 m") != std::string::npos);
}

TEST_CASE("an unknown room is refused with the rooms there are") {
  try {
    explain_room(floor_of_two(), "999");
    FAIL("not refused");
  } catch (const InputError& error) {
    CHECK(error.advice.find("101, s_2") != std::string::npos);
  }
}
