#include "optimize/infeasibility.hpp"

#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "optimize/least_violation.hpp"
#include "optimize/starts.hpp"
#include "optimize/switches.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kPieces = 24;  // taste
// Below this the limits count as met: finer meshes win that much.
constexpr double kContradiction = 1e-5;  // accuracy: a hundred times that of a limit
// Below this a finer mesh may make up for what is left.
constexpr double kNearly = 0.005;  // taste

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
    const double share = std::sqrt(std::max(v, 0.0)) / limit.bound;
    // A depth is as much larger as the speed may be smaller.
    return limit.name.id == LimitId::highest_burden_depth ? limit.bound_si / share : limit.bound_si * share;
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
  constexpr double kKept = 1e-6;         // accuracy: ten times that of a limit
  constexpr std::size_t kFollowing = 3;  // budget
  constexpr std::size_t kFiner = 32;     // taste
  constexpr double kPays = 0.98;         // taste
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
                  " m/s no track reaches the finish at a friction angle of " + angle_text(friction.angle()) +
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
                  angle_text(friction.angle()) + ": the mean slope is " +
                  angle_text(Angle::from_radians(math::atan2(problem.endpoints.drop, run))) +
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
  constexpr std::size_t kFiner[] = {32, 48};  // taste
  constexpr double kPays = 0.7;               // taste
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

namespace {

/// How much each limit holds the least violation up; the last entry is the finish and the straight ends.
Vector shares_of(const Attempt& attempt) {
  const Found& found = attempt.relaxed.found;
  Vector share(attempt.problem->limits.size() + 1, 0.0);
  for (std::size_t i = 0; i < found.active.size(); ++i) share[found.active[i].limit] += found.inequality[i];
  for (std::size_t i = 0; i < found.equality.size(); ++i) {
    const std::size_t* limit = found.rows->limit_of_equality(i);
    share[limit != nullptr ? *limit : share.size() - 1] += std::fabs(found.equality[i]);
  }
  return share;
}

// A limit with less of a share in the least violation has none.
constexpr double kPartOf = 1e-4;  // taste

/// Whether the limits in conflict ask for energy to be worn down, or for length: then winding tracks may do.
bool asks_for_bends(const Attempt& attempt) {
  const Vector share = shares_of(attempt);
  const std::vector<LimitSpec>& limits = attempt.problem->limits;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (share[i] <= kPartOf || limits[i].built_in) continue;
    const bool slows = limits[i].measure == Measure::exit_run_speed || limits[i].measure == Measure::speed ||
                       limits[i].measure == Measure::exit_speed;
    if (slows && limits[i].side >= 0) return true;
    if (limits[i].measure == Measure::arc_length && limits[i].side <= 0) return true;
  }
  return false;
}

/// The search for the least violation on every way past the keep-outs, from one start after the other.
class LeastViolation {
 public:
  LeastViolation(const Problem& problem, const std::vector<Passages>& passages, SearchControl& control)
      : control_(control) {
    for (const Passages& way : passages)
      ways_.push_back(std::make_shared<ScaledProblem>(scaled(problem, way)));
  }

  /// @return whether a track was found that keeps all limits
  bool from(std::vector<GuessCurve> (*curves_of)(const ScaledProblem&)) {
    for (std::size_t way = 0; way < ways_.size(); ++way) {
      const std::vector<GuessCurve> curves = curves_of(*ways_[way]);
      for (auto start = curves.begin(); start != curves.end(); ++start) {
        if (control_.stop()) return false;
        if (std::find(curves.begin(), start, *start) != start) continue;
        if (from(way, mesh_of(*ways_[way], graded_knots(*start, kPieces, 1.0), start->length), *start))
          return true;
      }
    }
    return false;
  }

  /// From a track on its own mesh. @return as above
  bool from(std::size_t way, const Mesh& mesh, const GuessCurve& curve) {
    Attempt attempt;
    attempt.problem = ways_[way];
    attempt.mesh = mesh;
    attempt.relaxed = all_relaxed(*ways_[way], mesh, curve, control_);
    if (attempt.relaxed.t < kNearly) follow(attempt, control_);
    if (!best_ || attempt.relaxed.t < best_->relaxed.t) {
      best_ = std::move(attempt);
      way_ = way;
    }
    return kept();
  }

  bool closely() {
    if (best_->relaxed.t >= kNearly) follow(*best_, control_);
    return kept();
  }

  /// Whether no step lowers the least violation, or the search from its end lowers it no further.
  [[nodiscard]] bool confirmed() {
    constexpr double kSame = 0.98;  // taste
    if (best_->relaxed.settled) return true;
    const double before = best_->relaxed.t;
    const Transcription& track = *best_->relaxed.found.track;
    const GuessCurve curve = curve_of(track, best_->relaxed.found.z);
    (void)from(way_, Mesh(track.mesh()), curve);
    return best_->relaxed.t > kSame * before;
  }

  [[nodiscard]] bool kept() const { return best_->relaxed.t <= kContradiction; }
  [[nodiscard]] const Attempt& best() const { return *best_; }
  [[nodiscard]] std::size_t way() const { return way_; }

