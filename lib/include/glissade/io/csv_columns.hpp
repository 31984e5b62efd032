#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// A file of comma-separated values, by the names of its columns.
///
/// The first line names the columns; values are parted by commas, semicolons or tabs, whichever that line has, and
/// may stand in double quotes. Decimals have a point. Empty lines and lines that begin with # are skipped.
class CsvColumns {
 public:
  /// @param what  for messages: "the survey"
  /// @throws FileError if the file cannot be read, is larger than kLargestCsvFile or empty, or if a line has more cells than
  ///         the first one has names (empty ones at its end apart)
  [[nodiscard]] static CsvColumns read(const std::filesystem::path& file, std::string_view what);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  [[nodiscard]] std::size_t rows() const noexcept { return cells_.size(); }
  /// @throws FileError, as all that follow, if two columns have that name
  [[nodiscard]] bool has(std::string_view column) const;
  /// @return "survey.csv:14": where a row stands
  [[nodiscard]] std::string place(std::size_t row) const;
  /// A column that there must be.
  struct Required {
    std::string_view column;
    std::string_view hint;
  };
  /// @throws FileError if any of them is not there (names all of these, and those that there are)
  void require(const std::vector<Required>& columns) const;
  /// Columns that may be left out and are misspelt would be passed over.
  /// @param known  all columns that are read
  /// @throws FileError if a column is none of them and named nearly as one that is not there: `before_egde_m`, `Y`
  void require_spelt(const std::vector<std::string_view>& known) const;
  /// @return the text of a cell; empty where the row is too short or there is no such column
  [[nodiscard]] std::string text(std::size_t row, std::string_view column) const;
  /// @return the finite number in a cell
  /// @throws FileError with line and column if it is none
  [[nodiscard]] double number(std::size_t row, std::string_view column) const;

 private:
  [[nodiscard]] std::size_t index_of(std::string_view column) const;

  std::filesystem::path file_;
  std::size_t header_line_ = 1;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::size_t> lines_;
};

/// [bytes]
inline constexpr std::size_t kLargestCsvFile = std::size_t{64} << 20U;

}  // namespace glissade
