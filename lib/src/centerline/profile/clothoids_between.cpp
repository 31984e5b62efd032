#include "centerline/profile/clothoids_between.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::centerline {
namespace {

using Rule = boost::math::quadrature::gauss<double, 7>;

// By more than this the quadrature of one clothoid is not exact to rounding.
constexpr double kMostTurned = 1.5;

/// A clothoid over a chord: its angle to the chord goes from `entry` to `exit` as entry + (change - bend) t + bend t^2.
struct Hermite {
  double length = 0.0;
  double entry_curvature = 0.0;  // d angle/ds
  double exit_curvature = 0.0;

  [[nodiscard]] double rate() const { return (exit_curvature - entry_curvature) / length; }
};

/// @param entry, exit  angles of the curve less that of the chord
std::optional<Hermite> hermite(double chord, double entry, double exit) {
  constexpr int kMostSteps = 20;
  const double change = exit - entry;
  double bend = 3.0 * (entry + exit);
  double along = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    double across = 0.0;
    double slope = 0.0;
    along = 0.0;
    const auto add = [&](double t, double weight) {
      const auto [sine, cosine] = math::sine_cosine(entry + (change - bend) * t + bend * t * t);
      across += weight * sine;
      along += weight * cosine;
      slope += weight * cosine * (t * t - t);
    };
    add(0.5, 0.5 * Rule::weights()[0]);
    for (std::size_t i = 1; i < Rule::abscissa().size(); ++i) {
      add(0.5 - 0.5 * Rule::abscissa()[i], 0.5 * Rule::weights()[i]);
      add(0.5 + 0.5 * Rule::abscissa()[i], 0.5 * Rule::weights()[i]);
    }
    const double move = across / slope;
    if (!std::isfinite(move) || !(std::fabs(bend) < kMostTurned)) return {};
    bend -= move;
    if (std::fabs(move) <= 1e-15) break;
  }
  const double length = chord / along;
  if (!(length > 0.0)) return {};
  return Hermite{length, (change - bend) / length, (change + bend) / length};
}

/// Chords between points, their angles without jumps.
struct Chords {
  std::vector<double> lengths;
  std::vector<double> angles;
};

Chords chords_of(const std::vector<Vec2>& points, const std::vector<double>& angles) {
  Chords chords;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 chord = points[i + 1] - points[i];
    const double angle = math::atan2(chord.y, chord.x);
    chords.lengths.push_back(norm(chord));
    chords.angles.push_back(angles[i] + std::remainder(angle - angles[i], 2.0 * std::numbers::pi));
  }
  return chords;
}

std::optional<std::vector<Hermite>> pieces_between(const Chords& chords, const std::vector<double>& angles) {
  std::vector<Hermite> pieces;
  for (std::size_t i = 0; i < chords.lengths.size(); ++i) {
    const auto piece =
        hermite(chords.lengths[i], angles[i] - chords.angles[i], angles[i + 1] - chords.angles[i]);
    if (!piece) return {};
    pieces.push_back(*piece);
  }
  return pieces;
}

/// Equations of three neighbours each, of two at the ends.
struct Tridiagonal {
  std::vector<std::array<double, 3>> rows;  // of the one before, its own, the one after
  std::vector<double> right;

  std::vector<double> solved() {
    const std::size_t count = rows.size();
    for (std::size_t i = 1; i < count; ++i) {
      const double factor = rows[i][0] / rows[i - 1][1];
      rows[i][1] -= factor * rows[i - 1][2];
      right[i] -= factor * right[i - 1];
    }
    std::vector<double> x(count);
    for (std::size_t i = count; i-- > 0;) {
      x[i] = (right[i] - (i + 1 < count ? rows[i][2] * x[i + 1] : 0.0)) / rows[i][1];
    }
    return x;
  }
};

