#include "design/written_text.hpp"

namespace glissade::design_file {

std::string in_quotes(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result = "\"";
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      result += {'\\', letter};
    } else if (byte < 0x20U || byte == 0x7FU) {
      result += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
    } else {
      result += letter;
    }
  }
  return result + "\"";
}

std::string length(double value) {
  return written_quantity(value, Dimension::length);
}

std::string point(Vec2 at) {
  return "[" + length(at.x) + ", " + length(at.y) + "]";
}

}  // namespace glissade::design_file
