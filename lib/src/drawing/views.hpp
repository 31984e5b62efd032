#pragma once

#include "glissade/drawing/drawing.hpp"
#include "glissade/parts/shop_part.hpp"

#include <string>
#include <vector>

namespace glissade::drawing {

/// Where an eye looks: the picture's x axis to the right and y axis up, unit vectors square to each other.
struct Eye {
  Vec3 right;
  Vec3 up;

  [[nodiscard]] Vec2 see(Vec3 point) const { return {dot(right, point), dot(up, point)}; }
};

/// Edges of parts as an eye sees them, in millimetres; those that fall together once.
class Projection {
 public:
  explicit Projection(const Eye& eye) : eye_(eye) {}

  /// Edges of one piece of a part.
  void add(const ShopPart& part, const Frame& place);
  /// @return what was added, on the layer EDGES
  [[nodiscard]] Drawing drawing(const std::string& name) const;

 private:
  void add_mesh(const TriangleMesh& mesh, const Frame& place);

  Eye eye_;
  std::vector<ArcPath> paths_;
};

/// @return the eye that sees the track run from left to right, by its setting-out points
[[nodiscard]] Eye eye_beside(const Workshop& workshop);
/// @return the eye above it, the track again from left to right
[[nodiscard]] Eye eye_above(const Workshop& workshop);

/// An end, joint or support of the track, where an eye sees it.
struct MarkedPlace {
  std::string what;  ///< "joint 2"
  Vec2 at;           ///< [mm]
};
/// @param seen  what is drawn [mm]; places far from it are left out
[[nodiscard]] std::vector<MarkedPlace> marked_places(const Workshop& workshop, const PlaneBox& seen,
                                                     const Eye& eye);

}  // namespace glissade::drawing
