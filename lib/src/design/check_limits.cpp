#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "design/checks.hpp"
#include "design/outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

using ValueText = std::string (*)(double);

std::string angle_of(double radians) {
  return angle_text(radians);
}
std::string length_of(double metres) {
  return length_text(metres);
}
std::string speed_of(double speed) {
  return rounded_text(speed, 4) + " m/s";
}
std::string acceleration_of(double load) {
  return rounded_text(load, 4) + " m/s^2";
}
std::string rate_of(double rate) {
  return rounded_text(rate, 4) + " 1/m^2";
}

std::string path(const std::string& key) {
  return "limits." + key;
}

/// A range whose ends lie within (least, most) and in order.
struct RangeBounds {
  double least;
  double most;
  ValueText text;
};

void check_end(const std::optional<double>& value, const std::string& key, const RangeBounds& bounds,
               Collected& findings) {
  if (!value || (*value >= bounds.least && *value <= bounds.most)) return;
  report(findings, {path(key)},
         {"", key + ": " + bounds.text(*value) + " is out of range",
          "It lies between " + bounds.text(bounds.least) + " and " + bounds.text(bounds.most) + ".", ""});
}

void check_range(const LimitRange& range, const std::string& key, const RangeBounds& bounds,
                 Collected& findings) {
  check_end(range.lowest, key + ".lowest", bounds, findings);
  if (range.highest != range.lowest) check_end(range.highest, key + ".highest", bounds, findings);
  if (!range.lowest || !range.highest || *range.lowest <= *range.highest) return;
  report(findings, {path(key)},
         {"",
          key + ": lowest " + bounds.text(*range.lowest) + " is above highest " + bounds.text(*range.highest),
          "Nothing lies between them.", "the two the other way round"});
}

bool disjoint(const LimitRange& left, const LimitRange& right) {
  const auto above = [](const LimitRange& high, const LimitRange& low) {
    return high.lowest && low.highest && *high.lowest > *low.highest;
  };
  return above(left, right) || above(right, left);
}

std::string range_text(const LimitRange& range, ValueText text) {
  if (range.lowest && range.highest && *range.lowest == *range.highest) return text(*range.lowest);
  if (range.lowest && range.highest) return text(*range.lowest) + " to " + text(*range.highest);
  return range.lowest ? "at least " + text(*range.lowest) : "at most " + text(*range.highest);
}

void check_agreement(const LimitRange& part, const std::string& part_key, const LimitRange& whole,
                     const std::string& whole_key, ValueText text, Collected& findings) {
  if (!disjoint(part, whole)) return;
  report(findings, {path(part_key), path(whole_key)},
         {"",
          part_key + ": " + range_text(part, text) + " contradicts " + whole_key + ": " +
              range_text(whole, text),
          "The limit for the whole track holds at its ends too.", "ranges that overlap"});
}

void check_positive(const std::optional<double>& value, const std::string& key, ValueText text,
                    Collected& findings) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return;
  report(findings, {path(key)},
         {"", key + ": " + text(*value) + " is not positive", "", "no " + key + ", if it is not limited"});
}

void check_slopes(const LimitsDesign& limits, Collected& findings) {
  constexpr RangeBounds kBounds = {-std::numbers::pi, std::numbers::pi, &angle_of};
  check_range(limits.entry_slope_angle, "entry_slope_angle", kBounds, findings);
  check_range(limits.exit_slope_angle, "exit_slope_angle", kBounds, findings);
  check_range(limits.slope_angle, "slope_angle", kBounds, findings);
  check_agreement(limits.entry_slope_angle, "entry_slope_angle", limits.slope_angle, "slope_angle", &angle_of,
                  findings);
  check_agreement(limits.exit_slope_angle, "exit_slope_angle", limits.slope_angle, "slope_angle", &angle_of,
                  findings);
}

