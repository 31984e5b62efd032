#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/clearance/envelope.hpp"
#include "glissade/core/friction_level.hpp"
#include "glissade/task/limit_catalogue.hpp"
#include "glissade/task/problem.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// Greatest violation of a limit that still counts as kept, in the scale of the limit.
inline constexpr double kLimitAccuracy = 1e-6;

/// A limit on the rate of curvature is measured against itself, but no finer than against this over the square of the chord: what
/// lies below is rounding.
inline constexpr double kLeastRateScale = 1e-6;

/// How well the referee finds one limit kept.
struct LimitCheck {
  LimitName limit;
  double value = 0.0;      ///< the bound, SI
  double reached = 0.0;    ///< the worst value that the referee found, SI; may be infinite (curvature rate)
  double violation = 0.0;  ///< by which it breaks the bound [SI]; 0 where kept
  double scale = 1.0;      ///< what a violation is measured against [SI]; > 0
  double where = 0.0;      ///< arc length of the worst value [m]
  /// Of a problem with a friction range: at which of its frictions the worst value was reached; none where
  /// friction has no part in it.
  std::optional<FrictionLevel> friction = {};
  /// Of a clearance measured from an envelope: the part of it that comes closest.
  std::optional<EnvelopePlace> closest = std::nullopt;
  /// Of the lowest load: the body leaves the track, at some friction. Up to there the least load may well be within the bound.
  bool leaves_track = false;

  /// @return violation <= kLimitAccuracy * scale, and the body does not leave the track that is to hold it
  [[nodiscard]] bool kept() const { return !leaves_track && violation <= kLimitAccuracy * scale; }
};

/// Holds any track against the limits of a problem, sampled ten times finer than optimize() looks: each limit
/// with its worst value and the place, at every friction of the range. Where a body of the range does not
/// arrive, limits on its motion are held against the part that it rides, its end included, and "arrival_at_low_friction" or
/// "arrival_at_high_friction" tells how far it comes; at the nominal friction Motion tells.
/// @param track  leads to problem.finish; its own run counts towards the finish
/// @throws InputError if there is no track, or as require_judgeable()
[[nodiscard]] std::vector<LimitCheck> check_limits(const Problem& problem, const CenterlinePtr& track);

}  // namespace glissade
