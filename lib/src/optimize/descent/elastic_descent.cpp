#include "optimize/descent/elastic_descent.hpp"

#include "optimize/algebra/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace glissade::optimizer {
namespace {

// Rows this close to their bound take part in a program.
constexpr double kRowBand = 0.25;  // taste
// Curvature of the model along t: it bounds t, and is without effect at the end.
constexpr double kSlackCurvature = 1e-6;  // taste
// The price on the violation lies this much above the sum of the multipliers, ...
constexpr double kAbove = 2.0;  // theory: above 1
// ... at first here, and never higher than that. Larger sums are of rows that all but depend on each other.
constexpr double kFirstPrice = 10.0;   // taste
constexpr double kHighestPrice = 1e3;  // taste
// A violation below this is none.
constexpr double kKept = 1e-12;  // rounding
// Less is promised only at the end, ...
constexpr double kNothingPromised = 1e-13;  // rounding
// ... or not worth the steps, where none of Newton's own does.
constexpr double kNotWorth = 1e-9;  // accuracy: below that of a time
// The first price on changes of shape, as a share of that on the violation, and how fast it rises at first.
constexpr double kSoftest = 1e-2;  // taste
constexpr double kHarder = 4.0;    // taste
// A violation above this is one.
constexpr double kViolated = 1e-4;  // taste

class ElasticDescent {
 public:
  ElasticDescent(const Rows& rows, const Transcription& track, Vector z, Multipliers known, double near,
                 SearchControl& control)
      : rows_(rows),
        track_(track),
        near_(near),
        control_(control),
        n_(track.layout().size()),
        shape_(shape_metric(track)),
        known_(std::move(known)) {
    state_ = rows_.state(z, true);
    near_rows_ = near_rows(state_);
    violation_ = violation_of(state_, near_rows_);
    // Multipliers of a program that contradicts itself grow without bound: a curvature made of them stops every step.
    if (price_above(known_) > kHighestPrice) known_ = Multipliers{};
    price_ = price_above(known_);
  }

  [[nodiscard]] ElasticEnd run() {
    constexpr int kMostSteps = 40;    // budget
    constexpr int kMostRefused = 10;  // budget
    linearise();
    int refused = 0;
    for (int step = 0; step < kMostSteps && refused < kMostRefused && !control_.stop(); ++step) {
      const double promised = propose();
      if (is_stuck(promised)) {
        if (violation_ <= control_.limit_tolerance || price_ >= kHighestPrice) break;
        price_ = kHighestPrice;
        stiffness_ = 0.0;
        is_factored_ = false;
        continue;
      }
      refused = advance(promised) ? 0 : refused + 1;
      if (refused > 0) continue;
      if (is_near()) break;
      linearise();
    }
    return {state_.z, known_, violation_};
  }

 private:
  /// Rows close to their bounds at a state, and their values.
  struct NearRows {
    std::vector<Row> rows;
    Vector values;
  };
  [[nodiscard]] NearRows near_rows(const State& state) const {
    NearRows near;
    near.rows = rows_.candidates(state, kRowBand, &near.values);
    return near;
  }
  [[nodiscard]] double violation_of(const State& state, const NearRows& near) const {
    return std::max(greatest_size(rows_.equality_values(state)), greatest_of(near.values));
  }
  [[nodiscard]] static double price_above(const Multipliers& multipliers) {
    double sum = 0.0;
    for (const double multiplier : multipliers.equality) sum += std::fabs(multiplier);
    for (const double multiplier : multipliers.inequality) sum += multiplier;
    return std::max(kFirstPrice, kAbove * sum);
  }
  [[nodiscard]] double merit(const State& state, double violation) const {
    return rows_.objective(state) + price_ * violation;
  }
  /// The last step was short, to all but a track that keeps the limits.
  [[nodiscard]] bool is_near() const { return length_ <= near_ && violation_ <= near_; }

  /// Nothing is promised, or no step at all lowers the violation.
  [[nodiscard]] bool is_stuck(double promised) const {
    constexpr double kHardly = 0.95;  // taste
    const double least = stiffness_ > 0.0 ? kNotWorth : kNothingPromised;
    if (!(promised > least * (1.0 + std::fabs(rows_.objective(state_))))) return true;
    const bool lowers = step_.t < kHardly * violation_ || promised > (1.0 - kHardly) * price_ * violation_;
    return is_elastic_ && stiffness_ <= kSoftest * price_ && violation_ > kViolated && !lowers;
  }

