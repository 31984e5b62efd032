#include "glissade/centerline/constant_speed_curve.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace constant_speed_curve_test {

using namespace glissade;

namespace {

struct ReferenceCurve {
  Endpoints endpoints;
  Friction friction;
  double gravity;
  double p;
  double entry_slope_angle;
  double exit_slope_angle;
  double arc_length;
  double travel_time_from_rest;
  double exit_speed_from_rest;
  double travel_time_at_constant_speed;

  [[nodiscard]] ConstantSpeedCurve curve() const { return {endpoints, friction, gravity, p}; }
};

std::vector<ReferenceCurve> reference_curves() {
  std::ifstream file(test_data_path("reference/pudasaini_and_tracks.json"));
  REQUIRE(file);
  std::vector<ReferenceCurve> curves;
  const nlohmann::json document = nlohmann::json::parse(file);
  for (const auto& entry : document.at("pudasaini")) {
    const auto number = [&entry](const char* key) {
      return std::strtod(entry.at(key).get<std::string>().c_str(), nullptr);
    };
    curves.push_back({{number("run"), number("drop")},
                      Friction::from_coefficient(number("friction_coefficient")),
                      number("gravity"),
                      number("P"),
                      number("entry_slope_angle"),
                      number("exit_slope_angle"),
                      number("arc_length"),
                      number("travel_time_from_rest"),
                      number("exit_speed_from_rest"),
                      number("travel_time_at_constant_speed")});
  }
  return curves;
}

double relative_error(double value, double reference) {
  return std::abs(value / reference - 1.0);
}

}  // namespace

TEST_CASE("constant-speed curve: angles, length, times and exit speed meet all 60 reference curves") {
  const std::vector<ReferenceCurve> references = reference_curves();
  REQUIRE(references.size() == 60);
  for (const ReferenceCurve& reference : references) {
    const ConstantSpeedCurve curve = reference.curve();
    INFO("run " << reference.endpoints.run << " m, P = " << reference.p);
    CHECK(relative_error(curve.entry_slope_angle().radians(), reference.entry_slope_angle) <
          kConstantSpeedCurveAccuracy);
    CHECK(relative_error(curve.exit_slope_angle().radians(), reference.exit_slope_angle) <
          kConstantSpeedCurveAccuracy);
    CHECK(relative_error(curve.length(), reference.arc_length) < kConstantSpeedCurveAccuracy);
    CHECK(relative_error(curve.travel_time(), reference.travel_time_from_rest) < kConstantSpeedCurveAccuracy);
    CHECK(relative_error(curve.speed(curve.length()), reference.exit_speed_from_rest) <
          kConstantSpeedCurveAccuracy);
    CHECK(relative_error(curve.travel_time_at_constant_speed(), reference.travel_time_at_constant_speed) <
          kConstantSpeedCurveAccuracy);
  }
}

TEST_CASE("constant-speed curve: it ends at its finish") {
  for (const ReferenceCurve& reference : reference_curves()) {
    const ConstantSpeedCurve curve = reference.curve();
    const CenterlinePoint finish = curve.at(curve.length());
    CHECK(finish.x == Approx(reference.endpoints.run).epsilon(1e-14));
    CHECK(finish.drop == Approx(reference.endpoints.drop).epsilon(1e-14));
  }
}

TEST_CASE("constant-speed curve: the fastest P for 10 m by 5 m is the one of the theory's table") {
  struct Row {
    double mu, time, p, rounding;
  };
  for (const Row& row : {Row{0.1, 1.97264, 305, 0.5}, Row{0.2, 2.19868, 127, 0.5},
                         Row{0.3, 2.55645, 67.8, 0.05}, Row{0.45, 4.38684, 22.9, 0.05}}) {
    const auto curve = ConstantSpeedCurve::fastest({10, 5}, Friction::from_coefficient(row.mu), 9.81);
    CHECK(std::abs(curve.travel_time() - row.time) <= 0.5e-5);
    CHECK(std::abs(curve.p() - row.p) <= row.rounding);
  }
}

TEST_CASE("constant-speed curve: a body fed at sqrt(P) keeps its speed, one from rest nears it from below") {
  const auto curve = ConstantSpeedCurve::at_speed({10, 5}, Friction::from_coefficient(0.2), 9.81, 11.0);
  CHECK(curve.p() == 121.0);
  double from_rest = 0.0;
  for (const double part : {0.1, 0.3, 0.6, 1.0}) {
    const double s = part * curve.length();
    CHECK(curve.speed(s, 11.0) == Approx(11.0).epsilon(1e-15));
    CHECK(curve.speed(s, 20.0) > 11.0);
    CHECK(curve.speed(s) > from_rest);
    from_rest = curve.speed(s);
    CHECK(from_rest < 11.0);
  }
  CHECK(curve.travel_time(11.0) == Approx(curve.travel_time_at_constant_speed()).epsilon(1e-14));
}

