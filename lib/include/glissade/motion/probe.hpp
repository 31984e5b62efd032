#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/friction_level.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/motion/motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// The body at a place that was asked about, at one friction.
struct ProbeState {
  FrictionLevel level = FrictionLevel::nominal;
  std::optional<MotionState> motion;  ///< none where the body does not come so far
};

/// One place on a track: the track there, and the body at every friction.
struct ProbeReading {
  std::string name;                ///< for people: "take-off", "12 m from the start"
  CenterlinePoint point;           ///< of the track
  Vec3 position;                   ///< in space [m]
  std::vector<ProbeState> states;  ///< from low to high friction
};

}  // namespace glissade
