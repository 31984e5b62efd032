#pragma once

#include "glissade/core/arc_path.hpp"

#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace testing {

/// Points on a curve that turns by a little less in each of `count` arcs, as a chute does; tangent where they meet.
inline glissade::ArcPath bending_line(int count, double size) {
  glissade::ArcPath path;
  glissade::Vec2 at{0.0, 0.0};
  double heading = -1.3;
  for (int i = 0; i < count; ++i) {
    const double sweep = 1.2 / count * (1.5 - static_cast<double>(i) / count);
    const double chord = size * (0.6 + 0.8 * i / count) / count;
    path.vertices.push_back({at, glissade::bulge_of_sweep(sweep)});
    at = at + chord * glissade::Vec2{std::cos(heading + 0.5 * sweep), std::sin(heading + 0.5 * sweep)};
    heading += sweep;
  }
  path.vertices.push_back({at, 0.0});
  return path;
}

/// The band between a tangent line of arcs and its parallel on the left: a side plate.
/// @param count  of arcs a side
inline glissade::PlaneRegion band(int count, double size, double width, int holes) {
  const glissade::ArcPath low = bending_line(count, size);
  glissade::PlaneRegion region;
  region.outline.closed = true;
  const std::vector<glissade::PathPiece> pieces = glissade::pieces_of(low);
  std::vector<glissade::PathVertex> back;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const glissade::CircularArc arc = glissade::arc_of(pieces[i]);
    const double factor = (arc.radius - width) / arc.radius;  // all of them turn left
    const auto inner = [&](glissade::Vec2 p) { return arc.centre + factor * (p - arc.centre); };
    region.outline.vertices.push_back({pieces[i].from, pieces[i].bulge});
    if (i == 0) back.push_back({inner(pieces[i].from), 0.0});
    back.back().bulge = pieces[i].bulge;
    back.push_back({inner(pieces[i].to), 0.0});
  }
  region.outline.vertices.push_back({pieces.back().to, 0.0});
  const glissade::ArcPath upper = glissade::reversed({back, false});
  for (std::size_t i = 0; i < upper.vertices.size(); ++i) {
    region.outline.vertices.push_back(upper.vertices[i]);
  }
  region.outline.vertices.back().bulge = 0.0;
  const int rounds = (holes + count - 1) / count;  // so many holes along an arc at most
  for (int i = 0; i < holes; ++i) {
    const glissade::PathPiece& piece = pieces[static_cast<std::size_t>(i % count)];
    const glissade::CircularArc arc = glissade::arc_of(piece);
    const glissade::Vec2 middle = glissade::point_on(piece, (i / count + 1.0) / (rounds + 1.0));
    const double factor = (arc.radius - 0.5 * width) / arc.radius;
    region.holes.push_back({arc.centre + factor * (middle - arc.centre), 0.1 * width});
  }
  return region;
}

}  // namespace testing
