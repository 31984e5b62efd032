#include "report/line_style.hpp"

#include <array>

#include <fmt/format.h>

namespace glissade::report {
namespace {

constexpr std::array<const char*, 8> kColours = {"#0b6e99", "#b4531a", "#1a7f5a", "#6d3fa0",
                                                 "#a3325f", "#52606d", "#8a7000", "#16202a"};
constexpr std::array<const char*, 4> kDashes = {"", "8 4", "2 4", "10 3 2 3"};

}  // namespace

std::string line_stroke(std::size_t colour, std::size_t dash) {
  const std::size_t style = dash % kDashes.size();
  return fmt::format("stroke=\"{}\"{}", kColours[colour % kColours.size()],
                     style == 0 ? "" : fmt::format(" stroke-dasharray=\"{}\"", kDashes[style]));
}

std::string choice_stroke(int choice) {
  const auto index = static_cast<std::size_t>(choice - 1);
  // The second time round the colours meet other dashes.
  return line_stroke(index, index + index / kColours.size());
}

}  // namespace glissade::report
