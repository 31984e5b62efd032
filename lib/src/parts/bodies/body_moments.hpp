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

}  // namespace glissade::parts
