#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include "referee/judgement.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// A track without any bend, and what the referee says of it.
struct Ramp {
  CenterlinePtr line;
  referee::Judgement judgement;

  [[nodiscard]] bool keeps_limits(double tolerance) const {
    return judgement.arrived && judgement.worst <= tolerance;
  }
};

/// Where neither run nor drop is given: the steepest straight track within the limits on slope angles that reaches the lowest
/// exit speed, or, where straight ends ask for more length than that takes, the flatter one of their length.
///
/// The steeper, the less friction takes: no straight track is lower or shorter. Whether it keeps all other limits the judgement
/// tells. Speeds are those of Motion, at the friction of the range that arrives slowest.
/// @return none where another finish is asked for, no exit speed is, or no straight track of 20 free falls' drop reaches it
[[nodiscard]] std::optional<Ramp> steepest_ramp(const Problem& problem);

/// @return whether it is a length that is made least: least_drop, least_length
[[nodiscard]] constexpr bool is_low_or_short(ObjectiveKind objective) {
  return objective == ObjectiveKind::least_drop || objective == ObjectiveKind::least_length;
}

/// What a track has of such an objective [m].
[[nodiscard]] double measure_of(const Centerline& track, ObjectiveKind objective);

/// Limits that a ramp lies at, each with its price by central differences: the ramps of bounds that are a little tighter and
/// a little looser.
[[nodiscard]] std::vector<ActiveLimit> active_limits(const Ramp& ramp, const Problem& problem);

}  // namespace glissade::optimizer
