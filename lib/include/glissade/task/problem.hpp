#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/task/finish.hpp"
#include "glissade/task/limits.hpp"
#include "glissade/task/objective.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// Which end of the track places count from.
enum class PlacesFrom {
  start,
  finish  ///< where it is the start that is free: what lies before the finish has a negative run, above it a negative drop
};

/// What is asked: a body, two ends, and the limits between them.
struct Problem {
  Endpoints endpoints;  ///< run != 0; runs of limits count towards the finish, whichever side it lies on
  Finish finish;
  PlacesFrom places_from = PlacesFrom::start;  ///< of half_planes, keep_outs, lines and waypoints
  Body body;                                   ///< body.friction is the nominal friction
  std::optional<Friction> low_friction;        ///< <= body.friction; limits hold there too
  std::optional<Friction> high_friction;       ///< >= body.friction; limits hold there too
  /// Within the range; limits hold there, too, as far as a search looks. A wear of the floor need be greatest at none of those
  /// above: optimize() adds what it meets.
  std::vector<Friction> further_frictions;
  double gravity = kDefaultGravity;  ///< [m/s^2]; > 0
  Limits limits;
  Objective objective;
};

/// @throws InputError listing every field that breaks its stated bound: ends, body, friction range, gravity and
///         objective here, limits in limit_catalogue() and Limits
void require_valid(const Problem& problem);

/// What a track that is given can be held against: as require_valid(), but for ends and objective. It leads where
/// it leads, up or down, whatever it was found for.
/// @throws InputError as require_valid()
void require_judgeable(const Problem& problem);

}  // namespace glissade
