// The tables of the chute trade: Roberts' arc and straight, the textbook curve under full friction, valleys and impacts,
// and the minimum-time profile of Chiarella, Charlton and Roberts by discrete segments.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/no_curvature_load.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/trades/chute/ends.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>

#include <nlohmann/json.hpp>

namespace chute_tables_test {

using namespace glissade;
using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;

/// 60-digit integration, and a discrete-element code where that is said (docs/accuracy.md).
const json& tables() {
  static const json all = json::parse(std::ifstream(test_data_path("reference/chute_tests.json")));
  return all;
}

double number(const json& object, const char* key) {
  return object.at(key).get<double>();
}

Body point(double mu, double entry_speed) {
  Body body;
  body.friction = Friction::from_coefficient(mu);
  body.entry_speed = entry_speed;
  return body;
}

}  // namespace

TEST_CASE("Roberts' arc from the vertical to the level: speed, time, place and load at every 15 deg") {
  const json& table = tables().at("arc_constmu");
  const double radius = number(table, "R");
  const auto arc = std::make_shared<const ClothoidSpline>(
      Angle::from_degrees(90.0),
      std::vector<ClothoidSegment>{{radius * 0.5 * std::numbers::pi, 1.0 / radius, 1.0 / radius}});
  const Motion motion(arc, point(number(table, "mu"), number(table, "v0")), kGravity);
  REQUIRE(motion.arrived());
  for (const json& row : table.at("table")) {
    const double s = std::min(motion.distance(), radius * number(row, "phi_deg") * kDegree);
    const MotionState state = motion.at(s);
    const CenterlinePoint at = arc->at(s);
    CHECK(state.speed == Approx(number(row, "v")).epsilon(1e-12));
    // Times of the table were integrated to some 1e-7.
    CHECK(state.time == Approx(number(row, "t")).epsilon(1e-6).margin(1e-12));
    CHECK(state.normal_load / kGravity == Approx(number(row, "N_over_mg")).epsilon(1e-12));
    CHECK(at.x == Approx(number(row, "x")).margin(1e-13));
    CHECK(at.drop == Approx(number(row, "y")).margin(1e-13));
  }
}

TEST_CASE("Roberts' straight chute with one friction") {
  const json& row = tables().at("straight_constmu");
  const double length = number(row, "S");
  const double angle = number(row, "theta_deg") * kDegree;
  const Motion motion(
      std::make_shared<const StraightLine>(Endpoints{length * std::cos(angle), length * std::sin(angle)}),
      point(number(row, "mu"), number(row, "v0")), kGravity);
  CHECK(motion.exit_speed() == Approx(number(row, "v")).epsilon(1e-12));
  CHECK(motion.travel_time() == Approx(number(row, "t")).epsilon(1e-12));
}

TEST_CASE("the textbook curve under full friction: times, speeds, and where it stalls") {
  for (const json& row : tables().at("frictional_brachistochrone")) {
    INFO(row.dump());
    const double mu = number(row, "mu");
    const Endpoints ends{number(row, "X"), number(row, "Y")};
    const auto curve = std::make_shared<const NoCurvatureLoadCurve>(ends, Friction::from_coefficient(mu));
    const Motion motion(curve, point(mu, 0.0), kGravity);
    REQUIRE(motion.arrived());
    // The table's rides begin with 0.1 mm/s instead of at rest, which takes v/g to reach.
    CHECK(motion.travel_time() == Approx(number(row, "t_full") + 1e-4 / kGravity).epsilon(1e-7));
    CHECK(motion.exit_speed() == Approx(number(row, "v_full")).epsilon(1e-6));
    CHECK(curve->travel_time_without_curvature_load(kGravity) ==
          Approx(number(row, "t_closed")).epsilon(1e-9));
    const Motion line(std::make_shared<const StraightLine>(ends), point(mu, 0.0), kGravity);
    CHECK(line.travel_time() == Approx(number(row, "t_line")).epsilon(1e-9));
    CHECK(line.exit_speed() == Approx(number(row, "v_line")).epsilon(1e-9));
    // The true optimum is faster.
    CHECK(fastest_travel_time(ends, Friction::from_coefficient(mu), 0.0, kGravity) < motion.travel_time());
  }
  const json& stall = tables().at("stall");
  const Endpoints ends{number(stall, "X"), number(stall, "Y")};
  const Motion stalled(std::make_shared<const NoCurvatureLoadCurve>(ends, Friction::from_coefficient(0.5)),
                       point(0.5, 0.0), kGravity);
  REQUIRE(stalled.stall());
  const CenterlinePoint place = stalled.centerline().at(stalled.distance());
  CHECK(place.x == Approx(number(stall, "x_stall")).epsilon(1e-6));
  CHECK(place.drop == Approx(number(stall, "y_stall")).epsilon(1e-6));
  // The table's is the greatest at its steps.
  CHECK(stalled.highest_speed().speed == Approx(number(stall, "vmax")).epsilon(2e-4));
  CHECK(stalled.highest_speed().speed >= number(stall, "vmax"));
  // Each friction on the curve made for it: from here on none arrives.
  const auto arrives = [&](double mu) {
    return Motion(std::make_shared<const NoCurvatureLoadCurve>(ends, Friction::from_coefficient(mu)),
                  point(mu, 0.0), kGravity)
        .arrived();
  };
  CHECK(arrives(number(stall, "mu_crit_4x3") - 1e-6));
  CHECK_FALSE(arrives(number(stall, "mu_crit_4x3") + 1e-6));
}

