#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/vec.hpp"

#include <algorithm>
#include <vector>

namespace glissade {

/// A stock sheet that parts are cut from, all of one material and thickness. Metres.
struct NestStock {
  double width = 3.0;      ///< along x, the longer side; > 0
  double height = 1.5;     ///< along y; > 0
  double margin = 5e-3;    ///< of parts from the sheet's edges; >= 0
  double spacing = 10e-3;  ///< between parts; >= 0

  /// @param sheet  its sides, either of them first
  [[nodiscard]] static NestStock of(Vec2 sheet, double margin, double spacing) {
    return {std::max(sheet.x, sheet.y), std::min(sheet.x, sheet.y), margin, spacing};
  }
  /// @return what its margins leave, along x and along y
  [[nodiscard]] Vec2 room() const { return {width - 2.0 * margin, height - 2.0 * margin}; }

  friend bool operator==(const NestStock&, const NestStock&) = default;
};

/// @return what is wrong with a sheet, all of it, at the keys "split.sheet", "split.margin" and "split.spacing"
[[nodiscard]] std::vector<Issue> stock_problems(const NestStock& stock);

}  // namespace glissade
