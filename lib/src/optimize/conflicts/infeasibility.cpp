#include "optimize/conflicts/infeasibility.hpp"

#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "optimize/conflicts/energy_left.hpp"
#include "optimize/descent/least_violation.hpp"
#include "optimize/mesh/refined_knots.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/search/hooked_starts.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kPieces = 24;  // taste
// Below this the limits count as met: finer meshes win that much.
constexpr double kContradiction = 1e-5;  // accuracy: a hundred times that of a limit
// Below this a finer mesh may make up for what is left.
constexpr double kNearly = 0.005;  // taste

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
    const Mesh mesh =
        mesh_of(problem, refined_knots(*found.track, found.z, {}, kFiner), found.track->core_length(found.z));
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
  // Where friction changes along the track its least one tells what no track can do.
  Friction friction = problem.high_friction.value_or(problem.body.friction);
  for (const FrictionChange& change : problem.body.friction_changes)
    friction = std::min(friction, change.friction);
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
  if (is_driven_by_wind(problem.body)) return std::nullopt;
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
                    SearchControl& control, StepModel model = StepModel::curved) {
  const Vector margins(problem.limits.size(), 0.0);
  return least_violation(problem, mesh, fit(curve, Transcription(mesh)), Elastic::all(problem.limits.size()),
                         margins, control, model);
}

