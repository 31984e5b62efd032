// Where a track runs, the point of it that is closest to another, and the derivatives of both.

#include "glissade/core/many_angles.hpp"
#include "glissade/core/math.hpp"

#include "optimize/algebra/four.hpp"
#include "optimize/algebra/quadrature.hpp"
#include "optimize/discretise/transcription.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
void Transcription::shape(const Vector& z, Shape& out, bool derivatives) const {
  const PanelRule& rule = panel_rule();
  const std::size_t count = stations_.size();
  out.zeta.resize(count);
  out.sin.resize(count);
  out.cos.resize(count);
  out.curvature.resize(count);
  out.x.resize(count);
  out.y.resize(count);
  out.x.front() = 0.0;
  out.y.front() = 0.0;
  const Vector angles = section_angles(z);
  for (std::size_t i = 0; i < count; ++i) {
    out.zeta[i] = angle_at(z, angles, i);
    out.curvature[i] = curvature(z, i);
  }
  math::sines_cosines(out.zeta, out.sin, out.cos);
  out.dx = {};
  out.dy = {};
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    const std::size_t start = start_station(p);
    const double scale = scale_of(panel, z);
    for (std::size_t q = 0; q <= kNodes; ++q) {
      double sum_x = 0.0;
      double sum_y = 0.0;
      for (std::size_t k = 0; k < kNodes; ++k) {
        const double part = (q < kNodes ? rule.to_node[q][k] : rule.weight[k]) * panel.ds[k];
        sum_x += part * out.cos[panel.first + k];
        sum_y += part * out.sin[panel.first + k];
      }
      out.x[panel.first + q] = out.x[start] + scale * sum_x;
      out.y[panel.first + q] = out.y[start] + scale * sum_y;
    }
  }
  if (derivatives) add_derivatives(z, out);
}

void Transcription::add_derivatives(const Vector& z, Shape& shape) const {
  shape.dx = no_derivatives();
  shape.dy = shape.dx;
  for (std::size_t p = 0; p < panels_.size(); ++p) differentiate_shape(z, p, shape);
}

void Transcription::count_from_finish(Shape& shape) const {
  const std::size_t last = stations_.size() - 1;
  for (Vector* const places : {&shape.x, &shape.y}) {
    const double finish = places->back();
    for (double& place : *places) place -= finish;
  }
  if (shape.dx.empty()) return;
  const std::size_t n = layout_.size();
  for (Derivatives* const derivatives : {&shape.dx, &shape.dy}) {
    Vector finish(n, 0.0);
    add(*derivatives, last, 1.0, finish.data());
    // Every station's derivatives are those of where its section begins and more; the start, where nothing moved so far,
    // has had none.
    derivatives->local.front()[kOwn] = 1.0;
    for (std::size_t i = 0; i < sections_.size(); ++i)
      add_scaled(derivatives->starts.row(i), -1.0, finish.data(), n);
  }
}

GLISSADE_WIDE_VARIANT void Transcription::differentiate_shape(const Vector& z, std::size_t p,
                                                              Shape& out) const {
  const PanelRule& rule = panel_rule();
  const Panel& panel = panels_[p];
  const double scale = scale_of(panel, z);
  carry_over(p, out.dx);
  carry_over(p, out.dy);
  const LocalRow dx_start = at_start(p, out.dx);
  const LocalRow dy_start = at_start(p, out.dy);
  const std::size_t start = start_station(p);
  // Slope angles know nothing of the length: what is added to that entry is nothing.
  Four dz[kNodes];
  for (std::size_t k = 0; k < kNodes; ++k) load(dz[k], &local_dzeta_[panel.first + k][kZeta]);
  for (std::size_t q = 0; q <= kNodes; ++q) {
    const std::size_t at = panel.first + q;
    LocalRow& dx = out.dx.local[at];
    LocalRow& dy = out.dy.local[at];
    dx = dx_start;
    dy = dy_start;
    Four along, down;
    load(along, &dx[kZeta]);
    load(down, &dy[kZeta]);
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double part = scale * (q < kNodes ? rule.to_node[q][k] : rule.weight[k]) * panel.ds[k];
      along -= part * out.sin[panel.first + k] * dz[k];
      down += part * out.cos[panel.first + k] * dz[k];
    }
    store(along, &dx[kZeta]);
    store(down, &dy[kZeta]);
    if (panel.by_length == 0.0) continue;
    dx[kLength] += panel.by_length * (out.x[at] - out.x[start]) / scale;
    dy[kLength] += panel.by_length * (out.y[at] - out.y[start]) / scale;
  }
}

