#include "glissade/core/slot.hpp"

#include <cmath>
#include <cstddef>

namespace glissade {

ArcPath path_of(const Slot& slot) {
  const Vec2 along = (1.0 / norm(slot.reach)) * slot.reach;
  const Vec2 right = slot.radius * Vec2{along.y, -along.x};
  const Vec2 low = slot.middle - slot.reach;
  const Vec2 high = slot.middle + slot.reach;
  return {{{low + right, 0.0}, {high + right, 1.0}, {high - right, 0.0}, {low - right, 1.0}}, true};
}

std::optional<Slot> as_slot(const ArcPath& path) {
  constexpr double kHalfCircle = 1e-9;
  const auto& at = path.vertices;
  if (!path.closed || at.size() != 4) return std::nullopt;
  const std::size_t first = at[0].bulge == 0.0 ? 1 : 0;
  const PathVertex& one = at[first];
  const PathVertex& other = at[first + 2];
  const auto is_end = [](const PathVertex& vertex) {
    return std::fabs(std::fabs(vertex.bulge) - 1.0) < kHalfCircle;
  };
  if (!is_end(one) || !is_end(other) || one.bulge * other.bulge < 0.0) return std::nullopt;
  if (at[1 - first].bulge != 0.0 || at[3 - first].bulge != 0.0) return std::nullopt;
  const Vec2 across = at[first + 1].at - one.at;
  const Vec2 back = at[(first + 3) % 4].at - other.at;
  const Vec2 from = 0.5 * (one.at + at[first + 1].at);
  const Vec2 to = 0.5 * (other.at + at[(first + 3) % 4].at);
  const Vec2 reach = 0.5 * (to - from);
  // Half circles of one size whose ends the lines touch: all else with two arcs is another figure.
  const double rounding = kHalfCircle * (norm(across) + norm(reach));
  if (!(norm(across) > 0.0) || !(norm(reach) > 0.0) || norm(across + back) > rounding) return std::nullopt;
  if (std::fabs(dot(across, reach)) > rounding * norm(reach)) return std::nullopt;
  return Slot{0.5 * (from + to), reach, 0.5 * norm(across)};
}

double overall_length(const Slot& slot) {
  return 2.0 * (norm(slot.reach) + slot.radius);
}

}  // namespace glissade
