#include "glissade/parts/shop_part.hpp"

#include "glissade/core/number_text.hpp"

#include <array>
#include <cstddef>
#include <limits>
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

double ShopMeasurement::in_units() const {
  if (unit != 0.0) return value / unit;
  return value > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

std::string_view to_text(ShopVerdict verdict) {
  constexpr std::array<std::string_view, 4> kTexts = {"pass", "warn", "fail", "cannot be judged"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

std::string file_stem(const ShopPart& part) {
  const std::string number = (part.number < 10 ? "0" : "") + std::to_string(part.number);
  return number + "_" + as_file_word(part.name) + "_" + as_file_word(part.material) + "_" +
         rounded_text(part.thickness * 1e3, 6) + "mm_" + std::to_string(part.quantity()) + "x";
}

}  // namespace glissade
