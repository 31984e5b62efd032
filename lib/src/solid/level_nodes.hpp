#pragma once

#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::solid {

/// A point of a trimmed level curve. A station carries it (from == to), or it stands for a trim.
struct LevelNode {
  Vec2 point;  ///< (x, z) [m]
  double from = 0.0;
  double to = 0.0;
  bool trim = false;
};

/// How close the nodes of a level curve may stand [m].
struct NodeSpacing {
  double shortest = 0.0;      ///< nodes closer together are left out where they are not needed
  double beside_trims = 0.0;  ///< so are those closer to a trim, where the curve without them
  double sagitta = 0.0;       ///<   passes them by no further than this
  /// No node beside a trim is left out: a width begins or ends to change at any of them.
  bool keeps_beside_trims = false;
};

/// One level curve from the start face to the finish face.
struct LevelCurve {
  std::vector<LevelNode> nodes;
  bool trimmed = false;
};

/// Leaves out nodes that stand too close to the one kept before them, or to a trim; trims and both ends stay.
void thin_out(std::vector<LevelNode>& nodes, const NodeSpacing& limits);

}  // namespace glissade::solid
