#pragma once

#include "glissade/centerline/in_run.hpp"
#include "glissade/core/units.hpp"

#include <optional>

namespace glissade {

/// An in-run by the letters of its certificate; of e1, e2 and es any two give the third.
struct InRunDesign {
  Angle gamma;
  Angle alpha;
  double r1 = 0.0;           ///< [m]
  double t = 0.0;            ///< [m]
  std::optional<double> e1;  ///< length from the highest start [m]
  std::optional<double> e2;  ///< length from the lowest start [m]
  std::optional<double> es;  ///< length of the start area [m]
  /// Both definitions are in use: e to the beginning of the table (older ICR), or to its edge (IWO 2012).
  bool counts_to_edge = false;
  InRunTransition transition = InRunTransition::cubic;
  double first_radius = 0.0;  ///< of two radii [m]

  /// @return e1, or what e2 and es make of it; 0 if neither is given
  [[nodiscard]] double longest() const;
  /// @return es, or what e1 and e2 make of it; none if it is not given
  [[nodiscard]] std::optional<double> start_area() const;
  /// @return the shape from the highest start to the edge
  [[nodiscard]] InRunShape shape() const;

  friend bool operator==(const InRunDesign&, const InRunDesign&) = default;
};

/// What a certificate says of the hill below the in-run; rules ask for it.
struct HillDesign {
  std::optional<double> size;                ///< hill size HS [m]
  std::optional<double> construction_point;  ///< w, distance from the edge to the construction point [m]
  std::optional<double> table_height;        ///< s [m]
  std::optional<double> height;              ///< zU, of the edge above the lowest point [m]
  std::optional<double> design_speed;  ///< v0 at the edge, which the norm sizes table and transition by [m/s]

  friend bool operator==(const HillDesign&, const HillDesign&) = default;
};

}  // namespace glissade
