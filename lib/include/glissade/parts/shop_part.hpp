#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace glissade {

/// What a workshop makes, piece by piece, as plain values: the writers of io/ need nothing else. Metres, radians,
/// kilograms; files turn metres into millimetres.

/// A right-handed frame in space: where a part lies in the assembly.
struct Frame {
  Vec3 origin;
  Vec3 x{1.0, 0.0, 0.0};  ///< unit vectors, square to each other
  Vec3 y{0.0, 1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};

  [[nodiscard]] constexpr Vec3 to_space(Vec3 point) const {
    return origin + point.x * x + point.y * y + point.z * z;
  }
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// A region of the part's x-y plane, moved along z from 0 to `depth`: plates cut from the plane, bars, and floors
/// (the region is their side view, the depth their width). Faces are planes and cylinders.
struct Prism {
  PlaneRegion region;
  double depth = 0.0;  ///< [m]; > 0
};

/// What is cut square through a plate that follows a path.
struct SweptWindow {
  double from = 0.0;  ///< arc length along the path [m]
  double to = 0.0;    ///< > from
  double low = 0.0;   ///< as the y of holes [m]
  double high = 0.0;  ///< > low

  friend bool operator==(const SweptWindow&, const SweptWindow&) = default;
};

/// A section moved along a chain of lines and arcs, square to it: plates that lean, whose faces are planes and cones.
struct SweptBody {
  ArcPath path;  ///< open, in the part's x-y plane; tangents continuous
  std::vector<Vec2>
      section;  ///< counter-clockwise seen against the path; x: to the left of the path, y: along z [m]
  /// Along z, of every corner at every vertex of the path, linear in the arc length between: plates beside a width that
  /// changes, faces among them that STEP holds as B-splines. Empty: none moves.
  std::vector<std::vector<double>> shifts = {};
  /// Drilled square through the plate, from the first edge of the section to the one opposite, both parallel; clear of the
  /// joints of the path. x: arc length along the path; y: along the first edge from its first corner [m]. Where corners move:
  /// through level plates, from that corner unmoved; through others on pieces along which none moves, from where it stands there.
  std::vector<Circle> holes = {};
  std::vector<SweptWindow> windows = {};  ///< cut as holes are drilled, each on one such piece
};

/// An edge of a sheet that runs along it and is not square to its faces.
struct Bevel {
  double at = 0.0;     ///< y of the edge on the upper face [m]
  double below = 0.0;  ///< by how much farther along y it stands on the lower one [m]

  friend bool operator==(const Bevel&, const Bevel&) = default;
};

/// A sheet bent to a chain of lines and arcs: plates with slots, tabs and holes, level or leaning. Its faces are planes,
/// cylinders and cones.
struct RolledSheet {
  /// Open, in the part's x-y plane. Tangents are continuous but between lines, which meet at bends without a radius: in the plane
  /// that halves their angle.
  ArcPath path;
  double thickness = 0.0;  ///< of the sheet, below its upper face [m]; > 0
  /// x: arc length along the path, from 0 to its length; y: along the upper face's line across [m]. Edges run along x or y;
  /// those along y and holes keep off the joints of the path, but for its ends. Holes are drilled square; no edge along y
  /// is level with one.
  PlaneRegion region;
  /// Where the upper face's line begins, and its unit direction. x: to the left of the path, y: along z [m]. The lower face
  /// lies to the left of that direction: of a level sheet, (0, 1), below the path.
  Vec2 foot = {0.0, 0.0};
  Vec2 across = {0.0, 1.0};
  std::vector<Bevel> bevels =
      {};  ///< by ascending `at`; between two of them evenly, beyond the last as there
  /// By how much shorter it is at both ends per length to the left of a path that is straight there: planes that halve a bend.
  std::array<double, 2> tilts = {0.0, 0.0};
};

/// A plate of plane facets that meet at bends without a radius: four corners at each bend and at both ends, counter-clockwise seen
/// against the way from the first to the last. Corners of two neighbours lie on the six planes of one facet.
struct FoldedPlate {
  std::vector<std::array<Vec3, 4>> corners;  ///< two or more [m]
};

/// What is cut out of a tube between two planes square to its axis and two through it.
struct TubeWindow {
  double from = 0.0;  ///< along the axis [m]
  double to = 0.0;    ///< > from
  Angle low;          ///< about the axis from x to y
  Angle high;         ///< > low, by less than half a turn

  friend bool operator==(const TubeWindow&, const TubeWindow&) = default;
};

/// A round hole that is drilled through a tube towards its axis.
struct TubeHole {
  double along = 0.0;   ///< of the axis, where that of the hole meets it [m]
  Angle about;          ///< from x to y
  double radius = 0.0;  ///< [m]; > 0

