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

constexpr int kMostRounds = 20;
constexpr double kFirstMove = 0.3;  // of a joint, as a share of the shorter cell beside it
constexpr double kLeastMove = 1e-3;
constexpr double kHopeless = 2.5;  // tolerances, after the first rounds
constexpr double kSettled = 3e-3;  // relative gain below which a round is the last one
constexpr double kRamp = 0.5;      // of the first and the last cell, in which a band to one side opens
constexpr double kLeastWeight = 0.02;
constexpr std::size_t kRowsPerCell =
    20;  // of the linear programme; the farthest sample of each cell is one more

double wrapped(double angle) {
  const double turn = 2.0 * std::numbers::pi;
  return angle - turn * std::nearbyint(angle / turn);
}

/// @return sin(x) / x
double sinc(double x) {
  return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : math::sin(x) / x;
}

Vec2 direction_of(double heading) {
  const auto [sine, cosine] = math::sine_cosine(heading);
  return {cosine, sine};
}

Vec2 left_of(double heading) {
  const Vec2 along = direction_of(heading);
  return {-along.y, along.x};
}

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

/// The biarc between two points with two headings whose joint comes closest to a given place.
/// @return its joint; the second arc starts there with the heading that the first one ends with
Vec2 biarc_joint(Vec2 from, double heading, Vec2 to, double end_heading, Vec2 wanted) {
  // Joints lie on the circle through both ends that makes equal angles with both tangents (K. M. Bolton, CAD 1975).
  const Vec2 chord = to - from;
  const double chord_angle = math::atan2(chord.y, chord.x);
  const double lean = 0.5 * (wrapped(heading - chord_angle) - wrapped(end_heading - chord_angle));
  const double share = std::clamp(dot(wanted - from, chord) / dot(chord, chord), 0.05, 0.95);
  // From the end of the locus: its centre may be far away.
  const double distance = norm(chord) * share * sinc(lean * share) / sinc(lean);
  return from + distance * direction_of(chord_angle + lean * (1.0 - share));
}

/// An arc from the end of one leg that touches the circle of another.
struct Touching {
  ArcAt leg;
  double length = 0.0;
  double beyond = 0.0;  ///< along the other leg from where that is known, to the place that is touched
};

/// @return none where the arc would run backwards or turn by more than a right angle
std::optional<Touching> touching(const ArcAt& from, const ArcAt& other) {
  // Both centres and the place that is touched lie on one line: C - T = N/k, O - T = N/kappa. Multiplied by k and kappa,
  // so that either may be 0.
  const Vec2 away = from.from - other.from;
  const Vec2 normal = left_of(from.heading);
  const Vec2 other_normal = left_of(other.heading);
  const double kappa = other.curvature;
  const double turn = wrapped(other.heading - from.heading);
  const double above = kappa * dot(away, normal) + 1.0 - math::cos(turn);
  const double below = 0.5 * kappa * dot(away, away) - dot(away, other_normal);
  Touching found{from, 0.0, 0.0};
  const double k = -above / below;
  if (!std::isfinite(k) || k == 0.0 || k == kappa) return std::nullopt;
  found.leg.curvature = k;
  const Vec2 at_touch = (1.0 / (kappa - k)) * ((k * kappa) * away + kappa * normal - k * other_normal);
  const double heading = math::atan2(-at_touch.x, at_touch.y);
  found.length = wrapped(heading - from.heading) / k;
  if (!(found.length > 0.0) || std::fabs(found.length * k) > 0.5 * std::numbers::pi) return std::nullopt;
  const Vec2 chord = found.leg.after(found.length).from - other.from;
  const double half = 0.5 * wrapped(heading - other.heading);
  const double size = norm(chord) / sinc(half);
  found.beyond = dot(chord, direction_of(other.heading + half)) < 0.0 ? -size : size;
  return found;
}

class Fitter {
 public:
  Fitter(const TrackSamples& samples, const Stretch& stretch, std::vector<double> knots, const Band& band)
      : samples_(samples), stretch_(stretch), band_(band), knots_(std::move(knots)) {
    offsets_.assign(knots_.size(), 0.0);
    heading_ = samples.heading[stretch.first];
    start_ = samples.s[stretch.first];
    end_ = samples.s[stretch.last];
    opening_ = kRamp * width(0);
    closing_ = kRamp * width(cells() - 1);
    dropped_.assign(2 * cells() + 1, false);
    dropped_.front() = dropped_.back() = true;
    if (stretch_.before && stretch_.before->reach == 0.0) dropped_[1] = true;
    if (stretch_.after && stretch_.after->reach == 0.0) dropped_[2 * cells() - 1] = true;
  }

