#pragma once

#include "glissade/parts/shop_part.hpp"

namespace glissade::parts {

/// Volumes and centres of gravity of bodies.

/// A body's volume with its first moments, in its own frame.
struct BodyMoments {
  double volume = 0.0;  ///< [m^3]
  Vec3 centroid;
};

/// @return of a prism exactly; of a section along lines and arcs by Pappus' theorem, its centroid by quadrature within 1e-12 of
///         its length; of a gore exactly
[[nodiscard]] BodyMoments moments(const PartBody& body);

/// Fills in volume, mass and centre of gravity of a part.
void weigh(ShopPart& part);

/// The mass of a wall beside a width that changes: as thick across the track as its sheet is, its body is thinner than the sheet,
/// which is what lies on the scales.
/// @pre the part has a pattern
void weigh_sheet(ShopPart& part);

}  // namespace glissade::parts
