#include "optimize/switches.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

// Knots before and behind a jump, in shares of the core length: near enough for what the ramp costs, far
// enough for the place to be met.
constexpr double kPair = 1e-3;  // taste
// Where the core joins a straight that is given, the place is known.
constexpr double kJoint = 1e-4;  // taste: a tenth of a pair
// A jump is seen from the track this many pieces before and behind it.
constexpr double kWindow = 4.0;  // taste
// And counts as one if it is this large a share of the curvature there.
constexpr double kJump = 0.1;  // taste

/// A place counted in pieces: 2.25 lies a quarter into the third.
double count_pieces(const Vector& knots, double sigma) {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, sigma);
  const auto i = static_cast<std::size_t>(above - knots.begin()) - 1;
  return static_cast<double>(i) + std::clamp((sigma - knots[i]) / (knots[i + 1] - knots[i]), 0.0, 1.0);
}

/// By how much a limit may be left alone between two places where it binds: a linear curvature cannot follow
/// that of a load.
double slack_within(const Measure& measure) {
  constexpr double kOfLoad = 0.1;  // taste
  constexpr double kElse = 1e-5;   // accuracy: a hundred times that of a limit
  return measure.is_load() ? kOfLoad : kElse;
}

/// Places where a limit that carries a price begins or ceases to bind, counted in pieces.
std::vector<double> ends_of_binding(const ScaledProblem& problem, const Found& found) {
  constexpr double kEnd = 1e-6;  // accuracy: ten times that of a limit
  const Mesh& mesh = found.track->mesh();
  std::vector<double> price(problem.limits.size(), 0.0);
  for (std::size_t k = 0; k < found.active.size(); ++k) price[found.active[k].limit] += found.inequality[k];
  const std::vector<std::vector<Span>> bindings = bindings_of(problem, found);
  std::vector<double> ends;
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    if (price[i] <= 0.0 || !problem.limits[i].measure->holds_along()) continue;
    // A load that a linear curvature misses next to an end of the core is held up to there all the same: a body
    // that flies off with little speed bends more in the first pieces than they can follow.
    constexpr double kJoined = 3.0;  // taste
    const double last = static_cast<double>(mesh.knots.size() - 1);
    const bool load = problem.limits[i].measure->is_load();
    for (const Span& span : bindings[i]) {
      for (const double place : {span.from, span.to}) {
        const double at = count_pieces(mesh.knots, found.track->sigma_at(found.z, place));
        const bool joins_start = load && place == span.from && at < kJoined && mesh.lead_in == 0.0;
        const bool joins_finish = load && place == span.to && at > last - kJoined && mesh.lead_out == 0.0;
        if (at > kEnd && at < last - kEnd && !joins_start && !joins_finish) ends.push_back(at);
      }
    }
  }
  return ends;
}

/// Slope angle of a track found at any place of its core.
class SlopeAngle {
 public:
  explicit SlopeAngle(const Found& found)
      : track_(*found.track), knots_(track_.mesh().knots), turns_(knots_.size()), at_knots_(knots_.size()) {
    const Layout& layout = found.track->layout();
    for (std::size_t i = 0; i < knots_.size(); ++i) turns_[i] = found.z[layout.turn(i)];
    at_knots_[0] = found.z[layout.angle()];
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
      at_knots_[i + 1] = at_knots_[i] - 0.5 * (knots_[i + 1] - knots_[i]) * (turns_[i] + turns_[i + 1]);
    }
  }
  /// @param share  of the way through the piece
  [[nodiscard]] double value(std::size_t piece, double share) const {
    const double bend = turns_[piece] + 0.5 * share * (turns_[piece + 1] - turns_[piece]);
    const double width = share * (knots_[piece + 1] - knots_[piece]);
    return at_knots_[piece] - width * bend + track_.own_angle(knots_[piece] + width);
  }

 private:
  const Transcription& track_;
  const Vector& knots_;
  Vector turns_;
  Vector at_knots_;
};

