#pragma once

#include "glissade/parts/shop_part.hpp"

#include <optional>

namespace glissade::parts {

/// By how much corners of two parts that get one number may differ [m]: what no machine cuts and no gauge sees.
inline constexpr double kSamePart = 1e-6;

/// Whether two parts are one and the same piece, however they lie: of one material and thickness, bodies that a turn and a move
/// bring together, and patterns alike with them - as they are, turned half round with a piece that is turned end for end, or,
/// of a plate that stays flat, turned over. Mirror images that are bent or rolled are two parts: one is formed the other way.
/// What is bought is alike only by name, too.
/// @return where the first part's body lies in the frame of the second one's
[[nodiscard]] std::optional<Frame> place_in(const ShopPart& part, const ShopPart& other);

/// @return whether two parts of one material and thickness have patterns that are one figure turned over
[[nodiscard]] bool mirror_images(const ShopPart& part, const ShopPart& other);

/// @return a place within a place
[[nodiscard]] Frame placed(const Frame& outer, const Frame& inner);

}  // namespace glissade::parts
