#pragma once

#include "glissade/core/units.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/parts/shop_part.hpp"

#include <vector>

namespace glissade::parts {

/// What lies along the tops of mitred troughs: rims, and covers bolted to them, a trough each.

/// One trough in the plane of the track.
struct TroughTop {
  Vec2 from;  ///< of its axis
  Vec2 along;
  double length = 0.0;  ///< of its axis [m]
  Angle start_tilt;     ///< of the planes of its ends, as of its body
  Angle end_tilt;
  double before = 0.0;  ///< what a frame takes of its upstream end [m]
  double after = 0.0;
};

/// Of every trough.
struct TopMeasures {
  double outer = 0.0;  ///< radius of its outside [m]
  double high = 0.0;   ///< its tops, from the axis [m]
};

/// Flat bars along the outsides of the tops: cut at the planes of their ends, or, where a cover is bolted to them, square.
/// @throws InputError of cover where no pieces of one are small and light enough
void add_trough_rims(const std::vector<TroughTop>& troughs, const TopMeasures& measures,
                     const PlateOptions& options, const Placement& placement, Workshop& workshop);

/// Flat plates over the rims, between the planes of the ends, in pieces as the sheet and the heaviest part ask.
/// Troughs too short for bolts at their tops stay open, which a note tells.
/// @throws InputError as above, and where all troughs are too short
void add_trough_covers(const std::vector<TroughTop>& troughs, const TopMeasures& measures,
                       const PlateOptions& options, const Placement& placement, Workshop& workshop);

}  // namespace glissade::parts
