#include "glissade/core/nearest_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>

namespace glissade {
namespace {

/// Lower case, one spelling of the separators: "Wall-Height" and "wall_height" are the same slip.
std::string plain(std::string_view word) {
  std::string text;
  for (const char letter : word) {
    const bool separator = letter == '-' || letter == ' ' || letter == '.';
    text += separator ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

/// Number of letters to insert, delete, replace or swap with a neighbour to get from one word to the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before_last(to.size() + 1);
  std::vector<std::size_t> last(to.size() + 1);
  std::vector<std::size_t> current(to.size() + 1);
  for (std::size_t column = 0; column <= to.size(); ++column) last[column] = column;
  for (std::size_t row = 1; row <= from.size(); ++row) {
    current[0] = row;
    for (std::size_t column = 1; column <= to.size(); ++column) {
      const std::size_t replace = last[column - 1] + (from[row - 1] == to[column - 1] ? 0 : 1);
      current[column] = std::min({replace, last[column] + 1, current[column - 1] + 1});
      const bool swapped =
          row > 1 && column > 1 && from[row - 1] == to[column - 2] && from[row - 2] == to[column - 1];
      if (swapped) current[column] = std::min(current[column], before_last[column - 2] + 1);
    }
    before_last.swap(last);
    last.swap(current);
  }
  return last[to.size()];
}

/// The one candidate of which the word is a part between separators: "height" of "wall_height"; empty if several.
std::string_view whole_of(const std::string& part, const std::vector<std::string_view>& candidates) {
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    if (("_" + plain(candidate) + "_").find("_" + part + "_") == std::string::npos) continue;
    if (!found.empty()) return {};
    found = candidate;
  }
  return found;
}

}  // namespace

std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& candidates) {
  constexpr std::size_t kLongestWord = 64;
  if (word.empty() || word.size() > kLongestWord) return {};
  const std::string sought = plain(word);
  std::string_view nearest;
  std::size_t least = std::max<std::size_t>(1, sought.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    const std::string whole = plain(candidate);
    // A word broken off early is a slip too: "frictoin" is near the beginning of "friction_angle".
    const std::size_t distance =
        std::min(edit_distance(sought, whole), edit_distance(sought, whole.substr(0, sought.size())) + 1);
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest.empty() ? whole_of(sought, candidates) : nearest;
}

}  // namespace glissade
