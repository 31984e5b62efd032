#include "optimize/prices/one_sided_prices.hpp"

#include "core/float_limits.hpp"
#include "optimize/algebra/quadratic_program.hpp"
#include "optimize/descent/programs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace glissade::optimizer {
namespace {

// A row this close to its bound may begin to bind; by so much bounds are moved, in scales.
constexpr double kTouches = 1e-6;  // accuracy: ten times that of a limit
constexpr double kMoved = 1e-7;    // accuracy: that of a limit
// A kink is as wide however little bounds are moved; prices that change fast with a bound are as close as it was moved little.
constexpr double kMovedLess = 0.1 * kMoved;  // taste
constexpr double kAsWide = 0.5;              // theory: between one and a tenth
// Prices this far apart are two, ...
constexpr double kPricesApart = 0.04;  // accuracy: twice that of a price
// ... if they lie apart by this share of the greatest multiplier: what costs next to nothing changes fast.
constexpr double kCounts = 1e-5;  // taste

/// The quadratic program at an optimum, with the bound of one limit moved.
class MovedPrograms {
 public:
  MovedPrograms(const ScaledProblem& problem, const Found& found)
      : problem_(problem), found_(found), rows_(*found.rows), state_(rows_.state(found.z, true)) {
    set_ = rows_.candidates(state_, kTouches);
    for (const Row& row : found.active) {
      if (std::find(set_.begin(), set_.end(), row) == set_.end()) set_.push_back(row);
    }
  }

  /// Whether a row is tight and carries nothing: else the multipliers are unique.
  [[nodiscard]] bool may_have_kinks() const {
    return std::any_of(set_.begin(), set_.end(), [&](const Row& row) { return !carries(row); });
  }

  /// The limits of which a row is tight, each name once.
  [[nodiscard]] std::vector<LimitName> names() const {
    std::vector<LimitName> names;
    const auto add = [&](std::size_t limit) {
      const LimitSpec& spec = problem_.limits[limit];
      if (!spec.built_in && std::find(names.begin(), names.end(), spec.name) == names.end())
        names.push_back(spec.name);
    };
    for (const Row& row : set_) add(row.limit);
    for (std::size_t i = 0; i < rows_.equality_count(); ++i) {
      if (const std::size_t* const limit = rows_.limit_of_equality(i)) add(*limit);
    }
    return names;
  }

  void prepare() {
    program_.gradient = rows_.objective_gradient(state_);
    rows_.equalities(state_, program_.equality_value, program_.equality);
    const std::size_t n = program_.gradient.size();
    program_.inequality = jacobian_of(rows_, state_, set_, n);
    program_.inequality_value = values_of(rows_, state_, set_);
    const Matrix carrying = jacobian_of(rows_, state_, found_.active, n);
    metric_ = metric_of(rows_.hessian(state_, found_.equality, found_.active, found_.inequality, 1.0),
                        program_.equality, carrying);
    std::vector<std::size_t> likely;
    for (std::size_t i = 0; i < set_.size(); ++i) {
      if (carries(set_[i])) likely.push_back(i);
    }
    begun_.emplace(program_, metric_, likely);
  }

  /// Of one limit's rows that are kept on one side, together; or of a value to be met exactly, whose sign tells which way
  /// wins. Infinite where no step keeps all rows.
  /// @param move  by which its first row is tightened, or its value lowered, in scales
  [[nodiscard]] double carried(const LimitName& name, double move) const {
    Vector equality_value = program_.equality_value;
    Vector inequality_value = program_.inequality_value;
    double first = 0.0;
    const auto add_move = [&](std::size_t limit, double& value) {
      if (problem_.limits[limit].name != name) return;
      if (first == 0.0) first = per_si(limit);
      value += move * per_si(limit) / first;
    };
    for (std::size_t i = 0; i < set_.size(); ++i) add_move(set_[i].limit, inequality_value[i]);
    for (std::size_t i = 0; i < equality_value.size(); ++i) {
      if (const std::size_t* const limit = rows_.limit_of_equality(i)) add_move(*limit, equality_value[i]);
    }
    const QuadraticSolution solution = begun_->solve(equality_value, inequality_value);
    using Status = QuadraticSolution::Status;
    if (solution.status == Status::contradictory) return std::copysign(core::kInfinity, move);
    if (solution.status != Status::solved) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (const std::size_t i : solution.active) {
      const std::size_t limit = set_[i].limit;
      if (problem_.limits[limit].name == name) sum += solution.inequality[i] * per_si(limit);
    }
    for (std::size_t i = 0; i < solution.equality.size(); ++i) {
      const std::size_t* const limit = rows_.limit_of_equality(i);
      if (limit != nullptr && problem_.limits[*limit].name == name)
        sum += solution.equality[i] * per_si(*limit);
    }
    return sum;
  }

