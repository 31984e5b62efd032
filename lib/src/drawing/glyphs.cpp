#include "drawing/glyphs.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <map>
#include <utility>

namespace glissade::drawing {
namespace {

/// Strokes by points "x,y", from pen down to pen up at ";". What leads to a point: a line; "(" and ")" a quarter turn
/// to the left and right; "<" and ">" a half turn. Drawn on a grid of 10 units to the height of a capital.
struct GlyphRow {
  char32_t character;
  double width;
  std::string_view strokes;
};

constexpr std::array kGlyphs = {
    GlyphRow{U' ', 2.0, ""},
    GlyphRow{U'!', 0.0, "0,10 0,3;0,0 0,0.6"},
    GlyphRow{U'"', 2.0, "0,10 0,8;2,10 2,8"},
    GlyphRow{U'#', 6.0, "1,0 2.5,10;3.5,0 5,10;0,3.3 5.5,3.3;0.5,6.7 6,6.7"},
    GlyphRow{U'$', 6.0, "6,7 (4,9 2,9 <2,5 4,5 >4,1 2,1 )0,3;3,10.5 3,-0.5"},
    GlyphRow{U'%', 6.0, "0,0 6,10;1.5,10 <1.5,7 <1.5,10;4.5,3 <4.5,0 <4.5,3"},
    GlyphRow{U'&', 6.5, "6.5,0 1.2,6.6 >4.8,7.5 >1,7.5 1.2,6.6;2.6,5 <2.6,0 3,0 (6.5,3.5"},
    GlyphRow{U'\'', 0.0, "0,10 0,8"},
    GlyphRow{U'(', 1.5, "1.5,11 (0,9.5 0,0.5 (1.5,-1"},
    GlyphRow{U')', 1.5, "0,11 )1.5,9.5 1.5,0.5 )0,-1"},
    GlyphRow{U'*', 4.0, "2,9 2,5;0.3,8 3.7,6;0.3,6 3.7,8"},
    GlyphRow{U'+', 5.0, "0,4.5 5,4.5;2.5,2 2.5,7"},
    GlyphRow{U',', 0.8, "0.8,0.6 0,-1.5"},
    GlyphRow{U'-', 4.0, "0,4.5 4,4.5"},
    GlyphRow{U'.', 0.8, "0,0 0.8,0 0.8,0.8 0,0.8 0,0"},
    GlyphRow{U'/', 5.0, "0,-1 5,11"},
    GlyphRow{U'0', 5.0, "5,2.5 5,7.5 <0,7.5 0,2.5 <5,2.5"},
    GlyphRow{U'1', 5.0, "1,8 3,10 3,0"},
    GlyphRow{U'2', 5.0, "0,7.5 >5,7.5 0,0 5,0"},
    GlyphRow{U'3', 5.0, "0,10 5,10 2,6 >2,0 )0,2"},
    GlyphRow{U'4', 5.5, "4,0 4,10 0,3 5.5,3"},
    GlyphRow{U'5', 5.0, "5,10 0,10 0,6 2,6 >2,0 )0,2"},
    GlyphRow{U'6', 5.0, "4.5,10 (0,5.5 0,2.5 <5,2.5 5,3 <0,3"},
    GlyphRow{U'7', 5.0, "0,10 5,10 1.5,0"},
    GlyphRow{U'8', 5.2, "2.6,10 <2.6,5.5 <2.6,10;2.6,5.5 <2.6,0 <2.6,5.5"},
    GlyphRow{U'9', 5.0, "0.5,0 (5,4.5 5,7.5 <0,7.5 0,7 <5,7"},
    GlyphRow{U':', 0.0, "0,0 0,0.6;0,5 0,5.6"},
    GlyphRow{U';', 0.8, "0.8,0.6 0,-1.5;0.8,5 0.8,5.6"},
    GlyphRow{U'<', 5.0, "5,7.5 0,4.5 5,1.5"},
    GlyphRow{U'=', 5.0, "0,3.5 5,3.5;0,5.5 5,5.5"},
    GlyphRow{U'>', 5.0, "0,7.5 5,4.5 0,1.5"},
    GlyphRow{U'?', 5.0, "0,7.5 >5,7.5 )2.5,5 2.5,3;2.5,0 2.5,0.6"},
    GlyphRow{U'@', 8.0, "6,3 6,7;6,5 <2,5 <6,5;6,3 (7,2 (8,3 8,6 (4,10 (0,6 0,4 (4,0 6.5,0"},
    GlyphRow{U'A', 6.0, "0,0 3,10 6,0;1.2,4 4.8,4"},
    GlyphRow{U'B', 6.0, "0,0 0,10 3.5,10 >3.5,5 0,5;3.5,5 >3.5,0 0,0"},
    GlyphRow{U'C', 6.0, "6,7 <0,7 0,3 <6,3"},
    GlyphRow{U'D', 6.0, "0,0 0,10 2,10 )6,6 6,4 )2,0 0,0"},
    GlyphRow{U'E', 6.0, "6,10 0,10 0,0 6,0;0,5 4.5,5"},
    GlyphRow{U'F', 6.0, "6,10 0,10 0,0;0,5 4.5,5"},
    GlyphRow{U'G', 6.0, "6,7 <0,7 0,3 <6,3 6,4.5 3.5,4.5"},
    GlyphRow{U'H', 6.0, "0,0 0,10;6,0 6,10;0,5 6,5"},
    GlyphRow{U'I', 0.0, "0,0 0,10"},
    GlyphRow{U'J', 5.0, "0,2.5 <5,2.5 5,10"},
    GlyphRow{U'K', 6.0, "0,0 0,10;6,10 0,4;2,6 6,0"},
    GlyphRow{U'L', 5.5, "0,10 0,0 5.5,0"},
    GlyphRow{U'M', 7.0, "0,0 0,10 3.5,4 7,10 7,0"},
    GlyphRow{U'N', 6.0, "0,0 0,10 6,0 6,10"},
    GlyphRow{U'O', 6.0, "6,3 6,7 <0,7 0,3 <6,3"},
    GlyphRow{U'P', 6.0, "0,0 0,10 3.5,10 >3.5,5 0,5"},
    GlyphRow{U'Q', 6.0, "6,3 6,7 <0,7 0,3 <6,3;3.5,2.5 6,0"},
    GlyphRow{U'R', 6.0, "0,0 0,10 3.5,10 >3.5,5 0,5;3,5 6,0"},
    GlyphRow{U'S', 6.0, "6,7.5 (3.5,10 2.5,10 <2.5,5 3.5,5 >3.5,0 2.5,0 )0,2.5"},
    GlyphRow{U'T', 6.0, "0,10 6,10;3,10 3,0"},
    GlyphRow{U'U', 6.0, "0,10 0,3 <6,3 6,10"},
    GlyphRow{U'V', 6.0, "0,10 3,0 6,10"},
    GlyphRow{U'W', 8.0, "0,10 2,0 4,8 6,0 8,10"},
    GlyphRow{U'X', 6.0, "0,0 6,10;0,10 6,0"},
    GlyphRow{U'Y', 6.0, "0,10 3,5 6,10;3,5 3,0"},
    GlyphRow{U'Z', 6.0, "0,10 6,10 0,0 6,0"},
    GlyphRow{U'[', 1.5, "1.5,11 0,11 0,-1 1.5,-1"},
    GlyphRow{U'\\', 5.0, "0,11 5,-1"},
    GlyphRow{U']', 1.5, "0,11 1.5,11 1.5,-1 0,-1"},
    GlyphRow{U'^', 4.0, "0,8 2,10 4,8"},
    GlyphRow{U'_', 5.0, "0,-1 5,-1"},
    GlyphRow{U'`', 1.2, "0,10 1.2,8.5"},
    GlyphRow{U'a', 5.0, "5,7 5,0;5,4.5 <0,4.5 0,2.5 <5,2.5"},
    GlyphRow{U'b', 5.0, "0,10 0,0;0,2.5 <5,2.5 5,4.5 <0,4.5"},
    GlyphRow{U'c', 5.0, "5,4.5 <0,4.5 0,2.5 <5,2.5"},
    GlyphRow{U'd', 5.0, "5,10 5,0;5,4.5 <0,4.5 0,2.5 <5,2.5"},
    GlyphRow{U'e', 5.0, "0,3.5 5,3.5 5,4.5 <0,4.5 0,2.5 (2.5,0 4.5,0"},
    GlyphRow{U'f', 3.8, "3.8,10 3.5,10 (1.5,8 1.5,0;0,7 3.5,7"},
    GlyphRow{U'g', 5.0, "5,7 5,-0.5 >0,-0.5;5,4.5 <0,4.5 0,2.5 <5,2.5"},
    GlyphRow{U'h', 5.0, "0,10 0,0;0,4.5 >5,4.5 5,0"},
    GlyphRow{U'i', 0.0, "0,7 0,0;0,9.3 0,10"},
    GlyphRow{U'j', 1.5, "1.5,7 1.5,-1.5 )0,-3;1.5,9.3 1.5,10"},
    GlyphRow{U'k', 4.5, "0,10 0,0;4.5,7 0,2.8;1.6,4.3 4.5,0"},
    GlyphRow{U'l', 0.0, "0,10 0,0"},
    GlyphRow{U'm', 8.0, "0,7 0,0;0,5 >4,5 4,0;4,5 >8,5 8,0"},
    GlyphRow{U'n', 5.0, "0,7 0,0;0,4.5 >5,4.5 5,0"},
    GlyphRow{U'o', 5.0, "5,2.5 5,4.5 <0,4.5 0,2.5 <5,2.5"},
    GlyphRow{U'p', 5.0, "0,7 0,-3;0,4.5 >5,4.5 5,2.5 >0,2.5"},
    GlyphRow{U'q', 5.0, "5,7 5,-3;5,4.5 <0,4.5 0,2.5 <5,2.5"},
    GlyphRow{U'r', 3.5, "0,7 0,0;0,4 )3,7 3.5,7"},
    GlyphRow{U's', 4.5, "4.5,5.25 (2.75,7 1.75,7 <1.75,3.5 2.75,3.5 >2.75,0 1.75,0 )0,1.75"},
    GlyphRow{U't', 4.0, "1.5,10 1.5,2 (3.5,0 4,0;0,7 3.5,7"},
    GlyphRow{U'u', 5.0, "0,7 0,2.5 <5,2.5;5,7 5,0"},
    GlyphRow{U'v', 5.0, "0,7 2.5,0 5,7"},
    GlyphRow{U'w', 7.0, "0,7 1.7,0 3.5,6 5.3,0 7,7"},
    GlyphRow{U'x', 5.0, "0,7 5,0;0,0 5,7"},
    GlyphRow{U'y', 5.0, "0,7 2.5,0;5,7 1.43,-3"},
    GlyphRow{U'z', 5.0, "0,7 5,7 0,0 5,0"},
    GlyphRow{U'{', 2.5, "2.5,11 (1,9.5 1,6 )0,5 )1,4 1,0.5 (2.5,-1"},
    GlyphRow{U'|', 0.0, "0,11 0,-2"},
    GlyphRow{U'}', 2.5, "0,11 )1.5,9.5 1.5,6 (2.5,5 (1.5,4 1.5,0.5 )0,-1"},
    GlyphRow{U'~', 5.0, "0,4.5 >2.5,4.5 <5,4.5"},
    GlyphRow{U'°', 2.6, "1.3,10 <1.3,7.4 <1.3,10"},
    GlyphRow{U'±', 5.0, "0,5.5 5,5.5;2.5,3 2.5,8;0,1 5,1"},
    GlyphRow{U'²', 3.0, "0,8.5 >3,8.5 0,5 3,5"},
    GlyphRow{U'³', 3.0, "0,10 3,10 1.3,8 >1.3,5 0,5"},
    GlyphRow{U'·', 0.0, "0,4.2 0,4.8"},
    GlyphRow{U'×', 4.0, "0,2.5 4,6.5;0,6.5 4,2.5"},
    GlyphRow{U'Ø', 6.0, "6,3 6,7 <0,7 0,3 <6,3;-0.5,-1 6.5,11"},
    GlyphRow{U'ø', 5.0, "5,2.5 5,4.5 <0,4.5 0,2.5 <5,2.5;-0.5,-1 5.5,8"},
    GlyphRow{U'ß', 4.5, "0,0 0,7.75 >4.5,7.75 )2.25,5.5;2.25,5.5 >2.25,0 1.5,0"},
    GlyphRow{U'µ', 5.0, "0,7 0,-3;0,2.5 <5,2.5;5,7 5,0"},
    GlyphRow{U'–', 6.0, "0,4.5 6,4.5"},
    GlyphRow{U'’', 0.8, "0.8,10 0,8"},
};

constexpr double kBoxWidth = 5.0;
constexpr std::string_view kBox = "0,0 0,10 5,10 5,0 0,0";

/// Letters with a sign above or below: which letter, which sign.
struct AccentRow {
  char32_t character;
  char32_t letter;
  char sign;  ///< : two dots, ' acute, ` grave, ^ circumflex, , cedilla
};

constexpr std::array kAccents = {
    AccentRow{U'Ä', U'A', ':'},  AccentRow{U'Ö', U'O', ':'}, AccentRow{U'Ü', U'U', ':'},
    AccentRow{U'ä', U'a', ':'},  AccentRow{U'ö', U'o', ':'}, AccentRow{U'ü', U'u', ':'},
    AccentRow{U'É', U'E', '\''}, AccentRow{U'È', U'E', '`'}, AccentRow{U'À', U'A', '`'},
    AccentRow{U'é', U'e', '\''}, AccentRow{U'è', U'e', '`'}, AccentRow{U'à', U'a', '`'},
    AccentRow{U'ê', U'e', '^'},  AccentRow{U'â', U'a', '^'}, AccentRow{U'î', U'i', '^'},
    AccentRow{U'ô', U'o', '^'},  AccentRow{U'û', U'u', '^'}, AccentRow{U'ù', U'u', '`'},
    AccentRow{U'ë', U'e', ':'},  AccentRow{U'ï', U'i', ':'}, AccentRow{U'ç', U'c', ','},
    AccentRow{U'Ç', U'C', ','},  AccentRow{U'Ê', U'E', '^'},
};

/// @return tan(sweep / 4) of what the character before a point says
double bulge_of(char turn) {
  constexpr double kQuarter = 0.41421356237309503;  // tan(pi/8)
  switch (turn) {
    case '(':
      return kQuarter;
    case ')':
      return -kQuarter;
    case '<':
      return 1.0;
    case '>':
      return -1.0;
    default:
      return 0.0;
  }
}

std::vector<ArcPath> strokes_of(std::string_view text) {
  std::vector<ArcPath> strokes;
  if (text.empty()) return strokes;
  strokes.emplace_back();
  const char* place = text.data();
  const char* const end = place + text.size();
  while (place != end) {
    if (*place == ';') strokes.emplace_back();
    if (*place == ';' || *place == ' ') {
      ++place;
      continue;
    }
    const double bulge = bulge_of(*place);
    if (bulge != 0.0) ++place;
    PathVertex vertex;
    place = std::from_chars(place, end, vertex.at.x).ptr + 1;  // and the comma
    place = std::from_chars(place, end, vertex.at.y).ptr;
    ArcPath& stroke = strokes.back();
    if (!stroke.vertices.empty()) stroke.vertices.back().bulge = bulge;
    stroke.vertices.push_back(vertex);
  }
  return strokes;
}

std::vector<ArcPath> sign_strokes(char sign, double middle, double above) {
  std::vector<ArcPath> strokes;
  const auto line = [&](double x, double y, double to_x, double to_y) {
    strokes.push_back({{{{middle + x, y}}, {{middle + to_x, to_y}}}, false});
  };
  if (sign == ':') {
    line(-1.3, above + 1.2, -1.3, above + 1.8);
    line(1.3, above + 1.2, 1.3, above + 1.8);
  }
  if (sign == '\'') line(-0.5, above + 1.0, 0.9, above + 2.6);
  if (sign == '`') line(0.5, above + 1.0, -0.9, above + 2.6);
  if (sign == '^') {
    line(-1.4, above + 1.0, 0.0, above + 2.4);
    line(0.0, above + 2.4, 1.4, above + 1.0);
  }
  if (sign == ',') line(0.3, 0.0, -0.6, -2.0);
  return strokes;
}

std::map<char32_t, Glyph> all_glyphs() {
  std::map<char32_t, Glyph> glyphs;
  for (const GlyphRow& row : kGlyphs) glyphs[row.character] = {row.width, strokes_of(row.strokes)};
  for (const AccentRow& row : kAccents) {
    Glyph glyph = glyphs.at(row.letter);
    // An i loses its dot.
    if (row.letter == U'i') glyph.strokes.pop_back();
    const bool capital = row.letter < U'a';
    for (ArcPath& stroke : sign_strokes(row.sign, 0.5 * glyph.width, capital ? 10.0 : 7.0)) {
      glyph.strokes.push_back(std::move(stroke));
    }
    glyphs[row.character] = std::move(glyph);
  }
  return glyphs;
}

const std::map<char32_t, Glyph>& glyphs() {
  static const std::map<char32_t, Glyph> kAll = all_glyphs();
  return kAll;
}

/// @return bytes of the character that starts with this one; 0: none does
std::size_t utf8_size(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) return 3;
  return first < 0xF5 ? 4 : 0;
}

}  // namespace

const Glyph& glyph_of(char32_t character) {
  static const Glyph kNone{kBoxWidth, strokes_of(kBox)};
  const auto found = glyphs().find(character);
  return found == glyphs().end() ? kNone : found->second;
}

bool has_glyph(char32_t character) {
  return glyphs().contains(character);
}

std::vector<char32_t> characters_of(std::string_view text) {
  constexpr char32_t kNoCharacter = 0xFFFD;
  std::vector<char32_t> characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t size = utf8_size(first);
    char32_t character = size < 2 ? first : first & (0x7FU >> size);
    bool good = size > 0 && i + size <= text.size();
    for (std::size_t k = 1; good && k < size; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xC0U) == 0x80U;
      character = (character << 6U) | (next & 0x3FU);
    }
    characters.push_back(good ? character : kNoCharacter);
    i += good ? size : 1;
  }
  return characters;
}

}  // namespace glissade::drawing
