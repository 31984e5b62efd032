#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade {

/// Everything that is known of a mesh, measured on the mesh alone.
///
/// The output of sweep() always has: closed, manifold, oriented outward, one component, no self-intersection,
/// no degenerate facet, the Euler characteristic of its cross-section.
struct MeshFacts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;             ///< connected pieces of the surface
  std::size_t boundary_edges = 0;         ///< edges with one facet only; 0 = closed
  std::size_t non_manifold_edges = 0;     ///< edges with three facets or more, or two of opposite winding
  std::size_t non_manifold_vertices = 0;  ///< vertices whose facets are not one fan
  std::size_t degenerate_facets = 0;      ///< of zero area, or with a vertex twice
  std::size_t duplicate_vertices = 0;     ///< positions that occur more than once
  std::size_t unused_vertices = 0;
  std::size_t self_intersections =
      0;                          ///< pairs of facets that meet elsewhere than in a shared edge or vertex
  bool oriented_outward = false;  ///< every closed piece encloses positive volume
  long long euler_characteristic = 0;  ///< V - E + F; 2 for a sphere-like solid, 0 for a pipe
  double volume = 0.0;                 ///< enclosed [m^3], positive where oriented outward
  double area = 0.0;                   ///< [m^2]
  double smallest_angle = 0.0;         ///< of any facet [rad]
  double shortest_edge = 0.0;          ///< [m]
  Vec3 lower;                          ///< bounding box [m]
  Vec3 upper;

  [[nodiscard]] bool closed() const { return triangles > 0 && boundary_edges == 0; }
  [[nodiscard]] bool manifold() const { return non_manifold_edges == 0 && non_manifold_vertices == 0; }
  /// closed and manifold: a slicer knows inside from outside
  [[nodiscard]] bool watertight() const { return closed() && manifold(); }
  /// watertight, outward, free of self-intersection and of degenerate facets
  [[nodiscard]] bool valid() const;
  /// @return every fault in plain words with its number, empty if valid()
  [[nodiscard]] std::vector<std::string> faults() const;
};

/// Measures a mesh; never throws for a faulty one: that is what the facts are for.
/// @throws InputError if a triangle names a vertex that does not exist or a coordinate is not finite
[[nodiscard]] MeshFacts measure(const TriangleMesh& mesh);

}  // namespace glissade
