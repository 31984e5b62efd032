#include "optimize/rows.hpp"

#include "glissade/core/math.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

/// 2 (s + v_0/2): squared speed of free fall through the arc length.
double free_fall(const Transcription& track, std::size_t station, double entry_speed2) {
  return 2.0 * track.stations()[station].arc_length(track.mesh().core_length) + entry_speed2;
}

}  // namespace

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

namespace {

/// The stations closest to some points, ascending, with the least sum of squared distances.
std::vector<std::size_t> passed_in_order(const Shape& shape, const std::vector<Vec2>& points) {
  const std::size_t count = shape.x.size();
  // Of the points so far: the least sum with the last of them at or before a station, and which station that is.
  Vector least(count, 0.0);
  std::vector<std::vector<std::size_t>> best(points.size(), std::vector<std::size_t>(count, 0));
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      const double dx = shape.x[i] - points[k].x;
      const double dy = shape.y[i] - points[k].y;
      const double sum = least[i] + dx * dx + dy * dy;
      const bool earlier = i > 0 && least[i - 1] <= sum;
      least[i] = earlier ? least[i - 1] : sum;
      best[k][i] = earlier ? best[k][i - 1] : i;
    }
  }
  std::vector<std::size_t> stations(points.size(), 0);
  std::size_t last = count - 1;
  for (std::size_t k = points.size(); k-- > 0;) {
    stations[k] = best[k][last];
    last = stations[k];
  }
  return stations;
}

}  // namespace

Rows::Rows(const ScaledProblem& problem, const Transcription& track)
    : problem_(problem),
      track_(track),
      envelope_(problem, track),
      fixed_equalities_(static_cast<std::size_t>(fixes_run(problem.finish)) +
                        static_cast<std::size_t>(fixes_drop(problem.finish))),
      margins_(problem.limits.size(), 0.0) {
  if (problem.lead_in > 0.0) ++fixed_equalities_;
  if (problem.lead_out > 0.0) ++fixed_equalities_;
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    if (limit.side != 0) continue;
    equality_limits_.emplace_back(i, 0);
    const std::size_t last = problem.rides.size() - 1;
    if (limit.measure == Measure::exit_speed && last > 0) equality_limits_.emplace_back(i, last);
  }
}

State Rows::state(const Vector& z, bool derivatives) const {
  State state;
  state.z = z;
  track_.shape(z, state.shape, derivatives);
  // One waypoint has no order.
  if (problem_.waypoints.size() > 1)
    state.waypoint_stations = passed_in_order(state.shape, problem_.waypoints);
  if (has_envelope()) state.zones = envelope_.zones(state.shape);
  state.flows.resize(problem_.rides.size());
  for (std::size_t r = 0; r < problem_.rides.size(); ++r) {
    track_.flow(z, state.shape, problem_.rides[r], state.flows[r], derivatives);
  }
  return state;
}

double Rows::objective(const State& state) const {
  const Flow& flow = state.flows[problem_.objective_ride];
  double value = problem_.time_weight * flow.time;
  if (problem_.speed_weight > 0.0) {
    // A squared speed below zero is a body that would not arrive: its root is continued as an odd function.
    const double v = flow.v.back();
    value -= problem_.speed_weight * std::copysign(std::sqrt(std::fabs(v)), v);
  }
  value += problem_.drop_weight * state.shape.y.back();
  value += problem_.length_weight * state.z[track_.layout().length()];
  return value;
}

Vector Rows::objective_gradient(const State& state) const {
  const Flow& flow = state.flows[problem_.objective_ride];
  Vector gradient = flow.dtime;
  for (double& entry : gradient) entry *= problem_.time_weight;
  if (problem_.speed_weight > 0.0) {
    const std::size_t last = flow.v.size() - 1;
    const double root = std::sqrt(std::max(std::fabs(flow.v[last]), 1e-12));
    track_.add(flow.dv, last, -problem_.speed_weight * 0.5 / root, gradient.data());
  }
  if (problem_.drop_weight > 0.0)
    track_.add(state.shape.dy, state.shape.y.size() - 1, problem_.drop_weight, gradient.data());
  gradient[track_.layout().length()] += problem_.length_weight;
  return gradient;
}

