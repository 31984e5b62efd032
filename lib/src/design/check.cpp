#include "design/check.hpp"

#include "glissade/core/number_text.hpp"

#include "design/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

constexpr double kFarthestCoordinate =
    1e7;                                 // [m]; beyond, a double no longer holds a tenth of a micrometre well
constexpr double kShortestTrack = 1e-4;  // [m]
constexpr double kLongestTrack = 1e6;    // [m]
constexpr double kLargestMeasure = 1e4;  // [m], of a cross-section
constexpr double kSmallestMeasure = 1e-6;  // [m]
constexpr double kHighestSpeed = 1e4;      // [m/s]
constexpr double kQuarterTurn = std::numbers::pi / 2.0;

using Collected = std::vector<Finding>;

void report(Collected& findings, std::vector<std::string> key_paths, Issue issue) {
  findings.push_back({std::move(key_paths), std::move(issue)});
}

std::string metres(double value) {
  return rounded_text(value, 4) + " m";
}

// --- track ---------------------------------------------------------------------------------------------

void check_coordinates(const Vec3& position, const std::string& key_path, Collected& findings) {
  const std::array<std::pair<const char*, double>, 3> coordinates = {
      {{"x", position.x}, {"y", position.y}, {"z", position.z}}};
  for (const auto& [name, value] : coordinates) {
    if (std::fabs(value) <= kFarthestCoordinate) continue;
    report(findings, {key_path + "." + name},
           {"", std::string(name) + ": " + metres(value) + " is too far from the origin",
            "Coordinates lie within 10000 km of the origin.", "a local origin"});
  }
}

double run_of(const TrackDesign& track) {
  return std::hypot(track.finish.x - track.start.x, track.finish.y - track.start.y);
}

double drop_of(const TrackDesign& track) {
  return track.start.z - track.finish.z;
}

std::string drop_over_run(const TrackDesign& track) {
  return "drop " + metres(drop_of(track)) + " over " + metres(run_of(track));
}

/// Whether a track of this kind is drawn by the design, and not found by Glissade.
bool is_given(CenterlineKind kind) {
  return kind == CenterlineKind::segments || kind == CenterlineKind::points;
}

bool may_climb(const Design& design) {
  if (is_given(design.centerline.kind)) return true;
  // Only a search takes account of the entry speed; the closed form of the fastest track starts from rest.
  const bool searched = design.centerline.kind == CenterlineKind::fastest &&
                        (design.limits || design.track.free_finish != FreeFinish::none);
  return (searched || design.centerline.kind == CenterlineKind::straight) && design.body.entry_speed > 0.0;
}

void check_drop(const Design& design, Collected& findings) {
  const double drop = drop_of(design.track);
  if (drop > 0.0) return;
  const std::vector<std::string> paths = {"track.finish.z", "track.start.z",    "track.finish",
                                          "track.start",    "body.entry_speed", "centerline"};
  const std::string place = drop < 0.0 ? metres(-drop) + " above the start" : "level with the start";
  if (!may_climb(design) && design.body.entry_speed > 0.0) {
    report(
        findings, paths,
        {"", "the finish lies " + place,
         "The kind " + std::string(word(design.centerline.kind)) +
             " is made for a start from rest: it must go down.",
         "limits: {} with the kind fastest, which searches the one for this entry_speed, or kind: straight"});
    return;
  }
  if (!may_climb(design)) {
    report(findings, paths,
           {"", "the finish lies " + place, "Nothing but gravity drives the body: it must go down.",
            "a finish.z below " + metres(design.track.start.z) + "; z counts upwards"});
    return;
  }
  const double climb = design.body.entry_speed * design.body.entry_speed / (2.0 * design.gravity);
  if (-drop < climb) return;
  report(findings, paths,
         {"", "the finish lies " + place + ", higher than the entry speed can carry the body",
          "An entry_speed of " + rounded_text(design.body.entry_speed, 4) + " m/s is worth a climb of " +
              metres(climb) + " without friction.",
          "a lower finish.z or a higher entry_speed"});
}

