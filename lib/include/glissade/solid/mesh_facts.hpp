#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// Where the first fault of each kind lies, by the number of vertex or facet [m]; none where there is none, or
/// where it is not known.
struct MeshFaultPlaces {
  std::optional<Vec3> boundary_edge;        ///< middle of the edge
  std::optional<Vec3> non_manifold_edge;    ///< middle of the edge
  std::optional<Vec3> non_manifold_vertex;  ///< the vertex
  std::optional<Vec3> degenerate_facet;     ///< its first corner
  std::optional<Vec3> duplicate_vertex;     ///< the position that two vertices share
  std::optional<Vec3> self_intersection;    ///< middle of the corners of both facets
  std::optional<Vec3> inside_out_piece;     ///< a corner of it
  std::optional<Vec3> nested_piece;         ///< a corner of it
};

/// Everything that is known of a mesh, measured on the mesh alone.
///
/// The output of sweep() always has: closed, manifold, oriented outward, one component, no self-intersection,
/// no degenerate facet, the Euler characteristic of its cross-section.
/// Accuracy: counts are exact (predicates decide in exact arithmetic where doubles do not suffice); volume
/// and area as kMeshMeasureAccuracy.
struct MeshFacts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;             ///< pieces of the surface, each joined through edges
  std::size_t boundary_edges = 0;         ///< edges with one facet only; 0 = closed
  std::size_t non_manifold_edges = 0;     ///< edges with three facets or more, or two of opposite winding
  std::size_t non_manifold_vertices = 0;  ///< vertices whose facets are not one fan
  std::size_t degenerate_facets = 0;      ///< corners on one line, or the same vertex twice
  std::size_t duplicate_vertices = 0;     ///< vertices at the position of an earlier one
  std::size_t unused_vertices = 0;        ///< that no facet has; no fault, and no part of the bounding box
  /// Pairs of facets that meet elsewhere than in a common edge or vertex (common: of equal position).
  /// Degenerate facets are left out, they are a fault of their own.
  std::size_t self_intersections = 0;
  /// False: the search stopped at a limit of its work (100,000 pairs found, or 200 pairs of overlapping boxes
  /// a facet tested), `self_intersections` is a lower bound and the mesh is not proven.
  bool self_intersections_complete = true;
  /// Closed, and facets face out of the material: every piece encloses positive volume, or negative volume (a
  /// cavity) if it lies within the material of others. Where pieces intersect or meet, and beyond 5,000
  /// pieces: every piece encloses positive volume.
  bool oriented_outward = false;
  std::size_t inside_out_pieces = 0;  ///< pieces that face inward and are no cavity; 0 unless closed
  std::size_t nested_pieces = 0;  ///< pieces that face outward within the material of others; 0 unless closed
  long long euler_characteristic = 0;  ///< V - E + F; 2 for a sphere-like solid, 0 for a pipe
  double volume = 0.0;         ///< enclosed [m^3], positive where oriented outward; meaningless unless closed
  double area = 0.0;           ///< [m^2]
  Angle smallest_angle;        ///< of any facet; 0 if one is degenerate
  double shortest_edge = 0.0;  ///< [m]
  MeshFaultPlaces places;
  Vec3 lower;  ///< bounding box of the facets [m]
  Vec3 upper;

  [[nodiscard]] bool closed() const { return triangles > 0 && boundary_edges == 0; }
  [[nodiscard]] bool manifold() const { return non_manifold_edges == 0 && non_manifold_vertices == 0; }
  /// closed and manifold: a slicer knows inside from outside
  [[nodiscard]] bool watertight() const { return closed() && manifold(); }
  /// watertight, outward, proven free of self-intersection, without degenerate facet or duplicate vertex
  [[nodiscard]] bool valid() const;
  /// @return every fault in plain words with its number and the place of the first, empty if valid()
  [[nodiscard]] std::vector<std::string> faults() const;
};

/// Stated bound of the relative error of MeshFacts' area, and of its volume relative to area times the
/// diagonal of the bounding box.
inline constexpr double kMeshMeasureAccuracy = 1e-14;

/// Coordinates beyond this are refused [m]: their products would leave the range of a double.
inline constexpr double kLargestMeshCoordinate = 1e60;

/// Meshes whose bounding box is smaller on its longest side are refused [m], for the same reason; one that is a single
/// point is not.
inline constexpr double kSmallestMeshSize = 1e-60;

/// Measures a mesh; never throws for a faulty one: that is what the facts are for.
/// @throws InputError if a triangle names a vertex that does not exist, a coordinate is not finite or beyond
///         kLargestMeshCoordinate, the mesh is smaller than kSmallestMeshSize, or there are 2^32 - 1 vertices or triangles or more; Interrupted if `stop`
///         asks for it
[[nodiscard]] MeshFacts measure(const TriangleMesh& mesh, const std::stop_token& stop = {});

}  // namespace glissade