TEST_CASE("constant-speed curve: a body at the constant speed weighs g sin(zeta)/mu on the track") {
  for (const ReferenceCurve& reference : reference_curves()) {
    const ConstantSpeedCurve curve = reference.curve();
    for (const double part : {0.0, 0.25, 0.5, 1.0}) {
      const CenterlinePoint point = curve.at(part * curve.length());
      const double load = curve.gravity() * std::cos(point.slope_angle) + point.curvature * curve.p();
      CHECK(load == Approx(curve.gravity() * std::sin(point.slope_angle) / curve.friction().coefficient())
                        .epsilon(1e-12));
    }
  }
}

TEST_CASE("constant-speed curve: position is the integral of the slope angle, curvature its derivative") {
  const ConstantSpeedCurve curve({10, 5}, Friction::from_coefficient(0.2), 9.81, 127);
  const double step = 1e-4;
  for (const double s : {0.5, 2.0, 5.0, 9.0, 11.0}) {
    const CenterlinePoint before = curve.at(s - step);
    const CenterlinePoint here = curve.at(s);
    const CenterlinePoint after = curve.at(s + step);
    CHECK((after.x - before.x) / (2 * step) == Approx(std::cos(here.slope_angle)).epsilon(1e-8));
    CHECK((after.drop - before.drop) / (2 * step) == Approx(std::sin(here.slope_angle)).epsilon(1e-8));
    CHECK((before.slope_angle - after.slope_angle) / (2 * step) == Approx(here.curvature).epsilon(1e-7));
    CHECK(curve.slope_angle(s) == here.slope_angle);
    CHECK(curve.arc_length_at_slope(Angle::from_radians(here.slope_angle)) == Approx(s).epsilon(1e-13));
    CHECK(curve.arc_length_at_run(here.x) == Approx(s).epsilon(1e-13));
  }
}

TEST_CASE("constant-speed curve: the initial-value form retraces the two-point form") {
  for (const ReferenceCurve& reference : reference_curves()) {
    const ConstantSpeedCurve curve = reference.curve();
    const auto retraced = ConstantSpeedCurve::from_entry_slope(curve.entry_slope_angle(), curve.length(),
                                                               curve.friction(), curve.gravity(), curve.p());
    // The angle psi = zeta - delta loses digits where the track leaves at nearly the friction angle.
    CHECK(retraced.endpoints().run == Approx(reference.endpoints.run).epsilon(1e-13));
    CHECK(retraced.endpoints().drop == Approx(reference.endpoints.drop).epsilon(1e-13));
    CHECK(retraced.exit_slope_angle().radians() == Approx(reference.exit_slope_angle).epsilon(1e-13));
  }
}

TEST_CASE("constant-speed curve: a finish to the left gives the mirrored track") {
  const ConstantSpeedCurve right({10, 5}, Friction::from_coefficient(0.2), 9.81, 127);
  const ConstantSpeedCurve left({-10, 5}, Friction::from_coefficient(0.2), 9.81, 127);
  CHECK(left.length() == right.length());
  CHECK(left.at(left.length()).x == right.at(right.length()).x);
  CHECK(left.endpoints().run == -10);
}

TEST_CASE("constant-speed curve: at the smallest P it starts vertical, below it the error names that P") {
  for (const double mu : {1e-3, 0.2, 1.0, 3.0}) {
    for (const double excess : {1e-6, 0.1, 1.0, 100.0}) {
      const Endpoints endpoints{10, 10 * mu * (1 + excess)};
      const Friction friction = Friction::from_coefficient(mu);
      const double smallest = ConstantSpeedCurve::smallest_p(endpoints, friction, 9.81);
      const ConstantSpeedCurve steepest(endpoints, friction, 9.81, smallest);
      CHECK(steepest.entry_slope_angle().radians() == Approx(std::numbers::pi / 2).epsilon(1e-11));
      CHECK_THROWS_AS(ConstantSpeedCurve(endpoints, friction, 9.81, 0.9 * smallest), InputError);
    }
  }
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, Friction::from_coefficient(0.2), 9.81, 10),
                    Catch::Matchers::Contains("p: 10 m^2/s^2 is too small") &&
                        Catch::Matchers::Contains("it would start steeper than vertical") &&
                        Catch::Matchers::Contains("Try: p at or above") &&
                        Catch::Matchers::Contains(" m^2/s^2, or no p"));
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 2}, Friction::from_coefficient(0.4), 9.81, 20),
                    Catch::Matchers::Contains("it would start uphill, steeper than vertical"));
}

