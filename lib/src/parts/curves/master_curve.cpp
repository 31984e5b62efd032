#include "glissade/parts/master_curve.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/curves/arc_fit.hpp"
#include "parts/curves/arc_search.hpp"
#include "parts/curves/circle_pieces.hpp"
#include "parts/curves/fewest_arcs.hpp"
#include "parts/curves/least_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
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
constexpr double kFlat = 2.0;  // tolerances by which an arc rises that a line within them could stand for
constexpr double kNarrower = 2e-3;  // of the band, where a fit has left it; twice that each time
constexpr int kMostPasses = 6;
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

/// Stretches of constant curvature, neighbours with the same one joined; none that is no longer than what arcs may miss, and
/// no arc that a line could stand for anyway.
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
  constexpr double kNoArc = 0.01;  // of the tolerance, by which it rises
  std::erase_if(kept, [&](const Kept& piece) {
    const double length = piece.to - piece.from;
    const double rise = 0.125 * std::fabs(piece.curvature) * length * length;
    return length <= tolerance || (piece.curvature != 0.0 && rise <= kNoArc * tolerance);
  });
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

/// Chains that are known, by their stretch, band and how thoroughly they were searched.
using KnownChains = std::map<std::tuple<std::size_t, std::size_t, double, double, bool>, ArcChain>;

/// What a fit goes by.
struct Fit {
  const Centerline& track;
  const TrackSamples& samples;
  MasterCurveOptions options;
  bool thorough = false;
  KnownChains known;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t>
      least;  // arcs of stretches, by first and last sample
};

/// The fewest arcs that a stretch takes within the band that is asked for.
std::size_t least_between(Fit& fit, const Stretch& stretch, const Band& band) {
  const auto key = std::pair(stretch.first, stretch.last);
  const auto known = fit.least.find(key);
  if (known != fit.least.end()) return known->second;
  return fit.least.emplace(key, least_arcs(fit.samples, stretch, band)).first->second;
}

/// The chain between a kept piece and the one before it; no vertices where there is nothing in between.
ArcChain chain_before(Fit& fit, const std::vector<Kept>& kept, std::size_t next, const Band& band) {
  const std::optional<Stretch> stretch = stretch_before(fit.samples, kept, next);
  if (!stretch) return {};
  const auto key = std::tuple(stretch->first, stretch->last, band.left, band.right, fit.thorough);
  const auto known = fit.known.find(key);
  if (known != fit.known.end()) return known->second;
  const Band wanted = band_of(fit.options.side, fit.options.tolerance);
  FewestSearch search{least_between(fit, *stretch, wanted), fit.thorough};
  const auto quick = fit.known.find(std::tuple(stretch->first, stretch->last, band.left, band.right, false));
  if (quick != fit.known.end()) search.known = &quick->second;
  ArcChain chain = fewest_arcs(fit.track, fit.samples, *stretch, band, search);
  return fit.known.emplace(key, std::move(chain)).first->second;
}

