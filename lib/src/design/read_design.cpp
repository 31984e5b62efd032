#include "glissade/centerline/in_run.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/odd_characters.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/design.hpp"
#include "glissade/design/design_source.hpp"

#include "core/counted.hpp"
#include "design/check.hpp"
#include "design/findings.hpp"
#include "design/map_reader.hpp"
#include "design/overrides.hpp"
#include "design/read_body.hpp"
#include "design/read_cross_section.hpp"
#include "design/read_ends.hpp"
#include "design/read_fabrication.hpp"
#include "design/read_gates.hpp"
#include "design/read_in_run.hpp"
#include "design/read_limits.hpp"
#include "design/read_line.hpp"
#include "design/read_materials.hpp"
#include "design/read_probes.hpp"
#include "design/read_process.hpp"
#include "design/read_rules.hpp"
#include "design/read_segments.hpp"
#include "design/read_stream.hpp"
#include "design/read_text.hpp"
#include "design/read_tree.hpp"
#include "design/schema_words.hpp"
#include "design/yaml_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace glissade {
namespace {

using namespace design_file;

constexpr double kLongestFreeRun = 1e6;  // [m]

void read_version(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.need("glissade", "glissade: 1 as the first line");
  if (!value) return;
  if (is_word(*value, "1", findings)) return;
  const std::optional<std::string> text = as_text(*value, findings);
  if (!text) return;
  findings.add(value->node->at, value->key_path,
               {"", "glissade: " + shown(*text) + " is not a version of design files that this program reads",
                "It reads version 1.", "glissade: 1"});
}

std::string read_name(MapReader& top, Findings& findings) {
  const std::optional<Value> value = top.find("name");
  if (!value) return {};
  std::string name = as_text(*value, findings).value_or("");
  constexpr std::size_t kLongestName = 200;
  if (name.size() > kLongestName) {
    findings.add(value->node->at, value->key_path,
                 {"", "name: longer than " + std::to_string(kLongestName) + " bytes", "", "a shorter name"});
  }
  if (const auto control = control_character(name, "")) {
    findings.add(value->node->at, value->key_path,
                 {"", "name: there is " + control->name + " in it", "It heads summaries, in one line.",
                  "a name without it"});
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

bool is_free(const std::optional<Value>& value, Findings& findings) {
  return value && (is_word(*value, "free", findings) || value->node->kind == Node::Kind::map);
}

/// A coordinate that the fastest track may choose: `free`, or a range.
Range read_free_range(const Value& value, Findings& findings) {
  if (value.node->kind != Node::Kind::map) return {};
  return read_range(value, Dimension::length, findings);
}

/// A value for a free coordinate: within its range, and where the finish is easiest to reach.
double easiest_height(const TrackDesign& track) {
  if (track.free_range.lowest) return *track.free_range.lowest;
  const double run = math::hypot(track.finish.x - track.start.x, track.finish.y - track.start.y);
  return std::min(track.start.z, track.free_range.highest.value_or(track.start.z)) - run;
}

double easiest_run(const TrackDesign& track) {
  const Range& range = track.free_range;
  const double start = track.start.x;
  if (range.lowest && *range.lowest > start) return *range.lowest;
  if (range.highest && *range.highest < start) return *range.highest;
  return std::min(start + std::fabs(track.start.z - track.finish.z),
                  range.highest.value_or(start + kLongestFreeRun));
}

/// Some place within both ranges: a metre along and a metre down where they leave it open.
void place_somewhere(TrackDesign& track) {
  const auto within = [](const Range& range, double value) {
    return std::min(std::max(value, range.lowest.value_or(value)), range.highest.value_or(HUGE_VAL));
  };
  track.finish.x = within(track.free_range, track.start.x + 1.0);
  track.finish.z = within(track.free_height, track.start.z - 1.0);
}

void read_finish(const Value& value, TrackDesign& track, Findings& findings) {
  MapReader map(value, "A finish", "{x: 5.4 m, z: 1.1 m}", findings);
  const auto x = map.need("x", "x: 5.4 m");
  const auto y = map.quantity("y", Dimension::length);
  const auto z = map.need("z", "z: 1.1 m, counted upwards");
  map.refuse_unknown_keys();
  track.finish.y = y.value_or(is_free(x, findings) ? track.start.y : 0.0);
  if (is_free(x, findings) && is_free(z, findings)) {
    track.free_finish = FinishKind::anywhere;
    track.free_range = read_free_range(*x, findings);
    track.free_height = read_free_range(*z, findings);
    place_somewhere(track);
    return;
  }
  if (x && !is_free(x, findings)) track.finish.x = as_quantity(*x, Dimension::length, findings).value_or(0.0);
  if (z && !is_free(z, findings)) track.finish.z = as_quantity(*z, Dimension::length, findings).value_or(0.0);
  if (is_free(x, findings)) {
    track.free_finish = FinishKind::level;
    track.free_range = read_free_range(*x, findings);
    track.finish.x = easiest_run(track);
  }
  if (is_free(z, findings)) {
    track.free_finish = FinishKind::vertical_line;
    track.free_range = read_free_range(*z, findings);
    track.finish.z = easiest_height(track);
  }
}

/// An in-run lies where its edge or its start does, and leads in a direction that is +x if nothing else is said.
TrackDesign read_track_of_in_run(const Value& value, Findings& findings) {
  MapReader map(value, "The track of an in-run", "{edge: {x: 0 m, z: 0 m}}", findings);
  map.expect({"edge", "start", "azimuth"});
  map.add_stranger("finish", "edge, which is where an in-run ends");
  TrackDesign track;
  track.finish_given = false;
  if (const auto edge = map.find("edge")) track.edge = read_position(*edge, "An edge", findings);
  if (const auto start = map.find("start")) track.start = read_position(*start, "A start", findings);
  track.azimuth = Angle::from_radians(map.quantity("azimuth", Dimension::angle).value_or(0.0));
  if (map.readable() && map.has("edge") == map.has("start")) {
    findings.add(findings.position(value.key_path), value.key_path,
                 {"", map.has("edge") ? "track: both edge and start are given" : "track: edge is missing",
                  "An in-run is placed by its take-off edge, or by its highest start; the other follows.",
                  "edge: {x: 0 m, z: 0 m}"});
  }
  map.refuse_unknown_keys();
  track.finish = track.edge.value_or(track.start);
  track.start = track.finish;
  return track;
}

/// A coordinate of a start: `free`, or a length.
std::optional<double> read_start_coordinate(const std::optional<Value>& value, Findings& findings) {
  if (!value || is_word(*value, "free", findings)) return {};
  return as_quantity(*value, Dimension::length, findings);
}

/// The direction of an azimuth, exactly along x or y where it is meant to be: limits count x differently there.
Vec2 heading_of(const TrackDesign& track) {
  const auto snapped = [](double share) {
    constexpr double kRounding = 1e-15;
    return std::fabs(share) < kRounding ? 0.0 : share;
  };
  const double azimuth = track.azimuth.radians();
  return {snapped(math::cos(azimuth)), snapped(math::sin(azimuth))};
}

/// The start of a track to an edge where it says something: `free` both ways where it does not.
void read_start_to_edge(const std::optional<Value>& value, TrackDesign& track, Findings& findings) {
  std::optional<double> x;
  std::optional<double> z;
  track.start = track.finish;
  if (value) {
    MapReader map(*value, "A start above an edge", "{x: free, z: free}", findings);
    const auto given_x = map.need("x", "x: free");
    const auto given_y = map.quantity("y", Dimension::length);
    const auto given_z = map.need("z", "z: free, or the level of the start");
    map.refuse_unknown_keys();
    x = read_start_coordinate(given_x, findings);
    z = read_start_coordinate(given_z, findings);
    track.start.y = given_y.value_or(track.finish.y);
  }
  track.free_start = !x || !z;
  track.free_finish = x && z ? FinishKind::point
                      : x    ? FinishKind::vertical_line
                      : z    ? FinishKind::level
                             : FinishKind::anywhere;
  const double side = x ? std::fabs(*x - track.finish.x) : 1.0;
  track.start.z = z.value_or(track.finish.z + std::max(side, 1e-3));
  const double run = std::fabs(track.start.z - track.finish.z);
  if (x) {
    track.start.x = *x;
    return;
  }
  const Vec2 heading = heading_of(track);
  track.start.x = track.finish.x - run * heading.x;
  track.start.y = track.finish.y - run * heading.y;
}

/// A track that ends at a given edge, as an in-run does, and whose start the search may choose.
TrackDesign read_track_to_edge(const Value& value, Findings& findings) {
  MapReader map(value, "A track to an edge", "{edge: {x: 0 m, z: 0 m}, start: {x: free, z: free}}", findings);
  map.add_stranger("finish", "edge alone, which is where the track ends");
  TrackDesign track;
  if (const auto edge = map.find("edge")) track.edge = read_position(*edge, "An edge", findings);
  track.finish = track.edge.value_or(Vec3{});
  track.azimuth = Angle::from_radians(map.quantity("azimuth", Dimension::angle).value_or(0.0));
  read_start_to_edge(map.find("start"), track, findings);
  map.refuse_unknown_keys();
  return track;
}

/// Tells a schema that x and z of a start may be the word `free`.
void note_free_start(const Value& start, Findings& findings) {
  if (start.node->kind != Node::Kind::map) return;
  MapReader map(start, "A start", "", findings);
  for (const std::string_view key : {"x", "z"}) {
    if (const auto value = map.find(key)) static_cast<void>(is_word(*value, "free", findings));
  }
}

/// A track of which nothing is known but that some kind of centerline may ask for what it has.
/// @return none where it is not the one that most kinds ask for: from a start to a finish
std::optional<TrackDesign> read_track_of_any_kind(const Value& value, Findings& findings) {
  MapReader map(value, "A track", "{start: {x: 0 m, z: 6.2 m}, finish: {x: 5.4 m, z: 1.1 m}}", findings);
  map.expect({"start", "finish", "edge", "azimuth"});
  const auto start = map.find("start");
  const auto finish = map.find("finish");
  const auto edge = map.find("edge");
  TrackDesign track;
  if (edge) static_cast<void>(read_position(*edge, "An edge", findings));
  if (edge && start) read_start_to_edge(start, track, findings);
  if (start && !edge) track.start = read_position(*start, "A start", findings);
  if (finish) read_finish(*finish, track, findings);
  static_cast<void>(map.quantity("azimuth", Dimension::angle));
  map.refuse_unknown_keys();
  if (edge || !start || !finish) return {};
  return track;
}

/// Any track that there is nothing to say against.
TrackDesign some_track() {
  TrackDesign track;
  track.finish = {1.0, 0.0, -1.0};
  return track;
}

/// @param kind  some say themselves where they end
TrackDesign read_track(MapReader& top, CenterlineKind kind, Findings& findings) {
  TrackDesign track;
  const std::optional<Value> value =
      top.need("track", "track: {start: {x: 0 m, z: 6.2 m}, finish: {x: 5.4 m, z: 1.1 m}}");
  if (!value) return track;
  if (findings.spoiled("centerline.kind"))
    return read_track_of_any_kind(*value, findings).value_or(some_track());
  if (kind == CenterlineKind::in_run) return read_track_of_in_run(*value, findings);
  const bool finish_may_follow = is_drawn(kind);
  const bool to_edge = kind == CenterlineKind::fastest && value->node->kind == Node::Kind::map &&
                       MapReader(*value, "A track", "", findings).has("edge");
  if (to_edge) return read_track_to_edge(*value, findings);
  MapReader map(*value, "A track", "{start: {x: 0 m, z: 6.2 m}, finish: {x: 5.4 m, z: 1.1 m}}", findings);
  const auto start = map.need("start", "start: {x: 0 m, z: 6.2 m}");
  if (start) track.start = read_position(*start, "A start", findings);
  track.finish = track.start;
  track.finish_given = map.has("finish") || !finish_may_follow;
  const auto finish =
      finish_may_follow ? map.find("finish") : map.need("finish", "finish: {x: 5.4 m, z: 1.1 m}");
  if (finish) read_finish(*finish, track, findings);
  for (const std::string_view key : {"edge", "azimuth"}) {
    map.add_stranger(key, "kind: in-run or kind: fastest in the centerline, which may be placed by an edge");
  }
  map.refuse_unknown_keys();
  // A schema does not know here of which kind the centerline is, nor that an edge stands beside a start that is free.
  if (start) note_free_start(*start, findings);
  if (const auto edge = map.find("edge")) static_cast<void>(read_position(*edge, "An edge", findings));
  static_cast<void>(map.quantity("azimuth", Dimension::angle));
  return track;
}

void read_point_columns(MapReader& map, CenterlineDesign& centerline, Findings& findings) {
  const auto value = map.find("columns");
  if (!value) return;
  const std::vector<Value> columns = as_list(*value, "[x, z]", findings, {.exactly = {2, 4}});
  if (columns.size() == 2 || columns.size() == 4) {
    centerline.points_distance_column = as_text(columns[0], findings).value_or("");
    centerline.points_height_column = as_text(columns[1], findings).value_or("");
    if (columns.size() == 4) {
      centerline.points_slope_angle_column = as_text(columns[2], findings).value_or("");
      centerline.points_curvature_column = as_text(columns[3], findings).value_or("");
    }
    refuse_column_twice(*value,
                        {centerline.points_distance_column, centerline.points_height_column,
                         centerline.points_slope_angle_column, centerline.points_curvature_column},
                        findings);
  } else if (value->node->kind == Node::Kind::sequence) {
    findings.add(value->node->at, value->key_path,
                 {"", "columns: " + core::counted(columns.size(), "name") + " instead of 2 or 4",
                  "A profile needs the column of horizontal distance and that of height; one whose slope "
                  "angles and curvatures "
                  "are known has two columns more.",
                  "columns: [x, z], or columns: [run_m, z_m, slope_angle_deg, curvature_per_m]"});
  }
}

void read_points(MapReader& map, CenterlineDesign& centerline, const std::filesystem::path& design_file,
                 Findings& findings) {
  if (const auto value = map.need("file", "file: profile.csv")) {
    const std::string text = as_text(*value, findings).value_or("");
    if (!text.empty()) {
      centerline.points_file = design_file.parent_path() / text;
      findings.add_data_file({centerline.points_file, value->key_path});
    }
  }
  read_point_columns(map, centerline, findings);
  if (const auto unit = map.find("unit")) {
    centerline.points_unit = map.choice(*unit, length_unit_words()).value_or(LengthUnit::metre);
  }
  centerline.points_max_deviation = map.quantity("max_deviation", Dimension::length);
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
  for (const std::string_view key : {"file", "columns", "unit", "max_deviation"}) {
    map.add_stranger(key, "kind: points, which has file, columns, unit and max_deviation");
  }
  for (const std::string_view key : {"gamma", "alpha", "r1", "t", "e1", "e2", "es", "transition"}) {
    map.add_stranger(key, "kind: in-run, which has the letters of a ski jump's certificate");
  }
  if (*kind == CenterlineKind::constant_speed) {
    centerline.constant_speed_p = map.quantity("p", Dimension::specific_energy);
  }
  if (*kind == CenterlineKind::segments) read_segments(map, centerline, findings);
  if (*kind == CenterlineKind::in_run) read_in_run(map, centerline.in_run, findings);
  if (*kind == CenterlineKind::points) read_points(map, centerline, file, findings);
  map.refuse_unknown_keys();
  return centerline;
}

MeshDesign read_mesh(MapReader& top, Findings& findings) {
  MeshDesign mesh;
  const std::optional<Value> value = top.find("mesh");
  if (!value) return mesh;
  MapReader map(*value, "A mesh", "{tolerance: 0.5 mm}", findings);
  mesh.tolerance = map.quantity("tolerance", Dimension::length).value_or(mesh.tolerance);
  if (const auto kink = map.quantity("largest_kink", Dimension::angle))
    mesh.largest_kink = Angle::from_radians(*kink);
  map.refuse_unknown_keys();
  return mesh;
}

void read_formats(MapReader& top, const Value& list, ExportDesign& exports, Findings& findings) {
  exports.formats.clear();
  for (const Value& item : as_list(list, "[stl, off, scad]", findings, {.least = 1})) {
    if (item.node->kind == Node::Kind::scalar && item.node->scalar == "report") {
      findings.add(
          item.node->at, item.key_path,
          {"", item.key + ": the report page is no format",
           "A build writes it anyway; glissade build --no-report leaves it out.", "the list without report"});
      continue;
    }
    const auto asked = top.choice(item, export_words());
    if (!asked) continue;
    if (asked->solid) {
      exports.formats.push_back(*asked->solid);
    } else if (asked->parts) {
      exports.workshop.push_back(*asked->parts);
    } else {
      exports.whole_workshop = true;
    }
  }
}

ExportDesign read_export(MapReader& top, Findings& findings) {
  ExportDesign exports;
  const std::optional<Value> value = top.find("export");
  if (!value) return exports;
  // The solid in the usual formats, beside all files of the parts.
  if (is_word(*value, "workshop", findings)) {
    exports.whole_workshop = true;
    return exports;
  }
  if (value->node->kind != Node::Kind::map) {
    read_formats(top, *value, exports, findings);
    return exports;
  }
  MapReader map(*value, "An export", "{formats: [stl, off, scad], unit: mm}", findings);
  if (const auto formats = map.find("formats")) read_formats(map, *formats, exports, findings);
  if (const auto unit = map.find("unit")) {
    exports.unit = map.choice(*unit, length_unit_words()).value_or(exports.unit);
  }
  if (const auto frame = map.find("frame")) {
    exports.frame = map.choice(*frame, mesh_frame_words()).value_or(exports.frame);
  }
  exports.dxf_version = chosen(map, "dxf_version", exports.dxf_version, dxf_version_words());
  exports.layers = chosen(map, "layers", exports.layers, layer_words());
  exports.paper = chosen(map, "paper", exports.paper, paper_words());
  map.refuse_unknown_keys();
  return exports;
}

/// Start or finish of an in-run follow from the other.
void place_in_run(Design& design) {
  TrackDesign& track = design.track;
  const Endpoints end = InRun(design.centerline.in_run.shape()).endpoints();
  const Vec2 heading = heading_of(track);
  const Vec3 way{end.run * heading.x, end.run * heading.y, -end.drop};
  if (track.edge) {
    track.finish = *track.edge;
    track.start = track.finish - way;
  } else {
    track.finish = track.start + way;
  }
}

/// The finish of `segments` follows from them where the file leaves it out; only sound ones have one.
void complete_finish(Design& design, Findings& findings) {
  if (design.centerline.kind == CenterlineKind::in_run && findings.empty()) {
    place_in_run(design);
    for (Finding& finding : check_values(design)) findings.add_unless_spoiled(std::move(finding));
    return;
  }
  const bool follows = design.centerline.kind == CenterlineKind::segments && !design.track.finish_given;
  if (!follows || !findings.empty()) return;
  const Endpoints end = end_of_segments(design);
  design.track.finish = design.track.start + Vec3{end.run, 0.0, -end.drop};
  for (Finding& finding : check_values(design)) findings.add_unless_spoiled(std::move(finding));
}

}  // namespace

Design design_file::read_tree(const Node& root, const std::filesystem::path& file, Findings& findings) {
  Design design;
  design.file = file;
  findings.set_position("", root.at);
  MapReader top({&root, "", ""}, "A design", "glissade: 1 as the first line of a design file", findings);
  if (!top.readable()) return design;
  top.expect({"glissade",  "name",      "track",         "body",        "stream", "feed",   "hood",
              "discharge", "materials", "gravity",       "centerline",  "limits", "probes", "hill",
              "gates",     "rules",     "cross_section", "fabrication", "mesh",   "export"});
  for (const std::string_view key : body_keys()) {
    top.add_stranger(key, "two spaces before it, below body:");
  }
  for (const std::string_view key : {"start", "finish"})
    top.add_stranger(key, "two spaces before it, below track:");
  read_version(top, findings);
  design.name = read_name(top, findings);
  design.centerline = read_centerline(top, file, findings);
  design.track = read_track(top, design.centerline.kind, findings);
  design.stream = read_stream(top, findings);
  design.materials = read_materials(top, nullptr, findings);
  // Of a stream that cannot be read, nobody knows whether it names a material.
  const bool friction_may_follow = design.stream ? design.stream->material.has_value() : top.has("stream");
  design.body = read_body(top, friction_may_follow, findings);
  follow_material(design, findings);
  design.feed = read_feed(top, findings);
  design.hood = read_hood(top, findings);
  design.discharge = read_discharge(top, findings);
  design.gravity = top.quantity("gravity", Dimension::acceleration).value_or(kDefaultGravity);
  read_limits(top, design, findings);
  design.probes = read_probes(top, findings);
  design.hill = read_hill(top, findings);
  design.gates = read_gates(top, findings);
  read_rules(top, design, findings);
  design.cross_section = read_cross_section(top, findings);
  design.fabrication = read_fabrication(top, design.file.parent_path(), findings);
  design.mesh = read_mesh(top, findings);
  design.exports = read_export(top, findings);
  top.refuse_unknown_keys();
  design.locations = findings.locations();
  design.data_files = findings.data_files();
  return design;
}

namespace {

Node parse_root(std::string_view text, const Findings& findings) {
  try {
    return parse_tree(text);
  } catch (const SyntaxProblem& problem) {
    Issue issue = problem.issues().front();
    issue.where = findings.where(problem.at());
    throw InputError(std::move(issue));
  }
}

}  // namespace

struct DesignSource::Parsed {
  std::string text;
  std::filesystem::path file;
  Node root;
};

DesignSource DesignSource::parse(std::string text, std::filesystem::path file) {
  const std::vector<Override> none;
  Node root = parse_root(text, Findings(file, none));
  if (root.kind == Node::Kind::null) {
    throw InputError(
        {file.string(), "the design file is empty", "", "glissade init, which makes one to start from"});
  }
  return DesignSource(
      std::make_shared<const Parsed>(Parsed{std::move(text), std::move(file), std::move(root)}));
}

DesignSource DesignSource::read(const std::filesystem::path& file) {
  return parse(read_text(file, "the design file", "glissade init makes one"), file);
}

const std::string& DesignSource::text() const noexcept {
  return parsed_->text;
}

const std::filesystem::path& DesignSource::file() const noexcept {
  return parsed_->file;
}

Design DesignSource::with(const std::vector<Override>& overrides, ReachCheck reach) const {
  Findings findings(parsed_->file, overrides);
  Node root = parsed_->root;
  apply_overrides(root, overrides, findings);
  Design design = read_tree(root, parsed_->file, findings);
  for (Finding& finding : sure_findings(design, findings)) findings.add_unless_spoiled(std::move(finding));
  complete_finish(design, findings);
  const bool well_formed = findings.empty();
  if (reach == ReachCheck::yes) {
    if (auto unreachable = find_unreachable(design)) findings.add_unless_spoiled(*std::move(unreachable));
  }
  if (findings.empty()) return design;
  if (well_formed) throw InfeasibleError(findings.issues());
  if (findings.only_files()) throw FileError(findings.issues());
  throw InputError(findings.issues());
}

std::vector<DataFile> DesignSource::data_files(const std::vector<Override>& overrides) const {
  Findings findings(parsed_->file, overrides);
  Node root = parsed_->root;
  apply_overrides(root, overrides, findings);
  static_cast<void>(read_tree(root, parsed_->file, findings));
  return findings.data_files();
}

Design parse_design(std::string_view text, const std::filesystem::path& file,
                    const std::vector<Override>& overrides) {
  return DesignSource::parse(std::string(text), file).with(overrides);
}

Design read_design(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return DesignSource::read(file).with(overrides);
}

}  // namespace glissade