Rows::RunSpeed Rows::exit_run_speed(const State& state, const Row& row) const {
  // u cos(zeta), a squared speed below zero continued as in objective().
  const double v = state.flows[row.ride].v[row.place];
  const double u = std::sqrt(std::max(std::fabs(v), 1e-12));
  const double cosine = state.shape.cos[row.place];
  const double sine = state.shape.sin[row.place];
  RunSpeed run;
  run.value = std::copysign(u, v) * cosine;
  run.by_v = 0.5 * cosine / u;
  run.by_zeta = -u * sine;
  run.by_v_v = -0.25 * cosine / (u * u * u);
  run.by_zeta_v = -0.5 * sine / u;
  run.by_zeta_zeta = -u * cosine;
  return run;
}

double Rows::effective_bound(const LimitSpec& limit) const {
  const bool squared = limit.measure == Measure::speed || limit.measure == Measure::exit_speed;
  return squared ? limit.bound * limit.bound : limit.bound;
}

double Rows::effective_scale(const LimitSpec& limit) const {
  const bool squared = limit.measure == Measure::speed || limit.measure == Measure::exit_speed;
  return squared ? 2.0 * limit.bound * limit.scale : limit.scale;
}

const std::size_t* Rows::limit_of_equality(std::size_t row) const {
  return row < fixed_equalities_ ? nullptr : &equality_limits_[row - fixed_equalities_].first;
}

Row Rows::row_of_equality(std::size_t index) const {
  Row row;
  const auto& [limit, ride] = equality_limits_[index - fixed_equalities_];
  row.limit = limit;
  row.ride = ride;
  const Measure measure = problem_.limits[limit].measure;
  row.place = measure == Measure::entry_slope_angle ? 0 : track_.stations().size() - 1;
  row.foot = measure == Measure::waypoint;
  return row;
}

Vector Rows::equality_values(const State& state) const {
  const Layout& layout = track_.layout();
  Vector value;
  value.reserve(equality_count());
  if (fixes_run(problem_.finish)) value.push_back(state.shape.x.back() - problem_.run);
  if (fixes_drop(problem_.finish)) value.push_back(state.shape.y.back() - problem_.drop);
  if (problem_.lead_in > 0.0) value.push_back(state.z[layout.turn(0)]);
  if (problem_.lead_out > 0.0) value.push_back(state.z[layout.turn(layout.knots - 1)]);
  for (std::size_t i = fixed_equalities_; i < equality_count(); ++i) {
    const Row row = row_of_equality(i);
    const LimitSpec& limit = problem_.limits[row.limit];
    value.push_back((measure(state, limit, row) - effective_bound(limit)) / effective_scale(limit));
  }
  return value;
}

void Rows::equalities(const State& state, Vector& value, Matrix& jacobian) const {
  const Layout& layout = track_.layout();
  const std::size_t n = layout.size();
  const std::size_t last = track_.stations().size() - 1;
  value = equality_values(state);
  jacobian = Matrix(equality_count(), n);
  std::size_t at = 0;
  if (fixes_run(problem_.finish)) track_.add(state.shape.dx, last, 1.0, jacobian.row(at++));
  if (fixes_drop(problem_.finish)) track_.add(state.shape.dy, last, 1.0, jacobian.row(at++));
  if (problem_.lead_in > 0.0) jacobian(at++, layout.turn(0)) = 1.0;
  if (problem_.lead_out > 0.0) jacobian(at++, layout.turn(layout.knots - 1)) = 1.0;
  for (; at < equality_count(); ++at) {
    const Row row = row_of_equality(at);
    const LimitSpec& limit = problem_.limits[row.limit];
    measure_gradient(state, limit, row, jacobian.row(at));
    for (std::size_t j = 0; j < n; ++j) jacobian(at, j) /= effective_scale(limit);
  }
}

Ride::CurvatureLoad Rows::curvature_load(const State& state, const Row& row) const {
  return problem_.rides[row.ride].curvature_load(state.shape.curvature[row.place],
                                                 state.flows[row.ride].v[row.place]);
}