/// Lines and arcs of the track where it has them, chains in between.
ArcPath assembled(Fit& fit, const std::vector<Kept>& kept, const Band& band) {
  const TrackSamples& samples = fit.samples;
  std::vector<ArcChain> chains;
  for (std::size_t i = 0; i <= kept.size(); ++i) chains.push_back(chain_before(fit, kept, i, band));
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

/// How far a place of the spline lies to the left of the track.
/// @param guess  arc length of the track near it; becomes that of the nearest point
double offset_at(const Centerline& track, const ArcSpline& spline, double s, double& guess) {
  const CenterlinePoint at = spline.at(std::min(s, spline.length()));
  return offset_from(track, {at.x, -at.drop}, guess);
}

/// How far the spline lies to either side of the track at most: at points of each arc, and where parabolas through three
/// of them have their tops.
Band measured(const Centerline& track, const ArcSpline& spline) {
  Band found;
  const auto widen = [&](double offset) {
    found.left = std::max(found.left, offset);
    found.right = std::max(found.right, -offset);
  };
  std::vector<double> offsets(kPointsPerArc + 1);
  double guess = 0.0;
  for (const TrackArc& arc : spline.arcs()) {
    const double step = arc.length / kPointsPerArc;
    for (std::size_t k = 0; k <= kPointsPerArc; ++k) {
      offsets[k] = offset_at(track, spline, arc.start + step * static_cast<double>(k), guess);
      widen(offsets[k]);
      if (k < kPointsPerArc) guess += step;
    }
    for (std::size_t k = 1; k < kPointsPerArc; ++k) {
      const double rise = 0.5 * (offsets[k + 1] - offsets[k - 1]);
      const double bend = offsets[k - 1] - 2.0 * offsets[k] + offsets[k + 1];
      if (!(std::fabs(rise) < std::fabs(bend))) continue;
      const double ahead = -rise / bend;
      double near = guess + step * (static_cast<double>(k) + ahead - kPointsPerArc);
      widen(offset_at(track, spline, arc.start + step * (static_cast<double>(k) + ahead), near));
    }
  }
  return found;
}

/// Samples so close that each arc has many.
TrackSamples close_samples(const Centerline& track, double tolerance) {
  const TrackSamples samples = sample(track, kFirstSamples);
  const CirclePieces pieces = circle_pieces(samples, 0, samples.size() - 1, tolerance);
  return refined(track, samples, pieces, kSamplesPerArc);
}

/// No chain that keeps the track's lines and arcs with their tangents has fewer arcs: what is kept and what each stretch between
/// takes, or the pieces of the whole track that single circles pass, where these are more.
std::size_t lower_bound_of(Fit& fit, const std::vector<Kept>& kept, const Band& band) {
  const TrackSamples middle = moved_left(fit.samples, band.middle());
  const std::size_t whole = circle_pieces(middle, 0, middle.size() - 1, band.half_width()).count();
  std::size_t parts = kept.size();
  for (std::size_t i = 0; i <= kept.size(); ++i) {
    const std::optional<Stretch> stretch = stretch_before(fit.samples, kept, i);
    if (stretch) parts += least_between(fit, *stretch, band);
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

/// @param flattest  rise of the arcs that are left out, at most [m]
/// Lines, and arcs that are not flat.
std::vector<Kept> without_arcs(std::vector<Kept> kept, double flattest) {
  std::erase_if(kept, [&](const Kept& piece) {
    const double length = piece.to - piece.from;
    return piece.curvature != 0.0 && 0.125 * std::fabs(piece.curvature) * length * length <= flattest;
  });
  return kept;
}

/// Whether there are no more arcs than are to be expected.
bool as_expected(const MasterCurve& curve) {
  return static_cast<double>(curve.arcs) <=
         std::ceil(kExpectedShare * static_cast<double>(curve.lower_bound)) + kExpectedMore;
}

/// The band for a fit that was found to leave the one wanted.
/// @param share  of the one wanted, by which it is narrower than would do
Band narrowed(const Band& aim, const Band& found, const Band& wanted, double share) {
  const double more = share * wanted.half_width();
  const auto side = [&](double aimed, double reached, double bound) {
    return reached > bound ? std::max(aimed - (reached - bound) - more, 0.2 * bound) : aimed;
  };
  Band next{side(aim.left, found.left, wanted.left), side(aim.right, found.right, wanted.right)};
  if (wanted.left == wanted.right) next.left = next.right = std::min(next.left, next.right);
  return next;
}

MasterCurve fitted(Fit& fit, const std::vector<Kept>& kept) {
  const Band band = band_of(fit.options.side, fit.options.tolerance);
  MasterCurve master;
  master.tolerance = fit.options.tolerance;
  master.kept = kept.size();
  master.lower_bound = lower_bound_of(fit, kept, band);
  // What lies between two samples, and on the wrong arc beside a joint, is seen by the measurement alone.
  Band aim = band;
  for (int round = 0; round < kMostPasses; ++round) {
    master.spline = std::make_shared<ArcSpline>(assembled(fit, kept, aim));
    const Band found = measured(fit.track, *master.spline);
    master.max_deviation = std::max(found.left, found.right);
    if (found.left <= band.left && found.right <= band.right) {
      master.arcs = master.spline->arcs().size();
      for (const TrackArc& arc : master.spline->arcs()) master.lines += arc.curvature == 0.0 ? 1 : 0;
      return master;
    }
    aim = narrowed(aim, found, band, kNarrower * (1 << round));
  }
  throw ConvergenceError(
      {"", "arcs depart from the track by " + length_text(master.max_deviation, 3), "", ""});
}

/// Pieces that leave more to what lies between them, at either end a share of their length.
std::vector<Kept> with_room(std::vector<Kept> kept, const TrackSamples& samples, double share) {
  for (Kept& piece : kept) {
    const double room = share * (piece.to - piece.from);
    if (piece.from > 0.0) piece.from = samples.s[index_at(samples, piece.from + room)];
    if (piece.to < samples.s.back()) piece.to = samples.s[index_at(samples, piece.to - room)];
  }
  std::erase_if(kept, [](const Kept& piece) { return !(piece.to > piece.from); });
  return kept;
}

/// Where next to no way leads from one piece to the next - a line that crosses the circle behind it by a rounding - no arcs join
/// them as they are.
MasterCurve fitted_with_room(Fit& fit, const std::vector<Kept>& kept) {
  for (const double share : {0.0, 0.02, 0.1}) {
    try {
      return fitted(fit, share == 0.0 ? kept : with_room(kept, fit.samples, share));
    } catch (const ConvergenceError&) {
      // The next one has more.
    }
  }
  return fitted(fit, with_room(kept, fit.samples, 0.2));
}

}  // namespace

MasterCurve fit_arcs(const Centerline& track, const MasterCurveOptions& options) {
  require_fine(track, options.tolerance);
  const TrackSamples samples = close_samples(track, band_of(options.side, options.tolerance).half_width());
  const std::vector<Kept> kept = kept_pieces(track, options.tolerance);
  Fit fit{track, samples, options, false, {}, {}};
  MasterCurve best = fitted_with_room(fit, kept);
  const auto take = [&best](MasterCurve other) {
    const bool better = as_expected(other) == as_expected(best) ? other.arcs < best.arcs : as_expected(other);
    if (better) best = std::move(other);
  };
  if (options.found) {
    // A search that just touches a limit on the radius leaves short arcs, each of which costs several more.
    const std::vector<Kept> seen = without_arcs(kept, kFlat * options.tolerance);
    if (seen.size() < kept.size()) take(fitted_with_room(fit, seen));
  }
  if (as_expected(best)) return best;
  fit.thorough = true;
  take(fitted_with_room(fit, kept));
  const std::vector<Kept> lines = without_arcs(kept, std::numeric_limits<double>::infinity());
  if (options.found && !as_expected(best) && lines.size() < kept.size()) take(fitted_with_room(fit, lines));
  return best;
}

}  // namespace glissade
