// Sheets along a chain of lines and arcs: each piece of the chain has a face above and one below, sides stand where the
// region ends.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_places.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/bodies/brep_building.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kSamePlace = 1e-6;  // along the path [mm]

RolledSheet in_millimetres(RolledSheet sheet) {
  sheet.path = scaled(sheet.path, core::kMillimetres);
  sheet.thickness *= core::kMillimetres;
  sheet.region = scaled(sheet.region, core::kMillimetres);
  sheet.foot = core::kMillimetres * sheet.foot;
  for (Bevel& bevel : sheet.bevels) bevel = {core::kMillimetres * bevel.at, core::kMillimetres * bevel.below};
  return sheet;
}

/// A corner of the sheet: its vertices in the upper and the lower face.
struct Corner {
  Vec2 at;
  std::size_t upper = 0;
  std::size_t lower = 0;
};

class SheetFaces {
 public:
  SheetFaces(const RolledSheet& sheet, const ShopPart& part)
      : part_(part),
        pieces_(pieces_of(scaled(sheet.path, core::kMillimetres))),
        sheet_(in_millimetres(sheet)),
        mitres_(mitres_of(sheet)),
        region_(sheet_.region) {
    if (pieces_.empty() || sheet.path.closed) throw bad_body(part, "its path is closed or has no piece");
    if (!(sheet.thickness > 0.0)) throw bad_body(part, "its thickness is " + length_text(sheet.thickness));
    const std::vector<std::string> faults = faults_of(sheet.region);
    if (!faults.empty()) throw bad_body(part, faults.front());
    starts_ = {0.0};
    for (const PathPiece& piece : pieces_) {
      starts_.push_back(starts_.back() + length(piece));
      if (piece.straight()) continue;
      const double radius = arc_of(piece).radius;
      for (const PathVertex& vertex : region_.outline.vertices) {
        for (const bool upper : {true, false}) {
          const double left = sheet_place(sheet_, vertex.at.y, upper).x;
          if ((piece.bulge > 0.0 ? left : -left) < radius) continue;
          throw bad_body(
              part, "it reaches beyond the radius of its path, " + length_text(radius / core::kMillimetres));
        }
      }
    }
  }

  Brep whole() {
    const std::vector<Vec2> outline = on_joints(turning(region_.outline, true));
    upper_.resize(pieces_.size());
    lower_.resize(pieces_.size());
    std::vector<std::vector<Vec2>> across_joints;  // cutouts
    for (const ArcPath& path : region_.cutouts) {
      const ArcPath cutout = turning(path, false);
      const std::vector<Vec2> corners = on_joints(cutout);
      if (corners.size() > cutout.vertices.size()) across_joints.push_back(corners);
    }
    if (across_joints.empty())
      add_outline(outline);
    else
      add_cut_outline(outline, across_joints);
    for (const ArcPath& path : region_.cutouts) {
      const ArcPath cutout = turning(path, false);
      if (on_joints(cutout).size() == cutout.vertices.size()) add_cutout(cutout);
    }
    for (const Bore& bore : bores_of(sheet_)) {
      const BoreLoops loops = add_bore(brep_, bore);
      upper_[bore.piece].push_back({loops.face});
      lower_[bore.piece].push_back({loops.back});
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (const bool top : {true, false}) add_sheet_faces(i, top);
    }
    return std::move(brep_);
  }

