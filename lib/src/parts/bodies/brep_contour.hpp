#pragma once

#include "glissade/core/arc_path.hpp"

#include "parts/bodies/brep.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// Upright faces over lines and arcs of the plane, between two heights. Millimetres.

/// @return the edge over a piece between two vertices at one height
std::size_t add_edge(Brep& brep, const PathPiece& piece, std::size_t from, std::size_t to);

/// Edges of an upright face over a path with the material on its left.
struct UprightEdges {
  std::vector<std::size_t> low_vertices;  ///< of every piece its first one; of an open path the last one, too
  std::vector<std::size_t> high_vertices;
  std::vector<std::size_t> low;  ///< a piece each
  std::vector<std::size_t> high;
  std::vector<std::size_t> upright;  ///< from the lower to the upper of a pair of vertices
};
/// Adds the faces over a path, one a piece.
UprightEdges add_upright(Brep& brep, const ArcPath& path, double low, double high);

/// Contours with the material on their left: faces between two heights, and the loops that bound what lies below and above.
class ContourFaces {
 public:
  ContourFaces(Brep& brep, double depth) : brep_(brep), depth_(depth) {}

  void add(const ArcPath& path);
  /// A round hole.
  void add(const Circle& hole);
  /// Adds the level faces.
  void close();

  /// @return loops of the level faces so far, as seen from outside
  [[nodiscard]] const std::vector<std::vector<BrepUse>>& below() const { return below_; }
  [[nodiscard]] const std::vector<std::vector<BrepUse>>& above() const { return above_; }

 private:
  Brep& brep_;
  double depth_;
  std::vector<std::vector<BrepUse>> below_;
  std::vector<std::vector<BrepUse>> above_;
};

}  // namespace glissade::parts
