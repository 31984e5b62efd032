#pragma once

#include "glissade/task/limits.hpp"

#include "optimize/algebra/dense.hpp"

#include <vector>

namespace glissade::optimizer {

class EnvelopeRows;
struct LimitSpec;
struct Row;
struct ScaledProblem;
struct State;
struct StationWeights;
class Transcription;

/// A row, and everything that its value depends on.
struct RowAt {
  const ScaledProblem& problem;
  const Transcription& track;
  const EnvelopeRows& envelope;
  const State& state;
  const LimitSpec& limit;
  const Row& row;
};

/// What a limit is about: one scalar at each of its places, with exact first and second derivatives by the
/// unknowns. One object a measure, without state; docs/development.md tells how a limit gets one.
///
/// Second derivatives come in two parts: through the state (position, slope, squared speed, time: `add_weights`, which
/// the transcription turns into a Hessian) and those that are not (`add_terms`).
class Measure {
 public:
  constexpr Measure() = default;
  Measure(const Measure&) = delete;
  Measure& operator=(const Measure&) = delete;
  virtual ~Measure() = default;

  [[nodiscard]] virtual double value(const RowAt& at) const = 0;
  /// @param out  the gradient, zero before
  virtual void gradient(const RowAt& at, double* out) const = 0;
  /// What `factor` times the value weighs the stations with.
  virtual void add_weights(const RowAt&, double /*factor*/, StationWeights&) const {}
  virtual void add_terms(const RowAt&, double /*factor*/, Matrix& /*hessian*/) const {}

  /// Every row of the limit, in the order of its rides and places.
  /// @param at  of the limit's first row
  virtual void add_rows(const RowAt& at, std::vector<Row>& rows) const = 0;
  /// The row where a limit of one value is met exactly.
  /// @param row  at the last station
  virtual void set_exact_row(Row& /*row*/) const {}
  /// @return arc length of the row's place
  [[nodiscard]] virtual double place(const RowAt& at) const;

  /// Whether value and bound are squared speeds, the limit's bound and scale speeds.
  [[nodiscard]] virtual bool is_squared() const { return false; }
  /// Whether a limit of one value is met at both ends of the friction range.
  [[nodiscard]] virtual bool is_met_at_each_end_of_range() const { return false; }
  /// Whether it can bind along a stretch, whose ends are then looked for (switches.cpp).
  [[nodiscard]] virtual bool holds_along() const { return false; }
  /// Whether it is a load, whose curvature where it binds is not linear in arc length (held_arcs.cpp).
  [[nodiscard]] virtual bool is_load() const { return false; }

  static const Measure* const entry_slope_angle;
  static const Measure* const exit_slope_angle;
  static const Measure* const slope_angle;
  static const Measure* const curvature;  ///< positive in a valley
  static const Measure* const curvature_rate;
  static const Measure* const normal_load;
  static const Measure* const curvature_load;
  static const Measure* const speed;
  static const Measure* const exit_speed;
  static const Measure* const exit_run_speed;  ///< the level part of the exit speed
  static const Measure* const arc_length;
  static const Measure* const finish_coordinate;  ///< whichever is free
  static const Measure* const distance;           ///< from an obstacle, positive on its free side
  static const Measure* const waypoint;           ///< distance of the track from a point
  static const Measure* const span_length;        ///< of each span, over what it began with
  static const Measure* const arrival;  ///< squared speed over that of free fall through the arc length
};

/// @return what the search measures for a limit that is one number
[[nodiscard]] const Measure* measure_of(LimitId id);

}  // namespace glissade::optimizer
