// What no shop can make of what is set on plates, whatever the track is.

#include "glissade/core/number_text.hpp"

#include "parts/plates/fittings.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/stiffener_row.hpp"
#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kLeastWeb = 20e-3;    // of a wall above and below an opening [m]
constexpr double kLeastRound = 20e-3;  // of a stiffener, beyond a corner that laps [m]

class Refusals {
 public:
  void add(const char* where, std::string what, std::string why, std::string hint) {
    issues_.push_back({where, std::move(what), std::move(why), std::move(hint)});
  }
  void positive(double value, const char* where, const char* key) {
    if (value > 0.0) return;
    add(where, std::string(key) + ": " + length_text(value) + " is not positive", "", "a positive length");
  }
  void bolt(int size, const char* where, const char* key) {
    if (is_bolt_size(size)) return;
    add(where, std::string(key) + ": M" + std::to_string(size) + " is no size whose holes are known", "",
        "M5, M6, M8, M10, M12, M16, M20 or M24");
  }
  [[nodiscard]] std::vector<Issue> all() && { return std::move(issues_); }

 private:
  std::vector<Issue> issues_;
};

/// Tiles hold their bolts: half ones 1.2 hole diameters from both edges.
void object_to_tiles(const ChannelMeasures& channel, const LinerOptions& liner, Refusals& refusals) {
  const bool known = is_bolt_size(liner.bolt);
  if (!known || !(liner.tile_width > 0.0) || !(liner.tile_length > 0.0)) return;
  const double least = 2.4 * clearance_hole(liner.bolt, HoleFit::medium);
  const std::string why =
      "Holes for M" + std::to_string(liner.bolt) + " take " + length_text(least, 3) + " with their edges.";
  const double count = std::ceil(channel.width / liner.tile_width - 1e-9);
  const double full = (channel.width - (count + 1.0) * liner.gap) / count;
  if (0.5 * (full - liner.gap) < least) {
    refusals.add(
        "liner.tile_width",
        "tile_width: " + length_text(liner.tile_width) + " makes half tiles of " +
            length_text(0.5 * (full - liner.gap), 3),
        why, "tile_width: " + length_text(2.0 * least + 3.0 * liner.gap, 2) + " or more, or a smaller bolt");
  }
  if (liner.tile_length - liner.gap < least) {
    refusals.add("liner.tile_length", "tile_length: " + length_text(liner.tile_length) + " is too short", why,
                 "tile_length: 600 mm");
  }
}

/// Heads end flush with the faces of tiles: what juts out is in the way of what slides.
void object_to_heads(const LinerOptions& liner, Refusals& refusals) {
  if (!is_bolt_size(liner.bolt) || !(liner.thickness > 0.0)) return;
  const std::string name = "M" + std::to_string(liner.bolt);
  const Bolt& bolt = bolt_of(liner.bolt);
  if (bolt.head_height == 0.0) {
    refusals.add("liner.bolt", "bolt: " + name + " has no countersunk head",
                 "Tiles are held by countersunk bolts, and ISO 10642 ends at M20.", "a bolt of M5 to M20");
    return;
  }
  if (liner.thickness >= bolt.head_height) return;
  std::string smaller;
  for (const int size : bolt_sizes()) {
    const double height = bolt_of(size).head_height;
    if (height > 0.0 && height <= liner.thickness) smaller = "bolt: M" + std::to_string(size) + ", or ";
  }
  refusals.add(
      "liner.thickness",
      "thickness: " + length_text(liner.thickness) + " is less than the heads of " + name + " are high, " +
          length_text(bolt.head_height),
      "Tiles are held by countersunk bolts (ISO 10642), whose heads must not jut out of their faces.",
      smaller + "a thickness of " + length_text(bolt.head_height) + " or more");
}

