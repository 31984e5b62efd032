// Minimise t over x, t subject to  A x + base <= above t + room  and  -(A x + base) <= below t + room. In the form G y <= h with
// y = (x, t): slacks w = h - G y > 0, multipliers z > 0 with G'z = -c; Newton on w z = mu with Mehrotra's centring.

#include "parts/curves/minimax.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::parts {
namespace {

using Vector = std::vector<double>;

constexpr int kMostSteps = 60;
constexpr double kToWall = 0.995;  // share of the way to the nearest bound that a step goes

/// Symmetric positive definite with two diagonals beside the main one; solved by L D L'.
class Banded {
 public:
  explicit Banded(std::size_t size) : diagonals_(size, {0.0, 0.0, 0.0}) {}

  void add(std::size_t i, std::size_t j, double value) { diagonals_[i][i - j] += value; }  // i >= j
  void pin(std::size_t i) { diagonals_[i][0] = 1.0; }

  void factor() {
    for (std::size_t i = 0; i < diagonals_.size(); ++i) {
      auto& row = diagonals_[i];
      if (i >= 2) {
        const auto& two = diagonals_[i - 2];
        row[1] -= row[2] * diagonals_[i - 1][1];
        row[2] /= two[0];
        row[0] -= row[2] * row[2] * two[0];
      }
      if (i >= 1) {
        const double pivot = diagonals_[i - 1][0];
        row[1] /= pivot;
        row[0] -= row[1] * row[1] * pivot;
      }
    }
  }

  void solve(Vector& b) const {
    const std::size_t n = diagonals_.size();
    for (std::size_t i = 1; i < n; ++i) {
      b[i] -= diagonals_[i][1] * b[i - 1];
      if (i >= 2) b[i] -= diagonals_[i][2] * b[i - 2];
    }
    for (std::size_t i = n; i-- > 0;) {
      b[i] /= diagonals_[i][0];
      if (i + 1 < n) b[i] -= diagonals_[i + 1][1] * b[i + 1];
      if (i + 2 < n) b[i] -= diagonals_[i + 2][2] * b[i + 2];
    }
  }

 private:
  std::vector<std::array<double, 3>> diagonals_;  // row i: (i, i), (i, i - 1), (i, i - 2)
};

/// Both bounds of a row: A x - above t <= room - base, and -A x - below t <= room + base.
struct Pair {
  double upper = 0.0;
  double lower = 0.0;
};

class Method {
 public:
  Method(const std::vector<MinimaxRow>& rows, const std::vector<bool>& dropped)
      : rows_(rows),
        dropped_(dropped),
        x_(dropped.size(), 0.0),
        x_step_(dropped.size(), 0.0),
        target_(rows.size()),
        slack_step_(rows.size()),
        dual_step_(rows.size()),
        primal_(rows.size()),
        inverse_(rows.size()),
        weight_(rows.size()) {}

  MinimaxResult run(double most_gap) {
    start();
    for (int step = 0; step < kMostSteps && gap() > most_gap * t_; ++step) improve();
    return {x_, t_};
  }

 private:
  [[nodiscard]] double at(const MinimaxRow& row, const Vector& x) const {
    return row.value[0] * x[row.first] + row.value[1] * x[row.first + 1] + row.value[2] * x[row.first + 2];
  }

  void start() {
    double most = 1e-300;
    for (const MinimaxRow& row : rows_) most = std::max(most, std::fabs(row.base));
    t_ = 1.2 * most;
    // Rows that a small t or room leaves outside start so: the method needs positive slacks, no feasible point.
    const double count = 2.0 * static_cast<double>(rows_.size());
    for (const MinimaxRow& row : rows_) {
      const double least = row.room > 0.0 ? 0.2 * row.room : 0.2 * most;
      slack_.push_back({std::max(row.above * t_ + row.room - row.base, least),
                        std::max(row.below * t_ + row.room + row.base, least)});
      dual_.push_back({most / count / slack_.back().upper, most / count / slack_.back().lower});
    }
  }