TEST_CASE("constant-speed curve: input that leaves it undefined is refused with the reason") {
  const Friction friction = Friction::from_coefficient(0.2);
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, Friction(), 9.81, 100),
                    Catch::Matchers::Contains("Without friction nothing takes the energy"));
  CHECK_THROWS_WITH(ConstantSpeedCurve({0, 5}, friction, 9.81, 100),
                    Catch::Matchers::Contains("On a vertical track a body presses on nothing"));
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, friction, 9.81, -1),
                    Catch::Matchers::Contains("p: -1 m^2/s^2 is not positive"));
  for (const double speed : {1e200, 1e-200}) {
    CHECK_THROWS_WITH(ConstantSpeedCurve::at_speed({10, 5}, friction, 9.81, speed),
                      Catch::Matchers::StartsWith("speed: 1e") &&
                          Catch::Matchers::Contains(" m/s is out of range") &&
                          Catch::Matchers::Contains("its square"));
  }
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, friction, 9.81, HUGE_VAL),
                    Catch::Matchers::Contains("p: inf m^2/s^2 is not positive and finite"));
  CHECK_THROWS_WITH(
      ConstantSpeedCurve::from_entry_slope(Angle::from_degrees(90.0001), 5.0, friction, 9.81, 127),
      Catch::Matchers::Contains("entry_slope_angle: 90.0001 deg overhangs") &&
          Catch::Matchers::Contains("between -90 and 90 deg"));
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, friction, 0, 100),
                    Catch::Matchers::Contains("gravity: 0 m/s^2 is not positive"));
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, friction, 9.81, 127).speed(1, -2),
                    Catch::Matchers::Contains("entry_speed: -2 m/s is negative"));
  CHECK_THROWS_WITH(ConstantSpeedCurve({10, 5}, friction, 9.81, 127).at(99),
                    Catch::Matchers::Contains("s: 99 m lies outside the track"));
}

TEST_CASE(
    "constant-speed curve: a mean slope of exactly mu gives the straight line, which nothing at rest "
    "leaves") {
  const ConstantSpeedCurve line({8, 4}, Friction::from_coefficient(0.5), 9.81, 100);
  CHECK(line.length() == Approx(std::hypot(8, 4)).epsilon(1e-15));
  CHECK(line.at(3).curvature == 0.0);
  CHECK(line.at(line.length()).x == Approx(8).epsilon(1e-15));
  CHECK_FALSE(line.is_convex());
  CHECK(line.travel_time(3.0) == Approx(line.length() / 3.0).epsilon(1e-14));
  CHECK(ConstantSpeedCurve::smallest_p({8, 4}, Friction::from_coefficient(0.5), 9.81) == 0.0);
  CHECK_THROWS_AS(line.travel_time(), InfeasibleError);
}

TEST_CASE(
    "constant-speed curve: flatter than mu it is a crest that a body at sqrt(P) follows while zeta >= 0") {
  const Friction friction = Friction::from_coefficient(0.4);
  const ConstantSpeedCurve crest({10, 2}, friction, 9.81, 400);
  CHECK(crest.is_convex());
  CHECK(crest.holds_body());
  CHECK(crest.at(1).curvature < 0.0);
  CHECK(crest.at(crest.length()).x == Approx(10).epsilon(1e-14));
  CHECK(crest.at(crest.length()).drop == Approx(2).epsilon(1e-14));
  CHECK(crest.travel_time(20) == Approx(crest.length() / 20).epsilon(1e-14));
  const CenterlinePoint start = crest.at(0);
  CHECK(crest.lift_off_speed(0) ==
        Approx(std::sqrt(9.81 * std::cos(start.slope_angle) / -start.curvature)).epsilon(1e-12));
  CHECK_THROWS_WITH(crest.travel_time(),
                    Catch::Matchers::Contains("A body at rest never starts to slide there"));
  CHECK_THROWS_WITH(crest.travel_time(3), Catch::Matchers::Contains("stalls where the slope angle is"));
  CHECK_THROWS_WITH(crest.travel_time(50), Catch::Matchers::Contains("leaves the track at s = 0 m"));
  // Too slow a constant speed for the same points makes the crest rise at first: the body flies off there.
  const ConstantSpeedCurve hump({10, 2}, friction, 9.81, 100);
  CHECK_FALSE(hump.holds_body());
  CHECK_THROWS_WITH(hump.travel_time(10.0), Catch::Matchers::Contains("leaves the track"));
  CHECK_THROWS_WITH(ConstantSpeedCurve::fastest({10, 2}, friction, 9.81),
                    Catch::Matchers::Contains("no track between these points reaches the finish"));
}

