#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/task/problem.hpp"

#include "referee/watches.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

/// Where a track is looked at, and what only the whole of it tells.
namespace glissade::referee {

/// @param samples  points on a piece as long as a 32nd of the track; a longer one has more, a shorter one fewer
/// @return arc lengths from 0 to the end, ascending: both sides of every break, and of every place at which friction or the
///   law changes [m]
[[nodiscard]] std::vector<double> sampled(const Centerline& track, const Problem& problem, int samples);

/// Adds the places between samples where a smooth quantity is greatest or least: vertices of the parabola through three of
/// them, none across a break or where it matters by less than rounding does.
/// @param values  at each station
void add_extremes(std::span<const double> stations, std::span<const double> values,
                  std::vector<double>& places);

/// Shows all of a track's curvature and its rate, jumps included.
/// @param samples  points on a piece that is no clothoid
void see_curvature(const Centerline& track, int samples, Watches& watches);

/// @return lengths of the straights that a track starts and ends with, as far as its points tell
[[nodiscard]] std::pair<double, double> straight_ends(const std::vector<CenterlinePoint>& points);

/// @return the samples at which a track passes some points in their order, closest to all of them together
[[nodiscard]] std::vector<std::size_t> passages_in_order(const std::vector<CenterlinePoint>& points,
                                                         const std::vector<Vec2>& targets);

/// @param nearest  of the points, the one closest to the target
/// @param where    takes the arc length at which the track is closest [m]
/// @return the distance there [m]
[[nodiscard]] double closest_approach(const Centerline& track, const std::vector<CenterlinePoint>& points,
                                      std::size_t nearest, Vec2 target, double& where);

}  // namespace glissade::referee
