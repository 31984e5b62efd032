#pragma once

#include "glissade/pipeline/redesign.hpp"
#include "glissade/task/problem.hpp"

#include <vector>

namespace glissade::pipeline {

/// The clearances and waypoints of a design, counted from the edge of its in-run; of its other limits rules take the place.
[[nodiscard]] Problem places_to_edge(const Design& design, const Endpoints& certificate);

/// The same, counted from a place before the edge.
[[nodiscard]] Limits moved(Limits limits, Vec2 from_there_to_edge);

/// Along which gates lie, and no bend begins [m]; 0 where the design says nothing of it.
[[nodiscard]] double start_area_of(const Design& design);

/// How far a track is straight from its start on [m].
[[nodiscard]] double straight_of(const Centerline& track);

/// Tells of each shape but the free one, which the search holds to it, where gates would lie in the bend.
/// @param area  start_area_of() [m]
void hold_to_area(double area, std::vector<RedesignShape>& shapes);

/// Tells of each shape what it runs into.
void hold_against(Problem places, std::vector<RedesignShape>& shapes);

}  // namespace glissade::pipeline
