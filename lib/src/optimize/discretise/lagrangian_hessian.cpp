// The Hessian of a Lagrangian over the stations of a transcription: what each section adds is gathered over the
// five vectors that its stations share, and told over those of the section before it, up to the start.

#include "optimize/algebra/four.hpp"
#include "optimize/algebra/quadrature.hpp"
#include "optimize/discretise/transcription.hpp"

#include <algorithm>
#include <utility>

namespace glissade::optimizer {

void Transcription::add_square(LocalMatrix& matrix, double factor, const LocalRow& a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += factor * a[i] * a[j];
  }
}

void Transcription::add_pair(LocalMatrix& matrix, double factor, const LocalRow& a, const LocalRow& b) {
  // Four entries of each row at once, of the upper triangle too, which nobody reads.
  Four left, right;
  load(left, a.data());
  load(right, b.data());
  for (std::size_t i = 0; i < a.size(); ++i) {
    Four sum;
    load(sum, matrix[i].data());
    sum += factor * (a[i] * right + left * b[i]);
    store(sum, matrix[i].data());
  }
  matrix[kLength][kLength] += factor * (a[kLength] * b[kLength] + a[kLength] * b[kLength]);
}

void Transcription::add_turning(LocalMatrix& matrix, double square, double with_length, const LocalRow& dz) {
  const double first = dz[kFirst];
  const double second = dz[kSecond];
  matrix[kZeta][kZeta] += square;
  matrix[kFirst][kZeta] += square * first;
  matrix[kFirst][kFirst] += square * first * first;
  matrix[kSecond][kZeta] += square * second;
  matrix[kSecond][kFirst] += square * first * second;
  matrix[kSecond][kSecond] += square * second * second;
  matrix[kLength][kZeta] += with_length;
  matrix[kLength][kFirst] += with_length * first;
  matrix[kLength][kSecond] += with_length * second;
}

GLISSADE_WIDE_VARIANT void Transcription::add_terms(LocalMatrix& matrix, const StationTerms& terms,
                                                    const LocalRow& dv, const LocalRow& dz) {
  // All that goes together with dv in one go.
  LocalRow with_v = dv;
  for (double& entry : with_v) entry *= 0.5 * terms.v_v;
  for (const std::size_t j : {kZeta, kFirst, kSecond}) with_v[j] += terms.v_zeta * dz[j];
  with_v[kLength] += terms.v_length;
  add_pair(matrix, 1.0, dv, with_v);
  add_turning(matrix, terms.zeta_zeta, terms.zeta_length, dz);
  matrix[kLength][kLength] += terms.length_length;
}

void Transcription::add_shape_parts(const Vector& z, const Shape& shape, const StationWeights& weights,
                                    std::vector<LocalMatrix>& parts) const {
  const PanelRule& rule = panel_rule();
  double later_x = 0.0;
  double later_y = 0.0;
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    LocalMatrix& part = parts[panel.section];
    const double scale = scale_of(panel, z);
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
      add_turning(part, -scale * (shape.cos[at] * sum_x + shape.sin[at] * sum_y),
                  panel.by_length * (-shape.sin[at] * sum_x + shape.cos[at] * sum_y), local_dzeta_[at]);
    }
    for (std::size_t q = 0; q < kNodes; ++q) {
      later_x += weights.x[panel.first + q];
      later_y += weights.y[panel.first + q];
    }
  }
}

void Transcription::add_exponent(StationTerms& terms, double mu, const Ride& ride, double v, double by_length,
                                 double by_v) {
  terms.v_zeta += 2.0 * mu * by_v;
  terms.zeta_zeta -= 4.0 * mu * mu * by_v * v;
  if (ride.drag == 0.0) return;
  const double reach = 2.0 * ride.drag * by_length;
  terms.v_length -= reach * by_v;
  terms.zeta_length += 2.0 * mu * reach * by_v * v;
  terms.length_length -= reach * reach * by_v * v;
}

