#pragma once

#include <string_view>

namespace glissade {

enum class ObjectiveKind {
  travel_time,  ///< least T
  exit_speed,   ///< greatest u(S)
  /// Least work of friction on floor and walls for each kilogram. With the ends given and no drag that is the
  /// greatest exit speed: what is not rubbed off arrives. Where the centre of mass lies above the track, what it comes down
  /// by goes with the slopes at the ends as well, and they are counted.
  least_wear,
  /// Of a stream: least highest wear of the floor, Roberts' wear factor W_c, over the track and all frictions
  least_peak_wear,
  /// Of a stream: least integral of (u/u(0) - 1)^2 along the track; even speed is even burden depth
  even_speed,
  least_drop,    ///< least drop from start to finish: of a ski jump, the lowest tower
  least_length,  ///< least arc length S
  /// Least highest normal load at which Limits::exit_speed.lowest is reached
  least_load,
  /// Least highest |d kappa/ds| at which Limits::exit_speed.lowest is reached
  least_curvature_rate,
  blend  ///< least T - exit_speed_weight * u(S)
};

/// @return whether the objective is a bound, made as tight as a given exit speed allows
[[nodiscard]] constexpr bool is_least_bound(ObjectiveKind kind) {
  return kind == ObjectiveKind::least_load || kind == ObjectiveKind::least_curvature_rate;
}

/// What is made least.
struct Objective {
  ObjectiveKind kind = ObjectiveKind::travel_time;
  double exit_speed_weight = 0.0;  ///< of `blend`: seconds given for one m/s of exit speed [s/(m/s)]; >= 0
  bool worst_case = false;         ///< at the highest friction of the range instead of the body's own

  friend bool operator==(const Objective&, const Objective&) = default;
};

/// @return what a unit of the objective is: "s", "m/s", "m"
[[nodiscard]] constexpr std::string_view unit_of(const Objective& objective) {
  switch (objective.kind) {
    case ObjectiveKind::exit_speed:
    case ObjectiveKind::least_wear:
      return "m/s";
    case ObjectiveKind::least_drop:
    case ObjectiveKind::least_length:
    case ObjectiveKind::even_speed:
      return "m";
    case ObjectiveKind::least_load:
      return "m/s^2";
    case ObjectiveKind::least_curvature_rate:
      return "1/m^2";
    case ObjectiveKind::least_peak_wear:
      return "W/m^2";
    default:
      return "s";
  }
}

}  // namespace glissade
