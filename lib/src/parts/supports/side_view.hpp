#pragma once

#include "parts/curves/offset_line.hpp"
#include "parts/plates/shell.hpp"
#include "parts/supports/trestle.hpp"

#include <array>
#include <vector>

namespace glissade::parts {

/// Frames, stiffeners and other plates square to the track, and angles, seen from the side: below a slope they lean over beams.
class SideView {
 public:
  explicit SideView(const Shell& shell);

  /// @param tube  side of beam and legs [m]
  /// @return whether nothing of it lies where beam and legs of a trestle stand
  [[nodiscard]] bool is_clear(const Trestle& trestle, double tube) const;

  /// @param seat   what the saddle is cut to
  /// @param aside  of the saddle, to the left [m]
  /// @param beam   height of the cross beam's upper face [m]
  /// @return whether a saddle stands beside all of it: stiffeners lean over what is upright
  [[nodiscard]] bool is_clear(const ArcPath& seat, double aside, double beam) const;

 private:
  /// A convex figure, and from where to where it reaches across, to the left.
  struct Shape {
    std::vector<Vec2> corners;
    Span aside;
  };

  [[nodiscard]] double aside_of(Vec3 point) const;
  [[nodiscard]] Vec2 seen(Vec3 point) const;
  void add(const Prism& prism, const Frame& place);
  /// From where to where a plate square to the track reaches across.
  [[nodiscard]] Span reach_of(const Prism& prism, const Frame& place) const;

  const Placement& placement_;
  std::vector<std::array<Vec2, 2>> lines_;
  std::vector<Shape> shapes_;
};

}  // namespace glissade::parts
