#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::io {

/// @param what   for messages: "the profile"
/// @throws FileError if the file cannot be read or is larger than `largest` bytes
[[nodiscard]] std::string read_csv_text(const std::filesystem::path& file, std::string_view what,
                                        std::size_t largest);

/// @return the cells of a line without the blanks and quotes around them; they point into it. What begins with a
///   quote goes on to the next one, whatever separators stand between
[[nodiscard]] std::vector<std::string_view> csv_cells(std::string_view line, char separator);

/// @return the names of the first line; empty ones at its end, as a separator there leaves them, name no column
[[nodiscard]] std::vector<std::string_view> csv_names(std::string_view line, char separator);

/// The cells of a line below the one that names the columns. It may have fewer cells than there are names; empty ones at its
/// end do not count.
/// @param file,number  of the line, for messages
/// @throws FileError if it has more: of a number with a decimal comma a file parted by commas makes two
[[nodiscard]] std::vector<std::string_view> csv_row(std::string_view line, char separator,
                                                    std::size_t columns, const std::filesystem::path& file,
                                                    std::size_t number);

/// @throws FileError always
[[noreturn]] void refuse_name_twice(std::string_view column, const std::filesystem::path& file,
                                    std::size_t number);

/// @param file,number  of the line that names the columns, for messages
/// @throws FileError if the column's name stands there more than once
template <typename Names>
void require_named_once(const Names& names, std::string_view column, const std::filesystem::path& file,
                        std::size_t number) {
  if (std::count(names.begin(), names.end(), column) > 1) refuse_name_twice(column, file, number);
}

/// @return what parts the cells of a file with this first line
[[nodiscard]] char csv_separator(std::string_view header);

/// Lines with content, one after the other.
class CsvLines {
 public:
  explicit CsvLines(std::string_view text) : rest_(text) {}

  [[nodiscard]] std::optional<std::string_view> next();
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

}  // namespace glissade::io
