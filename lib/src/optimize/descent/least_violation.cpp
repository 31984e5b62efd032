#include "optimize/descent/least_violation.hpp"

#include "optimize/algebra/quadratic_program.hpp"
#include "optimize/descent/programs.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

// Rows this much further from their bound than the worst one take part in a step.
constexpr double kBehindWorst = 0.3;  // taste
// Curvature of the model along t and s: it bounds the first guess of a step, and is without effect at the end.
constexpr double kOwnCurvature = 0.1;  // taste: without effect at the end
// A violation below this is none.
constexpr double kNone = 1e-9;  // accuracy: a hundredth of that of a limit
// Rows that are to be kept give way too at first, by these shares of what the elastic ones do: the track that
// breaks everything a little leads over to the one that breaks one limit alone.
constexpr double kFirmer[] = {0.1, 1e-2, 1e-4, 1e-7};  // taste
// What is kept has to be broken by this much less each time.
constexpr double kFalls = 0.8;  // taste
// Where they are broken by less the end of the path is near.
constexpr double kNearlyKept = 1e-4;  // taste
// A step whose model promises less, at the price 1 on the change of shape, is none.
constexpr double kSettled = 1e-9;  // accuracy: a hundredth of that of a limit
// So is one that promises less than this share of the violation.
constexpr double kShare = 1e-5;  // accuracy: far below what tells one track from another

class ViolationSearch {
 public:
  ViolationSearch(const ScaledProblem& problem, const Mesh& mesh, const Elastic& elastic,
                  const Vector& margins, SearchControl& control, StepModel model)
      : elastic_(elastic),
        control_(control),
        model_(model),
        track_(std::make_shared<const Transcription>(mesh)),
        rows_(std::make_shared<Rows>(problem, *track_)),
        problem_(problem),
        n_(track_->layout().size()),
        shape_metric_(shape_metric(*track_)) {
    rows_->set_margins(margins);
  }

  [[nodiscard]] Relaxed run(const Vector& start) {
    z_ = start;
    state_ = rows_->state(z_, true);
    Relaxed relaxed;
    ++control_.rounds;
    double kept_before = HUGE_VAL;
    for (const double weight : kFirmer) {
      weight_ = weight;
      Near here = near(state_);
      t_ = violation(state_, here);
      linearise(std::move(here));
      relaxed.settled = settle();
      const double kept = kept_violation();
      // Where the others cannot be kept however far the elastic ones give way, the path leads nowhere.
      const bool hopeless = kept > kFalls * kept_before;
      kept_before = kept;
      if (t_ <= kNone || all_give_way() || hopeless || control_.stop()) break;
      if (kept <= kNearlyKept && arrive()) break;
    }
    describe(relaxed);
    return relaxed;
  }

 private:
  [[nodiscard]] bool gives_way(const Row& row) const { return elastic_.limits[row.limit]; }
  [[nodiscard]] bool gives_way(std::size_t equality) const {
    const std::size_t* limit = rows_->limit_of_equality(equality);
    return limit == nullptr ? elastic_.equalities : static_cast<bool>(elastic_.limits[*limit]);
  }
  [[nodiscard]] bool all_give_way() const {
    for (std::size_t i = 0; i < rows_->equality_count(); ++i) {
      if (!gives_way(i)) return false;
    }
    return std::all_of(elastic_.limits.begin(), elastic_.limits.end(), [](bool gives) { return gives; });
  }
  template <typename RowOrEquality>
  [[nodiscard]] double weight(const RowOrEquality& row) const {
    return gives_way(row) ? 1.0 : weight_;
  }

  /// Steps until none lowers t by more than a share of it. @return false if it ended before
  [[nodiscard]] bool settle() {
    constexpr int kMostSteps = 60;         // budget
    constexpr double kHighestPrice = 1e9;  // taste
    price_ = 1.0;
    growth_ = 2.0;
    for (int step = 0; step < kMostSteps; ++step) {
      if (t_ <= kNone) return false;
      if (control_.stop()) return false;
      const double promised = propose();
      if (promised * std::max(price_, 1.0) <= kSettled + kShare * t_) return true;
      if (!advance(promised) && price_ > kHighestPrice) return false;
    }
    return false;
  }

