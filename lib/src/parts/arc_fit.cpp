// A chain is known by its joints, each at an offset along the track's normal at its knot, and by its first heading:
// an arc leaves with the heading that the one before has at its end and is bound for the next joint, so common
// tangents and both end points are exact whatever the offsets are. A small change of the offsets changes the deviation
// by a piecewise quadratic delta with delta'' = change of curvature; a joint that moves by m along the track gives it a
// kink of m times the jump of curvature there. The best such change, the moves within a part of a cell, is minimax's;
// the deviation is then measured, and so on.

#include "parts/arc_fit.hpp"

#include "glissade/core/math.hpp"

#include "parts/minimax.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glissade::parts {
namespace {

// Measured over the shipped designs at six tolerances: a first move of 0.05 to 0.2 finds the same chains to 1 in 200.
constexpr double kFirstMove = 0.1;  // of a joint, as a share of the shorter cell beside it
constexpr double kMostMove = 0.3;
constexpr double kLeastMove = 1e-3;
constexpr double kFaster = 1.5;  // moves after one that paid
constexpr double kSlower = 0.3;  // and after one that did not
constexpr int kMostRounds = 20;
constexpr int kTrialRounds = 4;
constexpr double kHopeless = 2.5;   // tolerances, after the trial rounds
constexpr double kSlowGain = 0.01;  // relative gain of a round that is slow
constexpr int kMostSlow = 3;        // slow rounds in a row that end the search
constexpr int kMostSettling = 4;
constexpr double kSettled = 0.02;  // relative gain below which the offsets are settled
constexpr std::size_t kRowsPerCell =
    20;  // of the linear programme; the farthest sample of each cell is one more

/// The track between samples, by the arc that its neighbours' points and headings make.
struct TrackPoint {
  Vec2 point;
  double heading = 0.0;
};

TrackPoint between(const TrackSamples& samples, double s) {
  const auto after = std::upper_bound(samples.s.begin() + 1, samples.s.end() - 1, s);
  const auto i = static_cast<std::size_t>(after - samples.s.begin());
  const double share = (s - samples.s[i - 1]) / (samples.s[i] - samples.s[i - 1]);
  if (share <= 0.0) return {samples.point[i - 1], samples.heading[i - 1]};
  if (share >= 1.0) return {samples.point[i], samples.heading[i]};
  const Vec2 chord = samples.point[i] - samples.point[i - 1];
  const double turned = wrapped(samples.heading[i] - samples.heading[i - 1]);
  const Vec2 left{-chord.y, chord.x};
  const double sag = -0.5 * turned * share * (1.0 - share);
  return {samples.point[i - 1] + share * chord + sag * left, samples.heading[i - 1] + share * turned};
}

/// The share of a biarc's locus whose joint comes closest to a given place.
double share_near(Vec2 wanted, Vec2 from, Vec2 to) {
  const Vec2 chord = to - from;
  return std::clamp(dot(wanted - from, chord) / dot(chord, chord), 0.05, 0.95);
}

class Fitter {
 public:
  Fitter(const TrackSamples& samples, const Stretch& stretch, ChainStart start)
      : samples_(samples), stretch_(stretch), state_(std::move(start)) {
    start_ = samples.s[stretch.first];
    end_ = samples.s[stretch.last];
    dropped_.assign(2 * cells() + 1, false);
    dropped_.front() = dropped_.back() = true;
    if (stretch_.before && stretch_.before->reach == 0.0) dropped_[1] = true;
    if (stretch_.after && stretch_.after->reach == 0.0) dropped_[2 * cells() - 1] = true;
  }

