// What the search does where its own starts led to no optimum, or to tracks that wind: it looks once more.

#include "optimize/mesh/refined_knots.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/mesh/switches.hpp"
#include "optimize/search/hooked_starts.hpp"
#include "optimize/search/searcher.hpp"
#include "optimize/search/settling.hpp"
#include "optimize/search/shifted_bends.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

/// An optimum before what is none and hardly better, else the better one.
bool is_ahead(const Candidate& a, const Candidate& b, double tolerance) {
  // As little of the objective is worth less than to know how good a track is.
  constexpr double kHardly = 1e-4;  // taste
  const bool is_optimum = a.found->residual <= tolerance;
  const double better = b.found->objective - a.found->objective;
  const bool counts = std::fabs(better) <= kHardly * std::fabs(b.found->objective);
  if (counts && is_optimum != (b.found->residual <= tolerance)) return is_optimum;
  return better > 0.0;
}

/// What the search goes on from.
const Found& begun_with(const Candidate& best) {
  return best.rough_found ? *best.rough_found : *best.found;
}

}  // namespace

Candidate Searcher::from_scattered(Candidate best) {
  constexpr std::size_t kMostEnded = 3;                           // budget
  const std::shared_ptr<const ScaledProblem> rough = best.rough;  // which the tracks below refer to
  std::vector<Found> tracks;
  for (const GuessCurve& start : scattered_starts(*rough)) {
    if (control_.stop()) break;
    descents_.begin_margins(*rough);
    descents_.aim_at(kCoarseTolerance, 5);
    Found found = coarsely(*rough, start, kMiddlePieces);
    const bool may_win = found.feasible(kNearlyFeasible) && found.objective < best.found->objective;
    if (may_win) tracks.push_back(std::move(found));
  }
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const Found& a, const Found& b) { return a.objective < b.objective; });
  if (tracks.size() > kMostEnded) tracks.resize(kMostEnded);
  for (Found& track : tracks) {
    if (best.stopped) break;
    Candidate end = begun_again(best);
    const Found found =
        descents_.laid_anew(*end.rough, on_finer_meshes(*end.rough, *end.rough, std::move(track)));
    settle(end, found);
    if (!end.kept && !end.stopped) mend_any(end, found.track->mesh(), found.z);
    const bool stopped = end.stopped;
    if (end.kept && is_ahead(end, best, options_.tolerance)) best = std::move(end);
    best.stopped = stopped;
  }
  return best;
}

Candidate Searcher::with_promises_tried(Candidate best) {
  constexpr int kMostRounds = 4;  // budget
  for (int round = 0; round < kMostRounds; ++round) {
    const double promised = best.ahead.finer_mesh_wins.value_or(0.0);
    if (best.stopped || !best.found || !promises_too_much(*best.problem, promised)) break;
    const double before = best.found->objective;
    Candidate end = begun_again(best);
    settle(end, begun_with(best), Promises::tried);
    const bool stopped = end.stopped;
    if (end.kept && is_ahead(end, best, options_.tolerance)) best = std::move(end);
    best.stopped = stopped;
    if (!(best.found->objective < before)) break;
  }
  return best;
}

namespace {

/// Limits that keep a body from being fast.
std::vector<std::size_t> caps_on_speed(const ScaledProblem& problem) {
  std::vector<std::size_t> caps;
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    const bool is_speed = limit.measure == Measure::exit_run_speed || limit.measure == Measure::speed ||
                          limit.measure == Measure::exit_speed;
    if (is_speed && limit.side > 0) caps.push_back(i);
  }
  return caps;
}

/// @param share  by which the caps are higher
std::shared_ptr<const ScaledProblem> with_looser(const std::shared_ptr<const ScaledProblem>& problem,
                                                 const std::vector<std::size_t>& caps, double share) {
  if (share == 0.0) return problem;
  auto looser = std::make_shared<ScaledProblem>(*problem);
  for (const std::size_t cap : caps) looser->limits[cap].bound *= 1.0 + share;
  return looser;
}

}  // namespace

Candidate Searcher::from_loose_caps(Candidate best) {
  const std::vector<std::size_t> caps = caps_on_speed(*best.rough);
  if (caps.empty() || best.stopped) return best;
  descents_.begin_margins(*best.rough);
  std::optional<Tightened> track = tightened(best.rough, caps);
  if (!track) return best;
  Candidate end = begun_again(best);
  settle(end, descents_.laid_anew(*end.rough,
                                  on_finer_meshes(*end.rough, *track->problem, std::move(track->found))));
  const bool stopped = end.stopped;
  if (end.kept && is_ahead(end, best, options_.tolerance)) best = std::move(end);
  best.stopped = stopped;
  return best;
}

