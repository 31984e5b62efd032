#include "centerline/optima/endpoint_rules.hpp"

#include "glissade/centerline/flying_start_brachistochrone.hpp"
#include "glissade/centerline/reach.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace glissade::centerline {
namespace {

void append_faulty_way(const Endpoints& endpoints, std::vector<Issue>& issues) {
  if (!issues.empty()) return;
  const double longer = std::max(std::fabs(endpoints.run), std::fabs(endpoints.drop));
  if (longer >= kShortestWay && longer <= kLongestWay) return;
  issues.push_back(
      {"",
       "run and drop: the finish, " + exact_text(endpoints.run) + " m by " + exact_text(endpoints.drop) +
           " m, lies too " + (longer < kShortestWay ? "near to" : "far from") + " the start",
       "The longer of both is between " + rounded_text(kShortestWay, 3) + " m and " +
           rounded_text(kLongestWay, 3) + " m, so that nothing of the track leaves the range of numbers.",
       "run and drop in metres"});
}

constexpr int kUsualDigits = 4;
constexpr int kAllDigits = 17;

void append_faulty_friction(Friction friction, std::vector<Issue>& issues) {
  if (friction.coefficient() <= kRoughest) return;
  issues.push_back({"",
                    "friction coefficient: " + exact_text(friction.coefficient()) + " is more than " +
                        rounded_text(kRoughest, 3),
                    "Beyond it the closed form loses its digits.", "0.05 to 1 for what slides"});
}

/// Digits that two numbers need to read differently: a message never says "4 deg exceeds 4 deg".
int digits_to_tell_apart(double first, double second) {
  for (int digits = kUsualDigits; digits < kAllDigits; ++digits) {
    if (rounded_text(first, digits) != rounded_text(second, digits)) return digits;
  }
  return first == second ? kUsualDigits : kAllDigits;
}

Issue out_of_reach(const Endpoints& endpoints, Friction friction) {
  const double run = std::fabs(endpoints.run);
  const Angle mean_slope = Angle::from_radians(math::atan2(endpoints.drop, run));
  const Angle friction_angle = friction.angle();
  const double least_drop = friction.coefficient() * run;
  const int angle_digits = digits_to_tell_apart(mean_slope.degrees(), friction_angle.degrees());
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

Issue out_of_reach_with_speed(const Endpoints& endpoints, Friction friction, double entry_speed,
                              double gravity) {
  // What is out of reach by a rounding needs no less than it has.
  const double needed = std::max(least_entry_speed(endpoints, friction, gravity), entry_speed);
  const double drop = least_drop(endpoints.run, friction, entry_speed, gravity);
  const int digits = digits_to_tell_apart(entry_speed, needed);
  return {"",
          "entry_speed: " + rounded_text(entry_speed, digits) + " m/s is not more than the " +
              rounded_text(needed, digits) + " m/s that bring a body to rest at the finish (drop " +
              length_text(endpoints.drop) + " over " + length_text(std::fabs(endpoints.run)) +
              ", friction_angle " + angle_text(friction.angle()) + ")",
          "At that speed no track between these points reaches the finish, whatever its shape "
          "(docs/theory.md, reach theorem).",
          "an entry_speed above " + rounded_text(needed, digits) + " m/s, a drop above " +
              length_text(drop, digits_to_tell_apart(drop, endpoints.drop)) + ", or less friction"};
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
  append_faulty_way(endpoints, issues);
  if (!issues.empty()) throw InputError(std::move(issues));
}

void require_reachable_with_speed(const Endpoints& endpoints, Friction friction, double entry_speed,
                                  double gravity) {
  std::vector<Issue> issues;
  const auto require_length = [&](const char* name, double value) {
    if (std::isfinite(value)) return;
    issues.push_back(
        {"", std::string(name) + ": " + exact_text(value) + " m is not a finite length", "", ""});
  };
  require_length("run", endpoints.run);
  require_length("drop", endpoints.drop);
  if (!(std::isfinite(entry_speed) && entry_speed > 0.0)) {
    issues.push_back({"", "entry_speed: " + exact_text(entry_speed) + " m/s is not a finite speed above 0",
                      "From rest the fastest track is another curve.", ""});
  }
  if (endpoints == Endpoints{}) {
    issues.push_back({"", "run and drop: both are 0 m", "Start and finish are the same point.", ""});
  }
  append_faulty_way(endpoints, issues);
  append_faulty_friction(friction, issues);
  if (!issues.empty()) throw InputError(std::move(issues));
  const bool as_at_rest = as_from_rest(endpoints, entry_speed, gravity);
  const bool arrives = can_arrive(endpoints, friction, entry_speed, gravity) &&
                       !(as_at_rest && drop_beyond_friction(endpoints, friction) <= 0.0);
  if (!arrives) throw InfeasibleError(out_of_reach_with_speed(endpoints, friction, entry_speed, gravity));
}

void require_entry_speed(double entry_speed) {
  if (std::isfinite(entry_speed) && entry_speed >= 0.0) return;
  throw InputError({"", "entry_speed: " + exact_text(entry_speed) + " m/s is negative or not finite",
                    "A body enters the track downhill or at rest.", "0 m/s, a start from rest"});
}

void require_gravity(double gravity) {
  if (gravity >= kWeakestGravity && gravity <= kStrongestGravity) return;
  const bool is_number = std::isfinite(gravity) && gravity > 0.0;
  throw InputError({"",
                    "gravity: " + exact_text(gravity) + " m/s^2 is " +
                        (is_number ? "out of range" : "not a finite number above 0"),
                    is_number ? "Between " + rounded_text(kWeakestGravity, 3) + " and " +
                                    rounded_text(kStrongestGravity, 3) +
                                    " m/s^2 speeds and times stay within the range of numbers."
                              : "",
                    "9.81 m/s^2 on Earth, 1.62 m/s^2 on the Moon"});
}

bool as_vertical(double run, double drop) {
  // rounding: what the run, and its friction at kRoughest, takes of the drop is lost in it
  constexpr double kSteepest = 1e30;
  return drop / run > kSteepest;
}

bool as_from_rest(const Endpoints& endpoints, double entry_speed, double gravity) {
  const double way = math::hypot(endpoints.run, endpoints.drop);
  return entry_speed < kRestShare * std::sqrt(gravity) * std::sqrt(way);
}

double drop_beyond_friction(const Endpoints& endpoints, Friction friction) {
  return std::fma(-friction.coefficient(), std::fabs(endpoints.run), endpoints.drop);
}

void require_reachable_from_rest(const Endpoints& endpoints, Friction friction) {
  require_falling(endpoints);
  std::vector<Issue> issues;
  append_faulty_friction(friction, issues);
  if (!issues.empty()) throw InputError(std::move(issues));
  if (drop_beyond_friction(endpoints, friction) > 0.0) return;
  throw InfeasibleError(out_of_reach(endpoints, friction));
}

}  // namespace glissade::centerline
