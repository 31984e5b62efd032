#include "parts/bodies/body_edges.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_places.hpp"
#include "parts/bodies/swept_windows.hpp"
#include "parts/bodies/tube_windows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::parts {
namespace {

/// Printed pieces are held against planes instead (prints.cpp).
std::vector<Vec3> points_of(const MeshBody& /*body*/, double /*inset*/) {
  return {};
}

/// Of bodies that lie flush every edge of one lies on a face of the other: so far inside neither does [m].
constexpr double kWellInside = 1e-3;
constexpr double kOfThickness = 0.25;

/// Where edges alone do not tell: well inside, beside each piece of an outline.
void add_inner_points(const Prism& prism, std::vector<Vec3>& points) {
  const double deep = std::min(kWellInside, kOfThickness * prism.depth);
  const auto is_inside = [&](Vec2 at) {
    return contains(prism.region.outline, at) &&
           std::none_of(prism.region.cutouts.begin(), prism.region.cutouts.end(),
                        [&](const ArcPath& cutout) { return contains(cutout, at); });
  };
  const bool left = signed_area(prism.region.outline) > 0.0;
  for (const PathPiece& piece : pieces_of(prism.region.outline)) {
    for (const double share : {0.25, 0.75}) {
      const Vec2 along = tangent_at(piece, share);
      const Vec2 at = point_on(piece, share) + (left ? deep : -deep) * Vec2{-along.y, along.x};
      if (!is_inside(at)) continue;
      for (const double z : {deep, 0.5 * prism.depth, prism.depth - deep}) points.push_back({at.x, at.y, z});
    }
  }
}

std::vector<Vec3> points_of(const Prism& prism, double inset) {
  std::vector<Vec3> points;
  add_inner_points(prism, points);
  const auto along_path = [&](const ArcPath& path, bool outline) {
    const bool left = (signed_area(path) > 0.0) == outline;  // the material's side
    for (const PathPiece& piece : pieces_of(path)) {
      constexpr int kPoints = 6;
      for (int k = 0; k < kPoints; ++k) {
        const double share = (k + 0.5) / kPoints;
        const Vec2 at = point_on(piece, share);
        const Vec2 along = tangent_at(piece, share);
        const Vec2 inward = (left ? inset : -inset) * Vec2{-along.y, along.x};
        for (const double z : {inset, 0.5 * prism.depth, prism.depth - inset}) {
          points.push_back({at.x + inward.x, at.y + inward.y, z});
        }
      }
    }
  };
  along_path(prism.region.outline, true);
  for (const ArcPath& cutout : prism.region.cutouts) along_path(cutout, false);
  return points;
}

std::vector<Vec3> points_of(const AngleBar& bar, double inset) {
  std::vector<Vec3> points;
  for (const Prism& leg : legs_of(bar)) {
    for (const Vec3 point : points_of(leg, inset)) points.push_back(point);
  }
  return points;
}

std::vector<Vec3> points_of(const SweptBody& body, double inset) {
  std::vector<Vec3> points;
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  std::vector<Vec2> places;
  const auto look_at = [&](const std::vector<Vec2>& corners) {
    const Vec2 middle = glissade::moments(polygon_of(corners)).centroid;
    places = {middle};
    for (const Vec2 corner : corners) {
      const Vec2 inward = middle - corner;
      // Inside both faces of a sharp corner.
      places.push_back(corner + std::min(1.0, 4.0 * inset / norm(inward)) * inward);
    }
  };
  look_at(body.section);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double edge = inset / length(pieces[i]);
    for (const double share : {edge, 0.25, 0.5, 0.75, 1.0 - edge}) {
      if (!body.shifts.empty()) look_at(section_at(body, i, share));
      const Vec2 at = point_on(pieces[i], share);
      const Vec2 along = tangent_at(pieces[i], share);
      const Vec2 up{-along.y, along.x};
      for (const Vec2 place : places) {
        const Vec2 here = at + place.x * up;
        points.push_back({here.x, here.y, place.y});
      }
    }
  }
  if (body.windows.empty()) return points;
  std::erase_if(points, [&](Vec3 point) { return depth_inside(body, point) < 0.0; });
  for (const Vec3 point : points_beside(body, inset)) points.push_back(point);
  return points;
}

