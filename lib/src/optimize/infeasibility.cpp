#include "optimize/infeasibility.hpp"

#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "optimize/least_violation.hpp"
#include "optimize/starts.hpp"
#include "optimize/switches.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kPieces = 24;
// Below this the limits count as met: finer meshes win that much.
constexpr double kContradiction = 1e-5;
// Below this a finer mesh may make up for what is left.
constexpr double kNearly = 0.005;

/// The bound after relaxing it by t scales, in the user's unit.
double relaxed_bound(const LimitSpec& limit, double t, double measured) {
  const bool squared = limit.measure == Measure::speed || limit.measure == Measure::exit_speed;
  if (limit.side == 0) return (squared ? std::sqrt(std::max(measured, 0.0)) : measured) / limit.per_si;
  if (limit.name.is_radius()) {
    // A radius: its curvature grows by t times its own bound.
    return limit.bound_si / (1.0 + t);
  }
  if (squared) {
    const double v = limit.bound * limit.bound + limit.side * t * 2.0 * limit.bound * limit.scale;
    return std::sqrt(std::max(v, 0.0)) / limit.bound * limit.bound_si;
  }
  if (limit.measure == Measure::curvature_rate) return limit.bound_si * (1.0 + t);
  return limit.bound_si + limit.side * t * limit.scale / limit.per_si;
}

struct Attempt {
  std::shared_ptr<ScaledProblem> problem;
  Mesh mesh;
  Relaxed relaxed;
};

/// The least by which one limit must give way when all others hold: from the track that breaks all of them
/// least; where that descent loses its way, from the straight line.
std::optional<Relaxed> relaxed_alone(const Attempt& attempt, const Elastic& elastic, SearchControl& control) {
  constexpr double kKept = 1e-6;
  constexpr std::size_t kFollowing = 3;
  constexpr std::size_t kFiner = 32;
  constexpr double kPays = 0.98;
  const ScaledProblem& problem = *attempt.problem;
  const Vector margins(problem.limits.size(), 0.0);
  std::optional<Relaxed> least;
  bool settled = false;
  const auto descend = [&](const Mesh& mesh, const Vector& beginning) {
    Relaxed alone = least_violation(problem, mesh, beginning, elastic, margins, control);
    settled = alone.settled;
    if (alone.found.violation > kKept || alone.t <= 0.0) return false;
    const bool pays = !least || alone.t < kPays * least->t;
    if (!least || alone.t < least->t) least = std::move(alone);
    return pays;
  };
  if (!descend(attempt.mesh, attempt.relaxed.found.z) && !settled && !control.stop()) {
    descend(attempt.mesh, fit(starts(problem).back(), Transcription(attempt.mesh)));
  }
  // The mesh follows the track: where it bends in the end need not be where it bent in the beginning.
  for (std::size_t round = 0; least && round < kFollowing && !control.stop(); ++round) {
    const Found& found = least->found;
    const Mesh mesh = mesh_of(problem, refined_knots(*found.track, found.z, {}, kFiner),
                              found.z[found.track->layout().length()]);
    if (!descend(mesh, fit(curve_of(*found.track, found.z), Transcription(mesh)))) break;
  }
  return least;
}

Conflict too_slow(const Problem& problem, Friction friction) {
  const Endpoints& ends = problem.endpoints;
  const double speed = problem.body.entry_speed;
  const double needed = least_entry_speed(ends, friction, problem.gravity);
  const double drop = least_drop(ends.run, friction, speed, problem.gravity);
  Conflict conflict;
  conflict.limits = {{{LimitId::friction}, {}}, {{LimitId::finish}, {}}};
  conflict.relaxations.push_back({{LimitId::finish_drop}, ends.drop, drop});
  conflict.text = "at an entry speed of " + rounded_text(speed, 4) +
                  " m/s no track reaches the finish at a friction angle of " +
                  angle_text(friction.angle().radians()) +
                  ", whatever the shape (reach theorem); an entry speed above " + rounded_text(needed, 4) +
                  " m/s or a drop above " + length_text(drop) + " would do";
  return conflict;
}

}  // namespace

std::optional<Conflict> beyond_reach(const Problem& problem) {
  if (problem.finish.kind != FinishKind::point) return std::nullopt;
  const Friction friction = problem.high_friction.value_or(problem.body.friction);
  if (problem.body.entry_speed > 0.0) {
    // With speed, the theorem is told of the sliding point.
    if (!is_sliding_point(problem.body)) return std::nullopt;
    const bool arrives = can_arrive(problem.endpoints, friction, problem.body.entry_speed, problem.gravity);
    return arrives ? std::nullopt : std::optional(too_slow(problem, friction));
  }
  const double run = std::fabs(problem.endpoints.run);
  const double mu = friction.coefficient();
  // The theorem is about the centre of mass, whose ends lie up to this much more favourably than the track's.
  const double height = problem.body.law ? problem.body.law->centre_height() : 0.0;
  const double favour = height == 0.0 ? 0.0 : height * (std::sqrt(1.0 + mu * mu) + mu);
  if (problem.endpoints.drop + favour > mu * run) return std::nullopt;
  if (problem.body.head_wind < 0.0 && problem.body.drag_per_metre > 0.0) return std::nullopt;
  Conflict conflict;
  conflict.limits = {{{LimitId::friction}, {}}, {{LimitId::finish}, {}}};
  conflict.relaxations.push_back(
      {{LimitId::finish_drop}, problem.endpoints.drop, friction.coefficient() * run});
  conflict.text = "from rest, no track reaches the finish at a friction angle of " +
                  angle_text(friction.angle().radians()) + ": the mean slope is " +
                  angle_text(math::atan2(problem.endpoints.drop, run)) +
                  ", whatever the shape (reach theorem); a drop above " +
                  length_text(friction.coefficient() * run) + " would do";
  return conflict;
}

