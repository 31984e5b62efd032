// A build in memory, and what of it comes to a disk.

#include "glissade/core/error.hpp"
#include "glissade/core/file_format.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

using namespace glissade;
using Catch::Matchers::Contains;
using Names = std::vector<std::string>;

namespace {

Design chute() {
  return read_design(designs_path("grain_chute.yaml"), {{"export", "[stl, stl-ascii, scad, csv]"}});
}

Names names_of(const std::vector<PendingFile>& files) {
  Names names;
  for (const PendingFile& file : files) names.push_back(file.name);
  return names;
}

}  // namespace

TEST_CASE("assemble makes and proves everything, and leaves the disk alone") {
  const TempDir place;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(place.path());
  const Design design = chute();
  const Assembly assembly = assemble(design, solve(design));
  std::filesystem::current_path(before);
  CHECK(place.names().empty());
  CHECK(assembly.stem == "grain_chute");
  CHECK(names_of(assembly.files) ==
        Names{"grain_chute.stl", "grain_chute.ascii.stl", "grain_chute.scad", "grain_chute.csv"});
  REQUIRE(assembly.parts.size() == 1);
  CHECK(assembly.parts[0].name == "track");
  CHECK(assembly.parts[0].files == names_of(assembly.files));
  CHECK(assembly.swept().facts.watertight());
  CHECK(assembly.swept().max_deviation <= design.mesh.tolerance);
  CHECK(assembly.cost < assembly.total_cost);
}

TEST_CASE("solve, assemble and publish one by one write the bytes of build") {
  const TempDir place;
  const Design design = chute();
  const Build at_once = build(design, place / "build");
  const Build in_steps = publish(design, assemble(design, solve(design)), place / "steps");
  REQUIRE(at_once.files.size() == in_steps.files.size());
  for (std::size_t i = 0; i < at_once.files.size(); ++i) {
    INFO(at_once.files[i].path);
    CHECK(bytes_of(at_once.files[i].path) == bytes_of(in_steps.files[i].path));
  }
  CHECK(in_steps.parts.size() == 1);
  CHECK(in_steps.swept().facts.triangles == at_once.swept().facts.triangles);
}

TEST_CASE("files of a set may lie in folders, and are removed from there when the set no longer has them") {
  const TempDir place;
  const Design design = chute();
  const auto text_file = [](const std::string& name) {
    PendingFile file;
    file.name = name;
    file.write = [](const std::filesystem::path& path, const std::stop_token&) {
      put_bytes(path, "plate\n");
    };
    return file;
  };
  Assembly assembly = assemble(design, solve(design));
  assembly.files = {text_file("plates/01_floor.dxf"), text_file("cut_list.csv")};
  const Build first = publish(design, std::move(assembly), place / "out", {}, {.report = false});
  REQUIRE(first.files.size() == 2);
  CHECK(first.files[0].path == place / "out/plates/01_floor.dxf");
  CHECK(bytes_of(place / "out/plates/01_floor.dxf") == "plate\n");

  assembly = assemble(design, solve(design));
  assembly.files = {text_file("cut_list.csv")};
  const Build second = publish(design, std::move(assembly), place / "out", {}, {.report = false});
  CHECK(second.removed == std::vector<std::filesystem::path>{place / "out/plates/01_floor.dxf"});
  CHECK_FALSE(std::filesystem::exists(place / "out/plates/01_floor.dxf"));
}

TEST_CASE("a file that does not read back as meant ends the build, and none appears") {
  const TempDir place;
  const Design design = chute();
  Assembly assembly = assemble(design, solve(design));
  assembly.files.back().read_back = [](const std::filesystem::path& path, const std::stop_token&) {
    throw InternalError({path.string(), "the file read back differs from what was written", "", ""});
  };
  CHECK_THROWS_AS(publish(design, std::move(assembly), place / "out"), InternalError);
  CHECK(place.names().empty());
}

TEST_CASE("every format has a word and an ending of its own in a set") {
  std::vector<std::string> words;
  for (const FileFormat& row : kFileFormats) {
    CHECK(&file_format(row.format) == &row);
    CHECK(word(row.format) == row.word);
    CHECK(row.ending.starts_with('.'));
    CHECK(std::count(words.begin(), words.end(), row.word) == 0);
    words.emplace_back(row.word);
  }
}

