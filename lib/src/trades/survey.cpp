#include "glissade/trades/survey.hpp"

#include "glissade/centerline/track_from.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/counted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade {
namespace {

constexpr std::size_t kFewestPoints = 5;

void require_options(const SurveyOptions& options) {
  const auto positive = [](double value, const char* name, const std::string& text) {
    if (value > 0.0 && std::isfinite(value)) return;
    throw InputError({name, text + " is not positive and finite", "", ""});
  };
  positive(options.tolerance, "--tolerance", length_text(options.tolerance));
  positive(options.slope_tolerance.radians(), "--slope-tolerance", angle_text(options.slope_tolerance));
  positive(options.largest_gap, "--largest-gap", length_text(options.largest_gap));
  positive(options.reach, "--reach", length_text(options.reach));
}

/// A point in the frame of the place of the profile nearest to it.
struct Foot {
  double arc_length = 0.0;
  double above = 0.0;   ///< square to the profile
  double beyond = 0.0;  ///< along the tangent, beyond an end; 0 between them
};

/// @param why  so few, as a sentence and a space
void require_enough(std::size_t points, const std::string& why) {
  if (points >= kFewestPoints) return;
  throw InputError({"", core::counted(points, "point") + (points == 1 ? " makes" : " make") + " no survey",
                    why + "Slope and radius as built need at least " + std::to_string(kFewestPoints) + ".",
                    "a point every 2 m along the track"});
}

/// Where a message leads to: the line of its file, or the name of a point that comes from none.
std::string place_of(const SurveyPoint& point) {
  return point.source.empty() ? point.name : point.source;
}

/// What a message calls a point whose place it begins with.
std::string called(const SurveyPoint& point) {
  return place_of(point) == point.name ? "the point" : "the point " + point.name;
}

class FootFinder {
 public:
  explicit FootFinder(const Centerline& curve) : curve_(curve) {
    constexpr int kSamples = 2000;
    for (int i = 0; i <= kSamples; ++i)
      samples_.push_back(curve.at(i == kSamples ? curve.length() : curve.length() * i / kSamples));
  }

  [[nodiscard]] Foot of(const SurveyPoint& point) const {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double distance = math::hypot(point.run - samples_[i].x, point.drop - samples_[i].drop);
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    const double from = samples_[nearest == 0 ? 0 : nearest - 1].arc_length;
    const double to = samples_[std::min(nearest + 1, samples_.size() - 1)].arc_length;
    return at(point, bisected(point, from, to));
  }

 private:
  /// How far along the tangent the point lies from the place.
  [[nodiscard]] static double along(const SurveyPoint& point, const CenterlinePoint& place) {
    return (point.run - place.x) * math::cos(place.slope_angle) +
           (point.drop - place.drop) * math::sin(place.slope_angle);
  }

  [[nodiscard]] double bisected(const SurveyPoint& point, double from, double to) const {
    if (along(point, curve_.at(from)) <= 0.0) return from;
    if (along(point, curve_.at(to)) >= 0.0) return to;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (from + to);
      (along(point, curve_.at(middle)) > 0.0 ? from : to) = middle;
    }
    return 0.5 * (from + to);
  }

  [[nodiscard]] Foot at(const SurveyPoint& point, double s) const {
    const CenterlinePoint place = curve_.at(s);
    const double above = (point.run - place.x) * math::sin(place.slope_angle) -
                         (point.drop - place.drop) * math::cos(place.slope_angle);
    const bool at_end = s == 0.0 || s == curve_.length();
    return {s, above, at_end ? along(point, place) : 0.0};
  }

  const Centerline& curve_;
  std::vector<CenterlinePoint> samples_;
};

/// Each point with its foot, by arc length; every one that does not belong to the profile is a problem.
std::vector<std::pair<Foot, SurveyPoint>> footed(const Centerline& design,
                                                 const std::vector<SurveyPoint>& points,
                                                 const SurveyOptions& options) {
  const FootFinder finder(design);
  std::vector<Issue> issues;
  std::vector<std::pair<Foot, SurveyPoint>> feet;
  const std::string hint =
      "points of this track in the design's frame, the height of the prism, or a larger reach";
  for (const SurveyPoint& point : points) {
    const Foot foot = finder.of(point);
    const double off = foot.above - options.height;
    if (std::fabs(foot.beyond) > options.reach) {
      issues.push_back({place_of(point),
                        called(point) + " lies " + length_text(std::fabs(foot.beyond)) +
                            (foot.beyond < 0.0 ? " before the start" : " beyond the end") + " of the track",
                        "Points within " + length_text(options.reach) + " of the profile belong to it.",
                        hint});
    } else if (std::fabs(off) > options.reach || std::fabs(point.aside) > options.reach) {
      const bool beside = std::fabs(off) <= options.reach;
      issues.push_back({place_of(point),
                        called(point) + " lies " + length_text(std::fabs(beside ? point.aside : off)) +
                            (beside      ? " beside"
                             : off > 0.0 ? " above"
                                         : " below") +
                            " the profile, " + length_text(foot.arc_length) + " down the track",
                        "Points within " + length_text(options.reach) + " of the profile belong to it.",
                        hint});
    }
    feet.emplace_back(foot, point);
  }
  if (!issues.empty()) throw InputError(std::move(issues));
  // What lies before the start or beyond the end has its foot there: among them the way along the tangent tells.
  const auto way = [](const Foot& foot) { return foot.arc_length + foot.beyond; };
  std::stable_sort(feet.begin(), feet.end(),
                   [&](const auto& a, const auto& b) { return way(a.first) < way(b.first); });
  return feet;
}

