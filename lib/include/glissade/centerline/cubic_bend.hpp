#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

#include <array>
#include <cstddef>

namespace glissade {

/// A bend that begins without curvature: a cubic parabola in the frame of its first tangent, as the FIS norm has
/// it for in-runs since 2008.
///
/// Curve: eta = C xi^3 for 0 <= xi <= d, xi along the first tangent, eta square to it towards the side that it bends
///   to; d = 2 R sin D cos^2 D, C = tan D/(3 d^2): it turns by D, its curvature is 0 where it begins and 1/R where
///   it ends (docs/theory.md, in-runs).
/// Source: Gasser, Standards for the Construction of Jumping Hills (2012), as programs that follow it state it;
///   derived again in docs/theory.md.
/// Accuracy: kCubicBendAccuracy, relative, of arc length and position.
/// Identity: at(length()) turns by turn(), with curvature 1/end_radius().
class CubicBend {
 public:
  /// One place of the bend, in the frame of its first tangent.
  struct Place {
    double along = 0.0;      ///< xi [m]
    double across = 0.0;     ///< eta, towards the side that it bends to [m]
    double turned = 0.0;     ///< angle by which it has turned [rad]; >= 0
    double curvature = 0.0;  ///< [1/m]; >= 0
  };

  /// @param turn        D; above 0, at most kMostTurn
  /// @param end_radius  R [m]; kShortestWay to kLongestWay
  /// @throws InputError if one is out of its range
  CubicBend(Angle turn, double end_radius);

  [[nodiscard]] Angle turn() const noexcept { return turn_; }
  [[nodiscard]] double end_radius() const noexcept { return end_radius_; }
  /// @return d, how far it leads along its first tangent [m]
  [[nodiscard]] double reach() const noexcept { return reach_; }
  /// @return f, how far it ends off its first tangent [m]
  [[nodiscard]] double offset() const noexcept { return reach_ * tan_turn_ / 3.0; }
  /// @return arc length [m]
  [[nodiscard]] double length() const noexcept { return length_; }

  /// @param s  arc length from where it begins [m]; 0 to length(), which is not checked
  [[nodiscard]] Place at(double s) const;

  /// The largest turn up to which curvature grows all along, atan(1/sqrt(5)): some 24.1 deg. Bends that turn by more are
  /// sharpest before their end, where their slope against the first tangent is 1/sqrt(5).
  static constexpr Angle kGrowingTurn = Angle::from_radians(0.42053433528396510);
  /// The most that it may turn: up to there the stated accuracy holds.
  static constexpr Angle kMostTurn = Angle::from_degrees(50.0);
  /// @return the smallest radius of curvature [m]: the end radius up to kGrowingTurn, less beyond
  [[nodiscard]] double smallest_radius() const;

 private:
  static constexpr std::size_t kTerms = 36;

  Angle turn_;
  double end_radius_;
  double tan_turn_;
  double reach_;
  double length_;
  std::array<double, kTerms> along_per_length_;  // xi/s as a Chebyshev series in (s/length)^4
};

/// Stated bound of the relative error of CubicBend's arc length and positions.
inline constexpr double kCubicBendAccuracy = 1e-14;

}  // namespace glissade