  ArcChain best(double tolerance) {
    ArcChain best;
    best.deviation = std::numeric_limits<double>::infinity();
    State good = state();
    double move = kFirstMove;
    for (int round = 0; round < kMostRounds; ++round) {
      ArcChain chain = build();
      const double before = best.deviation;
      if (chain.deviation < before) {
        best = std::move(chain);
        good = state();
      } else {
        restore(good);
        if (!std::isfinite(build().deviation)) return best;
        move *= 0.3;
      }
      if (best.deviation <= tolerance) return best;
      if (round > 2 && best.deviation < before && best.deviation > (1.0 - kSettled) * before) return best;
      if (move < kLeastMove) return best;
      if (round > 3 && best.deviation > kHopeless * tolerance) return best;
      correct(move);
    }
    return best;
  }

 private:
  /// What a chain is known by.
  struct State {
    std::vector<double> knots;
    std::vector<double> offsets;
    double heading = 0.0;
  };
  [[nodiscard]] State state() const { return {knots_, offsets_, heading_}; }
  void restore(const State& state) {
    knots_ = state.knots;
    offsets_ = state.offsets;
    heading_ = state.heading;
  }

  [[nodiscard]] std::size_t cells() const { return knots_.size() - 1; }
  [[nodiscard]] double width(std::size_t cell) const { return knots_[cell + 1] - knots_[cell]; }

  /// Width of the band relative to that far from the ends.
  [[nodiscard]] double weight_at(double s) const {
    if (band_.middle == 0.0) return 1.0;
    const double after = (s - samples_.s[stretch_.first]) / opening_;
    const double before = (samples_.s[stretch_.last] - s) / closing_;
    return std::clamp(std::min(after, before), kLeastWeight, 1.0);
  }
  [[nodiscard]] double middle_at(double s) const {
    return band_.middle == 0.0 ? 0.0 : band_.middle * weight_at(s);
  }

