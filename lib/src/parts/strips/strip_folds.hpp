#pragma once

#include "parts/plates/plate_section.hpp"

#include <algorithm>

namespace glissade::parts {

// Of a strip, rolled or bent, that would fold over where the track bends more than its height allows.
inline constexpr double kRoomAtFold =
    1.02;  // radius, or length of a flat, over what the height takes of it: room of 2 %
inline constexpr double kMostCutOff = 0.05;  // of the track, at either end, over which a strip may be missing

/// @return how high the plate reaches above the floor line [m]
inline double highest_of(const SectionPlate& plate) {
  return std::max({plate.face_from.y, plate.face_to.y, plate.back_from.y, plate.back_to.y});
}

/// @return where it begins, below 0 beneath the floor line [m]
inline double lowest_of(const SectionPlate& plate) {
  return std::min({plate.face_from.y, plate.face_to.y, plate.back_from.y, plate.back_to.y});
}

}  // namespace glissade::parts
