#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/clothoid_spline.hpp"

#include "support/random.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

/// Tracks that the tests of Motion slide down.
namespace testing {

inline std::shared_ptr<const glissade::ClothoidSpline> track(
    double entry_slope_angle, std::vector<glissade::ClothoidSegment> segments) {
  return std::make_shared<const glissade::ClothoidSpline>(glissade::Angle::from_radians(entry_slope_angle),
                                                          std::move(segments));
}

/// Downhill on the whole, with valleys, crests and straights; curvature continuous.
inline std::shared_ptr<const glissade::ClothoidSpline> random_smooth_track(Random& random) {
  const double scale = std::pow(10.0, random.between(-1.0, 2.0));
  const double entry = random.between(0.4, 1.4);
  std::vector<glissade::ClothoidSegment> segments;
  double curvature = 0.0;
  double slope = entry;
  const int count = random.integer(2, 8);
  for (int i = 0; i < count; ++i) {
    const double length = random.between(0.2, 1.0) * scale;
    // Turns towards a slope between -0.2 and 1.2 rad by the end of the segment.
    const double turn = slope - random.between(-0.2, 1.2);
    const double next = random.integer(0, 3) == 0 ? curvature : 2.0 * turn / length - curvature;
    segments.push_back({length, curvature, next});
    slope -= 0.5 * length * (curvature + next);
    curvature = next;
  }
  return track(entry, segments);
}

/// The same with jumps of curvature.
inline std::shared_ptr<const glissade::ClothoidSpline> random_rough_track(Random& random) {
  const auto smooth = random_smooth_track(random);
  std::vector<glissade::ClothoidSegment> segments = smooth->segments();
  for (auto& segment : segments) {
    if (random.integer(0, 1) == 0) continue;
    segment.entry_curvature = 0.5 * (segment.entry_curvature + segment.exit_curvature);
    segment.exit_curvature = segment.entry_curvature;
  }
  return track(smooth->entry_slope_angle().radians(), segments);
}

/// A cycloid from its cusp, where it is vertical and its curvature unbounded: slope angle 90 deg - theta/2.
class Cycloid final : public glissade::Centerline {
 public:
  Cycloid(double radius, double theta_end) : radius_(radius), length_(arc_length(theta_end)) {}

  [[nodiscard]] std::string_view kind() const noexcept override { return "test-cycloid"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override { return true; }
  [[nodiscard]] glissade::CenterlinePoint at(double s) const override {
    require_on_track(s);
    const double theta = 4.0 * std::asin(std::sqrt(s / (8.0 * radius_)));
    return {s, radius_ * (theta - std::sin(theta)), 2.0 * radius_ * std::pow(std::sin(0.5 * theta), 2),
            0.5 * (std::numbers::pi - theta), 1.0 / (4.0 * radius_ * std::sin(0.5 * theta))};
  }
  [[nodiscard]] double arc_length(double theta) const {
    return 8.0 * radius_ * std::pow(std::sin(0.25 * theta), 2);
  }

 private:
  double radius_;
  double length_;
};

}  // namespace testing
