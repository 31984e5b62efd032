#pragma once

namespace glissade {

/// Altitudes that air_density() takes: below the tropopause of the standard atmosphere [m].
inline constexpr double kLowestAltitude = -500.0;
inline constexpr double kHighestAltitude = 11'000.0;

/// @param altitude  above sea level [m]; kLowestAltitude to kHighestAltitude
/// @return air temperature of the standard atmosphere there [K]
/// @throws InputError if the altitude is out of that range
[[nodiscard]] double standard_temperature(double altitude);

/// Density of dry air: pressure of the standard atmosphere (ISO 2533) at the altitude, and the ideal gas law at
/// the temperature. Moist air is up to 1 % thinner.
/// Source: docs/theory.md (M10).
/// @param altitude     above sea level [m]; kLowestAltitude to kHighestAltitude
/// @param temperature  [K]; > 0
/// @return [kg/m^3]; 1.225 at sea level and 15 degC
/// @throws InputError if the altitude is out of that range, or the temperature not finite and positive
[[nodiscard]] double air_density(double altitude, double temperature);

}  // namespace glissade