  void linearise() {
    program_ = QuadraticProgram{};
    program_.gradient = rows_.objective_gradient(state_);
    rows_.equalities(state_, program_.equality_value, program_.equality);
    set_ = std::move(near_rows_.rows);
    program_.inequality_value = std::move(near_rows_.values);
    program_.inequality = jacobian_of(rows_, state_, set_, n_);
    Vector equality = known_.equality;
    equality.resize(program_.equality_value.size(), 0.0);
    hessian_ = rows_.hessian(state_, equality, known_.active, known_.inequality, 1.0);
    carrying_ = jacobian_of(rows_, state_, known_.active, n_);
    is_factored_ = false;
  }

  /// The metric of the programs, for the stiffness that there is.
  void factor() {
    if (is_factored_) return;
    is_factored_ = true;
    Matrix hessian = hessian_;
    for (std::size_t i = 0; i < n_; ++i) add_scaled(hessian.row(i), stiffness_, shape_.row(i), n_);
    metric_ = metric_of(hessian, program_.equality, carrying_);
    Vector gradient = program_.gradient;
    metric_.forward(gradient.data());
    gradient_ = norm(gradient);
  }

  /// A program in which all rows give way by t, its last unknown.
  [[nodiscard]] QuadraticProgram elastic() const {
    const std::size_t equalities = program_.equality.rows();
    QuadraticProgram program;
    program.gradient = program_.gradient;
    program.gradient.push_back(price_);
    const std::size_t count = 2 * equalities + set_.size() + 1;
    program.inequality = Matrix(count, n_ + 1);
    for (std::size_t i = 0; i < equalities; ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        add_scaled(program.inequality.row(2 * i + side), side == 0 ? 1.0 : -1.0, program_.equality.row(i),
                   n_);
      }
    }
    for (std::size_t i = 0; i < set_.size(); ++i) {
      std::copy_n(program_.inequality.row(i), n_, program.inequality.row(2 * equalities + i));
    }
    for (std::size_t i = 0; i < count; ++i) program.inequality(i, n_) = -1.0;
    return program;
  }
  [[nodiscard]] static Vector elastic_values(const Vector& equality, const Vector& inequality) {
    Vector values;
    for (const double value : equality) {
      values.push_back(value);
      values.push_back(-value);
    }
    values.insert(values.end(), inequality.begin(), inequality.end());
    values.push_back(0.0);
    return values;
  }

  /// The step of one program, and its multipliers.
  struct Step {
    Vector z;
    double t = 0.0;       ///< by which linearised rows are still broken
    double length = 0.0;  ///< in the metric
    bool is_solved = false;
    Multipliers multipliers;
  };

  [[nodiscard]] std::vector<std::size_t> likely() const {
    std::vector<std::size_t> rows;
    for (const Row& row : known_.active) {
      const auto found = std::find(set_.begin(), set_.end(), row);
      if (found != set_.end()) rows.push_back(static_cast<std::size_t>(found - set_.begin()));
    }
    return rows;
  }

  /// @param equality_value,inequality_value  of the program's rows
  [[nodiscard]] Step solved_exactly(const Vector& equality_value, const Vector& inequality_value) const {
    // In a metric that much smaller: the same program with a gradient that much larger, and so are its multipliers.
    const QuadraticSolution solution = exact_->solve(equality_value, inequality_value, reach_);
    Step step;
    step.is_solved = solution.status == QuadraticSolution::Status::solved;
    if (!step.is_solved) return step;
    step.z = solution.step;
    step.length = solution.length / std::sqrt(reach_);
    for (const double multiplier : solution.equality)
      step.multipliers.equality.push_back(multiplier / reach_);
    for (const std::size_t i : solution.active) {
      step.multipliers.active.push_back(set_[i]);
      step.multipliers.inequality.push_back(solution.inequality[i] / reach_);
    }
    return step;
  }

  [[nodiscard]] Step solved_elastically(const Vector& equality_value, const Vector& inequality_value) const {
    const std::size_t equalities = program_.equality.rows();
    const QuadraticSolution solution = giving_->solve({}, elastic_values(equality_value, inequality_value));
    Step step;
    step.is_solved = solution.status == QuadraticSolution::Status::solved;
    if (!step.is_solved) return step;
    step.t = solution.step[n_] > kKept ? solution.step[n_] : 0.0;
    step.z.assign(solution.step.begin(), solution.step.end() - 1);
    const double own = solution.step[n_] * solution.step[n_] * kSlackCurvature;
    step.length = std::sqrt(std::max(0.0, solution.length * solution.length - own));
    step.multipliers.equality.assign(equalities, 0.0);
    for (const std::size_t i : solution.active) {
      const double multiplier = solution.inequality[i];
      if (i < 2 * equalities) {
        step.multipliers.equality[i / 2] += i % 2 == 0 ? multiplier : -multiplier;
      } else if (i < 2 * equalities + set_.size()) {
        step.multipliers.active.push_back(set_[i - 2 * equalities]);
        step.multipliers.inequality.push_back(multiplier);
      }
    }
    return step;
  }

