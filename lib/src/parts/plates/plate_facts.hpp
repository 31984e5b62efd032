#pragma once

#include "parts/plates/plate_joints.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// What rules of the shop may bound of the parts of any section: holes, sizes and masses.
void measure_plates(const PlateOptions& options, Workshop& workshop);
/// A radius that plate rolls are to give.
void measure_rolling(double radius, const ShopPart& part, const std::string& where, Workshop& workshop);
/// The floor of a channel: its radii, bends and flats, and the steps from unit to unit.
void measure_floor(const Job& job, const std::vector<Unit>& units, Workshop& workshop);
/// Tabs, slots and the webs beside them; nothing of corners without.
void measure_corners(const Job& job, const std::vector<Unit>& units, Workshop& workshop);

}  // namespace glissade::parts
