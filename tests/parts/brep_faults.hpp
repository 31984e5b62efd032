#pragma once

// What keeps faces of a part from being the surface of a solid.

#include "parts/bodies/brep.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

namespace testing {

/// Faces that are no closed surface, or not seen counter-clockwise from outside.
inline std::string fault_of(const glissade::ShopPart& part) {
  const glissade::parts::Brep brep = glissade::parts::brep_of(part);
  std::map<std::size_t, int> uses;
  double volume = 0.0;
  for (const glissade::parts::BrepFace& face : brep.faces) {
    for (const auto& loop : face.loops) {
      std::size_t at =
          loop.front().forward ? brep.edges[loop.front().edge].from : brep.edges[loop.front().edge].to;
      const std::size_t first = at;
      for (const glissade::parts::BrepUse& use : loop) {
        const glissade::parts::BrepEdge& edge = brep.edges[use.edge];
        uses[use.edge] += use.forward ? 1 : 100;
        if ((use.forward ? edge.from : edge.to) != at) return part.name + ": a loop is no chain";
        at = use.forward ? edge.to : edge.from;
        // Volume by chords: near the body's own, and of its sign only where faces look outwards.
        const glissade::Vec3 a = brep.vertices[edge.from];
        const glissade::Vec3 b = brep.vertices[edge.to];
        const glissade::Vec3 c = brep.vertices[loop.front().forward ? brep.edges[loop.front().edge].from
                                                                    : brep.edges[loop.front().edge].to];
        volume += (use.forward ? 1.0 : -1.0) * dot(cross(a, b), c) / 6.0;
      }
      if (at != first) return part.name + ": a loop is open";
    }
  }
  for (const auto& [edge, count] : uses) {
    if (count != 101) return part.name + ": edge " + std::to_string(edge) + " is not used once each way";
  }
  if (uses.size() != brep.edges.size()) return part.name + ": an edge is in no face";
  if (std::fabs(1e-9 * volume / part.volume - 1.0) > 0.6) return part.name + ": faces do not look outwards";
  return "";
}

}  // namespace testing
