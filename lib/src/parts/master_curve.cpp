#include "glissade/parts/master_curve.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/arc_fit.hpp"
#include "parts/arc_search.hpp"
#include "parts/circle_pieces.hpp"
#include "parts/fewest_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace glissade {

using namespace parts;

namespace {

constexpr std::size_t kFirstSamples = 2048;
constexpr std::size_t kSamplesPerArc = 96;
// What is to be expected of a track whose own arcs do not stand in the way: this share of the lower bound, and so many more.
constexpr double kExpectedShare = 1.16;
constexpr double kExpectedMore = 2.0;
constexpr double kSameArc = 1e-10;   // relative difference of curvatures within one arc of the track
constexpr double kSameLine = 1e-12;  // the same of straight lines, times the length of the track

/// An arc or straight line of the track itself.
struct Kept {
  double from = 0.0;
  double to = 0.0;
  double curvature = 0.0;
};

/// Whether two curvatures give one arc: over the whole track they part by less than rounding does.
bool same_curvature(double a, double b, double length) {
  return std::fabs(a - b) <= std::max(kSameArc * std::fabs(a), kSameLine / length);
}

/// @return the curvature of a stretch between breaks where that is constant
std::optional<double> constant_curvature(const Centerline& track, double from, double to) {
  const double middle = track.at(0.5 * (from + to)).curvature;
  for (const double share : {0.0, 0.07, 0.31, 0.77, 0.97}) {
    const double here = track.at(from + share * (to - from)).curvature;
    if (!same_curvature(middle, here, track.length())) return std::nullopt;
  }
  // What bends away by less than rounding does over its length is straight.
  const double sagitta = 0.125 * std::fabs(middle) * (to - from) * (to - from);
  return sagitta <= kSameLine * track.length() ? 0.0 : middle;
}

/// Stretches of constant curvature, neighbours with the same one joined; none that is no longer than what arcs may miss.
std::vector<Kept> kept_pieces(const Centerline& track, double tolerance) {
  std::vector<Kept> kept;
  const std::vector<double> breaks = track.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    if (i == 0 && track.unbounded_curvature_at_start()) continue;
    const auto curvature = constant_curvature(track, breaks[i], breaks[i + 1]);
    if (!curvature) continue;
    const bool goes_on = !kept.empty() && kept.back().to == breaks[i] &&
                         same_curvature(*curvature, kept.back().curvature, track.length());
    if (goes_on) {
      kept.back().to = breaks[i + 1];
    } else {
      kept.push_back({breaks[i], breaks[i + 1], *curvature});
    }
  }
  std::erase_if(kept, [&](const Kept& piece) { return piece.to - piece.from <= tolerance; });
  return kept;
}

/// Where the arcs may lie.
Band band_of(FitSide side, double tolerance) {
  switch (side) {
    case FitSide::away:
      return {kOneSidedSlip * tolerance, tolerance};
    case FitSide::into_flow:
      return {tolerance, kOneSidedSlip * tolerance};
    case FitSide::both:
      break;
  }
  return {tolerance, tolerance};
}

/// The stretch between a kept piece and the one before it; the first begins at the start, the last ends at the finish.
/// @param next  number of the kept piece after it
/// @return none where there is nothing in between
std::optional<Stretch> stretch_before(const TrackSamples& samples, const std::vector<Kept>& kept,
                                      std::size_t next) {
  const double from = next == 0 ? 0.0 : kept[next - 1].to;
  const double to = next == kept.size() ? samples.s.back() : kept[next].from;
  if (!(to > from)) return std::nullopt;
  Stretch stretch{index_at(samples, from), index_at(samples, to), {}, {}};
  const auto leg_at = [&](std::size_t at, double curvature) {
    return ArcAt{samples.point[at], samples.heading[at], curvature};
  };
  if (next > 0) stretch.before = KeptEnd{leg_at(stretch.first, kept[next - 1].curvature), 0.0};
  if (next < kept.size()) stretch.after = KeptEnd{leg_at(stretch.last, kept[next].curvature), 0.0};
  return stretch;
}

