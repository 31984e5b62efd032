#include "parts/supports/trestle.hpp"

#include "parts/plates/section_outside.hpp"
#include "parts/supports/ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace glissade::parts {
namespace {

constexpr double kOffLap = 1e-3;   // of a saddle that stands beside laps [m]
constexpr double kOffBeam = 2e-3;  // from the track above it: what a weld of the floor's corner takes [m]

/// The lowest of the outside above a plate between two places across.
double underside_between(const ArcPath& line, double from, double to) {
  double lowest = std::numeric_limits<double>::infinity();
  const auto see = [&](double x) {
    if (const auto y = underside_at(line, x)) lowest = std::min(lowest, *y);
  };
  see(from);
  see(0.5 * (from + to));
  see(to);
  for (const PathVertex& vertex : line.vertices) {
    if (vertex.at.x > from && vertex.at.x < to) see(vertex.at.x);
  }
  return lowest;
}

/// As far out as the outside leans no more than so, clear of what laps below it.
double saddle_on_left(const SectionOutside& outside) {
  constexpr double kMostLean = 0.58;   // tan 30 deg
  constexpr double kFromEdge = 20e-3;  // of a saddle's middle [m]
  constexpr double kAtLeast = 0.25;    // of the section's half width, however it leans
  constexpr int kPlaces = 400;
  double widest = 0.0;
  for (const Vec2 point : flattened(outside.line, 1e-4)) widest = std::max(widest, point.x);
  double aside = 0.0;
  const double step = widest / kPlaces;
  std::optional<double> before = underside_at(outside.line, 0.0);
  for (int k = 1; k <= kPlaces && before; ++k) {
    // The outermost line itself is upright.
    const auto here = underside_at(outside.line, step * std::min(k + 0.0, kPlaces - 1e-6));
    if (!here || std::fabs(*here - *before) > kMostLean * step) break;
    aside = step * k;
    before = here;
  }
  for (const Vec2 tip : lap_tips(outside)) {
    // A whole saddle inside of walls that reach below the floor.
    if (tip.x > 0.0 && tip.x < aside + kSaddle) aside = std::min(aside, tip.x - 0.5 * kSaddle);
  }
  double seat = std::max(aside - kFromEdge, kAtLeast * widest);
  double thick = 0.0;
  for (const OutsideLap& lap : outside.laps) thick = std::max(thick, lap.thickness);
  for (const Vec2 tip : lap_tips(outside)) {
    // Below a narrow floor what walls reach inwards goes first.
    const double clear = tip.x - thick - 0.5 * kSaddle - kOffLap;
    if (clear > kSaddle && tip.x < seat + thick + kSaddle) seat = std::min(seat, clear);
  }
  return seat;
}

/// The lowest of the outside's lowest line within so much of an x.
/// @param s       of the track, about there
/// @param height  of the outside at that x, above the floor line
double lowest_about(const Shell& shell, double s, double height, double x, double within) {
  // Lines that are lower than the saddles' lie above the beam from another stretch of the track.
  constexpr double kLeastLevel = 0.2;  // cosine of the steepest slope that is looked at
  const TrackFrame frame = frame_of(shell, s);
  const double reach = kSaddleHalf + (std::fabs((height - shell.lowest) * frame.along.y) + within) /
                                         std::max(kLeastLevel, frame.along.x);
  double low = std::numeric_limits<double>::infinity();
  constexpr int kPlaces = 100;
  for (int k = -kPlaces; k <= kPlaces; ++k) {
    const TrackFrame here = frame_of(shell, std::clamp(s + reach * k / kPlaces, 0.0, shell.track.length()));
    const Vec2 point = here.at + shell.lowest * here.up;
    // Between two of them the line is no lower than at the one beyond.
    const double step = reach / kPlaces * here.along.x;
    if (std::fabs(point.x - x) <= within + step) low = std::min(low, point.y);
  }
  return low;
}

}  // namespace

Saddles saddles_at(const Shell& shell, double s, double half) {
  Saddles saddles;
  saddles.half = half;
  for (std::size_t side = 0; side < 2; ++side) {
    double aside = std::numeric_limits<double>::infinity();
    double height = std::numeric_limits<double>::infinity();
    for (const bool placed : {false, true}) {
      for (const double at : {s - half, s, s + half}) {
        const SectionOutside outside = side == 0 ? shell.outside(at) : mirrored(shell.outside(at));
        if (placed) {
          const Span across{aside - 0.5 * kSaddle, aside + 0.5 * kSaddle};
          height = std::min(height, underside_between(outside.line, across.from, across.to));
          // Where a narrow floor leaves no place beside what laps, it carries the laps.
          if (const auto laps = underside_of_laps(outside, across.from - kOffLap, across.to + kOffLap))
            height = std::min(height, *laps);
        } else {
          aside = std::min(aside, saddle_on_left(outside));
        }
      }
    }
    saddles.aside[side] = side == 0 ? aside : -aside;
    saddles.height[side] = height;
  }
  return saddles;
}

double base_side(const SupportOptions& supports) {
  return std::max(150e-3, supports.tube + 90e-3);
}

Trestle trestle_at(const Shell& shell, double at, const Saddles& saddles) {
  const SupportOptions& supports = *shell.options.supports;
  Trestle trestle;
  trestle.at = at;
  const double height = 0.5 * (saddles.height[0] + saddles.height[1]);
  const auto below = [&](double s) {
    const TrackFrame frame = frame_of(shell, s);
    return frame.at + shell.lowest * frame.up;
  };
  const TrackFrame frame = frame_of(shell, at);
  trestle.x = (frame.at + height * frame.up).x;
  double low = std::min({below(at - saddles.half).y, below(at).y, below(at + saddles.half).y});
  if (height > shell.lowest)
    low = std::min(low, lowest_about(shell, at, height, trestle.x, kSaddleHalf + supports.tube));
  // Below a slope the beam's edge downstream is nearer to the track than the saddles, where it is wider than they are long.
  trestle.beam = std::min(low - kSaddleLeast,
                          lowest_about(shell, at, height, trestle.x, 0.5 * supports.tube) - kOffBeam);
  // The highest below the base plate: grout fills the rest.
  const double half = 0.5 * base_side(supports);
  trestle.ground = highest_ground(supports.ground, trestle.x - half, trestle.x + half);
  return trestle;
}

std::optional<ArcPath> seat_line(const Shell& shell, double at, double half, double height) {
  if (shell.straights.empty()) return offset_line(shell.track, {at - half, at + half}, height);
  ArcPath line;
  // Along the flat or tube on which its middle stands.
  const TrackFrame frame = frame_of(shell, at);
  for (const double reach : {-half, half})
    line.vertices.push_back({frame.at + reach * frame.along + height * frame.up, 0.0});
  return line;
}

}  // namespace glissade::parts
