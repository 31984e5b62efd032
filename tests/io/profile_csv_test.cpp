#include "glissade/io/profile_csv.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <string>
#include <vector>

namespace profile_csv_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

std::vector<Vec2> read(const std::string& text, const ProfileCsvOptions& options = {}) {
  const TempDir place;
  put_bytes(place / "wall.csv", text);
  return read_profile_csv(place / "wall.csv", options).points;
}

std::string refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a profile reads by the names of its columns, height turned into drop") {
  const std::vector<Vec2> expected = {{0.0, -2.0}, {0.5, -1.25}, {1.5, 0.5}};
  CHECK(read("x,z\n0,2\n0.5,1.25\n1.5,-0.5\n") == expected);
  CHECK(read("# measured by tape\nname;z;x\na;2;0\n\nb;1.25;0.5\r\nc;-0.5;1.5") == expected);
  CHECK(read("\xEF\xBB\xBF\"x\"\t\"z\"\n0\t2\n0.5\t\"1.25\"\n1.5\t-0.5\n") == expected);
}

TEST_CASE("a profile in millimetres comes back in metres") {
  const ProfileCsvOptions options{"distance", "height", LengthUnit::millimetre};
  CHECK(read("distance,height\n250,1000\n", options) == std::vector<Vec2>{{0.25, -1.0}});
}

TEST_CASE("what is wrong with a profile is told with line and column") {
  CHECK_THAT(refusal(""), Contains("wall.csv: the file is empty"));
  CHECK_THAT(refusal("a,b\n1,2\n"),
             Contains("wall.csv:1: there is no column") && Contains("a") && Contains("b"));
  CHECK_THAT(refusal("x,z\n0,1\n1\n"),
             Contains("wall.csv:3: column") && Contains("is missing") && Contains("1 of 2"));
  CHECK_THAT(refusal("x;z\n0;1,5\n"),
             Contains("wall.csv:2:3: ") && Contains("1,5") && Contains("decimal point"));
  CHECK_THAT(refusal("x,z\n0,nan\n"), Contains("wall.csv:2:3: ") && Contains("nan"));
  CHECK_THAT(refusal("x,z\n\n0,\n"), Contains("wall.csv:3:3: ") && Contains("is no number"));
  CHECK_THAT(refusal("x,z\n1e999,1\n"), Contains("wall.csv:2:1: ") && Contains("is no number"));
  CHECK_THAT(refusal("x,z\n1,2\n2e7,1\n"),
             Contains("wall.csv:3:1: ") && Contains("too large") && Contains("unit"));
  CHECK_THAT(refusal(std::string(300, '\xff') + "\n\x01\n"), Contains("there is no column"));
  CHECK_THAT(refusal("x,z\n0,1 m\n"), Contains("1 m"));
  CHECK_THAT(refusal("x,z\r0,1\r1,0\r"),
             Contains("wall.csv:1:4: the line ends with a carriage return (CR) alone"));
  CHECK_THAT(refusal("x,z\n0,\u22121\n"), Contains("a minus sign (U+2212)") && Contains("Try: -1"));
  // A decimal comma in a file that commas part: two numbers of each, and others in the place of the second column.
  CHECK_THAT(refusal("x,z\n2,0,3,5\n"), Contains("wall.csv:2: the line has 4 cells, more than the 2 names") &&
                                            Contains("a decimal comma makes two cells of one number") &&
                                            Contains("semicolons"));
  CHECK_THAT(refusal("x;z\n2;3;5\n"),
             Contains("3 cells, more than the 2 names") && !Contains("decimal comma"));
  CHECK_THAT(refusal("x,z,z\n0,1,2\n"), Contains("wall.csv:1: two columns are called \"z\""));
  CHECK(read("x,z,note,note\n0,2,a,b\n") == std::vector<Vec2>{{0.0, -2.0}});
  CHECK(read("x,z\n0,2,,\n") == std::vector<Vec2>{{0.0, -2.0}});
  const TempDir place;
  CHECK_THROWS_AS(read_profile_csv(place / "nowhere.csv"), FileError);
}

TEST_CASE("separators at the end of the first line name no column, and those within quotes part no cells") {
  CHECK_THAT(refusal("x,z,\n2,0,3,\n"), Contains("wall.csv:2: the line has 3 cells, more than the 2 names"));
  const std::vector<Vec2> expected = {{0.0, -2.0}, {1.0, -1.0}};
  CHECK(read("x,z,\n0,2,\n1,1\n") == expected);
  CHECK(read(",x,z\n1,0,2\n2,1,1\n") == expected);
  CHECK(read("x,z,note\n0,2,\"left, by tape\"\n1,1,5\"\n") == expected);
  CHECK(read("note,x,z\n\"left, by tape\",0,2\n\"\",1,1\n") == expected);
  CHECK_THAT(refusal("note,x,z\n\"left,0,2\n\"\",1,high\n"), Contains("is no number"));
}

TEST_CASE("a profile of more than 64 MiB is refused before it is read") {
  const TempDir place;
  put_bytes(place / "wall.csv", "x,z\n0,1\n");
  std::filesystem::resize_file(place / "wall.csv", 100'000'000);
  CHECK_THROWS_WITH(read_profile_csv(place / "wall.csv"), Contains("larger than 64 MiB"));
}

TEST_CASE("points remember their lines") {
  const TempDir place;
  put_bytes(place / "wall.csv", "# taken in May\nx,z\n0,1\n\n1,0\n");
  CHECK(read_profile_csv(place / "wall.csv").lines == std::vector<std::size_t>{3, 5});
}

TEST_CASE("the other coordinate beside the distance is told where every line has one") {
  const auto other = [](const std::string& text, const ProfileCsvOptions& options) {
    const TempDir place;
    put_bytes(place / "wall.csv", text);
    return read_profile_csv(place / "wall.csv", options).other;
  };
  const std::string site = "run_m,x_m,y_m,z_m\n0,10,4,9\n5,13,8,6\n10,16,12,5\n";
  const auto beside_x = other(site, {"x_m", "z_m"});
  REQUIRE(beside_x);
  CHECK(beside_x->column == "y_m");
  CHECK(beside_x->distance == 6.0);
  CHECK(beside_x->reach == 8.0);
  CHECK(beside_x->has_run);
  const auto beside_y = other(site, {"y_m", "z_m"});
  REQUIRE(beside_y);
  CHECK(beside_y->column == "x_m");
  CHECK_FALSE(other(site, {"run_m", "z_m"}));
  const auto millimetres = other("X;Y;Z\n0;0;9\n3000;-4000;6\n", {"X", "Z", LengthUnit::millimetre});
  REQUIRE(millimetres);
  CHECK(millimetres->reach == 4.0);
  CHECK_FALSE(millimetres->has_run);
  CHECK_FALSE(other("x,y\n0,9\n3,6\n", {"x", "y"}));       // y is the height here
  CHECK_FALSE(other("x,z,y\n0,9,left\n3,6,right\n", {}));  // no coordinate
  CHECK_FALSE(other("x,z,y\n0,9\n3,6,1\n", {}));           // nor one of every point
  CHECK_FALSE(other("x,z\n0,9\n3,6\n", {}));
}

}  // namespace profile_csv_test
