#include "glissade/parts/master_curve.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/arc_fit.hpp"
#include "parts/circle_pieces.hpp"

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
constexpr double kSameArc = 1e-10;     // relative difference of curvatures within one arc of the track
constexpr double kSameLine = 1e-12;    // the same of straight lines, times the length of the track
constexpr std::size_t kMoreArcs = 64;  // than the bound, before the search for a chain gives up

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
  return same_curvature(0.0, middle, track.length()) ? 0.0 : middle;
}

/// Stretches of constant curvature, neighbours with the same one joined.
std::vector<Kept> kept_pieces(const Centerline& track) {
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
  return kept;
}

/// The band of a fit, and the width to either side of its middle.
struct Aim {
  Band band;
  double width = 0.0;  // [m]
};

Aim aim_at(FitSide side, double tolerance) {
  switch (side) {
    case FitSide::away:
      return {{-0.5 * tolerance}, 0.5 * tolerance};
    case FitSide::into_flow:
      return {{0.5 * tolerance}, 0.5 * tolerance};
    case FitSide::both:
      break;
  }
  return {{}, tolerance};
}

/// Places where a given number of arcs should join: ends of pieces whose common tolerance is the least that this many
/// pieces have.
std::vector<double> first_knots(const TrackSamples& samples, const Stretch& stretch, double tolerance,
                                std::size_t cells) {
  double high = tolerance;  // too many pieces below `low`, few enough at `high`
  double low = tolerance;
  const auto pieces_at = [&](double bound) {
    return circle_pieces(samples, stretch.first, stretch.last, bound);
  };
  CirclePieces pieces = pieces_at(high);
  while (pieces.count() > cells) pieces = pieces_at(high *= 2.0);
  for (int k = 0; k < 8 && pieces_at(low).count() <= cells; ++k) low *= 0.5;
  for (int k = 0; k < 5; ++k) {
    const double middle = std::sqrt(low * high);
    const CirclePieces tried = pieces_at(middle);
    if (tried.count() > cells) {
      low = middle;
    } else {
      high = middle;
      pieces = tried;
    }
  }
  std::vector<double> knots = {samples.s[stretch.first]};
  for (std::size_t i = 0; i + 1 < pieces.ends.size(); ++i) knots.push_back(samples.s[pieces.ends[i]]);
  knots.push_back(samples.s[stretch.last]);
  while (knots.size() < cells + 1) {  // fewer pieces would do: split the longest
    std::size_t longest = 0;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      if (knots[i + 1] - knots[i] > knots[longest + 1] - knots[longest]) longest = i;
    }
    const double middle = 0.5 * (knots[longest] + knots[longest + 1]);
    knots.insert(knots.begin() + static_cast<std::ptrdiff_t>(longest) + 1, middle);
  }
  return knots;
}

