#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/arc_path.hpp"

#include <cstddef>
#include <vector>

namespace glissade {

/// One arc or straight piece of an ArcSpline.
struct TrackArc {
  double start = 0.0;        ///< arc length where it begins [m]
  double length = 0.0;       ///< [m]
  double slope_angle = 0.0;  ///< zeta where it begins [rad]
  double curvature = 0.0;    ///< kappa, positive in a valley; 0: straight [1/m]
};

/// Largest angle at which two pieces of an ArcSpline may meet, as a rule [rad].
inline constexpr double kArcSplineKink = 1e-9;

/// A track of straight lines and circular arcs that meet with a common tangent: what a shop cuts, rolls and sets out.
///
/// Curve: curvature piecewise constant, position and slope angle continuous. Pieces that rise by less than 5e-11 of their length,
/// which is what rounding leaves of a straight, are straight to the last bit: curvature and bulge 0.
/// Accuracy: joints are the vertices of the path to the last bit; kArcSplineAccuracy * length() in between.
/// Identity: an offset of it is concentric arcs with the same joints, exactly.
class ArcSpline final : public Centerline {
 public:
  /// @param path  open, in the frame (x, height): x as a centerline has it, height = -drop; starts at the origin
  /// @param largest_kink  more of a line that nothing runs on: the flats that bent plates are [rad]
  /// @throws InputError if there are fewer than two vertices, the first is not the origin, a piece has no length, a
  ///   place or bulge is not finite, or two pieces meet at more than `largest_kink`; names the joint
  explicit ArcSpline(ArcPath path, double largest_kink = kArcSplineKink);

  [[nodiscard]] std::string_view kind() const noexcept override { return "arc-spline"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  [[nodiscard]] std::vector<double> breaks() const override;

  [[nodiscard]] const ArcPath& path() const noexcept { return path_; }
  [[nodiscard]] const std::vector<TrackArc>& arcs() const noexcept { return arcs_; }
  /// @return index of the arc at an arc length; at a joint, of the one after it
  [[nodiscard]] std::size_t arc_at(double s) const;

 private:
  ArcPath path_;
  std::vector<TrackArc> arcs_;
  double length_ = 0.0;
};

/// Stated bound of the position error of ArcSpline between its joints, relative to the length of the track.
inline constexpr double kArcSplineAccuracy = 1e-14;
}  // namespace glissade
