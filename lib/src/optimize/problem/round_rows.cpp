#include "optimize/problem/round_rows.hpp"

#include "optimize/problem/feet.hpp"
#include "optimize/problem/rows.hpp"

namespace glissade::optimizer {
namespace {

Vec2 station_at(const State& state, const Row& row) {
  return {state.shape.x[row.place], state.shape.y[row.place]};
}

/// From the corner to the station, of length 1.
Vec2 outward(const State& state, const Obstacle& obstacle, const Row& row) {
  const Vec2 way = station_at(state, row) - obstacle.corners[row.edge];
  const double size = norm(way);
  return size > 0.0 ? (1.0 / size) * way : -obstacle.side * Vec2{0.0, 1.0};
}

/// Whether the free side lies round a corner, not within it as in a gully.
bool stands_out(const Obstacle& obstacle, std::size_t corner) {
  const std::vector<Vec2>& corners = obstacle.corners;
  if (corner == 0 || corner + 1 == corners.size()) return true;
  return obstacle.side * cross(corners[corner] - corners[corner - 1], corners[corner + 1] - corners[corner]) >
         0.0;
}

/// Whether a point is as far from the chain about this corner as from the corner.
bool lies_past_edges(const Obstacle& obstacle, std::size_t corner, Vec2 point) {
  const std::vector<Vec2>& corners = obstacle.corners;
  const Vec2 way = point - corners[corner];
  if (corner > 0 && dot(way, corners[corner] - corners[corner - 1]) < 0.0) return false;
  return corner + 1 >= corners.size() || dot(way, corners[corner + 1] - corners[corner]) <= 0.0;
}

}  // namespace

bool add_round_rows(const State& state, const Obstacle& obstacle, Row row, double nearest,
                    const std::function<bool(std::size_t)>& stands, std::vector<Row>& rows) {
  constexpr double kReach = 1.5;  // taste: of the least distance
  if (!(nearest > 0.0) || !stands_out(obstacle, row.edge)) return false;
  const std::size_t before = rows.size();
  row.around = true;
  for (row.place = 0; row.place < state.shape.x.size(); ++row.place) {
    const Vec2 point = station_at(state, row);
    const Vec2 way = point - obstacle.corners[row.edge];
    if (dot(way, way) > kReach * kReach * nearest * nearest) continue;
    if (lies_past_edges(obstacle, row.edge, point) && stands(row.place)) rows.push_back(row);
  }
  return rows.size() > before;
}

bool runs_round(const Transcription& track, const State& state, Vec2 corner, double side, const Foot& foot,
                double nearest) {
  constexpr double kReach = 1.5;   // taste: of the least distance
  constexpr double kSpread = 0.5;  // taste: 0 where the corner is the centre of curvature
  if (foot.end) return false;
  const double distance = corner_distance(foot, corner, side);
  return distance > 0.0 && distance < kReach * nearest &&
         1.0 + side * curvature_at(track, state.z, foot) * distance < kSpread;
}

double round_distance(const State& state, const Obstacle& obstacle, const Row& row) {
  return norm(station_at(state, row) - obstacle.corners[row.edge]);
}

void add_round_gradient(const Transcription& track, const State& state, const Obstacle& obstacle,
                        const Row& row, double* out) {
  const Vec2 away = outward(state, obstacle, row);
  track.add(state.shape.dx, row.place, away.x, out);
  track.add(state.shape.dy, row.place, away.y, out);
}

void add_round_weights(const State& state, const Obstacle& obstacle, const Row& row, double factor,
                       StationWeights& weights) {
  const Vec2 away = outward(state, obstacle, row);
  weights.x[row.place] += factor * away.x;
  weights.y[row.place] += factor * away.y;
}

void add_round_terms(const Transcription& track, const State& state, const Obstacle& obstacle, const Row& row,
                     double factor, Matrix& hessian) {
  const double distance = round_distance(state, obstacle, row);
  if (distance == 0.0) return;
  const Vec2 away = outward(state, obstacle, row);
  Vector across(track.layout().size(), 0.0);
  track.add(state.shape.dx, row.place, -away.y, across.data());
  track.add(state.shape.dy, row.place, away.x, across.data());
  add_symmetric(hessian, 0.5 * factor / distance, across, across);
}

}  // namespace glissade::optimizer
