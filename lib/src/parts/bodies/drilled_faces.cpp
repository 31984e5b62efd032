#include "parts/bodies/drilled_faces.hpp"

#include "glissade/core/math.hpp"

#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace glissade::parts {
namespace {

/// A flat face with round holes, its plane being that of its first, second and last corner.
class DrilledFace {
 public:
  /// @param outline  counter-clockwise seen from outside
  DrilledFace(TriangleMesh& mesh, const std::vector<Index>& outline) : mesh_(mesh), outline_(outline) {
    const Vec3 corner = mesh.vertices[outline.front()];
    const Vec3 way = mesh.vertices[outline[1]] - corner;
    const Vec3 normal = cross(way, mesh.vertices[outline.back()] - corner);
    right_ = (1.0 / norm(way)) * way;
    up_ = (1.0 / norm(normal)) * cross(normal, right_);
    out_ = (1.0 / norm(normal)) * normal;
  }

  /// The circle in which a hole goes through the face, along a way that need not be square to it.
  /// @return its first vertex
  Index add_hole(const Bore& bore, int corners) {
    const Index first = count_of(mesh_);
    for (int k = 0; k < corners; ++k) {
      const auto [sine, cosine] = math::sine_cosine(kTurn * k / corners);
      const Vec3 at = bore.centre + bore.radius * (cosine * bore.along + sine * bore.across);
      const double off = dot(mesh_.vertices[outline_[0]] - at, out_) / dot(bore.into, out_);
      mesh_.vertices.push_back(at + off * bore.into);
    }
    holes_.push_back({first, first + static_cast<Index>(corners)});
    return first;
  }

  void fill() {
    std::vector<std::vector<Vec2>> loops(1);
    std::vector<Index> indices = outline_;
    for (const auto& [first, end] : holes_) {
      loops.emplace_back();
      for (Index k = first; k < end; ++k) indices.push_back(k);
    }
    const auto flat = [&](Index k) {
      const Vec3 at = mesh_.vertices[k] - mesh_.vertices[outline_[0]];
      return Vec2{dot(at, right_), dot(at, up_)};
    };
    for (const Index k : outline_) loops[0].push_back(flat(k));
    for (std::size_t i = 0; i < holes_.size(); ++i) {
      for (Index k = holes_[i][0]; k < holes_[i][1]; ++k) loops[i + 1].push_back(flat(k));
    }
    for (const auto& [a, b, c] : solid::triangulate_loops(loops))
      mesh_.triangles.push_back({indices[a], indices[b], indices[c]});
  }

 private:
  TriangleMesh& mesh_;
  std::vector<Index> outline_;
  Vec3 right_;
  Vec3 up_;
  Vec3 out_;
  std::vector<std::array<Index, 2>> holes_;
};

}  // namespace

std::vector<const Bore*> between(const std::vector<Circle>& holes, const std::vector<Bore>& bores,
                                 double from, double to, Vec2 rows) {
  std::vector<const Bore*> found;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const Vec2 at = holes[i].centre;
    if (at.x > from && at.x < to && at.y > rows.x && at.y < rows.y) found.push_back(&bores[i]);
  }
  return found;
}

bool is_crossed(const std::vector<Circle>& holes, double from, double to, double across) {
  constexpr double kAside = 1.25;  // in radii: holes through plates that lean reach farther on one face
  return std::any_of(holes.begin(), holes.end(), [&](const Circle& hole) {
    return hole.centre.x > from && hole.centre.x < to &&
           std::fabs(hole.centre.y - across) < kAside * hole.radius;
  });
}

void add_drilled(TriangleMesh& mesh, const std::vector<Index>& face, const std::vector<Index>& back,
                 const std::vector<const Bore*>& bores, const Fineness& fineness) {
  DrilledFace one(mesh, face);
  DrilledFace other(mesh, back);
  for (const Bore* bore : bores) {
    const int corners = std::max(8, chords_of(kTurn, bore->radius, fineness));
    const Index near = one.add_hole(*bore, corners);
    const Index far = other.add_hole(*bore, corners);
    for (Index k = 0; k < static_cast<Index>(corners); ++k) {
      const Index next = (k + 1) % static_cast<Index>(corners);
      // Counter-clockwise about the way into the plate: the wall looks inwards.
      add_quad(mesh, near + k, far + k, far + next, near + next);
    }
  }
  one.fill();
  other.fill();
}

}  // namespace glissade::parts