Rows::WidthFactor Rows::width_factor(const State& state, const LimitSpec& limit, const Row& row) const {
  const auto* const stream = dynamic_cast<const BulkStream*>(problem_.rides[row.ride].law.get());
  if (limit.width_power == 0 || stream == nullptr || stream->shape().width.is_constant()) return {};
  const Station& station = track_.stations()[row.place];
  const double s = station.arc_length(state.z[track_.layout().length()]);
  const double width = stream->width(s);
  const double share = width / stream->width(0.0);
  const double value = math::pow(share, limit.width_power);
  const double narrowing = stream->width_slope(s) / width * station.sigma;
  const double power = limit.width_power;
  return {value, power * value * narrowing, power * (power - 1.0) * value * narrowing * narrowing};
}

double Rows::measure(const State& state, const LimitSpec& limit, const Row& row) const {
  return width_factor(state, limit, row).value * plain_measure(state, limit, row);
}

void Rows::measure_gradient(const State& state, const LimitSpec& limit, const Row& row, double* out) const {
  plain_gradient(state, limit, row, out);
  const WidthFactor width = width_factor(state, limit, row);
  if (width.value == 1.0 && width.first == 0.0) return;
  for (std::size_t j = 0; j < track_.layout().size(); ++j) out[j] *= width.value;
  out[track_.layout().length()] += width.first * plain_measure(state, limit, row);
}

double Rows::plain_measure(const State& state, const LimitSpec& limit, const Row& row) const {
  const Shape& shape = state.shape;
  const Layout& layout = track_.layout();
  const std::size_t last = track_.stations().size() - 1;
  const double length = state.z[layout.length()];
  switch (limit.measure) {
    case Measure::entry_slope_angle:
    case Measure::exit_slope_angle:
    case Measure::slope_angle:
      return shape.zeta[row.place];
    case Measure::curvature:
      return bend(state.z, row.place).turn / length;
    case Measure::curvature_rate: {
      const Vector& knots = track_.mesh().knots;
      return (state.z[layout.turn(row.place + 1)] - state.z[layout.turn(row.place)]) /
             ((knots[row.place + 1] - knots[row.place]) * length * length);
    }
    case Measure::normal_load:
      return shape.cos[row.place] + curvature_load(state, row).value;
    case Measure::curvature_load:
      return curvature_load(state, row).value;
    case Measure::speed:
    case Measure::exit_speed:
      return state.flows[row.ride].v[row.place];
    case Measure::exit_run_speed:
      return exit_run_speed(state, row).value;
    case Measure::arc_length:
      return problem_.lead_in + length + problem_.lead_out;
    case Measure::finish_coordinate:
      return limit.name.id == LimitId::finish_run ? shape.x[last] : shape.y[last];
    case Measure::distance: {
      const Obstacle& obstacle = problem_.obstacles[limit.obstacle];
      if (has_envelope()) return envelope_.measure(state, obstacle, row);
      if (row.foot) {
        const Vec2 corner = obstacle.corners[row.place];
        return corner_distance(foot_of(state, limit, row), corner, obstacle.side);
      }
      const Vec2 forbidden = obstacle.endless ? obstacle.forbidden
                                              : edge_normal(obstacle.corners[row.edge],
                                                            obstacle.corners[row.edge + 1], obstacle.side);
      return dot(obstacle.corners[row.edge] - Vec2{shape.x[row.place], shape.y[row.place]}, forbidden);
    }
    case Measure::waypoint: {
      const Vec2 point = problem_.waypoints[limit.obstacle];
      const Foot foot = foot_of(state, limit, row);
      return corner_distance(foot, point, 1.0);
    }
    case Measure::arrival:
      return state.flows[row.ride].v[row.place] /
             free_fall(track_, row.place, problem_.rides[row.ride].entry_speed2);
  }
  return 0.0;
}