/// The chain between a kept piece and the one before it; no vertices where there is nothing in between.
ArcChain chain_before(const Centerline& track, const TrackSamples& samples, const std::vector<Kept>& kept,
                      std::size_t next, const Band& band) {
  const std::optional<Stretch> stretch = stretch_before(samples, kept, next);
  if (!stretch) return {};
  return fewest_arcs(track, samples, *stretch, band);
}

/// Lines and arcs of the track where it has them, chains in between.
ArcPath assembled(const Centerline& track, const TrackSamples& samples, const std::vector<Kept>& kept,
                  const Band& band) {
  std::vector<ArcChain> chains;
  for (std::size_t i = 0; i <= kept.size(); ++i)
    chains.push_back(chain_before(track, samples, kept, i, band));
  ArcPath path;
  const auto add = [&path](const ArcChain& chain) {
    if (!chain.vertices.empty())
      path.vertices.insert(path.vertices.end(), chain.vertices.begin(), chain.vertices.end() - 1);
  };
  for (std::size_t i = 0; i < kept.size(); ++i) {
    add(chains[i]);
    const Kept& piece = kept[i];
    const bool begins = chains[i].vertices.empty();
    const Vec2 from = begins ? samples.point[index_at(samples, piece.from)] : chains[i].vertices.back().at;
    const double length = chains[i].last_reach + (piece.to - piece.from) + chains[i + 1].first_reach;
    path.vertices.push_back({from, math::tan(0.25 * piece.curvature * length)});
  }
  add(chains.back());
  path.vertices.push_back({samples.point.back(), 0.0});
  return path;
}

/// The distance of a point from the track, positive to its left.
/// @param guess  arc length near the nearest point; becomes that of the point found
double offset_from(const Centerline& track, Vec2 point, double& guess) {
  double s = std::clamp(guess, 0.0, track.length());
  double least = std::numeric_limits<double>::infinity();
  double side = 1.0;
  for (int step = 0; step < 12; ++step) {
    const CenterlinePoint at = track.at(s);
    const auto [sine, cosine] = math::sine_cosine(at.slope_angle);
    const Vec2 away{point.x - at.x, point.y + at.drop};
    const double distance = norm(away);
    const double along = away.x * cosine - away.y * sine;
    const double left = away.x * sine + away.y * cosine;
    if (distance < least) {
      least = distance;
      side = left < 0.0 ? -1.0 : 1.0;
      guess = s;
    }
    const double stretch = std::isfinite(at.curvature) ? std::max(1.0 - at.curvature * left, 0.25) : 1.0;
    const double next = std::clamp(s + along / stretch, 0.0, track.length());
    if (std::fabs(next - s) <= 1e-13 * track.length()) break;
    s = next;
  }
  return side * least;
}

/// The greatest value of a list, with the top between values by a parabola.
double greatest(const std::vector<double>& values, double sign) {
  double most = 0.0;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const double before = sign * values[i - 1];
    const double here = sign * values[i];
    const double after = sign * values[i + 1];
    most = std::max(most, here);
    const double bend = before - 2.0 * here + after;
    const double rise = 0.5 * (after - before);
    if (here >= before && here >= after && bend < 0.0) most = std::max(most, here - 0.5 * rise * rise / bend);
  }
  return most;
}

/// How far the spline lies to either side of the track at most.
Band measured(const Centerline& track, const ArcSpline& spline) {
  std::vector<double> offsets;
  double guess = 0.0;
  for (const TrackArc& arc : spline.arcs()) {
    for (int k = 0; k < kPointsPerArc; ++k) {
      const CenterlinePoint at = spline.at(arc.start + arc.length * k / kPointsPerArc);
      offsets.push_back(offset_from(track, {at.x, -at.drop}, guess));
      guess += arc.length / kPointsPerArc;
    }
  }
  return {greatest(offsets, 1.0), greatest(offsets, -1.0)};
}

/// Samples so close that each arc has many.
TrackSamples close_samples(const Centerline& track, double tolerance) {
  const TrackSamples samples = sample(track, kFirstSamples);
  const CirclePieces pieces = circle_pieces(samples, 0, samples.size() - 1, tolerance);
  return refined(track, samples, pieces, kSamplesPerArc);
}

