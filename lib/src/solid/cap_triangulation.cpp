#include "solid/cap_triangulation.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

// Incremental Delaunay triangulation by flips (Lawson 1977), edges of the loops forced in by flips (Sloan
// 1993), and flips again until every other edge is locally Delaunay: that is the constrained Delaunay
// triangulation (Lee, Lin 1986). Exact predicates make every step certain.

namespace glissade::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::uint32_t kNone = UINT32_MAX;

[[noreturn]] void refuse() {
  throw InternalError({"", "the outline of an end face crosses or touches itself", "", ""});
}

Kernel::Point_2 point(Vec2 p) {
  return {p.x, p.y};
}

/// @return above 0 where a, b, c turn left; 0 only if they lie on one line
int turn(Vec2 a, Vec2 b, Vec2 c) {
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c)));
}

/// @return whether d lies inside the circle through a, b, c, which turn left
bool in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return CGAL::side_of_oriented_circle(point(a), point(b), point(c), point(d)) == CGAL::ON_POSITIVE_SIDE;
}

std::size_t next(std::size_t side) {
  return side == 2 ? 0 : side + 1;
}

std::size_t before(std::size_t side) {
  return side == 0 ? 2 : side - 1;
}

/// A triangle; side i is the one opposite corner i, from the next corner to the one before.
struct Face {
  std::array<std::uint32_t, 3> corner{};
  std::array<std::uint32_t, 3> neighbour{kNone, kNone, kNone};
  std::array<bool, 3> fixed{};  // sides that belong to a loop
};

struct SideOf {
  std::uint32_t face = kNone;
  std::size_t side = 0;
};

