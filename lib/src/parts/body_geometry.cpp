#include "parts/body_geometry.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/piece_distance.hpp"
#include "parts/angle_bar.hpp"
#include "parts/bores.hpp"
#include "parts/piece_mesh.hpp"
#include "parts/tube_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace glissade::parts {

Vec2 tangent_at(const PathPiece& piece, double share) {
  const Vec2 chord = piece.to - piece.from;
  const double angle = 4.0 * math::atan(piece.bulge) * (share - 0.5);
  const auto [sine, cosine] = math::sine_cosine(angle);
  return (1.0 / norm(chord)) * Vec2{cosine * chord.x - sine * chord.y, sine * chord.x + cosine * chord.y};
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

namespace {

constexpr double kInset = 20e-6;  // from a part's edges to the points that are looked for in others [m]
constexpr double kDeep = 10e-6;   // inside another part that counts as a clash [m]
constexpr double kFar = 1e300;

/// A plane section: x towards the upper side of its path, y across.
struct SectionMoments {
  double area = 0.0;
  double x = 0.0;  // first moments
  double y = 0.0;
  double xx = 0.0;  // second ones
  double xy = 0.0;
};

SectionMoments moments_of(const std::vector<Vec2>& corners) {
  SectionMoments all;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i];
    const Vec2 b = corners[(i + 1) % corners.size()];
    const double twice = cross(a, b);
    all.area += twice / 2.0;
    all.x += twice * (a.x + b.x) / 6.0;
    all.y += twice * (a.y + b.y) / 6.0;
    all.xx += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
    all.xy += twice * (a.x * b.y + 2.0 * a.x * a.y + 2.0 * b.x * b.y + b.x * a.y) / 24.0;
  }
  if (all.area > 0.0) return all;
  return {-all.area, -all.x, -all.y, -all.xx, -all.xy};
}

double curvature_of(const PathPiece& piece) {
  return 4.0 * math::atan(piece.bulge) / length(piece);
}

/// The section of a body at a share of a piece of its path.
std::vector<Vec2> section_at(const SweptBody& body, std::size_t piece, double share) {
  std::vector<Vec2> section = body.section;
  if (body.shifts.empty()) return section;
  for (std::size_t j = 0; j < section.size(); ++j)
    section[j].y += (1.0 - share) * body.shifts[piece][j] + share * body.shifts[piece + 1][j];
  return section;
}

/// What is left beside holes.
BodyMoments without(BodyMoments all, const std::vector<Bore>& bores) {
  for (const Bore& bore : bores) {
    const BoreMoments hole = moments(bore);
    const double left = all.volume - hole.volume;
    all.centroid = (1.0 / left) * (all.volume * all.centroid - hole.volume * hole.centroid);
    all.volume = left;
  }
  return all;
}

BodyMoments moments_of(const Prism& prism) {
  const AreaMoments area = glissade::moments(prism.region);
  return {area.area * prism.depth, {area.centroid.x, area.centroid.y, 0.5 * prism.depth}};
}

// Gauss, four points on each of four panels a piece.
constexpr std::array<double, 4> kNodes = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                          0.9305681557970263};
constexpr std::array<double, 4> kWeights = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                            0.1739274225687269};
constexpr int kPanels = 4;

BodyMoments moments_of(const SweptBody& body) {
  SectionMoments section = moments_of(body.section);
  BodyMoments all;
  Vec3 first;
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double whole = length(pieces[i]);
    const double curvature = curvature_of(pieces[i]);
    for (int panel = 0; panel < kPanels; ++panel) {
      for (std::size_t k = 0; k < kNodes.size(); ++k) {
        const double share = (panel + kNodes[k]) / kPanels;
        if (!body.shifts.empty()) section = moments_of(section_at(body, i, share));
        const Vec2 along = tangent_at(pieces[i], share);
        const double weight = kWeights[k] * whole / kPanels;
        const Vec2 at = point_on(pieces[i], share);
        const double volume = section.area - curvature * section.x;
        const double up = section.x - curvature * section.xx;
        all.volume += weight * volume;
        first.x += weight * (at.x * volume - along.y * up);
        first.y += weight * (at.y * volume + along.x * up);
        first.z += weight * (section.y - curvature * section.xy);
      }
    }
  }
  all.centroid = (1.0 / all.volume) * first;
  return without(all, bores_of(body));
}

