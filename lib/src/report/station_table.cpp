#include "report/station_table.hpp"

#include "glissade/core/math.hpp"

#include "report/serial/packed.hpp"

#include <cmath>
#include <limits>

namespace glissade::report {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double or_unknown(double value) {
  return std::isfinite(value) ? value : kUnknown;
}

}  // namespace

StationGrid station_grid(const Motion& motion) {
  constexpr double kFewest = 200.0;  // taste: stations of the finest spacing
  constexpr double kSame = 1e-9;     // rounding: of a last multiple that is the end
  const double length = motion.distance();
  StationGrid grid;
  if (!(length > 0.0)) return {0.0, {0.0}};
  grid.spacing = math::decade_of(length / kFewest);
  // A quotient is rounded once: 7/100 is 0.07 to a reader, 7 times 0.01 is not.
  const double per_metre = std::round(1.0 / grid.spacing);
  const auto place = [&](int i) { return grid.spacing < 1.0 ? i / per_metre : i * grid.spacing; };
  for (int i = 0; place(i) < length * (1.0 - kSame); ++i) grid.places.push_back(place(i));
  grid.places.push_back(length);
  return grid;
}

Json track_table(const Motion& motion, const StationGrid& grid, double start_height) {
  std::vector<double> x;
  std::vector<double> z;
  std::vector<double> slope;
  std::vector<double> curvature;
  for (const double s : grid.places) {
    const CenterlinePoint point = motion.centerline().at(s);
    x.push_back(point.x);
    z.push_back(start_height - point.drop);
    slope.push_back(degrees(point.slope_angle));
    curvature.push_back(or_unknown(point.curvature));
  }
  return {{"spacing_m", grid.spacing},
          {"arc_length_m", packed("f64", grid.places)},
          {"x_m", packed("f64", x)},
          {"z_m", packed("f64", z)},
          {"slope_angle_deg", packed("f64", slope)},
          {"curvature_per_m", packed("f64", curvature)}};
}

Json ride_table(const Motion& motion, const StationGrid& grid) {
  std::vector<double> time;
  std::vector<double> speed;
  std::vector<double> load;
  for (const double s : grid.places) {
    const bool ridden = s <= motion.distance();
    const MotionState state = ridden ? motion.at(s) : MotionState{s, kUnknown, kUnknown, kUnknown};
    time.push_back(or_unknown(state.time));
    speed.push_back(state.speed);
    load.push_back(or_unknown(state.normal_load));
  }
  return {{"time_s", packed("f64", time)},
          {"speed_m_per_s", packed("f64", speed)},
          {"normal_load_m_per_s2", packed("f64", load)}};
}

}  // namespace glissade::report
