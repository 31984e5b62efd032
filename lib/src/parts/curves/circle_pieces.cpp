// Best circles by exchange on four points: the levelled error of four points is the least that any circle has on
// them (de la Vallee Poussin), so it bounds what any circle has on more points from below.

#include "parts/curves/circle_pieces.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace glissade::parts {
namespace {

constexpr std::size_t kMostPoints = 96;  // of a piece that are looked at
constexpr int kMostExchanges = 12;

/// C |p|^2 + B x + y + A, whose zeros are a circle; E the error that four points have in turn.
struct Circle4 {
  double a = 0.0, b = 0.0, c = 0.0, error = 0.0;

  /// @return signed distance from the circle, exactly: 2 F / (|grad F| + |grad F on the circle|)
  [[nodiscard]] double distance(Vec2 p) const { return value(p) / weight(p); }
  [[nodiscard]] double value(Vec2 p) const { return c * dot(p, p) + b * p.x + p.y + a; }
  [[nodiscard]] double weight(Vec2 p) const {
    const double on = std::max(b * b + 1.0 - 4.0 * a * c, 0.0);
    const double here = std::max(on + 4.0 * c * value(p), 0.0);
    return 0.5 * (std::sqrt(here) + std::sqrt(on));
  }
};

using Four = std::array<Vec2, 4>;

/// Solves a 4 x 5 system by elimination with pivots; false if it is singular.
bool solve(std::array<std::array<double, 5>, 4>& m) {
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t best = i;
    for (std::size_t r = i + 1; r < 4; ++r) {
      if (std::fabs(m[r][i]) > std::fabs(m[best][i])) best = r;
    }
    std::swap(m[i], m[best]);
    if (m[i][i] == 0.0) return false;
    for (std::size_t r = 0; r < 4; ++r) {
      if (r == i) continue;
      const double share = m[r][i] / m[i][i];
      for (std::size_t k = i; k < 5; ++k) m[r][k] -= share * m[i][k];
    }
  }
  for (std::size_t i = 0; i < 4; ++i) m[i][4] /= m[i][i];
  return true;
}

/// The circle that four points, in their order along the curve, miss by the same distance, in turn to either side.
Circle4 levelled(const Four& points) {
  Circle4 circle;
  for (int round = 0; round < 4; ++round) {
    std::array<std::array<double, 5>, 4> m{};
    for (std::size_t i = 0; i < 4; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      m[i] = {1.0, points[i].x, dot(points[i], points[i]), -sign * circle.weight(points[i]), -points[i].y};
    }
    if (!solve(m)) return circle;
    circle = {m[0][4], m[1][4], m[2][4], m[3][4]};
  }
  return circle;
}

/// The points of a piece in the frame of its chord, whose length is 1.
struct Piece {
  std::vector<Vec2> points;
  double chord = 0.0;
};

Piece in_chord_frame(const TrackSamples& samples, std::size_t first, std::size_t last) {
  const Vec2 a = samples.point[first];
  const Vec2 along = samples.point[last] - a;
  Piece piece;
  piece.chord = norm(along);
  const double square = dot(along, along);
  const std::size_t count = std::min(last - first, kMostPoints);
  for (std::size_t k = 0; k <= count; ++k) {
    const Vec2 from = samples.point[first + k * (last - first) / count] - a;
    piece.points.push_back({dot(along, from) / square - 0.5, cross(along, from) / square});
  }
  return piece;
}

using Reference = std::array<std::size_t, 4>;

/// Puts the farthest point in place of a neighbour in the reference, so that the signs still take turns.
void exchange(Reference& at, const Piece& piece, const Circle4& circle, std::size_t farthest) {
  const auto sign_at = [&](std::size_t i) { return circle.distance(piece.points[i]) > 0.0; };
  const bool sign = sign_at(farthest);
  std::size_t after = 0;
  while (after < 4 && at[after] < farthest) ++after;
  // Signs of the reference alternate by construction: that of at[0] is the error's.
  const auto reference_sign = [&](std::size_t i) { return (circle.error > 0.0) == (i % 2 == 0); };
  if (after == 0) {
    if (reference_sign(0) != sign) {
      for (std::size_t i = 3; i > 0; --i) at[i] = at[i - 1];
    }
    at[0] = farthest;
  } else if (after == 4) {
    if (reference_sign(3) != sign) {
      for (std::size_t i = 0; i < 3; ++i) at[i] = at[i + 1];
    }
    at[3] = farthest;
  } else {
    at[reference_sign(after) == sign ? after : after - 1] = farthest;
  }
}

void add_sample(TrackSamples& samples, const Centerline& track, double s) {
  const CenterlinePoint point = track.at(s);
  samples.s.push_back(s);
  // Tracks begin at their origin, some of them up to rounding.
  samples.point.push_back(s > 0.0 ? Vec2{point.x, -point.drop} : Vec2{});
  samples.heading.push_back(-point.slope_angle);
}

}  // namespace

