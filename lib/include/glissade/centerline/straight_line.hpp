#pragma once

#include "glissade/centerline/centerline.hpp"

namespace glissade {

/// The straight track between two points: the yardstick that every other track is measured by.
///
/// Curve: constant slope angle atan2(drop, |run|), no curvature; smooth everywhere.
/// Accuracy: correctly rounded to a few units in the last place.
class StraightLine final : public Centerline {
 public:
  /// @param endpoints  finish as seen from the start [m]; finite, not both zero. The sign of the run is not
  ///   used (x counts towards the finish); run 0 is a vertical track, a negative drop leads uphill.
  /// @throws InputError if a value or the way between them is not finite, or start and finish are the same point
  explicit StraightLine(const Endpoints& endpoints);

  [[nodiscard]] std::string_view kind() const noexcept override { return "straight"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;

 private:
  double run_;
  double drop_;
  double length_;
  double slope_angle_;
};

}  // namespace glissade