TEST_CASE("a chute made for one friction, run at others") {
  const auto curve =
      std::make_shared<const NoCurvatureLoadCurve>(Endpoints{4.0, 3.0}, Friction::from_coefficient(0.3));
  for (const auto& [mu, speed] : tables().at("offdesign_4x3_mud0.3").items()) {
    const Motion motion(curve, point(std::stod(mu), 0.0), kGravity);
    CHECK(motion.exit_speed() == Approx(speed.get<double>()).epsilon(1e-6));
  }
}

TEST_CASE("impacts and valleys of the facts") {
  for (const json& row : tables().at("impact")) {
    const Impact impact = impact_on({3.0, Angle::from_degrees(number(row, "theta"))}, Angle{},
                                    Friction::from_angle(Angle::from_degrees(number(row, "phi"))), 1000.0);
    CHECK(impact.speed_ratio == Approx(number(row, "V2_V1")).margin(1e-12));
  }
}

TEST_CASE("Chiarella, Charlton and Roberts: twenty layers of the profile of least time") {
  // As printed by Burden and Faires: X = 2 ft, twenty layers of 0.2 ft, from rest, without resistance; angles from the
  // vertical [rad], of 5 digits, by a rule that passes each layer at the speed of its end.
  constexpr std::array kAngles = {.14062, .19954, .24522, .28413, .31878, .35045, .37990,
                                  .40763, .43398, .45920, .48348, .50697, .52979, .55205,
                                  .57381, .59516, .61615, .63683, .65726, .67746};
  constexpr double kLayer = 0.2;
  constexpr double kFeet = 32.17;  // [ft/s^2]
  double run = 0.0;
  double rule_time = 0.0;
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    run += kLayer * std::tan(kAngles[i]);
    const double speed = std::sqrt(2.0 * kFeet * kLayer * static_cast<double>(i + 1));
    rule_time += kLayer / (std::cos(kAngles[i]) * speed);
    // Stationary: Snell's law from layer to layer.
    const double first = std::sqrt(2.0 * kFeet * kLayer);
    CHECK(std::sin(kAngles[i]) / speed == Approx(std::sin(kAngles[0]) / first).epsilon(1e-4));
  }
  CHECK(run == Approx(2.0).epsilon(1e-4));
  CHECK(rule_time == Approx(0.465422).epsilon(1e-5));
  // Ours between the same ends passes each layer at that angle, to three quarters of what it turns through in the layer;
  // the rule takes each layer at the speed of its bottom and tells a shorter time than any ride takes.
  const FastestTrack fastest = fastest_track({2.0, 4.0}, Friction{}, 0.0, kFeet);
  CHECK(rule_time < fastest.travel_time);
  const Centerline& track = *fastest.centerline;
  double place = 0.0;
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    const double bottom = kLayer * static_cast<double>(i + 1);
    double beyond = track.length();
    double low = place;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + beyond);
      (track.at(middle).drop < bottom ? low : beyond) = middle;
    }
    const double top_angle = 0.5 * std::numbers::pi - track.slope_angle(place);
    const double bottom_angle = 0.5 * std::numbers::pi - track.slope_angle(low);
    INFO("layer " << i + 1 << ": " << top_angle << " to " << bottom_angle);
    CHECK(std::fabs(kAngles[i] - 0.5 * (top_angle + bottom_angle)) < 0.75 * (bottom_angle - top_angle));
    place = low;
  }
}

}  // namespace chute_tables_test
