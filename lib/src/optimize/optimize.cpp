// The facade: searches on every way past the keep-outs, and explains the end.

#include "glissade/optimize/optimize.hpp"

#include "optimize/end_conflict.hpp"
#include "optimize/infeasibility.hpp"
#include "optimize/least_bound.hpp"
#include "optimize/prices.hpp"
#include "optimize/scaled_problem.hpp"
#include "optimize/searcher.hpp"
#include "optimize/starts.hpp"

#include <chrono>
#include <functional>
#include <optional>

namespace glissade {
namespace optimizer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostPassages = 16;  // budget: 2^4 ways past four keep-outs

/// Every combination of sides for the keep-outs that leave it open, up to kMostPassages.
std::vector<Passages> all_passages(const Limits& limits) {
  std::vector<Passages> all{{}};
  for (const KeepOut& keep_out : limits.keep_outs) {
    std::vector<Passages> longer;
    for (const Passages& begun : all) {
      for (const Passage side : {Passage::above, Passage::below}) {
        if (keep_out.passage != Passage::either && keep_out.passage != side) continue;
        // Beyond the cap the earlier keep-outs have branched already; the later ones go above.
        if (keep_out.passage == Passage::either && side == Passage::below && all.size() >= kMostPassages)
          continue;
        Passages passages = begun;
        passages.push_back(side);
        longer.push_back(std::move(passages));
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string none_found_text(const std::vector<std::string>& nearly) {
  std::string text = "no track was found that keeps every limit, and no conflict between them is certain";
  for (std::size_t i = 0; i < nearly.size(); ++i) {
    if (i == 0) text += "; the closest one breaks ";
    if (i > 0) text += i + 1 == nearly.size() ? " and " : ", ";
    text += nearly[i];
  }
  return text;
}

/// "faster", as an adjective of what is searched for.
const char* better_text(const Objective& objective) {
  switch (objective.kind) {
    case ObjectiveKind::least_drop:
      return "lower";
    case ObjectiveKind::least_length:
      return "shorter";
    default:
      return "faster";
  }
}

}  // namespace
}  // namespace optimizer

Optimum optimize(const Problem& problem, const OptimizeOptions& options, const std::stop_token& stop,
                 const Progress& progress) {
  using namespace optimizer;
  require_searchable(problem);
  require_passable_in_order(problem);
  require_valid(options);
  if (is_least_bound(problem.objective.kind)) return least_bound(problem, options, stop, progress);
  const auto begin = Clock::now();
  SearchControl control;
  control.limit_tolerance = 0.1 * options.limit_tolerance;
  bool out_of_time = false;
  bool stopped = false;
  control.stop = [&] {
    if (stop.stop_requested()) return true;
    out_of_time = std::chrono::duration<double>(Clock::now() - begin).count() > options.time_budget;
    return out_of_time;
  };

  Optimum optimum;
  OptimizeReport& report = optimum.report;
  report.objective = problem.objective;
  report.unlimited_travel_time = unlimited_travel_time(problem);
  const auto finish = [&] {
    report.ended_early = stopped;
    report.iterations = control.rounds;
    report.evaluations = control.evaluations;
    report.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  };

  std::optional<Conflict> at_once = beyond_reach(problem);
  if (!at_once) at_once = too_close_at_an_end(problem);
  if (const std::optional<Conflict>& conflict = at_once) {
    report.status = OptimizeStatus::infeasible;
    report.conflict = *conflict;
    report.message = conflict->text;
    finish();
    return optimum;
  }

  Searcher searcher(problem, options, control, progress);
  std::optional<Candidate> best;
  const std::vector<Passages> all = all_passages(problem.limits);
  for (const Passages& passages : all) {
    Candidate candidate = searcher.search(passages);
    stopped = stopped || candidate.stopped;
    const bool better = !best || (candidate.kept && !best->kept) ||
                        (candidate.kept && best->kept && candidate.found->objective < best->found->objective);
    if (better) best = std::move(candidate);
    if (stopped) break;
  }

  std::optional<Conflict> conflict;
  std::vector<std::string> nearly;
  if (!best->kept && !stopped) {
    control.most_rounds = 10;
    Explanation explanation = explain(problem, all, control);
    conflict = std::move(explanation.conflict);
    nearly = std::move(explanation.nearly);
    if (!conflict && !explanation.z.empty()) {
      best = searcher.search_from(all[explanation.passages], explanation.mesh, explanation.z);
    }
    stopped = best->stopped || control.stop();
  }

  if (best->kept) {
    const Found& found = *best->found;
    optimum.centerline = best->track;
    report.travel_time = best->judgement.travel_time;
    report.exit_speed = best->judgement.exit_speed;
    report.checks = best->judgement.checks;
    report.first_order_residual = found.residual;
    report.active = active_limits(*best->problem, priced(*best->problem, found, options, control));
    const bool converged = found.residual <= options.tolerance && !stopped;
    report.status = converged ? OptimizeStatus::optimal : OptimizeStatus::feasible_not_converged;
    if (converged) {
      report.message =
          std::string("every limit holds and no neighbouring track is ") + better_text(problem.objective);
    } else if (stopped) {
      report.message =
          out_of_time ? "the time budget ran out: the best track so far" : "stopped: the best track so far";
    } else {
      report.message = "every limit holds, but the first-order residual stayed above its tolerance";
    }
  } else if (stopped && !conflict) {
    report.status = OptimizeStatus::no_track_found;
    report.message = "ended early, before any track kept every limit";
  } else {
    if (conflict) {
      report.status = OptimizeStatus::infeasible;
      report.conflict = *conflict;
      report.message = conflict->text;
    } else {
      report.status = OptimizeStatus::no_track_found;
      report.message = none_found_text(nearly);
    }
  }
  finish();
  return optimum;
}

}  // namespace glissade
