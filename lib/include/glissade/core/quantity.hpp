#pragma once

#include "glissade/core/error.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace glissade {

/// What a value measures. Its units are listed in docs/design-file.md.
enum class Dimension {
  number,           ///< plain, or with %
  length,           ///< [m]
  angle,            ///< [rad]
  speed,            ///< [m/s]
  acceleration,     ///< [m/s^2]; the unit g is kStandardGravity
  per_length,       ///< curvature, drag [1/m]
  per_area,         ///< rate of curvature along the track [1/m^2]
  specific_energy,  ///< energy per mass, the square of a speed [m^2/s^2]
  time,             ///< [s]
  time_per_speed,   ///< what a unit of speed is worth in time [s/(m/s)]
  mass,             ///< [kg]
  area,             ///< [m^2]
  density,          ///< [kg/m^3]
  temperature,      ///< [K]
  mass_flow,        ///< [kg/s]
  pressure,         ///< hardness too [Pa]
  power_per_area,   ///< of rubbing [W/m^2]
};

/// As parse_quantity().
/// @return the value in SI units and radians, or what is wrong with the text (its `where` left empty)
[[nodiscard]] std::variant<double, Issue> read_quantity(std::string_view text, Dimension dimension,
                                                        std::string_view name);

/// Reads a value as design files and options write it: a decimal number, then the unit: "5.4 m", "19deg".
///
/// @param text  independent of locale; neither hexadecimal, nor nan or infinity
/// @param name  what the value is called in messages, e.g. "friction_angle" or "--drop"
/// @return the value in SI units and radians; finite
/// @throws InputError if the number is malformed or out of the range of a double, the unit is missing,
///         unknown or of another dimension; the message lists the units that fit
[[nodiscard]] double parse_quantity(std::string_view text, Dimension dimension, std::string_view name);

/// One spelling of a unit.
struct UnitName {
  std::string_view text;
  bool listed = true;  ///< named in messages; further spellings are accepted silently
};
/// @return every spelling of a unit of that dimension
[[nodiscard]] std::vector<UnitName> units_of(Dimension dimension);

/// @param value  SI, rad; finite
/// @return the shortest decimal with a metric unit that parse_quantity() reads as exactly `value`: "0.4 m", "2.5 g"
[[nodiscard]] std::string written_quantity(double value, Dimension dimension);

/// @return the unit that messages give such a value in: "deg", "m", "m/s^2", ...; empty for a number
[[nodiscard]] std::string_view unit_for_people(Dimension dimension);
/// @param value  SI, rad
/// @return it in unit_for_people()
[[nodiscard]] double in_unit_for_people(double value, Dimension dimension);
/// @param value  SI, rad
/// @return the value with a unit, for people: "17 deg", "412 mm", "5.4 m", "9.81 m/s^2"; "unbounded" for
///         infinity
[[nodiscard]] std::string quantity_text(double value, Dimension dimension, int digits = 4);

/// A value that bounds refuse; SI, rad.
/// @return quantity_text() with the digits that tell it from all of the bounds: "10001 m/s", not "10000 m/s"
[[nodiscard]] std::string quantity_beyond(double value, Dimension dimension,
                                          std::initializer_list<double> bounds);
/// What messages say of such a value.
/// @param name    key or option
/// @param bounds  those that `why` tells
/// @return "NAME: VALUE is out of range", its `where` left empty
[[nodiscard]] Issue out_of_range(std::string_view name, double value, Dimension dimension,
                                 std::initializer_list<double> bounds, std::string why, std::string hint);

}  // namespace glissade