void check_free_finish(const Design& design, Collected& findings) {
  const TrackDesign& track = design.track;
  const LimitRange& range = track.free_range;
  const std::string key = track.free_finish == FreeFinish::run ? "x" : "z";
  if (design.centerline.kind != CenterlineKind::fastest) {
    report(findings, {"track.finish", "centerline.kind"},
           {"", "a free " + key + " of the finish needs the kind fastest",
            "It is the fastest track that chooses.", "kind: fastest, or a finish with a value for " + key});
  }
  if (range.lowest && range.highest && *range.lowest > *range.highest) {
    report(findings, {"track.finish." + key},
           {"", key + ": lowest " + metres(*range.lowest) + " is above highest " + metres(*range.highest),
            "Nothing lies between them.", "the two the other way round"});
  }
  const bool aside = track.start.y == track.finish.y;
  if (track.free_finish == FreeFinish::run && !aside) {
    report(findings, {"track.finish.y", "track.start"},
           {"", "y: a finish with a free x lies straight along x from the start", "", "the y of the start"});
  }
  if (track.free_finish == FreeFinish::height && track.start.x == track.finish.x && aside) {
    report(findings, {"track.finish", "track.start"},
           {"", "the finish lies on the vertical through the start",
            "With a free height the track could end where it begins.", "a finish to the side"});
  }
  if (range.lowest) check_coordinates({*range.lowest, 0.0, 0.0}, "track.finish." + key, findings);
  if (range.highest) check_coordinates({*range.highest, 0.0, 0.0}, "track.finish." + key, findings);
}

void check_track(const Design& design, Collected& findings) {
  const TrackDesign& track = design.track;
  check_coordinates(track.start, "track.start", findings);
  check_coordinates(track.finish, "track.finish", findings);
  if (!track.finish_given) return;
  if (track.free_finish != FreeFinish::none) check_free_finish(design, findings);
  const std::vector<std::string> paths = {"track.finish", "track.start"};
  const double distance = norm(track.finish - track.start);
  if (distance == 0.0) {
    report(findings, paths, {"", "start and finish are the same point", "A track leads somewhere.", ""});
    return;
  }
  if (distance < kShortestTrack || distance > kLongestTrack) {
    report(findings, paths,
           {"", "start and finish are " + length_text(distance) + " apart",
            "A track is between 0.1 mm and 1000 km long.", "the units of start and finish"});
    return;
  }
  check_drop(design, findings);
}

// --- body, gravity -------------------------------------------------------------------------------------

std::string friction_key(const Design& design) {
  return design.locations.contains("body.friction_coefficient") ? "friction_coefficient" : "friction_angle";
}

void check_friction_range(const Design& design, Collected& findings) {
  const BodyDesign& body = design.body;
  const std::string key = friction_key(design);
  const double low = body.low_friction.value_or(body.friction).coefficient();
  const double high = body.high_friction.value_or(body.friction).coefficient();
  const double nominal = body.friction.coefficient();
  if (low > nominal || nominal > high) {
    report(findings, {"body." + key},
           {"", key + ": low, nominal and high are not in ascending order",
            "They are " + angle_text(std::atan(low)) + ", " + angle_text(std::atan(nominal)) + " and " +
                angle_text(std::atan(high)) + ".",
            ""});
  }
  if ((body.low_friction || body.high_friction) && !design.limits) {
    report(findings, {"body." + key, "limits"},
           {"", key + ": a range without limits to keep over it",
            "The low and the high value count for limits only.",
            "the nominal value alone, or limits: with what is to hold at every friction"});
  }
}

void check_body(const Design& design, Collected& findings) {
  check_friction_range(design, findings);
  const BodyDesign& body = design.body;
  if (!(body.entry_speed >= 0.0 && body.entry_speed <= kHighestSpeed)) {
    report(findings, {"body.entry_speed"},
           {"", "entry_speed: " + rounded_text(body.entry_speed, 4) + " m/s is out of range",
            "It lies between 0 and 10000 m/s.", "0 m/s, or no entry_speed, for a start from rest"});
  }
  if (!(body.drag_per_metre >= 0.0 && std::isfinite(body.drag_per_metre))) {
    report(findings, {"body.drag"},
           {"", "drag: " + rounded_text(body.drag_per_metre, 4) + " 1/m is negative",
            "Drag slows the body down.", "air density x drag coefficient x frontal area / (2 x mass)"});
  }
  if (!(design.gravity > 0.0 && design.gravity <= 1e4)) {
    report(findings, {"gravity"},
           {"", "gravity: " + rounded_text(design.gravity, 4) + " m/s^2 is out of range",
            "It is positive, and at most 10000 m/s^2.", "9.81 m/s^2"});
  }
}