void Rows::plain_gradient(const State& state, const LimitSpec& limit, const Row& row, double* out) const {
  const Shape& shape = state.shape;
  const Layout& layout = track_.layout();
  const std::size_t n = layout.size();
  const std::size_t last = track_.stations().size() - 1;
  const double length = state.z[layout.length()];
  std::fill_n(out, n, 0.0);
  const auto add_load = [&](bool weight) {
    const Flow& flow = state.flows[row.ride];
    const double curvature = shape.curvature[row.place];
    const Ride::CurvatureLoad load = curvature_load(state, row);
    if (weight) track_.add_dzeta(row.place, -shape.sin[row.place], out);
    track_.add(flow.dv, row.place, load.by_v, out);
    const Station& station = track_.stations()[row.place];
    if (station.part != Part::core) return;
    const double v = load.by_curvature;
    out[layout.turn(station.piece)] += v * (1.0 - station.share) / length;
    out[layout.turn(station.piece + 1)] += v * station.share / length;
    out[layout.length()] -= v * curvature / length;
  };
  switch (limit.measure) {
    case Measure::entry_slope_angle:
    case Measure::exit_slope_angle:
    case Measure::slope_angle:
      track_.add_dzeta(row.place, 1.0, out);
      return;
    case Measure::curvature: {
      const Bend at = bend(state.z, row.place);
      out[layout.turn(at.piece)] = (1.0 - at.share) / length;
      out[layout.turn(at.piece + 1)] = at.share / length;
      out[layout.length()] = -at.turn / (length * length);
      return;
    }
    case Measure::curvature_rate: {
      const Vector& knots = track_.mesh().knots;
      const double factor = 1.0 / ((knots[row.place + 1] - knots[row.place]) * length * length);
      out[layout.turn(row.place + 1)] = factor;
      out[layout.turn(row.place)] = -factor;
      out[layout.length()] = -2.0 * measure(state, limit, row) / length;
      return;
    }
    case Measure::normal_load:
      add_load(true);
      return;
    case Measure::curvature_load:
      add_load(false);
      return;
    case Measure::speed:
    case Measure::exit_speed:
      track_.add(state.flows[row.ride].dv, row.place, 1.0, out);
      return;
    case Measure::exit_run_speed: {
      const RunSpeed run = exit_run_speed(state, row);
      track_.add(state.flows[row.ride].dv, row.place, run.by_v, out);
      track_.add_dzeta(row.place, run.by_zeta, out);
      return;
    }
    case Measure::arc_length:
      out[layout.length()] = 1.0;
      return;
    case Measure::finish_coordinate:
      track_.add(limit.name.id == LimitId::finish_run ? shape.dx : shape.dy, last, 1.0, out);
      return;
    case Measure::distance: {
      const Obstacle& obstacle = problem_.obstacles[limit.obstacle];
      if (has_envelope()) {
        envelope_.gradient(state, obstacle, row, out);
        return;
      }
      if (!row.foot) {
        const Vec2 forbidden = obstacle.endless ? obstacle.forbidden
                                                : edge_normal(obstacle.corners[row.edge],
                                                              obstacle.corners[row.edge + 1], obstacle.side);
        track_.add(shape.dx, row.place, -forbidden.x, out);
        track_.add(shape.dy, row.place, -forbidden.y, out);
        return;
      }
      break;
    }
    case Measure::waypoint:
      break;
    case Measure::arrival:
      track_.add(state.flows[row.ride].dv, row.place,
                 1.0 / free_fall(track_, row.place, problem_.rides[row.ride].entry_speed2), out);
      return;
  }
  // At a foot the distance changes with the track's position alone: to first order sliding along costs
  // nothing.
  const bool obstacle = limit.measure == Measure::distance;
  const Vec2 corner =
      obstacle ? problem_.obstacles[limit.obstacle].corners[row.place] : problem_.waypoints[limit.obstacle];
  const double side = obstacle ? problem_.obstacles[limit.obstacle].side : 1.0;
  const Foot foot = foot_of(state, limit, row);
  Vector dx;
  Vector dy;
  track_.foot_derivatives(state.z, shape, foot, dx, dy);
  Vec2 away{-side * foot.sin, side * foot.cos};
  if (foot.end) {
    const double distance = math::hypot(corner.x - foot.x, corner.y - foot.y);
    if (distance == 0.0) return;
    away = {(corner.x - foot.x) / distance, (corner.y - foot.y) / distance};
  }
  add_scaled(out, -away.x, dx.data(), n);
  add_scaled(out, -away.y, dy.data(), n);
}

