#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/parts/plate_options.hpp"

#include <functional>
#include <string>
#include <vector>

namespace glissade::parts {

/// The holes of the two frames that meet at a joint stand about the same axes. Those of one are ISO 273 medium, those of the other
/// coarse, so that they fit as they come; that one is the frame downstream, or the one that is asked for with slots. Slots are as
/// wide as coarse holes and upright in the frame, square to the floor: a unit may be raised or lowered against the next one.

/// @return from end to end of a slot [m]
[[nodiscard]] double slot_length(const FlangeOptions& flange);
/// Least distances of holes' middles over their diameter, to an edge and to each other: as the rules of the shop have them, and so
/// far that a web is left, whatever these are.
[[nodiscard]] double hole_edge_diameters(const ShopLeast& shop);
[[nodiscard]] double hole_pitch_diameters(const ShopLeast& shop);

/// @return from the middle of a slot to that of its ends; 0 if no frame is slotted [m]
[[nodiscard]] double slot_reach(const FlangeOptions& flange);

/// @return the least distance of the uppermost holes' middles below the top of a frame, for its edge [m]
[[nodiscard]] double below_top(const FlangeOptions& flange);
/// @return the same for a rim, which ends before flat frames with its top level with theirs: heads, nuts and washers lie below it; 0
///         where there is none, or none before them [m]
[[nodiscard]] double bolts_below_rim(const PlateOptions& options);

/// @return the name of the frame on a side of a joint: "end_frame", "end_frame_loose", "end_frame_slotted"
[[nodiscard]] std::string frame_name(const std::string& name, const FlangeOptions& flange, FlangeSide side);

/// Middles of a frame's bolts, by pitch and slots of the options [m].
using FrameBolts = std::function<std::vector<Vec2>(const FlangeOptions&)>;

/// Cuts the holes of the frame on a side of a joint. The frame's region has y upright.
/// @throws InputError where `flanges.pitch` if holes or slots would stand too near each other and another pitch puts them farther
///         apart; says which pitch, or length of slots, would do
void drill_frame(const PlateOptions& options, FlangeSide side, const FrameBolts& bolts, PlaneRegion& region);

/// Appends what of slots no shop makes in frames of these measures, whatever the section is.
void add_slot_problems(const PlateOptions& options, std::vector<Issue>& issues);

}  // namespace glissade::parts
