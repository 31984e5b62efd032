#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

#include <string_view>

namespace glissade {

/// Kind "no-curvature-load": the textbook "brachistochrone with friction", for comparison only.
///
/// It minimises the travel time of a body whose friction comes from its weight alone. A real body also
/// presses into every valley it rides through (normal load g cos zeta + kappa u^2); this curve leaves that
/// out and is therefore NOT the fastest track of any body on a real surface, and a real body may even stall
/// on it. Use "fastest" for the true one.
///
/// Frame: as CenterlinePoint; x counts towards the finish on whichever side of the start it lies.
/// Curve: with t = 2 a, x = A [(t - sin t) + mu (1 - cos t)], y = A [(1 - cos t) + mu (t + sin t)]; slope
///   angle pi/2 - a, s = 4 A [(1 - cos a) + mu sin a], curvature 1/(4 A (sin a + mu cos a)). Starts
///   vertically; with friction its curvature there is finite, 1/(4 A mu). a runs from 0 to less than pi - 2
///   delta. Run 0 gives a vertical line.
/// Source: docs/theory.md, curve without curvature load (as printed by MathWorld, "Brachistochrone Problem").
/// Accuracy: kPositionAccuracy of the length.
/// Identity: equals Cycloid at friction 0.
class NoCurvatureLoadCurve final : public Centerline {
 public:
  /// Stated bound of the position error relative to the length, measured in docs/accuracy.md.
  static constexpr double kPositionAccuracy = 1e-13;

  /// @param endpoints  run [m], finite, any sign; drop [m], finite, > 0 and > mu |run|; the longer of both kShortestWay to
  ///                   kLongestWay
  /// @throws InputError if run or drop is not finite, drop is not positive, the way is out of its range, or the friction
  ///         coefficient is above kRoughest
  /// @throws InfeasibleError if drop <= mu |run|: from rest, no track whatever reaches the finish
  NoCurvatureLoadCurve(const Endpoints& endpoints, Friction friction);

  /// Travel time of the body that the curve was made for, which feels no curvature load: shorter than the
  /// time of any real body on the same track, and not attainable.
  /// @param gravity  [m/s^2]; kWeakestGravity to kStrongestGravity
  /// @return 2 sqrt(A/g) arccos(cos(a_1 + delta)/cos(delta)) [s]
  /// @throws InputError if gravity is out of its range
  [[nodiscard]] double travel_time_without_curvature_load(double gravity = kDefaultGravity) const;

  [[nodiscard]] std::string_view kind() const noexcept override { return "no-curvature-load"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override;

 private:
  double mu_ = 0.0;
  double scale_ = 0.0;
  double finish_half_tangent_ = 0.0;
  double length_ = 0.0;
};

}  // namespace glissade
