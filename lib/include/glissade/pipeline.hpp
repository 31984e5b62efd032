#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/progress.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/placement.hpp"
#include "glissade/solid/sweep.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// The one way that data flow: design -> centerline -> motion -> solid -> files.

/// A centerline with the ride down it and the two times that it is measured by.
struct Track {
  Endpoints endpoints;
  CenterlinePtr centerline;
  Motion motion;
  /// Travel time of the same body on the straight line between the endpoints [s]; none if it does not arrive
  /// there.
  std::optional<double> straight_travel_time;
  /// Least possible travel time from rest without drag (docs/theory.md, Coulomb brachistochrone) [s]; none
  /// where that theory does not apply (entry speed or drag).
  std::optional<double> optimum_travel_time;
  double min_radius =
      0.0;  ///< smallest radius of curvature, 0 at an unbounded start, infinity on a straight [m]
};

/// Design to centerline and motion.
/// @throws InputError, InfeasibleError, ConvergenceError with the location in the design file
[[nodiscard]] Track solve(const Design& design);

struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};

struct Build {
  Track track;
  Placement placement;
  Solid solid;
  MeshFacts facts;  ///< of the mesh as written, and confirmed on the files read back
  std::vector<WrittenFile> files;
};

/// Design to files in `directory` (made if missing). Nothing is left there unless everything succeeded.
/// @throws as solve(); FileError if a file cannot be written; InternalError if a written mesh is faulty
[[nodiscard]] Build build(const Design& design, const std::filesystem::path& directory,
                          const Progress& progress = {});

}  // namespace glissade
