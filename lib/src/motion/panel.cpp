#include "panel.hpp"

#include "glissade/core/math.hpp"

#include "core/float_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::motion {
namespace {

// A law is continued below the squared speed at which it ends by this share of it.
constexpr double kContinued = 0.25;
// The derivative of drag in wind, |u + w|/u of that of drag in still air, grows without bound towards rest. It only leads
// the iteration: below this share of the wind it is that there.
constexpr double kSlowest = 1e-6;
// What is not linear in v is iterated on until v moves by no more than rounding. Newton's method takes some 5
// rounds; a panel that takes more than this is halved.
constexpr double kSettled = 4.0 * core::kEpsilon;
constexpr int kMostIterations = 25;

/// Direction at s; at the end of a smooth part that from before the break, a jump of curvature is not ours.
Direction direction_within(const Equation& equation, const Stretch& stretch, double s) {
  Direction direction = equation.centerline->direction(s);
  if (s < stretch.smooth_end) return direction;
  const double inside = std::max(s * (1.0 - 4.0 * core::kEpsilon), 0.5 * (stretch.begin + s));
  direction.curvature = equation.centerline->direction(inside).curvature;
  return direction;
}

double integral_of_push(const Stretch& stretch, double sigma, double mean, double weighted_mean) {
  if (stretch.spacing == Spacing::even) return sigma * mean;
  return sigma * (2.0 * stretch.anchor_root * mean + sigma * weighted_mean);
}

}  // namespace

double Equation::friction_at(double s) const {
  double friction = mu;
  for (const FrictionChange& change : changes) {
    if (change.from <= s) friction = change.friction.coefficient();
  }
  return friction;
}

double Equation::path_rate(const Direction& direction) const {
  return height == 0.0 ? 1.0 : 1.0 - direction.curvature * height;
}

double Equation::push(const Direction& direction, double friction) const {
  const auto [sine, cosine] = math::sine_cosine(direction.slope_angle);
  const double along = gain * gravity * (sine - side * friction * cosine);
  return height == 0.0 ? along : along * path_rate(direction);
}

double Equation::keep(double turn, double distance, double friction) const {
  // The centre's way is shorter by h where the track turns upwards by 1 rad.
  return math::exp(gain * (side * friction * turn - k * (distance + height * turn)));
}

double Equation::resistance(double s, double v) const {
  return law == nullptr ? 1.0 : law->resistance(s, v).factor;
}

LawState Equation::law_state(double s, const Direction& direction, double v, double normal_load,
                             double friction) const {
  return {.arc_length = s,
          .slope_angle = direction.slope_angle,
          .curvature = direction.curvature,
          .v = v,
          .normal_load = normal_load,
          .friction = friction,
          .drive = gravity * math::sin(direction.slope_angle) - k * dragged(v)};
}

double Equation::dragged(double v) const {
  if (head_wind == 0.0) return v;
  const double air_speed = std::sqrt(std::max(0.0, v)) + head_wind;
  return air_speed * std::fabs(air_speed);
}

Equation::Extra Equation::extra(const Direction& direction, double s, double friction, double v) const {
  const double path = path_rate(direction);
  Extra extra;
  if (law != nullptr) {
    // Below the speed at which the law ends it is continued as it is a little further down, so that the panel
    // in which that happens is smooth.
    const double v_of_law = std::max(v, kContinued * law->least_v(s));
    const Resistance c = law->resistance(s, v_of_law);
    const double pressing =
        side * (path * gravity * math::cos(direction.slope_angle) + direction.curvature * v);
    const double by_v = v_of_law > v ? 0.0 : c.by_v;
    extra.rate = -gain * friction * (by_v * pressing + (c.factor - 1.0) * side * direction.curvature);
    extra.push = -gain * friction * (c.factor - 1.0) * pressing - extra.rate * v;
  }
  if (head_wind != 0.0) {
    const double speed = std::sqrt(std::max(0.0, v));
    const double by_v = std::fabs(speed + head_wind) / std::max(speed, kSlowest * std::fabs(head_wind));
    const double rate = gain * k * path * (1.0 - by_v);
    extra.rate += rate;
    extra.push += gain * k * path * (v - dragged(v)) - rate * v;
  }
  return extra;
}

double Equation::slope_at_rest(const Direction& direction, double friction) const {
  const double closed_push = push(direction, friction);
  return head_wind == 0.0 ? closed_push : closed_push - gain * k * path_rate(direction) * dragged(0.0);
}

