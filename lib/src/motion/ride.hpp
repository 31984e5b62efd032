#pragma once

#include "glissade/motion/motion.hpp"

#include "panel.hpp"

#include <optional>
#include <vector>

namespace glissade::motion {

/// What a ride left behind: panels in order from the start, and how it ended.
struct RideRecord {
  Equation equation;
  std::vector<Panel> panels;
  std::vector<RideSums> sums_before;  ///< of each panel
  std::optional<Stall> stall;
  std::optional<LiftOff> lift_off;
  std::optional<LawEnd> law_end;
  MotionState end;  ///< the state at the end of the ride
};

/// @return ascending places between which the equation is smooth, from 0 to the length of the track; some may be there twice
[[nodiscard]] std::vector<double> breaks_of(const Equation& equation);

/// Integrates the energy equation down the track, up to the finish, a stall or a lift-off.
/// @throws ConvergenceError if the track is so rough between its breaks that panels without number would be
/// needed
[[nodiscard]] RideRecord ride_down(const Equation& equation, double entry_speed);

}  // namespace glissade::motion
