#pragma once

#include "optimize/algebra/sqp.hpp"
#include "optimize/discretise/transcription.hpp"
#include "optimize/problem/envelope_rows.hpp"
#include "optimize/problem/measure.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <compare>
#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// One scalar condition on the unknowns: a limit at one place, for one friction.
struct Row {
  std::size_t limit = 0;
  std::size_t ride = 0;
  std::size_t place = 0;  ///< station; knot (fine ones behind the others) or piece; corner of a foot row
  std::size_t edge = 0;   ///< of an obstacle's chain; of a row around it, the corner
  bool foot = false;      ///< measured at the foot of a corner instead of at a station
  bool around = false;    ///< measured from a corner to a station
  bool face = false;      ///< of an envelope: measured at a corner of the end face at that station
  std::size_t level = 0;  ///< of an envelope: 0 at the underside, 1 at the top

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 within a defaulted <=> for a pointer.
  friend auto operator<=>(const Row&, const Row&) = default;
};

/// Everything at one point of the search.
struct State {
  Vector z;
  Shape shape;
  std::vector<Flow> flows;
  /// The station at which the track comes closest to each waypoint, passing them in their order.
  std::vector<std::size_t> waypoint_stations;
  EnvelopeRows::Zones zones;  ///< where the end planes may cut an envelope
  /// Of the corners of each obstacle, as they are asked for: value, gradient and curvature of a row all need them.
  mutable std::vector<std::vector<std::optional<Foot>>> feet;
  /// @return the place in `feet` of one of an obstacle's corners
  [[nodiscard]] std::optional<Foot>& corner_foot(const ScaledProblem& problem, std::size_t obstacle,
                                                 std::size_t corner) const {
    if (feet.empty()) feet.resize(problem.obstacles.size());
    std::vector<std::optional<Foot>>& known = feet[obstacle];
    const Obstacle& of = problem.obstacles[obstacle];
    if (known.empty()) known.resize(of.corners.size() + of.other_corners.size());
    return known[corner];
  }

  /// From the start to the finish, whichever of them the shape's positions count from.
  [[nodiscard]] double run() const { return shape.x.back() - shape.x.front(); }
  [[nodiscard]] double drop() const { return shape.y.back() - shape.y.front(); }
};

/// What a run or a drop from the start to the finish weighs the stations with.
inline void weigh_across(Vector& weights, double factor) {
  weights.back() += factor;
  weights.front() -= factor;
}

/// The limits of a problem as rows over one transcription. Inequalities are kept where value <= 0, in units
/// of the limit's scale.
class Rows {
 public:
  Rows(const ScaledProblem& problem, const Transcription& track);

  [[nodiscard]] State state(const Vector& z, bool derivatives) const;
  /// Adds the derivatives to a state without.
  void add_derivatives(State& state) const;

  [[nodiscard]] double objective(const State& state) const;
  /// @return the squared speed at the finish that the objective counts, at any friction that it is of
  [[nodiscard]] double speed_counted(const State& state) const;
  [[nodiscard]] Vector objective_gradient(const State& state) const;

  [[nodiscard]] std::size_t equality_count() const { return equality_limits_.size() + fixed_equalities_; }
  /// Finish, straight ends, limits of one value, waypoints.
  void equalities(const State& state, Vector& value, Matrix& jacobian) const;
  [[nodiscard]] Vector equality_values(const State& state) const;
  /// @return the limit behind an equality row, or none for the finish and the straight ends
  [[nodiscard]] const std::size_t* limit_of_equality(std::size_t row) const;

  /// Every inequality row there is, that is within `band` of its bound or beyond it.
  /// @param values  theirs, where asked for
  [[nodiscard]] std::vector<Row> candidates(const State& state, double band, Vector* values = nullptr) const;
  [[nodiscard]] double value(const State& state, const Row& row) const;
  void gradient(const State& state, const Row& row, double* out) const;
  /// arc length of the row's place
  [[nodiscard]] double place(const State& state, const Row& row) const;

  /// Tightens limits by `margin` [scale], one entry a limit.
  void set_margins(Vector margins) { margins_ = std::move(margins); }
  [[nodiscard]] const Vector& margins() const { return margins_; }

  /// The Lagrangian's Hessian; of distances from corners, what curvature the track has between its foot and
  /// the station next to it is left out.
  /// @param objective  multiplier of the objective
  [[nodiscard]] Matrix hessian(const State& state, const Vector& equality, const std::vector<Row>& rows,
                               const Vector& inequality, double objective) const;

  /// What the Lagrangian asks of each station, for its Hessian.
  [[nodiscard]] StationWeights weights(const State& state, const Vector& equality,
                                       const std::vector<Row>& rows, const Vector& inequality,
                                       double objective) const;

 private:
  /// out += factor times the derivatives of a run or a drop from the start to the finish
  void add_across(const Derivatives& derivatives, double factor, double* out) const;
  /// By how much the row is tightened [scale].
  [[nodiscard]] double margin(const Row& row) const;
  [[nodiscard]] Row row_of_equality(std::size_t index) const;
  [[nodiscard]] RowAt at(const State& state, const LimitSpec& limit, const Row& row) const {
    return {problem_, track_, envelope_, state, limit, row};
  }
  /// The channel's width over that at the start, to the limit's power, and its derivatives by the core's length.
  struct WidthFactor {
    double value = 1.0;
    double first = 0.0;
    double second = 0.0;
  };
  [[nodiscard]] WidthFactor width_factor(const State& state, const LimitSpec& limit, const Row& row) const;
  [[nodiscard]] double measure(const State& state, const LimitSpec& limit, const Row& row) const;
  void measure_gradient(const State& state, const LimitSpec& limit, const Row& row, double* out) const;
  void add_measure_weights(const State& state, const LimitSpec& limit, const Row& row, double factor,
                           StationWeights& weights) const;
  void add_direct_terms(const State& state, const LimitSpec& limit, const Row& row, double factor,
                        Matrix& hessian) const;
  /// Whether clearances are measured from more than the centerline.
  [[nodiscard]] bool has_envelope() const { return problem_.envelope_high > problem_.envelope_low; }
  [[nodiscard]] double effective_bound(const LimitSpec& limit) const;
  [[nodiscard]] double effective_scale(const LimitSpec& limit) const;

  const ScaledProblem& problem_;
  const Transcription& track_;
  EnvelopeRows envelope_;
  std::vector<std::pair<std::size_t, std::size_t>> equality_limits_;  ///< limit, ride
  std::size_t fixed_equalities_ = 0;
  std::optional<double> entry_cosine_;  ///< where one value is the entry slope angle's
  Vector margins_;
};

}  // namespace glissade::optimizer
