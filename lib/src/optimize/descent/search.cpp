#include "optimize/descent/search.hpp"

#include "optimize/algebra/quadratic_program.hpp"
#include "optimize/descent/elastic_descent.hpp"
#include "optimize/descent/programs.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

// Rows this close to their bound take part in a quadratic program.
constexpr double kBand = 0.25;  // taste
// Of the rows' gradients, as shares of the objective's.
constexpr double kMultiplierAccuracy = 1e-15;  // rounding
// On meshes of fewer knots all rows take part in a round of NLopt; on others those that lie this close to
// their bound, and ...
constexpr std::size_t kCoarse = 18;  // budget: a round of SLSQP costs the cube of rows and unknowns
constexpr double kMayMatter = 0.05;  // taste
// A step as short as this leads to no other rows than those.
constexpr double kShortestStep = 0.01;  // taste
// ... those that a round without them broke by this much.
constexpr double kBroken = 0.01;  // taste
// Finer meshes than this are left to our own steps, ...
constexpr std::size_t kMostForRounds = 48;  // budget
// ... and so are those on which they ended outside the limits by as much as this.
constexpr double kContradictory = 1e-2;  // taste
// Newton steps go on until they are this share of what is asked for.
constexpr double kArrived = 0.1;  // taste
// Rows this close to their bound may carry a multiplier, ...
constexpr double kActive = 1e-6;  // accuracy: ten times that of a limit
// ... and Newton steps bring those that do this close to it.
constexpr double kTight = 1e-8;  // accuracy: a tenth of that of a limit
// Newton steps end there, and what is frozen or drawn has its finish to the nanometre.
constexpr double kOnFinish = 1e-11;  // accuracy: of conditions that hold exactly, in chords

/// An objective without bound and rows that say nothing.
void reject(Sample& out, std::size_t n, std::size_t equalities, std::size_t inequalities) {
  out.objective = HUGE_VAL;
  out.gradient.assign(n, 0.0);
  out.equality.assign(equalities, 0.0);
  out.equality_jacobian = Matrix(equalities, n);
  out.inequality.assign(inequalities, 0.0);
  out.inequality_jacobian = Matrix(inequalities, n);
}

/// Minimises on one mesh. Rounds of NLopt lead to where Newton steps converge; these finish, as a line search
/// on the objective's own digits cannot.
class Minimiser {
 public:
  Minimiser(const ScaledProblem& problem, const Mesh& mesh, const Vector& margins, SearchControl& control)
      : problem_(problem),
        control_(control),
        track_(std::make_shared<const Transcription>(mesh)),
        rows_(std::make_shared<Rows>(problem, *track_)),
        n_(track_->layout().size()) {
    rows_->set_margins(margins);
  }

  [[nodiscard]] Found run(const Vector& start, const Found* known) {
    Found found;
    begin(start, known);
    // So many rounds that do not come closer by this factor end the search.
    constexpr double kPays = 0.7;  // taste
    constexpr int kMostIdle = 3;   // budget
    double least = HUGE_VAL;
    int idle = 0;
    for (int round = 0;; ++round) {
      ++control_.rounds;
      approach();
      judge(found);
      if (found.residual <= control_.tolerance && found.violation <= control_.limit_tolerance) break;
      const bool pays = found.residual + found.violation < kPays * least;
      least = std::min(least, found.residual + found.violation);
      idle = pays ? 0 : idle + 1;
      if (round >= control_.most_rounds || idle >= kMostIdle || stopped_ || !may_descend()) break;
      const Vector before = point_.state.z;
      descend_once();
      // The same again would end where it ended before.
      if (point_.state.z == before && !stopped_) break;
    }
    found.stopped = stopped_;
    found.track = track_;
    found.rows = rows_;
    found.z = point_.state.z;
    found.objective = rows_->objective(point_.state);
    return found;
  }

