#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/vec.hpp"

#include "centerline/numerics/symmetric_matrix.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace glissade::centerline {

[[nodiscard]] inline Vec2 perpendicular(Vec2 a) {
  return {-a.y, a.x};
}

/// The unknowns: a curve of length `length` whose curvature times length is `bend` at the knots, linear
/// between. The place on it is u = s / length, so that the shape does not depend on the length.
struct Shape {
  double entry = 0.0;  // slope angle at the start
  double length = 0.0;
  std::vector<double> bend;
};

/// Order of the unknowns in a vector: entry slope angle, length, bends.
inline constexpr std::size_t kEntry = 0;
inline constexpr std::size_t kLength = 1;
inline constexpr std::size_t kFirstBend = 2;

/// The sum of squares about one shape, to second order without the curvature of its terms.
struct Linearized {
  explicit Linearized(std::size_t unknowns) : matrix(unknowns), gradient(unknowns, 0.0) {}
  SymmetricMatrix matrix;        // of the mean of (distance/scale)^2 / 2
  std::vector<double> gradient;  // of the same
  double mean_square = 0.0;      // of distance/scale
};

/// @return for each point its arc length along a polygon through those points that lie well apart: the way
/// through all of them grows with their noise
[[nodiscard]] std::vector<double> rough_arc_lengths(const std::vector<Vec2>& points);

/// Points in order and clothoid splines beside them: how far one is from the other, how that changes with
/// the spline, and how rough the spline is.
class ProfileModel {
 public:
  /// @param points  from the origin, at least 3
  explicit ProfileModel(std::vector<Vec2> points);

  [[nodiscard]] std::size_t point_count() const { return points_.size(); }
  /// Whether the curve has as many numbers as the points give equations: one each, the last two, the first none.
  [[nodiscard]] bool can_interpolate() const { return unknowns() >= points_.size(); }

  /// @return a shape from the directions of a few chords: near enough for an iteration, hardly touched by
  /// noise
  [[nodiscard]] Shape first_shape() const;
  /// Moves the points' places on the curve to where it is nearest, and measures from there.
  [[nodiscard]] Linearized linearized(const Shape& shape);
  /// @return integral of (d bend/du)^2
  [[nodiscard]] double roughness(const Shape& shape) const;
  /// Adds half of smoothing * roughness to the second-order sum.
  void add_roughness(const Shape& shape, double smoothing, Linearized& sum) const;
  [[nodiscard]] ClothoidSpline spline(const Shape& shape) const;

 private:
  struct Local {
    Vec2 position;
    Vec2 tangent;
    Vec2 turned;  // integral of the perpendicular of the tangent over the knot interval so far, times length
    Vec2 left_turned;  // the same, weighted by what the interval's left bend has turned
    Vec2 right_turned;
  };

  /// What a point sees of the unknowns: every complete knot before it in three ways, and four of its own.
  static constexpr std::size_t kSight = 7;
  enum : std::size_t { kByX, kByDrop, kByArea, kOwnLeft, kOwnRight, kOwnEntry, kOwnLength };
  using Sight = std::array<double, kSight>;

  [[nodiscard]] std::size_t unknowns() const { return kFirstBend + knots_.size(); }
  [[nodiscard]] std::size_t interval_of(double u) const;
  [[nodiscard]] double width(std::size_t interval) const { return knots_[interval + 1] - knots_[interval]; }
  [[nodiscard]] double area_before(std::size_t knot) const { return knot == 0 ? 0.0 : 0.5 * width(knot - 1); }
  void place_knots();
  void lay_out(const Shape& shape);
  [[nodiscard]] double slope_at(const Shape& shape, std::size_t interval, double local) const;
  [[nodiscard]] Local local_at(const Shape& shape, std::size_t interval, double u) const;
  void project(const Shape& shape);
  void add_interval(std::size_t interval, const std::array<Sight, kSight>& gram, const Sight& moment,
                    Linearized& sum) const;

  std::vector<Vec2> points_;
  std::vector<double> places_;  // u of each point
  std::vector<double> knots_;   // u
  double scale_ = 0.0;          // length of the polygon through the points
  // Of the shape laid out last, at each knot.
  std::vector<Vec2> knot_positions_;
  std::vector<double> knot_slopes_;
  std::vector<std::vector<Vec2>> knot_changes_;  // of position by each bend
};

}  // namespace glissade::centerline
