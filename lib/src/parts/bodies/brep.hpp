#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/parts/shop_part.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace glissade::parts {

/// A solid by its faces, edges and vertices, in millimetres: what STEP holds.

enum class CurveKind { line, circle, ellipse, cubic, mouth };

/// From one vertex to another, counter-clockwise about the axis where it is round. A closed one has one vertex, at
/// centre + radius reference.
struct BrepEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  CurveKind kind = CurveKind::line;
  Vec3 centre;
  Vec3 axis;
  Vec3 reference;               ///< unit, square to the axis; of an ellipse along its first semi-axis
  double radius = 0.0;          ///< of an ellipse its semi-axis along the reference
  double second_radius = 0.0;   ///< of an ellipse
  std::array<Vec3, 4> poles{};  ///< of a cubic, in Bezier's form, from its first vertex to its last
  /// Of a mouth, the edge of a hole in a curved face: at the angle a from the reference its circle stands out along the axis by
  /// cos^2 a (rise + skew sin a).
  double rise = 0.0;
  double skew = 0.0;
};

struct BrepUse {
  std::size_t edge = 0;
  bool forward = true;
};

enum class SurfaceKind { plane, cylinder, cone, ruled };

/// Loops run counter-clockwise as seen from outside the solid; the first one is the outer one.
struct BrepFace {
  SurfaceKind kind = SurfaceKind::plane;
  Vec3 origin;
  Vec3 axis;                ///< of a plane its normal
  Vec3 reference;           ///< unit, square to the axis
  double radius = 0.0;      ///< of a cone where its axis passes the origin
  double half_angle = 0.0;  ///< of a cone, which widens along its axis [rad]
  bool outward = true;      ///< the surface's own normal (away from its axis) points out of the solid
  /// Of a ruled face: the cubics between which its straight lines lead; its normal is square to the way from the first to the
  /// second and, after it, to the way along them.
  std::array<std::array<Vec3, 4>, 2> rails{};
  std::vector<std::vector<BrepUse>> loops;
};

struct Brep {
  std::vector<Vec3> vertices;
  std::vector<BrepEdge> edges;
  std::vector<BrepFace> faces;
};

/// @return the solid of a part in its own frame
/// @throws InputError if the body is none, as glissade/io/step_file.hpp says; names the part
[[nodiscard]] Brep brep_of(const ShopPart& part);

}  // namespace glissade::parts