std::optional<Searcher::Tightened> Searcher::tightened(const std::shared_ptr<const ScaledProblem>& rough,
                                                       const std::vector<std::size_t>& caps) {
  constexpr double kSteps = 20.0;      // measured: with 12 one of five such problems ends in a worse valley
  constexpr double kMostShare = 1.0;   // taste: caps of twice their bound hardly ever bind
  constexpr int kMostHalvings = 8;     // budget
  constexpr double kMostSlower = 0.4;  // taste: slower by such a share after one step a track has got lost
  double root = 1.0;
  double step = 1.0 / kSteps;
  Tightened track{with_looser(rough, caps, kMostShare), {}};
  std::optional<Found> begun = coarse(*track.problem, starts(*rough).front()).found;
  if (!begun) return std::nullopt;
  track.found = std::move(*begun);
  for (int halvings = 0; root > 0.0;) {
    if (control_.stop()) return std::nullopt;
    // Shorter and shorter steps: bends come up all at once, where the caps are nearly met.
    const double next_root = std::max(0.0, root - step);
    Tightened next{with_looser(rough, caps, kMostShare * next_root * next_root), {}};
    descents_.aim_at(kCoarseTolerance, 8);
    const Mesh mesh =
        mesh_with(*next.problem, refined_knots(*track.found.track, track.found.z, {}, kFinerPieces),
                  core_length_of(track.found));
    const Vector beginning = fit(curve_of(*track.found.track, track.found.z), Transcription(mesh));
    next.found = descents_.minimised(*next.problem, mesh, beginning, &track.found);
    const double slower = next.found.objective - track.found.objective;
    if (next.found.feasible(kNearlyFeasible) && slower <= kMostSlower * std::fabs(track.found.objective)) {
      track = std::move(next);
      root = next_root;
    } else if (++halvings > kMostHalvings) {
      return std::nullopt;
    } else {
      step *= 0.5;
    }
  }
  return track;
}

std::vector<Found> Searcher::tracks_with_hooks(const ScaledProblem& problem) {
  constexpr std::size_t kPieces = 56;  // measured: with 40 three tracks end 0.3 to 0.5 % slower
  const double before_core = problem.lead_in + 0.5 * problem.entry_speed2;
  std::vector<Found> tracks;
  for (const GuessCurve& start : hooked_starts(problem)) {
    if (control_.stop()) break;
    descents_.begin_margins(problem);
    descents_.aim_at(kCoarseTolerance, 12);
    const Mesh mesh =
        mesh_with(problem, graded_knots(start, kPieces, before_core / start.length), start.length);
    const Vector beginning = fit(start, Transcription(mesh));
    std::optional<Found> found = descents_.minimised(problem, mesh, beginning);
    if (!found->feasible(kNearlyFeasible)) found = descents_.rescued(problem, mesh, beginning);
    if (!found) continue;
    found = descents_.laid_anew(problem, on_finer_meshes(problem, problem, *std::move(found)));
    const bool is_known = std::any_of(tracks.begin(), tracks.end(), [&](const Found& track) {
      constexpr double kSame = 1e-6;  // accuracy: that of a time
      return std::fabs(track.objective - found->objective) <= kSame * std::fabs(track.objective);
    });
    if (!is_known && found->feasible(kNearlyFeasible)) tracks.push_back(*std::move(found));
  }
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const Found& a, const Found& b) { return a.objective < b.objective; });
  return tracks;
}

Candidate Searcher::from_hooks(Candidate best) {
  constexpr double kBehind = 2e-3;  // taste: of the objective; what follows may win as much
  constexpr double kMuch = 1e-4;  // taste: for less of the objective it is not worth the way to other meshes
  constexpr double kPays = 1e-6;  // accuracy: that of a time
  constexpr std::size_t kMostEnded = 2;                           // budget
  const std::shared_ptr<const ScaledProblem> rough = best.rough;  // which the tracks below refer to
  const auto wins = [&](double objective, double share) {
    return best.found->objective - objective > share * std::fabs(best.found->objective);
  };
  std::vector<Found> tracks = tracks_with_hooks(*rough);
  if (tracks.size() > kMostEnded) tracks.resize(kMostEnded);
  for (Found& track : tracks) {
    if (best.stopped || !wins(track.objective, -kBehind)) break;
    Candidate end = begun_again(best);
    settle(end, std::move(track));
    const bool may_win = end.kept && !end.stopped && wins(end.found->objective, kMuch);
    if (may_win && !descents_.is_optimum(*end.found)) end = on_other_meshes(std::move(end), false);
    const bool stopped = end.stopped;
    const bool takes = end.kept && is_ahead(end, best, options_.tolerance);
    const bool pays = takes && wins(end.found->objective, kPays);
    if (takes) best = std::move(end);
    best.stopped = stopped;
    if (pays) break;
  }
  return best;
}

