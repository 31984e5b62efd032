#include "parts/supports/ground.hpp"

#include <algorithm>
#include <cstddef>

namespace glissade::parts {

double ground_at(const std::vector<Vec2>& ground, double x) {
  if (x <= ground.front().x) return ground.front().y;
  for (std::size_t i = 0; i + 1 < ground.size(); ++i) {
    if (x > ground[i + 1].x) continue;
    const double share = (x - ground[i].x) / (ground[i + 1].x - ground[i].x);
    return ground[i].y + share * (ground[i + 1].y - ground[i].y);
  }
  return ground.back().y;
}

double highest_ground(const std::vector<Vec2>& ground, double from, double to) {
  double highest = std::max(ground_at(ground, from), ground_at(ground, to));
  for (const Vec2 corner : ground) {
    if (corner.x > from && corner.x < to) highest = std::max(highest, corner.y);
  }
  return highest;
}

}  // namespace glissade::parts
