#include "design/read_limits.hpp"

#include "glissade/core/words.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "core/counted.hpp"
#include "design/read_line.hpp"
#include "design/schema_words.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

Range read_range(MapReader& map, const LimitEntry& entry, Findings& findings) {
  const auto value = map.find(entry.key);
  if (!value) return {};
  if (value->node->kind == Node::Kind::map) return read_range(*value, entry.dimension, findings);
  if (entry.fixable) {
    const auto number = as_quantity(*value, entry.dimension, findings);
    return number ? Range::fixed(*number) : Range{};
  }
  findings.add(value->node->at, value->key_path,
               {"",
                value->key + ": " + shown(value->node->scalar) +
                    " does not say whether it is the lowest or the highest",
                "", value->key + ": {highest: " + shown(value->node->scalar) + "}"});
  return {};
}

/// Beside its range a speed has the place from which its lowest value holds.
void read_speed(const Value& value, Limits& limits, Findings& findings) {
  MapReader map(value, "A speed limit", "speed: {highest: 4 m/s}", findings);
  limits.speed.lowest = map.quantity("lowest", Dimension::speed);
  limits.speed.highest = map.quantity("highest", Dimension::speed);
  limits.lowest_speed_from = map.quantity("lowest_from", Dimension::length).value_or(0.0);
  map.refuse_unknown_keys();
}

/// "none" lifts the one limit that holds where nothing is said.
std::optional<double> read_value(MapReader& map, const LimitEntry& entry, std::optional<double> unsaid,
                                 Findings& findings) {
  const auto value = map.find(entry.key);
  if (!value) return unsaid;
  if (unsaid && is_word(*value, "none", findings)) return {};
  const auto number = as_quantity(*value, entry.dimension, findings);
  return number ? number : unsaid;
}

BeltMatch read_match(const Value& value, Findings& findings) {
  MapReader map(value, "A belt to match", "{speed: 2.5 m/s, within: 10 %}", findings);
  map.expect({"speed", "direction", "within"});
  BeltMatch match;
  match.speed = map.needed_quantity("speed", Dimension::speed, "speed: 2.5 m/s").value_or(1.0);
  match.direction = Angle::from_radians(map.quantity("direction", Dimension::angle).value_or(0.0));
  match.within = map.quantity("within", Dimension::number).value_or(match.within);
  map.refuse_unknown_keys();
  return match;
}

