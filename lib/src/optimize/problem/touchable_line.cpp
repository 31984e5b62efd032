#include "optimize/problem/touchable_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace glissade::optimizer {
namespace {

/// Whether a corner lies behind the arc through two others, all with what is forbidden below.
bool is_behind_arc(Vec2 before, Vec2 corner, Vec2 after, double radius) {
  constexpr double kBehind = 1e-9;  // rounding: of the radius
  const Vec2 chord = after - before;
  const double half = 0.5 * norm(chord);
  if (!(chord.x > 0.0) || !(half < radius)) return false;
  const double rise = std::sqrt((radius - half) * (radius + half)) / (2.0 * half);
  const Vec2 centre = before + 0.5 * chord + rise * Vec2{-chord.y, chord.x};
  // Beyond its lower half an arc is no track's.
  if (before.y > centre.y || after.y > centre.y) return false;
  const double aside = corner.x - centre.x;
  const double arc = centre.y - std::sqrt(std::max(0.0, (radius - aside) * (radius + aside)));
  return corner.y < arc - kBehind * radius;
}

/// A corner behind all of the line's from `first` to `last`, but for these two.
Vec2 corner_behind(const std::vector<Vec2>& line, std::size_t first, std::size_t last) {
  double down = std::numeric_limits<double>::infinity();
  double up = -std::numeric_limits<double>::infinity();
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 since = line[i] - line[first];
    const Vec2 until = line[last] - line[i];
    down = std::min(down, since.y / since.x);
    up = std::max(up, until.y / until.x);
  }
  const Vec2 whole = line[last] - line[first];
  const double x = (up * whole.x - whole.y) / (up - down);
  return {line[first].x + x, line[first].y + down * x};
}

}  // namespace

TouchableLine touchable(const std::vector<Vec2>& given, const Touching& touching) {
  // With what is forbidden below: drop points down.
  std::vector<Vec2> line = given;
  for (Vec2& corner : line) corner.y *= -touching.side;
  std::vector<std::size_t> kept;
  const auto stands_between = [&](std::size_t i) {
    return line[i].x >= touching.from && line[i].x <= touching.to;
  };
  const auto leaves_out_last = [&](std::size_t next) {
    const std::size_t before = kept[kept.size() - 2];
    const bool ascends = line[before].x < line[kept.back()].x && line[kept.back()].x < line[next].x;
    return ascends && stands_between(before) && stands_between(next) &&
           is_behind_arc(line[before], line[kept.back()], line[next], touching.radius);
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    while (kept.size() > 1 && leaves_out_last(i)) kept.pop_back();
    kept.push_back(i);
  }
  TouchableLine result;
  const auto add = [&](Vec2 corner, bool out_of_reach) {
    result.corners.push_back({corner.x, -touching.side * corner.y});
    result.out_of_reach.push_back(out_of_reach);
  };
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (k > 0 && kept[k] - kept[k - 1] > 1) add(corner_behind(line, kept[k - 1], kept[k]), true);
    add(line[kept[k]], false);
  }
  return result;
}

}  // namespace glissade::optimizer
