#include "solid/cap_triangulation.hpp"

#include "glissade/core/error.hpp"

#include <cstddef>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace glissade::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

constexpr int kUnknown = -1;

[[noreturn]] void refuse() {
  throw InternalError({"", "the outline of an end face crosses or touches itself", "", ""});
}

// Counts how many loops each face lies inside, from the outside in.
void mark_depths(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = kUnknown;
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    for (int side = 0; side < 3; ++side) {
      const auto neighbour = face->neighbor(side);
      if (neighbour->info() != kUnknown) continue;
      neighbour->info() = face->info() ^ (face->is_constrained(side) ? 1 : 0);
      open.push_back(neighbour);
    }
  }
}

std::size_t point_count(const std::vector<std::vector<Vec2>>& loops) {
  std::size_t count = 0;
  for (const auto& loop : loops) count += loop.size();
  return count;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_loops(const std::vector<std::vector<Vec2>>& loops) {
  // In the order of the loops, each from its neighbour: same input, same triangles, even where four points of
  // a grid lie on one circle.
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertices;
  vertices.reserve(point_count(loops));
  for (const auto& loop : loops) {
    for (const Vec2 p : loop) {
      const auto near = vertices.empty() ? Triangulation::Face_handle() : vertices.back()->face();
      vertices.push_back(triangulation.insert(Kernel::Point_2(p.x, p.y), near));
      vertices.back()->info() = static_cast<std::uint32_t>(vertices.size() - 1);
    }
  }
  if (triangulation.number_of_vertices() != vertices.size()) refuse();

  try {
    std::size_t first = 0;
    for (const auto& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        triangulation.insert_constraint(vertices[first + i], vertices[first + (i + 1) % loop.size()]);
      }
      first += loop.size();
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    refuse();
  }

  mark_depths(triangulation);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles()) {
    if (face->info() == 0) continue;
    triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  // Each hole adds two to the count of a polygon without one.
  if (triangles.size() != vertices.size() + 2 * loops.size() - 4) refuse();
  return triangles;
}

}  // namespace glissade::solid
