#pragma once

#include "glissade/parts/plate_options.hpp"

#include "parts/plates/plate_unit.hpp"

#include <functional>
#include <vector>

namespace glissade::parts {

/// @return the least distance of two, which leaves room to weld them [m]
[[nodiscard]] inline double least_apart(const StiffenerOptions& stiffener) {
  constexpr double kThicknesses = 10.0;  // taste
  return kThicknesses * stiffener.thickness;
}

/// Where a stiffener of a unit may stand.
struct StiffenerSeats {
  std::vector<double> places;             ///< at which it is looked for, ascending, along the track [m]
  bool anywhere = true;                   ///< whether it may stand between them, too
  std::function<bool(double s)> is_free;  ///< whether one may stand there
  std::function<bool(double before, double after)> beside;  ///< whether two leave each other room
};

/// @return where they stand, ascending: in even gaps where these are free, else the fewest that keep to the spacing; where none do,
///         those that come nearest to it [m]
[[nodiscard]] std::vector<double> stiffener_row(const Span& unit, double spacing,
                                                const StiffenerSeats& seats);

}  // namespace glissade::parts