  friend bool operator==(const TubeHole&, const TubeHole&) = default;
};

/// A round tube cut off by two planes: a gore of a mitred pipe. Its axis runs along z through the origin.
struct TubeGore {
  double inner_radius = 0.0;  ///< [m]; > 0
  double thickness = 0.0;     ///< [m]; > 0
  double length = 0.0;        ///< along the axis, between the planes [m]
  Angle start_tilt;           ///< z of the first plane is x tan(start_tilt)
  Angle end_tilt;             ///< z of the second one is length + x tan(end_tilt)
  /// Between the planes at every angle, clear of one another.
  std::vector<TubeWindow> windows = {};
  std::vector<TubeHole> holes = {};
};

/// A trough cut off by two planes: a gore of a mitred half-pipe. Half a round tube whose lowest line is at -x, with upright
/// sides; the round's axis runs along z through the origin.
struct TroughGore {
  double inner_radius = 0.0;  ///< [m]; > 0
  double thickness = 0.0;     ///< [m]; > 0
  double side = 0.0;          ///< height of the sides above the axis [m]; >= 0
  double length = 0.0;        ///< along the axis, between the planes [m]
  Angle start_tilt;           ///< z of the first plane is x tan(start_tilt)
  Angle end_tilt;             ///< z of the second one is length + x tan(end_tilt)
  /// In the round, as a tube's.
  std::vector<TubeWindow> windows = {};
  std::vector<TubeHole> holes = {};
};

/// A bar of angle section, straight or rolled to an arc or ring. One leg lies in the x-y plane between heel and toe, from z = 0 to
/// `thickness`, with holes and slots; the other one rises along the heel up to z = `height`, its inner face above the root. The three
/// lines run side by side, root and toe to the left of the heel: open, their ends at either end on one line, or all closed.
/// Corners are sharp; fillets of rolled bars hold up to 2 % more.
struct AngleBar {
  ArcPath heel;
  ArcPath root;
  ArcPath toe;
  double thickness = 0.0;  ///< of the leg that lies [m]; > 0
  double height = 0.0;     ///< of the leg that rises [m]; > thickness
  std::vector<Circle> holes = {};
  std::vector<ArcPath> slots = {};  ///< closed
};

/// What only facets show: printed pieces with holes and numbers.
struct MeshBody {
  TriangleMesh mesh;  ///< closed, outward, in the part's own frame [m]
};

using PartBody =
    std::variant<Prism, SweptBody, RolledSheet, FoldedPlate, TubeGore, TroughGore, AngleBar, MeshBody>;

/// A straight bend across a flat pattern.
struct BendLine {
  Vec2 from;
  Vec2 to;
  Angle angle;                ///< > 0
  double inner_radius = 0.0;  ///< [m]
  bool up = true;             ///< towards the viewer of the pattern
};

/// A line on the pattern of a rolled plate where its radius changes.
struct RollLine {
  Vec2 from;
  Vec2 to;
  double radius = 0.0;  ///< of the flow face after the line, positive where it curls up; infinity: flat [m]
};

/// What is cut from a sheet, in the sheet's plane, seen on the face that the body slides on where there is one.
struct FlatPattern {
  PlaneRegion region;
  std::vector<BendLine> bends;
  std::vector<RollLine> rolls;
  std::vector<ArcPath> marks;  ///< engraved or drawn: lines alone, no letters; numbers are set by the writers
  /// Where a writer may set the part's number, and how high; none: it does not fit.
  std::optional<Vec2> number_at;  ///< lower left corner [m]
  double number_height = 0.0;     ///< [m]
};

/// One row of a parts list.
struct ShopPart {
  int number = 0;    ///< from 1, in the order of the list
  std::string name;  ///< lower case, words joined by "_": "floor", "left_wall_2"
  std::string material;
  double thickness = 0.0;  ///< of the stock [m]; > 0
  double density = 0.0;    ///< [kg/m^3]; > 0
  double volume = 0.0;     ///< of one piece's body, exactly [m^3]
  /// Of one piece [kg]. Of a wall beside a width that changes that of its sheet: `body`, as thick across the track as the
  /// sheet is, is thinner by the cosine of what the wall leans along the track (by 4 % at most).
  double mass = 0.0;
  Vec3 centre_of_gravity;                       ///< of the first piece, in the frame of the assembly [m]
  std::array<double, 3> colour{0.7, 0.7, 0.7};  ///< red, green, blue: 0 to 1
  std::optional<FlatPattern> pattern;           ///< of what is cut from a sheet
  PartBody body;                                ///< finished, in the part's own frame
  std::vector<Frame> places;                    ///< one a piece, in the frame of the assembly
  bool stands = false;                          ///< of a support, which reaches down to the ground
  bool bought_in = false;                       ///< a bar or fitting that nobody cuts from a sheet
  bool flat_bar = false;           ///< of what is bought in: sawn from a flat bar, drilled as its pattern
  std::vector<std::string> files;  ///< of this part alone, below the folder of the build