/// What of a sheet lies between two places along its path, its edges being parallel to it.
struct Slab {
  std::size_t piece = 0;
  double from = 0.0;  ///< along the path
  double to = 0.0;
  SectionMoments section;
};

/// Of what lies between the two edges of a stretch of a sheet's section.
void add_strip(const RolledSheet& sheet, double low, double high, SectionMoments& sum) {
  const SectionMoments one = moments_of({sheet_place(sheet, low, true), sheet_place(sheet, high, true),
                                         sheet_place(sheet, high, false), sheet_place(sheet, low, false)});
  sum.area += one.area;
  sum.x += one.x;
  sum.y += one.y;
  sum.xx += one.xx;
  sum.xy += one.xy;
}

std::vector<Slab> slabs_of(const RolledSheet& sheet, const std::vector<PathPiece>& pieces) {
  std::vector<double> breaks = {0.0};
  std::vector<double> joints = {0.0};
  for (const PathPiece& piece : pieces) joints.push_back(joints.back() + length(piece));
  std::vector<const ArcPath*> loops = {&sheet.region.outline};
  for (const ArcPath& cutout : sheet.region.cutouts) loops.push_back(&cutout);
  breaks.insert(breaks.end(), joints.begin(), joints.end());
  for (const ArcPath* loop : loops) {
    for (const PathVertex& vertex : loop->vertices) breaks.push_back(vertex.at.x);
  }
  const std::vector<double> mitres = mitres_of(sheet);
  const bool bent = std::any_of(mitres.begin(), mitres.end(), [](double mitre) { return mitre != 0.0; });
  for (double& place : breaks) {
    constexpr double kSamePlace = 1e-9;  // [m]
    if (!bent) break;
    for (const double joint : joints) {
      if (std::fabs(place - joint) < kSamePlace) place = joint;
    }
  }
  std::sort(breaks.begin(), breaks.end());
  std::vector<Slab> slabs;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double middle = 0.5 * (breaks[k] + breaks[k + 1]);
    if (!(breaks[k + 1] > breaks[k]) || middle > joints.back()) continue;
    Slab slab{0, breaks[k], breaks[k + 1], {}};
    while (slab.piece + 1 < pieces.size() && middle > joints[slab.piece + 1]) ++slab.piece;
    std::vector<double> edges;
    for (const ArcPath* loop : loops) {
      for (const PathPiece& edge : pieces_of(*loop)) {
        if (std::min(edge.from.x, edge.to.x) <= middle && middle < std::max(edge.from.x, edge.to.x))
          edges.push_back(edge.from.y);
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
      add_strip(sheet, edges[i], edges[i + 1], slab.section);
    slabs.push_back(slab);
  }
  return slabs;
}

/// Of what lies between two planes that lean: its volume, and moments from its beginning, up and across.
/// @param from,to  by how much it is shorter there per height
Vec3 moments_between(const SectionMoments& section, double size, double from, double to, double& volume) {
  const double both = from + to;
  volume = section.area * size - section.x * both;
  return {
      0.5 * (section.area * size * size - 2.0 * size * to * section.x + (to * to - from * from) * section.xx),
      section.x * size - section.xx * both, section.y * size - section.xy * both};
}

BodyMoments moments_of(const RolledSheet& sheet) {
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  const std::vector<double> mitres = mitres_of(sheet);
  std::vector<double> starts = {0.0};
  for (const PathPiece& piece : pieces) starts.push_back(starts.back() + length(piece));
  BodyMoments all;
  Vec3 first;
  for (const Slab& slab : slabs_of(sheet, pieces)) {
    const PathPiece& piece = pieces[slab.piece];
    const SectionMoments& section = slab.section;
    const double curvature = curvature_of(piece);
    const double whole = length(piece);
    const double through = section.area - curvature * section.x;
    const double up = section.x - curvature * section.xx;
    const double size = slab.to - slab.from;
    const double mitre_from = slab.from == starts[slab.piece] ? mitres[slab.piece] : 0.0;
    const double mitre_to = slab.to == starts[slab.piece + 1] ? mitres[slab.piece + 1] : 0.0;
    if (mitre_from != 0.0 || mitre_to != 0.0) {
      double volume = 0.0;
      const Vec3 own = moments_between(section, size, mitre_from, mitre_to, volume);
      const Vec2 at = point_on(piece, (slab.from - starts[slab.piece]) / whole);
      const Vec2 along = tangent_at(piece, 0.0);
      all.volume += volume;
      first.x += at.x * volume + own.x * along.x - own.y * along.y;
      first.y += at.y * volume + own.x * along.y + own.y * along.x;
      first.z += own.z;
      continue;
    }
    all.volume += size * through;
    first.z += size * (section.y - curvature * section.xy);
    for (std::size_t k = 0; k < kNodes.size(); ++k) {
      const double share = (slab.from + kNodes[k] * size - starts[slab.piece]) / whole;
      const Vec2 at = point_on(piece, share);
      const Vec2 along = tangent_at(piece, share);
      const double weight = kWeights[k] * size;
      first.x += weight * (at.x * through - along.y * up);
      first.y += weight * (at.y * through + along.x * up);
    }
  }
  all.centroid = (1.0 / all.volume) * first;
  return without(all, bores_of(sheet));
}

/// Six outward planes of a facet of a folded plate; the last two lie at its bends or ends.
struct FacetPlanes {
  std::array<Vec3, 6> origins;
  std::array<Vec3, 6> outward;
};

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

BodyMoments moments_of(const FoldedPlate& plate) {
  BodyMoments all;
  Vec3 first;
  for (std::size_t i = 0; i + 1 < plate.corners.size(); ++i) {
    const FacetPlanes planes = planes_of(plate.corners[i], plate.corners[i + 1]);
    const Vec3 apex = plate.corners[i][0];
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 outward) {
      const Vec3 normal = cross(b - a, c - a);
      const double volume =
          std::fabs(dot(a - apex, normal)) / 6.0 * (dot(a - apex, outward) < 0.0 ? -1.0 : 1.0);
      all.volume += volume;
      first = first + (0.25 * volume) * (apex + a + b + c);
    };
    const auto quad = [&](std::size_t k, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
      add(a, b, c, planes.outward[k]);
      add(a, c, d, planes.outward[k]);
    };
    const auto& from = plate.corners[i];
    const auto& to = plate.corners[i + 1];
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t next = (j + 1) % 4;
      quad(j, from[j], to[j], to[next], from[next]);
    }
    quad(5, to[0], to[1], to[2], to[3]);
  }
  all.centroid = (1.0 / all.volume) * first;
  return all;
}

