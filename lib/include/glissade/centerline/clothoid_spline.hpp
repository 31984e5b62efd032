#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

#include <vector>

namespace glissade {

/// One piece of a ClothoidSpline; its curvature is linear in arc length: both zero is a straight, both equal
/// an arc, anything else a clothoid.
struct ClothoidSegment {
  double length = 0.0;           ///< [m]; finite, > 0
  double entry_curvature = 0.0;  ///< kappa where the segment begins [1/m]; finite
  double exit_curvature = 0.0;   ///< kappa where it ends [1/m]; finite

  friend bool operator==(const ClothoidSegment&, const ClothoidSegment&) = default;
};

/// A track put together from straights, arcs and clothoids, as track builders draw it.
///
/// Curve: curvature piecewise linear in arc length. Position and slope angle are continuous; curvature may
///   jump from one segment to the next (at() gives the value after the jump). The track may overhang or loop.
/// Cost: construction O(n + angle turned), at() O(log n).
/// Accuracy: clothoid_accuracy(turning) * length() in position.
class ClothoidSpline final : public Centerline {
 public:
  /// @param entry_slope_angle  zeta at the start; finite
  /// @param segments           in order from the start; at least one
  /// @throws InputError naming the segment if there is none, a length is not positive and finite, nor that of
  ///   all together, a curvature is not finite, or the track turns by more than kMostTurning in all
  ClothoidSpline(Angle entry_slope_angle, std::vector<ClothoidSegment> segments);

  [[nodiscard]] std::string_view kind() const noexcept override { return "segments"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  /// @return the joints between segments, with start and finish
  [[nodiscard]] std::vector<double> breaks() const override { return joints_; }

  [[nodiscard]] Angle entry_slope_angle() const noexcept { return entry_slope_angle_; }
  [[nodiscard]] const std::vector<ClothoidSegment>& segments() const noexcept { return segments_; }

 private:
  /// A stretch of one segment that turns little, with the curve at its beginning.
  struct Piece {
    CenterlinePoint start;
    double curvature_rate = 0.0;  // d kappa/ds [1/m^2]
  };
  [[nodiscard]] const Piece& piece_at(double s) const;

  Angle entry_slope_angle_;
  std::vector<ClothoidSegment> segments_;
  std::vector<double> joints_;
  std::vector<Piece> pieces_;
  double length_ = 0.0;
};

/// Stated bound of the position error of ClothoidSpline, relative to the length of the track, where it turns by no more than
/// some loops.
inline constexpr double kClothoidAccuracy = 1e-14;
/// The same of every track: a slope angle keeps its last digit of all that was turned.
/// @param turning  of the segments, adding up left and right turns [rad]; up to kMostTurning
[[nodiscard]] constexpr double clothoid_accuracy(double turning) {
  return kClothoidAccuracy + 2e-16 * turning;  // accuracy: measured up to 1e6 rad, half of it
}

/// The most that the segments of one ClothoidSpline may turn, adding up left and right turns [rad].
inline constexpr double kMostTurning = 1e6;

}  // namespace glissade
