#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/descent/search.hpp"
#include "optimize/mesh/held_arcs.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/mesh/switches.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "referee/judgement.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::optimizer {

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
  std::optional<double> finer_mesh_wins;  ///< pieces halved once would win, as a share of the objective
  double moves_promise = 0.0;             ///< MovedKnots::promised, as a share of the objective
  double sharper_crest_wins = 0.0;  ///< where a body at rest turns down at once, as a share of the objective
  Vector multipliers_ahead;         ///< of each limit on a finer mesh, as in Outlook; none if not looked at
};

/// By which a limit is tightened before anything asks for it, in scales.
[[nodiscard]] double least_margin(const LimitSpec& limit);

/// Searches coarse to fine, and goes on until the referee finds the limits kept.
class Searcher {
 public:
  Searcher(const Problem& problem, const OptimizeOptions& options, SearchControl& control,
           const Progress& progress)
      : problem_(problem), options_(options), control_(control), progress_(progress) {}

  /// A coarse track that breaks its limits by less is carried on to a finer mesh.
  static constexpr double kNearlyFeasible = 1e-3;  // taste

  struct Rough {
    std::optional<Found> found;
    bool got_lost = false;  ///< the descent did, and was led back by way of any track that keeps the limits
  };
  /// One way past the keep-outs as the first of the product's own starts shows it, on a coarse mesh.
  struct Opening {
    Candidate candidate;
    std::vector<GuessCurve> starts;
    Rough first;  ///< nothing where the search is to begin with the exact solution

    /// The objective to expect; huge where nothing keeps the limits.
    [[nodiscard]] double promise() const;
  };
  [[nodiscard]] Opening opened(const Passages& passages);
  /// From the product's own starts.
  /// @param to_beat  the best one by other ways: tracks that are plainly behind it are not searched to their end
  [[nodiscard]] Candidate search(Opening opening, const std::optional<Candidate>& to_beat = std::nullopt);
  [[nodiscard]] Candidate search(const Passages& passages) { return search(opened(passages)); }
  /// From a track that keeps the limits: carried_on() and ended(), or mended() where any track will do.
  [[nodiscard]] Candidate search_from(const Passages& passages, const Mesh& mesh, const Vector& z);
  /// A search from a track that keeps the limits, on its way: carried to the finer meshes, which tell how good it can be.
  struct Stage {
    Candidate candidate;
    Found found;
    Mesh mesh;  ///< of the track that it begins with
    Vector z;
  };
  [[nodiscard]] Stage carried_on(const Passages& passages, const Mesh& mesh, const Vector& z);
  /// The same to its end. Where it comes to nothing, the track that it begins with, mended.
  [[nodiscard]] Candidate ended(Stage stage);
  /// As carried_on(), on the mesh of the track alone and to a coarse tolerance: on the way to another problem's track.
  [[nodiscard]] Stage carried_along(const Passages& passages, const Mesh& mesh, const Vector& z);
  /// Another optimum of a candidate's own problem and margins, to its end.
  [[nodiscard]] Candidate ended_on(const Candidate& known, Found found);
  /// Where the search's own starts led to no optimum: the best of what `best` is and of what curves of no kind lead to.
  [[nodiscard]] Candidate from_scattered(Candidate best);
  /// Where tracks have to wind: the better one of what `best` is and of what the fastest track leads to while caps on the speed,
  /// far from it first, are drawn tight. Neighbouring problems take neighbouring ways.
  [[nodiscard]] Candidate from_loose_caps(Candidate best);
  /// Where a cap on the speed asks for bends: the better one of what `best` is and of what falls, rides at the cap and hooks
  /// between them lead to.
  [[nodiscard]] Candidate from_hooks(Candidate best);
  /// Where tracks wind at a cap on the speed: the same with bends elsewhere between the stretches that lie at the cap, as long
  /// as that pays.
  [[nodiscard]] Candidate with_shifted_bends(Candidate best);
  /// The search once more from where it ended, on meshes of other sizes laid for that track, until an optimum is found.
  /// @param for_better  goes on from there as long as that pays
  [[nodiscard]] Candidate on_other_meshes(Candidate best, bool for_better);
  /// What a candidate's promising track leads to on other meshes.
  [[nodiscard]] Candidate from_promising(const Candidate& known);
  /// Where a body at rest turns down at once: the same with bends ever tighter there, until that wins nothing.
  [[nodiscard]] Candidate with_sharper_crest(Candidate best);
  /// A track that keeps the limits on its mesh, mended so that it keeps them everywhere, however slow it is.
  [[nodiscard]] Candidate mended(const Passages& passages, const Mesh& mesh, const Vector& z);
  /// Where the search was asked to end before the referee had found any track to keep the limits: the best one that kept them
  /// at the stations of its mesh, mended in a few short rounds. @return one that keeps nothing where there was none
  [[nodiscard]] Candidate from_known();