Foot Rows::foot_of(const State& state, const LimitSpec& limit, const Row& row) const {
  const bool waypoint = limit.measure == Measure::waypoint;
  const Vec2 point =
      waypoint ? problem_.waypoints[limit.obstacle] : problem_.obstacles[limit.obstacle].corner(row.place);
  if (!waypoint || state.waypoint_stations.empty()) {
    return track_.foot(state.z, state.shape, point.x, point.y);
  }
  return track_.foot(state.z, state.shape, point.x, point.y, state.waypoint_stations[limit.obstacle]);
}

Rows::Bend Rows::bend(const Vector& z, std::size_t place) const {
  const Layout& layout = track_.layout();
  if (place >= layout.knots) {
    const FineKnot& fine = track_.fine_knots()[place - layout.knots];
    return {fine.piece, fine.share, track_.fine_turn(z, place - layout.knots), fine.sigma};
  }
  // The last knot is the end of the last piece.
  const std::size_t piece = std::min(place, layout.knots - 2);
  return {piece, place == piece ? 0.0 : 1.0, z[layout.turn(place)], track_.mesh().knots[place]};
}

double Rows::value(const State& state, const Row& row) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  return limit.side * (measure(state, limit, row) - effective_bound(limit)) / effective_scale(limit) +
         margins_[row.limit];
}

void Rows::gradient(const State& state, const Row& row, double* out) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  measure_gradient(state, limit, row, out);
  const double factor = limit.side / effective_scale(limit);
  for (std::size_t j = 0; j < track_.layout().size(); ++j) out[j] *= factor;
}

double Rows::place(const State& state, const Row& row) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  const double length = state.z[track_.layout().length()];
  if (limit.measure == Measure::curvature) {
    return problem_.lead_in + length * bend(state.z, row.place).sigma;
  }
  if (limit.measure == Measure::curvature_rate) {
    return problem_.lead_in + length * track_.mesh().knots[row.place];
  }
  if (row.foot) {
    return foot_of(state, limit, row).at.arc_length(length);
  }
  return track_.stations()[row.place].arc_length(length);
}

std::vector<Row> Rows::candidates(const State& state, double band) const {
  const std::vector<Station>& stations = track_.stations();
  const std::size_t last = stations.size() - 1;
  const std::size_t last_ride = problem_.rides.size() - 1;
  const double length = state.z[track_.layout().length()];
  std::vector<Row> rows;
  const auto consider = [&](const Row& row) {
    if (value(state, row) > -band) rows.push_back(row);
  };
  for (std::size_t i = 0; i < problem_.limits.size(); ++i) {
    const LimitSpec& limit = problem_.limits[i];
    if (limit.side == 0) continue;
    Row row;
    row.limit = i;
    const auto everywhere = [&](std::size_t ride, std::size_t first) {
      row.ride = ride;
      for (row.place = first; row.place <= last; ++row.place) {
        if (stations[row.place].watched) consider(row);
      }
    };
    switch (limit.measure) {
      case Measure::entry_slope_angle:
        consider(row);
        break;
      case Measure::exit_slope_angle:
      case Measure::arc_length:
      case Measure::finish_coordinate:
        row.place = last;
        consider(row);
        break;
      case Measure::slope_angle:
        everywhere(0, 0);
        break;
      case Measure::curvature:
        for (row.place = 0; row.place < track_.layout().knots + track_.fine_knots().size(); ++row.place) {
          consider(row);
        }
        break;
      case Measure::curvature_rate:
        for (row.place = 0; row.place + 1 < track_.layout().knots; ++row.place) consider(row);
        break;
      // More friction is a slower body at every point, so the ends of the friction range hold all between.
      case Measure::normal_load:
        everywhere(limit.ride.value_or(0), 0);
        if (limit.side < 0 && last_ride > 0) everywhere(last_ride, 0);
        break;
      case Measure::curvature_load:
        everywhere(0, 0);
        break;
      case Measure::speed:
        row.ride = limit.side > 0 ? 0 : last_ride;
        for (row.place = 0; row.place <= last; ++row.place) {
          const double s = stations[row.place].arc_length(length);
          if (!stations[row.place].watched) continue;
          const bool of_speed = limit.name.id == LimitId::speed;
          if (limit.side < 0 && of_speed && s < problem_.lowest_speed_from * (1.0 - 1e-9)) continue;
          consider(row);
        }
        break;
      case Measure::exit_speed:
        row.ride = limit.side > 0 ? 0 : last_ride;
        row.place = last;
        consider(row);
        break;
      case Measure::exit_run_speed:
        row.ride = limit.side > 0 ? 0 : last_ride;
        row.place = last;
        consider(row);
        break;
      case Measure::arrival:
        everywhere(last_ride, 1);
        break;
      case Measure::distance: {
        if (has_envelope()) {
          for (const Row& place : envelope_.rows(state, i)) consider(place);
          break;
        }
        const Obstacle& obstacle = problem_.obstacles[limit.obstacle];
        if (obstacle.endless) {
          everywhere(0, 0);
          break;
        }
        for (row.edge = 0; row.edge + 1 < obstacle.corners.size(); ++row.edge) {
          const Vec2 from = obstacle.corners[row.edge];
          const Vec2 to = obstacle.corners[row.edge + 1];
          for (row.place = 0; row.place <= last; ++row.place) {
            if (!stations[row.place].watched) continue;
            if (concerns({state.shape.x[row.place], state.shape.y[row.place]}, from, to, obstacle.side)) {
              consider(row);
            }
          }
        }
        row.foot = true;
        row.edge = 0;
        for (row.place = 0; row.place < obstacle.corners.size(); ++row.place) consider(row);
        break;
      }
      case Measure::waypoint:
        break;
    }
  }
  return rows;
}

