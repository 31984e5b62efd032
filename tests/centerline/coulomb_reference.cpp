#include "coulomb_reference.hpp"

#include "support/paths.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <nlohmann/json.hpp>

namespace glissade::reference {
namespace {

using nlohmann::json;

std::string text(const json& object, const char* key) {
  return object.at(key).get<std::string>();
}

double number(const json& object, const char* key) {
  return std::stod(text(object, key));
}

CurvePoint curve_point(const json& item) {
  using Precise = boost::multiprecision::cpp_bin_float_50;
  CurvePoint point;
  point.slope_angle = number(item, "slope_angle");
  point.slope_remainder =
      static_cast<double>(Precise(text(item, "slope_angle")) - Precise(point.slope_angle));
  point.x = number(item, "x");
  point.drop = number(item, "drop");
  point.time = number(item, "time");
  point.speed = number(item, "speed");
  return point;
}

CurveCase curve_case(const json& item) {
  CurveCase curve;
  curve.endpoints = {number(item, "run"), number(item, "drop")};
  curve.friction = Friction::from_coefficient(number(item, "friction_coefficient"));
  curve.gravity = number(item, "gravity");
  curve.exit_slope_angle = number(item, "exit_slope_angle");
  curve.travel_time = number(item, "travel_time");
  curve.exit_speed = number(item, "exit_speed");
  curve.straight_time = number(item, "straight_time");
  for (const json& point : item.at("points")) curve.points.push_back(curve_point(point));
  return curve;
}

}  // namespace

std::vector<CurveCase> curve_cases() {
  std::ifstream file(test_data_path("reference/coulomb_brachistochrone.json"));
  std::vector<CurveCase> cases;
  for (const json& item : json::parse(file)) cases.push_back(curve_case(item));
  return cases;
}

double reach_margin(const Endpoints& endpoints, Friction friction) {
  const double lost = friction.coefficient() * std::fabs(endpoints.run);
  if (lost == 0.0) return std::numeric_limits<double>::infinity();
  return std::fma(-friction.coefficient(), std::fabs(endpoints.run), endpoints.drop) / lost;
}

CoulombState turned_by(CoulombState state, double change, Friction friction, double gravity) {
  const double path = -change / state.curvature;
  const double sine = std::sin(state.slope_angle);
  const double cosine = std::cos(state.slope_angle);
  const double load = gravity * cosine + state.curvature * state.speed * state.speed;
  state.x += path * cosine;
  state.drop += path * sine;
  state.time += path / state.speed;
  state.speed += path * (gravity * sine - friction.coefficient() * load) / state.speed;
  return state;
}

}  // namespace glissade::reference
