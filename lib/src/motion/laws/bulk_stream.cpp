#include "glissade/motion/laws/bulk_stream.hpp"

#include "motion/laws/requirement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace glissade {

BulkStream::BulkStream(const StreamShape& shape)
    : shape_(shape), flow_(shape.mass_flow / shape.bulk_density) {
  motion::require_positive("mass_flow", shape.mass_flow, " kg/s", "A stream carries something.");
  motion::require_positive("bulk_density", shape.bulk_density, " kg/m^3", "A bulk solid weighs something.");
  for (const WidthAt& width : shape.width.knots()) {
    motion::require_positive("width", width.width, " m", "A chute has a width.");
  }
  if (shape.wall_height) {
    motion::require_positive("wall_height", *shape.wall_height, " m",
                             "A wall that holds a stream has a height.");
  }
  motion::require_positive("least_speed", shape.least_speed, " m/s", "A stream that stands does not flow.");
  if (!(shape.slip_ratio > 0.0 && shape.slip_ratio <= 1.0)) {
    throw InputError({"", "slip_ratio: " + exact_text(shape.slip_ratio) + " is not above 0 and at most 1",
                      "Speed at the floor over the mean speed.", "0.6"});
  }
  if (shape.lateral_pressure_ratio >= 0.0 && std::isfinite(shape.lateral_pressure_ratio)) return;
  throw InputError({"",
                    "lateral_pressure_ratio: " + exact_text(shape.lateral_pressure_ratio) +
                        " is not a finite number, 0 or larger",
                    "What presses on the side walls, over the pressure from above.", "0.5"});
}

double BulkStream::width(double s) const {
  return shape_.width.at(s);
}

double BulkStream::width_slope(double s) const {
  return shape_.width.slope(s);
}

double BulkStream::depth(double s, double speed) const {
  return flow_ / (width(s) * speed);
}

double BulkStream::floor_wear(double s, Friction friction, double normal_load) const {
  return shape_.slip_ratio * shape_.mass_flow * friction.coefficient() * normal_load / width(s);
}

Resistance BulkStream::resistance(double s, double v) const {
  // 1 + K_v H/B = 1 + C1/u, C1 = K_v Q/(rho B^2).
  const double wide = width(s);
  const double excess = shape_.lateral_pressure_ratio * flow_ / (wide * wide * std::sqrt(v));
  const double narrowing = -2.0 * width_slope(s) / wide;
  Resistance resistance;
  resistance.factor = 1.0 + excess;
  resistance.by_v = -0.5 * excess / v;
  resistance.by_v_v = 0.75 * excess / (v * v);
  resistance.by_s = excess * narrowing;
  resistance.by_s_v = resistance.by_v * narrowing;
  resistance.by_s_s = 1.5 * excess * narrowing * narrowing;
  return resistance;
}

std::vector<double> BulkStream::breaks() const {
  std::vector<double> places;
  for (const WidthAt& width : shape_.width.knots()) places.push_back(width.at);
  return places;
}

std::vector<LawQuantity> BulkStream::quantities() const {
  // Its bound is the wall's, or the width's where that is less: least_v() knows which.
  return {{"burden_depth_m", "burden depth", "m", {}, true},
          {"equivalent_friction", "equivalent friction", "", {}, false}};
}

double BulkStream::quantity(std::size_t index, const LawState& state) const {
  if (index == 0) return depth(state.arc_length, std::sqrt(state.v));
  if (index == 1) return state.friction * resistance(state.arc_length, state.v).factor;
  return Law::quantity(index, state);
}

double BulkStream::least_v(double s) const {
  return std::max(bound_v(s), shape_.least_speed * shape_.least_speed);
}

double BulkStream::bound_v(double s) const {
  const double wide = width(s);
  const double speed = flow_ / (wide * deepest(s));
  return speed * speed;
}

double BulkStream::deepest(double s) const {
  const double wide = width(s);
  return std::min(wide, shape_.wall_height.value_or(wide));
}

LawPtr BulkStream::from(double s) const {
  if (shape_.width.is_constant()) return nullptr;
  StreamShape rest = shape_;
  // What lies behind is one knot at the start of the rest.
  std::vector<WidthAt> widths = {{0.0, shape_.width.at(s)}};
  for (const WidthAt& width : shape_.width.knots()) {
    if (width.at > s) widths.push_back({width.at - s, width.width});
  }
  rest.width = WidthLaw(std::move(widths));
  return std::make_shared<const BulkStream>(rest);
}

LawPtr BulkStream::in_units(double length, double speed) const {
  StreamShape scaled = shape_;
  // Depth is all that counts: Q/rho in units of length^2 speed.
  scaled.bulk_density = 1.0;
  scaled.mass_flow = flow_ / (length * length * speed);
  std::vector<WidthAt> widths = shape_.width.knots();
  for (WidthAt& width : widths) {
    width.at /= length;
    width.width /= length;
  }
  scaled.width = WidthLaw(std::move(widths));
  scaled.least_speed /= speed;
  if (scaled.wall_height) *scaled.wall_height /= length;
  return std::make_shared<const BulkStream>(scaled);
}

}  // namespace glissade
