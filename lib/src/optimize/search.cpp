#include "optimize/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::fastest {
namespace {

// Rows this close to their bound take part in the first round, and in those that move the track less. All do
// on a coarse mesh and after a round that broke limits which had no part in it.
constexpr double kBand = 0.25;
constexpr double kLaterBand = 0.04;
constexpr double kEverything = HUGE_VAL;
constexpr std::size_t kCoarse = 24;
constexpr double kBroken = 0.01;
// Rows this close to their bound may carry a multiplier.
constexpr double kActive = 1e-6;

Matrix jacobian_of(const Rows& rows, const State& state, const std::vector<Row>& set, std::size_t n) {
  Matrix jacobian(set.size(), n);
  for (std::size_t i = 0; i < set.size(); ++i) rows.gradient(state, set[i], jacobian.row(i));
  return jacobian;
}

Vector values_of(const Rows& rows, const State& state, const std::vector<Row>& set) {
  Vector values(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) values[i] = rows.value(state, set[i]);
  return values;
}

double greatest_size(const Vector& values) {
  double greatest = 0.0;
  for (const double value : values) greatest = std::max(greatest, std::fabs(value));
  return greatest;
}

/// A metric in which the Lagrangian's Hessian is the identity; convex by adding the equality rows' squares,
/// which changes no step that keeps them, and a shift if that is not enough.
ShiftedCholesky metric_of(const Matrix& hessian, const Matrix& equality) {
  const std::size_t n = hessian.columns();
  Vector diagonal(n);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(hessian(i, i)));
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = std::max(std::fabs(hessian(i, i)), 1e-12 * largest);
  constexpr double kFirstPenalty = 10.0;
  constexpr double kLastPenalty = 1e3;
  ShiftedCholesky best;
  for (double penalty = kFirstPenalty; penalty <= kLastPenalty; penalty *= 10.0) {
    Matrix convex = hessian;
    for (std::size_t e = 0; e < equality.rows(); ++e) {
      const double* row = equality.row(e);
      for (std::size_t i = 0; i < n; ++i) add_scaled(convex.row(i), penalty * row[i], row, n);
    }
    best = ShiftedCholesky(convex, diagonal);
    if (best.shift() <= 1e-5) break;
  }
  return best;
}

Matrix in_metric(Matrix jacobian, const ShiftedCholesky& metric) {
  for (std::size_t i = 0; i < jacobian.rows(); ++i) metric.forward(jacobian.row(i));
  return jacobian;
}

/// An objective without bound and rows that say nothing.
void reject(Sample& out, std::size_t n, std::size_t equalities, std::size_t inequalities) {
  out.objective = HUGE_VAL;
  out.gradient.assign(n, 0.0);
  out.equality.assign(equalities, 0.0);
  out.equality_jacobian = Matrix(equalities, n);
  out.inequality.assign(inequalities, 0.0);
  out.inequality_jacobian = Matrix(inequalities, n);
}

struct Judged {
  Multipliers multipliers;
  std::vector<Row> active;
  double residual = 0.0;
  double violation = 0.0;
};

/// First-order optimality of a point, measured in a metric.
Judged judge(const Rows& rows, const State& state, const ShiftedCholesky& metric) {
  Judged judged;
  Vector equality;
  Matrix equality_jacobian;
  rows.equalities(state, equality, equality_jacobian);
  judged.active = rows.candidates(state, kActive);
  judged.violation = greatest_size(equality);
  for (const double value : values_of(rows, state, judged.active)) {
    judged.violation = std::max(judged.violation, value);
  }
  Vector gradient = rows.objective_gradient(state);
  const std::size_t n = gradient.size();
  metric.forward(gradient.data());
  const Matrix active_jacobian = in_metric(jacobian_of(rows, state, judged.active, n), metric);
  judged.multipliers =
      least_multipliers(gradient, in_metric(std::move(equality_jacobian), metric), active_jacobian);
  judged.residual = norm(judged.multipliers.residual) / norm(gradient);
  return judged;
}

/// Newton steps on the rows that carry multipliers, as long as they pay: they end where a line search on the
/// objective's own digits cannot.
void polish(const Transcription& track, const Rows& rows, const ShiftedCholesky& metric,
            const SearchControl& control, State& state, Judged& judged) {
  constexpr int kMostSteps = 4;
  constexpr double kNear = 1e-2;
  const std::size_t n = track.layout().size();
  for (int step = 0; step < kMostSteps; ++step) {
    if (judged.residual > kNear || judged.violation > kNear) return;
    if (judged.residual <= 0.1 * control.tolerance && judged.violation <= 0.1 * control.limit_tolerance)
      return;
    Vector value;
    Matrix jacobian;
    rows.equalities(state, value, jacobian);
    std::vector<Row> carrying;
    for (std::size_t i = 0; i < judged.active.size(); ++i) {
      if (judged.multipliers.inequality[i] > 0.0) carrying.push_back(judged.active[i]);
    }
    Matrix all(value.size() + carrying.size(), n);
    Vector wanted;
    for (std::size_t i = 0; i < value.size(); ++i) {
      std::copy_n(jacobian.row(i), n, all.row(i));
      wanted.push_back(-value[i]);
    }
    for (std::size_t i = 0; i < carrying.size(); ++i) {
      rows.gradient(state, carrying[i], all.row(value.size() + i));
      wanted.push_back(-rows.value(state, carrying[i]));
    }
    Vector move = shortest_solution(in_metric(std::move(all), metric), wanted);
    add_scaled(move.data(), -1.0, judged.multipliers.residual.data(), n);
    metric.backward(move.data());
    Vector z = state.z;
    add_scaled(z.data(), 1.0, move.data(), n);
    if (!track.is_track(z)) return;
    State next = rows.state(z, true);
    Judged better = judge(rows, next, metric);
    const bool pays = better.residual < 0.7 * judged.residual || judged.residual <= control.tolerance;
    const bool keeps = better.violation <= std::max(control.limit_tolerance, 0.7 * judged.violation);
    if (!pays || !keeps || better.residual > std::max(judged.residual, control.tolerance)) return;
    state = std::move(next);
    judged = std::move(better);
  }
}

