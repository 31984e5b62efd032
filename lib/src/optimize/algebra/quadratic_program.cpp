#include "optimize/algebra/quadratic_program.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace glissade::optimizer {
namespace {

// A row whose part outside the active ones is smaller than this share of it depends on them.
constexpr double kDependent = 1e-9;  // rounding
// Of a row of which this share is left by one pass of Gram-Schmidt the rest is orthogonal to rounding.
// Source: W. Hoffmann, "Iterative algorithms for Gram-Schmidt orthogonalization", Computing 41 (1989) 335-348.
constexpr double kMuchLeft = 0.5;  // rounding
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The active rows N = Q R in the metric of H, Q with orthonormal columns, R upper triangular.
class ActiveBasis {
 public:
  [[nodiscard]] std::size_t size() const { return q_.size(); }

  /// Splits a row into its share of each active one, and the part that none of them has.
  struct Split {
    Vector along;  ///< Q^T row
    Vector rest;
    double rest_norm = 0.0;
    bool dependent = false;
  };
  [[nodiscard]] Split split(const Vector& row) const { return split(row.data(), row.size()); }
  [[nodiscard]] Split split(const double* row, std::size_t n) const {
    Split split;
    split.along.assign(size(), 0.0);
    split.rest.assign(row, row + n);
    const double whole = norm(split.rest);
    split.rest_norm = whole;
    const std::vector<const double*> basis = columns();
    Vector along(size());
    // Twice is enough, and once where little is taken away.
    for (int pass = 0; pass < 2 && size() > 0; ++pass) {
      dots(basis, split.rest.data(), n, along.data());
      for (std::size_t j = 0; j < size(); ++j) {
        split.along[j] += along[j];
        along[j] = -along[j];
      }
      add_scaled_rows(split.rest.data(), along, basis, n);
      split.rest_norm = norm(split.rest);
      if (split.rest_norm > kMuchLeft * whole) break;
    }
    split.dependent = !(split.rest_norm > kDependent * whole);
    return split;
  }

  void append(Split split) {
    split.along.push_back(split.rest_norm);
    r_.push_back(std::move(split.along));
    q_.push_back(std::move(split.rest));
    for (double& entry : q_.back()) entry /= split.rest_norm;
  }

  void remove(std::size_t index) {
    r_.erase(r_.begin() + static_cast<std::ptrdiff_t>(index));
    // Plane rotations bring the columns behind back to triangular form.
    for (std::size_t j = index; j < r_.size(); ++j) {
      const double a = r_[j][j];
      const double b = r_[j][j + 1];
      const double size = math::hypot(a, b);
      const double cosine = a / size;
      const double sine = b / size;
      for (std::size_t k = j; k < r_.size(); ++k) rotate(r_[k][j], r_[k][j + 1], cosine, sine);
      rotate_rows(q_[j].data(), q_[j + 1].data(), cosine, sine, q_[j].size());
      r_[j].pop_back();
    }
    q_.pop_back();
  }

  /// R^-1 value
  [[nodiscard]] Vector solve(Vector value) const {
    for (std::size_t i = size(); i-- > 0;) {
      value[i] /= r_[i][i];
      add_scaled(value.data(), -value[i], r_[i].data(), i);
    }
    return value;
  }

  /// R^-T value
  [[nodiscard]] Vector solve_transposed(Vector value) const {
    for (std::size_t i = 0; i < size(); ++i) {
      value[i] = (value[i] - dot(r_[i].data(), value.data(), i)) / r_[i][i];
    }
    return value;
  }

  /// The shortest y with which the first rows have the values `wanted`, as many as there are of these.
  [[nodiscard]] Vector shortest(const Vector& wanted, std::size_t n) const {
    Vector along(wanted.size());
    Vector y(n, 0.0);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      along[i] = (wanted[i] - dot(r_[i].data(), along.data(), i)) / r_[i][i];
      add_scaled(y.data(), along[i], q_[i].data(), n);
    }
    return y;
  }

