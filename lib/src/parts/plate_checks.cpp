// Rules of thumb and of standards, as data: who says so stands beside each.

#include "parts/plate_checks.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bolts.hpp"
#include "parts/fittings.hpp"
#include "parts/shop_rule.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace glissade {
namespace parts {
namespace {

constexpr double kLeastEdge = 1.2;   // hole diameters from its centre to an edge
constexpr double kLeastPitch = 2.4;  // hole diameters between centres, across the force
constexpr double kEdgeAtTop = 1.5;   // hole diameters below the top of a frame, as frame_plate() has it

constexpr ShopRule kHoleDiameter{"hole diameter", true, ShopVerdict::fail,
                                 "laser cutters' tables: 0.7 to 1.5 thicknesses, most 1"};
constexpr ShopRule kHoleToEdge{"hole to edge", true, ShopVerdict::fail,
                               "EN 1993-1-8 table 3.3: 1.2 hole diameters"};
constexpr ShopRule kHolePitch{"distance of bolts, least", true, ShopVerdict::fail,
                              "EN 1993-1-8 table 3.3: 2.4 hole diameters"};
constexpr ShopRule kWidePitch{"distance of bolts, greatest", false, ShopVerdict::warn,
                              "chute practice, uncertain: 100 to 150 mm"};
constexpr ShopRule kSheet{"largest part", false, ShopVerdict::fail, "sheet of the design"};
constexpr ShopRule kSmallest{"smallest part", true, ShopVerdict::warn, "laser cutters' tables: 25 mm"};
constexpr ShopRule kRolling{"rolling radius", true, ShopVerdict::warn,
                            "shop practice, uncertain: 20 to 50 thicknesses; pre-bend or press below"};
constexpr ShopRule kPunch{"inner radius of bends", true, ShopVerdict::fail,
                          "shop practice: 1 thickness of mild steel"};
constexpr ShopRule kFlat{"flat between bends", true, ShopVerdict::warn,
                         "half the opening of a die of 8 thicknesses"};
constexpr ShopRule kMass{"mass of a part", false, ShopVerdict::fail, "heaviest of the design"};
constexpr ShopRule kStep{"step up at a joint", false, ShopVerdict::fail,
                         "downstream edge never higher than upstream edge"};

std::string as_length(double metres) {
  return length_text(metres, 4);
}

std::string as_mass(double kilograms) {
  return rounded_text(kilograms, 4) + " kg";
}

double edge_distance(const ArcPath& outline, Vec2 point) {
  const PathPiece here{point, point + Vec2{1e-9, 0.0}, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : pieces_of(outline)) least = std::min(least, distance(here, piece));
  return least;
}

void check_holes(const Workshop& workshop, std::vector<ShopCheck>& checks) {
  ShopCase diameter(kHoleDiameter);
  ShopCase edge(kHoleToEdge);
  ShopCase pitch(kHolePitch);
  ShopCase wide(kWidePitch);
  for (const ShopPart& part : workshop.parts) {
    if (!part.pattern) continue;
    const std::vector<Circle>& holes = part.pattern->region.holes;
    for (std::size_t i = 0; i < holes.size(); ++i) {
      const double hole = 2.0 * holes[i].radius;
      diameter.see(hole, part.thickness, part.name, as_length);
      edge.see(edge_distance(part.pattern->region.outline, holes[i].centre), kLeastEdge * hole, part.name,
               as_length);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < holes.size(); ++k) {
        if (k != i) nearest = std::min(nearest, norm(holes[k].centre - holes[i].centre));
      }
      if (holes.size() < 2) continue;
      pitch.see(nearest, kLeastPitch * hole, part.name, as_length);
      const bool frame =
          part.name.find("frame") != std::string::npos || part.name.find("flange") != std::string::npos;
      if (frame) wide.see(nearest, 0.15, part.name, as_length);
    }
  }
  for (const ShopCase* worst : {&diameter, &edge, &pitch, &wide}) worst->add_to(checks);
}

void check_sizes(const SplitOptions& split, const Workshop& workshop, std::vector<ShopCheck>& checks) {
  ShopCase largest(kSheet);
  ShopCase smallest(kSmallest);
  ShopCase mass(kMass);
  constexpr double kLeastSide = 25e-3;
  for (const ShopPart& part : workshop.parts) {
    if (part.pattern) {
      const PlaneBox box = bounds(part.pattern->region.outline);
      largest.see(std::max(box.width(), box.height()), std::max(split.sheet.x, split.sheet.y), part.name,
                  as_length);
      largest.see(std::min(box.width(), box.height()), std::min(split.sheet.x, split.sheet.y), part.name,
                  as_length);
      smallest.see(std::min(box.width(), box.height()), kLeastSide, part.name, as_length);
    }
    if (split.heaviest) mass.see(part.mass, *split.heaviest, part.name, as_mass);
  }
  for (const ShopCase* worst : {&largest, &smallest, &mass}) worst->add_to(checks);
}

void check_floor(const Job& job, const std::vector<Unit>& units, std::vector<ShopCheck>& checks) {
  const double thickness = job.channel.thickness;
  ShopCase rolling(kRolling);
  ShopCase punch(kPunch);
  ShopCase flat(kFlat);
  ShopCase step(kStep);
  for (const Unit& unit : units) {
    const bool bent = unit.face.facets.has_value();
    for (const TrackArc& arc : unit.face.line.arcs()) {
      const std::string where =
          unit.floor.name + " at " + length_text(unit.span.from + arc.start, 3) + " along the track";
      if (!bent && arc.curvature != 0.0) {
        rolling.see(1.0 / std::fabs(arc.curvature), 20.0 * thickness, where, as_length);
      }
      if (bent && arc.curvature == 0.0) flat.see(arc.length, 4.0 * thickness, where, as_length);
    }
    if (bent && unit.face.facets->bends() > 0)
      punch.see(bend_radius(job), thickness, unit.floor.name, as_length);
  }
  if (units.size() > 1) step.see(0.0 - job.options.joint_step, 0.0, "every joint", as_length);
  for (const ShopCase* worst : {&rolling, &punch, &flat, &step}) worst->add_to(checks);
}

/// Collects what is wrong with the measures, all of it.
class Objections {
 public:
  void positive(double value, const char* key) {
    if (std::isfinite(value) && value > 0.0) return;
    add(key, std::string(key) + ": " + length_text(value) + " is not positive", "", "a positive length");
  }
  void add(const char* where, std::string what, std::string why, std::string hint) {
    issues_.push_back({where, std::move(what), std::move(why), std::move(hint)});
  }
  [[nodiscard]] std::vector<Issue> all() && { return std::move(issues_); }

