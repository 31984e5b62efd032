// The facade: what is asked of a course, in which order, and what is answered.

#include "glissade/optimize/optimize.hpp"

#include "glissade/core/math.hpp"
#include "glissade/motion/laws/most_wear.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "optimize/answer/course.hpp"
#include "optimize/answer/substitute.hpp"
#include "optimize/answer/told.hpp"
#include "optimize/conflicts/end_conflict.hpp"
#include "optimize/conflicts/energy_left.hpp"
#include "optimize/conflicts/infeasibility.hpp"
#include "optimize/conflicts/mean_slope.hpp"
#include "optimize/conflicts/reach_conflict.hpp"
#include "optimize/least_bound/least_bound.hpp"
#include "optimize/least_bound/least_peak.hpp"
#include "optimize/least_bound/optimize_briefly.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/search/patience.hpp"
#include "optimize/search/simple_tracks.hpp"
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

/// optimize() of a problem that is sound and has all its frictions, by the objective.
Optimum searched_by_objective(const Problem& problem, const OptimizeOptions& options,
                              const std::stop_token& stop, const Progress& progress) {
  if (is_least_bound(problem.objective.kind)) return least_bound(problem, options, stop, progress);
  if (problem.objective.kind == ObjectiveKind::least_peak_wear)
    return least_peak(problem, options, stop, progress);
  return searched_once(problem, options, Reasons::with_what_would_do, stop, progress).optimum;
}

/// A friction inside the range at which the track found wears more than at those that were searched with, and as much as matters.
std::optional<Friction> wearing_more(const Problem& problem, const Optimum& optimum) {
  constexpr double kApart = 1e-3;  // taste: next to a friction that is known a flat peak is hardly higher
  // What keeps a friction that no row of a program knows falls short of the bound.
  constexpr double kNear = 0.8;  // taste: of a bound that may bind
  const bool is_least = problem.objective.kind == ObjectiveKind::least_peak_wear;
  const std::optional<double>& highest = problem.limits.highest_floor_wear;
  if (!optimum.centerline || optimum.report.ended_early || (!is_least && !highest)) return {};
  const Friction low = problem.low_friction.value_or(problem.body.friction);
  const Friction high = problem.high_friction.value_or(problem.body.friction);
  const auto most = friction_of_most_wear(optimum.centerline, problem.body, problem.gravity, low, high);
  if (!most) return {};
  const std::vector<LimitCheck>& checks = optimum.report.checks;
  const auto wear = std::find_if(checks.begin(), checks.end(), [](const LimitCheck& check) {
    return check.limit.id == LimitId::highest_floor_wear;
  });
  if (!is_least && (wear == checks.end() || wear->reached < kNear * *highest)) return {};
  std::vector<Friction> known = problem.further_frictions;
  known.push_back(problem.body.friction);
  const bool is_known = std::any_of(known.begin(), known.end(), [&](const Friction& friction) {
    return std::fabs(friction.coefficient() - most->coefficient()) <= kApart * most->coefficient();
  });
  return is_known ? std::nullopt : most;
}

/// The search, once more with each friction at which its track wears more than it has seen. All of them lead to tracks that keep
/// every limit all over the range: what was found before counts where the next one did not converge, or is slower.
Optimum searched_over_range(Problem problem, const OptimizeOptions& options, const std::stop_token& stop,
                            const Progress& progress) {
  constexpr int kMostFrictions = 4;  // budget
  Optimum best = searched_by_objective(problem, options, stop, progress);
  std::optional<Friction> more = wearing_more(problem, best);
  for (int round = 0; more && round < kMostFrictions; ++round) {
    problem.further_frictions.push_back(*more);
    Optimum next = searched_by_objective(problem, options, stop, progress);
    next.report.iterations += best.report.iterations;
    next.report.evaluations += best.report.evaluations;
    next.report.seconds += best.report.seconds;
    const bool is_worse = !next.centerline || (next.report.status != OptimizeStatus::optimal &&
                                               best.report.status == OptimizeStatus::optimal);
    const bool is_slower = problem.objective.kind == ObjectiveKind::travel_time &&
                           !problem.objective.worst_case && best.report.status == OptimizeStatus::optimal &&
                           next.report.travel_time > best.report.travel_time;
    if (is_worse || is_slower) break;
    best = std::move(next);
    more = wearing_more(problem, best);
  }
  return best;
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
  Optimum optimum = with_stop_told(searched_over_range(problem, options, stop, progress), stop);
  leave_out_own(optimum.report.active);
  return optimum;
}

}  // namespace glissade
