// End faces get new triangles between their edge and what is sunk into them: no boolean operation, no vertex of the rest is
// touched, and the mesh stays as valid as it was.

#include "parts/bodies/piece_mesh.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kInPlane = 1e-10;  // [m]
constexpr int kBarCorners = 48;

using Triangle = std::array<std::uint32_t, 3>;

/// Loops of vertices round the triangles of a face, counter-clockwise round the outside.
std::vector<std::vector<std::uint32_t>> edges_of(const std::vector<Triangle>& face) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> sides;
  for (const Triangle& triangle : face) {
    for (std::size_t i = 0; i < 3; ++i) sides[{triangle[i], triangle[(i + 1) % 3]}] = true;
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [side, here] : sides) {
    if (!sides.contains({side.second, side.first})) next[side.first] = side.second;
  }
  std::vector<std::vector<std::uint32_t>> loops;
  while (!next.empty()) {
    std::vector<std::uint32_t> loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.empty() ? at->second : loop.back())) {
      loop.push_back(at->second);
      next.erase(at);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Triangle> take_face(TriangleMesh& mesh, const FacePlane& plane) {
  const std::vector<bool> in_plane = vertices_in(mesh, plane);
  std::vector<Triangle> face;
  std::vector<Triangle> rest;
  for (const Triangle& triangle : mesh.triangles) {
    const bool there = in_plane[triangle[0]] && in_plane[triangle[1]] && in_plane[triangle[2]];
    (there ? face : rest).push_back(triangle);
  }
  if (face.empty()) throw InternalError({"", "a piece has no face where it is joined", "", ""});
  mesh.triangles = std::move(rest);
  return face;
}

/// Adds the corners of a ring. @return the number of the first
std::uint32_t add_ring(TriangleMesh& mesh, const FacePlane& plane, const Recess::Ring& ring) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec2 corner : ring.corners) mesh.vertices.push_back(plane.to_space(corner, ring.depth));
  return first;
}

/// A closed line in a face, and the vertices that are its corners.
struct Loop {
  std::vector<Vec2> corners;
  std::vector<std::uint32_t> vertices;
};

bool contains(const std::vector<Vec2>& loop, Vec2 point) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i];
    const Vec2 b = loop[(i + 1) % loop.size()];
    if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
      inside = !inside;
  }
  return inside;
}

void add_walls(TriangleMesh& mesh, std::uint32_t above, std::uint32_t below, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({above + i, above + next, below + i});
    mesh.triangles.push_back({above + next, below + next, below + i});
  }
}

}  // namespace

std::vector<bool> vertices_in(const TriangleMesh& mesh, const FacePlane& plane) {
  const Vec3 outward = plane.outward();
  std::vector<bool> in_plane;
  in_plane.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    in_plane.push_back(std::fabs(dot(vertex - plane.origin, outward)) < kInPlane);
  }
  return in_plane;
}

std::vector<std::vector<std::uint32_t>> take_flat_face(TriangleMesh& mesh, const FacePlane& plane) {
  return edges_of(take_face(mesh, plane));
}

void sink(TriangleMesh& mesh, const FacePlane& plane, const std::vector<Recess>& recesses) {
  if (recesses.empty()) return;
  std::vector<Loop> outer;
  std::vector<Loop> inner;
  for (const std::vector<std::uint32_t>& edge : take_flat_face(mesh, plane)) {
    Loop loop;
    for (const std::uint32_t vertex : edge) loop.corners.push_back(plane.see(mesh.vertices[vertex]));
    loop.vertices = edge;
    (area_of(loop.corners) > 0.0 ? outer : inner).push_back(std::move(loop));
  }
  for (const Recess& recess : recesses) {
    const auto count = static_cast<std::uint32_t>(recess.rings.front().corners.size());
    std::uint32_t above = add_ring(mesh, plane, recess.rings.front());
    Loop mouth{recess.rings.front().corners, {}};
    for (std::uint32_t i = 0; i < count; ++i) mouth.vertices.push_back(above + i);
    inner.push_back(std::move(mouth));
    for (std::size_t ring = 1; ring < recess.rings.size(); ++ring) {
      const std::uint32_t below = add_ring(mesh, plane, recess.rings[ring]);
      add_walls(mesh, above, below, count);
      above = below;
    }
    for (const Triangle& triangle : solid::triangulate_loops({recess.rings.back().corners})) {
      mesh.triangles.push_back({above + triangle[0], above + triangle[1], above + triangle[2]});
    }
  }
  // A face that a tongue divides has two outlines.
  for (const Loop& outline : outer) {
    std::vector<std::vector<Vec2>> loops = {outline.corners};
    std::vector<std::uint32_t> vertices = outline.vertices;
    for (const Loop& hole : inner) {
      if (!contains(outline.corners, hole.corners.front())) continue;
      loops.push_back(hole.corners);
      vertices.insert(vertices.end(), hole.vertices.begin(), hole.vertices.end());
    }
    for (const Triangle& triangle : solid::triangulate_loops(loops)) {
      mesh.triangles.push_back({vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]});
    }
  }
}

void drop_unused_vertices(TriangleMesh& mesh) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(mesh.vertices.size(), kUnused);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) number[vertex] = 0;
  }
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == kUnused) continue;
    mesh.vertices[kept] = mesh.vertices[i];
    number[i] = kept++;
  }
  mesh.vertices.resize(kept);
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = number[vertex];
  }
}

TriangleMesh round_bar(double diameter, double length, double chamfer) {
  TriangleMesh mesh;
  const auto ring = [&](double radius, double z) {
    for (int i = 0; i < kBarCorners; ++i) {
      const auto [sine, cosine] = math::sine_cosine(2.0 * std::numbers::pi * i / kBarCorners);
      mesh.vertices.push_back({radius * cosine, radius * sine, z});
    }
  };
  const double radius = 0.5 * diameter;
  // Without chamfers the rings beside the ends would lie on them.
  const bool chamfered = chamfer > 0.0;
  ring(radius - chamfer, 0.0);
  if (chamfered) ring(radius, chamfer);
  if (chamfered) ring(radius, length - chamfer);
  ring(radius - chamfer, length);
  constexpr auto kCount = static_cast<std::uint32_t>(kBarCorners);
  const std::uint32_t last = chamfered ? 3 : 1;
  // Seen from outside, each ring is below the next one: the walls of a recess turned inside out.
  for (std::uint32_t i = 0; i < last; ++i) add_walls(mesh, i * kCount, (i + 1) * kCount, kCount);
  for (std::uint32_t i = 1; i + 1 < kCount; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({last * kCount, last * kCount + i, last * kCount + i + 1});
  }
  return mesh;
}

MeshMoments mesh_moments(const TriangleMesh& mesh) {
  MeshMoments sum;
  const Vec3 base = mesh.vertices.empty() ? Vec3{} : mesh.vertices.front();
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 a = mesh.vertices[triangle[0]] - base;
    const Vec3 b = mesh.vertices[triangle[1]] - base;
    const Vec3 c = mesh.vertices[triangle[2]] - base;
    const double volume = dot(a, cross(b, c)) / 6.0;
    sum.volume += volume;
    sum.centre = sum.centre + 0.25 * volume * (a + b + c);
  }
  if (sum.volume > 0.0) sum.centre = base + (1.0 / sum.volume) * sum.centre;
  return sum;
}

}  // namespace glissade::parts