  /// The shortest steps to where the rows that are to be kept are kept: the rest of the path at once. What t might fall
  /// by on a longer one is not worth that.
  /// @return false, and nothing has moved, where they do not lead there
  [[nodiscard]] bool arrive() {
    constexpr int kMostSteps = 6;      // budget
    constexpr double kCloser = 0.3;    // theory: below 1
    constexpr double kKept = 1e-10;    // accuracy: a thousandth of that of a limit
    constexpr double kMostOfT = 1.1;   // taste: further away is another valley
    constexpr double kStiffest = 1e3;  // taste: the price on the change of shape
    const Vector z_before = z_;
    const double t_before = t_;
    const double weight_before = weight_;
    const std::vector<std::size_t> likely_before = likely_;
    weight_ = 0.0;
    price_ = kStiffest;
    double kept = kept_violation();
    for (int step = 0; step < kMostSteps && kept > kKept; ++step) {
      t_ = elastic_violation();
      linearise(near(state_));
      (void)propose();
      Vector z = z_;
      add_scaled(z.data(), 1.0, solution_.step.data(), n_);
      if (solution_.status != QuadraticSolution::Status::solved || !track_->is_track(z)) break;
      z_ = std::move(z);
      state_ = rows_->state(z_, true);
      ++control_.evaluations;
      const double before = kept;
      kept = kept_violation();
      if (kept > std::max(kCloser * before, kKept)) break;
    }
    t_ = elastic_violation();
    if (kept <= kKept && t_ <= kMostOfT * t_before) return true;
    weight_ = weight_before;
    likely_ = likely_before;
    z_ = z_before;
    state_ = rows_->state(z_, true);
    return false;
  }

  /// What the elastic rows give way by at the point.
  [[nodiscard]] double elastic_violation() const {
    double t = 0.0;
    const Vector equality = rows_->equality_values(state_);
    for (std::size_t i = 0; i < equality.size(); ++i) {
      if (gives_way(i)) t = std::max(t, std::fabs(equality[i]));
    }
    Vector values;
    const std::vector<Row> broken = rows_->candidates(state_, 0.0, &values);
    for (std::size_t i = 0; i < broken.size(); ++i) {
      if (gives_way(broken[i])) t = std::max(t, values[i]);
    }
    return t;
  }

  /// Rows close to their bounds at a state, and their values.
  struct Near {
    std::vector<Row> rows;
    Vector values;
  };
  [[nodiscard]] Near near(const State& state) const {
    Near near;
    near.rows = rows_->candidates(state, kBehindWorst, &near.values);
    return near;
  }

  /// The t by which the rows would have to give way at a state; 0 if all are kept.
  [[nodiscard]] double violation(const State& state, const Near& near) const {
    double t = 0.0;
    const Vector equality = rows_->equality_values(state);
    for (std::size_t i = 0; i < equality.size(); ++i) t = std::max(t, std::fabs(equality[i]) / weight(i));
    for (std::size_t i = 0; i < near.rows.size(); ++i) t = std::max(t, near.values[i] / weight(near.rows[i]));
    return t;
  }

  [[nodiscard]] double kept_violation() const {
    double kept = 0.0;
    const Vector equality = rows_->equality_values(state_);
    for (std::size_t i = 0; i < equality.size(); ++i) {
      if (!gives_way(i)) kept = std::max(kept, std::fabs(equality[i]));
    }
    Vector values;
    const std::vector<Row> broken = rows_->candidates(state_, 0.0, &values);
    for (std::size_t i = 0; i < broken.size(); ++i) {
      if (!gives_way(broken[i])) kept = std::max(kept, values[i]);
    }
    return kept;
  }

  /// Rows of a program: both sides of each equality, the set, and t >= 0. Its last unknown is what t changes by.
  [[nodiscard]] std::size_t row_count() const { return 2 * rows_->equality_count() + set_.size() + 1; }

