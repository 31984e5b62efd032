#include "optimize/discretise/guess.hpp"

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

/// ds/dzeta of the frictional brachistochrone with exit slope angle zeta_1, for scale C = 1.
double arc_per_angle(double zeta, double zeta_1, double mu) {
  const auto [sine, cosine] = math::sine_cosine(zeta);
  const double t1 = math::tan(zeta_1);
  const double q2 = 1.0 - mu * mu + 2.0 * mu * t1;
  // E cos^2, so that the vertical start stays finite.
  const double lean = sine - mu * cosine;
  const double e = lean * lean + q2 * cosine * cosine;
  const double bracket = e * cosine + 4.0 * mu * cosine * cosine * (sine - t1 * cosine);
  return bracket / (e * e * e);
}

/// The curve for one exit angle as a table from the start, unscaled.
struct Arc {
  Vector s, zeta;
  double x = 0.0;
  double y = 0.0;
};

Arc trace(double zeta_1, double mu, int steps) {
  Arc arc;
  const double turn = kRightAngle - zeta_1;
  double s = 0.0;
  arc.s.push_back(0.0);
  arc.zeta.push_back(kRightAngle);
  for (int i = 0; i < steps; ++i) {
    const auto angle = [&](double share) { return kRightAngle - turn * share; };
    const double from = static_cast<double>(i) / steps;
    const double to = static_cast<double>(i + 1) / steps;
    constexpr double kOffset = 0.3872983346207417;                       // Gauss-Legendre, 3 nodes; theory
    constexpr double kShare[3] = {0.5 - kOffset, 0.5, 0.5 + kOffset};    // theory
    constexpr double kWeight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};  // theory
    for (int k = 0; k < 3; ++k) {
      const double zeta = angle(from + (to - from) * kShare[k]);
      const double ds = kWeight[k] * turn * (to - from) * arc_per_angle(zeta, zeta_1, mu);
      s += ds;
      const auto [sine, cosine] = math::sine_cosine(zeta);
      arc.x += ds * cosine;
      arc.y += ds * sine;
    }
    arc.s.push_back(s);
    arc.zeta.push_back(angle(to));
  }
  return arc;
}

}  // namespace

double GuessCurve::slope_angle(double at) const {
  const auto above = std::upper_bound(sigma.begin(), sigma.end(), at);
  if (above == sigma.begin()) return zeta.front();
  if (above == sigma.end()) return zeta.back();
  const auto i = static_cast<std::size_t>(above - sigma.begin());
  const double share = (at - sigma[i - 1]) / (sigma[i] - sigma[i - 1]);
  return zeta[i - 1] + share * (zeta[i] - zeta[i - 1]);
}

GuessCurve brachistochrone_guess(double run, double drop, double mu) {
  constexpr int kSteps = 400;  // taste
  const CoulombSolution exact =
      solve_coulomb_brachistochrone({run, drop}, Friction::from_coefficient(mu), 1.0);
  const Arc arc = trace(exact.exit_slope_angle.radians(), mu, kSteps);
  const double scale = math::hypot(run, drop) / math::hypot(arc.x, arc.y);
  GuessCurve guess;
  guess.length = arc.s.back() * scale;
  guess.zeta = arc.zeta;
  const double q2 = 1.0 - mu * mu + 2.0 * mu * math::tan(exact.exit_slope_angle.radians());
  for (const double zeta : arc.zeta) {
    const auto [sine, cosine] = math::sine_cosine(zeta);
    const double lean = sine - mu * cosine;
    guess.speed.push_back(cosine / (lean * lean + q2 * cosine * cosine));
  }
  for (const double s : arc.s) guess.sigma.push_back(s / arc.s.back());
  return guess;
}