// v = e^phi w with phi = 2 mu zeta - 2 k s, w' = drive e^-phi. phi is linear in the unknowns:
// d2v = e^phi d2w + dv dphi + dphi dv - v dphi dphi, dphi = 2 mu dzeta - 2 k ds/dL e_L. Where friction changes, and
// where another span begins, v goes on, and w = v e^-phi begins anew.
GLISSADE_WIDE_VARIANT void Transcription::add_flow_parts(const Vector& z, const Shape& shape,
                                                         const Ride& ride, const Flow& flow,
                                                         const StationWeights& weights, std::size_t index,
                                                         std::vector<LocalMatrix>& parts) const {
  const PanelRule& rule = panel_rule();
  const double drag = ride.drag;
  double later = 0.0;  // dL/dv at the end of the panel, of everything behind it
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    LocalMatrix& part = parts[panel.section];
    const double scale = scale_of(panel, z);
    const double mu = ride.friction_in(panel.zone);
    double by_v_at_end = 0.0;
    std::array<StationTerms, kNodes + 1> terms{};
    const Panel& next = panels_[std::min(p + 1, panels_.size() - 1)];
    if (next.zone != panel.zone || next.span != panel.span) {
      const std::size_t end = panel.first + kNodes;
      const double by_length = next.span == panel.span ? stations_[end].by_length : 0.0;
      add_exponent(terms[kNodes], ride.friction_in(next.zone), ride, flow.v[end], by_length, -later);
      by_v_at_end = std::exchange(later, 0.0);
    }
    double by_w[kNodes + 1] = {};  // w as counted from the start of the panel
    for (std::size_t q = 0; q <= kNodes; ++q) {
      const std::size_t at = panel.first + q;
      double by_v = weights.v[index][at] + (q == kNodes ? by_v_at_end : 0.0);
      if (q < kNodes && weights.time[index] != 0.0) {
        const Slowness slow = slowness(flow.v[at], slowest(ride, at));
        const double timed = weights.time[index] * rule.weight[q] * panel.ds[q];
        by_v += scale * timed * slow.first;
        terms[q].v_v += scale * timed * slow.second;
        terms[q].v_length += panel.by_length * timed * slow.first;
      }
      if (by_v == 0.0) continue;
      add_exponent(terms[q], mu, ride, flow.v[at], stations_[at].by_length, by_v);
      by_w[q] = by_v * flow.growth[at];
    }
    later = later * flow.growth[panel.first + kNodes] + by_w[kNodes];
    for (std::size_t k = 0; k < kNodes; ++k) {
      const std::size_t at = panel.first + k;
      double sum = rule.weight[k] * later;
      for (std::size_t q = 0; q < kNodes; ++q) sum += rule.to_node[q][k] * by_w[q];
      if (sum == 0.0) continue;
      sum *= panel.ds[k] / flow.growth[at];
      const double drive = 2.0 * (shape.sin[at] - mu * shape.cos[at]);
      const double drive1 = 2.0 * (shape.cos[at] + mu * shape.sin[at]);
      const double f1 = drive1 - 2.0 * mu * drive;
      terms[k].zeta_zeta += scale * sum * (-drive - 4.0 * mu * drive1 + 4.0 * mu * mu * drive);
      const double reach = 2.0 * drag * stations_[at].by_length;
      const double own = panel.by_length;
      terms[k].zeta_length += sum * f1 * (own + scale * reach);
      terms[k].length_length += 2.0 * sum * drive * reach * (own + 0.5 * scale * reach);
    }
    for (std::size_t q = 0; q <= kNodes; ++q)
      add_terms(part, terms[q], flow.dv.local[panel.first + q], local_dzeta_[panel.first + q]);
    for (std::size_t q = 0; q < kNodes; ++q) later += by_w[q];
  }
  // What the body brings along: w = v_0 e^(-2 mu zeta_0).
  const double mu = ride.friction_in(panels_[0].zone);
  add_square(parts[stations_[0].section], later * 4.0 * mu * mu * ride.entry_speed2, local_dzeta_[0]);
}

