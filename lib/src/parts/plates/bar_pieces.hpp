#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include <array>
#include <vector>

namespace glissade::parts {

/// Angles, tubes and flat bars come in stock lengths (`split.bar`): what is longer, or too heavy, is pieces, cut square and welded end to end.

/// @param bar  whose body is an AngleBar
/// @param staggered  cut elsewhere, by one bolt: of one of two that meet
/// @return the bar alone where one length does; else pieces that are cut between its bolts
/// @throws InputError where `split` if it is longer or too heavy and one piece is asked for, or where no cuts are to be had
[[nodiscard]] std::vector<ShopPart> angle_pieces(const ShopPart& bar, bool staggered,
                                                 const PlateOptions& options);

/// Adds a tube along z of its places, in equal pieces where it is longer than the stock.
/// @param tube  whose body is a Prism
/// @throws InputError as above
void add_tube(const ShopPart& tube, const PlateOptions& options, const std::array<double, 3>& colour,
              Workshop& workshop);

/// Adds a rectangle along x of its frame as a flat bar, in equal pieces where it is longer than the stock.
/// @param bar  with a pattern, and a Prism of it as its body
/// @throws InputError as above
void add_flat_bar(ShopPart bar, const PlateOptions& options, const std::array<double, 3>& colour,
                  Workshop& workshop);

/// Says that bars are pieces, once.
void note_bar_pieces(const PlateOptions& options, Workshop& workshop);

}  // namespace glissade::parts