Foot Transcription::between(const Vector& z, const Shape& shape, std::size_t base, std::size_t towards,
                            double share) const {
  const PanelRule& rule = panel_rule();
  const Station& from = stations_[base];
  // The piece that lies between the two is that of the later one.
  const Station& later = stations_[std::max(base, towards)];
  const Station& to = stations_[towards];
  Foot foot;
  foot.base = base;
  foot.towards = towards;
  foot.share = share;
  foot.at = later;
  foot.at.fixed_length = from.fixed_length + share * (to.fixed_length - from.fixed_length);
  foot.at.by_length = from.by_length + share * (to.by_length - from.by_length);
  foot.at.sigma = from.sigma + share * (to.sigma - from.sigma);
  double curvature_from = 0.0;
  double curvature_slope = 0.0;
  if (later.part == Part::core) {
    const double knot = mesh_.knots[later.piece];
    const double width = mesh_.knots[later.piece + 1] - knot;
    foot.at.share = (foot.at.sigma - knot) / width;
    const double from_share = (from.sigma - knot) / width;
    const double stretch = this->stretch(z, later.piece);
    const double c0 = z[layout_.turn(later.piece)] / stretch;
    const double c1 = z[layout_.turn(later.piece + 1)] / stretch;
    curvature_from = c0 + (c1 - c0) * from_share + station_turn_[base] / stretch;
    curvature_slope = (c1 - c0) / (width * stretch);
    const double gap = (to.sigma - from.sigma) * stretch;
    if (!fine_.empty() && gap != 0.0) {
      curvature_slope += (station_turn_[towards] - station_turn_[base]) / (gap * stretch);
    }
  }
  const double ds = arc_length(z, foot.at) - arc_length(z, from);
  const auto angle = [&](double s) {
    return shape.zeta[base] - s * (curvature_from + 0.5 * s * curvature_slope);
  };
  foot.x = shape.x[base];
  foot.y = shape.y[base];
  // As many as two registers of four hold: one too many costs less than one by itself.
  std::array<double, kNodes + 2> angles, sine, cosine;
  for (std::size_t k = 0; k < kNodes; ++k) angles[k] = angle(ds * rule.node[k]);
  angles[kNodes] = angles[kNodes + 1] = angle(ds);
  math::sines_cosines(angles, sine, cosine);
  for (std::size_t k = 0; k < kNodes; ++k) {
    foot.x += rule.weight[k] * ds * cosine[k];
    foot.y += rule.weight[k] * ds * sine[k];
  }
  foot.cos = cosine[kNodes];
  foot.sin = sine[kNodes];
  return foot;
}

Foot Transcription::foot(const Vector& z, const Shape& shape, double target_x, double target_y) const {
  const auto distance_of = [&](std::size_t i) {
    return math::hypot(shape.x[i] - target_x, shape.y[i] - target_y);
  };
  // A few stations tell how near the nearest at most is; the rest need only be looked at where that may be undercut:
  // along the track no distance falls faster than the arc length grows.
  constexpr std::size_t kStride = 24;  // taste: no result depends on it
  constexpr double kRounding = 1e-9;   // accuracy: far above that of the stations
  std::size_t nearest = 0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < stations_.size(); i += kStride) {
    const double distance = distance_of(i);
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  for (std::size_t i = 0; i < stations_.size();) {
    const double distance = distance_of(i);
    double ahead = arc_length(z, stations_[i]);
    if (distance < least || (distance == least && i < nearest)) {
      least = distance;
      nearest = i;
    } else {
      ahead += (1.0 - kRounding) * (distance - least);
    }
    i = first_behind(z, i + 1, ahead);
  }
  return foot(z, shape, target_x, target_y, nearest);
}

std::size_t Transcription::first_behind(const Vector& z, std::size_t from, double arc) const {
  const auto lies_before = [&](std::size_t i) {
    return i < stations_.size() && arc_length(z, stations_[i]) < arc;
  };
  if (!lies_before(from)) return from;
  // Mostly it is near: twice as far each time, then back by halves.
  std::size_t before = from;
  std::size_t step = 1;
  while (lies_before(before + step)) {
    before += step;
    step *= 2;
  }
  while (step > 1) {
    step /= 2;
    if (lies_before(before + step)) before += step;
  }
  return before + 1;
}

