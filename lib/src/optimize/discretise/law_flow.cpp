// Speed and time of bodies that are not the sliding point, by collocation of docs/theory.md (M2) at the nodes of
// each panel, and the derivatives of that very collocation: forward through its linearised equations, and
// backward for the Hessian. Where c does not depend on the speed and no wind blows the equations are linear and
// one step of Newton's method solves them.

#include "glissade/core/math.hpp"

#include "optimize/algebra/quadrature.hpp"
#include "optimize/discretise/transcription.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

using NodeValues = std::array<double, kNodes>;
using NodeMatrix = std::array<NodeValues, kNodes>;

// What a law or the wind asks for at lower speeds is continued by its second-order Taylor polynomial: below this
// share of the squared speed at which a law ends, and below this squared speed where wind blows.
constexpr double kContinued = 0.25;  // taste: below where a ride ends it is never reported
constexpr double kStill = 1e-6;      // theory: what counts as lying still
constexpr int kMostSteps = 30;       // budget

/// A function of v and its derivatives, continued below a floor.
struct Term {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;

  [[nodiscard]] Term continued(double by) const {
    return {value + by * (first + 0.5 * by * second), first + by * second, second};
  }
};

/// D(v): drag over k.
Term dragged(double v, double wind) {
  if (wind == 0.0) return {v, 1.0, 0.0};
  const double at = std::max(v, kStill);
  const double u = std::sqrt(at);
  const double sign = u + wind < 0.0 ? -1.0 : 1.0;
  const Term term{sign * (u + wind) * (u + wind), sign * (1.0 + wind / u), -0.5 * sign * wind / (u * at)};
  return term.continued(v - at);
}

/// v where a ride enters, and its derivatives by the slope angle there: V1^2 r |r| with r what the impact leaves.
Term entry_v(const Ride& ride, double slope_angle) {
  if (!ride.landing) return {ride.entry_speed2, 0.0, 0.0};
  const double theta = ride.landing->angle.radians() - slope_angle;
  const double left = math::cos(theta) - ride.friction * math::sin(theta);
  const double first = math::sin(theta) + ride.friction * math::cos(theta);
  const double v = ride.landing->speed * ride.landing->speed;
  const double sign = left < 0.0 ? -1.0 : 1.0;
  return {v * left * std::fabs(left), 2.0 * v * std::fabs(left) * first,
          2.0 * v * sign * (first * first - left * left)};
}

/// (M2) at one place: dv/ds and its derivatives by slope angle, curvature, v and arc length.
struct Slope {
  double value = 0.0;
  double zeta = 0.0, curvature = 0.0, v = 0.0, s = 0.0;
  double zeta_zeta = 0.0, zeta_curvature = 0.0, zeta_v = 0.0, curvature_v = 0.0, v_v = 0.0;
  double s_zeta = 0.0, s_curvature = 0.0, s_v = 0.0, s_s = 0.0;
};

struct Place {
  double friction = 0.0;
  double sin = 0.0;
  double cos = 0.0;
  double curvature = 0.0;
  double s = 0.0;
};

Slope slope_at(const Ride& ride, const Place& at, double v) {
  const double h = ride.height;
  const double mu = at.friction;
  Resistance c;
  if (ride.law) {
    const double floor = std::max(v, kContinued * ride.law->least_v(at.s));
    c = ride.law->resistance(at.s, floor);
    const Term by_v = Term{c.factor, c.by_v, c.by_v_v}.continued(v - floor);
    c.factor = by_v.value;
    c.by_v = by_v.first;
    c.by_s += (v - floor) * c.by_s_v;
  }
  const Term drag = dragged(v, ride.head_wind);
  const double path = 1.0 - at.curvature * h;
  const double driven = at.sin - ride.drag * drag.value;
  const double pressing = path * at.cos + at.curvature * v;
  const double pressing_by_curvature = v - h * at.cos;
  const double g = ride.gain;
  Slope slope;
  slope.value = g * (path * driven - mu * c.factor * pressing);
  slope.zeta = g * path * (at.cos + mu * c.factor * at.sin);
  slope.curvature = -g * (h * driven + mu * c.factor * pressing_by_curvature);
  slope.v = -g * (path * ride.drag * drag.first + mu * (c.by_v * pressing + c.factor * at.curvature));
  slope.s = -g * mu * c.by_s * pressing;
  slope.zeta_zeta = g * path * (mu * c.factor * at.cos - at.sin);
  slope.zeta_curvature = -g * h * (at.cos + mu * c.factor * at.sin);
  slope.zeta_v = g * mu * c.by_v * path * at.sin;
  slope.curvature_v = g * (h * ride.drag * drag.first - mu * (c.by_v * pressing_by_curvature + c.factor));
  slope.v_v =
      -g * (path * ride.drag * drag.second + mu * (c.by_v_v * pressing + 2.0 * c.by_v * at.curvature));
  slope.s_zeta = g * mu * c.by_s * path * at.sin;
  slope.s_curvature = -g * mu * c.by_s * pressing_by_curvature;
  slope.s_v = -g * mu * (c.by_s_v * pressing + c.by_s * at.curvature);
  slope.s_s = -g * mu * c.by_s_s * pressing;
  return slope;
}