  [[nodiscard]] double gap() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      sum += slack_[i].upper * dual_[i].upper + slack_[i].lower * dual_[i].lower;
    }
    return sum;
  }

  void improve() {
    residuals();
    factor();
    const double mu = gap() / (2.0 * static_cast<double>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      target_[i] = {slack_[i].upper * dual_[i].upper, slack_[i].lower * dual_[i].lower};
    }
    direction();
    const double affine = mu_after();
    const double share = affine / mu;
    const double centring = share * share * share;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      target_[i].upper += slack_step_[i].upper * dual_step_[i].upper - centring * mu;
      target_[i].lower += slack_step_[i].lower * dual_step_[i].lower - centring * mu;
    }
    direction();
    take();
  }

  /// How far the present point is from G y + w = h and G'z = -c.
  void residuals() {
    stationary_.assign(x_.size(), 0.0);
    stationary_t_ = 1.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const MinimaxRow& row = rows_[i];
      const double value = at(row, x_) + row.base;
      primal_[i] = {value - row.above * t_ - row.room + slack_[i].upper,
                    -value - row.below * t_ - row.room + slack_[i].lower};
      const double difference = dual_[i].upper - dual_[i].lower;
      for (std::size_t k = 0; k < 3; ++k) stationary_[row.first + k] += row.value[k] * difference;
      stationary_t_ -= row.above * dual_[i].upper + row.below * dual_[i].lower;
    }
  }

  void factor() {
    matrix_ = Banded(x_.size());
    border_.assign(x_.size(), 0.0);
    corner_ = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const MinimaxRow& row = rows_[i];
      inverse_[i] = {1.0 / slack_[i].upper, 1.0 / slack_[i].lower};
      weight_[i] = {dual_[i].upper * inverse_[i].upper, dual_[i].lower * inverse_[i].lower};
      const double upper = weight_[i].upper;
      const double lower = weight_[i].lower;
      for (std::size_t k = 0; k < 3; ++k) {
        if (dropped_[row.first + k]) continue;
        border_[row.first + k] += row.value[k] * (row.below * lower - row.above * upper);
        for (std::size_t l = 0; l <= k; ++l) {
          if (dropped_[row.first + l]) continue;
          matrix_.add(row.first + k, row.first + l, (upper + lower) * row.value[k] * row.value[l]);
        }
      }
      corner_ += row.above * row.above * upper + row.below * row.below * lower;
    }
    for (std::size_t j = 0; j < x_.size(); ++j) {
      if (dropped_[j]) matrix_.pin(j);
    }
    matrix_.factor();
    solved_border_ = border_;
    matrix_.solve(solved_border_);
    schur_ = corner_;
    for (std::size_t j = 0; j < x_.size(); ++j) schur_ -= border_[j] * solved_border_[j];
  }

  /// The step for which w z becomes w z - target, to first order.
  void direction() {
    Vector& right = x_step_;
    for (std::size_t j = 0; j < x_.size(); ++j) right[j] = -stationary_[j];
    double right_t = -stationary_t_;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const MinimaxRow& row = rows_[i];
      // dz = (z (G dy + r) - target) / w.
      Pair& push = dual_step_[i];
      push = {weight_[i].upper * primal_[i].upper - target_[i].upper * inverse_[i].upper,
              weight_[i].lower * primal_[i].lower - target_[i].lower * inverse_[i].lower};
      for (std::size_t k = 0; k < 3; ++k) right[row.first + k] -= row.value[k] * (push.upper - push.lower);
      right_t += row.above * push.upper + row.below * push.lower;
    }
    for (std::size_t j = 0; j < x_.size(); ++j) {
      if (dropped_[j]) right[j] = 0.0;
    }
    matrix_.solve(right);
    double coupled = right_t;
    for (std::size_t j = 0; j < x_.size(); ++j) coupled -= border_[j] * right[j];
    t_step_ = coupled / schur_;
    for (std::size_t j = 0; j < x_.size(); ++j) right[j] -= t_step_ * solved_border_[j];
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double value = at(rows_[i], x_step_);
      const Pair moved{value - rows_[i].above * t_step_, -value - rows_[i].below * t_step_};
      slack_step_[i] = {-primal_[i].upper - moved.upper, -primal_[i].lower - moved.lower};
      dual_step_[i].upper += weight_[i].upper * moved.upper;
      dual_step_[i].lower += weight_[i].lower * moved.lower;
    }
  }

  [[nodiscard]] static double room(const std::vector<Pair>& values, const std::vector<Pair>& steps) {
    double most = 1.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (steps[i].upper < 0.0) most = std::min(most, -values[i].upper / steps[i].upper);
      if (steps[i].lower < 0.0) most = std::min(most, -values[i].lower / steps[i].lower);
    }
    return most;
  }

  [[nodiscard]] double mu_after() const {
    const double primal = room(slack_, slack_step_);
    const double dual = room(dual_, dual_step_);
    double sum = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      sum +=
          (slack_[i].upper + primal * slack_step_[i].upper) * (dual_[i].upper + dual * dual_step_[i].upper);
      sum +=
          (slack_[i].lower + primal * slack_step_[i].lower) * (dual_[i].lower + dual * dual_step_[i].lower);
    }
    return sum / (2.0 * static_cast<double>(rows_.size()));
  }

  void take() {
    const double primal = std::min(1.0, kToWall * room(slack_, slack_step_));
    const double dual = std::min(1.0, kToWall * room(dual_, dual_step_));
    for (std::size_t j = 0; j < x_.size(); ++j) x_[j] += primal * x_step_[j];
    t_ += primal * t_step_;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      slack_[i].upper += primal * slack_step_[i].upper;
      slack_[i].lower += primal * slack_step_[i].lower;
      dual_[i].upper += dual * dual_step_[i].upper;
      dual_[i].lower += dual * dual_step_[i].lower;
    }
  }

  const std::vector<MinimaxRow>& rows_;
  const std::vector<bool>& dropped_;
  Vector x_, x_step_;
  double t_ = 0.0, t_step_ = 0.0;
  std::vector<Pair> slack_, dual_, target_, slack_step_, dual_step_, primal_;
  std::vector<Pair> inverse_, weight_;  // 1/w and z/w
  Vector stationary_, border_, solved_border_;
  double stationary_t_ = 0.0, corner_ = 0.0, schur_ = 0.0;
  Banded matrix_{0};
};

}  // namespace

MinimaxResult minimax(const std::vector<MinimaxRow>& rows, const std::vector<bool>& dropped, double gap) {
  return Method(rows, dropped).run(gap);
}

}  // namespace glissade::parts
