#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::study {

/// A table of comma-separated values, cells in quotation marks included.
struct TableFile {
  std::filesystem::path file;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< of the headings and then of each row, from 1
  std::string digest;              ///< SHA-256 of the file

  /// @param row  0: the headings; else the row before
  /// @return "points.csv:7"
  [[nodiscard]] std::string place(std::size_t row) const;
};

/// @throws FileError if it cannot be read or is larger than 256 MiB; InputError if it has no rows, or a row is not as long
///         as the headings
[[nodiscard]] TableFile read_table(const std::filesystem::path& file);

/// @param line  one line of a table, without its end
/// @return its cells, without blanks around them
/// @throws InputError where a quotation mark is not closed; the caller adds the place
[[nodiscard]] std::vector<std::string> cells_of(std::string_view line);

/// @return the cell as a table holds it: in quotation marks where it needs them
[[nodiscard]] std::string as_cell(std::string_view text);

}  // namespace glissade::study
