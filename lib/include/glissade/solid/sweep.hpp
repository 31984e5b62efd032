#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/capacity.hpp"
#include "glissade/core/error.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/section/cross_section.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

namespace glissade {

/// How closely a mesh follows the swept solid, and how large it may become.
struct SweepOptions {
  /// Greatest distance between the mesh and the ideal solid [m]; > 0.
  double tolerance = 0.5e-3;
  /// Refuse a mesh that would need more triangles than this; >= 1000.
  std::size_t max_triangles = kMostTriangles;
  /// About how many triangles may be spent on well shaped facets where the tolerance alone needs fewer.
  std::size_t shape_triangles = 1'000'000;
  /// Greatest angle that the track, or a round outline, may turn through from one facet to the next; > 0. Without
  /// it, the tolerance alone decides, and 0.25 rad.
  std::optional<Angle> largest_kink = {};
  /// Ends the sweep within some milliseconds.
  std::stop_token stop = {};
};

/// A swept solid and what the sweep knows of it.
struct Solid {
  TriangleMesh mesh;
  Placement placement;         ///< that of its frame
  double max_deviation = 0.0;  ///< greatest measured distance between mesh and ideal solid [m]
  bool trimmed = false;        ///< parts of the naive sweep that would have folded over were cut away
  double exact_volume = 0.0;   ///< of the ideal solid, arcs round, trims cut; see kSweepVolumeAccuracy [m^3]
  long long expected_euler = 2;  ///< Euler characteristic that this cross-section must give
  std::vector<double> stations;  ///< arc lengths of the mesh's rows of vertices, ascending [m]
};

/// Sweeps a cross-section along a centerline into one closed surface.
///
/// Shape: the set of points whose signed distance to the centerline (height) and distance from its plane
///   (across) lie inside the cross-section, between the two end faces, which are square to the track
///   (docs/solid.md). Where every radius of curvature exceeds the section's reach towards it, that is the
///   ordinary sweep. Elsewhere the ordinary sweep folds over itself; here each level of the section is an
///   offset curve trimmed at the end faces and where its branches meet (a crease), so that the end face of a
///   vertical start is wider than the section is high.
/// Accuracy: max_deviation <= options.tolerance, measured between the stations and inside the facets near
///   trims. Volume of the mesh tends to exact_volume at order 2 in the distance of the stations.
/// Identity: same input, same mesh. The mesh is closed, manifold, oriented outward, one component, without
///   self-intersection or degenerate facet, of the expected Euler characteristic.
/// @throws InputError if
///   - the section cannot follow the track: names the place, the radius there and the largest height above or
///     depth below the floor that works;
///   - options.tolerance is not finite and positive, options.largest_kink not positive, or finer than the coordinates can carry;
///   - the mesh would exceed options.max_triangles: names its size in triangles and bytes, and a tolerance
///     that fits; decided before anything of that size is allocated
/// @throws Interrupted if options.stop asks for it
[[nodiscard]] Solid sweep(const Centerline& centerline, const CrossSection& section,
                          const Placement& placement, const SweepOptions& options = {});

/// What keeps a section from following a track, at a fraction of what a mesh takes: where sweep() has no mesh to give for it.
/// @param tolerance  of the mesh that is laid out for it, and laid out finer before anything is said [m]; > 0
/// @throws InputError if it is not finite and positive
/// @return where it is, and how far the section may reach there; none where every level leads from the start face to the finish face,
///   or where telling would take a mesh of more than half a million triangles or finer than coordinates carry: sweep() tells then
[[nodiscard]] std::optional<Issue> obstacle_to_sweep(const Centerline& centerline,
                                                     const CrossSection& section, double tolerance);

/// Stated bound of the relative error of Solid::exact_volume, measured in docs/accuracy.md: V = A S - M dphi
/// to rounding where nothing is trimmed (A area, S arc length, M first moment, dphi angle turned towards the
/// upper side), else less the integral of the lengths that the levels lose.
inline constexpr double kSweepVolumeAccuracy = 1e-7;

}  // namespace glissade
