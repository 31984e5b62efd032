#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "core/counted.hpp"
#include "core/outline.hpp"
#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

std::string path(const std::string& key) {
  return "limits." + key;
}

bool disjoint(const Range& left, const Range& right) {
  const auto above = [](const Range& high, const Range& low) {
    return high.lowest && low.highest && *high.lowest > *low.highest;
  };
  return above(left, right) || above(right, left);
}

/// Two values of one dimension that contradict each other, with the digits that tell them apart.
std::pair<std::string, std::string> apart(double a, double b, Dimension dimension) {
  const auto text = [&](double value, int digits) { return quantity_text(value, dimension, digits); };
  return texts_apart(a, b, text);
}

std::string range_text(const Range& range, Dimension dimension) {
  const auto text = [&](double value) { return quantity_text(value, dimension); };
  if (range.is_fixed()) return text(*range.lowest);
  if (range.lowest && range.highest) return text(*range.lowest) + " to " + text(*range.highest);
  return range.lowest ? "at least " + text(*range.lowest) : "at most " + text(*range.highest);
}

void check_agreement(const Limits& limits, LimitId part_id, LimitId whole_id, Collected& findings) {
  const LimitEntry& part = entry_of(part_id);
  const LimitEntry& whole = entry_of(whole_id);
  if (!disjoint(limits.*part.range, limits.*whole.range)) return;
  const std::string part_key(part.key);
  const std::string whole_key(whole.key);
  report(findings, {path(part_key), path(whole_key)},
         {"",
          part_key + ": " + range_text(limits.*part.range, part.dimension) + " contradicts " + whole_key +
              ": " + range_text(limits.*whole.range, whole.dimension),
          "The limit for the whole track holds at its ends too.", "ranges that overlap"});
}

/// Every number of the limits against its bounds in the catalogue.
void check_bounds(const Design& design, Collected& findings) {
  const bool one_radius = design.locations.contains("limits.smallest_radius") &&
                          !design.locations.contains("limits.smallest_valley_radius");
  for (LimitFault& fault : limit_faults(*design.limits)) {
    std::string key = fault.key;
    // Where one key stands for both radii it is the one to be named, once.
    const bool of_both = !design.locations.contains("limits.smallest_crest_radius");
    if (one_radius && of_both && key == "smallest_crest_radius") continue;
    if (one_radius && key == "smallest_valley_radius") {
      fault.issue.what.replace(0, key.size(), "smallest_radius");
      fault.issue.hint = "no smallest_radius, if it is not limited";
      key = "smallest_radius";
    }
    report(findings, {path(key)}, std::move(fault.issue));
  }
}

/// Along a concave track the slope angle only falls.
void check_concave(const Limits& limits, Collected& findings) {
  const std::optional<double>& entry = limits.entry_slope_angle.highest;
  const std::optional<double>& exit = limits.exit_slope_angle.lowest;
  if (!limits.concave || !entry || !exit || *entry >= *exit) return;
  report(
      findings, {path("concave"), path("entry_slope_angle"), path("exit_slope_angle")},
      {"",
       "concave: the track would have to be steeper at the exit (" + angle_text(Angle::from_radians(*exit)) +
           ") than at the entry (" + angle_text(Angle::from_radians(*entry)) + ")",
       "Without a crest the slope angle only falls.", "concave: false, or a steeper entry_slope_angle"});
}

void check_loads(const Limits& limits, Collected& findings) {
  if (!limits.highest_normal_load || !limits.lowest_normal_load) return;
  if (*limits.lowest_normal_load <= *limits.highest_normal_load) return;
  const auto [lowest, highest] =
      apart(*limits.lowest_normal_load, *limits.highest_normal_load, Dimension::acceleration);
  report(findings, {path("lowest_normal_load"), path("highest_normal_load")},
         {"", "lowest_normal_load: " + lowest + " is above highest_normal_load: " + highest,
          "Nothing lies between them.", "the two the other way round"});
}

