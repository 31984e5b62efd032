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

/// Reads the lines of one file, whose first names the columns.
class ProfileReader {
 public:
  ProfileReader(const std::filesystem::path& file, const std::string& text, const ProfileCsvOptions& options)
      : file_(file), lines_(text), scale_(options.unit == LengthUnit::millimetre ? 1e-3 : 1.0) {
    const auto header = lines_.next();
    if (!header)
      throw FileError({file.string(), "the file is empty", "", "a line of names, then a line a point"});
    separator_ = csv_separator(*header);
    names_ = csv_cells(*header, separator_);
    distance_ = column_named(names_, options.distance_column, place());
    height_ = column_named(names_, options.height_column, place());
    slope_ = further_column(options.slope_angle_column);
    curvature_ = further_column(options.curvature_column);
  }

  ProfilePoints read() {
    ProfilePoints profile;
    while (const auto line = lines_.next()) {
      line_ = *line;
      cells_ = csv_cells(line_, separator_);
      profile.points.push_back({coordinate(distance_), -coordinate(height_)});
      profile.lines.push_back(lines_.number());
      if (slope_) profile.slope_angles.push_back(Angle::from_degrees(number(*slope_, true).value).radians());
      if (curvature_) profile.curvatures.push_back(number(*curvature_, false).value / scale_);
    }
    return profile;
  }

 private:
  struct Number {
    double value = 0.0;
    std::string place;
  };

  [[nodiscard]] std::string place() const { return file_.string() + ":" + std::to_string(lines_.number()); }

  [[nodiscard]] std::optional<std::size_t> further_column(const std::string& name) const {
    if (name.empty()) return {};
    return column_named(names_, name, place());
  }

  /// @param bounded  infinity is no number
  [[nodiscard]] Number number(std::size_t column, bool bounded) const {
    if (column >= cells_.size()) {
      throw FileError({place(), "column " + in_quotes(names_[column]) + " is missing",
                       "The line has " + std::to_string(cells_.size()) + " of " +
                           std::to_string(names_.size()) + " columns.",
                       "a value in every line"});
    }
    const std::string_view cell = cells_[column];
    Number read{0.0, place() + ":" + std::to_string(cell.data() - line_.data() + 1)};
    const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), read.value);
    const bool usable = bounded ? std::isfinite(read.value) : !std::isnan(read.value);
    if (status == std::errc() && rest == cell.data() + cell.size() && usable) return read;
    const auto odd = odd_character(cell);
    throw FileError({read.place,
                     "column " + in_quotes(names_[column]) + ": " + in_quotes(cell) + " is no number",
                     odd ? "It holds " + odd->name + "." : "",
                     odd ? with_plain_characters(cell) : "numbers with a decimal point and without a unit"});
  }

  [[nodiscard]] double coordinate(std::size_t column) const {
    const Number read = number(column, true);
    if (std::fabs(read.value * scale_) <= kLargestProfileCoordinate) return read.value * scale_;
    throw FileError(
        {read.place,
         "column " + in_quotes(names_[column]) + ": " + in_quotes(cells_[column]) + " is too large",
         "Coordinates lie within 10000 km of the origin.", "the unit of the file"});
  }

  const std::filesystem::path& file_;
  CsvLines lines_;
  double scale_;
  char separator_ = ',';
  std::vector<std::string_view> names_;
  std::size_t distance_ = 0;
  std::size_t height_ = 0;
  std::optional<std::size_t> slope_;
  std::optional<std::size_t> curvature_;
  std::string_view line_;
  std::vector<std::string_view> cells_;
};

}  // namespace

ProfilePoints read_profile_csv(const std::filesystem::path& file, const ProfileCsvOptions& options) {
  const std::string text = read_csv_text(file, "the profile", kLargestProfileFile);
  return ProfileReader(file, text, options).read();
}

}  // namespace glissade