  /// The minimum of g.y + |y|^2/2 where every active row has the value `wanted`, and its multipliers.
  void minimum(const Vector& gradient, const Vector& wanted, Vector& y, Vector& multipliers) const {
    const std::size_t n = gradient.size();
    const Split free = split(gradient);
    Vector along = solve_transposed(wanted);
    y.assign(n, 0.0);
    add_scaled(y.data(), -1.0, free.rest.data(), n);
    add_scaled_rows(y.data(), along, columns(), n);
    for (std::size_t j = 0; j < size(); ++j) along[j] = -along[j] - free.along[j];
    multipliers = solve(std::move(along));
  }

 private:
  [[nodiscard]] std::vector<const double*> columns() const {
    std::vector<const double*> columns;
    columns.reserve(size());
    for (const Vector& q : q_) columns.push_back(q.data());
    return columns;
  }

  static void rotate(double& a, double& b, double cosine, double sine) {
    const double first = cosine * a + sine * b;
    b = cosine * b - sine * a;
    a = first;
  }

  std::vector<Vector> q_;
  std::vector<Vector> r_;  ///< columns
};

/// One solution in the making, in y = L^T d.
class DualMethod {
 public:
  DualMethod(const QuadraticProgram& program, const ShiftedCholesky& metric)
      : program_(program),
        metric_(metric),
        gradient_(program.gradient),
        most_changes_(static_cast<int>(50 + 5 * (program.gradient.size() + program.inequality.rows()))) {
    metric_.forward(gradient_.data());
    is_active_.assign(program.inequality.rows(), false);
  }

  /// Enters the equality rows and those likely to hold, whatever their values.
  void begin(const std::vector<std::size_t>& likely) {
    for (std::size_t i = 0; i < program_.equality.rows(); ++i) {
      ActiveBasis::Split split = basis_.split(in_metric(program_.equality.row(i)));
      if (split.dependent) {
        depending_.push_back(i);
      } else {
        enter(std::move(split), i);
      }
    }
    fixed_ = source_.size();
    extents_.reserve(program_.inequality.rows());
    for (std::size_t i = 0; i < program_.inequality.rows(); ++i)
      extents_.push_back(extent_of(program_.inequality.row(i), gradient_.size()));
    Matrix rows = Matrix::unset(likely.size(), gradient_.size());
    for (std::size_t k = 0; k < likely.size(); ++k)
      std::copy_n(program_.inequality.row(likely[k]), gradient_.size(), rows.row(k));
    metric_.forward(rows);
    for (std::size_t k = 0; k < likely.size(); ++k) {
      const std::size_t i = likely[k];
      if (is_active_[i]) continue;
      ActiveBasis::Split split = basis_.split(rows.row(k), gradient_.size());
      if (split.dependent) continue;
      enter(std::move(split), i);
      is_active_[i] = true;
      ++changes_;
    }
  }

  void scale_gradient(double factor) {
    for (double& entry : gradient_) entry *= factor;
  }

  /// To the solution from there.
  [[nodiscard]] QuadraticSolution run(const Vector& equality_value, const Vector& inequality_value) {
    equality_value_ = &equality_value;
    inequality_value_ = &inequality_value;
    for (std::size_t i = 0; i < source_.size(); ++i)
      wanted_.push_back(-(i < fixed_ ? equality_value : inequality_value)[source_[i]]);
    QuadraticSolution solution;
    refresh();
    solution.status = keeps_depending_rows() ? from_likely_rows() : QuadraticSolution::Status::contradictory;
    solution.step = step();
    solution.length = norm(y_);
    solution.equality.assign(program_.equality.rows(), 0.0);
    solution.inequality.assign(program_.inequality.rows(), 0.0);
    for (std::size_t i = 0; i < source_.size(); ++i) {
      if (i < fixed_) {
        solution.equality[source_[i]] = multipliers_[i];
      } else {
        solution.inequality[source_[i]] = std::max(multipliers_[i], 0.0);
        solution.active.push_back(source_[i]);
      }
    }
    solution.changes = changes_;
    return solution;
  }