/// The quadratic B-spline of four knots, ascending, of which two may coincide.
double b_spline(const std::array<double, 4>& knot, double at) {
  const auto rising = [&](std::size_t i, std::size_t order) {
    const double width = knot[i + order] - knot[i];
    return width > 0.0 ? (at - knot[i]) / width : 0.0;
  };
  const auto hat = [&](std::size_t i) {
    if (at < knot[i] || at > knot[i + 2]) return 0.0;
    return at < knot[i + 1] ? rising(i, 1) : 1.0 - rising(i + 1, 1);
  };
  return rising(0, 2) * hat(0) + (1.0 - rising(1, 2)) * hat(1);
}

/// A parabola in sigma.
struct Parabola {
  double origin = 0.0;
  std::array<double, 3> factor{};
  [[nodiscard]] double value(double sigma) const {
    const double t = sigma - origin;
    return factor[0] + t * (factor[1] + t * factor[2]);
  }
  [[nodiscard]] double slope(double sigma) const { return factor[1] + 2.0 * (sigma - origin) * factor[2]; }
};

/// The slope angle sought on one side of a jump.
///
/// The track found differs from it by what is square to every change of shape that the knots allow. Against
/// those that leave the jump alone, the three next to it, a parabola looks the same for both.
/// @param from      the knot at the jump
/// @param backwards  before the jump rather than behind it
/// @param most      pieces up to the next jump; >= 3
Parabola beside_jump(const Vector& knots, const SlopeAngle& found, std::size_t from, bool backwards,
                     std::size_t most) {
  constexpr std::size_t kTests = 3;  // theory: a parabola has three coefficients
  // Gauss-Legendre: products of two parabolas are integrated exactly.
  constexpr double kOffset = 0.3872983346207417;  // theory: Gauss-Legendre, sqrt(3/5)/2
  constexpr std::array<double, 3> kShare = {0.5 - kOffset, 0.5, 0.5 + kOffset};    // theory
  constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};  // theory
  const double sign = backwards ? -1.0 : 1.0;
  const double origin = knots[from];
  const std::size_t reach = std::min(most, kTests + 1);
  const auto away = [&](std::size_t k) {
    const std::size_t step = std::min(k, reach);
    return sign * (knots[backwards ? from - step : from + step] - origin);
  };
  // Both the jump and, if it is as near as that, the next one are double knots.
  std::array<std::array<double, 4>, kTests> tests{};
  for (std::size_t j = 0; j < kTests; ++j) {
    for (std::size_t k = 0; k < 4; ++k) tests[j][k] = away(j + k == 0 ? 0 : j + k - 1);
  }
  Matrix system(kTests, kTests);
  Vector right(kTests, 0.0);
  const double unit = away(reach);
  for (std::size_t k = 0; k < reach; ++k) {
    const std::size_t piece = backwards ? from - k - 1 : from + k;
    const double width = away(k + 1) - away(k);
    for (std::size_t q = 0; q < kShare.size(); ++q) {
      const double at = away(k) + kShare[q] * width;
      const double t = at / unit;
      const double zeta = found.value(piece, backwards ? 1.0 - kShare[q] : kShare[q]);
      for (std::size_t j = 0; j < kTests; ++j) {
        const double test = kWeight[q] * width * b_spline(tests[j], at);
        system(j, 0) += test;
        system(j, 1) += test * t;
        system(j, 2) += test * t * t;
        right[j] += test * zeta;
      }
    }
  }
  // Cramer's rule: three unknowns of like size.
  const auto determinant = [&](std::size_t replaced) {
    std::array<std::array<double, kTests>, kTests> m{};
    for (std::size_t i = 0; i < kTests; ++i) {
      for (std::size_t j = 0; j < kTests; ++j) m[i][j] = j == replaced ? right[i] : system(i, j);
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  const double whole = determinant(kTests);
  Parabola side;
  side.origin = origin;
  side.factor = {determinant(0) / whole, sign * determinant(1) / whole / unit,
                 determinant(2) / whole / (unit * unit)};
  return side;
}

/// Least squares for a slope angle of two parabolas that meet, through the track before and behind a blurred
/// stretch.
class Kink {
 public:
  Kink(const Vector& knots, const SlopeAngle& found, std::size_t first, std::size_t last, Span blurred)
      : seen_{knots[first], knots[last]} {
    constexpr std::size_t kPoints = 6;  // taste
    for (std::size_t i = first; i < last; ++i) {
      if (knots[i] >= blurred.from && knots[i + 1] <= blurred.to) continue;
      const double width = knots[i + 1] - knots[i];
      for (std::size_t k = 0; k < kPoints; ++k) {
        const double share = (static_cast<double>(k) + 0.5) / kPoints;
        points_.push_back({knots[i] + share * width, found.value(i, share),
                           width / (kPoints * (knots[last] - knots[first]))});
      }
    }
  }

  struct Fit {
    double miss = 0.0;  ///< root of the mean square
    double jump = 0.0;  ///< of d zeta/d sigma
  };
  [[nodiscard]] Fit fit(double at) const {
    Matrix normal(kTerms, kTerms);
    Vector factors(kTerms, 0.0);
    for (const Point& point : points_) {
      const auto term = terms(point.sigma, at);
      for (std::size_t j = 0; j < kTerms; ++j) {
        add_scaled(normal.row(j), point.weight * term[j], term.data(), kTerms);
        factors[j] += point.weight * term[j] * point.zeta;
      }
    }
    Vector diagonal(kTerms);
    for (std::size_t j = 0; j < kTerms; ++j) diagonal[j] = normal(j, j);
    const ShiftedCholesky cholesky(normal, diagonal);
    cholesky.forward(factors.data());
    cholesky.backward(factors.data());
    double squares = 0.0;
    for (const Point& point : points_) {
      const double miss = dot(terms(point.sigma, at).data(), factors.data(), kTerms) - point.zeta;
      squares += point.weight * miss * miss;
    }
    return {std::sqrt(squares), factors[3] / unit()};
  }

  /// The place within `span` that fits best.
  [[nodiscard]] double best(Span span) const {
    constexpr int kScan = 24;      // taste
    constexpr int kHalvings = 20;  // rounding: 2^-20 of a piece
    const double step = (span.to - span.from) / kScan;
    double at = span.from;
    double least = HUGE_VAL;
    for (int k = 0; k <= kScan; ++k) {
      const double miss = fit(span.from + step * k).miss;
      if (miss >= least) continue;
      least = miss;
      at = span.from + step * k;
    }
    double width = 0.5 * step;
    for (int k = 0; k < kHalvings; ++k, width *= 0.5) {
      const double before = fit(at - width).miss;
      const double behind = fit(at + width).miss;
      if (std::min(before, behind) >= least) continue;
      least = std::min(before, behind);
      at += before < behind ? -width : width;
    }
    return at;
  }

 private:
  static constexpr std::size_t kTerms = 5;  // theory: the columns of the fit
  struct Point {
    double sigma = 0.0;
    double zeta = 0.0;
    double weight = 0.0;
  };
  [[nodiscard]] double unit() const { return 0.5 * (seen_.to - seen_.from); }
  [[nodiscard]] std::array<double, kTerms> terms(double sigma, double at) const {
    const double t = (sigma - at) / unit();
    const double behind = std::max(t, 0.0);
    return {1.0, t, t * t, behind, behind * behind};
  }

  Span seen_;
  std::vector<Point> points_;
};

/// Finds the jumps of one track.
class JumpFinder {
 public:
  JumpFinder(const ScaledProblem& problem, const Found& found)
      : found_(found),
        knots_(found.track->mesh().knots),
        pieces_(knots_.size() - 1),
        slope_angle_(found),
        ends_(ends_of_binding(problem, found)),
        wide_(knots_.size(), 0.0) {
    for (std::size_t i = 0; i < pieces_; ++i) {
      wide_[i + 1] = wide_[i] + (is_narrow(i) ? 0.0 : 1.0);
    }
  }

  [[nodiscard]] std::vector<Switch> switches() const {
    const Mesh& mesh = found_.track->mesh();
    const std::vector<std::size_t> ramps = this->ramps();
    const std::size_t first = mesh.lead_in > 0.0 ? 1 : 0;
    const std::size_t last = mesh.lead_out > 0.0 ? pieces_ - 1 : pieces_;
    std::vector<Switch> result;
    if (first > 0 && turns(0)) result.push_back({{0.0, knots_[1]}, Span{0.0, kJoint}});
    for (std::size_t k = 0; k < ramps.size(); ++k) {
      if (ramps[k] < first || ramps[k] >= last) continue;
      const auto [free_from, free_to] = between_changes(ramps[k], first, last);
      const std::size_t begin = k == 0 ? free_from : std::max(free_from, ramps[k - 1] + 1);
      const std::size_t end = k + 1 == ramps.size() ? free_to : std::min(free_to, ramps[k + 1]);
      if (const std::optional<Switch> seen = seen_from(ramps[k], begin, end)) result.push_back(*seen);
    }
    if (last < pieces_ && turns(last)) result.push_back({{knots_[last], 1.0}, Span{1.0 - kJoint, 1.0}});
    return result;
  }

 private:
  [[nodiscard]] bool is_narrow(std::size_t piece) const {
    return knots_[piece + 1] - knots_[piece] < 2.0 * kPair;
  }
  /// Whether a piece stands for the jump at a change of friction, whose place is known.
  [[nodiscard]] bool is_at_change(std::size_t piece) const {
    const std::vector<ChangeKnots>& changes = found_.track->mesh().change_knots;
    return std::any_of(changes.begin(), changes.end(), [&](const ChangeKnots& change) {
      return knots_[piece] >= change.from && knots_[piece + 1] <= change.to;
    });
  }
  /// The pieces around one of them, within [first, last), up to the next changes of friction.
  [[nodiscard]] std::pair<std::size_t, std::size_t> between_changes(std::size_t piece, std::size_t first,
                                                                    std::size_t last) const {
    for (const ChangeKnots& change : found_.track->mesh().change_knots) {
      while (first <= piece && knots_[first] < change.to && change.to <= knots_[piece]) ++first;
      while (last > piece + 1 && knots_[last] > change.from && change.from >= knots_[piece + 1]) --last;
    }
    return {first, last};
  }
  [[nodiscard]] double turn(std::size_t knot) const { return found_.z[found_.track->layout().turn(knot)]; }
  [[nodiscard]] double change(std::size_t piece) const { return std::fabs(turn(piece + 1) - turn(piece)); }
  /// Whether curvature changes across a piece by much of what it is nearby.
  [[nodiscard]] bool turns(std::size_t piece) const {
    double size = 0.0;
    for (std::size_t k = 0; k <= pieces_; ++k) {
      const bool near = wide_[k] >= wide_[piece] - kWindow && wide_[k] <= wide_[piece + 1] + kWindow;
      if (near) size = std::max(size, std::fabs(turn(k)));
    }
    return change(piece) > kJump * size;
  }

  /// The pieces that stand for a jump each: near the end of a binding, and no ripple of a greater one.
  [[nodiscard]] std::vector<std::size_t> ramps() const {
    constexpr double kNear = 3.0;    // taste
    constexpr double kRipple = 1.5;  // taste
    std::vector<std::size_t> by_size;
    for (std::size_t i = 0; i < pieces_; ++i) {
      const double middle = static_cast<double>(i) + 0.5;
      const bool near = std::any_of(ends_.begin(), ends_.end(),
                                    [&](double end) { return std::fabs(end - middle) < kNear; });
      if (near && turns(i) && !is_at_change(i)) by_size.push_back(i);
    }
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](std::size_t a, std::size_t b) { return change(a) > change(b); });
    std::vector<std::size_t> ramps;
    for (const std::size_t i : by_size) {
      const bool ripple = std::any_of(ramps.begin(), ramps.end(), [&](std::size_t greater) {
        return wide_[std::max(i, greater)] - wide_[std::min(i, greater) + 1] < kRipple;
      });
      if (!ripple) ramps.push_back(i);
    }
    std::sort(ramps.begin(), ramps.end());
    return ramps;
  }

  /// @param first,last  pieces [first, last) belong to this jump and to no other
  /// @return none where curvature turns out to change smoothly
  [[nodiscard]] std::optional<Switch> seen_from(std::size_t ramp, std::size_t first, std::size_t last) const {
    constexpr double kPartOfRamp = 0.6;    // taste
    constexpr std::size_t kMostRamps = 3;  // taste
    std::size_t begin = ramp;
    std::size_t end = ramp + 1;
    while (begin > first && end - begin < kMostRamps && change(begin - 1) > kPartOfRamp * change(ramp))
      --begin;
    while (end < last && end - begin < kMostRamps && change(end) > kPartOfRamp * change(ramp)) ++end;
    std::size_t before = begin;
    while (before > first && wide_[begin] - wide_[before - 1] <= kWindow) --before;
    std::size_t behind = end;
    while (behind < last && wide_[behind + 1] - wide_[end] <= kWindow) ++behind;

    Switch result;
    result.blurred = {knots_[begin], knots_[end]};
    if (wide_[before] == wide_[begin] || wide_[behind] == wide_[end]) return result;
    const Span search{0.5 * (knots_[begin - 1] + knots_[begin]), 0.5 * (knots_[end] + knots_[end + 1])};
    if (end == begin + 1 && is_narrow(begin)) {
      result.jump = moved(begin, begin - first, last - end, search);
      if (result.jump) return result;
    }
    const Kink kink(knots_, slope_angle_, before, behind, result.blurred);
    const double at = kink.best(search);
    const Kink::Fit fit = kink.fit(at);
    // Two parabolas that do not fit tell of more than one jump.
    constexpr double kFits = 1e-2;     // taste
    constexpr double kLikeRamp = 0.3;  // taste
    const double risen = turn(begin) - turn(end);
    if (fit.miss > kFits * std::fabs(risen) * (knots_[behind] - knots_[before])) return result;
    if (fit.jump / risen < kLikeRamp) return std::nullopt;
    if (at > search.from && at < search.to) result.jump = Span{at - 0.5 * kPair, at + 0.5 * kPair};
    return result;
  }

  /// Two knots around a jump that two knots stand around already, where the curves on both sides meet.
  /// @param before,behind  pieces up to the next jumps
  [[nodiscard]] std::optional<Span> moved(std::size_t pair, std::size_t before, std::size_t behind,
                                          Span search) const {
    constexpr std::size_t kNeeded = 3;  // theory: a parabola has three coefficients
    if (before < kNeeded || behind < kNeeded) return std::nullopt;
    const Parabola left = beside_jump(knots_, slope_angle_, pair, true, before);
    const Parabola right = beside_jump(knots_, slope_angle_, pair + 1, false, behind);
    constexpr int kSteps = 6;  // budget
    double at = 0.5 * (knots_[pair] + knots_[pair + 1]);
    for (int step = 0; step < kSteps; ++step) {
      at -= (right.value(at) - left.value(at)) / (right.slope(at) - left.slope(at));
    }
    if (!(at > search.from && at < search.to)) return std::nullopt;
    return Span{at - 0.5 * kPair, at + 0.5 * kPair};
  }

  const Found& found_;
  const Vector& knots_;
  std::size_t pieces_;
  SlopeAngle slope_angle_;
  std::vector<double> ends_;
  std::vector<double> wide_;  ///< pieces before each knot, without those across a jump made out before
};

