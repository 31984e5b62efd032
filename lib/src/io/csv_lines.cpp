#include "io/csv_lines.hpp"

#include "glissade/core/error.hpp"

#include "io/reading.hpp"
#include "io/system_error.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace glissade::io {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return text.substr(text.size());
  text = text.substr(from, text.find_last_not_of(kBlanks) + 1 - from);
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// @return where the cell that begins at `from` ends: at a separator that no quotes enclose
std::size_t end_of_cell(std::string_view line, std::size_t from, char separator) {
  const std::size_t first = line.find_first_not_of(" \r", from);
  std::size_t inside = from;
  if (first != std::string_view::npos && line[first] == '"') {
    const std::size_t closed = line.find('"', first + 1);
    if (closed != std::string_view::npos) inside = closed;
  }
  return std::min(line.find(separator, inside), line.size());
}

}  // namespace

std::string read_csv_text(const std::filesystem::path& file, std::string_view what, std::size_t largest) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw system_error(file, "cannot read " + std::string(what), error.value());
  if (size > largest) {
    throw FileError({file.string(), "larger than " + std::to_string(largest >> 20U) + " MiB",
                     "Such a file has a line a point.", "fewer points"});
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw system_error(file, "cannot read " + std::string(what), errno);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  const std::size_t end = text.find('\r');
  const bool goes_on = text.find_first_not_of('\r', end) != std::string::npos;
  if (end != std::string::npos && goes_on && text.find('\n') == std::string::npos) {
    throw FileError({file.string() + ":1:" + std::to_string(end + 1),
                     "the line ends with a carriage return (CR) alone",
                     "Lines end with a line feed (LF), or with both; the whole file reads as one line.",
                     "to save it with line ends LF or CRLF (in Excel as CSV, not as CSV of Macintosh)"});
  }
  return text;
}

std::vector<std::string_view> csv_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = end_of_cell(line, from, separator);
    cells.push_back(trimmed(line.substr(from, to - from)));
    from = to + 1;
  }
  return cells;
}

std::vector<std::string_view> csv_names(std::string_view line, char separator) {
  std::vector<std::string_view> names = csv_cells(line, separator);
  while (names.size() > 1 && names.back().empty()) names.pop_back();
  return names;
}

std::vector<std::string_view> csv_row(std::string_view line, char separator, std::size_t columns,
                                      const std::filesystem::path& file, std::size_t number) {
  std::vector<std::string_view> cells = csv_cells(line, separator);
  while (cells.size() > columns && cells.back().empty()) cells.pop_back();
  if (cells.size() <= columns) return cells;
  const bool by_comma = separator == ',';
  throw FileError(
      {file.string() + ":" + std::to_string(number),
       "the line has " + std::to_string(cells.size()) + " cells, more than the " + std::to_string(columns) +
           " names of the first line",
       by_comma ? "Commas part the cells here: a decimal comma makes two cells of one number." : "",
       by_comma ? "decimal points (2.5 for 2,5), with commas, semicolons or tabs between the cells"
                : "a name for each cell"});
}

void refuse_name_twice(std::string_view column, const std::filesystem::path& file, std::size_t number) {
  throw FileError({file.string() + ":" + std::to_string(number),
                   "two columns are called " + in_quotes(column), "Which of them counts is not told.",
                   "another name for one of them"});
}

char csv_separator(std::string_view header) {
  for (const char separator : {';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

std::optional<std::string_view> CsvLines::next() {
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

}  // namespace glissade::io
