#include "parts/bodies/angle_bar.hpp"

#include <algorithm>

namespace glissade::parts {
namespace {

/// What lies between two lines that run side by side, the second one to the left of the first.
PlaneRegion between(const ArcPath& line, const ArcPath& left) {
  if (line.closed) {
    // To the left of a ring's heel lies what is outside of it, or inside.
    const bool outwards = signed_area(line) < 0.0;
    return {outwards ? left : line, {outwards ? line : left}, {}};
  }
  PlaneRegion region{line, {}, {}};
  region.outline.closed = true;
  region.outline.vertices.back().bulge = 0.0;
  for (const PathVertex& vertex : reversed(left).vertices) region.outline.vertices.push_back(vertex);
  region.outline.vertices.back().bulge = 0.0;
  return region;
}

}  // namespace

PlaneRegion lying_leg(const AngleBar& bar) {
  PlaneRegion region = between(bar.heel, bar.toe);
  region.cutouts.insert(region.cutouts.end(), bar.slots.begin(), bar.slots.end());
  region.holes = bar.holes;
  return region;
}

PlaneRegion rising_leg(const AngleBar& bar) {
  return between(bar.heel, bar.root);
}

std::array<Prism, 2> legs_of(const AngleBar& bar) {
  return {Prism{lying_leg(bar), bar.thickness}, Prism{rising_leg(bar), bar.height}};
}

double angle_centroid(double leg, double thickness) {
  return 0.5 * (leg * leg + (leg - thickness) * thickness) / (2.0 * leg - thickness);
}

bool is_rolled(const AngleBar& bar) {
  return std::any_of(bar.heel.vertices.begin(), bar.heel.vertices.end(),
                     [](const PathVertex& vertex) { return vertex.bulge != 0.0; });
}

double stock_length(const AngleBar& bar) {
  const double heel = length(bar.heel);
  const double toe = length(bar.toe);
  if (!is_rolled(bar)) return std::max(heel, toe);
  return heel + angle_centroid(bar.height, bar.thickness) / bar.height * (toe - heel);
}

}  // namespace glissade::parts
