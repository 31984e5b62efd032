#pragma once

#include "parts/plates/plate_unit.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// Corners between floor and walls. Of two plates one passes: the walls beside a floor, or the floor below them. Where
/// corners lap, that one reaches beyond the other's far face; it does not where frames stand. With tabs, it has slots.

inline constexpr double kLapAside = 5e-3;  ///< of laps from the frames that they end before [m]
inline constexpr double kOffJoint = 1e-3;  ///< of slots and steps from joints of the arcs [m]

/// Measures the webs beside the slots of all parts, for rules of the shop.
void measure_slots(Workshop& workshop);

/// @return how far the passing plate reaches; 0 of corners that butt, and without walls [m]
[[nodiscard]] double overlap(const Job& job);
[[nodiscard]] bool has_tabs(const Job& job);

/// @return width of the floor with everything that reaches out of it [m]
[[nodiscard]] double floor_width(const Job& job);
/// @return of it, what goes from end to end: without tabs [m]
[[nodiscard]] Span floor_base(const Job& job);

/// Places of tabs along the face of a floor: on one of its arcs or flats each, off the ends, where frames are, and off bends.
/// @return from and to of each tab, ascending; none where corners have none
/// @throws InputError if there is no place for one: what is, and a way out
[[nodiscard]] std::vector<Span> tab_places(const Job& job, const FloorFace& face, std::size_t unit);

/// @return where the passing plate reaches out, along a line of that length [m]
[[nodiscard]] Span lapped(const Job& job, double length);
/// @return the same of a floor, off the joints of its arcs
[[nodiscard]] Span lapped(const Job& job, const ArcSpline& line);

/// A floor as a sheet along its face: x from its upstream edge along the face, y across from its right edge.
[[nodiscard]] PlaneRegion floor_sheet(const Job& job, const ArcSpline& line, const std::vector<Span>& tabs);
/// @return the same on the flat
[[nodiscard]] PlaneRegion developed(const Job& job, const FloorFace& face, const PlaneRegion& sheet);

/// A wall in the plane of the track, with its slots or tabs.
/// @return none where it folds away
[[nodiscard]] std::optional<PlaneRegion> wall_region(const Job& job, const Span& span, const FloorFace& face,
                                                     const std::vector<Span>& tabs);

/// What no shop can make of the corners, whatever the track is.
[[nodiscard]] std::vector<Issue> corner_problems(const ChannelMeasures& channel, const PlateOptions& options);

}  // namespace glissade::parts
