#pragma once

#include "optimize/algebra/dense.hpp"
#include "optimize/discretise/transcription.hpp"

namespace glissade::optimizer {

/// Slope angle over the share of arc length, as a table fine towards the start; the shape that a search
/// begins with. Scaled as everything here.
struct GuessCurve {
  Vector sigma;  ///< ascending, 0 to 1
  Vector zeta;
  Vector speed;  ///< to any scale; empty where unknown
  double length = 1.0;
  /// linear between the entries
  [[nodiscard]] double slope_angle(double at) const;

  friend bool operator==(const GuessCurve&, const GuessCurve&) = default;
};

/// The frictional brachistochrone from rest to (run, drop), drop > mu run >= 0 (docs/theory.md), to a few
/// digits: a starting point, not a reference.
[[nodiscard]] GuessCurve brachistochrone_guess(double run, double drop, double mu);

/// Knots in [0, 1] that share the interpolation error of a piecewise linear curvature evenly.
/// @param pieces  >= 2
[[nodiscard]] Vector graded_knots(const GuessCurve& curve, std::size_t pieces, double entry_length);

/// Unknowns of the clothoid spline whose slope angle is closest to the curve's, least squares over arc
/// length.
[[nodiscard]] Vector fit(const GuessCurve& curve, const Transcription& track);

}  // namespace glissade::optimizer
