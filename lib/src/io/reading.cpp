#include "io/reading.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "io/coordinates.hpp"
#include "io/printable_name.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::io {
namespace {

enum class NumberFault { none, not_a_number, not_finite, too_large };

struct Number {
  double value = 0.0;
  NumberFault fault = NumberFault::none;
};

Number parse_number(std::string_view word) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  double value = 0.0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure == std::errc::invalid_argument || end != digits.data() + digits.size()) {
    return {0.0, NumberFault::not_a_number};
  }
  if (failure == std::errc::result_out_of_range) {
    const bool is_tiny = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos;
    return {0.0, is_tiny ? NumberFault::none : NumberFault::too_large};
  }
  if (!std::isfinite(value)) return {0.0, NumberFault::not_finite};
  return {value, NumberFault::none};
}

}  // namespace

Reading::Reading(ByteSource& source, std::string name, LengthUnit unit)
    : text_(source), name_(std::move(name)), per_metre_(units_per_metre(unit)) {}

FileError Reading::error(std::string what, std::string why, std::string hint) const {
  return FileError({name_, std::move(what), std::move(why), std::move(hint)});
}

FileError Reading::error_in(const std::string& part, std::string what) const {
  return FileError({name_ + ", " + part, std::move(what), "", ""});
}

FileError Reading::error_at_line(const std::string& part, std::string what, std::string why,
                                 std::string hint) const {
  return FileError({name_ + ":" + std::to_string(text_.line()) + ", " + part, std::move(what), std::move(why),
                    std::move(hint)});
}

FileError Reading::unexpected(const std::string& part, std::string_view word, const std::string& due) const {
  if (word.empty()) return error_at_line(part, "the file ends where " + due + " is due", "It is truncated.");
  return error_at_line(part, in_quotes(word) + " stands where " + due + " is due");
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMostShown = 40;
  std::string text;
  text += '"';
  text += printable_name(word, kMostShown);
  if (word.size() > kMostShown) text += "...";
  text += '"';
  return text;
}

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
  return word.size() == lower.size() &&
         std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

/// @throws FileError if there are more facets than 32 bits can number the corners of
void require_countable(const Reading& reading, std::uint64_t vertices, std::uint64_t facets) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max() - 1;
  if (vertices <= kMost && facets <= kMost) return;
  throw reading.error(
      "holds " + std::to_string(vertices) + " vertices and " + std::to_string(facets) + " facets",
      "Glissade reads up to " + std::to_string(kMost) + " of each.");
}

std::optional<double> parse_coordinate(std::string_view word, double per_metre) {
  const Number number = parse_number(word);
  const double metres = number.value / per_metre + 0.0;
  if (number.fault != NumberFault::none || std::fabs(metres) > kLargestMeshCoordinate) return std::nullopt;
  return metres;
}

FileError bad_coordinate(const Reading& reading, const std::string& part, std::string_view word) {
  switch (parse_number(word).fault) {
    case NumberFault::not_a_number:
      return reading.unexpected(part, word, "a coordinate");
    case NumberFault::not_finite:
      return reading.error_at_line(part, "coordinate " + in_quotes(word) + " is not a finite number");
    default:
      return reading.error_at_line(part, "coordinate " + in_quotes(word) + " is too large",
                                   "Coordinates end at " + rounded_text(kLargestMeshCoordinate, 3) + " m.");
  }
}

}  // namespace glissade::io