  /// Moves the joints as long as that brings the chain closer; each move is judged by the best offsets at its joints.
  ArcChain best(double tolerance) {
    ArcChain best = settled(tolerance);
    ChainStart good = state_;
    double move = kFirstMove;
    int slow = 0;
    for (int round = 0; round < kMostRounds && move >= kLeastMove && slow < kMostSlow; ++round) {
      if (best.deviation <= tolerance || !std::isfinite(best.deviation)) return best;
      if (round >= kTrialRounds && best.deviation > kHopeless * tolerance) return best;
      correct(move);
      ArcChain chain = settled(tolerance);
      if (chain.deviation < best.deviation) {
        slow = chain.deviation > (1.0 - kSlowGain) * best.deviation ? slow + 1 : 0;
        best = std::move(chain);
        good = state_;
        move = std::min(kFaster * move, kMostMove);
      } else {
        state_ = good;
        build();
        move *= kSlower;
      }
    }
    return best;
  }

 private:
  /// The chain with the best offsets and first heading for the joints as they are.
  ArcChain settled(double tolerance) {
    ArcChain chain = build();
    for (int k = 0; k < kMostSettling; ++k) {
      if (!std::isfinite(chain.deviation) || chain.deviation <= tolerance) return chain;
      const ChainStart good = state_;
      correct(0.0);
      ArcChain next = build();
      if (!(next.deviation < chain.deviation)) {
        state_ = good;
        build();
        return chain;
      }
      const bool small = next.deviation > (1.0 - kSettled) * chain.deviation;
      chain = std::move(next);
      if (small) break;
    }
    return chain;
  }

  [[nodiscard]] std::size_t cells() const { return state_.knots.size() - 1; }
  [[nodiscard]] double width(std::size_t cell) const { return state_.knots[cell + 1] - state_.knots[cell]; }

  /// The three Bernstein polynomials of a place in a cell: delta is piecewise quadratic, its values at the knots shared.
  [[nodiscard]] MinimaxRow row_at(double s, std::size_t cell) const {
    const double v = (s - state_.knots[cell]) / width(cell);
    return {2 * cell, {(1.0 - v) * (1.0 - v), 2.0 * v * (1.0 - v), v * v}, 0.0, 1.0, 1.0, 0.0};
  }

  /// Adds the arc from the present place and heading to a point.
  void go_to(ArcChain& chain, Vec2& at, double& heading, Vec2 to) {
    const Vec2 chord = to - at;
    const double half = wrapped(math::atan2(chord.y, chord.x) - heading);
    const double distance = norm(chord);
    if (!(distance > 0.0) || std::fabs(half) > 1.5) chain.deviation = std::numeric_limits<double>::infinity();
    chain.vertices.push_back({at, math::tan(0.5 * half)});
    legs_.push_back({at, heading, 2.0 * math::sin(half) / distance});
    heading += 2.0 * half;
    at = to;
  }

  /// Puts a knot beside its joint; false where that is not between its neighbours.
  bool move_knot(std::size_t knot, Vec2 joint) {
    for (int k = 0; k < 2; ++k) {
      const TrackPoint place = between(samples_, state_.knots[knot]);
      const Vec2 along = direction_of(place.heading);
      state_.knots[knot] += dot(joint - place.point, along);
      state_.offsets[knot] = dot(joint - place.point, left_of(along));
    }
    return state_.knots[knot - 1] < state_.knots[knot] && state_.knots[knot] < state_.knots[knot + 1];
  }

  ArcChain build() {
    ArcChain chain;
    legs_.clear();
    const std::size_t n = cells();
    Vec2 at = samples_.point[stretch_.first];
    Vec2 end = samples_.point[stretch_.last];
    double heading = state_.heading;
    double end_heading = samples_.heading[stretch_.last];
    if (stretch_.before) {
      chain.first_reach = state_.knots.front() - start_;
      const ArcAt leg = stretch_.before->leg.after(chain.first_reach);
      at = leg.from;
      heading = leg.heading;
    }
    if (stretch_.after) {
      chain.last_reach = end_ - state_.knots.back();
      const ArcAt leg = stretch_.after->leg.after(-chain.last_reach);
      end = leg.from;
      end_heading = leg.heading;
    }
    if (n == 1 && stretch_.after) {
      const Vec2 chord = end - at;
      heading = 2.0 * math::atan2(chord.y, chord.x) - end_heading;
    }
    for (std::size_t i = 1; i < n; ++i) {
      const TrackPoint place = between(samples_, state_.knots[i]);
      Vec2 to = place.point + state_.offsets[i] * left_of(direction_of(place.heading));
      if (i + 1 == n && stretch_.after) {
        to = biarc_joint(at, heading, end, end_heading, share_near(to, at, end));
        if (!move_knot(i, to)) chain.deviation = std::numeric_limits<double>::infinity();
      }
      go_to(chain, at, heading, to);
    }
    go_to(chain, at, heading, end);
    chain.vertices.push_back({at, 0.0});
    measure(chain);
    return chain;
  }

