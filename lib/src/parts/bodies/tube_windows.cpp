#include "parts/bodies/tube_windows.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/brep_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

Vec3 at_angle(double radius, double angle, double z) {
  const auto [sine, cosine] = math::sine_cosine(angle);
  return {radius * cosine, radius * sine, z};
}

using Loop = std::vector<BrepUse>;

/// The edges of a window on one cylinder: counter-clockwise seen from outside from the corner at `from` and `low`.
struct WindowRim {
  std::array<std::size_t, 4> corners{};
  std::array<std::size_t, 4> edges{};
};

WindowRim add_rim(Brep& brep, const TubeWindow& window, double radius) {
  WindowRim rim;
  const auto corner = [&](Angle about, double along) {
    const auto [sine, cosine] = math::sine_cosine(about.radians());
    return add_vertex(brep, {radius * cosine, radius * sine, core::kMillimetres * along});
  };
  rim.corners = {corner(window.low, window.from), corner(window.high, window.from),
                 corner(window.high, window.to), corner(window.low, window.to)};
  rim.edges = {add_arc(brep, rim.corners[0], rim.corners[1], {}, true),
               add_line(brep, rim.corners[1], rim.corners[2]),
               add_arc(brep, rim.corners[2], rim.corners[3], {}, false),
               add_line(brep, rim.corners[3], rim.corners[0])};
  return rim;
}

/// The four walls of a window: two square to the axis, two through it.
void add_walls(Brep& brep, const TubeWindow& window, const WindowRim& outer, const WindowRim& inner) {
  std::array<std::size_t, 4> across{};
  for (std::size_t k = 0; k < 4; ++k) across[k] = add_line(brep, inner.corners[k], outer.corners[k]);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    BrepFace face = level_plane(core::kMillimetres * (k == 0 ? window.from : window.to), k == 0);
    if (k % 2 == 1) {
      // Out of the tube is into the window: back from its upper edge, on from its lower one.
      const auto [sine, cosine] = math::sine_cosine((k == 1 ? window.high : window.low).radians());
      const double sense = k == 1 ? -1.0 : 1.0;
      face.origin = brep.vertices[inner.corners[k]];
      face.axis = {-sense * sine, sense * cosine, 0.0};
      face.reference = {cosine, sine, 0.0};
    }
    face.loops = {
        {{outer.edges[k], true}, {across[next], false}, {inner.edges[k], false}, {across[k], true}}};
    brep.faces.push_back(std::move(face));
  }
}

Loop loop_of(const WindowRim& rim, bool forward) {
  Loop loop;
  for (std::size_t k = 0; k < 4; ++k) loop.push_back({rim.edges[forward ? k : 3 - k], forward});
  return loop;
}

/// What bores_of() needs of it.
TubeGore in_millimetres(const TubeGore& gore) {
  TubeGore scaled;
  scaled.inner_radius = core::kMillimetres * gore.inner_radius;
  scaled.thickness = core::kMillimetres * gore.thickness;
  for (const TubeHole& hole : gore.holes)
    scaled.holes.push_back({core::kMillimetres * hole.along, hole.about, core::kMillimetres * hole.radius});
  return scaled;
}

}  // namespace

TubeGore round_of(const TroughGore& gore) {
  return {gore.inner_radius, gore.thickness, gore.length, gore.start_tilt,
          gore.end_tilt,     gore.windows,   gore.holes};
}

TubeMouths add_openings(Brep& brep, const TubeGore& gore) {
  TubeMouths mouths;
  const double inner = core::kMillimetres * gore.inner_radius;
  for (const TubeWindow& window : gore.windows) {
    const WindowRim rim = add_rim(brep, window, inner + core::kMillimetres * gore.thickness);
    const WindowRim inside = add_rim(brep, window, inner);
    add_walls(brep, window, rim, inside);
    mouths.outside.push_back(loop_of(rim, false));
    mouths.inside.push_back(loop_of(inside, true));
  }
  for (const Bore& bore : bores_of(in_millimetres(gore))) {
    const BoreLoops loops = add_bore(brep, bore);
    mouths.inside.push_back({loops.face});
    mouths.outside.push_back({loops.back});
  }
  return mouths;
}

std::vector<Bore> bores_of(const TubeGore& gore) {
  std::vector<Bore> bores;
  for (const TubeHole& hole : gore.holes) {
    const auto [sine, cosine] = math::sine_cosine(hole.about.radians());
    Bore bore;
    bore.centre = at_angle(gore.inner_radius, hole.about.radians(), hole.along);
    bore.along = {-sine, cosine, 0.0};
    bore.across = {0.0, 0.0, 1.0};
    bore.into = {cosine, sine, 0.0};
    bore.radius = hole.radius;
    bore.depth = gore.thickness;
    bore.from_axis = gore.inner_radius;
    bore.grows_into = 1.0;
    bore.path_radius = gore.inner_radius;
    bores.push_back(bore);
  }
  return bores;
}

BodyMoments moments_of(const TubeWindow& window, const TubeGore& gore) {
  const double inner = gore.inner_radius;
  const double outer = inner + gore.thickness;
  const double turn = window.high.radians() - window.low.radians();
  const double area = 0.5 * turn * (outer * outer - inner * inner);
  // Of the sector of a ring, from the axis.
  const double out =
      2.0 / 3.0 * (outer * outer * outer - inner * inner * inner) * math::sin(0.5 * turn) / area;
  const double middle = 0.5 * (window.low.radians() + window.high.radians());
  return {area * (window.to - window.from), at_angle(out, middle, 0.5 * (window.from + window.to))};
}

double beside(const TubeWindow& window, Vec3 place) {
  const double radius = math::hypot(place.x, place.y);
  const double middle = 0.5 * (window.low.radians() + window.high.radians());
  const auto [sine, cosine] = math::sine_cosine(middle);
  const double turned = math::atan2(cosine * place.y - sine * place.x, cosine * place.x + sine * place.y);
  const double round = radius * (std::fabs(turned) - 0.5 * (window.high.radians() - window.low.radians()));
  const double along = std::max(window.from - place.z, place.z - window.to);
  if (round <= 0.0 || along <= 0.0) return std::max(round, along);
  return math::hypot(round, along);
}

std::vector<Vec3> points_beside(const TubeGore& gore, double inset) {
  std::vector<Vec3> points;
  constexpr int kPoints = 6;
  for (const TubeWindow& window : gore.windows) {
    for (const double radius : {gore.inner_radius + inset, gore.inner_radius + gore.thickness - inset}) {
      const double off = inset / radius;
      const double low = window.low.radians() - off;
      const double high = window.high.radians() + off;
      for (int k = 0; k <= kPoints; ++k) {
        const double share = static_cast<double>(k) / kPoints;
        const double z = window.from + share * (window.to - window.from);
        const double angle = low + share * (high - low);
        points.push_back(at_angle(radius, low, z));
        points.push_back(at_angle(radius, high, z));
        points.push_back(at_angle(radius, angle, window.from - inset));
        points.push_back(at_angle(radius, angle, window.to + inset));
      }
    }
  }
  return points;
}

}  // namespace glissade::parts