/// A stretch with knots of its own.
struct Cut {
  Span span;
  std::size_t pieces = 1;
  Span blurred;
};

std::vector<Cut> cuts_of(const Vector& knots, const std::vector<Switch>& switches) {
  constexpr std::size_t kMoreBlurred = 2;  // taste
  constexpr double kApart = 4.0 * kPair;   // taste
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < switches.size(); ++i) {
    const Switch& change = switches[i];
    const double free_from = cuts.empty() ? 0.0 : cuts.back().span.to + kApart;
    if (change.jump) {
      // Jumps too close to tell apart are kept as one stretch.
      const bool joined = change.jump->from < free_from && !cuts.empty();
      if (!joined) cuts.push_back({*change.jump, 1, change.blurred});
      cuts.back().span.to = std::max(cuts.back().span.to, change.jump->to);
      cuts.back().blurred.to = std::max(cuts.back().blurred.to, change.blurred.to);
      cuts.back().pieces += joined ? 2 : 0;
      continue;
    }
    const bool before_jump = i + 1 < switches.size() && switches[i + 1].jump;
    const double free_to = before_jump ? switches[i + 1].jump->from - kApart : 1.0;
    const Span span{std::max(change.blurred.from, free_from), std::min(change.blurred.to, free_to)};
    if (span.to - span.from < kApart) continue;
    const double width = count_pieces(knots, span.to) - count_pieces(knots, span.from);
    cuts.push_back({span, kMoreBlurred + static_cast<std::size_t>(std::lround(width)), change.blurred});
  }
  return cuts;
}

