#pragma once

#include "optimize/conflicts/foothold.hpp"
#include "optimize/descent/least_violation.hpp"
#include "optimize/problem/passages.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

// Tracks that break limits least: all of them together, or one alone while the others hold.

namespace glissade::optimizer {

// Below this the limits count as met: finer meshes win that much.
inline constexpr double kContradiction = 1e-5;  // accuracy: a hundred times that of a limit
// Below this a finer mesh may make up for what is left.
inline constexpr double kNearly = 0.005;  // taste

/// A track that breaks limits least, and the mesh that it lies on.
struct Attempt {
  std::shared_ptr<ScaledProblem> problem;
  Mesh mesh;
  Relaxed relaxed;
};

/// The least by which one limit must give way when all others hold: from the track that breaks all of them
/// least; where that descent loses its way, from the straight line.
/// @return none where no descent ends with the others kept
[[nodiscard]] std::optional<Relaxed> relaxed_alone(const Attempt& attempt, const Elastic& elastic,
                                                   SearchControl& control);

/// That one limit alone gives way.
[[nodiscard]] Elastic alone_of(const std::vector<LimitSpec>& limits, const LimitName& name);

/// The problem on every way past the keep-outs, as roughly_scaled() has it.
[[nodiscard]] std::vector<std::shared_ptr<ScaledProblem>> roughly_scaled_ways(
    const Problem& problem, const std::vector<Passages>& passages);

/// Curves that a search may begin with.
using Curves = std::vector<GuessCurve> (*)(const ScaledProblem&);

/// The tracks that have one limit alone give way, from curves of every kind and on every way past the keep-outs. What
/// its bound is has no part in which of them has it give way least.
class Winding {
 public:
  /// @param ways  past the keep-outs; they, and the control, outlive it
  Winding(const std::vector<std::shared_ptr<ScaledProblem>>& ways, const LimitName& limit,
          SearchControl& control)
      : ways_(ways), limit_(limit), control_(control) {}

  /// From all curves.
  void descend_all();

  /// From one of them. @return whether the limit need not give way at all there
  [[nodiscard]] bool descend_from(const Beginning& beginning);

  /// Those that need it not give way at all, the best first.
  [[nodiscard]] std::vector<Foothold> footholds() const;

  /// Whose curves have it give way least.
  [[nodiscard]] std::vector<Beginning> best_beginnings() const;

  /// Where a descent ended, the other limits kept.
  struct End {
    Beginning beginning;
    Attempt attempt;
  };
  /// The one that has it give way least.
  [[nodiscard]] const End* least() const { return ends_.empty() ? nullptr : &ends_.front(); }

 private:
  static constexpr double kKept = 1e-6;  // accuracy: ten times that of a limit

  [[nodiscard]] std::vector<GuessCurve> curves_on(std::size_t way) const;

  void sort();

  [[nodiscard]] Relaxed relaxed(const ScaledProblem& problem, const Mesh& mesh,
                                const GuessCurve& curve) const;

  void descend(const Beginning& beginning, const GuessCurve& curve);

  void follow(End& end);

  const std::vector<std::shared_ptr<ScaledProblem>>& ways_;
  LimitName limit_;
  SearchControl& control_;
  std::vector<End> ends_;
};

/// The search for the least violation on every way past the keep-outs, from one start after the other. What keeps all
/// limits on its mesh has to lead to a track that keeps them everywhere; where it does not, the search goes on.
class LeastViolation {
 public:
  /// @param leads  outlives it, and so does the control
  LeastViolation(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                 SearchControl& control)
      : leads_(leads), control_(control), ways_(roughly_scaled_ways(problem, passages)) {}

  /// @return whether a track was found that keeps all limits
  bool from(Curves curves_of, StepModel model = StepModel::curved);

  /// From a track on its own mesh. @return as above
  bool from(std::size_t way, const Mesh& mesh, const GuessCurve& curve, StepModel model = StepModel::curved);

  /// From a track that all but keeps the limits: what is left over may go as the mesh follows the track. @return as above
  bool from_near(std::size_t way, const Mesh& mesh, const GuessCurve& curve);

  /// Once more from the best one, on finer meshes where it breaks limits by much. @return as above
  bool closely();

  /// Whether no step lowers the least violation, or the search from its end lowers it no further.
  [[nodiscard]] bool confirmed();

  /// Whether a track was found that keeps all limits.
  [[nodiscard]] bool found() const { return found_; }
  /// Whether there were tracks that keep all limits on their mesh, but led nowhere.
  [[nodiscard]] bool astray() const { return !found_ && best_ && best_->relaxed.t <= kContradiction; }
  /// The least that limits are broken by, and on which way. @pre from() has been called
  [[nodiscard]] const Attempt& best() const { return *best_; }
  [[nodiscard]] std::size_t way() const { return way_; }
  [[nodiscard]] const std::vector<std::shared_ptr<ScaledProblem>>& ways() const { return ways_; }

 private:
  /// @return as above
  bool ends_at(std::size_t way, Attempt attempt);

  /// An end that nearly kept all limits on its first mesh: what it comes to on finer ones is known.
  struct NearEnd {
    std::size_t way = 0;
    double t = 0.0;
    double objective = 0.0;
  };
  [[nodiscard]] bool is_new(std::size_t way, const Relaxed& relaxed);

  const Leads& leads_;
  SearchControl& control_;
  std::vector<std::shared_ptr<ScaledProblem>> ways_;
  std::vector<NearEnd> near_ends_;
  std::optional<Attempt> best_;
  std::size_t way_ = 0;
  bool found_ = false;
};

}  // namespace glissade::optimizer
