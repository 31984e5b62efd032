#pragma once

#include "glissade/solid/triangle_mesh.hpp"

#include <string>

namespace glissade {

/// One thing to be printed.
struct PrintPiece {
  std::string name;    ///< "segment 2 of 5"
  std::string number;  ///< as it is marked on the piece: "02"
  TriangleMesh mesh;   ///< closed, outward [m]
};

/// The room of a printer [m]; all > 0.
struct PrintBed {
  double x = 0.220;
  double y = 0.220;
  double z = 0.250;
  double gap = 0.005;  ///< between pieces, and from the edges of the bed; >= 0

  friend bool operator==(const PrintBed&, const PrintBed&) = default;
};

}  // namespace glissade