void Rows::add_measure_weights(const State& state, const LimitSpec& limit, const Row& row, double factor,
                               StationWeights& weights) const {
  // Second derivatives through the state; the others are direct terms.
  factor *= width_factor(state, limit, row).value;
  const Shape& shape = state.shape;
  const std::size_t last = track_.stations().size() - 1;
  switch (limit.measure) {
    case Measure::normal_load:
      weights.zeta_zeta[row.place] -= factor * shape.cos[row.place];
      weights.v[row.ride][row.place] += factor * curvature_load(state, row).by_v;
      return;
    case Measure::curvature_load:
      weights.v[row.ride][row.place] += factor * curvature_load(state, row).by_v;
      return;
    case Measure::speed:
    case Measure::exit_speed:
      weights.v[row.ride][row.place] += factor;
      return;
    case Measure::exit_run_speed: {
      const RunSpeed run = exit_run_speed(state, row);
      weights.v[row.ride][row.place] += factor * run.by_v;
      weights.v_v[row.ride][row.place] += factor * run.by_v_v;
      weights.zeta_zeta[row.place] += factor * run.by_zeta_zeta;
      return;
    }
    case Measure::arrival:
      weights.v[row.ride][row.place] +=
          factor / free_fall(track_, row.place, problem_.rides[row.ride].entry_speed2);
      return;
    case Measure::finish_coordinate:
      (limit.name.id == LimitId::finish_run ? weights.x : weights.y)[last] += factor;
      return;
    case Measure::distance: {
      const Obstacle& obstacle = problem_.obstacles[limit.obstacle];
      if (has_envelope()) {
        envelope_.add_weights(state, obstacle, row, factor, weights);
        return;
      }
      if (row.foot) {
        const Foot foot = foot_of(state, limit, row);
        add_foot_weights(foot, factor * obstacle.side, weights);
        return;
      }
      const Vec2 forbidden = obstacle.endless ? obstacle.forbidden
                                              : edge_normal(obstacle.corners[row.edge],
                                                            obstacle.corners[row.edge + 1], obstacle.side);
      weights.x[row.place] -= factor * forbidden.x;
      weights.y[row.place] -= factor * forbidden.y;
      return;
    }
    case Measure::waypoint: {
      const Foot foot = foot_of(state, limit, row);
      add_foot_weights(foot, factor, weights);
      return;
    }
    case Measure::entry_slope_angle:
    case Measure::exit_slope_angle:
    case Measure::slope_angle:
    case Measure::curvature:
    case Measure::curvature_rate:
    case Measure::arc_length:
      return;
  }
}

