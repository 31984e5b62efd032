#pragma once

#include "glissade/core/units.hpp"

#include <optional>

namespace glissade {

/// A condition of track, skis and air in which gates are ridden; what it leaves out is that of the body.
struct ConditionDesign {
  std::optional<Friction> friction;
  std::optional<double> drag_per_metre;  ///< [1/m]
  std::optional<double> drag_area;  ///< c_d A of the body's mass in its air [m^2]; instead of drag_per_metre
  std::optional<double> head_wind;  ///< [m/s]

  friend bool operator==(const ConditionDesign&, const ConditionDesign&) = default;
};

/// Start gates, numbered from the lowest. Either they fill the start area evenly, or they follow each other by a step from
/// its lowest place.
struct GatesDesign {
  std::optional<int> count;             ///< 1 to kMostGates
  std::optional<double> step;           ///< along the track [m]
  std::optional<double> vertical_step;  ///< in height [m]
  std::optional<double> start_area;     ///< from the start of the track [m]; none: es of the in-run
  double measuring_place = 10.0;        ///< where speed is measured, before the edge [m]
  std::optional<ConditionDesign> slow;  ///< beside the body's own
  std::optional<ConditionDesign> fast;

  friend bool operator==(const GatesDesign&, const GatesDesign&) = default;
};

inline constexpr int kMostGates = 1000;

}  // namespace glissade
