#include "parts/plates/angle_frames.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/plates/bar_pieces.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/plate_facts.hpp"
#include "parts/plates/plate_section.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/section_outside.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::parts {
namespace {

/// An equal angle of EN 10056-1. Lists of mills have roots of 9 or of 10 mm for legs of 75 mm; the standard's area, 8.73 cm^2,
/// is that of 9 mm.
struct Angled {
  double leg;
  double thickness;
  double root;
};
constexpr std::array<Angled, 42> kAngles = {
    {{20e-3, 3e-3, 3.5e-3},  {25e-3, 3e-3, 3.5e-3},  {25e-3, 4e-3, 3.5e-3},  {30e-3, 3e-3, 5e-3},
     {30e-3, 4e-3, 5e-3},    {35e-3, 4e-3, 5e-3},    {40e-3, 4e-3, 6e-3},    {40e-3, 5e-3, 6e-3},
     {45e-3, 4.5e-3, 7e-3},  {50e-3, 4e-3, 7e-3},    {50e-3, 5e-3, 7e-3},    {50e-3, 6e-3, 7e-3},
     {60e-3, 5e-3, 8e-3},    {60e-3, 6e-3, 8e-3},    {60e-3, 8e-3, 8e-3},    {65e-3, 7e-3, 9e-3},
     {70e-3, 6e-3, 9e-3},    {70e-3, 7e-3, 9e-3},    {75e-3, 6e-3, 9e-3},    {75e-3, 8e-3, 9e-3},
     {80e-3, 8e-3, 10e-3},   {80e-3, 10e-3, 10e-3},  {90e-3, 7e-3, 11e-3},   {90e-3, 8e-3, 11e-3},
     {90e-3, 9e-3, 11e-3},   {90e-3, 10e-3, 11e-3},  {100e-3, 8e-3, 12e-3},  {100e-3, 10e-3, 12e-3},
     {100e-3, 12e-3, 12e-3}, {110e-3, 10e-3, 13e-3}, {110e-3, 12e-3, 13e-3}, {120e-3, 10e-3, 13e-3},
     {120e-3, 11e-3, 13e-3}, {120e-3, 12e-3, 13e-3}, {120e-3, 13e-3, 13e-3}, {120e-3, 15e-3, 13e-3},
     {130e-3, 12e-3, 14e-3}, {150e-3, 10e-3, 16e-3}, {150e-3, 12e-3, 16e-3}, {150e-3, 14e-3, 16e-3},
     {150e-3, 15e-3, 16e-3}, {150e-3, 18e-3, 16e-3}}};
constexpr double kSameSize = 1e-9;  // [m]
constexpr double kFromCut = 1.5;    // hole diameters from a mitre to the middle of a hole

bool same(double a, double b) {
  return std::fabs(a - b) < kSameSize;
}

double hole_of(const FlangeOptions& flange) {
  return clearance_hole(flange.bolt, HoleFit::coarse);
}

double washer_of(const FlangeOptions& flange) {
  const Bolt& bolt = bolt_of(flange.bolt);
  return flange.slotted ? bolt.large_washer : bolt.washer;
}

std::string size_text(double leg, double thickness) {
  const auto shown = [](double length) { return rounded_text(1e3 * length, 4); };
  return shown(leg) + " x " + shown(leg) + " x " + shown(thickness) + " mm";
}

std::string thicknesses_of(double leg) {
  std::vector<std::string> all;
  for (const Angled& one : kAngles) {
    if (same(one.leg, leg)) all.push_back(rounded_text(1e3 * one.thickness, 4));
  }
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += (i == 0 ? "" : i + 1 < all.size() ? ", " : " or ") + all[i];
  return text + " mm";
}

/// The rolled leg nearest to one that is none.
double nearest_leg(double leg) {
  double best = kAngles.front().leg;
  for (const Angled& one : kAngles) {
    if (std::fabs(one.leg - leg) < std::fabs(best - leg)) best = one.leg;
  }
  return best;
}

/// What keeps a bolt from its place in an angle; none.
std::optional<std::string> fault_of(const FlangeOptions& flange, const ShopLeast& shop) {
  const auto root = root_radius(flange.width, flange.thickness);
  if (!root) return std::nullopt;
  const double line = bolt_line(flange);
  // Slots are upright, across the pieces below the floor.
  const double reach = slot_reach(flange);
  const double washer = line - reach - 0.5 * washer_of(flange) - flange.thickness;
  if (washer < *root - kSameSize) {
    return "Washers of " + length_text(washer_of(flange)) + " begin " +
           length_text(std::max(washer, 0.0), 3) + " from the other leg, its fillet is " +
           length_text(*root) + " (EN 10056-1).";
  }
  const double edge = flange.width - line - reach;
  const double least = flange.slotted ? shop.slot_edge_diameters : hole_edge_diameters(shop);
  if (edge < least * hole_of(flange) - kSameSize) {
    return "Middles of holes of " + length_text(hole_of(flange)) + " are " + length_text(edge, 3) +
           " from the toe, at least " + length_text(least * hole_of(flange), 3) + " are asked for.";
  }
  return std::nullopt;
}

/// The smallest rolled angle that takes the bolts; none.
std::optional<Angled> one_that_takes(FlangeOptions flange, const ShopLeast& shop) {
  for (const Angled& one : kAngles) {
    flange.width = one.leg;
    flange.thickness = one.thickness;
    if (!fault_of(flange, shop)) return one;
  }
  return std::nullopt;
}

Vec2 unit(Vec2 v) {
  return (1.0 / norm(v)) * v;
}

/// One side of a frame: lines that run along it, from one cut to the next.
struct Side {
  std::array<Vec2, 2> heel;
  std::array<Vec2, 2> root;
  std::array<Vec2, 2> toe;
  std::array<Vec2, 2> bolts;  ///< on which they stand

