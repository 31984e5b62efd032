#pragma once

#include "glissade/core/vec.hpp"

#include "solid/self_intersections.hpp"

#include <cstdint>
#include <stop_token>
#include <vector>

namespace glissade::solid {

/// The pieces of a surface: which one each facet belongs to, and what volume each encloses, negative where it
/// faces inward.
struct Pieces {
  std::vector<std::uint32_t> of_facet;
  std::vector<double> volumes;  ///< [m^3]
};

/// Tells whether closed pieces that do not intersect bound material together: a piece of positive volume lies
/// where there is none, a piece of negative volume (a cavity) lies within material.
///
/// Winding numbers by solid angle, which are whole numbers up to rounding. The work is bounded: with more
/// than 5,000 pieces, or 2e8 solid angles to add, only pieces that are all positive count as bounding
/// material.
[[nodiscard]] bool bounds_material(const std::vector<Vec3>& positions,
                                   const std::vector<FacetCorners>& facets, const Pieces& pieces,
                                   const std::stop_token& stop = {});

}  // namespace glissade::solid
