#pragma once

#include "glissade/io/file_set.hpp"
#include "glissade/pipeline/solve.hpp"

#include <filesystem>

namespace glissade {

/// Writes a track that was found as a design of its own, in which nothing is searched for or fitted any more: to be
/// judged at other frictions, changed in other respects, built again.
///
/// A track of straights, arcs and clothoids (searched, fitted) becomes the kind `segments`; segments stay as they were
/// told. Any other becomes the kind `points` with a table of its slope angles and curvatures, FILE with the ending .csv
/// beside it, from which a body flies free where it did. All else of
/// the design is kept; the finish is the place where the track ends.
/// Accuracy: solve() of the new design gives travel time, speeds and places as they were to kTableAccuracy and kTableRounding, or to
///   rounding where the track becomes segments. Where a body comes to the finish at less than some 3e-6 of the speed of a fall
///   by the length of the track, rounding decides whether it does so on the table: a remark in the file says so.
/// @param file  to write, with an ending other than .csv
/// @throws InputError if its ending is .csv, or if a file that is no table of a frozen track stands where its own is to go; FileError
///   as AtomicFile
void write_frozen_design(const std::filesystem::path& file, const Design& design, const Track& track);

/// The same beside other files: design and table take their places with those.
void add_frozen_design(FileSet& files, const std::filesystem::path& file, const Design& design,
                       const Track& track);

}  // namespace glissade