StationWeights Rows::weights(const State& state, const Vector& equality, const std::vector<Row>& rows,
                             const Vector& inequality, double objective) const {
  const std::size_t count = track_.stations().size();
  const std::size_t last = count - 1;
  StationWeights weights;
  weights.x.assign(count, 0.0);
  weights.y.assign(count, 0.0);
  weights.zeta_zeta.assign(count, 0.0);
  weights.v.assign(problem_.rides.size(), Vector(count, 0.0));
  weights.v_v = weights.v;
  weights.time.assign(problem_.rides.size(), 0.0);
  weights.time[problem_.objective_ride] = objective * problem_.time_weight;
  if (problem_.speed_weight > 0.0) {
    const double root = std::sqrt(std::max(std::fabs(state.flows[problem_.objective_ride].v[last]), 1e-12));
    weights.v[problem_.objective_ride][last] -= objective * problem_.speed_weight * 0.5 / root;
    weights.v_v[problem_.objective_ride][last] +=
        objective * problem_.speed_weight * 0.25 / (root * root * root);
  }
  weights.y[last] += objective * problem_.drop_weight;
  std::size_t row = 0;
  if (fixes_run(problem_.finish)) weights.x[last] += equality[row++];
  if (fixes_drop(problem_.finish)) weights.y[last] += equality[row++];
  for (row = fixed_equalities_; row < equality.size(); ++row) {
    const Row at = row_of_equality(row);
    const LimitSpec& limit = problem_.limits[at.limit];
    add_measure_weights(state, limit, at, equality[row] / effective_scale(limit), weights);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (inequality[i] == 0.0) continue;
    const LimitSpec& limit = problem_.limits[rows[i].limit];
    add_measure_weights(state, limit, rows[i], inequality[i] * limit.side / effective_scale(limit), weights);
  }
  return weights;
}

namespace {

/// Second derivative of c/L, c = first z_i + second z_(i+1).
void add_curvature_terms(Matrix& hessian, std::size_t at, double first, double second, std::size_t at_length,
                         double curvature, double length, double factor) {
  const auto add_pair = [&](std::size_t j, double value) {
    hessian(j, at_length) += value;
    hessian(at_length, j) += value;
  };
  add_pair(at, -factor * first / (length * length));
  if (second != 0.0) add_pair(at + 1, -factor * second / (length * length));
  hessian(at_length, at_length) += 2.0 * factor * curvature / (length * length);
}

}  // namespace

void add_symmetric(Matrix& hessian, double factor, const Vector& a, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    add_scaled(hessian.row(i), factor * a[i], b.data(), b.size());
    add_scaled(hessian.row(i), factor * b[i], a.data(), a.size());
  }
}

