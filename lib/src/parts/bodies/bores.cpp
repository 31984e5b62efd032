#include "parts/bodies/bores.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/brep_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace glissade::parts {
namespace {

constexpr double kPi = std::numbers::pi;

/// Bernstein coefficients of a polynomial.
using Bernstein = std::vector<double>;

double choose(std::size_t n, std::size_t k) {
  double product = 1.0;
  for (std::size_t i = 0; i < k; ++i)
    product = product * static_cast<double>(n - i) / static_cast<double>(i + 1);
  return product;
}

Bernstein operator*(const Bernstein& a, const Bernstein& b) {
  const std::size_t m = a.size() - 1;
  const std::size_t n = b.size() - 1;
  Bernstein product(m + n + 1, 0.0);
  for (std::size_t i = 0; i <= m; ++i) {
    for (std::size_t k = 0; k <= n; ++k)
      product[i + k] += choose(m, i) * choose(n, k) / choose(m + n, i + k) * a[i] * b[k];
  }
  return product;
}

/// Gauss over the square of the radius, four points: exact for polynomials of degree 15 in the radius.
constexpr std::array<double, 4> kNodes = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                          0.9305681557970263};
constexpr std::array<double, 4> kWeights = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                            0.1739274225687269};
constexpr int kSpokes = 16;

}  // namespace

double Bore::rise(double at_depth, double x, double y) const {
  if (from_axis == 0.0) return at_depth;
  // The place's distance from the axis of the arc exceeds that of the plane through the hole's axis; faces are straight lines
  // in planes through the axis of the arc.
  double z = at_depth;
  constexpr int kRounds = 60;
  for (int k = 0; k < kRounds; ++k) {
    const double level = from_axis + y * grows_across + z * grows_into;
    const double next = at_depth - grows_into * (x * x / (math::hypot(level, x) + level));
    if (next == z) break;
    z = next;
  }
  return z;
}

BoreMoments moments(const Bore& bore) {
  double volume = 0.0;
  double x_moment = 0.0;
  double y_moment = 0.0;
  double z_moment = 0.0;
  for (std::size_t k = 0; k < kNodes.size(); ++k) {
    const double r = bore.radius * std::sqrt(kNodes[k]);
    const double weight = kWeights[k] * kPi * bore.radius * bore.radius / kSpokes;
    for (int i = 0; i < kSpokes; ++i) {
      const auto [sine, cosine] = math::sine_cosine(2.0 * kPi * (i + 0.5) / kSpokes);
      const double face = bore.rise(0.0, r * cosine, r * sine);
      const double back = bore.rise(bore.depth, r * cosine, r * sine);
      volume += weight * (back - face);
      x_moment += weight * (back - face) * r * cosine;
      y_moment += weight * (back - face) * r * sine;
      z_moment += weight * 0.5 * (back * back - face * face);
    }
  }
  return {volume, bore.centre + (1.0 / volume) *
                                    (x_moment * bore.along + y_moment * bore.across + z_moment * bore.into)};
}

double drilled_volume(double hole_radius, double thickness, double radius) {
  const double area = kPi * hole_radius * hole_radius;
  if (!std::isfinite(radius)) return area * thickness;
  // Integral of sqrt(R^2 - x^2) over the circle, R times the area times sum c_k m_k (hole / R)^2k: c_k of the root's series, m_k
  // the mean of (x / hole)^2k over the circle.
  // The first terms differ by the thickness.
  const auto beyond_first = [&](double cylinder) {
    const double square = hole_radius * hole_radius / (cylinder * cylinder);
    double root = 1.0;
    double mean = 1.0;
    double power = 1.0;
    double sum = 0.0;
    constexpr int kTerms = 200;
    for (int k = 1; k < kTerms; ++k) {
      root *= (k - 1.5) / k;
      mean *= (2.0 * k - 1.0) / (2.0 * k + 2.0);
      power *= square;
      const double term = root * mean * power;
      sum += term;
      if (std::fabs(term) < std::numeric_limits<double>::epsilon() * 1e-3) break;
    }
    return cylinder * sum;
  };
  return area * (thickness + beyond_first(radius + thickness) - beyond_first(radius));
}

