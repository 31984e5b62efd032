#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace glissade::design_file {
namespace {

constexpr double kFastest = 100.0;  // [m/s], of an exit speed
constexpr double kShare = 0.5;      // of the energy that is gained: limits cost some of it
// [m], of a start that may lie anywhere: half of it is what a ski jump's 28 m/s take.
constexpr double kUsualDrop = 80.0;

/// From start to finish, as far as the design leaves it open a drop that a track may have [m].
double drop_to_count_with(const TrackDesign& track) {
  const double start = track.start.z;
  const auto farthest = [&](const Range& height, double usual) {
    const double nearest = height.highest ? start - *height.highest : usual;
    return std::min(std::max(usual, nearest), height.lowest ? start - *height.lowest : HUGE_VAL);
  };
  if (track.free_start && !fixes_drop(track.free_finish)) return kUsualDrop;
  switch (track.free_finish) {
    case FinishKind::vertical_line:
      return farthest(track.free_range, run_of(track));
    case FinishKind::anywhere:
      return farthest(track.free_height, kUsualDrop);
    case FinishKind::point:
    case FinishKind::level:
      return drop_of(track);
  }
  return drop_of(track);
}

double most_friction(const BodyDesign& body) {
  double most = body.high_friction.value_or(body.friction).coefficient();
  for (const FrictionFrom& change : body.friction_changes)
    most = std::max(most, change.friction.coefficient());
  return most;
}

/// Mass that is moved over mass that falls: a ball turns, too.
double inertia_of(const BodyDesign& body) {
  constexpr double kSolidBall = 2.0 / 5.0;
  const auto* const ball = body.rolling();
  if (ball == nullptr) return 1.0;
  const double spread = math::sin(ball->groove_half_angle.radians());
  return 1.0 + kSolidBall / (spread * spread);
}

/// Squared, at the end of a straight line: no track is much faster there.
double exit_speed2_on_line(const Design& design) {
  const BodyDesign& body = design.body;
  const double run = run_of(design.track);
  const double drop = drop_to_count_with(design.track);
  const double length = math::hypot(run, drop);
  const double entry = body.entry_speed * body.entry_speed;
  const double inertia = inertia_of(body);
  const double work = design.gravity * (drop - most_friction(body) * run);
  if (!(body.drag_per_metre > 0.0)) return entry + 2.0 * work / inertia;
  // (u + w)^2 <= 2 (u^2 + w^2), and a wind from behind does not slow it down.
  const bool is_against = body.head_wind > 0.0;
  const double wind = is_against ? 2.0 * body.drag_per_metre * body.head_wind * body.head_wind : 0.0;
  const double rate = (is_against ? 4.0 : 2.0) * body.drag_per_metre / inertia;
  const double kept = math::exp(-rate * length);
  return 2.0 * (work / length - wind) / inertia * (1.0 - kept) / rate + entry * kept;
}

/// To two digits from below, or to as many more as it takes to stay above.
std::string rounded_down(double value, double above) {
  constexpr int kMost = 12;
  for (int digits = 2; digits <= kMost; ++digits) {
    const double step = math::pow(10.0, std::floor(math::log(value) / std::numbers::ln10) + 1.0 - digits);
    const double rounded = step * std::floor(value / step);
    if (rounded > above) return rounded_text(rounded, digits);
  }
  return rounded_text(value, kMost);
}

}  // namespace

std::optional<std::string> exit_speed_to_ask_for(const Design& design) {
  const double entry = design.body.entry_speed;
  const double gained = exit_speed2_on_line(design) - entry * entry;
  if (!(gained > 0.0)) return {};
  double speed = std::sqrt(entry * entry + kShare * gained);
  speed = std::min(speed, kFastest);
  if (design.limits) {
    speed = std::min(speed, design.limits->exit_speed.highest.value_or(speed));
    speed = std::min(speed, design.limits->speed.highest.value_or(speed));
  }
  if (!(speed > entry)) return {};
  return rounded_down(speed, entry) + " m/s";
}

double drop_to_ask_for(const Design& design) {
  const double entry = design.body.entry_speed;
  const double asked = design.limits ? design.limits->exit_speed.lowest.value_or(entry) : entry;
  if (!(asked > entry)) return drop_to_count_with(design.track);
  return inertia_of(design.body) * (asked * asked - entry * entry) / (2.0 * design.gravity * kShare);
}

}  // namespace glissade::design_file
