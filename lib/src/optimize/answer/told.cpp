#include "optimize/answer/told.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"

#include "optimize/conflicts/energy_left.hpp"
#include "optimize/prices/prices.hpp"
#include "optimize/search/shifted_bends.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::optimizer {
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

}  // namespace

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
  if (converged && !is_exact &&
      promises_too_much(*course.best().problem, report.finer_mesh_wins.value_or(0.0))) {
    report.status = OptimizeStatus::feasible_not_converged;
    report.message =
        "every limit holds, but a finer mesh promises to win " +
        rounded_text(100.0 * *report.finer_mesh_wins, 2) +
        " %, and none that was tried did: a better track is likely; try bounds a little tighter, whose track "
        "keeps these, too";
    return;
  }
  // Answers to neighbouring problems of the kind were out of order by up to 1.7e-3 (docs/optimization.md).
  const bool winds = converged && winds_at_cap(*course.best().problem, *course.best().found);
  if (winds) report.message += "; with bends elsewhere at the cap on the speed some 0.2 % may be left";
}

void tell_none(Conflict conflict, bool certain, bool stopped, OptimizeReport& report) {
  report.status = certain ? OptimizeStatus::infeasible : OptimizeStatus::no_track_found;
  if (stopped) {
    report.message = "ended early, before any track kept every limit";
    return;
  }
  report.message = certain ? conflict.text : none_found_text(conflict);
  report.conflict = std::move(conflict);
}

}  // namespace glissade::optimizer
