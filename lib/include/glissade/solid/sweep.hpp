#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/solid/cross_section.hpp"
#include "glissade/solid/placement.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstddef>

namespace glissade {

struct SweepOptions {
  /// Greatest distance between the mesh and the ideal solid [m]; > 0.
  double tolerance = 0.5e-3;
  /// Refuse a mesh that would need more triangles than this; >= 1000.
  std::size_t max_triangles = 20'000'000;
};

/// A swept solid and what the sweep knows of it.
struct Solid {
  TriangleMesh mesh;
  double max_deviation = 0.0;    ///< greatest measured distance between mesh and ideal solid [m]
  bool trimmed = false;          ///< parts of the naive sweep that would have folded over were cut away
  double exact_volume = 0.0;     ///< of the ideal solid, V = A S - M dphi; valid where !trimmed [m^3]
  long long expected_euler = 2;  ///< Euler characteristic that this cross-section must give
};

/// Sweeps a cross-section along a centerline into one closed surface.
///
/// Trim: the solid is the set of points whose signed distance to the centerline (height) and offset from its
/// plane
///   (across) lie inside the cross-section, between the two end planes. Where every radius of curvature
///   exceeds the section's reach towards it, that is the ordinary sweep.
/// @throws InputError if the section cannot follow the track (names where, the radius there and the smallest
/// height
///   or width that works), if the options break their bounds, or if the mesh would exceed max_triangles
[[nodiscard]] Solid sweep(const Centerline& centerline, const CrossSection& section,
                          const Placement& placement, const SweepOptions& options = {});

}  // namespace glissade