BodyMoments moments_of(const TubeGore& gore) {
  const double inner = gore.inner_radius;
  const double outer = inner + gore.thickness;
  const double area = std::numbers::pi * (outer * outer - inner * inner);
  const double second =
      0.25 * std::numbers::pi * (outer * outer * outer * outer - inner * inner * inner * inner);  // of x^2
  const double start = math::tan(gore.start_tilt.radians());
  const double end = math::tan(gore.end_tilt.radians());
  // The planes' x terms average out of the volume, not of its moments.
  const double x = second * (end - start);
  const double z = 0.5 * (area * gore.length * gore.length + second * (end * end - start * start));
  BodyMoments all{area * gore.length, {}};
  all.centroid = {x / all.volume, 0.0, z / all.volume};
  for (const TubeWindow& window : gore.windows) {
    const BodyMoments cut = parts::moments_of(window, gore);
    const double left = all.volume - cut.volume;
    all.centroid = (1.0 / left) * (all.volume * all.centroid - cut.volume * cut.centroid);
    all.volume = left;
  }
  return without(all, bores_of(gore));
}

BodyMoments moments_of(const TroughGore& gore) {
  const double inner = gore.inner_radius;
  const double outer = inner + gore.thickness;
  constexpr double kPi = std::numbers::pi;
  // Of the section: area, and its moments of x, the sides' and the half ring's.
  const double high = gore.side;
  const double area = 0.5 * kPi * (outer * outer - inner * inner) + 2.0 * gore.thickness * high;
  const double first =
      gore.thickness * high * high - 2.0 / 3.0 * (outer * outer * outer - inner * inner * inner);
  const double second = 0.125 * kPi * (outer * outer * outer * outer - inner * inner * inner * inner) +
                        2.0 / 3.0 * gore.thickness * high * high * high;
  const double start = math::tan(gore.start_tilt.radians());
  const double end = math::tan(gore.end_tilt.radians());
  const double volume = area * gore.length + first * (end - start);
  const double x = first * gore.length + second * (end - start);
  const double z = 0.5 * (area * gore.length * gore.length + 2.0 * first * gore.length * end +
                          second * (end * end - start * start));
  return {volume, {x / volume, 0.0, z / volume}};
}

