#include "solid/nesting.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/stop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace glissade::solid {
namespace {

constexpr std::size_t kMostPieces = 5'000;
constexpr std::size_t kMostSolidAngles = 200'000'000;

/// One piece: its facets and the box around them.
struct Piece {
  std::vector<std::uint32_t> facets;
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  void include(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] bool box_holds(Vec3 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
};

std::vector<Piece> gather(const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
                          const Pieces& pieces) {
  std::vector<Piece> gathered(pieces.volumes.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    Piece& piece = gathered[pieces.of_facet[i]];
    piece.facets.push_back(static_cast<std::uint32_t>(i));
    for (const std::uint32_t vertex : facets[i]) piece.include(positions[vertex]);
  }
  return gathered;
}

/// @return solid angle of a facet as seen from the origin, positive from inside (van Oosterom, Strackee 1983)
double solid_angle(Vec3 a, Vec3 b, Vec3 c) {
  const double la = std::sqrt(dot(a, a));
  const double lb = std::sqrt(dot(b, b));
  const double lc = std::sqrt(dot(c, c));
  return 2.0 *
         math::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Adds up how often pieces wind around points, within a bound of work.
class Winding {
 public:
  Winding(const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
          const std::vector<Piece>& pieces)
      : positions_(positions), facets_(facets), pieces_(pieces) {}

  /// @return windings of all pieces but one around a vertex of that one; none if the work is used up
  [[nodiscard]] std::optional<long> around(std::size_t piece) {
    const Vec3 point = positions_[facets_[pieces_[piece].facets.front()].front()];
    double angle = 0.0;
    for (std::size_t other = 0; other < pieces_.size(); ++other) {
      if (other == piece || !pieces_[other].box_holds(point)) continue;
      work_ += pieces_[other].facets.size();
      if (work_ > kMostSolidAngles) return std::nullopt;
      angle += angle_of(pieces_[other], point);
    }
    return std::lround(angle / (4.0 * std::numbers::pi));
  }

 private:
  [[nodiscard]] double angle_of(const Piece& piece, Vec3 point) const {
    double angle = 0.0;
    for (const std::uint32_t facet : piece.facets) {
      const auto& [a, b, c] = facets_[facet];
      angle += solid_angle(positions_[a] - point, positions_[b] - point, positions_[c] - point);
    }
    return angle;
  }

  const std::vector<Vec3>& positions_;
  const std::vector<FacetCorners>& facets_;
  const std::vector<Piece>& pieces_;
  std::size_t work_ = 0;
};

void add(std::size_t& count, std::optional<std::uint32_t>& first, std::size_t piece) {
  ++count;
  if (!first) first = static_cast<std::uint32_t>(piece);
}

}  // namespace

WrongPieces pieces_inside_out(const Pieces& pieces) {
  WrongPieces wrong;
  for (std::size_t i = 0; i < pieces.volumes.size(); ++i) {
    if (!(pieces.volumes[i] > 0.0)) add(wrong.inside_out, wrong.first_inside_out, i);
  }
  return wrong;
}

WrongPieces wrong_pieces(const std::vector<Vec3>& positions, const std::vector<FacetCorners>& facets,
                         const Pieces& pieces, const std::stop_token& stop) {
  if (pieces.volumes.size() == 1 || pieces.volumes.size() > kMostPieces) return pieces_inside_out(pieces);

  const std::vector<Piece> gathered = gather(positions, facets, pieces);
  Winding winding(positions, facets, gathered);
  WrongPieces wrong;
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    require_going(stop);
    const bool faces_outward = pieces.volumes[i] > 0.0;
    const std::optional<long> actual = winding.around(i);
    if (!actual) return pieces_inside_out(pieces);
    if (*actual == (faces_outward ? 0 : 1)) continue;
    // Within one that is inside out: that one is wrong.
    if (faces_outward && *actual < 0) continue;
    if (faces_outward) {
      add(wrong.nested, wrong.first_nested, i);
    } else {
      add(wrong.inside_out, wrong.first_inside_out, i);
    }
  }
  return wrong;
}

}  // namespace glissade::solid
