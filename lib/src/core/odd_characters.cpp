#include "glissade/core/odd_characters.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

namespace glissade {
namespace {

/// Code points from `first` to `last`, and what each of them stands for. Names are those of Unicode, the
/// usual words where those are longer than helpful.
struct Odd {
  std::uint32_t first;
  std::uint32_t last;
  const char* name;
  const char* plain;
  bool visible;
};

constexpr std::array kOdd = {
    Odd{0x00A0, 0x00A0, "a no-break space", " ", false},
    Odd{0x00AD, 0x00AD, "a soft hyphen", "", false},
    Odd{0x00BA, 0x00BA, "an ordinal indicator", "\u00b0", true},
    Odd{0x02DA, 0x02DA, "a ring above", "\u00b0", true},
    Odd{0x1680, 0x1680, "an ogham space", " ", false},
    Odd{0x180E, 0x180E, "a vowel separator", "", false},
    Odd{0x2000, 0x2006, "a wide space", " ", false},
    Odd{0x2007, 0x2007, "a figure space", " ", false},
    Odd{0x2008, 0x2008, "a punctuation space", " ", false},
    Odd{0x2009, 0x2009, "a thin space", " ", false},
    Odd{0x200A, 0x200A, "a hair space", " ", false},
    Odd{0x200B, 0x200D, "a zero-width mark", "", false},
    Odd{0x200E, 0x200F, "a direction mark", "", false},
    Odd{0x2010, 0x2011, "a hyphen", "-", true},
    Odd{0x2012, 0x2015, "a dash", "-", true},
    Odd{0x2018, 0x201B, "a curly quote", "'", true},
    Odd{0x201C, 0x201F, "a curly quote", "\"", true},
    Odd{0x2028, 0x2029, "a line separator", " ", false},
    Odd{0x202A, 0x202E, "a direction mark", "", false},
    Odd{0x202F, 0x202F, "a narrow no-break space", " ", false},
    Odd{0x2032, 0x2032, "a prime", "'", true},
    Odd{0x2044, 0x2044, "a fraction slash", "/", true},
    Odd{0x205F, 0x205F, "a mathematical space", " ", false},
    Odd{0x2060, 0x2064, "an invisible mark", "", false},
    Odd{0x2066, 0x2069, "a direction mark", "", false},
    Odd{0x2212, 0x2212, "a minus sign", "-", true},
    Odd{0x2215, 0x2215, "a division slash", "/", true},
    Odd{0x3000, 0x3000, "a wide space", " ", false},
    Odd{0xFE63, 0xFE63, "a small hyphen", "-", true},
    Odd{0xFEFF, 0xFEFF, "a byte order mark", "", false},
};

/// Cyrillic letters that look like a Latin one, as a keyboard writes them that was not switched back.
struct Lookalike {
  std::uint32_t letter;
  const char* plain;
};

constexpr std::array kLookalikes = {
    Lookalike{0x0405, "S"}, Lookalike{0x0406, "I"}, Lookalike{0x0408, "J"}, Lookalike{0x0410, "A"},
    Lookalike{0x0412, "B"}, Lookalike{0x0415, "E"}, Lookalike{0x041A, "K"}, Lookalike{0x041C, "M"},
    Lookalike{0x041D, "H"}, Lookalike{0x041E, "O"}, Lookalike{0x0420, "P"}, Lookalike{0x0421, "C"},
    Lookalike{0x0422, "T"}, Lookalike{0x0425, "X"}, Lookalike{0x0430, "a"}, Lookalike{0x0435, "e"},
    Lookalike{0x043A, "k"}, Lookalike{0x043C, "m"}, Lookalike{0x043E, "o"}, Lookalike{0x0440, "p"},
    Lookalike{0x0441, "c"}, Lookalike{0x0442, "t"}, Lookalike{0x0443, "y"}, Lookalike{0x0445, "x"},
    Lookalike{0x0455, "s"}, Lookalike{0x0456, "i"}, Lookalike{0x0458, "j"},
};

constexpr std::uint32_t kCyrillicFirst = 0x0400;
constexpr std::uint32_t kCyrillicLast = 0x04FF;

constexpr std::uint32_t kFullWidthFirst = 0xFF01;  // to U+FF5E: ASCII from '!' to '~', twice as wide
constexpr std::uint32_t kFullWidthLast = 0xFF5E;

struct CodePoint {
  std::uint32_t value = 0;
  std::size_t bytes = 1;
};

/// @return the code point at `offset`; a byte that begins none counts for itself
CodePoint code_point_at(std::string_view text, std::size_t offset) {
  const auto byte = [&](std::size_t index) -> std::uint32_t {
    return offset + index < text.size() ? static_cast<unsigned char>(text[offset + index]) : 0U;
  };
  const std::uint32_t lead = byte(0);
  const std::size_t bytes = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : lead >= 0xC0U ? 2 : 1;
  if (bytes == 1) return {lead, 1};
  std::uint32_t value = lead & (0xFFU >> (bytes + 1));
  for (std::size_t index = 1; index < bytes; ++index) {
    if ((byte(index) & 0xC0U) != 0x80U) return {lead, 1};
    value = value << 6U | (byte(index) & 0x3FU);
  }
  return {value, bytes};
}

std::string number_of(std::uint32_t code_point) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "U+%04X", static_cast<unsigned>(code_point));
  return text.data();
}