/// No chain that keeps the track's lines and arcs has fewer arcs: the pieces that single circles pass, over the whole
/// track or between what the kept pieces can reach.
std::size_t least_arcs(const TrackSamples& samples, const std::vector<Kept>& kept, const Band& band) {
  const TrackSamples middle = moved_left(samples, 0.5 * (band.left - band.right));
  const double tolerance = band.half_width();
  const std::size_t whole = circle_pieces(middle, 0, middle.size() - 1, tolerance).count();
  std::size_t parts = kept.size();
  for (std::size_t i = 0; i <= kept.size(); ++i) {
    const std::optional<Stretch> stretch = stretch_before(samples, kept, i);
    if (!stretch) continue;
    const auto reach = [&](const std::optional<KeptEnd>& end, int step) {
      return end ? reach_of(samples, *stretch, end->leg, band, step) : 0.0;
    };
    const double from = samples.s[stretch->first] + reach(stretch->before, 1);
    const double to = samples.s[stretch->last] - reach(stretch->after, -1);
    if (!(from < to)) continue;
    parts += circle_pieces(middle, index_at(samples, from), index_at(samples, to), tolerance).count();
  }
  return std::max(whole, parts);
}

void require_fine(const Centerline& track, double tolerance) {
  const double finest = kFinestTolerance * track.length();
  if (std::isfinite(tolerance) && tolerance >= finest) return;
  throw InputError(
      {"", "arc tolerance: " + length_text(tolerance) + " is finer than arcs can be held to the track",
       "On a track of " + length_text(track.length()) + " the finest is " + length_text(finest, 2) + ".",
       "0.1 mm for plates, 0.02 mm for prints, 1 mm for timber"});
}

/// Arcs that no tolerance tells from a straight line left out: lines all of whose points lie within it of them.
std::vector<Kept> without_flat_arcs(std::vector<Kept> kept, double tolerance) {
  std::erase_if(kept, [&](const Kept& piece) {
    const double length = piece.to - piece.from;
    const double sagitta = 0.125 * std::fabs(piece.curvature) * length * length;
    return piece.curvature != 0.0 && sagitta <= 2.0 * tolerance;
  });
  return kept;
}

MasterCurve fitted(const Centerline& track, const TrackSamples& samples, const MasterCurveOptions& options,
                   const std::vector<Kept>& kept) {
  const Band band = band_of(options.side, options.tolerance);
  MasterCurve master;
  master.tolerance = options.tolerance;
  master.kept = kept.size();
  master.lower_bound = least_arcs(samples, kept, band);
  // What lies between two samples, and on the wrong arc beside a joint, is seen by the measurement alone.
  double aim = 1.0;
  for (int round = 0; round < 4; ++round) {
    master.spline = std::make_shared<ArcSpline>(assembled(track, samples, kept, band.scaled(aim)));
    const Band found = measured(track, *master.spline);
    master.max_deviation = std::max(found.left, found.right);
    const double excess = std::max(found.left / band.left, found.right / band.right);
    if (excess <= 1.0) {
      master.arcs = master.spline->arcs().size();
      for (const TrackArc& arc : master.spline->arcs()) master.lines += arc.curvature == 0.0 ? 1 : 0;
      return master;
    }
    aim *= 0.995 / excess;
  }
  throw ConvergenceError(
      {"", "arcs depart from the track by " + length_text(master.max_deviation, 3), "", ""});
}

}  // namespace

MasterCurve fit_arcs(const Centerline& track, const MasterCurveOptions& options) {
  require_fine(track, options.tolerance);
  const TrackSamples samples = close_samples(track, band_of(options.side, options.tolerance).half_width());
  const std::vector<Kept> kept = kept_pieces(track, options.tolerance);
  MasterCurve master = fitted(track, samples, options, kept);
  if (static_cast<double>(master.arcs) <=
      std::ceil(kExpectedShare * static_cast<double>(master.lower_bound)) + kExpectedMore)
    return master;
  // A search that just touches a limit on the radius leaves short arcs, each of which costs several more.
  const std::vector<Kept> seen = without_flat_arcs(kept, options.tolerance);
  if (seen.size() == kept.size()) return master;
  MasterCurve other = fitted(track, samples, options, seen);
  return other.arcs < master.arcs ? other : master;
}

}  // namespace glissade
