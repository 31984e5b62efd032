#pragma once

#include "glissade/parts/shop_part.hpp"

#include <array>

namespace glissade::parts {

/// @return the leg of an angle that lies in its plane, with its holes and slots
[[nodiscard]] PlaneRegion lying_leg(const AngleBar& bar);
/// @return what the leg that rises stands on
[[nodiscard]] PlaneRegion rising_leg(const AngleBar& bar);
/// @return both legs from z = 0 on: together they are the bar
[[nodiscard]] std::array<Prism, 2> legs_of(const AngleBar& bar);

/// @return from the heel of an equal angle to its centroid, corners sharp [m]
[[nodiscard]] double angle_centroid(double leg, double thickness);
/// @return whether it is rolled to an arc or ring
[[nodiscard]] bool is_rolled(const AngleBar& bar);
/// @return the length of straight bar that it takes: cut, its longer edge; rolled, the line through the centroid [m]
[[nodiscard]] double stock_length(const AngleBar& bar);

}  // namespace glissade::parts
