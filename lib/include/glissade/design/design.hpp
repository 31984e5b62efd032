#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

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
  Vec3 start;   ///< [m], z up
  Vec3 finish;  ///< [m]; below the start
};

struct BodyDesign {
  Friction friction;
  double entry_speed = 0.0;     ///< [m/s]; >= 0
  double drag_per_metre = 0.0;  ///< [1/m]; >= 0
};

enum class CenterlineKind { fastest, constant_speed, straight, cycloid, no_curvature_load, segments, points };

/// One piece of a `segments` centerline; curvature is linear in between.
struct SegmentDesign {
  double length = 0.0;           ///< [m]; > 0
  double entry_curvature = 0.0;  ///< [1/m]
  double exit_curvature = 0.0;   ///< [1/m]
};

struct CenterlineDesign {
  CenterlineKind kind = CenterlineKind::fastest;
  std::optional<double> constant_speed_p;  ///< P of the constant-speed track [m^2/s^2]; none: the fastest P
  Angle entry_slope_angle;                 ///< of `segments`
  std::vector<SegmentDesign> segments;
  std::filesystem::path points_file;  ///< CSV of a measured profile, for `points`
};

enum class CrossSectionKind { slab, u_channel, trapezoid, half_pipe, pipe, polygon };

/// Inside measures [m]; which of them count is said in docs/design-file.md and cross_section.hpp.
struct CrossSectionDesign {
  CrossSectionKind kind = CrossSectionKind::u_channel;
  double width = 0.0;
  double wall_height = 0.0;
  double thickness = 0.0;
  Angle wall_angle;          ///< of `trapezoid`, from upright
  double curb_height = 0.0;  ///< of `slab`
  double curb_width = 0.0;
  std::vector<Vec2> outline;  ///< of `polygon`
};

struct MeshDesign {
  double tolerance = 0.5e-3;  ///< [m]; > 0
};

enum class ExportFormat { stl, stl_ascii, off, scad, csv };
enum class LengthUnit { millimetre, metre };

struct ExportDesign {
  std::vector<ExportFormat> formats;
  LengthUnit unit = LengthUnit::millimetre;
};

struct Design {
  std::string name;
  TrackDesign track;
  BodyDesign body;
  double gravity = kDefaultGravity;  ///< [m/s^2]; > 0
  CenterlineDesign centerline;
  std::optional<CrossSectionDesign> cross_section;
  MeshDesign mesh;
  ExportDesign exports;

  /// The file that this was read from; empty if it was not.
  std::filesystem::path file;
  /// Where each key stood, by its path, e.g. {"body.friction_angle", "chute.yaml:7:19"}.
  std::map<std::string, std::string, std::less<>> locations;

  /// @return the location of `key_path`, of its nearest parent that has one, or the file's name
  [[nodiscard]] std::string where(std::string_view key_path) const;
};

/// A value that replaces one of the file's, as `--set body.friction_angle=19deg` gives it.
struct Override {
  std::string key_path;
  std::string value;
};

/// Reads and checks a design file.
/// @throws FileError if the file cannot be read or is larger than 4 MiB
/// @throws InputError with every problem of the file at once: syntax, unknown or missing keys, units, bounds
[[nodiscard]] Design read_design(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides = {});

/// The same from text; `file` names it in messages and is the base of relative paths in it.
[[nodiscard]] Design parse_design(std::string_view text, const std::filesystem::path& file,
                                  const std::vector<Override>& overrides = {});

/// Checks that need more than one value, and those of a design that was not read from a file.
/// @return every problem; empty if the design can be built
[[nodiscard]] std::vector<Issue> check(const Design& design);

}  // namespace glissade
