#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// Which numbers of a profile's file count, and in what unit.
struct ProfileCsvOptions {
  std::string distance_column = "x";  ///< name of the column of horizontal distance
  std::string height_column = "z";    ///< name of the column of height, positive up
  LengthUnit unit = LengthUnit::metre;
  /// Names of the columns of slope angle (degrees, positive downhill) and of curvature (one over the unit, positive in
  /// a valley; "inf" where it has no bound); empty: not read.
  std::string slope_angle_column = {};
  std::string curvature_column = {};
};

/// The other horizontal coordinate that stands beside a column of distance: `y_m` of `x_m`, `X` of `Y`, `Northing` of `Easting`.
struct OtherCoordinate {
  std::string column;     ///< its name
  double reach = 0.0;     ///< how far its values of the points lie apart [m]
  double distance = 0.0;  ///< the same of the column of distance [m]
  bool has_run = false;   ///< the file has `run_m`, the horizontal distance of Glissade's own stations
};

/// The points of a profile's file and where they stand in it.
struct ProfilePoints {
  std::vector<Vec2> points;  ///< (distance, drop) [m], in the file's order; drop = -height, positive DOWN
  std::vector<std::size_t> lines;    ///< of each point, counted from 1
  std::vector<double> slope_angles;  ///< [rad]; one a point if there is a column of them
  std::vector<double> curvatures;    ///< [1/m]; one a point if there is a column of them
  /// Where the file has one with a number in every line: what is read as distance may be one side of the way alone.
  std::optional<OtherCoordinate> other = {};
};

/// Reads a measured profile from comma-separated values.
///
/// The first line names the columns; values are parted by commas, semicolons or tabs, whichever that line
/// has, and may stand in double quotes. Decimals have a point. Empty lines and lines that begin with # are
/// skipped, other columns too.
/// @throws FileError if the file cannot be read, is larger than kLargestProfileFile, lacks a column (names
///         those that it has) or has a value that is no finite number or larger than
///         kLargestProfileCoordinate (names line and column)
[[nodiscard]] ProfilePoints read_profile_csv(const std::filesystem::path& file,
                                             const ProfileCsvOptions& options = {});

/// A coordinate of the site is no horizontal distance of points that lead away from its axis: their run is longer.
/// @return what is wrong with the column of distance where the other coordinate lengthens the run by more than
///         kMostMissingRun, without a place; none if nothing is
[[nodiscard]] std::optional<Issue> distance_fault(const ProfilePoints& profile,
                                                  const ProfileCsvOptions& options);

/// By so much, relatively, may a run be told too short: radii are read some three times that wrong.
inline constexpr double kMostMissingRun = 1e-3;
/// [m]
inline constexpr double kLargestProfileCoordinate = 1e7;
/// [bytes]
inline constexpr std::size_t kLargestProfileFile = std::size_t{64} << 20U;

}  // namespace glissade
