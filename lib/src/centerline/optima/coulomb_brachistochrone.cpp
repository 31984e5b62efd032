// Arc length of the fastest track: ds/dphi of coulomb_laws.cpp, integrated panel by panel in v = tan(phi/2),
// or 1/v beyond phi = pi/2, where it is a rational function times one square root. Panels are halved until
// Gauss quadrature is exact to rounding, then until a Chebyshev series in r = sqrt(s) gives v back.
#include "glissade/centerline/coulomb_brachistochrone.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include "centerline/numerics/chebyshev_series.hpp"
#include "centerline/optima/coulomb_laws.hpp"
#include "centerline/optima/endpoint_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {

using namespace centerline;

namespace {

/// A stretch of the track by its local half tangent v: tan(phi/2), or tan((pi - phi)/2) in the upper half,
/// where v falls from `first` to `last`.
struct Panel {
  double first = 0.0;
  double last = 0.0;
  bool upper_half = false;

  [[nodiscard]] double middle() const { return 0.5 * (first + last); }
  [[nodiscard]] Panel front() const { return {first, middle(), upper_half}; }
  [[nodiscard]] Panel back() const { return {middle(), last, upper_half}; }
};

double arc_slope(const CoulombShape& shape, double local, bool upper_half) {
  const double half_tangent = upper_half ? 1.0 / local : local;
  return arc_length_slope(shape, half_tangent) * 2.0 / (1.0 + local * local);
}

template <unsigned kPoints>
double arc_length(const CoulombShape& shape, const Panel& panel) {
  const auto slope = [&](double local) { return arc_slope(shape, local, panel.upper_half); };
  return boost::math::quadrature::gauss<double, kPoints>::integrate(slope, std::min(panel.first, panel.last),
                                                                    std::max(panel.first, panel.last));
}

// Enough for a panel of append_smooth_panels(), and for the step between neighbouring nodes within it.
constexpr unsigned kPanelPoints = 15;
constexpr unsigned kStepPoints = 7;

/// Appends panels that make up `panel`, each so short that Gauss quadrature over it is exact to rounding.
void append_smooth_panels(const CoulombShape& shape, const Panel& panel, std::vector<Panel>& panels,
                          int depth = 0) {
  // Halving a panel divides the error of 15-point quadrature by 2^30: the halves are far better than this.
  constexpr double kHalvesAgree = 1e-10;
  constexpr int kDeepest = 60;
  const double whole = arc_length<kPanelPoints>(shape, panel);
  const double halves =
      arc_length<kPanelPoints>(shape, panel.front()) + arc_length<kPanelPoints>(shape, panel.back());
  if (std::fabs(whole - halves) <= kHalvesAgree * halves || depth == kDeepest) {
    panels.push_back(panel.front());
    panels.push_back(panel.back());
    return;
  }
  append_smooth_panels(shape, panel.front(), panels, depth + 1);
  append_smooth_panels(shape, panel.back(), panels, depth + 1);
}

std::vector<Panel> smooth_panels(const CoulombShape& shape) {
  const double finish = shape.finish_phase_half_tangent;
  std::vector<Panel> panels;
  append_smooth_panels(shape, {0.0, std::min(finish, 1.0), false}, panels);
  if (finish > 1.0) append_smooth_panels(shape, {1.0, 1.0 / finish, true}, panels);
  return panels;
}

/// @return the local half tangent `distance` of arc length beyond rest.first, a small part of the panel;
///         `guess` is where to look first
double local_beyond(const CoulombShape& shape, const Panel& rest, double distance, double guess) {
  constexpr double kQuadraticallyConverged = 1e-8;  // its square is below rounding
  constexpr int kMostSteps = 20;
  const double low = std::min(rest.first, rest.last);
  const double high = std::max(rest.first, rest.last);
  const double direction = rest.upper_half ? -1.0 : 1.0;
  double local = std::clamp(guess, low, high);
  for (int step = 0; step < kMostSteps; ++step) {
    const double reached = arc_length<kStepPoints>(shape, {rest.first, local, rest.upper_half});
    const double change = direction * (distance - reached) / arc_slope(shape, local, rest.upper_half);
    local = std::clamp(local + change, low, high);
    if (std::fabs(change) <= kQuadraticallyConverged * local) break;
  }
  return local;
}

/// @return where the midpoint rule expects the local half tangent `distance` beyond rest.first > 0
double midpoint_guess(const CoulombShape& shape, const Panel& rest, double distance) {
  const double step = (rest.upper_half ? -1.0 : 1.0) * distance;
  const double low = std::min(rest.first, rest.last);
  const double high = std::max(rest.first, rest.last);
  const double middle = rest.first + 0.5 * step / arc_slope(shape, rest.first, rest.upper_half);
  return rest.first + step / arc_slope(shape, std::clamp(middle, low, high), rest.upper_half);
}

}  // namespace

/// Turns panels into pieces, halving those whose series does not converge to rounding.
class CoulombBrachistochrone::Tabulation {
 public:
  explicit Tabulation(const CoulombShape& shape) : shape_(shape) {
    for (const Panel& panel : smooth_panels(shape)) append(panel);
  }

  std::vector<Piece> pieces;
  double length = 0.0;

