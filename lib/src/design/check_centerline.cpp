#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"

#include "design/check.hpp"
#include "design/checks.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

std::string overhanging(Angle slope) {
  return quantity_beyond(slope.radians(), Dimension::angle, {-kRightAngle, kRightAngle});
}

void check_segment(const SegmentDesign& segment, const std::string& key_path, Collected& findings) {
  if (segment.length && !(*segment.length > 0.0 && *segment.length <= kLongestTrack)) {
    report(findings, {key_path + ".length"},
           out_of_range("length", *segment.length, Dimension::length, {0.0, kLongestTrack},
                        "A segment is longer than 0 mm and at most 1000 km.", ""));
  }
  if (!std::isfinite(segment.entry_curvature) || !std::isfinite(segment.exit_curvature)) {
    report(findings, {key_path}, {"", "the curvature is not finite", "", "a radius above 0 m"});
  }
  const double leads_to = segment.to_slope_angle.value_or(Angle()).radians();
  if (!(std::fabs(leads_to) <= kRightAngle)) {
    report(findings, {key_path + ".to_slope_angle"},
           {"", "to_slope_angle: " + overhanging(*segment.to_slope_angle) + " overhangs",
            "A slope angle lies between -90 deg (straight up) and 90 deg (straight down).", "35 deg"});
  }
}

bool check_entry(const CenterlineDesign& centerline, Collected& findings) {
  const double slope = centerline.entry_slope_angle.radians();
  constexpr double kRounding = 1e-12;
  if (std::fabs(slope) <= kRightAngle + kRounding) return true;
  report(findings, {"centerline.entry_slope_angle"},
         {"", "entry_slope_angle: " + overhanging(centerline.entry_slope_angle) + " overhangs",
          "A slope angle lies between -90 deg (straight up) and 90 deg (straight down).", "35 deg"});
  return false;
}

void check_segments_finish(const Design& design, Collected& findings) {
  const Endpoints end = end_of_segments(design);
  const auto issue = missed_finish(design.track, "the segments", {end.run, end.drop});
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
  if (findings.size() != before || !check_entry(centerline, findings)) return;
  DrawnSegments drawn = drawn_segments(design.track, centerline);
  if (drawn.fault) {
    const std::string path = "centerline.segments." + std::to_string(drawn.segments.size());
    const std::string& key = drawn.fault->key;
    report(findings, {key.empty() ? path : path + "." + key, "track.start", "centerline"},
           std::move(drawn.fault->issue));
  } else if (design.track.finish_given) {
    check_segments_finish(design, findings);
  } else {
    const Endpoints end = end_of_segments(design);
    if (auto issue = ends_fault("the segments", math::hypot(end.run, end.drop)))
      report(findings, {"centerline.segments"}, *std::move(issue));
  }
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

Endpoints end_of_segments(const Design& design) {
  const DrawnSegments drawn = drawn_segments(design.track, design.centerline);
  return joined(design.centerline.entry_slope_angle, drawn.segments)->endpoints();
}

}  // namespace glissade::design_file