  [[nodiscard]] Vec2 way() const { return unit(heel[1] - heel[0]); }
  /// Along the side per distance from the cut at an end.
  [[nodiscard]] double slant(std::size_t end) const {
    return 1.0 / std::fabs(cross(way(), unit(toe[end] - heel[end])));
  }
};

std::vector<Side> sides_of(const AngleSeat& seat, const FlangeOptions& flange) {
  const auto at = [&](double by) { return moved_to_left(seat.outside, seat.ring, flange.gap + by); };
  const std::vector<Vec2> heel = at(0.0);
  const std::vector<Vec2> root = at(flange.thickness);
  const std::vector<Vec2> toe = at(flange.width);
  const std::vector<Vec2> bolts = at(bolt_line(flange));
  std::vector<Side> sides;
  for (std::size_t i = 0; i + (seat.ring ? 0 : 1) < heel.size(); ++i) {
    const std::size_t next = (i + 1) % heel.size();
    sides.push_back(
        {{heel[i], heel[next]}, {root[i], root[next]}, {toe[i], toe[next]}, {bolts[i], bolts[next]}});
  }
  return sides;
}

/// The stretch of a side's line on which bolts may stand; its ends change places where there is none.
/// @param from_cut  [m]
std::array<Vec2, 2> room_on(const Side& side, double from_cut) {
  return {side.bolts[0] + from_cut * side.slant(0) * side.way(),
          side.bolts[1] - from_cut * side.slant(1) * side.way()};
}

double room_of(const Side& side, double from_cut) {
  const auto [from, to] = room_on(side, from_cut);
  return dot(to - from, side.way());
}

std::vector<Vec2> bolts_on(const Side& side, const FlangeOptions& flange) {
  const double from_cut = kFromCut * hole_of(flange) + slot_reach(flange);
  const auto [from, to] = room_on(side, from_cut);
  // Two, where they are as far apart as middles of holes are at corners.
  const double least = 2.0 * kFromCut * hole_of(flange) + 2.0 * slot_reach(flange);
  if (room_of(side, from_cut) < least) return {0.5 * (from + to)};
  return evenly(from, to, flange.pitch);
}

ArcPath line_of(const std::array<Vec2, 2>& ends, const PlaneMotion& motion) {
  return {{{motion(ends[0]), 0.0}, {motion(ends[1]), 0.0}}, false};
}

/// Into the frame of a piece: x along its heel, the least x and y of its leg 0.
PlaneMotion into_own(const Side& side) {
  const Vec2 way = side.way();
  const PlaneMotion turned{way.x, -way.y, {}, false};
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Vec2 corner : {side.heel[0], side.heel[1], side.toe[0], side.toe[1]}) {
    const Vec2 there = turned(corner);
    low = {std::min(low.x, there.x), std::min(low.y, there.y)};
  }
  return {way.x, -way.y, -1.0 * low, false};
}

