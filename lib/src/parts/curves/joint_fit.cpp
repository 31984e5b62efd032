// To first order an arc lies delta beside the track with delta'' = its curvature - kappa, so that a chain with common
// tangents is a quadratic spline Q with continuous slope less the integral of the track's heading, F. Q is kept by its
// Bezier ordinates, one at each joint and one for each arc; those of the arcs alone give a spline (de Boor), and
// 2 F(middle) - (F(from) + F(to)) / 2 of each arc one that is close to F whatever the joints are. The best spline is minimax's.

#include "parts/curves/joint_fit.hpp"

#include "parts/curves/minimax.hpp"
#include "parts/curves/spline_change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kFirstMove = 0.1;  // of a joint, as a share of the shorter cell beside it
constexpr double kMostMove = 0.3;
constexpr double kLeastMove = 2e-3;
constexpr double kFaster = 1.5;  // moves after one that paid
constexpr double kSlower = 0.4;  // and after one that did not
constexpr int kMostRounds = 24;
constexpr int kTrialRounds = 6;
constexpr double kHopeless = 2.0;    // tolerances, after the trial rounds
constexpr double kSlowGain = 0.01;   // relative gain of a round that is slow
constexpr double kRowsMiss = 1.005;  // of what the rows tell, by a sample between them
constexpr double kFarTurn = 100.0;   // deviations by which a free start's arc may rise
constexpr double kMovingGap = 1e-2;  // of minimax(), where joints move
constexpr int kMostSlow = 3;         // slow rounds in a row that end the search

class JointFitter {
 public:
  JointFitter(const TrackSamples& samples, const Stretch& stretch, ChainStart start, double middle)
      : samples_(samples), stretch_(stretch), start_(std::move(start)), middle_(middle) {
    begin_ = samples.s[stretch.first];
    end_ = samples.s[stretch.last];
    sums_ = {0.0};
    for (std::size_t j = stretch.first; j < stretch.last; ++j) {
      const double mean = 0.5 * (heading_at(j) + heading_at(j + 1));
      sums_.push_back(sums_.back() + mean * (samples.s[j + 1] - samples.s[j]));
    }
    // An upright start does not lean over.
    const double own = samples.heading[stretch.first];
    lowest_slope_ = std::min(own, -0.5 * std::numbers::pi) - own;
    dropped_.assign(2 * cells() + 1, false);
    dropped_.front() = dropped_.back() = true;
    if (stretch_.before && stretch_.before->reach == 0.0) dropped_[1] = true;
    if (stretch_.after && stretch_.after->reach == 0.0) dropped_[2 * cells() - 1] = true;
  }

  FittedJoints best(double tolerance) {
    State best = settled(start_.knots);
    double move = kFirstMove;
    int slow = 0;
    for (int round = 0; round < kMostRounds && move >= kLeastMove && slow < kMostSlow; ++round) {
      if (!(best.deviation > tolerance) || !std::isfinite(best.deviation)) break;
      if (round >= kTrialRounds && best.deviation > kHopeless * tolerance) break;
      State next = settled(moved(best, move));
      if (next.deviation < best.deviation) {
        slow = next.deviation > (1.0 - kSlowGain) * best.deviation ? slow + 1 : 0;
        best = std::move(next);
        move = std::min(kFaster * move, kMostMove);
      } else {
        move *= kSlower;
      }
    }
    return {joints_of(best), deviations(best), best.deviation};
  }

 private:
  /// Joints with the spline between them.
  struct State {
    std::vector<double> knots;
    std::vector<double> ordinates;  // of Q: one a joint, between them one an arc [m]
    std::vector<double> offsets;    // of the samples, from where the chain is to lie [m]
    double deviation = std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] std::size_t cells() const { return start_.knots.size() - 1; }
  [[nodiscard]] static double width(const State& state, std::size_t cell) {
    return state.knots[cell + 1] - state.knots[cell];
  }
  [[nodiscard]] double heading_at(std::size_t sample) const {
    return samples_.heading[sample] - samples_.heading[stretch_.first];
  }

  /// F at an arc length, the heading between samples as if it turned evenly, and the heading there.
  struct Integral {
    double sum = 0.0;
    double heading = 0.0;
  };
  [[nodiscard]] Integral integral(double s) const {
    const auto first = samples_.s.begin() + static_cast<std::ptrdiff_t>(stretch_.first);
    const auto last = samples_.s.begin() + static_cast<std::ptrdiff_t>(stretch_.last);
    const auto after = std::upper_bound(first + 1, last, s);
    const auto i = static_cast<std::size_t>(after - samples_.s.begin()) - 1;
    const double u = s - samples_.s[i];
    const double bend = (heading_at(i + 1) - heading_at(i)) / (samples_.s[i + 1] - samples_.s[i]);
    return {sums_[i - stretch_.first] + (heading_at(i) + 0.5 * bend * u) * u, heading_at(i) + bend * u};
  }