/// (I - A diag(factor))^-1 with A the panel's integration matrix: how nodes answer to what is added at them.
NodeMatrix response(const NodeValues& factor) {
  const PanelRule& rule = panel_rule();
  NodeMatrix matrix{};
  NodeMatrix inverse{};
  for (std::size_t q = 0; q < kNodes; ++q) {
    for (std::size_t k = 0; k < kNodes; ++k) matrix[q][k] = -rule.to_node[q][k] * factor[k];
    matrix[q][q] += 1.0;
    inverse[q][q] = 1.0;
  }
  for (std::size_t column = 0; column < kNodes; ++column) {
    std::size_t pivot = column;
    for (std::size_t q = column + 1; q < kNodes; ++q) {
      if (std::fabs(matrix[q][column]) > std::fabs(matrix[pivot][column])) pivot = q;
    }
    std::swap(matrix[pivot], matrix[column]);
    std::swap(inverse[pivot], inverse[column]);
    const double scale = 1.0 / matrix[column][column];
    for (std::size_t k = 0; k < kNodes; ++k) {
      matrix[column][k] *= scale;
      inverse[column][k] *= scale;
    }
    for (std::size_t q = 0; q < kNodes; ++q) {
      const double share = matrix[q][column];
      if (q == column || share == 0.0) continue;
      for (std::size_t k = 0; k < kNodes; ++k) {
        matrix[q][k] -= share * matrix[column][k];
        inverse[q][k] -= share * inverse[column][k];
      }
    }
  }
  return inverse;
}

/// A panel whose nodes' speeds are known.
struct Solved {
  NodeValues v{};
  std::array<Slope, kNodes> slopes;
  NodeMatrix response{};
};

/// @param ds  of the nodes, in full
Solved solve(const Ride& ride, const std::array<Place, kNodes>& places, const NodeValues& ds,
             double v_start) {
  const PanelRule& rule = panel_rule();
  Solved solved;
  solved.v.fill(v_start);
  for (int step = 0; step < kMostSteps; ++step) {
    NodeValues factor{};
    for (std::size_t k = 0; k < kNodes; ++k) {
      solved.slopes[k] = slope_at(ride, places[k], solved.v[k]);
      factor[k] = ds[k] * solved.slopes[k].v;
    }
    solved.response = response(factor);
    NodeValues missing{};
    for (std::size_t q = 0; q < kNodes; ++q) {
      missing[q] = v_start - solved.v[q];
      for (std::size_t k = 0; k < kNodes; ++k)
        missing[q] += rule.to_node[q][k] * ds[k] * solved.slopes[k].value;
    }
    double moved = 0.0;
    double size = 0.0;
    for (std::size_t q = 0; q < kNodes; ++q) {
      double change = 0.0;
      for (std::size_t k = 0; k < kNodes; ++k) change += solved.response[q][k] * missing[k];
      solved.v[q] += change;
      moved = std::max(moved, std::fabs(change));
      size = std::max(size, std::fabs(solved.v[q]));
    }
    // From here on a step of Newton's method gains nothing but rounding.
    if (moved <= 1e-15 * size) break;
  }
  for (std::size_t k = 0; k < kNodes; ++k) solved.slopes[k] = slope_at(ride, places[k], solved.v[k]);
  return solved;
}

void add_row(LocalRow& out, double factor, const LocalRow& a) {
  for (std::size_t j = 0; j < a.size(); ++j) out[j] += factor * a[j];
}

/// Derivatives of v at a panel's nodes and its end: nodes dv = R (dv_start + A b), end dv_start + w (b + ds F_v dv).
/// @param source  b, what each node's ds F changes by at fixed v
/// @param dv      of the nodes and the end behind them
void differentiate(const Solved& solved, const NodeValues& ds, const LocalRow& dv_start,
                   const std::array<LocalRow, kNodes>& source, LocalRow* dv) {
  const PanelRule& rule = panel_rule();
  LocalRow& dv_end = dv[kNodes];
  dv_end = dv_start;
  std::array<LocalRow, kNodes> added;
  for (std::size_t i = 0; i < kNodes; ++i) {
    added[i] = dv_start;
    for (std::size_t k = 0; k < kNodes; ++k) add_row(added[i], rule.to_node[i][k], source[k]);
  }
  for (std::size_t q = 0; q < kNodes; ++q) {
    dv[q] = {};
    for (std::size_t i = 0; i < kNodes; ++i) add_row(dv[q], solved.response[q][i], added[i]);
    add_row(dv_end, rule.weight[q], source[q]);
    add_row(dv_end, rule.weight[q] * ds[q] * solved.slopes[q].v, dv[q]);
  }
}

}  // namespace

