#pragma once

#include <string_view>

namespace glissade {

enum class ObjectiveKind {
  travel_time,  ///< least T
  exit_speed,   ///< greatest u(S)
  /// Least work of friction on floor and walls for each kilogram. With the ends given and no drag that is the
  /// greatest exit speed: what is not rubbed off arrives.
  least_wear,
  /// Of a stream: least integral of (u/u(0) - 1)^2 along the track; even speed is even burden depth
  even_speed,
  blend  ///< least T - exit_speed_weight * u(S)
};

/// What is made least.
struct Objective {
  ObjectiveKind kind = ObjectiveKind::travel_time;
  double exit_speed_weight = 0.0;  ///< of `blend`: seconds given for one m/s of exit speed [s/(m/s)]; >= 0
  bool worst_case = false;         ///< at the highest friction of the range instead of the body's own

  friend bool operator==(const Objective&, const Objective&) = default;
};

/// @return what a unit of the objective is: "s", "m/s"
[[nodiscard]] constexpr std::string_view unit_of(const Objective& objective) {
  const bool by_speed =
      objective.kind == ObjectiveKind::exit_speed || objective.kind == ObjectiveKind::least_wear;
  return by_speed ? "m/s" : "s";
}

}  // namespace glissade
