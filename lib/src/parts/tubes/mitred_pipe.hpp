#pragma once

#include "glissade/parts/plates.hpp"
#include "glissade/section/measures.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// A pipe as rolled tubes between mitred planes, or half a pipe as troughs, with flanges round the ends of transport units.
///
/// The lowest line of each tube is a flat that touches the track; its axis lies a radius above. Planes halve the angles
/// between tubes, so both ends of a mitre are the same ellipse. A tube develops to a rectangle of the mean circumference
/// between two sine lines, which are written as arcs within kSineTolerance; seams are turned by 20 deg to either side of the crown.
/// Of a trough the half turn develops to half a sine line, its sides go on as lines, tangent to it.
/// @param side  of half a pipe: height of its upright sides; none: a whole one
/// @throws InputError as make_plates()
[[nodiscard]] WorkshopBuild make_mitred_pipe(const ArcSpline& track, const section::Pipe& pipe,
                                             std::optional<double> side, const PlateOptions& options,
                                             const Placement& placement, const Body& body, double gravity,
                                             const Motion& design);

/// What no shop can make of mitred tubes or troughs, whatever the track is.
[[nodiscard]] std::vector<Issue> mitred_problems(const section::Pipe& pipe, std::optional<double> side,
                                                 const PlateOptions& options);

/// Greatest distance of the cut edge of a developed tube from its sine line [m].
inline constexpr double kSineTolerance = 0.02e-3;

}  // namespace glissade::parts
