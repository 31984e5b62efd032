#include "optimize/problem/rows.hpp"

#include "glissade/core/math.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace glissade::optimizer {
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
    if (limit.measure == Measure::entry_slope_angle && !entry_cosine_) entry_cosine_ = math::cos(limit.bound);
    equality_limits_.emplace_back(i, 0);
    const std::size_t last = problem.rides.size() - 1;
    if (limit.measure->is_met_at_each_end_of_range() && last > 0) equality_limits_.emplace_back(i, last);
  }
}

State Rows::state(const Vector& z, bool derivatives) const {
  State state;
  state.z = z;
  track_.shape(z, state.shape, derivatives);
  if (problem_.places_from == PlacesFrom::finish) track_.count_from_finish(state.shape);
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

void Rows::add_derivatives(State& state) const {
  if (problem_.places_from == PlacesFrom::finish) {
    // To the same bits: from where positions count from the finish their differences are rounded otherwise.
    track_.shape(state.z, state.shape, true);
    track_.count_from_finish(state.shape);
  } else {
    track_.add_derivatives(state.z, state.shape);
  }
  for (std::size_t r = 0; r < problem_.rides.size(); ++r)
    track_.add_derivatives(state.z, state.shape, problem_.rides[r], state.flows[r]);
}

double Rows::speed_counted(const State& state) const {
  const double v = state.flows[problem_.objective_ride].v.back();
  return problem_.tilt == 0.0
             ? v
             : v - problem_.tilt * (state.shape.cos.front() - state.shape.cos[track_.stations().size() - 1]);
}

double Rows::objective(const State& state) const {
  const Flow& flow = state.flows[problem_.objective_ride];
  double value = problem_.time_weight * flow.time;
  if (problem_.speed_weight > 0.0) {
    // A squared speed below zero is a body that would not arrive: its root is continued as an odd function.
    const double v = speed_counted(state);
    value -= problem_.speed_weight * std::copysign(std::sqrt(std::fabs(v)), v);
  }
  value += problem_.drop_weight * state.drop();
  // With its straight ends: what changes with them is what they cost.
  const double length = problem_.lead_in + track_.core_length(state.z) + problem_.lead_out;
  value += problem_.length_weight * length;
  return value;
}

Vector Rows::objective_gradient(const State& state) const {
  const Flow& flow = state.flows[problem_.objective_ride];
  Vector gradient = flow.dtime;
  for (double& entry : gradient) entry *= problem_.time_weight;
  if (problem_.speed_weight > 0.0) {
    const std::size_t last = flow.v.size() - 1;
    const double root = std::sqrt(std::max(std::fabs(speed_counted(state)), 1e-12));
    const double by_v = -problem_.speed_weight * 0.5 / root;
    track_.add(flow.dv, last, by_v, gradient.data());
    if (problem_.tilt != 0.0) {
      track_.add_dzeta(0, by_v * problem_.tilt * state.shape.sin.front(), gradient.data());
      track_.add_dzeta(last, -by_v * problem_.tilt * state.shape.sin[last], gradient.data());
    }
  }
  if (problem_.drop_weight > 0.0) add_across(state.shape.dy, problem_.drop_weight, gradient.data());
  track_.add_core_length(problem_.length_weight, gradient.data());
  return gradient;
}

void Rows::add_across(const Derivatives& derivatives, double factor, double* out) const {
  track_.add(derivatives, track_.stations().size() - 1, factor, out);
  track_.add(derivatives, 0, -factor, out);
}

double Rows::effective_bound(const LimitSpec& limit) const {
  return limit.measure->is_squared() ? limit.bound * limit.bound : limit.bound;
}

double Rows::effective_scale(const LimitSpec& limit) const {
  return limit.measure->is_squared() ? 2.0 * limit.bound * limit.scale : limit.scale;
}

const std::size_t* Rows::limit_of_equality(std::size_t row) const {
  return row < fixed_equalities_ ? nullptr : &equality_limits_[row - fixed_equalities_].first;
}

Row Rows::row_of_equality(std::size_t index) const {
  Row row;
  const auto& [limit, ride] = equality_limits_[index - fixed_equalities_];
  row.limit = limit;
  row.ride = ride;
  row.place = track_.stations().size() - 1;
  problem_.limits[limit].measure->set_exact_row(row);
  return row;
}

Vector Rows::equality_values(const State& state) const {
  const Layout& layout = track_.layout();
  Vector value;
  value.reserve(equality_count());
  if (fixes_run(problem_.finish)) value.push_back(state.run() - problem_.run);
  if (fixes_drop(problem_.finish)) value.push_back(state.drop() - problem_.drop);
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
  value = equality_values(state);
  jacobian = Matrix(equality_count(), n);
  std::size_t at = 0;
  if (fixes_run(problem_.finish)) add_across(state.shape.dx, 1.0, jacobian.row(at++));
  if (fixes_drop(problem_.finish)) add_across(state.shape.dy, 1.0, jacobian.row(at++));
  if (problem_.lead_in > 0.0) jacobian(at++, layout.turn(0)) = 1.0;
  if (problem_.lead_out > 0.0) jacobian(at++, layout.turn(layout.knots - 1)) = 1.0;
  for (; at < equality_count(); ++at) {
    const Row row = row_of_equality(at);
    const LimitSpec& limit = problem_.limits[row.limit];
    measure_gradient(state, limit, row, jacobian.row(at));
    for (std::size_t j = 0; j < n; ++j) jacobian(at, j) /= effective_scale(limit);
  }
}

Rows::WidthFactor Rows::width_factor(const State& state, const LimitSpec& limit, const Row& row) const {
  if (limit.width_power == 0) return {};
  const auto* const stream = dynamic_cast<const BulkStream*>(problem_.rides[row.ride].law.get());
  if (stream == nullptr || stream->shape().width.is_constant()) return {};
  const Station& station = track_.stations()[row.place];
  const double s = track_.arc_length(state.z, station);
  const double width = stream->width(s);
  const double share = width / stream->width(0.0);
  const double value = math::pow(share, limit.width_power);
  const double narrowing = stream->width_slope(s) / width * station.by_length;
  const double power = limit.width_power;
  return {value, power * value * narrowing, power * (power - 1.0) * value * narrowing * narrowing};
}

double Rows::measure(const State& state, const LimitSpec& limit, const Row& row) const {
  return width_factor(state, limit, row).value * limit.measure->value(at(state, limit, row));
}

void Rows::measure_gradient(const State& state, const LimitSpec& limit, const Row& row, double* out) const {
  std::fill_n(out, track_.layout().size(), 0.0);
  limit.measure->gradient(at(state, limit, row), out);
  const WidthFactor width = width_factor(state, limit, row);
  if (width.value == 1.0 && width.first == 0.0) return;
  for (std::size_t j = 0; j < track_.layout().size(); ++j) out[j] *= width.value;
  out[track_.layout().length()] += width.first * limit.measure->value(at(state, limit, row));
}

double Rows::value(const State& state, const Row& row) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  return limit.side * (measure(state, limit, row) - effective_bound(limit)) / effective_scale(limit) +
         margin(row);
}

