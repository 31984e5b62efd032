// The facade: searches on every way past the keep-outs, and explains the end.

#include "glissade/optimize/optimize.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "optimize/conflicts/end_conflict.hpp"
#include "optimize/conflicts/energy_left.hpp"
#include "optimize/conflicts/infeasibility.hpp"
#include "optimize/conflicts/mean_slope.hpp"
#include "optimize/least_bound/least_bound.hpp"
#include "optimize/least_bound/least_peak.hpp"
#include "optimize/least_bound/optimize_briefly.hpp"
#include "optimize/prices/prices.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/problem/passages.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "optimize/search/patience.hpp"
#include "optimize/search/ramp.hpp"
#include "optimize/search/searcher.hpp"
#include "optimize/search/shifted_bends.hpp"
#include "optimize/search/simple_tracks.hpp"
#include "optimize/search/smoother_ground.hpp"
#include "optimize/search/starts.hpp"
#include "optimize/stopped.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace glissade {
namespace optimizer {
namespace {

std::string none_found_text(const Conflict& nearest) {
  std::string text = "no track was found that keeps every limit, and no conflict between them is certain";
  std::vector<std::string> names;
  for (const StatedLimit& stated : nearest.limits) names.push_back(stated.limit.key());
  if (!names.empty()) text += "; the closest one breaks " + listed(names);
  for (std::size_t i = 0; i < nearest.relaxations.size(); ++i) {
    const Relaxation& relaxation = nearest.relaxations[i];
    text += (i == 0 ? "; one was found for " : ", or ") + relaxation.limit.key() + " " +
            quantity_text(relaxation.needed, relaxation.limit.dimension());
  }
  return text;
}

/// What no neighbouring track does.
const char* better_text(const Objective& objective) {
  switch (objective.kind) {
    case ObjectiveKind::exit_speed:
      return "has a higher exit speed";
    case ObjectiveKind::least_wear:
      return "wears less";
    case ObjectiveKind::even_speed:
      return "has a more even speed";
    case ObjectiveKind::least_drop:
      return "is lower";
    case ObjectiveKind::least_length:
      return "is shorter";
    case ObjectiveKind::blend:
      return "is better";
    default:
      return "is faster";
  }
}

/// The better one of two ends.
bool is_better(const Candidate& candidate, const std::optional<Candidate>& best) {
  if (!best) return true;
  if (candidate.kept != best->kept) return candidate.kept;
  return candidate.kept && candidate.found->objective < best->found->objective;
}

/// Whether a body that was fast is all but at rest somewhere: next to that a track is an optimum among those that keep it moving,
/// and others, on which it stays fast, lie far away.
bool nearly_stops(const Found& found) {
  constexpr double kOfSpeed = 0.05;  // taste: of the highest speed before
  const State state = found.rows->state(found.z, false);
  return std::any_of(state.flows.begin(), state.flows.end(), [](const Flow& flow) {
    double highest = 0.0;
    for (const double v : flow.v) {
      if (v < kOfSpeed * kOfSpeed * highest) return true;
      highest = std::max(highest, v);
    }
    return false;
  });
}

/// One problem's search, from its own starts and from tracks that keep its limits.
class Course {
 public:
  Course(const Problem& problem, const OptimizeOptions& options, SearchControl& control,
         const Progress& progress)
      : problem_(problem),
        options_(options),
        control_(control),
        progress_(progress),
        searcher_(problem, options, control, progress) {}

  void from_starts() {
    if (control_.any_track) {
      for (std::size_t way = 0; way < ways_.size() && !stopped_ && !kept(); ++way)
        take(way, searcher_.search(ways_[way]));
      return;
    }
    // The promising ways first: what is plainly behind them need not be searched to its end.
    std::vector<Searcher::Opening> openings;
    Vector promises;
    do {
      openings.push_back(searcher_.opened(ways_[openings.size()]));
      promises.push_back(openings.back().promise());
    } while (openings.size() < ways_.size() && !control_.stop());
    const double least = *std::min_element(promises.begin(), promises.end());
    for (const bool first_ones : {true, false}) {
      for (std::size_t way = 0; way < openings.size(); ++way) {
        constexpr double kBehind = 0.01;  // taste
        const bool is_promising = promises[way] <= least + kBehind * std::fabs(least);
        if (stopped_) return;
        if (is_promising == first_ones) take(way, searcher_.search(std::move(openings[way]), best_));
      }
    }
  }

  /// Where a track is found: those that go on to smoother ground, which the starts may miss.
  void onto_smoother_ground() {
    for (std::size_t way = 0; way < ways_.size(); ++way) {
      if (!kept() || stopped_) return;
      // The same track by another way differs by less, and that is no reason to prefer it.
      constexpr double kFaster = 1e-6;  // accuracy: that of a time
      const Candidate known = *best_;
      const double enough = known.found->objective - kFaster * std::fabs(known.found->objective);
      for (Candidate& other :
           on_smoother_ground(problem_, ways_[way], known, options_, control_, progress_)) {
        if (other.found->objective < enough) take(way, std::move(other));
      }
    }
  }

