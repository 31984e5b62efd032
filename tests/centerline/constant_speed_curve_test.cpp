#include "glissade/centerline/constant_speed_curve.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

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
  std::ifstream file(GLISSADE_TEST_DATA "/reference/pudasaini_and_tracks.json");
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
