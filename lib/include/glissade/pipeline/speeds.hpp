#pragma once

#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/ski_jump/fit.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace glissade {

/// Reads measured speeds, with the tracks and bodies that they are of, from a CSV file (docs/ski-jumps.md): columns `design` (a
/// design file beside it; may be left out where `design` is given), one of `gate` and `length_m` (the length of in-run ridden, counted as the design counts e),
/// one of `speed_km_h` and `speed_m_per_s`, and, if wanted, `before_edge_m` (where it was measured; without it the
/// measuring place of the design) and `count`.
/// @param design  for rows without one
/// @throws FileError if the file cannot be read or lacks a column; InputError with the line where a gate or a length does not
///         belong to its hill; as read_design()
[[nodiscard]] std::vector<SpeedReading> read_speeds(const std::filesystem::path& file,
                                                    const std::optional<std::filesystem::path>& design = {});

}  // namespace glissade
