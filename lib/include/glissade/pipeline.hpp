#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/progress.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/solid/cross_section.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/placement.hpp"
#include "glissade/solid/sweep.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// The one way that data flow: design -> centerline -> motion -> solid -> files.

/// How long work tells how far it is, and is asked to end.
struct RunContext {
  Progress progress;
  std::stop_token stop;
};

/// A centerline with the ride down it and the two rides that it is measured by.
struct Track {
  Endpoints endpoints;
  Placement placement;
  CenterlinePtr centerline;
  Motion motion;
  /// The same body on the straight line between the endpoints; none if it does not arrive there.
  std::optional<Motion> straight;
  /// The ride on the fastest track there is, which the theory gives from rest and without drag
  /// (docs/theory.md, fastest track); none where it does not apply.
  std::optional<Motion> optimum;
  /// Travel time of `optimum` by its closed form, which shares nothing with Motion [s].
  std::optional<double> optimum_travel_time;
  /// Smallest radius of curvature [m]: 0 where the curvature is unbounded at the start, infinity on a
  /// straight.
  double min_radius = 0.0;
  double steepest_slope_angle = 0.0;  ///< largest slope angle anywhere [rad]

  /// @return travel time on the straight line [s]; none if the body does not arrive there
  [[nodiscard]] std::optional<double> straight_travel_time() const;
};

/// Where a design's track leads, in the plane of its centerline.
[[nodiscard]] Endpoints endpoints_of(const Design& design);

/// The curve that a design asks for.
/// @throws InputError, InfeasibleError, ConvergenceError, FileError with the location in the design
[[nodiscard]] CenterlinePtr make_centerline(const Design& design);

/// The ride of the design's body down a given centerline, and what it is measured by.
[[nodiscard]] Track ride(const Design& design, CenterlinePtr centerline);

/// Design to centerline and motion. A body that stalls or leaves the track is a result, not an error.
/// @throws InputError with everything that check() finds; else as make_centerline()
[[nodiscard]] Track solve(const Design& design, const RunContext& context = {});

/// Why a ride is not what was wanted: the body stalls or leaves the track.
/// @return the problem with the place and what is missing there; none if the body arrives
[[nodiscard]] std::optional<Issue> ride_problem(const Design& design, const Track& track);

/// The outline that a design asks for.
/// @throws InputError if the measures do not make a cross-section
[[nodiscard]] CrossSection make_cross_section(const CrossSectionDesign& design);

struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};

struct Build {
  Track track;
  CrossSection section;
  Solid solid;
  MeshFacts
      facts;  ///< of the mesh as the least precise of the files holds it, confirmed on each file read back
  std::vector<WrittenFile> files;
};

/// Design to files in `directory` (made if missing), each named after the design file. Either all of them
/// appear, or the directory stays as it was, files of an earlier build included.
/// @throws as solve(); InputError if the design has no cross_section or the section cannot follow the track;
///         InfeasibleError if the body does not arrive; FileError if a file cannot be written;
///         Interrupted if the context's stop token asks for it; InternalError if a mesh turns out faulty
[[nodiscard]] Build build(const Design& design, const std::filesystem::path& directory,
                          const RunContext& context = {});

}  // namespace glissade