 private:
  void append(const Panel& panel) {
    const double end = length + arc_length<kPanelPoints>(shape_, panel);
    Piece piece;
    piece.first_root = std::sqrt(length);
    piece.last_root = std::sqrt(end);
    piece.first_half_tangent = panel.first;
    piece.last_half_tangent = panel.last;
    piece.upper_half = panel.upper_half;
    if (piece.last_root == piece.first_root) return;
    piece.coefficients = chebyshev_series(node_values(panel, piece));
    if (!piece.resolved()) {
      append(panel.front());
      append(panel.back());
      return;
    }
    pieces.push_back(piece);
    length = end;
  }

  /// Values of the series at its nodes: v, or v/r in the first piece, where both vanish together.
  [[nodiscard]] std::array<double, kTerms> node_values(const Panel& panel, const Piece& piece) const {
    std::array<double, kTerms> values{};
    Panel rest = panel;
    double rest_root = piece.first_root;
    for (std::size_t j = kTerms; j-- > 0;) {
      const double root = piece.root_at(node_cosines<kTerms>()[1][j]);
      const double distance = (root - rest_root) * (root + rest_root);
      const double guess =
          rest.first == 0.0 ? panel.last * (root / piece.last_root) : midpoint_guess(shape_, rest, distance);
      const double local = local_beyond(shape_, rest, distance, guess);
      values[j] = panel.first == 0.0 ? local / root : local;
      rest.first = local;
      rest_root = root;
    }
    return values;
  }

  const CoulombShape& shape_;
};

double CoulombBrachistochrone::Piece::root_at(double position) const {
  return 0.5 * ((first_root + last_root) + position * (last_root - first_root));
}

bool CoulombBrachistochrone::Piece::resolved() const {
  constexpr double kNegligible = 2e-15;
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double tail = std::max(std::fabs(coefficients[kTerms - 1]), std::fabs(coefficients[kTerms - 2]));
  // Where v changes fast, as near the cusp of a flat track, one rounding of r already moves it by this much.
  const double rounding =
      4.0 * kEpsilon * last_root * 2.0 * std::fabs(coefficients[1]) / (last_root - first_root);
  return tail <= kNegligible * std::fabs(coefficients[0]) + rounding;
}

double CoulombBrachistochrone::Piece::half_tangent(double root) const {
  const double position = ((root - first_root) - (last_root - root)) / (last_root - first_root);
  const double value = chebyshev_value(coefficients, position);
  if (first_root == 0.0) return value * root;
  // v is monotone: where rounding of r moves the series past an end of the piece, that end is nearer the
  // truth.
  const auto [low, high] = std::minmax(first_half_tangent, last_half_tangent);
  const double local = std::clamp(value, low, high);
  return upper_half ? 1.0 / local : local;
}

CoulombBrachistochrone::CoulombBrachistochrone(const Endpoints& endpoints, Friction friction, double gravity)
    : solution_(solve_coulomb_brachistochrone(endpoints, friction, gravity)) {
  if (solution_.shape.scale == 0.0) {
    length_ = endpoints.drop;
    return;
  }
  Tabulation table(solution_.shape);
  length_ = table.length;
  pieces_ = std::move(table.pieces);
}

double CoulombBrachistochrone::phase_half_tangent(double s) const {
  const double root = std::sqrt(s);
  const auto piece = std::lower_bound(pieces_.begin(), pieces_.end() - 1, root,
                                      [](const Piece& left, double value) { return left.last_root < value; });
  return std::min(piece->half_tangent(root), solution_.shape.finish_phase_half_tangent);
}

CenterlinePoint CoulombBrachistochrone::at(double s) const {
  require_on_track(s);
  if (pieces_.empty()) return {s, 0.0, s, kRightAngle, 0.0};
  const CoulombState state = coulomb_state(solution_, phase_half_tangent(s));
  return {s, state.x, state.drop, state.slope_angle, state.curvature};
}

double CoulombBrachistochrone::slope_angle(double s) const {
  require_on_track(s);
  if (pieces_.empty()) return kRightAngle;
  return coulomb_slope_angle(solution_.shape, phase_half_tangent(s));
}

Direction CoulombBrachistochrone::direction(double s) const {
  require_on_track(s);
  if (pieces_.empty()) return {kRightAngle, 0.0};
  const double half_tangent = phase_half_tangent(s);
  return {coulomb_slope_angle(solution_.shape, half_tangent),
          coulomb_curvature(solution_.shape, half_tangent)};
}

double CoulombBrachistochrone::arc_length_at_slope_angle(Angle slope_angle) const {
  const double half_tangent = half_tangent_at_slope_angle(solution_, slope_angle.radians());
  const bool upper_half = half_tangent > 1.0;
  const double local = upper_half ? 1.0 / half_tangent : half_tangent;
  const auto holds = [&](const Piece& piece) {
    if (piece.upper_half != upper_half) return false;
    return upper_half ? local >= piece.last_half_tangent : local <= piece.last_half_tangent;
  };
  const auto piece = std::find_if(pieces_.begin(), pieces_.end() - 1, holds);
  const double beyond =
      arc_length<kPanelPoints>(solution_.shape, {piece->first_half_tangent, local, upper_half});
  return std::min(piece->first_root * piece->first_root + beyond, length_);
}

CoulombState CoulombBrachistochrone::state_at(double s) const {
  require_on_track(s);
  if (!pieces_.empty()) return coulomb_state(solution_, phase_half_tangent(s));
  const double speed = std::sqrt(2.0 * solution_.gravity * s);
  return {kRightAngle, 0.0, s, 0.0, speed, speed / solution_.gravity};
}

}  // namespace glissade