  /// Where the chain lies as seen from the track, at every sample.
  void measure(ArcChain& chain) {
    offset_at_.clear();
    std::size_t cell = 0;
    const ArcAt* leg = nullptr;
    Vec2 along;
    for (std::size_t j = stretch_.first + 1; j < stretch_.last; ++j) {
      while (cell + 1 < cells() && samples_.s[j] >= state_.knots[cell + 1]) ++cell;
      const ArcAt& here = leg_at(samples_.s[j], cell);
      if (&here != leg) along = direction_of(here.heading);
      leg = &here;
      const double offset = -distance_from(here.from, along, here.curvature, samples_.point[j]);
      offset_at_.push_back(offset);
      if (!(std::fabs(offset) <= chain.deviation)) chain.deviation = std::fabs(offset);
    }
  }

  /// The leg beside a place within a cell, or on a kept piece that reaches so far.
  [[nodiscard]] const ArcAt& leg_at(double s, std::size_t cell) const {
    if (stretch_.before && s < state_.knots.front()) return stretch_.before->leg;
    if (stretch_.after && s >= state_.knots.back()) return stretch_.after->leg;
    return legs_[cell];
  }

  void add_cell_rows(std::vector<MinimaxRow>& rows, std::size_t cell) const {
    const auto index_of = [&](double s) {
      const auto place = std::lower_bound(samples_.s.begin(), samples_.s.end(), s);
      const auto i = static_cast<std::size_t>(place - samples_.s.begin());
      return std::clamp(i, stretch_.first + 1, stretch_.last);
    };
    const std::size_t first = index_of(state_.knots[cell]);
    const std::size_t last = index_of(state_.knots[cell + 1]);
    const auto add = [&](std::size_t j) {
      rows.push_back(row_at(samples_.s[j], cell));
      rows.back().base = offset_at_[j - stretch_.first - 1];
    };
    const std::size_t count = last - first;
    const std::size_t taken = std::min(count, kRowsPerCell);
    for (std::size_t k = 0; k < taken; ++k) add(first + k * count / taken);
    std::size_t farthest = first;
    for (std::size_t j = first; j < last; ++j) {
      const auto size = [&](std::size_t i) { return std::fabs(offset_at_[i - stretch_.first - 1]); };
      if (size(j) > size(farthest)) farthest = j;
    }
    if (farthest < last) add(farthest);
  }

  /// Of the curvature at a knot; at the ends that against the kept pieces.
  [[nodiscard]] double jump(std::size_t knot) const {
    const double before = knot > 0 ? legs_[knot - 1].curvature : stretch_.before->leg.curvature;
    const double after = knot < cells() ? legs_[knot].curvature : stretch_.after->leg.curvature;
    return before - after;
  }
  /// Whether a knot may move: within the chain, or along a kept piece that reaches on.
  [[nodiscard]] bool moves(std::size_t knot) const {
    if (knot == 0) return stretch_.before && stretch_.before->reach > 0.0;
    return knot < cells() || (stretch_.after && stretch_.after->reach > 0.0);
  }
  /// The shorter of the cells beside a knot.
  [[nodiscard]] double room_at(std::size_t knot) const {
    if (knot == 0) return width(0);
    return knot < cells() ? std::min(width(knot - 1), width(knot)) : width(knot - 1);
  }

