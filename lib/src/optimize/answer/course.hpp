#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include "optimize/conflicts/infeasibility.hpp"
#include "optimize/problem/passages.hpp"
#include "optimize/search/candidate.hpp"
#include "optimize/search/searcher.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// One problem's search: which tracks it is begun from, on which way past the keep-outs, and which of their ends counts. Each step
/// goes on from what those before it found, and does nothing once the search was asked to stop.
class Course {
 public:
  Course(const Problem& problem, const OptimizeOptions& options, SearchControl& control,
         const Progress& progress)
      : problem_(problem),
        options_(options),
        control_(control),
        progress_(progress),
        searcher_(problem, options, control, progress) {}

  /// From the product's own starts, the promising ways first.
  void from_starts();

  /// Where a track is found: those that go on to smoother ground, which the starts may miss.
  void onto_smoother_ground();

  /// Where the straight line keeps every limit no answer is slower: the search from there, or that line itself.
  void from_straight_line();

  /// The same of tracks that are to be low or short: where the steepest ramp keeps every limit none is higher, or longer.
  void from_ramp();

  /// The search from a track that was made without one, and keeps the limits.
  void from_track(const Centerline& track);

  /// From a track that keeps the limits.
  void from(const Foothold& foothold);

  /// From several, of which the best one counts. On their way there they tell which can be that.
  void from(const std::vector<Foothold>& footholds);

  /// Where the search was asked to end, whatever it was at: what it has come by on its way.
  void from_known();

  /// What became of a track that was to be the best one.
  enum class Onto { untried, no_better, taken };
  /// From the best one to another optimum of its problem, where that wins something.
  Onto onto(Found found);

  /// Where a body at rest turns down at once: the same track, ever tighter there.
  void sharpen_crest();

  /// Where the starts did not simply lead to an optimum: how good a track is depends on its mesh there.
  /// @param by_footholds  whether the starts led nowhere
  void look_again(bool by_footholds);

  /// Where bends are looked for.
  void from_likely(const std::vector<Beginning>& likely);

  /// Where the limits lead none of the starts to a track that keeps them: tracks that do, if there are any.
  void from_footholds(bool bends);

  /// @return what stands in the way, if no track keeps all limits
  [[nodiscard]] Conflict explained(const Resolve& resolve, bool& certain);

  /// @pre from_starts() or another search has come to its end
  [[nodiscard]] const Candidate& best() const { return *best_; }
  /// The best track, to go on from. @pre kept()
  [[nodiscard]] Foothold foothold() const {
    return {way_, Mesh(best_->found->track->mesh()), best_->found->z};
  }
  /// Whether there is a track that keeps every limit.
  [[nodiscard]] bool kept() const { return best_ && best_->kept; }
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  static constexpr int kFarRounds = 10;  // budget

  [[nodiscard]] bool is_about_exit_speed() const {
    return problem_.objective.kind == ObjectiveKind::exit_speed;
  }

  [[nodiscard]] static bool is_on_limits(const Searcher::Stage& stage);

  /// What a way out of a conflict is tried with: whether one of some footholds leads to a track.
  [[nodiscard]] Leads leads();

  /// The search from a straight line, by every way, or that line itself, while the best track is behind it.
  /// @param finish  of the line [m]
  void from_line(Vec2 finish, const std::function<bool()>& is_behind);

  [[nodiscard]] bool is_fastest() const { return problem_.objective.kind == ObjectiveKind::travel_time; }
  /// Whether it is plain that the straight line is no better.
  /// @param share  of a time
  [[nodiscard]] bool has_straight_line_behind(double share) const;

  /// A better track than the best one that came to no end there.
  void look_at_promising();

  /// An end becomes the best one if it is better.
  void take(std::size_t way, Candidate candidate);

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

}  // namespace glissade::optimizer