 private:
  // Pieces of levels before the finest.
  static constexpr std::size_t kMiddlePieces = 16;  // taste: meshes grow by some 4/3
  static constexpr std::size_t kFinerPieces = 24;   // taste
  static constexpr double kCoarseTolerance = 1e-3;  // taste

  [[nodiscard]] Candidate begun(const Passages& passages);
  /// @param found  of the rough problem of a candidate
  void remember(const Candidate& candidate, const Found& found);
  /// On the very problems of another one, which tracks found for it refer to.
  [[nodiscard]] Candidate begun_again(const Candidate& known);
  /// Limits that nothing has tightened yet.
  void begin_margins(const ScaledProblem& problem);
  /// Only what every track obeys: the mesh can then be laid by the exact solution.
  [[nodiscard]] bool is_unlimited() const;
  [[nodiscard]] static double core_length_of(const Found& found) { return found.track->core_length(found.z); }
  /// The mesh of a track found, for the same unknowns: laid by its length, unless changes of friction hold it in place.
  [[nodiscard]] static Mesh mesh_again(const Found& found);
  [[nodiscard]] Mesh mesh_with(const ScaledProblem& problem, Vector knots, double core_length) const;
  [[nodiscard]] std::optional<Found> from_exact(const ScaledProblem& problem, const GuessCurve& start);
  [[nodiscard]] Rough coarse(const ScaledProblem& problem, const GuessCurve& start);
  /// On a mesh laid for the start alone.
  [[nodiscard]] Found coarsely(const ScaledProblem& problem, const GuessCurve& start, std::size_t pieces);
  /// A track, and the problem that it is of.
  struct Tightened {
    std::shared_ptr<const ScaledProblem> problem;
    Found found;
  };
  /// From the fastest track over caps far from it to that of the caps themselves. @return none where the way ends before
  [[nodiscard]] std::optional<Tightened> tightened(const std::shared_ptr<const ScaledProblem>& rough,
                                                   const std::vector<std::size_t>& caps);
  /// On their finest meshes, the best one first.
  [[nodiscard]] std::vector<Found> tracks_with_hooks(const ScaledProblem& problem);
  /// @param shares  of the stretch that a bend goes into, one after the other
  [[nodiscard]] Candidate with_shifted_bends(Candidate best, const Vector& shares);
  /// The best of the tracks with a bend elsewhere, and so on from there. @return none where none is better
  /// @param shares  as above
  [[nodiscard]] std::optional<Found> bends_shifted(const ScaledProblem& problem, const Found& known,
                                                   const Vector& shares);
  /// @return whether a search on a mesh ended in a better track than the best one, which it is then
  bool ends_better(const Mesh& mesh, const Vector& z, Candidate& best);
  /// Whether a track is plainly behind the one to beat, whatever finer meshes win.
  [[nodiscard]] bool is_behind(const Found& found, bool on_finest) const;
  /// From every start, where the first one's track is doubted: the best of them, then others until one is an optimum.
  void take_best(Candidate& candidate, Found first, const std::vector<GuessCurve>& more,
                 std::vector<Found>& others);
  /// By way of any track that keeps the limits. @return nothing where none comes close
  [[nodiscard]] std::optional<Found> rescued(const ScaledProblem& problem, const Mesh& mesh,
                                             const Vector& beginning);
  /// Finer meshes, then tightening until the referee is content.
  void refine(Candidate& candidate, Found found, bool unlimited);
  /// What follows on the finest mesh of pieces.
  void settle(Candidate& candidate, Found found);
  /// Meshes of more and more pieces, the last of them only while the places at which limits change over move, and it
  /// pays.
  /// @param rough  of the meshes before those of all pieces
  [[nodiscard]] Found on_finer_meshes(const ScaledProblem& problem, const ScaledProblem& rough, Found found);
  /// From an optimum of the rough problem to that of the problem itself.
  [[nodiscard]] Found exactly(const ScaledProblem& problem, Found found);
  /// The search on a mesh laid for a track, once more by way of any track that keeps the limits if it gets lost.
  [[nodiscard]] Found on_mesh(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                              const Found& known);
  /// The same track with a curvature that follows the limits on loads and the caps on the speed which it lies at.
  [[nodiscard]] Found followed(const ScaledProblem& problem, Found found);
  /// The same with caps on the speed held where the track exceeds them between its stations. It comes before jumps and bends are
  /// moved: they would go where stations miss what is exceeded.
  [[nodiscard]] Found held_between(const ScaledProblem& problem, Found found);
  /// The same, jumps of the curvature that lie far from where they belong brought there.
  [[nodiscard]] Found with_far_jumps_moved(const ScaledProblem& problem, Found found);
  /// Where exit speed counts a last bend over a crest, where the track carries less, may win it: too short a bend for the
  /// usual pieces to tell.
  [[nodiscard]] Found bent_at_finish(const ScaledProblem& problem, Found found);
  /// The same with shorter ramps for jumps of the curvature, where that is better.
  [[nodiscard]] Found with_short_ramps(const ScaledProblem& problem, Found found);
  /// The same with jumps of the curvature where they belong, in rounds. @return none where they are there
  /// @param found  with tighter corners and shorter ramps afterwards
  [[nodiscard]] std::optional<Found> with_jumps_at_rest(const ScaledProblem& problem, Found& found);
  /// The same with corners ever tighter where no radius is asked for, as long as that pays: how tight they are would be up to the mesh.
  [[nodiscard]] Found with_tight_corners(const ScaledProblem& problem, Found found);
  /// Pieces are halved where a finer mesh has much left to win.
  [[nodiscard]] Found halved(const ScaledProblem& problem, Found found);