  /// The line of a kept piece as an ordinate and a slope of Q at a place that it reaches.
  [[nodiscard]] Integral kept_at(const KeptEnd& kept, double from, double s) const {
    const double turned = wrapped(kept.leg.heading - samples_.heading[stretch_.first]);
    const Integral there = integral(from);
    const double u = s - from;
    return {there.sum + (turned + 0.5 * kept.leg.curvature * u) * u, turned + kept.leg.curvature * u};
  }

  /// A spline close to the track.
  [[nodiscard]] std::vector<double> near_track(const std::vector<double>& knots) const {
    const std::size_t n = cells();
    std::vector<double> ordinates(2 * n + 1);
    for (std::size_t i = 0; i < n; ++i) {
      const double middle = integral(0.5 * (knots[i] + knots[i + 1])).sum;
      ordinates[2 * i + 1] = 2.0 * middle - 0.5 * (integral(knots[i]).sum + integral(knots[i + 1]).sum);
    }
    ordinates.front() = integral(knots.front()).sum;
    ordinates.back() = integral(knots.back()).sum;
    if (stretch_.before) {
      const Integral kept = kept_at(*stretch_.before, begin_, knots.front());
      ordinates.front() = kept.sum;
      ordinates[1] = kept.sum + 0.5 * kept.heading * (knots[1] - knots[0]);
    }
    if (stretch_.after) {
      const Integral kept = kept_at(*stretch_.after, end_, knots.back());
      ordinates.back() = kept.sum;
      ordinates[2 * n - 1] = kept.sum - 0.5 * kept.heading * (knots[n] - knots[n - 1]);
    }
    for (std::size_t i = 1; i < n; ++i) {
      const double before = knots[i] - knots[i - 1];
      const double after = knots[i + 1] - knots[i];
      ordinates[2 * i] = (after * ordinates[2 * i - 1] + before * ordinates[2 * i + 1]) / (before + after);
    }
    return ordinates;
  }

  /// The best spline for some joints.
  [[nodiscard]] State settled(std::vector<double> knots) const {
    State state{std::move(knots), {}, {}, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < cells(); ++i) {
      if (!(state.knots[i] < state.knots[i + 1])) return state;  // nor what is not a number
    }
    state.ordinates = near_track(state.knots);
    measure(state);
    // Rows are some samples only: once more where another one lies farther.
    for (int k = 0; k < 3; ++k) {
      const std::vector<MinimaxRow> rows = rows_of(state);
      if (rows.empty()) return state;
      const auto [x, most] =
          best_change(state.knots, rows, stretch_.before.has_value(), stretch_.after.has_value());
      State next = state;
      for (std::size_t j = 0; j < x.size(); ++j) next.ordinates[j] += x[j];
      measure(next);
      if (next.deviation < state.deviation) state = std::move(next);
      if (state.deviation < kRowsMiss * most) break;
    }
    return state;
  }

  /// The greatest offset of each arc.
  [[nodiscard]] std::vector<double> deviations(const State& state) const {
    std::vector<double> most(cells(), 0.0);
    std::size_t cell = 0;
    for (std::size_t k = 0; k < state.offsets.size(); ++k) {
      while (cell + 1 < cells() && samples_.s[stretch_.first + 1 + k] >= state.knots[cell + 1]) ++cell;
      most[cell] = std::max(most[cell], std::fabs(state.offsets[k]));
    }
    return most;
  }

  /// How far the chain lies from where it is to lie, at every sample.
  void measure(State& state) const {
    state.offsets.clear();
    state.deviation = 0.0;
    std::size_t cell = 0;
    for (std::size_t j = stretch_.first + 1; j < stretch_.last; ++j) {
      const double s = samples_.s[j];
      while (cell + 1 < cells() && s >= state.knots[cell + 1]) ++cell;
      const double* q = &state.ordinates[2 * cell];
      const double v = (s - state.knots[cell]) / width(state, cell);
      // Beside the chain lie the kept pieces, which are where they are.
      const bool outside = v < 0.0 || v > 1.0;
      const double at = (1.0 - v) * ((1.0 - v) * q[0] + 2.0 * v * q[1]) + v * v * q[2];
      const double offset = outside ? 0.0 : at - sums_[j - stretch_.first] - middle_;
      state.offsets.push_back(offset);
      if (!(std::fabs(offset) <= state.deviation)) state.deviation = std::fabs(offset);
    }
  }

  [[nodiscard]] std::vector<MinimaxRow> rows_of(const State& state) const {
    std::vector<MinimaxRow> rows =
        spline_rows(samples_, stretch_.first + 1, stretch_.last, state.knots, state.offsets);
    if (!stretch_.before && !rows.empty()) {
      const double half = 0.5 * width(state, 0);
      const double more = state.ordinates[1] - state.ordinates[0] - half * lowest_slope_;
      rows.push_back(start_row(more, kFarTurn * state.deviation));
    }
    return rows;
  }

