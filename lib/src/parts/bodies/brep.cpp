#include "parts/bodies/brep.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_places.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/bodies/brep_building.hpp"
#include "parts/bodies/brep_contour.hpp"
#include "parts/bodies/swept_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

// --- prisms

Brep brep_of(const Prism& prism, const ShopPart& part) {
  const std::vector<std::string> faults = faults_of(prism.region);
  if (!faults.empty()) throw bad_body(part, faults.front());
  if (!(prism.depth > 0.0)) throw bad_body(part, "its depth is " + length_text(prism.depth));
  const PlaneRegion region = scaled(prism.region, core::kMillimetres);
  Brep brep;
  ContourFaces faces(brep, prism.depth * core::kMillimetres);
  faces.add(turning(region.outline, true));
  for (const ArcPath& cutout : region.cutouts) faces.add(turning(cutout, false));
  for (const Circle& hole : region.holes) faces.add(hole);
  faces.close();
  return brep;
}

// --- sections along a path

class SweptFaces {
 public:
  SweptFaces(const SweptBody& body, const ShopPart& part)
      : part_(part), pieces_(pieces_of(scaled(body.path, core::kMillimetres))) {
    if (pieces_.empty() || body.path.closed) throw bad_body(part, "its path is closed or has no piece");
    if (body.section.size() < 3) throw bad_body(part, "its section has fewer than three corners");
    const bool moves = !body.shifts.empty();
    if (moves && body.shifts.size() != pieces_.size() + 1)
      throw bad_body(part, "its section does not move at every vertex of its path");
    double twice = 0.0;
    for (std::size_t j = 0; j < body.section.size(); ++j) {
      twice += cross(body.section[j], body.section[(j + 1) % body.section.size()]);
    }
    for (std::size_t i = 0; i <= pieces_.size(); ++i) {
      std::vector<Vec2> section = body.section;
      for (std::size_t j = 0; j < section.size(); ++j)
        section[j] = core::kMillimetres * (section[j] + Vec2{0.0, moves ? body.shifts[i].at(j) : 0.0});
      if (twice < 0.0) std::reverse(section.begin(), section.end());
      sections_.push_back(std::move(section));
    }
    if (body.holes.empty() && body.windows.empty()) return;
    if (twice < 0.0 || body.section.size() != 4) throw bad_body(part, "it is no plate that holes go through");
    plate_.path = scaled(body.path, core::kMillimetres);
    plate_.shifts = body.shifts;
    for (std::vector<double>& station : plate_.shifts) {
      for (double& shift : station) shift *= core::kMillimetres;
    }
    for (const Vec2 corner : body.section) plate_.section.push_back(core::kMillimetres * corner);
    for (const Circle& hole : body.holes)
      plate_.holes.push_back({core::kMillimetres * hole.centre, core::kMillimetres * hole.radius});
    for (const SweptWindow& one : body.windows)
      plate_.windows.push_back({core::kMillimetres * one.from, core::kMillimetres * one.to,
                                core::kMillimetres * one.low, core::kMillimetres * one.high});
    bores_ = bores_of(plate_);
  }

