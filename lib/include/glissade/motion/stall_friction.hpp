#pragma once

#include "glissade/core/units.hpp"
#include "glissade/motion/motion.hpp"

#include <optional>

namespace glissade {

/// Stated bound of the error of stall_friction_angle() [rad].
inline constexpr double kStallFrictionAccuracy = 1e-6;

/// How far a ride is from getting stuck: the friction angle from which on the same body stalls on the same
/// track.
///
/// More friction is a slower body at every place as long as the track carries it (docs/theory.md, energy
/// equation), so that there is one such angle: below it the body does not stall, above it it does. A body that
/// leaves the track has not stalled.
/// What comes down from a hood (Body::approach) falls away from it beyond some friction, and misses the track: the first
/// friction counts at which a ride from the body's own on no longer goes through, and there is none if what ends it is that.
/// Where friction changes along the track, every change is shifted by the same angle as the body's own, down to 0 and up to
/// 89.9 deg (its own, if it is more).
/// Accuracy: kStallFrictionAccuracy; never above the true angle by more than that.
/// @return 0 if the body stalls without any friction; none if it does not stall below 89.9 deg, or misses the track before it
///         would
/// @throws as Motion
[[nodiscard]] std::optional<Angle> stall_friction_angle(const CenterlinePtr& centerline, const Body& body,
                                                        double gravity = kDefaultGravity);

/// Whether the same body of another friction angle stalls on the same track, or chokes it; changes of friction along the
/// track are shifted as for stall_friction_angle().
/// @param angle  [0, 89.9 deg]
/// @return false, too, where it leaves the track
/// @throws as Motion
[[nodiscard]] bool stalls_at(const CenterlinePtr& centerline, const Body& body, Angle angle,
                             double gravity = kDefaultGravity);

}  // namespace glissade