BodyMoments moments_of(const AngleBar& bar) {
  const AreaMoments lying = glissade::moments(lying_leg(bar));
  const AreaMoments rising = glissade::moments(rising_leg(bar));
  const double low = lying.area * bar.thickness;
  const double high = rising.area * (bar.height - bar.thickness);
  const Vec2 middle = (1.0 / (low + high)) * (low * lying.centroid + high * rising.centroid);
  const double level = 0.5 * (low * bar.thickness + high * (bar.thickness + bar.height)) / (low + high);
  return {low + high, {middle.x, middle.y, level}};
}

BodyMoments moments_of(const MeshBody& body) {
  const MeshMoments all = mesh_moments(body.mesh);
  return {all.volume, all.centre};
}

/// Printed pieces are held against planes instead (prints.cpp).
std::vector<Vec3> points_of(const MeshBody& /*body*/, double /*inset*/) {
  return {};
}

std::vector<Vec3> points_of(const Prism& prism, double inset) {
  std::vector<Vec3> points;
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
    const SectionMoments section = moments_of(corners);
    const Vec2 middle{section.x / section.area, section.y / section.area};
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
  return points;
}

std::vector<Vec3> points_of(const RolledSheet& sheet, double inset) {
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  std::vector<double> starts = {0.0};
  for (const PathPiece& piece : pieces) starts.push_back(starts.back() + length(piece));
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
  const auto along_edges = [&](const ArcPath& path, bool outline) {
    const bool left = (signed_area(path) > 0.0) == outline;  // the material's side
    for (const PathPiece& edge : pieces_of(path)) {
      const Vec2 step = edge.to - edge.from;
      const double whole = norm(step);
      if (!(whole > 0.0)) continue;
      const Vec2 inward = ((left ? inset : -inset) / whole) * Vec2{-step.y, step.x};
      const int count =
          4 + static_cast<int>(4.0 * whole / starts.back() * static_cast<double>(pieces.size()));
      for (int k = 0; k < count; ++k) put(edge.from + ((k + 0.5) / count) * step + inward);
    }
  };
  along_edges(sheet.region.outline, true);
  for (const ArcPath& cutout : sheet.region.cutouts) along_edges(cutout, false);
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
  for (const double radius : {gore.inner_radius + inset, gore.inner_radius + gore.thickness - inset}) {
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
  return points;
}

std::vector<Vec3> points_of(const TubeGore& gore, double inset) {
  std::vector<Vec3> points = points_beside(gore, inset);
  constexpr int kPoints = 24;
  for (int k = 0; k < kPoints; ++k) {
    const auto [sine, cosine] = math::sine_cosine(2.0 * std::numbers::pi * k / kPoints);
    for (const double radius : {gore.inner_radius + inset, gore.inner_radius + gore.thickness - inset}) {
      const double x = radius * cosine;
      const double low = x * math::tan(gore.start_tilt.radians()) + 2.0 * inset;
      const double high = gore.length + x * math::tan(gore.end_tilt.radians()) - 2.0 * inset;
      for (const double z : {low, 0.5 * (low + high), high}) {
        const Vec3 point{x, radius * sine, z};
        const bool cut = std::any_of(gore.windows.begin(), gore.windows.end(), [&](const TubeWindow& window) {
          return parts::beside(window, point) < 0.0;
        });
        if (!cut) points.push_back(point);
      }
    }
  }
  return points;
}

double distance_to(const ArcPath& path, Vec2 point) {
  double least = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : pieces_of(path)) {
    // No point of an arc of up to half a turn is farther from its middle than half its chord and its rise.
    const double half = 0.5 * norm(piece.to - piece.from);
    const double away = norm(point - 0.5 * (piece.from + piece.to));
    if (std::fabs(piece.bulge) <= 1.0 && away - half * (1.0 + std::fabs(piece.bulge)) > least) continue;
    least = std::min(least, core::distance_to_piece(piece, point));
  }
  return least;
}

