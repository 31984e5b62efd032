// A channel as plates: units between joints, parts of each, equal parts under one number, frames at the ends, lists,
// checks and proof.

#include "glissade/parts/plates.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bolts.hpp"
#include "parts/plate_checks.hpp"
#include "parts/plate_joints.hpp"
#include "parts/plate_proof.hpp"
#include "parts/setting_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

namespace glissade {

using namespace parts;

namespace {

constexpr std::array<double, 3> kFloorColour{0.62, 0.66, 0.70};
constexpr std::array<double, 3> kWallColour{0.45, 0.56, 0.68};
constexpr std::array<double, 3> kFrameColour{0.80, 0.55, 0.30};

bool same_pattern(const ShopPart& a, const ShopPart& b) {
  return a.thickness == b.thickness && a.material == b.material && a.pattern && b.pattern &&
         a.pattern->region == b.pattern->region;
}

/// Adds a part to the list; under the number of its equal where there is one.
int add_part(Workshop& workshop, ShopPart part, const std::array<double, 3>& colour) {
  for (ShopPart& other : workshop.parts) {
    if (!same_pattern(other, part)) continue;
    other.places.insert(other.places.end(), part.places.begin(), part.places.end());
    return other.number;
  }
  part.number = static_cast<int>(workshop.parts.size()) + 1;
  part.colour = colour;
  workshop.parts.push_back(std::move(part));
  return workshop.parts.back().number;
}

void add_units(Workshop& workshop, const std::vector<Unit>& units) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::string suffix = units.size() > 1 ? "_" + std::to_string(i + 1) : "";
    ShopPart floor = units[i].floor;
    floor.name += suffix;
    const std::size_t before = workshop.parts.size();
    const int number = add_part(workshop, std::move(floor), kFloorColour);
    if (workshop.parts.size() == before) continue;  // as another one: its schedule stands already
    for (BendStep step : units[i].steps) {
      step.part = number;
      workshop.bends.push_back(step);
    }
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!units[i].wall) continue;
    ShopPart wall = *units[i].wall;
    if (units.size() > 1) wall.name += "_" + std::to_string(i + 1);
    add_part(workshop, std::move(wall), kWallColour);
  }
}

void add_frames(const Job& job, Workshop& workshop, const std::vector<double>& joints) {
  if (!job.options.flanges.wanted) return;
  std::vector<Frame> upstream;    // at the upstream end of each unit
  std::vector<Frame> downstream;  // at its downstream end
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    upstream.push_back(frame_place(job, joints[i], true));
    downstream.push_back(frame_place(job, joints[i + 1], false));
  }
  // Holes of one of two frames that meet are larger, so that they fit as they come.
  add_part(workshop, frame_plate(job, HoleFit::medium, downstream), kFrameColour);
  add_part(workshop, frame_plate(job, HoleFit::coarse, upstream), kFrameColour);
  const std::size_t inner = joints.size() - 2;
  if (inner == 0) return;
  const std::size_t holes = workshop.parts.back().pattern->region.holes.size();
  const Bolt& bolt = bolt_of(job.options.flanges.bolt);
  const double length = bolt_length(bolt, 2.0 * job.options.flanges.thickness);
  const std::string size = "M" + std::to_string(bolt.size);
  const std::string where = inner == 1 ? "at the joint" : "at the " + std::to_string(inner) + " joints";
  const std::size_t count = holes * inner;
  workshop.items.push_back(
      {"bolt " + size + " x " + rounded_text(1e3 * length, 4), "ISO 4017 8.8", count, where});
  workshop.items.push_back({"nut " + size, "ISO 4032 8", count, where});
  workshop.items.push_back({"washer " + size, "ISO 7089 200 HV", 2 * count, where});
}

AsBuiltRide ride_as_built(const Job& job, const std::vector<Unit>& units, const Motion& design,
                          const Body& body, double gravity) {
  AsBuiltRide ride;
  ride.design_travel_time = design.travel_time();
  ride.design_exit_speed = design.exit_speed();
  ride.joints = units.size() - 1;
  FacetRide found;
  if (job.options.floor == FloorMake::bent) {
    std::vector<Facets> facets;
    for (const Unit& unit : units) {
      facets.push_back(*unit.face.facets);
      ride.bends += unit.face.facets->bends();
    }
    found = ride_facets(facets, body, gravity, job.options.joint_step);
  } else {
    std::vector<std::shared_ptr<const ArcSpline>> lines;
    for (const Unit& unit : units) lines.push_back(std::make_shared<ArcSpline>(unit.face.line));
    found = ride_lines(lines, body, gravity, job.options.joint_step);
  }
  ride.arrives = found.arrives;
  ride.travel_time = found.time;
  ride.exit_speed = found.speed;
  ride.highest_load = found.highest_load;
  return ride;
}

}  // namespace

double k_factor(double inner_radius, double thickness) {
  const double ratio = inner_radius / thickness;
  const double factor = 0.325 + 0.25 * math::log(ratio) / std::numbers::ln10;
  return std::clamp(factor, 0.0, 0.5);
}

PlateBuild make_plates(const Centerline& track, const ChannelMeasures& channel, const MasterCurveOptions& fit,
                       const PlateOptions& options, const Placement& placement, const Body& body,
                       double gravity) {
  std::vector<Issue> problems = plate_problems(channel, options);
  if (!problems.empty()) throw InputError(std::move(problems));
  PlateBuild build;
  build.master = fit_arcs(track, fit);
  const Job job{*build.master.spline, channel, options, placement};
  const Motion smooth(CenterlinePtr(CenterlinePtr(), &track), body,
                      gravity);  // of the design, which outlives it
  const double kink =
      options.floor == FloorMake::bent ? kink_for_speed(job, body, gravity, smooth.exit_speed()) : 1.0;
  const std::vector<Unit> units = split_units(job, kink);
  build.joints.push_back(0.0);
  for (const Unit& unit : units) build.joints.push_back(unit.span.to);
  Workshop& workshop = build.workshop;
  add_units(workshop, units);
  add_frames(job, workshop, build.joints);
  workshop.setting_out = setting_out(job.track, build.joints, placement);
  build.ride = ride_as_built(job, units, smooth, body, gravity);
  workshop.checks = shop_checks(job, units, workshop);
  build.proof = prove(job, units, workshop);
  return build;
}

}  // namespace glissade
