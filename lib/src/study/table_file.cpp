#include "study/table_file.hpp"

#include "glissade/core/error.hpp"
#include "glissade/report/report.hpp"

#include "study/trimmed.hpp"

#include <cstdint>
#include <fstream>
#include <system_error>
#include <utility>

namespace glissade::study {
namespace {

constexpr std::uintmax_t kLargestTable = std::uintmax_t{256} << 20U;

bool is_blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r';
}

void require_readable(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error)
    throw FileError({file.string(), "cannot be read: " + error.message(), "", "the path of a CSV file"});
  if (size <= kLargestTable) return;
  throw FileError({file.string(), "larger than 256 MiB", "A table of points has a line a point.",
                   "several smaller ones"});
}

}  // namespace

std::string TableFile::place(std::size_t row) const {
  return file.string() + ":" + std::to_string(lines.at(row));
}

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t index = 0; index < line.size(); ++index) {
    const char letter = line[index];
    if (letter == '"') {
      // A doubled mark within marks stands for one, as spreadsheets write it.
      if (quoted && index + 1 < line.size() && line[index + 1] == '"') {
        cells.back() += '"';
        ++index;
      } else {
        quoted = !quoted;
      }
    } else if (letter == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  if (quoted) throw InputError({"", "a quotation mark is not closed", "", ""});
  for (std::string& cell : cells) {
    if (!cell.empty() && (is_blank(cell.front()) || is_blank(cell.back()))) cell = std::string(trimmed(cell));
  }
  return cells;
}

std::string as_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char letter : text) {
    if (letter == '"') cell += '"';
    cell += letter == '\n' || letter == '\r' ? ' ' : letter;
  }
  return cell + "\"";
}

TableFile read_table(const std::filesystem::path& file) {
  require_readable(file);
  TableFile table;
  table.file = file;
  table.digest = sha256_of_file(file);
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    table.lines.push_back(number);
    std::vector<std::string> cells;
    try {
      cells = cells_of(std::string(content));
    } catch (const InputError& error) {
      Issue issue = error.issues().front();
      issue.where = table.place(table.lines.size() - 1);
      throw InputError(issue);
    }
    if (table.headings.empty()) {
      table.headings = std::move(cells);
      continue;
    }
    if (cells.size() != table.headings.size()) {
      const bool more = cells.size() > table.headings.size();
      throw InputError({table.place(table.lines.size() - 1),
                        "the line has " + std::to_string(cells.size()) + " cells instead of " +
                            std::to_string(table.headings.size()),
                        std::string("Every line has a cell for each name of the first one") +
                            (more ? "; a decimal comma makes two of one number." : "."),
                        more ? "decimal points; quotes around a value that has commas" : ""});
    }
    table.rows.push_back(std::move(cells));
  }
  if (stream.bad()) throw FileError({file.string(), "cannot be read", "", ""});
  if (table.rows.empty()) {
    throw InputError({file.string(), "there are no points in it",
                      "The first line names keys, each other one is a point.",
                      "a line such as: body.friction_angle [deg], body.entry_speed [m/s]"});
  }
  return table;
}

}  // namespace glissade::study