  /// Where the straight line keeps every limit no answer is slower: the search from there, or that line itself.
  void from_straight_line() {
    constexpr double kSlower = 1e-6;  // accuracy: that of a time
    if (stopped_ || problem_.finish.kind != FinishKind::point || has_straight_line_behind(kSlower)) return;
    const CenterlinePtr line = std::make_shared<StraightLine>(problem_.endpoints);
    const referee::Judgement judgement = referee::judge_track(problem_, line, referee::kRefereeSamples);
    if (!judgement.arrived || judgement.worst > options_.limit_tolerance) return;
    const auto is_behind = [&] {
      return !kept() ||
             (is_fastest() && best_->judgement.travel_time > (1.0 + kSlower) * judgement.travel_time);
    };
    from_line({std::fabs(problem_.endpoints.run), problem_.endpoints.drop}, is_behind);
  }

  /// The same of tracks that are to be low or short: where the steepest ramp keeps every limit none is higher, or longer.
  void from_ramp() {
    constexpr double kHigher = 1e-7;  // accuracy: that of a limit
    if (stopped_ || !is_low_or_short(problem_.objective.kind)) return;
    const std::optional<Ramp> ramp = steepest_ramp(problem_);
    if (!ramp || !ramp->keeps_limits(options_.limit_tolerance)) return;
    const double length = measure_of(*ramp->line, problem_.objective.kind);
    const auto is_behind = [&] {
      return !kept() || measure_of(*best_->track, problem_.objective.kind) > (1.0 + kHigher) * length;
    };
    const Endpoints ends = ramp->line->endpoints();
    from_line({ends.run, ends.drop}, is_behind);
  }

  /// The search from a track that was made without one, and keeps the limits.
  void from_track(const Centerline& track) {
    constexpr std::size_t kPieces = 24;  // taste
    for (std::size_t way = 0; way < ways_.size() && !kept() && !stopped_; ++way) {
      const ScaledProblem problem = scaled(problem_, ways_[way]);
      const std::optional<GuessCurve> curve = curve_along(problem, track);
      if (!curve) return;
      const Mesh mesh = mesh_of(problem, graded_knots(*curve, kPieces, 1.0), curve->length);
      from(Foothold{way, mesh, fit(*curve, Transcription(mesh))});
    }
  }

  void from(const Foothold& foothold) {
    if (!stopped_)
      take(foothold.passages, searcher_.search_from(ways_[foothold.passages], foothold.mesh, foothold.z));
  }

  /// Where the search was asked to end, whatever it was at: what it has come by on its way.
  void from_known() {
    if (stopped_ && !kept()) take(way_, searcher_.from_known());
  }

  /// What became of a track that was to be the best one.
  enum class Onto { untried, no_better, taken };
  /// From the best one to another optimum of its problem, where that wins something.
  Onto onto(Found found) {
    constexpr double kPays = 5e-7;  // accuracy: half that of a time
    const double known = best_->found->objective;
    if (stopped_ || !(known - found.objective > kPays * std::fabs(known))) return Onto::untried;
    const Candidate end = searcher_.ended_on(*best_, std::move(found));
    const bool converged = end.kept && !end.stopped && end.found->residual <= options_.tolerance;
    if (!converged) return Onto::untried;
    take(way_, end);
    return best_->found->objective < known ? Onto::taken : Onto::no_better;
  }

  /// Where a body at rest turns down at once: the same track, ever tighter there.
  void sharpen_crest() {
    if (!stopped_) best_ = searcher_.with_sharper_crest(*std::move(best_));
  }

  /// From several, of which the best one counts. On their way there they tell which can be that.
  void from(const std::vector<Foothold>& footholds) {
    if (control_.any_track) {
      for (const Foothold& foothold : footholds) {
        if (!kept()) from(foothold);
      }
      return;
    }
    std::vector<Searcher::Stage> stages;
    double best = HUGE_VAL;
    for (const Foothold& foothold : footholds) {
      stages.push_back(searcher_.carried_on(ways_[foothold.passages], foothold.mesh, foothold.z));
      if (is_on_limits(stages.back())) best = std::min(best, stages.back().found.objective);
    }
    const auto may_win = [&](const Searcher::Stage& stage) {
      constexpr double kBehind = 0.01;  // taste: of the objective; what follows wins less
      return is_on_limits(stage) && stage.found.objective <= best + kBehind * std::fabs(best);
    };
    for (const bool first : {true, false}) {
      for (std::size_t i = 0; i < stages.size(); ++i) {
        if (stopped_ || (!first && kept())) return;
        if (may_win(stages[i]) == first) take(footholds[i].passages, searcher_.ended(std::move(stages[i])));
      }
    }
  }

  /// Where the starts did not simply lead to an optimum: how good a track is depends on its mesh there.
  /// @param by_footholds  whether the starts led nowhere
  void look_again(bool by_footholds) {
    const auto is_optimum = [&] { return best_->found->residual <= options_.tolerance; };
    look_at_promising();
    bool is_hooked = false;
    if (kept() && !stopped_) {
      const double known = best_->found->objective;
      best_ = searcher_.from_hooks(*std::move(best_));
      stopped_ = best_->stopped;
      // Other tracks that wind take long to find: that is for those that hooks do not help.
      is_hooked = best_->found->objective < known && is_optimum();
    }
    if (!kept() || stopped_) return;
    const bool is_doubted = is_about_exit_speed() && nearly_stops(*best_->found);
    if (!is_hooked && (by_footholds || !is_optimum() || is_doubted)) {
      best_ = by_footholds ? searcher_.from_loose_caps(*std::move(best_))
                           : searcher_.from_scattered(*std::move(best_));
      if (!best_->stopped && (by_footholds || !is_optimum()))
        best_ = searcher_.on_other_meshes(*std::move(best_), by_footholds);
    }
    // Bends that lie well by themselves may still lie in the wrong order.
    if (!best_->stopped) best_ = searcher_.with_shifted_bends(*std::move(best_));
    stopped_ = best_->stopped;
  }

