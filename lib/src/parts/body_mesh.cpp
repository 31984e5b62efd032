#include "parts/body_mesh.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "parts/body_places.hpp"
#include "parts/bores.hpp"
#include "parts/tube_windows.hpp"
#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

using Index = std::uint32_t;

struct Fineness {
  double sagitta;
  int round_corners;
};

Index count_of(const TriangleMesh& mesh) {
  return static_cast<Index>(mesh.vertices.size());
}

void add_quad(TriangleMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

int chords_of(double sweep, double radius, const Fineness& fineness) {
  const double cosine = std::clamp(1.0 - fineness.sagitta / radius, -1.0, 1.0);
  const double widest = std::min(2.0 * math::acos(cosine), kTurn / fineness.round_corners);
  return std::max(1, static_cast<int>(std::ceil(std::fabs(sweep) / widest - 1e-9)));
}

int chords_of(const PathPiece& piece, const Fineness& fineness) {
  if (piece.straight()) return 1;
  const CircularArc arc = arc_of(piece);
  return chords_of(arc.sweep, arc.radius, fineness);
}

// --- prisms

/// Corners of a closed path; of a circle as two half circles.
std::vector<Vec2> corners_of(const ArcPath& path, const Fineness& fineness) {
  std::vector<Vec2> corners;
  for (const PathPiece& piece : pieces_of(path)) {
    const int chords = chords_of(piece, fineness);
    corners.push_back(piece.from);
    for (int i = 1; i < chords; ++i) corners.push_back(point_on(piece, static_cast<double>(i) / chords));
  }
  return corners;
}

void run(std::vector<Vec2>& loop, bool counter_clockwise) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  if ((twice > 0.0) != counter_clockwise) std::reverse(loop.begin(), loop.end());
}

std::vector<std::vector<Vec2>> loops_of(const PlaneRegion& region, const Fineness& fineness) {
  std::vector<std::vector<Vec2>> loops{corners_of(region.outline, fineness)};
  for (const ArcPath& cutout : region.cutouts) loops.push_back(corners_of(cutout, fineness));
  for (const Circle& hole : region.holes) loops.push_back(corners_of(path_of(hole), fineness));
  for (std::size_t i = 0; i < loops.size(); ++i) run(loops[i], i == 0);
  return loops;
}

TriangleMesh prism_of(const Prism& prism, const Fineness& fineness) {
  const std::vector<std::vector<Vec2>> loops = loops_of(prism.region, fineness);
  const std::vector<std::array<Index, 3>> faces = solid::triangulate_loops(loops);
  TriangleMesh mesh;
  for (const double z : {0.0, prism.depth}) {
    for (const std::vector<Vec2>& loop : loops) {
      for (const Vec2 corner : loop) mesh.vertices.push_back({corner.x, corner.y, z});
    }
  }
  const Index above = count_of(mesh) / 2;
  for (const auto& [a, b, c] : faces) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({above + a, above + b, above + c});
  }
  Index first = 0;
  for (const std::vector<Vec2>& loop : loops) {
    const auto size = static_cast<Index>(loop.size());
    for (Index i = 0; i < size; ++i) {
      const Index a = first + i;
      const Index b = first + (i + 1) % size;
      add_quad(mesh, a, b, above + b, above + a);
    }
    first += size;
  }
  return mesh;
}

/// @param make  of a fineness; again with more chords where those of two arcs beside each other cross
template <typename Make>
TriangleMesh with_enough_chords(Make make, Fineness fineness) {
  constexpr int kTries = 16;
  for (int i = 1; i < kTries; ++i) {
    try {
      return make(fineness);
    } catch (const InternalError&) {
      fineness.sagitta /= 4.0;
      fineness.round_corners *= 2;
    }
  }
  return make(fineness);
}

TriangleMesh mesh_of(const Prism& prism, const Fineness& fineness) {
  return with_enough_chords([&](const Fineness& fine) { return prism_of(prism, fine); }, fineness);
}

// --- angles

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

TriangleMesh mesh_of(const AngleBar& bar, const Fineness& fineness) {
  return with_enough_chords([&](const Fineness& fine) { return AngleMesh(bar, fine).whole(); }, fineness);
}

// --- holes through curved plates