std::vector<Vec3> points_of(const RolledSheet& sheet, double inset) {
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  const std::vector<double> starts = starts_of(pieces);
  const std::vector<double> mitres = mitres_of(sheet);
  std::vector<Vec3> points;
  const auto put = [&](Vec2 place) {
    std::size_t i = 0;
    while (i + 1 < pieces.size() && place.x > starts[i + 1]) ++i;
    const double whole = length(pieces[i]);
    const double share = (place.x - starts[i]) / whole;
    const Vec2 along = tangent_at(pieces[i], share);
    const Vec2 at = point_on(pieces[i], share);
    const Vec2 upper = sheet_place(sheet, place.y, true);
    const Vec2 way = (1.0 / sheet.thickness) * (sheet_place(sheet, place.y, false) - upper);
    for (const double depth : {inset, 0.5 * sheet.thickness, sheet.thickness - inset}) {
      const Vec2 there = upper + depth * way;
      const double low = there.x * mitres[i] + inset;
      const double high = whole - there.x * mitres[i + 1] - inset;
      if ((mitres[i] != 0.0 || mitres[i + 1] != 0.0) && high > low) {
        const Vec2 here = at + (std::clamp(share * whole, low, high) - share * whole) * along;
        points.push_back({here.x - there.x * along.y, here.y + there.x * along.x, there.y});
        continue;
      }
      points.push_back({at.x - there.x * along.y, at.y + there.x * along.x, there.y});
    }
  };
  const auto along_edges = [&](const ArcPath& path, bool outline, double off) {
    const bool left = (signed_area(path) > 0.0) == outline;  // the material's side
    for (const PathPiece& edge : pieces_of(path)) {
      const Vec2 step = edge.to - edge.from;
      const double whole = norm(step);
      if (!(whole > 0.0)) continue;
      const Vec2 inward = ((left ? off : -off) / whole) * Vec2{-step.y, step.x};
      const int count =
          4 + static_cast<int>(4.0 * whole / starts.back() * static_cast<double>(pieces.size()));
      for (int k = 0; k < count; ++k) put(edge.from + ((k + 0.5) / count) * step + inward);
    }
  };
  along_edges(sheet.region.outline, true, inset);
  along_edges(sheet.region.outline, true, std::min(kWellInside, kOfThickness * sheet.thickness));
  for (const ArcPath& cutout : sheet.region.cutouts) along_edges(cutout, false, inset);
  return points;
}

std::vector<Vec3> points_of(const FoldedPlate& plate, double inset) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + 1 < plate.corners.size(); ++i) {
    const auto& from = plate.corners[i];
    const auto& to = plate.corners[i + 1];
    const double edge = std::min(0.25, inset / norm(to[0] - from[0]));
    for (const double share : {edge, 0.25, 0.5, 0.75, 1.0 - edge}) {
      const auto at = [&](std::size_t j) { return (1.0 - share) * from[j] + share * to[j]; };
      const Vec3 middle = 0.25 * (at(0) + at(1) + at(2) + at(3));
      points.push_back(middle);
      for (std::size_t j = 0; j < 4; ++j) {
        // Inside both faces of a sharp corner.
        const Vec3 one = at((j + 1) % 4) - at(j);
        const Vec3 other = at((j + 3) % 4) - at(j);
        const double sine = norm(cross(one, other)) / (norm(one) * norm(other));
        points.push_back(at(j) + (inset / (sine * norm(one))) * one + (inset / (sine * norm(other))) * other);
      }
    }
  }
  return points;
}

/// Whether a point lies in a window.
bool is_cut(const TubeGore& gore, Vec3 point) {
  return std::any_of(gore.windows.begin(), gore.windows.end(),
                     [&](const TubeWindow& window) { return parts::beside(window, point) < 0.0; });
}