/// Where a piece's own frame lies in that of the joint.
Frame out_of_own(const Frame& joint, const PlaneMotion& own) {
  const auto back = [&](Vec2 at) {
    const Vec2 away = at - own.shift;
    return Vec2{own.cosine * away.x + own.sine * away.y, -own.sine * away.x + own.cosine * away.y};
  };
  const Vec2 origin = back({});
  const Vec2 x = back({1.0, 0.0}) - origin;
  return {joint.to_space({origin.x, origin.y, 0.0}), x.x * joint.x + x.y * joint.y,
          -x.y * joint.x + x.x * joint.y, joint.z};
}

/// The name of one of several pieces, in the frame of the joint: x to the left.
std::string piece_name(const std::string& name, const Side& side, std::size_t index, std::size_t count) {
  if (count == 1) return name;
  if (count > 3) return name + "_" + std::to_string(index + 1);
  const double middle = 0.5 * (side.heel[0].x + side.heel[1].x);
  const double half = 0.25 * norm(side.heel[1] - side.heel[0]);
  if (std::fabs(side.way().x) > 0.99 || std::fabs(middle) < half) return "lower_" + name;
  return (middle > 0.0 ? "left_" : "right_") + name;
}

/// The same seen along the track: left for right.
AngleSeat mirrored(const AngleSeat& seat) {
  AngleSeat other{{seat.outside.rbegin(), seat.outside.rend()}, seat.ring};
  for (Vec2& corner : other.outside) corner.x = -corner.x;
  return other;
}

}  // namespace

std::optional<double> root_radius(double leg, double thickness) {
  for (const Angled& one : kAngles) {
    if (same(one.leg, leg) && same(one.thickness, thickness)) return one.root;
  }
  return std::nullopt;
}

double bolt_line(const FlangeOptions& flange) {
  const double root = root_radius(flange.width, flange.thickness).value_or(flange.thickness);
  return 0.5 * (flange.thickness + root + flange.width);
}

void add_angle_problems(const PlateOptions& options, std::vector<Issue>& issues) {
  const FlangeOptions& flange = options.flanges;
  if (flange.section != FlangeSection::angle) return;
  if (!root_radius(flange.width, flange.thickness)) {
    const double leg = nearest_leg(flange.width);
    const bool known = same(leg, flange.width);
    issues.push_back({known ? "flanges.thickness" : "flanges.width",
                      "section: no angle of " + size_text(flange.width, flange.thickness) + " is rolled",
                      "Equal angles are those of EN 10056-1.",
                      (known ? std::string() : "width: " + length_text(leg) + " with ") +
                          "thickness: " + thicknesses_of(leg) + ", or section: flat"});
    return;
  }
  const auto fault = fault_of(flange, options.shop);
  if (!fault) return;
  const auto other = one_that_takes(flange, options.shop);
  issues.push_back({"flanges.bolt",
                    "bolt: M" + std::to_string(flange.bolt) +
                        (flange.slotted ? " in slots of " + length_text(slot_length(flange)) : "") +
                        " finds no place in an angle of " + size_text(flange.width, flange.thickness),
                    *fault,
                    (other ? "width: " + length_text(other->leg) +
                                 " with thickness: " + length_text(other->thickness) + ", or "
                           : std::string()) +
                        (flange.slotted ? "a smaller bolt or a shorter slot" : "a smaller bolt")});
}

void add_angle_seat_problems(const AngleSeat& seat, const PlateOptions& options, std::vector<Issue>& issues) {
  const FlangeOptions& flange = options.flanges;
  if (!flange.wanted || flange.section != FlangeSection::angle ||
      !root_radius(flange.width, flange.thickness))
    return;
  const double from_cut =
      std::max(options.shop.hole_edge_diameters, kFromCut) * hole_of(flange) + slot_reach(flange);
  for (const Side& side : sides_of(seat, flange)) {
    if (room_of(side, from_cut) >= 0.0) continue;
    issues.push_back({"flanges.section",
                      "section: angle finds no place for M" + std::to_string(flange.bolt) +
                          " along a side of " + length_text(norm(side.heel[1] - side.heel[0]), 3),
                      "Each side has a piece of its own, whose holes of " + length_text(hole_of(flange)) +
                          " keep " + length_text(from_cut, 3) + " off the cuts at its ends.",
                      "section: flat, or a smaller bolt"});
    return;
  }
}

