#include "glissade/parts/shop_part.hpp"

#include "glissade/core/number_text.hpp"

#include <string>

namespace glissade {
namespace {

/// Letters, digits and what file systems and machine controls take; the rest becomes "-".
std::string as_file_word(const std::string& text) {
  std::string word;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '-' || c == '_';
    if (plain) {
      word += c;
    } else if (!word.empty() && word.back() != '-') {
      word += '-';
    }
  }
  while (!word.empty() && word.back() == '-') word.pop_back();
  return word.empty() ? "x" : word;
}

}  // namespace

std::string file_stem(const ShopPart& part) {
  const std::string number = (part.number < 10 ? "0" : "") + std::to_string(part.number);
  return number + "_" + as_file_word(part.name) + "_" + as_file_word(part.material) + "_" +
         rounded_text(part.thickness * 1e3, 6) + "mm_" + std::to_string(part.quantity()) + "x";
}

}  // namespace glissade
