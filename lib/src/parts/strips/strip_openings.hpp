#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/strips/strip_shape.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::parts {

/// An inspection opening in a rolled strip, with the lid that is bolted over it from outside.
struct StripWindow {
  std::size_t plate = 0;
  std::size_t unit = 0;
  Span along;   ///< of the track
  Span across;  ///< along the plate's face, from `face_from`
  Span lid_along;
  Span lid_across;
  std::vector<Vec2> bolts;  ///< (place along the track, along the plate's face)
  int bolt = 0;             ///< [mm]
  double asked = 0.0;       ///< where its middle was to be [m]
};

/// The openings of a unit.
/// @param index   of the unit, from 0
/// @param breaks  places along the track that no hole lies across
/// @throws InputError where one reaches over the unit's end, or finds no place on one arc: the place that would do
[[nodiscard]] std::vector<StripWindow> windows_of(const StripJob& job, const Span& unit, std::size_t index,
                                                  const std::vector<double>& breaks);

/// @throws InputError where an opening is not on the track, or two of them meet
void require_openings_on_track(const StripJob& job);

/// What lids take of the plate that is opened.
struct LidStretch {
  std::size_t plate = 0;
  Span across;  ///< along the plate's face, from `face_from`
};
/// @return that of the highest lid; none of a section without openings, or without a side for them
[[nodiscard]] std::optional<LidStretch> lid_stretch(const PlateSection& section, const PlateOptions& options);

void add_strip_lids(const StripJob& job, const std::vector<StripWindow>& windows, Workshop& workshop);

/// What keeps openings out of a section, whatever the track is.
[[nodiscard]] std::vector<Issue> strip_opening_problems(const PlateSection& section,
                                                        const PlateOptions& options);

}  // namespace glissade::parts