AngleSeat channel_seat(const ChannelMeasures& channel, const PlateOptions& options) {
  const double out = 0.5 * channel.width + channel.wall();
  const double low = -(options.liner ? options.liner->thickness : 0.0) - channel.thickness;
  if (channel.wall_height == 0.0) return {{{out, low}, {-out, low}}};
  return {{{out, channel.wall_height}, {out, low}, {-out, low}, {-out, channel.wall_height}}};
}

AngleBar rolled_angle(const ArcPath& line, const FlangeOptions& flange) {
  AngleBar bar;
  bar.heel = line;
  bar.root = moved_out(line, flange.thickness);
  bar.toe = moved_out(line, flange.width);
  bar.thickness = flange.thickness;
  bar.height = flange.width;
  return bar;
}

ShopPart angle_part(const PlateOptions& options, std::string name, AngleBar bar) {
  ShopPart part;
  part.name = std::move(name);
  part.material = options.material.name;
  part.density = options.material.density;
  part.thickness = bar.thickness;
  part.bought_in = true;
  FlatPattern pattern;
  pattern.region = lying_leg(bar);
  part.pattern = std::move(pattern);
  part.body = std::move(bar);
  return part;
}

Frame turned_about(const Frame& place) {
  return {place.origin, -1.0 * place.x, place.y, -1.0 * place.z};
}

AngleFrame angle_frame(const AngleSeat& seat, const PlateOptions& options, FlangeSide of_joint,
                       const std::vector<Frame>& places) {
  const FlangeOptions& flange = options.flanges;
  // Upstream of a joint the other leg stands upstream: the frame is drawn from there.
  const bool before = of_joint == FlangeSide::upstream;
  const std::vector<Side> sides = sides_of(before ? mirrored(seat) : seat, flange);
  PlaneRegion drilled;
  drill_frame(
      options, of_joint,
      [&](const FlangeOptions& with) {
        std::vector<Vec2> all;
        for (const Side& side : sides) {
          for (const Vec2 bolt : bolts_on(side, with)) all.push_back(bolt);
        }
        return all;
      },
      drilled);
  const auto place_in_order = [&](std::size_t i) {
    const std::size_t count = sides.size();
    return before ? (2 * count - (seat.ring ? 2 : 1) - i) % count : i;
  };
  AngleFrame frame;
  frame.closed = seat.ring;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    const PlaneMotion own = into_own(side);
    AngleBar bar{line_of(side.heel, own), line_of(side.root, own), line_of(side.toe, own), flange.thickness,
                 flange.width};
    // Holes, or slots, come in the order of the bolts.
    frame.rows.push_back(bolts_on(side, flange));
    for (std::size_t k = frame.rows.back().size(); k > 0; --k, ++frame.bolts) {
      if (!drilled.holes.empty()) {
        const Circle& hole = drilled.holes[frame.bolts];
        bar.holes.push_back({own(hole.centre), hole.radius});
      } else {
        bar.slots.push_back(moved(drilled.cutouts[frame.bolts], own));
      }
    }
    // Names as in the other half: mirrored, sides come in the other order.
    Side seen = side;
    if (before) {
      for (Vec2& corner : seen.heel) corner.x = -corner.x;
    }
    const std::string name = frame_name("frame_angle", flange, of_joint);
    ShopPart part =
        angle_part(options, piece_name(name, seen, place_in_order(i), sides.size()), std::move(bar));
    for (const Frame& place : places)
      part.places.push_back(out_of_own(before ? turned_about(place) : place, own));
    weigh(part);
    frame.pieces.push_back(std::move(part));
  }
  return frame;
}

void add_angle_frame(const AngleFrame& frame, FlangeSide of_joint, const PlateOptions& options,
                     Workshop& workshop) {
  std::vector<RowBolt> row;
  for (std::size_t i = 0; i < frame.rows.size(); ++i) {
    for (const Vec2 middle : frame.rows[i]) row.push_back({middle, &frame.pieces[i]});
  }
  measure_bolt_row(row, frame.closed, workshop);
  for (const ShopPart& whole : frame.pieces) {
    std::vector<ShopPart> pieces = angle_pieces(whole, of_joint == FlangeSide::downstream, options);
    if (pieces.size() > 1) note_bar_pieces(options, workshop);
    for (ShopPart& piece : pieces) add_part(workshop, std::move(piece), kFrameColour);
  }
}

double elongation_of(const FlangeOptions& flange, double radius) {
  const double centroid = angle_centroid(flange.width, flange.thickness);
  return (flange.width - centroid) / (radius + centroid);
}

}  // namespace glissade::parts
