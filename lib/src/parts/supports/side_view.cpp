#include "parts/supports/side_view.hpp"

#include "core/plane_geometry.hpp"
#include "parts/bodies/body_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace glissade::parts {
namespace {

Span ordered(double a, double b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The widest gap between two convex figures, square to an edge of either; negative where they meet.
double gap_between(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double widest = -std::numeric_limits<double>::infinity();
  const auto reach = [](const std::vector<Vec2>& corners, Vec2 way) {
    Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Vec2 corner : corners)
      span = {std::min(span.from, dot(corner, way)), std::max(span.to, dot(corner, way))};
    return span;
  };
  for (const std::vector<Vec2>* const one : {&a, &b}) {
    for (std::size_t i = 0; i < one->size(); ++i) {
      const Vec2 edge = (*one)[(i + 1) % one->size()] - (*one)[i];
      if (!(norm(edge) > 0.0)) continue;
      const Vec2 way = (1.0 / norm(edge)) * Vec2{-edge.y, edge.x};
      const Span first = reach(a, way);
      const Span second = reach(b, way);
      widest = std::max({widest, second.from - first.to, first.from - second.to});
    }
  }
  return widest;
}

}  // namespace

SideView::SideView(const Shell& shell) : placement_(shell.placement) {
  for (const ShopPart& part : shell.workshop.parts) {
    for (const Frame& place : part.places) {
      if (const auto* const prism = std::get_if<Prism>(&part.body)) add(*prism, place);
      if (!std::holds_alternative<AngleBar>(part.body)) continue;
      for (const EdgeLine& line : edge_lines(part.body, 0.0)) {
        const Vec3 from = place.to_space(line.from);
        const Vec3 to = place.to_space(line.to);
        lines_.push_back({seen(from), seen(to)});
        shapes_.push_back({{seen(from), seen(to)}, ordered(aside_of(from), aside_of(to))});
      }
    }
  }
}

bool SideView::is_clear(const Trestle& trestle, double tube) const {
  constexpr double kAround = 1e-3;  // taste: of beams [m]
  const double half = 0.5 * tube + kAround;
  const Vec2 low{trestle.x - half, trestle.ground};
  const Vec2 high{trestle.x + half, trestle.beam + kAround};
  return std::none_of(lines_.begin(), lines_.end(),
                      [&](const auto& line) { return core::touches_rectangle(line[0], line[1], low, high); });
}

bool SideView::is_clear(const ArcPath& seat, double aside, double beam) const {
  constexpr double kAround = 1e-3;  // taste: of saddles [m]
  std::vector<Vec2> saddle;
  for (const PathVertex& vertex : seat.vertices) saddle.push_back(vertex.at);
  saddle.push_back({seat.vertices.back().at.x, beam});
  saddle.push_back({seat.vertices.front().at.x, beam});
  const double half = 0.5 * kSaddle + kAround;
  return std::none_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
    return shape.aside.from < aside + half && shape.aside.to > aside - half &&
           gap_between(shape.corners, saddle) < kAround;
  });
}

double SideView::aside_of(Vec3 point) const {
  return dot(point - in_space(placement_, {}), across(placement_));
}

Vec2 SideView::seen(Vec3 point) const {
  const Vec3 away = point - in_space(placement_, {});
  return {dot(away, along(placement_)), away.z};
}

void SideView::add(const Prism& prism, const Frame& place) {
  constexpr double kSquare = 1e-6;  // rounding
  const Vec3 aside = across(placement_);
  if (std::fabs(dot(place.z, aside)) > kSquare) return;
  const Vec3 up = cross(aside, place.z);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec2 corner : flattened(prism.region.outline, 1e-4)) {
    const double level = dot(corner.x * place.x + corner.y * place.y, up);
    low = std::min(low, level);
    high = std::max(high, level);
  }
  const Vec3 far = prism.depth * place.z;
  const std::array<Vec2, 4> corners = {seen(place.origin + low * up), seen(place.origin + high * up),
                                       seen(place.origin + high * up + far),
                                       seen(place.origin + low * up + far)};
  for (std::size_t i = 0; i < 4; ++i) lines_.push_back({corners[i], corners[(i + 1) % 4]});
  shapes_.push_back({{corners.begin(), corners.end()}, reach_of(prism, place)});
}

Span SideView::reach_of(const Prism& prism, const Frame& place) const {
  Span reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec2 corner : flattened(prism.region.outline, 1e-4)) {
    const double aside = aside_of(place.to_space({corner.x, corner.y, 0.0}));
    reach = {std::min(reach.from, aside), std::max(reach.to, aside)};
  }
  return reach;
}

}  // namespace glissade::parts
