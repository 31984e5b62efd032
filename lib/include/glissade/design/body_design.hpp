#pragma once

#include "glissade/core/units.hpp"

#include <optional>
#include <vector>

namespace glissade {

/// A ball that rolls instead of sliding; BodyDesign::friction is then its rolling resistance.
struct RollingDesign {
  double radius = 0.0;  ///< [m]; > 0
  /// Half the angle between the walls of the groove that it runs in; 90 deg is a flat floor. 0 to 90 deg.
  Angle groove_half_angle = Angle::from_degrees(90.0);
  std::optional<Friction> grip;  ///< while it slips; none: slip is not judged

  friend bool operator==(const RollingDesign&, const RollingDesign&) = default;
};

/// Drag by what it comes from.
struct DragDesign {
  double mass = 0.0;                  ///< [kg]; > 0
  double drag_area = 0.0;             ///< c_d A [m^2]; >= 0
  double altitude = 0.0;              ///< [m], kLowestAltitude to kHighestAltitude
  std::optional<double> temperature;  ///< [K]; none: that of the standard atmosphere at the altitude
  std::optional<double> density;      ///< of the air [kg/m^3]; given instead of altitude and temperature

  /// @return k = density drag_area / (2 mass) [1/m]; not finite where a value breaks its bound
  [[nodiscard]] double drag_per_metre() const;

  friend bool operator==(const DragDesign&, const DragDesign&) = default;
};

/// From here on along the track, friction is another.
struct FrictionFrom {
  double from = 0.0;  ///< arc length [m]
  Friction friction;

  friend bool operator==(const FrictionFrom&, const FrictionFrom&) = default;
};

/// What moves down the track, as a design file gives it.
struct BodyDesign {
  bool friction_given = true;             ///< false: the file leaves it to the material of its stream
  Friction friction;                      ///< the nominal one; of `rolling` its resistance to rolling
  std::optional<Friction> low_friction;   ///< <= friction; limits hold there too
  std::optional<Friction> high_friction;  ///< >= friction; limits hold there too
  double entry_speed = 0.0;               ///< [m/s]; >= 0
  double drag_per_metre = 0.0;            ///< [1/m]; >= 0; follows from `drag` where that is given
  std::optional<DragDesign> drag = {};
  double head_wind = 0.0;  ///< [m/s]; from behind where negative
  /// Of a friction that changes along the track: from the start on, ascending; the first is `friction`.
  std::vector<FrictionFrom> friction_changes = {};
  /// Height of the centre of mass above the track [m]; none: 0 of a sliding body, the radius of a rolling one.
  std::optional<double> centre_height = {};
  std::optional<RollingDesign> rolling = {};  ///< none: it slides

  friend bool operator==(const BodyDesign&, const BodyDesign&) = default;
};

}  // namespace glissade
