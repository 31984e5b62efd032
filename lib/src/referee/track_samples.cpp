#include "referee/track_samples.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace glissade::referee {
namespace {

/// As many samples on a piece as its length asks for: the fewer pieces a track has, the more of its bends lie in each; fewer
/// where a piece is short: a curvature follows a load in many of them.
/// @param share  of the track that a piece takes up
int samples_within(double share, int samples) {
  constexpr double kUsualPieces = 32.0;
  constexpr double kLeast = 0.3;
  return std::max(static_cast<int>(std::ceil(samples * std::max(share * kUsualPieces, kLeast))), 2);
}

/// Where the ride changes its law: both sides of each place.
void add_changes(const Body& body, double length, std::vector<double>& stations) {
  std::vector<double> places;
  for (const FrictionChange& change : body.friction_changes) places.push_back(change.from);
  if (body.law) {
    const std::vector<double> breaks = body.law->breaks();
    places.insert(places.end(), breaks.begin(), breaks.end());
  }
  for (const double place : places) {
    if (!(place > 0.0) || !(place < length)) continue;
    stations.push_back(std::nextafter(place, 0.0));
    stations.push_back(place);
  }
}

}  // namespace

std::vector<double> sampled(const Centerline& track, const Problem& problem, int samples) {
  const std::vector<double> breaks = track.breaks();
  std::vector<double> stations;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    const int count = samples_within(width / breaks.back(), samples);
    for (int k = 0; k < count; ++k) stations.push_back(breaks[i] + width * k / count);
    // At the break itself the values of the next piece hold.
    stations.push_back(std::nextafter(breaks[i + 1], breaks[i]));
  }
  stations.push_back(breaks.back());
  const double from = problem.limits.lowest_speed_from;
  if (from > 0.0 && from < breaks.back()) stations.push_back(from);
  add_changes(problem.body, breaks.back(), stations);
  std::sort(stations.begin(), stations.end());
  stations.erase(std::unique(stations.begin(), stations.end()), stations.end());
  return stations;
}

std::vector<std::size_t> passages_in_order(const std::vector<CenterlinePoint>& points,
                                           const std::vector<Vec2>& targets) {
  // From the last target back: the least sum of squares from a sample on, and the first sample that has it.
  std::vector<double> rest(points.size() + 1, 0.0);
  rest.back() = std::numeric_limits<double>::infinity();
  std::vector<std::vector<std::size_t>> at(targets.size());
  for (std::size_t k = targets.size(); k-- > 0;) {
    at[k].assign(points.size(), points.size() - 1);
    double least = std::numeric_limits<double>::infinity();
    std::size_t where = points.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) {
      const Vec2 away = Vec2{points[i].x, points[i].drop} - targets[k];
      const double sum = dot(away, away) + rest[i];
      if (sum <= least) {
        least = sum;
        where = i;
      }
      rest[i] = least;
      at[k][i] = where;
    }
  }
  std::vector<std::size_t> passages;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    passages.push_back(at[k][passages.empty() ? 0 : passages.back()]);
  }
  return passages;
}

double closest_approach(const Centerline& track, const std::vector<CenterlinePoint>& points,
                        std::size_t nearest, Vec2 target, double& where) {
  double low = points[nearest == 0 ? 0 : nearest - 1].arc_length;
  double high = points[std::min(nearest + 1, points.size() - 1)].arc_length;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    const CenterlinePoint point = track.at(middle);
    const double along = (target.x - point.x) * math::cos(point.slope_angle) +
                         (target.y - point.drop) * math::sin(point.slope_angle);
    (along > 0.0 ? low : high) = middle;
  }
  where = 0.5 * (low + high);
  const CenterlinePoint point = track.at(where);
  return norm(Vec2{point.x, point.drop} - target);
}