  /// Where bends are looked for.
  void from_likely(const std::vector<Beginning>& likely) {
    control_.most_rounds = kFarRounds;
    (void)has_likely_footing(problem_, ways_, leads(), control_, likely);
  }

  /// Where the limits lead none of the starts to a track that keeps them: tracks that do, if there are any.
  void from_footholds(bool bends) {
    control_.most_rounds = kFarRounds;
    (void)has_footing(problem_, ways_, leads(), control_, bends);
  }

  /// @return what stands in the way, if no track keeps all limits
  [[nodiscard]] Conflict explained(const Resolve& resolve, bool& certain) {
    control_.most_rounds = kFarRounds;
    Explanation explanation = explain(problem_, ways_, leads(), resolve, control_);
    stopped_ = stopped_ || control_.stop();
    certain = explanation.certain && !best_->kept && !stopped_;
    return std::move(explanation.conflict);
  }

  [[nodiscard]] const Candidate& best() const { return *best_; }
  [[nodiscard]] Foothold foothold() const {
    return {way_, Mesh(best_->found->track->mesh()), best_->found->z};
  }
  [[nodiscard]] bool kept() const { return best_ && best_->kept; }
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  static constexpr int kFarRounds = 10;  // budget

  [[nodiscard]] bool is_about_exit_speed() const {
    return problem_.objective.kind == ObjectiveKind::exit_speed;
  }

  [[nodiscard]] static bool is_on_limits(const Searcher::Stage& stage) {
    constexpr double kNearly = 1e-5;  // accuracy: a hundred times that of a limit
    return stage.found.feasible(kNearly);
  }

  [[nodiscard]] Leads leads() {
    return [this](const std::vector<Foothold>& footholds) {
      from(footholds);
      return kept() || stopped_;
    };
  }

  /// The search from a straight line, by every way, or that line itself, while the best track is behind it.
  /// @param finish  of the line [m]
  void from_line(Vec2 finish, const std::function<bool()>& is_behind) {
    constexpr std::size_t kPieces = 24;  // taste
    for (std::size_t way = 0; way < ways_.size() && is_behind() && !stopped_; ++way) {
      const ScaledProblem problem = scaled(problem_, ways_[way]);
      const std::optional<GuessCurve> curve = straight_line(problem, (1.0 / problem.chord) * finish);
      if (!curve) return;
      const Mesh mesh = mesh_of(problem, graded_knots(*curve, kPieces, 1.0), curve->length);
      const Foothold foothold{way, mesh, fit(*curve, Transcription(mesh))};
      from(foothold);
      if (is_behind() && !stopped_) take(way, searcher_.mended(ways_[way], foothold.mesh, foothold.z));
    }
  }

  [[nodiscard]] bool is_fastest() const { return problem_.objective.kind == ObjectiveKind::travel_time; }
  /// Whether it is plain that the straight line is no better.
  /// @param share  of a time
  [[nodiscard]] bool has_straight_line_behind(double share) const {
    if (!kept()) return false;
    if (!is_fastest()) return true;
    const bool simple = best_->rough->drag == 0.0;
    return simple && best_->found->objective <= (1.0 + share) * straight_time(*best_->rough);
  }

  /// A better track than the best one that came to no end there.
  void look_at_promising() {
    constexpr double kMuch = 1e-4;  // taste: for less of the objective it is not worth the way
    if (!kept() || stopped_ || !promising_) return;
    const double known = best_->found->objective;
    if (!(known - promising_->promising->objective > kMuch * std::fabs(known))) return;
    Candidate end = searcher_.from_promising(*promising_);
    stopped_ = stopped_ || end.stopped;
    if (end.kept && end.found->residual <= options_.tolerance) take(promising_way_, std::move(end));
  }

  void take(std::size_t way, Candidate candidate) {
    stopped_ = stopped_ || candidate.stopped;
    const bool promises = candidate.promising &&
                          (!promising_ || candidate.promising->objective < promising_->promising->objective);
    if (promises) {
      promising_ = candidate;
      promising_way_ = way;
    }
    if (!is_better(candidate, best_)) return;
    best_ = std::move(candidate);
    way_ = way;
  }

