#include "glissade/core/arc_path.hpp"
#include "glissade/core/math.hpp"

#include "core/arc_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace glissade {
namespace {

bool finite(const ArcPath& path) {
  return std::all_of(path.vertices.begin(), path.vertices.end(), [](const PathVertex& vertex) {
    return std::isfinite(vertex.at.x) && std::isfinite(vertex.at.y) && std::isfinite(vertex.bulge);
  });
}

Vec2 turned(Vec2 way, double angle) {
  const auto [sine, cosine] = math::sine_cosine(angle);
  return {cosine * way.x - sine * way.y, sine * way.x + cosine * way.y};
}

/// Whether the second of two neighbours goes on ahead of their corner, and the first one stays behind it: neither turns by a right
/// angle, and the corner less than one. Where circles hardly differ, rounding would have them meet again close to it.
bool leads_on(const PathPiece& before, const PathPiece& after) {
  constexpr double kEighth = 0.4;  // just less than tan(pi/8), of a quarter of a circle
  if (!(std::fabs(before.bulge) < kEighth && std::fabs(after.bulge) < kEighth)) return false;
  const Vec2 comes = turned(before.to - before.from, 2.0 * math::atan(before.bulge));
  const Vec2 goes = turned(after.to - after.from, -2.0 * math::atan(after.bulge));
  return dot(comes, goes) > 0.0;
}

/// Neighbours share a corner; whether they meet anywhere else, or run back over each other.
bool neighbours_clash(const PathPiece& before, const PathPiece& after, double nearness) {
  if (leads_on(before, after)) return false;
  const std::vector<Vec2> places = core::meetings(before, after);
  const bool elsewhere = std::any_of(places.begin(), places.end(), [&](Vec2 place) {
    return norm(place - before.to) > nearness && norm(place - after.to) > nearness;
  });
  const Vec2 back = before.from - before.to;
  const Vec2 on = after.to - after.from;
  const bool runs_back = before.straight() && after.straight() && dot(back, on) > 0.0 &&
                         std::fabs(cross(back, on)) <= nearness * std::max(norm(back), norm(on));
  return elsewhere || runs_back;
}

bool meets_itself(const ArcPath& path, double nearness) {
  std::vector<PathPiece> pieces = pieces_of(path);
  // Circles that are straight to far below the nearness have no middle to reckon with.
  for (PathPiece& piece : pieces) {
    if (std::fabs(piece.bulge) * norm(piece.to - piece.from) < 1e-3 * nearness) piece.bulge = 0.0;
  }
  std::vector<PlaneBox> boxes;
  boxes.reserve(pieces.size());
  for (const PathPiece& piece : pieces) boxes.push_back(core::bounds_of(piece));
  const std::size_t count = pieces.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      if (core::gap(boxes[i], boxes[k]) > nearness) continue;
      const bool next = k == i + 1;
      const bool first_and_last = i == 0 && k + 1 == count;
      if (next && first_and_last) continue;  // two pieces round the whole figure
      const bool clash = next             ? neighbours_clash(pieces[i], pieces[k], nearness)
                         : first_and_last ? neighbours_clash(pieces[k], pieces[i], nearness)
                                          : distance(pieces[i], pieces[k]) <= nearness;
      if (clash) return true;
    }
  }
  return false;
}

void add_faults_of_path(const ArcPath& path, const std::string& name, std::vector<std::string>& faults) {
  if (!path.closed) faults.push_back(name + " is open");
  if (path.vertices.size() < 2) {
    faults.push_back(name + " has " + std::to_string(path.vertices.size()) + " corners");
    return;
  }
  const PlaneBox box = bounds(path);
  const double nearness = 1e-9 * std::max(box.width(), box.height());
  const std::vector<PathPiece> pieces = pieces_of(path);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string where = name + ", piece " + std::to_string(i + 1) + ",";
    if (norm(pieces[i].to - pieces[i].from) <= nearness) faults.push_back(where + " has no length");
  }
  if (meets_itself(path, nearness)) faults.push_back(name + " meets itself");
  if (!(std::fabs(signed_area(path)) > nearness * nearness)) faults.push_back(name + " has no area");
}

}  // namespace

std::vector<std::string> faults_of(const PlaneRegion& region) {
  std::vector<std::string> faults;
  std::vector<std::pair<std::string, ArcPath>> inner;
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    inner.emplace_back("cutout " + std::to_string(i + 1), region.cutouts[i]);
  }
  bool all_finite = finite(region.outline);
  for (const auto& [name, path] : inner) all_finite = all_finite && finite(path);
  for (std::size_t i = 0; i < region.holes.size(); ++i) {
    const Circle& hole = region.holes[i];
    const std::string name = "hole " + std::to_string(i + 1);
    all_finite = all_finite && std::isfinite(hole.centre.x + hole.centre.y + hole.radius);
    if (!(hole.radius > 0.0)) faults.push_back(name + " has no radius");
    inner.emplace_back(name, path_of(hole));
  }
  if (!all_finite) return {"a coordinate is not a finite number"};
  add_faults_of_path(region.outline, "the outline", faults);
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    add_faults_of_path(region.cutouts[i], inner[i].first, faults);
  }
  if (!faults.empty()) return faults;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const auto& [name, path] = inner[i];
    if (distance(path, region.outline) == 0.0 || !contains(region.outline, path.vertices.front().at)) {
      faults.push_back(name + " reaches outside the outline");
    }
    for (std::size_t k = 0; k < i; ++k) {
      const auto& [other_name, other] = inner[k];
      if (distance(path, other) == 0.0 || contains(other, path.vertices.front().at) ||
          contains(path, other.vertices.front().at)) {
        faults.push_back(name);
        faults.back().append(" touches ").append(other_name);
      }
    }
  }
  return faults;
}

}  // namespace glissade
