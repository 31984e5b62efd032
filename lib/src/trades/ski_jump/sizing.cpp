// Design speed and K point follow the hill size as they do in certificates: v0 is where 4 t and sqrt(r1/0.14) agree
// (Rasnov HS38, Predazzo HS66, Rasnov HS97, Almaty HS106 and HS140, Vikersund HS240), the K point that of the same hills,
// within the class of the hill size (IWO 411.1).

#include "glissade/trades/ski_jump/sizing.hpp"

#include "glissade/centerline/in_run.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/motion/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

namespace glissade {
namespace {

/// Length of the start area over that of the in-run, as in certificates.
constexpr double kStartAreaRatio = 0.22;

struct Certificate {
  double hill_size;
  double design_speed;
  double construction_point;
};

constexpr std::array<Certificate, 6> kCertificates = {{{38.0, 18.75, 35.0},
                                                       {66.0, 22.70, 60.0},
                                                       {97.0, 25.64, 90.0},
                                                       {106.0, 26.31, 95.0},
                                                       {140.0, 27.27, 125.0},
                                                       {240.0, 29.40, 200.0}}};

/// A value between those of the neighbouring certificates; below the smallest as energy and size have it.
template <typename Value>
double interpolated(double hill_size, Value value, double power_below) {
  const Certificate& smallest = kCertificates.front();
  if (hill_size <= smallest.hill_size) {
    return value(smallest) * math::pow(hill_size / smallest.hill_size, power_below);
  }
  std::size_t i = 1;
  while (i + 1 < kCertificates.size() && hill_size > kCertificates[i].hill_size) ++i;
  const Certificate& below = kCertificates[i - 1];
  const Certificate& above = kCertificates[i];
  const double part = (hill_size - below.hill_size) / (above.hill_size - below.hill_size);
  return value(below) + part * (value(above) - value(below));
}

/// Hills from a size on, and the K points of their class.
struct HillClass {
  double smallest;
  double lowest_point;
  double highest_point;
};

/// The K point by certificates, in the class that the hill size has: in between they know nothing of its ends.
double construction_point_of(double hill_size) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  constexpr std::array<HillClass, 5> kClasses = {{{0.0, 0.0, 44.0},
                                                  {50.0, 45.0, 74.0},
                                                  {85.0, 75.0, 99.0},
                                                  {110.0, 100.0, 169.0},
                                                  {185.0, 170.0, kNone}}};
  std::size_t i = kClasses.size() - 1;
  while (hill_size < kClasses[i].smallest) --i;
  const double as_certified = interpolated(
      hill_size, [](const Certificate& of) { return of.construction_point; }, 1.0);
  return std::clamp(std::round(as_certified), kClasses[i].lowest_point, kClasses[i].highest_point);
}

double alpha_deg(double hill_size) {
  if (hill_size < 50.0) return 9.0;
  if (hill_size < 85.0) return 10.0;
  if (hill_size < 110.0) return 10.5;
  return hill_size < 185.0 ? 11.0 : 11.25;
}

double rounded_up(double value, double step) {
  constexpr double kRounding = 1e-9;
  return std::ceil(value / step - kRounding) * step;
}

double speed_at_edge(const InRunSizes& sizes, double e1) {
  const InRunShape shape{sizes.gamma, sizes.alpha, sizes.r1, sizes.t, e1 + sizes.t, InRunTransition::cubic,
                         0.0};
  Body body;
  body.friction = Friction::from_coefficient(kSlowFriction);
  body.drag_per_metre = kInRunDrag;
  return Motion(std::make_shared<const InRun>(shape), body).exit_speed();
}

/// The shortest in-run, to half a metre, whose highest gate gives the design speed when the track is slow, and whose
/// straight holds the gates.
double shortest(const InRunSizes& sizes) {
  constexpr double kStep = 0.5;
  constexpr double kMostSteps = 2000;
  const double bend =
      transition_length({sizes.gamma, sizes.alpha, sizes.r1, sizes.t, 0.0, InRunTransition::cubic, 0.0});
  double e1 = rounded_up(bend / (1.0 - kStartAreaRatio) + kStep, kStep);
  for (int step = 0; step < kMostSteps && speed_at_edge(sizes, e1) < sizes.design_speed; ++step) e1 += kStep;
  return e1;
}

}  // namespace

InRunSizes suggested_in_run(double hill_size) {
  if (!(hill_size >= kSmallestHill && hill_size <= kLargestHill)) {
    throw InputError(
        {"--hill-size",
         "a hill size of " + quantity_beyond(hill_size, Dimension::length, {kSmallestHill, kLargestHill}) +
             " is out of range",
         "Hills are between " + length_text(kSmallestHill) + " and " + length_text(kLargestHill) + ".",
         "106, of a normal hill; 140, of a large one"});
  }
  InRunSizes sizes;
  sizes.hill_size = hill_size;
  sizes.design_speed =
      0.1 * std::round(10.0 * interpolated(
                                  hill_size, [](const Certificate& of) { return of.design_speed; }, 0.5));
  sizes.construction_point = construction_point_of(hill_size);
  sizes.gamma = Angle::from_degrees(hill_size < 50.0 ? 32.0 : 35.0);
  sizes.alpha = Angle::from_degrees(alpha_deg(hill_size));
  sizes.r1 = rounded_up(0.14 * sizes.design_speed * sizes.design_speed, 0.5);
  sizes.t = rounded_up(0.25 * sizes.design_speed, 0.05);
  sizes.e1 = shortest(sizes);
  sizes.es = 0.5 * std::round(2.0 * kStartAreaRatio * sizes.e1);
  sizes.table_height = hill_size < 185.0 ? 0.025 * sizes.construction_point : 3.2;
  constexpr double kHighestStep = 0.40;  // [m]
  sizes.gates = 1 + static_cast<int>(std::ceil(sizes.es * math::sin(sizes.gamma.radians()) / kHighestStep));
  return sizes;
}

}  // namespace glissade