  /// Programs in turn, without a look back: none where their steps do not shrink at once.
  [[nodiscard]] std::optional<Found> approximate(const Vector& start, const Found& known) {
    constexpr int kMostSteps = 3;     // budget
    constexpr double kClose = 2e-5;   // accuracy: far below that of a price
    constexpr double kFast = 1e-3;    // taste: from as close as this the metric of the step before will do
    constexpr double kShrinks = 0.5;  // taste
    begin(start, &known);
    take_in_broken(point_);
    Vector before = by_limit(carried_over(known));
    for (int step = 0; solved(point_); ++step) {
      Vector z = point_.state.z;
      add_scaled(z.data(), 1.0, point_.solution.step.data(), n_);
      if (!track_->is_track(z)) break;
      Vector now = by_limit(point_.next);
      const bool settled = settles(before, now);
      before = std::move(now);
      if (point_.distance <= kClose && settled) return at_end_of_step(std::move(z));
      if (step == kMostSteps || control_.stop()) break;
      ++control_.evaluations;
      Point next = linearised(rows_->state(z, true));
      if (point_.distance < kFast) {
        next.metric = std::move(point_.metric);
      } else {
        set_metric(next, point_.next);
      }
      set_solution(next, point_.next);
      take_in_broken(next);
      if (next.distance > kShrinks * point_.distance) break;
      point_ = std::move(next);
    }
    return std::nullopt;
  }

  [[nodiscard]] Outlook look(const Vector& start, const Found& known, RowsAhead rows) {
    Outlook outlook;
    // The multipliers of the coarser mesh tell which rows to begin with. For the curvature they are not good enough:
    // where they leave it indefinite, the step would be shortened, and less promised than there is.
    point_ = linearised(rows_->state(start, true));
    set_metric(point_, Multipliers{});
    set_solution(point_, carried_over(known));
    if (rows == RowsAhead::broken) take_in_broken(point_);
    renew(point_);
    if (rows == RowsAhead::broken) take_in_broken(point_);
    outlook.step = point_.solution.step;
    outlook.force.assign(n_, 0.0);
    if (!solved(point_)) return outlook;
    outlook.force = point_.program.gradient;
    for (std::size_t i = 0; i < point_.program.equality.rows(); ++i) {
      add_scaled(outlook.force.data(), point_.solution.equality[i], point_.program.equality.row(i), n_);
    }
    for (const std::size_t i : point_.solution.active) {
      add_scaled(outlook.force.data(), point_.solution.inequality[i], point_.program.inequality.row(i), n_);
    }
    outlook.by_limit = by_limit(point_.next);
    // With d^T H d = -force.d = |L^T d|^2.
    outlook.won = -dot(point_.program.gradient.data(), outlook.step.data(), n_) -
                  0.5 * point_.solution.length * point_.solution.length;
    return outlook;
  }

 private:
  /// A point of the search, with the quadratic program there and its solution.
  struct Point {
    State state;
    ShiftedCholesky metric;
    std::vector<Row> set;
    QuadraticProgram program;
    QuadraticSolution solution;
    Multipliers next;       ///< of the solution
    double distance = 0.0;  ///< length of the step over that of the gradient, in the metric
  };

