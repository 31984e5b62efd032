#include "solid/self_intersections.hpp"

#include "glissade/core/stop.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace glissade::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point to_point(Vec3 p) {
  return {p.x, p.y, p.z};
}

double manhattan(Vec3 a) {
  return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z);
}

/// Signs of projections that hold in spite of rounding: the vectors given are differences of two points, each
/// component rounded once; a dot product of three terms then errs by less than 4 epsilon times this product.
double projection_error(Vec3 direction, double largest) {
  return 8.0 * core::kEpsilon * manhattan(direction) * largest + std::numeric_limits<double>::min();
}

/// @return true only if a plane square to `direction` through the common origin certainly has a1, a2 on its
///         one side and b1, b2 on the other
bool origin_plane_parts(Vec3 direction, Vec3 a1, Vec3 a2, Vec3 b1, Vec3 b2, double largest) {
  const double error = projection_error(direction, largest);
  return std::min(dot(direction, a1), dot(direction, a2)) > error &&
         std::max(dot(direction, b1), dot(direction, b2)) < -error;
}

/// @return true only if some plane square to `direction` certainly parts the two triangles; corners relative
///         to one common origin, the first of `a`
bool plane_parts(Vec3 direction, const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double largest) {
  const double error = 2.0 * projection_error(direction, largest);
  const auto [a_low, a_high] =
      std::minmax({dot(direction, a[0]), dot(direction, a[1]), dot(direction, a[2])});
  const auto [b_low, b_high] =
      std::minmax({dot(direction, b[0]), dot(direction, b[1]), dot(direction, b[2])});
  return b_low - a_high > error || a_low - b_high > error;
}

/// Directions of lines that may part two sectors of one plane with a common apex, each between two rays: such
/// a line leads through both gaps, so that it lies between two rays that face each other in the gaps, where
/// the rays of one gap count turned round.
std::array<Vec3, 6> lines_between(Vec3 a1, Vec3 a2, Vec3 b1, Vec3 b2) {
  return {a1 + b1, a1 + b2, a2 + b1, a2 + b2, a1 - a2, b1 - b2};
}

Vec3 unit(Vec3 a) {
  return (1.0 / std::sqrt(dot(a, a))) * a;
}

struct LimitReached {};

class PairTester {
 public:
  PairTester(const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
             const SelfIntersectionLimits& limits)
      : positions_(positions), facets_(facets), limits_(limits) {}

  void test(std::uint32_t first, std::uint32_t second) {
    if (++tests_ > limits_.tests) throw LimitReached{};
    if (!meet(facets_[first], facets_[second])) return;
    const FacetPair pair = std::minmax(first, second);
    if (pairs_ == 0 || pair < first_) first_ = pair;
    if (++pairs_ >= limits_.pairs) throw LimitReached{};
  }

  [[nodiscard]] SelfIntersections found(bool complete) const {
    if (pairs_ == 0) return {.pairs = 0, .complete = complete, .exact = exact_, .first = {}};
    Vec3 sum;
    for (const std::uint32_t facet : {first_.first, first_.second}) {
      for (const std::uint32_t vertex : facets_[facet]) sum = sum + at(vertex);
    }
    return {.pairs = pairs_, .complete = complete, .exact = exact_, .first = (1.0 / 6.0) * sum};
  }

 private:
  using FacetPair = std::pair<std::uint32_t, std::uint32_t>;