/// Places along a path at which chords end, those about holes moved to both sides of them: a hole lies between two chords.
class ChordEnds {
 public:
  ChordEnds(const std::vector<PathPiece>& pieces, double reach, const Fineness& fineness) {
    starts_ = {0.0};
    for (const PathPiece& piece : pieces) {
      int chords = 1;
      if (!piece.straight()) {
        const CircularArc arc = arc_of(piece);
        chords = chords_of(arc.sweep, arc.radius + reach, fineness);
      }
      const double whole = length(piece);
      for (int k = 0; k < chords; ++k) places_.push_back(starts_.back() + whole * k / chords);
      starts_.push_back(starts_.back() + whole);
    }
    places_.push_back(starts_.back());
  }

  void leave_out(const std::vector<Circle>& holes, const std::vector<Bore>& bores) {
    if (holes.empty()) return;
    std::vector<std::array<double, 2>> spans;
    for (std::size_t i = 0; i < holes.size(); ++i) {
      const Bore& bore = bores[i];
      // Nearer to the axis of an arc than the path is, a hole takes more of it.
      const double least = std::min(bore.from_axis, bore.from_axis + bore.depth * bore.grows_into) -
                           bore.radius * std::fabs(bore.grows_across);
      const double stretch = bore.from_axis == 0.0 ? 1.0 : bore.path_radius / least;
      constexpr double kWider = 1.02;  // than the hole
      const double half = kWider * stretch * bore.radius;
      spans.push_back({holes[i].centre.x - half, holes[i].centre.x + half});
    }
    std::sort(spans.begin(), spans.end());
    std::vector<std::array<double, 2>> apart;
    for (const auto& span : spans) {
      if (!apart.empty() && span[0] <= apart.back()[1])
        apart.back()[1] = std::max(apart.back()[1], span[1]);
      else
        apart.push_back(span);
    }
    for (const auto& span : apart) {
      std::erase_if(places_, [&](double place) {
        const bool joint = std::find(starts_.begin(), starts_.end(), place) != starts_.end();
        return !joint && place > span[0] && place < span[1];
      });
      places_.insert(places_.end(), span.begin(), span.end());
    }
    std::sort(places_.begin(), places_.end());
  }

  [[nodiscard]] const std::vector<double>& starts() const { return starts_; }
  [[nodiscard]] const std::vector<double>& places() const { return places_; }

 private:
  std::vector<double> starts_;  ///< of pieces, and the end
  std::vector<double> places_;
};

/// A flat four-cornered face with round holes, its plane being that of three of its corners.
class DrilledFace {
 public:
  /// @param quad  counter-clockwise seen from outside
  DrilledFace(TriangleMesh& mesh, const std::array<Index, 4>& quad) : mesh_(mesh), quad_(quad) {
    const Vec3 corner = mesh.vertices[quad[0]];
    const Vec3 way = mesh.vertices[quad[1]] - corner;
    const Vec3 normal = cross(way, mesh.vertices[quad[3]] - corner);
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
      const double off = dot(mesh_.vertices[quad_[0]] - at, out_) / dot(bore.into, out_);
      mesh_.vertices.push_back(at + off * bore.into);
    }
    holes_.push_back({first, first + static_cast<Index>(corners)});
    return first;
  }

  void fill() {
    std::vector<std::vector<Vec2>> loops(1);
    std::vector<Index> indices(quad_.begin(), quad_.end());
    for (const auto& [first, end] : holes_) {
      loops.emplace_back();
      for (Index k = first; k < end; ++k) indices.push_back(k);
    }
    const auto flat = [&](Index k) {
      const Vec3 at = mesh_.vertices[k] - mesh_.vertices[quad_[0]];
      return Vec2{dot(at, right_), dot(at, up_)};
    };
    for (const Index k : quad_) loops[0].push_back(flat(k));
    for (std::size_t i = 0; i < holes_.size(); ++i) {
      for (Index k = holes_[i][0]; k < holes_[i][1]; ++k) loops[i + 1].push_back(flat(k));
    }
    for (const auto& [a, b, c] : solid::triangulate_loops(loops))
      mesh_.triangles.push_back({indices[a], indices[b], indices[c]});
  }

 private:
  TriangleMesh& mesh_;
  std::array<Index, 4> quad_;
  Vec3 right_;
  Vec3 up_;
  Vec3 out_;
  std::vector<std::array<Index, 2>> holes_;
};

