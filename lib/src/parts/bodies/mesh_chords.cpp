#include "parts/bodies/mesh_chords.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/body_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace glissade::parts {

Index count_of(const TriangleMesh& mesh) {
  return static_cast<Index>(mesh.vertices.size());
}

void add_quad(TriangleMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

int chords_of(double sweep, double radius, const Fineness& fineness) {
  const double cosine = std::clamp(1.0 - fineness.sagitta / radius, -1.0, 1.0);
  const double widest = std::min(2.0 * math::acos(cosine), kTurn / fineness.round_corners);
  return std::max(1, static_cast<int>(std::ceil(std::fabs(sweep) / widest - 1e-9)));
}

int chords_of(const PathPiece& piece, const Fineness& fineness) {
  if (piece.straight()) return 1;
  const CircularArc arc = arc_of(piece);
  return chords_of(arc.sweep, arc.radius, fineness);
}

std::vector<Vec2> corners_of(const ArcPath& path, const Fineness& fineness) {
  std::vector<Vec2> corners;
  for (const PathPiece& piece : pieces_of(path)) {
    const int chords = chords_of(piece, fineness);
    corners.push_back(piece.from);
    for (int i = 1; i < chords; ++i) corners.push_back(point_on(piece, static_cast<double>(i) / chords));
  }
  return corners;
}

void run(std::vector<Vec2>& loop, bool counter_clockwise) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  if ((twice > 0.0) != counter_clockwise) std::reverse(loop.begin(), loop.end());
}

void sort_apart(std::vector<double>& places) {
  constexpr double kSamePlace = 1e-9;
  std::sort(places.begin(), places.end());
  std::vector<double> apart;
  for (const double place : places) {
    if (apart.empty() || place - apart.back() > kSamePlace) apart.push_back(place);
  }
  places = std::move(apart);
}

ChordEnds::ChordEnds(const std::vector<PathPiece>& pieces, double reach, const Fineness& fineness) {
  starts_ = {0.0};
  for (const PathPiece& piece : pieces) {
    int chords = 1;
    if (!piece.straight()) {
      const CircularArc arc = arc_of(piece);
      chords = chords_of(arc.sweep, arc.radius + reach, fineness);
    }
    const double whole = length(piece);
    for (int k = 0; k < chords; ++k) places_.push_back(starts_.back() + whole * k / chords);
    starts_.push_back(starts_.back() + whole);
  }
  places_.push_back(starts_.back());
}

void ChordEnds::leave_out(const std::vector<Circle>& holes, const std::vector<Bore>& bores) {
  if (holes.empty()) return;
  std::vector<std::array<double, 2>> spans;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const Bore& bore = bores[i];
    // Nearer to the axis of an arc than the path is, a hole takes more of it.
    const double least = std::min(bore.from_axis, bore.from_axis + bore.depth * bore.grows_into) -
                         bore.radius * std::fabs(bore.grows_across);
    const double stretch = bore.from_axis == 0.0 ? 1.0 : bore.path_radius / least;
    const double half = kRoomOfHole * stretch * bore.radius;
    spans.push_back({holes[i].centre.x - half, holes[i].centre.x + half});
  }
  std::sort(spans.begin(), spans.end());
  std::vector<std::array<double, 2>> apart;
  for (const auto& span : spans) {
    if (!apart.empty() && span[0] <= apart.back()[1])
      apart.back()[1] = std::max(apart.back()[1], span[1]);
    else
      apart.push_back(span);
  }
  for (const auto& span : apart) {
    std::erase_if(places_, [&](double place) {
      const bool joint = std::find(starts_.begin(), starts_.end(), place) != starts_.end();
      return !joint && place > span[0] && place < span[1];
    });
    places_.insert(places_.end(), span.begin(), span.end());
  }
  std::sort(places_.begin(), places_.end());
}

void ChordEnds::add(const SweptWindow& window) {
  constexpr double kSame = 1e-7;  // [m]
  for (const double end : {window.from, window.to}) {
    std::erase_if(places_, [&](double place) {
      const bool joint = std::find(starts_.begin(), starts_.end(), place) != starts_.end();
      return !joint && std::fabs(place - end) < kSame;
    });
    places_.push_back(end);
  }
  std::sort(places_.begin(), places_.end());
}

}  // namespace glissade::parts