double drilled_by_layers(const Bore& bore) {
  double volume = 0.0;
  for (std::size_t layer = 0; layer < kNodes.size(); ++layer) {
    const double depth = kNodes[layer] * bore.depth;
    for (std::size_t k = 0; k < kNodes.size(); ++k) {
      const double r = bore.radius * std::sqrt(kNodes[k]);
      const double weight =
          kWeights[layer] * bore.depth * kWeights[k] * kPi * bore.radius * bore.radius / kSpokes;
      for (int i = 0; i < kSpokes; ++i) {
        const auto [sine, cosine] = math::sine_cosine(2.0 * kPi * (i + 0.5) / kSpokes);
        const double x = r * cosine;
        const double y = r * sine;
        double slant =
            0.0;  // of the surface, as 1 minus the cosine of its angle to the plate at the hole's axis
        if (bore.from_axis != 0.0) {
          const double level =
              bore.from_axis + y * bore.grows_across + bore.rise(depth, x, y) * bore.grows_into;
          const double away = math::hypot(level, x);
          slant = bore.grows_into * bore.grows_into * (x * x / (away * (away + level)));
        }
        volume += weight / (1.0 - slant);
      }
    }
  }
  return volume;
}

PieceAt piece_at(const std::vector<PathPiece>& pieces, double place) {
  PieceAt at;
  while (at.piece + 1 < pieces.size() && place > at.begins + length(pieces[at.piece]))
    at.begins += length(pieces[at.piece++]);
  return at;
}

BoreLine first_edge(const SweptBody& body, std::size_t piece) {
  std::array<Vec2, 3> corners = {body.section.at(0), body.section.at(1), body.section.at(2)};
  constexpr double kLevel = 1e-12;  // [m]
  if (!body.shifts.empty() && std::fabs(corners[1].x - corners[0].x) > kLevel) {
    for (std::size_t j = 0; j < corners.size(); ++j) corners[j].y += body.shifts[piece][j];
  }
  const Vec2 way = corners[1] - corners[0];
  const Vec2 across = (1.0 / norm(way)) * way;
  const Vec2 into{-across.y, across.x};
  return {corners[0], across, dot(into, corners[2] - corners[1])};
}

Bore bore_at(const std::vector<PathPiece>& pieces, const Circle& hole, const BoreLine& line) {
  const auto [i, reached] = piece_at(pieces, hole.centre.x);
  const PathPiece& piece = pieces[i];
  const double share = (hole.centre.x - reached) / length(piece);
  const Vec2 at = point_on(piece, share);
  Vec2 tangent = start_tangent(piece);
  Bore bore;
  const Vec2 into{-line.across.y, line.across.x};  // (to the left of the path, along z)
  const double height = line.foot.x + hole.centre.y * line.across.x;
  if (!piece.straight()) {
    const CircularArc arc = arc_of(piece);
    const auto [sine, cosine] = math::sine_cosine(arc.sweep * share);
    tangent = {cosine * tangent.x - sine * tangent.y, sine * tangent.x + cosine * tangent.y};
    const double outward = piece.bulge > 0.0 ? -1.0 : 1.0;  // of the left side, from the axis
    bore.path_radius = arc.radius;
    bore.from_axis = arc.radius + outward * height;
    bore.grows_into = outward * into.x;
    bore.grows_across = outward * line.across.x;
  }
  const Vec2 left{-tangent.y, tangent.x};
  const auto in_space = [&](Vec2 pair) { return Vec3{pair.x * left.x, pair.x * left.y, pair.y}; };
  bore.centre = at_height(at, 0.0) + in_space(line.foot + hole.centre.y * line.across);
  bore.along = at_height(tangent, 0.0);
  bore.across = in_space(line.across);
  bore.into = in_space(into);
  bore.radius = hole.radius;
  bore.depth = line.thickness;
  bore.piece = i;
  return bore;
}

std::vector<Bore> bores_of(const SweptBody& body) {
  std::vector<Bore> bores;
  if (body.holes.empty()) return bores;
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  for (const Circle& hole : body.holes)
    bores.push_back(bore_at(pieces, hole, first_edge(body, piece_at(pieces, hole.centre.x).piece)));
  return bores;
}

