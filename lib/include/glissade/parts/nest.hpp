#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/parts/nest_stock.hpp"
#include "glissade/parts/shop_part.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace glissade {

/// Flat patterns laid out on stock sheets, for ordering and for cutting several parts at once.

/// One piece on a sheet.
struct NestedPiece {
  std::size_t part = 0;  ///< index in Workshop::parts
  PlaneMotion motion;    ///< from the pattern's frame to the sheet's, origin at its lower left corner [m]
};

/// One sheet of stock with the pieces that are cut from it.
struct NestedSheet {
  std::string name;  ///< of its file, "nest_S235_4mm_1_of_2": no two of one nest() have the same
  std::string material;
  double thickness = 0.0;  ///< [m]
  NestStock stock;
  std::vector<NestedPiece> pieces;
  double utilisation = 0.0;  ///< area of the parts, without their holes, over that of the sheet
  std::string file = {};     ///< below the folder of the build; empty where none is written
};

/// Lays every piece with a flat pattern on sheets, one group of sheets for each material and thickness.
///
/// Each pattern is turned so that the least rectangle round it lies along the sheet, or across it, or end for end; the
/// largest go first; each drops to where the top of the heap stays lowest, and settles into hollows: curved bands stack
/// as closely as their curves allow. No piece lies inside the hole of another. Where pieces fall is decided on columns of
/// kNestColumn; distances hold exactly.
/// Identity: pieces are at least `spacing` apart and `margin` from the edges (tests measure it).
/// Source: bottom-left filling on a skyline (B. Chazelle, IEEE Trans. Comput. C-32(8), 1983), with curved undersides.
/// @throws InputError if a measure of the stock is out of its bound: stock_problems(); or with all parts that fit no sheet, at
///         "split.sheet": size, bound, what to try
[[nodiscard]] std::vector<NestedSheet> nest(const Workshop& workshop, const NestStock& stock = {});

/// Sheets of one material and thickness.
struct StockGroup {
  std::span<const NestedSheet> sheets;  ///< not empty; of the sheets given
  double utilisation = 0.0;             ///< mean over the sheets
};

/// @param sheets  as nest() gives them: those of one stock follow each other; outlive what is returned
/// @return one group a stock, in their order
[[nodiscard]] std::vector<StockGroup> by_stock(std::span<const NestedSheet> sheets);

/// Width of the columns that decide where pieces fall [m]; a sheet has 20 to 4000.
inline constexpr double kNestColumn = 0.003;

}  // namespace glissade
