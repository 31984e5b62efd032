// What no shop can make of options, whatever the track is.

#include "parts/plates/plate_checks.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "parts/plates/angle_frames.hpp"
#include "parts/plates/corners.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kLeastStrip = 50e-3;  // [m]

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
  void add(Issue issue) { issues_.push_back(std::move(issue)); }
  [[nodiscard]] std::vector<Issue>& issues() { return issues_; }
  [[nodiscard]] std::vector<Issue> all() && { return std::move(issues_); }

 private:
  std::vector<Issue> issues_;
};

/// Whose bound it is.
/// @param asked  by the rules of the shop
std::string asked_by(double bound, double asked, double usual) {
  if (bound > asked) return " (less leaves no web).";
  return bound == usual ? " (EN 1993-1-8)." : " (the rules of this shop).";
}

/// A length that the text of it does not make less.
double next_up(double length) {
  constexpr double kStep = 0.1e-3;  // [m]
  return kStep * std::ceil(length / kStep - 1e-6);
}

/// Of frames round any section.
void object_to_bolts(const PlateOptions& options, Objections& objections) {
  const FlangeOptions& flange = options.flanges;
  const ShopLeast& shop = options.shop;
  if (!flange.wanted) return;
  objections.positive(flange.width, "flanges.width");
  objections.positive(flange.thickness, "flanges.thickness");
  objections.positive(flange.pitch, "flanges.pitch");
  if (!is_bolt_size(flange.bolt)) {
    objections.add("flanges.bolt",
                   "bolt: M" + std::to_string(flange.bolt) + " is no size whose holes are known", "",
                   "M5, M6, M8, M10, M12, M16, M20 or M24");
    return;
  }
  const double hole = clearance_hole(flange.bolt, HoleFit::coarse);
  const std::string bolt = "M" + std::to_string(flange.bolt);
  const double edge = hole_edge_diameters(shop) * hole;
  if (flange.section == FlangeSection::angle) {
    add_slot_problems(options, objections.issues());
    add_angle_problems(options, objections.issues());
  } else if (0.5 * flange.width < edge) {
    objections.add(
        "flanges.width",
        "width: " + length_text(flange.width) + " puts holes for " + bolt + " " +
            length_text(0.5 * flange.width) + " from the edge",
        "Their centres are at least " + length_text(edge) + " from it" +
            asked_by(edge, shop.hole_edge_diameters * hole, ShopLeast{}.hole_edge_diameters * hole),
        "a width of at least " + length_text(next_up(2.0 * edge)) + ", or a smaller bolt");
  } else {
    add_slot_problems(options, objections.issues());
  }
}

void object_to_flanges(const ChannelMeasures& channel, const PlateOptions& options, Objections& objections);

/// A frame no wider than the walls are high, with the largest bolt that finds place in it.
std::string frame_that_fits(const ChannelMeasures& channel, const PlateOptions& options) {
  const bool angle = options.flanges.section == FlangeSection::angle;
  std::vector<int> sizes = bolt_sizes();
  std::sort(sizes.rbegin(), sizes.rend());
  PlateOptions with = options;
  with.flanges.width = channel.wall_height;
  for (const int size : sizes) {
    if (angle || size > options.flanges.bolt) continue;
    with.flanges.bolt = size;
    Objections left;
    object_to_flanges(channel, with, left);
    if (!left.issues().empty()) continue;
    return "width: " + length_text(channel.wall_height) +
           (size == options.flanges.bolt ? "" : " with bolt: M" + std::to_string(size)) +
           ", or flanges: none";
  }
  return angle ? "a narrower angle, or flanges: none" : "higher walls, or flanges: none";
}

void object_to_flanges(const ChannelMeasures& channel, const PlateOptions& options, Objections& objections) {
  const FlangeOptions& flange = options.flanges;
  object_to_bolts(options, objections);
  const bool known = is_bolt_size(flange.bolt);
  if (!flange.wanted || !known) return;
  const double hole = clearance_hole(flange.bolt, HoleFit::coarse);
  const std::string bolt = "M" + std::to_string(flange.bolt);
  if (channel.wall_height <= 0.0) {
    add_angle_seat_problems(channel_seat(channel, options), options, objections.issues());
    return;
  }
  if (flange.width > channel.wall_height) {
    objections.add("flanges.width",
                   "width: " + length_text(flange.width) + " is more than the walls are high, " +
                       length_text(channel.wall_height),
                   "The frame would stand out farther than the channel is deep.",
                   frame_that_fits(channel, options));
    return;
  }
  if (flange.section == FlangeSection::angle) {
    add_angle_seat_problems(channel_seat(channel, options), options, objections.issues());
    return;
  }
  const double rim = bolts_below_rim(options);
  const bool for_rim = rim > below_top(flange);
  const double column = channel.wall_height - std::max(below_top(flange), rim) + channel.thickness +
                        flange.gap + 0.5 * flange.width;
  if (column < hole_pitch_diameters(options.shop) * hole + 2.0 * slot_reach(flange)) {
    objections.add(
        "flanges.bolt",
        "bolt: " + bolt + " finds no place beside walls of " + length_text(channel.wall_height),
        "Two " + std::string(flange.slotted ? "slots, as wide as holes" : "holes") + " of " +
            length_text(hole) + (flange.slotted ? "," : "") + " are " + length_text(column) + " apart there" +
            (for_rim ? ", below the rim of " + length_text(options.rim->thickness) : "") + ".",
        std::string(for_rim ? "a thinner rim, " : "") +
            (flange.slotted ? "a smaller bolt, a shorter slot, or slotted: none" : "a smaller bolt"));
  }
}