  /// Curvature before a knot less that after it; at the ends against the kept pieces.
  [[nodiscard]] double jump(const State& state, std::size_t knot) const {
    const auto curvature = [&](std::size_t cell) {
      const double* q = &state.ordinates[2 * cell];
      return 2.0 * (q[0] - 2.0 * q[1] + q[2]) / (width(state, cell) * width(state, cell));
    };
    const double before = knot > 0 ? curvature(knot - 1) : stretch_.before->leg.curvature;
    const double after = knot < cells() ? curvature(knot) : stretch_.after->leg.curvature;
    return before - after;
  }
  /// Whether a knot may move: within the chain, or along a kept piece that reaches on.
  [[nodiscard]] bool moves(std::size_t knot) const {
    if (knot == 0) return stretch_.before && stretch_.before->reach > 0.0;
    return knot < cells() || (stretch_.after && stretch_.after->reach > 0.0);
  }
  /// The shorter of the cells beside a knot.
  [[nodiscard]] double room_at(const State& state, std::size_t knot) const {
    if (knot == 0) return width(state, 0);
    if (knot == cells()) return width(state, knot - 1);
    return std::min(width(state, knot - 1), width(state, knot));
  }

  /// Slope after a knot less slope before it, times a width: a length, as the other rows are.
  [[nodiscard]] MinimaxRow kink_row(const State& state, std::size_t knot, double move) const {
    const double shorter = room_at(state, knot);
    MinimaxRow kink{0, {}, 0.0, 0.0, 0.0, 0.0};
    if (knot == 0) {
      kink.value = {-2.0, 2.0, 0.0};
    } else if (knot == cells()) {
      kink.first = 2 * knot - 2;
      kink.value = {0.0, 2.0, -2.0};
    } else {
      const double before = shorter / width(state, knot - 1);
      const double after = shorter / width(state, knot);
      kink.first = 2 * knot - 1;
      kink.value = {2.0 * before, -2.0 * (before + after), 2.0 * after};
    }
    kink.room = std::max(std::fabs(jump(state, knot)) * move * shorter * shorter, 1e-9 * shorter * shorter);
    return kink;
  }

  /// The change of the ordinates that brings the chain closest, with kinks that the joints may take up by moving.
  [[nodiscard]] std::vector<double> change(const State& state, double move) const {
    std::vector<MinimaxRow> rows = rows_of(state);
    for (std::size_t i = 0; i <= cells(); ++i) {
      if (moves(i)) rows.push_back(kink_row(state, i, move));
    }
    return minimax(rows, dropped_, kMovingGap).x;
  }

  /// The joints where the kinks of the best change vanish: a joint that moves by m has m times its jump.
  [[nodiscard]] std::vector<double> moved(const State& state, double move) const {
    const std::vector<double> x = change(state, move);
    std::vector<double> knots = state.knots;
    for (std::size_t i = 0; i <= cells(); ++i) {
      if (!moves(i)) continue;
      const double after = i < cells() ? 2.0 * (x[2 * i + 1] - x[2 * i]) / width(state, i) : 0.0;
      const double before = i > 0 ? 2.0 * (x[2 * i] - x[2 * i - 1]) / width(state, i - 1) : 0.0;
      const double most = move * room_at(state, i);
      const double bend = jump(state, i);
      if (bend != 0.0) knots[i] += std::clamp((after - before) / bend, -most, most);
    }
    if (moves(0)) knots.front() = std::clamp(knots.front(), begin_, begin_ + stretch_.before->reach);
    if (moves(cells())) knots.back() = std::clamp(knots.back(), end_ - stretch_.after->reach, end_);
    return knots;
  }

  [[nodiscard]] ChainStart joints_of(const State& state) const {
    if (state.ordinates.empty()) return start_;
    ChainStart joints{state.knots, {}, start_.heading};
    for (std::size_t i = 0; i <= cells(); ++i)
      joints.offsets.push_back(state.ordinates[2 * i] - integral(state.knots[i]).sum);
    const double slope = 2.0 * (state.ordinates[1] - state.ordinates[0]) / width(state, 0);
    joints.heading = samples_.heading[stretch_.first] + std::max(slope, lowest_slope_);
    return joints;
  }

  const TrackSamples& samples_;
  Stretch stretch_;
  ChainStart start_;
  double middle_ = 0.0;  // to the left of the track [m]
  double begin_ = 0.0;   // arc lengths of the stretch
  double end_ = 0.0;
  double lowest_slope_ = 0.0;  // of a free start, off the track's
  std::vector<double> sums_;   // F, one a sample of the stretch
  std::vector<bool> dropped_;  // columns that ends and kept tangents fix
};

}  // namespace

FittedJoints fit_joints(const TrackSamples& samples, const Stretch& stretch, ChainStart start, double middle,
                        double tolerance) {
  return JointFitter(samples, stretch, std::move(start), middle).best(tolerance);
}

}  // namespace glissade::parts
