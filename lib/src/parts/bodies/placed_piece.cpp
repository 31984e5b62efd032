#include "parts/bodies/placed_piece.hpp"

#include "parts/bodies/body_edges.hpp"

#include <algorithm>
#include <limits>

namespace glissade::parts {

Vec3 in_own(const Frame& place, Vec3 point) {
  const Vec3 from = point - place.origin;
  return {dot(from, place.x), dot(from, place.y), dot(from, place.z)};
}

bool PlacedPiece::near(Vec3 own, double room) const {
  const auto within = [&](double value, double least, double most) {
    return value >= least - room && value <= most + room;
  };
  return within(own.x, low.x, high.x) && within(own.y, low.y, high.y) && within(own.z, low.z, high.z);
}

std::vector<PlacedPiece> placed_pieces(const Workshop& workshop) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<PlacedPiece> pieces;
  for (const ShopPart& part : workshop.parts) {
    PlacedPiece piece{&part, {}, {kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
    for (const Vec3 point : edge_points(part.body, 0.0)) {
      piece.low = {std::min(piece.low.x, point.x), std::min(piece.low.y, point.y),
                   std::min(piece.low.z, point.z)};
      piece.high = {std::max(piece.high.x, point.x), std::max(piece.high.y, point.y),
                    std::max(piece.high.z, point.z)};
    }
    for (const Frame& place : part.places) {
      piece.place = place;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

}  // namespace glissade::parts