LocalRow Transcription::dcurvature(const Vector& z, std::size_t index, double curvature) const {
  const Station& station = stations_[index];
  if (station.part != Part::core) return {};
  const double stretch = this->stretch(z, station.piece);
  const double by_length = stretches(station.piece) ? -curvature / stretch : 0.0;
  return {0.0, 0.0, (1.0 - station.share) / stretch, station.share / stretch, by_length};
}

std::optional<double> Transcription::steady_curvature(const Vector& z, const Shape& shape, const Ride& ride,
                                                      std::size_t station, double v) const {
  // dv/ds is linear in the curvature.
  const Place straight{ride.friction_in(stations_[station].zone), shape.sin[station], shape.cos[station], 0.0,
                       arc_length(z, stations_[station])};
  const Slope slope = slope_at(ride, straight, v);
  if (!(slope.curvature < 0.0)) return std::nullopt;
  return -slope.value / slope.curvature;
}

void Transcription::enter(const Shape& shape, const Ride& ride, Flow& out) const {
  const Term entry = entry_v(ride, shape.zeta[0]);
  out.v[0] = entry.value;
  if (out.dv.empty()) return;
  add_dzeta(0, entry.first, out.dv.starts.row(0));
  out.dv.local[0][kOwn] = 1.0;
}

void Transcription::law_flow_through(const Vector& z, const Shape& shape, const Ride& ride, std::size_t p,
                                     Flow& out, LocalRow* by_time) const {
  const PanelRule& rule = panel_rule();
  const Panel& panel = panels_[p];
  const std::size_t start = start_station(p);
  const double scale = scale_of(panel, z);
  const double mu = ride.friction_in(panel.zone);
  std::array<Place, kNodes> places;
  NodeValues ds{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    const std::size_t at = panel.first + k;
    places[k] = {mu, shape.sin[at], shape.cos[at], shape.curvature[at], arc_length(z, stations_[at])};
    ds[k] = scale * panel.ds[k];
  }
  const Solved solved = solve(ride, places, ds, out.v[start]);
  const std::size_t end = panel.first + kNodes;
  out.v[end] = out.v[start];
  std::array<LocalRow, kNodes> bend;
  std::array<LocalRow, kNodes> source{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    const std::size_t at = panel.first + k;
    const Slope& slope = solved.slopes[k];
    out.v[at] = solved.v[k];
    out.v[end] += rule.weight[k] * ds[k] * slope.value;
    bend[k] = dcurvature(z, at, places[k].curvature);
    add_row(source[k], ds[k] * slope.zeta, local_dzeta_[at]);
    add_row(source[k], ds[k] * slope.curvature, bend[k]);
    source[k][kLength] +=
        ds[k] * slope.s * stations_[at].by_length + panel.by_length * panel.ds[k] * slope.value;
  }
  if (by_time != nullptr) {
    differentiate(solved, ds, at_start(p, out.dv), source, &out.dv.local[panel.first]);
  }
  for (std::size_t q = 0; q < kNodes; ++q) {
    const std::size_t at = panel.first + q;
    const Slowness slow = pace_of(ride, out.v[at], slowest(ride, at));
    const double path = 1.0 - places[q].curvature * ride.height;
    const double part = rule.weight[q] * ds[q];
    out.time += part * path * slow.value;
    if (by_time == nullptr) continue;
    add_row(*by_time, part * path * slow.first, out.dv.local[at]);
    (*by_time)[kLength] += panel.by_length * rule.weight[q] * panel.ds[q] * path * slow.value;
    add_row(*by_time, -part * ride.height * slow.value, bend[q]);
  }
}

// Of one panel: what its nodes are like, and how strongly L depends on them.
struct Transcription::LawPanel {
  std::array<Slope, kNodes> slopes;
  std::array<Slowness, kNodes> slow;
  NodeValues path{};        ///< 1 - kappa h
  NodeValues factor{};      ///< d(ds F)/dv
  NodeValues timed{};       ///< weight of the time, but for the panel's scale
  NodeValues multiplier{};  ///< dL/dv, through the later nodes and the end too
};