  /// What the optimum's own rows carry, as carried(): where the program is right it lies between those to either side.
  [[nodiscard]] double own(const LimitName& name) const {
    double sum = 0.0;
    const auto add = [&](std::size_t limit, double multiplier) {
      if (problem_.limits[limit].name == name) sum += multiplier * per_si(limit);
    };
    for (std::size_t k = 0; k < found_.active.size(); ++k) add(found_.active[k].limit, found_.inequality[k]);
    for (std::size_t i = 0; i < found_.equality.size(); ++i) {
      if (const std::size_t* const limit = rows_.limit_of_equality(i)) add(*limit, found_.equality[i]);
    }
    return sum;
  }

  /// Below this nothing counts, as carried().
  [[nodiscard]] double counts(const LimitName& name) const {
    double greatest = 0.0;
    for (const double multiplier : found_.inequality) greatest = std::max(greatest, multiplier);
    for (const double multiplier : found_.equality) greatest = std::max(greatest, std::fabs(multiplier));
    for (std::size_t i = 0; i < problem_.limits.size(); ++i) {
      if (problem_.limits[i].name == name) return kCounts * greatest * per_si(i);
    }
    return 0.0;
  }

 private:
  [[nodiscard]] double per_si(std::size_t limit) const {
    return problem_.limits[limit].per_si / problem_.limits[limit].scale;
  }
  [[nodiscard]] bool carries(const Row& row) const {
    for (std::size_t k = 0; k < found_.active.size(); ++k) {
      if (found_.active[k] == row) return found_.inequality[k] > 0.0;
    }
    return false;
  }

  const ScaledProblem& problem_;
  const Found& found_;
  const Rows& rows_;
  State state_;
  std::vector<Row> set_;
  QuadraticProgram program_;
  ShiftedCholesky metric_;
  std::optional<BegunProgram> begun_;
};

/// @param width  between the prices to either side, with bounds moved as usual
bool is_kink(const MovedPrograms& programs, const LimitName& name, double width) {
  if (std::isinf(width)) return true;
  const double closer = programs.carried(name, kMovedLess) - programs.carried(name, -kMovedLess);
  return !(closer < kAsWide * width);
}

}  // namespace

std::vector<OneSidedPrice> one_sided_prices(const ScaledProblem& problem, const Found& found) {
  MovedPrograms programs(problem, found);
  std::vector<OneSidedPrice> result;
  if (!programs.may_have_kinks()) return result;
  programs.prepare();
  for (const LimitName& name : programs.names()) {
    double relaxing = programs.carried(name, -kMoved);
    double tightening = programs.carried(name, kMoved);
    // Multipliers of an optimum are a subgradient: a program that has them outside of its own prices was led to another set of
    // rows by what the point is still off.
    const double own = programs.own(name);
    const double room = kPricesApart * std::fabs(own) + programs.counts(name);
    if (own < relaxing - room || own > tightening + room) continue;
    if (name.bound == Bound::exactly) {
      // Smaller values win, or neither do.
      if (tightening < 0.0) std::tie(relaxing, tightening) = std::pair(-tightening, -relaxing);
      tightening = std::max(tightening, -relaxing);
    }
    if (std::isinf(relaxing) && name.bound != Bound::exactly) continue;
    relaxing = std::max(relaxing, 0.0);
    const bool counts = tightening - relaxing > programs.counts(name);
    if (!counts || !(relaxing < (1.0 - kPricesApart) * tightening)) continue;
    if (is_kink(programs, name, tightening - relaxing)) result.push_back({name, relaxing, tightening});
  }
  return result;
}

}  // namespace glissade::optimizer
