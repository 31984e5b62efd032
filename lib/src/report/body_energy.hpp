#pragma once

#include "glissade/motion/motion.hpp"

namespace glissade::report {

/// What a body has of mechanical energy per mass. Its centre of mass may run above the track, and its spin stores energy too;
/// with the losses of a MotionState these sum to one constant all along a ride (docs/theory.md, M3).
class BodyEnergy {
 public:
  explicit BodyEnergy(const Motion& motion);

  /// @return f, inertia over mass
  [[nodiscard]] double inertia() const noexcept { return inertia_; }
  /// @return h, of the centre of mass above the track [m]
  [[nodiscard]] double centre_height() const noexcept { return height_; }
  /// @return of the centre of mass above its lowest place on the ride [J/kg]; off by what lies between two stations
  [[nodiscard]] double potential(const MotionState& state) const;
  /// @return of motion and spin [J/kg]
  [[nodiscard]] double kinetic(const MotionState& state) const noexcept;

 private:
  [[nodiscard]] double centre_drop(double s) const;

  const Motion& motion_;
  double inertia_;
  double height_;
  double lowest_ = 0.0;
};

}  // namespace glissade::report
