// Distances from obstacles and points, as rows of the search (docs/optimization.md, clearances).

#include "glissade/core/math.hpp"

#include "optimize/problem/feet.hpp"
#include "optimize/problem/measure.hpp"
#include "optimize/problem/round_rows.hpp"
#include "optimize/problem/rows.hpp"

#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

Foot foot_of(const RowAt& at, Vec2 point) {
  return at.track.foot(at.state.z, at.state.shape, point.x, point.y);
}

/// Of a corner of the limit's obstacle, looked for once in each state.
Foot corner_foot(const RowAt& at, std::size_t corner) {
  std::optional<Foot>& known = at.state.corner_foot(at.problem, at.limit.obstacle, corner);
  if (!known) known = foot_of(at, at.problem.obstacles[at.limit.obstacle].corners[corner]);
  return *known;
}

/// At a foot the distance changes with the track's position alone: to first order sliding along costs nothing.
void foot_gradient(const RowAt& at, const Foot& foot, Vec2 corner, double side, double* out) {
  Vector dx;
  Vector dy;
  at.track.foot_derivatives(at.state.z, at.state.shape, foot, dx, dy);
  Vec2 away{-side * foot.sin, side * foot.cos};
  if (foot.end) {
    const double distance = math::hypot(corner.x - foot.x, corner.y - foot.y);
    if (distance == 0.0) return;
    away = {(corner.x - foot.x) / distance, (corner.y - foot.y) / distance};
  }
  const std::size_t n = at.track.layout().size();
  add_scaled(out, -away.x, dx.data(), n);
  add_scaled(out, -away.y, dy.data(), n);
}

void add_terms_at_foot(const RowAt& at, const Foot& foot, Vec2 corner, double side, double factor,
                       Matrix& hessian) {
  if (foot.end) return;
  add_foot_terms(at.track, at.state, foot, corner_distance(foot, corner, side), side, factor, hessian);
}

