#pragma once

#include "glissade/section/measures.hpp"
#include "glissade/section/outline.hpp"

#include <vector>

namespace glissade::section {

/// Outlines of a kind and the width of its narrowest place.
struct Shape {
  std::vector<Outline> loops;
  double narrowest = 0.0;
};

/// @return the outlines at the narrowest width
/// @throws InputError if a measure is no size, or if measures break what they ask of each other
[[nodiscard]] Shape shape_of(const Measures& measures);

}  // namespace glissade::section
