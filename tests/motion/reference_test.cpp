#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

using namespace glissade;

namespace {

double number(const nlohmann::json& text) {
  return std::stod(text.get<std::string>());
}

nlohmann::json reference(const std::string& name) {
  std::ifstream file(test_data_path("reference/" + name));
  return nlohmann::json::parse(file);
}

double relative_error(double value, double expected) {
  return std::fabs(value / expected - 1.0);
}

}  // namespace

TEST_CASE("Motion: time and exit speed on the reference tracks", "[accuracy]") {
  const auto tracks = reference("pudasaini_and_tracks.json").at("tracks");
  REQUIRE(tracks.size() == 15);
  double worst_time = 0.0;
  double worst_speed = 0.0;
  for (const auto& track : tracks) {
    std::vector<ClothoidSegment> segments;
    for (const auto& s : track.at("segments")) segments.push_back({s.at(0), s.at(1), s.at(2)});
    const auto spline = std::make_shared<const ClothoidSpline>(
        Angle::from_radians(track.at("entry_slope_angle").get<double>()), segments);
    const Motion motion(spline,
                        {Friction::from_coefficient(number(track.at("friction_coefficient"))),
                         number(track.at("entry_speed")), number(track.at("drag_per_metre"))},
                        number(track.at("gravity")));
    REQUIRE(motion.arrived());
    worst_time = std::max(worst_time, relative_error(motion.travel_time(), number(track.at("travel_time"))));
    worst_speed = std::max(worst_speed, relative_error(motion.exit_speed(), number(track.at("exit_speed"))));
  }
  WARN("tracks: largest relative error of time " << worst_time << ", of exit speed " << worst_speed);
  CHECK(worst_time <= kMotionAccuracy);
  CHECK(worst_speed <= kMotionAccuracy);
}

TEST_CASE("Motion: time and exit speed from rest on the reference constant-speed curves", "[accuracy]") {
  const auto curves = reference("pudasaini_and_tracks.json").at("pudasaini");
  REQUIRE(curves.size() == 60);
  double worst_time = 0.0;
  double worst_speed = 0.0;
  for (const auto& curve : curves) {
    const Friction friction = Friction::from_coefficient(number(curve.at("friction_coefficient")));
    const double gravity = number(curve.at("gravity"));
    const auto track = std::make_shared<const ConstantSpeedCurve>(
        Endpoints{number(curve.at("run")), number(curve.at("drop"))}, friction, gravity,
        number(curve.at("P")));
    const Motion motion(track, {friction, 0.0, 0.0}, gravity);
    REQUIRE(motion.arrived());
    worst_time =
        std::max(worst_time, relative_error(motion.travel_time(), number(curve.at("travel_time_from_rest"))));
    worst_speed =
        std::max(worst_speed, relative_error(motion.exit_speed(), number(curve.at("exit_speed_from_rest"))));
  }
  WARN("curves: largest relative error of time " << worst_time << ", of exit speed " << worst_speed);
  CHECK(worst_time <= kMotionAccuracy);
  CHECK(worst_speed <= kMotionAccuracy);
}

TEST_CASE("Motion: time and speed on the reference fastest tracks, whose curvature is unbounded at the start",
          "[accuracy]") {
  const auto cases = reference("coulomb_brachistochrone.json");
  REQUIRE(cases.size() == 120);
  // Near the reach limit a track turns up at the finish within less than its arc length has digits for, and
  // the body is all but at rest there: a few roundings of s move v by |dv/ds| ulp(s).
  double worst_time = 0.0;
  double worst_speed = 0.0;
  for (const auto& entry : cases) {
    const double run = number(entry.at("run"));
    const double drop = number(entry.at("drop"));
    const double mu = number(entry.at("friction_coefficient"));
    const Friction friction = Friction::from_coefficient(mu);
    const double gravity = number(entry.at("gravity"));
    const auto track =
        std::make_shared<const CoulombBrachistochrone>(Endpoints{run, drop}, friction, gravity);
    const Motion motion(track, {friction, 0.0, 0.0}, gravity);
    CAPTURE(run, drop, mu);
    CHECK(motion.arrived());
    if (!motion.arrived()) continue;
    const CenterlinePoint finish = track->at(track->length());
    const double load = gravity * std::cos(finish.slope_angle) +
                        finish.curvature * std::pow(number(entry.at("exit_speed")), 2);
    const double rate = 2.0 * std::fabs(gravity * std::sin(finish.slope_angle) - mu * load);
    const double rounding = 1e-15 * track->length() * rate / std::pow(number(entry.at("exit_speed")), 2);
    const double time_error = relative_error(motion.travel_time(), number(entry.at("travel_time")));
    const double speed_error = relative_error(motion.exit_speed(), number(entry.at("exit_speed")));
    worst_time = std::max(worst_time, time_error);
    worst_speed = std::max(worst_speed, speed_error / (kMotionAccuracy + rounding));
    CHECK(time_error <= kMotionAccuracy);
    CHECK(speed_error <= kMotionAccuracy + rounding);
  }
  WARN("fastest tracks: largest relative error of time "
       << worst_time << ", of exit speed, in units of what is allowed, " << worst_speed);
}