/// From an obstacle: of stations from its edges, and of its corners from the track, each at its foot. Where clearances
/// are measured from more than the centerline, EnvelopeRows has the rows.
class Distance final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    const Obstacle& obstacle = obstacle_of(at);
    if (has_envelope(at)) return at.envelope.measure(at.state, obstacle, at.row);
    if (at.row.foot) {
      const Vec2 corner = obstacle.corners[at.row.place];
      return corner_distance(corner_foot(at, at.row.place), corner, obstacle.side);
    }
    if (at.row.around) return round_distance(at.state, obstacle, at.row);
    const Vec2 station{at.state.shape.x[at.row.place], at.state.shape.y[at.row.place]};
    return dot(obstacle.corners[at.row.edge] - station, forbidden(at));
  }

  void gradient(const RowAt& at, double* out) const override {
    const Obstacle& obstacle = obstacle_of(at);
    if (has_envelope(at)) return at.envelope.gradient(at.state, obstacle, at.row, out);
    if (at.row.foot) {
      const Vec2 corner = obstacle.corners[at.row.place];
      return foot_gradient(at, corner_foot(at, at.row.place), corner, obstacle.side, out);
    }
    if (at.row.around) return add_round_gradient(at.track, at.state, obstacle, at.row, out);
    at.track.add(at.state.shape.dx, at.row.place, -forbidden(at).x, out);
    at.track.add(at.state.shape.dy, at.row.place, -forbidden(at).y, out);
  }

  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    const Obstacle& obstacle = obstacle_of(at);
    if (has_envelope(at)) return at.envelope.add_weights(at.state, obstacle, at.row, factor, weights);
    if (at.row.foot) {
      return add_foot_weights(corner_foot(at, at.row.place), factor * obstacle.side, weights);
    }
    if (at.row.around) return add_round_weights(at.state, obstacle, at.row, factor, weights);
    weights.x[at.row.place] -= factor * forbidden(at).x;
    weights.y[at.row.place] -= factor * forbidden(at).y;
  }

  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    const Obstacle& obstacle = obstacle_of(at);
    if (has_envelope(at)) return at.envelope.add_direct_terms(at.state, obstacle, at.row, factor, hessian);
    if (at.row.around) return add_round_terms(at.track, at.state, obstacle, at.row, factor, hessian);
    if (!at.row.foot) return;
    const Vec2 corner = obstacle.corners[at.row.place];
    add_terms_at_foot(at, corner_foot(at, at.row.place), corner, obstacle.side, factor, hessian);
  }

  void add_rows(const RowAt& at, std::vector<Row>& rows) const override {
    if (has_envelope(at)) {
      const std::vector<Row> all = at.envelope.rows(at.state, at.row.limit);
      rows.insert(rows.end(), all.begin(), all.end());
      return;
    }
    const Obstacle& obstacle = obstacle_of(at);
    Row row = at.row;
    const std::vector<Station>& stations = at.track.stations();
    if (obstacle.endless) {
      for (row.place = 0; row.place < stations.size(); ++row.place) {
        if (stations[row.place].watched) rows.push_back(row);
      }
      return;
    }
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < stations.size(); ++i)
      points.push_back({at.state.shape.x[i], at.state.shape.y[i]});
    const ConcernedPoints track(std::move(points));
    std::vector<std::size_t> concerned;
    for (row.edge = 0; row.edge + 1 < obstacle.corners.size(); ++row.edge) {
      if (!obstacle.is_touchable(row.edge) || !obstacle.is_touchable(row.edge + 1)) continue;
      track.of_edge(obstacle.corners[row.edge], obstacle.corners[row.edge + 1], obstacle.side, concerned);
      for (const std::size_t i : concerned) {
        row.place = i;
        if (stations[i].watched) rows.push_back(row);
      }
    }
    const auto stands = [&](std::size_t station) { return stations[station].watched; };
    row.foot = true;
    row.edge = 0;
    for (row.place = 0; row.place < obstacle.corners.size(); ++row.place) {
      if (!obstacle.is_touchable(row.place)) continue;
      Row round = at.row;
      round.edge = row.place;
      const Vec2 corner = obstacle.corners[row.place];
      const bool bends =
          add_round_rows(at.state, obstacle, round, at.limit.bound, stands, rows) &&
          runs_round(at.track, at.state, corner, obstacle.side, corner_foot(at, row.place), at.limit.bound);
      if (!bends) rows.push_back(row);
    }
  }

  [[nodiscard]] double place(const RowAt& at) const override {
    if (!at.row.foot) return Measure::place(at);
    return at.track.arc_length(at.state.z, foot_of(at, obstacle_of(at).corner(at.row.place)).at);
  }
  [[nodiscard]] bool holds_along() const override { return true; }

 private:
  static const Obstacle& obstacle_of(const RowAt& at) { return at.problem.obstacles[at.limit.obstacle]; }
  static bool has_envelope(const RowAt& at) { return at.problem.envelope_high > at.problem.envelope_low; }
  static Vec2 forbidden(const RowAt& at) {
    const Obstacle& obstacle = obstacle_of(at);
    return obstacle.endless ? obstacle.forbidden : obstacle.normals[at.row.edge];
  }
};

/// Of the track from a point, at its foot; of several points, at their places in their order.
class Waypoint final : public Measure {
 public:
  [[nodiscard]] double value(const RowAt& at) const override {
    return corner_distance(foot(at), point(at), 1.0);
  }
  void gradient(const RowAt& at, double* out) const override {
    foot_gradient(at, foot(at), point(at), 1.0, out);
  }
  void add_weights(const RowAt& at, double factor, StationWeights& weights) const override {
    add_foot_weights(foot(at), factor, weights);
  }
  void add_terms(const RowAt& at, double factor, Matrix& hessian) const override {
    add_terms_at_foot(at, foot(at), point(at), 1.0, factor, hessian);
  }
  void add_rows(const RowAt&, std::vector<Row>&) const override {}
  void set_exact_row(Row& row) const override { row.foot = true; }
  [[nodiscard]] double place(const RowAt& at) const override {
    return at.track.arc_length(at.state.z, foot(at).at);
  }

 private:
  static Vec2 point(const RowAt& at) { return at.problem.waypoints[at.limit.obstacle]; }
  static Foot foot(const RowAt& at) {
    if (at.state.waypoint_stations.empty()) return foot_of(at, point(at));
    return at.track.foot(at.state.z, at.state.shape, point(at).x, point(at).y,
                         at.state.waypoint_stations[at.limit.obstacle]);
  }
};

constinit const Distance kDistance{};
constinit const Waypoint kWaypoint{};

}  // namespace

constinit const Measure* const Measure::distance = &kDistance;
constinit const Measure* const Measure::waypoint = &kWaypoint;

}  // namespace glissade::optimizer
