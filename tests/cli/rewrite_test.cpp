// 'glissade rewrite': a design as a file that reads as the same design.

#include "glissade/design/design.hpp"

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <string>

using Catch::Matchers::Contains;
using namespace glissade;

TEST_CASE("a design that is rewritten is the one that --set asks for") {
  const TempDir place;
  const std::string design = shipped("grain_chute");
  const Outcome printed = glissade_run({"rewrite", design, "--set", "body.friction_angle=19deg"});
  CHECK(printed.exit_code == 0);
  const Design wanted = read_design(design, {{"body.friction_angle", "19deg"}});
  CHECK(parse_design(printed.output, design).asks_the_same(wanted));
  CHECK_THAT(printed.output, Contains("friction_angle: 19 deg"));

  const std::string file = (place / "rough.yaml").string();
  CHECK(glissade_run({"rewrite", design, "--set", "body.friction_angle=19deg", "-o", file}).exit_code == 0);
  CHECK(bytes_of(file) == printed.output);
  const Outcome again = glissade_run({"rewrite", design, "-o", file});
  CHECK(again.exit_code == 5);
  CHECK_THAT(again.errors, Contains("the file exists already"));
  CHECK(bytes_of(file) == printed.output);
  CHECK(glissade_run({"rewrite", design, "-o", file, "--force"}).exit_code == 0);
  CHECK(read_design(file).asks_the_same(read_design(design)));
}

TEST_CASE("options become a design file that solves to the same track") {
  const TempDir place;
  const std::vector<std::string> options = {"--run", "10", "--drop", "5", "--friction-angle", "11deg"};
  std::vector<std::string> rewrite = {"rewrite"};
  rewrite.insert(rewrite.end(), options.begin(), options.end());
  put_bytes(place / "ten.yaml", glissade_run(rewrite).output);
  const Outcome from_file = glissade_run({"rewrite", (place / "ten.yaml").string()});
  CHECK(from_file.output == bytes_of(place / "ten.yaml"));
  const Design design = read_design(place / "ten.yaml");
  CHECK(design.track.finish.x - design.track.start.x == 10.0);
  CHECK(design.track.start.z - design.track.finish.z == 5.0);
}

TEST_CASE("a profile is named as seen from where the design is written") {
  const TempDir place;
  std::filesystem::create_directories(place / "deep/er");
  REQUIRE(glissade_run({"init", "points", "-o", (place / "wall.yaml").string()}).exit_code == 0);
  const std::string moved = (place / "deep/er/wall.yaml").string();
  REQUIRE(glissade_run({"rewrite", (place / "wall.yaml").string(), "-o", moved}).exit_code == 0);
  CHECK_THAT(bytes_of(moved), Contains("file: \"../../profile.csv\""));
  CHECK(glissade_run({"solve", moved, "-q"}).exit_code == 0);
}

TEST_CASE("a set of rules in a file is named as seen from where the design is written") {
  const TempDir place;
  std::filesystem::create_directories(place / "deep");
  put_bytes(place / "own.yaml",
            "glissade_rules: 1\nname: own\ntitle: Own\n"
            "rules: [{id: a, sentence: s, quantity: run, highest: 9 m, source: s, certainty: own}]\n");
  put_bytes(place / "d.yaml",
            "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 3 m, z: 0 m}}\n"
            "body: {friction_angle: 10 deg}\nrules: {sets: [own.yaml, playground-slide]}\n");
  const std::string moved = (place / "deep/d.yaml").string();
  REQUIRE(glissade_run({"rewrite", (place / "d.yaml").string(), "-o", moved}).exit_code == 0);
  CHECK_THAT(bytes_of(moved), Contains("sets: [\"../own.yaml\", \"playground-slide\"]"));
  CHECK(glissade_run({"solve", moved, "-q"}).exit_code == 0);
}
