#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/vec.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// How smooth a FittedProfile is.
struct ProfileFit {
  /// The farthest that a point may lie from the curve [m]; > 0. The curve is the smoothest that keeps to it.
  /// None: the curve finds the noise of the points by itself. Fewer than 20 points cannot show it, nor can points
  /// that lie far apart for their noise: through such the curve passes.
  std::optional<double> max_deviation;
};

/// One measured point and the curve that was fitted to it.
struct PointDeviation {
  double arc_length = 0.0;  ///< of the place on the curve that is nearest to the point [m]
  double deviation =
      0.0;  ///< distance from there to the point, positive where the point lies below the curve [m]
};

/// What points leave open of the largest curvature of their profile [1/m], its magnitude.
struct CurvatureRange {
  double least = 0.0;
  double greatest = 0.0;
};

/// @return the radii as "16.1 m to 35 m" or, where a straight is among them, "16.1 m or more"
[[nodiscard]] std::string radius_range_text(const CurvatureRange& range);

/// A smallest radius is open where points allow another that is off by more than this share.
inline constexpr double kOpenRadius = 0.05;

/// Why points are no profile, and which of them shows it.
struct ProfileFault {
  std::optional<std::size_t> point;  ///< its index; none where there are too few of them
  Issue issue;  ///< `where` names the point by number, counted from 1, and its coordinates
};

/// @param points  as FittedProfile takes them
/// @return the first fault; none if the points make a profile
[[nodiscard]] std::optional<ProfileFault> profile_fault(const std::vector<Vec2>& points);

/// A measured or hand-drawn profile as a smooth curve, so that an existing chute can be assessed.
///
/// Measured points cannot be slid on as they are: the curvature of a line through them is mostly their noise,
/// and curvature drives the normal load. So the curve is described in one of three ways. Of the first
/// two whichever the Bayesian information criterion finds the better one:
/// - as few pieces: straights, arcs, clothoids and bends whose curvature is a polynomial, with curvature jumps and
///   kinks between them where the points show them (a track that builders drew; the in-run of a ski jump).
///   Straights, arcs and clothoids come back to rounding from exact points; straights that meet at an angle have the
///   longest arc there that passes none of their points, down to 1e-7 of the length where a point lies in the kink;
/// - as a clothoid spline of many pieces, curvature continuous, that minimises
///     mean of (distance / length)^2 + smoothing * length^3 * integral of (d kappa/ds)^2 ds
///   over all clothoid splines from the first point, the smoothing chosen by cross-validation, or, where rounding tells the
///   noise of points that this would follow, by Mallows' score. Where its knots are few for its waves, more clothoids stand
///   for them. This is the only way if max_deviation is given;
/// - as clothoids along a spline of fifth degree through the points (less their noise, where they show some), where that
///   leaves less open between exact points than the smooth curve, or where the smooth curve misses what they show.
/// What the description costs is told by the deviations.
/// Where the curve overhangs, or bends at once or leaves more than noise where points at an end lie within it, as those of a cycloid
/// do at its start, such points count as their mean: a curve led to one of them bends to come to the others. What still passes
/// 90 deg either way is a vertical straight.
/// Frame: the start (0, 0) is the place of the curve nearest to the first point, the finish that nearest to the
///   last one. Where the last point lies to the left of the first, the profile is mirrored: x counts towards the
///   finish.
/// Curve: curvature is piecewise linear between breaks(); it may jump there. Of more than 1000 points the smooth
///   curve is fitted to means of neighbours, of more than 2000 the spline; deviations are always those of every point.
/// Accuracy: docs/accuracy.md, profiles fitted to exact points.
/// Cost: of what builders draw some 0.1 s for 100 points, 1 to 2 s for 2000; of smooth waves, whose pieces no drawing has,
///   mostly 1 to 3 s.
/// Identity: exact points of an arc or a straight give that arc or straight.
class FittedProfile final : public Centerline {
 public:
  /// @param points  (run, drop) [m] in order along the track, at least 3; the run may go backwards where the
  ///   track does, the order may not. In any frame with x horizontal and y down.
  /// @throws InputError with the profile_fault(), or if max_deviation is not positive and finite
  /// @throws InfeasibleError if no curve of this kind comes as near to all points as max_deviation asks; it
  ///   says how near the best one comes
  explicit FittedProfile(std::vector<Vec2> points, const ProfileFit& fit = {});

  [[nodiscard]] std::string_view kind() const noexcept override { return "points"; }
  [[nodiscard]] double length() const noexcept override { return curve_.length(); }
  [[nodiscard]] CenterlinePoint at(double s) const override { return curve_.at(s); }
  [[nodiscard]] double slope_angle(double s) const override { return curve_.slope_angle(s); }
  [[nodiscard]] Direction direction(double s) const override { return curve_.direction(s); }
  [[nodiscard]] std::vector<double> breaks() const override { return curve_.breaks(); }