  [[nodiscard]] bool meet(const FacetCorners& a, const FacetCorners& b) {
    // Corners that both have, moved to the front of copies of both.
    FacetCorners mine = a;
    FacetCorners other = b;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = shared; j < 3; ++j) {
        if (mine[i] != other[j]) continue;
        std::swap(mine[shared], mine[i]);
        std::swap(other[shared], other[j]);
        ++shared;
        break;
      }
    }
    switch (shared) {
      case 0:
        return strangers_meet(mine, other);
      case 1:
        return meet_beyond_vertex(mine, other);
      case 2:
        return meet_beyond_edge(mine, other);
      default:
        return true;
    }
  }

  /// Two facets with a common edge overlap only if folded flat onto each other.
  [[nodiscard]] bool meet_beyond_edge(const FacetCorners& a, const FacetCorners& b) {
    const Vec3 origin = at(a[0]);
    const Vec3 edge = at(a[1]) - origin;
    const Vec3 mine = at(a[2]) - origin;
    const Vec3 other = at(b[2]) - origin;
    const double length = manhattan(edge);
    const double error = 64.0 * core::kEpsilon * length * length * manhattan(mine) * manhattan(other) +
                         std::numeric_limits<double>::min();
    if (dot(cross(edge, mine), cross(edge, other)) < -error) return false;

    ++exact_;
    const Point p = point(a[0]);
    const Point q = point(a[1]);
    const Point r = point(a[2]);
    const Point s = point(b[2]);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }

  [[nodiscard]] bool meet_beyond_vertex(const FacetCorners& a, const FacetCorners& b) {
    const Vec3 origin = at(a[0]);
    const Vec3 a1 = at(a[1]) - origin;
    const Vec3 a2 = at(a[2]) - origin;
    const Vec3 b1 = at(b[1]) - origin;
    const Vec3 b2 = at(b[2]) - origin;
    const double largest = std::max({manhattan(a1), manhattan(a2), manhattan(b1), manhattan(b2)});
    const Vec3 between = (unit(a1) + unit(a2)) - (unit(b1) + unit(b2));
    if (origin_plane_parts(between, a1, a2, b1, b2, largest)) return false;
    // Facets of one plane to the last digits, as floors and walls have them, are beyond every filter of a
    // predicate; planes square to theirs part them all the same.
    for (const Vec3 normal : {cross(a1, a2), cross(b1, b2)}) {
      for (const Vec3 line : lines_between(unit(a1), unit(a2), unit(b1), unit(b2))) {
        const Vec3 across = cross(normal, line);
        if (origin_plane_parts(across, a1, a2, b1, b2, largest) ||
            origin_plane_parts(across, b1, b2, a1, a2, largest)) {
          return false;
        }
      }
    }

    ++exact_;
    const std::array<Point, 3> mine{point(a[0]), point(a[1]), point(a[2])};
    const std::array<Point, 3> other{point(b[0]), point(b[1]), point(b[2])};
    if (lies_beside(other, mine) || lies_beside(mine, other)) return false;
    // The part in common is convex and holds the vertex: if it is more than that, it ends on an edge
    // opposite.
    return CGAL::do_intersect(Kernel::Triangle_3(mine[0], mine[1], mine[2]),
                              Kernel::Segment_3(other[1], other[2])) ||
           CGAL::do_intersect(Kernel::Triangle_3(other[0], other[1], other[2]),
                              Kernel::Segment_3(mine[1], mine[2]));
  }

  [[nodiscard]] bool strangers_meet(const FacetCorners& a, const FacetCorners& b) {
    const Vec3 origin = at(a[0]);
    const std::array<Vec3, 3> mine{Vec3{}, at(a[1]) - origin, at(a[2]) - origin};
    const std::array<Vec3, 3> other{at(b[0]) - origin, at(b[1]) - origin, at(b[2]) - origin};
    const double largest = std::max({manhattan(mine[1]), manhattan(mine[2]), manhattan(other[0]),
                                     manhattan(other[1]), manhattan(other[2])});
    const Vec3 apart = (other[0] + other[1] + other[2]) - (mine[1] + mine[2]);
    const Vec3 my_normal = cross(mine[1], mine[2]);
    const Vec3 other_normal = cross(other[1] - other[0], other[2] - other[0]);
    if (plane_parts(apart, mine, other, largest) || plane_parts(my_normal, mine, other, largest) ||
        plane_parts(other_normal, mine, other, largest)) {
      return false;
    }
    // Two triangles of one plane that do not meet lie on two sides of an edge of one of them.
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      if (plane_parts(cross(my_normal, mine[next] - mine[i]), mine, other, largest) ||
          plane_parts(cross(other_normal, other[next] - other[i]), mine, other, largest)) {
        return false;
      }
    }
    ++exact_;
    return CGAL::do_intersect(Kernel::Triangle_3(point(a[0]), point(a[1]), point(a[2])),
                              Kernel::Triangle_3(point(b[0]), point(b[1]), point(b[2])));
  }

  /// @return true if the corners of `triangle` other than its first lie strictly on one side of `plane`
  static bool lies_beside(const std::array<Point, 3>& triangle, const std::array<Point, 3>& plane) {
    const CGAL::Orientation side = CGAL::orientation(plane[0], plane[1], plane[2], triangle[1]);
    return side != CGAL::COPLANAR && side == CGAL::orientation(plane[0], plane[1], plane[2], triangle[2]);
  }

  [[nodiscard]] Vec3 at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] Point point(std::uint32_t vertex) const { return to_point(positions_[vertex]); }

  const std::vector<Vec3>& positions_;
  const std::vector<FacetCorners>& facets_;
  SelfIntersectionLimits limits_;
  std::size_t tests_ = 0;
  std::size_t pairs_ = 0;
  std::size_t exact_ = 0;
  FacetPair first_;
};

}  // namespace

bool are_collinear(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 first = b - a;
  const Vec3 second = c - a;
  const double error =
      8.0 * core::kEpsilon * manhattan(first) * manhattan(second) + std::numeric_limits<double>::min();
  const Vec3 normal = cross(first, second);
  if (std::max({std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)}) > error) return false;
  return CGAL::collinear(to_point(a), to_point(b), to_point(c));
}

SelfIntersections find_self_intersections(const std::vector<Vec3>& positions,
                                          const std::vector<FacetCorners>& facets,
                                          const SelfIntersectionLimits& limits, const std::stop_token& stop) {
  PairTester tester(positions, facets, limits);
  const auto pause = [&stop] { require_going(stop); };
  const FacetBoxes boxes(positions, facets, pause);
  try {
    boxes.for_each_pair([&tester](std::uint32_t a, std::uint32_t b) { tester.test(a, b); }, pause);
  } catch (const LimitReached&) {
    return tester.found(false);
  }
  return tester.found(true);
}

}  // namespace glissade::solid
