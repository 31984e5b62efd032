#include "endpoint_rules.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace glissade::centerline {
namespace {

constexpr int kUsualDigits = 4;
constexpr int kAllDigits = 17;

/// Digits that two numbers need to read differently: a message never says "4 deg exceeds 4 deg".
int digits_to_tell_apart(double first, double second) {
  for (int digits = kUsualDigits; digits < kAllDigits; ++digits) {
    if (rounded_text(first, digits) != rounded_text(second, digits)) return digits;
  }
  return first == second ? kUsualDigits : kAllDigits;
}

Issue out_of_reach(const Endpoints& endpoints, Friction friction) {
  const double run = std::fabs(endpoints.run);
  const double mean_slope = math::atan2(endpoints.drop, run);
  const double friction_angle = friction.angle().radians();
  const double least_drop = friction.coefficient() * run;
  const int angle_digits =
      digits_to_tell_apart(mean_slope * (180.0 / std::numbers::pi), friction.angle().degrees());
  const int drop_digits = digits_to_tell_apart(endpoints.drop, least_drop);
  const std::string verdict = friction_angle > mean_slope ? " is steeper than" : " is as steep as";
  return {"",
          "friction_angle: " + angle_text(friction_angle, angle_digits) + verdict +
              " the mean slope from start to finish, " + angle_text(mean_slope, angle_digits) + " (drop " +
              length_text(endpoints.drop, drop_digits) + " over " + length_text(run) + ")",
          "From rest, no track between these points reaches the finish, whatever its shape "
          "(docs/theory.md, reach theorem).",
          "a friction_angle below " + angle_text(mean_slope, angle_digits) + ", a drop above " +
              length_text(least_drop, drop_digits) + ", or a centerline kind that takes an entry_speed."};
}

}  // namespace

void require_falling(const Endpoints& endpoints) {
  std::vector<Issue> issues;
  if (!std::isfinite(endpoints.run)) {
    issues.push_back({"", "run: " + exact_text(endpoints.run) + " m is not a finite length", "", ""});
  }
  if (!(std::isfinite(endpoints.drop) && endpoints.drop > 0.0)) {
    issues.push_back({"", "drop: " + exact_text(endpoints.drop) + " m is not a finite length above 0",
                      "From rest, a body reaches only what lies below its start.",
                      "a finish below the start; the drop counts positive downwards"});
  }
  if (!issues.empty()) throw InputError(std::move(issues));
}

void require_gravity(double gravity) {
  if (std::isfinite(gravity) && gravity > 0.0) return;
  throw InputError({"", "gravity: " + exact_text(gravity) + " m/s^2 is not a finite number above 0", "",
                    "9.81 m/s^2 on Earth, 1.62 m/s^2 on the Moon"});
}

double drop_beyond_friction(const Endpoints& endpoints, Friction friction) {
  return std::fma(-friction.coefficient(), std::fabs(endpoints.run), endpoints.drop);
}

void require_reachable_from_rest(const Endpoints& endpoints, Friction friction) {
  require_falling(endpoints);
  if (drop_beyond_friction(endpoints, friction) > 0.0) return;
  throw InfeasibleError(out_of_reach(endpoints, friction));
}

}  // namespace glissade::centerline
