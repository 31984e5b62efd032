#pragma once

#include "glissade/solid/triangle_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

/// Small meshes whose facts are known by hand.
namespace glissade::shapes {

inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Axis-parallel, 8 vertices, 12 facets.
inline TriangleMesh box(Vec3 low, Vec3 high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline TriangleMesh unit_cube() {
  return box({0, 0, 0}, {1, 1, 1});
}

/// Around the z axis; `around` steps of the large circle, `across` of the small one.
inline TriangleMesh torus(double large_radius, double small_radius, std::size_t around, std::size_t across) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < around; ++i) {
    const double u = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(around);
    for (std::size_t j = 0; j < across; ++j) {
      const double v = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(across);
      const double distance = large_radius + small_radius * std::cos(v);
      mesh.vertices.push_back({distance * std::cos(u), distance * std::sin(u), small_radius * std::sin(v)});
    }
  }
  const auto index = [around, across](std::size_t i, std::size_t j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (std::size_t i = 0; i < around; ++i) {
    for (std::size_t j = 0; j < across; ++j) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return mesh;
}

/// A band of `steps` quads with half a twist.
inline TriangleMesh moebius(std::size_t steps) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < steps; ++i) {
    const double u = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps);
    for (const double side : {-0.25, 0.25}) {
      const double distance = 1.0 + side * std::cos(u / 2.0);
      mesh.vertices.push_back({distance * std::cos(u), distance * std::sin(u), side * std::sin(u / 2.0)});
    }
  }
  const auto count = static_cast<std::uint32_t>(steps);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = 2 * i;
    const bool last = i + 1 == count;
    const std::uint32_t c = last ? 1 : a + 2;
    const std::uint32_t d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, c, a + 1});
    mesh.triangles.push_back({a + 1, c, d});
  }
  return mesh;
}

inline TriangleMesh flipped(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, Vec3 by) {
  for (Vec3& vertex : mesh.vertices) vertex = vertex + by;
  return mesh;
}

/// Side by side in one mesh, nothing merged.
inline TriangleMesh together(TriangleMesh first, const TriangleMesh& second) {
  const auto offset = static_cast<std::uint32_t>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const auto& [a, b, c] : second.triangles) {
    first.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return first;
}

/// Vertices at equal positions made one, the first of them.
inline TriangleMesh welded(TriangleMesh mesh) {
  std::vector<Vec3> kept;
  std::vector<std::uint32_t> now;
  for (const Vec3& vertex : mesh.vertices) {
    std::uint32_t i = 0;
    while (i < kept.size() && !(kept[i] == vertex)) ++i;
    if (i == kept.size()) kept.push_back(vertex);
    now.push_back(i);
  }
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = now[corner];
  }
  mesh.vertices = kept;
  return mesh;
}

}  // namespace glissade::shapes
