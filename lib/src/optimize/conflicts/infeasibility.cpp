#include "optimize/conflicts/infeasibility.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "optimize/conflicts/energy_conflict.hpp"
#include "optimize/conflicts/least_broken.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/search/hooked_starts.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
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