/// zeta''' at the knots, from the kinks of the curvature there; in a cut it is that of its surroundings.
Vector third_differences(const Transcription& track, const Vector& z, const std::vector<Cut>& cuts) {
  const Layout& layout = track.layout();
  const Vector& knots = track.mesh().knots;
  const std::size_t n = knots.size();
  const auto slope = [&](std::size_t i) {
    return (z[layout.turn(i + 1)] - z[layout.turn(i)]) / (knots[i + 1] - knots[i]);
  };
  Vector third(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    third[i] = std::fabs(slope(i) - slope(i - 1)) * 2.0 / (knots[i + 1] - knots[i - 1]);
  }
  third[0] = third[1];
  third[n - 1] = third[n - 2];
  constexpr double kRounding = 1e-12;  // rounding
  for (const Cut& cut : cuts) {
    const auto begin = std::lower_bound(knots.begin(), knots.end(), cut.blurred.from - kRounding);
    const auto end = std::upper_bound(knots.begin(), knots.end(), cut.blurred.to + kRounding);
    const auto first = static_cast<std::size_t>(begin - knots.begin());
    const auto last = static_cast<std::size_t>(end - knots.begin());
    const double before = first > 0 ? third[first - 1] : 0.0;
    const double behind = last < n ? third[last] : 0.0;
    for (std::size_t i = first; i < last; ++i) third[i] = 2 * i < first + last ? before : behind;
  }
  return third;
}

