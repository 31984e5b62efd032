#include "glissade/report/ride_figure.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"

#include "report/body_energy.hpp"
#include "report/ride_stations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace glissade {

using namespace report;

namespace {

constexpr std::array<std::pair<RideQuantity, std::string_view>, 6> kWords = {{
    {RideQuantity::profile, "profile"},
    {RideQuantity::slope, "slope"},
    {RideQuantity::speed, "speed"},
    {RideQuantity::load, "load"},
    {RideQuantity::curvature, "curvature"},
    {RideQuantity::energy, "energy"},
}};

using OfPoint = std::function<double(const CenterlinePoint&)>;
using OfState = std::function<double(const MotionState&)>;

/// A property of the track, over the whole of it.
FigureLine track_line(const FigureRide& ride, const OfPoint& x, const OfPoint& y) {
  FigureLine line{ride.name, {}, {}, ride.dashed};
  const Centerline& centerline = ride.motion->centerline();
  for (const double s : track_stations(centerline)) {
    const CenterlinePoint point = centerline.at(s);
    line.xs.push_back(x(point));
    line.ys.push_back(y(point));
  }
  return line;
}

/// A property of the ride, as far as the body came.
FigureLine ride_line(const FigureRide& ride, const std::string& name, const OfState& y) {
  FigureLine line{name, ride_stations(*ride.motion), {}, ride.dashed};
  for (const MotionState& state : ride.motion->at(line.xs)) line.ys.push_back(y(state));
  return line;
}

double arc_length(const CenterlinePoint& point) {
  return point.arc_length;
}

/// A curvature that grows without bound would flatten everything else: its line ends where it is ten times
/// the curvature halfway.
void interrupt_steep_start(FigureLine& line) {
  if (std::isfinite(line.ys.front())) return;
  const double highest = 10.0 * std::fabs(line.ys[line.ys.size() / 2]);
  for (double& y : line.ys) {
    if (std::fabs(y) > highest) y = std::numeric_limits<double>::infinity();
  }
}

void add_energies(Figure& figure, const FigureRide& ride, bool named) {
  const Motion& motion = *ride.motion;
  const BodyEnergy energy(motion);
  const std::string prefix = named ? ride.name + ": " : "";
  const auto add = [&](const std::string& name, const OfState& y) {
    figure.lines.push_back(ride_line(ride, prefix + name, y));
  };
  add("potential", [&energy](const MotionState& state) { return energy.potential(state); });
  add("kinetic", [&energy](const MotionState& state) { return energy.kinetic(state); });
  add("lost to friction", [](const MotionState& state) { return state.friction_loss; });
  if (motion.body().drag_per_metre > 0.0) {
    add("lost to drag", [](const MotionState& state) { return state.drag_loss; });
  }
}

void add_line(Figure& figure, RideQuantity quantity, const FigureRide& ride, bool named) {
  std::vector<FigureLine>& lines = figure.lines;
  switch (quantity) {
    case RideQuantity::profile:
      lines.push_back(track_line(
          ride, [](const CenterlinePoint& point) { return point.x; },
          [](const CenterlinePoint& point) { return -point.drop; }));
      return;
    case RideQuantity::slope:
      lines.push_back(track_line(ride, arc_length, [](const CenterlinePoint& point) {
        return Angle::from_radians(point.slope_angle).degrees();
      }));
      return;
    case RideQuantity::speed:
      lines.push_back(ride_line(ride, ride.name, [](const MotionState& state) { return state.speed; }));
      return;
    case RideQuantity::load:
      lines.push_back(ride_line(
          ride, ride.name, [](const MotionState& state) { return state.normal_load / kStandardGravity; }));
      return;
    case RideQuantity::curvature:
      lines.push_back(
          track_line(ride, arc_length, [](const CenterlinePoint& point) { return point.curvature; }));
      interrupt_steep_start(lines.back());
      return;
    case RideQuantity::energy:
      add_energies(figure, ride, named);
      return;
  }
}

Figure empty_figure(RideQuantity quantity) {
  Figure figure;
  figure.x_label = "arc length s [m]";
  switch (quantity) {
    case RideQuantity::profile:
      figure.title = "Profile, to scale";
      figure.x_label = "run x [m]";
      figure.y_label = "height from the start [m]";
      figure.to_scale = true;
      break;
    case RideQuantity::slope:
      figure.title = "Slope angle";
      figure.y_label = "slope angle [deg]";
      break;
    case RideQuantity::speed:
      figure.title = "Speed";
      figure.y_label = "speed [m/s]";
      break;
    case RideQuantity::load:
      figure.title = "Normal load";
      figure.y_label = "normal load [g]";
      break;
    case RideQuantity::curvature:
      figure.title = "Curvature";
      figure.y_label = "curvature [1/m]";
      break;
    case RideQuantity::energy:
      figure.title = "Energy per mass";
      figure.y_label = "energy per mass [J/kg]";
      break;
  }
  return figure;
}

}  // namespace

std::string_view word(RideQuantity quantity) {
  for (const auto& [known, text] : kWords) {
    if (known == quantity) return text;
  }
  throw InternalError({"", "a quantity without a word", "", ""});
}

std::optional<RideQuantity> ride_quantity(std::string_view word) {
  for (const auto& [quantity, text] : kWords) {
    if (text == word) return quantity;
  }
  return {};
}

const std::vector<RideQuantity>& ride_quantities() {
  static const std::vector<RideQuantity> quantities = [] {
    std::vector<RideQuantity> all;
    all.reserve(kWords.size());
    for (const auto& entry : kWords) all.push_back(entry.first);
    return all;
  }();
  return quantities;
}

Figure ride_figure(RideQuantity quantity, const std::vector<FigureRide>& rides) {
  Figure figure = empty_figure(quantity);
  if (rides.empty())
    throw InputError({figure.title, "there is no ride to draw", "", "a track that the body can ride"});
  for (const FigureRide& ride : rides) add_line(figure, quantity, ride, rides.size() > 1);
  return figure;
}

}  // namespace glissade