/// The mesh follows the track, finer where it bends: what is left over then is no fault of the mesh.
void follow(Attempt& attempt, SearchControl& control) {
  constexpr std::size_t kFiner[] = {32, 48};  // taste
  constexpr double kPays = 0.7;               // taste
  for (const std::size_t pieces : kFiner) {
    if (attempt.relaxed.t <= kContradiction || control.stop()) return;
    const Found& found = attempt.relaxed.found;
    const ScaledProblem& problem = *attempt.problem;
    const Mesh mesh =
        mesh_of(problem, refined_knots(*found.track, found.z, {}, pieces), found.track->core_length(found.z));
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

/// Of the limits in conflict that one which asks the most for energy to be worn down, or for length: then winding
/// tracks may do.
std::optional<std::size_t> asking_for_bends(const Attempt& attempt) {
  Vector share = shares_of(attempt);
  // A track that keeps all of them, but led nowhere, tells of no conflict: then any that may ask for bends does.
  if (attempt.relaxed.t <= kContradiction) share.assign(share.size(), 1.0);
  const std::vector<LimitSpec>& limits = attempt.problem->limits;
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (share[i] <= kPartOf || limits[i].built_in) continue;
    const bool slows = limits[i].measure == Measure::exit_run_speed || limits[i].measure == Measure::speed ||
                       limits[i].measure == Measure::exit_speed;
    const bool asks =
        (slows && limits[i].side >= 0) || (limits[i].measure == Measure::arc_length && limits[i].side <= 0);
    if (asks && (!most || share[i] > share[*most])) most = i;
  }
  return most;
}

/// That one limit alone gives way.
Elastic alone_of(const std::vector<LimitSpec>& limits, const LimitName& name) {
  Elastic elastic;
  elastic.equalities = false;
  for (const LimitSpec& limit : limits) elastic.limits.push_back(limit.name == name);
  return elastic;
}

std::vector<std::shared_ptr<ScaledProblem>> roughly_scaled_ways(const Problem& problem,
                                                                const std::vector<Passages>& passages) {
  std::vector<std::shared_ptr<ScaledProblem>> ways;
  for (const Passages& way : passages)
    ways.push_back(std::make_shared<ScaledProblem>(roughly_scaled(problem, way)));
  return ways;
}

using Curves = std::vector<GuessCurve> (*)(const ScaledProblem&);

/// The tracks that have one limit alone give way, from curves of every kind and on every way past the keep-outs. What
/// its bound is has no part in which of them has it give way least.
class Winding {
 public:
  Winding(const std::vector<std::shared_ptr<ScaledProblem>>& ways, const LimitName& limit,
          SearchControl& control)
      : ways_(ways), limit_(limit), control_(control) {}

  /// From all curves.
  void descend_all() {
    for (std::size_t way = 0; way < ways_.size(); ++way) {
      const std::vector<GuessCurve> curves = curves_on(way);
      for (std::size_t curve = 0; curve < curves.size(); ++curve) {
        // Clipped slopes are often the unclipped ones.
        const auto here = curves.begin() + static_cast<std::ptrdiff_t>(curve);
        if (std::find(curves.begin(), here, *here) == here) descend({way, curve, limit_}, *here);
      }
    }
    sort();
    constexpr std::size_t kFollowed = 2;  // budget
    for (std::size_t i = 0; i < std::min(kFollowed, ends_.size()); ++i) follow(ends_[i]);
    sort();
  }

  /// From one of them. @return whether the limit need not give way at all there
  [[nodiscard]] bool descend_from(const Beginning& beginning) {
    if (beginning.passages >= ways_.size()) return false;
    const std::vector<GuessCurve> curves = curves_on(beginning.passages);
    if (beginning.curve >= curves.size()) return false;
    descend(beginning, curves[beginning.curve]);
    if (!ends_.empty() && ends_.front().attempt.relaxed.t > kContradiction) follow(ends_.front());
    return !ends_.empty() && ends_.front().attempt.relaxed.t <= kContradiction;
  }

  /// Those that need it not give way at all, the best first.
  [[nodiscard]] std::vector<Foothold> footholds() const {
    std::vector<const End*> keeping;
    for (const End& end : ends_) {
      if (end.attempt.relaxed.t <= kContradiction) keeping.push_back(&end);
    }
    std::stable_sort(keeping.begin(), keeping.end(), [](const End* a, const End* b) {
      return a->attempt.relaxed.found.objective < b->attempt.relaxed.found.objective;
    });
    std::vector<Foothold> result;
    for (const End* end : keeping)
      result.push_back({end->beginning.passages, end->attempt.mesh, end->attempt.relaxed.found.z});
    return result;
  }

  /// Whose curves have it give way least.
  [[nodiscard]] std::vector<Beginning> best_beginnings() const {
    constexpr std::size_t kMost = 4;  // budget
    std::vector<Beginning> best;
    for (std::size_t i = 0; i < std::min(kMost, ends_.size()); ++i) best.push_back(ends_[i].beginning);
    return best;
  }

  struct End {
    Beginning beginning;
    Attempt attempt;
  };
  /// The one that has it give way least.
  [[nodiscard]] const End* least() const { return ends_.empty() ? nullptr : &ends_.front(); }

 private:
  static constexpr double kKept = 1e-6;  // accuracy: ten times that of a limit

  [[nodiscard]] std::vector<GuessCurve> curves_on(std::size_t way) const {
    std::vector<GuessCurve> all;
    for (const Curves curves :
         {&starts, &constant_speed_starts, &winding_starts, &stepped_starts, &hooked_starts}) {
      for (GuessCurve& curve : curves(*ways_[way])) all.push_back(std::move(curve));
    }
    return all;
  }

  void sort() {
    std::stable_sort(ends_.begin(), ends_.end(),
                     [](const End& a, const End& b) { return a.attempt.relaxed.t < b.attempt.relaxed.t; });
  }

  [[nodiscard]] Relaxed relaxed(const ScaledProblem& problem, const Mesh& mesh,
                                const GuessCurve& curve) const {
    const Vector margins(problem.limits.size(), 0.0);
    return least_violation(problem, mesh, fit(curve, Transcription(mesh)), alone_of(problem.limits, limit_),
                           margins, control_);
  }

  void descend(const Beginning& beginning, const GuessCurve& curve) {
    if (control_.stop()) return;
    const std::shared_ptr<ScaledProblem>& problem = ways_[beginning.passages];
    End end{beginning, {problem, mesh_of(*problem, graded_knots(curve, kPieces, 1.0), curve.length), {}}};
    end.attempt.relaxed = relaxed(*problem, end.attempt.mesh, curve);
    if (end.attempt.relaxed.found.violation <= kKept) ends_.push_back(std::move(end));
  }

  void follow(End& end) {
    constexpr std::size_t kFiner = 40;  // taste
    if (control_.stop()) return;
    const Found& found = end.attempt.relaxed.found;
    const Mesh mesh = mesh_of(*end.attempt.problem, refined_knots(*found.track, found.z, {}, kFiner),
                              found.track->core_length(found.z));
    Relaxed finer = relaxed(*end.attempt.problem, mesh, curve_of(*found.track, found.z));
    if (finer.found.violation > kKept || finer.t >= end.attempt.relaxed.t) return;
    end.attempt.mesh = mesh;
    end.attempt.relaxed = std::move(finer);
  }

  const std::vector<std::shared_ptr<ScaledProblem>>& ways_;
  LimitName limit_;
  SearchControl& control_;
  std::vector<End> ends_;
};

/// The search for the least violation on every way past the keep-outs, from one start after the other. What keeps all
/// limits on its mesh has to lead to a track that keeps them everywhere; where it does not, the search goes on.
class LeastViolation {
 public:
  LeastViolation(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                 SearchControl& control)
      : leads_(leads), control_(control), ways_(roughly_scaled_ways(problem, passages)) {}

  /// @return whether a track was found that keeps all limits
  bool from(Curves curves_of, StepModel model = StepModel::curved) {
    for (std::size_t way = 0; way < ways_.size(); ++way) {
      const std::vector<GuessCurve> curves = curves_of(*ways_[way]);
      for (auto start = curves.begin(); start != curves.end(); ++start) {
        if (control_.stop()) return false;
        if (std::find(curves.begin(), start, *start) != start) continue;
        const Mesh mesh = mesh_of(*ways_[way], graded_knots(*start, kPieces, 1.0), start->length);
        if (from(way, mesh, *start, model)) return true;
      }
    }
    return false;
  }

  /// From a track on its own mesh. @return as above
  bool from(std::size_t way, const Mesh& mesh, const GuessCurve& curve, StepModel model = StepModel::curved) {
    Attempt attempt;
    attempt.problem = ways_[way];
    attempt.mesh = mesh;
    attempt.relaxed = all_relaxed(*ways_[way], mesh, curve, control_, model);
    if (attempt.relaxed.t < kNearly && is_new(way, attempt.relaxed)) follow(attempt, control_);
    return ends_at(way, std::move(attempt));
  }

  /// From a track that all but keeps the limits: what is left over may go as the mesh follows the track. @return as above
  bool from_near(std::size_t way, const Mesh& mesh, const GuessCurve& curve) {
    constexpr double kMayGo = 1e-4;  // taste: ten times what counts as met
    if (from(way, mesh, curve)) return true;
    if (best_->relaxed.t > kMayGo) return false;
    found_ = leads_({Foothold{way_, best_->mesh, best_->relaxed.found.z}});
    return found_;
  }

  bool closely() {
    if (best_->relaxed.t < kNearly) return found_;
    Attempt closer = *best_;
    follow(closer, control_);
    return ends_at(way_, std::move(closer));
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

  /// Whether a track was found that keeps all limits.
  [[nodiscard]] bool found() const { return found_; }
  /// Whether there were tracks that keep all limits on their mesh, but led nowhere.
  [[nodiscard]] bool astray() const { return !found_ && best_ && best_->relaxed.t <= kContradiction; }
  [[nodiscard]] const Attempt& best() const { return *best_; }
  [[nodiscard]] std::size_t way() const { return way_; }
  [[nodiscard]] const std::vector<std::shared_ptr<ScaledProblem>>& ways() const { return ways_; }

 private:
  /// @return as above
  bool ends_at(std::size_t way, Attempt attempt) {
    if (attempt.relaxed.t <= kContradiction && !found_) {
      found_ = leads_({Foothold{way, attempt.mesh, attempt.relaxed.found.z}});
    }
    if (!best_ || attempt.relaxed.t < best_->relaxed.t) {
      best_ = std::move(attempt);
      way_ = way;
    }
    return found_;
  }

  /// An end that nearly kept all limits on its first mesh: what it comes to on finer ones is known.
  struct NearEnd {
    std::size_t way = 0;
    double t = 0.0;
    double objective = 0.0;
  };
  [[nodiscard]] bool is_new(std::size_t way, const Relaxed& relaxed) {
    constexpr double kSame = 1e-4;  // taste
    const NearEnd end{way, relaxed.t, relaxed.found.objective};
    const auto same = [&](const NearEnd& known) {
      return known.way == end.way && std::fabs(known.t - end.t) <= kSame * known.t &&
             std::fabs(known.objective - end.objective) <= kSame * std::fabs(known.objective);
    };
    if (std::any_of(near_ends_.begin(), near_ends_.end(), same)) return false;
    near_ends_.push_back(end);
    return true;
  }

  const Leads& leads_;
  SearchControl& control_;
  std::vector<std::shared_ptr<ScaledProblem>> ways_;
  std::vector<NearEnd> near_ends_;
  std::optional<Attempt> best_;
  std::size_t way_ = 0;
  bool found_ = false;
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

/// A limit that may give way alone, and the track on which it does.
struct GivingWay {
  std::size_t limit = 0;
  Relaxed alone;
  Foothold foothold;  ///< of that track
};

/// The bound that would do, beyond the least that a local search finds by a share of the way there: it has to be
/// found again. Where tracks wind, by a share of itself: what would do is the same then, whatever the bound is now.
std::optional<double> needed_bound(const LimitSpec& limit, std::size_t index, const Relaxed& alone,
                                   double beyond, bool winding) {
  if (winding && limit.side != 0) {
    return relaxed_bound(limit, alone.t, 0.0) * (1.0 + limit.side * beyond);
  }
  constexpr double kAtLeast = 1e-2;  // taste: of a bound that is nearly kept
  const double t = alone.t * (1.0 + beyond) + kAtLeast * beyond;
  double measured = 0.0;
  if (limit.side == 0) {
    const double least = measured_on(alone.found, limit, index);
    const bool squared = limit.measure == Measure::exit_speed;
    measured = least + beyond * (least - (squared ? limit.bound * limit.bound : limit.bound));
  }
  const double needed = relaxed_bound(limit, t, measured);
  // A beam cannot be closer than touched: then it is the beam that would have to move.
  if (limit.name.id == LimitId::keep_outs && needed < 0.0) return std::nullopt;
  if (limit.measure == Measure::normal_load && needed < 0.0) return std::nullopt;
  return needed;
}

/// The bound as messages tell it, to few digits: rounded away from what it is now, so that it still does.
double as_told(double needed, double now, Dimension dimension) {
  constexpr int kMostNudges = 20;  // budget
  constexpr double kNudge = 1e-4;  // taste
  for (int i = 0; i <= kMostNudges; ++i) {
    const double nudged = needed + (needed > now ? kNudge : -kNudge) * i * std::fabs(needed);
    const double told = parse_quantity(quantity_text(nudged, dimension), dimension, "needed");
    if (needed > now ? told >= needed : told <= needed) return told;
  }
  return needed;
}

/// What stands against each other at the track that breaks all limits least.
struct Opposition {
  std::vector<StatedLimit> limits;  ///< empty if nothing that the user set
  std::vector<GivingWay> giving;    ///< what could give way alone
};

/// @param winding  of the limit that asks for bends, where there is one
Opposition opposition_at(LeastViolation& search, const std::optional<GivingWay>& winding,
                         SearchControl& control) {
  const Attempt attempt = search.best();
  const std::vector<LimitSpec>& limits = attempt.problem->limits;
  const Vector share = shares_of(attempt);
  Opposition opposition;
  bool set_by_user = false;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (share[i] <= kPartOf) continue;
    const LimitSpec& limit = limits[i];
    const auto same = [&](const StatedLimit& known) { return known.limit == limit.name; };
    if (std::any_of(opposition.limits.begin(), opposition.limits.end(), same)) continue;
    set_by_user = set_by_user || !limit.built_in;
    const bool has_value = !limit.built_in && entry_of(limit.name.id).form != LimitForm::flag;
    opposition.limits.push_back({limit.name, has_value ? std::optional(limit.bound_si) : std::nullopt});
    if (limit.built_in || (limit.measure == Measure::curvature && limit.bound == 0.0)) continue;
    if (winding && limits[winding->limit].name == limit.name) {
      opposition.giving.push_back(*winding);
      continue;
    }
    std::optional<Relaxed> alone = relaxed_alone(attempt, alone_of(limits, limit.name), control);
    if (!alone) continue;
    // A track that breaks one limit alone is another beginning: from there all of them may be kept after all.
    const Transcription& track = *alone->found.track;
    if (search.from(search.way(), track.mesh(), curve_of(track, alone->found.z))) return opposition;
    Foothold foothold{search.way(), Mesh(track.mesh()), alone->found.z};
    opposition.giving.push_back({i, std::move(*alone), std::move(foothold)});
  }
  if (share.back() > kPartOf && !set_by_user && !opposition.limits.empty()) {
    opposition.limits.insert(opposition.limits.begin(),
                             {LimitName{LimitId::finish, Bound::exactly}, std::nullopt});
  }
  return opposition;
}

/// Whether no track can be as slow as a limit asks, however it winds.
std::optional<std::string> too_fast(const Problem& problem) {
  const std::optional<double> left = least_speed_left(problem);
  if (!left) return std::nullopt;
  const Limits& limits = problem.limits;
  for (const std::optional<double>& highest : {limits.speed.highest, limits.exit_speed.highest}) {
    if (!highest || *left <= *highest) continue;
    return "However a track winds within these slopes, " + rounded_text(*left, 4) +
           " m/s or more are left at the finish: so the energy equation says.";
  }
  return std::nullopt;
}

/// A lowest speed that no track can reach, whatever its shape, and why.
struct OutOfEnergy {
  StatedLimit limit;
  std::string why;
};

constexpr double kSurely = 1.0 + 1e-6;  // accuracy: ten times that of a limit

/// Whether every track is long enough for a lowest speed on the way to begin.
bool begins_on_every_track(const Problem& problem) {
  const bool is_point = problem.finish.kind == FinishKind::point;
  return problem.limits.lowest_speed_from <=
         (is_point ? math::hypot(problem.endpoints.run, problem.endpoints.drop) : 0.0);
}

/// Where a lowest speed begins to hold before a body that falls is as fast.
std::optional<OutOfEnergy> begins_too_soon(const Problem& problem) {
  const Range& speed = problem.limits.speed;
  const double from = problem.limits.lowest_speed_from;
  if (!speed.lowest || !begins_on_every_track(problem)) return std::nullopt;
  const std::optional<double> most = most_speed_after(problem, from);
  if (!most || !(*speed.lowest > kSurely * *most)) return std::nullopt;
  const auto text = [](double value, int digits) { return quantity_text(value, Dimension::speed, digits); };
  const auto [reached, wanted] = texts_apart(*most, *speed.lowest, text);
  const double entry = problem.body.entry_speed;
  const double enough = (*speed.lowest * *speed.lowest - entry * entry) / (2.0 * problem.gravity);
  return OutOfEnergy{{{LimitId::speed, speed.is_fixed() ? Bound::exactly : Bound::lowest}, *speed.lowest},
                     "Whatever the shape of the track, a fall of " + length_text(from) + " gives at most " +
                         reached + ". " + wanted + " take one of " + length_text(enough) +
                         ": lowest_from has to be more than that, by what slope, friction and drag take."};
}

std::optional<OutOfEnergy> out_of_energy(const Problem& problem) {
  const std::optional<double> most = most_speed_left(problem);
  if (!most) return begins_too_soon(problem);
  const Limits& limits = problem.limits;
  // A lowest speed on the way holds at the finish where every track is long enough for it to begin.
  const bool at_finish = begins_on_every_track(problem);
  for (const auto& [id, range] :
       {std::pair(LimitId::exit_speed, &limits.exit_speed), std::pair(LimitId::speed, &limits.speed)}) {
    if (!range->lowest || !(*range->lowest > kSurely * *most)) continue;
    if (id == LimitId::speed && !at_finish) continue;
    const double asked = *range->lowest;
    const double entry = problem.body.entry_speed;
    const auto text = [](double speed, int digits) { return quantity_text(speed, Dimension::speed, digits); };
    const auto [reached, wanted] = texts_apart(*most, asked, text);
    const double entry2 = entry * entry;
    const double drop = (asked * asked - entry2) / (2.0 * problem.gravity);
    const double faster = asked * asked - *most * *most + entry2;
    return OutOfEnergy{{{id, range->is_fixed() ? Bound::exactly : Bound::lowest}, asked},
                       "Whatever the shape of the track, the energy equation leaves at most " + reached +
                           " at the finish. " + wanted + " takes more than " + length_text(drop) +
                           " of drop, or " + text(std::sqrt(faster), 4) +
                           " at the entry; friction and drag add to that."};
  }
  return begins_too_soon(problem);
}

/// The search for what keeps all limits, and what it ends with where there is nothing.
class Footing {
 public:
  Footing(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
          SearchControl& control, bool bends)
      : search_(problem, passages, leads, control) {
    found_ = search_.from(&starts) || (!control.stop() && search_.closely()) ||
             search_.from(&constant_speed_starts);
    if (bends && !control.stop() && (!found_ || !control.any_track)) wind(leads, control);
  }

  [[nodiscard]] bool found() const { return found_ || search_.found(); }
  [[nodiscard]] bool asks_for_bends() const { return asks_for_bends_; }
  [[nodiscard]] const std::optional<GivingWay>& winding() const { return winding_; }
  [[nodiscard]] const std::vector<Beginning>& likely() const { return likely_; }
  [[nodiscard]] LeastViolation& search() { return search_; }

 private:
  void wind(const Leads& leads, SearchControl& control) {
    const std::optional<std::size_t> asking = asking_for_bends(search_.best());
    if (!asking) return;
    asks_for_bends_ = true;
    const LimitName name = search_.best().problem->limits[*asking].name;
    Winding winding(search_.ways(), name, control);
    winding.descend_all();
    // Of several the best one counts; where none of the best leads somewhere, any other.
    constexpr std::size_t kBest = 3;  // budget
    std::vector<Foothold> footholds = winding.footholds();
    const auto others = footholds.begin() + static_cast<std::ptrdiff_t>(std::min(kBest, footholds.size()));
    const std::vector<Foothold> worse(others, footholds.end());
    footholds.erase(others, footholds.end());
    found_ = !footholds.empty() && leads(footholds);
    if (!found_ && !worse.empty()) {
      const bool any = std::exchange(control.any_track, true);
      found_ = leads(worse);
      control.any_track = any;
    }
    const Winding::End* const least = winding.least();
    if (found_ || least == nullptr) return;
    const Transcription& track = *least->attempt.relaxed.found.track;
    const Beginning& beginning = least->beginning;
    likely_ = winding.best_beginnings();
    winding_ = GivingWay{*asking,
                         least->attempt.relaxed,
                         {beginning.passages, Mesh(track.mesh()), least->attempt.relaxed.found.z}};
    (void)search_.from(beginning.passages, track.mesh(), curve_of(track, least->attempt.relaxed.found.z));
  }

  LeastViolation search_;
  std::vector<Beginning> likely_;  ///< the best ones, once all have been tried
  bool found_ = false;
  bool asks_for_bends_ = false;
  std::optional<GivingWay> winding_;
};

/// Finds the bounds that do, each alone.
class Enough {
 public:
  Enough(const Problem& problem, const std::vector<LimitSpec>& limits, const Footing& footing,
         const Resolve& resolve, SearchControl& control)
      : problem_(problem),
        limits_(limits),
        winding_(footing.asks_for_bends()),
        likely_(footing.likely()),
        resolve_(resolve),
        control_(control) {}

  /// The least bound for which a track is found again, as far as that takes hardly longer than for a looser one: tracks
  /// that have a bound hardly give way are found at ten times the cost of others, if at all.
  [[nodiscard]] std::optional<Relaxation> of(const GivingWay& way) const {
    return winding_ ? among_bends(way) : among_others(way);
  }

 private:
  static constexpr int kMost = 1500;      // budget: three times what most take
  static constexpr double kLoose = 5e-2;  // taste

  [[nodiscard]] std::optional<Relaxation> among_others(const GivingWay& way) const {
    constexpr double kUsual = 1e-2;    // taste
    constexpr double kClosely = 1e-4;  // taste
    const int before = control_.evaluations;
    std::optional<double> found = tried(way, kUsual, kMost);
    if (!found) found = tried(way, kLoose, kMost);
    if (!found) return std::nullopt;
    return told(way, *found, tried(way, kClosely, more_than(before)));
  }

  /// Where the loosest does not do, those between it and the least are not tried.
  [[nodiscard]] std::optional<Relaxation> among_bends(const GivingWay& way) const {
    constexpr double kClosely = 1e-3;  // taste
    constexpr double kUsual = 1e-2;    // taste
    if (const auto closely = tried(way, kClosely, kMost)) return told(way, *closely, std::nullopt);
    const int before = control_.evaluations;
    const auto found = tried(way, kLoose, kMost);
    if (!found) return std::nullopt;
    return told(way, *found, tried(way, kUsual, more_than(before)));
  }

  /// What a closer bound may take: hardly more than one that was found.
  [[nodiscard]] int more_than(int before) const {
    constexpr int kTimes = 2;      // budget
    constexpr int kAtLeast = 300;  // budget
    return kTimes * (control_.evaluations - before) + kAtLeast;
  }

  [[nodiscard]] Relaxation told(const GivingWay& way, double found, std::optional<double> closer) const {
    const LimitSpec& limit = limits_[way.limit];
    return {limit.name, limit.bound_si, closer.value_or(found)};
  }

  /// @param most  evaluations
  [[nodiscard]] std::optional<double> tried(const GivingWay& way, double beyond, int most) const {
    if (control_.stop()) return std::nullopt;
    const LimitSpec& limit = limits_[way.limit];
    const auto least = needed_bound(limit, way.limit, way.alone, beyond, winding_);
    if (!least) return std::nullopt;
    const double needed = as_told(*least, limit.bound_si, limit.name.dimension());
    const auto changed = with_bound(problem_, limit.name, needed);
    // What is told can be put in.
    if (!changed || !limit_faults(changed->limits).empty()) return std::nullopt;
    // What keeps the bound already tells soonest where there is nothing to be found; all has to be found anew.
    if (!resolve_.from(*changed, way.foothold)) return std::nullopt;
    return resolve_.anew(*changed, most, likely_) ? std::optional(needed) : std::nullopt;
  }

  const Problem& problem_;
  const std::vector<LimitSpec>& limits_;
  bool winding_;  ///< tracks wind where a limit gives way
  std::vector<Beginning> likely_;
  const Resolve& resolve_;
  SearchControl& control_;
};

/// Straight ends are no rows of a program, which could tell: they have a part in a conflict where there is a track without
/// them. Adds those that do, and how long they may be.
void add_leads(const Problem& problem, const Resolve& resolve, SearchControl& control, Conflict& conflict) {
  constexpr int kMost = 1500;   // budget: as of any other bound
  constexpr int kHalvings = 7;  // taste: to a hundredth of the length
  for (const LimitId id : {LimitId::lead_in, LimitId::lead_out}) {
    const double length = problem.limits.*entry_of(id).length;
    const LimitName name{id, entry_of(id).bound};
    const auto does = [&](double shorter) {
      const auto changed = with_bound(problem, name, shorter);
      return changed && !control.stop() && resolve.anew(*changed, kMost, {});
    };
    if (!(length > 0.0) || !does(0.0)) continue;
    conflict.limits.push_back({name, length});
    double longest = 0.0;
    double too_long = length;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = as_told(0.5 * (longest + too_long), length, name.dimension());
      (middle > longest && does(middle) ? longest : too_long) = middle;
    }
    if (longest > 0.0) conflict.relaxations.push_back({name, length, longest});
  }
}

/// Where limits are all but met: whether an optimum within a looser bound that does leads to a track that keeps them. Its mesh has
/// knots where curvature jumps, which coarser ones miss by as much as is missing.
bool is_met_from_looser(const Problem& problem, const std::vector<Relaxation>& looser, const Resolve& resolve,
                        LeastViolation& search) {
  if (!resolve.optimum || search.best().relaxed.t >= kNearly) return false;
  for (const Relaxation& relaxation : looser) {
    const auto changed = with_bound(problem, relaxation.limit, relaxation.needed);
    const auto optimum = changed ? resolve.optimum(*changed) : std::nullopt;
    if (!optimum) continue;
    // Straight ends are part of a mesh.
    const Transcription track(optimum->mesh);
    const Mesh mesh =
        mesh_of(*search.ways()[optimum->passages], optimum->mesh.knots, track.core_length(optimum->z));
    if (search.from_near(optimum->passages, mesh, curve_of(track, optimum->z))) return true;
  }
  return false;
}

/// What stands against each other where no track was found, from the best end of all searches for one.
Opposition opposition_of(Footing& footing, SearchControl& control) {
  // From a better track the reasons are others; how often they are looked for anew.
  constexpr int kMostRounds = 3;    // budget
  constexpr double kBetter = 0.98;  // taste
  LeastViolation& search = footing.search();
  Opposition opposition;
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = search.best().relaxed.t;
    opposition = opposition_at(search, footing.winding(), control);
    if (control.stop() || search.found() || search.best().relaxed.t > kBetter * before) break;
  }
  return opposition;
}

}  // namespace

