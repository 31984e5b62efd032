#include "optimize/problem/feet.hpp"

#include "glissade/core/math.hpp"

#include "optimize/problem/rows.hpp"

#include <algorithm>
#include <utility>

namespace glissade::optimizer {

double corner_distance(const Foot& foot, Vec2 corner, double side) {
  const double dx = corner.x - foot.x;
  const double dy = corner.y - foot.y;
  if (foot.end) return math::hypot(dx, dy);
  return side * (-foot.sin * dx + foot.cos * dy);
}

void add_foot_weights(const Foot& foot, double factor, StationWeights& weights) {
  weights.x[foot.base] += factor * foot.sin * (1.0 - foot.share);
  weights.y[foot.base] -= factor * foot.cos * (1.0 - foot.share);
  weights.x[foot.towards] += factor * foot.sin * foot.share;
  weights.y[foot.towards] -= factor * foot.cos * foot.share;
}

Vec2 edge_normal(Vec2 from, Vec2 to, double side) {
  const Vec2 along = to - from;
  const double size = norm(along);
  return {-side * along.y / size, side * along.x / size};
}

bool concerns(Vec2 point, Vec2 from, Vec2 to, double side) {
  const Vec2 along = to - from;
  const Vec2 rest = point - from;
  if (side * cross(along, rest) > 0.0) return point.x >= from.x && point.x <= to.x;
  const double share = dot(rest, along) / dot(along, along);
  return share >= 0.0 && share <= 1.0;
}

ConcernedPoints::ConcernedPoints(std::vector<Vec2> points) : points_(std::move(points)) {
  constexpr std::size_t kBlock = 16;     // taste: no result depends on it
  constexpr double kWider = 1.0 + 1e-6;  // rounding
  for (std::size_t first = 0; first < points_.size(); first += kBlock) {
    Block block{first, std::min(first + kBlock, points_.size()), {}, 0.0};
    block.centre = 0.5 * (points_[first] + points_[block.end - 1]);
    for (std::size_t i = first; i < block.end; ++i)
      block.radius = std::max(block.radius, kWider * norm(points_[i] - block.centre));
    blocks_.push_back(block);
  }
}

void ConcernedPoints::of_edge(Vec2 from, Vec2 to, double side, std::vector<std::size_t>& found) const {
  constexpr double kWider = 1e-9;  // rounding: of lengths in chords
  found.clear();
  const Vec2 along = to - from;
  const double length = norm(along);
  for (const Block& block : blocks_) {
    // Neither between the runs of its ends nor beside it.
    const double reach = block.radius + kWider;
    const double beside = dot(block.centre - from, along);
    const bool is_beside = beside >= -reach * length && beside <= (length + reach) * length;
    const bool is_over = block.centre.x >= from.x - reach && block.centre.x <= to.x + reach;
    if (!is_beside && !is_over) continue;
    for (std::size_t i = block.first; i < block.end; ++i) {
      if (concerns(points_[i], from, to, side)) found.push_back(i);
    }
  }
}

double curvature_at(const Transcription& track, const Vector& z, const Foot& foot) {
  const Layout& layout = track.layout();
  if (foot.at.part != Part::core) return 0.0;
  return ((1.0 - foot.at.share) * z[layout.turn(foot.at.piece)] +
          foot.at.share * z[layout.turn(foot.at.piece + 1)] + track.own_turn(foot.at.sigma)) /
         track.stretch(z, foot.at.piece);
}

// D'' = m.p'' + (b t t - t a - a t - D a a)/(1 + b D) with m = -side normal, t the derivative along the track,
// a that of the direction across it, b how the track bends towards m.
void add_foot_terms(const Transcription& track, const State& state, const Foot& foot, double distance,
                    double side, double factor, Matrix& hessian) {
  const Layout& layout = track.layout();
  const std::size_t n = layout.size();
  Vector dx;
  Vector dy;
  track.foot_derivatives(state.z, state.shape, foot, dx, dy);
  Vector along(n);
  for (std::size_t j = 0; j < n; ++j) along[j] = foot.cos * dx[j] + foot.sin * dy[j];
  Vector across(n);
  track.turning_row(foot.at, across.data());
  for (double& entry : across) entry *= -side;
  const double bend = side * curvature_at(track, state.z, foot);
  const double share = factor / (1.0 + bend * distance);
  add_symmetric(hessian, 0.5 * share * bend, along, along);
  add_symmetric(hessian, -share, along, across);
  add_symmetric(hessian, -0.5 * share * distance, across, across);
}

}  // namespace glissade::optimizer
