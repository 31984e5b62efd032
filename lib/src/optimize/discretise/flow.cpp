// Speed and time: of the sliding point in closed form from node to node, of all other bodies by law_flow.cpp.

#include "glissade/core/many_angles.hpp"

#include "optimize/algebra/four.hpp"
#include "optimize/algebra/quadrature.hpp"
#include "optimize/discretise/transcription.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

// What a second weighs beside a second of speed that is off by all of itself: enough for one optimum to be left.
constexpr double kFasterOfTwo = 1e-3;  // taste

// Below this share of free fall a body counts as not arriving.
constexpr double kSlowest = 2e-6;  // theory: twice what counts as lying still

}  // namespace

Slowness slowness(double v, double floor) {
  if (v >= floor) {
    const double root = 1.0 / std::sqrt(v);
    return {root, -0.5 * root / v, 0.75 * root / (v * v)};
  }
  const double root = 1.0 / std::sqrt(floor);
  const double first = -0.5 * root / floor;
  const double second = 0.75 * root / (floor * floor);
  const double below = v - floor;
  return {root + below * (first + 0.5 * below * second), first + below * second, second};
}

Slowness evenness(double v, double floor, double even_speed) {
  // ((1 + epsilon u0 w + v w^2 ...) written in 1/u = w: (v/u0^2 - 2 u/u0 + 1)/u0 + epsilon w.
  const double u0 = even_speed;
  const Slowness slow = slowness(v, floor);
  const double at = std::max(v, floor);
  const double u = std::sqrt(at);
  const double below = v - at;
  // u and its derivatives, continued as slowness() is.
  const double first = 0.5 / u;
  const double second = -0.25 / (u * at);
  const double speed = u + below * (first + 0.5 * below * second);
  const double speed_first = first + below * second;
  const double share = 1.0 / (u0 * u0 * u0);
  return {share * v - 2.0 / (u0 * u0) * speed + 1.0 / u0 + kFasterOfTwo * slow.value,
          share - 2.0 / (u0 * u0) * speed_first + kFasterOfTwo * slow.first,
          -2.0 / (u0 * u0) * second + kFasterOfTwo * slow.second};
}

Slowness pace_of(const Ride& ride, double v, double floor) {
  return ride.even_speed > 0.0 ? evenness(v, floor, ride.even_speed) : slowness(v, floor);
}
double Transcription::slowest(const Ride& ride, std::size_t station) const {
  return kSlowest * (stations_[station].arc_length(mesh_.core_length) + 0.5 * ride.entry_speed2);
}

void Transcription::flow(const Vector& z, const Shape& shape, const Ride& ride, Flow& out,
                         bool derivatives) const {
  out.growth.clear();
  if (ride.sliding_point()) set_growth(z, shape, ride, out);
  flow_through_all(z, shape, ride, out, derivatives);
}

void Transcription::add_derivatives(const Vector& z, const Shape& shape, const Ride& ride, Flow& flow) const {
  flow_through_all(z, shape, ride, flow, true);
}

// Angles count from the entry and arc lengths from the start of each panel, so that the exponents stay small; v
// carries over from panel to panel.
void Transcription::set_growth(const Vector& z, const Shape& shape, const Ride& ride, Flow& out) const {
  Vector exponents(stations_.size(), 0.0);
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    const std::size_t start = start_station(p);
    const double mu = ride.friction_in(panel.zone);
    const double length = z[layout_.length(panel.span)];
    for (std::size_t at = panel.first; at <= panel.first + kNodes; ++at) {
      const double s = stations_[at].arc_length(length) - stations_[start].arc_length(length);
      exponents[at] = 2.0 * mu * (shape.zeta[at] - shape.zeta[start]) - 2.0 * ride.drag * s;
    }
  }
  out.growth.resize(stations_.size());
  math::exponentials(exponents, out.growth);
}

