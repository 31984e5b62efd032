#include "glissade/core/number_text.hpp"
#include "glissade/design/design.hpp"

#include "design/check.hpp"
#include "design/findings.hpp"
#include "design/map_reader.hpp"
#include "design/overrides.hpp"
#include "design/schema_words.hpp"
#include "design/words.hpp"
#include "design/yaml_tree.hpp"

#include <cmath>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <system_error>
#include <utility>

namespace glissade {
namespace {

using namespace design_file;

constexpr std::size_t kLargestFile = std::size_t{4} << 20U;

void read_version(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.need("glissade", "glissade: 1 as the first line");
  if (!value) return;
  const std::optional<std::string> text = as_text(*value, findings);
  if (!text || *text == "1") return;
  findings.add(value->node->at, value->key_path,
               {"", "glissade: " + shown(*text) + " is not a version of design files that this program reads",
                "It reads version 1.", "glissade: 1"});
}

std::string read_name(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.find("name");
  if (!value) return {};
  const std::string name = as_text(*value, findings).value_or("");
  constexpr std::size_t kLongestName = 200;
  if (name.size() > kLongestName) {
    findings.add(value->node->at, value->key_path,
                 {"", "name: longer than " + std::to_string(kLongestName) + " bytes", "", "a shorter name"});
  }
  return name;
}

Vec3 read_position(const Value& value, std::string_view noun, Findings& findings) {
  MapReader map(value, noun, "{x: 0 m, z: 6.2 m}", findings);
  Vec3 position;
  position.x = map.needed_quantity("x", Dimension::length, "x: 0 m").value_or(0.0);
  position.y = map.quantity("y", Dimension::length).value_or(0.0);
  position.z = map.needed_quantity("z", Dimension::length, "z: 6.2 m, counted upwards").value_or(0.0);
  map.refuse_unknown_keys();
  return position;
}

/// @param finish_may_follow  the centerline itself says where it ends
TrackDesign read_track(MapReader& top, bool finish_may_follow, Findings& findings) {
  TrackDesign track;
  const std::optional<Value> value =
      top.need("track", "track: {start: {x: 0 m, z: 6.2 m}, finish: {x: 5.4 m, z: 1.1 m}}");
  if (!value) return track;
  MapReader map(*value, "A track", "{start: {x: 0 m, z: 6.2 m}, finish: {x: 5.4 m, z: 1.1 m}}", findings);
  if (const auto start = map.need("start", "start: {x: 0 m, z: 6.2 m}")) {
    track.start = read_position(*start, "A start", findings);
  }
  track.finish = track.start;
  track.finish_given = map.has("finish") || !finish_may_follow;
  const auto finish =
      finish_may_follow ? map.find("finish") : map.need("finish", "finish: {x: 5.4 m, z: 1.1 m}");
  if (finish) track.finish = read_position(*finish, "A finish", findings);
  map.refuse_unknown_keys();
  return track;
}

Friction read_friction(MapReader& map, Findings& findings) {
  const bool by_coefficient = map.has("friction_coefficient");
  if (by_coefficient && map.has("friction_angle")) {
    findings.add(findings.position(map.path_of("")), map.path_of("friction_angle"),
                 {"", "both friction_angle and friction_coefficient are given",
                  "They say the same: the coefficient is the tangent of the angle.", "one of the two"});
  }
  const auto coefficient = map.quantity("friction_coefficient", Dimension::number);
  const auto angle = by_coefficient
                         ? map.quantity("friction_angle", Dimension::angle)
                         : map.needed_quantity("friction_angle", Dimension::angle,
                                               "friction_angle: 17 deg, or friction_coefficient: 0.306");
  try {
    if (coefficient) return Friction::from_coefficient(*coefficient);
    if (angle) return Friction::from_angle(Angle::from_radians(*angle));
  } catch (const InputError& error) {
    const std::string path = map.path_of(by_coefficient ? "friction_coefficient" : "friction_angle");
    findings.add(findings.position(path), path, error.issues().front());
  }
  return {};
}

BodyDesign read_body(MapReader& top, Findings& findings) {
  BodyDesign body;
  const std::optional<Value> value = top.need("body", "body: {friction_angle: 17 deg}");
  if (!value) return body;
  MapReader map(*value, "A body", "{friction_angle: 17 deg}", findings);
  map.expect({"friction_angle", "friction_coefficient", "entry_speed", "drag"});
  body.friction = read_friction(map, findings);
  body.entry_speed = map.quantity("entry_speed", Dimension::speed).value_or(0.0);
  body.drag_per_metre = map.quantity("drag", Dimension::per_length).value_or(0.0);
  map.refuse_unknown_keys();
  return body;
}

SegmentDesign read_segment(const Value& value, Findings& findings) {
  MapReader map(value, "A segment", "{length: 2 m, radius: 5 m}", findings);
  SegmentDesign segment;
  segment.length = map.needed_quantity("length", Dimension::length, "length: 2 m").value_or(0.0);
  const bool by_radius = map.has("radius");
  const bool by_curvature = map.has("curvature");
  const bool by_ends = map.has("entry_curvature") || map.has("exit_curvature");
  const auto curvature = map.quantity("curvature", Dimension::per_length);
  const auto radius = map.quantity("radius", Dimension::length);
  const auto entry = map.quantity("entry_curvature", Dimension::per_length);
  const auto exit = map.quantity("exit_curvature", Dimension::per_length);
  if (static_cast<int>(by_radius) + static_cast<int>(by_curvature) + static_cast<int>(by_ends) > 1) {
    findings.add(findings.position(value.key_path), value.key_path,
                 {"", value.key + " is bent in more than one way",
                  "A segment is straight, has a curvature, has a radius, or has an entry_curvature and an "
                  "exit_curvature.",
                  "one of them"});
  }
  if (radius && *radius == 0.0) {
    findings.add(findings.position(map.path_of("radius")), map.path_of("radius"),
                 {"", "radius: 0 m bends without bound", "",
                  "a positive radius for a valley, a negative one for a crest"});
  } else if (radius) {
    segment.entry_curvature = segment.exit_curvature = 1.0 / *radius;
  }
  if (curvature) segment.entry_curvature = segment.exit_curvature = *curvature;
  segment.entry_curvature = entry.value_or(segment.entry_curvature);
  segment.exit_curvature = exit.value_or(segment.exit_curvature);
  map.refuse_unknown_keys();
  return segment;
}

void read_segments(MapReader& map, CenterlineDesign& centerline, Findings& findings) {
  centerline.entry_slope_angle = Angle::from_radians(
      map.needed_quantity("entry_slope_angle", Dimension::angle, "entry_slope_angle: 35 deg").value_or(0.0));
  constexpr std::string_view kExample = "[{length: 2 m}, {length: 1.5 m, radius: 3 m}]";
  const auto list = map.need("segments", kExample);
  if (!list) return;
  for (const Value& item : as_list(*list, kExample, findings)) {
    centerline.segments.push_back(read_segment(item, findings));
  }
}

void read_point_columns(MapReader& map, CenterlineDesign& centerline, Findings& findings) {
  const auto value = map.find("columns");
  if (!value) return;
  const std::vector<Value> columns = as_list(*value, "[x, z]", findings);
  if (columns.size() == 2) {
    centerline.points_distance_column = as_text(columns[0], findings).value_or("");
    centerline.points_height_column = as_text(columns[1], findings).value_or("");
  } else if (value->node->kind == Node::Kind::sequence) {
    findings.add(
        value->node->at, value->key_path,
        {"", "columns: " + std::to_string(columns.size()) + " names instead of 2",
         "A profile needs the column of horizontal distance and that of height.", "columns: [x, z]"});
  }
}

void read_points(MapReader& map, CenterlineDesign& centerline, const std::filesystem::path& design_file,
                 Findings& findings) {
  if (const auto value = map.need("file", "file: profile.csv")) {
    const std::string text = as_text(*value, findings).value_or("");
    if (!text.empty()) centerline.points_file = design_file.parent_path() / text;
  }
  read_point_columns(map, centerline, findings);
  if (const auto unit = map.find("unit")) {
    centerline.points_unit = map.choice(*unit, length_unit_words()).value_or(LengthUnit::metre);
  }
}

CenterlineDesign read_centerline(MapReader& top, const std::filesystem::path& file, Findings& findings) {
  CenterlineDesign centerline;
  const std::optional<Value> value = top.find("centerline");
  if (!value) return centerline;
  MapReader map(*value, "A centerline", "{kind: fastest}", findings);
  const auto kind_value = map.need("kind", "kind: fastest");
  const auto kind = kind_value ? map.choice(*kind_value, centerline_words()) : std::nullopt;
  if (!kind) return centerline;
  centerline.kind = *kind;
  const std::string noun = "A centerline of kind " + std::string(word(*kind));
  map.rename(noun);
  map.add_stranger("p", "kind: constant-speed, which has p");
  for (const std::string_view key : {"segments", "entry_slope_angle"}) {
    map.add_stranger(key, "kind: segments, which has entry_slope_angle and segments");
  }
  for (const std::string_view key : {"file", "columns", "unit"}) {
    map.add_stranger(key, "kind: points, which has file, columns and unit");
  }
  if (*kind == CenterlineKind::constant_speed) {
    centerline.constant_speed_p = map.quantity("p", Dimension::specific_energy);
  }
  if (*kind == CenterlineKind::segments) read_segments(map, centerline, findings);
  if (*kind == CenterlineKind::points) read_points(map, centerline, file, findings);
  map.refuse_unknown_keys();
  return centerline;
}

std::optional<Vec2> read_corner(const Value& value, Findings& findings) {
  const std::vector<Value> numbers = as_list(value, "[-200 mm, 250 mm]", findings);
  if (value.node->kind != Node::Kind::sequence) return {};
  if (numbers.size() != 2) {
    findings.add(value.node->at, value.key_path,
                 {"", value.key + " has " + std::to_string(numbers.size()) + " values instead of 2",
                  "A point is a pair.", "[-200 mm, 250 mm]"});
    return {};
  }
  const auto first = as_quantity(numbers[0], Dimension::length, findings);
  const auto second = as_quantity(numbers[1], Dimension::length, findings);
  if (!first || !second) return {};
  return Vec2{*first, *second};
}

std::vector<Vec2> read_outline(MapReader& map, Findings& findings) {
  constexpr std::string_view kExample =
      "[[-200 mm, 0 mm], [-200 mm, -5 mm], [200 mm, -5 mm], [200 mm, 0 mm], [0 mm, 0 mm]]";
  std::vector<Vec2> outline;
  const auto value = map.need("outline", kExample);
  if (!value) return outline;
  for (const Value& item : as_list(*value, kExample, findings)) {
    if (const auto corner = read_corner(item, findings)) outline.push_back(*corner);
  }
  return outline;
}

void read_measures(MapReader& map, CrossSectionDesign& section, Findings& findings) {
  const auto needed = [&](std::string_view key, std::string_view example) {
    return map.needed_quantity(key, Dimension::length, example).value_or(0.0);
  };
  const auto optional = [&](std::string_view key) {
    return map.quantity(key, Dimension::length).value_or(0.0);
  };
  constexpr std::string_view kWidth = "width: 400 mm";
  constexpr std::string_view kWall = "wall_height: 250 mm";
  switch (section.kind) {
    case CrossSectionKind::slab:
      section.width = needed("width", kWidth);
      section.curb_height = optional("curb_height");
      section.curb_width = optional("curb_width");
      break;
    case CrossSectionKind::u_channel:
      section.width = needed("width", kWidth);
      section.wall_height = needed("wall_height", kWall);
      break;
    case CrossSectionKind::trapezoid:
      section.width = needed("width", kWidth);
      section.wall_height = needed("wall_height", kWall);
      section.wall_angle = Angle::from_radians(
          map.needed_quantity("wall_angle", Dimension::angle, "wall_angle: 20 deg").value_or(0.0));
      break;
    case CrossSectionKind::half_pipe:
      section.width = needed("width", kWidth);
      section.wall_height = optional("wall_height");
      break;
    case CrossSectionKind::pipe:
      section.width = needed("inner_diameter", "inner_diameter: 150 mm");
      break;
    case CrossSectionKind::polygon:
      section.outline = read_outline(map, findings);
      return;
  }
  section.thickness = needed("thickness", "thickness: 4 mm");
}

std::optional<CrossSectionDesign> read_cross_section(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.find("cross_section");
  if (!value) return {};
  CrossSectionDesign section;
  MapReader map(*value, "A cross_section",
                "{kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}", findings);
  const auto kind_value = map.need("kind", "kind: u-channel");
  const auto kind = kind_value ? map.choice(*kind_value, cross_section_words()) : std::nullopt;
  if (!kind) return {};
  section.kind = *kind;
  const std::string noun = "A cross_section of kind " + std::string(word(*kind));
  map.rename(noun);
  map.add_stranger("inner_diameter", "kind: pipe, which has inner_diameter");
  map.add_stranger("outline", "kind: polygon, which has outline");
  map.add_stranger("wall_angle", "kind: trapezoid, which has wall_angle");
  map.add_stranger("curb_height", "kind: slab, which has curb_height and curb_width");
  map.add_stranger("curb_width", "kind: slab, which has curb_height and curb_width");
  if (*kind == CrossSectionKind::pipe) map.add_stranger("width", "inner_diameter");
  read_measures(map, section, findings);
  map.refuse_unknown_keys();
  return section;
}

MeshDesign read_mesh(MapReader& top, Findings& findings) {
  MeshDesign mesh;
  const std::optional<Value> value = top.find("mesh");
  if (!value) return mesh;
  MapReader map(*value, "A mesh", "{tolerance: 0.5 mm}", findings);
  mesh.tolerance = map.quantity("tolerance", Dimension::length).value_or(mesh.tolerance);
  map.refuse_unknown_keys();
  return mesh;
}

void read_formats(MapReader& top, const Value& list, ExportDesign& exports, Findings& findings) {
  exports.formats.clear();
  for (const Value& item : as_list(list, "[stl, off, scad]", findings)) {
    if (const auto format = top.choice(item, export_words())) exports.formats.push_back(*format);
  }
}

ExportDesign read_export(MapReader& top, Findings& findings) {
  ExportDesign exports;
  const std::optional<Value> value = top.find("export");
  if (!value) return exports;
  if (value->node->kind != Node::Kind::map) {
    read_formats(top, *value, exports, findings);
    return exports;
  }
  MapReader map(*value, "An export", "{formats: [stl, off, scad], unit: mm}", findings);
  if (const auto formats = map.find("formats")) read_formats(map, *formats, exports, findings);
  if (const auto unit = map.find("unit")) {
    exports.unit = map.choice(*unit, length_unit_words()).value_or(exports.unit);
  }
  map.refuse_unknown_keys();
  return exports;
}

/// The finish of `segments` follows from them where the file leaves it out.
void complete_finish(Design& design) {
  if (design.track.finish_given || design.centerline.kind != CenterlineKind::segments) return;
  const Vec2 end = end_of_segments(design.centerline);
  design.track.finish = design.track.start + Vec3{end.x, 0.0, end.y};
}

Design read_tree(const Node& root, const std::filesystem::path& file, Findings& findings) {
  Design design;
  design.file = file;
  findings.set_position("", root.at);
  MapReader top({&root, "", ""}, "A design", "glissade: 1 as the first line of a design file", findings);
  if (!top.readable()) return design;
  top.expect(
      {"glissade", "name", "track", "body", "gravity", "centerline", "cross_section", "mesh", "export"});
  for (const std::string_view key : {"friction_angle", "friction_coefficient", "entry_speed", "drag"}) {
    top.add_stranger(key, "two spaces before it, below body:");
  }
  for (const std::string_view key : {"start", "finish"})
    top.add_stranger(key, "two spaces before it, below track:");
  read_version(top, findings);
  design.name = read_name(top, findings);
  design.centerline = read_centerline(top, file, findings);
  const bool finish_may_follow =
      design.centerline.kind == CenterlineKind::segments || design.centerline.kind == CenterlineKind::points;
  design.track = read_track(top, finish_may_follow, findings);
  design.body = read_body(top, findings);
  design.gravity = top.quantity("gravity", Dimension::acceleration).value_or(kDefaultGravity);
  design.cross_section = read_cross_section(top, findings);
  design.mesh = read_mesh(top, findings);
  design.exports = read_export(top, findings);
  top.refuse_unknown_keys();
  complete_finish(design);
  design.locations = findings.locations();
  return design;
}

Node parse_root(std::string_view text, const Findings& findings) {
  try {
    return parse_tree(text);
  } catch (const SyntaxProblem& problem) {
    Issue issue = problem.issues().front();
    issue.where = findings.where(problem.at());
    throw InputError(std::move(issue));
  }
}

[[noreturn]] void throw_unreadable(const std::filesystem::path& file, const std::string& why,
                                   const std::string& hint) {
  throw FileError({file.string(), "cannot read the design file: " + why, "", hint});
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw_unreadable(file, "no such file", "the path of a design file; glissade init makes one");
  if (std::filesystem::is_directory(status))
    throw_unreadable(file, "it is a directory", "the path of a file in it");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw_unreadable(file, "opening it is refused", "its permissions");
  // Read at most one byte more than the limit: the size of a pipe or a device is not known before.
  std::string text(kLargestFile + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw_unreadable(file, "reading fails", "");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kLargestFile) {
    throw FileError({file.string(), "larger than 4 MiB", "A design file is a page of text.",
                     "kind: points with a CSV file for a measured profile"});
  }
  return text;
}

}  // namespace

Design parse_design(std::string_view text, const std::filesystem::path& file,
                    const std::vector<Override>& overrides) {
  Findings findings(file, overrides);
  Node root = parse_root(text, findings);
  if (root.kind == Node::Kind::null) {
    throw InputError(
        {file.string(), "the design file is empty", "", "glissade init, which makes one to start from"});
  }
  apply_overrides(root, overrides, findings);
  Design design = read_tree(root, file, findings);
  for (Finding& finding : check_values(design)) findings.add_unless_spoiled(std::move(finding));
  const bool well_formed = findings.empty();
  if (auto unreachable = find_unreachable(design)) findings.add_unless_spoiled(*std::move(unreachable));
  if (findings.empty()) return design;
  if (well_formed) throw InfeasibleError(findings.issues());
  throw InputError(findings.issues());
}

Design read_design(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_design(read_text(file), file, overrides);
}

}  // namespace glissade
