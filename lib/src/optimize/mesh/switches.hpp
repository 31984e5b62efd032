#pragma once

#include "optimize/descent/search.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// Knots before and behind a jump, in shares of the core length: near enough for what the ramp costs, far enough for the
/// place to be met.
inline constexpr double kPair = 1e-3;  // taste

/// What turns by more within a piece or a few as short as those of a jump is a corner [rad].
inline constexpr double kCorner = 0.05;  // taste

/// A stretch of the track.
struct Span {
  double from = 0.0;
  double to = 0.0;
};

/// A place where limits begin or cease to bind.
///
/// The fastest track's curvature jumps there. Between coarse knots a jump is found as a ramp, with ripples on
/// either side; two knots close before and behind it take both out.
struct Switch {
  Span blurred;              ///< shares of the core: here the track found is not yet like the one sought
  std::optional<Span> jump;  ///< shares of the core: where two knots belong; none if it could not be made out
  std::size_t pieces = 1;    ///< between these two
};

/// Where each limit binds, in arc length [chords].
[[nodiscard]] std::vector<std::vector<Span>> bindings_of(const ScaledProblem& problem, const Found& found);

/// Switches of a track found, in order.
[[nodiscard]] std::vector<Switch> switches_of(const ScaledProblem& problem, const Found& found);

/// Whether the track found has its knots at the switches already.
[[nodiscard]] bool settled(const std::vector<Switch>& switches);

}  // namespace glissade::optimizer
