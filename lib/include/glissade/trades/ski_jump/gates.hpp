#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/motion/motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// A start gate of a ski jump.
struct Gate {
  int number = 1;           ///< from 1, the lowest
  double from_start = 0.0;  ///< arc length from the start of the track, the highest start A [m]
  double to_edge = 0.0;     ///< along the track to the take-off edge, its finish [m]
};

/// Gates that fill a start area evenly, the first at its lowest place and the last at the start of the track.
/// @param length      of the track [m]; > 0
/// @param start_area  length of the start area, from the start of the track [m]; 0 to below `length`
/// @param count       >= 1; one gate is the lowest place
/// @throws InputError if a value is out of its range
[[nodiscard]] std::vector<Gate> even_gates(double length, double start_area, int count);

/// Gates that follow each other by a step, from the lowest place of a start area upwards, as many as it holds.
/// @param step  along the track [m]; > 0
/// @throws InputError as even_gates(), or if there would be more than 100 000
[[nodiscard]] std::vector<Gate> stepped_gates(double length, double start_area, double step);

/// Gates that follow each other by a step in height, from the lowest place of a start area upwards, as many as it holds.
/// Accuracy: 1e-12 of the length of the track, where that falls by more than rounding.
/// @param step  in height [m]; > 0
/// @throws InputError as stepped_gates(), or if the track rises within the start area
[[nodiscard]] std::vector<Gate> gates_by_height(const Centerline& centerline, double start_area, double step);

/// How a speed answers to small changes.
struct SpeedSlopes {
  double by_friction = 0.0;  ///< du/dmu [m/s]
  double by_drag = 0.0;      ///< du/dk [m^2/s]
  double by_length = 0.0;    ///< du per length of in-run added at the gate [1/s]
};

/// The ride of one body from one gate.
struct GateRide {
  Gate gate;
  bool arrived = false;  ///< otherwise of times and speeds only the highest speed is told
  RideEnd end = RideEnd::arrived;
  double ended_at = 0.0;       ///< arc length from the start of the track [m]
  double travel_time = 0.0;    ///< from the gate to the edge [s]
  double speed_at_edge = 0.0;  ///< [m/s]
  /// [m/s]; none where the ride does not arrive or does not pass the place, which lies at the gate or above it
  std::optional<double> speed_at_measuring_place;
  std::optional<SpeedSlopes> slopes;  ///< of that speed
  double highest_load = 0.0;          ///< per unit mass [m/s^2]
  double highest_load_at = 0.0;       ///< arc length from the start of the track [m]
  double lowest_load = 0.0;           ///< [m/s^2]
  double lowest_load_at = 0.0;        ///< arc length from the start of the track [m]
  double highest_speed = 0.0;         ///< [m/s]
  double highest_speed_at = 0.0;      ///< arc length from the start of the track [m]
  double highest_radial = 0.0;        ///< kappa u^2 [m/s^2]
  double highest_radial_at = 0.0;     ///< arc length from the start of the track [m]
};

/// @return whether a body from a gate passes the place where speed is measured: it lies below the gate
[[nodiscard]] bool passes(const Gate& gate, double measuring_place);

/// Rides a body from every gate, each ride once.
/// @param track            from the highest start to the take-off edge
/// @param body             starts from rest at each gate, or with its entry speed
/// @param measuring_place  distance before the edge where speed is measured [m]; 0 or more
/// @return one ride a gate, in their order
/// @throws InputError if the measuring place is negative, or no gate's ride passes it; else as Motion
[[nodiscard]] std::vector<GateRide> ride_gates(const CenterlinePtr& track, const std::vector<Gate>& gates,
                                               const Body& body, double measuring_place,
                                               double gravity = kDefaultGravity);

/// The same body from one place of the track: what ride_gates() rides.
[[nodiscard]] Motion ride_from(const CenterlinePtr& track, double from_start, const Body& body,
                               double gravity = kDefaultGravity);

/// How the speed at a place answers to friction, drag and length, of a body that slides from rest.
///
/// Without wind the energy equation is linear in u^2, and so is each derivative: one quadrature (docs/theory.md,
/// in-runs). With wind, or friction that changes along the track, by central differences of the ride.
/// Accuracy: kSpeedSlopeAccuracy relative without wind, 1e-6 with it.
/// @param from_start  the gate [m]
/// @param place       arc length from the start of the track [m]; above the gate's
[[nodiscard]] SpeedSlopes speed_slopes(const CenterlinePtr& track, double from_start, double place,
                                       const Body& body, double gravity = kDefaultGravity);

/// Stated bound of the relative error of speed_slopes() without wind.
inline constexpr double kSpeedSlopeAccuracy = 1e-10;

/// The rides of one body in one condition of track and air.
struct GateCondition {
  std::string name;  ///< "nominal", "slow", "fast"; of a range "low friction", "high friction"
  Body body;
  std::vector<GateRide> rides;  ///< one a gate
};

/// Every gate of a hill in every condition.
struct GateTable {
  double measuring_place = 10.0;  ///< before the edge [m]
  std::vector<Gate> gates;
  std::vector<Vec3> positions;            ///< of the gates, in space [m]
  double largest_height_step = 0.0;       ///< from one gate to the next [m]; 0 of a single gate
  std::vector<GateCondition> conditions;  ///< the nominal one first
  /// Ends of a range of friction that are none of the conditions, "low friction" and "high friction": rules hold there, too.
  std::vector<GateCondition> range;

  /// @return whether a gate's y is other than 0 but for rounding, as on a track that is turned in plan
  [[nodiscard]] bool has_y() const;
};

/// @return the gate, as a number between gates where it falls between them, whose speed at the measuring place is
///         `speed` [m/s], by linear interpolation between neighbours; none where all gates are slower or faster, of
///         those whose rides pass the place
[[nodiscard]] std::optional<double> gate_for_speed(const std::vector<GateRide>& rides, double speed);

}  // namespace glissade
