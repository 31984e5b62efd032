#include "glissade/centerline/fitted_profile.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "centerline/profile/profile_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace glissade {

using namespace centerline;

namespace {

std::string point_text(const std::vector<Vec2>& points, std::size_t index) {
  return "point " + std::to_string(index + 1) + " (" + exact_text(points[index].x) + ", " +
         exact_text(points[index].y) + ")";
}

/// A turn sharper than this between two long chords is not a track, but points out of order.
constexpr double kSharpestTurnCosine = -0.5;
/// Chords shorter than this share of the profile may turn as noise makes them.
constexpr double kLongChord = 0.02;

double reach_of(const std::vector<Vec2>& points) {
  double reach = 0.0;
  for (const Vec2& point : points) reach = std::max(reach, norm(point - points.front()));
  return reach;
}

/// A point may lie this share of the profile's reach behind an earlier one: noise, where the profile is steep.
constexpr double kFarthestBack = 0.005;

/// The first point that lies too far behind an earlier one; the number of points if there is none.
std::size_t point_running_back(const std::vector<Vec2>& points, double reach) {
  const double side = points.back().x < points.front().x ? -1.0 : 1.0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double run = side * (points[i].x - points.front().x);
    if (run < farthest - kFarthestBack * reach) return i;
    farthest = std::max(farthest, run);
  }
  return points.size();
}

bool turns_back(Vec2 before, Vec2 after, double long_chord) {
  if (std::min(norm(before), norm(after)) < long_chord) return false;
  return dot(before, after) < kSharpestTurnCosine * norm(before) * norm(after);
}

std::vector<Vec2> in_track_frame(std::vector<Vec2> points) {
  if (const auto fault = profile_fault(points)) throw InputError(fault->issue);
  const Vec2 start = points.front();
  const double side = points.back().x < start.x ? -1.0 : 1.0;
  for (Vec2& point : points) point = {side * (point.x - start.x), point.y - start.y};
  return points;
}

/// Whether deviations of neighbours go together more than chance lets them.
bool shows_pattern(const std::vector<PointDeviation>& deviations) {
  constexpr std::size_t kFewest = 20;
  // Half of what a neighbour shows is foretold, and no chance of one in ten thousand makes it so.
  constexpr double kMuch = 0.5;
  constexpr double kChance = 4.0;
  if (deviations.size() < kFewest) return false;
  double together = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    squares += deviations[i].deviation * deviations[i].deviation;
    if (i > 0) together += deviations[i].deviation * deviations[i - 1].deviation;
  }
  const double least = std::max(kMuch, kChance / std::sqrt(static_cast<double>(deviations.size())));
  return together > least * squares;
}

/// By how many times as much as the others one point deviates, in the root of their mean square; none where there are too
/// few others to tell.
std::optional<double> apart_from_others(const std::vector<PointDeviation>& deviations, std::size_t one) {
  constexpr std::size_t kFewest = 12;
  if (deviations.size() < kFewest) return {};
  double squares = 0.0;
  for (std::size_t i = 0; i < deviations.size(); ++i)
    if (i != one) squares += deviations[i].deviation * deviations[i].deviation;
  const double others = std::sqrt(squares / static_cast<double>(deviations.size() - 1));
  const double own = std::fabs(deviations[one].deviation);
  return others > 0.0 ? std::optional(own / others) : std::nullopt;
}

const ProfileFit& checked(const ProfileFit& fit) {
  const bool usable = !fit.max_deviation || (*fit.max_deviation > 0.0 && std::isfinite(*fit.max_deviation));
  if (usable) return fit;
  throw InputError({"", "max_deviation: " + exact_text(*fit.max_deviation) + " m is not positive and finite",
                    "A smooth curve does not go through every measured point.",
                    "the accuracy of the measurement"});
}

}  // namespace

std::string radius_range_text(const CurvatureRange& range) {
  const std::string least = length_text(1.0 / range.greatest, 3);
  return range.least > 0.0 ? least + " to " + length_text(1.0 / range.least, 3) : least + " or more";
}