  /// What each limit carries.
  [[nodiscard]] Vector by_limit(const Multipliers& multipliers) const {
    Vector sums(problem_.limits.size(), 0.0);
    for (std::size_t i = 0; i < multipliers.active.size(); ++i) {
      sums[multipliers.active[i].limit] += multipliers.inequality[i];
    }
    for (std::size_t i = 0; i < multipliers.equality.size(); ++i) {
      const std::size_t* const limit = rows_->limit_of_equality(i);
      if (limit != nullptr) sums[*limit] += std::fabs(multipliers.equality[i]);
    }
    return sums;
  }
  /// Whether what limits carry has come to rest from one program to the next.
  [[nodiscard]] static bool settles(const Vector& before, const Vector& now) {
    constexpr double kSame = 5e-3;    // accuracy: a quarter of that of a price
    constexpr double kCounts = 1e-4;  // taste: of the greatest one
    double greatest = 0.0;
    for (const double multiplier : now) greatest = std::max(greatest, multiplier);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (std::fabs(now[i] - before[i]) > kSame * std::max(now[i], kCounts * greatest)) return false;
    }
    return true;
  }

  /// The optimum as the point's program has it.
  [[nodiscard]] Found at_end_of_step(Vector z) const {
    Found found;
    found.track = track_;
    found.rows = rows_;
    found.objective = rows_->objective(rows_->state(z, false));
    found.residual = point_.distance;
    found.z = std::move(z);
    found.equality = point_.next.equality;
    found.active = point_.next.active;
    found.inequality = point_.next.inequality;
    return found;
  }

  void begin(const Vector& start, const Found* known) {
    is_guessed_ = known != nullptr;
    is_known_ = is_known_ || is_guessed_;
    if (known != nullptr) {
      point_ = point(rows_->state(start, true), carried_over(*known));
      return;
    }
    point_ = point(rows_->state(start, true), Multipliers{});
    // With the multipliers of the first program the curvature is that of the Lagrangian.
    renew(point_);
  }

  /// The multipliers of an optimum on another mesh, at the rows closest to theirs. Where this mesh is twice as fine, a limit
  /// that binds all along most likely binds halfway between, too: such rows are named, without a multiplier.
  [[nodiscard]] Multipliers carried_over(const Found& known) const {
    Multipliers multipliers{known.equality, {}, {}};
    const auto add = [&](const Row& row, double value) {
      const auto same = std::find(multipliers.active.begin(), multipliers.active.end(), row);
      if (same == multipliers.active.end()) {
        multipliers.active.push_back(row);
        multipliers.inequality.push_back(value);
      } else {
        multipliers.inequality[static_cast<std::size_t>(same - multipliers.active.begin())] += value;
      }
    };
    std::vector<Row> carrying;
    for (std::size_t i = 0; i < known.active.size(); ++i) {
      if (!(known.inequality[i] > 0.0)) continue;
      add(counterpart(known, known.active[i]), known.inequality[i]);
      carrying.push_back(known.active[i]);
    }
    std::sort(carrying.begin(), carrying.end());
    for (std::size_t i = 0; i < carrying.size(); ++i) {
      for (const Row& row : within(known, carrying[i])) add(row, 0.0);
      if (i + 1 == carrying.size()) break;
      if (const std::optional<Row> row = halfway(known, carrying[i], carrying[i + 1])) add(*row, 0.0);
    }
    return multipliers;
  }

  /// The row at the knot of this mesh halfway between two of another that follow each other, where this one is about twice as
  /// fine.
  [[nodiscard]] std::optional<Row> halfway(const Found& known, const Row& before, const Row& behind) const {
    constexpr double kFiner = 1.7;  // taste
    Row row = before;
    row.place = behind.place;
    const bool follow = row == behind && behind.place == before.place + 1;
    if (!follow || before.foot || problem_.limits[before.limit].measure != Measure::curvature)
      return std::nullopt;
    const double from = knot_at(*known.track, before.place);
    const double to = knot_at(*known.track, behind.place);
    const Vector& knots = track_->mesh().knots;
    if (!(count_pieces(knots, to) - count_pieces(knots, from) > kFiner)) return std::nullopt;
    row.place = nearest_knot(0.5 * (from + to));
    return row;
  }

  /// Of a row on a piece of another mesh those on all pieces of this one that lie within.
  [[nodiscard]] std::vector<Row> within(const Found& known, Row row) const {
    std::vector<Row> rows;
    if (row.foot || problem_.limits[row.limit].measure != Measure::curvature_rate) return rows;
    const Vector& before = known.track->mesh().knots;
    const Vector& knots = track_->mesh().knots;
    const double from = before[row.place];
    const double to = before[row.place + 1];
    for (row.place = 0; row.place + 1 < knots.size(); ++row.place) {
      const double middle = 0.5 * (knots[row.place] + knots[row.place + 1]);
      if (middle > from && middle < to) rows.push_back(row);
    }
    return rows;
  }

  /// The row of this mesh that lies closest to one of another.
  [[nodiscard]] Row counterpart(const Found& known, Row row) const {
    if (row.foot) return row;  // of a corner, whatever the mesh
    const Measure* const measure = problem_.limits[row.limit].measure;
    const Vector& knots = track_->mesh().knots;
    if (measure == Measure::curvature) {
      const double sigma = knot_at(*known.track, row.place);
      const bool moves = !known.track->mesh().borders.empty();
      row.place = nearest_knot(moves ? known.track->share_of_core(known.z, sigma) : sigma);
    } else if (measure == Measure::curvature_rate) {
      const Vector& before = known.track->mesh().knots;
      const double middle = 0.5 * (before[row.place] + before[row.place + 1]);
      const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, middle);
      row.place = static_cast<std::size_t>(above - knots.begin()) - 1;
    } else {
      const Station& station = known.track->stations()[row.place];
      const bool moves = !known.track->mesh().borders.empty();
      row.place = nearest_station(moves ? known.track->arc_length(known.z, station)
                                        : station.arc_length(track_->mesh().core_length));
    }
    return row;
  }

  /// Place of a knot of either kind, of the core's length.
  [[nodiscard]] static double knot_at(const Transcription& track, std::size_t index) {
    const std::size_t own = track.layout().knots;
    return index < own ? track.mesh().knots[index] : track.fine_knots()[index - own].sigma;
  }

  [[nodiscard]] std::size_t nearest_knot(double sigma) const {
    std::size_t nearest = 0;
    const std::size_t count = track_->layout().knots + track_->fine_knots().size();
    for (std::size_t i = 1; i < count; ++i) {
      if (std::fabs(knot_at(*track_, i) - sigma) < std::fabs(knot_at(*track_, nearest) - sigma)) nearest = i;
    }
    return nearest;
  }

  /// Of those at which limits are held.
  [[nodiscard]] std::size_t nearest_station(double s) const {
    const std::vector<Station>& stations = track_->stations();
    const double unit = track_->mesh().core_length;
    const auto above =
        std::lower_bound(stations.begin(), stations.end(), s,
                         [&](const Station& at, double to) { return at.arc_length(unit) < to; });
    auto behind = static_cast<std::size_t>(above - stations.begin());
    while (behind < stations.size() && !stations[behind].watched) ++behind;
    if (behind == stations.size()) return behind - 1;
    if (behind == 0) return 0;
    std::size_t before = behind - 1;
    while (before > 0 && !stations[before].watched) --before;
    return s - stations[before].arc_length(unit) < stations[behind].arc_length(unit) - s ? before : behind;
  }

  /// @param known  for the curvature of the Lagrangian, and for where the program's solution may begin
  [[nodiscard]] Point point(State state, const Multipliers& known) const {
    Point point = linearised(std::move(state));
    set_metric(point, known);
    set_solution(point, known);
    return point;
  }

  /// @param band  rows that close to their bounds take part
  [[nodiscard]] Point linearised(State state, double band = kBand) const {
    Point point;
    QuadraticProgram& program = point.program;
    program.gradient = rows_->objective_gradient(state);
    rows_->equalities(state, program.equality_value, program.equality);
    point.set = rows_->candidates(state, band, &program.inequality_value);
    program.inequality = jacobian_of(*rows_, state, point.set, n_);
    point.state = std::move(state);
    return point;
  }

  void set_metric(Point& point, const Multipliers& known) const {
    Vector equality = known.equality;
    equality.resize(point.program.equality_value.size(), 0.0);
    std::vector<Row> carrying;
    for (std::size_t i = 0; i < known.active.size(); ++i) {
      if (known.inequality[i] > 0.0) carrying.push_back(known.active[i]);
    }
    // Where next to no energy is left, a little of it decides over speeds.
    const bool creeps = std::any_of(carrying.begin(), carrying.end(), [&](const Row& row) {
      return problem_.limits[row.limit].measure == Measure::arrival;
    });
    point.metric = metric_of(rows_->hessian(point.state, equality, known.active, known.inequality, 1.0),
                             point.program.equality, jacobian_of(*rows_, point.state, carrying, n_), creeps);
  }

  void set_solution(Point& point, const Multipliers& known) const {
    std::vector<std::size_t> likely;
    for (const Row& row : known.active) {
      const auto found = std::find(point.set.begin(), point.set.end(), row);
      if (found != point.set.end()) likely.push_back(static_cast<std::size_t>(found - point.set.begin()));
    }
    point.solution = solve(point.program, point.metric, likely);
    point.next = Multipliers{point.solution.equality, {}, {}};
    for (const std::size_t i : point.solution.active) {
      point.next.active.push_back(point.set[i]);
      point.next.inequality.push_back(point.solution.inequality[i]);
    }
    Vector gradient = point.program.gradient;
    point.metric.forward(gradient.data());
    point.distance = point.solution.length / norm(gradient);
  }

  /// The program once more, with the curvature that belongs to its multipliers.
  void renew(Point& point) const {
    const Multipliers known = std::move(point.next);
    set_metric(point, known);
    set_solution(point, known);
  }

  /// Rows too far from their bounds to have a part in the program and broken at the end of its step: once more with them.
  void take_in_broken(Point& point) const {
    constexpr int kMostTimes = 4;  // budget
    for (int time = 0; time < kMostTimes && solved(point); ++time) {
      Vector z = point.state.z;
      add_scaled(z.data(), 1.0, point.solution.step.data(), n_);
      if (!track_->is_track(z)) return;
      const std::size_t known = point.set.size();
      for (const Row& row : rows_->candidates(rows_->state(z, false), -control_.limit_tolerance)) {
        const auto end = point.set.begin() + static_cast<std::ptrdiff_t>(known);
        if (std::find(point.set.begin(), end, row) == end) point.set.push_back(row);
      }
      if (point.set.size() == known) return;
      point.program.inequality_value = values_of(*rows_, point.state, point.set);
      point.program.inequality = jacobian_of(*rows_, point.state, point.set, n_);
      set_solution(point, point.next);
    }
  }

  [[nodiscard]] static bool solved(const Point& point) {
    return point.solution.status == QuadraticSolution::Status::solved;
  }

  /// Close to the optimum, and on the bounds that hold there.
  [[nodiscard]] bool has_arrived(const Point& point) const {
    if (!solved(point) || point.distance > kArrived * control_.tolerance) return false;
    const Vector& values = point.program.inequality_value;
    const auto is_tight = [&](std::size_t row) { return std::fabs(values[row]) <= kTight; };
    return greatest_size(point.program.equality_value) <= kOnFinish &&
           greatest_of(values) <= control_.limit_tolerance &&
           std::all_of(point.solution.active.begin(), point.solution.active.end(), is_tight);
  }

  /// Whether a round of NLopt is worth what it costs: with the cube of the unknowns and all rows nearby.
  [[nodiscard]] bool may_descend() const {
    return !is_contradictory_ && track_->mesh().fine.empty() && track_->mesh().knots.size() <= kMostForRounds;
  }

  [[nodiscard]] bool is_coarse() const { return track_->mesh().knots.size() < kCoarse; }

  /// Newton steps. From far away they are taken only if they arrive.
  void approach() {
    constexpr double kNear = 0.5;  // taste
    if (control_.stop()) stopped_ = true;
    if (stopped_ || has_arrived(point_)) return;
    bool goes_on = solved(point_);
    if (goes_on && point_.distance <= kNear) {
      goes_on = take_steps();
      if (has_arrived(point_)) return;
    }
    Point begun = point_;
    if (solved(point_)) {
      if (goes_on) take_steps();
      if (has_arrived(point_)) return;
      if (is_guessed_) {
        // Multipliers of another mesh may be no good guess.
        begin(begun.state.z, nullptr);
        begun = point_;
        take_steps();
        if (has_arrived(point_)) return;
      }
    }
    point_ = begun;
    if (has_tried_elastic_ || control_.is_close) return;
    has_tried_elastic_ = true;
    take_elastic_steps();
    if (!has_arrived(point_) && !(solved(point_) && is_progress(begun))) point_ = begun;
  }

  /// @return whether more of them may be taken
  bool take_steps() {
    constexpr int kMostSteps = 12;  // budget
    for (int step = 0; step < kMostSteps; ++step) {
      if (!advance() || !solved(point_) || has_arrived(point_)) return false;
      if (control_.stop()) stopped_ = true;
      if (stopped_) return false;
    }
    return true;
  }

  /// Where no step gets shorter: from further away, and on a fine mesh at a tenth of the cost of a round of NLopt.
  void take_elastic_steps() {
    constexpr int kMostTimes = 4;     // budget
    constexpr double kNear = 1e-4;    // taste
    constexpr double kNearer = 1e-2;  // taste
    constexpr double kPays = 1e-4;    // taste: of the objective
    double near = kNear;
    for (int time = 0; time < kMostTimes; ++time) {
      const double before = rows_->objective(point_.state);
      const ElasticEnd end =
          descend_elastically(*rows_, *track_, point_.state.z, point_.next, near, control_);
      if (control_.stop()) stopped_ = true;
      is_contradictory_ = !is_known_ && end.violation > kContradictory;
      if (stopped_ || is_contradictory_ || end.z == point_.state.z) return;
      point_ = point(rows_->state(end.z, true), end.multipliers);
      if (!solved(point_) || has_arrived(point_)) return;
      take_steps();
      if (!solved(point_) || has_arrived(point_)) return;
      const bool is_near = point_.distance <= kNear;
      if (!is_near && !(rows_->objective(point_.state) < before - kPays * std::fabs(before))) return;
      if (is_near) near = kNearer * point_.distance;
    }
  }

  [[nodiscard]] double violation_of(const State& state) const {
    return std::max(greatest_size(rows_->equality_values(state)),
                    greatest_of(values_of(*rows_, state, rows_->candidates(state, 0.0))));
  }

  /// Whether a point is to be kept that is no optimum: it is the better one, and breaks limits no more.
  [[nodiscard]] bool is_progress(const Point& from) const {
    if (!track_->is_track(point_.state.z)) return false;
    const double broken = violation_of(point_.state);
    return broken <= std::max(control_.limit_tolerance, violation_of(from.state)) &&
           rows_->objective(point_.state) < rows_->objective(from.state);
  }

  /// The part of the step after which the next one, in the same metric, is shorter.
  /// Source: P. Deuflhard, "Newton Methods for Nonlinear Problems" (2004), the natural monotonicity test.
  /// @return false if there is none
  [[nodiscard]] bool advance() {
    constexpr double kParts[] = {1.0, 0.5, 0.2};  // taste
    constexpr double kShorter = 0.3;              // theory: below 1, the natural monotonicity test
    // A metric that makes the steps this much shorter is kept: another would cost more than a step.
    constexpr double kFast = 0.1;    // taste
    constexpr double kClose = 1e-3;  // taste
    for (const double part : kParts) {
      Vector z = point_.state.z;
      add_scaled(z.data(), part, point_.solution.step.data(), n_);
      if (!track_->is_track(z)) continue;
      ++control_.evaluations;
      Point next = linearised(rows_->state(z, true), point_.distance < kShortestStep ? kMayMatter : kBand);
      next.metric = point_.metric;
      set_solution(next, point_.next);
      if (!solved(next)) continue;
      if (next.distance > (1.0 - kShorter * part) * point_.distance && !has_arrived(next)) continue;
      const bool is_fast = point_.distance < kClose && next.distance < kFast * point_.distance;
      point_ = std::move(next);
      if (is_fast || has_arrived(point_)) return true;
      renew(point_);
      return true;
    }
    return false;
  }

  /// How far the steepest descent would break a row.
  [[nodiscard]] static double greatest_along(const QuadraticProgram& program, const ShiftedCholesky& metric) {
    Vector step = program.gradient;
    metric.forward(step.data());
    metric.backward(step.data());
    double greatest = 0.0;
    for (std::size_t i = 0; i < program.inequality.rows(); ++i) {
      greatest = std::max(greatest, std::fabs(dot(program.inequality.row(i), step.data(), step.size())));
    }
    return greatest;
  }

  /// First-order optimality of the point, from the rows that are tight there.
  void judge(Found& found) const {
    const State& state = point_.state;
    found.violation = violation_of(state);
    if (!track_->is_track(state.z) || !std::isfinite(rows_->objective(state))) found.violation = HUGE_VAL;
    if (has_arrived(point_)) {
      found.residual = point_.distance;
      found.equality = point_.next.equality;
      found.active = point_.next.active;
      found.inequality = point_.next.inequality;
      return;
    }
    QuadraticProgram program;
    program.gradient = point_.program.gradient;
    program.equality = point_.program.equality;
    program.equality_value.assign(program.equality.rows(), 0.0);
    found.active = rows_->candidates(state, kActive);
    program.inequality = jacobian_of(*rows_, state, found.active, n_);
    program.inequality_value.assign(found.active.size(), 0.0);
    program.tolerance = kMultiplierAccuracy * greatest_along(program, point_.metric);
    // The shortest sum of the gradient and the rows, nu >= 0: the step of the program whose rows are all tight.
    const QuadraticSolution shortest = solve(program, point_.metric);
    Vector gradient = program.gradient;
    point_.metric.forward(gradient.data());
    found.residual = shortest.length / norm(gradient);
    found.equality = shortest.equality;
    found.inequality = shortest.inequality;
  }

  /// The rows that can matter on the way: tight where the step leads, or near. All of them on a coarse mesh.
  [[nodiscard]] std::vector<Row> working_set() const {
    if (is_coarse()) return rows_->candidates(point_.state, HUGE_VAL);
    std::vector<Row> set;
    for (std::size_t i = 0; i < point_.set.size(); ++i) {
      const double now = point_.program.inequality_value[i];
      const double then = now + dot(point_.program.inequality.row(i), point_.solution.step.data(), n_);
      if (std::max(now, then) > -kMayMatter) set.push_back(point_.set[i]);
    }
    return set;
  }

  /// A round of NLopt. Where it breaks rows that had no part in it, it is repeated with them.
  void descend_once() {
    constexpr int kMostRepeats = 4;  // budget
    std::vector<Row> set = working_set();
    std::sort(set.begin(), set.end());
    for (int repeat = 0;; ++repeat) {
      State end;
      stopped_ = descend_with(set, end);
      if (end.z.empty()) return;
      const std::size_t known = set.size();
      if (repeat < kMostRepeats && !stopped_) add_broken(end, set);
      if (set.size() > known) continue;
      // Twice: the second time with the curvature of the first one's multipliers.
      point_ = point(std::move(end), point_.next);
      renew(point_);
      return;
    }
  }

  /// Adds the rows that come near to their bounds at a state where one of them is broken that is not in the set.
  void add_broken(const State& state, std::vector<Row>& set) const {
    std::vector<Row> more;
    bool is_broken = false;
    for (const Row& row : rows_->candidates(state, kMayMatter)) {
      if (std::binary_search(set.begin(), set.end(), row)) continue;
      more.push_back(row);
      is_broken = is_broken || rows_->value(state, row) > kBroken;
    }
    if (!is_broken) return;
    set.insert(set.end(), more.begin(), more.end());
    std::sort(set.begin(), set.end());
  }

  /// @param end  where it led, or nothing where that is no track
  /// @return whether it was asked to end
  [[nodiscard]] bool descend_with(const std::vector<Row>& set, State& end) const {
    const std::size_t equalities = rows_->equality_count();
    const SampleFunction sample = [&](const Vector& at, Sample& out) {
      if (!track_->is_track(at)) {
        reject(out, n_, equalities, set.size());
        return;
      }
      end = rows_->state(at, true);
      out.objective = rows_->objective(end);
      out.gradient = rows_->objective_gradient(end);
      rows_->equalities(end, out.equality, out.equality_jacobian);
      out.inequality = values_of(*rows_, end, set);
      out.inequality_jacobian = jacobian_of(*rows_, end, set, n_);
    };
    DescentOptions options;
    // Then the metric is old: with 40 the same problems take a quarter longer.
    options.most_evaluations = 16;
    const Descent descent =
        descend(sample, point_.state.z, equalities, set.size(), point_.metric, options, control_.stop);
    control_.evaluations += descent.evaluations;
    if (!track_->is_track(descent.z)) {
      end = State{};
    } else if (end.z != descent.z) {
      end = rows_->state(descent.z, true);
    }
    return descent.stopped;
  }

  const ScaledProblem& problem_;
  SearchControl& control_;
  std::shared_ptr<const Transcription> track_;
  std::shared_ptr<Rows> rows_;
  std::size_t n_;
  Point point_;
  bool is_known_ = false;    ///< a track near an optimum was given
  bool is_guessed_ = false;  ///< the multipliers of the first point are of another mesh
  bool has_tried_elastic_ = false;
  bool is_contradictory_ = false;  ///< on this mesh, as far as steps of our own can tell
  bool stopped_ = false;
};

}  // namespace

