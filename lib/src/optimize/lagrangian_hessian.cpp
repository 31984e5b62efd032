// The Hessian of a Lagrangian over the stations of a transcription: what each section adds is gathered over the
// five vectors that its stations share, and spread over all unknowns once a section.

#include "optimize/quadrature.hpp"
#include "optimize/transcription.hpp"

#include <algorithm>
#include <utility>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kNodes = PanelRule::kNodes;

constexpr LocalRow kOfLength = {0.0, 0.0, 0.0, 0.0, 1.0};

}  // namespace

void Transcription::add_square(LocalMatrix& matrix, double factor, const LocalRow& a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += factor * a[i] * a[j];
  }
}

void Transcription::add_pair(LocalMatrix& matrix, double factor, const LocalRow& a, const LocalRow& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += factor * (a[i] * b[j] + a[j] * b[i]);
  }
}

void Transcription::add_shape_parts(const Vector& z, const Shape& shape, const StationWeights& weights,
                                    std::vector<LocalMatrix>& parts) const {
  const PanelRule& rule = panel_rule();
  const double length = z[layout_.length()];
  double later_x = 0.0;
  double later_y = 0.0;
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    LocalMatrix& part = parts[panel.section];
    const double scale = panel.scale(length);
    const std::size_t end = panel.first + kNodes;
    later_x += weights.x[end];
    later_y += weights.y[end];
    for (std::size_t k = 0; k < kNodes; ++k) {
      const std::size_t at = panel.first + k;
      double sum_x = rule.weight[k] * later_x;
      double sum_y = rule.weight[k] * later_y;
      for (std::size_t q = 0; q < kNodes; ++q) {
        sum_x += rule.to_node[q][k] * weights.x[panel.first + q];
        sum_y += rule.to_node[q][k] * weights.y[panel.first + q];
      }
      sum_x *= panel.ds[k];
      sum_y *= panel.ds[k];
      const LocalRow& dz = local_dzeta_[at];
      add_square(part, -scale * (shape.cos[at] * sum_x + shape.sin[at] * sum_y), dz);
      if (panel.by_length == 0.0) continue;
      add_pair(part, panel.by_length * (-shape.sin[at] * sum_x + shape.cos[at] * sum_y), kOfLength, dz);
    }
    for (std::size_t q = 0; q < kNodes; ++q) {
      later_x += weights.x[panel.first + q];
      later_y += weights.y[panel.first + q];
    }
  }
}

void Transcription::add_exponent(LocalMatrix& part, double mu, const Ride& ride, const Flow& flow,
                                 std::size_t station, double by_v) const {
  const LocalRow& dv = flow.dv.local[station];
  const LocalRow& dz = local_dzeta_[station];
  add_pair(part, 2.0 * mu * by_v, dz, dv);
  add_square(part, -4.0 * mu * mu * by_v * flow.v[station], dz);
  if (ride.drag == 0.0) return;
  const double reach = 2.0 * ride.drag * stations_[station].by_length;
  add_pair(part, -reach * by_v, kOfLength, dv);
  add_pair(part, 2.0 * mu * reach * by_v * flow.v[station], kOfLength, dz);
  add_square(part, -reach * reach * by_v * flow.v[station], kOfLength);
}

// v = e^phi w with phi = 2 mu zeta - 2 k s, w' = drive e^-phi. phi is linear in the unknowns:
// d2v = e^phi d2w + dv dphi + dphi dv - v dphi dphi, dphi = 2 mu dzeta - 2 k ds/dL e_L. Where friction changes v goes
// on, and w = v e^-phi begins anew.
void Transcription::add_flow_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                                   const StationWeights& weights, std::size_t index,
                                   std::vector<LocalMatrix>& parts) const {
  const PanelRule& rule = panel_rule();
  const double length = z[layout_.length()];
  const double drag = ride.drag;
  double later = 0.0;  // dL/dv at the end of the panel, of everything behind it
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    LocalMatrix& part = parts[panel.section];
    const double scale = panel.scale(length);
    const double mu = ride.friction_in(panel.zone);
    double by_v_at_end = 0.0;
    if (p + 1 < panels_.size() && panels_[p + 1].zone != panel.zone) {
      const double behind = ride.friction_in(panels_[p + 1].zone);
      add_exponent(part, behind, ride, flow, panel.first + kNodes, -later);
      by_v_at_end = std::exchange(later, 0.0);
    }
    double by_w[kNodes + 1] = {};  // w as counted from the start of the panel
    for (std::size_t q = 0; q <= kNodes; ++q) {
      const std::size_t at = panel.first + q;
      double by_v = weights.v[index][at] + (q == kNodes ? by_v_at_end : 0.0);
      const LocalRow& dv = flow.dv.local[at];
      if (q < kNodes && weights.time[index] != 0.0) {
        const Slowness slow = slowness(flow.v[at], slowest(ride, at));
        const double timed = weights.time[index] * rule.weight[q] * panel.ds[q];
        by_v += scale * timed * slow.first;
        add_square(part, scale * timed * slow.second, dv);
        if (panel.by_length != 0.0) add_pair(part, panel.by_length * timed * slow.first, kOfLength, dv);
      }
      if (by_v == 0.0) continue;
      add_exponent(part, mu, ride, flow, at, by_v);
      by_w[q] = by_v * flow.growth[at];
    }
    later = later * flow.growth[panel.first + kNodes] + by_w[kNodes];
    for (std::size_t k = 0; k < kNodes; ++k) {
      const std::size_t at = panel.first + k;
      double sum = rule.weight[k] * later;
      for (std::size_t q = 0; q < kNodes; ++q) sum += rule.to_node[q][k] * by_w[q];
      if (sum == 0.0) continue;
      sum *= panel.ds[k] / flow.growth[at];
      const LocalRow& dz = local_dzeta_[at];
      const double drive = 2.0 * (shape.sin[at] - mu * shape.cos[at]);
      const double drive1 = 2.0 * (shape.cos[at] + mu * shape.sin[at]);
      const double f1 = drive1 - 2.0 * mu * drive;
      add_square(part, scale * sum * (-drive - 4.0 * mu * drive1 + 4.0 * mu * mu * drive), dz);
      const double reach = 2.0 * drag * stations_[at].by_length;
      const double own = panel.by_length;
      add_pair(part, sum * f1 * (own + scale * reach), kOfLength, dz);
      add_square(part, 2.0 * sum * drive * reach * (own + 0.5 * scale * reach), kOfLength);
    }
    for (std::size_t q = 0; q < kNodes; ++q) later += by_w[q];
  }
  // What the body brings along: w = v_0 e^(-2 mu zeta_0).
  const double mu = ride.friction_in(panels_[0].zone);
  add_square(parts[stations_[0].section], later * 4.0 * mu * mu * ride.entry_speed2, local_dzeta_[0]);
}