struct Meaning {
  std::string name;
  std::string plain;
  bool visible = true;
};

const char* latin_of(std::uint32_t code_point) {
  for (const Lookalike& known : kLookalikes) {
    if (known.letter == code_point) return known.plain;
  }
  return nullptr;
}

/// Whether a text has Cyrillic letters that look like no Latin one: it is a word of that alphabet, and seen to be.
bool is_seen_to_be_cyrillic(std::string_view text) {
  for (std::size_t offset = 0; offset < text.size();) {
    const CodePoint point = code_point_at(text, offset);
    const bool cyrillic = point.value >= kCyrillicFirst && point.value <= kCyrillicLast;
    if (point.bytes > 1 && cyrillic && !latin_of(point.value)) return true;
    offset += point.bytes;
  }
  return false;
}

/// @param letters  whether Cyrillic letters that look like Latin ones are odd
std::optional<Meaning> meaning_of(std::uint32_t code_point, bool letters) {
  if (const char* const plain = latin_of(code_point); plain && letters) {
    return Meaning{"a Cyrillic letter", plain, true};
  }
  for (const Odd& odd : kOdd) {
    if (code_point < odd.first || code_point > odd.last) continue;
    return Meaning{odd.name, odd.plain, odd.visible};
  }
  if (code_point < kFullWidthFirst || code_point > kFullWidthLast) return {};
  const char plain = static_cast<char>('!' + static_cast<int>(code_point - kFullWidthFirst));
  return Meaning{"a full-width " + std::string(1, plain), std::string(1, plain), true};
}

/// @return `text` with each odd character as `replaced` gives it
template <typename Replace>
std::string rewritten(std::string_view text, Replace&& replaced) {
  std::string result;
  const bool letters = !is_seen_to_be_cyrillic(text);
  for (std::size_t offset = 0; offset < text.size();) {
    const CodePoint point = code_point_at(text, offset);
    const std::string_view as_it_is = text.substr(offset, point.bytes);
    const auto meaning = point.bytes > 1 ? meaning_of(point.value, letters) : std::nullopt;
    result += meaning ? replaced(point.value, *meaning, as_it_is) : std::string(as_it_is);
    offset += point.bytes;
  }
  return result;
}

}  // namespace

std::optional<OddCharacter> odd_character(std::string_view text) {
  const bool letters = !is_seen_to_be_cyrillic(text);
  for (std::size_t offset = 0; offset < text.size();) {
    const CodePoint point = code_point_at(text, offset);
    if (point.bytes > 1) {
      const auto meaning = meaning_of(point.value, letters);
      if (meaning) return OddCharacter{offset, meaning->name + " (" + number_of(point.value) + ")"};
    }
    offset += point.bytes;
  }
  return {};
}

namespace {

/// What turns the direction of all that follows in a line, or ends lines for some readers: nobody sees it, either.
bool is_line_control(std::uint32_t value) {
  return (value >= 0x2028U && value <= 0x202EU) || (value >= 0x2066U && value <= 0x2069U);
}

bool is_control(const CodePoint& point, std::string_view allowed) {
  if (point.bytes == 1 && point.value >= 0x80U) return false;  // a byte that is no text
  if (is_line_control(point.value)) return true;
  const bool control = point.value < 0x20U || (point.value >= 0x7FU && point.value < 0xA0U);
  return control &&
         (point.bytes > 1 || allowed.find(static_cast<char>(point.value)) == std::string_view::npos);
}

}  // namespace

std::optional<OddCharacter> control_character(std::string_view text, std::string_view allowed) {
  for (std::size_t offset = 0; offset < text.size();) {
    const CodePoint point = code_point_at(text, offset);
    if (is_control(point, allowed)) {
      const char* const name = point.value == '\n' ? "a line break (" : "a control character (";
      return OddCharacter{offset, name + number_of(point.value) + ")"};
    }
    offset += point.bytes;
  }
  return {};
}

std::string with_controls_shown(std::string_view text) {
  std::string result;
  for (std::size_t offset = 0; offset < text.size();) {
    const CodePoint point = code_point_at(text, offset);
    result += is_control(point, "\n\t") ? "<" + number_of(point.value) + ">"
                                        : std::string(text.substr(offset, point.bytes));
    offset += point.bytes;
  }
  return result;
}

std::string with_plain_characters(std::string_view text) {
  return rewritten(text,
                   [](std::uint32_t, const Meaning& meaning, std::string_view) { return meaning.plain; });
}

std::string with_visible_characters(std::string_view text) {
  return rewritten(text, [](std::uint32_t code_point, const Meaning& meaning, std::string_view as_it_is) {
    return meaning.visible ? std::string(as_it_is) : "<" + number_of(code_point) + ">";
  });
}

}  // namespace glissade