/// Along a concave track the slope angle only falls.
void check_concave(const LimitsDesign& limits, Collected& findings) {
  const std::optional<double>& entry = limits.entry_slope_angle.highest;
  const std::optional<double>& exit = limits.exit_slope_angle.lowest;
  if (!limits.concave || !entry || !exit || *entry >= *exit) return;
  report(findings, {path("concave"), path("entry_slope_angle"), path("exit_slope_angle")},
         {"",
          "concave: the track would have to be steeper at the exit (" + angle_text(*exit) +
              ") than at the entry (" + angle_text(*entry) + ")",
          "Without a crest the slope angle only falls.", "concave: false, or a steeper entry_slope_angle"});
}

void check_curvature(const LimitsDesign& limits, Collected& findings) {
  check_positive(limits.smallest_valley_radius, "smallest_valley_radius", &length_of, findings);
  if (limits.smallest_crest_radius != limits.smallest_valley_radius) {
    check_positive(limits.smallest_crest_radius, "smallest_crest_radius", &length_of, findings);
  }
  check_positive(limits.highest_curvature_rate, "highest_curvature_rate", &rate_of, findings);
  check_concave(limits, findings);
}

void check_loads(const LimitsDesign& limits, Collected& findings) {
  check_positive(limits.highest_normal_load, "highest_normal_load", &acceleration_of, findings);
  check_positive(limits.highest_curvature_load, "highest_curvature_load", &acceleration_of, findings);
  if (!limits.highest_normal_load || !limits.lowest_normal_load) return;
  if (*limits.lowest_normal_load <= *limits.highest_normal_load) return;
  report(findings, {path("lowest_normal_load"), path("highest_normal_load")},
         {"",
          "lowest_normal_load: " + acceleration_of(*limits.lowest_normal_load) +
              " is above highest_normal_load: " + acceleration_of(*limits.highest_normal_load),
          "Nothing lies between them.", "the two the other way round"});
}

void check_entry_speed(const Design& design, Collected& findings) {
  const LimitsDesign& limits = *design.limits;
  const double entry = design.body.entry_speed;
  if (limits.speed.highest && entry > *limits.speed.highest) {
    report(findings, {path("speed.highest"), "body.entry_speed"},
           {"",
            "speed.highest: " + speed_of(*limits.speed.highest) + " is below the entry speed, " +
                speed_of(entry),
            "The body breaks the limit before the track begins.", "a lower entry_speed"});
  }
  if (limits.speed.lowest && entry < *limits.speed.lowest && limits.lowest_speed_from == 0.0) {
    report(
        findings, {path("speed.lowest"), path("speed"), "body.entry_speed"},
        {"",
         "speed.lowest: " + speed_of(*limits.speed.lowest) + " is above the entry speed, " + speed_of(entry),
         "The body is too slow at the start itself.",
         "lowest_from: 0.5 m beside it, the arc length from which it holds"});
  }
}

void check_speeds(const Design& design, Collected& findings) {
  const LimitsDesign& limits = *design.limits;
  constexpr RangeBounds kBounds = {0.0, 1e4, &speed_of};
  check_range(limits.speed, "speed", kBounds, findings);
  check_range(limits.exit_speed, "exit_speed", kBounds, findings);
  check_agreement(limits.exit_speed, "exit_speed", limits.speed, "speed", &speed_of, findings);
  if (!(limits.lowest_speed_from >= 0.0)) {
    report(findings, {path("speed.lowest_from")},
           {"", "speed.lowest_from: " + length_text(limits.lowest_speed_from) + " is negative",
            "It is an arc length from the start.", ""});
  }
  check_entry_speed(design, findings);
}

void check_lead(double value, const std::string& key, Collected& findings) {
  if (value >= 0.0 && value <= 1e6) return;
  report(findings, {path(key)},
         {"", key + ": " + length_text(value) + " is out of range", "A straight piece is 0 to 1000 km long.",
          ""});
}

