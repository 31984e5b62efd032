#include "glissade/core/nearest_word.hpp"
#include "glissade/core/odd_characters.hpp"

#include "support/catch.hpp"

using namespace glissade;

TEST_CASE("the nearest word is the one that was meant, or none") {
  CHECK(nearest_word("bild", {"build", "solve", "init"}) == "build");
  CHECK(nearest_word("--hlep", {"--help", "--html"}) == "--help");
  CHECK(nearest_word("Wall-Height", {"width", "wall_height"}) == "wall_height");
  CHECK(nearest_word("frictoin", {"friction_angle", "gravity"}) == "friction_angle");
  CHECK(nearest_word("height", {"width", "wall_height", "thickness"}) == "wall_height");
  CHECK(nearest_word("radius", {"smallest_radius", "highest_curvature"}) == "smallest_radius");
  CHECK(nearest_word("radius", {"smallest_radius", "punch_radius"}).empty());
  CHECK(nearest_word("eight", {"wall_heighten", "thickness"}).empty());
  CHECK(nearest_word("swim", {"build", "solve"}).empty());
  CHECK(nearest_word("", {"build"}).empty());
}

TEST_CASE("plain text holds no odd character, whatever its bytes") {
  for (const char* text :
       {"", "11 deg", "name: \u00e9l\u00e8ve \u4e2d\u00b0\u00b2 \u00b5m", "\xff\xc2", "\xe2\x80"}) {
    CHECK_FALSE(odd_character(text));
    CHECK(with_plain_characters(text) == text);
    CHECK(with_visible_characters(text) == text);
  }
}

TEST_CASE("an odd character is found, named, made plain and made visible") {
  const auto odd = odd_character("ab\u202fc");
  REQUIRE(odd);
  CHECK(odd->offset == 2);
  CHECK(odd->name == "a narrow no-break space (U+202F)");
  CHECK(with_plain_characters("ab\u202fc\u2060d\u2212\uff11") == "ab cd-1");
  CHECK(with_visible_characters("ab\u202fc\u22121") == "ab<U+202F>c\u22121");
}

TEST_CASE("Cyrillic letters that look like Latin ones are odd, but in words that show their alphabet") {
  CHECK(odd_character("m\u0430rble").value().name == "a Cyrillic letter (U+0430)");
  CHECK(with_plain_characters("\u0440\u0430th") == "path");
  const std::string word = "\u0448\u0438\u0440\u0438\u043d\u0430";
  CHECK_FALSE(odd_character(word));
  CHECK(with_plain_characters(word) == word);
}

TEST_CASE("text made plain has nothing odd left") {
  std::string all;
  for (unsigned code = 0x80; code < 0x10000; ++code) {
    if (code >= 0xD800 && code < 0xE000) continue;
    if (code < 0x800) {
      all += {static_cast<char>(0xC0U | code >> 6U), static_cast<char>(0x80U | (code & 0x3FU))};
    } else {
      all += {static_cast<char>(0xE0U | code >> 12U), static_cast<char>(0x80U | (code >> 6U & 0x3FU)),
              static_cast<char>(0x80U | (code & 0x3FU))};
    }
  }
  CHECK(odd_character(all));
  CHECK_FALSE(odd_character(with_plain_characters(all)));
}

TEST_CASE("control characters are found and shown by their number; what is no UTF-8 is left to others") {
  for (const char* const text : {"", "a\tb\n", "\u00e4\u00a0",
                                 "\x9b"
                                 "31m"}) {
    INFO(text);
    CHECK_FALSE(control_character(text));
    CHECK(with_controls_shown(text) == text);
  }
  CHECK(control_character("ab\x1b[1m").value().offset == 2);
  CHECK(control_character("ab\x1b[1m").value().name == "a control character (U+001B)");
  CHECK(control_character("a\nb", "").value().name == "a line break (U+000A)");
  for (const char* const text : {"a\u202egnp.b", "a\u2067b", "a\u2028b"})
    CHECK(control_character(text).value().offset == 1);
  CHECK(control_character("a\u202eb").value().name == "a control character (U+202E)");
  CHECK_FALSE(control_character("a\u200fb"));  // a mark that turns nothing but itself
  CHECK(with_controls_shown("\x7f\r\u009b\u00e4\n") == "<U+007F><U+000D><U+009B>\u00e4\n");
}
