#include "glissade/core/air.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <cmath>

namespace glissade {
namespace {

// ISO 2533, the layer below the tropopause.
constexpr double kSeaLevelPressure = 101'325.0;  // [Pa]
constexpr double kSeaLevelTemperature = 288.15;  // [K]
constexpr double kLapseRate = 0.0065;            // [K/m]
constexpr double kGasConstant = 287.05287;       // of dry air [J/(kg K)]
constexpr double kAtmosphereGravity = 9.80665;   // of the definition [m/s^2]

}  // namespace

double standard_temperature(double altitude) {
  if (!(altitude >= kLowestAltitude && altitude <= kHighestAltitude)) {
    throw InputError({"", "altitude: " + exact_text(altitude) + " m is out of range",
                      "The standard atmosphere is known from " + rounded_text(kLowestAltitude, 3) + " m to " +
                          rounded_text(kHighestAltitude, 5) + " m above sea level, below its tropopause.",
                      "1200 m for a hill in the mountains"});
  }
  return kSeaLevelTemperature - kLapseRate * altitude;
}

double air_density(double altitude, double temperature) {
  if (!(std::isfinite(temperature) && temperature > 0.0)) {
    throw InputError({"",
                      "temperature: " + exact_text(temperature) + " K is not a finite temperature above 0",
                      "It counts from absolute zero.", "288.15 K, 15 degC"});
  }
  constexpr double kExponent = kAtmosphereGravity / (kGasConstant * kLapseRate);
  const double pressure =
      kSeaLevelPressure * math::pow(standard_temperature(altitude) / kSeaLevelTemperature, kExponent);
  return pressure / (kGasConstant * temperature);
}

}  // namespace glissade