void Transcription::flow_through_all(const Vector& z, const Shape& shape, const Ride& ride, Flow& out,
                                     bool derivatives) const {
  out.v.assign(stations_.size(), 0.0);
  out.time = 0.0;
  out.dv = derivatives ? no_derivatives() : Derivatives{};
  if (derivatives) out.dtime.assign(layout_.size(), 0.0);
  if (ride.sliding_point()) {
    out.v[0] = ride.entry_speed2;
  } else {
    enter(shape, ride, out);
  }
  LocalRow by_time{};  // of the section
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    if (derivatives) carry_over(p, out.dv);
    if (ride.sliding_point()) {
      flow_through(z, shape, ride, p, out, derivatives ? &by_time : nullptr);
    } else {
      law_flow_through(z, shape, ride, p, out, derivatives ? &by_time : nullptr);
    }
    if (!derivatives || (p + 1 < panels_.size() && !begins_section(p + 1))) continue;
    const std::size_t section = panels_[p].section;
    expand(by_time, section, out.dv.starts.row(section), out.dtime.data());
    by_time = {};
  }
}

GLISSADE_WIDE_VARIANT void Transcription::flow_through(const Vector& z, const Shape& shape, const Ride& ride,
                                                       std::size_t p, Flow& out, LocalRow* by_time) const {
  const PanelRule& rule = panel_rule();
  const Panel& panel = panels_[p];
  const std::size_t start = start_station(p);
  const double mu = ride.friction_in(panel.zone);
  const double scale = scale_of(panel, z);
  // A span counts from where it begins.
  const bool goes_on = stations_[start].span == panel.span;
  const double by_length_at_start = goes_on ? stations_[start].by_length : 0.0;
  const LocalRow dz_start = dzeta_at_start(p);
  Four turning_at_start;
  load(turning_at_start, &dz_start[kZeta]);
  double f[kNodes] = {};
  // By the last four of a LocalRow: nothing depends on the first, the speed at the start.
  Four df[kNodes] = {};
  for (std::size_t q = 0; q < kNodes; ++q) {
    const std::size_t at = panel.first + q;
    const double weight = panel.ds[q] / out.growth[at];
    const double drive = 2.0 * (shape.sin[at] - mu * shape.cos[at]);
    f[q] = drive * weight;
    if (by_time == nullptr) continue;
    const double by_zeta = (2.0 * (shape.cos[at] + mu * shape.sin[at]) - 2.0 * mu * drive) * weight;
    const double by_start = 2.0 * mu * f[q];
    Four dz;
    load(dz, &local_dzeta_[at][kZeta]);
    df[q] = scale * (by_zeta * dz + by_start * turning_at_start);
    const double ds_dlength = stations_[at].by_length - by_length_at_start;
    df[q][kLength - kZeta] = panel.by_length * f[q] + scale * f[q] * 2.0 * ride.drag * ds_dlength;
  }
  const LocalRow dv_start = by_time != nullptr ? at_start(p, out.dv) : LocalRow{};
  for (std::size_t q = 0; q <= kNodes; ++q) {
    const std::size_t at = panel.first + q;
    const double* row = q < kNodes ? rule.to_node[q].data() : rule.weight.data();
    double w = out.v[start];
    for (std::size_t k = 0; k < kNodes; ++k) w += scale * row[k] * f[k];
    out.v[at] = w * out.growth[at];
    if (by_time != nullptr) {
      LocalRow& dv = out.dv.local[at];
      Four sum, dz;
      load(sum, &dv_start[kZeta]);
      load(dz, &local_dzeta_[at][kZeta]);
      for (std::size_t k = 0; k < kNodes; ++k) sum += row[k] * df[k];
      sum *= out.growth[at];
      const double turning = 2.0 * mu * out.v[at];
      sum += turning * (dz - turning_at_start);  // nothing by the length
      dv[kOwn] = dv_start[kOwn] * out.growth[at];
      store(sum, &dv[kZeta]);
      dv[kLength] -= 2.0 * ride.drag * out.v[at] * (stations_[at].by_length - by_length_at_start);
    }
    if (q == kNodes) continue;
    const Slowness slow = slowness(out.v[at], slowest(ride, at));
    const double part = rule.weight[q] * panel.ds[q];
    out.time += scale * part * slow.value;
    if (by_time == nullptr) continue;
    const double by_v = scale * part * slow.first;
    for (std::size_t j = 0; j < by_time->size(); ++j) (*by_time)[j] += by_v * out.dv.local[at][j];
    (*by_time)[kLength] += panel.by_length * part * slow.value;
  }
}

}  // namespace glissade::optimizer
