#pragma once

#include "glissade/centerline/centerline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::shapes {

/// A cycloid from its cusp, straight down at first, by its textbook form: x = a (t - sin t), drop = a (1 -
/// cos t), s = 4 a (1 - cos(t/2)), slope angle = (pi - t)/2, radius = 4 a sin(t/2). The normal at t meets the
/// level of the start at height 2 a sin(t/2), half the radius, and at run a t.
class CycloidTrack : public Centerline {
 public:
  CycloidTrack(double a, double last_t) : a_(a), last_t_(last_t) {}

  [[nodiscard]] std::string_view kind() const noexcept override { return "cycloid by its textbook form"; }
  [[nodiscard]] double length() const noexcept override { return arc_length(last_t_); }
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override { return true; }
  [[nodiscard]] CenterlinePoint at(double s) const override {
    // 1 - cos(t/2) = s/(4a), taken through the quarter angle, which does not cancel near the cusp.
    const double half = 2.0 * std::asin(std::sqrt(std::min(1.0, s / (8.0 * a_))));
    const double t = 2.0 * half;
    return {s, a_ * (t < 1e-2 ? t * t * t / 6.0 * (1.0 - t * t / 20.0) : t - std::sin(t)),
            2.0 * a_ * std::sin(half) * std::sin(half), 0.5 * std::numbers::pi - half,
            1.0 / (4.0 * a_ * std::sin(half))};
  }

  [[nodiscard]] double arc_length(double t) const {
    const double quarter = std::sin(0.25 * t);
    return 8.0 * a_ * quarter * quarter;
  }

 private:
  double a_;
  double last_t_;
};

}  // namespace glissade::shapes
