#include "glissade/core/air.hpp"

#include "glissade/core/math.hpp"

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
  return kSeaLevelTemperature - kLapseRate * altitude;
}

double air_density(double altitude, double temperature) {
  constexpr double kExponent = kAtmosphereGravity / (kGasConstant * kLapseRate);
  const double pressure =
      kSeaLevelPressure * math::pow(standard_temperature(altitude) / kSeaLevelTemperature, kExponent);
  return pressure / (kGasConstant * temperature);
}

}  // namespace glissade
