#pragma once

#include "glissade/core/units.hpp"
#include "glissade/motion/law.hpp"

#include <optional>

namespace glissade {

/// A ball and the groove that it runs in.
struct BallShape {
  double radius = 0.0;  ///< r [m]; > 0
  /// Half the opening angle of the groove that the ball runs in: it touches the walls r sin(angle) below its
  /// centre; 90 deg is a flat floor. 0 < angle <= 90 deg.
  Angle groove_half_angle = Angle::from_degrees(90.0);
  /// Height of the ball's centre above the track [m]; > 0. None: the radius, as on a flat floor.
  std::optional<double> centre_height;
  /// Friction between ball and track while they slip, which decides whether they do. None: nothing is said.
  std::optional<Friction> grip;
};

/// A solid ball that rolls without slipping; Body::friction is its rolling resistance, force over load.
///
/// f = 1 + (2/5)(r/r_eff)^2 with r_eff = r sin(groove half angle) (docs/theory.md, laws of motion).
/// Quantity 0, "friction_needed": the friction coefficient that rolling without slip takes,
///   |F|/(N/sin(groove half angle)) with F = (f - 1) dv_t/dt + c N; the walls of a groove are pressed more than
///   a floor. Where it exceeds `grip` the ball slips and the ride is not that of a rolling ball. A ball that
///   starts vertically slips there, whatever its grip.
class RollingBall final : public Law {
 public:
  /// @throws InputError if a measure breaks its stated bound
  explicit RollingBall(const BallShape& shape);

  [[nodiscard]] const BallShape& shape() const noexcept { return shape_; }

  [[nodiscard]] std::string_view kind() const noexcept override { return "rolling"; }
  [[nodiscard]] std::string_view resistance_angle_name() const noexcept override {
    return "angle of rolling resistance";
  }
  [[nodiscard]] double inertia() const noexcept override { return inertia_; }
  [[nodiscard]] double centre_height() const noexcept override { return height_; }
  [[nodiscard]] std::vector<LawQuantity> quantities() const override;
  [[nodiscard]] double quantity(std::size_t index, const LawState& state) const override;
  [[nodiscard]] LawPtr in_units(double length, double speed) const override;

 private:
  BallShape shape_;
  double spread_;  ///< sin of the groove's half angle
  double inertia_;
  double height_;
};

}  // namespace glissade