std::size_t index_at(const TrackSamples& samples, double s) {
  return static_cast<std::size_t>(std::lower_bound(samples.s.begin(), samples.s.end(), s) -
                                  samples.s.begin());
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

/// How far a kept piece stays within a tolerance of a stretch beside it, at most a part of that.
/// @param step  1 from its start on, -1 from its end back
double reach_of(const TrackSamples& samples, const Stretch& stretch, const ArcAt& leg, double tolerance,
                int step) {
  constexpr double kMost = 0.45;  // of the stretch: the other end may reach as far
  const double most = kMost * (samples.s[stretch.last] - samples.s[stretch.first]);
  const std::size_t from = step > 0 ? stretch.first : stretch.last;
  double reached = 0.0;
  for (std::size_t j = from; j >= stretch.first && j <= stretch.last; j += static_cast<std::size_t>(step)) {
    const double away = std::fabs(samples.s[j] - samples.s[from]);
    if (away > most || std::fabs(leg.distance(samples.point[j])) > tolerance) break;
    reached = away;
  }
  return reached;
}

/// As few arcs as keep the band along a stretch.
ArcChain fewest_arcs(const TrackSamples& samples, const Stretch& stretch, const Aim& aim) {
  if (stretch.before && stretch.after && stretch.before->reach > 0.0 && stretch.after->reach > 0.0) {
    ArcChain one = tangent_arc(samples, stretch);
    if (one.deviation <= aim.width) return one;
  }
  // Of what a kept piece may reach, where its joint begins to look for its place.
  constexpr double kFirstShare = 0.6;
  Stretch inner = stretch;
  if (stretch.before)
    inner.first = index_at(samples, samples.s[stretch.first] + kFirstShare * stretch.before->reach);
  if (stretch.after)
    inner.last = index_at(samples, samples.s[stretch.last] - kFirstShare * stretch.after->reach);
  const std::size_t bound = circle_pieces(samples, inner.first, inner.last, aim.width).count();
  const std::size_t least = stretch.before && stretch.after ? 2 : 1;
  ArcChain chain;
  for (std::size_t cells = std::max(bound, least); cells <= 2 * bound + kMoreArcs; ++cells) {
    chain = fit_chain(samples, stretch, first_knots(samples, inner, aim.width, cells), aim.band, aim.width);
    if (chain.deviation <= aim.width) return chain;
  }
  throw ConvergenceError(
      {"", "no arcs found that follow the track within " + length_text(aim.width), "", "a larger tolerance"});
}

/// The chain between a kept piece and the one before it; no vertices where there is nothing in between.
ArcChain chain_before(const TrackSamples& samples, const std::vector<Kept>& kept, std::size_t next,
                      const Aim& aim) {
  std::optional<Stretch> stretch = stretch_before(samples, kept, next);
  if (!stretch) return {};
  // A band to one side closes where a kept piece begins: there that stays as long as it is.
  if (aim.band.middle == 0.0) {
    for (auto* end : {&stretch->before, &stretch->after}) {
      const int step = end == &stretch->before ? 1 : -1;
      if (*end) (*end)->reach = reach_of(samples, *stretch, (*end)->leg, aim.width, step);
    }
  }
  return fewest_arcs(samples, *stretch, aim);
}

/// Lines and arcs of the track where it has them, chains in between.
ArcPath assembled(const TrackSamples& samples, const std::vector<Kept>& kept, const Aim& aim) {
  std::vector<ArcChain> chains;
  for (std::size_t i = 0; i <= kept.size(); ++i) chains.push_back(chain_before(samples, kept, i, aim));
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

/// The distance of a point from the track.
/// @param guess  arc length near the nearest point; becomes that of the point found
double distance_to(const Centerline& track, Vec2 point, double& guess) {
  double s = std::clamp(guess, 0.0, track.length());
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 12; ++step) {
    const CenterlinePoint at = track.at(s);
    const auto [sine, cosine] = math::sine_cosine(at.slope_angle);
    const Vec2 away{point.x - at.x, point.y + at.drop};
    const double distance = norm(away);
    if (distance < least) {
      least = distance;
      guess = s;
    }
    const double along = away.x * cosine - away.y * sine;
    const double left = away.x * sine + away.y * cosine;
    const double stretch = std::isfinite(at.curvature) ? std::max(1.0 - at.curvature * left, 0.25) : 1.0;
    const double next = std::clamp(s + along / stretch, 0.0, track.length());
    if (std::fabs(next - s) <= 1e-13 * track.length()) break;
    s = next;
  }
  return least;
}

/// The greatest distance of the spline from the track, with the top between points by a parabola.
double measured_deviation(const Centerline& track, const ArcSpline& spline) {
  std::vector<double> found;
  double guess = 0.0;
  for (const TrackArc& arc : spline.arcs()) {
    for (int k = 0; k < kPointsPerArc; ++k) {
      const double along = arc.length * k / kPointsPerArc;
      const CenterlinePoint at = spline.at(arc.start + along);
      found.push_back(distance_to(track, {at.x, -at.drop}, guess));
      guess += arc.length / kPointsPerArc;
    }
  }
  double most = 0.0;
  for (std::size_t i = 1; i + 1 < found.size(); ++i) {
    most = std::max(most, found[i]);
    const double bend = found[i - 1] - 2.0 * found[i] + found[i + 1];
    const double rise = 0.5 * (found[i + 1] - found[i - 1]);
    const bool top = found[i] >= found[i - 1] && found[i] >= found[i + 1] && bend < 0.0;
    if (top) most = std::max(most, found[i] - 0.5 * rise * rise / bend);
  }
  return most;
}

void require_fine(const Centerline& track, double tolerance) {
  const double finest = kFinestTolerance * track.length();
  if (std::isfinite(tolerance) && tolerance >= finest) return;
  throw InputError(
      {"", "arc tolerance: " + length_text(tolerance) + " is finer than arcs can be held to the track",
       "On a track of " + length_text(track.length()) + " the finest is " + length_text(finest, 2) + ".",
       "0.1 mm for plates, 0.02 mm for prints, 1 mm for timber"});
}

}  // namespace

MasterCurve fit_arcs(const Centerline& track, const MasterCurveOptions& options) {
  require_fine(track, options.tolerance);
  TrackSamples samples = sample(track, kFirstSamples);
  std::size_t bound = circle_pieces(samples, 0, samples.size() - 1, options.tolerance).count();
  if (bound * kSamplesPerArc > samples.size()) {
    samples = sample(track, bound * kSamplesPerArc);
    bound = circle_pieces(samples, 0, samples.size() - 1, options.tolerance).count();
  }
  const std::vector<Kept> kept = kept_pieces(track);
  MasterCurve master;
  master.lower_bound = bound;
  master.tolerance = options.tolerance;
  // What lies between two samples, and on the wrong arc beside a joint, is seen by the measurement alone.
  double aim = options.tolerance;
  for (int round = 0; round < 4; ++round) {
    master.spline = std::make_shared<ArcSpline>(assembled(samples, kept, aim_at(options.side, aim)));
    master.max_deviation = measured_deviation(track, *master.spline);
    if (master.max_deviation <= options.tolerance) break;
    aim *= 0.995 * options.tolerance / master.max_deviation;
  }
  if (master.max_deviation > options.tolerance) {
    throw ConvergenceError(
        {"", "arcs depart from the track by " + length_text(master.max_deviation, 3), "", ""});
  }
  master.arcs = master.spline->arcs().size();
  master.kept = kept.size();
  for (const TrackArc& arc : master.spline->arcs()) master.lines += arc.curvature == 0.0 ? 1 : 0;
  return master;
}

}  // namespace glissade
