#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "design/check.hpp"
#include "design/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

void check_segment(const SegmentDesign& segment, const std::string& key_path, Collected& findings) {
  if (!(segment.length > 0.0 && segment.length <= kLongestTrack)) {
    report(findings, {key_path + ".length"},
           {"", "length: " + length_text(segment.length) + " is out of range",
            "A segment is longer than 0 and at most 1000 km.", ""});
  }
  if (!std::isfinite(segment.entry_curvature) || !std::isfinite(segment.exit_curvature)) {
    report(findings, {key_path}, {"", "the curvature is not finite", "", ""});
  }
}

double slope_change(const SegmentDesign& segment) {
  return -0.5 * (segment.entry_curvature + segment.exit_curvature) * segment.length;
}

double slope_at(const SegmentDesign& segment, double entry_slope, double s) {
  const double rate = (segment.exit_curvature - segment.entry_curvature) / segment.length;
  return entry_slope - s * (segment.entry_curvature + 0.5 * rate * s);
}

/// Greatest departure from the level within the segment, with its sign: at an end, or where curvature is 0.
double steepest_slope(const SegmentDesign& segment, double entry_slope) {
  double steepest = entry_slope;
  const auto compare = [&](double slope) {
    if (std::fabs(slope) > std::fabs(steepest)) steepest = slope;
  };
  compare(entry_slope + slope_change(segment));
  const double turn = segment.entry_curvature - segment.exit_curvature;
  const double fraction = turn == 0.0 ? 0.0 : segment.entry_curvature / turn;
  if (fraction > 0.0 && fraction < 1.0) compare(slope_at(segment, entry_slope, fraction * segment.length));
  return steepest;
}

void check_overhang(const CenterlineDesign& centerline, Collected& findings) {
  constexpr double kRounding = 1e-12;
  double slope = centerline.entry_slope_angle.radians();
  if (std::fabs(slope) > kRightAngle + kRounding) {
    report(findings, {"centerline.entry_slope_angle"},
           {"", "entry_slope_angle: " + angle_text(Angle::from_radians(slope)) + " overhangs",
            "A slope angle lies between -90 deg (straight up) and 90 deg (straight down).", ""});
    return;
  }
  for (std::size_t index = 0; index < centerline.segments.size(); ++index) {
    const SegmentDesign& segment = centerline.segments[index];
    const double steepest = steepest_slope(segment, slope);
    if (!(std::fabs(steepest) <= kRightAngle + kRounding)) {
      report(findings, {"centerline.segments." + std::to_string(index), "centerline"},
             {"",
              "segments[" + std::to_string(index) + "] overhangs: its slope angle reaches " +
                  angle_text(Angle::from_radians(steepest)),
              "A slope angle lies between -90 deg (straight up) and 90 deg (straight down); a positive "
              "curvature or radius turns the track upwards.",
              "a shorter segment, a larger radius, or the other sign"});
      return;
    }
    slope += slope_change(segment);
  }
}

void check_segments_finish(const Design& design, Collected& findings) {
  const Vec2 end = end_of_segments(design.centerline);
  const auto issue = missed_finish(design.track, "the segments", {end.x, -end.y});
  if (issue) report(findings, {"track.finish", "track.start", "centerline"}, *issue);
}

void check_segments(const Design& design, Collected& findings) {
  const CenterlineDesign& centerline = design.centerline;
  if (centerline.segments.empty()) {
    report(findings, {"centerline.segments"},
           {"", "segments: the list is empty", "A track has at least one segment.", "[{length: 2 m}]"});
    return;
  }
  const std::size_t before = findings.size();
  for (std::size_t index = 0; index < centerline.segments.size(); ++index) {
    check_segment(centerline.segments[index], "centerline.segments." + std::to_string(index), findings);
  }
  if (findings.size() != before) return;
  check_overhang(centerline, findings);
  if (findings.size() == before && design.track.finish_given) check_segments_finish(design, findings);
}

}  // namespace

void check_centerline(const Design& design, Collected& findings) {
  const CenterlineDesign& centerline = design.centerline;
  if (centerline.kind == CenterlineKind::segments) check_segments(design, findings);
  if (centerline.kind == CenterlineKind::in_run) check_in_run(design, findings);
  if (centerline.kind == CenterlineKind::points && centerline.points_file.empty()) {
    report(
        findings, {"centerline.file"},
        {"", "file: no CSV file is named", "The kind points reads a measured profile.", "file: profile.csv"});
  }
  const auto& max_deviation = centerline.points_max_deviation;
  if (max_deviation && !(*max_deviation > 0.0 && std::isfinite(*max_deviation))) {
    report(findings, {"centerline.max_deviation"},
           {"", "max_deviation: " + length_text(*max_deviation) + " is not positive",
            "A smooth curve does not go through every measured point.",
            "the accuracy of the measurement, or no max_deviation: the points then show it"});
  }
  if (max_deviation && !centerline.points_curvature_column.empty()) {
    report(findings, {"centerline.max_deviation"},
           {"", "max_deviation: nothing is fitted to points whose slope angles and curvatures are given",
            "They are taken as they are.", "no max_deviation, or columns: [x, z]"});
  }
  if (centerline.constant_speed_p && !(*centerline.constant_speed_p > 0.0)) {
    report(findings, {"centerline.p"},
           {"", "p: " + rounded_text(*centerline.constant_speed_p, 4) + " m^2/s^2 is not positive",
            "It is the square of the speed that the track keeps.", "no p: the fastest one is then found"});
  }
}

Vec2 end_of_segments(const CenterlineDesign& centerline) {
  // Gauss-Legendre, 4 points, on pieces that turn by at most 0.1 rad: exact to rounding.
  constexpr std::array<std::pair<double, double>, 4> kRule = {
      {{-0.86113631159405257522, 0.34785484513745385737},
       {-0.33998104358485626480, 0.65214515486254614263},
       {0.33998104358485626480, 0.65214515486254614263},
       {0.86113631159405257522, 0.34785484513745385737}}};
  constexpr double kLargestTurn = 0.1;
  constexpr double kMostPieces = 1000.0;
  Vec2 end;
  double slope = centerline.entry_slope_angle.radians();
  for (const SegmentDesign& segment : centerline.segments) {
    const double turn =
        std::max(std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature)) * segment.length;
    const int pieces = static_cast<int>(std::clamp(std::ceil(turn / kLargestTurn), 1.0, kMostPieces));
    const double half = 0.5 * segment.length / pieces;
    for (int piece = 0; piece < pieces; ++piece) {
      for (const auto& [node, weight] : kRule) {
        const double zeta = slope_at(segment, slope, half * (2.0 * piece + 1.0 + node));
        end = end + (weight * half) * Vec2{math::cos(zeta), -math::sin(zeta)};
      }
    }
    slope += slope_change(segment);
  }
  return end;
}

}  // namespace glissade::design_file
