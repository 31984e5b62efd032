#pragma once

#include "glissade/trades/ski_jump/gates.hpp"

#include <filesystem>

namespace glissade {

/// Writes the gates of a hill, one a line: number, distance to the edge, place, and of each condition travel time, speeds,
/// highest load and the derivatives of the speed at the measuring place; SI, every number with all its digits. Of a
/// body that does not arrive the ride's cells are empty.
/// @throws FileError as AtomicFile
void write_gates_csv(const std::filesystem::path& file, const GateTable& table);

}  // namespace glissade