void object_to_liner(const ChannelMeasures& channel, const PlateOptions& options, Refusals& refusals) {
  const LinerOptions& liner = *options.liner;
  refusals.positive(liner.thickness, "liner.thickness", "thickness");
  refusals.positive(liner.tile_length, "liner.tile_length", "tile_length");
  refusals.positive(liner.tile_width, "liner.tile_width", "tile_width");
  const double tile = std::min(liner.tile_length, liner.tile_width);
  if (tile > 0.0 && liner.thickness > tile) {
    refusals.add("liner.thickness",
                 "thickness: " + length_text(liner.thickness) + " is more than a tile is " +
                     (tile < liner.tile_width ? "long, " : "wide, ") + length_text(tile),
                 "Tiles are plates that lie on the floor.", "thickness: 6 mm");
  }
  refusals.bolt(liner.bolt, "liner.bolt", "bolt");
  object_to_heads(liner, refusals);
  if (!(liner.heaviest > 0.0)) {
    refusals.add("liner.heaviest", "heaviest: " + rounded_text(liner.heaviest, 4) + " kg is not positive", "",
                 "25 kg");
  }
  const auto percent = [](double share, int digits) { return rounded_text(100.0 * share, digits) + " %"; };
  if (!(liner.worn_from > 0.0 && liner.worn_from <= 1.0)) {
    refusals.add("liner.worn_from",
                 "worn_from: " + text_beyond(liner.worn_from, {0.0, 1.0}, percent) + " is out of range",
                 "It is a share of the wear where the floor wears most: above 0 to 100 %.", "50 %");
  }
  for (const auto& [value, key] :
       {std::pair(liner.life, "liner.life"), std::pair(liner.tonnage, "liner.tonnage")}) {
    if (value && !(*value > 0.0))
      refusals.add(key, std::string(key).substr(6) + " is not positive", "A liner is to last for some time.",
                   "20000 h");
  }
  if (liner.life && liner.tonnage) {
    refusals.add("liner.tonnage", "tonnage beside life", "Either says how long tiles are to last.",
                 "one of them");
  }
  if (!(liner.gap >= 0.0) || liner.gap > 0.1 * channel.width) {
    refusals.add(
        "liner.gap",
        "gap: " + text_beyond(liner.gap, {0.0, 0.1 * channel.width}, &length_text) + " is out of range",
        "Gaps between tiles are 0 to a tenth of the floor's width, " + length_text(0.1 * channel.width) + ".",
        "gap: 2 mm");
  }
  object_to_tiles(channel, liner, refusals);
  if (options.floor == FloorMake::bent) {
    refusals.add("liner", "liner: curbs follow the track where tiles would follow the flats of a bent floor",
                 "Curbs are cut along arcs; between bends tiles would leave them.",
                 "floor: rolled, or a cross_section of kind u-channel or trapezoid");
  }
}

void object_to_rim(const ChannelMeasures& channel, const PlateOptions& options, Refusals& refusals) {
  const RimOptions& rim = *options.rim;
  refusals.positive(rim.width, "rim.width", "width");
  refusals.positive(rim.thickness, "rim.thickness", "thickness");
  if (rim.thickness > 0.5 * channel.wall_height) {
    refusals.add("rim.thickness",
                 "thickness: " + length_text(rim.thickness) + " is more than half the walls, " +
                     length_text(channel.wall_height),
                 "The rim lies against them.", "thickness: 5 mm");
  }
  if (rim.width > channel.wall_height) {
    refusals.add("rim.width",
                 "width: " + length_text(rim.width) + " is more than the walls are high, " +
                     length_text(channel.wall_height),
                 "The rim would stand out farther than the channel is deep.",
                 "width: " + length_text(channel.wall_height) + " or less");
  }
}