namespace {

Relaxed all_relaxed(const ScaledProblem& problem, const Mesh& mesh, const GuessCurve& curve,
                    SearchControl& control) {
  const Vector margins(problem.limits.size(), 0.0);
  return least_violation(problem, mesh, fit(curve, Transcription(mesh)), Elastic::all(problem.limits.size()),
                         margins, control);
}

/// The mesh follows the track, finer where it bends: what is left over then is no fault of the mesh.
void follow(Attempt& attempt, SearchControl& control) {
  constexpr std::size_t kFiner[] = {32, 48};
  constexpr double kPays = 0.7;
  for (const std::size_t pieces : kFiner) {
    if (attempt.relaxed.t <= kContradiction || control.stop()) return;
    const Found& found = attempt.relaxed.found;
    const ScaledProblem& problem = *attempt.problem;
    const Mesh mesh = mesh_of(problem, refined_knots(*found.track, found.z, {}, pieces),
                              found.z[found.track->layout().length()]);
    Relaxed finer = all_relaxed(problem, mesh, curve_of(*found.track, found.z), control);
    const bool pays = finer.t < kPays * attempt.relaxed.t;
    if (finer.t < attempt.relaxed.t) {
      attempt.mesh = mesh;
      attempt.relaxed = std::move(finer);
    }
    if (!pays) return;
  }
}

}  // namespace

Explanation explain(const Problem& problem, const std::vector<Passages>& passages, SearchControl& control) {
  std::optional<Attempt> best;
  Explanation explanation;
  for (std::size_t way = 0; way < passages.size(); ++way) {
    const auto scaled_problem = std::make_shared<ScaledProblem>(scaled(problem, passages[way]));
    const std::vector<GuessCurve> curves = starts(*scaled_problem);
    for (auto start = curves.begin(); start != curves.end(); ++start) {
      if (control.stop()) return explanation;
      if (std::find(curves.begin(), start, *start) != start) continue;
      Attempt attempt;
      attempt.problem = scaled_problem;
      attempt.mesh = mesh_of(*scaled_problem, graded_knots(*start, kPieces, 1.0), start->length);
      attempt.relaxed = all_relaxed(*scaled_problem, attempt.mesh, *start, control);
      if (attempt.relaxed.t < kNearly) follow(attempt, control);
      if (best && best->relaxed.t <= attempt.relaxed.t) continue;
      best = std::move(attempt);
      explanation.passages = way;
      if (best->relaxed.t > kContradiction) continue;
      explanation.mesh = best->mesh;
      explanation.z = best->relaxed.found.z;
      return explanation;
    }
  }

  if (best->relaxed.t >= kNearly) follow(*best, control);
  if (best->relaxed.t <= kContradiction) {
    explanation.mesh = best->mesh;
    explanation.z = best->relaxed.found.z;
    return explanation;
  }

  const std::vector<LimitSpec>& limits = best->problem->limits;
  const Found& found = best->relaxed.found;
  Vector share(limits.size(), 0.0);
  for (std::size_t i = 0; i < found.active.size(); ++i) share[found.active[i].limit] += found.inequality[i];
  for (std::size_t i = 0; i < found.equality.size(); ++i) {
    const std::size_t* limit = found.rows->limit_of_equality(i);
    if (limit != nullptr) share[*limit] += std::fabs(found.equality[i]);
  }
  Conflict conflict;
  constexpr double kPartOf = 1e-4;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (share[i] <= kPartOf) continue;
    const LimitSpec& limit = limits[i];
    const auto same = [&](const StatedLimit& known) { return known.limit == limit.name; };
    if (std::any_of(conflict.limits.begin(), conflict.limits.end(), same)) continue;
    conflict.limits.push_back({limit.name, limit.built_in ? std::nullopt : std::optional(limit.bound_si)});
    if (limit.built_in || (limit.measure == Measure::curvature && limit.bound == 0.0)) continue;
    Elastic elastic;
    elastic.equalities = false;
    elastic.limits.assign(limits.size(), false);
    for (std::size_t k = 0; k < limits.size(); ++k) elastic.limits[k] = limits[k].name == limit.name;
    const std::optional<Relaxed> least = relaxed_alone(*best, elastic, control);
    if (!least) continue;
    const Relaxed& alone = *least;
    double measured = 0.0;
    if (limit.side == 0) {
      Vector value;
      Matrix jacobian;
      alone.found.rows->equalities(alone.found.rows->state(alone.found.z, true), value, jacobian);
      for (std::size_t k = 0; k < value.size(); ++k) {
        const std::size_t* owner = alone.found.rows->limit_of_equality(k);
        const bool squared = limit.measure == Measure::exit_speed;
        if (owner != nullptr && *owner == i) {
          measured = squared ? limit.bound * limit.bound + value[k] * 2.0 * limit.bound * limit.scale
                             : limit.bound + value[k] * limit.scale;
        }
      }
    }
    const double needed = relaxed_bound(limit, alone.t, measured);
    // A beam cannot be closer than touched: then it is the beam that would have to move.
    if (limit.name.id == LimitId::keep_outs && needed < 0.0) continue;
    if (limit.measure == Measure::normal_load && needed < 0.0) continue;
    conflict.relaxations.push_back({limit.name, limit.bound_si, needed});
  }
  conflict.text = conflict_text(conflict);
  explanation.conflict = std::move(conflict);
  return explanation;
}

}  // namespace glissade::optimizer
