#pragma once

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

/// @return the cells of a line without the blanks and quotes around them; they point into it
[[nodiscard]] std::vector<std::string_view> csv_cells(std::string_view line, char separator);

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