 private:
  [[nodiscard]] Vector in_metric(const double* row) const {
    Vector result(row, row + gradient_.size());
    metric_.forward(result.data());
    return result;
  }

  [[nodiscard]] Vector step() const {
    Vector d = y_;
    metric_.backward(d.data());
    return d;
  }

  /// y and the multipliers anew from the active set alone: steps leave rounding behind.
  void refresh() { basis_.minimum(gradient_, wanted_, y_, multipliers_); }

  void enter(ActiveBasis::Split split, std::size_t row) {
    basis_.append(std::move(split));
    source_.push_back(row);
  }

  void leave(std::size_t index) {
    basis_.remove(index);
    const auto at = static_cast<std::ptrdiff_t>(index);
    is_active_[source_[index]] = false;
    source_.erase(source_.begin() + at);
    wanted_.erase(wanted_.begin() + at);
    multipliers_.erase(multipliers_.begin() + at);
    ++changes_;
  }

  /// @return false if the equality rows contradict each other
  [[nodiscard]] bool keeps_depending_rows() const {
    if (depending_.empty()) return true;
    const auto end = wanted_.begin() + static_cast<std::ptrdiff_t>(fixed_);
    Vector d = basis_.shortest(Vector(wanted_.begin(), end), gradient_.size());
    metric_.backward(d.data());
    return std::all_of(depending_.begin(), depending_.end(), [&](std::size_t i) {
      const double value = (*equality_value_)[i];
      const double left = dot(program_.equality.row(i), d.data(), d.size()) + value;
      return std::fabs(left) <= kDependent * (1.0 + std::fabs(value));
    });
  }

  /// Rows whose multipliers are negative leave, and those that are broken enter.
  [[nodiscard]] QuadraticSolution::Status from_likely_rows() {
    for (;;) {
      const auto first = multipliers_.begin() + static_cast<std::ptrdiff_t>(fixed_);
      const auto least = std::min_element(first, multipliers_.end());
      if (least == multipliers_.end() || *least >= 0.0) break;
      leave(static_cast<std::size_t>(least - multipliers_.begin()));
      refresh();
    }
    const int before = changes_;
    const QuadraticSolution::Status status = enter_broken_rows();
    if (status != QuadraticSolution::Status::contradictory && changes_ != before) refresh();
    return status;
  }

  /// Rows outside the active ones that a step breaks.
  /// @param among  where to look
  [[nodiscard]] std::vector<std::size_t> broken(const std::vector<std::size_t>& among, std::size_t& worst,
                                                double& value) {
    step_ = y_;
    metric_.backward(step_.data());
    std::vector<std::size_t> rows;
    Vector& along = along_;
    along.resize(among.size());
    dots(program_.inequality, among, extents_, step_.data(), along.data());
    value = program_.tolerance;
    for (std::size_t k = 0; k < among.size(); ++k) {
      const std::size_t i = among[k];
      const double there = along[k] + (*inequality_value_)[i];
      if (!(there > program_.tolerance) || is_active_[i]) continue;  // most are kept
      rows.push_back(i);
      if (there <= value) continue;
      value = there;
      worst = i;
    }
    return rows;
  }

  /// The worst row enters, again and again. Most rows are never broken: all are looked at only where none is left of
  /// those that were broken when all were looked at before.
  [[nodiscard]] QuadraticSolution::Status enter_broken_rows() {
    using Status = QuadraticSolution::Status;
    std::vector<std::size_t> all(program_.inequality.rows());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::size_t worst = 0;
    double value = 0.0;
    for (;;) {
      const std::vector<std::size_t> known = broken(all, worst, value);
      if (known.empty()) return Status::solved;
      for (;;) {
        const Status status = enter_row(worst, value);
        if (status != Status::solved) return status;
        if (broken(known, worst, value).empty()) break;
      }
    }
  }

