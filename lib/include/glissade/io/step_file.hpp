#pragma once

#include "glissade/parts/shop_part.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace glissade {

/// Parts and assemblies as STEP (ISO 10303-21, schema AUTOMOTIVE_DESIGN: AP214), in millimetres.
///
/// Each part is one closed solid of planes, cylinders and cones, bounded by lines, circles and ellipses, with its name and
/// colour; the assembly is a tree of their places. No face is a facet, and none a spline but for plates beside a width that
/// changes along a curve: those are ruled between cubics.
/// Bytes depend on the arguments alone (the time stamp is fixed); coordinates are rounded to kStepRounding.
/// Accuracy: each vertex lies on the curves and surfaces that meet there within kStepAccuracy.

/// Coordinates are whole multiples of this [mm].
inline constexpr double kStepRounding = 1e-9;
/// Largest distance of a vertex from its curves and surfaces [mm], for parts up to 100 m across; beyond the rounding of a radius,
/// four units in its last place, where an arc is all but straight.
inline constexpr double kStepAccuracy = 1e-8;

/// Largest radius [mm]: coordinates of a centre farther away are no finer than 0.004 mm, and readers make nothing of what is beyond.
inline constexpr double kStepLargestRadius = 2e13;

/// @return one part, in its own frame
/// @throws InputError if a body is none: a region with faults_of(), a depth, radius or length that is not positive, a path
///         with kinks, a section that reaches beyond the centre of an arc, planes of a gore that meet inside the tube
[[nodiscard]] std::string step_text(const ShopPart& part);

/// @return every part once and the assembly of all their places
/// @throws InputError as above, and if there is no part
[[nodiscard]] std::string step_text(const Workshop& workshop);

/// Write beside the target and rename into place.
/// @throws FileError as AtomicFile; InputError as step_text()
void write_step(const std::filesystem::path& file, const ShopPart& part);
void write_step(const std::filesystem::path& file, const Workshop& workshop);

/// What a STEP file holds of one solid.
struct StepSolid {
  std::string name;  ///< of its product
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t planes = 0;
  std::size_t cylinders = 0;
  std::size_t cones = 0;
  std::size_t splines = 0;
  std::size_t loops = 0;  ///< of all faces
  /// Every edge is used twice, once in each direction, each loop is a closed chain, and the count of vertices, edges, faces
  /// and loops is that of a closed surface (Euler and Poincare).
  bool closed = false;
  double worst_gap_mm = 0.0;       ///< of a vertex from a curve or surface that it bounds [mm]
  double largest_radius_mm = 0.0;  ///< of its circles, cylinders and cones [mm]

  [[nodiscard]] std::size_t faces() const { return planes + cylinders + cones + splines; }
};

/// What a STEP file holds, as it was read back.
struct StepFacts {
  std::vector<StepSolid> solids;
  std::vector<std::string> occurrences;  ///< of parts in the assembly, by their names
};

/// Reads the entities of a STEP file as this writer makes them and checks the topology of every solid.
/// @throws FileError if the file cannot be read, is no STEP file, is cut off, refers to an entity that it does not have,
///         or has a face of another kind; says which entity
[[nodiscard]] StepFacts read_step_facts(const std::filesystem::path& file);

/// Holds a STEP file against what it was written from: solids and their names, places, closed shells, gaps, radii up to
/// kStepLargestRadius.
/// @throws InternalError if anything differs; FileError as read_step_facts()
void require_same_step(const std::filesystem::path& file, const Workshop& workshop);
void require_same_step(const std::filesystem::path& file, const ShopPart& part);

}  // namespace glissade
