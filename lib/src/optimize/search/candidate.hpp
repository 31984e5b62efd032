#pragma once

#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "referee/judgement.hpp"

#include <memory>
#include <optional>

namespace glissade::optimizer {

/// What lies ahead of a track on its finest mesh, as last looked at there: what other meshes would win.
struct Ahead {
  std::optional<double> finer_mesh_wins;  ///< pieces halved once would win, as a share of the objective
  double moves_promise = 0.0;             ///< MovedKnots::promised, as a share of the objective
  Vector multipliers;  ///< of each limit on a finer mesh, as in Outlook; none if not looked at
};

/// Of the objective, that a finer mesh promises to win: more is not believed.
inline constexpr double kMostPromised = 0.01;  // taste: twice what any promised that kept part of it
/// Whether so much of it is promised at the end of a search that this is doubted. Of a sum of unlike things, and of an integral that may be
/// next to none, no share tells.
/// @param share  of the objective
[[nodiscard]] inline bool promises_too_much(const ScaledProblem& problem, double share) {
  constexpr double kMost = 2e-3;  // measured: no track of 900 random problems is left with as much
  const bool is_sum = problem.time_weight != 0.0 && problem.speed_weight != 0.0;
  return share > kMost && !is_sum && problem.rides.front().even_speed == 0.0;
}
/// What is done where a finer mesh promises more than that.
enum class Promises { left, tried };

/// One way past the keep-outs, searched to its end.
struct Candidate {
  std::shared_ptr<ScaledProblem> problem;
  std::shared_ptr<ScaledProblem> rough;  ///< what the search began with, as of roughly_scaled()
  std::optional<Found> found;            ///< none where no start came close to keeping the limits
  /// That of the rough problem which led to it, before the referee saw it: what goes on from there goes the same way wherever
  /// the problem lies, and whatever its unit.
  std::optional<Found> rough_found;
  /// A better optimum of the rough problem with which no track came to its end: another mesh may bring it there.
  std::optional<Found> promising;
  CenterlinePtr track;
  referee::Judgement judgement;
  bool kept = false;  ///< the referee finds every limit kept
  bool stopped = false;
  Ahead ahead;                      ///< of `found`
  double sharper_crest_wins = 0.0;  ///< where a body at rest turns down at once, as a share of the objective

  /// On the very problems of another one, which tracks found for it refer to; nothing is found yet.
  [[nodiscard]] static Candidate on_problems_of(const Candidate& known) {
    Candidate candidate;
    candidate.problem = known.problem;
    candidate.rough = known.rough;
    return candidate;
  }
};

}  // namespace glissade::optimizer
