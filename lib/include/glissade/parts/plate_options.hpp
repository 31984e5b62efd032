#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/parts/nest_stock.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// What plates are made of.
struct StockMaterial {
  std::string name = "S235";
  double density = 7850.0;  ///< [kg/m^3]; > 0

  friend bool operator==(const StockMaterial&, const StockMaterial&) = default;
};

/// How a curved floor is made: on plate rolls, or by hits of a press.
enum class FloorMake { rolled, bent };

/// What decides how many bends a floor gets.
enum class FacetRule {
  speed_loss,       ///< share of the exit speed that the bends may cost
  chord_tolerance,  ///< greatest distance between facets and track [m]
  bends,            ///< how many in all
  segment_length,   ///< greatest length of a facet [m]
  segment_angle     ///< greatest angle of a bend [rad]
};

/// How a bent floor is divided into facets, and how it is bent.
struct BendOptions {
  FacetRule rule = FacetRule::speed_loss;
  double value = 0.01;                 ///< of the rule, in its unit; > 0
  std::optional<double> inner_radius;  ///< of the punch [m]; none: the plate's thickness
  std::optional<double>
      k_factor;  ///< neutral fibre, 0 inside to 1; none: k_factor() by radius over thickness

  friend bool operator==(const BendOptions&, const BendOptions&) = default;
};

/// Where walls stand: beside the floor, their lower edges flush with its underside, or on it.
enum class WallSeat { beside_floor, on_floor };

/// How floor and walls of a channel meet.
enum class CornerJoint {
  butt,         ///< edge against face, flush
  lap,          ///< the plate that passes the other reaches beyond it, with room for a weld
  tab_and_slot  ///< as lap; tabs of the plate that ends there stand in slots of the one that passes
};
/// The joint along the edges where plates of a channel meet.
struct CornerOptions {
  CornerJoint kind = CornerJoint::butt;
  double overlap = 15e-3;     ///< beyond the other plate's far face [m]; > 0
  double tab = 40e-3;         ///< width of a tab, along the track [m]
  double spacing = 300e-3;    ///< greatest distance of tabs [m]
  double clearance = 0.2e-3;  ///< by which a slot is larger than its tab, in all, both ways [m]; >= 0

  friend bool operator==(const CornerOptions&, const CornerOptions&) = default;
};

/// What no part may exceed. Ends of parts are where the track bends least.
struct SplitOptions {
  std::optional<double> longest;   ///< length of a transport unit along the track [m]
  Vec2 sheet{3.0, 1.5};            ///< stock, longer side first [m]
  std::optional<double> heaviest;  ///< mass of a part [kg]
  bool allowed = true;             ///< false: everything in one piece, or an error
  /// Of a strip of a plate, across the track [m]; what is wider is strips side by side, welded along the track. None: as the sheet asks.
  std::optional<double> widest = std::nullopt;
  double bar = 6.0;  ///< stock length of angles, tubes and flat bars [m]; > 0
  int frames =
      1;  ///< pieces of a frame, ring or stiffener of plate, at least; of 1 they are whole where the sheet takes them
  double margin = NestStock{}.margin;    ///< of the sheet's edges that stays free of parts [m]; >= 0
  double spacing = NestStock{}.spacing;  ///< between parts on one sheet [m]; >= 0

  [[nodiscard]] NestStock stock() const { return NestStock::of(sheet, margin, spacing); }

  friend bool operator==(const SplitOptions&, const SplitOptions&) = default;
};

/// On which side of a joint a frame lies, seen the way that the body goes.
enum class FlangeSide { upstream, downstream };

/// What flanges are made of: a plate or ring cut from the sheet, or equal angles whose one leg is welded along the channel.
enum class FlangeSection { flat, angle };

/// Frames round both ends of every transport unit, bolted together at the joints.
struct FlangeOptions {
  bool wanted = true;
  double width = 50e-3;     ///< of the bar, from the channel outwards; of an angle of both legs [m]
  double thickness = 6e-3;  ///< [m]
  int bolt = 10;            ///< nominal diameter of a metric bolt [mm]; one of bolt_sizes()
  double pitch = 150e-3;    ///< greatest distance of bolts [m]
  double gap = 0.5e-3;      ///< between channel and frame, for welding [m]
  bool as_told =
      false;  ///< kept where the usual measures, these, do not fit the section; else what fits is taken
  /// Of the two frames at a joint the one with slots, square to the floor, in place of round holes; none: neither.
  std::optional<FlangeSide> slotted = std::nullopt;
  std::optional<double> slot =
      std::nullopt;  ///< overall length of the slots [m]; none: 2.5 bolt diameters (EN 1090-2)
  FlangeSection section = FlangeSection::flat;

