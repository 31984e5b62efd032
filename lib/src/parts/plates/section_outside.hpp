#pragma once

#include "glissade/core/arc_path.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::parts {

/// What a plate reaches beyond its corner with the next one.
struct OutsideLap {
  std::size_t corner = 0;  ///< of the outside's line
  bool before = false;     ///< the side that ends there goes on; else the one that begins there
  double reach = 0.0;      ///< beyond the corner, along that side [m]
  double thickness = 0.0;  ///< inwards from that side [m]
};

/// The outside of a section, seen against the track: x across to the left, y up from the floor line.
struct SectionOutside {
  /// With the outside to its left: from the left top below the section to the right one; of a ring all round. Pieces meet at
  /// corners between lines, or with a common tangent.
  ArcPath line;
  std::vector<OutsideLap> laps = {};
};

/// @return a line moved to its left, corners mitred, arcs with their centres; ends of an open one at the heights that they had
[[nodiscard]] ArcPath moved_out(const ArcPath& line, double by);
/// @return an open outside without what lies less than `by` below either end
[[nodiscard]] SectionOutside lowered(const SectionOutside& outside, double by);
/// @return what lies left of x = `from` of a ring: from its upper end round to its lower one
[[nodiscard]] ArcPath left_half(const ArcPath& ring, double from);
/// @return the first stretch of a line, of that length at most
[[nodiscard]] ArcPath first_stretch(const ArcPath& line, double most);
/// @return the same seen along the track: left for right
[[nodiscard]] SectionOutside mirrored(const SectionOutside& outside);

/// @return the lowest point of the line above (across) x; none beside it
[[nodiscard]] std::optional<double> underside_at(const ArcPath& line, double x);
/// @return corners of what laps reach beyond the line
[[nodiscard]] std::vector<Vec2> lap_tips(const SectionOutside& outside);

/// @return the lowest that laps reach between two places across; none where there are none
[[nodiscard]] std::optional<double> underside_of_laps(const SectionOutside& outside, double from, double to);

/// The line that something round a section keeps to at a gap: beyond laps, too.
/// @return none where laps leave no way round them
[[nodiscard]] std::optional<ArcPath> round_laps(const SectionOutside& outside, double gap);

}  // namespace glissade::parts
