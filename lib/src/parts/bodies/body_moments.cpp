#include "parts/bodies/body_moments.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_places.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/bodies/piece_mesh.hpp"
#include "parts/bodies/swept_windows.hpp"
#include "parts/bodies/tube_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace glissade::parts {
namespace {

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

/// What a section sweeps along a stretch of a piece: its volume, and first moments.
struct SweptMoments {
  double volume = 0.0;
  Vec3 first;

  /// @param from,to   shares of the piece
  /// @param section   moments at a share
  /// @param sense     -1: what is taken away
  template <typename Section>
  void add(const PathPiece& piece, double from, double to, const Section& section, double sense) {
    const double whole = (to - from) * length(piece);
    const double curvature = curvature_of(piece);
    for (int panel = 0; panel < kPanels; ++panel) {
      for (std::size_t k = 0; k < kNodes.size(); ++k) {
        const double share = from + (to - from) * ((panel + kNodes[k]) / kPanels);
        const SectionMoments here = section(share);
        const Vec2 along = tangent_at(piece, share);
        const double weight = sense * kWeights[k] * whole / kPanels;
        const Vec2 at = point_on(piece, share);
        const double layer = here.area - curvature * here.x;
        const double up = here.x - curvature * here.xx;
        volume += weight * layer;
        first.x += weight * (at.x * layer - along.y * up);
        first.y += weight * (at.y * layer + along.x * up);
        first.z += weight * (here.y - curvature * here.xy);
      }
    }
  }
};

BodyMoments moments_of(const SweptBody& body) {
  const SectionMoments section = moments_of(body.section);
  SweptMoments all;
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto at = [&](double share) {
      return body.shifts.empty() ? section : moments_of(section_at(body, i, share));
    };
    all.add(pieces[i], 0.0, 1.0, at, 1.0);
  }
  for (const SweptWindow& window : body.windows) {
    const auto [i, begins] = piece_at(pieces, window.from);
    const SectionMoments cut = moments_of(section_of(window, first_edge(body, i)));
    const double whole = length(pieces[i]);
    all.add(
        pieces[i], (window.from - begins) / whole, (window.to - begins) / whole, [&](double) { return cut; },
        -1.0);
  }
  return without({all.volume, (1.0 / all.volume) * all.first}, bores_of(body));
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
  const std::vector<double> joints = starts_of(pieces);
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
  const std::vector<double> starts = starts_of(pieces);
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

/// What is left of a tube beside its windows and holes.
BodyMoments without_openings(BodyMoments all, const TubeGore& gore) {
  for (const TubeWindow& window : gore.windows) {
    const BodyMoments cut = parts::moments_of(window, gore);
    const double left = all.volume - cut.volume;
    all.centroid = (1.0 / left) * (all.volume * all.centroid - cut.volume * cut.centroid);
    all.volume = left;
  }
  return without(all, bores_of(gore));
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
  return without_openings(all, gore);
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
  return without_openings({volume, {x / volume, 0.0, z / volume}}, round_of(gore));
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

void weigh_sheet(ShopPart& part) {
  part.mass = glissade::moments(part.pattern->region).area * part.thickness * part.density;
}

}  // namespace glissade::parts