/// Both faces of a plate between two chords with the holes between them, and the walls of the holes.
void add_drilled(TriangleMesh& mesh, const std::array<Index, 4>& face, const std::array<Index, 4>& back,
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

// --- sections along a path

struct PathFrame {
  Vec2 at;
  Vec2 left;
  std::size_t piece = 0;
  double share = 0.0;  ///< of the piece
};

PathFrame frame_on(const PathPiece& piece, double share) {
  const Vec2 chord = piece.to - piece.from;
  const auto [sine, cosine] = math::sine_cosine(4.0 * math::atan(piece.bulge) * (share - 0.5));
  const Vec2 along =
      (1.0 / norm(chord)) * Vec2{cosine * chord.x - sine * chord.y, sine * chord.x + cosine * chord.y};
  return {point_on(piece, share), {-along.y, along.x}, 0, share};
}

std::vector<PathFrame> frames_along(const ArcPath& path, const ChordEnds& ends) {
  std::vector<PathFrame> frames;
  const std::vector<PathPiece> pieces = pieces_of(path);
  const std::vector<double>& starts = ends.starts();
  std::size_t p = 0;
  for (const double place : ends.places()) {
    // A joint belongs to the piece before it.
    while (p + 1 < pieces.size() && place > starts[p + 1]) ++p;
    const double share = std::clamp((place - starts[p]) / (starts[p + 1] - starts[p]), 0.0, 1.0);
    frames.push_back(frame_on(pieces[p], place == starts[p + 1] ? 1.0 : share));
    frames.back().piece = p;
  }
  return frames;
}

/// The holes whose middles lie between two places along a path, and between two across.
std::vector<const Bore*> between(const std::vector<Circle>& holes, const std::vector<Bore>& bores,
                                 double from, double to, Vec2 rows = {-1e300, 1e300}) {
  std::vector<const Bore*> found;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const Vec2 at = holes[i].centre;
    if (at.x > from && at.x < to && at.y > rows.x && at.y < rows.y) found.push_back(&bores[i]);
  }
  return found;
}

TriangleMesh mesh_of(const SweptBody& body, const Fineness& fineness) {
  std::vector<Vec2> section = body.section;
  run(section, true);
  const bool turned = section != body.section;
  double reach = 0.0;
  for (const Vec2 corner : section) reach = std::max(reach, std::fabs(corner.x));
  TriangleMesh mesh;
  ChordEnds ends(pieces_of(body.path), reach, fineness);
  const std::vector<Bore> bores = bores_of(body);
  ends.leave_out(body.holes, bores);
  const std::vector<PathFrame> frames = frames_along(body.path, ends);
  for (const PathFrame& frame : frames) {
    for (std::size_t j = 0; j < section.size(); ++j) {
      const Vec2 corner = section[j];
      const Vec2 at = frame.at + corner.x * frame.left;
      const std::size_t own = turned ? section.size() - 1 - j : j;
      const double shift = body.shifts.empty() ? 0.0
                                               : (1.0 - frame.share) * body.shifts[frame.piece][own] +
                                                     frame.share * body.shifts[frame.piece + 1][own];
      mesh.vertices.push_back({at.x, at.y, corner.y + shift});
    }
  }
  const auto size = static_cast<Index>(section.size());
  const Index last = count_of(mesh) - size;
  for (Index ring = 0; ring + 1 < frames.size(); ++ring) {
    const auto quad = [&](Index i) {
      const Index a = ring * size + i;
      const Index b = ring * size + (i + 1) % size;
      return std::array<Index, 4>{a, b, b + size, a + size};
    };
    const std::vector<const Bore*> holes =
        between(body.holes, bores, ends.places()[ring], ends.places()[ring + 1]);
    for (Index i = 0; i < size; ++i) {
      if (!holes.empty() && i % 2 == 0) continue;
      const auto [a, b, c, d] = quad(i);
      add_quad(mesh, a, b, c, d);
    }
    if (!holes.empty()) add_drilled(mesh, quad(0), quad(2), holes, fineness);
  }
  for (const auto& [a, b, c] : solid::triangulate_loops({section})) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({last + a, last + b, last + c});
  }
  return mesh;
}

// --- tubes

