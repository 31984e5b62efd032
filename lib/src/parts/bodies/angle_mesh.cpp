#include "parts/bodies/angle_mesh.hpp"

#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

/// The mesh of an angle from lines with the material on their left: its heel, its root and toe the other way.
class AngleMesh {
 public:
  AngleMesh(const AngleBar& bar, const Fineness& fineness) : bar_(bar), fineness_(fineness) {}

  TriangleMesh whole() {
    const double t = bar_.thickness;
    const Wall heel = wall(corners(bar_.heel), 0.0, bar_.height, bar_.heel.closed);
    const Wall root = wall(corners(reversed(bar_.root)), t, bar_.height, bar_.root.closed);
    const Wall toe = wall(corners(reversed(bar_.toe)), 0.0, t, bar_.toe.closed);
    std::vector<Wall> holes;
    for (const ArcPath& slot : bar_.slots) holes.push_back(hole(slot));
    for (const Circle& circle : bar_.holes) holes.push_back(hole(path_of(circle)));
    level({heel.low, toe.low}, holes, false, false);
    std::vector<Index> inner = root.low;
    std::reverse(inner.begin(), inner.end());
    level({inner, toe.high}, holes, true, true);
    level({heel.high, root.high}, {}, true, true);
    if (!bar_.heel.closed) {
      end({heel.low.back(), toe.low.front(), toe.high.front(), root.low.front(), root.high.front(),
           heel.high.back()});
      end({heel.low.front(), heel.high.front(), root.high.back(), root.low.back(), toe.high.back(),
           toe.low.back()});
    }
    return std::move(mesh_);
  }

 private:
  /// Vertices of an upright face below and above.
  struct Wall {
    std::vector<Index> low;
    std::vector<Index> high;
  };

  [[nodiscard]] std::vector<Vec2> corners(const ArcPath& path) const {
    std::vector<Vec2> all = corners_of(path, fineness_);
    if (!path.closed) all.push_back(path.vertices.back().at);
    return all;
  }

  Wall wall(const std::vector<Vec2>& line, double low, double high, bool closed) {
    Wall made;
    for (const Vec2 corner : line) {
      made.low.push_back(add({corner.x, corner.y, low}));
      made.high.push_back(add({corner.x, corner.y, high}));
    }
    for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
      const std::size_t next = (i + 1) % line.size();
      add_quad(mesh_, made.low[i], made.low[next], made.high[next], made.high[i]);
    }
    return made;
  }

  Wall hole(const ArcPath& path) {
    std::vector<Vec2> line = corners_of(path, fineness_);
    run(line, false);
    return wall(line, 0.0, bar_.thickness, true);
  }

  Index add(Vec3 vertex) {
    mesh_.vertices.push_back(vertex);
    return count_of(mesh_) - 1;
  }

  /// A level face between two lines: one loop of open ones, two of closed ones.
  void level(const std::array<std::vector<Index>, 2>& lines, const std::vector<Wall>& holes, bool up,
             bool above) {
    std::vector<std::vector<Index>> loops;
    if (bar_.heel.closed) {
      // The outer one first.
      const bool second = twice_area(lines[1]) > 0.0;
      loops = {lines[second ? 1 : 0], lines[second ? 0 : 1]};
    } else {
      loops = {lines[0]};
      loops[0].insert(loops[0].end(), lines[1].begin(), lines[1].end());
    }
    for (const Wall& hole : holes) loops.push_back(above ? hole.high : hole.low);
    std::vector<std::vector<Vec2>> flat;
    std::vector<Index> indices;
    for (const std::vector<Index>& loop : loops) {
      flat.emplace_back();
      for (const Index k : loop) flat.back().push_back(flat_of(k));
      indices.insert(indices.end(), loop.begin(), loop.end());
    }
    for (const auto& [a, b, c] : solid::triangulate_loops(flat)) {
      if (up)
        mesh_.triangles.push_back({indices[a], indices[b], indices[c]});
      else
        mesh_.triangles.push_back({indices[a], indices[c], indices[b]});
    }
  }

  /// An L, counter-clockwise seen from outside, about its inner corner, which is the fourth.
  void end(const std::array<Index, 6>& corner) {
    for (std::size_t k = 4; k < 8; ++k)
      mesh_.triangles.push_back({corner[3], corner[k % 6], corner[(k + 1) % 6]});
  }

  [[nodiscard]] Vec2 flat_of(Index k) const { return {mesh_.vertices[k].x, mesh_.vertices[k].y}; }
  [[nodiscard]] double twice_area(const std::vector<Index>& loop) const {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      twice += cross(flat_of(loop[i]), flat_of(loop[(i + 1) % loop.size()]));
    return twice;
  }

  const AngleBar& bar_;
  Fineness fineness_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh mesh_of(const AngleBar& bar, const Fineness& fineness) {
  return with_enough_chords([&](const Fineness& fine) { return AngleMesh(bar, fine).whole(); }, fineness);
}

}  // namespace glissade::parts
