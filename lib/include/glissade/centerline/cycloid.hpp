#pragma once

#include "glissade/centerline/centerline.hpp"

#include <string_view>

namespace glissade {

/// Kind "cycloid": the fastest track without friction, for comparison where there is some.
///
/// Frame: as CenterlinePoint; x counts towards the finish on whichever side of the start it lies.
/// Curve: x = A (2 a - sin 2a), y = A (1 - cos 2a), slope angle pi/2 - a, s = 8 A sin^2(a/2); a from 0 to at
///   most pi, curvature 1/(4 A sin a). Starts vertically with curvature unbounded like s^(-1/2). Run 0 gives
///   a vertical line.
/// Accuracy: kPositionAccuracy of the length, and relative to its own size near the start.
/// Identity: equals CoulombBrachistochrone at friction 0 (found and evaluated by formulas of its own).
class Cycloid final : public Centerline {
 public:
  /// Stated bound of the position error relative to the length, measured in docs/accuracy.md.
  static constexpr double kPositionAccuracy = 1e-14;

  /// @param endpoints  run [m], finite, any sign; drop [m], finite, > 0; the longer of both kShortestWay to
  ///                   kLongestWay
  /// @throws InputError if run or drop is not finite, drop is not positive, or both are out of that range
  explicit Cycloid(const Endpoints& endpoints);

  /// @return radius A of the rolling circle [m]; +infinity where the track is vertical
  [[nodiscard]] double rolling_radius() const noexcept { return radius_; }

  [[nodiscard]] std::string_view kind() const noexcept override { return "cycloid"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override;

 private:
  double radius_ = 0.0;
  double length_ = 0.0;
};

}  // namespace glissade