TEST_CASE("binary STL is too coarse for wide solids as it is for long ones, and what is told to try does") {
  for (const auto& [width, azimuth] :
       {std::pair{"30 m", 0.0}, std::pair{"300 m", 0.0}, std::pair{"300 m", 3.0}, std::pair{"3000 m", 1.0}}) {
    CAPTURE(width, azimuth);
    const TempDir place;
    put_bytes(place / "wide.yaml",
              "glissade: 1\ntrack: {start: {x: 0 m, y: 0 m, z: 2 m}, finish: {x: 3 m, y: " +
                  exact_text(azimuth) + " m, z: 0 m}}\nbody: {friction_coefficient: 0.2}\n" +
                  "centerline: {kind: fastest}\ncross_section: {kind: u-channel, width: " + width +
                  ", wall_height: 300 mm, thickness: 5 mm}\nmesh: {tolerance: 1 mm}\nexport: [stl]\n");
    // Fine enough that single precision cannot hold it, whatever the width.
    const double half = 0.5 * std::stod(width);
    const auto built_at = [&](const std::string& tolerance) {
      const Design design = read_design(place / "wide.yaml", {{"mesh.tolerance", tolerance}});
      return assemble(design, solve(design));
    };
    std::string told;
    for (const double share : {0.1, 0.3, 0.9}) {
      CAPTURE(share);
      try {
        static_cast<void>(built_at(exact_text(share * 0x1p-23 * half) + " m"));
        FAIL("accepted");
      } catch (const InputError& error) {
        const std::string said = error.what();
        CHECK_THAT(said, Contains("is finer than binary STL can hold"));
        told = said.substr(said.find("or a tolerance of ") + 18);
      }
    }
    CAPTURE(told);
    CHECK_NOTHROW(built_at(told));
  }
}

TEST_CASE(
    "coordinates of the site are taken to half of the tolerance, as its steps there are and not as three "
    "axes'") {
  const TempDir place;
  put_bytes(place / "far.yaml",
            "glissade: 1\ntrack: {start: {x: 500000 m, z: 6.25 m}, finish: {x: 500005.5 m, z: 1.125 m}}\n"
            "body: {friction_angle: 17 deg}\ncross_section: {kind: slab, width: 2 m, thickness: 300 mm}\n"
            "mesh: {tolerance: 150 mm}\nexport: {formats: [stl], frame: site}\n");
  // In millimetres x steps by 32 there.
  for (const char* thickness : {"300 mm", "1 m"}) {
    for (const double tolerance : {0.035, 0.045, 0.06, 0.15, 0.2}) {
      CAPTURE(thickness, tolerance);
      const Design design = read_design(place / "far.yaml", {{"mesh.tolerance", exact_text(tolerance) + " m"},
                                                             {"cross_section.thickness", thickness}});
      const Assembly assembly = assemble(design, solve(design));
      CHECK(assembly.parts.front().solid->max_deviation <= tolerance);
    }
  }
  const Design fine = read_design(place / "far.yaml", {{"mesh.tolerance", "30 mm"}});
  CHECK_THROWS_WITH(assemble(fine, solve(fine)),
                    Contains("positions move by up to 16 mm") && Contains("or a tolerance of 65 mm"));
}

TEST_CASE("a track along which no solid can be built is told with a warning, as a build refuses it") {
  const auto design_with = [](const std::string& walls) {
    return parse_design(
        "glissade: 1\ntrack: {start: {x: 3 m, z: 6 m}}\n"
        "body: {friction_angle: 1 deg, entry_speed: 12 m/s}\n"
        "centerline: {kind: segments, entry_slope_angle: 38.165 deg, segments: [{to_slope_angle: 57.009 "
        "deg, radius: -0.359 m}, {length: 0.753 m}, {to_slope_angle: -41.493 deg, radius: 0.574 m}, "
        "{length: 0.384 m}]}\n"
        "cross_section: {kind: half-pipe, width: 0.529 m, thickness: 0.026 m, wall_height: " +
            walls + "}\nlimits: {lowest_normal_load: none, stay_below: [{line: [[3 m, 9 m], [5 m, 9 m]]}]}\n",
        "d.yaml");
  };
  const Design high = design_with("0.774 m");
  const Track track = solve(high);
  const std::vector<Issue> told = warnings(high, track);
  REQUIRE(told.size() == 1);
  CHECK(told[0].where == high.where("cross_section"));
  CHECK_THAT(told[0].what,
             Contains("it reaches 1.038 m above the floor, further than the track has room for"));
  CHECK_THAT(told[0].what, Contains("no solid can be built along this track"));
  REQUIRE_THROWS_AS(assemble(high, track), InputError);
  // What it advises is 903 mm above the floor, 264.5 mm of them the round bottom's.
  const Design low = design_with("0.63 m");
  CHECK(warnings(low, solve(low)).empty());
  CHECK_NOTHROW(assemble(low, solve(low)));
}
