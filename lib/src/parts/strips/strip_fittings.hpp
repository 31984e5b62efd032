#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/plates/liner_tiles.hpp"
#include "parts/strips/strip_shape.hpp"
#include "parts/strips/strip_sheet.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::parts {

/// What is set on sections whose plates are strips: rims along the tops of their outer sides, covers on them, tiles on the
/// floor or, where there is none that is flat, on every plate.

/// @return what frames and folds leave of a unit to a plate
[[nodiscard]] Span room_of(const StripJob& job, const Span& unit, const SectionPlate& plate);

/// The part of a plate that is not of the section itself, between two places.
/// @param holes  (place along the track, y along its face); where the width changes of level plates alone, y from where `face_from` is
///               told
[[nodiscard]] ShopPart set_plate(const StripJob& job, const SectionPlate& plate, double thickness,
                                 const Span& span, const StockMaterial& material,
                                 const std::vector<Circle>& holes);

/// Rims of plates that are bent: flats between bends as theirs.
/// @return what was listed
std::vector<Strip> add_bent_rims(const StripJob& job, const BentStrips& bent, Workshop& workshop);
void add_strip_rims(const StripJob& job, const std::vector<double>& joints, Workshop& workshop);
void add_strip_covers(const StripJob& job, const std::vector<double>& joints, Workshop& workshop);

/// The tiles of a unit.
/// @param index   of the unit, from 0
/// @param breaks  places that no hole lies across
/// @param row     courses before it; counts on
[[nodiscard]] std::vector<TilePlace> strip_tiles(const StripJob& job, const Span& unit, std::size_t index,
                                                 const std::vector<double>& breaks, int& row);
/// @return the holes of tiles in the plates below them, one list a plate
[[nodiscard]] std::vector<std::vector<Circle>> holes_below(const StripJob& job, std::size_t unit,
                                                           const std::vector<TilePlace>& tiles);
void add_strip_liner(const StripJob& job, const std::vector<TilePlace>& tiles, Workshop& workshop);

/// What of a lined face holds tiles: from `low` along it.
struct Lane {
  double low = 0.0;
  double width = 0.0;
};
/// Between the corners of the section and of the plate below, whichever are nearer to the middle: tiles are cut square.
[[nodiscard]] Lane lane_of(const PlateSection& section, const LinedFace& face);

/// What is bent along the track beside the plates themselves, or these, whichever is thickest.
/// @return of a punch too sharp for it; none of one that is not
[[nodiscard]] std::optional<Issue> too_tight_a_bend_of_any(double plate, const PlateOptions& options);

/// What no shop can set on a section, whatever the track is.
[[nodiscard]] std::vector<Issue> section_fitting_problems(const PlateSection& section,
                                                          const PlateOptions& options);

}  // namespace glissade::parts