double depth_in(const PlaneRegion& region, Vec2 point) {
  double edge = distance_to(region.outline, point);
  bool inside = contains(region.outline, point);
  for (const ArcPath& cutout : region.cutouts) {
    edge = std::min(edge, distance_to(cutout, point));
    inside = inside && !contains(cutout, point);
  }
  return inside ? edge : -edge;
}

double depth_in(const Prism& prism, Vec3 point) {
  const double between = std::min(point.z, prism.depth - point.z);
  if (between <= 0.0) return between;
  const double flat = depth_in(prism.region, Vec2{point.x, point.y});
  return flat > 0.0 ? std::min(flat, between) : flat;
}

double depth_in(const AngleBar& bar, Vec3 point) {
  const auto legs = legs_of(bar);
  return std::max(depth_in(legs[0], point), depth_in(legs[1], point));
}

/// Where a point lies beside a piece of a path.
struct Beside {
  double along = 0.0;  ///< from the piece's start
  double above = 0.0;  ///< to its left
};

Beside beside(const PathPiece& piece, Vec2 point) {
  // The circle of an arc that rises less than this is so large that the distance from it is lost in rounding.
  constexpr double kFlatRise = 1e-8;
  if (0.5 * std::fabs(piece.bulge) * norm(piece.to - piece.from) < kFlatRise) {
    const Vec2 tangent = tangent_at(piece, 0.0);
    return {dot(point - piece.from, tangent), cross(tangent, point - piece.from)};
  }
  const CircularArc arc = arc_of(piece);
  const Vec2 spoke = point - arc.centre;
  const Vec2 start = piece.from - arc.centre;
  const double sense = arc.sweep > 0.0 ? 1.0 : -1.0;
  return {sense * arc.radius * math::atan2(cross(start, spoke), dot(start, spoke)),
          sense * (arc.radius - norm(spoke))};
}

/// The depth of a point inside what lies along a path.
/// @param across  (piece, share of it, height above it): depth square to the path
/// @param mitres  as mitres_of(); none: no two pieces meet at a bend
template <typename Across>
double depth_along(const std::vector<PathPiece>& pieces, Vec2 point, Across across,
                   const std::vector<double>& mitres = {}) {
  double deepest = -kFar;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // Ends of the body alone count as faces.
    const auto [along, above] = beside(pieces[i], point);
    const double whole = length(pieces[i]);
    double to_start = along;
    double to_end = whole - along;
    if (!mitres.empty() && (mitres[i] != 0.0 || mitres[i + 1] != 0.0)) {
      to_start = (along - above * mitres[i]) / math::hypot(1.0, mitres[i]);
      to_end = (whole - along - above * mitres[i + 1]) / math::hypot(1.0, mitres[i + 1]);
    }
    const double from_start = i == 0 ? to_start : to_start + kInset;
    const double from_end = (i + 1 == pieces.size() ? 0.0 : kInset) + to_end;
    const double lengthwise = std::min(i == 0 ? from_start : kFar, i + 1 == pieces.size() ? from_end : kFar);
    if (from_start < 0.0 || from_end < 0.0) {
      deepest = std::max(deepest, std::min(from_start, from_end));
      continue;
    }
    const double flat_depth = across(i, std::clamp(along / whole, 0.0, 1.0), above);
    deepest = std::max(deepest, flat_depth > 0.0 ? std::min(flat_depth, lengthwise) : flat_depth);
  }
  return deepest;
}

double depth_in(const SweptBody& body, Vec3 point) {
  return depth_along(pieces_of(body.path), {point.x, point.y},
                     [&](std::size_t i, double share, double above) {
                       ArcPath section{{}, true};
                       for (const Vec2 corner : section_at(body, i, share))
                         section.vertices.push_back({corner, 0.0});
                       return depth_in(PlaneRegion{section, {}, {}}, Vec2{above, point.z});
                     });
}

