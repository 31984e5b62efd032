#pragma once

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::test {

/// A sound design with nothing optional in it, to break in one place.
inline constexpr std::string_view kSoundDesign = R"(glissade: 1
name: Chute
track:
  start: {x: 0 m, z: 6.2 m}
  finish: {x: 5.4 m, z: 1.1 m}
body:
  friction_angle: 17 deg
centerline: {kind: fastest}
cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}
mesh: {tolerance: 0.5 mm}
export: [stl, off, scad]
)";

/// The sound design with one part of its text replaced.
inline std::string sound_design_with(std::string_view part, std::string_view replacement) {
  std::string text(kSoundDesign);
  const std::size_t at = text.find(part);
  if (at == std::string::npos)
    throw std::logic_error("the sound design has no \"" + std::string(part) + "\"");
  return text.replace(at, part.size(), replacement);
}

/// @return the text of all problems, empty if there are none
inline std::string problems_of(std::string_view text, const std::vector<Override>& overrides = {}) {
  try {
    static_cast<void>(parse_design(text, "d.yaml", overrides));
    return {};
  } catch (const InputError& error) {
    return error.what();
  } catch (const InfeasibleError& error) {
    return std::string("infeasible: ") + error.what();
  } catch (const FileError& error) {
    return error.what();
  }
}

inline std::string problems_with(std::string_view part, std::string_view replacement) {
  return problems_of(sound_design_with(part, replacement));
}

}  // namespace glissade::test
