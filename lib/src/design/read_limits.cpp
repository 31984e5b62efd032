#include "design/read_limits.hpp"

#include "glissade/core/words.hpp"

#include "design/schema_words.hpp"

#include <string>
#include <utility>

namespace glissade::design_file {
namespace {

constexpr std::string_view kLineExample = "[[0 m, 1 m], [5 m, 0.5 m]]";

/// A range; where `single` allows it a single value stands for both ends.
enum class Single { fixes, refused };

LimitRange read_range(MapReader& map, std::string_view key, Dimension dimension, Single single,
                      Findings& findings) {
  const auto value = map.find(key);
  if (!value) return {};
  if (value->node->kind == Node::Kind::map) return read_range(*value, dimension, findings);
  const auto number = as_quantity(*value, dimension, findings);
  if (!number) return {};
  if (single == Single::fixes) return {number, number};
  findings.add(value->node->at, value->key_path,
               {"",
                value->key + ": " + shown(value->node->scalar) +
                    " does not say whether it is the lowest or the highest",
                "", value->key + ": {highest: " + shown(value->node->scalar) + "}"});
  return {};
}

void read_slopes(MapReader& map, LimitsDesign& limits, Findings& findings) {
  limits.entry_slope_angle = read_range(map, "entry_slope_angle", Dimension::angle, Single::fixes, findings);
  limits.exit_slope_angle = read_range(map, "exit_slope_angle", Dimension::angle, Single::fixes, findings);
  limits.slope_angle = read_range(map, "slope_angle", Dimension::angle, Single::refused, findings);
}

void read_curvature(MapReader& map, LimitsDesign& limits, Findings& findings) {
  const auto both = map.quantity("smallest_radius", Dimension::length);
  const auto valley = map.quantity("smallest_valley_radius", Dimension::length);
  const auto crest = map.quantity("smallest_crest_radius", Dimension::length);
  limits.smallest_valley_radius = valley ? valley : both;
  limits.smallest_crest_radius = crest ? crest : both;
  limits.highest_curvature_rate = map.quantity("highest_curvature_rate", Dimension::per_area);
  if (const auto value = map.find("concave")) limits.concave = as_flag(*value, findings).value_or(false);
}

void read_loads(MapReader& map, LimitsDesign& limits, Findings& findings) {
  limits.highest_normal_load = map.quantity("highest_normal_load", Dimension::acceleration);
  limits.highest_curvature_load = map.quantity("highest_curvature_load", Dimension::acceleration);
  const auto lowest = map.find("lowest_normal_load");
  if (!lowest) return;
  if (lowest->node->kind == Node::Kind::scalar && lowest->node->scalar == "none") {
    limits.lowest_normal_load.reset();
    return;
  }
  limits.lowest_normal_load = as_quantity(*lowest, Dimension::acceleration, findings).value_or(0.0);
}

void read_speed(MapReader& limits_map, LimitsDesign& limits, Findings& findings) {
  const auto value = limits_map.find("speed");
  if (!value) return;
  MapReader map(*value, "A speed limit", "speed: {highest: 4 m/s}", findings);
  limits.speed.lowest = map.quantity("lowest", Dimension::speed);
  limits.speed.highest = map.quantity("highest", Dimension::speed);
  limits.lowest_speed_from = map.quantity("lowest_from", Dimension::length).value_or(0.0);
  map.refuse_unknown_keys();
}

double read_clearance(MapReader& map) {
  return map.quantity("clearance", Dimension::length).value_or(0.0);
}

enum class Side { above, below, left, right };

/// The unit vector square to the line that points away from `stay`; none if the line does not have that side.
std::optional<Vec2> away_from(Side stay, Vec2 along) {
  const double size = norm(along);
  if (!(size > 0.0)) return {};
  Vec2 away{-along.y / size, along.x / size};
  const bool vertical_sides = stay == Side::above || stay == Side::below;
  const double component = vertical_sides ? away.y : away.x;
  if (component == 0.0) return {};
  const bool wanted_positive = stay == Side::below || stay == Side::left;
  return (component > 0.0) == wanted_positive ? away : -1.0 * away;
}

std::optional<HalfPlaneDesign> read_half_plane(const Value& value, Findings& findings) {
  constexpr std::string_view kExample = "{line: [[0 m, 2 m], [5 m, 2 m]], stay: below}";
  static const Words<Side> sides = {
      {"above", Side::above}, {"below", Side::below}, {"left", Side::left}, {"right", Side::right}};
  MapReader map(value, "A half_plane", kExample, findings);
  const auto line_value = map.need("line", "line: [[0 m, 2 m], [5 m, 2 m]]");
  const auto stay_value = map.need("stay", "stay: below");
  HalfPlaneDesign plane;
  plane.clearance = read_clearance(map);
  map.refuse_unknown_keys();
  const std::vector<Vec2> line =
      line_value ? as_points(*line_value, "[[0 m, 2 m], [5 m, 2 m]]", findings) : std::vector<Vec2>{};
  const auto stay = stay_value ? map.choice(*stay_value, sides) : std::nullopt;
  if (!stay || !line_value || line_value->node->items.size() != line.size()) return {};
  if (line.size() != 2) {
    findings.add(line_value->node->at, line_value->key_path,
                 {"", "line: " + std::to_string(line.size()) + " points instead of 2",
                  "Two points give a straight line.", "stay_above or stay_below for a line with corners"});
    return {};
  }
  const std::optional<Vec2> forbidden = away_from(*stay, line[1] - line[0]);
  if (!forbidden) {
    findings.add(stay_value->node->at, stay_value->key_path,
                 {"", "stay: " + stay_value->node->scalar + " is no side of this line",
                  "A level line has sides above and below, a vertical one left and right.", ""});
    return {};
  }
  plane.point = line[0];
  plane.forbidden = *forbidden;
  return plane;
}

std::optional<KeepOutDesign> read_keep_out(const Value& value, Findings& findings) {
  static const Words<PassageDesign> passages = {
      {"either", PassageDesign::either}, {"above", PassageDesign::above}, {"below", PassageDesign::below}};
  constexpr std::string_view kOutline = "[[2 m, 3 m], [2.4 m, 3 m], [2.4 m, 3.4 m], [2 m, 3.4 m]]";
  MapReader map(value, "A keep_out", "{outline: [[2 m, 3 m], [2.4 m, 3 m], [2 m, 3.4 m]], clearance: 50 mm}",
                findings);
  KeepOutDesign keep_out;
  if (const auto outline = map.need("outline", kOutline)) {
    keep_out.outline = as_points(*outline, kOutline, findings);
  }
  keep_out.clearance = read_clearance(map);
  if (const auto pass = map.find("pass")) {
    keep_out.passage = map.choice(*pass, passages).value_or(PassageDesign::either);
  }
  map.refuse_unknown_keys();
  return keep_out;
}

std::optional<ProfileDesign> read_profile(const Value& value, Findings& findings) {
  MapReader map(value, "A line", "{line: [[0 m, 1 m], [5 m, 0.5 m]], clearance: 100 mm}", findings);
  ProfileDesign profile;
  if (const auto line = map.need("line", kLineExample))
    profile.line = as_points(*line, kLineExample, findings);
  profile.clearance = read_clearance(map);
  map.refuse_unknown_keys();
  return profile;
}

/// Reads a list of things; each keeps its place, so that its number in messages is that of the file.
template <typename Thing>
std::vector<Thing> read_list(MapReader& map, std::string_view key, std::string_view example,
                             std::optional<Thing> (*read)(const Value&, Findings&), Findings& findings) {
  std::vector<Thing> things;
  const auto value = map.find(key);
  if (!value) return things;
  for (const Value& item : as_list(*value, example, findings)) {
    things.push_back(read(item, findings).value_or(Thing{}));
  }
  return things;
}

void read_clearances(MapReader& map, LimitsDesign& limits, Findings& findings) {
  limits.half_planes = read_list(map, "half_planes", "[{line: [[0 m, 2 m], [5 m, 2 m]], stay: below}]",
                                 &read_half_plane, findings);
  limits.keep_outs = read_list(map, "keep_outs", "[{outline: [[2 m, 3 m], [2.4 m, 3 m], [2 m, 3.4 m]]}]",
                               &read_keep_out, findings);
  limits.stay_above =
      read_list(map, "stay_above", "[{line: [[0 m, 1 m], [5 m, 0.5 m]]}]", &read_profile, findings);
  limits.stay_below =
      read_list(map, "stay_below", "[{line: [[0 m, 7 m], [5 m, 4 m]]}]", &read_profile, findings);
  if (const auto waypoints = map.find("waypoints")) {
    limits.waypoints = as_points(*waypoints, "[[2 m, 3.5 m]]", findings);
  }
}

void read_objective(MapReader& limits_map, ObjectiveDesign& objective, Findings& findings) {
  static const Words<ObjectiveDesignKind> kinds = {{"travel_time", ObjectiveDesignKind::travel_time},
                                                   {"exit_speed", ObjectiveDesignKind::exit_speed},
                                                   {"blend", ObjectiveDesignKind::blend}};
  const auto value = limits_map.find("objective");
  if (!value) return;
  if (value->node->kind == Node::Kind::scalar) {
    objective.kind = limits_map.choice(*value, kinds).value_or(ObjectiveDesignKind::travel_time);
    if (objective.kind != ObjectiveDesignKind::blend) return;
    findings.add(
        value->node->at, value->key_path,
        {"", "objective: blend has no weight", "It says how much time a unit of exit speed is worth.",
         "{kind: blend, exit_speed_weight: 0.1 s/(m/s)}"});
    return;
  }
  MapReader map(*value, "An objective", "travel_time", findings);
  if (const auto kind = map.need("kind", "kind: travel_time")) {
    objective.kind = map.choice(*kind, kinds).value_or(ObjectiveDesignKind::travel_time);
  }
  if (objective.kind == ObjectiveDesignKind::blend) {
    objective.exit_speed_weight =
        map.needed_quantity("exit_speed_weight", Dimension::time_per_speed, "exit_speed_weight: 0.1 s/(m/s)")
            .value_or(0.0);
  }
  map.add_stranger("exit_speed_weight", "kind: blend, which has exit_speed_weight");
  if (const auto worst = map.find("worst_case"))
    objective.worst_case = as_flag(*worst, findings).value_or(false);
  map.refuse_unknown_keys();
}

}  // namespace

LimitRange read_range(const Value& value, Dimension dimension, Findings& findings) {
  MapReader map(value, "A range", "{lowest: ..., highest: ...}", findings);
  LimitRange range;
  range.lowest = map.quantity("lowest", dimension);
  range.highest = map.quantity("highest", dimension);
  map.refuse_unknown_keys();
  return range;
}

std::optional<LimitsDesign> read_limits(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.find("limits");
  if (!value) return {};
  MapReader map(*value, "A group of limits", "{slope_angle: {highest: 35 deg}}", findings);
  LimitsDesign limits;
  read_slopes(map, limits, findings);
  read_curvature(map, limits, findings);
  read_loads(map, limits, findings);
  read_speed(map, limits, findings);
  limits.exit_speed = read_range(map, "exit_speed", Dimension::speed, Single::fixes, findings);
  limits.arc_length = read_range(map, "arc_length", Dimension::length, Single::fixes, findings);
  limits.lead_in = map.quantity("lead_in", Dimension::length).value_or(0.0);
  limits.lead_out = map.quantity("lead_out", Dimension::length).value_or(0.0);
  read_clearances(map, limits, findings);
  read_objective(map, limits.objective, findings);
  map.refuse_unknown_keys();
  return limits;
}

}  // namespace glissade::design_file
