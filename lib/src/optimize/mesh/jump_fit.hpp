#pragma once

#include "optimize/mesh/switches.hpp"

#include <array>
#include <vector>

namespace glissade::optimizer {

/// Slope angle of a track found at any place of its core.
class FoundSlope {
 public:
  explicit FoundSlope(const Found& found);
  /// @param share  of the way through the piece
  [[nodiscard]] double value(std::size_t piece, double share) const;

 private:
  const Transcription& track_;
  const Vector& knots_;
  Vector turns_;
  Vector at_knots_;
};

/// A parabola in sigma.
struct Parabola {
  double origin = 0.0;
  std::array<double, 3> factor{};
  [[nodiscard]] double value(double sigma) const {
    const double t = sigma - origin;
    return factor[0] + t * (factor[1] + t * factor[2]);
  }
  [[nodiscard]] double slope(double sigma) const { return factor[1] + 2.0 * (sigma - origin) * factor[2]; }
};

/// The slope angle sought on one side of a jump.
///
/// The track found differs from it by what is square to every change of shape that the knots allow. Against
/// those that leave the jump alone, the three next to it, a parabola looks the same for both.
/// @param from      the knot at the jump
/// @param backwards  before the jump rather than behind it
/// @param most      pieces up to the next jump; >= 3
[[nodiscard]] Parabola beside_jump(const Vector& knots, const FoundSlope& found, std::size_t from,
                                   bool backwards, std::size_t most);

/// Least squares for a slope angle of two parabolas that meet, through the track before and behind a blurred
/// stretch.
class Kink {
 public:
  /// @param first,last  the knots from and up to which the track is seen
  Kink(const Vector& knots, const FoundSlope& found, std::size_t first, std::size_t last, Span blurred);

  struct Fit {
    double miss = 0.0;  ///< root of the mean square
    double jump = 0.0;  ///< of d zeta/d sigma
  };
  [[nodiscard]] Fit fit(double at) const;
  /// The place within `span` that fits best.
  [[nodiscard]] double best(Span span) const;

 private:
  static constexpr std::size_t kTerms = 5;  // theory: the columns of the fit
  struct Point {
    double sigma = 0.0;
    double zeta = 0.0;
    double weight = 0.0;
  };
  [[nodiscard]] double unit() const { return 0.5 * (seen_.to - seen_.from); }
  [[nodiscard]] std::array<double, kTerms> terms(double sigma, double at) const;

  Span seen_;
  std::vector<Point> points_;
};

}  // namespace glissade::optimizer
