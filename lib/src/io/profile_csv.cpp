#include "glissade/io/profile_csv.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/odd_characters.hpp"

#include "io/csv_lines.hpp"
#include "io/reading.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace glissade {

using namespace io;

namespace {

std::size_t column_named(const std::vector<std::string_view>& names, const std::string& name,
                         const std::filesystem::path& file, std::size_t line) {
  require_named_once(names, name, file, line);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string there;
  for (const std::string_view other : names) there += (there.empty() ? "" : ", ") + in_quotes(other);
  throw FileError({file.string() + ":" + std::to_string(line), "there is no column " + in_quotes(name),
                   "The first line names the columns; here they are " + there + ".",
                   "columns: [x, z] in the design, with the names of your file"});
}

/// @return x of y and y of x, north of east and east of north, with what follows; empty for other names
std::string other_coordinate_of(std::string_view name) {
  using Names = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Names, 5> kPairs{
      {{"x", "y"}, {"X", "Y"}, {"east", "north"}, {"East", "North"}, {"EAST", "NORTH"}}};
  for (const auto& [first, second] : kPairs) {
    if (name.starts_with(first)) return std::string(second) + std::string(name.substr(first.size()));
    if (name.starts_with(second)) return std::string(first) + std::string(name.substr(second.size()));
  }
  return {};
}

std::optional<double> finite_number(std::string_view cell) {
  double value = 0.0;
  const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = status == std::errc() && rest == cell.data() + cell.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The least and the largest of values.
struct Reach {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  void add(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  [[nodiscard]] double length() const { return highest - lowest; }
};

/// Reads the lines of one file, whose first names the columns.
class ProfileReader {
 public:
  ProfileReader(const std::filesystem::path& file, const std::string& text, const ProfileCsvOptions& options)
      : file_(file), lines_(text), scale_(options.unit == LengthUnit::millimetre ? 1e-3 : 1.0) {
    const auto header = lines_.next();
    if (!header)
      throw FileError({file.string(), "the file is empty", "", "a line of names, then a line a point"});
    separator_ = csv_separator(*header);
    names_ = csv_names(*header, separator_);
    distance_ = column_named(names_, options.distance_column, file, lines_.number());
    height_ = column_named(names_, options.height_column, file, lines_.number());
    slope_ = further_column(options.slope_angle_column);
    curvature_ = further_column(options.curvature_column);
    const auto other = std::find(names_.begin(), names_.end(), other_coordinate_of(options.distance_column));
    if (other != names_.end()) other_ = static_cast<std::size_t>(other - names_.begin());
    if (other_ == height_) other_.reset();
  }

  ProfilePoints read() {
    ProfilePoints profile;
    Reach along;
    Reach beside;
    while (const auto line = lines_.next()) {
      line_ = *line;
      cells_ = csv_row(line_, separator_, names_.size(), file_, lines_.number());
      profile.points.push_back({coordinate(distance_), -coordinate(height_)});
      profile.lines.push_back(lines_.number());
      if (slope_) profile.slope_angles.push_back(Angle::from_degrees(number(*slope_, true).value).radians());
      if (curvature_) profile.curvatures.push_back(number(*curvature_, false).value / scale_);
      if (!other_) continue;
      const auto value = *other_ < cells_.size() ? finite_number(cells_[*other_]) : std::nullopt;
      if (!value) other_.reset();
      along.add(profile.points.back().x);
      beside.add(value.value_or(0.0) * scale_);
    }
    if (other_ && !profile.points.empty()) {
      const bool has_run = std::find(names_.begin(), names_.end(), "run_m") != names_.end();
      profile.other = {std::string(names_[*other_]), beside.length(), along.length(), has_run};
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
    return column_named(names_, name, file_, lines_.number());
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
  std::optional<std::size_t> other_;
  std::string_view line_;
  std::vector<std::string_view> cells_;
};

}  // namespace

ProfilePoints read_profile_csv(const std::filesystem::path& file, const ProfileCsvOptions& options) {
  const std::string text = read_csv_text(file, "the profile", kLargestProfileFile);
  return ProfileReader(file, text, options).read();
}

std::optional<Issue> distance_fault(const ProfilePoints& profile, const ProfileCsvOptions& options) {
  if (!profile.other) return {};
  const OtherCoordinate& other = *profile.other;
  const double run = math::hypot(other.distance, other.reach);
  if (run <= (1.0 + kMostMissingRun) * other.distance) return {};
  const std::string& column = options.distance_column;
  return Issue{"", column + " is not the horizontal distance of this profile",
               "Beside " + length_text(other.distance) + " of " + column + ", " + other.column +
                   " changes by " + length_text(other.reach) + ": from end to end that is " +
                   length_text(run) + ".",
               other.has_run ? "columns: [run_m, " + options.height_column + "]"
                             : "a column of the distance along the way, summed over sqrt(dx^2 + dy^2); or "
                               "another name for " +
                                   other.column + " if it is no coordinate"};
}

}  // namespace glissade