 private:
  std::vector<Issue> issues_;
};

/// Of frames round any section.
void object_to_bolts(const FlangeOptions& flange, Objections& objections) {
  if (!flange.wanted) return;
  objections.positive(flange.width, "flanges.width");
  objections.positive(flange.thickness, "flanges.thickness");
  if (std::find(bolt_sizes().begin(), bolt_sizes().end(), flange.bolt) == bolt_sizes().end()) {
    objections.add("flanges.bolt",
                   "bolt: M" + std::to_string(flange.bolt) + " is no size whose holes are known", "",
                   "M5, M6, M8, M10, M12, M16, M20 or M24");
    return;
  }
  const double hole = clearance_hole(flange.bolt, HoleFit::coarse);
  const std::string bolt = "M" + std::to_string(flange.bolt);
  if (flange.pitch < kLeastPitch * hole) {
    objections.add("flanges.pitch", "pitch: " + length_text(flange.pitch) + " is too close for " + bolt,
                   "Holes of " + length_text(hole) + " are at least " + length_text(kLeastPitch * hole) +
                       " apart (EN 1993-1-8).",
                   "a pitch of 150 mm, or a smaller bolt");
  }
  if (0.5 * flange.width < kLeastEdge * hole) {
    objections.add("flanges.width",
                   "width: " + length_text(flange.width) + " puts holes for " + bolt + " " +
                       length_text(0.5 * flange.width) + " from the edge",
                   "Their centres are at least " + length_text(kLeastEdge * hole) + " from it (EN 1993-1-8).",
                   "a width of at least " + length_text(2.0 * kLeastEdge * hole) + ", or a smaller bolt");
  }
}

void object_to_flanges(const ChannelMeasures& channel, const FlangeOptions& flange, Objections& objections) {
  object_to_bolts(flange, objections);
  const bool known = std::find(bolt_sizes().begin(), bolt_sizes().end(), flange.bolt) != bolt_sizes().end();
  if (!flange.wanted || !known) return;
  const double hole = clearance_hole(flange.bolt, HoleFit::coarse);
  const std::string bolt = "M" + std::to_string(flange.bolt);
  if (channel.wall_height <= 0.0) return;
  if (flange.width > channel.wall_height) {
    objections.add("flanges.width",
                   "width: " + length_text(flange.width) + " is more than the walls are high, " +
                       length_text(channel.wall_height),
                   "The frame would stand out farther than the channel is deep.", "a smaller width");
    return;
  }
  const double column =
      channel.wall_height - kEdgeAtTop * hole + channel.thickness + flange.gap + 0.5 * flange.width;
  if (column < kLeastPitch * hole) {
    objections.add("flanges.bolt",
                   "bolt: " + bolt + " finds no place beside walls of " + length_text(channel.wall_height),
                   "Two holes of " + length_text(hole) + " are " + length_text(column) + " apart there.",
                   "a smaller bolt");
  }
}

void object_to_split(const SplitOptions& split, Objections& objections) {
  objections.positive(split.sheet.x, "split.sheet");
  objections.positive(split.sheet.y, "split.sheet");
  if (split.longest) objections.positive(*split.longest, "split.longest");
  if (split.heaviest && !(*split.heaviest > 0.0)) {
    objections.add("split.heaviest", "heaviest: " + as_mass(*split.heaviest) + " is not positive", "",
                   "25 kg");
  }
}

void object_to_step(double step, Objections& objections) {
  if (step >= 0.0) return;
  objections.add("joint_step", "joint_step: " + length_text(step) + " is a step up",
                 "The downstream edge is never higher than the upstream edge.", "joint_step: 0 mm");
}

}  // namespace