/// By how much angles are to turn so that curvatures meet at the joints, as cubics tell. At both ends two pieces are to
/// be one clothoid.
std::vector<double> moves(const Chords& chords, const std::vector<Hermite>& pieces) {
  const std::size_t last = pieces.size();
  Tridiagonal equations;
  equations.rows.resize(last + 1);
  equations.right.resize(last + 1);
  for (std::size_t i = 1; i < last; ++i) {
    const double before = chords.lengths[i - 1];
    const double after = chords.lengths[i];
    equations.rows[i] = {2.0 / before, 4.0 / before + 4.0 / after, 2.0 / after};
    equations.right[i] = pieces[i].entry_curvature - pieces[i - 1].exit_curvature;
  }
  const auto end_row = [&](std::size_t end, std::size_t next, double outer, double inner, double gap) {
    // 6 (x0 + x1)/outer^2 - 6 (x1 + x2)/inner^2 = gap; x2 by the next row.
    const std::array<double, 3>& row = equations.rows[next];
    const double beyond = end < next ? row[2] : row[0];
    const double towards = end < next ? row[0] : row[2];
    const double factor = 6.0 / (inner * inner) / beyond;
    const double own = 6.0 / (outer * outer) + factor * towards;
    const double neighbour = 6.0 / (outer * outer) - 6.0 / (inner * inner) + factor * row[1];
    equations.rows[end] = end < next ? std::array{0.0, own, neighbour} : std::array{neighbour, own, 0.0};
    equations.right[end] = gap + factor * equations.right[next];
  };
  end_row(0, 1, chords.lengths[0], chords.lengths[1], pieces[1].rate() - pieces[0].rate());
  end_row(last, last - 1, chords.lengths[last - 1], chords.lengths[last - 2],
          pieces[last - 2].rate() - pieces[last - 1].rate());
  return equations.solved();
}

/// Where curvature jumps, a spline whose curvature is continuous rings: kinks of other sign each time that fall off as
/// geometric series do.
bool rings(const std::vector<double>& kinks) {
  constexpr std::size_t kMost = 4;
  const auto falls = [](double ratio) { return ratio < -0.1 && ratio > -0.5; };
  std::size_t ahead = 0;
  std::size_t back = 0;
  for (std::size_t i = 1; i < kinks.size(); ++i) {
    ahead = falls(kinks[i] / kinks[i - 1]) ? ahead + 1 : 0;
    back = falls(kinks[i - 1] / kinks[i]) ? back + 1 : 0;
    if (std::max(ahead, back) >= kMost) return true;
  }
  return false;
}

/// Whether the curvature goes on through most joints as it was.
bool mostly_smooth(const std::vector<Hermite>& pieces) {
  constexpr double kNone = 1e-6;
  constexpr double kMost = 0.6;
  double sharpest = 0.0;
  for (const Hermite& piece : pieces) sharpest = std::max(sharpest, std::fabs(piece.exit_curvature));
  std::size_t smooth = 0;
  std::vector<double> kinks;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const double kink = pieces[i].rate() - pieces[i - 1].rate();
    const double turned = std::fabs(kink) * std::min(pieces[i].length, pieces[i - 1].length);
    const bool none = turned <= kNone * sharpest;
    if (none) ++smooth;
    kinks.push_back(none ? 0.0 : kink);
  }
  return static_cast<double>(smooth) > kMost * static_cast<double>(pieces.size()) && !rings(kinks);
}

}  // namespace

std::optional<ClothoidSpline> clothoids_between(const std::vector<Vec2>& points, std::vector<double> angles) {
  constexpr int kMostSteps = 40;
  constexpr double kSettled = 1e-12;
  constexpr double kLost = 0.5;
  const Chords chords = chords_of(points, angles);
  std::optional<std::vector<Hermite>> pieces;
  double most = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    pieces = pieces_between(chords, angles);
    if (!pieces) return {};
    most = 0.0;
    const std::vector<double> move = moves(chords, *pieces);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      angles[i] += move[i];
      most = std::max(most, std::fabs(move[i]));
    }
    if (!(most < kLost)) return {};
    if (most <= 1e-15) break;
  }
  if (most > kSettled || !mostly_smooth(*pieces)) return {};
  std::vector<ClothoidSegment> segments;
  for (const Hermite& piece : *pieces) {
    // Slope angles fall where curvature is positive.
    const double entry = segments.empty() ? -piece.entry_curvature : segments.back().exit_curvature;
    segments.push_back({piece.length, entry, -piece.exit_curvature});
  }
  return ClothoidSpline(Angle::from_radians(angles.front()), std::move(segments));
}

}  // namespace glissade::centerline