Candidate Searcher::with_shifted_bends(Candidate best) {
  // Of the stretch that a bend goes into. What the widest ones led to is an answer before narrower ones change it.
  best = with_shifted_bends(std::move(best), {0.4, 0.1, 0.025});  // taste
  return with_shifted_bends(std::move(best), {0.00625});          // taste: the next of them
}

Candidate Searcher::with_shifted_bends(Candidate best, const Vector& shares) {
  constexpr int kMostRounds = 3;  // budget
  constexpr double kPays = 1e-5;  // accuracy: ten times that of a time
  if (!best.kept || best.stopped) return best;
  // What makes a track a little better waits until its bends lie where they belong.
  std::optional<Found> shifted;
  for (int round = 0; round < kMostRounds; ++round) {
    const Found& from = shifted ? *shifted : begun_with(best);
    const double before = from.objective;
    std::optional<Found> next = bends_shifted(*best.rough, from, shares);
    if (!next) break;
    shifted = std::move(next);
    if (before - shifted->objective < kPays * std::fabs(before)) break;
  }
  if (!shifted) return best;
  Candidate end = begun_again(best);
  settle(end, descents_.laid_anew(*end.rough, std::move(*shifted)));
  const bool stopped = end.stopped;
  if (end.kept && is_ahead(end, best, options_.tolerance)) best = std::move(end);
  best.stopped = stopped;
  return best;
}

std::optional<Found> Searcher::bends_shifted(const ScaledProblem& problem, const Found& known,
                                             const Vector& shares) {
  constexpr int kMostSteps = 6;           // budget
  constexpr double kPays = 1e-6;          // accuracy: that of a time
  constexpr int kMostEvaluations = 6000;  // budget: twice what a hard search takes
  descents_.begin_margins(problem);
  const int begun = control_.evaluations;
  const auto is_spent = [&] { return control_.stop() || control_.evaluations - begun > kMostEvaluations; };
  // What is gone too fast between stations would be won by bends that put stations elsewhere.
  Settling settling(problem, descents_);
  Found best = settling.held_between(known);
  std::vector<Vector> tried;  // the same beginnings come back where stretches are short
  const auto wins = [&](std::size_t bend, double share) {
    const std::vector<Span> stretches = stretches_at_cap(problem, best);
    if (bend + 1 >= stretches.size() || is_spent()) return false;
    const MeshTrack begun_with = with_shifted_bend(best, stretches[bend], stretches[bend + 1], share);
    if (std::find(tried.begin(), tried.end(), begun_with.mesh.knots) != tried.end()) return false;
    tried.push_back(begun_with.mesh.knots);
    Mesh mesh = mesh_of(problem, begun_with.mesh.knots, begun_with.mesh.core_length);
    if (mesh.knots.size() != begun_with.mesh.knots.size()) return false;  // friction changes elsewhere, too
    mesh.fine = begun_with.mesh.fine;
    mesh.fine_turns = begun_with.mesh.fine_turns;
    descents_.aim_at_optimum(3);
    Found next = descents_.minimised(problem, mesh, begun_with.z);
    const auto is_better = [&] {
      return descents_.is_optimum(next) &&
             best.objective - next.objective > kPays * std::fabs(best.objective);
    };
    if (is_better()) next = settling.held_between(std::move(next));
    const bool does = is_better();
    if (!does) return false;
    best = std::move(next);
    tried.clear();
    return true;
  };
  bool won = false;
  for (std::size_t bend = 0; bend + 1 < stretches_at_cap(problem, best).size(); ++bend) {
    for (const double share : shares) {
      int steps = 0;
      for (const double way : {share, -share}) {
        while (steps < kMostSteps && wins(bend, way)) ++steps;
        if (steps > 0) break;
      }
      // What follows loads went along; here and there it may lie better now.
      if (steps > 0) best = settling.followed(std::move(best));
      won = won || steps > 0;
    }
  }
  return won ? std::optional(std::move(best)) : std::nullopt;
}