TriangleMesh whole_tube(const TubeGore& gore, const Fineness& fineness) {
  const double outer = gore.inner_radius + gore.thickness;
  const auto corners = static_cast<Index>(std::max(chords_of(kTurn, outer, fineness), 3));
  TriangleMesh mesh;
  const auto add_ring = [&](double radius, double height, Angle tilt) {
    const double rise = math::tan(tilt.radians());
    for (Index i = 0; i < corners; ++i) {
      const auto [sine, cosine] = math::sine_cosine(kTurn * i / corners);
      const double x = radius * cosine;
      mesh.vertices.push_back({x, radius * sine, height + rise * x});
    }
  };
  add_ring(outer, 0.0, gore.start_tilt);
  add_ring(gore.inner_radius, 0.0, gore.start_tilt);
  add_ring(outer, gore.length, gore.end_tilt);
  add_ring(gore.inner_radius, gore.length, gore.end_tilt);
  for (Index i = 0; i < corners; ++i) {
    const Index next = (i + 1) % corners;
    const auto at = [corners](Index ring, Index corner) { return ring * corners + corner; };
    add_quad(mesh, at(0, i), at(0, next), at(2, next), at(2, i));
    add_quad(mesh, at(1, next), at(1, i), at(3, i), at(3, next));
    add_quad(mesh, at(0, next), at(0, i), at(1, i), at(1, next));
    add_quad(mesh, at(2, i), at(2, next), at(3, next), at(3, i));
  }
  return mesh;
}

/// A tube with windows and holes on a grid of angles and of places along its axis, the first and last of which lie on its end planes.
class TubeMesh {
 public:
  TubeMesh(const TubeGore& gore, const Fineness& fineness)
      : gore_(gore), fineness_(fineness), bores_(bores_of(gore)) {
    const int corners = std::max(chords_of(kTurn, gore.inner_radius + gore.thickness, fineness), 3);
    for (int k = 0; k < corners; ++k) angles_.push_back(kTurn * k / corners);
    rows_ = {0.0, gore.length};
    for (const TubeHole& hole : gore.holes) leave_out(hole);
    for (const TubeWindow& window : gore.windows) {
      for (const Angle edge : {window.low, window.high}) angles_.push_back(in_turn(edge.radians()));
      rows_.insert(rows_.end(), {window.from, window.to});
    }
    sort_apart(angles_);
    sort_apart(rows_);
  }

