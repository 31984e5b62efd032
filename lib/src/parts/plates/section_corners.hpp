#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/plates/plate_section.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// Corners between plates of any section that lap or hold tabs. Of two plates one passes the other, which butts against its
/// face: the one farther from the floor (`walls: beside-floor`) or nearer to it (`on-floor`). Where the section turns by the
/// angle a, the butting plate's far face meets the passing plate's near one t / sin a beyond the corner.

/// An edge of a plate. Places are y along its face, from `face_from`.
struct CornerEdge {
  enum class Meeting { mitre, butts, passes };
  Meeting meeting = Meeting::mitre;
  Bevel
      plain;  ///< where it ends beside frames: mitred, butting, or flush with the far face of the other plate
  Bevel out;  ///< of one that passes where its lap ends, of one that butts where its tabs do
  Bevel
      slot_near;  ///< of one that passes, the sides of its slots: towards its middle, and beyond the other plate
  Bevel slot_far;
};
struct CorneredPlate {
  CornerEdge from;
  CornerEdge to;
};

/// @return one for each plate; corners that turn by less than kLeastTurn or inwards stay mitres
[[nodiscard]] std::vector<CorneredPlate> cornered(const PlateSection& section, const PlateOptions& options);

/// What no shop can make of the corners of a section, whatever the track is.
[[nodiscard]] std::vector<Issue> section_corner_problems(const PlateSection& section,
                                                         const PlateOptions& options);

/// Plates that meet at a flatter angle would end in knife edges [deg].
inline constexpr double kLeastTurn = 30.0;

}  // namespace glissade::parts
