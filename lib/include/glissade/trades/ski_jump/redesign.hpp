#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/task/limits.hpp"

namespace glissade {

/// In-runs that give the same take-off speed: what a hill costs in height, and each of its letters.

/// A body at the start of an in-run and the speed that it is to have at the edge.
struct TakeOff {
  Body body;           ///< from rest, or with its entry speed
  double speed = 0.0;  ///< at the edge [m/s]; > 0
  double gravity = kDefaultGravity;
};

/// The in-run of these letters that begins as high as a take-off speed needs.
/// Accuracy: kTakeOffAccuracy of the speed.
/// @param shape  its length is not asked
/// @throws InputError if the speed is not finite and positive
/// @throws InfeasibleError if the body is faster at the edge without any straight, or never as fast: drag and friction let
///         it have no more
[[nodiscard]] InRunShape reaching(InRunShape shape, const TakeOff& take_off);

/// Stated bound of the relative error of a take-off speed.
inline constexpr double kTakeOffAccuracy = 1e-12;

/// How the drop of an in-run answers to its letters, the take-off speed being the same.
struct DropSlopes {
  double by_gamma = 0.0;  ///< [m/rad]
  double by_alpha = 0.0;  ///< [m/rad]
  double by_r1 = 0.0;     ///< [m/m]
  double by_t = 0.0;      ///< [m/m]
  double by_speed = 0.0;  ///< [m/(m/s)]
};

/// By differences of reaching(): central ones, or those of one side where on the other one no straight gives the speed.
/// Accuracy: 1e-6 relative.
/// @throws as reaching()
[[nodiscard]] DropSlopes drop_slopes(const InRunShape& shape, const TakeOff& take_off);

/// What the letters of an in-run may be; a side that is left out keeps the letter from passing what it is now.
struct LetterBounds {
  Range gamma;            ///< [rad]
  Range r1;               ///< [m]
  Range t;                ///< [m]
  double straight = 0.0;  ///< above the transition, at least: a start area [m]
};

/// Of all in-runs within the bounds that reach the take-off speed the one with the least drop from start to edge; alpha, which
/// the jump decides, and the kind of transition stay.
/// Method: one letter after the other, each at the best of its bounds and the places between, until none gains; where the straight
///   is as short as it may be, two together. Letters that do not reach the speed, with whatever straight, are passed by.
/// Accuracy: 1e-6 of the drop against a grid of the bounds, where one valley holds it.
/// @throws as reaching() if no letters within the bounds reach it, InputError if a bound's sides are the wrong way round
[[nodiscard]] InRunShape least_drop_in_run(const InRunShape& shape, const LetterBounds& bounds,
                                           const TakeOff& take_off);

/// A power curve in place of a circle: straights of the same angles that end at the same places, joined without a
/// jump of curvature at E1.
///
/// Curve: eta = C xi^n in the frame of the first tangent, n = 1 + 1/cos(D), D = gamma - alpha; radius r1/cos(D) at E2.
/// Source: Zanevskyy, A power function profile of a ski jumping in-run hill, Acta Bioeng. Biomech. 13(4), 2011: the
///   conditions; the exponent follows from them.
/// Accuracy: pieces of linear curvature; 1e-5 of the curvature, angles exact.
/// @param shape  r1 is the radius of the circle that is replaced; its length and transition are not asked
/// @throws as reaching()
[[nodiscard]] ClothoidSpline power_in_run(const InRunShape& shape, const TakeOff& take_off);

/// A transition shaped by the load: v^2/radius grows evenly from 0 over the first quarter, keeps, and fades evenly over
/// the last quarter of the transition, so that curvature jumps neither at E1 nor at E2. The ride is the body's own, in wind and
/// with its centre of mass where that runs: v^2/radius is of the way of that, what the load is above the weight's share.
///
/// Source: after Palej and Filipowska, Mathematical modelling of the inrun profile of a ski jumping hill with the
///   controlled track reaction force, J. Theor. Appl. Mech. 47(1), 2009: a prescribed reaction and a boundary-value
///   problem for the profile; the shape of the load is ours.
/// @param shape        its r1, length and transition are not asked
/// @param radial_load  the v^2/radius that is kept [m/s^2]; > 0
/// @throws as reaching(), InputError if the load is not finite and positive, or gives no bend for the speeds at E1:
///   one shorter than 0.001 mm, or one that the body stops in
[[nodiscard]] ClothoidSpline load_controlled_in_run(const InRunShape& shape, double radial_load,
                                                    const TakeOff& take_off);

}  // namespace glissade