double Rows::margin(const Row& row) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  const double wanted = margins_[row.limit];
  if (limit.measure != Measure::normal_load || limit.side >= 0 || !(wanted > 0.0)) return wanted;
  const Station& station = track_.stations()[row.place];
  const bool from_rest = problem_.entry_speed2 == 0.0 && !problem_.rides[row.ride].landing;
  const bool straight = station.part == Part::lead_in;
  if (!from_rest && !straight) return wanted;
  // Where a fixed slope angle makes the load there is no more margin than that leaves, none on the way straight down;
  // and from rest hardly more right behind the start.
  constexpr double kNear = 0.01;  // [chords]; taste
  if (!entry_cosine_) return wanted;
  const double way = straight ? 0.0 : station.arc_length(track_.mesh().core_length) - problem_.lead_in;
  const double left = (*entry_cosine_ - effective_bound(limit)) / effective_scale(limit);
  return std::min(wanted, 0.5 * std::max(0.0, left) + wanted * way / kNear);
}

void Rows::gradient(const State& state, const Row& row, double* out) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  measure_gradient(state, limit, row, out);
  const double factor = limit.side / effective_scale(limit);
  for (std::size_t j = 0; j < track_.layout().size(); ++j) out[j] *= factor;
}

double Rows::place(const State& state, const Row& row) const {
  const LimitSpec& limit = problem_.limits[row.limit];
  return limit.measure->place(at(state, limit, row));
}