std::vector<Vec3> points_of(const TroughGore& gore, double inset) {
  std::vector<Vec3> points;
  const double start = math::tan(gore.start_tilt.radians());
  const double end = math::tan(gore.end_tilt.radians());
  const auto put = [&](double x, double y) {
    const double low = x * start + 2.0 * inset;
    const double high = gore.length + x * end - 2.0 * inset;
    for (const double z : {low, 0.5 * (low + high), high}) points.push_back({x, y, z});
  };
  constexpr int kPoints = 13;
  for (const double radius : {gore.inner_radius + inset, gore.inner_radius + 0.5 * gore.thickness,
                              gore.inner_radius + gore.thickness - inset}) {
    for (int k = 0; k < kPoints; ++k) {
      const auto [sine, cosine] = math::sine_cosine(std::numbers::pi * k / (kPoints - 1));
      put(-radius * sine, radius * cosine);
    }
    if (gore.side < 2.0 * inset) continue;
    for (const double height : {0.5 * gore.side, gore.side - inset}) {
      put(height, radius);
      put(height, -radius);
    }
  }
  if (gore.windows.empty()) return points;
  const TubeGore round = round_of(gore);
  std::erase_if(points, [&](Vec3 point) { return is_cut(round, point); });
  for (const Vec3 point : points_beside(round, inset)) points.push_back(point);
  return points;
}

std::vector<Vec3> points_of(const TubeGore& gore, double inset) {
  std::vector<Vec3> points = points_beside(gore, inset);
  constexpr int kPoints = 24;
  for (int k = 0; k < kPoints; ++k) {
    const auto [sine, cosine] = math::sine_cosine(2.0 * std::numbers::pi * k / kPoints);
    for (const double radius : {gore.inner_radius + inset, gore.inner_radius + 0.5 * gore.thickness,
                                gore.inner_radius + gore.thickness - inset}) {
      const double x = radius * cosine;
      const double low = x * math::tan(gore.start_tilt.radians()) + 2.0 * inset;
      const double high = gore.length + x * math::tan(gore.end_tilt.radians()) - 2.0 * inset;
      for (const double z : {low, 0.5 * (low + high), high}) {
        const Vec3 point{x, radius * sine, z};
        if (!is_cut(gore, point)) points.push_back(point);
      }
    }
  }
  return points;
}

/// Beside every corner of an outline, across the depth, and along its straight pieces.
std::vector<EdgeLine> lines_of(const Prism& prism, double inset) {
  std::vector<EdgeLine> lines;
  const auto along_path = [&](const ArcPath& path, bool outline) {
    const double side = (signed_area(path) > 0.0) == outline ? inset : -inset;  // to the material's
    const std::vector<PathPiece> pieces = pieces_of(path);
    std::vector<Vec2> inside;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Vec2 before = tangent_at(pieces[(i + pieces.size() - 1) % pieces.size()], 1.0);
      const Vec2 after = tangent_at(pieces[i], 0.0);
      const Vec2 both = Vec2{-before.y, before.x} + Vec2{-after.y, after.x};
      // Off both sides; of a corner that turns back, off the second one.
      const double sharp = dot(both, both);
      inside.push_back(pieces[i].from +
                       (sharp > 0.1 ? (2.0 * side / sharp) * both : side * Vec2{-after.y, after.x}));
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Vec2 from = inside[i];
      const Vec2 to = inside[(i + 1) % pieces.size()];
      lines.push_back({{from.x, from.y, inset}, {from.x, from.y, prism.depth - inset}});
      if (!pieces[i].straight()) continue;
      for (const double z : {inset, prism.depth - inset})
        lines.push_back({{from.x, from.y, z}, {to.x, to.y, z}});
    }
  };
  along_path(prism.region.outline, true);
  for (const ArcPath& cutout : prism.region.cutouts) along_path(cutout, false);
  return lines;
}

std::vector<EdgeLine> lines_of(const AngleBar& bar, double inset) {
  std::vector<EdgeLine> lines;
  for (const Prism& leg : legs_of(bar)) {
    for (const EdgeLine& line : lines_of(leg, inset)) lines.push_back(line);
  }
  return lines;
}

template <typename Body>
std::vector<EdgeLine> lines_of(const Body& /*body*/, double /*inset*/) {
  return {};
}

}  // namespace

std::vector<Vec3> edge_points(const PartBody& body, double inset) {
  return std::visit([&](const auto& one) { return points_of(one, inset); }, body);
}

std::vector<EdgeLine> edge_lines(const PartBody& body, double inset) {
  return std::visit([&](const auto& one) { return lines_of(one, inset); }, body);
}

}  // namespace glissade::parts