std::size_t index_at(const TrackSamples& samples, double s) {
  return static_cast<std::size_t>(std::lower_bound(samples.s.begin(), samples.s.end(), s) -
                                  samples.s.begin());
}

TrackSamples moved_left(const TrackSamples& samples, double distance) {
  TrackSamples moved = samples;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const auto [sine, cosine] = math::sine_cosine(moved.heading[i]);
    moved.point[i] = moved.point[i] + distance * Vec2{-sine, cosine};
  }
  return moved;
}

TrackSamples refined(const Centerline& track, const TrackSamples& samples, const CirclePieces& pieces,
                     std::size_t count) {
  TrackSamples more;
  std::size_t first = 0;
  for (const std::size_t last : pieces.ends) {
    const std::size_t steps = std::max<std::size_t>(last - first, 1);
    const std::size_t parts = (count + steps - 1) / steps;
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = 0; k < parts; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(parts);
        add_sample(more, track, samples.s[i] + share * (samples.s[i + 1] - samples.s[i]));
      }
    }
    first = last;
  }
  add_sample(more, track, samples.s.back());
  return more;
}

TrackSamples sample(const Centerline& track, std::size_t count) {
  TrackSamples samples;
  const std::vector<double> breaks = track.breaks();
  const double length = track.length();
  const auto add = [&](double s) { add_sample(samples, track, s); };
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double span = breaks[i + 1] - breaks[i];
    const auto own = static_cast<std::size_t>(std::ceil(static_cast<double>(count) * span / length));
    const std::size_t steps = std::max<std::size_t>(own, breaks.size() > count / 16 ? 2 : 16);
    for (std::size_t k = 0; k < steps; ++k) {
      double share = static_cast<double>(k) / static_cast<double>(steps);
      // The error of an arc at an unbounded curvature ~ s^(-1/2) has even steps in s^(1/2): closer still, to be safe.
      if (i == 0 && track.unbounded_curvature_at_start()) share = share * share * (0.5 + 0.5 * share);
      add(breaks[i] + span * share);
    }
  }
  add(length);
  return samples;
}

bool fits_circle(const TrackSamples& samples, std::size_t first, std::size_t last, double tolerance) {
  if (last < first + 3) return true;
  const Piece piece = in_chord_frame(samples, first, last);
  const double bound = tolerance / piece.chord;
  const std::size_t n = piece.points.size() - 1;
  Reference at = {0, std::max<std::size_t>(n / 4, 1), std::max<std::size_t>(3 * n / 4, 2), n};
  for (int round = 0; round < kMostExchanges; ++round) {
    const Circle4 circle =
        levelled({piece.points[at[0]], piece.points[at[1]], piece.points[at[2]], piece.points[at[3]]});
    if (std::fabs(circle.error) > bound) return false;
    std::size_t farthest = 0;
    double most = 0.0;
    for (std::size_t i = 0; i <= n; ++i) {
      const double away = std::fabs(circle.distance(piece.points[i]));
      if (away > most) {
        most = away;
        farthest = i;
      }
    }
    if (most <= bound) return true;
    if (std::find(at.begin(), at.end(), farthest) != at.end()) return true;
    exchange(at, piece, circle, farthest);
  }
  return true;  // neither ruled out nor confirmed: the bound must not be too high
}

CirclePieces circle_pieces(const TrackSamples& samples, std::size_t first, std::size_t last,
                           double tolerance) {
  CirclePieces pieces;
  std::size_t guess = std::max<std::size_t>((last - first) / 16, 4);
  double earlier = 0.0;
  while (true) {
    std::size_t good = std::min(first + 1, last);
    std::size_t step = guess;
    std::size_t bad = last + 1;
    while (good < last && bad > last) {
      const std::size_t tried = std::min(good + step, last);
      (fits_circle(samples, first, tried, tolerance) ? good : bad) = tried;
      step *= 2;
      if (good == last) break;
    }
    while (bad <= last && bad > good + 1) {
      const std::size_t middle = good + (bad - good) / 2;
      (fits_circle(samples, first, middle, tolerance) ? good : bad) = middle;
    }
    pieces.ends.push_back(good);
    const double span = samples.s[good] - samples.s[first];
    if (good >= last) {
      pieces.last_share = earlier > 0.0 ? std::min(1.0, span / earlier) : 1.0;
      return pieces;
    }
    guess = std::max<std::size_t>((good - first) / 2, 2);
    earlier = span;
    first = bad;
    if (first >= last) {
      pieces.ends.push_back(last);  // the last sample alone needs one more
      return pieces;
    }
  }
}

}  // namespace glissade::parts
