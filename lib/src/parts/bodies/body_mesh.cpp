#include "parts/bodies/body_mesh.hpp"

#include "parts/bodies/angle_mesh.hpp"
#include "parts/bodies/mesh_chords.hpp"
#include "parts/bodies/path_mesh.hpp"
#include "parts/bodies/tube_mesh.hpp"
#include "solid/cap_triangulation.hpp"

#include <array>
#include <cmath>
#include <map>
#include <variant>
#include <vector>

namespace glissade::parts {
namespace {

std::vector<std::vector<Vec2>> loops_of(const PlaneRegion& region, const Fineness& fineness) {
  std::vector<std::vector<Vec2>> loops{corners_of(region.outline, fineness)};
  for (const ArcPath& cutout : region.cutouts) loops.push_back(corners_of(cutout, fineness));
  for (const Circle& hole : region.holes) loops.push_back(corners_of(path_of(hole), fineness));
  for (std::size_t i = 0; i < loops.size(); ++i) run(loops[i], i == 0);
  return loops;
}

TriangleMesh prism_of(const Prism& prism, const Fineness& fineness) {
  const std::vector<std::vector<Vec2>> loops = loops_of(prism.region, fineness);
  const std::vector<std::array<Index, 3>> faces = solid::triangulate_loops(loops);
  TriangleMesh mesh;
  for (const double z : {0.0, prism.depth}) {
    for (const std::vector<Vec2>& loop : loops) {
      for (const Vec2 corner : loop) mesh.vertices.push_back({corner.x, corner.y, z});
    }
  }
  const Index above = count_of(mesh) / 2;
  for (const auto& [a, b, c] : faces) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({above + a, above + b, above + c});
  }
  Index first = 0;
  for (const std::vector<Vec2>& loop : loops) {
    const auto size = static_cast<Index>(loop.size());
    for (Index i = 0; i < size; ++i) {
      const Index a = first + i;
      const Index b = first + (i + 1) % size;
      add_quad(mesh, a, b, above + b, above + a);
    }
    first += size;
  }
  return mesh;
}

TriangleMesh mesh_of(const Prism& prism, const Fineness& fineness) {
  return with_enough_chords([&](const Fineness& fine) { return prism_of(prism, fine); }, fineness);
}

TriangleMesh mesh_of(const FoldedPlate& plate, const Fineness& /*fineness*/) {
  TriangleMesh mesh;
  for (const auto& corners : plate.corners)
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  const Index last = count_of(mesh) - 4;
  for (Index first = 0; first < last; first += 4) {
    for (Index j = 0; j < 4; ++j) {
      const Index next = (j + 1) % 4;
      add_quad(mesh, first + j, first + next, first + 4 + next, first + 4 + j);
    }
  }
  add_quad(mesh, 3, 2, 1, 0);
  add_quad(mesh, last, last + 1, last + 2, last + 3);
  return mesh;
}

TriangleMesh mesh_of(const MeshBody& body, const Fineness& /*fineness*/) {
  return body.mesh;
}

}  // namespace

TriangleMesh facets_of(const PartBody& body, double tolerance, int round_corners) {
  const Fineness fineness{tolerance, round_corners};
  return std::visit([&](const auto& shape) { return mesh_of(shape, fineness); }, body);
}

TriangleMesh coarsened(const TriangleMesh& mesh, double cell) {
  TriangleMesh coarse;
  std::map<std::array<long long, 3>, Index> cells;
  std::vector<Index> kept;
  kept.reserve(mesh.vertices.size());
  const auto on_grid = [cell](double value) { return std::llround(value / cell); };
  for (const Vec3& vertex : mesh.vertices) {
    const auto [at, is_new] =
        cells.try_emplace({on_grid(vertex.x), on_grid(vertex.y), on_grid(vertex.z)}, count_of(coarse));
    if (is_new) coarse.vertices.push_back(vertex);
    kept.push_back(at->second);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (kept[a] == kept[b] || kept[b] == kept[c] || kept[c] == kept[a]) continue;
    coarse.triangles.push_back({kept[a], kept[b], kept[c]});
  }
  return coarse;
}

}  // namespace glissade::parts
