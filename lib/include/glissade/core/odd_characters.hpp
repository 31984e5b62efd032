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

/// @return `text` with every such character replaced by the plain one that it looks like: a blank, "-", a
///         quote, a letter, or nothing
[[nodiscard]] std::string with_plain_characters(std::string_view text);

/// @return `text` with every odd space or mark that cannot be seen as its number: "11<U+00A0>deg"
[[nodiscard]] std::string with_visible_characters(std::string_view text);

}  // namespace glissade