  const Problem& problem_;
  const OptimizeOptions& options_;
  SearchControl& control_;
  const Progress& progress_;
  Searcher searcher_;
  std::vector<Passages> ways_ = all_passages(problem_.limits);
  std::optional<Candidate> best_;
  std::size_t way_ = 0;                 ///< of the best one
  std::optional<Candidate> promising_;  ///< with the best track that came to no end
  std::size_t promising_way_ = 0;
  bool stopped_ = false;
};

/// How a problem with another bound is solved: any track that keeps the limits tells that the bound does.
Resolve resolve_with(const OptimizeOptions& options, SearchControl& control) {
  static const Progress quiet;
  const auto anew = [&](const Problem& problem, int most_evaluations, const std::vector<Beginning>& likely) {
    const std::function<bool()> stop = control.stop;
    const int before = control.evaluations;
    control.stop = [&, stop] { return control.evaluations - before > most_evaluations || stop(); };
    control.any_track = true;
    Course course(problem, options, control, quiet);
    course.from_likely(likely);
    if (!course.kept() && !course.stopped()) course.from_starts();
    if (!course.kept() && !course.stopped()) course.from_footholds(likely.empty());
    control.any_track = false;
    control.stop = stop;
    return course.kept();
  };
  const auto from = [&](const Problem& problem, const Foothold& foothold) {
    control.any_track = true;
    Course course(problem, options, control, quiet);
    course.from(foothold);
    control.any_track = false;
    return course.kept();
  };
  const auto optimum = [&](const Problem& problem) -> std::optional<Foothold> {
    Course course(problem, options, control, quiet);
    course.from_starts();
    if (!course.kept() && !course.stopped()) course.from_footholds(false);
    if (!course.kept()) return std::nullopt;
    return course.foothold();
  };
  return {anew, from, optimum};
}

std::string ended_text(const Objective& objective, OptimizeStatus status, bool stopped, bool out_of_time) {
  if (status == OptimizeStatus::optimal) {
    return std::string("every limit holds and no neighbouring track ") + better_text(objective);
  }
  if (!stopped) return "every limit holds, but the first-order residual stayed above its tolerance";
  return out_of_time ? "the time budget ran out: the best track so far" : "stopped: the best track so far";
}

/// Whether bends lie between stretches at a cap on the speed that might as well lie elsewhere along these.
bool winds_at_cap(const ScaledProblem& problem, const Found& found) {
  constexpr double kBend = 0.03;  // taste: of the core; what is shorter joins a fall to a ride at the cap
  const std::vector<Span> stretches = stretches_at_cap(problem, found);
  for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
    if (stretches[i + 1].from - stretches[i].to > kBend) return true;
  }
  return false;
}

/// Whether it is how long tracks are looked for that holds the best one up: where a longer one is better without end, no limit does.
bool is_held_by_longest(const ScaledProblem& problem, const Found& found) {
  constexpr double kHolds = 1e-6;  // accuracy: of a multiplier, in units of the objective a chord
  for (std::size_t k = 0; k < found.active.size(); ++k) {
    const LimitSpec& limit = problem.limits[found.active[k].limit];
    if (limit.name.id == LimitId::not_many_chords_long && found.inequality[k] > kHolds) return true;
  }
  return false;
}

/// What is lost to limits that are held tighter than asked for: loads that no curvature between knots follows just so.
double lost_to_margins(const ScaledProblem& problem, const Found& found) {
  double lost = 0.0;
  for (std::size_t k = 0; k < found.active.size(); ++k) {
    const std::size_t limit = found.active[k].limit;
    if (!problem.limits[limit].measure->is_load()) continue;
    lost += found.inequality[k] * (found.rows->margins()[limit] - least_margin(problem.limits[limit]));
  }
  return lost;
}

/// What finer meshes would win, as a share of the objective.
/// @param on_finest  the best one is that on the finest mesh of those that prices were taken from
std::optional<double> left_to_win(const Candidate& best, const PricedLimits& priced, bool on_finest) {
  // Where halving pieces wins so much, halving them again and again wins as much again, at first order.
  constexpr double kAgain = 2.0;  // theory
  // Jumps lie beside where they belong by some twentieth of their room: drawn ones win a hundredth to a twentieth of what
  // their first order promises through all of it.
  constexpr double kOfRoom = 0.05;  // measured
  if (!best.ahead.finer_mesh_wins) return std::nullopt;
  const Found& found = *best.found;
  const double size = std::fabs(found.objective);
  double halving = (std::max(0.0, found.objective - priced.least) + priced.rest) / size;
  // What a program promises counts where no mesh of all pieces halved has told it.
  const double promised =
      priced.halved_wins ? std::max(0.0, *priced.halved_wins) / size : *best.ahead.finer_mesh_wins;
  if (!on_finest) halving = std::max(halving, kAgain * promised);
  return halving + lost_to_margins(*best.problem, found) / size + kOfRoom * best.ahead.moves_promise +
         best.sharper_crest_wins;
}

/// Limits that the track keeps well clear of cost nothing: what a finer mesh would have at them is no part of it.
void leave_out_untouched(const std::vector<LimitCheck>& checks, std::vector<ActiveLimit>& active) {
  // In scales: loads that are held tighter than asked for stay a hundredth of it off.
  constexpr double kClear = 1e-3;  // taste
  std::erase_if(active, [&](const ActiveLimit& limit) {
    const auto check = std::find_if(checks.begin(), checks.end(),
                                    [&](const LimitCheck& known) { return known.limit == limit.limit; });
    return check != checks.end() && check->violation == 0.0 && limit.limit.bound != Bound::exactly &&
           std::fabs(check->reached - check->value) > kClear * check->scale;
  });
}

/// Brings places on one track to another one, of a little more or less length between the same straight ends.
/// @param from,to  their lengths [m]
void carry_places(const ScaledProblem& problem, double from, double to, std::vector<ActiveLimit>& active) {
  const double lead_in = problem.lead_in * problem.chord;
  const double ends = lead_in + problem.lead_out * problem.chord;
  const auto carried = [&](double s) {
    if (s <= lead_in) return s;
    const double behind = from - (ends - lead_in);  // where the last straight end begins
    if (s >= behind) return s + (to - from);
    return lead_in + (s - lead_in) * (to - ends) / (from - ends);
  };
  for (ActiveLimit& limit : active) {
    for (Stretch& stretch : limit.where)
      stretch = {std::min(carried(stretch.from), to), std::min(carried(stretch.to), to)};
  }
}

/// Tells of the best track that keeps every limit.
void tell_track(Course& course, const OptimizeOptions& options, SearchControl& control,
                const Progress& progress, OptimizeReport& report) {
  if (progress) progress("prices", 0.95);
  PricedLimits priced;
  {
    const Candidate& known = course.best();
    priced = priced_limits(*known.problem, *known.found, known.ahead.multipliers, options, control);
  }
  report.active = std::move(priced.limits);
  const Course::Onto onto = priced.better ? course.onto(std::move(*priced.better)) : Course::Onto::untried;
  const bool onto_finest = onto == Course::Onto::taken && priced.is_finest;
  // What it won between its stations it has lost again where limits are held there, too.
  if (onto == Course::Onto::no_better) {
    priced.least = course.best().found->objective;
    priced.rest = 0.0;
  }
  const Found blunt = *course.best().found;
  course.sharpen_crest();
  const Candidate& best = course.best();
  const Found& found = *best.found;
  if (best.sharper_crest_wins > 0.0) carry_over(*best.problem, blunt, found, report.active);
  report.travel_time = best.judgement.travel_time;
  report.exit_speed = best.judgement.exit_speed;
  report.checks = best.judgement.checks;
  leave_out_untouched(report.checks, report.active);
  carry_places(*best.problem, priced.length, best.track->length(), report.active);
  report.first_order_residual = found.residual;
  report.finer_mesh_wins = left_to_win(best, priced, onto_finest);
}

/// A track that no mesh was needed for, in the place of the one found.
void answer_with(CenterlinePtr track, const referee::Judgement& judgement, std::vector<ActiveLimit> active,
                 Optimum& optimum) {
  OptimizeReport& report = optimum.report;
  optimum.centerline = std::move(track);
  report.active = std::move(active);
  report.travel_time = judgement.travel_time;
  report.exit_speed = judgement.exit_speed;
  report.checks = judgement.checks;
  report.first_order_residual = 0.0;
  report.finer_mesh_wins = 0.0;
}

/// The unlimited optimum, where that keeps every limit. @pre there is one: unlimited_travel_time()
std::optional<KeptTrack> exact_track(const Problem& problem, const OptimizeOptions& options) {
  const FastestTrack fastest =
      fastest_track(problem.endpoints, problem.body.friction, problem.body.entry_speed, problem.gravity);
  return kept_track(problem, fastest.centerline, options.limit_tolerance);
}

bool is_fastest_at_nominal(const Objective& objective) {
  return objective.kind == ObjectiveKind::travel_time && !objective.worst_case;
}

/// The unlimited optimum instead, where the search stayed behind it although it keeps every limit: next to the reach limit its
/// flattest stretch asks for more pieces than a mesh has.
/// @return whether it is the answer
bool take_unlimited(const Problem& problem, const OptimizeOptions& options, Optimum& optimum) {
  constexpr double kBehind = 1e-6;  // accuracy: that of a time
  OptimizeReport& report = optimum.report;
  const std::optional<double> least = report.unlimited_travel_time;
  const bool is_fastest = is_fastest_at_nominal(problem.objective);
  if (!least || !is_fastest || report.travel_time <= (1.0 + kBehind) * *least) return false;
  // Who asks for few pieces gets what they give.
  if (options.pieces < OptimizeOptions{}.pieces) return false;
  const bool bound = std::any_of(report.active.begin(), report.active.end(), [](const ActiveLimit& active) {
    return active.limit.id != LimitId::lowest_normal_load && active.limit.id != LimitId::arrival;
  });
  if (bound) return false;
  const std::optional<KeptTrack> exact = exact_track(problem, options);
  if (!exact || !(exact->judgement.travel_time < report.travel_time)) return false;
  answer_with(exact->track, exact->judgement, {}, optimum);
  return true;
}

/// The ramp instead, where it keeps every limit and the search, which began from it, stayed behind it: that needs something to
/// bend between two straight ends, and tells nearly upright tracks apart by next to nothing.
void take_ramp(const Problem& problem, const OptimizeOptions& options, Optimum& optimum) {
  constexpr double kBehind = 1e-7;  // accuracy: that of a limit
  const ObjectiveKind kind = problem.objective.kind;
  if (!is_low_or_short(kind)) return;
  const std::optional<Ramp> ramp = steepest_ramp(problem);
  if (!ramp || !ramp->keeps_limits(options.limit_tolerance)) return;
  if (!(measure_of(*ramp->line, kind) < (1.0 - kBehind) * measure_of(*optimum.centerline, kind))) return;
  answer_with(ramp->line, ramp->judgement, active_limits(*ramp, problem), optimum);
}

/// The same with one that keeps every limit, and is not said to be the best.
void answer_with_any(const KeptTrack& kept, Optimum& optimum) {
  answer_with(kept.track, kept.judgement, {}, optimum);
  optimum.report.status = OptimizeStatus::feasible_not_converged;
  optimum.report.first_order_residual = HUGE_VAL;
  optimum.report.finer_mesh_wins.reset();
}

/// Where no search can tell tracks apart: the exact optimum where that is known and keeps every limit, else the straight line.
void tell_creeping(const Problem& problem, const OptimizeOptions& options, const Creep& creep,
                   Optimum& optimum) {
  OptimizeReport& report = optimum.report;
  const bool has_exact = report.unlimited_travel_time && is_fastest_at_nominal(problem.objective);
  if (const auto exact = has_exact ? exact_track(problem, options) : std::nullopt) {
    answer_with(exact->track, exact->judgement, {}, optimum);
    report.status = OptimizeStatus::optimal;
    report.message = "every limit holds, and no track without limits is faster";
    return;
  }
  const auto line =
      kept_track(problem, std::make_shared<const StraightLine>(problem.endpoints), options.limit_tolerance);
  report.message =
      (line ? "every limit holds on the straight line, but " : "no search was made: ") + creep_text(creep);
  if (line) answer_with_any(*line, optimum);
}

/// Whether what a search takes for lying still decided how fast the body arrives, as no limit does: slower than that on a straight line
/// that took its track's place, or just as fast where there is little more to be had. What it would win by other tracks the search
/// does not see: measured at friction 0.2 over 10 m, 8.5e-3 of the time where at most 4.4 times that speed is left, 8.5e-5 at 14 times.
bool arrives_creeping(const Problem& problem, const Optimum& optimum) {
  constexpr double kBelow = 0.99;    // taste: rows are kept to far more
  constexpr double kAtMost = 1.001;  // rounding: the same from above
  constexpr double kLittle = 10.0;   // taste: as in creep_at_best()
  Body body = problem.body;
  body.friction = problem.high_friction.value_or(body.friction);
  const double speed = Motion(optimum.centerline, body, problem.gravity).exit_speed();
  const double still = creeping_speed(problem, optimum.centerline->length());
  if (speed < kBelow * still) return true;
  const std::optional<double> most = most_speed_left(problem);
  return speed <= kAtMost * still && most && *most < kLittle * still;
}

/// Tells why there is no track.
void tell_none(Conflict conflict, bool certain, bool stopped, OptimizeReport& report) {
  report.status = certain ? OptimizeStatus::infeasible : OptimizeStatus::no_track_found;
  if (stopped) {
    report.message = "ended early, before any track kept every limit";
    return;
  }
  report.message = certain ? conflict.text : none_found_text(conflict);
  report.conflict = std::move(conflict);
}

/// Without changes from one friction to the same: what is known of one friction then holds.
Problem with_true_changes(Problem problem) {
  std::vector<FrictionChange> changes = std::move(problem.body.friction_changes);
  problem.body.friction_changes.clear();
  const bool is_range = problem.low_friction || problem.high_friction;
  for (const FrictionChange& change : changes) {
    const std::vector<FrictionChange>& kept = problem.body.friction_changes;
    const bool same = kept.empty() ? !is_range && change.friction == problem.body.friction
                                   : change.friction == kept.back().friction;
    if (!same) problem.body.friction_changes.push_back(change);
  }
  return problem;
}

/// Tells how the search ended. @param is_exact  the track is the optimum without limits
void tell_end(const Problem& problem, const OptimizeOptions& options, const Course& course, bool out_of_time,
              bool is_exact, Optimum& optimum) {
  OptimizeReport& report = optimum.report;
  const bool converged = report.first_order_residual <= options.tolerance && !course.stopped();
  report.status = converged ? OptimizeStatus::optimal : OptimizeStatus::feasible_not_converged;
  report.message = ended_text(problem.objective, report.status, course.stopped(), out_of_time);
  if (!course.stopped() && !is_exact && arrives_creeping(problem, optimum)) {
    report.status = OptimizeStatus::feasible_not_converged;
    report.message =
        "every limit holds, but the body arrives no faster than what a search takes for lying still: drop "
        "and friction are so near to what ends the ride that it cannot tell whether another track is better; "
        "try a larger drop, less friction or an entry speed";
    report.first_order_residual = HUGE_VAL;
    report.finer_mesh_wins.reset();
    return;
  }
  if (converged && !is_exact && is_held_by_longest(*course.best().problem, *course.best().found)) {
    report.status = OptimizeStatus::feasible_not_converged;
    report.message = "every limit holds, but the longer a track, the better: none longer than " +
                     length_text(optimum.centerline->length()) +
                     " is looked for; give the free end a nearer bound, or an arc_length";
    return;
  }
  // Answers to neighbouring problems of the kind were out of order by up to 1.7e-3 (docs/optimization.md).
  const bool winds = converged && winds_at_cap(*course.best().problem, *course.best().found);
  if (winds) report.message += "; with bends elsewhere at the cap on the speed some 0.2 % may be left";
}

std::string simple_text(bool stopped) {
  return stopped
             ? "the time budget ran out before a search came to a track: one of lines and a bend that keeps "
               "every limit"
             : "every limit holds on a track of lines and a bend; no search led from there to a better one";
}

/// What is told where no track keeps the limits.
enum class Reasons { with_what_would_do, alone };

/// Whether an answer is the track of the search, and not one that took its place.
bool is_track_of(const Course& course, const Optimum& optimum) {
  return course.kept() && optimum.centerline == course.best().track;
}

/// The search itself, of a problem that is sound.
BriefEnd searched(const Problem& problem, const OptimizeOptions& options, Reasons reasons, Patience& patience,
                  SearchControl& control, const Progress& progress) {
  BriefEnd end;
  Optimum& optimum = end.optimum;
  OptimizeReport& report = optimum.report;
  report.objective = problem.objective;
  report.unlimited_travel_time = unlimited_travel_time(problem);

  std::optional<Conflict> at_once = beyond_reach(problem);
  // What would do at one end, or for one theorem, has to do along the whole track.
  const Resolve resolve = resolve_with(options, control);
  const auto would_do = [&](const LimitName& limit, double value) {
    const auto changed = with_bound(problem, limit, value);
    return !changed || (!too_close_at_an_end(*changed, {}) &&
                        resolve.anew(*changed, std::numeric_limits<int>::max(), {}));
  };
  if (!at_once) at_once = beside_mean_slope(problem, options.limit_tolerance, would_do);
  if (!at_once) at_once = on_other_side_at_an_end(problem);
  if (!at_once) at_once = too_close_at_an_end(problem, would_do);
  if (at_once) {
    tell_none(*std::move(at_once), true, false, report);
    return end;
  }
  if (const std::optional<Creep> creep = creep_at_best(problem)) {
    tell_creeping(problem, options, *creep, optimum);
    return end;
  }

  Course course(problem, options, control, progress);
  course.from_starts();
  course.onto_smoother_ground();
  Conflict conflict;
  bool certain = false;
  const bool by_footholds = !course.kept();
  if (!course.kept() && !course.stopped())
    conflict = course.explained(reasons == Reasons::alone ? Resolve{} : resolve, certain);
  course.look_again(by_footholds);
  course.from_straight_line();
  course.from_ramp();
  course.from_known();
  std::optional<KeptTrack> simple;
  // Who asks to stop before there is a track wants none.
  const bool may_answer = !course.stopped() || patience.out_of_time();
  if (!course.kept() && may_answer) simple = simple_track(problem, options.limit_tolerance);
  if (simple) course.from_track(*simple->track);
  report.ended_early = course.stopped();
  if (!course.kept() && simple) {
    answer_with_any(*simple, optimum);
    report.message = simple_text(course.stopped());
    return end;
  }
  if (!course.kept()) {
    tell_none(std::move(conflict), certain, course.stopped(), report);
    return end;
  }
  tell_track(course, options, control, progress, report);
  optimum.centerline = course.best().track;
  const bool is_exact = take_unlimited(problem, options, optimum);
  take_ramp(problem, options, optimum);
  tell_end(problem, options, course, patience.out_of_time(), is_exact, optimum);
  if (is_track_of(course, optimum)) end.foothold = course.foothold();
  end.objective = course.best().found->objective;
  return end;
}

/// The problem of the tracks that end before the place from which a lowest speed holds: it asks nothing of them.
/// @return none where there is no such place, or no track as short
std::optional<Problem> ending_before_lowest_speed(const Problem& problem) {
  constexpr double kBefore = 1e-6;  // accuracy: ten times that of a limit
  const Limits& limits = problem.limits;
  const double longest = limits.lowest_speed_from * (1.0 - kBefore);
  if (!limits.speed.lowest || limits.arc_length.lowest.value_or(0.0) > longest) return std::nullopt;
  const bool is_point = problem.finish.kind == FinishKind::point;
  const double distance = math::hypot(problem.endpoints.run, problem.endpoints.drop);
  if (!(longest > (is_point ? distance : limits.lead_in + limits.lead_out))) return std::nullopt;
  Problem shorter = problem;
  shorter.limits.speed.lowest.reset();
  shorter.limits.lowest_speed_from = 0.0;
  shorter.limits.arc_length.highest = std::min(limits.arc_length.highest.value_or(longest), longest);
  return shorter;
}

/// Whether a lowest speed is in the way of a track, or of a better one.
bool is_held_up_by_lowest_speed(const OptimizeReport& report) {
  return report.status != OptimizeStatus::optimal ||
         std::any_of(report.active.begin(), report.active.end(), [](const ActiveLimit& active) {
           return active.limit == LimitName{LimitId::speed, Bound::lowest};
         });
}

/// The better one of the tracks that are as fast as asked from a place on, and those that end before it: between the two lies none,
/// and no small step leads from one to the other.
BriefEnd better_with_those_before(const Problem& problem, BriefEnd end,
                                  const std::function<BriefEnd(const Problem&)>& searched_too) {
  if (end.optimum.report.ended_early || !is_held_up_by_lowest_speed(end.optimum.report)) return end;
  const std::optional<Problem> shorter = ending_before_lowest_speed(problem);
  if (!shorter) return end;
  BriefEnd before = searched_too(*shorter);
  if (!before.optimum.centerline || !(before.objective < end.objective)) return end;
  OptimizeReport& report = before.optimum.report;
  report.checks = check_limits(problem, before.optimum.centerline);
  // That it ends there is nobody's limit.
  if (shorter->limits.arc_length.highest != problem.limits.arc_length.highest) {
    std::erase_if(report.active, [](const ActiveLimit& active) {
      return active.limit == LimitName{LimitId::arc_length, Bound::highest};
    });
  }
  return before;
}

/// The search that goes on from a track it is given: no other starts, and no reasons where it leads to none.
BriefEnd searched_from(const Problem& problem, const OptimizeOptions& options, const Foothold& foothold,
                       Patience& patience, SearchControl& control, const Progress& progress) {
  BriefEnd end;
  Optimum& optimum = end.optimum;
  OptimizeReport& report = optimum.report;
  report.objective = problem.objective;
  report.unlimited_travel_time = unlimited_travel_time(problem);
  Course course(problem, options, control, progress);
  course.from(foothold);
  report.ended_early = course.stopped();
  if (!course.kept()) {
    tell_none({}, false, course.stopped(), report);
    return end;
  }
  tell_track(course, options, control, progress, report);
  optimum.centerline = course.best().track;
  tell_end(problem, options, course, patience.out_of_time(), false, optimum);
  if (is_track_of(course, optimum)) end.foothold = course.foothold();
  return end;
}

/// A track that ends where it is asked to. A search ends with the finish met as well as any limit is kept, mostly far better; with a
/// crest that turns within 1e-8 of the track it may stay at the former. Turned and scaled by what it misses the track meets it,
/// and keeps what it kept to as much.
void meet_finish(const Problem& problem, double tolerance, Optimum& optimum) {
  constexpr double kMet = 1e-10;  // accuracy: of the chord; a tenth of what tables come back to
  const auto* const spline = dynamic_cast<const ClothoidSpline*>(optimum.centerline.get());
  if (spline == nullptr || problem.finish.kind != FinishKind::point) return;
  const Vec2 asked{std::fabs(problem.endpoints.run), problem.endpoints.drop};
  const CenterlinePoint last = spline->at(spline->length());
  const Vec2 end{last.x, last.drop};
  if (!(norm(end - asked) > kMet * norm(asked))) return;
  const double scale = norm(asked) / norm(end);
  const double turn = math::atan2(cross(end, asked), dot(end, asked));
  std::vector<ClothoidSegment> segments = spline->segments();
  for (ClothoidSegment& segment : segments) {
    segment.length *= scale;
    segment.entry_curvature /= scale;
    segment.exit_curvature /= scale;
  }
  const Angle entry = Angle::from_radians(spline->entry_slope_angle().radians() + turn);
  const auto met = std::make_shared<const ClothoidSpline>(entry, std::move(segments));
  referee::Judgement judgement = referee::judge_track(problem, met, referee::kRefereeSamples);
  if (!judgement.arrived || judgement.worst > tolerance) return;
  for (ActiveLimit& active : optimum.report.active) {
    for (Stretch& stretch : active.where) stretch = {scale * stretch.from, scale * stretch.to};
  }
  optimum.centerline = met;
  optimum.report.travel_time = judgement.travel_time;
  optimum.report.exit_speed = judgement.exit_speed;
  optimum.report.checks = std::move(judgement.checks);
}

/// One search, of a problem that is sound.
/// @param foothold  that it goes on from; none: from its own starts
BriefEnd searched_once(const Problem& problem, const OptimizeOptions& options, Reasons reasons,
                       const std::stop_token& stop, const Progress& progress,
                       const Foothold* foothold = nullptr) {
  Patience patience(options.time_budget, stop);
  SearchControl control;
  control.limit_tolerance = 0.1 * options.limit_tolerance;
  control.stop = [&] { return patience.ends(); };
  BriefEnd end = foothold != nullptr ? searched_from(problem, options, *foothold, patience, control, progress)
                                     : searched(problem, options, reasons, patience, control, progress);
  if (foothold == nullptr) {
    end = better_with_those_before(problem, std::move(end), [&](const Problem& shorter) {
      return searched(shorter, options, Reasons::alone, patience, control, progress);
    });
  }
  meet_finish(problem, options.limit_tolerance, end.optimum);
  end.optimum.report.iterations = control.rounds;
  end.optimum.report.evaluations = control.evaluations;
  end.optimum.report.seconds = patience.seconds();
  return end;
}

/// Steps that follow the descents, as pricing, cut themselves short without a word.
Optimum with_stop_told(Optimum optimum, const std::stop_token& stop) {
  if (optimum.centerline && stop.stop_requested()) tell_stopped(optimum.report);
  return optimum;
}

/// What a search sets itself is nobody's to relax: only what the problem asks for has a price.
void leave_out_own(std::vector<ActiveLimit>& active) {
  std::erase_if(active,
                [](const ActiveLimit& one) { return entry_of(one.limit.id).form == LimitForm::of_search; });
}

/// optimize() of a problem that is sound, by the objective.
Optimum searched_by_objective(const Problem& problem, const OptimizeOptions& options,
                              const std::stop_token& stop, const Progress& progress) {
  if (is_least_bound(problem.objective.kind)) return least_bound(problem, options, stop, progress);
  if (problem.objective.kind == ObjectiveKind::least_peak_wear)
    return least_peak(problem, options, stop, progress);
  return searched_once(problem, options, Reasons::with_what_would_do, stop, progress).optimum;
}

}  // namespace