void Transcription::expand(const LocalMatrix& matrix, std::size_t section, const double* own,
                           Matrix& hessian) const {
  const std::size_t n = layout_.size();
  const std::size_t piece = sections_[section].piece;
  const double* zeta = dzeta_starts_.row(section);
  const auto entry = [&](std::size_t i, std::size_t j) { return i >= j ? matrix[i][j] : matrix[j][i]; };
  Vector product(n);
  const auto times = [&](std::size_t i) {
    std::fill(product.begin(), product.end(), 0.0);
    LocalRow row{};
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = entry(i, j);
    expand(row, section, own, product.data());
  };
  const auto add_outer = [&](const double* vector) {
    for (std::size_t i = 0; i < n; ++i) {
      if (vector[i] != 0.0) add_scaled(hessian.row(i), vector[i], product.data(), i + 1);
    }
  };
  if (own != nullptr) {
    times(kOwn);
    add_outer(own);
  }
  times(kZeta);
  add_outer(zeta);
  const std::size_t unknown[] = {layout_.turn(piece), layout_.turn(piece + 1), layout_.length()};
  for (std::size_t k = 0; k < 3; ++k) {
    times(kFirst + k);
    add_scaled(hessian.row(unknown[k]), 1.0, product.data(), unknown[k] + 1);
  }
}

Matrix Transcription::hessian(const Vector& z, const Shape& shape, const std::vector<Ride>& rides,
                              const std::vector<Flow>& flows, const StationWeights& weights) const {
  const std::size_t n = layout_.size();
  Matrix h(n, n);
  // What has no part in the flow goes with the first one.
  for (std::size_t r = 0; r < rides.size(); ++r) {
    std::vector<LocalMatrix> parts(sections_.size(), LocalMatrix{});
    if (r == 0) {
      add_shape_parts(z, shape, weights, parts);
      for (std::size_t i = 0; i < stations_.size(); ++i) {
        if (weights.zeta_zeta[i] == 0.0) continue;
        add_square(parts[stations_[i].section], weights.zeta_zeta[i], local_dzeta_[i]);
      }
    }
    const Flow& flow = flows[r];
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (weights.v_v[r][i] == 0.0) continue;
      add_square(parts[stations_[i].section], weights.v_v[r][i], flow.dv.local[i]);
    }
    if (rides[r].sliding_point()) {
      add_flow_parts(z, shape, rides[r], flow, weights, r, parts);
    } else {
      add_law_parts(z, shape, rides[r], flow, weights, r, parts);
    }
    for (std::size_t s = 0; s < sections_.size(); ++s) expand(parts[s], s, flow.dv.starts.row(s), h);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) h(j, i) = h(i, j);
  }
  return h;
}

Matrix Transcription::gram_of_dzeta(const Vector& weights) const {
  const std::size_t n = layout_.size();
  Matrix gram(n, n);
  std::vector<LocalMatrix> parts(sections_.size(), LocalMatrix{});
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    add_square(parts[stations_[i].section], weights[i], local_dzeta_[i]);
  }
  for (std::size_t s = 0; s < sections_.size(); ++s) expand(parts[s], s, nullptr, gram);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) gram(j, i) = gram(i, j);
  }
  return gram;
}

}  // namespace glissade::optimizer
