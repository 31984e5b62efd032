#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/solve.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace free_ends_test {

using namespace glissade;

namespace {

/// A design whose ends stand `east` metres from where its text has them.
Track moved(const std::string& track, const std::string& limits, double east) {
  std::string text = "glissade: 1\ntrack: " + track +
                     "\nbody: {friction_coefficient: 0.05, drag: 0.002 1/m}\ncenterline: {kind: fastest}\n" +
                     "limits: {slope_angle: {highest: 60 deg}" + limits + "}\n";
  // "@2" is a coordinate that moves along
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at)) {
    const std::size_t end = text.find_first_of(",} ", at);
    const double value = std::stod(text.substr(at + 1, end - at - 1));
    text.replace(at, end - at, exact_text(value + east));
  }
  INFO(text);
  return solve(parse_design(text, "moved.yaml"));
}

}  // namespace

TEST_CASE("a search straight down is refused at the finish, with what to try") {
  const Design design = parse_design(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 6 m}, finish: {x: 0 m, z: 1 m}}\nbody: {friction_angle: 8 "
      "deg}\n"
      "limits: {smallest_radius: 1 m}\n",
      "down.yaml");
  CHECK_THROWS_WITH(solve(design),
                    Catch::Matchers::Contains("down.yaml:2:") &&
                        Catch::Matchers::Contains("track.finish.x: 0 mm is that of the start") &&
                        Catch::Matchers::Contains("a finish further out"));
}

TEST_CASE("a track with a free end is the same wherever it stands") {
  struct Case {
    std::string track;
    std::string limits;
  };
  const std::string fast = ", exit_speed: {lowest: 6 m/s}";
  const std::vector<Case> cases = {
      {"{start: {x: @0 m, z: 3 m}, finish: {x: free, z: 0 m}}", ", exit_slope_angle: 10 deg"},
      {"{start: {x: @0 m, z: 3 m}, finish: {x: {lowest: @2 m}, z: 0 m}}", ""},
      {"{start: {x: @0 m, z: 3 m}, finish: {x: {highest: @4 m}, z: 0 m}}", ", exit_slope_angle: 10 deg"},
      {"{start: {x: @0 m, z: 3 m}, finish: {x: {lowest: @-4 m, highest: @-2 m}, z: 0 m}}", ""},
      {"{start: {x: @0 m, z: 3 m}, finish: {x: @4 m, z: free}}", ""},
      {"{start: {x: @0 m, z: 3 m}, finish: {x: @4 m, z: {lowest: 1 m}}}", ""},
      {"{start: {x: @0 m, z: 3 m}, finish: {x: free, z: free}}", ", objective: least_drop" + fast},
      {"{edge: {x: @0 m, z: 0 m}}", ", objective: least_drop" + fast},
      {"{edge: {x: @0 m, z: 0 m}, start: {x: @-4 m, z: free}}", ", objective: least_drop" + fast},
      {"{edge: {x: @0 m, z: 0 m}, start: {x: free, z: 3 m}}", ", exit_slope_angle: 10 deg"},
  };
  for (const Case& one : cases) {
    CAPTURE(one.track);
    const Track here = moved(one.track, one.limits, 0.0);
    for (const double east : {2e6, 5e6, -5e6}) {
      CAPTURE(east);
      const Track there = moved(one.track, one.limits, east);
      // Coordinates at 5000 km are whole multiples of 1e-9 m; where an optimum is flat, that is seen by its root.
      constexpr double kSame = 1e-5;  // [m]
      CHECK(std::fabs(there.endpoints.run - here.endpoints.run) < kSame);
      CHECK(std::fabs(there.endpoints.drop - here.endpoints.drop) < kSame);
      CHECK(std::fabs(there.motion.travel_time() - here.motion.travel_time()) < 1e-8);
    }
  }
}

}  // namespace free_ends_test