std::vector<ShopCheck> part_checks(const PlateOptions& options, const Workshop& workshop) {
  std::vector<ShopCheck> checks;
  check_sizes(options.split, workshop, checks);
  check_holes(workshop, checks);
  return checks;
}

ShopCheck rolling_check(double radius, double thickness, const std::string& where) {
  ShopCase rolling(kRolling);
  rolling.see(radius, 20.0 * thickness, where, as_length);
  std::vector<ShopCheck> checks;
  rolling.add_to(checks);
  return checks.front();
}

std::vector<ShopCheck> shop_checks(const Job& job, const std::vector<Unit>& units, const Workshop& workshop) {
  std::vector<ShopCheck> checks = part_checks(job.options, workshop);
  check_floor(job, units, checks);
  return checks;
}

std::vector<Issue> common_problems(const PlateOptions& options) {
  Objections objections;
  object_to_split(options.split, objections);
  object_to_bolts(options.flanges, objections);
  object_to_step(options.joint_step, objections);
  const auto only_on_channels = [&](bool wanted, const char* key) {
    if (!wanted) return;
    objections.add(key, std::string(key) + ": it goes with a flat floor and upright walls alone",
                   "Other sections have no place that it fits.", "a cross_section of kind: u-channel");
  };
  objections.positive(options.stave_tolerance, "stave_tolerance");
  objections.positive(options.polygon_thickness, "thickness");
  only_on_channels(options.rim.has_value(), "rim");
  only_on_channels(options.stiffeners.has_value(), "stiffeners");
  only_on_channels(options.liner.has_value(), "liner");
  only_on_channels(options.cover.has_value(), "cover");
  only_on_channels(!options.inspection.empty(), "inspection");
  only_on_channels(options.lifting.has_value(), "lifting");
  only_on_channels(options.supports.has_value(), "supports");
  return std::move(objections).all();
}

}  // namespace parts

std::vector<Issue> plate_problems(const ChannelMeasures& channel, const PlateOptions& options) {
  using namespace parts;
  Objections objections;
  objections.positive(channel.width, "width");
  objections.positive(channel.thickness, "thickness");
  object_to_split(options.split, objections);
  object_to_flanges(channel, options.flanges, objections);
  if (options.floor == FloorMake::bent) {
    const double radius = options.bend.inner_radius.value_or(channel.thickness);
    if (radius < (1.0 - 1e-9) * channel.thickness) {
      objections.add("bend.inner_radius",
                     "inner_radius: " + length_text(radius) + " is less than the plate's thickness",
                     "Mild steel cracks below " + length_text(channel.thickness) + " (1 thickness).",
                     "inner_radius: " + length_text(channel.thickness));
    }
    if (options.walls == WallSeat::on_floor) {
      objections.add("walls", "walls: on-floor does not go with a bent floor",
                     "Between the bends the floor departs from the walls' lower edges.",
                     "walls: beside-floor, or floor: rolled");
    }
  }
  object_to_step(options.joint_step, objections);
  std::vector<Issue> issues = std::move(objections).all();
  for (Issue& issue : fitting_problems(channel, options)) issues.push_back(std::move(issue));
  return issues;
}

}  // namespace glissade
