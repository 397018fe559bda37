#include "floor/fuse.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace gramap;

namespace {

RoomEvidence evidence(const std::string& id, double width, double sigma) {
  RoomEvidence result;
  result.id = id;
  result.width_m = width;
  result.width_sigma_m = sigma;
  result.centre_m = 1;
  result.centre_sigma_m = 0.25;
  return result;
}

}  // namespace

TEST_CASE("scans that agree are averaged by inverse variance, those that don't are told apart") {
  std::vector<SetAsideInput> aside;
  const auto result = fused({evidence("a", 3.00, 0.01), evidence("b", 5, 0.01), evidence("a", 3.03, 0.02),
                             evidence("a", 2.50, 0.01)},
                            aside);
  REQUIRE(result.size() == 2);
  CHECK(result[0].id == "a");
  CHECK(result[0].width_m == doctest::Approx((3.00 * 4 + 3.03) / 5));
  CHECK(result[0].width_sigma_m == doctest::Approx(0.01 * 2 / std::sqrt(5.0)));
  CHECK(result[0].centre_sigma_m == doctest::Approx(0.25));
  REQUIRE(aside.size() == 1);
  CHECK(aside[0].what == "a");
  CHECK(aside[0].reason.find("2.50") != std::string::npos);
}

TEST_CASE("of two that disagree neither is preferred") {
  std::vector<SetAsideInput> aside;
  CHECK(fused({evidence("a", 3.00, 0.01), evidence("a", 2.50, 0.01)}, aside).size() == 2);
  CHECK(aside.empty());
}