  TriangleMesh whole() {
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      for (std::size_t j = 0; j + 1 < rows_.size(); ++j) {
        if (filled(i, j)) add_cell(i, j);
      }
    }
    return std::move(mesh_);
  }

 private:
  using Place = std::array<std::size_t, 2>;  ///< angle, row

  static double in_turn(double angle) { return angle - kTurn * std::floor(angle / kTurn); }

  static void sort_apart(std::vector<double>& values) {
    constexpr double kSame = 1e-9;
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end(), [](double a, double b) { return b - a < kSame; }),
                 values.end());
  }

  /// A hole lies between two angles and two rows of the grid.
  void leave_out(const TubeHole& hole) {
    constexpr double kWider = 1.02;  // than the hole
    const double middle = in_turn(hole.about.radians());
    const double half = kWider * math::asin(hole.radius / gore_.inner_radius);
    const auto away = [&](double angle) {
      const double off = in_turn(angle - middle);
      return std::min(off, kTurn - off);
    };
    std::erase_if(angles_, [&](double angle) { return away(angle) < half; });
    angles_.insert(angles_.end(), {in_turn(middle - half), in_turn(middle + half)});
    rows_.insert(rows_.end(), {hole.along - kWider * hole.radius, hole.along + kWider * hole.radius});
  }

  [[nodiscard]] double next_angle(std::size_t i) const {
    return i + 1 < angles_.size() ? angles_[i + 1] : angles_.front() + kTurn;
  }

  [[nodiscard]] bool filled(std::size_t i, std::size_t j) const {
    const auto [sine, cosine] = math::sine_cosine(0.5 * (angles_[i] + next_angle(i)));
    const Vec3 middle{gore_.inner_radius * cosine, gore_.inner_radius * sine,
                      0.5 * (rows_[j] + rows_[j + 1])};
    return std::none_of(gore_.windows.begin(), gore_.windows.end(),
                        [&](const TubeWindow& window) { return beside(window, middle) < 0.0; });
  }

  Index vertex(const Place& place, bool outer) {
    const auto [i, j] = place;
    const auto [entry, fresh] = vertices_.try_emplace({i, j, outer ? 1U : 0U}, count_of(mesh_));
    if (fresh) {
      const auto [sine, cosine] = math::sine_cosine(angles_[i]);
      const double radius = gore_.inner_radius + (outer ? gore_.thickness : 0.0);
      const double x = radius * cosine;
      double z = rows_[j];
      if (j == 0) z = x * math::tan(gore_.start_tilt.radians());
      if (j + 1 == rows_.size()) z = gore_.length + x * math::tan(gore_.end_tilt.radians());
      mesh_.vertices.push_back({x, radius * sine, z});
    }
    return entry->second;
  }

  void add_cell(std::size_t i, std::size_t j) {
    const std::size_t next = (i + 1) % angles_.size();
    const std::size_t before = (i + angles_.size() - 1) % angles_.size();
    const std::array<Place, 4> corner = {Place{i, j}, {next, j}, {next, j + 1}, {i, j + 1}};
    std::array<Index, 4> outer{};
    std::array<Index, 4> inner{};
    for (std::size_t k = 0; k < 4; ++k) {
      outer[k] = vertex(corner[k], true);
      inner[k] = vertex(corner[3 - k], false);
    }
    const std::vector<const Bore*> holes = holes_in(i, j);
    if (holes.empty()) {
      add_quad(mesh_, outer[0], outer[1], outer[2], outer[3]);
      add_quad(mesh_, inner[0], inner[1], inner[2], inner[3]);
    } else {
      add_drilled(mesh_, inner, outer, holes, fineness_);
    }
    const std::array<bool, 4> edge = {j == 0 || !filled(i, j - 1), !filled(next, j),
                                      j + 2 == rows_.size() || !filled(i, j + 1), !filled(before, j)};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!edge[k]) continue;
      const Place& to = corner[(k + 1) % 4];
      add_quad(mesh_, vertex(to, true), vertex(corner[k], true), vertex(corner[k], false), vertex(to, false));
    }
  }

  [[nodiscard]] std::vector<const Bore*> holes_in(std::size_t i, std::size_t j) const {
    std::vector<const Bore*> found;
    for (std::size_t k = 0; k < gore_.holes.size(); ++k) {
      const TubeHole& hole = gore_.holes[k];
      const double off = in_turn(hole.about.radians() - angles_[i]);
      if (off < next_angle(i) - angles_[i] && hole.along > rows_[j] && hole.along < rows_[j + 1])
        found.push_back(&bores_[k]);
    }
    return found;
  }

  const TubeGore& gore_;
  Fineness fineness_;
  std::vector<Bore> bores_;
  std::vector<double> angles_;
  std::vector<double> rows_;
  TriangleMesh mesh_;
  std::map<std::array<std::size_t, 3>, Index> vertices_;
};

TriangleMesh mesh_of(const TubeGore& gore, const Fineness& fineness) {
  if (gore.windows.empty() && gore.holes.empty()) return whole_tube(gore, fineness);
  return TubeMesh(gore, fineness).whole();
}

/// The section of a trough, counter-clockwise seen against its axis.
std::vector<Vec2> trough_section(const TroughGore& gore, const Fineness& fineness) {
  const double outer = gore.inner_radius + gore.thickness;
  const int chords = std::max(2, chords_of(0.5 * kTurn, outer, fineness));
  std::vector<Vec2> section;
  const auto add_round = [&](double radius, bool from_left) {
    if (from_left && gore.side > 0.0) section.push_back({gore.side, radius});
    for (int k = 0; k <= chords; ++k) {
      const auto [sine, cosine] = math::sine_cosine(0.5 * kTurn * k / chords);
      section.push_back({-radius * sine, (from_left ? radius : -radius) * cosine});
    }
    section.push_back({gore.side, from_left ? -radius : radius});
    if (gore.side == 0.0) section.pop_back();
  };
  add_round(outer, true);
  if (gore.side > 0.0) section.push_back({gore.side, -gore.inner_radius});
  add_round(gore.inner_radius, false);
  return section;
}

