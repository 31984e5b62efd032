#pragma once

#include "glissade/core/vec.hpp"

#include "solid/self_intersections.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

namespace glissade::solid {

/// The pieces of a surface: which one each facet belongs to, and what volume each encloses, negative where it
/// faces inward.
struct Pieces {
  std::vector<std::uint32_t> of_facet;
  std::vector<double> volumes;  ///< [m^3]
};

/// Pieces that face the wrong way, of two kinds, and the lowest number of each kind.
struct WrongPieces {
  std::size_t inside_out = 0;  ///< face inward and lie within no material
  std::size_t nested = 0;      ///< face outward and lie within material that is there already
  std::optional<std::uint32_t> first_inside_out;
  std::optional<std::uint32_t> first_nested;

  [[nodiscard]] bool none() const { return inside_out == 0 && nested == 0; }
};

/// Closed pieces that do not intersect bound material together where none of them is wrong: a piece of positive
/// volume lies where there is none, a piece of negative volume (a cavity) lies within material.
///
/// Winding numbers by solid angle, which are whole numbers up to rounding. The work is bounded: with more
/// than 5,000 pieces, or 2e8 solid angles to add, every piece that is not of positive volume counts as inside out.
[[nodiscard]] WrongPieces wrong_pieces(const std::vector<Vec3>& positions,
                                       const std::vector<FacetCorners>& facets, const Pieces& pieces,
                                       const std::stop_token& stop = {});

/// The same without a look at what lies within what: every piece that is not of positive volume is inside out.
[[nodiscard]] WrongPieces pieces_inside_out(const Pieces& pieces);

}  // namespace glissade::solid