Found minimise(const ScaledProblem& problem, const Mesh& mesh, const Vector& start, const Vector& margins,
               SearchControl& control, const Found* known) {
  return Minimiser(problem, mesh, margins, control).run(start, known);
}

std::optional<Found> approximated(const ScaledProblem& problem, const Mesh& mesh, const Vector& z,
                                  const Vector& margins, SearchControl& control, const Found& known) {
  return Minimiser(problem, mesh, margins, control).approximate(z, known);
}

Outlook look_ahead(const ScaledProblem& problem, const Mesh& mesh, const Vector& z, const Vector& margins,
                   SearchControl& control, const Found& known, RowsAhead rows) {
  return Minimiser(problem, mesh, margins, control).look(z, known, rows);
}

GuessCurve curve_of(const Transcription& track, const Vector& z) {
  GuessCurve curve;
  Shape shape;
  track.shape(z, shape, false);
  curve.length = track.core_length(z);
  for (std::size_t i = 0; i < track.stations().size(); ++i) {
    const Station& station = track.stations()[i];
    if (station.part != Part::core) continue;
    const double share = track.share_of_core(z, station.sigma);
    if (!curve.sigma.empty() && share <= curve.sigma.back()) continue;
    curve.sigma.push_back(share);
    curve.zeta.push_back(shape.zeta[i]);
  }
  if (curve.sigma.front() > 0.0) {
    curve.sigma.insert(curve.sigma.begin(), 0.0);
    curve.zeta.insert(curve.zeta.begin(), z[track.layout().angle()]);
  }
  return curve;
}

}  // namespace glissade::optimizer