Transcription::LawPanel Transcription::law_panel(const Vector& z, const Shape& shape, const Ride& ride,
                                                 const Flow& flow, const StationWeights& weights,
                                                 std::size_t index, std::size_t p, double by_end) const {
  const PanelRule& rule = panel_rule();
  const Panel& panel = panels_[p];
  const double scale = scale_of(panel, z);
  const double mu = ride.friction_in(panel.zone);
  LawPanel law;
  NodeValues by_v{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    const std::size_t at = panel.first + k;
    const Place place{mu, shape.sin[at], shape.cos[at], shape.curvature[at], arc_length(z, stations_[at])};
    law.slopes[k] = slope_at(ride, place, flow.v[at]);
    law.slow[k] = pace_of(ride, flow.v[at], slowest(ride, at));
    law.factor[k] = scale * panel.ds[k] * law.slopes[k].v;
    law.path[k] = 1.0 - place.curvature * ride.height;
    law.timed[k] = weights.time[index] * rule.weight[k] * panel.ds[k];
    by_v[k] = weights.v[index][at] + scale * law.timed[k] * law.path[k] * law.slow[k].first +
              law.factor[k] * rule.weight[k] * by_end;
  }
  const NodeMatrix responding = response(law.factor);
  for (std::size_t q = 0; q < kNodes; ++q) {
    for (std::size_t k = 0; k < kNodes; ++k) law.multiplier[q] += responding[k][q] * by_v[k];
  }
  return law;
}

// With theta = dL/d(ds F), the multiplier of the collocation at a node, L's second derivative there is theta d2(ds F) and
// the direct terms.
void Transcription::add_law_node(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                                 const LawPanel& law, std::size_t p, std::size_t k, double theta,
                                 LocalMatrix& part) const {
  const Panel& panel = panels_[p];
  const std::size_t at = panel.first + k;
  const Slope& slope = law.slopes[k];
  const Slowness& slow = law.slow[k];
  const LocalRow& dv = flow.dv.local[at];
  const LocalRow& dz = local_dzeta_[at];
  const double scale = scale_of(panel, z);
  const double full = theta * scale;
  const double timed = law.timed[k];
  add_square(part, full * slope.zeta_zeta, dz);
  add_pair(part, full * slope.zeta_v, dz, dv);
  add_square(part, full * slope.v_v + scale * timed * law.path[k] * slow.second, dv);

  // Everything that meets the length: the panel's ds by it, and s.
  const double by_length = stations_[at].by_length;
  const double own = panel.by_length * theta;
  const double own_time = panel.by_length * timed;
  const double by_s = full * by_length;
  LocalRow with_length{};
  add_row(with_length, own * slope.zeta + by_s * slope.s_zeta, dz);
  add_row(with_length, own * slope.v + own_time * law.path[k] * slow.first + by_s * slope.s_v, dv);
  with_length[kLength] += own * slope.s * by_length + 0.5 * by_s * by_length * slope.s_s;

  // Curvature: with zeta and v, and c/L by itself.
  const LocalRow bend = dcurvature(z, at, shape.curvature[at]);
  const double itself = full * slope.curvature - scale * timed * ride.height * slow.value;
  const double with_v = full * slope.curvature_v - scale * timed * ride.height * slow.first;
  const std::size_t piece = stations_[at].piece;
  const double by_stretch = stretches(piece) ? itself / stretch(z, piece) : 0.0;
  add_pair(part, full * slope.zeta_curvature, bend, dz);
  add_pair(part, with_v, bend, dv);
  add_row(with_length,
          own * slope.curvature - own_time * ride.height * slow.value + by_s * slope.s_curvature - by_stretch,
          bend);
  add_pair(part, 1.0, kOfLength, with_length);
}

// L depends on the nodes' v directly and through the end of the panel.
void Transcription::add_law_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                                  const StationWeights& weights, std::size_t index,
                                  std::vector<LocalMatrix>& parts) const {
  const PanelRule& rule = panel_rule();
  double by_end = 0.0;  // dL/dv at the end of the panel
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    by_end += weights.v[index][panel.first + kNodes];
    const LawPanel law = law_panel(z, shape, ride, flow, weights, index, p, by_end);
    for (std::size_t k = 0; k < kNodes; ++k) {
      double theta = rule.weight[k] * by_end;
      for (std::size_t q = 0; q < kNodes; ++q) theta += rule.to_node[q][k] * law.multiplier[q];
      add_law_node(z, shape, ride, flow, law, p, k, theta * panel.ds[k], parts[panel.section]);
    }
    for (const double value : law.multiplier) by_end += value;
  }
  const double by_entry = by_end + weights.v[index][0];
  add_square(parts[stations_[0].section], by_entry * entry_v(ride, shape.zeta[0]).second, local_dzeta_[0]);
}

}  // namespace glissade::optimizer
