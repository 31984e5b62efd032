#pragma once

#include "glissade/centerline/drawn_track.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/file_format.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/design/body_design.hpp"
#include "glissade/design/ends_design.hpp"
#include "glissade/design/fabrication_design.hpp"
#include "glissade/design/gates_design.hpp"
#include "glissade/design/in_run_design.hpp"
#include "glissade/design/probe_design.hpp"
#include "glissade/design/rules_design.hpp"
#include "glissade/design/segment_design.hpp"
#include "glissade/design/stream_design.hpp"
#include "glissade/section/measures.hpp"
#include "glissade/task/finish.hpp"
#include "glissade/task/limits.hpp"
#include "glissade/task/objective.hpp"
#include "glissade/trades/chute/materials.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// A design file as plain values: the schema is these structs, docs/design-file.md describes them.
/// SI units and radians throughout; the file itself gives every dimensional value with its unit.

struct TrackDesign {
  Vec3 start;  ///< [m], z up
  /// [m]; below the start, unless the body enters fast enough. For `segments` without a finish in the file it
  /// is where they end, towards +x; for `points` without one it is the start, and the profile leads towards
  /// +x. Of a free coordinate it holds some value within its range.
  Vec3 finish;
  bool finish_given = true;  ///< false only for `segments` and `points` whose file leaves the finish out
  /// Of a track that is placed by its take-off edge: the finish; the start follows [m].
  std::optional<Vec3> edge = {};
  /// Of an in-run, or a start that is free, the direction that it leads in, counter-clockwise from +x seen from above.
  Angle azimuth = {};
  FinishKind free_finish = FinishKind::point;  ///< z is free on a vertical_line, x on a level, both anywhere
  Range free_range;                            ///< of the free coordinate, x or z, of x where both are [m]
  Range free_height;                           ///< of z where both are free [m]
  /// The finish is given, and what `free_finish` says is true of the start, which has no ranges; of a free
  /// coordinate it holds some value.
  bool free_start = false;

  friend bool operator==(const TrackDesign&, const TrackDesign&) = default;
};

/// How well a finish that is given must agree with the end of a drawn track, of the distance to the start.
inline constexpr double kFinishAgreement = 1e-3;

/// @param who        what ends there, e.g. "the segments"
/// @param end        where it ends: run from the start (not negative) and drop [m]
/// @param allowance  by how much it may miss the finish beyond kFinishAgreement [m]; >= 0
/// @return how a drawn track misses the finish; none if it does not
[[nodiscard]] std::optional<Issue> missed_finish(const TrackDesign& track, const std::string& who, Vec2 end,
                                                 double allowance = 0.0);

/// @param who       whose ends they are, e.g. "the points"
/// @param distance  between the ends of a drawn track [m]
/// @return that they lie less than 0.1 mm or more than 1000 km apart; none if they do not
[[nodiscard]] std::optional<Issue> ends_fault(const std::string& who, double distance);

/// @param point  (x, z) as a design file gives the points of its limits
/// @return (run, drop) in the plane of the centerline: run from the start, positive towards the finish
[[nodiscard]] Vec2 in_track_plane(const TrackDesign& track, Vec2 point);
/// @return the same of a track whose start is free, run and drop from its edge: negative runs before it, negative drops above
[[nodiscard]] Vec2 in_edge_plane(const TrackDesign& track, Vec2 point);

enum class CenterlineKind {
  fastest,
  constant_speed,
  straight,
  cycloid,
  no_curvature_load,
  segments,
  points,
  in_run
};

/// @return true for kinds that the design draws, and that say themselves where they end
[[nodiscard]] bool is_drawn(CenterlineKind kind);

/// @return the word that a design file uses, e.g. "constant-speed"
[[nodiscard]] std::string_view word(CenterlineKind kind);
/// @return the kind that the word names, none if it names none
[[nodiscard]] std::optional<CenterlineKind> centerline_kind(std::string_view word);
/// @return every kind, in the order of the enumeration
[[nodiscard]] const std::vector<CenterlineKind>& centerline_kinds();

/// Which curve, and what its kind is given by.
struct CenterlineDesign {
  CenterlineKind kind = CenterlineKind::fastest;
  std::optional<double> constant_speed_p;  ///< P of the constant-speed track [m^2/s^2]; none: the fastest P
  InRunDesign in_run;                      ///< of `in-run`
  Angle entry_slope_angle;                 ///< of `segments`
  std::vector<SegmentDesign> segments;
  /// CSV of a measured profile, for `points`; relative paths are taken from the design file's directory.
  std::filesystem::path points_file;
  /// Names of the CSV's columns of horizontal distance and of height (positive up).
  std::string points_distance_column = "x";
  std::string points_height_column = "z";
  /// Names of its columns of slope angle and curvature; empty, both of them: a curve is fitted to the places alone.
  std::string points_slope_angle_column;
  std::string points_curvature_column;
  LengthUnit points_unit = LengthUnit::metre;  ///< of the CSV's numbers
  /// The farthest that the curve of `points` may pass one by [m]; none: chosen by their noise.
  std::optional<double> points_max_deviation;

  friend bool operator==(const CenterlineDesign&, const CenterlineDesign&) = default;
};

/// What the segments of a centerline become on their track, one by one, as far as they can be drawn.
struct DrawnSegments {
  std::vector<TrackSegment> segments;
  /// What keeps the segment after these from being drawn; `key` is the key of it to point at, empty for all of it.
  struct Fault {
    std::string key;
    Issue issue;
  };
  std::optional<Fault> fault;
};

/// @param track  where the segments begin and which way they lead; their points are points of its plane
[[nodiscard]] DrawnSegments drawn_segments(const TrackDesign& track, const CenterlineDesign& centerline);