  void begin_exactly() { exact_.emplace(program_, metric_, likely()); }
  void begin_elastically() {
    elastic_program_ = elastic();
    elastic_metric_ = metric_.with_one_more(kSlackCurvature);
    begin_giving();
  }
  void begin_giving() {
    const std::size_t equalities = program_.equality.rows();
    std::vector<std::size_t> begin;
    for (const std::size_t i : likely()) begin.push_back(2 * equalities + i);
    giving_.emplace(elastic_program_, elastic_metric_, begin);
  }

  /// Solves a program at the point. @return how much it promises to lower the sum by
  [[nodiscard]] double propose() {
    factor();
    is_elastic_ = stiffness_ > 0.0;
    if (!is_elastic_) {
      begin_exactly();
      step_ = solved_exactly(program_.equality_value, program_.inequality_value);
      is_elastic_ = !step_.is_solved;
      // A price that high would follow the violation alone.
      if (price_above(step_.multipliers) > kHighestPrice) is_elastic_ = true;
    }
    if (is_elastic_) {
      if (stiffness_ == 0.0) stiffen();
      factor();
      begin_elastically();
      step_ = solved_elastically(program_.equality_value, program_.inequality_value);
    }
    if (!step_.is_solved) return 0.0;
    if (step_.t == 0.0) price_ = price_above(step_.multipliers);
    length_ = step_.length / (is_elastic_ ? gradient_ : std::sqrt(reach_) * gradient_);
    return price_ * (violation_ - step_.t) - dot(program_.gradient.data(), step_.z.data(), n_) -
           0.5 * step_.length * step_.length;
  }

  struct Trial {
    Vector step;
    State state;
    NearRows near;
    double violation = HUGE_VAL;
    double merit = HUGE_VAL;
  };
  [[nodiscard]] Trial tried(const Vector& step) const {
    Trial trial;
    Vector z = state_.z;
    add_scaled(z.data(), 1.0, step.data(), n_);
    if (!track_.is_track(z)) return trial;
    ++control_.evaluations;
    trial.step = step;
    trial.state = rows_.state(z, false);
    trial.near = near_rows(trial.state);
    trial.violation = violation_of(trial.state, trial.near);
    trial.merit = merit(trial.state, trial.violation);
    if (!std::isfinite(trial.merit)) trial.merit = HUGE_VAL;
    return trial;
  }

  /// The step again, the rows having the values that they really have at its end.
  [[nodiscard]] Trial corrected(const Trial& reached) {
    if (is_elastic_ && elastic_program_.gradient.back() != price_) {
      elastic_program_.gradient.back() = price_;
      begin_giving();
    }
    Vector equality = rows_.equality_values(reached.state);
    for (std::size_t i = 0; i < equality.size(); ++i)
      equality[i] -= dot(program_.equality.row(i), step_.z.data(), n_);
    Vector inequality = values_of(rows_, reached.state, set_);
    for (std::size_t i = 0; i < set_.size(); ++i)
      inequality[i] -= dot(program_.inequality.row(i), step_.z.data(), n_);
    const Step again =
        is_elastic_ ? solved_elastically(equality, inequality) : solved_exactly(equality, inequality);
    return again.is_solved ? tried(again.z) : Trial{};
  }

  /// Twice the way, and again, as long as the sum falls nearly as fast there: a metric made convex tells of a curvature that the
  /// sum may not have.
  void go_farther(double now, Trial& trial) const {
    constexpr double kAsFast = 1.5;  // taste: 2 is the straight line
    for (;;) {
      Vector step = trial.step;
      for (double& way : step) way *= 2.0;
      Trial farther = tried(step);
      if (!(now - farther.merit > kAsFast * (now - trial.merit))) return;
      trial = std::move(farther);
    }
  }

  /// What the next exact steps reach, from what share of the last one's promise was kept: with a curvature c in place of the
  /// metric's 1 it is 2 - c.
  void set_reach(double share) {
    constexpr double kLeast = 0.25;    // taste
    constexpr double kMost = 4.0;      // taste
    constexpr double kFarthest = 1e3;  // taste
    const double factor = 1.0 / std::clamp(2.0 - share, 1.0 / kMost, 1.0 / kLeast);
    reach_ = std::clamp(factor * reach_, 1.0, kFarthest);
  }

