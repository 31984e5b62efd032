#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace glissade::clearance {

/// Where a track passes an area: beside it on any side, wholly above or wholly below.
enum class Pass { either, above, below };

/// The place of a convex shape that comes closest to a region, or reaches deepest into it.
struct Nearest {
  double value = std::numeric_limits<double>::infinity();  ///< signed distance [m]; negative inside
  Vec2 point;                                              ///< of the shape
};

/// What tracks keep clear of.
///
/// Frame: plane of the centerline, (run, drop), drop positive DOWN [m].
/// Value of a point: its distance from the edges of the region; negative within it, and where the region is
///   passed on the wrong side:
///   - an area that may be passed on either side: less the distance to its outline;
///   - an area passed above (below): how far the point lies below its upper (above its lower) side;
///   - a line, kept above or below over its own runs: less the distance to the line;
///   - a half-plane: how far the point lies beyond the line.
class Region {
 public:
  /// @param outline  simple polygon, either winding, at least 3 corners
  [[nodiscard]] static Region area(const std::vector<Vec2>& outline, Pass pass);
  /// @param line   ascending runs, at least 2 points
  /// @param above  whether the track keeps above the line
  [[nodiscard]] static Region line(const std::vector<Vec2>& line, bool above);
  /// @param forbidden  square to the line, towards the forbidden side; any length > 0
  [[nodiscard]] static Region half_plane(Vec2 point, Vec2 forbidden);

  /// The least value over a convex shape. Distances and the sign are exact; so is the depth below lines and
  /// half-planes and on the wrong side of areas. The depth within an area passed on either side is that of the
  /// deepest of some points.
  /// @param shape  a point, a segment, or the corners of a convex polygon in order
  [[nodiscard]] Nearest nearest(std::span<const Vec2> shape) const;

  /// Where a segment meets an edge of the region.
  struct Crossing {
    double share = 0.0;    ///< of the segment, from 0 to 1
    std::size_t edge = 0;  ///< from corner `edge` of the outline or line to the next
  };
  /// @return all of them in their order along the segment; none of a half-plane
  [[nodiscard]] std::vector<Crossing> crossings(Vec2 from, Vec2 to) const;

  /// What a curve that enters the region through one edge and leaves it through another cuts off: the corners of an
  /// area on either side of the curve; those of a line between the two edges.
  /// @return nothing of what has no thickness to be told by: half-planes, and areas that are passed on a given side
  [[nodiscard]] std::vector<std::vector<Vec2>> cut_off(std::size_t entered, std::size_t left) const;

  /// @return the corners of an area or line; none of a half-plane
  [[nodiscard]] std::vector<Vec2> corners() const;

  /// @return whether the value of a point may jump at a run in between: at the ends of what lies behind a line
  ///   or an area, which no distance is measured from
  [[nodiscard]] bool jumps_within(double low_run, double high_run) const;

 private:
  enum class Kind { area, line, half_plane };

  struct Edge {
    Vec2 from;
    Vec2 to;
  };
  struct Box {
    Vec2 low;
    Vec2 high;
  };

  explicit Region(Kind kind) : kind_(kind) {}

  void add_edges(const std::vector<Vec2>& corners, bool closed);
  void add_jumps();
  void add_profile(const std::vector<Vec2>& outline, double side);
  void build_boxes(std::size_t node, std::size_t begin, std::size_t end);
  void search(std::size_t node, std::size_t begin, std::size_t end, std::span<const Vec2> shape,
              const Box& around, Nearest& nearest) const;
  [[nodiscard]] Nearest nearest_edge(std::span<const Vec2> shape) const;
  void meet(std::size_t node, std::size_t begin, std::size_t end, Vec2 from, Vec2 to,
            std::vector<Crossing>& found) const;
  [[nodiscard]] bool inside(Vec2 point) const;
  [[nodiscard]] Nearest deepest_within(std::span<const Vec2> shape) const;
  [[nodiscard]] Nearest deepest_behind(std::span<const Vec2> shape) const;

  Kind kind_;
  Pass pass_ = Pass::either;
  std::vector<Edge> edges_;    // what distances are measured from
  std::vector<Box> boxes_;     // tree over them
  std::vector<Edge> profile_;  // ascending runs: what lies behind it is forbidden
  std::vector<double> jumps_;  // runs at which it begins, breaks off or ends
  double side_ = 0.0;          // +1: forbidden below the profile (larger drop), -1: above it
  Vec2 forbidden_;             // unit vector, of a half-plane
};

}  // namespace glissade::clearance
