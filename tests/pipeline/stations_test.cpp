// The columns of a law in the table of stations, against the ride itself.

#include "glissade/core/math.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/trades/chute/stream.hpp"
#include "glissade/trades/chute/wear.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace stations_test {

using namespace glissade;

namespace {

using Columns = std::map<std::string, std::vector<std::string>>;

Columns columns_of(const Track& track) {
  const TempDir dir;
  write_track_csv(dir / "stations.csv", track);
  std::ifstream file(dir / "stations.csv");
  Columns columns;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::stringstream rest(line + ",");
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    REQUIRE(cells.size() == names.size());
    for (std::size_t i = 0; i < cells.size(); ++i) columns[names[i]].push_back(cells[i]);
  }
  return columns;
}

double number(const Columns& columns, const std::string& name, std::size_t row) {
  return std::stod(columns.at(name).at(row));
}

}  // namespace

TEST_CASE("stations: of a ball, the friction that it needs, whether it has it, and where its centre runs") {
  const Design design = read_design(designs_path("marble_run.yaml"));
  const Track track = solve(design);
  const Columns columns = columns_of(track);
  const double grip = design.body.rolling()->grip.value().coefficient();
  const double height = track.motion.body().law->centre_height();
  const std::size_t rows = columns.at("arc_length_m").size();
  REQUIRE(rows > 50);
  for (std::size_t i = 0; i < rows; ++i) {
    const double s = number(columns, "arc_length_m", i);
    const double needed = number(columns, "friction_needed", i);
    CHECK(needed == track.motion.quantity(0, s));
    CHECK((number(columns, "friction_needed_kept", i) == 1.0) == (needed <= grip));
    const double zeta = Angle::from_degrees(number(columns, "slope_angle_deg", i)).radians();
    CHECK(number(columns, "centre_run_m", i) ==
          Approx(number(columns, "run_m", i) + height * math::sin(zeta)).margin(1e-12));
    CHECK(number(columns, "centre_drop_m", i) ==
          Approx(number(columns, "drop_m", i) - height * math::cos(zeta)).margin(1e-12));
  }
}

TEST_CASE("stations: of a stream, its depth and the wear that it does, at each friction") {
  const Design design = read_design(designs_path("grain_chute_with_stream.yaml"));
  const Track track = solve(design);
  const Columns columns = columns_of(track);
  const auto& stream = dynamic_cast<const BulkStream&>(*track.motion.body().law);
  double deepest = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < columns.at("arc_length_m").size(); ++i) {
    const double s = number(columns, "arc_length_m", i);
    const double depth = number(columns, "burden_depth_m", i);
    // Continuity: Q = rho u B H.
    CHECK(depth * number(columns, "speed_m_per_s", i) * stream.width(s) * design.stream->bulk_density ==
          Approx(design.stream->mass_flow).epsilon(1e-12));
    deepest = std::max(deepest, depth);
    worst = std::max(worst, number(columns, "floor_wear_w_per_m2", i));
  }
  const std::optional<StreamFacts> facts = stream_facts(track.motion);
  REQUIRE(facts);
  CHECK(deepest == Approx(facts->deepest.value).epsilon(1e-3));
  CHECK(worst == Approx(wear_of({&track.motion}).floor.value).epsilon(1e-2));
  for (const RangeRide& ride : track.range) {
    CHECK(columns.contains("burden_depth_" + std::string(to_text(ride.level)) + "_m"));
    CHECK(columns.contains("floor_wear_" + std::string(to_text(ride.level)) + "_w_per_m2"));
  }
}

TEST_CASE("stations: of a sliding point there is no column of a law") {
  const Columns columns = columns_of(solve(read_design(designs_path("grain_chute.yaml"))));
  CHECK(columns.size() == 14);
}

TEST_CASE("stations: of a feed that flies over the start they tell of the track alone") {
  const Design design = parse_design(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 1.2 m, z: 1.4 m}}\n"
      "body: {friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}}\n"
      "stream: {mass_flow: 400 t/h, bulk_density: 1600 kg/m^3}\n"
      "feed: {kind: belt, belt_speed: 3.6 m/s, pulley_radius: 400 mm, drop: 600 mm}\ncenterline: {kind: "
      "straight}\n"
      "cross_section: {kind: u-channel, width: 800 mm, wall_height: 400 mm, thickness: 8 mm}\n",
      "d.yaml");
  const Columns columns = columns_of(solve(design));
  for (const std::string name : {"time_s", "speed_m_per_s", "normal_load_m_per_s2", "burden_depth_m",
                                 "floor_wear_w_per_m2", "speed_low_m_per_s", "burden_depth_high_m"}) {
    INFO(name);
    REQUIRE(columns.contains(name));
    for (const std::string& cell : columns.at(name)) CHECK(cell.empty());
  }
  for (const std::string& cell : columns.at("slope_angle_deg"))
    CHECK(std::stod(cell) == Approx(53.13010235415599));
}

}  // namespace stations_test
