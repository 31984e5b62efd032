#pragma once

#include <vector>

namespace hand_optima {

inline constexpr double kGravity = 9.81;

/// A place of a track and its curvature there; where curvature jumps two of them share a place.
struct Bend {
  double arc_length = 0.0;
  double curvature = 0.0;
};

/// A fastest track put together from arcs of closed form.
struct Optimum {
  double travel_time = 0.0;
  std::vector<Bend> bends;
};

/// Frictionless, above the line drop <= wall_slope x + wall_drop.
[[nodiscard]] Optimum along_wall(double run, double drop, double wall_slope, double wall_drop);

/// Nowhere steeper than `highest`: a straight at that angle, then free.
[[nodiscard]] Optimum below_slope(double run, double drop, double mu, double highest);

/// Frictionless, nowhere flatter than `lowest`: a cycloid, then a straight at that angle.
[[nodiscard]] Optimum above_slope(double run, double drop, double lowest);

/// Slope angles at the entry, where the arc of the smallest radius ends, and at the exit.
struct Turns {
  double entry = 0.0;
  double arc_end = 0.0;
  double exit = 0.0;
};

/// Nowhere bent tighter than `radius`: an arc of it, then free.
/// @param near  the solution to a tenth
[[nodiscard]] Optimum above_radius(double run, double drop, double mu, double radius, Turns near);

/// Where the first arc ends, and the slope angle on the other side of the bend that follows; where the flight onto rougher
/// ground ends, or the length of the arc before the flight to smoother ground; and the slope angle at the exit.
struct ChangeTurns {
  double first = 0.0;
  double bent = 0.0;
  double other = 0.0;
  double exit = 0.0;
};

/// From rest over ground that changes at an arc length: a free arc, free flight on the rougher side of the change and a
/// corner on its smoother one, a free arc.
/// @param near  the solution to a tenth
/// @return its travel time
[[nodiscard]] double across_change(double run, double drop, double mu_before, double mu_after, double place,
                                   ChangeTurns near);

}  // namespace hand_optima
