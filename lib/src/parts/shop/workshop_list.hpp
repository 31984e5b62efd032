#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"
#include "glissade/parts/workshop_build.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace glissade::parts {

inline constexpr std::array<double, 3> kFloorColour{0.62, 0.66, 0.70};
inline constexpr std::array<double, 3> kWallColour{0.45, 0.56, 0.68};
inline constexpr std::array<double, 3> kFrameColour{0.80, 0.55, 0.30};
inline constexpr std::array<double, 3> kLinerColour{0.55, 0.50, 0.46};
inline constexpr std::array<double, 3> kFittingColour{0.42, 0.62, 0.48};
inline constexpr std::array<double, 3> kSupportColour{0.36, 0.42, 0.58};

/// Adds a part to the list; under the number of its equal, however that lies (equal_parts.hpp), where there is one.
/// @return its number
int add_part(Workshop& workshop, ShopPart part, const std::array<double, 3>& colour);

/// Takes one piece off the list again: that of a part, or of its equal, at a place of the part.
void take_back(Workshop& workshop, ShopPart part, const Frame& place);

/// Adds a note that stands there once.
void add_note(std::string note, Workshop& workshop);
/// Says what is not made as it was asked for, once.
/// @param shortfall  all four parts of it; `where` is a key below `fabrication`
void add_shortfall(Issue shortfall, Workshop& workshop);
/// Of a plate that begins or ends short of the track, since its rim would fold over.
/// @param from    along the track, as `to` and its `length` [m]
void tell_short_plate(const std::string& name, double from, double to, double length, Workshop& workshop);
/// Of an opening that is not where it is asked for; nothing where it is so to half a millimetre.
/// @param asked  along the track, as `at` [m]
/// @param why    one sentence
void tell_moved_opening(double asked, double at, const std::string& why, Workshop& workshop);

/// Adds what is bought; to the count of its like where there is one.
void add_item(Workshop& workshop, BoughtInItem item);

/// A bolt with its nut and two washers through a grip.
void add_bolts(Workshop& workshop, int size, double grip, std::size_t count, const std::string& where);

/// A bolt with its nut and two large washers through a grip of timber.
void add_timber_bolts(Workshop& workshop, int size, double grip, std::size_t count, const std::string& where);

/// Bolts of the frames that meet at joints; where one frame is slotted, with a large washer on that side.
/// @param bolts   of all of them
/// @param joints  between units
void add_joint_bolts(Workshop& workshop, const FlangeOptions& flange, std::size_t bolts, std::size_t joints);

/// Says by how much the parts differ from what they make.
/// @param whole  "the plain channel"
void note_differences(const PartsProof& proof, const std::string& whole, Workshop& workshop);

}  // namespace glissade::parts
