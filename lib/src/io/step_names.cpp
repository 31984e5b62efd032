#include "io/step_names.hpp"

#include "drawing/glyphs.hpp"
#include "io/utf8.hpp"

#include <charconv>
#include <cstdint>
#include <string_view>

namespace glissade::io {

std::string step_name(const ShopPart& part) {
  const std::string number = std::to_string(part.number);
  return (number.size() < 2 ? "0" : "") + number + " " + part.name;
}

std::string step_string(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr char32_t kLargest = 0xFFFF;  // of \X2\ .
  std::string quoted = "'";
  for (const char32_t character : drawing::characters_of(text)) {
    if (character < 0x20 || character == 0x7F) {
      quoted += ' ';
    } else if (character < 0x7F) {
      if (character == U'\'' || character == U'\\') quoted += static_cast<char>(character);
      quoted += static_cast<char>(character);
    } else {
      const auto code = static_cast<std::uint32_t>(character > kLargest ? 0xFFFD : character);
      quoted += "\\X2\\";
      for (unsigned shift = 16; shift > 0; shift -= 4) quoted += kDigits[(code >> (shift - 4)) & 0xFU];
      quoted += "\\X0\\";
    }
  }
  return quoted + "'";
}

std::string step_string_value(const std::string& quoted) {
  std::string text;
  for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
    if (quoted.compare(i, 4, "\\X2\\") == 0 && i + 12 < quoted.size()) {
      std::uint32_t code = 0xFFFD;
      std::from_chars(quoted.data() + i + 4, quoted.data() + i + 8, code, 16);
      append_utf8(text, code);
      i += 11;
      continue;
    }
    if (quoted[i] == '\'' || quoted[i] == '\\') ++i;
    text += quoted[i];
  }
  return text;
}

}  // namespace glissade::io
