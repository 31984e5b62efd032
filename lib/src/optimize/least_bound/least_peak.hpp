#pragma once

#include "glissade/optimize/optimize.hpp"

namespace glissade::optimizer {

/// The track on which the floor of a stream wears least where it wears most, over all frictions: least_peak_wear.
///
/// Method: the wear of the floor is the one limit that gives way in a search for the least violation, from the product's
///   own starts and from the fastest track, on every way past the keep-outs; what it has to give way to is the peak.
///   Within a bound just above it the fastest track is searched for, on whose finer mesh the peak is searched for again,
///   until the two agree. Prices are the multipliers of the peak.
/// @param problem  its objective is least_peak_wear, its body a stream; sound, as require_searchable() has it
[[nodiscard]] Optimum least_peak(const Problem& problem, const OptimizeOptions& options,
                                 const std::stop_token& stop, const Progress& progress);

}  // namespace glissade::optimizer