std::vector<Bore> bores_of(const RolledSheet& sheet) {
  std::vector<Bore> bores;
  if (sheet.region.holes.empty()) return bores;
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  for (const Circle& hole : sheet.region.holes)
    bores.push_back(bore_at(pieces, hole, {sheet.foot, sheet.across, sheet.thickness}));
  return bores;
}

namespace {

/// A closed edge round a hole's axis, counter-clockwise about it.
std::size_t add_mouth(Brep& brep, const Bore& bore, double depth) {
  BrepEdge edge;
  edge.axis = bore.into;
  edge.reference = bore.along;
  edge.centre = bore.centre + depth * bore.into;
  edge.radius = bore.radius;
  edge.kind = CurveKind::circle;
  if (bore.from_axis != 0.0) {
    const double aside = bore.radius * std::numbers::sqrt2 / 2.0;
    edge.kind = CurveKind::mouth;
    edge.rise = bore.rise(depth, bore.radius, 0.0) - depth;
    // cos^2 sin is a quarter of the root of two where both are equal.
    edge.skew = std::numbers::sqrt2 * (bore.rise(depth, aside, aside) - bore.rise(depth, aside, -aside));
    if (edge.rise == 0.0 && edge.skew == 0.0) edge.kind = CurveKind::circle;
  }
  edge.from = add_vertex(brep, edge.centre + bore.radius * bore.along + edge.rise * bore.into);
  edge.to = edge.from;
  brep.edges.push_back(edge);
  return brep.edges.size() - 1;
}

}  // namespace

BoreLoops add_bore(Brep& brep, const Bore& bore) {
  const std::size_t face = add_mouth(brep, bore, 0.0);
  const std::size_t back = add_mouth(brep, bore, bore.depth);
  const std::size_t seam = add_line(brep, brep.edges[face].from, brep.edges[back].from);
  BrepFace wall;
  wall.kind = SurfaceKind::cylinder;
  wall.origin = bore.centre;
  wall.axis = bore.into;
  wall.reference = bore.along;
  wall.radius = bore.radius;
  wall.outward = false;
  wall.loops = {{{face, false}, {seam, true}, {back, true}, {seam, false}}};
  brep.faces.push_back(std::move(wall));
  return {{face, true}, {back, false}};
}

RationalCurve rational_mouth(const BrepEdge& edge) {
  const Vec3 across = cross(edge.axis, edge.reference);
  // Half a turn: (1 - 2t, 2t(1 - t)) over (1 - t)^2 + t^2, as a quadratic with no weight in its middle. Powers of it, raised by
  // one degree, have weights that are all positive.
  const Bernstein weight{1.0, 0.0, 1.0};
  const Bernstein none_more{1.0, 1.0};
  const Bernstein lift = edge.skew == 0.0 ? weight : weight * weight;
  const Bernstein weights = lift * weight * none_more;
  RationalCurve curve;
  curve.degree = weights.size() - 1;
  for (const double half : {1.0, -1.0}) {
    const Bernstein x{half, 0.0, -half};
    const Bernstein y{0.0, half, 0.0};
    const Bernstein xs = x * lift * none_more;
    const Bernstein ys = y * lift * none_more;
    Bernstein out = x * x;
    for (double& one : out) one *= edge.rise;
    if (edge.skew != 0.0) {
      const Bernstein skewed = x * x * y;
      out = out * weight;
      for (std::size_t k = 0; k < out.size(); ++k) out[k] += edge.skew * skewed[k];
    }
    out = out * none_more;
    for (std::size_t k = half > 0.0 ? 0 : 1; k <= curve.degree; ++k) {
      const double w = weights[k];
      curve.poles.push_back(edge.centre + (edge.radius * xs[k] / w) * edge.reference +
                            (edge.radius * ys[k] / w) * across + (out[k] / w) * edge.axis);
      // A common factor makes them short; it moves nothing.
      constexpr double kDigits = 1e12;
      curve.weights.push_back(std::round(w * static_cast<double>(curve.degree) * kDigits) / kDigits);
    }
  }
  return curve;
}

}  // namespace glissade::parts