std::vector<Row> Rows::candidates(const State& state, double band, Vector* values) const {
  std::vector<Row> near;
  std::vector<Row> rows;
  near.reserve(track_.watched().size());
  rows.reserve(2 * track_.watched().size());
  if (values != nullptr) values->clear();
  for (std::size_t i = 0; i < problem_.limits.size(); ++i) {
    const LimitSpec& limit = problem_.limits[i];
    if (limit.side == 0) continue;
    Row first;
    first.limit = i;
    rows.clear();
    limit.measure->add_rows(at(state, limit, first), rows);
    const double bound = effective_bound(limit);
    const double scale = effective_scale(limit);
    for (const Row& row : rows) {
      const double there = limit.side * (measure(state, limit, row) - bound) / scale + margin(row);
      if (!(there > -band)) continue;
      near.push_back(row);
      if (values != nullptr) values->push_back(there);
    }
  }
  return near;
}

void Rows::add_measure_weights(const State& state, const LimitSpec& limit, const Row& row, double factor,
                               StationWeights& weights) const {
  limit.measure->add_weights(at(state, limit, row), factor * width_factor(state, limit, row).value, weights);
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
    const double root = std::sqrt(std::max(std::fabs(speed_counted(state)), 1e-12));
    const double by_v = -objective * problem_.speed_weight * 0.5 / root;
    weights.v[problem_.objective_ride][last] += by_v;
    if (problem_.tilt == 0.0) {
      weights.v_v[problem_.objective_ride][last] +=
          objective * problem_.speed_weight * 0.25 / (root * root * root);
    } else {
      // As of the square of that speed, which has the same optimum: no product of v and the slopes at the ends comes in.
      weights.zeta_zeta[0] += by_v * problem_.tilt * state.shape.cos.front();
      weights.zeta_zeta[last] -= by_v * problem_.tilt * state.shape.cos[last];
    }
  }
  weigh_across(weights.y, objective * problem_.drop_weight);
  std::size_t row = 0;
  if (fixes_run(problem_.finish)) weigh_across(weights.x, equality[row++]);
  if (fixes_drop(problem_.finish)) weigh_across(weights.y, equality[row++]);
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
  // A place that counts from the finish goes along with it.
  if (problem_.places_from == PlacesFrom::finish) {
    for (Vector* const places : {&weights.x, &weights.y})
      places->back() -= std::accumulate(places->begin(), places->end(), 0.0);
  }
  return weights;
}

void Rows::add_direct_terms(const State& state, const LimitSpec& limit, const Row& row, double factor,
                            Matrix& hessian) const {
  const WidthFactor width = width_factor(state, limit, row);
  const RowAt here = at(state, limit, row);
  limit.measure->add_terms(here, factor * width.value, hessian);
  if (width.first == 0.0) return;
  const std::size_t n = track_.layout().size();
  Vector gradient(n, 0.0);
  limit.measure->gradient(here, gradient.data());
  Vector by_length(n, 0.0);
  by_length[track_.layout().length()] = 1.0;
  add_symmetric(hessian, factor * width.first, gradient, by_length);
  const double value = limit.measure->value(here);
  add_symmetric(hessian, 0.5 * factor * width.second * value, by_length, by_length);
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
