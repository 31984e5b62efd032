// A chain is known by its joints, each at an offset along the track's normal at its knot, and by its first heading:
// an arc leaves with the heading that the one before has at its end and is bound for the next joint, so common
// tangents and both end points are exact whatever the offsets are. A small change of the offsets changes the deviation
// by a quadratic spline with continuous slope. The best one is minimax's; the deviation is then measured, and so on.

#include "parts/curves/arc_fit.hpp"

#include "glissade/core/math.hpp"

#include "parts/curves/spline_change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glissade::parts {
namespace {

constexpr int kMostSettling = 6;
constexpr double kFarTurn = 100.0;  // deviations by which a free start's arc may rise
constexpr double kSettled = 0.02;   // relative gain below which the offsets are settled

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
  Fitter(const TrackSamples& samples, const Stretch& stretch, ChainStart start, double middle)
      : samples_(samples), stretch_(stretch), state_(std::move(start)), middle_(middle) {
    start_ = samples.s[stretch.first];
    end_ = samples.s[stretch.last];
  }

  /// The chain with the best offsets and first heading for the joints as they are.
  ArcChain best(double tolerance) {
    ArcChain best = build();
    for (int k = 0; k < kMostSettling; ++k) {
      if (!std::isfinite(best.deviation) || best.deviation <= tolerance) return best;
      const ChainStart good = state_;
      correct(best.deviation);
      ArcChain next = build();
      if (!(next.deviation < best.deviation)) {
        state_ = good;
        return build();
      }
      const bool small = next.deviation > (1.0 - kSettled) * best.deviation;
      best = std::move(next);
      if (small) break;
    }
    return best;
  }

 private:
  [[nodiscard]] std::size_t cells() const { return state_.knots.size() - 1; }
  [[nodiscard]] double width(std::size_t cell) const { return state_.knots[cell + 1] - state_.knots[cell]; }

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

  /// Where the chain lies as seen from where it is to lie, at every sample.
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
      const double offset = -distance_from(here.from, along, here.curvature, samples_.point[j]) - middle_;
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

  /// Moves the joints across the track, and turns a free start, as the best change of the offsets does.
  void correct(double deviation) {
    std::vector<MinimaxRow> rows =
        spline_rows(samples_, stretch_.first + 1, stretch_.last, state_.knots, offset_at_);
    if (rows.empty()) return;
    // An upright start does not lean over.
    const double own = samples_.heading[stretch_.first];
    const double steepest = std::min(own, -0.5 * std::numbers::pi);
    if (!stretch_.before)
      rows.push_back(start_row(0.5 * width(0) * (state_.heading - steepest), kFarTurn * deviation));
    const std::vector<double> x =
        best_change(state_.knots, rows, stretch_.before.has_value(), stretch_.after.has_value()).x;
    for (std::size_t i = 1; i < cells(); ++i) state_.offsets[i] += x[2 * i];
    if (!stretch_.before) state_.heading = std::max(state_.heading + 2.0 * x[1] / width(0), steepest);
  }

  const TrackSamples& samples_;
  Stretch stretch_;
  ChainStart state_;
  double middle_ = 0.0;  // to the left of the track [m]
  double start_ = 0.0;   // arc lengths of the stretch
  double end_ = 0.0;
  std::vector<ArcAt> legs_;
  std::vector<double> offset_at_;  // of the chain at each sample within the stretch [m]
};

}  // namespace

ArcChain fit_chain(const TrackSamples& samples, const Stretch& stretch, ChainStart start, double middle,
                   double tolerance) {
  return Fitter(samples, stretch, std::move(start), middle).best(tolerance);
}

}  // namespace glissade::parts
