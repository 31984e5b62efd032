#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace glissade {

/// How the straight of an in-run passes into its table.
enum class InRunTransition {
  cubic,     ///< FIS norm 2008 and later: CubicBend, curvature 0 at E1, 1/r1 at E2
  circle,    ///< before: an arc of radius r1; curvature jumps at E1 and at E2
  clothoid,  ///< curvature grows in proportion to arc length, from 0 at E1 to 1/r1 at E2
  two_radii  ///< curvature changes in proportion to arc length, from 1/first_radius at E1 to 1/r1 at E2
};

/// The shape of an in-run by the letters of its certificate (FIS ICR/IWO 411).
struct InRunShape {
  Angle gamma;          ///< slope angle of the straight
  Angle alpha;          ///< slope angle of the table; below gamma
  double r1 = 0.0;      ///< radius of the transition where it ends, E2 [m]; > 0
  double t = 0.0;       ///< length of the table [m]; > 0
  double length = 0.0;  ///< from the highest start A to the edge, table included [m]
  InRunTransition transition = InRunTransition::cubic;
  double first_radius = 0.0;  ///< of `two_radii`: where the transition begins, E1 [m]; > 0

  friend bool operator==(const InRunShape&, const InRunShape&) = default;
};

/// @return every letter of a shape that is out of its range, its `length` aside: `where` is the letter
[[nodiscard]] std::vector<Issue> letter_problems(const InRunShape& shape);

/// @return arc length of the transition of a shape, from E1 to E2 [m]; its `length` is not asked
/// @throws InputError as InRun, but for the length
[[nodiscard]] double transition_length(const InRunShape& shape);

/// The in-run of a ski jump: a straight, a transition and the take-off table, down to the take-off edge T.
///
/// Curve: slope angle gamma from the start A to E1, falling to alpha at E2, alpha to the edge T. Curvature is that of the
///   transition between E1 and E2 and 0 elsewhere: it jumps at E2, by the norm, and of a circle or two radii at E1.
/// Accuracy: kInRunAccuracy, relative to the length, in arc length and position.
/// Identity: breaks() are A, E1, E2 and T.
class InRun final : public Centerline {
 public:
  /// @throws InputError if an angle, a length or a radius is out of its range, gamma is not above alpha, or the
  ///   transition and the table are longer than the in-run
  explicit InRun(const InRunShape& shape);
  ~InRun() override;
  InRun(const InRun&) = delete;
  InRun& operator=(const InRun&) = delete;

  [[nodiscard]] std::string_view kind() const noexcept override { return "in-run"; }
  [[nodiscard]] double length() const noexcept override { return shape_.length; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  [[nodiscard]] std::vector<double> breaks() const override;

  [[nodiscard]] const InRunShape& shape() const noexcept { return shape_; }
  /// @return arc length of E1, where the transition begins [m]
  [[nodiscard]] double transition_begins() const noexcept { return e1_; }
  /// @return arc length of E2, where it ends and the table begins [m]
  [[nodiscard]] double table_begins() const noexcept { return e2_; }

 private:
  class Bend;

  InRunShape shape_;
  double e1_ = 0.0;
  double e2_ = 0.0;
  std::unique_ptr<const Bend> bend_;
  CenterlinePoint begin_of_table_;
};

/// Stated bound of the position and arc-length error of InRun, relative to its length.
inline constexpr double kInRunAccuracy = 1e-14;

}  // namespace glissade
