#pragma once

#include "glissade/parts/nest.hpp"
#include "glissade/parts/shop_part.hpp"

#include <string>
#include <vector>

namespace glissade {

/// Tables of what a workshop makes, as CSV: comma separated, a header line with units, quotes round texts that hold a comma,
/// quote or line end; numbers are the shortest decimals that read back as the same double, millimetres, degrees and
/// kilograms; `inf` where a radius is unbounded.

/// Columns: number, name, material, thickness_mm, quantity, length_mm, width_mm (of the least rectangle round the flat pattern: what it is
/// cut from; of a tube or angle the length of straight bar that it takes and the width of its section; else empty), cut_length_mm, holes, bends, mass_kg, total_mass_kg,
/// centre_of_gravity_x_mm, _y_mm, _z_mm, bought_in, section ("tube 60 x 60 x 4 mm", "angle 50 x 50 x 6 mm").
[[nodiscard]] std::string cut_list_csv(const Workshop& workshop);

/// Columns: name, standard, quantity, where.
[[nodiscard]] std::string bought_in_csv(const Workshop& workshop);

/// Columns: sheet (the stem of its file), material, thickness_mm, length_mm, width_mm, margin_mm, spacing_mm, pieces, parts_area_m2
/// (without holes), utilisation_percent (that area over the sheet's), parts ("2 x no. 4; 1 x no. 7").
/// @param sheets  of nest(workshop)
[[nodiscard]] std::string nests_csv(const Workshop& workshop, const std::vector<NestedSheet>& sheets);

/// Columns: part, hit, distance_mm, length_mm, angle_deg, sum_deg, radius_mm, chord_error_mm.
[[nodiscard]] std::string bend_schedule_csv(const Workshop& workshop);

/// Columns: what, arc_length_mm, run_mm, z_mm, site_x_m, site_y_m, site_z_m, slope_deg, slope_percent, radius_mm, ordinate_mm,
/// then the heights z of the lines below, plumb below the place: underside_of_deck_plumb_mm; empty where such a line ends short of it.
[[nodiscard]] std::string setting_out_csv(const Workshop& workshop);

/// Columns: rule, verdict, value, bound, where, source.
[[nodiscard]] std::string shop_checks_csv(const Workshop& workshop);

}  // namespace glissade
