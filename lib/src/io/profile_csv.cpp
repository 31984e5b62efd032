#include "glissade/io/profile_csv.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/odd_characters.hpp"

#include "io/csv_lines.hpp"
#include "io/reading.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace glissade {

using namespace io;

namespace {

std::size_t column_named(const std::vector<std::string_view>& names, const std::string& name,
                         const std::string& place) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string there;
  for (const std::string_view other : names) there += (there.empty() ? "" : ", ") + in_quotes(other);
  throw FileError({place, "there is no column " + in_quotes(name),
                   "The first line names the columns; here they are " + there + ".",
                   "columns: [x, z] in the design, with the names of your file"});
}

}  // namespace

ProfilePoints read_profile_csv(const std::filesystem::path& file, const ProfileCsvOptions& options) {
  const std::string text = read_csv_text(file, "the profile", kLargestProfileFile);
  const double scale = options.unit == LengthUnit::millimetre ? 1e-3 : 1.0;
  CsvLines lines(text);
  const auto place = [&] { return file.string() + ":" + std::to_string(lines.number()); };

  const auto header = lines.next();
  if (!header)
    throw FileError({file.string(), "the file is empty", "", "a line of names, then a line a point"});
  const char separator = csv_separator(*header);
  const std::vector<std::string_view> names = csv_cells(*header, separator);
  const std::size_t distance_column = column_named(names, options.distance_column, place());
  const std::size_t height_column = column_named(names, options.height_column, place());
  const auto further_column = [&](const std::string& name) -> std::optional<std::size_t> {
    if (name.empty()) return {};
    return column_named(names, name, place());
  };
  const std::optional<std::size_t> slope_column = further_column(options.slope_angle_column);
  const std::optional<std::size_t> curvature_column = further_column(options.curvature_column);

  const auto number = [&](std::string_view line, const std::vector<std::string_view>& cells,
                          std::size_t column, bool bounded) {
    if (column >= cells.size()) {
      throw FileError({place(), "column " + in_quotes(names[column]) + " is missing",
                       "The line has " + std::to_string(cells.size()) + " of " +
                           std::to_string(names.size()) + " columns.",
                       "a value in every line"});
    }
    const std::string_view cell = cells[column];
    const std::string here = place() + ":" + std::to_string(cell.data() - line.data() + 1);
    double read = 0.0;
    const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), read);
    const bool usable = bounded ? std::isfinite(read) : !std::isnan(read);
    if (status != std::errc() || rest != cell.data() + cell.size() || !usable) {
      const auto odd = odd_character(cell);
      throw FileError(
          {here, "column " + in_quotes(names[column]) + ": " + in_quotes(cell) + " is no number",
           odd ? "It holds " + odd->name + "." : "",
           odd ? with_plain_characters(cell) : "numbers with a decimal point and without a unit"});
    }
    return std::pair(read, here);
  };
  const auto value = [&](std::string_view line, const std::vector<std::string_view>& cells,
                         std::size_t column) {
    const auto [read, here] = number(line, cells, column, true);
    if (std::fabs(read * scale) > kLargestProfileCoordinate) {
      const std::string_view cell = cells[column];
      throw FileError({here, "column " + in_quotes(names[column]) + ": " + in_quotes(cell) + " is too large",
                       "Coordinates lie within 10000 km of the origin.", "the unit of the file"});
    }
    return read * scale;
  };
  ProfilePoints profile;
  while (const auto line = lines.next()) {
    const std::vector<std::string_view> cells = csv_cells(*line, separator);
    profile.points.push_back({value(*line, cells, distance_column), -value(*line, cells, height_column)});
    profile.lines.push_back(lines.number());
    if (slope_column) {
      const double degrees = number(*line, cells, *slope_column, true).first;
      profile.slope_angles.push_back(Angle::from_degrees(degrees).radians());
    }
    if (curvature_column) {
      profile.curvatures.push_back(number(*line, cells, *curvature_column, false).first / scale);
    }
  }
  return profile;
}

}  // namespace glissade
