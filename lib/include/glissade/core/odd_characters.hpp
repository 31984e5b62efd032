#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace glissade {

/// Characters that look like a plain one, or like nothing, and come along when text is copied from a page or
/// typed on a telephone: no-break and thin spaces, zero-width marks, the minus sign U+2212 and the dashes,
/// curly quotes, full-width letters; and Cyrillic letters that look like Latin ones, in a text that has no other Cyrillic
/// letter.
struct OddCharacter {
  std::size_t offset = 0;  ///< of its first byte
  std::string name;        ///< "a no-break space (U+00A0)"
};

/// @param text  UTF-8
/// @return the first such character of `text`; none if it has none
[[nodiscard]] std::optional<OddCharacter> odd_character(std::string_view text);

/// @param text     UTF-8
/// @param allowed  those of ASCII that may be there
/// @return the first control character of `text`, which a terminal obeys and no reader sees: U+0000 to U+001F, U+007F to U+009F,
///         ends of lines and marks of direction that change what is read after them (U+2028 to U+202E, U+2066 to U+2069);
///         none if it has none
[[nodiscard]] std::optional<OddCharacter> control_character(std::string_view text,
                                                            std::string_view allowed = "\n\t");

/// @return `text` with every control character but line feeds and tabs as its number: "<U+001B>[31m"
[[nodiscard]] std::string with_controls_shown(std::string_view text);

/// @return `text` with every odd character replaced by the plain one that it looks like: a blank, "-", a
///         quote, a letter, or nothing
[[nodiscard]] std::string with_plain_characters(std::string_view text);

/// @return `text` with every odd space or mark that cannot be seen as its number: "11<U+00A0>deg"
[[nodiscard]] std::string with_visible_characters(std::string_view text);

}  // namespace glissade
