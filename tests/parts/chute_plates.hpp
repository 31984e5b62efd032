#pragma once

// The chute of which most tests of plates are, what makes it, and what is looked for in it.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/refusals.hpp"
#include "support/catch.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace testing {

inline const glissade::Friction kFriction =
    glissade::Friction::from_angle(glissade::Angle::from_degrees(17.0));
inline constexpr glissade::ChannelMeasures kChannel{0.4, 0.25, 4e-3};

inline glissade::CoulombBrachistochrone chute() {
  return {{5.4, 5.1}, kFriction};
}

inline glissade::section::VChannel v_channel() {
  glissade::section::VChannel channel;
  channel.angle = glissade::Angle::from_degrees(100.0);
  channel.wall_height = 0.3;
  channel.bottom_radius = 0.12;
  channel.thickness = 3e-3;
  return channel;
}

inline glissade::WorkshopBuild plates(const glissade::Centerline& track,
                                      const glissade::PlateOptions& options = {},
                                      const glissade::ChannelMeasures& channel = kChannel) {
  return make_plates(track, channel, {1e-4}, options, glissade::Placement(), {.friction = kFriction});
}

inline glissade::WorkshopBuild plates_of(const glissade::Centerline& track,
                                         const glissade::section::Measures& measures,
                                         const glissade::PlateOptions& options = {}) {
  return make_plates(track, measures, {1e-4}, options, glissade::Placement(), {.friction = kFriction});
}

inline std::string refusal(const glissade::PlateOptions& options,
                           const glissade::ChannelMeasures& channel = kChannel) {
  return refusal_of([&] { return plates(chute(), options, channel); });
}

/// Parts in whose names a word stands.
inline std::vector<const glissade::ShopPart*> named(const glissade::WorkshopBuild& build,
                                                    const std::string& word) {
  std::vector<const glissade::ShopPart*> found;
  for (const glissade::ShopPart& part : build.workshop.parts) {
    if (part.name.find(word) != std::string::npos) found.push_back(&part);
  }
  return found;
}

/// The first part whose name begins so.
inline const glissade::ShopPart& part_of(const glissade::WorkshopBuild& build, const std::string& name) {
  for (const glissade::ShopPart& part : build.workshop.parts) {
    if (part.name.starts_with(name)) return part;
  }
  FAIL("no part " << name);
  throw std::logic_error("FAIL throws");
}

}  // namespace testing