/// What sections add to a Hessian, gathered from the last one to the first. Where a section begins, all behind it is
/// told by a form over three vectors, those of its quantity, of the slope angle and of the length, and by how the unknowns
/// behind go together with them: as these three are sums of the same of the section before, each section costs no more
/// than one row of the Hessian.
class Transcription::LaterSections {
 public:
  LaterSections(std::size_t unknowns, Matrix& upper) : upper_(upper) {
    for (Vector& cross : cross_) cross.assign(unknowns, 0.0);
  }

  /// The turning rates, and the lengths of spans, that sections from one on depend on.
  struct KnownBehind {
    std::size_t turn = 0;      ///< turning rates from here ...
    std::size_t turn_end = 0;  ///< ... to here,
    std::size_t length = 0;    ///< and lengths from here on ...
    std::size_t end = 0;       ///< ... to here
    template <class Visitor>
    void visit(const Visitor& visitor) const {
      for (std::size_t j = turn; j < turn_end; ++j) visitor(j);
      for (std::size_t j = length; j < end; ++j) visitor(j);
    }
  };

  /// The sections so far begin a span: what they know of its length is told of that unknown.
  void end_span(std::size_t length, const KnownBehind& known) {
    Vector& with_length = cross_[2];
    known.visit([&](std::size_t j) { add(length, j, std::exchange(with_length[j], 0.0)); });
    upper_(length, length) += std::exchange(form_[2][2], 0.0);
    for (std::size_t i = 0; i < 2; ++i) cross_[i][length] += std::exchange(form_[2][i], 0.0);
  }

  /// What is told over the vectors of a section is told over those of the section before it.
  /// @param own,zeta    where the section ends, over the vectors of the section before
  /// @param first       the unknown of the turning rate at the first knot of the section before
  /// @param known  the unknowns that the sections so far depend on
  void tell_by(const LocalRow& own, const LocalRow& zeta, std::size_t first, const KnownBehind& known) {
    const std::array<LocalRow, 3> by = {own, zeta, kOfLength};
    LocalMatrix before{};
    for (std::size_t i = 0; i < kShared; ++i) {
      for (std::size_t j = 0; j < kShared; ++j) {
        const double factor = form_[i >= j ? i : j][i >= j ? j : i];
        for (std::size_t a = 0; a < own.size(); ++a) {
          for (std::size_t b = 0; b <= a; ++b) before[a][b] += factor * by[i][a] * by[j][b];
        }
      }
    }
    known.visit([&](std::size_t j) {
      const double of_own = cross_[0][j];
      const double of_zeta = cross_[1][j];
      const double to_first = of_own * own[kFirst] + of_zeta * zeta[kFirst];
      const double to_second = of_own * own[kSecond] + of_zeta * zeta[kSecond];
      cross_[0][j] = of_own * own[kOwn];
      cross_[1][j] = of_own * own[kZeta] + of_zeta * zeta[kZeta];
      cross_[2][j] += of_own * own[kLength] + of_zeta * zeta[kLength];
      add(first, j, to_first);
      add(first + 1, j, to_second);
    });
    form_ = {};
    add_section(before, first);
  }

  /// Adds what a section that begins here adds itself.
  void add_section(const LocalMatrix& part, std::size_t first) {
    upper_(first, first) += part[kFirst][kFirst];
    upper_(first, first + 1) += part[kSecond][kFirst];
    upper_(first + 1, first + 1) += part[kSecond][kSecond];
    for (std::size_t i = 0; i < kShared; ++i) {
      for (std::size_t j = 0; j <= i; ++j) form_[i][j] += part[kVector[i]][kVector[j]];
      cross_[i][first] += entry(part, kFirst, kVector[i]);
      cross_[i][first + 1] += entry(part, kSecond, kVector[i]);
    }
  }