Candidate Searcher::on_other_meshes(Candidate best, bool for_better) {
  constexpr std::size_t kPieces[] = {24, 32, 40, 60};  // taste
  constexpr std::size_t kMostForBetter = 40;           // budget
  constexpr std::size_t kMostKnots = 70;               // budget
  constexpr int kMostEvaluations = 3000;               // budget: as many as a hard search takes
  constexpr double kPays = 1e-4;                       // taste: of the objective
  const auto is_known = [&] { return best.found->residual <= options_.tolerance; };
  const int before = control_.evaluations;
  // The track's own mesh, without the places at which limits were held beside it, is another one, too.
  if (!is_known() && best.found->track->mesh().knots.size() <= kMostKnots) {
    const Found& from = begun_with(best);
    Mesh mesh = mesh_again(from);
    mesh.extra_breaks.clear();
    (void)ends_better(mesh, Vector(from.z), best);
  }
  for (const std::size_t pieces : kPieces) {
    if (best.stopped || control_.stop() || control_.evaluations - before > kMostEvaluations) break;
    const bool was_known = is_known();
    if (was_known && (!for_better || pieces > kMostForBetter)) break;
    const Found& from = begun_with(best);
    const double known = best.found->objective;
    const std::vector<Switch> switches = switches_of(*best.rough, from);
    const Mesh mesh =
        mesh_with(*best.rough, refined_knots(*from.track, from.z, switches, pieces), core_length_of(from));
    if (mesh.knots.size() > kMostKnots) continue;
    const bool better = ends_better(mesh, fit(curve_of(*from.track, from.z), Transcription(mesh)), best);
    const double won = better ? known - best.found->objective : 0.0;
    if (was_known && won < kPays * std::fabs(known)) break;
  }
  return best;
}

Candidate Searcher::from_promising(const Candidate& known) {
  Candidate candidate = begun_again(known);
  candidate.found = known.promising;
  candidate.found->residual = HUGE_VAL;  // as yet
  return on_other_meshes(std::move(candidate), false);
}

bool Searcher::ends_better(const Mesh& mesh, const Vector& z, Candidate& best) {
  Candidate end = begun_again(best);
  descents_.aim_at_optimum(12);
  Found next = descents_.laid_anew(*end.rough, descents_.on_mesh(*end.rough, mesh, z, begun_with(best)));
  if (next.feasible(kNearlyFeasible)) settle(end, std::move(next));
  best.stopped = end.stopped;
  if (!end.kept || !is_ahead(end, best, options_.tolerance)) return false;
  best = std::move(end);
  return true;
}

Candidate Searcher::with_sharper_crest(Candidate best) {
  constexpr int kMostRounds = 8;    // budget
  constexpr double kPays = 5e-7;    // accuracy: half that of a time
  constexpr double kNearly = 1e-3;  // accuracy: half its square is half that of a time
  constexpr double kMuch = 2e-6;    // taste: worth a descent that takes its time
  const ScaledProblem& problem = *best.problem;
  if (!starts_with_crest(problem) || !best.kept || best.stopped || !descents_.is_optimum(*best.found))
    return best;
  // One that the last digits keep from being an optimum may lead to one that is.
  Candidate last = best;
  for (int round = 0; round < kMostRounds; ++round) {
    const Found known = *last.found;
    const MeshTrack sharper = with_shorter_beginning(*known.track, known.z);
    const auto next_from = [&](bool is_close) {
      descents_.set_margins(known.rows->margins());
      descents_.aim_at_optimum(0);
      control_.is_close = is_close;
      Found next = descents_.minimised(problem, sharper.mesh, sharper.z, &known);
      const bool goes_on = !next.stopped && next.residual <= kNearly && next.feasible(kNearlyFeasible) &&
                           next.objective < known.objective;
      last.kept = false;
      last.found.reset();
      if (goes_on) mending_.mend(last, next, best.ahead, sharper.mesh.extra_breaks);
      control_.is_close = false;
      return goes_on ? (known.objective - next.objective) / std::fabs(known.objective) : 0.0;
    };
    const auto is_sharper = [&](double residual) {
      return last.kept && !last.stopped && last.found->residual <= residual &&
             last.found->objective < known.objective;
    };
    double won = next_from(true);
    if (!is_sharper(kNearly) || (!is_sharper(options_.tolerance) && won > kMuch))
      won = std::max(won, next_from(false));
    // Each quarter wins half of what is left.
    if (is_sharper(options_.tolerance)) {
      best = last;
      best.sharper_crest_wins = won;
    } else {
      best.sharper_crest_wins = std::max(best.sharper_crest_wins, 2.0 * won);
    }
    if (!is_sharper(kNearly) || won < kPays) break;
  }
  return best;
}

}  // namespace glissade::optimizer
