#pragma once

#include "glissade/section/measures.hpp"

#include "parts/plates/shell.hpp"
#include "parts/strips/flats_line.hpp"
#include "parts/strips/strip_works.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// @return the outside of a section of plates, where it is narrowest
[[nodiscard]] SectionOutside outside_of(const PlateSection& section, const PlateOptions& options);

/// Strips as what stiffeners, lugs and trestles are set on.
/// @param bent   none: they are rolled
/// @param flats  along whose line the works of bent ones are; none: they have none
/// @param works  of rolled ones along the track
[[nodiscard]] Shell strip_shell(const StripJob& job, const std::optional<BentStrips>& bent,
                                const FlatsJob* flats, const std::vector<double>& joints,
                                const std::vector<UnitWork>& works, Workshop& workshop, TakenUp& taken);

/// Mitred tubes, or the troughs of half a pipe, as what they are set on.
/// @param side    of half a pipe: height of its upright sides above the axis [m]
/// @param facets  the tubes' lowest lines
[[nodiscard]] Shell pipe_shell(const ArcSpline& track, const section::Pipe& pipe, std::optional<double> side,
                               const PlateOptions& options, const Placement& placement, const Facets& facets,
                               const std::vector<double>& joints, Workshop& workshop, TakenUp& taken);
/// @return their outside
[[nodiscard]] SectionOutside outside_of(const section::Pipe& pipe, std::optional<double> side);

/// What no shop can set on a section so, whatever the track is.
[[nodiscard]] std::vector<Issue> strip_shell_problems(const PlateSection& section,
                                                      const PlateOptions& options);

}  // namespace glissade::parts
