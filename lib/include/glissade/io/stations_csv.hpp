#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/friction_level.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/motion/motion.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// What is known of one station of a track.
struct StationRow {
  CenterlinePoint point;
  Vec3 position;                      ///< of the point in space [m]
  std::optional<MotionState> motion;  ///< of the body there; none where it does not come
};

/// What the law of a body says beside its motion, at every station: how deep a stream is, what friction a ball needs.
struct StationColumn {
  std::string name;                           ///< with its unit at the end: "burden_depth_m"
  std::vector<std::optional<double>> values;  ///< one a row; none where the body does not come
};

/// The body at every station at one end of a friction range.
struct StationRange {
  FrictionLevel level = FrictionLevel::low;
  std::vector<std::optional<MotionState>> states;  ///< one a row; none where it does not come
  std::vector<StationColumn> law = {};             ///< as of the table
};

/// A track by stations.
struct StationTable {
  std::vector<StationRow> rows;
  std::vector<StationRange> range;      ///< of a design with a friction range
  std::vector<StationColumn> law = {};  ///< of a body that is not a sliding point
};

/// Writes stations as comma-separated values: one line of names with their units, then a line a station.
///
/// Columns: arc_length_m, run_m, drop_m, x_m, y_m, z_m, slope_angle_deg, curvature_per_m, radius_m, time_s,
/// speed_m_per_s, normal_load_m_per_s2, friction_loss_j_per_kg, drag_loss_j_per_kg. Numbers are the shortest
/// decimals that read back as the same double, "inf" where unbounded (the radius of a straight); columns of a
/// missing motion are empty. What the law of the body says follows: burden_depth_m, friction_needed, ... Of a friction
/// range the columns of motion and law follow once more for each end: time_low_s, speed_low_m_per_s, ... Bytes
/// depend on the stations alone.
/// @throws InputError if a number is NaN
/// @throws FileError as AtomicFile
void write_stations_csv(const std::filesystem::path& file, const StationTable& stations);

}  // namespace glissade