double Equation::load(const Direction& direction, double v) const {
  const double weight = side * gravity * math::cos(direction.slope_angle);
  if (v == 0.0) return weight;
  if (height == 0.0) return weight + side * direction.curvature * v;
  const double rate = path_rate(direction);
  // A valley tighter than the centre of mass is high: the load grows without bound before the body is in it.
  if (!(rate > 0.0)) return std::numeric_limits<double>::infinity();
  return weight + direction.curvature * v / rate;
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

Stretch Stretch::beyond(double s) const {
  Stretch part = *this;
  const double passed = sigma(s);
  part.begin = s;
  part.width = width - passed;
  part.anchor_root = anchor_root + passed;
  return part;
}

Panel::Panel(const Equation& equation, const Stretch& covered, double v_at_anchor, double side_pressed)
    : stretch(covered),
      friction(side_pressed * (equation.changes.empty()
                                   ? equation.mu
                                   : equation.friction_at(0.5 * (covered.begin + covered.end)))),
      pressing(side_pressed),
      anchor_v(v_at_anchor) {
  const chebyshev::Values& x = chebyshev::nodes();
  Nodes nodes;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    const double s = stretch.arc_length(i + 1 == chebyshev::kNodes ? stretch.width : stretch.width * x[i]);
    nodes.directions[i] = direction_within(equation, stretch, s);
    if (i == 0) anchor_zeta = nodes.directions[0].slope_angle;
    nodes.keeping[i] =
        equation.keep(nodes.directions[i].slope_angle - anchor_zeta, s - stretch.anchor(), friction);
    push[i] = equation.push(nodes.directions[i], friction) / nodes.keeping[i];
  }
  if (equation.closed()) {
    add_up(nodes);
  } else {
    settle(equation, nodes);
  }
  kept = nodes.keeping.back();
  weigh(equation, nodes);
}

void Panel::add_up(const Nodes& nodes) {
  const chebyshev::Values& x = chebyshev::nodes();
  const double side = stretch.anchored_at_end ? -1.0 : 1.0;
  mean_push = chebyshev::running_mean(push);
  if (stretch.spacing == Spacing::root) weighted_mean_push = chebyshev::weighted_running_mean(push);
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    v[i] = nodes.keeping[i] * (anchor_v + side * integral_of_push(stretch, stretch.width * x[i], mean_push[i],
                                                                  weighted_mean_push[i]));
  }
}

void Panel::settle(const Equation& equation, Nodes& nodes) {
  const chebyshev::Values& x = chebyshev::nodes();
  const double side = stretch.anchored_at_end ? -1.0 : 1.0;
  nodes.closed_keeping = nodes.keeping;
  chebyshev::Values closed_push;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) closed_push[i] = push[i] * nodes.keeping[i];
  v.fill(anchor_v);
  resolved = false;
  mean_rate.emplace();
  chebyshev::Values rate{};
  // Where wind and slope all but balance v is a small difference of what either does.
  const double wind_terms = equation.push_of_wind() * (stretch.end - stretch.begin);
  for (int iteration = 0; iteration < kMostIterations && !resolved; ++iteration) {
    const chebyshev::Values before = v;
    for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
      const double sigma = stretch.width * x[i];
      const Equation::Extra extra =
          equation.extra(nodes.directions[i], stretch.arc_length(sigma), friction, before[i]);
      rate[i] = extra.rate * stretch.stretching(sigma);
      push[i] = closed_push[i] + extra.push;
    }
    // From rest the rate goes as 1/u, the stretching as u.
    if (at_rest() && equation.head_wind != 0.0) rate[0] = chebyshev::extrapolated_to_zero(rate);
    *mean_rate = chebyshev::running_mean(rate);
    for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
      nodes.keeping[i] = nodes.closed_keeping[i] * math::exp(side * stretch.width * x[i] * (*mean_rate)[i]);
      push[i] /= nodes.keeping[i];
    }
    add_up(nodes);
    double change = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
      change = std::max(change, std::fabs(v[i] - before[i]));
      size = std::max(size, std::fabs(v[i]));
    }
    resolved = change <= kSettled * (size + wind_terms);
  }
}

