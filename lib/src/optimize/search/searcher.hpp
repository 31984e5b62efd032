#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "optimize/search/candidate.hpp"
#include "optimize/search/descents.hpp"
#include "optimize/search/mending.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::optimizer {

/// Searches coarse to fine, and goes on until the referee finds the limits kept: which descents from where, and which of their ends
/// counts. How a track gets on on one mesh is in Descents, what becomes of it on the finest one in Settling, what the
/// referee has to say in Mending.
class Searcher {
 public:
  Searcher(const Problem& problem, const OptimizeOptions& options, SearchControl& control,
           const Progress& progress)
      : problem_(problem),
        options_(options),
        control_(control),
        progress_(progress),
        descents_(options, control),
        mending_(problem, descents_, progress) {}
  Searcher(const Searcher&) = delete;
  Searcher& operator=(const Searcher&) = delete;

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
  /// Where a finer mesh promises so much that it is not believed: the better one of what `best` is and of what finer meshes lead to as long as
  /// they keep part of it.
  [[nodiscard]] Candidate with_promises_tried(Candidate best);
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
  /// The same as Candidate::on_problems_of().
  [[nodiscard]] Candidate begun_again(const Candidate& known);
  /// Only what every track obeys: the mesh can then be laid by the exact solution.
  [[nodiscard]] bool is_unlimited() const;
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
  /// Starts to other runs of a free finish that lead to tracks as low or short as the first one's, or nearly so.
  [[nodiscard]] std::vector<GuessCurve> promising_runs(const ScaledProblem& problem, const Found& first);
  /// From every start, where the first one's track is doubted: the best of them, then others until one is an optimum.
  void take_best(Candidate& candidate, Found first, const std::vector<GuessCurve>& more,
                 std::vector<Found>& others);
  /// Finer meshes, then tightening until the referee is content.
  void refine(Candidate& candidate, Found found, bool unlimited);
  /// What follows on the finest mesh of pieces, and its end: as Settling, then Mending.
  void settle(Candidate& candidate, Found begun, Promises promises = Promises::left);
  /// Meshes of more and more pieces, the last of them only while the places at which limits change over move, and it
  /// pays.
  /// @param rough  of the meshes before those of all pieces
  [[nodiscard]] Found on_finer_meshes(const ScaledProblem& problem, const ScaledProblem& rough, Found found);
  /// The end of it, in a candidate that keeps nothing yet: as Mending.
  void mend_any(Candidate& candidate, const Mesh& mesh, const Vector& z);
  void tell(std::string_view stage, double fraction) const {
    if (progress_) progress_(stage, fraction);
  }

  const Problem& problem_;
  const OptimizeOptions& options_;
  SearchControl& control_;
  const Progress& progress_;
  /// As of from_known(), the best ones first.
  std::vector<std::pair<Candidate, Found>> known_;
  std::optional<double> to_beat_;  ///< objective of the best track by other ways
  Descents descents_;
  Mending mending_;
};

}  // namespace glissade::optimizer