void add_extremes(std::span<const double> stations, std::span<const double> values,
                  std::vector<double>& places) {
  constexpr double kBreak = 1e-12;    // of the track: both sides of one lie closer to each other
  constexpr double kMatters = 1e-11;  // of the greatest value
  const std::size_t count = stations.size();
  if (count < 3) return;
  double greatest = 0.0;
  for (const double value : values) greatest = std::max(greatest, std::fabs(value));
  const double gap = kBreak * stations.back();
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before = stations[i] - stations[i - 1];
    const double behind = stations[i + 1] - stations[i];
    if (before <= gap || behind <= gap) continue;
    const double rise = (values[i] - values[i - 1]) / before;
    const double next_rise = (values[i + 1] - values[i]) / behind;
    const double bend = (next_rise - rise) / (before + behind);
    // From the middle one of the three.
    const double away = -0.5 * (rise + bend * before) / bend;
    const bool first = i == 1 || stations[i - 1] - stations[i - 2] <= gap;
    const bool last = i + 2 == count || stations[i + 2] - stations[i + 1] <= gap;
    const bool between = away >= (first ? -before : -0.5 * before) && away <= (last ? behind : 0.5 * behind);
    if (between && std::fabs(bend) * away * away > kMatters * greatest) places.push_back(stations[i] + away);
  }
}

namespace {

/// A change of curvature from one piece to the next, times the track's length; below it is rounding.
constexpr double kJump = 1e-9;

/// A spline's curvature is known at its joints, and linear between them.
void see_curvature(const ClothoidSpline& spline, Watches& watches) {
  double s = 0.0;
  double before = spline.segments().front().entry_curvature;
  for (const ClothoidSegment& segment : spline.segments()) {
    const double jump = std::fabs(segment.entry_curvature - before) * spline.length();
    if (jump > kJump) watches.at_rate(s, std::numeric_limits<double>::infinity());
    watches.at_curvature(s, segment.entry_curvature);
    watches.at_rate(s, (segment.exit_curvature - segment.entry_curvature) / segment.length);
    s += segment.length;
    watches.at_curvature(s, segment.exit_curvature);
    before = segment.exit_curvature;
  }
}

}  // namespace

void see_curvature(const Centerline& track, int samples, Watches& watches) {
  if (const auto* spline = dynamic_cast<const ClothoidSpline*>(&track)) {
    see_curvature(*spline, watches);
    return;
  }
  const std::vector<double> breaks = track.breaks();
  double before = track.direction(0.0).curvature;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    double s_before = breaks[i];
    const double width = breaks[i + 1] - breaks[i];
    const int count = samples_within(width / breaks.back(), samples);
    for (int k = 0; k <= count; ++k) {
      const double s = k == count ? std::nextafter(breaks[i + 1], breaks[i]) : breaks[i] + width * k / count;
      const double curvature = track.direction(s).curvature;
      watches.at_curvature(s, curvature);
      const double change = std::fabs(curvature - before);
      if (k > 0) {
        watches.at_rate(s_before, change / (s - s_before));
      } else if (!(change * track.length() <= kJump)) {
        watches.at_rate(s, std::numeric_limits<double>::infinity());
      }
      before = curvature;
      s_before = s;
    }
  }
}

std::pair<double, double> straight_ends(const std::vector<CenterlinePoint>& points) {
  constexpr double kStraight = 1e-7;  // [rad]
  const CenterlinePoint& first = points.front();
  const CenterlinePoint& last = points.back();
  double in = 0.0;
  for (const CenterlinePoint& point : points) {
    if (!(std::fabs(point.slope_angle - first.slope_angle) <= kStraight)) break;
    in = point.arc_length;
  }
  double out = 0.0;
  const auto bent = std::find_if(points.rbegin(), points.rend(), [&](const CenterlinePoint& point) {
    return !(std::fabs(point.slope_angle - last.slope_angle) <= kStraight);
  });
  if (bent != points.rbegin()) out = last.arc_length - std::prev(bent)->arc_length;
  // The last point before the end is a rounding away from it.
  constexpr double kNothing = 1e-12;
  return {in > kNothing * last.arc_length ? in : 0.0, out > kNothing * last.arc_length ? out : 0.0};
}

}  // namespace glissade::referee
