#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"
#include "glissade/motion/motion.hpp"

#include <optional>

namespace glissade {

/// The friction inside a range at which the floor below a stream wears most, where it wears most along its track.
///
/// W_c goes with mu N (BulkStream::floor_wear()). The rougher the floor, the slower the stream, and the less it is pressed on a
/// floor that bends as in a valley: mu N, and with it the peak of W_c over the track, may be greatest between the ends of a range.
/// Method: rides at twelve frictions that share the range evenly, then Brent's method around each of them that may lie next
///   to the highest peak. A ride that ends early counts as far as it goes, one that does not land not at all.
/// Accuracy: friction to 1e-5 of the range, W_c to some 1e-10 of itself, where there is one peak. Of a track that was searched for
///   within such a limit two may lie less than a twelfth of the range apart, about as high: W_c to some 1e-4 of itself.
/// Cost: some twenty to sixty rides.
/// @param body  a stream; its own friction plays no part
/// @throws InputError if the body is no stream, or as Motion
/// @return none where the peak is greatest at an end of the range, or by no more than 1e-9 of itself inside
[[nodiscard]] std::optional<Friction> friction_of_most_wear(const CenterlinePtr& centerline, const Body& body,
                                                            double gravity, Friction low, Friction high);

}  // namespace glissade
