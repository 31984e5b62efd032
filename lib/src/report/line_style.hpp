#pragma once

#include <cstddef>
#include <string>

namespace glissade::report {

/// How the lines of a figure differ, in colour and in dashes: attributes of an SVG path. 32 of them before they repeat.
/// @param dash  which dashes; 0: none
[[nodiscard]] std::string line_stroke(std::size_t colour, std::size_t dash);
/// Those of a line that a reader may choose, the same in every figure.
/// @param choice  FigureLine::choice, from 1
[[nodiscard]] std::string choice_stroke(int choice);

}  // namespace glissade::report
