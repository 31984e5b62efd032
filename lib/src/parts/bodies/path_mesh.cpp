#include "parts/bodies/path_mesh.hpp"

#include "parts/bodies/body_places.hpp"
#include "parts/bodies/drilled_faces.hpp"
#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

struct PathFrame {
  Vec2 at;
  Vec2 left;
  std::size_t piece = 0;
  double share = 0.0;  ///< of the piece
};

PathFrame frame_on(const PathPiece& piece, double share) {
  const Vec2 along = tangent_at(piece, share);
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
        if (!filled(i, j)) continue;
        // Cells between which a hole lies are one.
        const std::size_t first = j;
        while (filled(i, j + 1) &&
               is_crossed(sheet_.region.holes, grid_.along[i], grid_.along[i + 1], grid_.across[j + 1]))
          ++j;
        add_faces(i, first, j + 1);
        for (std::size_t k = first; k <= j; ++k) add_sides(i, k);
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

  /// Both faces between two places along, from one place across to another.
  void add_faces(std::size_t i, std::size_t from, std::size_t to) {
    const std::vector<const Bore*> holes =
        between(sheet_.region.holes, bores_, grid_.along[i], grid_.along[i + 1],
                {grid_.across[from], grid_.across[to]});
    if (holes.empty()) {
      for (const bool upper : {false, true}) {
        const Index a = vertex(i, upper ? to : from, upper);
        const Index b = vertex(i + 1, upper ? to : from, upper);
        const Index c = vertex(i + 1, upper ? from : to, upper);
        add_quad(mesh_, a, b, c, vertex(i, upper ? from : to, upper));
      }
      return;
    }
    std::vector<Index> lower;
    std::vector<Index> upper;
    lower.push_back(vertex(i, from, false));
    for (std::size_t j = from; j <= to; ++j) lower.push_back(vertex(i + 1, j, false));
    for (std::size_t j = to; j > from; --j) lower.push_back(vertex(i, j, false));
    upper.push_back(vertex(i, to, true));
    for (std::size_t j = to + 1; j > from; --j) upper.push_back(vertex(i + 1, j - 1, true));
    for (std::size_t j = from; j < to; ++j) upper.push_back(vertex(i, j, true));
    add_drilled(mesh_, upper, lower, holes, fineness_);
  }

  void add_sides(std::size_t i, std::size_t j) {
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

}  // namespace

/// A plate with windows: its section has a corner more on both faces wherever a window begins or ends across, the same share of
/// the way all along.
class WindowedPlate {
 public:
  WindowedPlate(const SweptBody& body, const Fineness& fineness)
      : body_(body),
        fineness_(fineness),
        pieces_(pieces_of(body.path)),
        bores_(bores_of(body)),
        ends_(pieces_, reach_of(body), fineness) {
    ends_.leave_out(body.holes, bores_);
    for (const SweptWindow& window : body.windows) {
      ends_.add(window);
      const BoreLine line = first_edge(body, piece_at(pieces_, window.from).piece);
      rows_.insert(rows_.end(), {window.low, window.high});
      line_ = line;
    }
    std::sort(rows_.begin(), rows_.end());
    constexpr double kSame = 1e-9;  // [m]
    rows_.erase(std::unique(rows_.begin(), rows_.end(), [](double a, double b) { return b - a < kSame; }),
                rows_.end());
  }

  TriangleMesh whole() {
    for (const PathFrame& frame : frames_along(body_.path, ends_)) add_ring(frame);
    const auto rings = static_cast<Index>(ends_.places().size());
    for (Index ring = 0; ring + 1 < rings; ++ring) {
      for (Index i = 0; i <= cuts(); ++i) {
        // Cells between which a hole lies are one.
        const Index first = i;
        while (i < cuts() && !open(ring, i) && !open(ring, i + 1) &&
               is_crossed(body_.holes, ends_.places()[ring], ends_.places()[ring + 1], rows_[i]))
          ++i;
        add_cells(ring, first, i);
      }
      add_edge(ring, cuts() + 1);
      add_edge(ring, size() - 1);
    }
    add_caps(rings - 1);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] static double reach_of(const SweptBody& body) {
    double reach = 0.0;
    for (const Vec2 corner : body.section) reach = std::max(reach, std::fabs(corner.x));
    return reach;
  }
  [[nodiscard]] Index cuts() const { return static_cast<Index>(rows_.size()); }
  [[nodiscard]] Index size() const { return 4 + 2 * cuts(); }
  /// Corners of a face from its first one; of the back in the same order across.
  [[nodiscard]] Index face(Index ring, Index i) const { return ring * size() + i; }
  [[nodiscard]] Index back(Index ring, Index i) const { return ring * size() + size() - 1 - i; }

  /// Shares of the way across at which rows lie, on the face or on the back.
  [[nodiscard]] std::vector<double> shares(Vec2 from, Vec2 to) const {
    std::vector<double> shares;
    for (const double row : rows_)
      shares.push_back(dot(line_.foot + row * line_.across - from, line_.across) /
                       dot(to - from, line_.across));
    return shares;
  }

  void add_ring(const PathFrame& frame) {
    const std::size_t own = piece_at(pieces_, body_.windows.front().from).piece;
    const std::vector<Vec2> here = section_at(body_, frame.piece, frame.share);
    const std::vector<Vec2> there = section_at(body_, own, 0.0);
    std::vector<Vec2> section = {here[0]};
    for (const double share : shares(there[0], there[1]))
      section.push_back(here[0] + share * (here[1] - here[0]));
    section.push_back(here[1]);
    section.push_back(here[2]);
    std::vector<double> far = shares(there[3], there[2]);
    std::reverse(far.begin(), far.end());
    for (const double share : far) section.push_back(here[3] + share * (here[2] - here[3]));
    section.push_back(here[3]);
    for (const Vec2 corner : section) {
      const Vec2 at = frame.at + corner.x * frame.left;
      mesh_.vertices.push_back({at.x, at.y, corner.y});
    }
  }

  [[nodiscard]] bool open(Index ring, Index i) const {
    if (i == 0 || i >= cuts() || ring + 1 >= ends_.places().size()) return false;
    const double along = 0.5 * (ends_.places()[ring] + ends_.places()[ring + 1]);
    const double across = 0.5 * (rows_[i - 1] + rows_[i]);
    return std::any_of(body_.windows.begin(), body_.windows.end(), [&](const SweptWindow& window) {
      return along > window.from && along < window.to && across > window.low && across < window.high;
    });
  }

  /// What lies from one row to another, from one ring to the next; of an open one, which is alone, its walls.
  void add_cells(Index ring, Index i, Index last) {
    const Index next = ring + 1;
    if (open(ring, i)) {
      add_walls(ring, i);
      return;
    }
    const double low = i == 0 ? -1e300 : rows_[i - 1];
    const double high = last == cuts() ? 1e300 : rows_[last];
    const std::vector<const Bore*> holes =
        between(body_.holes, bores_, ends_.places()[ring], ends_.places()[next], {low, high});
    if (holes.empty()) {
      for (Index k = i; k <= last; ++k) {
        add_quad(mesh_, face(ring, k), face(ring, k + 1), face(next, k + 1), face(next, k));
        add_quad(mesh_, back(ring, k + 1), back(ring, k), back(next, k), back(next, k + 1));
      }
      return;
    }
    std::vector<Index> near;
    std::vector<Index> far;
    near.push_back(face(next, i));
    for (Index k = i; k <= last + 1; ++k) near.push_back(face(ring, k));
    for (Index k = last + 1; k > i; --k) near.push_back(face(next, k));
    far.push_back(back(next, last + 1));
    for (Index k = last + 2; k > i; --k) far.push_back(back(ring, k - 1));
    for (Index k = i; k <= last; ++k) far.push_back(back(next, k));
    add_drilled(mesh_, near, far, holes, fineness_);
  }

  void add_walls(Index ring, Index i) {
    const Index next = ring + 1;
    const std::array<Index, 4> near = {face(ring, i), face(ring, i + 1), face(next, i + 1), face(next, i)};
    const std::array<Index, 4> far = {back(ring, i + 1), back(ring, i), back(next, i), back(next, i + 1)};
    if (!open(ring, i - 1)) add_quad(mesh_, face(ring, i), back(ring, i), back(next, i), face(next, i));
    if (!open(ring, i + 1))
      add_quad(mesh_, back(ring, i + 1), face(ring, i + 1), face(next, i + 1), back(next, i + 1));
    if (ring == 0 || !open(ring - 1, i)) add_quad(mesh_, near[0], near[1], far[0], far[1]);
    if (!open(next, i)) add_quad(mesh_, near[3], far[2], far[3], near[2]);
  }

  /// An edge of the plate, from a corner to the next.
  void add_edge(Index ring, Index i) {
    const Index other = (i + 1) % size();
    add_quad(mesh_, face(ring, i), face(ring, other), face(ring + 1, other), face(ring + 1, i));
  }

  void add_caps(Index last) {
    for (Index i = 0; i <= cuts(); ++i) {
      add_quad(mesh_, face(0, i), back(0, i), back(0, i + 1), face(0, i + 1));
      add_quad(mesh_, face(last, i), face(last, i + 1), back(last, i + 1), back(last, i));
    }
  }

  const SweptBody& body_;
  Fineness fineness_;
  std::vector<PathPiece> pieces_;
  std::vector<Bore> bores_;
  ChordEnds ends_;
  BoreLine line_;
  std::vector<double> rows_;
  TriangleMesh mesh_;
};

namespace {

std::vector<Index> listed(const std::array<Index, 4>& quad) {
  return {quad.begin(), quad.end()};
}

}  // namespace

TriangleMesh mesh_of(const SweptBody& body, const Fineness& fineness) {
  if (!body.windows.empty()) return WindowedPlate(body, fineness).whole();
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
    if (!holes.empty()) add_drilled(mesh, listed(quad(0)), listed(quad(2)), holes, fineness);
  }
  for (const auto& [a, b, c] : solid::triangulate_loops({section})) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({last + a, last + b, last + c});
  }
  return mesh;
}

TriangleMesh mesh_of(const RolledSheet& sheet, const Fineness& fineness) {
  return SheetMesh(sheet, fineness).whole();
}

}  // namespace glissade::parts
