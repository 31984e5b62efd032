#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/drawing/sheet.hpp"

#include <optional>
#include <utility>

namespace glissade::drawing {

/// @return the lowest and highest point of an outline above a place of the x axis; none beside it
[[nodiscard]] std::optional<std::pair<double, double>> heights_at(const ArcPath& outline, double x);

/// Ordinates of an outline with arcs at round distances from its left end: what marks a curve with a rule alone.
/// @return no rows where the outline has no arcs, or is shorter than 0.3 m
[[nodiscard]] SheetTable ordinate_table(const ArcPath& outline);

}  // namespace glissade::drawing
