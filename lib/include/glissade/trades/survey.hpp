#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/units.hpp"
#include "glissade/motion/motion.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// A point that was measured on a track that stands.
struct SurveyPoint {
  std::string name;         ///< its own, or the line of its file
  double run = 0.0;         ///< in the plane of the track, from its start [m]
  double drop = 0.0;        ///< [m], positive down
  double aside = 0.0;       ///< to the left of that plane [m]
  std::string source = {};  ///< "points.csv:7", for messages; empty if it comes from no file
};

/// How a survey is held against its design.
struct SurveyOptions {
  double height = 0.0;       ///< of the points above the track, square to it: prism, guide tube [m]
  double tolerance = 0.010;  ///< of the deviation square to the profile [m]; > 0
  Angle slope_tolerance = Angle::from_degrees(0.1);  ///< of the slope angle; > 0
  double largest_gap = 5.0;                          ///< between neighbours along the track [m]; > 0
  double reach = 1.0;  ///< a point farther from the profile does not belong to it [m]; > 0
};

/// A point against the design, at the place of the profile that is nearest to it.
struct SurveyedPlace {
  std::string name;
  double arc_length = 0.0;  ///< of the design there [m]
  double deviation = 0.0;   ///< square to the profile, above it where positive, the height taken off [m]
  double aside = 0.0;       ///< [m]
  Angle slope_angle;        ///< of the profile as built, by a smooth curve through the points
  Angle slope_deviation;    ///< that less the design's
  double curvature = 0.0;   ///< as built [1/m]
  double designed_curvature = 0.0;  ///< [1/m]
  double beyond =
      0.0;  ///< along the tangent, of a point before the start (negative) or beyond the end, which it is held against [m]
};

/// A stretch without points.
struct SurveyGap {
  double from = 0.0;  ///< [m]
  double to = 0.0;    ///< [m]
};

/// A track as it was surveyed against the one that was designed.
struct Survey {
  std::vector<SurveyedPlace> places;  ///< by arc length
  std::vector<SurveyGap> gaps;        ///< longer than SurveyOptions::largest_gap, ends of the track included
  double mean_deviation = 0.0;        ///< [m]
  double rms_deviation = 0.0;         ///< [m]
  std::size_t worst = 0;              ///< index of the place of the largest deviation, either way
  std::size_t worst_slope = 0;        ///< the same of the slope angle
  bool within_tolerance = true;
  bool slope_within_tolerance = true;
  std::shared_ptr<const FittedProfile> as_built;  ///< from the first point to the last, the height taken off
  /// How much of it lies before the start of the track and beyond its end: nobody rides there [m].
  double before_start = 0.0;
  double beyond_end = 0.0;

  [[nodiscard]] bool sound() const { return within_tolerance && slope_within_tolerance && gaps.empty(); }
};

/// Holds measured points against a design.
/// @param points  in any order; at least 5
/// @throws InputError with every point that does not belong to the profile, by its name, distance and bound; or if there are too
///         few, or an option is out of its range
[[nodiscard]] Survey survey_of(const Centerline& design, const std::vector<SurveyPoint>& points,
                               const SurveyOptions& options = {});

/// One body on the surveyed part of the track as it was built and as it was designed.
struct SurveyRides {
  double from =
      0.0;  ///< arc length of the design at the first point on it [m]; both rides have the designed speed there
  double to = 0.0;        ///< at the last point on it [m]
  Motion designed;        ///< of the whole design
  Motion designed_there;  ///< of the design from `from` to `to`, or as far as the body comes
  Motion as_built;        ///< from `from` to `to`, without what lies before the start or beyond the end
};

/// Rides both. Where the survey begins below the start, the ride as built enters with the designed speed.
/// @throws InputError if the points leave nothing of the track to ride; InfeasibleError if the body does not come to the first one
[[nodiscard]] SurveyRides ride_survey(const CenterlinePtr& design, const Survey& survey, const Body& body,
                                      double gravity = kDefaultGravity);

}  // namespace glissade