 private:
  SearchControl& control_;
  std::vector<std::shared_ptr<ScaledProblem>> ways_;
  std::optional<Attempt> best_;
  std::size_t way_ = 0;
};

/// What an equality limit measures on a track that has it give way.
double measured_on(const Found& found, const LimitSpec& limit, std::size_t index) {
  const Vector value = found.rows->equality_values(found.rows->state(found.z, false));
  double measured = 0.0;
  for (std::size_t k = 0; k < value.size(); ++k) {
    const std::size_t* owner = found.rows->limit_of_equality(k);
    if (owner == nullptr || *owner != index) continue;
    const bool squared = limit.measure == Measure::exit_speed;
    measured = squared ? limit.bound * limit.bound + value[k] * 2.0 * limit.bound * limit.scale
                       : limit.bound + value[k] * limit.scale;
  }
  return measured;
}

/// The bound that would do, a little beyond the least that a local search finds: it has to be found again.
std::optional<double> needed_bound(const LimitSpec& limit, std::size_t index, const Relaxed& alone) {
  constexpr double kBeyond = 1e-4;   // accuracy: of a bound that would do
  constexpr double kAtLeast = 2e-6;  // accuracy: twenty times that of a limit
  const double t = alone.t * (1.0 + kBeyond) + kAtLeast;
  const double measured = limit.side == 0 ? measured_on(alone.found, limit, index) : 0.0;
  const double needed = relaxed_bound(limit, t, measured);
  // A beam cannot be closer than touched: then it is the beam that would have to move.
  if (limit.name.id == LimitId::keep_outs && needed < 0.0) return std::nullopt;
  if (limit.measure == Measure::normal_load && needed < 0.0) return std::nullopt;
  return needed;
}

/// What stands against each other at the track that breaks all limits least; empty if nothing that the user set.
Conflict conflict_at(LeastViolation& search, SearchControl& control) {
  const Attempt attempt = search.best();
  const std::vector<LimitSpec>& limits = attempt.problem->limits;
  const Vector share = shares_of(attempt);
  Conflict conflict;
  bool set_by_user = false;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (share[i] <= kPartOf) continue;
    const LimitSpec& limit = limits[i];
    const auto same = [&](const StatedLimit& known) { return known.limit == limit.name; };
    if (std::any_of(conflict.limits.begin(), conflict.limits.end(), same)) continue;
    set_by_user = set_by_user || !limit.built_in;
    conflict.limits.push_back({limit.name, limit.built_in ? std::nullopt : std::optional(limit.bound_si)});
    if (limit.built_in || (limit.measure == Measure::curvature && limit.bound == 0.0)) continue;
    Elastic elastic;
    elastic.equalities = false;
    elastic.limits.assign(limits.size(), false);
    for (std::size_t k = 0; k < limits.size(); ++k) elastic.limits[k] = limits[k].name == limit.name;
    const std::optional<Relaxed> alone = relaxed_alone(attempt, elastic, control);
    if (!alone) continue;
    // A track that breaks one limit alone is another beginning: from there all of them may be kept after all.
    const Transcription& track = *alone->found.track;
    if (search.from(search.way(), track.mesh(), curve_of(track, alone->found.z))) return conflict;
    if (const auto needed = needed_bound(limit, i, *alone)) {
      conflict.relaxations.push_back({limit.name, limit.bound_si, *needed});
    }
  }
  if (share.back() > kPartOf && !set_by_user && !conflict.limits.empty()) {
    conflict.limits.insert(conflict.limits.begin(),
                           {LimitName{LimitId::finish, Bound::exactly}, std::nullopt});
  }
  return conflict;
}

}  // namespace

Explanation explain(const Problem& problem, const std::vector<Passages>& passages, SearchControl& control) {
  // From a better track the reasons are others; how often they are looked for anew.
  constexpr int kMostRounds = 3;    // budget
  constexpr double kBetter = 0.98;  // taste
  Explanation explanation;
  LeastViolation search(problem, passages, control);
  bool found = search.from(starts);
  if (control.stop()) return explanation;
  found = found || search.closely();
  if (!found && asks_for_bends(search.best())) found = search.from(winding_starts) || search.closely();
  Conflict conflict;
  for (int round = 0; !found && round < kMostRounds; ++round) {
    const double before = search.best().relaxed.t;
    conflict = conflict_at(search, control);
    if (control.stop()) return explanation;
    found = search.kept();
    if (search.best().relaxed.t > kBetter * before) break;
  }
  explanation.passages = search.way();
  if (found) {
    explanation.mesh = search.best().mesh;
    explanation.z = search.best().relaxed.found.z;
    return explanation;
  }
  if (conflict.limits.empty() || !search.confirmed()) {
    for (const StatedLimit& stated : conflict.limits) explanation.nearly.push_back(stated.limit.key());
    return explanation;
  }
  conflict.text = conflict_text(conflict);
  explanation.conflict = std::move(conflict);
  return explanation;
}

}  // namespace glissade::optimizer