void check_lengths(const Design& design, Collected& findings) {
  const LimitsDesign& limits = *design.limits;
  constexpr RangeBounds kBounds = {0.0, 1e6, &length_of};
  check_range(limits.arc_length, "arc_length", kBounds, findings);
  check_lead(limits.lead_in, "lead_in", findings);
  check_lead(limits.lead_out, "lead_out", findings);
  const std::optional<double>& longest = limits.arc_length.highest;
  if (!longest) return;
  const double distance = norm(design.track.finish - design.track.start);
  if (design.track.free_finish == FreeFinish::none && *longest < distance) {
    report(findings, {path("arc_length"), "track"},
           {"",
            "arc_length: at most " + length_text(*longest) + " is shorter than the straight line, " +
                length_text(distance),
            "No track is.", ""});
  }
  if (limits.lead_in + limits.lead_out > *longest) {
    report(findings, {path("arc_length"), path("lead_in"), path("lead_out")},
           {"",
            "arc_length: at most " + length_text(*longest) + " leaves no room for lead_in and lead_out, " +
                length_text(limits.lead_in + limits.lead_out),
            "The straight pieces count too.", ""});
  }
}

// --- clearances ----------------------------------------------------------------------------------------

void check_clearance(double clearance, const std::string& key, Collected& findings) {
  if (clearance >= 0.0 && clearance <= 1e6) return;
  report(findings, {path(key) + ".clearance", path(key)},
         {"", "clearance: " + length_text(clearance) + " is out of range", "It is 0 or more.", ""});
}

void check_line(const std::vector<Vec2>& line, const std::string& key, Collected& findings) {
  if (line.size() < 2) {
    report(findings, {path(key) + ".line"},
           {"", "line: " + std::to_string(line.size()) + " points", "A line has at least two.", ""});
    return;
  }
  for (std::size_t index = 1; index < line.size(); ++index) {
    if (line[index].x > line[index - 1].x) continue;
    report(findings, {path(key) + ".line." + std::to_string(index), path(key) + ".line"},
           {"",
            "line[" + std::to_string(index) + "]: x does not grow from " + length_text(line[index - 1].x) +
                " to " + length_text(line[index].x),
            "A line runs from left to right and has one height at each x.",
            "keep_outs for a shape that overhangs"});
    return;
  }
}

/// The point of the track's vertical plane, in the coordinates that limits are given in.
Vec2 in_limit_plane(const TrackDesign& track, Vec3 point) {
  if (track.start.y == track.finish.y) return {point.x, point.z};
  return {math::hypot(point.x - track.start.x, point.y - track.start.y), point.z};
}

struct NamedPoint {
  std::string name;
  Vec2 point;
  std::string key_path;
};

std::vector<NamedPoint> fixed_points(const Design& design) {
  const TrackDesign& track = design.track;
  std::vector<NamedPoint> points = {{"the start", in_limit_plane(track, track.start), "track.start"}};
  if (track.free_finish == FreeFinish::none) {
    points.push_back({"the finish", in_limit_plane(track, track.finish), "track.finish"});
  }
  const std::vector<Vec2>& waypoints = design.limits->waypoints;
  for (std::size_t index = 0; index < waypoints.size(); ++index) {
    const std::string number = std::to_string(index);
    points.push_back({"waypoints[" + number + "]", waypoints[index], path("waypoints." + number)});
  }
  return points;
}

/// Height of the line over x; none beside it.
std::optional<double> height_at(const std::vector<Vec2>& line, double x) {
  for (std::size_t index = 1; index < line.size(); ++index) {
    const Vec2 a = line[index - 1];
    const Vec2 b = line[index];
    if (!(a.x < b.x) || x < a.x || x > b.x) continue;
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
  }
  return {};
}

void report_breach(const NamedPoint& point, const std::string& key, const std::string& what,
                   Collected& findings) {
  report(findings, {path(key), point.key_path, "track"},
         {"", point.name + " " + what, "The track would break this limit there, whatever its shape.",
          "another position of one of the two"});
}