  /// How far it reaches along the track from the joint [m].
  [[nodiscard]] double along() const { return section == FlangeSection::angle ? width : thickness; }

  friend bool operator==(const FlangeOptions&, const FlangeOptions&) = default;
};

/// How round sections are made of plates: rolled tubes or troughs between mitred planes, or flat strips along the track.
enum class RoundMake {
  as_fits,  ///< mitred, unless the sheet or the radii of the track forbid it
  mitred,
  staves
};

/// A flat bar along the outside of each wall's top.
struct RimOptions {
  double width = 40e-3;     ///< outwards [m]
  double thickness = 5e-3;  ///< its upper face is level with the wall's top [m]

  friend bool operator==(const RimOptions&, const RimOptions&) = default;
};

/// Plates round the channel between its ends, against bulging.
struct StiffenerOptions {
  double spacing = 0.8;     ///< greatest distance along the track [m]
  double width = 40e-3;     ///< from the channel outwards [m]
  double thickness = 6e-3;  ///< [m]

  friend bool operator==(const StiffenerOptions&, const StiffenerOptions&) = default;
};

/// Where tiles of the wearing kind lie: all over the floor, or where it wears; plain ones as thick, of the chute's own
/// material, everywhere else.
enum class LinerPlaces { whole, worn };

/// What a stream does to a floor at a place, the most over all of its rides.
struct FloorWear {
  double at = 0.0;         ///< arc length [m]
  double share = 0.0;      ///< of the wear at its peak, 0 to 1
  double loss_rate = 0.0;  ///< thickness that a liner loses there [m/s]; 0: not known

  friend bool operator==(const FloorWear&, const FloorWear&) = default;
};

/// Plates that wear in place of the floor. Their upper faces are the track's floor; the floor plate lies below them.
struct LinerOptions {
  StockMaterial material{"400 HB", 7850.0};
  double thickness = 6e-3;   ///< [m]
  double tile_length = 0.6;  ///< greatest, along the track [m]
  double tile_width = 0.2;   ///< greatest, across [m]
  double gap = 2e-3;         ///< between tiles, and beside the walls [m]
  double heaviest = 25.0;    ///< mass of a tile [kg]
  int bolt = 8;              ///< countersunk [mm]
  LinerPlaces where = LinerPlaces::whole;
  double worn_from = 0.5;         ///< share of the peak from which a floor counts as worn; > 0, at most 1
  std::optional<double> life;     ///< for which spare tiles are listed [s]; > 0
  std::optional<double> tonnage;  ///< the same, by what flows through [kg]; > 0, not both

  friend bool operator==(const LinerOptions&, const LinerOptions&) = default;
};

/// Lids over the walls, bolted to the rim.
struct CoverOptions {
  double thickness = 2e-3;  ///< [m]
  int bolt = 8;             ///< [mm]
  double pitch = 300e-3;    ///< [m]

  friend bool operator==(const CoverOptions&, const CoverOptions&) = default;
};

/// An opening with a lid that is bolted over it: in the left wall, the widest upright side on the left, or
/// the left of a mitred tube.
struct InspectionOptions {
  double at = 0.0;       ///< its middle, along the track [m]
  double length = 0.2;   ///< along the track [m]
  double height = 0.15;  ///< across it, along the wall [m]
  int bolt = 8;          ///< of the lid [mm]

  friend bool operator==(const InspectionOptions&, const InspectionOptions&) = default;
};

/// Lugs beside the centre of gravity of each unit, one on each side.
struct LiftingOptions {
  double thickness = 10e-3;  ///< [m]
  double hole = 22e-3;       ///< for a shackle [m]

  friend bool operator==(const LiftingOptions&, const LiftingOptions&) = default;
};

