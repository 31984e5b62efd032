#pragma once

#include "parts/plates/plate_joints.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// What rules of the shop may bound of the parts of any section: holes, sizes and masses.
void measure_plates(const PlateOptions& options, Workshop& workshop);
/// A bolt of a frame.
struct RowBolt {
  Vec2 middle;                     ///< in the plane of the joint [m]
  const ShopPart* part = nullptr;  ///< in which it is drilled
};
/// @param line  along which the frame's holes or slots stand, or near it
/// @return its bolts, from the line's beginning on
[[nodiscard]] std::vector<RowBolt> bolts_in_order(const ShopPart& frame, const ArcPath& line);
/// The least and the greatest way, straight, from a bolt of a frame to the next one; nothing of a single bolt. What the bolts clamp
/// between them goes on over corners and over cuts of the frame: pieces of one frame are one row.
/// @param row     in the order in which they go round the section
/// @param closed  all round it: the last is next to the first
void measure_bolt_row(const std::vector<RowBolt>& row, bool closed, Workshop& workshop);
/// A radius that plate rolls are to give.
void measure_rolling(double radius, const ShopPart& part, const std::string& where, Workshop& workshop);
/// The floor of a channel: its radii, bends and flats, and the steps from unit to unit.
void measure_floor(const Job& job, const std::vector<Unit>& units, Workshop& workshop);
/// Tabs, slots and the webs beside them; nothing of corners without.
void measure_corners(const Job& job, const std::vector<Unit>& units, Workshop& workshop);

}  // namespace glissade::parts