std::size_t Transcription::last_at_place(std::size_t station, bool forward) const {
  const auto is_same = [&](std::size_t a, std::size_t b) {
    return stations_[a].part == Part::core && stations_[b].part == Part::core &&
           stations_[a].sigma == stations_[b].sigma;
  };
  if (forward) {
    while (station + 1 < stations_.size() && is_same(station, station + 1)) ++station;
  } else {
    while (station > 0 && is_same(station, station - 1)) --station;
  }
  return station;
}

Foot Transcription::foot(const Vector& z, const Shape& shape, double target_x, double target_y,
                         std::size_t nearest) const {
  const double along =
      (target_x - shape.x[nearest]) * shape.cos[nearest] + (target_y - shape.y[nearest]) * shape.sin[nearest];
  const bool forward = along > 0.0;
  if (!mesh_.borders.empty()) nearest = last_at_place(nearest, forward);
  if ((!forward && nearest == 0) || (forward && nearest + 1 == stations_.size())) {
    Foot foot;
    foot.at = stations_[nearest];
    foot.base = nearest;
    foot.towards = nearest;
    foot.x = shape.x[nearest];
    foot.y = shape.y[nearest];
    foot.sin = shape.sin[nearest];
    foot.cos = shape.cos[nearest];
    foot.end = true;
    return foot;
  }
  const std::size_t towards = forward ? nearest + 1 : nearest - 1;
  const double gap = arc_length(z, stations_[towards]) - arc_length(z, stations_[nearest]);
  double share = std::min(1.0, std::fabs(along / gap));
  Foot foot = between(z, shape, nearest, towards, share);
  for (int step = 0; step < 8; ++step) {
    const double rest = (target_x - foot.x) * foot.cos + (target_y - foot.y) * foot.sin;
    if (std::fabs(rest) < 1e-15) break;
    share = std::clamp(share + rest / gap, 0.0, 1.0);
    foot = between(z, shape, nearest, towards, share);
  }
  return foot;
}

void Transcription::foot_derivatives(const Vector& z, const Shape& shape, const Foot& foot, Vector& dx,
                                     Vector& dy) const {
  const PanelRule& rule = panel_rule();
  const std::size_t n = layout_.size();
  const Station& from = stations_[foot.base];
  dx.assign(n, 0.0);
  dy.assign(n, 0.0);
  add(shape.dx, foot.base, 1.0, dx.data());
  add(shape.dy, foot.base, 1.0, dy.data());
  const double d_sigma = foot.at.sigma - from.sigma;
  const double by_length = foot.at.by_length - from.by_length;
  const double ds = arc_length(z, foot.at) - arc_length(z, from);
  if (ds == 0.0) return;
  const std::size_t section = section_of(foot.at.part, foot.at.piece);
  const std::size_t piece = sections_[section].piece;
  const double angle = section_angles(z)[section];
  LocalRow local_dx{};
  LocalRow local_dy{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    Station node = foot.at;
    node.sigma = from.sigma + d_sigma * rule.node[k];
    if (node.part == Part::core) {
      const double knot = mesh_.knots[node.piece];
      node.share = (node.sigma - knot) / (mesh_.knots[node.piece + 1] - knot);
    }
    const LocalRow row = local_dzeta(node);
    const double zeta = angle + row[kFirst] * z[layout_.turn(piece)] +
                        row[kSecond] * z[layout_.turn(piece + 1)] + own_angle(node.sigma);
    const auto [sine, cosine] = math::sine_cosine(zeta);
    for (const std::size_t j : {kZeta, kFirst, kSecond}) {
      local_dx[j] -= rule.weight[k] * ds * sine * row[j];
      local_dy[j] += rule.weight[k] * ds * cosine * row[j];
    }
    local_dx[kLength] += rule.weight[k] * by_length * cosine;
    local_dy[kLength] += rule.weight[k] * by_length * sine;
  }
  expand(local_dx, section, nullptr, dx.data());
  expand(local_dy, section, nullptr, dy.data());
}

}  // namespace glissade::optimizer