double curvature_at(const Transcription& track, const Vector& z, const Foot& foot) {
  const Layout& layout = track.layout();
  if (foot.at.part != Part::core) return 0.0;
  return ((1.0 - foot.at.share) * z[layout.turn(foot.at.piece)] +
          foot.at.share * z[layout.turn(foot.at.piece + 1)] + track.own_turn(foot.at.sigma)) /
         z[layout.length()];
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

void Rows::add_direct_terms(const State& state, const LimitSpec& limit, const Row& row, double factor,
                            Matrix& hessian) const {
  const WidthFactor width = width_factor(state, limit, row);
  add_plain_terms(state, limit, row, factor * width.value, hessian);
  if (width.first == 0.0) return;
  const std::size_t n = track_.layout().size();
  Vector gradient(n);
  plain_gradient(state, limit, row, gradient.data());
  Vector by_length(n, 0.0);
  by_length[track_.layout().length()] = 1.0;
  add_symmetric(hessian, factor * width.first, gradient, by_length);
  const double value = plain_measure(state, limit, row);
  add_symmetric(hessian, 0.5 * factor * width.second * value, by_length, by_length);
}

void Rows::add_plain_terms(const State& state, const LimitSpec& limit, const Row& row, double factor,
                           Matrix& hessian) const {
  const Layout& layout = track_.layout();
  const std::size_t n = layout.size();
  const std::size_t at_length = layout.length();
  const double length = state.z[at_length];
  switch (limit.measure) {
    case Measure::normal_load:
    case Measure::curvature_load: {
      // kappa v: curvature and speed both change.
      const Station& station = track_.stations()[row.place];
      if (station.part != Part::core) return;
      const Flow& flow = state.flows[row.ride];
      const double curvature = state.shape.curvature[row.place];
      Vector by_curvature(n, 0.0);
      by_curvature[layout.turn(station.piece)] = (1.0 - station.share) / length;
      by_curvature[layout.turn(station.piece + 1)] = station.share / length;
      by_curvature[at_length] = -curvature / length;
      Vector dv(n, 0.0);
      track_.add(flow.dv, row.place, 1.0, dv.data());
      const Ride::CurvatureLoad load = curvature_load(state, row);
      add_symmetric(hessian, factor * load.by_curvature_v, by_curvature, dv);
      if (load.by_curvature_curvature != 0.0) {
        add_symmetric(hessian, 0.5 * factor * load.by_curvature_curvature, by_curvature, by_curvature);
      }
      add_curvature_terms(hessian, layout.turn(station.piece), 1.0 - station.share, station.share, at_length,
                          curvature, length, factor * load.by_curvature);
      return;
    }
    case Measure::curvature: {
      const Bend at = bend(state.z, row.place);
      add_curvature_terms(hessian, layout.turn(at.piece), 1.0 - at.share, at.share, at_length,
                          at.turn / length, length, factor);
      return;
    }
    case Measure::curvature_rate: {
      const Vector& knots = track_.mesh().knots;
      const double by_turn =
          -2.0 * factor / ((knots[row.place + 1] - knots[row.place]) * length * length * length);
      const auto add_pair = [&](std::size_t j, double value) {
        hessian(j, at_length) += value;
        hessian(at_length, j) += value;
      };
      add_pair(layout.turn(row.place + 1), by_turn);
      add_pair(layout.turn(row.place), -by_turn);
      hessian(at_length, at_length) += 6.0 * factor * measure(state, limit, row) / (length * length);
      return;
    }
    case Measure::distance:
    case Measure::waypoint: {
      const bool obstacle = limit.measure == Measure::distance;
      if (obstacle && has_envelope()) {
        envelope_.add_direct_terms(state, problem_.obstacles[limit.obstacle], row, factor, hessian);
        return;
      }
      if (!row.foot) return;
      const Vec2 corner = obstacle ? problem_.obstacles[limit.obstacle].corners[row.place]
                                   : problem_.waypoints[limit.obstacle];
      const double side = obstacle ? problem_.obstacles[limit.obstacle].side : 1.0;
      const Foot foot = foot_of(state, limit, row);
      if (foot.end) return;
      add_foot_terms(track_, state, foot, corner_distance(foot, corner, side), side, factor, hessian);
      return;
    }
    case Measure::exit_run_speed: {
      Vector dv(n, 0.0);
      Vector dz(n, 0.0);
      track_.add(state.flows[row.ride].dv, row.place, 1.0, dv.data());
      track_.add_dzeta(row.place, 1.0, dz.data());
      add_symmetric(hessian, factor * exit_run_speed(state, row).by_zeta_v, dv, dz);
      return;
    }
    case Measure::entry_slope_angle:
    case Measure::exit_slope_angle:
    case Measure::slope_angle:
    case Measure::speed:
    case Measure::exit_speed:
    case Measure::arc_length:
    case Measure::finish_coordinate:
    case Measure::arrival:
      return;
  }
}

Matrix Rows::hessian(const State& state, const Vector& equality, const std::vector<Row>& rows,
                     const Vector& inequality, double objective) const {
  Matrix hessian = track_.hessian(state.z, state.shape, problem_.rides, state.flows,
                                  weights(state, equality, rows, inequality, objective));
  for (std::size_t i = fixed_equalities_; i < equality.size(); ++i) {
    const Row row = row_of_equality(i);
    const LimitSpec& limit = problem_.limits[row.limit];
    add_direct_terms(state, limit, row, equality[i] / effective_scale(limit), hessian);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const LimitSpec& limit = problem_.limits[rows[i].limit];
    if (inequality[i] == 0.0) continue;
    add_direct_terms(state, limit, rows[i], inequality[i] * limit.side / effective_scale(limit), hessian);
  }
  return hessian;
}

}  // namespace glissade::optimizer
