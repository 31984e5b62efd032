#pragma once

#include "glissade/parts/workshop_build.hpp"

#include "parts/prints/print_split.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// What is printed of a stand in one piece, as it stands.
struct StandBlock {
  TriangleMesh mesh;    ///< in the frame (x - that of the stand, across, height)
  double volume = 0.0;  ///< exactly, holes taken off [m^3]
};

/// A foot that holds the run between two cheeks, in as many blocks as the height of the printer asks for.
struct Stand {
  double at = 0.0;                 ///< arc length of the place above its middle [m]
  std::string what;                ///< what it stands below: "joint 2", "start"
  double x = 0.0;                  ///< of its middle [m]
  double ground = 0.0;             ///< height [m]
  std::vector<StandBlock> blocks;  ///< from below
  std::vector<Vec3> pins;  ///< middles of the pins between blocks, upright, in the frame of the blocks
};

inline constexpr double kLeastStand = 4e-3;  ///< between ground and run [m]
/// Pins between the blocks of stands.
inline constexpr double kStandPin = 4e-3;       ///< diameter [m]
inline constexpr double kStandPinDepth = 6e-3;  ///< of each hole [m]

/// Stands below joints and ends, and between them where they are too far apart.
/// @param workshop  is told which of them find no place
/// @throws InputError where the ground lies too near the run or above it, or its line ends before a stand: names the place
[[nodiscard]] std::vector<Stand> make_stands(const PrintJob& job, const std::vector<double>& joints,
                                             Workshop& workshop);

}  // namespace glissade::parts