void check_fixed_point(const LimitsDesign& limits, const NamedPoint& point, Collected& findings) {
  constexpr double kRounding = 1e-9;
  for (std::size_t index = 0; index < limits.half_planes.size(); ++index) {
    const HalfPlaneDesign& plane = limits.half_planes[index];
    const double beyond = dot(point.point - plane.point, plane.forbidden) + plane.clearance;
    if (beyond <= kRounding) continue;
    report_breach(
        point, "half_planes." + std::to_string(index),
        "lies " + length_text(beyond) + " on the wrong side of half_planes[" + std::to_string(index) + "]",
        findings);
  }
  for (std::size_t index = 0; index < limits.keep_outs.size(); ++index) {
    if (limits.keep_outs[index].outline.size() < 3) continue;
    if (!inside_outline(limits.keep_outs[index].outline, point.point)) continue;
    report_breach(point, "keep_outs." + std::to_string(index),
                  "lies in keep_outs[" + std::to_string(index) + "]", findings);
  }
  const auto check_profiles = [&](const std::vector<ProfileDesign>& profiles, const std::string& key,
                                  double sign) {
    for (std::size_t index = 0; index < profiles.size(); ++index) {
      const auto height = height_at(profiles[index].line, point.point.x);
      const double beyond = height ? sign * (*height - point.point.y) + profiles[index].clearance : 0.0;
      if (beyond <= kRounding) continue;
      report_breach(
          point, key + "." + std::to_string(index),
          "lies " + length_text(beyond) + " on the wrong side of " + key + "[" + std::to_string(index) + "]",
          findings);
    }
  };
  check_profiles(limits.stay_above, "stay_above", 1.0);
  check_profiles(limits.stay_below, "stay_below", -1.0);
}

void check_shapes(const LimitsDesign& limits, Collected& findings) {
  for (std::size_t index = 0; index < limits.half_planes.size(); ++index) {
    check_clearance(limits.half_planes[index].clearance, "half_planes." + std::to_string(index), findings);
  }
  for (std::size_t index = 0; index < limits.keep_outs.size(); ++index) {
    const std::string key = "keep_outs." + std::to_string(index);
    check_clearance(limits.keep_outs[index].clearance, key, findings);
    if (auto fault = outline_fault(limits.keep_outs[index].outline, "outline")) {
      report(findings, {path(key) + ".outline"}, *std::move(fault));
    }
  }
  const auto check_profiles = [&](const std::vector<ProfileDesign>& profiles, const std::string& name) {
    for (std::size_t index = 0; index < profiles.size(); ++index) {
      const std::string key = name + "." + std::to_string(index);
      check_clearance(profiles[index].clearance, key, findings);
      check_line(profiles[index].line, key, findings);
    }
  };
  check_profiles(limits.stay_above, "stay_above");
  check_profiles(limits.stay_below, "stay_below");
}

void check_clearances(const Design& design, Collected& findings) {
  const std::size_t before = findings.size();
  check_shapes(*design.limits, findings);
  if (findings.size() != before || !design.track.finish_given) return;
  for (const NamedPoint& point : fixed_points(design)) check_fixed_point(*design.limits, point, findings);
}

void check_objective(const Design& design, Collected& findings) {
  const ObjectiveDesign& objective = design.limits->objective;
  if (!(objective.exit_speed_weight >= 0.0 && std::isfinite(objective.exit_speed_weight))) {
    report(findings, {path("objective.exit_speed_weight")},
           {"", "exit_speed_weight: " + rounded_text(objective.exit_speed_weight, 4) + " s/(m/s) is negative",
            "Exit speed is worth something, or nothing.", "0.1 s/(m/s)"});
  }
  if (objective.worst_case && !design.body.high_friction) {
    report(findings, {path("objective.worst_case"), "body"},
           {"", "worst_case: the friction has no highest value",
            "The worst case is the highest friction of a range.",
            "friction_angle: {low: 14 deg, nominal: 17 deg, high: 20 deg}"});
  }
}

}  // namespace

void check_limits(const Design& design, Collected& findings) {
  if (!design.limits) return;
  check_slopes(*design.limits, findings);
  check_curvature(*design.limits, findings);
  check_loads(*design.limits, findings);
  check_speeds(design, findings);
  check_lengths(design, findings);
  check_clearances(design, findings);
  check_objective(design, findings);
}

}  // namespace glissade::design_file
