#pragma once

#include "parts/plates/shell.hpp"
#include "parts/shop/setting_out.hpp"

#include <vector>

namespace glissade::parts {

/// Trestles from the ground, if options ask for them; what they take up along the track is taken then.
/// @param rows  each one's place is added
/// @throws InputError where the ground leaves them no room, its line ends before one, or the track is too steep for any
void add_supports(const Shell& shell, std::vector<SettingOutPoint>& rows);

}  // namespace glissade::parts
