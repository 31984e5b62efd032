#include "glissade/io/profile_csv.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/odd_characters.hpp"

#include "io/reading.hpp"
#include "io/system_error.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

namespace glissade {

using namespace io;

namespace {

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw system_error(file, "cannot read the profile", error.value());
  if (size > kLargestProfileFile) {
    throw FileError({file.string(), "larger than 64 MiB", "A profile has a line a point.", "fewer points"});
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw system_error(file, "cannot read the profile", errno);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return text.substr(text.size());
  text = text.substr(from, text.find_last_not_of(kBlanks) + 1 - from);
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = std::min(line.find(separator, from), line.size());
    cells.push_back(trimmed(line.substr(from, to - from)));
    from = to + 1;
  }
  return cells;
}

char separator_of(std::string_view header) {
  for (const char separator : {';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

/// Lines with content, one after the other.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  [[nodiscard]] std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      const std::string_view content = trimmed(line);
      if (!content.empty() && content.front() != '#') return line;
    }
    return {};
  }

  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

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
  const std::string text = read_text(file);
  const double scale = options.unit == LengthUnit::millimetre ? 1e-3 : 1.0;
  Lines lines(text);
  const auto place = [&] { return file.string() + ":" + std::to_string(lines.number()); };

  const auto header = lines.next();
  if (!header)
    throw FileError({file.string(), "the file is empty", "", "a line of names, then a line a point"});
  const char separator = separator_of(*header);
  const std::vector<std::string_view> names = cells_of(*header, separator);
  const std::size_t distance_column = column_named(names, options.distance_column, place());
  const std::size_t height_column = column_named(names, options.height_column, place());

  const auto value = [&](std::string_view line, const std::vector<std::string_view>& cells,
                         std::size_t column) {
    if (column >= cells.size()) {
      throw FileError({place(), "column " + in_quotes(names[column]) + " is missing",
                       "The line has " + std::to_string(cells.size()) + " of " +
                           std::to_string(names.size()) + " columns.",
                       "a value in every line"});
    }
    const std::string_view cell = cells[column];
    const std::string here = place() + ":" + std::to_string(cell.data() - line.data() + 1);
    double number = 0.0;
    const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (status != std::errc() || rest != cell.data() + cell.size() || !std::isfinite(number)) {
      const auto odd = odd_character(cell);
      throw FileError(
          {here, "column " + in_quotes(names[column]) + ": " + in_quotes(cell) + " is no number",
           odd ? "It holds " + odd->name + "." : "",
           odd ? with_plain_characters(cell) : "numbers with a decimal point and without a unit"});
    }
    if (std::fabs(number * scale) > kLargestProfileCoordinate) {
      throw FileError({here, "column " + in_quotes(names[column]) + ": " + in_quotes(cell) + " is too large",
                       "Coordinates lie within 10000 km of the origin.", "the unit of the file"});
    }
    return number * scale;
  };
  ProfilePoints profile;
  while (const auto line = lines.next()) {
    const std::vector<std::string_view> cells = cells_of(*line, separator);
    profile.points.push_back({value(*line, cells, distance_column), -value(*line, cells, height_column)});
    profile.lines.push_back(lines.number());
  }
  return profile;
}

}  // namespace glissade
