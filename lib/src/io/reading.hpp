#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "io/text_scanner.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::io {

/// What the readers of all mesh formats share: the bytes, whose they are, and how to say where something is
/// wrong.
class Reading {
 public:
  /// @param name  of the file, for messages
  Reading(ByteSource& source, std::string name, LengthUnit unit);

  [[nodiscard]] TextScanner& text() { return text_; }
  [[nodiscard]] const TextScanner& text() const { return text_; }
  [[nodiscard]] double per_metre() const { return per_metre_; }

  /// @return an error about the whole file
  [[nodiscard]] FileError error(std::string what, std::string why = {}, std::string hint = {}) const;
  /// @return an error about a part of it: "facet 12"
  [[nodiscard]] FileError error_in(const std::string& part, std::string what) const;
  /// @return an error about a part of it that has just been scanned, with its line
  [[nodiscard]] FileError error_at_line(const std::string& part, std::string what, std::string why = {},
                                        std::string hint = {}) const;
  /// @return an error about a word that is not what is due, or that is missing at the end of the file
  [[nodiscard]] FileError unexpected(const std::string& part, std::string_view word,
                                     const std::string& due) const;

 private:
  TextScanner text_;
  std::string name_;
  double per_metre_;
};

/// @return a word of a file as it can stand in a message: printable and short
[[nodiscard]] std::string in_quotes(std::string_view word);

/// @param lower  in lower case
[[nodiscard]] bool equals_ignoring_case(std::string_view word, std::string_view lower);

/// @throws FileError if there are more than 32 bits can number
void require_countable(const Reading& reading, std::uint64_t vertices, std::uint64_t facets);

/// @return why `word` is no coordinate, as an error
[[nodiscard]] FileError bad_coordinate(const Reading& reading, const std::string& part,
                                       std::string_view word);

/// @return the coordinate in metres, finite and at most kLargestMeshCoordinate; none if `word` is no such
/// number
[[nodiscard]] std::optional<double> parse_coordinate(std::string_view word, double per_metre);

/// @param part  says what is being read; a function, since only errors need the text
template <typename Part>
[[nodiscard]] Vec3 read_position(Reading& reading, const Part& part) {
  const auto read = [&reading, &part] {
    const std::string_view word = reading.text().word();
    const std::optional<double> coordinate = parse_coordinate(word, reading.per_metre());
    if (!coordinate) throw bad_coordinate(reading, part(), word);
    return *coordinate;
  };
  const double x = read();
  const double y = read();
  const double z = read();
  return {x, y, z};
}

}  // namespace glissade::io
