#include "glissade/study/plan.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/quantity.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

using namespace glissade;
using namespace glissade::study;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> values_of(const Factor& factor) {
  std::vector<std::string> values;
  for (std::uint64_t setting = 0; setting < factor.size; ++setting)
    values.push_back(factor.at(setting).at(0));
  return values;
}

std::filesystem::path written(const TempDir& place, const std::string& text) {
  const std::filesystem::path file = place.path() / "points.csv";
  std::ofstream(file) << text;
  return file;
}

}  // namespace

TEST_CASE("a grid has both of its ends and equal steps between them") {
  CHECK(values_of(vary("body.friction_angle=10deg:25deg:4")) ==
        std::vector<std::string>{"10deg", "15deg", "20deg", "25deg"});
  CHECK(values_of(vary("a.b = 0.1 m : 0.3 m : 3")) == std::vector<std::string>{"0.1m", "0.2m", "0.3m"});
  CHECK(values_of(vary("a=5:1:5")) == std::vector<std::string>{"5", "4", "3", "2", "1"});
  CHECK(values_of(vary("a=7mm:9mm:1")) == std::vector<std::string>{"7mm"});
  CHECK(vary("body.friction_angle=10deg:25deg:4").inputs[0].column() == "body.friction_angle_deg");
}

TEST_CASE("a grid of as many values as a plan may have takes no more memory than one of two") {
  const Factor factor = vary("a=10deg:25deg:1000000000");
  REQUIRE(factor.size == 1'000'000'000);
  CHECK(factor.values.empty());
  CHECK(factor.at(0) == std::vector<std::string>{"10deg"});
  CHECK(factor.at(999'999'999) == std::vector<std::string>{"25deg"});
  CHECK_THROWS_AS(factor.at(1'000'000'000), InternalError);
  const Plan plan({factor});
  CHECK(plan.point(333'333'333).at(0).value == factor.at(333'333'333).at(0));
}

TEST_CASE("the values of a grid ascend from end to end, however far apart they are") {
  for (const char* const ends :
       {"1e308:-1e308", "-1e308:1.7e308", "1:1.0000000000000002", "0:1e-320", "3:8"}) {
    for (const std::uint64_t count : {2U, 3U, 10U, 1000U}) {
      const Factor factor = vary("a=" + std::string(ends) + ":" + std::to_string(count));
      INFO(factor.text);
      const Grid& grid = factor.grid.value();
      const double sign = grid.to > grid.from ? 1.0 : -1.0;
      for (std::uint64_t i = 0; i < count; ++i) {
        REQUIRE(std::isfinite(grid.at(i)));
        if (i > 0) REQUIRE(sign * grid.at(i) >= sign * grid.at(i - 1));
      }
      CHECK(grid.at(0) == grid.from);
      CHECK(grid.at(count - 1) == grid.to);
    }
  }
  CHECK(values_of(vary("a=1e308:-1e308:3")) == std::vector<std::string>{"1e+308", "0", "-1e+308"});
}

TEST_CASE("a list takes values as they are, with commas inside brackets") {
  CHECK(values_of(vary("k=30deg,33deg, 36deg")) == std::vector<std::string>{"30deg", "33deg", "36deg"});
  CHECK(values_of(vary("export=[stl, off],[stl]")) == std::vector<std::string>{"[stl, off]", "[stl]"});
  const Factor words = vary("centerline.kind=fastest,straight");
  CHECK_FALSE(words.inputs[0].numeric);
  CHECK(words.inputs[0].column() == "centerline.kind");
  const Factor mixed = vary("a=100mm,0.2m");
  CHECK_FALSE(mixed.inputs[0].numeric);
}

TEST_CASE("a column is named by key and unit in letters") {
  CHECK(Input{"body.drag", "1/m"}.column() == "body.drag_per_m");
  CHECK(Input{"limits.highest_normal_load", "m/s^2"}.column() == "limits.highest_normal_load_m_per_s2");
  CHECK(Input{"body.entry_speed", "km/h"}.column() == "body.entry_speed_km_per_h");
  CHECK(Input{"gravity", ""}.column() == "gravity");
  CHECK(Input{"moisture", "%"}.column() == "moisture_percent");
}

TEST_CASE("a unit that begins with a digit stays apart from the number, wherever that comes from") {
  CHECK(values_of(vary("body.drag=0.001 1/m:0.003 1/m:3")) ==
        std::vector<std::string>{"0.001 1/m", "0.002 1/m", "0.003 1/m"});
  CHECK(values_of(vary("body.drag=0.001 1/m,0.003 1/m")) ==
        std::vector<std::string>{"0.001 1/m", "0.003 1/m"});
  for (const char* law : {"uniform(0.001 1/m,0.003 1/m)", "normal(0.002 1/m,0.0001 1/m)",
                          "lognormal(0.002 1/m,0.5)", "triangular(0.001 1/m,0.002 1/m,0.003 1/m)"}) {
    for (const std::string& value :
         values_of(scatter({"body.drag=" + std::string(law)}, Sampling::sobol, 16, 1))) {
      INFO(law << ": " << value);
      const auto quantity = split_quantity(value);
      REQUIRE(quantity);
      CHECK(quantity->unit == "1/m");
      CHECK(quantity->number > 1e-4);
      CHECK(quantity->number < 0.02);
      CHECK_NOTHROW(parse_quantity(value, Dimension::per_length, "drag"));
    }
  }
  const TempDir place;
  const Factor points =
      read_points(written(place, "body.drag [1/m], body.entry_speed [m/s]\n0.0012,3\n0.0034,4\n"));
  CHECK(points.at(0) == std::vector<std::string>{"0.0012 1/m", "3m/s"});
  CHECK(points.at(1) == std::vector<std::string>{"0.0034 1/m", "4m/s"});
  CHECK(points.inputs[0].column() == "body.drag_per_m");
}

TEST_CASE("values that are no values are refused with an example") {
  const auto refused = [](const std::string& text, const std::string& message) {
    INFO(text);
    CHECK_THROWS_AS(vary(text), InputError);
    CHECK_THROWS_WITH(vary(text), Contains(message));
  };
  refused("body.friction_angle", "is not of the form KEY=...");
  refused("=1:2:3", "is not of the form KEY=...");
  refused("a=1deg:2rad:3", "the ends 1deg and 2rad differ in unit");
  refused("a=x:2:3", "'x' is no number");
  refused("a=1:2:0", "'0' is no number of values from 1 to 1000000000");
  refused("a=1:2:1e3", "is no number of values");
  refused("a=1,,2", "has an empty value");
}

TEST_CASE("points are numbered so that the last factor varies fastest") {
  const Plan plan(
      {vary("a=1,2"), vary("b=10mm,20mm,30mm"), scatter({"c=uniform(0,1)"}, Sampling::random, 5, 1)});
  REQUIRE(plan.count() == 30);
  std::uint64_t index = 0;
  for (const std::string a : {"1", "2"}) {
    for (const std::string b : {"10mm", "20mm", "30mm"}) {
      for (std::uint64_t sample = 0; sample < 5; ++sample, ++index) {
        const std::vector<Override> point = plan.point(index);
        REQUIRE(point.size() == 3);
        CHECK(point[0].key_path == "a");
        CHECK(point[0].value == a);
        CHECK(point[1].value == b);
        // The same samples for every combination of the others: variants are compared on equal terms.
        CHECK(point[2].value == plan.point(sample)[2].value);
      }
    }
  }
  CHECK_THROWS_AS(plan.point(30), InternalError);
}

TEST_CASE("a plan without factors, with a key twice, or beyond all bounds is refused") {
  CHECK_THROWS_WITH(Plan({}), Contains("nothing varies"));
  CHECK_THROWS_WITH(Plan({vary("a=1,2"), vary("a=3")}), Contains("a is given twice"));
  CHECK_THROWS_WITH(Plan({scatter({"a=uniform(0,1)"}, Sampling::random, 1'000'000, 1), vary("b=0:1:2000")}),
                    Contains("more than 1000000000 points"));
  CHECK_THROWS_WITH(scatter({"a=uniform(0,1)", "a=uniform(0,2)"}, Sampling::random, 3, 1),
                    Contains("a is given twice"));
}

TEST_CASE("a table of points has its units in the headings or in the cells") {
  const TempDir place;
  const Factor factor = read_points(written(place,
                                            "# measured\n"
                                            "body.friction_angle [deg], body.entry_speed ,centerline.kind\r\n"
                                            "17, 1 m/s, fastest\n"
                                            "\n"
                                            "18.5,2 m/s,\"straight\"\n"));
  REQUIRE(factor.size == 2);
  CHECK(factor.at(0) == std::vector<std::string>{"17deg", "1 m/s", "fastest"});
  CHECK(factor.at(1) == std::vector<std::string>{"18.5deg", "2 m/s", "straight"});
  CHECK(factor.inputs[0].column() == "body.friction_angle_deg");
  CHECK(factor.inputs[1].column() == "body.entry_speed_m_per_s");
  CHECK_FALSE(factor.inputs[2].numeric);
}

TEST_CASE("a table that is none is refused with the line") {
  const TempDir place;
  const auto refused = [&](const std::string& text, const std::string& message) {
    const auto file = written(place, text);
    CHECK_THROWS_WITH(read_points(file), Contains(message));
  };
  refused("a,b\n1\n", "points.csv:2: the line has 1 cells instead of 2");
  refused("a,b\n1,5,2\n",
          "the line has 3 cells instead of 2\n      Every line has a cell for each name of the first one; a "
          "decimal comma makes two of one number");
  refused("a,b\n1,\n", "points.csv:2: column b is empty");
  refused("a,a\n1,2\n", "points.csv:1: a is given twice");
  refused("a,b\n", "there are no points in it");
  refused("", "there are no points in it");
  refused("a\n\"x\n", "points.csv:2: a quotation mark is not closed");
  CHECK_THROWS_AS(read_points(place.path() / "none.csv"), FileError);
}
