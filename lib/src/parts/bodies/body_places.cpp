#include "parts/bodies/body_places.hpp"

#include "glissade/core/math.hpp"

#include <cmath>

namespace glissade::parts {

Vec2 tangent_at(const PathPiece& piece, double share) {
  const Vec2 chord = piece.to - piece.from;
  const double angle = 4.0 * math::atan(piece.bulge) * (share - 0.5);
  const auto [sine, cosine] = math::sine_cosine(angle);
  return (1.0 / norm(chord)) * Vec2{cosine * chord.x - sine * chord.y, sine * chord.x + cosine * chord.y};
}

std::vector<double> starts_of(const std::vector<PathPiece>& pieces) {
  std::vector<double> starts = {0.0};
  for (const PathPiece& piece : pieces) starts.push_back(starts.back() + length(piece));
  return starts;
}

std::vector<Vec2> section_at(const SweptBody& body, std::size_t piece, double share) {
  std::vector<Vec2> section = body.section;
  if (body.shifts.empty()) return section;
  for (std::size_t j = 0; j < section.size(); ++j)
    section[j].y += (1.0 - share) * body.shifts[piece][j] + share * body.shifts[piece + 1][j];
  return section;
}

PlaneRegion polygon_of(const std::vector<Vec2>& corners) {
  PlaneRegion polygon{{{}, true}, {}, {}};
  for (const Vec2 corner : corners) polygon.outline.vertices.push_back({corner, 0.0});
  return polygon;
}

double bevel_at(const RolledSheet& sheet, double y) {
  const std::vector<Bevel>& bevels = sheet.bevels;
  if (bevels.empty()) return 0.0;
  if (y <= bevels.front().at) return bevels.front().below;
  for (std::size_t i = 1; i < bevels.size(); ++i) {
    const Bevel& one = bevels[i - 1];
    const Bevel& other = bevels[i];
    if (y == other.at) return other.below;
    if (y < other.at) return one.below + (y - one.at) / (other.at - one.at) * (other.below - one.below);
  }
  return bevels.back().below;
}

std::vector<double> mitres_of(const RolledSheet& sheet) {
  constexpr double kNoBend = 1e-9;  // [rad]
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  std::vector<double> mitres(pieces.size() + 1, 0.0);
  mitres.front() = sheet.tilts[0];
  mitres.back() = sheet.tilts[1];
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (!pieces[i - 1].straight() || !pieces[i].straight()) continue;
    const Vec2 before = tangent_at(pieces[i - 1], 1.0);
    const Vec2 after = tangent_at(pieces[i], 0.0);
    const double sine = cross(before, after);
    if (std::fabs(sine) > kNoBend) mitres[i] = sine / (1.0 + dot(before, after));
  }
  return mitres;
}

Vec2 sheet_place(const RolledSheet& sheet, double y, bool upper) {
  if (upper) return sheet.foot + y * sheet.across;
  const Vec2 into{-sheet.across.y, sheet.across.x};
  return sheet.foot + (y + bevel_at(sheet, y)) * sheet.across + sheet.thickness * into;
}

FacetPlanes planes_of(const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& to) {
  FacetPlanes planes;
  const auto put = [&](std::size_t k, Vec3 a, Vec3 one, Vec3 other) {
    const Vec3 normal = cross(one, other);
    planes.origins[k] = a;
    planes.outward[k] = (1.0 / norm(normal)) * normal;
  };
  for (std::size_t j = 0; j < 4; ++j) {
    const std::size_t next = (j + 1) % 4;
    put(j, from[j], to[next] - from[j], from[next] - to[j]);
    // Corners run counter-clockwise seen against the way, so this points out of the facet.
    planes.outward[j] = -1.0 * planes.outward[j];
  }
  put(4, from[0], from[3] - from[1], from[2] - from[0]);
  put(5, to[0], to[2] - to[0], to[3] - to[1]);
  return planes;
}

}  // namespace glissade::parts