TEST_CASE("constant-speed curve: travel time has one minimum over P, and fastest() finds it") {
  for (const double mu : {1e-4, 0.03, 0.2, 1.0, 3.0}) {
    for (const double excess : {1e-4, 0.1, 2.0, 1000.0}) {
      for (const double entry_speed : {0.0, 2.0}) {
        const Endpoints endpoints{10, 10 * mu * (1 + excess)};
        const Friction friction = Friction::from_coefficient(mu);
        const double smallest = ConstantSpeedCurve::smallest_p(endpoints, friction, 9.81);
        double least = ConstantSpeedCurve(endpoints, friction, 9.81, smallest).travel_time(entry_speed);
        double before = least;
        bool rising = false;
        int falls_after_rise = 0;
        for (int step = 1; step <= 400; ++step) {
          const ConstantSpeedCurve curve(endpoints, friction, 9.81, smallest * std::exp(0.05 * step));
          const double time = curve.travel_time(entry_speed);
          if (time > before * (1 + 1e-12)) rising = true;
          if (rising && time < before * (1 - 1e-12)) ++falls_after_rise;
          before = time;
          least = std::min(least, time);
        }
        INFO("mu " << mu << ", excess " << excess << ", entry speed " << entry_speed);
        CHECK(falls_after_rise == 0);
        const auto fastest = ConstantSpeedCurve::fastest(endpoints, friction, 9.81, entry_speed);
        CHECK(fastest.travel_time(entry_speed) <= least * (1 + 1e-12));
      }
    }
  }
}

TEST_CASE("constant-speed curve: fastest() agrees with a golden-section search") {
  const Friction friction = Friction::from_coefficient(0.2);
  const auto time = [&](double log_p) {
    return ConstantSpeedCurve({10, 5}, friction, 9.81, std::exp(log_p)).travel_time();
  };
  double low = std::log(1.01 * ConstantSpeedCurve::smallest_p({10, 5}, friction, 9.81));
  double high = low + 5;
  while (high - low > 1e-7) {
    const double part = (high - low) / std::numbers::phi;
    if (time(high - part) < time(low + part)) {
      high = low + part;
    } else {
      low = high - part;
    }
  }
  const auto fastest = ConstantSpeedCurve::fastest({10, 5}, friction, 9.81);
  CHECK(fastest.p() == Approx(std::exp((low + high) / 2)).epsilon(1e-6));
  CHECK(fastest.travel_time() == Approx(time((low + high) / 2)).epsilon(1e-13));
  CHECK(ConstantSpeedCurve::fastest({10, 5}, friction, 9.81).p() == fastest.p());
}

TEST_CASE("constant-speed curve: of travel times with several minima fastest() finds the least") {
  const Friction friction = Friction::from_coefficient(0.2);
  const double smallest = ConstantSpeedCurve::smallest_p({10, 5}, friction, 9.81);
  const auto two_valleys = [&](double left, double right) {
    return [=](const ConstantSpeedCurve& curve) {
      const double q = std::log(curve.p() / smallest);
      const double time = std::min(left + (q - 3.1) * (q - 3.1), right + 2.0 * (q - 8.3) * (q - 8.3));
      return q > 20.0 ? std::numeric_limits<double>::infinity() : time;
    };
  };
  const auto q_of = [&](const ConstantSpeedCurve::TravelTime& time) {
    return std::log(ConstantSpeedCurve::fastest({10, 5}, friction, 9.81, time).p() / smallest);
  };
  CHECK(q_of(two_valleys(1.0, 2.0)) == Approx(3.1).epsilon(1e-6));
  CHECK(q_of(two_valleys(2.0, 1.0)) == Approx(8.3).epsilon(1e-6));
  // The least of the sweep's steps, at 3, lies in the other valley: 0.1 from its bottom, and none is as close to this one's.
  CHECK(q_of(two_valleys(1.0, 0.96)) == Approx(8.3).epsilon(1e-6));
  const auto stalls = [](const ConstantSpeedCurve&) { return std::numeric_limits<double>::infinity(); };
  CHECK_THROWS_WITH(ConstantSpeedCurve::fastest({10, 5}, friction, 9.81, stalls),
                    Catch::Matchers::Contains("the body arrives on none of these tracks, whatever their p"));
}

TEST_CASE("constant-speed curve: lengths and P may be scaled alike") {
  const auto metre = ConstantSpeedCurve::fastest({10, 5}, Friction::from_coefficient(0.2), 9.81);
  for (const double scale : {1e-4, 1e4}) {
    const auto scaled =
        ConstantSpeedCurve::fastest({10 * scale, 5 * scale}, Friction::from_coefficient(0.2), 9.81);
    CHECK(scaled.p() == Approx(scale * metre.p()).epsilon(1e-6));
    CHECK(scaled.travel_time() == Approx(std::sqrt(scale) * metre.travel_time()).epsilon(1e-13));
  }
}

}  // namespace constant_speed_curve_test
