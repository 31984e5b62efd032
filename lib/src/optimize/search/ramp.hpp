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
};

/// Where neither run nor drop is given: the steepest straight track within the limits on slope angles that reaches the lowest
/// exit speed, or, where straight ends ask for more length than that takes, the flatter one of their length.
///
/// The steeper, the less friction takes: no straight track is lower, none with such ends is shorter. Whether it keeps all other
/// limits the judgement tells. Speeds are those of Motion, at the friction of the range that arrives slowest.
/// @return none where another finish is asked for, no exit speed is, or no straight track of 20 free falls' drop reaches it
[[nodiscard]] std::optional<Ramp> steepest_ramp(const Problem& problem);

/// What a ramp has of an objective that is a length: least_drop and least_length [m].
[[nodiscard]] double measure_of(const Ramp& ramp, ObjectiveKind objective);

/// Limits that a ramp lies at, each with its price by central differences: the ramps of bounds that are a little tighter and
/// a little looser.
[[nodiscard]] std::vector<ActiveLimit> active_limits(const Ramp& ramp, const Problem& problem);

}  // namespace glissade::optimizer