TriangleMesh mesh_of(const TroughGore& gore, const Fineness& fineness) {
  const std::vector<Vec2> section = trough_section(gore, fineness);
  TriangleMesh mesh;
  for (const bool top : {false, true}) {
    const double rise = math::tan((top ? gore.end_tilt : gore.start_tilt).radians());
    for (const Vec2 corner : section)
      mesh.vertices.push_back({corner.x, corner.y, (top ? gore.length : 0.0) + rise * corner.x});
  }
  const auto size = static_cast<Index>(section.size());
  for (Index i = 0; i < size; ++i) {
    const Index next = (i + 1) % size;
    add_quad(mesh, i, next, size + next, size + i);
  }
  for (const auto& [a, b, c] : solid::triangulate_loops({section})) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({size + a, size + b, size + c});
  }
  return mesh;
}

// --- sheets along a path

/// A grid on a sheet: all places along it at which an edge, a joint or a chord ends, and all across; and which of its cells
/// are of the sheet.
struct SheetGrid {
  std::vector<double> along;
  std::vector<double> across;
  std::vector<Vec2> points;  ///< of the path at the places along
  std::vector<Vec2> lefts;

  [[nodiscard]] std::size_t cells() const { return across.size() - 1; }
};

constexpr double kSamePlace = 1e-9;  // along a sheet [m]

void sort_apart(std::vector<double>& places) {
  std::sort(places.begin(), places.end());
  std::vector<double> apart;
  for (const double place : places) {
    if (apart.empty() || place - apart.back() > kSamePlace) apart.push_back(place);
  }
  places = std::move(apart);
}

SheetGrid grid_of(const RolledSheet& sheet, const Fineness& fineness) {
  SheetGrid grid;
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  double reach = 0.0;
  for (const PathVertex& vertex : sheet.region.outline.vertices) {
    for (const bool upper : {true, false})
      reach = std::max(reach, std::fabs(sheet_place(sheet, vertex.at.y, upper).x));
  }
  ChordEnds ends(pieces, reach, fineness);
  ends.leave_out(sheet.region.holes, bores_of(sheet));
  const std::vector<double>& starts = ends.starts();
  grid.along = ends.places();
  for (std::size_t l = 0; l <= sheet.region.cutouts.size(); ++l) {
    const ArcPath& loop = l == 0 ? sheet.region.outline : sheet.region.cutouts[l - 1];
    for (const PathVertex& vertex : loop.vertices) {
      grid.along.push_back(std::clamp(vertex.at.x, 0.0, starts.back()));
      grid.across.push_back(vertex.at.y);
    }
  }
  sort_apart(grid.along);
  sort_apart(grid.across);
  const std::vector<double> mitres = mitres_of(sheet);
  for (const double x : grid.along) {
    std::size_t i = 0;
    while (i + 1 < pieces.size() && x > starts[i + 1]) ++i;
    const PathFrame frame = frame_on(pieces[i], std::clamp((x - starts[i]) / length(pieces[i]), 0.0, 1.0));
    grid.points.push_back(frame.at);
    grid.lefts.push_back(frame.left);
    const Vec2 along{frame.left.y, -frame.left.x};
    for (const std::size_t joint : {i, i + 1}) {
      if (mitres[joint] == 0.0 || std::fabs(x - starts[joint]) >= kSamePlace) continue;
      grid.lefts.back() = frame.left + (joint == i ? 1.0 : -1.0) * mitres[joint] * along;
    }
  }
  return grid;
}

class SheetMesh {
 public:
  SheetMesh(const RolledSheet& sheet, const Fineness& fineness)
      : sheet_(sheet), fineness_(fineness), grid_(grid_of(sheet, fineness)), bores_(bores_of(sheet)) {}

