#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/core/error.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/bores.hpp"

#include <cstdint>
#include <numbers>
#include <vector>

namespace glissade::parts {

/// What the facets of all bodies are made with: chords of arcs, quads, loops.

inline constexpr double kTurn = 2.0 * std::numbers::pi;
inline constexpr double kRoomOfHole = 1.02;  ///< widths of a hole that its two chords leave it

using Index = std::uint32_t;  ///< of a vertex

struct Fineness {
  double sagitta;     ///< greatest distance between an arc and its chord [m]
  int round_corners;  ///< chords of a full turn, at least
};

[[nodiscard]] Index count_of(const TriangleMesh& mesh);
/// @param a,b,c,d  counter-clockwise seen from outside
void add_quad(TriangleMesh& mesh, Index a, Index b, Index c, Index d);

/// @return how many chords an arc takes; >= 1
[[nodiscard]] int chords_of(double sweep, double radius, const Fineness& fineness);
[[nodiscard]] int chords_of(const PathPiece& piece, const Fineness& fineness);

/// @return corners of a path, but for the last one of an open path
[[nodiscard]] std::vector<Vec2> corners_of(const ArcPath& path, const Fineness& fineness);
/// Turns a loop round if it runs the other way.
void run(std::vector<Vec2>& loop, bool counter_clockwise);
/// Sorts places, and leaves out those within 1e-9 of the one before.
void sort_apart(std::vector<double>& places);

/// Places along a path at which chords end, those about holes moved to both sides of them: a hole lies between two chords.
class ChordEnds {
 public:
  /// @param reach  of what lies beside the path: chords are those of arcs so much larger [m]
  ChordEnds(const std::vector<PathPiece>& pieces, double reach, const Fineness& fineness);

  void leave_out(const std::vector<Circle>& holes, const std::vector<Bore>& bores);

  /// A window begins and ends at one of them.
  void add(const SweptWindow& window);

  [[nodiscard]] const std::vector<double>& starts() const { return starts_; }
  [[nodiscard]] const std::vector<double>& places() const { return places_; }

 private:
  std::vector<double> starts_;  ///< of pieces, and the end
  std::vector<double> places_;
};

/// @param make  of a fineness; again with more chords where those of two arcs beside each other cross
template <typename Make>
TriangleMesh with_enough_chords(Make make, Fineness fineness) {
  constexpr int kTries = 16;
  for (int i = 1; i < kTries; ++i) {
    try {
      return make(fineness);
    } catch (const InternalError&) {
      fineness.sagitta /= 4.0;
      fineness.round_corners *= 2;
    }
  }
  return make(fineness);
}

}  // namespace glissade::parts
