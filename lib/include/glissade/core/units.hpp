#pragma once

#include <compare>
#include <numbers>
#include <string_view>

namespace glissade {

/// A quarter of a turn [rad], for numerics that count in bare radians; half a turn is std::numbers::pi.
inline constexpr double kRightAngle = std::numbers::pi / 2.0;

/// An angle as a type, so that degrees and radians cannot be mixed up: how public headers take and give one.
/// Samples along a curve, plane geometry and the values of limits stay bare radians
/// (docs/decisions/0008-angles-at-the-edges.md).
///
/// Regular value; holds radians. Slope angles count from the horizontal, positive downhill.
class Angle {
 public:
  constexpr Angle() = default;

  [[nodiscard]] static constexpr Angle from_radians(double radians) { return Angle(radians); }
  [[nodiscard]] static constexpr Angle from_degrees(double degrees) {
    return Angle(degrees * (std::numbers::pi / 180.0));
  }

  [[nodiscard]] constexpr double radians() const { return radians_; }
  [[nodiscard]] constexpr double degrees() const { return radians_ * (180.0 / std::numbers::pi); }

  friend constexpr Angle operator-(Angle a) { return Angle(-a.radians_); }
  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.radians_ + b.radians_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.radians_ - b.radians_); }
  friend constexpr Angle operator*(double factor, Angle a) { return Angle(factor * a.radians_); }
  /// @return its size, without its sign
  friend constexpr Angle abs(Angle a) { return a.radians_ < 0.0 ? -a : a; }

  // The check takes the 0 that a defaulted <=> compares with for a null pointer.
  friend constexpr auto operator<=>(const Angle&, const Angle&) = default;  // NOLINT(modernize-use-nullptr)

 private:
  explicit constexpr Angle(double radians) : radians_(radians) {}
  double radians_ = 0.0;
};

/// Dry (Coulomb) friction between body and track: friction coefficient mu = tan(friction angle).
///
/// Regular value; the default is frictionless.
class Friction {
 public:
  constexpr Friction() = default;

  /// @param angle  friction angle delta; 0 <= delta < 90 deg
  /// @throws InputError if the angle is not in that range
  [[nodiscard]] static Friction from_angle(Angle angle);

  /// @param mu  friction coefficient [-]; finite, >= 0
  /// @throws InputError if mu is negative or not finite
  [[nodiscard]] static Friction from_coefficient(double mu);

  /// @return mu [-]; exactly the value given to from_coefficient
  [[nodiscard]] constexpr double coefficient() const { return coefficient_; }
  /// @return delta = atan(mu)
  [[nodiscard]] Angle angle() const;

  friend constexpr auto operator<=>(const Friction&, const Friction&) = default;

 private:
  explicit constexpr Friction(double mu) : coefficient_(mu) {}
  double coefficient_ = 0.0;
};

/// Gravity that is taken where none is given [m/s^2].
inline constexpr double kDefaultGravity = 9.81;
/// The unit g of loads and accelerations [m/s^2], whatever the gravity of a design.
inline constexpr double kStandardGravity = 9.80665;

/// The unit that the numbers of a file are in.
enum class LengthUnit { millimetre, metre };

/// @return how many of the unit make a metre
[[nodiscard]] constexpr double units_per_metre(LengthUnit unit) {
  return unit == LengthUnit::millimetre ? 1000.0 : 1.0;
}
/// @return "mm", "m"
[[nodiscard]] constexpr std::string_view unit_symbol(LengthUnit unit) {
  return unit == LengthUnit::millimetre ? "mm" : "m";
}

}  // namespace glissade