bool has_likely_footing(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                        SearchControl& control, const std::vector<Beginning>& likely) {
  const std::vector<std::shared_ptr<ScaledProblem>> ways = roughly_scaled_ways(problem, passages);
  for (const Beginning& beginning : likely) {
    Winding one(ways, beginning.limit, control);
    if (one.descend_from(beginning) && leads(one.footholds())) return true;
    if (control.stop()) return false;
  }
  return false;
}

bool has_footing(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                 SearchControl& control, bool bends) {
  return Footing(problem, passages, leads, control, bends).found();
}

Explanation explain(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                    const Resolve& resolve, SearchControl& control) {
  Explanation explanation;
  Footing footing(problem, passages, leads, control, true);
  if (footing.found() || control.stop()) return explanation;
  LeastViolation& search = footing.search();
  // Before limits are said to contradict each other, or no track to be found, a search of another kind, from other starts, has
  // to fail too.
  const std::optional<OutOfEnergy> beyond = out_of_energy(problem);
  const std::optional<std::string> proof = beyond ? beyond->why : too_fast(problem);
  if (!proof && search.from(&scattered_starts, StepModel::flat)) return explanation;
  if (search.astray() && !beyond) return explanation;
  Opposition opposition = opposition_of(footing, control);
  if (search.found() || control.stop()) return explanation;
  const bool settled = search.confirmed() && !search.found();
  Conflict& conflict = explanation.conflict;
  conflict.limits = std::move(opposition.limits);
  const Enough enough(problem, search.best().problem->limits, footing, resolve, control);
  for (const GivingWay& way : opposition.giving) {
    if (!resolve.anew) break;
    if (const auto relaxation = enough.of(way)) conflict.relaxations.push_back(*relaxation);
  }
  // Nothing stands against it but energy.
  if (beyond) conflict.limits = {beyond->limit};
  if (!conflict.limits.empty() && resolve.anew) add_leads(problem, resolve, control, conflict);
  if (!proof && is_met_from_looser(problem, conflict.relaxations, resolve, search)) return {};
  // A local search that ends above zero confirms that limits stand against each other; but for those that more and
  // other bends might keep, of which it has tried few.
  const bool bends = footing.asks_for_bends() || asking_for_bends(search.best());
  // Nor for several points to be passed, or straight ends that reach beyond the finish: the ways between them are many, too.
  const auto points =
      std::count_if(conflict.limits.begin(), conflict.limits.end(),
                    [](const StatedLimit& stated) { return stated.limit.id == LimitId::waypoints; });
  const ScaledProblem& scaled = *search.ways().front();
  const bool reaches_beyond = scaled.lead_in + scaled.lead_out >= 1.0;
  // Nor where one mesh holds a track that keeps all of them, though none of its neighbours does between the stations.
  constexpr double kKept = 1e-7;  // accuracy: that of a limit
  const bool is_local = bends || points >= 2 || reaches_beyond || search.best().relaxed.t <= kKept;
  explanation.certain = !conflict.limits.empty() && (proof || (settled && !is_local));
  if (proof) conflict.why = *proof;
  if (explanation.certain) conflict.text = conflict_text(conflict);
  return explanation;
}

}  // namespace glissade::optimizer
