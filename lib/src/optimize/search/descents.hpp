#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/descent/search.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <optional>
#include <utility>

namespace glissade::optimizer {

/// A coarse track that breaks its limits by less is carried on to a finer mesh.
inline constexpr double kNearlyFeasible = 1e-3;  // taste
/// A track that breaks them by more, on one mesh after the other or round by round, is given up.
inline constexpr double kHopeless = 1e-5;  // accuracy: a hundred times that of a limit

/// By which a limit is tightened before anything asks for it, in scales.
[[nodiscard]] double least_margin(const LimitSpec& limit);

/// Whether the fastest track would turn down at once from where a limit on the entry holds it: a body at rest
/// loses nothing by that, the tighter the crest the better, and no crest is the tightest. How tight it may be is
/// then up to the mesh, which has to be the same there for every such problem.
[[nodiscard]] bool starts_with_crest(const ScaledProblem& problem);

[[nodiscard]] inline double core_length_of(const Found& found) {
  return found.track->core_length(found.z);
}
/// The mesh of a track found, for the same unknowns: laid by its length, unless changes of friction hold it in place.
[[nodiscard]] Mesh mesh_again(const Found& found);
/// The mesh of these knots, with those of a crest at its start.
/// @param knots        in shares of the core
/// @param core_length  [chords]
[[nodiscard]] Mesh mesh_with(const ScaledProblem& problem, Vector knots, double core_length);

/// Descents from a track to an optimum on one mesh, all with the margins of one search: by which each limit is held tighter
/// than it is asked for. What they are to reach is aimed at before, and holds until something else is.
class Descents {
 public:
  Descents(const OptimizeOptions& options, SearchControl& control) : options_(options), control_(control) {}

  [[nodiscard]] const OptimizeOptions& options() const { return options_; }
  [[nodiscard]] SearchControl& control() { return control_; }

  /// One entry a limit of the problem, in scales.
  [[nodiscard]] const Vector& margins() const { return margins_; }
  void set_margins(Vector margins) { margins_ = std::move(margins); }
  /// Limits that nothing has tightened yet.
  void begin_margins(const ScaledProblem& problem);

  /// What the next descents are to reach.
  /// @param tolerance  of the residual
  void aim_at(double tolerance, int most_rounds);
  /// An optimum, as the search tells it.
  void aim_at_optimum(int most_rounds) { aim_at(kAimed * options_.tolerance, most_rounds); }
  [[nodiscard]] bool is_optimum(const Found& found) const {
    return !found.stopped && found.residual <= options_.tolerance && found.feasible(options_.limit_tolerance);
  }

  /// minimise() with the margins.
  [[nodiscard]] Found minimised(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                                const Found* known = nullptr);
  /// The same from so close that Newton steps get there, or nothing does.
  [[nodiscard]] Found minimised_closely(const ScaledProblem& problem, const Mesh& mesh,
                                        const Vector& beginning, const Found& known);
  /// A track that keeps the limits on a mesh, however slow it is.
  [[nodiscard]] Found kept_on(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning);
  /// By way of any track that keeps the limits. @return nothing where none comes close
  [[nodiscard]] std::optional<Found> rescued(const ScaledProblem& problem, const Mesh& mesh,
                                             const Vector& beginning);
  /// The search on a mesh laid for a track, once more by way of any track that keeps the limits if it gets lost.
  [[nodiscard]] Found on_mesh(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                              const Found& known);
  /// From an optimum of the rough problem to that of the problem itself.
  [[nodiscard]] Found exactly(const ScaledProblem& problem, Found found);
  /// The search once more on a mesh laid by the length found, until both agree, where friction changes along the
  /// track: a mesh knows the changes on the track that it was laid for, and where it stretches curvature goes on
  /// across the last of them only at that length.
  [[nodiscard]] Found laid_anew(const ScaledProblem& problem, Found found);

 private:
  const OptimizeOptions& options_;
  SearchControl& control_;
  Vector margins_;
};

}  // namespace glissade::optimizer