Matrix hessian_of(const ScaledProblem& problem, const Transcription& track, const Rows& rows,
                  const State& state, const Vector& equality, const std::vector<Row>& active,
                  const Vector& inequality) {
  return track.hessian(state.z, state.shape, problem.rides, state.flows,
                       rows.weights(state, equality, active, inequality, 1.0));
}

/// All that a round of the search begins with.
struct Round {
  Vector z;
  std::vector<Row> set;
  Vector equality;
  std::vector<Row> active;
  Vector inequality;

  friend bool operator==(const Round&, const Round&) = default;
};

}  // namespace

Found minimise(const ScaledProblem& problem, const Mesh& mesh, const Vector& start, const Vector& margins,
               SearchControl& control) {
  Found found;
  const auto track = std::make_shared<const Transcription>(mesh);
  const auto rows = std::make_shared<Rows>(problem, *track);
  rows->set_margins(margins);
  found.track = track;
  found.rows = rows;
  const std::size_t n = track->layout().size();
  const std::size_t equality_count = rows->equality_count();

  Vector z = start;
  State state = rows->state(z, true);
  Vector equality(equality_count, 0.0);
  std::vector<Row> active;
  Vector inequality;
  {
    // Before the first round: the finish's own multipliers, in units of the unknowns' curvature.
    Vector value;
    Matrix jacobian;
    rows->equalities(state, value, jacobian);
    equality = least_multipliers(rows->objective_gradient(state), jacobian, Matrix()).equality;
  }
  ShiftedCholesky metric;
  Round last;
  for (int round = 0; round < control.most_rounds; ++round) {
    ++control.rounds;
    Vector value;
    Matrix jacobian;
    rows->equalities(state, value, jacobian);
    metric = metric_of(hessian_of(problem, *track, *rows, state, equality, active, inequality), jacobian);

    const bool all = round == 0 ? mesh.knots.size() < kCoarse : found.violation > kBroken;
    std::vector<Row> set = rows->candidates(state, all ? kEverything : (round == 0 ? kBand : kLaterBand));
    set.insert(set.end(), active.begin(), active.end());
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
    Round begun{z, set, equality, active, inequality};
    // The same again would end where it ended before.
    if (round > 0 && begun == last) break;
    last = std::move(begun);
    const SampleFunction sample = [&](const Vector& at, Sample& out) {
      if (!track->is_track(at)) {
        reject(out, n, equality_count, set.size());
        return;
      }
      state = rows->state(at, true);
      out.objective = rows->objective(state);
      out.gradient = rows->objective_gradient(state);
      rows->equalities(state, out.equality, out.equality_jacobian);
      out.inequality = values_of(*rows, state, set);
      out.inequality_jacobian = jacobian_of(*rows, state, set, n);
    };
    DescentOptions options;
    options.most_evaluations = 40;
    const Descent descent = descend(sample, z, equality_count, set.size(), metric, options, control.stop);
    control.evaluations += descent.evaluations;
    if (track->is_track(descent.z)) z = descent.z;
    state = rows->state(z, true);
    Judged judged = judge(*rows, state, metric);
    polish(*track, *rows, metric, control, state, judged);
    z = state.z;
    equality = judged.multipliers.equality;
    active = judged.active;
    inequality = judged.multipliers.inequality;
    found.residual = judged.residual;
    found.violation = judged.violation;
    found.stopped = descent.stopped;
    if (descent.stopped) break;
    if (judged.residual <= control.tolerance && judged.violation <= control.limit_tolerance) break;
  }
  found.z = z;
  found.objective = rows->objective(state);
  found.equality = std::move(equality);
  found.active = std::move(active);
  found.inequality = std::move(inequality);
  return found;
}

GuessCurve curve_of(const Transcription& track, const Vector& z) {
  GuessCurve curve;
  Shape shape;
  track.shape(z, shape, false);
  for (std::size_t i = 0; i < track.stations().size(); ++i) {
    const Station& station = track.stations()[i];
    if (station.part != Part::core) continue;
    if (!curve.sigma.empty() && station.sigma <= curve.sigma.back()) continue;
    curve.sigma.push_back(station.sigma);
    curve.zeta.push_back(shape.zeta[i]);
  }
  if (curve.sigma.front() > 0.0) {
    curve.sigma.insert(curve.sigma.begin(), 0.0);
    curve.zeta.insert(curve.zeta.begin(), z[track.layout().angle()]);
  }
  curve.length = z[track.layout().length()];
  return curve;
}

}  // namespace glissade::fastest