// --- centerline ----------------------------------------------------------------------------------------

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
  if (std::fabs(slope) > kQuarterTurn + kRounding) {
    report(findings, {"centerline.entry_slope_angle"},
           {"", "entry_slope_angle: " + angle_text(slope) + " overhangs",
            "A slope angle lies between -90 deg (straight up) and 90 deg (straight down).", ""});
    return;
  }
  for (std::size_t index = 0; index < centerline.segments.size(); ++index) {
    const SegmentDesign& segment = centerline.segments[index];
    const double steepest = steepest_slope(segment, slope);
    if (!(std::fabs(steepest) <= kQuarterTurn + kRounding)) {
      report(findings, {"centerline.segments." + std::to_string(index), "centerline"},
             {"",
              "segments[" + std::to_string(index) + "] overhangs: its slope angle reaches " +
                  angle_text(steepest),
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

void check_centerline(const Design& design, Collected& findings) {
  const CenterlineDesign& centerline = design.centerline;
  if (centerline.kind == CenterlineKind::segments) check_segments(design, findings);
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
  if (centerline.constant_speed_p && !(*centerline.constant_speed_p > 0.0)) {
    report(findings, {"centerline.p"},
           {"", "p: " + rounded_text(*centerline.constant_speed_p, 4) + " m^2/s^2 is not positive",
            "It is the square of the speed that the track keeps.", "no p: the fastest one is then found"});
  }
}

// --- cross-section -------------------------------------------------------------------------------------

bool is_measure(double value) {
  return value >= kSmallestMeasure && value <= kLargestMeasure;
}

void check_measure(double value, const std::string& key, Collected& findings) {
  if (is_measure(value)) return;
  const std::string fault = value > 0.0 ? "out of range" : "not positive";
  report(findings, {"cross_section." + key},
         {"", key + ": " + length_text(value) + " is " + fault, "It lies between 0.001 mm and 10 km.", ""});
}

void check_optional_measure(double value, const std::string& key, Collected& findings) {
  if (value != 0.0) check_measure(value, key, findings);
}

void check_thickness(const CrossSectionDesign& section, const std::string& width_key, Collected& findings) {
  check_measure(section.thickness, "thickness", findings);
  if (!is_measure(section.width) || section.thickness <= section.width) return;
  report(findings, {"cross_section.thickness", "cross_section." + width_key},
         {"",
          "thickness: " + length_text(section.thickness) + " is wider than the channel, " +
              length_text(section.width),
          "A plate is thinner than the " + width_key + " that it encloses.", "the units of both"});
}

void check_curbs(const CrossSectionDesign& section, Collected& findings) {
  check_optional_measure(section.curb_height, "curb_height", findings);
  check_optional_measure(section.curb_width, "curb_width", findings);
  if ((section.curb_height > 0.0) != (section.curb_width > 0.0)) {
    const bool high = section.curb_height > 0.0;
    report(findings, {high ? "cross_section.curb_height" : "cross_section.curb_width"},
           {"", std::string(high ? "curb_height" : "curb_width") + " stands alone",
            "A curb has both a curb_height and a curb_width.", "both, or none"});
  }
  if (2.0 * section.curb_width < section.width || !is_measure(section.width)) return;
  report(findings, {"cross_section.curb_width", "cross_section.width"},
         {"",
          "curb_width: two curbs of " + length_text(section.curb_width) + " leave no floor in a width of " +
              length_text(section.width),
          "The curbs stand within the width.", "a curb_width below " + length_text(section.width / 2.0)});
}

void check_wall_angle(const CrossSectionDesign& section, Collected& findings) {
  constexpr double kSteepestLean = 80.0 / 180.0 * std::numbers::pi;
  const double angle = section.wall_angle.radians();
  if (angle >= 0.0 && angle <= kSteepestLean) return;
  report(findings, {"cross_section.wall_angle"},
         {"", "wall_angle: " + angle_text(angle) + " is out of range",
          "Walls lean outward by 0 to 80 deg from upright.", "20 deg"});
}

void check_outline(const std::vector<Vec2>& outline, Collected& findings) {
  std::optional<Issue> fault = outline_fault(outline, "outline");
  if (!fault && !touches_outline(outline, {0.0, 0.0})) {
    fault = Issue{"", "outline: does not pass through [0 mm, 0 mm]",
                  "That point is the centerline, on the floor's surface.",
                  "[0 mm, 0 mm] as a corner in the middle of the floor"};
  }
  if (fault) report(findings, {"cross_section.outline"}, *std::move(fault));
}

void check_cross_section(const Design& design, Collected& findings) {
  if (!design.cross_section) return;
  const CrossSectionDesign& section = *design.cross_section;
  if (section.kind == CrossSectionKind::polygon) {
    check_outline(section.outline, findings);
    return;
  }
  const std::string width_key = section.kind == CrossSectionKind::pipe ? "inner_diameter" : "width";
  check_measure(section.width, width_key, findings);
  check_thickness(section, width_key, findings);
  if (section.kind == CrossSectionKind::slab) check_curbs(section, findings);
  if (section.kind == CrossSectionKind::half_pipe) {
    check_optional_measure(section.wall_height, "wall_height", findings);
  }
  const bool walled =
      section.kind == CrossSectionKind::u_channel || section.kind == CrossSectionKind::trapezoid;
  if (walled) check_measure(section.wall_height, "wall_height", findings);
  if (section.kind == CrossSectionKind::trapezoid) check_wall_angle(section, findings);
}

// --- mesh, export --------------------------------------------------------------------------------------

double least_perimeter(const CrossSectionDesign& section) {
  if (section.kind != CrossSectionKind::polygon) return 2.0 * (section.width + section.wall_height);
  double left = 0.0;
  double right = 0.0;
  for (const Vec2& corner : section.outline) {
    left = std::min(left, corner.x);
    right = std::max(right, corner.x);
  }
  return 2.0 * (right - left);
}

/// A lower bound of the number of near-isotropic facets that a curved track needs: an edge of length h
/// departs by h^2 kappa / 8 from an arc of curvature kappa, so facets of that size number 2 S P / h^2 = phi P
/// / (4 e) on a track that turns by phi = kappa S under a section of perimeter P. Every curved kind turns by
/// more than 0.25.
double least_triangles(const Design& design) {
  constexpr double kLeastTurn = 0.25;
  return kLeastTurn * least_perimeter(*design.cross_section) / (4.0 * design.mesh.tolerance);
}

void check_mesh_size(const Design& design, Collected& findings) {
  constexpr double kMostTriangles = 1e8;
  constexpr double kBytesPerTriangle = 60.0;  // facet, half of a vertex, and what checking them takes
  const bool curved = !is_given(design.centerline.kind) && design.centerline.kind != CenterlineKind::straight;
  if (!design.cross_section || !curved) return;
  const double triangles = least_triangles(design);
  if (!(triangles > kMostTriangles)) return;
  const double smallest = design.mesh.tolerance * triangles / kMostTriangles;
  report(findings, {"mesh.tolerance", "cross_section", "centerline"},
         {"",
          "tolerance: " + rounded_text(design.mesh.tolerance * 1e3, 4) + " mm needs more than " +
              rounded_text(triangles, 2) + " triangles, some " +
              rounded_text(triangles * kBytesPerTriangle * 1e-9, 2) + " GB",
          "Such a mesh does not fit in memory.",
          "a tolerance above " + rounded_text(smallest * 1e3, 2) + " mm; 0.5 mm suits most workshops"});
}

void check_mesh(const Design& design, Collected& findings) {
  const double tolerance = design.mesh.tolerance;
  if (!(tolerance > 0.0 && std::isfinite(tolerance))) {
    report(findings, {"mesh.tolerance"},
           {"", "tolerance: " + rounded_text(tolerance * 1e3, 4) + " mm is not positive",
            "It is how far the mesh may depart from the exact shape.", "0.5 mm"});
    return;
  }
  const double distance = norm(design.track.finish - design.track.start);
  if (distance > 0.0 && tolerance > distance) {
    report(
        findings, {"mesh.tolerance", "track"},
        {"", "tolerance: " + length_text(tolerance) + " is larger than the track, " + length_text(distance),
         "It is how far the mesh may depart from the exact shape.", "0.5 mm"});
  }
  check_mesh_size(design, findings);
}

void check_export(const Design& design, Collected& findings) {
  const std::vector<ExportFormat>& formats = design.exports.formats;
  const bool listed = !formats.empty();
  if (!listed) {
    report(findings, {"export"},
           {"", "export: no format is named", "A build writes at least one file.", "[stl, off, scad]"});
  }
  for (std::size_t index = 1; index < formats.size(); ++index) {
    const auto here = formats.begin() + static_cast<std::ptrdiff_t>(index);
    if (std::find(formats.begin(), here, *here) == here) continue;
    report(findings, {"export"},
           {"", "export: " + std::string(word(*here)) + " is named twice", "", "each format once"});
  }
}

}  // namespace

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
        end = end + (weight * half) * Vec2{std::cos(zeta), -std::sin(zeta)};
      }
    }
    slope += slope_change(segment);
  }
  return end;
}

