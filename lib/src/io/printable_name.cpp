#include "io/printable_name.hpp"

#include <cstdint>

namespace glissade::io {
namespace {

unsigned byte_at(std::string_view text, std::size_t place) {
  return place < text.size() ? static_cast<unsigned char>(text[place]) : 0U;
}

bool continues(unsigned byte) {
  return (byte & 0xC0U) == 0x80U;
}

/// @return bytes of the printable UTF-8 character that starts at `place`; 0 if none does
std::size_t character_length(std::string_view text, std::size_t place) {
  const unsigned first = byte_at(text, place);
  const unsigned second = byte_at(text, place + 1);
  if (first < 0x80U) return first >= 0x20U && first != 0x7FU ? 1 : 0;
  if (!continues(second)) return 0;
  // U+0080 to U+009F are control characters too; longer spellings of short characters are not UTF-8.
  if (first >= 0xC2U && first <= 0xDFU) return first == 0xC2U && second < 0xA0U ? 0 : 2;
  if (!continues(byte_at(text, place + 2))) return 0;
  if (first >= 0xE0U && first <= 0xEFU) {
    const bool is_overlong = first == 0xE0U && second < 0xA0U;
    const bool is_surrogate = first == 0xEDU && second >= 0xA0U;
    // U+2028 and U+2029 end a line for some readers.
    const bool is_line_end = first == 0xE2U && second == 0x80U && (byte_at(text, place + 2) & 0xFEU) == 0xA8U;
    return is_overlong || is_surrogate || is_line_end ? 0 : 3;
  }
  if (!continues(byte_at(text, place + 3))) return 0;
  const bool is_overlong = first == 0xF0U && second < 0x90U;
  const bool is_beyond = first == 0xF4U && second >= 0x90U;
  return first >= 0xF0U && first <= 0xF4U && !is_overlong && !is_beyond ? 4 : 0;
}

}  // namespace

std::string printable_name(std::string_view name, std::size_t most_bytes) {
  std::string text;
  for (std::size_t place = 0; place < name.size();) {
    const std::size_t length = character_length(name, place);
    const std::string_view character = length == 0 ? std::string_view(" ") : name.substr(place, length);
    if (text.size() + character.size() > most_bytes) break;
    text += character;
    place += length == 0 ? 1 : length;
  }
  return text;
}

}  // namespace glissade::io
