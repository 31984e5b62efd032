#pragma once

#include "glissade/task/limits.hpp"

#include "design/map_reader.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glissade::design_file {

/// Reports a name that `columns` holds more than once: one column of the file cannot be two numbers.
void refuse_column_twice(const Value& value, const std::vector<std::string>& names, Findings& findings);

/// A line of ground or of a roof: its points in the design, or in a CSV file beside it.
/// @param directory  what a relative name of the file is taken from
[[nodiscard]] std::optional<Profile> read_line(const Value& value, const std::filesystem::path& directory,
                                               Findings& findings);

}  // namespace glissade::design_file
