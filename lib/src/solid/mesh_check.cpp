#include "solid/mesh_check.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace glissade::solid {
namespace {

// NaN is not usable either: it compares with nothing.
bool is_usable(Vec3 p) {
  return std::fabs(p.x) <= kLargestMeshCoordinate && std::fabs(p.y) <= kLargestMeshCoordinate &&
         std::fabs(p.z) <= kLargestMeshCoordinate;
}

InputError unusable(std::size_t vertex, Vec3 p, std::string_view use) {
  return InputError({"",
                     "vertex " + std::to_string(vertex) + " of the mesh: coordinates (" +
                         rounded_text(p.x, 6) + ", " + rounded_text(p.y, 6) + ", " + rounded_text(p.z, 6) +
                         ") m cannot be " + std::string(use),
                     "Every coordinate must be a finite number of at most " +
                         rounded_text(kLargestMeshCoordinate, 3) + " m.",
                     ""});
}

}  // namespace

// Both look at the whole range in a loop without branches, and one by one only where something is wrong.

void require_usable_positions(const TriangleMesh& mesh, std::size_t first, std::size_t last,
                              std::string_view use) {
  bool all_usable = true;
  for (std::size_t i = first; i < last; ++i) all_usable &= is_usable(mesh.vertices[i]);
  for (std::size_t i = first; !all_usable && i < last; ++i) {
    if (!is_usable(mesh.vertices[i])) throw unusable(i, mesh.vertices[i], use);
  }
}

MeshBox box_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  MeshBox box{mesh.vertices[mesh.triangles.front().front()], mesh.vertices[mesh.triangles.front().front()]};
  for (const auto& facet : mesh.triangles) {
    for (const std::uint32_t corner : facet) {
      const Vec3& p = mesh.vertices[corner];
      box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y), std::min(box.lower.z, p.z)};
      box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y), std::max(box.upper.z, p.z)};
    }
  }
  return box;
}

std::optional<double> size_too_small(const MeshBox& box) {
  const Vec3 sides = box.upper - box.lower;
  const double size = std::max({sides.x, sides.y, sides.z});
  return size == 0.0 || size >= kSmallestMeshSize ? std::nullopt : std::optional(size);
}

void require_measurable_size(const MeshBox& box) {
  const std::optional<double> size = size_too_small(box);
  if (!size) return;
  throw InputError(
      {"", "the mesh is " + rounded_text(*size, 3) + " m long, too small to be measured",
       "Products of lengths below " + rounded_text(kSmallestMeshSize, 3) + " m leave the range of a double.",
       ""});
}

void require_existing_vertices(const TriangleMesh& mesh, std::size_t first, std::size_t last) {
  std::uint32_t largest = 0;
  for (std::size_t i = first; i < last; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) largest = std::max(largest, vertex);
  }
  const bool all_exist = first >= last || largest < mesh.vertices.size();
  for (std::size_t i = first; !all_exist && i < last; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (vertex < mesh.vertices.size()) continue;
      throw InputError({"",
                        "triangle " + std::to_string(i) + " of the mesh: vertex " + std::to_string(vertex) +
                            " does not exist",
                        "The mesh has " + std::to_string(mesh.vertices.size()) + " vertices, counted from 0.",
                        ""});
    }
  }
}

}  // namespace glissade::solid