/// How many pieces are due up to a place, to some scale: linear between the knots of the track found.
class Demand {
 public:
  Demand(const Transcription& track, const Vector& z, const std::vector<Cut>& cuts)
      : knots_(track.mesh().knots), total_(knots_.size(), 0.0) {
    constexpr double kEvenShare = 0.3;  // taste
    const Mesh& mesh = track.mesh();
    const std::size_t n = knots_.size();
    const Vector third = third_differences(track, z, cuts);
    const double before = (mesh.lead_in + 0.5 * mesh.entry_speed2) / mesh.core_length;
    Vector density(n - 1);
    double mean = 0.0;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double error = 0.5 * (third[i] + third[i + 1]);
      const double speed = std::sqrt(0.5 * (knots_[i] + knots_[i + 1]) + before);
      density[i] = math::pow(error * error / speed, 1.0 / 7.0);
      mean += density[i] * (knots_[i + 1] - knots_[i]);
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double due = density[i] + kEvenShare * (mean + 1e-6);
      total_[i + 1] = total_[i] + due * (knots_[i + 1] - knots_[i]);
    }
  }

  [[nodiscard]] double up_to(double sigma) const {
    const double at = count_pieces(knots_, sigma);
    const auto i = std::min(static_cast<std::size_t>(at), total_.size() - 2);
    return total_[i] + (at - static_cast<double>(i)) * (total_[i + 1] - total_[i]);
  }
  [[nodiscard]] double within(Span span) const { return up_to(span.to) - up_to(span.from); }
  /// Appends what lies behind span.from, in equal parts.
  void share_out(Span span, std::size_t pieces, Vector& knots) const {
    const double begin = up_to(span.from);
    const double amount = within(span);
    std::size_t at = 0;
    for (std::size_t k = 1; k < pieces; ++k) {
      const double wanted = begin + amount * static_cast<double>(k) / static_cast<double>(pieces);
      while (total_[at + 1] < wanted) ++at;
      const double share = (wanted - total_[at]) / (total_[at + 1] - total_[at]);
      knots.push_back(knots_[at] + share * (knots_[at + 1] - knots_[at]));
    }
    knots.push_back(span.to);
  }

 private:
  const Vector& knots_;
  Vector total_;
};

}  // namespace