/// The points moved down to the track by the height that they were measured at.
std::vector<Vec2> on_track(const Centerline& design, const std::vector<std::pair<Foot, SurveyPoint>>& feet,
                           double height) {
  std::vector<Vec2> points;
  for (const auto& [foot, point] : feet) {
    const double slope = design.slope_angle(foot.arc_length);
    const Vec2 moved{point.run - height * math::sin(slope), point.drop + height * math::cos(slope)};
    // Two readings of one place are one point to a curve.
    constexpr double kSame = 1e-3;  // [m]
    if (!points.empty() && norm(moved - points.back()) < kSame) continue;
    points.push_back(moved);
  }
  return points;
}

void add_gaps(const Centerline& design, const SurveyOptions& options, Survey& survey) {
  double before = 0.0;
  const auto see = [&](double at) {
    if (at - before > options.largest_gap) survey.gaps.push_back({before, at});
    before = at;
  };
  for (const SurveyedPlace& place : survey.places) see(place.arc_length);
  see(design.length());
}

void add_worst(const SurveyOptions& options, Survey& survey) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < survey.places.size(); ++i) {
    const SurveyedPlace& place = survey.places[i];
    sum += place.deviation;
    squares += place.deviation * place.deviation;
    if (std::fabs(place.deviation) > std::fabs(survey.places[survey.worst].deviation)) survey.worst = i;
    if (abs(place.slope_deviation) > abs(survey.places[survey.worst_slope].slope_deviation)) {
      survey.worst_slope = i;
    }
  }
  const auto count = static_cast<double>(survey.places.size());
  survey.mean_deviation = sum / count;
  survey.rms_deviation = std::sqrt(squares / count);
  survey.within_tolerance = std::fabs(survey.places[survey.worst].deviation) <= options.tolerance;
  survey.slope_within_tolerance =
      abs(survey.places[survey.worst_slope].slope_deviation) <= options.slope_tolerance;
}

}  // namespace

Survey survey_of(const Centerline& design, const std::vector<SurveyPoint>& points,
                 const SurveyOptions& options) {
  require_options(options);
  require_enough(points.size(), "");
  const std::vector<std::pair<Foot, SurveyPoint>> feet = footed(design, points, options);
  std::vector<Vec2> moved = on_track(design, feet, options.height);
  require_enough(moved.size(), "Readings of one place are one point. ");
  const Vec2 first = moved.front();
  Survey survey;
  survey.as_built = std::make_shared<const FittedProfile>(std::move(moved));
  const FootFinder built(*survey.as_built);
  const auto on_built = [&](const CenterlinePoint& designed) {
    return built.of({"", designed.x - first.x, designed.drop - first.y, 0.0}).arc_length;
  };
  if (feet.front().first.beyond < 0.0) survey.before_start = on_built(design.at(0.0));
  if (feet.back().first.beyond > 0.0)
    survey.beyond_end = survey.as_built->length() - on_built(design.at(design.length()));
  for (const auto& [foot, point] : feet) {
    const CenterlinePoint designed = design.at(foot.arc_length);
    const CenterlinePoint as_built = survey.as_built->at(on_built(designed));
    survey.places.push_back({point.name, foot.arc_length, foot.above - options.height, point.aside,
                             Angle::from_radians(as_built.slope_angle),
                             Angle::from_radians(as_built.slope_angle - designed.slope_angle),
                             as_built.curvature, designed.curvature, foot.beyond});
  }
  add_gaps(design, options, survey);
  add_worst(options, survey);
  return survey;
}

namespace {

/// Of a survey that lies before the start or beyond the end of its track, all but a point or so.
void require_ridden(const Survey& survey, double from, double to) {
  const double built = survey.as_built->length() - survey.before_start - survey.beyond_end;
  if (to > from && built > 0.0) return;
  throw InputError(
      {"",
       "the points lie before the start of the track or beyond its end, and none of it between two of them",
       "Both rides are on what lies between the first point and the last.", "points along the track"});
}

}  // namespace

SurveyRides ride_survey(const CenterlinePtr& design, const Survey& survey, const Body& body, double gravity) {
  Motion designed(design, body, gravity);
  // A reading or two of a millimetre: the survey begins at the start.
  constexpr double kAtStart = 1e-3;  // [m]
  const double first = survey.places.front().arc_length;
  const double from = first > kAtStart ? first : 0.0;
  const double to = survey.places.back().arc_length;
  require_ridden(survey, from, to);
  Body entering = body_from(body, from);
  if (from > 0.0) {
    if (designed.distance() < from) {
      throw InfeasibleError({"",
                             "the body does not come to the first point of the survey, " + length_text(from) +
                                 " down the track",
                             "", "less friction, or a survey that begins at the start"});
    }
    // It is on its track by then.
    entering.entry_speed = designed.at(from).speed;
    entering.landing.reset();
    entering.approach.reset();
  }
  Motion there(std::make_shared<const TrackFrom>(design, from, to), entering, gravity);
  const auto ridden = std::make_shared<const TrackFrom>(survey.as_built, survey.before_start,
                                                        survey.as_built->length() - survey.beyond_end);
  Motion as_built(ridden, entering, gravity);
  return {from, to, std::move(designed), std::move(there), std::move(as_built)};
}

}  // namespace glissade
