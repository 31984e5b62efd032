#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/curves/offset_line.hpp"
#include "parts/plates/liner_tiles.hpp"
#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_openings.hpp"
#include "parts/strips/strip_shape.hpp"

#include <vector>

namespace glissade::parts {

/// What is cut from the plates of a unit besides their edges.
struct UnitWork {
  Span laps;               ///< where edges that pass reach out
  std::vector<Span> tabs;  ///< along the track
  std::vector<TilePlace> tiles;
  std::vector<StripWindow> windows;
  std::vector<std::vector<Circle>> holes;  ///< a list a plate: (place along the track, y along its face)
};

/// @return by how much slots are longer than tabs at either end [m]
[[nodiscard]] double slack_of(const StripJob& job);
[[nodiscard]] bool has_tabs(const StripJob& job);

/// @return the stretch of track on which every plate stands unfolded
[[nodiscard]] Span all_unfolded(const StripJob& job);

/// @return one a unit
/// @throws InputError where tabs or bolts of tiles find no place
[[nodiscard]] std::vector<UnitWork> works_between(const StripJob& job, const std::vector<double>& joints);

/// Rolled strips of all units, plate by plate.
[[nodiscard]] std::vector<Strip> strips_between(const StripJob& job, const std::vector<double>& joints,
                                                const std::vector<UnitWork>& works);

/// Plates of a bent job that have more than mitred edges get their laps, tabs, slots, holes and openings.
/// @param on_flats  along the flats, as its works
/// @param spans     of the strips along the line
void work_bent(const StripJob& on_flats, const std::vector<Span>& spans, const std::vector<UnitWork>& works,
               std::vector<Strip>& strips);

/// What rules of the shop may bound of tabs and slots.
void measure_tabs(const StripJob& job, const std::vector<double>& joints, const std::vector<UnitWork>& works,
                  Workshop& workshop);

}  // namespace glissade::parts