void object_to_cover(const PlateOptions& options, Refusals& refusals) {
  refusals.positive(options.cover->thickness, "cover.thickness", "thickness");
  if (!(options.cover->pitch >= 40e-3)) {
    refusals.add("cover.pitch", "pitch: " + length_text(options.cover->pitch) + " is too close",
                 "Bolts of covers are at least 40 mm apart.", "pitch: 300 mm");
  }
  refusals.bolt(options.cover->bolt, "cover.bolt", "bolt");
  if (options.rim && is_bolt_size(options.cover->bolt)) {
    const double least =
        2.0 * hole_edge_diameters(options.shop) * clearance_hole(options.cover->bolt, HoleFit::coarse);
    if (options.rim->width < least - 1e-9) {
      refusals.add(
          "cover.bolt",
          "bolt: the middle of holes for M" + std::to_string(options.cover->bolt) + " is " +
              length_text(0.5 * options.rim->width) + " from both edges of the rim",
          "At least " + length_text(0.5 * least, 3) + " are asked for.",
          "rim: {width: " + length_text(std::ceil(1e3 * least - 1e-6) / 1e3) + "}, or a smaller bolt");
    }
  }
  if (options.rim && options.rim->width > 0.0 && options.cover->thickness > options.rim->width) {
    refusals.add("cover.thickness",
                 "thickness: " + length_text(options.cover->thickness) +
                     " is more than the rim below it is wide, " + length_text(options.rim->width),
                 "A cover is a sheet that lies on rims and is bolted to them.", "thickness: 2 mm");
  }
  if (!options.rim)
    refusals.add("cover", "cover: it is bolted to a rim, and there is none", "", "rim: {width: 40 mm}");
}

void object_to_opening_values(const PlateOptions& options, Refusals& refusals) {
  for (const InspectionOptions& opening : options.inspection) {
    refusals.positive(opening.length, "inspection", "length");
    refusals.positive(opening.height, "inspection", "height");
    refusals.bolt(opening.bolt, "inspection", "bolt");
  }
}

void object_to_openings(const ChannelMeasures& channel, const PlateOptions& options, Refusals& refusals) {
  const double rim = options.rim ? options.rim->thickness + 2e-3 : 0.0;
  object_to_opening_values(options, refusals);
  for (const InspectionOptions& opening : options.inspection) {
    const double lap = lid_lap(opening, options.shop);
    const double most = channel.wall_height - rim - 2.0 * std::max(lap, kLeastWeb);
    if (opening.height <= most) continue;
    refusals.add("inspection",
                 "height: " + length_text(opening.height) + " leaves too little of the wall, " +
                     length_text(channel.wall_height),
                 "Its lid laps over by " + length_text(lap) + " all round.",
                 most >= kLeastOpening ? "height: " + length_text(most, 3)
                                       : "no inspection, or a wall_height of at least " +
                                             length_text(channel.wall_height - most + opening.height, 3));
  }
}

void object_to_supports(const PlateOptions& options, Refusals& refusals) {
  const SupportOptions& supports = *options.supports;
  if (!(supports.spacing >= 4.0 * supports.tube)) {
    refusals.add(
        "supports.spacing", "spacing: " + length_text(supports.spacing) + " leaves no room between trestles",
        "They are at least four tubes apart, " + length_text(4.0 * supports.tube) + ".", "spacing: 2 m");
  }
  refusals.positive(supports.tube, "supports.tube", "tube");
  refusals.bolt(supports.anchor, "supports.anchor", "anchor");
  if (!(supports.wall > 0.0) || 2.0 * supports.wall >= supports.tube) {
    refusals.add(
        "supports.wall",
        "wall: " + length_text(supports.wall) + " does not go into a tube of " + length_text(supports.tube),
        "", "wall: 4 mm");
  }
  for (std::size_t i = 1; i < supports.ground.size(); ++i) {
    if (supports.ground[i].x > supports.ground[i - 1].x) continue;
    refusals.add("supports.ground", "ground: its points do not lead from left to right", "",
                 "points in the order of their x");
    break;
  }
}

