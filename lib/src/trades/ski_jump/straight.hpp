#pragma once

#include "glissade/trades/ski_jump/redesign.hpp"

#include <functional>

namespace glissade::trades {

/// The straight above a bend, as long as a take-off speed needs: the one length that redesigns look for.

/// Of a straight that nothing asks for.
inline constexpr double kShortestStraight =
    1e-9;  // accuracy: no more than the length of an in-run is told to [m]

/// Whether a straight gives a take-off speed.
enum class Reach {
  reached,
  too_fast,  ///< the shortest one gives more
  too_slow,  ///< none gives as much
  no_bend    ///< its letters make no in-run
};

struct Straight {
  Reach reach = Reach::too_slow;
  double length = 0.0;  ///< [m]; no shorter than asked for
};

/// @return the speed at the end of a ride [m/s]; 0 where the body does not arrive, which a longer straight would mend
[[nodiscard]] double exit_speed(CenterlinePtr track, const TakeOff& take_off);

/// @param speed     at the edge with a straight of this length [m]; grows with it
/// @param shortest  [m]; > 0
/// @throws InputError if the take-off speed is not finite and positive
[[nodiscard]] Straight straight_for(const TakeOff& take_off, const std::function<double(double)>& speed,
                                    double shortest = kShortestStraight);

/// @return its length [m]
/// @throws InfeasibleError if there is none
[[nodiscard]] double required(const Straight& straight, const TakeOff& take_off);

/// A root of a function that grows, between two places where its sign differs.
[[nodiscard]] double root_between(const std::function<double(double)>& excess, double low, double high);

}  // namespace glissade::trades
