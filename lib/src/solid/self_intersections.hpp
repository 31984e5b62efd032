#pragma once

#include "glissade/core/vec.hpp"

#include "solid/facet_boxes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

namespace glissade::solid {

/// The questions about a mesh that only exact arithmetic can answer; CGAL stays behind this header.

/// @return true if the three points lie on one line, decided exactly
[[nodiscard]] bool are_collinear(Vec3 a, Vec3 b, Vec3 c);

struct SelfIntersections {
  std::size_t pairs = 0;
  bool complete = true;  ///< false: the search stopped at a limit, `pairs` is a lower bound
  std::size_t exact =
      0;  ///< pairs that no plane of those tried parts for certain: CGAL was asked, which takes longest
  /// Middle of the corners of the pair with the lowest numbers of those found.
  std::optional<Vec3> first;
};

/// Where the search stops. Both limits count work, never time: same mesh, same answer.
struct SelfIntersectionLimits {
  std::size_t pairs = 100'000;
  std::size_t tests = 0;  ///< pairs of facets with overlapping bounding boxes

  /// Room for meshes some thirty times less favourable than any that Glissade makes (7 tests a facet).
  [[nodiscard]] static SelfIntersectionLimits for_facets(std::size_t facets) {
    return {.pairs = 100'000, .tests = 50'000'000 + 200 * facets};
  }
};

/// Counts the pairs of facets that meet elsewhere than in the vertex or edge they share by index; two facets
/// with the same three vertices meet.
///
/// Exact: every decision is certain, made in floating point with an error bound where that suffices and by
/// CGAL's exact predicates where it does not.
/// @param facets  none with collinear corners
/// @throws Interrupted if `stop` asks for it
[[nodiscard]] SelfIntersections find_self_intersections(const std::vector<Vec3>& positions,
                                                        const std::vector<FacetCorners>& facets,
                                                        const SelfIntersectionLimits& limits,
                                                        const std::stop_token& stop = {});

}  // namespace glissade::solid