void read_numbers(MapReader& map, Limits& limits, Findings& findings) {
  // One key for both radii, before its parts are asked for.
  const auto both = map.quantity("smallest_radius", Dimension::length);
  limits.smallest_valley_radius = both;
  limits.smallest_crest_radius = both;
  for (const LimitEntry& entry : limit_catalogue()) {
    if (entry.id == LimitId::speed) {
      const auto value = map.find(entry.key);
      if (value && value->node->kind == Node::Kind::map) {
        read_speed(*value, limits, findings);
        continue;
      }
    }
    if (entry.range != nullptr) limits.*entry.range = read_range(map, entry, findings);
    if (entry.value != nullptr) {
      limits.*entry.value = read_value(map, entry, limits.*entry.value, findings);
    }
    if (entry.length != nullptr) {
      limits.*entry.length = map.quantity(entry.key, entry.dimension).value_or(0.0);
    }
  }
  if (const auto value = map.find("match_belt")) limits.match_belt = read_match(*value, findings);
  if (const auto value = map.find("concave")) limits.concave = as_flag(*value, findings).value_or(false);
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

std::optional<HalfPlane> read_half_plane(const Value& value, Findings& findings) {
  constexpr std::string_view kExample = "{line: [[0 m, 2 m], [5 m, 2 m]], stay: below}";
  static const Words<Side> sides = {
      {"above", Side::above}, {"below", Side::below}, {"left", Side::left}, {"right", Side::right}};
  MapReader map(value, "A half_plane", kExample, findings);
  const auto line_value = map.need("line", "line: [[0 m, 2 m], [5 m, 2 m]]");
  const auto stay_value = map.need("stay", "stay: below");
  HalfPlane plane;
  plane.clearance = read_clearance(map);
  map.refuse_unknown_keys();
  const std::vector<Vec2> line =
      line_value ? as_points(*line_value, "[[0 m, 2 m], [5 m, 2 m]]", findings, {.exactly = {2}})
                 : std::vector<Vec2>{};
  const auto stay = stay_value ? map.choice(*stay_value, sides) : std::nullopt;
  if (!stay || !line_value || line_value->node->items.size() != line.size()) return {};
  if (line.size() != 2) {
    findings.add(line_value->node->at, line_value->key_path,
                 {"", "line: " + core::counted(line.size(), "point") + " instead of 2",
                  "Two points give a straight line.", "stay_above or stay_below for a line with corners"});
    return {};
  }
  if (line[0] == line[1]) {
    findings.add(line_value->node->at, line_value->key_path,
                 {"", "line: its two points are one",
                  "Two points that differ give a straight line, as long as it likes.",
                  "line: [[0 m, 2 m], [5 m, 2 m]]"});
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
  plane.second = line[1];
  plane.forbidden = *forbidden;
  return plane;
}

std::optional<KeepOut> read_keep_out(const Value& value, Findings& findings) {
  static const Words<Passage> passages = {
      {"either", Passage::either}, {"above", Passage::above}, {"below", Passage::below}};
  constexpr std::string_view kOutline = "[[2 m, 3 m], [2.4 m, 3 m], [2.4 m, 3.4 m], [2 m, 3.4 m]]";
  MapReader map(value, "A keep_out", "{outline: [[2 m, 3 m], [2.4 m, 3 m], [2 m, 3.4 m]], clearance: 50 mm}",
                findings);
  KeepOut keep_out;
  if (const auto outline = map.need("outline", kOutline)) {
    keep_out.outline = as_points(*outline, kOutline, findings, {.least = 3});
  }
  keep_out.clearance = read_clearance(map);
  if (const auto pass = map.find("pass")) {
    keep_out.passage = map.choice(*pass, passages).value_or(Passage::either);
  }
  map.refuse_unknown_keys();
  return keep_out;
}

/// Lines of ground or of roofs; each keeps its place, as in read_list().
std::vector<Profile> read_lines(MapReader& map, std::string_view key, std::string_view example,
                                const std::filesystem::path& directory, Findings& findings) {
  std::vector<Profile> lines;
  const auto value = map.find(key);
  if (!value) return lines;
  for (const Value& item : as_list(*value, example, findings)) {
    lines.push_back(read_line(item, directory, findings).value_or(Profile{}));
  }
  return lines;
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

void read_clearances(MapReader& map, Limits& limits, const std::filesystem::path& directory,
                     Findings& findings) {
  static const Words<ClearancesFrom> origins = {{"solid", ClearancesFrom::solid},
                                                {"centerline", ClearancesFrom::centerline}};
  if (const auto from = map.find("clearances_from")) {
    limits.clearances_from = map.choice(*from, origins).value_or(ClearancesFrom::solid);
  }
  limits.envelope.headroom = map.quantity("headroom", Dimension::length).value_or(0.0);
  limits.half_planes = read_list(map, "half_planes", "[{line: [[0 m, 2 m], [5 m, 2 m]], stay: below}]",
                                 &read_half_plane, findings);
  limits.keep_outs = read_list(map, "keep_outs", "[{outline: [[2 m, 3 m], [2.4 m, 3 m], [2 m, 3.4 m]]}]",
                               &read_keep_out, findings);
  limits.stay_above =
      read_lines(map, "stay_above", "[{line: [[0 m, 1 m], [5 m, 0.5 m]]}]", directory, findings);
  limits.stay_below =
      read_lines(map, "stay_below", "[{line: [[0 m, 7 m], [5 m, 4 m]]}]", directory, findings);
  if (const auto waypoints = map.find("waypoints")) {
    limits.waypoints = as_points(*waypoints, "[[2 m, 3.5 m]]", findings);
  }
}

void read_objective(MapReader& limits_map, Objective& objective, Findings& findings) {
  static const Words<ObjectiveKind> kinds = {{"travel_time", ObjectiveKind::travel_time},
                                             {"exit_speed", ObjectiveKind::exit_speed},
                                             {"least_wear", ObjectiveKind::least_wear},
                                             {"least_peak_wear", ObjectiveKind::least_peak_wear},
                                             {"even_speed", ObjectiveKind::even_speed},
                                             {"least_drop", ObjectiveKind::least_drop},
                                             {"least_length", ObjectiveKind::least_length},
                                             {"least_load", ObjectiveKind::least_load},
                                             {"least_curvature_rate", ObjectiveKind::least_curvature_rate},
                                             {"blend", ObjectiveKind::blend}};
  const auto value = limits_map.find("objective");
  if (!value) return;
  if (value->node->kind == Node::Kind::scalar) {
    objective.kind = limits_map.choice(*value, kinds).value_or(ObjectiveKind::travel_time);
    if (objective.kind != ObjectiveKind::blend) return;
    findings.add(
        value->node->at, value->key_path,
        {"", "objective: blend has no weight", "It says how much time a unit of exit speed is worth.",
         "{kind: blend, exit_speed_weight: 0.1 s/(m/s)}"});
    return;
  }
  MapReader map(*value, "An objective", "travel_time", findings);
  const auto word = map.need("kind", "kind: travel_time");
  const auto kind = word ? map.choice(*word, kinds) : std::nullopt;
  objective.kind = kind.value_or(ObjectiveKind::travel_time);
  if (objective.kind == ObjectiveKind::blend) {
    objective.exit_speed_weight =
        map.needed_quantity("exit_speed_weight", Dimension::time_per_speed, "exit_speed_weight: 0.1 s/(m/s)")
            .value_or(0.0);
  }
  map.add_stranger("exit_speed_weight", "kind: blend, which has exit_speed_weight");
  if (const auto worst = map.find("worst_case"))
    objective.worst_case = as_flag(*worst, findings).value_or(false);
  // Of which kind its keys are is not known where that cannot be read.
  if (kind || !word) map.refuse_unknown_keys();
}

}  // namespace

Range read_range(const Value& value, Dimension dimension, Findings& findings) {
  MapReader map(value, "A range", "{lowest: ..., highest: ...}", findings);
  Range range;
  range.lowest = map.quantity("lowest", dimension);
  range.highest = map.quantity("highest", dimension);
  map.refuse_unknown_keys();
  return range;
}

void read_limits(MapReader& top, Design& design, Findings& findings) {
  const std::optional<Value> value = top.find("limits");
  if (!value) return;
  MapReader map(*value, "A group of limits", "{slope_angle: {highest: 35 deg}}", findings);
  Limits& limits = design.limits.emplace();
  read_numbers(map, limits, findings);
  read_clearances(map, limits, design.file.parent_path(), findings);
  read_objective(map, design.objective, findings);
  map.refuse_unknown_keys();
}

}  // namespace glissade::design_file
