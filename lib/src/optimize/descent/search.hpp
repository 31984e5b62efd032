#pragma once

#include "optimize/discretise/guess.hpp"
#include "optimize/problem/rows.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// Searches aim at this share of the residual that is allowed: where rounding keeps them from it, they have ended well.
inline constexpr double kAimed = 0.1;  // taste

/// What a search may cost, and who may end it.
struct SearchControl {
  double tolerance = 1e-7;        ///< of the residual
  double limit_tolerance = 1e-8;  ///< of every row
  int most_rounds = 12;
  bool any_track = false;  ///< the first track that keeps all limits ends the search, however slow it is
  bool is_close = false;   ///< Newton steps from where it begins get there, or nothing does
  std::function<bool()> stop = [] { return false; };
  int evaluations = 0;  ///< counted up
  int rounds = 0;       ///< counted up
};

/// The end of a search on one mesh: a point, its multipliers, and how good it is.
struct Found {
  std::shared_ptr<const Transcription> track;
  std::shared_ptr<Rows> rows;
  Vector z;
  double objective = 0.0;
  double residual = 0.0;   ///< norm of the Lagrangian's gradient over that of the objective's, scaled metric
  double violation = 0.0;  ///< greatest of all rows, in scales
  Vector equality;         ///< multipliers
  std::vector<Row> active;
  Vector inequality;  ///< multipliers of `active`
  bool stopped = false;

  [[nodiscard]] bool feasible(double tolerance) const { return violation <= tolerance; }
};

/// Minimises on one mesh from z. `margins` tighten the limits, one entry a limit.
/// @param known  an optimum of the same problem on another mesh, close to z: its multipliers are the first guess
[[nodiscard]] Found minimise(const ScaledProblem& problem, const Mesh& mesh, const Vector& z,
                             const Vector& margins, SearchControl& control, const Found* known = nullptr);

/// The optimum on a mesh to second order in what it differs by from one that is known on another mesh, at a fraction of the
/// cost: multipliers to some 1e-4 of themselves, the point to 1e-8 of a step. Residual and violation are not those of that
/// point. @return none where programs in turn do not get there at once
[[nodiscard]] std::optional<Found> approximated(const ScaledProblem& problem, const Mesh& mesh,
                                                const Vector& z, const Vector& margins,
                                                SearchControl& control, const Found& known);

/// One quadratic program at a point: what its step would change.
/// `known` as for minimise().
struct Outlook {
  Vector step;
  Vector force;      ///< the Lagrangian's gradient at the point, with the program's multipliers
  double won = 0.0;  ///< by which the step lowers the objective, to second order
  Vector
      by_limit;  ///< multipliers of the program, those of each limit's rows together; none where it has no solution
};
/// Which rows the program has.
enum class RowsAhead {
  near,   ///< those close to their bounds: a far one may take back what is promised, a step round it may not
  broken  ///< those, too, that its step would break
};
[[nodiscard]] Outlook look_ahead(const ScaledProblem& problem, const Mesh& mesh, const Vector& z,
                                 const Vector& margins, SearchControl& control, const Found& known,
                                 RowsAhead rows);

/// Slope angle over arc length of an iterate.
[[nodiscard]] GuessCurve curve_of(const Transcription& track, const Vector& z);

}  // namespace glissade::optimizer
