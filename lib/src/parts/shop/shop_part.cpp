#include "glissade/parts/shop_part.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/parts/bend_hits.hpp"

#include <array>
#include <cmath>
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

std::size_t bend_hits(const FlatPattern& pattern) {
  std::size_t hits = 0;
  const BendLine* before = nullptr;
  for (const BendLine& bend : pattern.bends) {
    constexpr double kOneLine = 1e-9;  // of the lines' lengths
    const auto off = [&](Vec2 point) {
      return std::fabs(cross(before->to - before->from, point - before->from));
    };
    const double room = before == nullptr ? 0.0 : kOneLine * norm(before->to - before->from);
    const bool goes_on = before != nullptr && off(bend.from) < room && off(bend.to) < room;
    hits += goes_on ? 0 : 1;
    before = &bend;
  }
  return hits;
}

}  // namespace glissade
