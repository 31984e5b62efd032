#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/shop_part.hpp"
#include "glissade/section/measures.hpp"

#include "parts/bodies/facets.hpp"
#include "parts/curves/offset_line.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::parts {

/// Inspection openings of mitred tubes and troughs: cut on the left, each with its lid within one tube, lids rolled to lie on the tube
/// and bolted on from outside. Of troughs they lie in the round, as high as its beginning, or a rim there, lets them.

/// A tube that may have one, x of its body upright and -y to the left of the run.
struct TubeRoom {
  double begins = 0.0;  ///< of its axis along the flats [m]
  double from = 0.0;    ///< what flanges leave of it, along its axis [m]
  double to = 0.0;
  TubeGore* body = nullptr;
};

/// Of a trough.
struct TroughSide {
  double height = 0.0;              ///< of its upright sides [m]
  std::optional<RimOptions> rim{};  ///< along their tops
};

/// An opening that was cut.
struct TubeOpening {
  std::size_t tube = 0;
  TubeWindow lid;
  std::vector<TubeHole> bolts;  ///< in the lid
  int bolt = 0;                 ///< [mm]
  double at = 0.0;              ///< its middle along the track [m]
  double asked = 0.0;
};

/// Cuts openings and the holes of their bolts into tubes.
/// @param flats  where places on the track lie along the tubes
/// @throws InputError where one finds no place in the tubes near it, or two meet: the place or length that would do
/// @param trough  what stands on half a one; none: whole tubes
[[nodiscard]] std::vector<TubeOpening> cut_tubes(const std::vector<InspectionOptions>& openings,
                                                 const std::vector<TubeRoom>& tubes,
                                                 const std::optional<TroughSide>& trough,
                                                 const FlatPlaces& flats, const ShopLeast& shop);

/// The lid of an opening as a rolled plate in the frame of its tube, its pattern seen from inside.
[[nodiscard]] ShopPart tube_lid(const TubeOpening& opening, const TubeGore& tube,
                                const StockMaterial& material);

/// What keeps openings out of tubes, whatever the track is.
/// @param side  of half a pipe: height of its upright sides; none: a whole one
[[nodiscard]] std::vector<Issue> tube_opening_problems(const section::Pipe& pipe, std::optional<double> side,
                                                       const PlateOptions& options);

/// @return what openings take out of tubes: developed windows by the thickness, holes by their series [m^3]; <= 0
[[nodiscard]] double openings_volume(const std::vector<TubeRoom>& tubes);

}  // namespace glissade::parts
