#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/joint_face.hpp"

#include <cstdint>
#include <vector>

namespace glissade::parts {

/// A flat face of a mesh in space: its normal right x up points out of the material.
struct FacePlane {
  Vec3 origin;
  Vec3 right;
  Vec3 up;

  [[nodiscard]] Vec3 outward() const { return cross(right, up); }
  [[nodiscard]] Vec2 see(Vec3 point) const { return {dot(point - origin, right), dot(point - origin, up)}; }
  [[nodiscard]] Vec3 to_space(Vec2 at, double depth) const {
    return origin + at.x * right + at.y * up - depth * outward();
  }
};

/// @return numbers of the vertices that lie in a plane
[[nodiscard]] std::vector<bool> vertices_in(const TriangleMesh& mesh, const FacePlane& plane);

/// Takes the triangles of the flat face that a mesh has in a plane out of it.
/// @return its edges, counter-clockwise round the outside
/// @throws InternalError if the face is not there
[[nodiscard]] std::vector<std::vector<std::uint32_t>> take_flat_face(TriangleMesh& mesh,
                                                                     const FacePlane& plane);

/// Sinks recesses into the flat face that a mesh has in a plane.
/// @param recesses  apart from one another and from the edges of the face
/// @throws InternalError if the face is not there, or recesses touch
void sink(TriangleMesh& mesh, const FacePlane& plane, const std::vector<Recess>& recesses);

/// Drops vertices that no triangle has: those that lay within a face that was made anew.
void drop_unused_vertices(TriangleMesh& mesh);

/// A round bar along z from 0, with both edges chamfered; nowhere wider than asked.
[[nodiscard]] TriangleMesh round_bar(double diameter, double length, double chamfer);

/// Volume and centre of a closed mesh.
struct MeshMoments {
  double volume = 0.0;  ///< [m^3]
  Vec3 centre;
};
[[nodiscard]] MeshMoments mesh_moments(const TriangleMesh& mesh);

}  // namespace glissade::parts
