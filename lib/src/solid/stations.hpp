#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::solid {

/// A point of the centerline with its frame, in the vertical plane with z UP (z = -drop).
struct Station {
  double s = 0.0;      ///< arc length [m]
  Vec2 point;          ///< (x, z) [m]
  Vec2 tangent;        ///< unit, towards the finish
  Vec2 normal;         ///< unit, the tangent turned left: up and, on a steep track, forward
  double slope = 0.0;  ///< zeta [rad]
  double kappa = 0.0;  ///< [1/m]; may be infinite at the start
};

/// @return the station at arc length s, which must lie on the track
[[nodiscard]] Station station_at(const Centerline& centerline, double s);

/// @return the point at `height` along the station's normal
[[nodiscard]] inline Vec2 offset(const Station& station, double height) {
  return station.point + height * station.normal;
}

/// What bounds the distance between neighbouring stations.
struct StationLimits {
  double chord_tolerance = 0.0;  ///< greatest distance of any level curve from its chords [m]
  double below = 0.0;            ///< the section reaches this far below the floor [m]; >= 0
  double above = 0.0;            ///< and this far above it [m]; >= 0
  double longest = 0.0;          ///< greatest distance between stations [m]
  /// Greatest angle that the track turns through between stations [rad]; one step that turns further than
  /// the default no longer looks like the curve, however loose the tolerance.
  double largest_turn = kLargestTurn;
  /// Breaks of the centerline where a station stands whatever other breaks lie beside them, ascending [m]: a width
  /// begins or ends to change.
  std::vector<double> kept = {};

  static constexpr double kLargestTurn = 0.25;
};

/// How stations are spread along a track: their density, before any of them is made.
///
/// The number of steps that an interval needs is the largest of ds/longest, dzeta/largest_turn, and
/// sqrt((ds dzeta + dzeta^2 n)/(8 tolerance)): the chord error of the level curve n on the convex side, whose
/// radius is largest. It stays finite at a start of unbounded curvature, where the slope angle does.
class StationPlan {
 public:
  StationPlan(const Centerline& centerline, const StationLimits& limits);

  /// @return how many steps the limits ask for
  [[nodiscard]] double steps() const { return steps_; }

  /// @return stations from start to finish, each step equally near its limits
  [[nodiscard]] std::vector<Station> stations() const;

 private:
  struct Panel {
    double begin;
    double end;
    double steps;
  };

  void spread(double begin, double begin_slope, double end, double end_slope, int depth);
  void meet_breaks(std::vector<Station>& stations) const;
  [[nodiscard]] double steps_of(double length, double turn) const;

  const Centerline& centerline_;
  StationLimits limits_;
  double steps_ = 0.0;
  std::vector<Panel> panels_;
};

}  // namespace glissade::solid