Vector graded_knots(const GuessCurve& curve, std::size_t pieces, double entry_length) {
  // A quadratic slope angle errs by h^3 zeta'''; travel time weighs its square by 1/u. Equal
  // shares of the error need a density of knots ~ (zeta'''^2/u)^(1/7).
  const std::size_t n = curve.sigma.size();
  Vector density(n - 1, 0.0);
  const auto slope = [&](std::size_t i) {
    return (curve.zeta[i + 1] - curve.zeta[i]) / (curve.sigma[i + 1] - curve.sigma[i]);
  };
  const auto middle = [&](std::size_t i) { return 0.5 * (curve.sigma[i] + curve.sigma[i + 1]); };
  Vector second(n - 1, 0.0);
  for (std::size_t i = 1; i + 2 < n; ++i) {
    const double left = (slope(i) - slope(i - 1)) / (middle(i) - middle(i - 1));
    const double right = (slope(i + 1) - slope(i)) / (middle(i + 1) - middle(i));
    second[i] = (right - left) / (0.5 * (middle(i + 1) - middle(i - 1)));
  }
  second[0] = n > 3 ? second[1] : 0.0;
  second[n - 2] = n > 3 ? second[n - 3] : 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double speed = curve.speed.empty() ? std::sqrt(middle(i) + entry_length)
                                             : 0.5 * (curve.speed[i] + curve.speed[i + 1]);
    density[i] = math::pow(second[i] * second[i] / speed, 1.0 / 7.0);
    mean += density[i] * (curve.sigma[i + 1] - curve.sigma[i]);
  }
  constexpr double kEvenShare = 0.05;  // taste
  Vector total(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    total[i + 1] =
        total[i] + (density[i] + kEvenShare * (mean + 1e-3)) * (curve.sigma[i + 1] - curve.sigma[i]);
  }
  Vector knots(pieces + 1, 0.0);
  std::size_t at = 0;
  for (std::size_t k = 1; k < pieces; ++k) {
    const double wanted = total.back() * static_cast<double>(k) / static_cast<double>(pieces);
    while (total[at + 1] < wanted) ++at;
    const double share = (wanted - total[at]) / (total[at + 1] - total[at]);
    knots[k] = curve.sigma[at] + share * (curve.sigma[at + 1] - curve.sigma[at]);
  }
  knots[pieces] = 1.0;
  return knots;
}

namespace {

/// Of knots that turn at a joint with a straight the slope angle hardly tells: there the curvature is none on one side, and
/// on the other that of what follows. But where the curve has a kink there, they have it too.
void set_joints(const Mesh& mesh, const Layout& layout, Vector& z) {
  constexpr double kNarrow = 1e-5;  // taste: ten times a piece of a joint
  constexpr double kKink = 0.05;    // taste: [rad], more than curvature turns there that has a bound
  const std::size_t pieces = mesh.knots.size() - 1;
  const auto is_narrow = [&](std::size_t piece) {
    return mesh.knots[piece + 1] - mesh.knots[piece] < kNarrow;
  };
  std::size_t from = 0;
  while (from < pieces && is_narrow(from)) ++from;
  std::size_t to = pieces;
  while (to > from && is_narrow(to - 1)) --to;
  if (from == to) return;
  const auto turned = [&](std::size_t first, std::size_t last) {
    double angle = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      angle += 0.5 * (z[layout.turn(i)] + z[layout.turn(i + 1)]) * (mesh.knots[i + 1] - mesh.knots[i]);
    }
    return std::fabs(angle);
  };
  if (mesh.lead_in > 0.0 && turned(0, from) < kKink) {
    for (std::size_t i = 0; i < from; ++i) z[layout.turn(i)] = i == 0 ? 0.0 : z[layout.turn(from)];
  }
  if (mesh.lead_out > 0.0 && turned(to, pieces) < kKink) {
    for (std::size_t i = to + 1; i <= pieces; ++i) z[layout.turn(i)] = i == pieces ? 0.0 : z[layout.turn(to)];
  }
}

}  // namespace

Vector fit(const GuessCurve& curve, const Transcription& track) {
  const Layout& layout = track.layout();
  const std::size_t n = layout.length();  // the length itself is not fitted
  const std::vector<Station>& stations = track.stations();
  Vector weights(stations.size(), 0.0);
  Vector right(layout.size(), 0.0);
  for (std::size_t i = 1; i < stations.size(); ++i) {
    if (stations[i].part != Part::core) continue;
    // Travel time weighs an error of the angle by 1/u ~ s^(-1/2), and r is s^(1/2).
    weights[i] = std::sqrt(stations[i].sigma) - std::sqrt(stations[i - 1].sigma);
    track.add_dzeta(i, weights[i] * curve.slope_angle(stations[i].sigma), right.data());
  }
  const Matrix gram = track.gram_of_dzeta(weights);
  Matrix normal(n, n);
  for (std::size_t j = 0; j < n; ++j) std::copy_n(gram.row(j), n, normal.row(j));
  Vector diagonal(n);
  for (std::size_t j = 0; j < n; ++j) diagonal[j] = normal(j, j);
  const ShiftedCholesky factor(normal, diagonal);
  factor.forward(right.data());
  factor.backward(right.data());
  right[n] = curve.length;
  set_joints(track.mesh(), layout, right);
  return right;
}

}  // namespace glissade::optimizer
