#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/design/design.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace glissade {

/// Which numbers of a profile's file count, and in what unit.
struct ProfileCsvOptions {
  std::string distance_column = "x";  ///< name of the column of horizontal distance
  std::string height_column = "z";    ///< name of the column of height, positive up
  LengthUnit unit = LengthUnit::metre;
};

/// Reads a measured profile from comma-separated values.
///
/// The first line names the columns; values are parted by commas, semicolons or tabs, whichever that line
/// has, and may stand in double quotes. Decimals have a point. Empty lines and lines that begin with # are
/// skipped, other columns too.
/// @return (distance, drop) of each line [m], in the file's order; drop = -height, positive DOWN
/// @throws FileError if the file cannot be read, is larger than kLargestProfileFile, lacks a column (names
///         those that it has) or has a value that is no finite number (names line and column)
[[nodiscard]] std::vector<Vec2> read_profile_csv(const std::filesystem::path& file,
                                                 const ProfileCsvOptions& options = {});

inline constexpr std::size_t kLargestProfileFile = std::size_t{64} << 20U;

}  // namespace glissade
