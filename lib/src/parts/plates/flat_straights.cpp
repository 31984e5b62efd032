#include "parts/plates/flat_straights.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glissade::parts {

void add_straights(const ArcSpline& track, const Facets& facets, const Span& heights,
                   std::vector<Straight>& straights) {
  const std::size_t flats = facets.corners.size() - 1;
  const auto taken = [&](std::size_t corner) {
    if (corner == 0 || corner == flats) return 0.0;
    const double slope = math::tan(0.5 * facets.kinks[corner - 1]);
    return std::max({0.0, slope * heights.to, slope * heights.from});
  };
  constexpr double kOnFlat = 1e-6;  // of the place where it touches [m]
  std::size_t touch = 0;
  for (std::size_t i = 0; i < flats; ++i) {
    const Vec2 from = facets.corners[i];
    const Vec2 way = facets.corners[i + 1] - from;
    const double whole = norm(way);
    const Vec2 along = (1.0 / whole) * way;
    // Several places of a straight stretch touch one flat.
    const auto off = [&](std::size_t k) {
      return std::fabs(cross(along, frame_at(track, facets.touches[k]).at - from));
    };
    while (touch + 1 < facets.touches.size() && off(touch) > kOnFlat) ++touch;
    const double at = dot(frame_at(track, facets.touches[touch]).at - from, along);
    const double low = taken(i);
    const double high = whole - taken(i + 1);
    if (off(touch) > kOnFlat || !(high > low)) continue;
    straights.push_back({{facets.touches[touch] + low - at, facets.touches[touch] + high - at},
                         {from + low * along, along, {-along.y, along.x}},
                         1.0});
  }
}

}  // namespace glissade::parts