/// A cross-section by its kind and measures: one struct a kind, see section/measures.hpp.
using CrossSectionDesign = section::Measures;

/// How closely the mesh follows the solid.
struct MeshDesign {
  double tolerance = 0.5e-3;  ///< [m]; > 0
  /// The greatest angle at which facets that follow a curve meet; none: as the tolerance asks.
  std::optional<Angle> largest_kink;

  friend bool operator==(const MeshDesign&, const MeshDesign&) = default;
};

/// Where the origin of a mesh file lies; its axes are always those of the design.
enum class MeshFrame {
  local,  ///< at the start of the track: binary STL holds single precision, which is lost far from the origin
  site    ///< where the design has it
};

/// Which files are asked for, in which unit and frame.
struct ExportDesign {
  std::vector<ExportFormat> formats = {ExportFormat::stl, ExportFormat::off, ExportFormat::scad};
  LengthUnit unit = LengthUnit::millimetre;
  MeshFrame frame = MeshFrame::local;

  /// Files of the parts, where there is a `fabrication`: all that fit its process where `whole_workshop` says so or none is
  /// named.
  bool whole_workshop = false;
  std::vector<WorkshopFormat> workshop;
  DxfVersion dxf_version = DxfVersion::r2000;
  LayerPreset layers = LayerPreset::own;      ///< of patterns
  TemplatePaper paper = TemplatePaper::roll;  ///< of templates

  /// @return whether these files of the parts are written, if they fit the process
  [[nodiscard]] bool asks_for(WorkshopFormat format) const;

  friend bool operator==(const ExportDesign&, const ExportDesign&) = default;
};

/// Another file that a design names.
struct DataFile {
  std::filesystem::path file;
  std::string key_path;  ///< whose value it is: "centerline.file"
};

/// A design file: everything that is asked for, as values (docs/design-file.md).
struct Design {
  std::string name;
  TrackDesign track;
  BodyDesign body;
  std::optional<StreamDesign> stream;        ///< none: a single body
  std::optional<FeedDesign> feed;            ///< of a stream; none: body.entry_speed says how fast it enters
  std::optional<HoodDesign> hood;            ///< between feed and track; none: the feed falls on the track
  std::optional<DischargeDesign> discharge;  ///< of a stream; none: nothing takes it away
  std::vector<Material> materials;           ///< the file's own, beside those of the library
  double gravity = kDefaultGravity;          ///< [m/s^2]; > 0
  CenterlineDesign centerline;
  /// The kind `fastest` is searched for within them, others are checked. Their points are (x, z) as the file gives
  /// them: x is the design's x for a track along the x axis, otherwise the horizontal distance from the start
  /// towards the finish; in_track_plane() turns them into run and drop.
  std::optional<Limits> limits;
  Objective objective;               ///< what the search is for
  std::vector<ProbeDesign> probes;   ///< places whose speed, slope angle and load are told
  HillDesign hill;                   ///< below an in-run
  std::optional<GatesDesign> gates;  ///< from which the track is ridden, too
  RulesDesign rules;                 ///< what a trade asks of the track; verdicts, no limits of a search
  std::optional<CrossSectionDesign> cross_section;
  std::optional<FabricationDesign> fabrication;  ///< none: the solid alone is built
  MeshDesign mesh;
  ExportDesign exports;

  /// The file that this was read from; empty if it was not.
  std::filesystem::path file;
  /// Other files that it names: profiles, ground lines, sets of rules. What they hold is part of the design.
  std::vector<DataFile> data_files;
  /// Where each key stood, by its path, e.g. {"body.friction_angle", "chute.yaml:7:19"}.
  std::map<std::string, std::string, std::less<>> locations;

  /// @param key_path  names joined by dots, list items by their number: "centerline.segments.0.length"
  /// @return the location of `key_path`, of its nearest parent that has one, or the file's name; `key_path`
  ///         itself where there is neither
  [[nodiscard]] std::string where(std::string_view key_path) const;

  /// @return true if both ask for the same, wherever they were read from
  [[nodiscard]] bool asks_the_same(const Design& other) const;
};

/// A value that replaces one of the file's, as `--set body.friction_angle=19deg` gives it. The value is read
/// as YAML; a friction angle replaces the file's friction coefficient and the other way round.
struct Override {
  std::string key_path;
  std::string value;
};

/// Reads and checks a design file.
/// @throws FileError if the file cannot be read or is larger than 4 MiB, or if nothing else is wrong but that files which
/// it names (a line of terrain, a set of rules) cannot be read or are not of their format
/// @throws InputError with every problem of the file at once: syntax, unknown or missing keys, units, bounds
/// @throws InfeasibleError if nothing is wrong but that no track can reach the finish (docs/theory.md, reach
/// theorem)
[[nodiscard]] Design read_design(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides = {});

/// The same from text; `file` names it in messages and is the base of relative paths in it.
[[nodiscard]] Design parse_design(std::string_view text, const std::filesystem::path& file,
                                  const std::vector<Override>& overrides = {});

/// Checks of a design whatever it comes from: bounds of single values, and what values must be to each other.
/// @return every problem, that of reach included; empty if the design can be built
[[nodiscard]] std::vector<Issue> check(const Design& design);

/// Whether friction lets any track at all arrive (docs/theory.md, reach theorem): a start from rest needs a
/// mean slope steeper than the friction angle. `segments` and `points` are not asked: their ride tells where
/// it stalls.
/// @return the problem, none if there is none or the body enters with speed
[[nodiscard]] std::optional<Issue> check_reach(const Design& design);

}  // namespace glissade