  /// A step was not worth taking: the next one is shorter, or changes the shape less.
  void step_back() {
    constexpr double kShorter = 0.125;  // taste
    was_refused_ = true;
    if (!is_elastic_ && reach_ > 1.0) {
      reach_ = std::max(1.0, kShorter * reach_);
      return;
    }
    reach_ = 1.0;
    stiffen();
  }

  /// The next step is to change the shape less.
  void stiffen() {
    stiffness_ = stiffness_ == 0.0 ? kSoftest * price_ : growth_ * stiffness_;
    growth_ *= 2.0;
    is_factored_ = false;
  }

  /// Rows that had no part in a step and are broken at its end take part in the next one. @return if there are any
  [[nodiscard]] bool add_broken(const State& reached) {
    if (reached.z.empty()) return false;
    std::vector<Row> more;
    for (const Row& row : rows_.candidates(reached, 0.0)) {
      if (std::find(set_.begin(), set_.end(), row) == set_.end()) more.push_back(row);
    }
    if (more.empty()) return false;
    set_.insert(set_.end(), more.begin(), more.end());
    program_.inequality_value = values_of(rows_, state_, set_);
    program_.inequality = jacobian_of(rows_, state_, set_, n_);
    return true;
  }

  /// Takes the step if it keeps part of its promise, and sets the stiffness of the next one. @return if it did
  [[nodiscard]] bool advance(double promised) {
    constexpr double kGood = 0.75;         // theory: usual bounds of a trust region
    constexpr double kWorthwhile = 1e-3;   // theory: usual bounds of a trust region
    constexpr double kShort = 1.5;         // taste: a curvature of half the metric's
    constexpr double kSofter = 0.25;       // taste
    constexpr double kLittleSofter = 0.5;  // taste: half of that was refused just before
    const double now = merit(state_, violation_);
    Trial trial = tried(step_.z);
    double share = (now - trial.merit) / promised;
    if (share < kGood && !trial.state.z.empty()) {
      Trial again = corrected(trial);
      if (again.merit < trial.merit) {
        trial = std::move(again);
        share = (now - trial.merit) / promised;
      }
    }
    if (!(share > kWorthwhile)) {
      if (!add_broken(trial.state)) step_back();
      return false;
    }
    if (!is_elastic_) set_reach(share);
    if (share >= kShort) go_farther(now, trial);
    if (share >= kGood) {
      const double softer = was_refused_ ? kLittleSofter : kSofter;
      stiffness_ = stiffness_ <= kSoftest * price_ ? 0.0 : softer * stiffness_;
    }
    was_refused_ = false;
    growth_ = kHarder;
    known_ = step_.multipliers;
    state_ = std::move(trial.state);
    rows_.add_derivatives(state_);
    near_rows_ = std::move(trial.near);
    violation_ = trial.violation;
    return true;
  }

  const Rows& rows_;
  const Transcription& track_;
  double near_;
  SearchControl& control_;
  std::size_t n_;
  Matrix shape_;
  Multipliers known_;  ///< for the curvature, and for where a program's solution may begin

  State state_;
  NearRows near_rows_;  ///< there, until they are the set
  double violation_ = 0.0;
  double price_ = kFirstPrice;
  double stiffness_ = 0.0;    ///< price of changes of shape
  double growth_ = kHarder;   ///< of the stiffness when a step is refused
  bool was_refused_ = false;  ///< a step from this point
  double reach_ = 1.0;        ///< of exact steps: the metric counts that much less
  std::vector<Row> set_;
  QuadraticProgram program_;
  Matrix hessian_;
  Matrix carrying_;
  ShiftedCholesky metric_;
  bool is_factored_ = false;
  // The programs at the point, begun: with other values of their rows they are solved again.
  std::optional<BegunProgram> exact_;
  QuadraticProgram elastic_program_;
  ShiftedCholesky elastic_metric_;
  std::optional<BegunProgram> giving_;
  double gradient_ = 1.0;  ///< its length in the metric
  bool is_elastic_ = false;
  Step step_;
  double length_ = HUGE_VAL;  ///< of the step, over that of the gradient
};

}  // namespace

ElasticEnd descend_elastically(const Rows& rows, const Transcription& track, const Vector& z,
                               const Multipliers& known, double near, SearchControl& control) {
  return ElasticDescent(rows, track, z, known, near, control).run();
}

}  // namespace glissade::optimizer
