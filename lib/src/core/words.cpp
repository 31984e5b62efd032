#include "glissade/core/words.hpp"

#include "glissade/core/odd_characters.hpp"

#include <algorithm>
#include <cstddef>

namespace glissade {

std::string listed(const std::vector<std::string_view>& words, std::string_view last) {
  std::string text;
  for (std::size_t index = 0; index < words.size(); ++index) {
    if (index > 0 && index + 1 == words.size()) {
      text.append(" ").append(last).append(" ");
    } else if (index > 0) {
      text += ", ";
    }
    text += words[index];
  }
  return text;
}

std::string listed(const std::vector<std::string>& words, std::string_view last) {
  return listed(std::vector<std::string_view>(words.begin(), words.end()), last);
}

std::string shown(std::string_view given) {
  constexpr std::size_t kLongest = 60;
  const std::string text = with_visible_characters(given);
  std::size_t size = std::min(text.size(), kLongest);
  // Never cut a UTF-8 sequence in two: step back over continuation bytes.
  while (size < text.size() && size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80U) --size;
  std::string result = text.substr(0, size);
  for (char& letter : result) {
    if (static_cast<unsigned char>(letter) < 0x20U || letter == 0x7F) letter = ' ';
  }
  if (size < text.size()) result += "...";
  return result;
}

}  // namespace glissade
