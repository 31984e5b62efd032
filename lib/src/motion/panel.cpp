#include "panel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::motion {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Direction at s; at the end of a smooth part that from before the break, a jump of curvature is not ours.
Direction direction_within(const Equation& equation, const Stretch& stretch, double s) {
  Direction direction = equation.centerline->direction(s);
  if (s < stretch.smooth_end) return direction;
  const double inside = std::max(s * (1.0 - 4.0 * kEpsilon), 0.5 * (stretch.begin + s));
  direction.curvature = equation.centerline->direction(inside).curvature;
  return direction;
}

double integral_of_push(const Stretch& stretch, double sigma, double mean, double weighted_mean) {
  if (stretch.spacing == Spacing::even) return sigma * mean;
  return sigma * (2.0 * stretch.anchor_root * mean + sigma * weighted_mean);
}

}  // namespace

double Equation::push(double zeta) const {
  return 2.0 * gravity * (std::sin(zeta) - mu * std::cos(zeta));
}

double Equation::keep(double turn, double distance) const {
  return std::exp(2.0 * (mu * turn - k * distance));
}

double Equation::load(const Direction& direction, double v) const {
  const double weight = gravity * std::cos(direction.slope_angle);
  return v == 0.0 ? weight : weight + direction.curvature * v;
}

Stretch Stretch::even(double begin, double end) {
  Stretch stretch;
  stretch.begin = begin;
  stretch.end = end;
  stretch.width = end - begin;
  stretch.smooth_end = end;
  return stretch;
}

Stretch Stretch::root(double begin, double end, double r) {
  Stretch stretch = even(begin, end);
  stretch.spacing = Spacing::root;
  stretch.anchor_root = r;
  stretch.width = stretch.sigma(end);
  return stretch;
}

Stretch Stretch::up_to_rest(double begin, double end, double smooth_end) {
  Stretch stretch = root(begin, end, 0.0);
  stretch.anchored_at_end = true;
  stretch.smooth_end = smooth_end;
  return stretch;
}

double Stretch::distance(double sigma) const {
  return spacing == Spacing::even ? sigma : sigma * (2.0 * anchor_root + sigma);
}

double Stretch::arc_length(double sigma) const {
  if (sigma == width) return anchored_at_end ? begin : end;
  return anchored_at_end ? std::max(begin, end - distance(sigma)) : std::min(end, begin + distance(sigma));
}

double Stretch::sigma(double s) const {
  const double from_anchor = anchored_at_end ? end - s : s - begin;
  if (spacing == Spacing::even || from_anchor == 0.0) return from_anchor;
  return from_anchor / (anchor_root + std::sqrt(anchor_root * anchor_root + from_anchor));
}

double Stretch::stretching(double sigma) const {
  return spacing == Spacing::even ? 1.0 : 2.0 * (anchor_root + sigma);
}

bool Stretch::can_split() const {
  const double middle = arc_length(0.5 * width);
  return begin < middle && middle < end;
}

Stretch Stretch::half_at_anchor() const {
  Stretch half = *this;
  half.width = 0.5 * width;
  (anchored_at_end ? half.begin : half.end) = arc_length(0.5 * width);
  return half;
}

Stretch Stretch::half_beyond() const {
  Stretch half = *this;
  half.width = 0.5 * width;
  half.anchor_root = anchor_root + 0.5 * width;
  (anchored_at_end ? half.end : half.begin) = arc_length(0.5 * width);
  return half;
}

Stretch Stretch::cut_at(double s) const {
  Stretch part = *this;
  part.end = s;
  part.width = sigma(s);
  return part;
}