void object_to_split(const SplitOptions& split, Objections& objections) {
  for (Issue& issue : stock_problems(split.stock())) objections.add(std::move(issue));
  if (split.longest) objections.positive(*split.longest, "split.longest");
  objections.positive(split.bar, "split.bar");
  if (split.frames < 1 || split.frames > kMostFramePieces) {
    objections.add(
        "split.frames",
        "frames: " + std::to_string(split.frames) + " lies outside 1 to " + std::to_string(kMostFramePieces),
        "So many pieces make a frame, a ring or a stiffener.", "frames: 3");
  } else if (split.frames > 1 && !split.allowed) {
    objections.add("split.frames", "frames: " + std::to_string(split.frames) + " beside allowed: false",
                   "One piece is asked for, and pieces.", "one of them");
  }
  if (split.widest && !(*split.widest >= kLeastStrip)) {
    objections.add(
        "split.widest", "widest: " + length_text(*split.widest) + " is too narrow",
        "Strips that are welded along the track are at least " + length_text(kLeastStrip) + " wide.",
        "widest: 1 m");
  } else if (split.widest && !split.allowed) {
    objections.add("split.widest", "widest beside allowed: false", "One piece is asked for, and strips.",
                   "one of them");
  }
  if (split.heaviest && !(*split.heaviest > 0.0)) {
    objections.add("split.heaviest",
                   "heaviest: " + quantity_text(*split.heaviest, Dimension::mass) + " is not positive", "",
                   "25 kg");
  }
}

void object_to_step(double step, Objections& objections) {
  if (step >= 0.0) return;
  objections.add("joint_step", "joint_step: " + length_text(step) + " is a step up",
                 "The downstream edge is never higher than the upstream edge.", "joint_step: 0 mm");
}

}  // namespace

std::optional<Issue> too_tight_a_bend(double thickness, const PlateOptions& options,
                                      const std::string& part) {
  const double radius = options.bend.inner_radius.value_or(thickness);
  const double asked = options.shop.bend_radius_thicknesses;
  const double least = asked * thickness;
  if (!(radius < (1.0 - 1e-9) * least)) return std::nullopt;
  const bool usual = asked == ShopLeast{}.bend_radius_thicknesses;
  return Issue{"bend.inner_radius",
               usual ? "inner_radius: " + length_text(radius) + " is less than the " + part + "'s thickness"
                     : "inner_radius: " + length_text(radius) + " is less than the shop bends",
               usual ? "Mild steel cracks below " + length_text(thickness) + " (1 thickness)."
                     : "Its rules ask for " + length_text(least) + " (" + rounded_text(asked, 4) +
                           " thicknesses of the " + part + ") or more.",
               "inner_radius: " + length_text(least)};
}

std::vector<Issue> common_problems(const PlateOptions& options) {
  Objections objections;
  object_to_split(options.split, objections);
  object_to_bolts(options, objections);
  object_to_step(options.joint_step, objections);
  objections.positive(options.stave_tolerance, "stave_tolerance");
  if (options.polygon_thickness) objections.positive(*options.polygon_thickness, "thickness");
  return std::move(objections).all();
}

std::vector<Issue> channel_problems(const ChannelMeasures& channel, const PlateOptions& options) {
  Objections objections;
  objections.positive(channel.width, "width");
  objections.positive(channel.thickness, "thickness");
  object_to_split(options.split, objections);
  object_to_flanges(channel, options, objections);
  if (options.floor == FloorMake::bent) {
    if (auto issue = too_tight_a_bend(channel.thickness, options)) objections.add(std::move(*issue));
    if (options.walls == WallSeat::on_floor) {
      objections.add("walls", "walls: on-floor does not go with a bent floor",
                     "Between the bends the floor departs from the walls' lower edges.",
                     "walls: beside-floor, or floor: rolled");
    }
  }
  object_to_step(options.joint_step, objections);
  std::vector<Issue> issues = std::move(objections).all();
  for (Issue& issue : corner_problems(channel, options)) issues.push_back(std::move(issue));
  for (Issue& issue : fitting_problems(channel, options)) issues.push_back(std::move(issue));
  return issues;
}

}  // namespace glissade::parts
