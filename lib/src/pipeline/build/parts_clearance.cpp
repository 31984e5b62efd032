// Parts of a build against what its design keeps clear of.
//
// The plane of the track holds the obstacles, which reach across it without end: what counts of a piece is its side view,
// the union of its facets seen from there. Those that face the viewer cover all of it.

#include "pipeline/build/parts_clearance.hpp"

#include "glissade/pipeline/solve.hpp"

#include "core/plane_geometry.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "task/obstacles.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace glissade::pipeline {
namespace {

// As a share of the tolerance that the arcs have: what chords of facets lie off them.
constexpr double kFacetShare = 0.1;

using Facet = std::array<Vec2, 3>;

/// One piece as it is seen from the side.
struct SideView {
  const ShopPart* part = nullptr;
  std::vector<Facet> facets;
  std::array<Vec2, 4> box{};  // round all of them
};

SideView view_of(const ShopPart& part, const TriangleMesh& mesh, const Frame& place, const Placement& frame) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<Vec2> seen;
  Vec2 low{kFar, kFar};
  Vec2 high{-kFar, -kFar};
  for (const Vec3 vertex : mesh.vertices) {
    const Vec2 point = frame.to_plane(place.to_space(vertex));
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    seen.push_back(point);
  }
  SideView view{&part, {}, {{low, {high.x, low.y}, high, {low.x, high.y}}}};
  for (const auto& triangle : mesh.triangles) {
    const Facet facet{seen[triangle[0]], seen[triangle[1]], seen[triangle[2]]};
    if (cross(facet[1] - facet[0], facet[2] - facet[0]) > 0.0) view.facets.push_back(facet);
  }
  return view;
}

std::vector<SideView> views_of(const Workshop& workshop, const Placement& frame, double tolerance) {
  std::vector<SideView> views;
  for (const ShopPart& part : workshop.parts) {
    const TriangleMesh mesh = parts::facets_of(part.body, tolerance);
    for (const Frame& place : part.places) views.push_back(view_of(part, mesh, place, frame));
  }
  return views;
}

/// Ground that a leg stands on is nothing to keep clear of.
bool is_bound(const ShopPart& part, const LimitName& limit) {
  return !part.stands || limit.id == LimitId::keep_outs;
}

std::optional<PartApproach> closest(const task::Obstacle& obstacle, const std::vector<SideView>& views) {
  clearance::Nearest least;
  const ShopPart* part = nullptr;
  for (const SideView& view : views) {
    if (!is_bound(*view.part, obstacle.limit)) continue;
    // No facet comes closer than the box round all of them.
    const double box = obstacle.region.nearest(view.box).value;
    if (box > 0.0 && box >= least.value) continue;
    for (const Facet& facet : view.facets) {
      const clearance::Nearest near = obstacle.region.nearest(facet);
      if (near.value >= least.value) continue;
      least = near;
      part = view.part;
    }
  }
  if (!part) return std::nullopt;
  return PartApproach{obstacle.limit.key(), obstacle.clearance, least.value,
                      part->number,         part->name,         least.point};
}

}  // namespace

std::vector<PartApproach> closest_parts(const Design& design, const Placement& frame,
                                        const Workshop& workshop) {
  if (!design.limits || !design.limits->has_clearances()) return {};
  if (design.limits->clearances_from == ClearancesFrom::centerline) return {};
  const double tolerance = kFacetShare * design.fabrication->arc_tolerance;
  const std::vector<SideView> views = views_of(workshop, frame, tolerance);
  std::vector<PartApproach> approaches;
  for (const task::Obstacle& obstacle : task::obstacles_of(problem_of(design).limits)) {
    if (auto approach = closest(obstacle, views)) approaches.push_back(std::move(*approach));
  }
  return approaches;
}

}  // namespace glissade::pipeline