void check_entry_speed(const Design& design, Collected& findings) {
  const Limits& limits = *design.limits;
  const double entry = design.body.entry_speed;
  if (limits.speed.highest && entry > *limits.speed.highest) {
    const auto [highest, enters] = apart(*limits.speed.highest, entry, Dimension::speed);
    report(findings, {path("speed.highest"), "body.entry_speed"},
           {"", "speed.highest: " + highest + " is below the entry speed, " + enters,
            "The body breaks the limit before the track begins.", "a lower entry_speed"});
  }
  if (limits.speed.lowest && entry < *limits.speed.lowest && limits.lowest_speed_from == 0.0) {
    const auto [lowest, enters] = apart(*limits.speed.lowest, entry, Dimension::speed);
    report(findings, {path("speed.lowest"), path("speed"), "body.entry_speed"},
           {"", "speed.lowest: " + lowest + " is above the entry speed, " + enters,
            "The body is too slow at the start itself.",
            "lowest_from: 0.5 m beside it, the arc length from which it holds"});
  }
}

void check_speeds(const Design& design, Collected& findings) {
  const Limits& limits = *design.limits;
  if (!(limits.lowest_speed_from >= 0.0)) {
    report(findings, {path("speed.lowest_from")},
           {"", "speed.lowest_from: " + length_text(limits.lowest_speed_from) + " is negative",
            "It is an arc length from the start.", "0 m, or no lowest_from"});
  }
  check_entry_speed(design, findings);
}

void check_lengths(const Design& design, Collected& findings) {
  const Limits& limits = *design.limits;
  const std::optional<double>& longest = limits.arc_length.highest;
  if (!longest) return;
  const double distance = norm(design.track.finish - design.track.start);
  const auto [most, straight] = texts_apart(*longest, distance, &length_text);
  const bool searched = design.track.finish_given && !is_drawn(design.centerline.kind);
  if (searched && design.track.free_finish == FinishKind::point && *longest < distance) {
    report(findings, {path("arc_length"), "track"},
           {"", "arc_length: at most " + most + " is shorter than the straight line, " + straight,
            "No track is.", "arc_length: at least " + straight});
  }
  if (limits.lowest_speed_from >= *longest && limits.speed.lowest) {
    report(findings, {path("speed.lowest_from"), path("speed"), path("arc_length")},
           {"",
            "speed.lowest_from: " + length_text(limits.lowest_speed_from) +
                " lies past the end of the track, which is at most " + length_text(*longest) + " long",
            "speed.lowest would never apply.", "a place before the end, or exit_speed: {lowest: ...}"});
  }
  if (limits.lead_in + limits.lead_out > *longest) {
    report(findings, {path("arc_length"), path("lead_in"), path("lead_out")},
           {"",
            "arc_length: at most " + length_text(*longest) + " leaves no room for lead_in and lead_out, " +
                length_text(limits.lead_in + limits.lead_out),
            "The straight pieces count too.", "a longer arc_length, or shorter pieces"});
  }
}

// --- clearances ----------------------------------------------------------------------------------------

void check_clearance(double clearance, const std::string& key, Collected& findings) {
  if (clearance >= 0.0 && clearance <= kLongestTrack) return;
  report(findings, {path(key) + ".clearance", path(key)},
         out_of_range("clearance", clearance, Dimension::length, {0.0, kLongestTrack},
                      "It lies between 0 mm and 1000 km.", ""));
}

void check_line(const std::vector<Vec2>& line, const std::string& key, Collected& findings) {
  if (line.size() < 2) {
    report(findings, {path(key) + ".line"},
           {"", "line: " + core::counted(line.size(), "point"), "A line has at least two.",
            "[[0 m, 2 m], [5 m, 2 m]]"});
    return;
  }
  for (std::size_t index = 1; index < line.size(); ++index) {
    if (line[index].x > line[index - 1].x) continue;
    const auto [before, here] = texts_apart(line[index - 1].x, line[index].x, &length_text);
    report(findings, {path(key) + ".line." + std::to_string(index), path(key) + ".line"},
           {"", "line[" + std::to_string(index) + "]: x does not grow from " + before + " to " + here,
            "A line runs from left to right and has one height at each x.",
            "keep_outs for a shape that overhangs"});
    return;
  }
}

/// The point of the track's vertical plane, in the coordinates that limits are given in.
Vec2 in_limit_plane(const TrackDesign& track, Vec3 point) {
  if (track.start.y == track.finish.y) return {point.x, point.z};
  const Vec3& origin = track.free_start ? track.finish : track.start;
  return {math::hypot(point.x - origin.x, point.y - origin.y), point.z};
}

struct NamedPoint {
  std::string name;
  Vec2 point;
  std::string key_path;
};

