#pragma once

#include "glissade/core/units.hpp"
#include "glissade/task/limits.hpp"

namespace glissade {

enum class FeedKind { belt, hopper, free_fall };

/// How a stream comes down on the start of its chute, in place of an entry speed.
struct FeedDesign {
  FeedKind kind = FeedKind::belt;
  double drop = 0.0;           ///< down to the start of the track [m]; > 0, of a hopper >= 0
  double belt_speed = 0.0;     ///< of a belt [m/s]; > 0
  double pulley_radius = 0.0;  ///< of a belt's head pulley [m]; > 0
  Angle belt_angle;            ///< of a belt, upwards where positive
  double outlet_speed = 0.0;   ///< of a hopper, straight down [m/s]; >= 0

  friend bool operator==(const FeedDesign&, const FeedDesign&) = default;
};

/// A hood between a belt's feed and the start of the track: what it is, or within which bounds the search chooses it.
struct HoodDesign {
  Range radius;        ///< of its underside [m]; > 0, both sides given
  Range impact_angle;  ///< between the way of the feed and the hood [rad]; both sides given
  Range exit_angle;    ///< of the stream at its lower edge, below the horizontal [rad]; both sides given
  double drop = 0.0;   ///< from its lower edge down to the start of the track [m]; > 0

  /// @return true if nothing of it is left to choose
  [[nodiscard]] bool settled() const {
    return radius.is_fixed() && impact_angle.is_fixed() && exit_angle.is_fixed();
  }

  friend bool operator==(const HoodDesign&, const HoodDesign&) = default;
};

/// The belt that takes a stream away.
struct DischargeDesign {
  double belt_speed = 0.0;     ///< [m/s]; > 0
  Angle direction;             ///< seen from above, from the track's own to the left
  Angle belt_angle;            ///< it climbs where positive
  double drop = 0.0;           ///< from the finish of the track down to the belt [m]; >= 0
  double belt_friction = 0.5;  ///< coefficient between stream and belt; >= 0

  friend bool operator==(const DischargeDesign&, const DischargeDesign&) = default;
};

}  // namespace glissade