  void linearise(Near near) {
    std::vector<Row> active_rows;
    std::vector<std::size_t> likely;
    const std::size_t equalities = rows_->equality_count();
    for (const std::size_t i : likely_) {
      if (i < 2 * equalities) {
        likely.push_back(i);
      } else if (i - 2 * equalities < set_.size()) {
        active_rows.push_back(set_[i - 2 * equalities]);
      }
    }
    set_ = std::move(near.rows);
    for (const Row& row : active_rows) {
      const auto found = std::find(set_.begin(), set_.end(), row);
      if (found == set_.end()) continue;
      likely.push_back(2 * equalities + static_cast<std::size_t>(found - set_.begin()));
    }
    likely_ = std::move(likely);

    program_.inequality = Matrix(row_count(), n_ + 1);
    Vector equality;
    Matrix jacobian;
    rows_->equalities(state_, equality, jacobian);
    for (std::size_t i = 0; i < equalities; ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        double* row = program_.inequality.row(2 * i + side);
        add_scaled(row, side == 0 ? 1.0 : -1.0, jacobian.row(i), n_);
        row[n_] = -weight(i);
      }
    }
    for (std::size_t i = 0; i < set_.size(); ++i) {
      double* row = program_.inequality.row(2 * equalities + i);
      rows_->gradient(state_, set_[i], row);
      row[n_] = -weight(set_[i]);
    }
    program_.inequality(row_count() - 1, n_) = -1.0;
    program_.inequality_value = row_values(equality, near.values);
    update_curvature();
  }

  /// Values of the program's rows at a state, less what they are given by t now.
  [[nodiscard]] Vector row_values(const State& state) const {
    Vector of_set;
    of_set.reserve(set_.size());
    for (const Row& row : set_) of_set.push_back(rows_->value(state, row));
    return row_values(rows_->equality_values(state), of_set);
  }
  [[nodiscard]] Vector row_values(const Vector& equality, const Vector& of_set) const {
    Vector values;
    values.reserve(row_count());
    for (std::size_t i = 0; i < equality.size(); ++i) {
      values.push_back(equality[i] - weight(i) * t_);
      values.push_back(-equality[i] - weight(i) * t_);
    }
    for (std::size_t i = 0; i < set_.size(); ++i) values.push_back(of_set[i] - weight(set_[i]) * t_);
    values.push_back(-t_);
    return values;
  }

  /// The Lagrangian's Hessian, of the rows that held t up in the last program.
  void update_curvature() {
    curvature_ = Matrix(n_, n_);
    if (solution_.inequality.empty() || model_ == StepModel::flat) return;
    curvature_ = rows_->hessian(state_, equality_, active_, inequality_, 0.0);
  }

  /// Of the rows that held t up in the last program those that still do: with other weights others do.
  [[nodiscard]] std::vector<std::size_t> holding_t_up() const {
    constexpr double kNearBound = 0.1;  // taste: of what t gives a row
    std::vector<std::size_t> holding;
    for (const std::size_t row : likely_) {
      const double given = -program_.inequality(row, n_) * t_;
      if (program_.inequality_value[row] >= -kNearBound * given) holding.push_back(row);
    }
    return holding;
  }

  /// The factor of price x shape + curvature; where that is not convex, with a penalty on leaving the rows that held t
  /// up, which is without effect where they go on doing so, and then with a higher price.
  void factor() {
    constexpr double kHigher = 4.0;                           // taste
    constexpr int kMostTries = 20;                            // budget
    constexpr double kPenalties[] = {0.0, 1.0, 10.0, 100.0};  // taste
    const std::vector<std::size_t> holding = holding_t_up();
    Vector diagonal(n_ + 1, 0.0);
    for (int tries = 0; tries < kMostTries; ++tries, price_ *= kHigher) {
      Matrix hessian(n_ + 1, n_ + 1);
      for (std::size_t i = 0; i < n_; ++i) {
        for (std::size_t j = 0; j < n_; ++j) {
          hessian(i, j) = price_ * shape_metric_(i, j) + curvature_(i, j);
        }
        diagonal[i] = price_ * shape_metric_(i, i);
      }
      hessian(n_, n_) = diagonal[n_] = kOwnCurvature / std::max(1.0, t_);
      double penalty = 0.0;
      for (const double next : kPenalties) {
        if (next > 0.0 && holding.empty()) break;
        for (const std::size_t row : holding) {
          const double* const gradient = program_.inequality.row(row);
          for (std::size_t i = 0; i <= n_ && next > 0.0; ++i) {
            if (gradient[i] != 0.0)
              add_scaled(hessian.row(i), (next - penalty) * gradient[i], gradient, n_ + 1);
          }
        }
        penalty = next;
        metric_ = ShiftedCholesky(hessian, diagonal, 0.0);
        if (metric_.shift() == 0.0) return;
      }
    }
  }

  /// Solves the program at the point. @return how much it promises to lower t by
  [[nodiscard]] double propose() {
    factor();
    program_.gradient.assign(n_ + 1, 0.0);
    program_.gradient[n_] = 1.0;
    solution_ = solve(program_, metric_, likely_);
    likely_ = solution_.active;
    remember_multipliers();
    return -solution_.step[n_];
  }

  void remember_multipliers() {
    const std::size_t equalities = rows_->equality_count();
    equality_.assign(equalities, 0.0);
    active_.clear();
    inequality_.clear();
    for (const std::size_t i : solution_.active) {
      const double multiplier = solution_.inequality[i];
      if (i < 2 * equalities) {
        equality_[i / 2] += i % 2 == 0 ? multiplier : -multiplier;
      } else if (i < 2 * equalities + set_.size()) {
        active_.push_back(set_[i - 2 * equalities]);
        inequality_.push_back(multiplier);
      }
    }
  }

  struct Trial {
    State state;  ///< without derivatives; none where the step leads to no track
    Near near;
    double t = HUGE_VAL;
  };
  [[nodiscard]] Trial tried(const Vector& step) const {
    Trial trial;
    Vector z = z_;
    add_scaled(z.data(), 1.0, step.data(), n_);
    if (!track_->is_track(z)) return trial;
    trial.state = rows_->state(z, false);
    ++control_.evaluations;
    trial.near = near(trial.state);
    trial.t = violation(trial.state, trial.near);
    return trial;
  }

  /// The step again, the rows having the values that they really have at its end: where they bend, the step
  /// follows.
  [[nodiscard]] Trial corrected(const State& reached) const {
    QuadraticProgram program = program_;
    const Vector there = row_values(reached);
    for (std::size_t i = 0; i + 1 < there.size(); ++i) {
      program.inequality_value[i] = there[i] - dot(program.inequality.row(i), solution_.step.data(), n_);
    }
    return tried(solve(program, metric_, solution_.active).step);
  }

  /// Takes the step if it keeps part of its promise, and sets the price of the next one. @return if it did
  bool advance(double promised) {
    constexpr double kGood = 0.75;        // theory: usual bounds of a trust region
    constexpr double kFall = 0.25;        // theory: usual bounds of a trust region
    constexpr double kWorthwhile = 1e-3;  // theory: usual bounds of a trust region
    Trial trial = tried(solution_.step);
    double share = (t_ - trial.t) / promised;
    if (share < kGood && !trial.state.z.empty()) {
      Trial again = corrected(trial.state);
      if (again.t < trial.t) {
        trial = std::move(again);
        share = (t_ - trial.t) / promised;
      }
    }
    if (!(share > kWorthwhile)) {
      price_ *= growth_;
      growth_ *= 2.0;
      return false;
    }
    constexpr double kLowestPrice = 1e-6;  // taste
    const double shift = 2.0 * std::min(share, 1.0) - 1.0;
    price_ = std::max(kLowestPrice, price_ * std::max(kFall, 1.0 - shift * shift * shift));
    growth_ = 2.0;
    state_ = std::move(trial.state);
    rows_->add_derivatives(state_);
    z_ = state_.z;
    t_ = trial.t;
    linearise(std::move(trial.near));
    return true;
  }

  void describe(Relaxed& relaxed) {
    Found& found = relaxed.found;
    relaxed.t = t_;
    found.track = track_;
    found.rows = rows_;
    found.z = z_;
    found.objective = rows_->objective(state_);
    found.violation = kept_violation();
    found.stopped = control_.stop();
    found.equality = equality_;
    found.equality.resize(rows_->equality_count(), 0.0);
    found.active = active_;
    found.inequality = inequality_;
  }

  const Elastic& elastic_;
  SearchControl& control_;
  StepModel model_;
  std::shared_ptr<const Transcription> track_;
  std::shared_ptr<Rows> rows_;
  const ScaledProblem& problem_;
  std::size_t n_;
  Matrix shape_metric_;

  double price_ = 1.0;   ///< on the change of shape
  double growth_ = 2.0;  ///< of the price when a step is refused
  Vector z_;
  State state_;
  double t_ = 0.0;
  double weight_ = 1.0;  ///< of t in the rows that are to be kept in the end
  std::vector<Row> set_;
  QuadraticProgram program_;
  Matrix curvature_;
  ShiftedCholesky metric_;
  QuadraticSolution solution_;
  std::vector<std::size_t> likely_;
  Vector equality_;
  std::vector<Row> active_;
  Vector inequality_;
};

}  // namespace

Relaxed least_violation(const ScaledProblem& problem, const Mesh& mesh, const Vector& start,
                        const Elastic& elastic, const Vector& margins, SearchControl& control,
                        StepModel model) {
  return ViolationSearch(problem, mesh, elastic, margins, control, model).run(start);
}

}  // namespace glissade::optimizer
