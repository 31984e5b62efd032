#pragma once

#include "optimize/search.hpp"

#include <optional>
#include <vector>

namespace glissade::fastest {

/// A stretch of the core, in shares of its length.
struct Span {
  double from = 0.0;
  double to = 0.0;
};

/// A place where limits begin or cease to bind.
///
/// The fastest track's curvature jumps there. Between coarse knots a jump is found as a ramp, with ripples on
/// either side; two knots close before and behind it take both out.
struct Switch {
  Span blurred;              ///< here the track found is not yet like the one sought
  std::optional<Span> jump;  ///< where two knots belong; none where the jump could not be made out
};

/// Switches of a track found, in order.
[[nodiscard]] std::vector<Switch> switches_of(const ScaledProblem& problem, const Found& found);

/// Knots that share out the error of a track found, from its own third differences, with two at each jump
/// and more of them where a jump could not be made out.
/// @param pieces  of what lies between the switches; those of the switches come on top
[[nodiscard]] Vector refined_knots(const Transcription& track, const Vector& z,
                                   const std::vector<Switch>& switches, std::size_t pieces);

}  // namespace glissade::fastest