  Brep whole() {
    stations();
    for (std::size_t i = 0; i < pieces_.size(); ++i) lengthwise(i);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (std::size_t j = 0; j < corners(); ++j) brep_.faces.push_back(face(i, j));
    }
    for (const Bore& bore : bores_) {
      const BoreLoops loops = add_bore(brep_, bore);
      brep_.faces[bore.piece * corners()].loops.push_back({loops.face});
      brep_.faces[bore.piece * corners() + 2].loops.push_back({loops.back});
    }
    for (const SweptWindow& window : plate_.windows) add_window(window);
    cap(0, start_tangent(pieces_.front()), false);
    cap(pieces_.size(), end_tangent(pieces_.back()), true);
    return std::move(brep_);
  }

 private:
  [[nodiscard]] std::size_t corners() const { return sections_.front().size(); }
  [[nodiscard]] Vec2 corner(std::size_t station, std::size_t j) const {
    return sections_[station][j % corners()];
  }
  [[nodiscard]] std::size_t vertex(std::size_t station, std::size_t corner) const {
    return station * corners() + corner % corners();
  }
  /// Edges come in the order of their making: those across first, then those along.
  [[nodiscard]] std::size_t across(std::size_t station, std::size_t corner) const {
    return vertex(station, corner);
  }
  [[nodiscard]] std::size_t along(std::size_t piece, std::size_t corner) const {
    return vertex(pieces_.size() + 1 + piece, corner);
  }
  [[nodiscard]] bool moves(std::size_t i, std::size_t j) const {
    return corner(i, j).y != corner(i + 1, j).y;
  }

  void stations() {
    constexpr double kKink = 1e-7;  // what bulges rounded to doubles leave is far less
    for (std::size_t i = 0; i <= pieces_.size(); ++i) {
      const bool last = i == pieces_.size();
      const Vec2 tangent = last ? end_tangent(pieces_.back()) : start_tangent(pieces_[i]);
      if (i > 0 && !last && std::fabs(cross(end_tangent(pieces_[i - 1]), tangent)) > kKink) {
        throw bad_body(part_, "its path has a kink after piece " + std::to_string(i));
      }
      const Vec2 left{-tangent.y, tangent.x};
      const Vec2 at = last ? pieces_.back().to : pieces_[i].from;
      for (const Vec2 corner : sections_[i]) add_vertex(brep_, at_height(at + corner.x * left, corner.y));
    }
    for (std::size_t i = 0; i <= pieces_.size(); ++i) {
      for (std::size_t j = 0; j < corners(); ++j) add_line(brep_, vertex(i, j), vertex(i, j + 1));
    }
  }

  void lengthwise(std::size_t i) {
    const PathPiece& piece = pieces_[i];
    for (std::size_t j = 0; j < corners(); ++j) {
      if (piece.straight()) {
        add_line(brep_, vertex(i, j), vertex(i + 1, j));
        continue;
      }
      const CircularArc arc = arc_of(piece);
      const double to_left = piece.bulge > 0.0 ? 1.0 : -1.0;
      if (!(arc.radius - to_left * corner(i, j).x > 0.0)) {
        throw bad_body(part_, "its section reaches beyond the centre of arc " + std::to_string(i + 1) +
                                  ", radius " + length_text(arc.radius / core::kMillimetres));
      }
      if (moves(i, j)) {
        add_helix(brep_, vertex(i, j), vertex(i + 1, j), arc.centre, arc.sweep);
      } else {
        add_arc(brep_, vertex(i, j), vertex(i + 1, j), arc.centre, piece.bulge > 0.0);
      }
    }
  }

  BrepFace face(std::size_t i, std::size_t j) {
    const PathPiece& piece = pieces_[i];
    BrepFace made = piece.straight() ? flat(i, j) : round(i, j);
    made.loops = {
        {{across(i, j), true}, {along(i, j + 1), true}, {across(i + 1, j), false}, {along(i, j), false}}};
    return made;
  }

  BrepFace flat(std::size_t i, std::size_t j) {
    return flat_face(brep_, vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
  }

  BrepFace round(std::size_t i, std::size_t j) {
    const bool moved = moves(i, j) || moves(i, j + 1);
    const Vec2 from = corner(i, j);
    const Vec2 to = corner(i, j + 1);
    // Level faces stay what they are wherever their edges go.
    if (moved && from.x != to.x) return ruled(i, j);
    return round_face(pieces_[i], from, to);
  }

  /// Straight lines across, between edges that are no arcs.
  BrepFace ruled(std::size_t i, std::size_t j) {
    BrepFace made;
    made.kind = SurfaceKind::ruled;
    const double sweep = arc_of(pieces_[i]).sweep;
    const Vec2 centre = arc_of(pieces_[i]).centre;
    for (std::size_t k = 0; k < 2; ++k)
      made.rails[k] =
          helix_poles(brep_.vertices[vertex(i, j + k)], brep_.vertices[vertex(i + 1, j + k)], centre, sweep);
    return made;
  }

  /// The walls of a window, and its mouths in both faces of the plate: a piece of plate turned inside out.
  void add_window(const SweptWindow& window) {
    const auto [i, begins] = piece_at(pieces_, window.from);
    const PathPiece& piece = pieces_[i];
    const std::vector<Vec2> section = section_of(window, first_edge(plate_, i));
    std::array<std::array<std::size_t, 4>, 2> at{};
    std::array<std::array<std::size_t, 4>, 2> round{};
    std::array<std::size_t, 4> lengthwise{};
    std::array<Vec2, 2> along;
    for (std::size_t end = 0; end < 2; ++end) {
      const double share = ((end == 0 ? window.from : window.to) - begins) / length(piece);
      along[end] = tangent_at(piece, share);
      const Vec2 left{-along[end].y, along[end].x};
      for (std::size_t k = 0; k < 4; ++k)
        at[end][k] = add_vertex(brep_, at_height(point_on(piece, share) + section[k].x * left, section[k].y));
      for (std::size_t k = 0; k < 4; ++k) round[end][k] = add_line(brep_, at[end][k], at[end][(k + 1) % 4]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      lengthwise[k] = piece.straight()
                          ? add_line(brep_, at[0][k], at[1][k])
                          : add_arc(brep_, at[0][k], at[1][k], arc_of(piece).centre, piece.bulge > 0.0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      std::vector<BrepUse> loop = {
          {lengthwise[k], true}, {round[1][k], true}, {lengthwise[next], false}, {round[0][k], false}};
      if (k % 2 == 0) {
        brep_.faces[i * corners() + k].loops.push_back(std::move(loop));
        continue;
      }
      BrepFace wall = piece.straight() ? flat_face(brep_, at[0][next], at[1][next], at[0][k])
                                       : round_face(piece, section[next], section[k]);
      wall.loops = {std::move(loop)};
      brep_.faces.push_back(std::move(wall));
    }
    for (std::size_t end = 0; end < 2; ++end) {
      BrepFace wall;
      wall.origin = brep_.vertices[at[end][0]];
      wall.axis = (end == 0 ? 1.0 : -1.0) * at_height(along[end], 0.0);
      wall.reference = kUp;
      std::vector<BrepUse> loop;
      for (std::size_t k = 0; k < 4; ++k) loop.push_back({round[end][end == 0 ? k : 3 - k], end == 0});
      wall.loops = {std::move(loop)};
      brep_.faces.push_back(std::move(wall));
    }
  }

  void cap(std::size_t station, Vec2 tangent, bool forward) {
    BrepFace made;
    made.origin = brep_.vertices[vertex(station, 0)];
    made.axis = (forward ? 1.0 : -1.0) * at_height(tangent, 0.0);
    made.reference = kUp;
    std::vector<BrepUse> loop;
    for (std::size_t j = 0; j < corners(); ++j) loop.push_back({across(station, j), forward});
    if (!forward) std::reverse(loop.begin(), loop.end());
    made.loops = {std::move(loop)};
    brep_.faces.push_back(std::move(made));
  }

  const ShopPart& part_;
  std::vector<PathPiece> pieces_;
  std::vector<std::vector<Vec2>> sections_;  ///< at every vertex of the path
  SweptBody plate_;                          ///< that holes and windows go through
  std::vector<Bore> bores_;
  Brep brep_;
};

Brep brep_of(const FoldedPlate& plate, const ShopPart& part) {
  if (plate.corners.size() < 2) throw bad_body(part, "it has no facet");
  Brep brep;
  for (const auto& corners : plate.corners) {
    for (const Vec3 corner : corners) add_vertex(brep, core::kMillimetres * corner);
  }
  const std::size_t rings = plate.corners.size();
  // Edges across at each ring, then those along to the next one.
  for (std::size_t i = 0; i < rings; ++i) {
    for (std::size_t j = 0; j < 4; ++j) add_line(brep, 4 * i + j, 4 * i + (j + 1) % 4);
  }
  for (std::size_t i = 0; i + 1 < rings; ++i) {
    for (std::size_t j = 0; j < 4; ++j) add_line(brep, 4 * i + j, 4 * i + 4 + j);
  }
  const auto across = [](std::size_t i, std::size_t j) { return 4 * i + j; };
  const auto along = [&](std::size_t i, std::size_t j) { return 4 * (rings + i) + j % 4; };
  const auto add = [&](std::vector<BrepUse> loop) {
    const auto start = [&](const BrepUse& use) {
      const BrepEdge& edge = brep.edges[use.edge];
      return brep.vertices[use.forward ? edge.from : edge.to];
    };
    BrepFace face;
    face.origin = start(loop[0]);
    face.axis = unit(cross(start(loop[2]) - start(loop[0]), start(loop[3]) - start(loop[1])));
    face.reference = unit(start(loop[1]) - start(loop[0]));
    face.loops = {std::move(loop)};
    brep.faces.push_back(std::move(face));
  };
  for (std::size_t i = 0; i + 1 < rings; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      add({{across(i, j), true}, {along(i, j + 1), true}, {across(i + 1, j), false}, {along(i, j), false}});
  }
  add({{across(0, 3), false}, {across(0, 2), false}, {across(0, 1), false}, {across(0, 0), false}});
  const std::size_t last = rings - 1;
  add({{across(last, 0), true}, {across(last, 1), true}, {across(last, 2), true}, {across(last, 3), true}});
  return brep;
}

Brep brep_of(const MeshBody& /*body*/, const ShopPart& part) {
  throw bad_body(part, "it is made of facets: it has no faces but those");
}

Brep brep_of(const SweptBody& body, const ShopPart& part) {
  return SweptFaces(body, part).whole();
}

Brep brep_of(const RolledSheet& sheet, const ShopPart& part) {
  return brep_of_sheet(sheet, part);
}

Brep brep_of(const TubeGore& gore, const ShopPart& part) {
  return brep_of_tube(gore, part);
}

Brep brep_of(const AngleBar& bar, const ShopPart& part) {
  return brep_of_angle(bar, part);
}

Brep brep_of(const TroughGore& gore, const ShopPart& part) {
  return brep_of_trough(gore, part);
}

}  // namespace

Brep brep_of(const ShopPart& part) {
  return std::visit([&](const auto& body) { return brep_of(body, part); }, part.body);
}

}  // namespace glissade::parts