  TriangleMesh whole() {
    for (std::size_t i = 0; i + 1 < grid_.along.size(); ++i) {
      for (std::size_t j = 0; j < grid_.cells(); ++j) {
        if (filled(i, j)) add_cell(i, j);
      }
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] bool filled(std::size_t i, std::size_t j) const {
    if (i + 1 >= grid_.along.size() || j >= grid_.cells()) return false;
    const Vec2 middle{0.5 * (grid_.along[i] + grid_.along[i + 1]),
                      0.5 * (grid_.across[j] + grid_.across[j + 1])};
    if (!contains(sheet_.region.outline, middle)) return false;
    return std::none_of(sheet_.region.cutouts.begin(), sheet_.region.cutouts.end(),
                        [&](const ArcPath& cutout) { return contains(cutout, middle); });
  }

  Index vertex(std::size_t i, std::size_t j, bool upper) {
    const auto [entry, fresh] = vertices_.try_emplace({i, j, upper ? 1U : 0U}, count_of(mesh_));
    if (fresh) {
      const Vec2 place = sheet_place(sheet_, grid_.across[j], upper);
      const Vec2 at = grid_.points[i] + place.x * grid_.lefts[i];
      mesh_.vertices.push_back({at.x, at.y, place.y});
    }
    return entry->second;
  }

  /// A side below an edge of the upper face that has the sheet on its left, seen from below.
  void add_side(std::size_t i, std::size_t j, std::size_t to_i, std::size_t to_j) {
    add_quad(mesh_, vertex(i, j, true), vertex(to_i, to_j, true), vertex(to_i, to_j, false),
             vertex(i, j, false));
  }

  void add_cell(std::size_t i, std::size_t j) {
    const std::array<Index, 4> lower = {vertex(i, j, false), vertex(i + 1, j, false),
                                        vertex(i + 1, j + 1, false), vertex(i, j + 1, false)};
    const std::array<Index, 4> upper = {vertex(i, j + 1, true), vertex(i + 1, j + 1, true),
                                        vertex(i + 1, j, true), vertex(i, j, true)};
    const std::vector<const Bore*> holes =
        between(sheet_.region.holes, bores_, grid_.along[i], grid_.along[i + 1],
                {grid_.across[j], grid_.across[j + 1]});
    if (holes.empty()) {
      add_quad(mesh_, lower[0], lower[1], lower[2], lower[3]);
      add_quad(mesh_, upper[0], upper[1], upper[2], upper[3]);
    } else {
      add_drilled(mesh_, upper, lower, holes, fineness_);
    }
    if (j == 0 || !filled(i, j - 1)) add_side(i, j, i + 1, j);
    if (!filled(i + 1, j)) add_side(i + 1, j, i + 1, j + 1);
    if (!filled(i, j + 1)) add_side(i + 1, j + 1, i, j + 1);
    if (i == 0 || !filled(i - 1, j)) add_side(i, j + 1, i, j);
  }

  const RolledSheet& sheet_;
  Fineness fineness_;
  SheetGrid grid_;
  std::vector<Bore> bores_;
  TriangleMesh mesh_;
  std::map<std::array<std::size_t, 3>, Index> vertices_;
};

TriangleMesh mesh_of(const RolledSheet& sheet, const Fineness& fineness) {
  return SheetMesh(sheet, fineness).whole();
}

TriangleMesh mesh_of(const FoldedPlate& plate, const Fineness& /*fineness*/) {
  TriangleMesh mesh;
  for (const auto& corners : plate.corners)
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  const Index last = count_of(mesh) - 4;
  for (Index first = 0; first < last; first += 4) {
    for (Index j = 0; j < 4; ++j) {
      const Index next = (j + 1) % 4;
      add_quad(mesh, first + j, first + next, first + 4 + next, first + 4 + j);
    }
  }
  add_quad(mesh, 3, 2, 1, 0);
  add_quad(mesh, last, last + 1, last + 2, last + 3);
  return mesh;
}

TriangleMesh mesh_of(const MeshBody& body, const Fineness& /*fineness*/) {
  return body.mesh;
}

}  // namespace

TriangleMesh facets_of(const PartBody& body, double tolerance, int round_corners) {
  const Fineness fineness{tolerance, round_corners};
  return std::visit([&](const auto& shape) { return mesh_of(shape, fineness); }, body);
}

TriangleMesh coarsened(const TriangleMesh& mesh, double cell) {
  TriangleMesh coarse;
  std::map<std::array<long long, 3>, Index> cells;
  std::vector<Index> kept;
  kept.reserve(mesh.vertices.size());
  const auto on_grid = [cell](double value) { return std::llround(value / cell); };
  for (const Vec3& vertex : mesh.vertices) {
    const auto [at, is_new] =
        cells.try_emplace({on_grid(vertex.x), on_grid(vertex.y), on_grid(vertex.z)}, count_of(coarse));
    if (is_new) coarse.vertices.push_back(vertex);
    kept.push_back(at->second);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (kept[a] == kept[b] || kept[b] == kept[c] || kept[c] == kept[a]) continue;
    coarse.triangles.push_back({kept[a], kept[b], kept[c]});
  }
  return coarse;
}

}  // namespace glissade::parts