  /// The three Bernstein polynomials of a place in a cell: delta is piecewise quadratic, its values at the knots shared.
  [[nodiscard]] MinimaxRow row_at(double s, std::size_t cell) const {
    const double v = (s - knots_[cell]) / width(cell);
    return {2 * cell, {(1.0 - v) * (1.0 - v), 2.0 * v * (1.0 - v), v * v}, 0.0, weight_at(s), weight_at(s),
            0.0};
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

  ArcChain build() {
    ArcChain chain;
    legs_.clear();
    const std::size_t n = cells();
    Vec2 at = samples_.point[stretch_.first];
    Vec2 end = samples_.point[stretch_.last];
    double heading = heading_;
    double end_heading = samples_.heading[stretch_.last];
    if (stretch_.before) {
      chain.first_reach = knots_.front() - start_;
      const ArcAt leg = stretch_.before->leg.after(chain.first_reach);
      at = leg.from;
      heading = leg.heading;
    }
    if (stretch_.after) {
      chain.last_reach = end_ - knots_.back();
      const ArcAt leg = stretch_.after->leg.after(-chain.last_reach);
      end = leg.from;
      end_heading = leg.heading;
    }
    if (n == 1 && stretch_.after) {
      const Vec2 chord = end - at;
      heading = 2.0 * math::atan2(chord.y, chord.x) - end_heading;
    }
    for (std::size_t i = 1; i < n; ++i) {
      const TrackPoint place = between(samples_, knots_[i]);
      Vec2 to = place.point + offsets_[i] * left_of(place.heading);
      if (i + 1 == n && stretch_.after) to = biarc_joint(at, heading, end, end_heading, to);
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
    for (std::size_t j = stretch_.first + 1; j < stretch_.last; ++j) {
      while (cell + 1 < cells() && samples_.s[j] >= knots_[cell + 1]) ++cell;
      const double offset = -leg_at(samples_.s[j], cell).distance(samples_.point[j]);
      offset_at_.push_back(offset);
      const double size = std::fabs(offset - middle_at(samples_.s[j])) / weight_at(samples_.s[j]);
      if (!(size <= chain.deviation)) chain.deviation = size;
    }
  }

  /// The leg beside a place within a cell, or on a kept piece that reaches so far.
  [[nodiscard]] const ArcAt& leg_at(double s, std::size_t cell) const {
    if (stretch_.before && s < knots_.front()) return stretch_.before->leg;
    if (stretch_.after && s >= knots_.back()) return stretch_.after->leg;
    return legs_[cell];
  }

  void add_cell_rows(std::vector<MinimaxRow>& rows, std::size_t cell) const {
    const auto index_of = [&](double s) {
      const auto place = std::lower_bound(samples_.s.begin(), samples_.s.end(), s);
      const auto i = static_cast<std::size_t>(place - samples_.s.begin());
      return std::clamp(i, stretch_.first + 1, stretch_.last);
    };
    const std::size_t first = index_of(knots_[cell]);
    const std::size_t last = index_of(knots_[cell + 1]);
    const auto add = [&](std::size_t j) {
      rows.push_back(row_at(samples_.s[j], cell));
      rows.back().base = offset_at_[j - stretch_.first - 1] - middle_at(samples_.s[j]);
    };
    const std::size_t count = last - first;
    const std::size_t taken = std::min(count, kRowsPerCell);
    for (std::size_t k = 0; k < taken; ++k) add(first + k * count / taken);
    std::size_t farthest = first;
    for (std::size_t j = first; j < last; ++j) {
      const auto size = [&](std::size_t i) {
        return std::fabs(offset_at_[i - stretch_.first - 1] - middle_at(samples_.s[i]));
      };
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
    const std::vector<double> old = knots_;
    std::vector<double> moved = knots_;
    std::vector<double> offsets = offsets_;
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
    if (!stretch_.before) heading_ += 2.0 * x[1] / width(0);
    knots_ = std::move(moved);
    offsets_ = std::move(offsets);
  }

  const TrackSamples& samples_;
  Stretch stretch_;
  Band band_;
  double start_ = 0.0;  // arc lengths of the stretch
  double end_ = 0.0;
  std::vector<double> knots_;    // arc lengths of the joints
  std::vector<double> offsets_;  // of the joints, to the left of the track [m]
  double opening_ = 0.0;         // lengths in which the band opens and closes [m]
  double closing_ = 0.0;
  double heading_ = 0.0;       // of the first arc
  std::vector<bool> dropped_;  // columns that ends and kept tangents fix
  std::vector<ArcAt> legs_;
  std::vector<double> offset_at_;  // of the chain at each sample within the stretch [m]
};

}  // namespace

double ArcAt::distance(Vec2 point) const {
  const Vec2 along = direction_of(heading);
  const Vec2 away = point - from;
  const double u = dot(along, away);
  const double v = cross(along, away);
  const double left = 1.0 - curvature * v;
  const double grade = math::hypot(curvature * u, left);
  return 2.0 * (v - 0.5 * curvature * (u * u + v * v)) / (1.0 + grade);
}

ArcAt ArcAt::after(double length) const {
  const double half = 0.5 * curvature * length;
  return {from + (length * sinc(half)) * direction_of(heading + half), heading + 2.0 * half, curvature};
}

ArcChain fit_chain(const TrackSamples& samples, const Stretch& stretch, std::vector<double> knots,
                   const Band& band, double tolerance) {
  return Fitter(samples, stretch, std::move(knots), band).best(tolerance);
}

ArcChain tangent_arc(const TrackSamples& samples, const Stretch& stretch) {
  constexpr int kPlaces = 32;
  ArcChain best;
  best.deviation = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPlaces; ++i) {
    const double reach = stretch.before->reach * i / kPlaces;
    const ArcAt from = stretch.before->leg.after(reach);
    const auto arc = touching(from, stretch.after->leg);
    if (!arc || arc->beyond > 0.0 || arc->beyond < -stretch.after->reach) continue;
    ArcChain chain;
    chain.first_reach = reach;
    chain.last_reach = -arc->beyond;
    const double starts = samples.s[stretch.first] + reach;
    const double ends = samples.s[stretch.last] - chain.last_reach;
    for (std::size_t j = stretch.first + 1; j < stretch.last; ++j) {
      const ArcAt& leg = samples.s[j] < starts ? stretch.before->leg
                         : samples.s[j] < ends ? arc->leg
                                               : stretch.after->leg;
      chain.deviation = std::max(chain.deviation, std::fabs(leg.distance(samples.point[j])));
    }
    if (!(chain.deviation < best.deviation)) continue;
    chain.vertices = {{from.from, math::tan(0.25 * arc->leg.curvature * arc->length)},
                      {stretch.after->leg.after(arc->beyond).from, 0.0}};
    best = std::move(chain);
  }
  return best;
}

}  // namespace glissade::parts