 private:
  /// Corners of a loop, those near a joint moved onto it, with one wherever an edge crosses a joint.
  [[nodiscard]] std::vector<Vec2> on_joints(const ArcPath& loop) const {
    std::vector<Vec2> corners;
    for (const PathVertex& vertex : loop.vertices) corners.push_back({snapped(vertex.at.x), vertex.at.y});
    std::vector<Vec2> all;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 from = corners[k];
      const Vec2 to = corners[(k + 1) % corners.size()];
      if (from == to) continue;
      if (from.x != to.x && from.y != to.y)
        throw bad_body(part_, "an edge of its sheet is neither along nor across");
      all.push_back(from);
      std::vector<double> between;
      for (const double joint : starts_) {
        if (joint > std::min(from.x, to.x) && joint < std::max(from.x, to.x)) between.push_back(joint);
      }
      if (to.x < from.x) std::reverse(between.begin(), between.end());
      for (const double joint : between) all.push_back({joint, from.y});
    }
    return all;
  }

  [[nodiscard]] double snapped(double x) const {
    for (const double joint : starts_) {
      if (std::fabs(joint - x) < kSamePlace) return joint;
    }
    return x;
  }

  /// The piece on which an edge lies; of one across, that with its place.
  [[nodiscard]] std::size_t piece_of(Vec2 from, Vec2 to) const {
    const double middle = 0.5 * (from.x + to.x);
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && middle > starts_[i + 1]) ++i;
    return i;
  }

  Corner corner(Vec2 at) {
    const auto [entry, fresh] = corners_.try_emplace({at.x, at.y});
    if (!fresh) return entry->second;
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && at.x >= starts_[i + 1]) ++i;
    const PathPiece& piece = pieces_[i];
    Vec2 point = piece.from;
    Vec2 tangent = start_tangent(piece);
    double mitre = mitres_[i];
    if (at.x >= starts_[i + 1]) {
      point = piece.to;
      tangent = end_tangent(piece);
      mitre = -mitres_[i + 1];
    } else if (at.x > starts_[i]) {
      const double share = (at.x - starts_[i]) / (starts_[i + 1] - starts_[i]);
      point = point_on(piece, share);
      if (!piece.straight()) {
        const CircularArc arc = arc_of(piece);
        const Vec2 spoke = (1.0 / norm(point - arc.centre)) * (point - arc.centre);
        point = arc.centre + arc.radius * spoke;
        tangent = (piece.bulge > 0.0 ? 1.0 : -1.0) * Vec2{-spoke.y, spoke.x};
      }
    }
    const Vec2 left =
        Vec2{-tangent.y, tangent.x} + (at.x > starts_[i] && at.x < starts_[i + 1] ? 0.0 : mitre) * tangent;
    const auto vertex = [&](bool upper) {
      const Vec2 place = sheet_place(sheet_, at.y, upper);
      return add_vertex(brep_, at_height(point + place.x * left, place.y));
    };
    entry->second.at = at;
    entry->second.upper = vertex(true);
    entry->second.lower = vertex(false);
    return entry->second;
  }

  /// The edge between two vertices, made once.
  BrepUse edge(std::size_t from, std::size_t to, std::size_t piece, bool along) {
    const auto key = std::pair(std::min(from, to), std::max(from, to));
    const auto known = edges_.find(key);
    if (known != edges_.end()) return {known->second, brep_.edges[known->second].from == from};
    std::size_t made = 0;
    if (!along || pieces_[piece].straight()) {
      made = add_line(brep_, from, to);
    } else {
      // Arcs run as the path does.
      const CircularArc arc = arc_of(pieces_[piece]);
      const Vec3 a = brep_.vertices[from];
      const Vec3 b = brep_.vertices[to];
      const Vec2 one = Vec2{a.x, a.y} - arc.centre;
      const Vec2 other = Vec2{b.x, b.y} - arc.centre;
      made = add_arc(brep_, from, to, arc.centre, cross(one, other) > 0.0);
    }
    edges_.emplace(key, made);
    return {made, true};
  }

  /// A side between the faces, the material to the left of its edge in the sheet.
  void add_side(const Corner& from, const Corner& to, std::size_t piece) {
    const bool along = from.at.x != to.at.x;
    const BrepUse above = edge(from.upper, to.upper, piece, along);
    const BrepUse below = edge(from.lower, to.lower, piece, along);
    const BrepUse first = edge(from.upper, from.lower, piece, false);
    const BrepUse second = edge(to.upper, to.lower, piece, false);
    BrepFace face;
    if (along) {
      const bool ahead = to.at.x > from.at.x;
      // Around the section counter-clockwise: up at its right edges, down at its left ones.
      if (pieces_[piece].straight()) {
        face = flat_face(brep_, from.upper, from.lower, to.upper);
      } else {
        face = round_face(pieces_[piece], sheet_place(sheet_, from.at.y, !ahead),
                          sheet_place(sheet_, from.at.y, ahead));
      }
    } else {
      const Vec2 tangent =
          tangent_at(pieces_[piece], (from.at.x - starts_[piece]) / (starts_[piece + 1] - starts_[piece]));
      // Square to the path, or in the plane that halves a bend at its end.
      const double mitre = from.at.x == starts_[piece]       ? mitres_[piece]
                           : from.at.x == starts_[piece + 1] ? -mitres_[piece + 1]
                                                             : 0.0;
      const Vec2 square = (1.0 / math::hypot(1.0, mitre)) * (tangent - mitre * Vec2{-tangent.y, tangent.x});
      face.origin = brep_.vertices[from.upper];
      face.axis = (to.at.y > from.at.y ? 1.0 : -1.0) * at_height(mitre == 0.0 ? tangent : square, 0.0);
      face.reference = kUp;
    }
    face.loops = {{above, second, {below.edge, !below.forward}, {first.edge, !first.forward}}};
    brep_.faces.push_back(std::move(face));
  }

  /// A loop of one piece, the material on its left in the sheet.
  void add_loop(std::size_t piece, const std::vector<Corner>& corners) {
    std::vector<BrepUse> upper;
    std::vector<BrepUse> lower;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Corner& from = corners[k];
      const Corner& to = corners[(k + 1) % corners.size()];
      const bool along = from.at.x != to.at.x;
      const BrepUse above = edge(from.upper, to.upper, piece, along);
      upper.push_back({above.edge, !above.forward});
      lower.push_back(edge(from.lower, to.lower, piece, along));
    }
    std::reverse(upper.begin(), upper.end());
    upper_[piece].push_back(std::move(upper));
    lower_[piece].push_back(std::move(lower));
  }

  void add_outline(const std::vector<Vec2>& outline) {
    std::vector<Corner> all;
    for (const Vec2 at : outline) all.push_back(corner(at));
    std::vector<std::vector<Corner>> loops(pieces_.size());
    // Each piece gets its stretches of the outline in their order; joints close the loop between them.
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Corner& from = all[k];
      const Corner& to = all[(k + 1) % all.size()];
      const std::size_t piece = piece_of(from.at, to.at);
      add_side(from, to, piece);
      std::vector<Corner>& loop = loops[piece];
      if (loop.empty() || !(loop.back().at == from.at)) loop.push_back(from);
      loop.push_back(to);
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (loops[i].empty()) throw bad_body(part_, "its sheet does not cover its path");
      if (loops[i].front().at == loops[i].back().at) loops[i].pop_back();
      add_loop(i, loops[i]);
    }
  }

  /// Where cutouts lie across joints: their edges, the outline's and, where a joint crosses the sheet, edges along it both ways, chained piece by
  /// piece. A piece may fall into several loops.
  void add_cut_outline(const std::vector<Vec2>& outline, const std::vector<std::vector<Vec2>>& cutouts) {
    struct Way {
      Corner from;
      Corner to;
    };
    std::vector<std::vector<Way>> ways(pieces_.size());
    std::vector<const std::vector<Vec2>*> loops = {&outline};
    for (const std::vector<Vec2>& cutout : cutouts) loops.push_back(&cutout);
    std::vector<std::vector<double>> crossed(starts_.size());
    for (const std::vector<Vec2>* const loop : loops) {
      for (std::size_t k = 0; k < loop->size(); ++k) {
        const Corner from = corner((*loop)[k]);
        const Corner to = corner((*loop)[(k + 1) % loop->size()]);
        const std::size_t piece = piece_of(from.at, to.at);
        add_side(from, to, piece);
        ways[piece].push_back({from, to});
        for (std::size_t j = 1; j + 1 < starts_.size(); ++j) {
          if (from.at.x == starts_[j]) crossed[j].push_back(from.at.y);
        }
      }
    }
    for (std::size_t j = 1; j + 1 < starts_.size(); ++j) {
      std::vector<double>& edges = crossed[j];
      std::sort(edges.begin(), edges.end());
      for (std::size_t k = 0; k + 1 < edges.size(); k += 2) {
        const Corner low = corner({starts_[j], edges[k]});
        const Corner high = corner({starts_[j], edges[k + 1]});
        ways[j - 1].push_back({low, high});
        ways[j].push_back({high, low});
      }
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      std::vector<Way>& left = ways[i];
      if (left.empty()) throw bad_body(part_, "its sheet does not cover its path");
      while (!left.empty()) {
        std::vector<Corner> loop = {left.front().from};
        Vec2 end = left.front().to.at;
        left.erase(left.begin());
        while (!(end == loop.front().at)) {
          const auto next =
              std::find_if(left.begin(), left.end(), [&](const Way& way) { return way.from.at == end; });
          if (next == left.end())
            throw bad_body(part_, "its sheet is not closed between two joints of its path");
          loop.push_back(next->from);
          end = next->to.at;
          left.erase(next);
        }
        add_loop(i, loop);
      }
    }
  }

  void add_cutout(const ArcPath& cutout) {
    std::vector<Corner> all;
    for (const PathVertex& vertex : cutout.vertices) all.push_back(corner(vertex.at));
    const std::size_t piece = piece_of(all.front().at, all.front().at);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Corner& to = all[(k + 1) % all.size()];
      if (piece_of(to.at, to.at) != piece) throw bad_body(part_, "a cutout lies across a joint of its path");
      add_side(all[k], to, piece);
    }
    add_loop(piece, all);
  }

  /// Whether a loop of a face runs counter-clockwise as seen from outside: one that is no hole.
  [[nodiscard]] bool is_outer(const std::vector<BrepUse>& loop, Vec3 axis) const {
    Vec3 twice;
    const auto start = [&](const BrepUse& use) {
      const BrepEdge& edge = brep_.edges[use.edge];
      return brep_.vertices[use.forward ? edge.from : edge.to];
    };
    for (std::size_t k = 0; k < loop.size(); ++k)
      twice =
          twice + cross(start(loop[k]) - start(loop[0]), start(loop[(k + 1) % loop.size()]) - start(loop[0]));
    return loop.size() > 1 && dot(twice, axis) > 0.0;
  }

  /// One face, or one for each of the stretches into which cutouts part a piece.
  void add_sheet_faces(std::size_t i, bool top) {
    std::vector<std::vector<BrepUse>> loops = std::move(top ? upper_[i] : lower_[i]);
    BrepFace made = sheet_face(i, top);
    if (loops.size() < 2 || !pieces_[i].straight() || !is_outer(loops[1], made.axis)) {
      made.loops = std::move(loops);
      brep_.faces.push_back(std::move(made));
      return;
    }
    std::vector<BrepFace> faces;
    for (const std::vector<BrepUse>& loop : loops) {
      if (!is_outer(loop, made.axis)) continue;
      faces.push_back(made);
      faces.back().loops = {loop};
    }
    for (const std::vector<BrepUse>& loop : loops) {
      if (!is_outer(loop, made.axis))
        face_round(faces, brep_.vertices[brep_.edges[loop[0].edge].from]).loops.push_back(loop);
    }
    for (BrepFace& face : faces) brep_.faces.push_back(std::move(face));
  }

  /// The flat face in which a place lies, of stretches side by side.
  BrepFace& face_round(std::vector<BrepFace>& faces, Vec3 place) const {
    const auto has = [&](const BrepFace& face) {
      const Vec3 aside = cross(face.axis, face.reference);
      const auto flat = [&](Vec3 at) { return Vec2{dot(at, face.reference), dot(at, aside)}; };
      ArcPath outline{{}, true};
      for (const BrepUse& use : face.loops[0]) {
        const BrepEdge& edge = brep_.edges[use.edge];
        outline.vertices.push_back({flat(brep_.vertices[use.forward ? edge.from : edge.to]), 0.0});
      }
      return contains(outline, flat(place));
    };
    const auto found = std::find_if(faces.begin(), faces.end(), has);
    if (found == faces.end()) throw bad_body(part_, "a hole lies beyond its sheet");
    return *found;
  }

  [[nodiscard]] BrepFace sheet_face(std::size_t i, bool top) {
    const Vec2 from = sheet_place(sheet_, 0.0, true);
    const Vec2 low = top ? from : from + sheet_.thickness * Vec2{-sheet_.across.y, sheet_.across.x};
    const Vec2 way = (top ? 1.0 : -1.0) * sheet_.across;
    if (!pieces_[i].straight()) return round_face(pieces_[i], low, low + way);
    const Vec2 tangent = start_tangent(pieces_[i]);
    const Vec2 left{-tangent.y, tangent.x};
    BrepFace face;
    face.origin = at_height(pieces_[i].from + low.x * left, low.y);
    face.reference = at_height(tangent, 0.0);
    face.axis = cross(at_height(way.x * left, way.y), face.reference);
    return face;
  }

  const ShopPart& part_;
  std::vector<PathPiece> pieces_;
  RolledSheet sheet_;  ///< in millimetres
  std::vector<double> mitres_;
  PlaneRegion region_;
  std::vector<double> starts_;
  Brep brep_;
  std::map<std::pair<double, double>, Corner> corners_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges_;
  std::vector<std::vector<std::vector<BrepUse>>> upper_;
  std::vector<std::vector<std::vector<BrepUse>>> lower_;
};

}  // namespace

Brep brep_of_sheet(const RolledSheet& sheet, const ShopPart& part) {
  return SheetFaces(sheet, part).whole();
}

}  // namespace glissade::parts