void object_to_stiffeners(const PlateOptions& options, double lap, Refusals& refusals) {
  const StiffenerOptions& stiffeners = *options.stiffeners;
  if (!(stiffeners.spacing >= least_apart(stiffeners))) {
    refusals.add("stiffeners.spacing",
                 "spacing: " + length_text(stiffeners.spacing) + " leaves no room to weld them",
                 "They are at least ten thicknesses apart, " + length_text(least_apart(stiffeners)) + ".",
                 "spacing: 800 mm");
  }
  refusals.positive(stiffeners.width, "stiffeners.width", "width");
  if (lap > 0.0 && stiffeners.width < lap + kLeastRound) {
    refusals.add("stiffeners.width",
                 "width: " + length_text(stiffeners.width) + " leaves nothing round corners that lap by " +
                     length_text(lap),
                 "At least " + length_text(kLeastRound) + " of it go round them.",
                 "width: " + length_text(lap + 0.04));
  }
  refusals.positive(stiffeners.thickness, "stiffeners.thickness", "thickness");
}

void object_to_lugs(const LiftingOptions& lifting, Refusals& refusals) {
  refusals.positive(lifting.thickness, "lifting.thickness", "thickness");
  constexpr double kWide = 80e-3;  // of a lug [m]
  if (lifting.thickness > kWide) {
    refusals.add(
        "lifting.thickness",
        "thickness: " + length_text(lifting.thickness) + " is more than a lug is wide, " + length_text(kWide),
        "Lugs are plates.", "thickness: 10 mm");
  }
  if (lifting.hole > 0.0 && lifting.hole <= 40e-3) return;
  refusals.add("lifting.hole", "hole: " + length_text(lifting.hole) + " does not go into a lug",
               "Lugs are 80 mm wide and reach 60 mm above the walls.", "hole: 22 mm");
}

/// @param lap  of corners; 0: none
void object_to_what_is_set(const PlateOptions& options, double lap, Refusals& refusals) {
  if (options.lifting) object_to_lugs(*options.lifting, refusals);
  if (options.stiffeners) object_to_stiffeners(options, lap, refusals);
  if (options.supports) object_to_supports(options, refusals);
}

}  // namespace

std::vector<Issue> fitting_problems(const ChannelMeasures& channel, const PlateOptions& options) {
  Refusals refusals;
  const bool walls = channel.wall_height > 0.0;
  const auto need_walls = [&](bool wanted, const char* key) {
    if (!wanted || walls) return true;
    refusals.add(key, std::string(key) + ": there are no walls to set it on", "",
                 "a cross_section with walls");
    return false;
  };
  if (options.rim && need_walls(true, "rim")) object_to_rim(channel, options, refusals);
  if (options.cover && need_walls(true, "cover")) object_to_cover(options, refusals);
  if (!options.inspection.empty() && need_walls(true, "inspection"))
    object_to_openings(channel, options, refusals);
  const double lap = options.corners.kind != CornerJoint::butt && walls ? options.corners.overlap : 0.0;
  object_to_what_is_set(options, lap, refusals);
  if (options.liner) object_to_liner(channel, options, refusals);
  return std::move(refusals).all();
}

std::vector<Issue> set_on_problems(const PlateOptions& options) {
  Refusals refusals;
  const double lap = options.corners.kind != CornerJoint::butt ? options.corners.overlap : 0.0;
  object_to_what_is_set(options, lap, refusals);
  return std::move(refusals).all();
}

std::vector<Issue> opening_value_problems(const PlateOptions& options) {
  Refusals refusals;
  object_to_opening_values(options, refusals);
  return std::move(refusals).all();
}

std::vector<Issue> liner_problems(const ChannelMeasures& lane, const PlateOptions& options) {
  Refusals refusals;
  if (options.liner) object_to_liner(lane, options, refusals);
  return std::move(refusals).all();
}

std::vector<Issue> cover_problems(const PlateOptions& options) {
  Refusals refusals;
  if (options.cover) object_to_cover(options, refusals);
  return std::move(refusals).all();
}

}  // namespace glissade::parts
