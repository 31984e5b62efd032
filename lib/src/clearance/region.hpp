#pragma once

#include "glissade/core/vec.hpp"

#include "clearance/convex.hpp"

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

/// Depths are known to this share of themselves, below that to the rounding of the coordinates.
inline constexpr double kRegionDepthAccuracy =
    1e-8;  // accuracy: a hundredth of what least clearances are told to

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

  /// The least value over a convex shape, that of one of its points: distances and the sign are exact to rounding, and
  /// so are depths beyond half-planes and on the wrong side of areas; others are known to kRegionDepthAccuracy. A larger
  /// shape has no larger one.
  /// @param shape  a point, a segment, or the corners of a convex polygon in order
  [[nodiscard]] Nearest nearest(std::span<const Vec2> shape) const;

  /// @return no more than the value of any point within a distance of the shape
  [[nodiscard]] double lower_bound(std::span<const Vec2> shape, double distance) const;

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

  /// @return by how much the value of a point below 0 changes at most from one place to another, as a share of their
  ///   distance, where it does not jump; above 0 it is that distance itself
  [[nodiscard]] double steepness() const { return steepness_; }

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

  /// Of what is forbidden, the part between two runs, an edge above and one below; either may be infinitely far.
  struct Piece {
    Edge upper;
    Edge lower;

    [[nodiscard]] Convex part_of(std::span<const Vec2> shape) const;
  };
  struct Found : Nearest {
    std::size_t edge = 0;
  };
  struct Depth {
    double value = 0.0;    ///< of the deepest place found [m]; 0 where none is
    double at_most = 0.0;  ///< no place is deeper [m]
    bool told = false;     ///< whether it is more than a rounding
    Vec2 point;
  };
  struct Sounding;

  explicit Region(Kind kind) : kind_(kind) {}

  void add_edges(const std::vector<Vec2>& corners, bool closed);
  void add_inside(const std::vector<Vec2>& outline);
  void add_profile(const std::vector<Vec2>& outline, double side);
  void add_behind(const std::vector<Edge>& profile, double side);
  void build_boxes(std::size_t node, std::size_t begin, std::size_t end);
  void search(std::size_t node, std::size_t begin, std::size_t end, std::span<const Vec2> shape,
              const Box& around, Found& nearest) const;
  [[nodiscard]] Found nearest_edge(std::span<const Vec2> shape) const;
  void meet(std::size_t node, std::size_t begin, std::size_t end, Vec2 from, Vec2 to,
            std::vector<Crossing>& found) const;
  [[nodiscard]] double distance(Vec2 point, std::size_t edge) const;
  [[nodiscard]] Depth deepest(std::span<const Vec2> shape) const;

  Kind kind_;
  Pass pass_ = Pass::either;
  std::vector<Edge> edges_;    // what distances are measured from
  std::vector<Box> boxes_;     // tree over them
  std::vector<Piece> pieces_;  // ascending runs: what is forbidden
  std::vector<double> jumps_;  // runs at which what lies behind a profile begins, breaks off or ends
  double steepness_ = 1.0;
  double side_ = 0.0;  // +1: forbidden below a profile (larger drop), -1: above it
  Vec2 forbidden_;     // unit vector, of a half-plane
};

}  // namespace glissade::clearance