void Panel::weigh(const Equation& equation, const Nodes& nodes) {
  const chebyshev::Values& x = chebyshev::nodes();
  const double side = stretch.anchored_at_end ? -1.0 : 1.0;
  chebyshev::Values stretched_v;
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    const double sigma = stretch.width * x[i];
    const double stretching = stretch.stretching(sigma);
    pace[i] = at_rest() ? 2.0 / std::sqrt(nodes.keeping[i] * side * weighted_mean_push[i])
                        : stretching / std::sqrt(v[i]);
    load[i] = equation.load(nodes.directions[i], v[i]);
    stretched_load[i] = load[i] * stretching;
    stretched_v[i] = v[i] * stretching;
  }
  const bool plain =
      equation.height == 0.0 && equation.closed() && equation.changes.empty() && pressing > 0.0;
  chebyshev::Values pressed;  // c N ds_c/dsigma over loss_friction()
  if (!plain) weigh_law(equation, nodes, pressed, stretched_v);
  if (!std::isfinite(stretched_load[0])) {
    load[0] = std::numeric_limits<double>::infinity();
    stretched_load[0] = chebyshev::extrapolated_to_zero(stretched_load);
    if (!plain) pressed[0] = chebyshev::extrapolated_to_zero(pressed);
  }
  mean_pace = chebyshev::running_mean(pace);
  mean_load = chebyshev::running_mean(plain ? stretched_load : pressed);
  mean_v = chebyshev::running_mean(stretched_v);
}

void Panel::weigh_law(const Equation& equation, const Nodes& nodes, chebyshev::Values& pressed,
                      chebyshev::Values& stretched_v) {
  const chebyshev::Values& x = chebyshev::nodes();
  const double share = equation.changes.empty() ? pressing : friction;
  if (equation.height > 0.0) path_rate.emplace();
  for (std::size_t i = 0; i < chebyshev::kNodes; ++i) {
    const double sigma = stretch.width * x[i];
    const double path = equation.path_rate(nodes.directions[i]);
    if (path_rate) (*path_rate)[i] = path;
    pace[i] *= path;
    stretched_v[i] = equation.dragged(v[i]) * path * stretch.stretching(sigma);
    pressed[i] = stretched_load[i] * path * share * equation.resistance(stretch.arc_length(sigma), v[i]);
  }
}

bool Panel::load_unbounded() const {
  return !std::isfinite(load[0]);
}

double Panel::scaled_w(double sigma, const chebyshev::Interpolation& at) const {
  const double mean = at(mean_push);
  const double weighted_mean = stretch.spacing == Spacing::root ? at(weighted_mean_push) : 0.0;
  const double gain = integral_of_push(stretch, sigma, mean, weighted_mean);
  return anchor_v + (stretch.anchored_at_end ? -gain : gain);
}

double Panel::v_for(const Equation& equation, double sigma, double zeta,
                    const chebyshev::Interpolation& at) const {
  const double s = stretch.arc_length(sigma);
  double keeping = equation.keep(zeta - anchor_zeta, s - stretch.anchor(), friction);
  if (mean_rate) {
    const double rate = at(*mean_rate);
    keeping *= math::exp((stretch.anchored_at_end ? -sigma : sigma) * rate);
  }
  // Rounding alone can take w below zero, where the body comes to rest.
  return keeping * std::max(0.0, scaled_w(sigma, at));
}

double Panel::v_at(const Equation& equation, double sigma) const {
  return v_for(equation, sigma, equation.centerline->slope_angle(stretch.arc_length(sigma)));
}

double Panel::load_at(const Equation& equation, double sigma) const {
  const Direction direction = direction_within(equation, stretch, stretch.arc_length(sigma));
  return equation.load(direction, v_for(equation, sigma, direction.slope_angle));
}

LawState Panel::law_state(const Equation& equation, double sigma) const {
  const double s = stretch.arc_length(sigma);
  const Direction direction = direction_within(equation, stretch, s);
  const double squared_speed = v_for(equation, sigma, direction.slope_angle);
  return equation.law_state(s, direction, squared_speed, equation.load(direction, squared_speed),
                            std::fabs(friction));
}

LawState Panel::law_state_at(const Equation& equation, std::size_t node) const {
  const double s = stretch.arc_length(stretch.width * chebyshev::nodes()[node]);
  return equation.law_state(s, direction_within(equation, stretch, s), v[node], load[node],
                            std::fabs(friction));
}

double Panel::path_rate_at(const Equation& equation, double sigma) const {
  return equation.path_rate(direction_within(equation, stretch, stretch.arc_length(sigma)));
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

RideSums Panel::sums_to(double sigma, const chebyshev::Interpolation& at) const {
  const RideSums from_anchor{sigma * at(mean_pace), sigma * at(mean_load), sigma * at(mean_v)};
  if (!stretch.anchored_at_end) return from_anchor;
  const RideSums all = sums();
  return {all.time - from_anchor.time, all.load - from_anchor.load,
          all.speed_squared - from_anchor.speed_squared};
}

}  // namespace glissade::motion