std::vector<Finding> check_values(const Design& design) {
  Collected findings;
  check_track(design, findings);
  check_body(design, findings);
  check_centerline(design, findings);
  check_cross_section(design, findings);
  check_mesh(design, findings);
  check_export(design, findings);
  for (Finding& finding : check_limits(design)) findings.push_back(std::move(finding));
  return findings;
}

namespace {

/// Whether a free finish can come as near to the start's vertical, or as deep, as reach may need.
bool finish_is_unbounded(const TrackDesign& track) {
  if (track.free_finish == FreeFinish::height) return !track.free_range.lowest;
  if (track.free_finish != FreeFinish::run) return false;
  const bool to_the_right = track.free_range.lowest && *track.free_range.lowest > track.start.x;
  const bool to_the_left = track.free_range.highest && *track.free_range.highest < track.start.x;
  return !to_the_right && !to_the_left;
}

}  // namespace

std::optional<Finding> find_unreachable(const Design& design) {
  const TrackDesign& track = design.track;
  const double run = run_of(track);
  const double drop = drop_of(track);
  const double mu = design.body.high_friction.value_or(design.body.friction).coefficient();
  if (finish_is_unbounded(track)) return {};
  if (is_given(design.centerline.kind) || design.body.entry_speed > 0.0 || !(drop > 0.0)) return {};
  if (drop > mu * run) return {};

  // Hints are rounded to the side on which they hold.
  constexpr double kBelow = 1.0 - 1e-3;
  constexpr double kAbove = 1.0 + 1e-3;
  const std::string key = friction_key(design);
  const bool by_coefficient = key == "friction_coefficient";
  const double mean_slope = std::atan2(drop, run);
  const std::string value = by_coefficient ? rounded_text(mu, 4) + " (" + angle_text(std::atan(mu)) + ")"
                                           : angle_text(std::atan(mu));
  const std::string better =
      by_coefficient ? rounded_text(kBelow * drop / run, 4) : angle_text(kBelow * mean_slope);
  Issue issue;
  issue.what = key + ": " + value + " is steeper than the mean slope from start to finish, " +
               angle_text(mean_slope) + " (" + drop_over_run(track) + ")";
  issue.why =
      "From rest, no track between these points reaches the finish, whatever its shape (docs/theory.md, "
      "reach theorem).";
  issue.hint = "a " + key + " of at most " + better + ", a drop of at least " + metres(kAbove * mu * run) +
               ", or an entry_speed";
  return Finding{{"body." + key, "body", "track", "centerline.kind"}, std::move(issue)};
}

}  // namespace glissade::design_file