Panel::Panel(const Equation& equation, const Stretch& covered, double v_at_anchor)
    : stretch(covered), anchor_v(v_at_anchor) {
  const chebyshev::Values& x = chebyshev::nodes();
  chebyshev::Values keeping{};
  std::array<Direction, chebyshev::kNodes> directions;
  const double side = stretch.anchored_at_end ? -1.0 : 1.0;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    const double s = stretch.arc_length(i + 1 == chebyshev::kNodes ? stretch.width : stretch.width * x[i]);
    directions[i] = direction_within(equation, stretch, s);
    if (i == 0) anchor_zeta = directions[0].slope_angle;
    keeping[i] = equation.keep(directions[i].slope_angle - anchor_zeta, s - stretch.anchor());
    push[i] = equation.push(directions[i].slope_angle) / keeping[i];
  }
  kept = keeping.back();
  mean_push = chebyshev::running_mean(push);
  if (stretch.spacing == Spacing::root) weighted_mean_push = chebyshev::weighted_running_mean(push);

  chebyshev::Values stretched_v;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    const double sigma = stretch.width * x[i];
    const double stretching = stretch.stretching(sigma);
    v[i] = keeping[i] *
           (anchor_v + side * integral_of_push(stretch, sigma, mean_push[i], weighted_mean_push[i]));
    pace[i] =
        at_rest() ? 2.0 / std::sqrt(keeping[i] * side * weighted_mean_push[i]) : stretching / std::sqrt(v[i]);
    load[i] = equation.load(directions[i], v[i]);
    stretched_load[i] = load[i] * stretching;
    stretched_v[i] = v[i] * stretching;
  }
  if (!std::isfinite(stretched_load[0])) {
    load[0] = std::numeric_limits<double>::infinity();
    stretched_load[0] = chebyshev::extrapolated_to_zero(stretched_load);
  }
  mean_pace = chebyshev::running_mean(pace);
  mean_load = chebyshev::running_mean(stretched_load);
  mean_v = chebyshev::running_mean(stretched_v);
}

bool Panel::load_unbounded() const {
  return !std::isfinite(load[0]);
}

double Panel::scaled_w(double sigma) const {
  const chebyshev::Interpolation at(sigma / stretch.width);
  const double mean = at(mean_push);
  const double weighted_mean = stretch.spacing == Spacing::root ? at(weighted_mean_push) : 0.0;
  const double gain = integral_of_push(stretch, sigma, mean, weighted_mean);
  return anchor_v + (stretch.anchored_at_end ? -gain : gain);
}

double Panel::v_for(const Equation& equation, double sigma, double zeta) const {
  const double s = stretch.arc_length(sigma);
  // Rounding alone can take w below zero, where the body comes to rest.
  return equation.keep(zeta - anchor_zeta, s - stretch.anchor()) * std::max(0.0, scaled_w(sigma));
}

double Panel::v_at(const Equation& equation, double sigma) const {
  return v_for(equation, sigma, equation.centerline->slope_angle(stretch.arc_length(sigma)));
}

double Panel::load_at(const Equation& equation, double sigma) const {
  const Direction direction = direction_within(equation, stretch, stretch.arc_length(sigma));
  return equation.load(direction, v_for(equation, sigma, direction.slope_angle));
}

double Panel::far_v_terms() const {
  double largest_push = 0.0;
  for (const double value : push) largest_push = std::max(largest_push, std::fabs(value));
  return kept * (anchor_v + largest_push * (stretch.end - stretch.begin));
}

RideSums Panel::sums() const {
  const double width = stretch.width;
  return {width * mean_pace.back(), width * mean_load.back(), width * mean_v.back()};
}

RideSums Panel::sums_to(double sigma) const {
  const chebyshev::Interpolation at(sigma / stretch.width);
  const RideSums from_anchor{sigma * at(mean_pace), sigma * at(mean_load), sigma * at(mean_v)};
  if (!stretch.anchored_at_end) return from_anchor;
  const RideSums all = sums();
  return {all.time - from_anchor.time, all.load - from_anchor.load,
          all.speed_squared - from_anchor.speed_squared};
}

}  // namespace glissade::motion