double depth_in(const RolledSheet& sheet, Vec3 point) {
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  std::vector<double> starts = {0.0};
  for (const PathPiece& piece : pieces) starts.push_back(starts.back() + length(piece));
  return depth_along(
      pieces, {point.x, point.y},
      [&](std::size_t i, double share, double above) {
        const Vec2 away = Vec2{above, point.z} - sheet.foot;
        const double depth = dot(Vec2{-sheet.across.y, sheet.across.x}, away);
        const double between = std::min(depth, sheet.thickness - depth);
        if (between <= 0.0) return between;
        const double x = starts[i] + share * length(pieces[i]);
        // Where it would be on the upper face, edges leaning as they do.
        const double lower = dot(sheet.across, away);
        double y = lower;
        constexpr int kRounds = 40;
        for (int k = 0; k < kRounds && !sheet.bevels.empty(); ++k)
          y = lower - depth / sheet.thickness * bevel_at(sheet, y);
        const double flat = depth_in(sheet.region, Vec2{x, y});
        return flat > 0.0 ? std::min(flat, between) : flat;
      },
      mitres_of(sheet));
}

double depth_in(const TroughGore& gore, Vec3 point) {
  const double radius = point.x < 0.0 ? math::hypot(point.x, point.y) : std::fabs(point.y);
  const double start =
      (point.z - point.x * math::tan(gore.start_tilt.radians())) * math::cos(gore.start_tilt.radians());
  const double end = (gore.length + point.x * math::tan(gore.end_tilt.radians()) - point.z) *
                     math::cos(gore.end_tilt.radians());
  return std::min({radius - gore.inner_radius, gore.inner_radius + gore.thickness - radius, start, end,
                   gore.side - point.x});
}

