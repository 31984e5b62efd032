#include "design/read_gates.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"

#include "design/read_body.hpp"

#include <cmath>
#include <initializer_list>
#include <string>

namespace glissade::design_file {
namespace {

void add_out_of_range(MapReader& map, std::string_view key, double value, Dimension dimension,
                      std::initializer_list<double> bounds, const std::string& why, Findings& findings) {
  findings.add(findings.position(map.path_of(key)), map.path_of(key),
               out_of_range(key, value, dimension, bounds, why, ""));
}

std::optional<Friction> read_friction(MapReader& map, Findings& findings) {
  const auto read = [&](std::string_view key, Dimension dimension) {
    const auto value = map.find(key);
    return value ? as_friction(*value, dimension, findings) : std::nullopt;
  };
  const auto angle = read("friction_angle", Dimension::angle);
  const auto coefficient = read("friction_coefficient", Dimension::number);
  if (angle && coefficient) {
    findings.add(findings.position(map.path_of("friction_angle")), map.path_of("friction_angle"),
                 {"", "both friction_angle and friction_coefficient are given",
                  "One is the tangent of the other.", "one of the two"});
    return {};
  }
  if (angle && !(*angle >= 0.0 && *angle < kRightAngle)) {
    add_out_of_range(map, "friction_angle", *angle, Dimension::angle, {0.0, kRightAngle},
                     "It lies between 0 and 90 deg (90 excluded).", findings);
    return {};
  }
  if (coefficient && !(*coefficient >= 0.0)) {
    add_out_of_range(map, "friction_coefficient", *coefficient, Dimension::number, {0.0},
                     "It is 0 or larger.", findings);
    return {};
  }
  if (angle) return Friction::from_angle(Angle::from_radians(*angle));
  if (coefficient) return Friction::from_coefficient(*coefficient);
  return {};
}

std::optional<ConditionDesign> read_condition(MapReader& top, std::string_view key, Findings& findings) {
  const auto value = top.find(key);
  if (!value) return {};
  MapReader map(*value, "A condition", "{friction_coefficient: 0.05, drag: 0.0013 1/m}", findings);
  map.expect({"friction_angle", "friction_coefficient", "drag", "drag_area", "head_wind"});
  ConditionDesign condition;
  condition.friction = read_friction(map, findings);
  condition.drag_per_metre = map.quantity("drag", Dimension::per_length);
  if (condition.drag_per_metre && *condition.drag_per_metre < 0.0) {
    add_out_of_range(map, "drag", *condition.drag_per_metre, Dimension::per_length, {0.0},
                     "It is 0 or larger.", findings);
  }
  condition.drag_area = map.quantity("drag_area", Dimension::area);
  if (condition.drag_area && *condition.drag_area < 0.0) {
    add_out_of_range(map, "drag_area", *condition.drag_area, Dimension::area, {0.0}, "It is 0 or larger.",
                     findings);
  }
  if (condition.drag_area && condition.drag_per_metre) {
    findings.add(findings.position(map.path_of("drag_area")), map.path_of("drag_area"),
                 {"", "both drag and drag_area are given", "drag = air density x drag_area / (2 x mass).",
                  "one of the two"});
  }
  condition.head_wind = map.quantity("head_wind", Dimension::speed);
  constexpr double kStrongest = 150.0;  // [m/s]
  if (condition.head_wind && std::fabs(*condition.head_wind) > kStrongest) {
    add_out_of_range(map, "head_wind", *condition.head_wind, Dimension::speed, {-kStrongest, kStrongest},
                     "It lies between -150 and 150 m/s.", findings);
  }
  map.refuse_unknown_keys();
  return condition;
}

std::optional<int> read_count(MapReader& map, Findings& findings) {
  const auto count = map.quantity("count", Dimension::number);
  if (!count) return {};
  if (*count >= 1.0 && *count <= kMostGates && *count == std::floor(*count)) return static_cast<int>(*count);
  add_out_of_range(map, "count", *count, Dimension::number, {1.0, static_cast<double>(kMostGates)},
                   "A hill has between 1 and " + std::to_string(kMostGates) + " gates.", findings);
  return {};
}

std::optional<double> read_positive(MapReader& map, std::string_view key, Findings& findings) {
  const auto length = map.quantity(key, Dimension::length);
  if (!length || *length > 0.0) return length;
  add_out_of_range(map, key, *length, Dimension::length, {0.0}, "It is above 0.", findings);
  return {};
}

}  // namespace

std::optional<GatesDesign> read_gates(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.find("gates");
  if (!value) return {};
  MapReader map(*value, "A group of gates", "{count: 49, measuring_place: 10 m}", findings);
  map.expect({"count", "step", "vertical_step", "start_area", "measuring_place", "slow", "fast"});
  GatesDesign gates;
  int given = 0;
  for (const char* const key : {"count", "step", "vertical_step"}) given += map.has(key) ? 1 : 0;
  gates.count = read_count(map, findings);
  gates.step = read_positive(map, "step", findings);
  gates.vertical_step = read_positive(map, "vertical_step", findings);
  gates.start_area = read_positive(map, "start_area", findings);
  const auto place = map.quantity("measuring_place", Dimension::length);
  if (place && *place < 0.0) {
    add_out_of_range(map, "measuring_place", *place, Dimension::length, {0.0},
                     "It counts back from the edge: 0 or more.", findings);
  }
  gates.measuring_place = place.value_or(gates.measuring_place);
  gates.slow = read_condition(map, "slow", findings);
  gates.fast = read_condition(map, "fast", findings);
  if (map.readable() && given != 1) {
    findings.add(findings.position(value->key_path), value->key_path,
                 {"",
                  given == 0 ? "gates: nothing says how many there are"
                             : "gates: their number is told in more than one way",
                  "They have a count, or a step along the track, or a vertical_step.", "count: 49"});
  }
  map.refuse_unknown_keys();
  return gates;
}

}  // namespace glissade::design_file
