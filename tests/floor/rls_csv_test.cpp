#include "floor/rls_csv.h"

#include <doctest/doctest.h>

#include "geometry/error.h"
#include "tests/floor/temporary_file.h"

using namespace gramap;

namespace {

std::vector<RlsSegment> read_texts(const std::string& rls, const std::string& rules) {
  const test::TemporaryFolder folder;
  return read_rls(folder.write("rls.csv", rls), folder.write("rules.csv", rules));
}

}  // namespace

TEST_CASE("segments are read with or without header, with trailing commas, with Windows line ends") {
  const std::vector<RlsSegment> segments = read_texts(
      "\xEF\xBB\xBF"
      "4,0,0,10,0\r\n\r\n7,0,5,0,15\r\n",
      "index,rlsStartX,rlsStartY,rlsEndX,rlsEndY,Reversed,rules,\n4, 0,0,10,0,No,0.5;2.5; 3;,\n");
  REQUIRE(segments.size() == 2);
  CHECK(segments[0].index == 4);
  CHECK(segments[0].walls_m == std::vector<double>{0.5, 3.0, 6.0});
  CHECK(segments[1].lengths_m.empty());
  CHECK(segments[1].walls_m.empty());
}

TEST_CASE("the lost sign of the first distance comes back from the collinear neighbour") {
  const std::vector<RlsSegment> segments = read_texts(
      "1,0,0,5,0\n2,5,0,15,0\n3,15,0,20,0\n4,20,0,20,9\n",
      "1,0,0,5,0,No,1;3.9;,\n2,5,0,15,0,No,0.1;4;6.5;,\n3,15,0,20,0,No,0.4;2;,\n4,20,0,20,9,No,2.6;1;,\n");
  CHECK(segments[1].walls_m[0] == doctest::Approx(-0.1));  // 4.9 on segment 1
  CHECK(segments[1].walls_m[2] == doctest::Approx(10.4));
  CHECK(segments[1].shares_first_wall);
  CHECK(segments[1].shares_last_wall);
  CHECK(segments[2].walls_m[0] == doctest::Approx(0.4));
  CHECK(segments[2].previous == 1);
  CHECK(segments[2].next == -1);  // segment 4 turns the corner
  CHECK_FALSE(segments[3].shares_first_wall);
}

TEST_CASE("a reversed list counts from the segment's end") {
  const std::vector<RlsSegment> segments =
      read_texts("1,0,0,10,0\n2,10,0,20,0\n", "1,0,0,10,0,Yes,0.5;2;3;,\n2,10,0,20,0,No,0.5;1;,\n");
  // The neighbour's first wall lies half a metre behind the common end: so does ours.
  CHECK(segments[0].walls_m == std::vector<double>{5.5, 8.5, 10.5});
  CHECK(segments[0].shares_last_wall);
}

TEST_CASE("what is written is read back the same") {
  const std::string rls = "index,startX,startY,endX,endY\n1,0.000000,0.000000,5.000000,0.000000\n";
  const std::string rules =
      "index,rlsStartX,rlsStartY,rlsEndX,rlsEndY,Reversed,rules,\n"
      "1,0.000000,0.000000,5.000000,0.000000,Yes,0.100000;2.000000;,\n";
  const RlsCsv csv = to_rls_csv(read_texts(rls, rules));
  CHECK(csv.rls == rls);
  CHECK(csv.rules == rules);
}

TEST_CASE("a fitted floor is written with wall lines in the middle of its inner walls") {
  FittedFloor floor;
  floor.floor.spaces = {{"S", "H", {}, {0, 0}, {6.2, 0}}};
  FittedRoom a, b;
  a.space = b.space = "S";
  a.width_m = 2.9;
  b.start_m = 3.1;
  b.width_m = 3.1;
  floor.rooms = {b, a};
  CHECK(to_rls_csv(floor).rules.find("No,0.000000;3.000000;3.200000;,") != std::string::npos);
}

TEST_CASE("faults of the CSV files are refused with line and column") {
  struct Case {
    std::string rls, rules, expected;
    int line, column;
  };
  const std::string rls = "1,0,0,10,0\n", row = "1,0,0,10,0,No,";
  const std::vector<Case> cases = {
      {"", row + "1;,\n", "no reference line segment", 0, 0},
      {"1,0,0,10\n", row, "the row has 4 fields", 1, 1},
      {"1,0,0,nan,0\n", row, "endX is no number", 1, 7},
      {"1,0,0,0,0\n", row, "no length", 1, 1},
      {rls + rls, row, "there twice", 2, 1},
      {"1.5,0,0,10,0\n", row, "not a whole number", 1, 1},
      {rls, "index,a,b,c,d,e,f\n2,0,0,10,0,No,1;,\n", "segment 2 is not in", 2, 1},
      {rls, "1,0,1,10,1,No,1;,\n", "lies elsewhere", 1, 1},
      {rls, row + "1;,\n" + row + "1;,\n", "second row", 2, 1},
      {rls, "1,0,0,10,0,Maybe,1;,\n", "Reversed is 'Maybe'", 1, 12},
      {rls, row + "1;-2;,\n", "not positive", 1, 17},
      {rls, row + "1;2,5;,\n", "something behind the lengths", 1, 19},
      {rls, row + "1;two;,\n", "a length is no number", 1, 17},
  };
  for (const Case& item : cases) {
    CAPTURE(item.expected);
    try {
      read_texts(item.rls, item.rules);
      FAIL("was not refused");
    } catch (const InputError& error) {
      CAPTURE(error.what());
      CHECK(std::string(error.what()).find(item.expected) != std::string::npos);
      CHECK(error.place.line == item.line);
      CHECK(error.place.column == item.column);
      CHECK_FALSE(error.advice.empty());
    }
  }
}
