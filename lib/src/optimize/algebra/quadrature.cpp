#include "optimize/algebra/quadrature.hpp"

#include "glissade/core/math.hpp"

#include <cmath>
#include <numbers>

namespace glissade::optimizer {
namespace {

struct Legendre {
  std::array<double, kNodes + 2> value{};
};

Legendre legendre(double t) {
  Legendre p;
  p.value[0] = 1.0;
  p.value[1] = t;
  for (std::size_t k = 1; k + 1 < p.value.size(); ++k) {
    const double degree = static_cast<double>(k);
    p.value[k + 1] = ((2.0 * degree + 1.0) * t * p.value[k] - degree * p.value[k - 1]) / (degree + 1.0);
  }
  return p;
}

PanelRule make_rule() {
  PanelRule rule;
  const double n = static_cast<double>(kNodes);
  std::array<double, kNodes> t{};
  std::array<double, kNodes> w{};
  for (std::size_t i = 0; i < kNodes; ++i) {
    double root = -math::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 60; ++step) {
      const Legendre p = legendre(root);
      slope = n * (root * p.value[kNodes] - p.value[kNodes - 1]) / (root * root - 1.0);
      const double change = p.value[kNodes] / slope;
      root -= change;
      if (std::fabs(change) < 1e-16) break;
    }
    t[i] = root;
    w[i] = 2.0 / ((1.0 - root * root) * slope * slope);
  }
  // The interpolant's Legendre coefficients are (2k + 1)/2 sum_j w_j P_k(t_j) f_j, exact below degree n.
  for (std::size_t i = 0; i < kNodes; ++i) {
    rule.node[i] = 0.5 * (1.0 + t[i]);
    rule.weight[i] = 0.5 * w[i];
    const Legendre at = legendre(t[i]);
    for (std::size_t j = 0; j < kNodes; ++j) {
      const Legendre from = legendre(t[j]);
      double sum = 0.5 * (t[i] + 1.0);
      for (std::size_t k = 1; k < kNodes; ++k) {
        sum += 0.5 * from.value[k] * (at.value[k + 1] - at.value[k - 1]);
      }
      rule.to_node[i][j] = 0.5 * w[j] * sum;
    }
  }
  return rule;
}

}  // namespace

const PanelRule& panel_rule() {
  static const PanelRule rule = make_rule();
  return rule;
}

}  // namespace glissade::optimizer
