#pragma once

#include "glissade/core/units.hpp"
#include "glissade/drawing/drawing.hpp"
#include "glissade/drawing/sheet.hpp"
#include "glissade/pipeline/solve.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// A curve parallel to the track: ice, substructure, beam, guide tube.
struct ParallelLine {
  std::string name;     ///< ASCII letters, digits, "_", "-"
  double height = 0.0;  ///< above the track, square to it [m]; below where negative
};

/// From where stations of a coordinate table are counted.
enum class CountedFrom {
  arc_length,  ///< along the track, from its start
  to_edge,     ///< along the track, back from its finish
  run          ///< horizontal, back from the finish: round metres of x where that is the origin
};

/// What stands in a coordinate table, and how closely.
struct ProfileOptions {
  /// Between stations [m]; > 0. None: 1 m on tracks of 20 m to 2 km, else 1, 2 or 5 times a power of ten that makes some
  /// hundred stations.
  std::optional<double> step = {};
  CountedFrom row = CountedFrom::arc_length;
  std::vector<ParallelLine> parallels;
};

/// One line of a coordinate table.
struct ProfileStation {
  std::string name;             ///< "A", "B", "E1", "E2", "T" where it is one of them; otherwise empty
  double arc_length = 0.0;      ///< [m]
  double to_edge = 0.0;         ///< along the track to the finish [m]
  Vec3 position;                ///< in the design's frame [m]
  Angle slope_angle;            ///< below the horizontal
  double curvature = 0.0;       ///< [1/m]; at a jump that just after it
  std::vector<Vec3> parallels;  ///< the places square above or below, in the order of the options [m]
};

/// Stations at every step and at the letters of an in-run, from the start on.
/// @throws InputError if the step is not positive or makes more than 100 000 stations, or a parallel line would turn back
///         on itself, since it lies beyond the centre of the track's curvature
[[nodiscard]] std::vector<ProfileStation> coordinate_table(const Design& design, const Track& track,
                                                           const ProfileOptions& options = {});

/// The longitudinal section at 1:1, millimetres, from start to finish, the finish at the origin: track, parallel lines, gates,
/// letters, dimensions.
[[nodiscard]] Drawing longitudinal_section(const Design& design, const Track& track,
                                           const ProfileOptions& options = {});

/// The cross-section at 1:1, millimetres, as a body sees it that looks towards the finish, the centerline at the origin: its
/// outline and the dimensions of its grooves, walls and plates.
/// @return none for a design without a cross_section
[[nodiscard]] std::optional<Drawing> cross_section_drawing(const Design& design);

/// The section, the cross-section, the parameters in English, German and French as a certificate has them, the gates and the coordinates, on
/// sheets of A3.
[[nodiscard]] std::vector<Sheet> profile_sheets(const Design& design, const Track& track,
                                                const ProfileOptions& options = {});

/// The longitudinal section as DXF, the sheets as PDF, the coordinate table as CSV, and the cross-section as DXF where the
/// design has one: all of them appear together, or none.
/// @param directory  made if missing
/// @return their paths, in this order
/// @throws InputError as coordinate_table(), FileError if a file cannot be written; what was there is then as it was
std::vector<std::filesystem::path> write_profile(const std::filesystem::path& directory, const Design& design,
                                                 const Track& track, const ProfileOptions& options = {});

/// The coordinate table as CSV, SI, every number with all its digits.
/// @throws FileError as AtomicFile
void write_coordinates_csv(const std::filesystem::path& file, const std::vector<ProfileStation>& stations,
                           const ProfileOptions& options);

}  // namespace glissade
