#pragma once

#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::optimizer {

/// Of a line that a track stays above, or below, what such a track can touch: measured ground has thousands of points, most
/// of them in hollows that no bend of the track fits into.
///
/// A corner between two others is left out where it lies behind the arc of the radius through both: a track that clears
/// these two, its bends towards the line no sharper than the arc, clears that corner (a first place where it did not would have
/// a bend as sharp as the arc's; docs/optimization.md, "Measured ground"). In place of those left out between two that stay
/// stands one corner behind all of them.
struct Touching {
  double side = 1.0;    ///< +1: tracks stay above the line (at less drop), -1: below
  double radius = 0.0;  ///< no track bends more sharply towards the line; > 0
  double from = 0.0;    ///< along the run: from here ...
  double to = 0.0;      ///< ... up to here every track lies over the line, or under it
};
struct TouchableLine {
  std::vector<Vec2> corners;
  std::vector<bool> out_of_reach;  ///< of each corner: whether it stands for others, and no track touches it
};
/// @param line  corners (run, drop), ascending run
/// @return as many or fewer, the first and the last among them
[[nodiscard]] TouchableLine touchable(const std::vector<Vec2>& line, const Touching& touching);

}  // namespace glissade::optimizer
