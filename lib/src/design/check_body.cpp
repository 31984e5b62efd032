#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "design/checks.hpp"

#include <cmath>
#include <string>

namespace glissade::design_file {
namespace {

constexpr double kHighestSpeed = 1e4;  // [m/s]

void check_friction_range(const Design& design, Collected& findings) {
  const BodyDesign& body = design.body;
  const std::string key = friction_key(design);
  const double low = body.low_friction.value_or(body.friction).coefficient();
  const double high = body.high_friction.value_or(body.friction).coefficient();
  const double nominal = body.friction.coefficient();
  if (low > nominal || nominal > high) {
    report(findings, {"body." + key},
           {"", key + ": low, nominal and high are not in ascending order",
            "They are " + angle_text(math::atan(low)) + ", " + angle_text(math::atan(nominal)) + " and " +
                angle_text(math::atan(high)) + ".",
            ""});
  }
}

}  // namespace

void check_body(const Design& design, Collected& findings) {
  check_friction_range(design, findings);
  const BodyDesign& body = design.body;
  if (!(body.entry_speed >= 0.0 && body.entry_speed <= kHighestSpeed)) {
    report(findings, {"body.entry_speed"},
           {"", "entry_speed: " + rounded_text(body.entry_speed, 4) + " m/s is out of range",
            "It lies between 0 and 10000 m/s.", "0 m/s, or no entry_speed, for a start from rest"});
  }
  if (!(body.drag_per_metre >= 0.0 && std::isfinite(body.drag_per_metre))) {
    report(findings, {"body.drag"},
           {"", "drag: " + rounded_text(body.drag_per_metre, 4) + " 1/m is negative",
            "Drag slows the body down.", "air density x drag coefficient x frontal area / (2 x mass)"});
  }
  if (!(design.gravity > 0.0 && design.gravity <= 1e4)) {
    report(findings, {"gravity"},
           {"", "gravity: " + rounded_text(design.gravity, 4) + " m/s^2 is out of range",
            "It is positive, and at most 10000 m/s^2.", "9.81 m/s^2"});
  }
}

}  // namespace glissade::design_file
