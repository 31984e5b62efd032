// From what a file tells of each segment to what it is on the track: each begins where the one before it ended.

#include "glissade/centerline/drawn_track.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/design.hpp"

#include "design/checks.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <variant>

namespace glissade {
namespace {

using Fault = DrawnSegments::Fault;
using Drawn = std::variant<TrackSegment, Fault>;

constexpr double kRounding = 1e-12;

/// Where a segment begins: (run, drop) from the start of the track, and the slope angle there.
struct Beginning {
  Vec2 place;
  double slope_angle = 0.0;
};

std::string point_text(Vec2 point) {
  return "[" + length_text(point.x) + ", " + length_text(point.y) + "]";
}

std::string radius_text(double curvature) {
  return curvature == 0.0 ? "no curvature" : "radius " + length_text(1.0 / curvature);
}

Fault fault(std::string key, std::string what, std::string why, std::string hint) {
  return {std::move(key), {"", ": " + std::move(what), std::move(why), std::move(hint)}};
}

bool is_bent(const SegmentDesign& segment) {
  return segment.entry_curvature != 0.0 || segment.exit_curvature != 0.0;
}

/// @param turn  by how much it is to turn upwards
std::optional<Fault> fault_of_turn(const SegmentDesign& segment, double slope_angle, double turn) {
  const std::string wanted = angle_text(*segment.to_slope_angle);
  if (std::fabs(turn) <= kRounding) {
    return fault("to_slope_angle",
                 "to_slope_angle: " + wanted + " is the slope angle where the segment begins",
                 "It has nothing to turn by.", "no such segment, or a length in its place");
  }
  const double curvature = segment.entry_curvature + segment.exit_curvature;
  if (curvature * turn >= 0.0) return {};
  const auto [before, after] = texts_apart(Angle::from_radians(slope_angle), *segment.to_slope_angle);
  const double sharper = std::fabs(segment.entry_curvature) > std::fabs(segment.exit_curvature)
                             ? segment.entry_curvature
                             : segment.exit_curvature;
  return fault("to_slope_angle",
               "to_slope_angle: from " + before + " to " + after + " the track bends " +
                   (turn > 0.0 ? "upwards" : "downwards") + ", with " + radius_text(sharper) +
                   " it bends the other way",
               "Positive radius and curvature bend the track upwards, so that its slope angle falls.",
               radius_text(-sharper));
}

Drawn cubic_to_slope(const SegmentDesign& segment, double turn) {
  if (segment.length || (segment.entry_curvature != 0.0) == (segment.exit_curvature != 0.0)) {
    return fault(segment.length ? "length" : "bend",
                 segment.length ? "length: " + length_text(*segment.length) + " of a cubic bend is given"
                                : "bend: a cubic bend is straight at one end and has a radius at the other",
                 "A cubic bend is told by the slope angle to which it leads and the radius at its bent end; "
                 "its length "
                 "follows.",
                 "{bend: cubic, to_slope_angle: 11 deg, exit_radius: 103 m}");
  }
  if (std::fabs(turn) > CubicBend::kMostTurn.radians()) {
    return fault("to_slope_angle",
                 "to_slope_angle: a cubic bend would turn by " +
                     texts_apart(Angle::from_radians(std::fabs(turn)), CubicBend::kMostTurn).first,
                 "It turns by at most " + angle_text(CubicBend::kMostTurn) + ".",
                 "bend: clothoid, or two bends");
  }
  const bool begins_bent = segment.entry_curvature != 0.0;
  const double curvature = begins_bent ? segment.entry_curvature : segment.exit_curvature;
  return TrackSegment(CubicSegment{Angle::from_radians(turn), 1.0 / std::fabs(curvature), begins_bent});
}

Drawn to_slope(const SegmentDesign& segment, double slope_angle) {
  const double turn = slope_angle - segment.to_slope_angle->radians();
  if (auto issue = fault_of_turn(segment, slope_angle, turn)) return *std::move(issue);
  if (segment.bend == SegmentBend::cubic) return cubic_to_slope(segment, turn);
  if (segment.length && is_bent(segment)) {
    return fault("length",
                 "length: " + length_text(*segment.length) + " is given beside a bend and a to_slope_angle",
                 "Two of the three give the third.", "to_slope_angle and length alone, which is an arc");
  }
  if (segment.length) {
    const double curvature = turn / *segment.length;
    return TrackSegment(ClothoidSegment{*segment.length, curvature, curvature});
  }
  const double sum = segment.entry_curvature + segment.exit_curvature;
  const double length = 2.0 * turn / sum;
  if (sum != 0.0 && length <= design_file::kLongestTrack) {
    return TrackSegment(ClothoidSegment{length, segment.entry_curvature, segment.exit_curvature});
  }
  if (!is_bent(segment)) {
    return fault("to_slope_angle",
                 "to_slope_angle: a straight never reaches " + angle_text(*segment.to_slope_angle) +
                     " from " + angle_text(Angle::from_radians(slope_angle)),
                 "A segment turns by its radius, its curvature or its length.",
                 "radius: " + std::string(turn > 0.0 ? "5 m" : "-5 m"));
  }
  return fault("to_slope_angle",
               "to_slope_angle: bent so little, the segment would be " +
                   (sum == 0.0 ? std::string("endless") : length_text(length) + " long"),
               "A segment is at most 1000 km long.", "a smaller radius");
}

Drawn to_point(const SegmentDesign& segment, const Beginning& from, Vec2 end) {
  if (segment.bend == SegmentBend::cubic) {
    return fault("bend", "bend: a cubic bend leads to a slope angle, not to a point", "",
                 "{to_point: [5.4 m, 1.1 m], to_slope_angle: 11 deg}, which is a clothoid");
  }
  if (segment.length || is_bent(segment)) {
    return fault(
        "to_point",
        "to_point: " + std::string(segment.length ? "a length" : "a curvature") + " is given beside it",
        "The arc to a point follows from the point, and so does the clothoid to a point and a slope angle.",
        "to_point alone, or with a to_slope_angle");
  }
  const Vec2 way = end - from.place;
  const std::string point = point_text(*segment.to_point);
  const std::string begins = "The segment begins " + length_text(from.place.x) + " away from the start and " +
                             length_text(from.place.y) + " below it, with slope angle " +
                             angle_text(Angle::from_radians(from.slope_angle)) + ".";
  constexpr double kShortest = 1e-6;
  if (!(math::hypot(way.x, way.y) >= kShortest)) {
    return fault("to_point", "to_point: " + point + " is where the segment begins", begins,
                 "a point farther on");
  }
  if (!(math::hypot(way.x, way.y) <= design_file::kLongestTrack)) {
    return fault("to_point", "to_point: " + point + " is too far away", "A segment is at most 1000 km long.",
                 "");
  }
  const Angle entry = Angle::from_radians(from.slope_angle);
  const std::string name = segment.to_slope_angle ? "clothoid" : "arc";
  const std::optional<ClothoidSegment> bend =
      segment.to_slope_angle ? clothoid_to(way, entry, *segment.to_slope_angle) : arc_to(way, entry);
  const double ends =
      bend ? from.slope_angle - 0.5 * bend->length * (bend->entry_curvature + bend->exit_curvature) : 0.0;
  if (bend && std::fabs(ends) <= kRightAngle + kRounding) return TrackSegment(*bend);
  return fault(
      "to_point",
      "to_point: no " + name + " leads to " + point +
          (bend ? " but one that ends at a slope angle of " + angle_text(Angle::from_radians(ends)) : ""),
      begins + " A slope angle lies between -90 and 90 deg.",
      segment.to_slope_angle ? "another point, or another slope angle there"
                             : "a point nearer to the straight ahead, or a to_slope_angle beside it");
}

Drawn drawn(const SegmentDesign& segment, const Beginning& from, const TrackDesign& track) {
  if (segment.to_point) return to_point(segment, from, in_track_plane(track, *segment.to_point));
  if (segment.to_slope_angle) return to_slope(segment, from.slope_angle);
  if (segment.bend == SegmentBend::cubic) {
    return fault("bend", "bend: a cubic bend has no to_slope_angle",
                 "It is told by the slope angle to which it leads and the radius at its bent end.",
                 "{bend: cubic, to_slope_angle: 11 deg, exit_radius: 103 m}");
  }
  if (!segment.length) {
    return fault("", "neither length, to_slope_angle nor to_point is given",
                 "A segment is as long as it is told to be, or leads somewhere.", "length: 2 m");
  }
  return TrackSegment(ClothoidSegment{*segment.length, segment.entry_curvature, segment.exit_curvature});
}

/// By how much a segment turns the track downwards.
double slope_change(const TrackSegment& segment) {
  if (const auto* const cubic = std::get_if<CubicSegment>(&segment)) return -cubic->turn.radians();
  const auto& clothoid = std::get<ClothoidSegment>(segment);
  return -0.5 * (clothoid.entry_curvature + clothoid.exit_curvature) * clothoid.length;
}

/// Greatest departure from the level within the segment, with its sign: at an end, or where curvature is 0.
double steepest_slope(const TrackSegment& segment, double entry_slope) {
  double steepest = entry_slope;
  const auto compare = [&](double slope) {
    if (std::fabs(slope) > std::fabs(steepest)) steepest = slope;
  };
  compare(entry_slope + slope_change(segment));
  const auto* const clothoid = std::get_if<ClothoidSegment>(&segment);
  if (clothoid == nullptr) return steepest;
  const double turn = clothoid->entry_curvature - clothoid->exit_curvature;
  const double share = turn == 0.0 ? 0.0 : clothoid->entry_curvature / turn;
  const double straight_at = share * clothoid->length;
  if (share > 0.0 && share < 1.0) compare(entry_slope - 0.5 * straight_at * clothoid->entry_curvature);
  return steepest;
}

std::optional<Fault> fault_of_overhang(const SegmentDesign& design, const TrackSegment& segment,
                                       double entry_slope) {
  const double steepest = steepest_slope(segment, entry_slope);
  if (std::fabs(steepest) <= kRightAngle + kRounding) return {};
  return Fault{"",
               {"", " overhangs: its slope angle reaches " + angle_text(Angle::from_radians(steepest)),
                "A slope angle lies between -90 deg (straight up) and 90 deg (straight down); a positive "
                "curvature or radius turns the track upwards.",
                design.to_point ? "another point, or another slope angle there"
                                : "a shorter segment, a larger radius, or the other sign"}};
}

/// Where the next segment begins.
Beginning after(const Beginning& from, const TrackSegment& segment) {
  const CenterlinePtr piece = joined(Angle::from_radians(from.slope_angle), {segment});
  const CenterlinePoint end = piece->at(piece->length());
  return {from.place + Vec2{end.x, end.drop}, end.slope_angle};
}

}  // namespace

DrawnSegments drawn_segments(const TrackDesign& track, const CenterlineDesign& centerline) {
  DrawnSegments result;
  Beginning from{{}, centerline.entry_slope_angle.radians()};
  for (const SegmentDesign& segment : centerline.segments) {
    Drawn next = drawn(segment, from, track);
    if (const auto* const found = std::get_if<TrackSegment>(&next)) {
      if (auto overhang = fault_of_overhang(segment, *found, from.slope_angle)) next = *std::move(overhang);
    }
    if (auto* const issue = std::get_if<Fault>(&next)) {
      result.fault = std::move(*issue);
      result.fault->issue.what =
          "segments[" + std::to_string(result.segments.size()) + "]" + result.fault->issue.what;
      return result;
    }
    result.segments.push_back(std::get<TrackSegment>(next));
    from = after(from, result.segments.back());
    // What comes after a slope angle that is given begins with it, to the last digit.
    if (segment.to_slope_angle) from.slope_angle = segment.to_slope_angle->radians();
  }
  return result;
}

}  // namespace glissade
