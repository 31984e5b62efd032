#pragma once

#include "glissade/core/units.hpp"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace glissade {

/// What moves, by kind. A kind names itself and its measures once: `visit` shows each to a visitor under its key in a
/// design file, in the order in which people read them. The reader, the checks, the schema, writing back, JSON and the
/// texts of a report are such visitors; lib/src/pipeline/task/body.cpp makes the law of motion of it:
///
///     visitor.resistance(key, example);              // BodyDesign::friction, as force over load; may be a range
///     visitor.length(key, value, least, most, why, example);
///     visitor.angle(key, value, most, why, hint);    // above 0, at most `most`, which it is if left out
///     visitor.grip(value, why);                      // one friction that holds it, and does not slow it down
///
/// A point or rider that slides: its friction is friction_angle, friction_coefficient or a list.
struct SlidingDesign {
  static constexpr std::string_view kKind = "sliding";
  static constexpr std::string_view kNoun = "A sliding body";
  static constexpr std::string_view kDoes = "slides";
  static constexpr std::string_view kResistance = {};  ///< key of its resistance; empty: one of friction

  static void visit(auto& /*self*/, auto&& /*visitor*/) {}
  [[nodiscard]] static constexpr double default_centre_height() { return 0.0; }

  friend bool operator==(const SlidingDesign&, const SlidingDesign&) = default;
};

/// A ball that rolls instead of sliding; BodyDesign::friction is then its rolling resistance.
struct RollingDesign {
  static constexpr std::string_view kKind = "rolling";
  static constexpr std::string_view kNoun = "A rolling body";
  static constexpr std::string_view kDoes = "rolls";
  static constexpr std::string_view kResistance = "rolling_resistance";
  double radius = 0.0;  ///< [m]; > 0
  /// Half the angle between the walls of the groove that it runs in; 90 deg is a flat floor. 0 to 90 deg.
  Angle groove_half_angle = Angle::from_degrees(90.0);
  std::optional<Friction> grip;  ///< while it slips; none: slip is not judged

  static void visit(auto& self, auto&& visitor) {
    visitor.resistance("rolling_resistance", "0.01, force over load");
    visitor.length("radius", self.radius, 1e-6, 1e3, "A ball's radius lies between 0.001 mm and 1 km.",
                   "8 mm");
    visitor.angle("groove_half_angle", self.groove_half_angle, Angle::from_degrees(90.0),
                  "It lies above 0 and is at most 90 deg, which is a flat floor.",
                  "half the angle between the walls of the groove");
    visitor.grip(self.grip,
                 "It decides whether the ball slips; what slows it down is its rolling_resistance.");
  }
  /// @return height of the centre of mass where the design does not say it [m]
  [[nodiscard]] double default_centre_height() const { return radius; }

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

/// A kind that is added here is read, checked, written back and named.
using BodyKind = std::variant<SlidingDesign, RollingDesign>;

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
  BodyKind kind = {};

  /// @return whether the wind, too, can drive it: it blows from behind a body that has drag
  [[nodiscard]] bool is_driven_by_wind() const { return head_wind < 0.0 && drag_per_metre > 0.0; }
  [[nodiscard]] bool slides() const { return std::holds_alternative<SlidingDesign>(kind); }
  /// @return the ball; null of another kind
  [[nodiscard]] const RollingDesign* rolling() const { return std::get_if<RollingDesign>(&kind); }

  friend bool operator==(const BodyDesign&, const BodyDesign&) = default;
};

/// Shows every measure of a body's kind to a visitor.
void visit_measures(const BodyDesign& body, auto&& visitor) {
  std::visit([&](const auto& kind) { kind.visit(kind, visitor); }, body.kind);
}

}  // namespace glissade