std::vector<std::vector<Span>> bindings_of(const ScaledProblem& problem, const Found& found) {
  constexpr double kAtBound = 1e-6;     // accuracy: ten times that of a limit
  constexpr double kSameStretch = 1.5;  // taste
  struct Place {
    double at = 0.0;
    double slack = 0.0;
  };
  const Mesh& mesh = found.track->mesh();
  const State state = found.rows->state(found.z, false);
  const auto pieces_at = [&](double at) {
    return count_pieces(mesh.knots, found.track->sigma_at(found.z, at));
  };
  std::vector<std::vector<Place>> places(problem.limits.size());
  for (const Row& row : found.rows->candidates(state, HUGE_VAL)) {
    const double slack = -found.rows->value(state, row);
    // How far a corner is tells of the track at one place, not along it.
    if ((row.foot || row.face) && slack > kAtBound) continue;
    const double at = found.rows->place(state, row);
    places[row.limit].push_back({at, slack});
    if (problem.limits[row.limit].measure != Measure::curvature_rate) continue;
    const double width = mesh.knots[row.place + 1] - mesh.knots[row.place];
    places[row.limit].push_back({at + width * found.track->stretch(found.z, row.place), slack});
  }
  std::vector<std::vector<Span>> bindings(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    // Of two rides at one place the closer one counts.
    std::sort(places[i].begin(), places[i].end(),
              [](const Place& a, const Place& b) { return a.at != b.at ? a.at < b.at : a.slack < b.slack; });
    const auto end = std::unique(places[i].begin(), places[i].end(),
                                 [](const Place& a, const Place& b) { return a.at == b.at; });
    places[i].erase(end, places[i].end());
    const double shallow = slack_within(*problem.limits[i].measure);
    double deepest = 0.0;
    for (const Place& place : places[i]) {
      deepest = std::max(deepest, place.slack);
      if (place.slack > kAtBound) continue;
      const bool goes_on =
          !bindings[i].empty() &&
          (deepest < shallow || pieces_at(place.at) - pieces_at(bindings[i].back().to) < kSameStretch);
      if (!goes_on) bindings[i].push_back({place.at, place.at});
      bindings[i].back().to = place.at;
      deepest = 0.0;
    }
  }
  return bindings;
}