  /// Slope after a knot less slope before it, times a width: a length, as the other rows are.
  [[nodiscard]] MinimaxRow kink_row(std::size_t knot, double move) const {
    const double shorter = room_at(knot);
    MinimaxRow kink{0, {}, 0.0, 0.0, 0.0, 0.0};
    if (knot == 0) {
      kink = {0, {-2.0, 2.0, 0.0}, 0.0, 0.0, 0.0, 0.0};
    } else if (knot == cells()) {
      kink = {2 * knot - 2, {0.0, 2.0, -2.0}, 0.0, 0.0, 0.0, 0.0};
    } else {
      const double before = shorter / width(knot - 1);
      const double after = shorter / width(knot);
      kink = {2 * knot - 1, {2.0 * before, -2.0 * (before + after), 2.0 * after}, 0.0, 0.0, 0.0, 0.0};
    }
    kink.room = std::max(std::fabs(jump(knot)) * move * shorter * shorter, 1e-9 * shorter * shorter);
    return kink;
  }

  void correct(double move) {
    std::vector<MinimaxRow> rows;
    for (std::size_t cell = 0; cell < cells(); ++cell) add_cell_rows(rows, cell);
    for (std::size_t i = 0; i <= cells(); ++i) {
      if (moves(i)) rows.push_back(kink_row(i, move));
    }
    if (rows.empty()) return;
    apply(minimax(rows, dropped_).x, move);
  }

  /// How far a knot goes for a change of the slope on both its sides.
  [[nodiscard]] double step_of(std::size_t knot, const std::vector<double>& x, double move) const {
    const double after = knot < cells() ? 2.0 * (x[2 * knot + 1] - x[2 * knot]) / width(knot) : 0.0;
    const double before = knot > 0 ? 2.0 * (x[2 * knot] - x[2 * knot - 1]) / width(knot - 1) : 0.0;
    const double most = move * room_at(knot);
    return jump(knot) == 0.0 ? 0.0 : std::clamp((after - before) / jump(knot), -most, most);
  }

  void apply(const std::vector<double>& x, double move) {
    const std::vector<double> old = state_.knots;
    std::vector<double> moved = state_.knots;
    std::vector<double> offsets = state_.offsets;
    for (std::size_t i = 1; i < cells(); ++i) {
      const double step = step_of(i, x, move);
      const std::size_t cell = step > 0.0 ? i : i - 1;
      moved[i] = old[i] + step;
      const TrackPoint place = between(samples_, moved[i]);
      const MinimaxRow row = row_at(moved[i], cell);
      offsets[i] = -legs_[cell].distance(place.point);
      for (std::size_t k = 0; k < 3; ++k) offsets[i] += row.value[k] * x[row.first + k];
    }
    if (moves(0))
      moved.front() = std::clamp(old.front() + step_of(0, x, move), start_, start_ + stretch_.before->reach);
    if (moves(cells()))
      moved.back() = std::clamp(old.back() + step_of(cells(), x, move), end_ - stretch_.after->reach, end_);
    if (!stretch_.before) {
      // An upright start does not lean over.
      const double own = samples_.heading[stretch_.first];
      const double steepest = std::min(own, -0.5 * std::numbers::pi);
      state_.heading = std::max(state_.heading + 2.0 * x[1] / width(0), steepest);
    }
    state_.knots = std::move(moved);
    state_.offsets = std::move(offsets);
  }

  const TrackSamples& samples_;
  Stretch stretch_;
  ChainStart state_;
  double start_ = 0.0;  // arc lengths of the stretch
  double end_ = 0.0;
  std::vector<bool> dropped_;  // columns that ends and kept tangents fix
  std::vector<ArcAt> legs_;
  std::vector<double> offset_at_;  // of the chain at each sample within the stretch [m]
};

}  // namespace

ArcChain fit_chain(const TrackSamples& samples, const Stretch& stretch, ChainStart start, double tolerance) {
  return Fitter(samples, stretch, std::move(start)).best(tolerance);
}

}  // namespace glissade::parts