/// Trestles from the ground to the underside: saddles, a cross beam, two legs with base plates and braces.
struct SupportOptions {
  std::vector<Vec2> ground;  ///< (x, height above the start), from left to right; one point: level [m]
  double spacing = 2.0;      ///< greatest distance along the track [m]
  double tube = 60e-3;       ///< outside of the square tubes [m]
  double wall = 4e-3;        ///< of the tubes [m]
  Angle steepest = Angle::from_degrees(60.0);  ///< slope angle of the track beyond which none stands
  double braced_from = 1.5;                    ///< length of a leg from which a trestle is braced [m]
  double grout = 25e-3;                        ///< below the base plates [m]
  int anchor = 12;                             ///< [mm]

  friend bool operator==(const SupportOptions&, const SupportOptions&) = default;
};

/// The least that the rules of a shop ask for: what is less is refused, and bent floors keep to it.
struct ShopLeast {
  double hole_edge_diameters = 1.2;      ///< from a hole's middle to an edge (EN 1993-1-8)
  double hole_pitch_diameters = 2.4;     ///< between holes' middles, across the force (EN 1993-1-8)
  double slot_edge_diameters = 1.5;      ///< from the middles of a slot's ends to an edge (EN 1993-1-8)
  double bend_radius_thicknesses = 1.0;  ///< inside a bend, mild steel
  double flat_thicknesses = 4.0;         ///< between bends: half the opening of a usual die
  double flat = 0.0;                     ///< the same, whatever the thickness [m]

  friend bool operator==(const ShopLeast&, const ShopLeast&) = default;
};

/// How a channel is made of plates.
struct PlateOptions {
  static constexpr std::string_view kProcess = "plate";
  static constexpr double kArcTolerance = 0.1e-3;  ///< [m]

  StockMaterial material;
  FloorMake floor = FloorMake::rolled;
  BendOptions bend;
  WallSeat walls = WallSeat::beside_floor;
  CornerOptions corners;
  SplitOptions split;
  FlangeOptions flanges;
  RoundMake round = RoundMake::as_fits;
  double stave_tolerance = 2e-3;  ///< greatest distance of staves from a round section [m]; > 0
  /// Of the plates round a section that has none itself [m]; > 0. None: 4 mm, or the thickest stock that fits.
  std::optional<double> polygon_thickness;
  std::optional<RimOptions> rim;
  std::optional<StiffenerOptions> stiffeners;
  std::optional<LinerOptions> liner;
  std::optional<CoverOptions> cover;
  std::vector<InspectionOptions> inspection;
  std::optional<LiftingOptions> lifting;
  std::optional<SupportOptions> supports;
  /// By ascending places; asked for by a liner with `worn` or `life`, which a stream alone has. No option: whoever knows the
  /// stream fills it in, and the liner's `life` from its `tonnage`.
  std::vector<FloorWear> floor_wear;
  bool hood = true;         ///< of a track below a hood: that becomes plates, too
  double joint_step = 0.0;  ///< by which the floor may drop at a joint, downstream [m]; >= 0
  ShopLeast shop;           ///< no option: whoever knows the shop's rules fills it in

  friend bool operator==(const PlateOptions&, const PlateOptions&) = default;
};

/// Inside measures of a channel of flat plates [m].
struct ChannelMeasures {
  double width = 0.0;
  double wall_height = 0.0;  ///< 0: a slab without walls
  double thickness = 0.0;
  double wall_thickness = 0.0;  ///< of curbs; 0: as the floor

  [[nodiscard]] double wall() const { return wall_thickness > 0.0 ? wall_thickness : thickness; }

  friend bool operator==(const ChannelMeasures&, const ChannelMeasures&) = default;
};

/// @return neutral fibre of a bend as a share of the thickness, from inside: DIN 6935, K = 0.325 + 0.25 lg(r/t), at most 0.5
[[nodiscard]] double k_factor(double inner_radius, double thickness);

/// @return nominal diameters of metric bolts [mm] whose clearance holes are known
[[nodiscard]] const std::vector<int>& bolt_sizes();
/// Fit of a clearance hole, ISO 273.
enum class HoleFit { fine, medium, coarse };
/// @return its diameter [m]
/// @throws InputError if the size is not one of bolt_sizes()
[[nodiscard]] double clearance_hole(int bolt, HoleFit fit);

/// Measures and options that no shop can make, whatever the track is: all of them.
/// @return issues whose `where` is the key: "flanges.pitch", "bend.inner_radius"; of the channel "width", "thickness"
[[nodiscard]] std::vector<Issue> plate_problems(const ChannelMeasures& channel, const PlateOptions& options);

}  // namespace glissade