  [[nodiscard]] std::size_t quantity() const { return places.size(); }
};

/// Bolts, nuts, washers, anchors: what is counted and not drawn.
struct BoughtInItem {
  std::string name;      ///< "bolt M12 x 40"
  std::string standard;  ///< "ISO 4017 8.8"
  std::size_t quantity = 0;
  std::string where;
};

/// One hit of the press along a bent floor, or one arc of a rolled one.
struct BendStep {
  int part = 0;  ///< number of the part
  int hit = 0;   ///< from 1, along the plate
  double distance =
      0.0;  ///< of the bend's middle, or of the arc's start, from the upstream edge of the flat, along the one beside the floor [m]
  double length = 0.0;       ///< of an arc on the flat; 0 of a hit [m]
  Angle angle;               ///< positive where the plate curls up
  Angle sum;                 ///< of the angles so far
  double radius = 0.0;       ///< of the design there, infinity where flat; sign as of the angle [m]
  double chord_error = 0.0;  ///< between the facet before this hit and the design [m]
};

/// A place on the track that is measured on site.
struct SettingOutPoint {
  std::string what;         ///< "station", "joint 2", "support 3"
  double arc_length = 0.0;  ///< s [m]
  double x = 0.0;           ///< horizontal distance from the start [m]
  double z = 0.0;           ///< height above the start [m]
  Vec3 site;                ///< in the frame of the site [m]
  Angle slope_angle;        ///< positive downhill
  double radius = 0.0;      ///< positive in a valley, infinity where straight [m]
  double ordinate = 0.0;    ///< distance above the chord of its segment [m]
  /// Heights z of the lines that the table follows, plumb below the place; none where such a line ends short of it [m].
  std::vector<std::optional<double>> offsets;
  /// Whether it is of something that stands beyond an end of the track, which does not lie plumb above it: x, z and site are
  /// those of the middle of its foot, s is that of the place it holds up; slope angle, radius and ordinate are none, and there
  /// are no levels.
  bool beyond_track = false;
};

/// A value at one place of the parts that rules of the shop may bound (`trades/rules.hpp`).
struct ShopMeasurement {
  std::string_view quantity;  ///< its key: "hole_thicknesses"
  double value = 0.0;         ///< as it is measured: the hole's diameter [SI, rad]
  double unit = 1.0;          ///< what the quantity counts it in, the plate's thickness [the same]; 1: in SI
  Dimension dimension = Dimension::length;  ///< of `value`
  std::string where;
  std::optional<double> thickness;  ///< of the part, if it is of one [m]
  std::optional<double> density;    ///< [kg/m^3]

  /// @return the quantity; of a unit of 0: 0 or infinity
  [[nodiscard]] double in_units() const;
};

/// How a rule of the shop is kept.
enum class ShopVerdict { pass, warn, fail, cannot_be_judged };
/// @return "pass", "warn", "fail", "cannot be judged"
[[nodiscard]] std::string_view to_text(ShopVerdict verdict);
/// A rule of the shop held against its worst place.
struct ShopCheck {
  std::string rule;  ///< its id: "plate.hole-diameter"
  ShopVerdict verdict = ShopVerdict::pass;
  std::string value;  ///< with its unit; "-" if there is none
  std::string bound;  ///< with its relation and unit: "at least 4 mm"
  std::string where;  ///< of a rule that cannot be judged: why
  std::string source;
  std::string sentence;         ///< what the rule asks
  std::string certainty;        ///< of its bound, as rule files have it: "secondary"
  bool needs_checking = false;  ///< nobody read the bound in its document
};

/// Everything that a workshop gets told.
struct Workshop {
  std::string name;                                                        ///< of the design
  std::string tolerance = "General tolerance ISO 2768-m; edges deburred";  ///< in words, on every sheet
  std::vector<ShopPart> parts;
  std::vector<BoughtInItem> items;
  std::vector<BendStep> bends;
  std::vector<SettingOutPoint> setting_out;
  std::vector<std::string> offset_names;  ///< of SettingOutPoint::offsets: "underside of deck"
  std::vector<ShopMeasurement> measured;  ///< what rules of the shop may bound
  std::vector<ShopCheck> checks;          ///< what they say of it: judge_shop() of pipeline/shop_rules.hpp
  /// What was asked for and is not made so: trestles that find no place, spans wider than asked for. `where` is the key below
  /// `fabrication` ("supports.spacing"), of a build its place in the design file. For whoever designs: warnings() has them all.
  std::vector<Issue> shortfalls;
  std::vector<std::string> notes;  ///< in words, for whoever makes it: fits, kerf, trims, how it is lifted
};

/// @return NUMBER_name_material_thickness_quantity without an ending, as a shop sorts files: "03_left_wall_S235_4mm_2x"
[[nodiscard]] std::string file_stem(const ShopPart& part);

}  // namespace glissade