std::vector<NamedPoint> fixed_points(const Design& design) {
  const TrackDesign& track = design.track;
  std::vector<NamedPoint> points;
  if (!track.free_start) {
    points.push_back({"the start", in_limit_plane(track, track.start), "track.start"});
  } else {
    points.push_back({"the edge", in_limit_plane(track, track.finish), "track.edge"});
  }
  if (track.free_finish == FinishKind::point) {
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

/// To an edge the track comes from one side alone, as long as it keeps within the vertical.
void check_waypoints_to_edge(const Design& design, Collected& findings) {
  if (!design.track.free_start) return;
  const Limits& limits = *design.limits;
  if (limits.slope_angle.highest.value_or(kRightAngle) > kRightAngle) return;
  for (std::size_t index = 0; index < limits.waypoints.size(); ++index) {
    const double past = in_edge_plane(design.track, limits.waypoints[index]).x;
    if (past <= 0.0) continue;
    report(findings, {path("waypoints." + std::to_string(index)), path("waypoints")},
           {"", "waypoints[" + std::to_string(index) + "] lies " + length_text(past) + " past the edge",
            "A track that keeps within the vertical does not run back to where it ends.",
            "a point before the edge"});
  }
}

/// A track that is searched for passes its waypoints in their order.
void check_waypoint_order(const Design& design, Collected& findings) {
  if (design.centerline.kind != CenterlineKind::fastest) return;
  const std::vector<Vec2>& waypoints = design.limits->waypoints;
  const auto run = [&](Vec2 point) {
    return design.track.free_start ? in_edge_plane(design.track, point).x
                                   : in_track_plane(design.track, point).x;
  };
  for (std::size_t index = 1; index < waypoints.size(); ++index) {
    const double back = run(waypoints[index - 1]) - run(waypoints[index]);
    if (!(back > 0.0)) continue;
    report(findings, {path("waypoints." + std::to_string(index))},
           {"",
            "waypoints[" + std::to_string(index) + "] lies " + length_text(back) +
                " along the run before waypoints[" + std::to_string(index - 1) + "]",
            "A track passes its waypoints in their order, and none that keeps within the vertical runs back.",
            "the waypoints in the order of their runs"});
  }
}

void report_breach(const NamedPoint& point, const std::string& key, const std::string& what,
                   Collected& findings) {
  report(findings, {path(key), point.key_path, "track"},
         {"", point.name + " " + what, "The track would break this limit there, whatever its shape.",
          "another position of one of the two"});
}

/// @param beyond  how far it lies beyond the clearance's bound
std::string breach_text(double beyond, double clearance, const std::string& what) {
  if (beyond > clearance) return "lies " + length_text(beyond - clearance) + " on the wrong side of " + what;
  return "lies " + length_text(beyond) + " within the clearance of " + what + ", " + length_text(clearance);
}

void check_fixed_point(const Limits& limits, const NamedPoint& point, Collected& findings) {
  constexpr double kRounding = 1e-9;
  for (std::size_t index = 0; index < limits.half_planes.size(); ++index) {
    const HalfPlane& plane = limits.half_planes[index];
    const double beyond = dot(point.point - plane.point, plane.forbidden) + plane.clearance;
    if (beyond <= kRounding) continue;
    report_breach(point, "half_planes." + std::to_string(index),
                  breach_text(beyond, plane.clearance, "half_planes[" + std::to_string(index) + "]"),
                  findings);
  }
  for (std::size_t index = 0; index < limits.keep_outs.size(); ++index) {
    if (limits.keep_outs[index].outline.size() < 3) continue;
    if (!core::inside_outline(limits.keep_outs[index].outline, point.point)) continue;
    report_breach(point, "keep_outs." + std::to_string(index),
                  "lies in keep_outs[" + std::to_string(index) + "]", findings);
  }
  const auto check_profiles = [&](const std::vector<Profile>& profiles, const std::string& key, double sign) {
    for (std::size_t index = 0; index < profiles.size(); ++index) {
      const auto height = height_at(profiles[index].line, point.point.x);
      const double beyond = height ? sign * (*height - point.point.y) + profiles[index].clearance : 0.0;
      if (beyond <= kRounding) continue;
      report_breach(point, key + "." + std::to_string(index),
                    breach_text(beyond, profiles[index].clearance, key + "[" + std::to_string(index) + "]"),
                    findings);
    }
  };
  check_profiles(limits.stay_above, "stay_above", 1.0);
  check_profiles(limits.stay_below, "stay_below", -1.0);
}

void check_shapes(const Limits& limits, Collected& findings) {
  for (std::size_t index = 0; index < limits.half_planes.size(); ++index) {
    check_clearance(limits.half_planes[index].clearance, "half_planes." + std::to_string(index), findings);
  }
  for (std::size_t index = 0; index < limits.keep_outs.size(); ++index) {
    const std::string key = "keep_outs." + std::to_string(index);
    check_clearance(limits.keep_outs[index].clearance, key, findings);
    if (auto fault = core::outline_fault(limits.keep_outs[index].outline, "outline")) {
      report(findings, {path(key) + ".outline"}, *std::move(fault));
    }
  }
  const auto check_profiles = [&](const std::vector<Profile>& profiles, const std::string& name) {
    for (std::size_t index = 0; index < profiles.size(); ++index) {
      const std::string key = name + "." + std::to_string(index);
      check_clearance(profiles[index].clearance, key, findings);
      check_line(profiles[index].line, key, findings);
    }
  };
  check_profiles(limits.stay_above, "stay_above");
  check_profiles(limits.stay_below, "stay_below");
}

void check_headroom(const Limits& limits, Collected& findings) {
  const double headroom = limits.envelope.headroom;
  if (!(headroom >= 0.0 && headroom <= kLongestTrack)) {
    report(findings, {path("headroom")},
           out_of_range("headroom", headroom, Dimension::length, {0.0, kLongestTrack},
                        "It is what slides needs above the floor, 0 mm to 1000 km.", ""));
    return;
  }
  if (headroom == 0.0) return;
  if (limits.clearances_from == ClearancesFrom::centerline) {
    report(findings, {path("headroom"), path("clearances_from")},
           {"", "headroom: " + length_text(headroom) + " contradicts clearances_from: centerline",
            "Measured from the centerline, clearances know nothing above the floor.",
            "clearances_from: solid, or a larger clearance instead of the headroom"});
  } else if (!limits.has_clearances()) {
    report(findings, {path("headroom")},
           {"", "headroom: " + length_text(headroom) + " is kept clear of nothing",
            "It counts for half_planes, keep_outs, stay_above and stay_below, and there are none.",
            "no headroom, or the obstacle that it is about"});
  }
}

void check_clearances(const Design& design, Collected& findings) {
  check_headroom(*design.limits, findings);
  const std::size_t before = findings.size();
  check_shapes(*design.limits, findings);
  // The ends of a track that is drawn are places of it like any other: the referee tells of them, whether or not a finish is given.
  if (findings.size() != before || !design.track.finish_given || is_drawn(design.centerline.kind)) return;
  for (const NamedPoint& point : fixed_points(design)) check_fixed_point(*design.limits, point, findings);
  check_waypoints_to_edge(design, findings);
  check_waypoint_order(design, findings);
}

/// Limits and objectives that only a stream can have.
void check_of_stream(const Design& design, Collected& findings) {
  const Limits& limits = *design.limits;
  const auto needs_stream = [&](bool asked, const char* key, const char* why) {
    if (!asked || design.stream) return;
    report(findings, {path(key)},
           {"", std::string(key) + ": of a body that is no stream", why,
            "stream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}"});
  };
  needs_stream(limits.highest_burden_depth.has_value(), "highest_burden_depth", "Only a stream has a depth.");
  needs_stream(limits.highest_floor_wear.has_value(), "highest_floor_wear",
               "What rubs on the floor follows from a mass flow.");
  const ObjectiveKind objective = design.objective.kind;
  if (objective == ObjectiveKind::even_speed && !design.stream) {
    report(findings, {path("objective")},
           {"", "objective: even_speed, of a body that is no stream",
            "A stream of even speed is of even depth; a single body has its constant-speed curve.",
            "centerline: {kind: constant-speed}"});
  }
  if (objective == ObjectiveKind::least_peak_wear && !design.stream) {
    report(findings, {path("objective")},
           {"", "objective: least_peak_wear, of a body that is no stream",
            "What rubs on the floor follows from a mass flow.", "objective: least_wear"});
  }
  const bool wears = objective == ObjectiveKind::least_wear;
  if (wears && (design.track.free_finish != FinishKind::point || design.body.drag_per_metre > 0.0)) {
    report(findings, {path("objective")},
           {"",
            std::string("objective: least_wear, with ") +
                (design.body.drag_per_metre > 0.0 ? "drag" : "a finish that is free"),
            "It is found as the greatest exit speed, which is the same between two fixed ends in still air.",
            "objective: exit_speed"});
  }
}

bool asks_for_exit_speed(const Design& design) {
  return design.limits->exit_speed.lowest.value_or(0.0) > design.body.entry_speed;
}

/// For an end that is free both ways.
std::string level_to_try(const Design& design) {
  constexpr int kDigits = 4;
  const TrackDesign& track = design.track;
  const double drop = drop_to_ask_for(design);
  const double height = track.free_start ? track.finish.z + drop : track.start.z - drop;
  return std::string(track.free_start ? "a start" : "a finish") +
         " at a level: {x: free, z: " + rounded_text(height, kDigits) + " m}";
}

/// The same ends, of which the height of one is left open; of one that is free along a level, both.
std::string free_height_to_try(const Design& design) {
  constexpr int kDigits = 12;
  const auto length = [](double value) { return rounded_text(value, kDigits) + " m"; };
  const TrackDesign& track = design.track;
  const bool along = track.free_finish == FinishKind::level;
  std::string text = track.free_start ? "start: {x: " : "finish: {x: ";
  text += along ? "free" : length(track.finish.x);
  if (!along && track.finish.y != 0.0) text += ", y: " + length(track.finish.y);
  text += ", z: free}";
  if (!along || asks_for_exit_speed(design)) return text;
  // What is free both ways falls as far as a speed asks for.
  Design opened = design;
  opened.track.free_finish = FinishKind::anywhere;
  opened.track.free_height = {};
  const std::optional<std::string> speed = exit_speed_to_ask_for(opened);
  return speed ? text + ", with limits: {exit_speed: {lowest: " + *speed + "}}" : text;
}

/// The tightest bound at which a speed is still reached needs that speed, and ends that a track cannot flee to.
void check_least_bound(const Design& design, Collected& findings) {
  const bool load = design.objective.kind == ObjectiveKind::least_load;
  const std::string name = std::string("objective: ") + (load ? "least_load" : "least_curvature_rate");
  if (!asks_for_exit_speed(design)) {
    const std::optional<std::string> speed = exit_speed_to_ask_for(design);
    report(findings, {path("objective"), path("exit_speed")},
           {"", name + ", without a lowest exit_speed above the entry speed",
            "The least is that at which a given speed is just reached.",
            speed ? "exit_speed: {lowest: " + *speed + "}"
                  : "a track that falls further, and a lowest exit_speed above the entry speed"});
  }
  if (design.track.free_finish == FinishKind::anywhere) {
    report(findings, {path("objective"), "track"},
           {"", name + ", with an end that is free both ways",
            "A longer and longer track has less and less of it.",
            level_to_try(design) + ", or objective: least_drop"});
  }
}

/// A height that is given is no less for being made the least. Of a track that is drawn nothing is: what was found is frozen
/// with what it was searched for.
void check_least_drop(const Design& design, Collected& findings) {
  const TrackDesign& track = design.track;
  if (!fixes_drop(track.free_finish) || is_drawn(design.centerline.kind)) return;
  report(
      findings, {path("objective"), "track"},
      {"", "objective: least_drop, with a drop that is given, " + length_text(track.start.z - track.finish.z),
       "It is the least height between start and finish.", free_height_to_try(design)});
}

void check_objective(const Design& design, Collected& findings) {
  const Objective& objective = design.objective;
  if (objective.kind == ObjectiveKind::least_drop) check_least_drop(design, findings);
  if (is_least_bound(objective.kind)) check_least_bound(design, findings);
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
  const Limits& limits = *design.limits;
  check_bounds(design, findings);
  check_agreement(limits, LimitId::entry_slope_angle, LimitId::slope_angle, findings);
  check_agreement(limits, LimitId::exit_slope_angle, LimitId::slope_angle, findings);
  check_agreement(limits, LimitId::exit_speed, LimitId::speed, findings);
  check_concave(limits, findings);
  check_loads(limits, findings);
  check_speeds(design, findings);
  check_lengths(design, findings);
  check_clearances(design, findings);
  check_objective(design, findings);
  check_of_stream(design, findings);
}

}  // namespace glissade::design_file