  /// @return the points (run, drop) [m] in the frame of the centerline
  [[nodiscard]] const std::vector<Vec2>& points() const noexcept { return points_; }
  /// @return what the fit cost, point by point
  [[nodiscard]] const std::vector<PointDeviation>& deviations() const noexcept { return deviations_; }
  /// @return the largest distance of a point from the curve [m]
  [[nodiscard]] double max_deviation() const noexcept {
    return std::fabs(deviations_[farthest_point_].deviation);
  }
  /// @return index of the point that lies farthest from the curve
  [[nodiscard]] std::size_t farthest_point() const noexcept { return farthest_point_; }
  /// @return root of the mean squared distance [m]
  [[nodiscard]] double rms_deviation() const noexcept { return rms_deviation_; }
  /// @return true where the curve leaves out more than kLargeDeviation of the profile's own shape: of the root of
  ///         the mean squared distance of the points from the straight line between the ends. Either the points
  ///         are very noisy, or they are too few for their shape.
  [[nodiscard]] bool leaves_out_much() const noexcept {
    return rms_deviation_ > kLargeDeviation * rms_bulge_;
  }
  static constexpr double kLargeDeviation = 0.1;
  /// @return an estimate of how far the curve may be from the profile between the points, within a factor of some two
  ///         where they are 5 to 12 to a wave [m]; 0 where few pieces describe them
  [[nodiscard]] double between_points() const noexcept { return between_points_; }
  /// @return true where between_points() is more than 1 % of the profile's own shape (as leaves_out_much() has it) and
  ///         more than 1e-4 of its length: the points are too few for their bends, although the curve meets them
  [[nodiscard]] bool leaves_gaps() const noexcept;
  /// @return true where the deviations of neighbouring points go together, as no noise does: what they show of the
  ///         profile is not in the curve (Durbin and Watson's question). Never of fewer than 20 points, nor where a
  ///         max_deviation was asked for, which leaves such a pattern by design, nor of deviations that are next to
  ///         nothing.
  [[nodiscard]] bool leaves_pattern() const noexcept { return leaves_pattern_; }
  /// @return by how many times as much as the other points in the root of their mean square the curve misses the
  ///         farthest_point(): a slip of whoever measured it, or a bend that it alone shows. None up to 6 times, as far as
  ///         noise goes, nor of fewer than 12 points, of 0.1 % of the profile's own shape or less (as leaves_out_much()
  ///         has it), or where a max_deviation was asked for.
  [[nodiscard]] const std::optional<double>& farthest_stands_out() const noexcept {
    return farthest_stands_out_;
  }
  /// @return the largest curvatures of curves that describe the points as well as curve() does, as far as a profile
  ///         likelihood or a Bayesian score within 6 of the best one goes: of the pieces, wherever they end, and of other
  ///         pieces in their place; of the smooth curve, two standard deviations of Wahba's posterior. The curve's own
  ///         lies between. Of a curve through points that cross-validation would have left to noise, its own and the one of that
  ///         other curve. Of exact points: of a curve through them, as far as the one through every second of them differs; of
  ///         pieces only where fewer points lie along some than these have unknowns, or where they leave something of
  ///         the points. None of other pieces, where too few points tell, or with a max_deviation. It is no interval of confidence:
  ///         where pieces are others than those tried, the profile's own may lie outside (docs/accuracy.md).
  [[nodiscard]] const std::optional<CurvatureRange>& largest_curvature() const noexcept {
    return largest_curvature_;
  }
  /// @return true where largest_curvature() reaches more than kOpenRadius beyond the curve's own
  [[nodiscard]] bool leaves_radius_open() const;
  /// @return the fitted curve
  [[nodiscard]] const ClothoidSpline& curve() const noexcept { return curve_; }

 private:
  /// Points in the frame of the curve that was fitted to them.
  struct Fitted {
    std::vector<Vec2> points;
    ClothoidSpline curve;
    double between = 0.0;
    double last_place = 0.0;  // to which the points were rounded, where it shows
    std::optional<CurvatureRange> largest_curvature;
  };
  [[nodiscard]] static Fitted fitted(std::vector<Vec2> points, const ProfileFit& fit);
  explicit FittedProfile(Fitted fitted);

  std::vector<Vec2> points_;
  ClothoidSpline curve_;
  std::vector<PointDeviation> deviations_;
  std::size_t farthest_point_ = 0;
  double rms_deviation_ = 0.0;
  double rms_bulge_ = 0.0;
  double between_points_ = 0.0;
  double last_place_ = 0.0;
  std::optional<CurvatureRange> largest_curvature_;
  bool leaves_pattern_ = false;
  std::optional<double> farthest_stands_out_;
};

/// The most knots of the smooth curve; along a spline through the points there are more.
inline constexpr int kMostProfileKnots = 120;

}  // namespace glissade
