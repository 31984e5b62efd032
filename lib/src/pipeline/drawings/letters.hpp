#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/design/design.hpp"

#include <string>
#include <vector>

namespace glissade::pipeline {

/// A place of a track with a name.
struct Letter {
  std::string name;
  double arc_length = 0.0;  ///< [m]
};

/// @return A, B, E1, E2 and T of an in-run, start and finish of any other track, in their order
[[nodiscard]] std::vector<Letter> letters_of(const Design& design, const Centerline& centerline);

}  // namespace glissade::pipeline
