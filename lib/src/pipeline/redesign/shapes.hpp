#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/pipeline/redesign.hpp"
#include "glissade/pipeline/rules.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// A shape with its ride.
[[nodiscard]] RedesignShape ridden(std::string name, CenterlinePtr track, const TakeOff& take_off);

/// A shape, or why there is none.
[[nodiscard]] RedesignShape attempted(const std::string& name, const TakeOff& take_off,
                                      const std::function<CenterlinePtr()>& make);
/// The same of one that letters make.
[[nodiscard]] RedesignShape lettered(const std::string& name, const TakeOff& take_off,
                                     const std::function<InRunShape()>& make);

/// What rules allow in a bend.
struct BendBounds {
  double radial = HUGE_VAL;  ///< v^2/radius at most [m/s^2]
  double load = HUGE_VAL;    ///< normal load at most [m/s^2]
};

/// @param otherwise  the v^2/radius where no rule speaks of it or of the load [m/s^2]
[[nodiscard]] BendBounds bend_bounds(const Design& design, const Measurements& measurements,
                                     double otherwise);

/// The certificate's own letters with every other transition, and the curves of the literature.
void add_comparisons(const InRunShape& certificate, const TakeOff& take_off, const BendBounds& bounds,
                     std::vector<RedesignShape>& shapes);

}  // namespace glissade::pipeline
