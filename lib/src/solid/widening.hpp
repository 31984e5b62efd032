#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/section/cross_section.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace glissade::solid {

/// How a cross-section changes along a track: each corner moves across from its place at the narrowest section to that
/// at the widest, in proportion to the width. Nothing moves where the width is constant.
class Widening {
 public:
  explicit Widening(const CrossSection& section);

  [[nodiscard]] bool varies() const { return law_.has_value(); }
  [[nodiscard]] const CrossSection& narrow() const { return narrow_; }
  [[nodiscard]] const CrossSection& wide() const { return wide_; }

  /// @return t(s), the share of the way from the narrowest section to the widest; 0 where the width is constant
  [[nodiscard]] double share(double s) const;

  /// @return integral of t over arc length [m]
  [[nodiscard]] double over_length(double from, double to) const;
  /// @return integral of t over the slope angle [rad], to 1e-9 of the range
  [[nodiscard]] double over_slope(const Centerline& centerline, double from, double to) const;

  /// @return the places where the law bends, strictly between two arc lengths
  [[nodiscard]] std::vector<double> knots_between(double from, double to) const;

 private:
  std::optional<WidthLaw> law_;  // none: constant
  CrossSection narrow_;
  CrossSection wide_;
  double least_ = 0.0;
  double most_ = 0.0;
};

/// A centerline with further breaks: stations stand where a width begins or ends to change.
class WithBreaks final : public Centerline {
 public:
  /// @param centerline  outlives this
  WithBreaks(const Centerline& centerline, const std::vector<double>& further);

  [[nodiscard]] std::string_view kind() const noexcept override { return centerline_.kind(); }
  [[nodiscard]] double length() const noexcept override { return centerline_.length(); }
  [[nodiscard]] CenterlinePoint at(double s) const override { return centerline_.at(s); }
  [[nodiscard]] double slope_angle(double s) const override { return centerline_.slope_angle(s); }
  [[nodiscard]] Direction direction(double s) const override { return centerline_.direction(s); }
  [[nodiscard]] std::vector<double> breaks() const override { return breaks_; }
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override {
    return centerline_.unbounded_curvature_at_start();
  }

 private:
  const Centerline& centerline_;
  std::vector<double> breaks_;
};

}  // namespace glissade::solid