BriefEnd optimize_briefly(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
                          const Progress& progress) {
  const Problem allowed = with_mean_slope_allowed(problem, options.limit_tolerance);
  BriefEnd end = searched_once(allowed, options, Reasons::alone, stop, progress);
  end.optimum = with_stop_told(std::move(end.optimum), stop);
  return end;
}

BriefEnd optimize_from(const Problem& problem, const Foothold& foothold, const OptimizeOptions& options,
                       const std::stop_token& stop, const Progress& progress) {
  const Problem allowed = with_mean_slope_allowed(problem, options.limit_tolerance);
  BriefEnd end = searched_once(allowed, options, Reasons::alone, stop, progress, &foothold);
  end.optimum = with_stop_told(std::move(end.optimum), stop);
  return end;
}

}  // namespace optimizer

Optimum optimize(const Problem& given, const OptimizeOptions& options, const std::stop_token& stop,
                 const Progress& progress) {
  using namespace optimizer;
  require_searchable(given);
  require_valid(options);
  const Problem problem = with_mean_slope_allowed(with_true_changes(given), options.limit_tolerance);
  require_passable_in_order(problem);
  Optimum optimum = with_stop_told(searched_by_objective(problem, options, stop, progress), stop);
  leave_out_own(optimum.report.active);
  return optimum;
}

}  // namespace glissade
