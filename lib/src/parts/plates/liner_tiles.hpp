#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/curves/offset_line.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace glissade::parts {

/// Tiles of a liner, on a floor or on every plate of a section that has none: each a lane, in courses that go right across.

/// Width of a tile that holds a bolt, in diameters of its hole.
inline constexpr double kLeastTile = 2.4;

struct TilePlace {
  Span span;    ///< along the line that the floor follows
  Span told;    ///< the same along the track, for people
  int row = 0;  ///< of its course, from 1, counted over all units
  std::size_t lane = 0;
  double edge = 0.0;  ///< its left edge, from that of the lane [m]
  double width = 0.0;
  bool half = false;
  std::vector<double> along;   ///< of its bolts: places on the track
  std::vector<double> across;  ///< and from its left edge
  double wider =
      0.0;  ///< of its course: what its lane has more there than where it is narrowest, half on either side
  double gap = 0.0;  ///< beside its lane
};

/// @param lanes  widths of the lanes [m]
/// @param arcs   where holes may stand
/// @param row    courses so far; counts on
/// @param seams  where courses may meet; none: anywhere
/// @param wider  of a lane that widens: by how much it is wider over a course than told, at the least
/// @param on_track  the place on the track of one on the line that the floor follows; none: that is the track
/// @throws InputError where no bolt finds a place: between which places, and a way out
[[nodiscard]] std::vector<TilePlace> tile_places(const PlateOptions& options,
                                                 const std::vector<double>& lanes, const Span& unit,
                                                 const OnOneArc& arcs, int& row,
                                                 const OnOneArc* seams = nullptr,
                                                 const std::function<double(const Span&)>& wider = {},
                                                 const std::function<double(double)>& on_track = {});

/// @return where the bolts of tiles stand across a lane, in courses of both kinds: from its left edge [m]
[[nodiscard]] std::vector<double> bolts_across(const PlateOptions& options, double lane);

/// A tile with its holes, but for its name.
using MakeTile = std::function<ShopPart(const TilePlace&, const StockMaterial&)>;

/// Lists tiles, their bolts and spares, and says where they lie.
/// @param lanes  ends of the tiles' names, one a lane
/// @param tiles  by ascending rows
/// @param below  thickness of the plate below them [m]
void lay_tiles(const PlateOptions& options, const std::vector<std::string>& lanes,
               const std::vector<TilePlace>& tiles, const MakeTile& make, double below, Workshop& workshop);

}  // namespace glissade::parts
