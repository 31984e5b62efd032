#include "glissade/io/csv_columns.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/nearest_word.hpp"
#include "glissade/core/odd_characters.hpp"
#include "glissade/core/words.hpp"

#include "io/csv_lines.hpp"
#include "io/reading.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace glissade {

using namespace io;

namespace {

bool same_but_for_case(std::string_view one, std::string_view other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

}  // namespace

CsvColumns CsvColumns::read(const std::filesystem::path& file, std::string_view what) {
  const std::string text = read_csv_text(file, what, kLargestCsvFile);
  CsvLines lines(text);
  const auto header = lines.next();
  if (!header)
    throw FileError({file.string(), "the file is empty", "", "a line of names, then a line a point"});
  const char separator = csv_separator(*header);
  CsvColumns columns;
  columns.file_ = file;
  columns.header_line_ = lines.number();
  for (const std::string_view name : csv_names(*header, separator)) columns.names_.emplace_back(name);
  while (const auto line = lines.next()) {
    columns.lines_.push_back(lines.number());
    const std::vector<std::string_view> cells =
        csv_row(*line, separator, columns.names_.size(), file, lines.number());
    columns.cells_.emplace_back(cells.begin(), cells.end());
  }
  return columns;
}

bool CsvColumns::has(std::string_view column) const {
  return index_of(column) < names_.size();
}

std::size_t CsvColumns::index_of(std::string_view column) const {
  require_named_once(names_, column, file_, header_line_);
  return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), column) - names_.begin());
}

std::string CsvColumns::place(std::size_t row) const {
  return file_.string() + ":" + std::to_string(lines_[row]);
}

void CsvColumns::require(const std::vector<Required>& columns) const {
  std::vector<Issue> missing;
  for (const Required& one : columns) {
    if (has(one.column)) continue;
    missing.push_back(
        {file_.string() + ":" + std::to_string(header_line_), "there is no column " + in_quotes(one.column),
         "The first line names the columns; here they are " + listed(names_) + ".", std::string(one.hint)});
  }
  if (!missing.empty()) throw FileError(std::move(missing));
}

void CsvColumns::require_spelt(const std::vector<std::string_view>& known) const {
  std::vector<std::string_view> absent;
  for (const std::string_view one : known) {
    if (!has(one)) absent.push_back(one);
  }
  std::vector<Issue> issues;
  for (const std::string& name : names_) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string meant(nearest_word(name, absent));
    // Any letter is one from any other: of these only the case is a slip.
    constexpr std::size_t kWord = 3;  // taste: letters
    if (meant.empty() || (name.size() < kWord && !same_but_for_case(name, meant))) continue;
    issues.push_back(
        {file_.string() + ":" + std::to_string(header_line_), "nobody reads a column " + in_quotes(name),
         "There is a column " + in_quotes(meant) + ".", meant + ", or a name that is less like it"});
  }
  if (!issues.empty()) throw FileError(std::move(issues));
}

std::string CsvColumns::text(std::size_t row, std::string_view column) const {
  const std::size_t index = index_of(column);
  if (index >= cells_[row].size()) return {};
  const std::string& cell = cells_[row][index];
  const auto control = control_character(cell);
  if (!control) return cell;
  throw FileError({place(row),
                   "column " + in_quotes(column) + ": there is " + control->name + " in " +
                       in_quotes(with_controls_shown(cell)),
                   "A terminal would obey it wherever the text is printed.", "the text without it"});
}

double CsvColumns::number(std::size_t row, std::string_view column) const {
  const std::string cell = text(row, column);
  double number = 0.0;
  const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (status == std::errc() && rest == cell.data() + cell.size() && std::isfinite(number)) return number;
  const auto odd = odd_character(cell);
  throw FileError({place(row), "column " + in_quotes(column) + ": " + in_quotes(cell) + " is no number",
                   odd ? "It holds " + odd->name + "." : "",
                   odd ? with_plain_characters(cell) : "numbers with a decimal point and without a unit"});
}

}  // namespace glissade
