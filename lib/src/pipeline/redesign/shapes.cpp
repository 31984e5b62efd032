#include "pipeline/redesign/shapes.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "pipeline/redesign/ruled_letters.hpp"
#include "pipeline/ride/extremes.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace glissade::pipeline {
namespace {

/// Highest rate of the curvature between its jumps, and the largest of those but for the one at the table's beginning.
void measure_bends(const Centerline& track, RedesignShape& shape) {
  constexpr int kSamples = 200;
  constexpr double kInside = 1e-9;
  const std::vector<double> breaks = track.breaks();
  double before = 0.0;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double from = breaks[i - 1];
    const double width = (breaks[i] - from) * (1.0 - kInside);
    const auto curvature = [&](int k) { return track.direction(from + width * k / kSamples).curvature; };
    double last = curvature(0);
    const bool at_table = i + 1 == breaks.size();
    if (i > 1 && !at_table) shape.largest_jump = std::max(shape.largest_jump, std::fabs(last - before));
    for (int k = 1; k <= kSamples; ++k) {
      const double now = curvature(k);
      shape.curvature_rate = std::max(shape.curvature_rate, std::fabs(now - last) * kSamples / width);
      last = now;
    }
    before = last;
  }
}

std::string transition_name(InRunTransition transition) {
  switch (transition) {
    case InRunTransition::cubic:
      return "cubic";
    case InRunTransition::circle:
      return "circle";
    case InRunTransition::clothoid:
      return "clothoid";
    case InRunTransition::two_radii:
      break;
  }
  return "two-radii";
}

/// Its v^2/radius is kept at what the rules allow, or at as much as leaves the load at what they allow.
CenterlinePtr load_controlled(const InRunShape& certificate, const TakeOff& take_off,
                              const BendBounds& bounds) {
  const double table_weight = take_off.gravity * math::cos(certificate.alpha.radians());
  double radial = std::min(bounds.radial, bounds.load - table_weight);
  CenterlinePtr track;
  constexpr int kMostRounds = 8;    // budget: each leaves some hundredth of what was missing
  constexpr double kEnough = 1e-9;  // rounding: of a bound
  for (int round = 0; round < kMostRounds; ++round) {
    track = std::make_shared<const ClothoidSpline>(load_controlled_in_run(certificate, radial, take_off));
    if (std::isinf(bounds.load)) break;
    const Motion motion(track, take_off.body, take_off.gravity);
    // Where the weight counts most, at the end of the bend, the load is fading already: there is more to give.
    const double wanted = std::min(bounds.radial, radial + bounds.load - motion.highest_load().normal_load);
    if (std::fabs(wanted - radial) <= kEnough * bounds.load) break;
    radial = wanted;
  }
  return track;
}

}  // namespace

RedesignShape ridden(std::string name, CenterlinePtr track, const TakeOff& take_off) {
  RedesignShape shape;
  shape.name = std::move(name);
  const Motion motion(track, take_off.body, take_off.gravity);
  shape.ends = track->endpoints();
  shape.length = track->length();
  if (motion.arrived()) {
    shape.take_off_speed = motion.exit_speed();
  } else {
    shape.problem = "the body does not arrive at the edge";
  }
  shape.highest_load = motion.highest_load().normal_load;
  shape.highest_radial = highest_radial_acceleration(motion).value;
  measure_bends(*track, shape);
  shape.track = std::move(track);
  return shape;
}

RedesignShape attempted(const std::string& name, const TakeOff& take_off,
                        const std::function<CenterlinePtr()>& make) {
  try {
    return ridden(name, make(), take_off);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    RedesignShape none;
    none.name = name;
    none.problem = error.issues().front().what;
    return none;
  }
}

RedesignShape lettered(const std::string& name, const TakeOff& take_off,
                       const std::function<InRunShape()>& make) {
  std::optional<InRunShape> letters;
  RedesignShape shape = attempted(name, take_off, [&] {
    letters = make();
    return std::make_shared<const InRun>(*letters);
  });
  if (shape.track != nullptr) shape.letters = letters;
  return shape;
}

BendBounds bend_bounds(const Design& design, const Measurements& measurements, double otherwise) {
  const double table_weight = design.gravity * math::cos(design.centerline.in_run.alpha.radians());
  BendBounds bounds;
  for (const Rule& rule : design.rules.in_force) {
    if (!rule.bound.highest || !applies(rule, measurements)) continue;
    const double highest = *rule.bound.highest;
    if (rule.quantity == "design_radial_acceleration" || rule.quantity == "highest_radial_acceleration")
      bounds.radial = std::min(bounds.radial, highest);
    if (rule.quantity == "highest_normal_load") bounds.load = std::min(bounds.load, highest);
    if (rule.quantity == "load_above_table_weight")
      bounds.load = std::min(bounds.load, table_weight + highest);
  }
  if (std::isinf(bounds.radial) && std::isinf(bounds.load)) bounds.radial = otherwise;
  return bounds;
}

void add_comparisons(const InRunShape& certificate, const TakeOff& take_off, const BendBounds& bounds,
                     std::vector<RedesignShape>& shapes) {
  for (const InRunTransition other :
       {InRunTransition::cubic, InRunTransition::circle, InRunTransition::clothoid}) {
    if (other == certificate.transition) continue;
    InRunShape shape = certificate;
    shape.transition = other;
    shapes.push_back(lettered("its letters, " + transition_name(other), take_off,
                              [&] { return reaching(shape, take_off); }));
  }
  shapes.push_back(attempted("power curve (after Zanevskyy)", take_off, [&] {
    return std::make_shared<const ClothoidSpline>(power_in_run(certificate, take_off));
  }));
  // Its pieces have a rate each; the curve's own, of xi^(1/cos(D) - 2), has no bound at E1 while cos(D) is above 1/2.
  if (shapes.back().track != nullptr &&
      2.0 * math::cos((certificate.gamma - certificate.alpha).radians()) > 1.0) {
    shapes.back().curvature_rate = HUGE_VAL;
  }
  shapes.push_back(attempted("load-controlled (after Palej, Filipowska)", take_off,
                             [&] { return load_controlled(certificate, take_off, bounds); }));
}

}  // namespace glissade::pipeline