std::vector<Switch> switches_of(const ScaledProblem& problem, const Found& found) {
  // Under a limit on its rate curvature does not jump.
  const bool smooth = std::any_of(problem.limits.begin(), problem.limits.end(), [](const LimitSpec& limit) {
    return limit.measure == Measure::curvature_rate;
  });
  if (smooth) return {};
  return JumpFinder(problem, found).switches();
}

bool settled(const std::vector<Switch>& switches) {
  constexpr double kSettled = 0.1 * kPair;  // taste
  return std::all_of(switches.begin(), switches.end(), [](const Switch& change) {
    if (!change.jump) return false;
    const double before = std::fabs(change.jump->from - change.blurred.from);
    const double behind = std::fabs(change.jump->to - change.blurred.to);
    return std::max(before, behind) <= kSettled;
  });
}

namespace {

/// With those whose place is known: where friction changes.
std::vector<Switch> with_changes(std::vector<Switch> switches, const Mesh& mesh) {
  for (const ChangeKnots& change : mesh.change_knots) {
    if (change.from < change.to) switches.push_back({{change.from, change.to}, Span{change.from, change.to}});
  }
  std::stable_sort(switches.begin(), switches.end(),
                   [](const Switch& a, const Switch& b) { return a.blurred.from < b.blurred.from; });
  return switches;
}

}  // namespace

Vector refined_knots(const Transcription& track, const Vector& z, const std::vector<Switch>& switches,
                     std::size_t pieces) {
  constexpr std::size_t kFewest = 2;  // taste
  const std::vector<Cut> cuts = cuts_of(track.mesh().knots, with_changes(switches, track.mesh()));
  const Demand demand(track, z, cuts);
  double shared = demand.up_to(1.0);
  for (const Cut& cut : cuts) shared -= demand.within(cut.span);
  Vector knots{0.0};
  const auto share_out_to = [&](double to) {
    const Span span{knots.back(), to};
    if (span.to <= span.from) return;
    const double part = static_cast<double>(pieces) * demand.within(span) / shared;
    demand.share_out(span, std::max(kFewest, static_cast<std::size_t>(std::lround(part))), knots);
  };
  for (const Cut& cut : cuts) {
    share_out_to(cut.span.from);
    for (std::size_t k = 1; k < cut.pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(cut.pieces);
      knots.push_back(cut.span.from + share * (cut.span.to - cut.span.from));
    }
    knots.push_back(cut.span.to);
  }
  share_out_to(1.0);
  for (double& knot : knots) knot = track.share_of_core(z, knot);
  return knots;
}

}  // namespace glissade::optimizer