class Triangulation {
 public:
  explicit Triangulation(std::vector<Vec2> points) : points_(std::move(points)) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    Vec2 low = points_.front();
    Vec2 high = low;
    for (const Vec2 p : points_) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    // A frame of two faces around all; loops part it from what they enclose.
    const double margin = std::max(high.x - low.x, high.y - low.y);
    low = low - Vec2{margin, margin};
    high = high + Vec2{margin, margin};
    points_.insert(points_.end(), {low, {high.x, low.y}, high, {low.x, high.y}});
    faces_ = {{{count, count + 1, count + 2}, {kNone, 1, kNone}, {}},
              {{count, count + 2, count + 3}, {kNone, kNone, 0}, {}}};
    face_of_.assign(points_.size(), kNone);
    face_of_[count] = face_of_[count + 1] = face_of_[count + 2] = 0;
    face_of_[count + 3] = 1;
    for (std::uint32_t i = 0; i < count; ++i) insert(i);
  }

  /// Makes the line between two points a side of faces, and keeps it so.
  void fix(std::uint32_t a, std::uint32_t b) {
    SideOf there = side_between(a, b);
    if (there.face == kNone) {
      force(a, b);
      there = side_between(a, b);
    }
    if (there.face == kNone) refuse();
    faces_[there.face].fixed[there.side] = true;
    const SideOf back = across(there);
    faces_[back.face].fixed[back.side] = true;
  }

  /// Flips what is not fixed until it is locally Delaunay.
  void settle() {
    std::vector<SideOf> open;
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      for (std::size_t side = 0; side < 3; ++side) open.push_back({face, side});
    }
    flip_until_delaunay(open);
  }

  /// @return faces that an odd number of fixed lines parts from the outside, in the order of their making
  [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> inside() const {
    constexpr char kUnknown = 2;
    std::vector<char> parity(faces_.size(), kUnknown);
    std::vector<std::uint32_t> open{face_of_.back()};
    parity[open.front()] = 0;
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (std::size_t side = 0; side < 3; ++side) {
        const std::uint32_t neighbour = faces_[face].neighbour[side];
        if (neighbour == kNone || parity[neighbour] != kUnknown) continue;
        parity[neighbour] = static_cast<char>(parity[face] ^ (faces_[face].fixed[side] ? 1 : 0));
        open.push_back(neighbour);
      }
    }
    std::vector<std::array<std::uint32_t, 3>> found;
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      if (parity[face] == 1) found.push_back(faces_[face].corner);
    }
    return found;
  }

 private:
  [[nodiscard]] int turn_at(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return turn(points_[a], points_[b], points_[c]);
  }

  [[nodiscard]] std::size_t corner_of(std::uint32_t face, std::uint32_t vertex) const {
    const auto& corner = faces_[face].corner;
    return corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
  }

  /// The same line as a side of the face beyond it.
  [[nodiscard]] SideOf across(const SideOf& side) const {
    const std::uint32_t beyond = faces_[side.face].neighbour[side.side];
    if (beyond == kNone) return {};
    const std::uint32_t after = faces_[side.face].corner[next(side.side)];
    return {beyond, next(corner_of(beyond, after))};
  }

  void connect(std::uint32_t face, std::size_t side, const SideOf& beyond) {
    if (beyond.face == kNone) {
      faces_[face].neighbour[side] = kNone;
      return;
    }
    faces_[face].neighbour[side] = beyond.face;
    faces_[beyond.face].neighbour[beyond.side] = face;
  }

  /// Walks towards a point from the face made last. Ends, because the triangulation is Delaunay meanwhile.
  [[nodiscard]] std::uint32_t locate(Vec2 p) const {
    std::uint32_t face = last_;
    for (bool found = false; !found;) {
      found = true;
      for (std::size_t side = 0; side < 3 && found; ++side) {
        const auto& corner = faces_[face].corner;
        if (turn(points_[corner[next(side)]], points_[corner[before(side)]], p) >= 0) continue;
        face = faces_[face].neighbour[side];
        found = false;
      }
    }
    return face;
  }

  void insert(std::uint32_t vertex) {
    const std::uint32_t face = locate(points_[vertex]);
    std::size_t touched = 0;
    std::size_t on_side = 0;
    for (std::size_t side = 0; side < 3; ++side) {
      const auto& corner = faces_[face].corner;
      if (turn_at(corner[next(side)], corner[before(side)], vertex) != 0) continue;
      ++touched;
      on_side = side;
    }
    if (touched > 1) refuse();  // it is a point that is there already
    std::vector<SideOf> open;
    if (touched == 1) {
      const SideOf other = across({face, on_side});
      split(other.face, vertex, open);
      // The split of the face beyond left one without area on this side: its flip splits this one.
      flip({face, on_side});
      open.clear();
      for (const std::uint32_t near : faces_around(vertex)) open.push_back({near, corner_of(near, vertex)});
    } else {
      split(face, vertex, open);
    }
    flip_until_delaunay(open);
    last_ = face_of_[vertex];
  }

  /// Three faces in place of one; `open` gets the sides opposite the new point.
  void split(std::uint32_t face, std::uint32_t vertex, std::vector<SideOf>& open) {
    const Face old = faces_[face];
    std::array<SideOf, 3> beyond{};
    for (std::size_t side = 0; side < 3; ++side) beyond[side] = across({face, side});
    const auto count = static_cast<std::uint32_t>(faces_.size());
    const std::array<std::uint32_t, 3> made{face, count, count + 1};
    faces_.resize(faces_.size() + 2);
    for (std::size_t i = 0; i < 3; ++i) {
      faces_[made[i]] = {{vertex, old.corner[next(i)], old.corner[before(i)]},
                         {kNone, made[next(i)], made[before(i)]},
                         {old.fixed[i], false, false}};
      connect(made[i], 0, beyond[i]);
      face_of_[old.corner[next(i)]] = made[i];
      open.push_back({made[i], 0});
    }
    face_of_[vertex] = face;
  }

  /// Gives the two faces at a side their other diagonal.
  void flip(const SideOf& at) {
    const SideOf back = across(at);
    const std::uint32_t f = at.face;
    const std::uint32_t g = back.face;
    const std::uint32_t p = faces_[f].corner[at.side];
    const std::uint32_t q = faces_[f].corner[next(at.side)];
    const std::uint32_t r = faces_[f].corner[before(at.side)];
    const std::uint32_t s = faces_[g].corner[back.side];
    const SideOf over_pq = across({f, before(at.side)});
    const SideOf over_rp = across({f, next(at.side)});
    const SideOf over_qs = across({g, corner_of(g, r)});
    const SideOf over_sr = across({g, corner_of(g, q)});
    const bool pq = faces_[f].fixed[before(at.side)];
    const bool rp = faces_[f].fixed[next(at.side)];
    const bool qs = faces_[g].fixed[corner_of(g, r)];
    const bool sr = faces_[g].fixed[corner_of(g, q)];
    faces_[f] = {{p, q, s}, {kNone, g, kNone}, {qs, false, pq}};
    faces_[g] = {{p, s, r}, {kNone, kNone, f}, {sr, rp, false}};
    connect(f, 0, over_qs);
    connect(f, 2, over_pq);
    connect(g, 0, over_sr);
    connect(g, 1, over_rp);
    face_of_[p] = face_of_[q] = face_of_[s] = f;
    face_of_[r] = g;
  }

  void flip_until_delaunay(std::vector<SideOf>& open) {
    while (!open.empty()) {
      const SideOf at = open.back();
      open.pop_back();
      if (faces_[at.face].fixed[at.side]) continue;
      const SideOf back = across(at);
      if (back.face == kNone) continue;
      const auto& corner = faces_[at.face].corner;
      const std::uint32_t opposite = faces_[back.face].corner[back.side];
      if (!in_circle(points_[corner[0]], points_[corner[1]], points_[corner[2]], points_[opposite])) continue;
      flip(at);
      for (const std::uint32_t face : {at.face, back.face}) {
        for (std::size_t side = 0; side < 3; ++side) open.push_back({face, side});
      }
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> faces_around(std::uint32_t vertex) const {
    const std::uint32_t start = face_of_[vertex];
    std::vector<std::uint32_t> faces;
    std::uint32_t face = start;
    do {
      faces.push_back(face);
      face = faces_[face].neighbour[next(corner_of(face, vertex))];
    } while (face != start && face != kNone);
    if (face == start) return faces;
    // A corner of the frame: the rest lies the other way.
    for (face = faces_[start].neighbour[before(corner_of(start, vertex))]; face != kNone;
         face = faces_[face].neighbour[before(corner_of(face, vertex))]) {
      faces.push_back(face);
    }
    return faces;
  }

  [[nodiscard]] SideOf side_between(std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t face : faces_around(a)) {
      const std::size_t at = corner_of(face, a);
      if (faces_[face].corner[next(at)] == b) return {face, before(at)};
      if (faces_[face].corner[before(at)] == b) return {face, next(at)};
    }
    return {};
  }

  [[nodiscard]] bool crosses(std::uint32_t u, std::uint32_t w, std::uint32_t a, std::uint32_t b) const {
    return turn_at(a, b, u) * turn_at(a, b, w) < 0 && turn_at(u, w, a) * turn_at(u, w, b) < 0;
  }

  /// Flips away the lines that the one from a to b crosses; leaves it out where a loop crosses or touches.
  void force(std::uint32_t a, std::uint32_t b) {
    std::deque<std::pair<std::uint32_t, std::uint32_t>> crossed = lines_between(a, b);
    // Each round flips at least one where that can be done at all; more rounds than lines squared cannot be.
    std::size_t rounds = 4 * crossed.size() * crossed.size() + 16;
    while (!crossed.empty() && rounds-- > 0) {
      const auto [u, w] = crossed.front();
      crossed.pop_front();
      const SideOf at = side_between(u, w);
      const SideOf back = across(at);
      const std::uint32_t p = faces_[at.face].corner[at.side];
      const std::uint32_t s = faces_[back.face].corner[back.side];
      if (!crosses(u, w, p, s)) {
        crossed.emplace_back(u, w);  // not convex yet
        continue;
      }
      flip(at);
      if (crosses(p, s, a, b)) crossed.emplace_back(p, s);
    }
  }

  [[nodiscard]] std::deque<std::pair<std::uint32_t, std::uint32_t>> lines_between(std::uint32_t a,
                                                                                  std::uint32_t b) const {
    std::deque<std::pair<std::uint32_t, std::uint32_t>> lines;
    SideOf at;
    for (const std::uint32_t face : faces_around(a)) {
      const std::size_t here = corner_of(face, a);
      const auto& corner = faces_[face].corner;
      if (crosses(corner[next(here)], corner[before(here)], a, b)) at = {face, here};
    }
    if (at.face == kNone) refuse();
    for (;;) {
      if (faces_[at.face].fixed[at.side]) refuse();
      const auto& corner = faces_[at.face].corner;
      lines.emplace_back(corner[next(at.side)], corner[before(at.side)]);
      const SideOf back = across(at);
      const auto& beyond = faces_[back.face].corner;
      if (beyond[back.side] == b) return lines;
      const bool first = crosses(beyond[back.side], beyond[next(back.side)], a, b);
      const bool second = crosses(beyond[back.side], beyond[before(back.side)], a, b);
      if (first == second) refuse();  // it runs through a point
      at = {back.face, first ? before(back.side) : next(back.side)};
    }
  }

  std::vector<Vec2> points_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> face_of_;  // one of the faces at each point
  std::uint32_t last_ = 0;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_loops(const std::vector<std::vector<Vec2>>& loops) {
  // In the order of the loops, each from its neighbour: same input, same triangles, even where four points of
  // a grid lie on one circle.
  std::vector<Vec2> points;
  for (const auto& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
  Triangulation triangulation(points);
  std::size_t first = 0;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      triangulation.fix(static_cast<std::uint32_t>(first + i),
                        static_cast<std::uint32_t>(first + (i + 1) % loop.size()));
    }
    first += loop.size();
  }
  triangulation.settle();
  std::vector<std::array<std::uint32_t, 3>> triangles = triangulation.inside();
  // Each hole adds two to the count of a polygon without one.
  if (triangles.size() != points.size() + 2 * loops.size() - 4) refuse();
  return triangles;
}

}  // namespace glissade::solid
