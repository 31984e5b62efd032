#include "glissade/centerline/fitted_profile.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "profile_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace glissade {
namespace {

std::string point_text(const std::vector<Vec2>& points, std::size_t index) {
  return "point " + std::to_string(index + 1) + " (" + exact_text(points[index].x) + ", " +
         exact_text(points[index].y) + ")";
}

/// A turn sharper than this between two long chords is not a track, but points out of order.
constexpr double kSharpestTurnCosine = -0.5;
/// Chords shorter than this share of the profile may turn as noise makes them.
constexpr double kLongChord = 0.02;

void require_distinct_numbers(const std::vector<Vec2>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      throw InputError({point_text(points, i), "it is not finite", "A profile is made of places.", ""});
    }
    if (i > 0 && points[i] == points[i - 1]) {
      throw InputError({point_text(points, i), "it repeats the point before it",
                        "The direction of the profile is lost between equal points.",
                        "leave one of them out"});
    }
  }
}

void require_order(const std::vector<Vec2>& points) {
  double reach = 0.0;
  for (const Vec2& point : points) reach = std::max(reach, norm(point - points.front()));
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec2 before = points[i] - points[i - 1];
    const Vec2 after = points[i + 1] - points[i];
    if (std::min(norm(before), norm(after)) < kLongChord * reach) continue;
    if (dot(before, after) >= kSharpestTurnCosine * norm(before) * norm(after)) continue;
    throw InputError({point_text(points, i), "the profile turns back on itself here",
                      "Points are read in order from start to finish; a track has no spikes.",
                      "the points sorted along the track"});
  }
}

std::vector<Vec2> in_track_frame(std::vector<Vec2> points) {
  if (points.size() < 3) {
    throw InputError({"points", "there are " + std::to_string(points.size()) + " of them",
                      "A curve needs at least 3 points.", "the kind straight for two points"});
  }
  require_distinct_numbers(points);
  require_order(points);
  const Vec2 start = points.front();
  const double side = points.back().x < start.x ? -1.0 : 1.0;
  for (Vec2& point : points) point = {side * (point.x - start.x), point.y - start.y};
  return points;
}

const ProfileFit& checked(const ProfileFit& fit) {
  const bool usable = !fit.max_deviation || (*fit.max_deviation > 0.0 && std::isfinite(*fit.max_deviation));
  if (usable) return fit;
  throw InputError({"", "max_deviation: " + exact_text(*fit.max_deviation) + " m is not positive and finite",
                    "A smooth curve does not go through every measured point.",
                    "the accuracy of the measurement"});
}

}  // namespace

FittedProfile::FittedProfile(std::vector<Vec2> points, const ProfileFit& fit)
    : points_(in_track_frame(std::move(points))),
      curve_(fit_clothoid_spline(points_, checked(fit))),
      deviations_(deviations_from(curve_, points_)) {
  double sum = 0.0;
  for (const PointDeviation& point : deviations_) {
    max_deviation_ = std::max(max_deviation_, std::fabs(point.deviation));
    sum += point.deviation * point.deviation;
  }
  rms_deviation_ = std::sqrt(sum / static_cast<double>(points_.size()));
}

}  // namespace glissade