double depth_in(const FoldedPlate& plate, Vec3 point) {
  double deepest = -kFar;
  const std::size_t count = plate.corners.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const FacetPlanes planes = planes_of(plate.corners[i], plate.corners[i + 1]);
    double depth = kFar;
    for (std::size_t k = 0; k < 6; ++k) {
      double inside = -dot(point - planes.origins[k], planes.outward[k]);
      // Bends are no faces: beyond them the next facet goes on.
      const bool bend = (k == 4 && i > 0) || (k == 5 && i + 1 < count);
      if (bend && inside > -kInset) inside = kFar;
      depth = std::min(depth, inside);
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

double depth_in(const MeshBody& /*body*/, Vec3 /*point*/) {
  return -kFar;
}

double depth_in(const TubeGore& gore, Vec3 point) {
  const double radius = math::hypot(point.x, point.y);
  const double start =
      (point.z - point.x * math::tan(gore.start_tilt.radians())) * math::cos(gore.start_tilt.radians());
  const double end = (gore.length + point.x * math::tan(gore.end_tilt.radians()) - point.z) *
                     math::cos(gore.end_tilt.radians());
  double depth =
      std::min({radius - gore.inner_radius, gore.inner_radius + gore.thickness - radius, start, end});
  for (const TubeWindow& window : gore.windows) depth = std::min(depth, parts::beside(window, point));
  return depth;
}

/// A straight edge, just inside its body.
struct EdgeLine {
  Vec3 from;
  Vec3 to;
};

/// Beside every corner of an outline, across the depth, and along its straight pieces: long ones may go through another part
/// between any points that are looked for.
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

/// Of others the points are as close as they are thick, or prisms' edges find them.
template <typename Body>
std::vector<EdgeLine> lines_of(const Body& /*body*/, double /*inset*/) {
  return {};
}

/// One piece in space, for looking into.
struct Box {
  Vec3 low{kFar, kFar, kFar};
  Vec3 high{-kFar, -kFar, -kFar};

  void widen(Vec3 point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
  }
  [[nodiscard]] bool meets(const Box& other, double margin) const {
    return other.low.x <= high.x + margin && low.x <= other.high.x + margin &&
           other.low.y <= high.y + margin && low.y <= other.high.y + margin &&
           other.low.z <= high.z + margin && low.z <= other.high.z + margin;
  }
};

constexpr double kMargin = 1e-3;  // of boxes round points that lie just inside

struct Piece {
  const ShopPart* part = nullptr;
  Frame place;
  std::vector<Vec3> points;
  Box box;
  Box own;  ///< in its own frame, where a thin plate that leans is thin
  std::vector<EdgeLine> lines = {};
};

std::vector<Piece> pieces_in_space(const Workshop& workshop) {
  std::vector<Piece> pieces;
  for (const ShopPart& part : workshop.parts) {
    const std::vector<Vec3> own = edge_points(part.body, kInset);
    Box box;
    for (const Vec3 local : own) box.widen(local);
    const std::vector<EdgeLine> lines =
        std::visit([](const auto& body) { return lines_of(body, kInset); }, part.body);
    for (const Frame& place : part.places) {
      Piece piece{&part, place, {}, {}, box};
      for (const EdgeLine& line : lines)
        piece.lines.push_back({place.to_space(line.from), place.to_space(line.to)});
      for (const Vec3 local : own) {
        piece.points.push_back(place.to_space(local));
        piece.box.widen(piece.points.back());
      }
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

[[noreturn]] void tell_clash(const Piece& a, const Piece& b, double depth) {
  throw InternalError(
      {"", "parts clash: " + a.part->name + " reaches " + length_text(depth, 3) + " into " + b.part->name, "",
       "another design, and a report of this one"});
}

/// Along an edge, in steps that the distance from the other part allows: nothing thicker than half a plate is stepped over.
void require_apart(const Piece& a, const EdgeLine& line, const Piece& b) {
  const auto in_own = [&](Vec3 point) {
    const Vec3 away = point - b.place.origin;
    return Vec3{dot(away, b.place.x), dot(away, b.place.y), dot(away, b.place.z)};
  };
  const Vec3 from = in_own(line.from);
  const Vec3 way = in_own(line.to) - from;
  const double whole = norm(way);
  Box box;
  box.widen(from);
  box.widen(from + way);
  if (!(whole > 0.0) || !b.own.meets(box, kMargin)) return;
  constexpr double kLeastStep = 0.5e-3;
  const double step = std::max(kLeastStep, 0.5 * b.part->thickness);
  for (double at = 0.0; at < whole;) {
    const double depth = depth_inside(b.part->body, from + (at / whole) * way);
    if (depth > kInset + kDeep) tell_clash(a, b, depth);
    at += std::max(step, -depth);
  }
}

/// Points and edges of one piece inside another.
void require_apart(const Piece& a, const Piece& b) {
  for (const EdgeLine& line : a.lines) require_apart(a, line, b);
  for (const Vec3 point : a.points) {
    if (!b.box.meets({point, point}, kMargin)) continue;
    const Vec3 away = point - b.place.origin;
    const Vec3 own{dot(away, b.place.x), dot(away, b.place.y), dot(away, b.place.z)};
    if (!b.own.meets({own, own}, kMargin)) continue;
    const double depth = depth_inside(b.part->body, own);
    if (depth <= kInset + kDeep) continue;
    tell_clash(a, b, depth);
  }
}

}  // namespace

BodyMoments moments(const PartBody& body) {
  return std::visit([](const auto& one) { return moments_of(one); }, body);
}

void weigh(ShopPart& part) {
  const BodyMoments all = moments(part.body);
  part.volume = all.volume;
  part.mass = part.volume * part.density;
  part.centre_of_gravity = part.places.front().to_space(all.centroid);
}

std::vector<Vec3> edge_points(const PartBody& body, double inset) {
  return std::visit([&](const auto& one) { return points_of(one, inset); }, body);
}

double depth_inside(const PartBody& body, Vec3 point) {
  return std::visit([&](const auto& one) { return depth_in(one, point); }, body);
}

std::size_t require_no_clash(const Workshop& workshop) {
  const std::vector<Piece> pieces = pieces_in_space(workshop);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (k != i && pieces[k].box.meets(pieces[i].box, kMargin)) require_apart(pieces[i], pieces[k]);
    }
  }
  return pieces.size() * (pieces.size() - 1) / 2;
}

}  // namespace glissade::parts