  /// The search once more on a mesh laid by the length found, until both agree, where friction changes along the
  /// track: a mesh knows the changes on the track that it was laid for, and where it stretches curvature goes on
  /// across the last of them only at that length.
  [[nodiscard]] Found laid_anew(const ScaledProblem& problem, Found found);
  /// The mesh for that, and the track on it.
  [[nodiscard]] MeshTrack relaid(const ScaledProblem& problem, const Found& found) const;

  /// The end of it, in a candidate that keeps nothing yet.
  void mend_any(Candidate& candidate, const Mesh& mesh, const Vector& z);
  /// A track that keeps the limits on a mesh, however slow it is.
  [[nodiscard]] Found kept_on(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning);
  /// Lets the referee judge and mends what it finds, round by round.
  /// @param places  at which limits are held beside the stations from the beginning, of the core's length
  void mend(Candidate& candidate, Found found, const Vector& places = {});
  /// Of the tracks on that way the best one counts.
  void take_if_better(Candidate& candidate, const Found& found, const CenterlinePtr& track,
                      const referee::Judgement& judgement) const;
  /// Where holding limits at further places made an optimum much dearer: that one, or the optimum on a mesh whose pieces are halved
  /// around these places. A piece of one linear curvature that broke a limit within may keep it at a price that two don't pay.
  [[nodiscard]] Found cheaper_of(const ScaledProblem& problem, Found next, const Found& found,
                                 const Mesh& holding);
  /// A curvature that follows the load more closely where a body lifts off.
  /// @return nothing where that takes no further knots, or no optimum is found with them
  [[nodiscard]] std::optional<Found> following_closely(const ScaledProblem& problem, const Found& found,
                                                       const std::vector<LiftOff>& lifts);
  void tighten(const ScaledProblem& problem, const referee::Judgement& judgement,
               const std::vector<LiftOff>& lifts, int round);
  [[nodiscard]] std::vector<double> places_to_hold(const ScaledProblem& problem,
                                                   const referee::Judgement& judgement, int round) const;
  [[nodiscard]] bool is_optimum(const Found& found) const {
    return !found.stopped && found.residual <= options_.tolerance && found.feasible(options_.limit_tolerance);
  }

  /// What the next descents are to reach.
  void aim_at(double tolerance, int most_rounds) {
    control_.tolerance = tolerance;
    control_.most_rounds = most_rounds;
  }
  void tell(std::string_view stage, double fraction) const {
    if (progress_) progress_(stage, fraction);
  }

  const Problem& problem_;
  const OptimizeOptions& options_;
  SearchControl& control_;
  const Progress& progress_;
  /// As of from_known(), the best ones first.
  std::vector<std::pair<Candidate, Found>> known_;
  std::optional<double> to_beat_;          ///< objective of the best track by other ways
  std::optional<double> finer_mesh_wins_;  ///< as last looked at
  double moves_promise_ = 0.0;             ///< as last looked at
  Vector multipliers_ahead_;               ///< as last looked at
  Vector margins_;                         ///< by which the limits are tightened, in scales
};

}  // namespace glissade::optimizer