  /// Raises the multiplier of one broken row until the row is kept; rows whose multipliers vanish on the way
  /// leave.
  [[nodiscard]] QuadraticSolution::Status enter_row(std::size_t row, double value) {
    using Status = QuadraticSolution::Status;
    const Vector normal = in_metric(program_.inequality.row(row));
    double multiplier = 0.0;
    while (changes_++ < most_changes_) {
      ActiveBasis::Split split = basis_.split(normal);
      const Vector share = basis_.solve(split.along);
      double dual_step = kUnlimited;
      std::size_t leaving = 0;
      for (std::size_t i = fixed_; i < share.size(); ++i) {
        if (!(share[i] > 0.0)) continue;
        const double until_zero = std::max(multipliers_[i], 0.0) / share[i];
        if (until_zero < dual_step) {
          dual_step = until_zero;
          leaving = i;
        }
      }
      const double full_step = split.dependent ? kUnlimited : value / (split.rest_norm * split.rest_norm);
      const double taken = std::min(dual_step, full_step);
      if (taken == kUnlimited) return Status::contradictory;
      for (std::size_t i = 0; i < share.size(); ++i) multipliers_[i] -= taken * share[i];
      multiplier += taken;
      if (!split.dependent) {
        add_scaled(y_.data(), -taken, split.rest.data(), y_.size());
        value -= taken * split.rest_norm * split.rest_norm;
      }
      if (full_step <= dual_step) {
        enter(std::move(split), row);
        wanted_.push_back(-(*inequality_value_)[row]);
        multipliers_.push_back(multiplier);
        is_active_[row] = true;
        return Status::solved;
      }
      leave(leaving);
    }
    return Status::unfinished;
  }

  const QuadraticProgram& program_;
  const ShiftedCholesky& metric_;
  Vector gradient_;  ///< in the metric
  int most_changes_;
  ActiveBasis basis_;
  std::vector<std::size_t> source_;  ///< equality rows first, then inequality rows
  std::size_t fixed_ = 0;            ///< so many of `source_` are equality rows
  Vector wanted_;
  Vector multipliers_;
  std::vector<std::size_t> depending_;  ///< equality rows that depend on those before them
  const Vector* equality_value_ = nullptr;
  const Vector* inequality_value_ = nullptr;
  std::vector<bool> is_active_;
  std::vector<Extent> extents_;  ///< of the inequality rows
  Vector y_;
  Vector step_;   ///< room for it, and
  Vector along_;  ///< for what rows have along it
  int changes_ = 0;
};

}  // namespace

QuadraticSolution solve(const QuadraticProgram& program, const ShiftedCholesky& metric,
                        const std::vector<std::size_t>& likely) {
  DualMethod method(program, metric);
  method.begin(likely);
  return method.run(program.equality_value, program.inequality_value);
}

struct BegunProgram::Method : DualMethod {
  using DualMethod::DualMethod;
};

BegunProgram::BegunProgram(const QuadraticProgram& program, const ShiftedCholesky& metric,
                           const std::vector<std::size_t>& likely)
    : method_(std::make_unique<Method>(program, metric)) {
  method_->begin(likely);
}

BegunProgram::BegunProgram(BegunProgram&&) noexcept = default;
BegunProgram& BegunProgram::operator=(BegunProgram&&) noexcept = default;
BegunProgram::~BegunProgram() = default;

QuadraticSolution BegunProgram::solve(const Vector& equality_value, const Vector& inequality_value,
                                      double gradient) const {
  Method method = *method_;
  if (gradient != 1.0) method.scale_gradient(gradient);
  return method.run(equality_value, inequality_value);
}

}  // namespace glissade::optimizer