  /// Where the track begins.
  /// @param vectors  that of the quantity, that of the slope angle, and the unit vector of the length
  void add_start(const std::array<const double*, 3>& vectors) {
    const std::size_t n = upper_.columns();
    Vector product(n);
    for (std::size_t i = 0; i < kShared; ++i) {
      // Half of the form, and all that goes together with the unknowns: both are added to either side.
      product = cross_[i];
      for (std::size_t j = 0; j < kShared; ++j)
        add_scaled(product.data(), 0.5 * form_[i >= j ? i : j][i >= j ? j : i], vectors[j], n);
      for (std::size_t k = 0; k < n; ++k) {
        const double share = vectors[i][k];
        if (share == 0.0) continue;
        for (std::size_t j = 0; j < n; ++j) add(k, j, share * product[j]);
      }
    }
  }

 private:
  static constexpr std::size_t kShared = 3;  // theory: as told above
  static constexpr std::array<std::size_t, kShared> kVector = {kOwn, kZeta, kLength};  // theory

  [[nodiscard]] static double entry(const LocalMatrix& matrix, std::size_t i, std::size_t j) {
    return i >= j ? matrix[i][j] : matrix[j][i];
  }
  /// + value (e_i e_j^T + e_j e_i^T)
  void add(std::size_t i, std::size_t j, double value) {
    upper_(std::min(i, j), std::max(i, j)) += i == j ? 2.0 * value : value;
  }

  std::array<LocalRow, kShared> form_{};  ///< lower triangle
  std::array<Vector, kShared> cross_;     ///< by unknown
  Matrix& upper_;
};

void Transcription::expand(const std::vector<LocalMatrix>& parts, const Derivatives* own,
                           Matrix& upper) const {
  const std::size_t n = layout_.size();
  LaterSections later(n, upper);
  std::vector<std::size_t> ends(sections_.size(), 0);
  for (std::size_t i = 0; i < stations_.size(); ++i) ends[stations_[i].section] = i;
  const std::size_t end = layout_.turn(layout_.knots);
  for (std::size_t s = sections_.size(); s-- > 0;) {
    const std::size_t first = layout_.turn(sections_[s].piece);
    if (s + 1 < sections_.size()) {
      const LocalRow by_own = own != nullptr ? own->local[ends[s]] : LocalRow{};
      const Section& behind = sections_[s + 1];
      const bool is_other = behind.span != sections_[s].span;
      LaterSections::KnownBehind known{layout_.turn(behind.piece), end, layout_.length(behind.span + 1), n};
      if (is_other) {
        later.end_span(layout_.length(behind.span), known);
        --known.length;
      }
      later.tell_by(by_own, local_dzeta_[ends[s]], first, known);
    }
    later.add_section(parts[s], first);
  }
  Vector of_length(n, 0.0);
  of_length[layout_.length()] = 1.0;
  const Vector none(n, 0.0);
  later.add_start(
      {own != nullptr ? own->starts.row(0) : none.data(), dzeta_starts_.row(0), of_length.data()});
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
        add_turning(parts[stations_[i].section], weights.zeta_zeta[i], 0.0, local_dzeta_[i]);
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
    expand(parts, &flow.dv, h);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) h(i, j) = h(j, i);
  }
  return h;
}

Matrix Transcription::gram_of_dzeta(const Vector& weights) const {
  const std::size_t n = layout_.size();
  Matrix gram(n, n);
  std::vector<LocalMatrix> parts(sections_.size(), LocalMatrix{});
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    add_turning(parts[stations_[i].section], weights[i], 0.0, local_dzeta_[i]);
  }
  expand(parts, nullptr, gram);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) gram(i, j) = gram(j, i);
  }
  return gram;
}

}  // namespace glissade::optimizer