std::optional<ProfileFault> profile_fault(const std::vector<Vec2>& points) {
  const auto fault = [&](std::size_t index, std::string what, std::string why, std::string hint) {
    return ProfileFault{index, {point_text(points, index), std::move(what), std::move(why), std::move(hint)}};
  };
  if (points.size() < 3) {
    const std::string count = points.empty()       ? "there are no points"
                              : points.size() == 1 ? "there is 1 point"
                                                   : "there are " + std::to_string(points.size()) + " points";
    return ProfileFault{
        {},
        {"points", count, "A curve needs at least 3 points.", "more points; between two, the kind straight"}};
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      return fault(i, "it is not finite", "A profile is made of places.", "");
    }
    if (i > 0 && points[i] == points[i - 1]) {
      return fault(i, "it repeats the point before it",
                   "The direction of the profile is lost between equal points.", "leave one of them out");
    }
  }
  const double long_chord = kLongChord * reach_of(points);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (!turns_back(points[i] - points[i - 1], points[i + 1] - points[i], long_chord)) continue;
    return fault(i, "the profile turns back on itself here",
                 "Points are read in order from start to finish; a track has no spikes.",
                 "the points sorted along the track");
  }
  const std::size_t back = point_running_back(points, reach_of(points));
  if (back < points.size()) {
    return fault(back, "the profile runs back here, behind a point before it",
                 "A track leads from start to finish; it does not overhang.",
                 "the points sorted along the track, or this one left out");
  }
  return {};
}

FittedProfile::FittedProfile(std::vector<Vec2> points, const ProfileFit& fit)
    : FittedProfile(fitted(in_track_frame(std::move(points)), checked(fit))) {
  // What rounding leaves goes on in steps along a straight: a pattern, but none of bends.
  constexpr double kRounded = 0.5;
  constexpr double kNextToNothing = 1e-5;
  const double nothing = std::max(kNextToNothing * rms_bulge_, kRounded * last_place_);
  leaves_pattern_ = !fit.max_deviation && rms_deviation_ > nothing && shows_pattern(deviations_);
  constexpr double kStandsOut = 6.0;  // noise has none of a million points beyond five
  constexpr double kOfBulge = 1e-3;
  if (fit.max_deviation || max_deviation() <= kOfBulge * rms_bulge_) return;
  const std::optional<double> times = apart_from_others(deviations_, farthest_point_);
  if (times && *times > kStandsOut) farthest_stands_out_ = times;
}

FittedProfile::Fitted FittedProfile::fitted(std::vector<Vec2> points, const ProfileFit& fit) {
  FittedCurve found = fit_clothoid_spline(points, fit);
  for (Vec2& point : points) point = point - found.start;
  return {std::move(points), std::move(found.curve), found.between, found.last_place,
          found.largest_curvature};
}

FittedProfile::FittedProfile(Fitted fitted)
    : points_(std::move(fitted.points)),
      curve_(std::move(fitted.curve)),
      deviations_(deviations_from(curve_, points_)),
      between_points_(fitted.between),
      last_place_(fitted.last_place),
      largest_curvature_(fitted.largest_curvature) {
  double sum = 0.0;
  for (std::size_t i = 0; i < deviations_.size(); ++i) {
    const double deviation = deviations_[i].deviation;
    if (std::fabs(deviation) > max_deviation()) farthest_point_ = i;
    sum += deviation * deviation;
  }
  rms_deviation_ = std::sqrt(sum / static_cast<double>(points_.size()));
  double bulge = 0.0;
  const Vec2 chord = points_.back();
  for (const Vec2& point : points_) {
    const double away = (chord.x * point.y - chord.y * point.x) / norm(chord);
    bulge += away * away;
  }
  // A straight has no shape of its own: rounding leaves nothing out of it.
  constexpr double kRounding = 1e-12;
  rms_bulge_ = std::max(std::sqrt(bulge / static_cast<double>(points_.size())), kRounding * norm(chord));
}

bool FittedProfile::leaves_gaps() const noexcept {
  constexpr double kOfBulge = 0.01;
  constexpr double kOfLength = 1e-4;
  return between_points_ > std::max(kOfBulge * rms_bulge_, kOfLength * length());
}

bool FittedProfile::leaves_radius_open() const {
  if (!largest_curvature_) return false;
  double own = 0.0;
  for (const ClothoidSegment& segment : curve_.segments())
    own = std::max({own, std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature)});
  return largest_curvature_->greatest > own / (1.0 - kOpenRadius) ||
         largest_curvature_->least < own / (1.0 + kOpenRadius);
}

}  // namespace glissade
