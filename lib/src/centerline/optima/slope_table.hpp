#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace glissade::centerline {

/// A plane curve whose slope angle falls or rises steadily, by arc length, from its radius by slope angle.
///
/// Curve: ds/d|zeta| = radius(zeta) > 0, smooth between the ends. Pieces are halved until a Chebyshev series
///   in s gives the turned angle back to rounding; run and drop are the integrals of its cosine and sine.
class SlopeTable {
 public:
  /// Place and direction, from the begin of the table.
  struct Point {
    double slope_angle = 0.0;  ///< [rad]
    double x = 0.0;            ///< [m]
    double drop = 0.0;         ///< [m]
  };

  /// @param begin   slope angle at the begin [rad]
  /// @param turn    slope angle at the end less that at the begin [rad]; not 0
  /// @param radius  of curvature [m], > 0, where the slope angle is that at the begin and so much more [rad], with its
  ///                sign: beside the vertical the sum of both has lost the digits that tell it from there
  SlopeTable(double begin, double turn, const std::function<double(double)>& radius);

  [[nodiscard]] double length() const noexcept { return length_; }
  /// @param s  [m]; in [0, length()], beyond it the nearest end but for rounding
  [[nodiscard]] double slope_angle(double s) const;
  [[nodiscard]] Point at(double s) const;

 private:
  static constexpr std::size_t kTerms = 16;
  using Series = std::array<double, kTerms>;

  struct Piece {
    double begin = 0.0;  // [m]
    double end = 0.0;
    Series turned{};  // angle turned since the begin of the table
    Series x{};       // since the begin of the piece
    Series drop{};
    double first_x = 0.0;  // since the begin of the table
    double first_drop = 0.0;

    [[nodiscard]] double position(double s) const;
  };
  class Builder;

  [[nodiscard]] const Piece& piece_at(double s) const;

  double begin_ = 0.0;
  double sign_ = 1.0;
  double length_ = 0.0;
  std::vector<Piece> pieces_;
};

}  // namespace glissade::centerline
