// Trestles: two saddles that are cut to the underside, a cross beam, two legs on base plates, braces where legs are long.

#include "parts/supports/supports.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/bar_pieces.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/shortfalls.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/supports/ground.hpp"
#include "parts/supports/trestle.hpp"
#include "parts/supports/trestle_row.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kAnchorInset = 25e-3;  // of anchor holes from the plate's edges [m]
constexpr double kBrace = 6e-3;         // flat bar 50 x 6
constexpr double kBraceWidth = 50e-3;
constexpr double kLeastLeg = 100e-3;

constexpr Vec3 kUp{0.0, 0.0, 1.0};

ShopPart bought_tube(const Shell& shell, const std::string& name, double length, const Frame& place) {
  const SupportOptions& supports = *shell.options.supports;
  const double half = 0.5 * supports.tube;
  const double inner = half - supports.wall;
  ShopPart part;
  part.name = name;
  part.material = shell.options.material.name;
  part.density = shell.options.material.density;
  part.thickness = supports.wall;
  part.stands = true;
  part.bought_in = true;
  part.body = Prism{
      {rectangle({-half, -half}, {half, half}), {rectangle({-inner, -inner}, {inner, inner})}, {}}, length};
  part.places = {place};
  weigh(part);
  return part;
}

ShopPart plate_part(const Shell& shell, const std::string& name, const PlaneRegion& region, double thickness,
                    const std::vector<Frame>& places) {
  ShopPart part;
  part.name = name;
  part.material = shell.options.material.name;
  part.density = shell.options.material.density;
  part.thickness = thickness;
  part.stands = true;
  part.body = Prism{region, thickness};
  part.places = places;
  FlatPattern pattern;
  pattern.region = region;
  part.pattern = std::move(pattern);
  weigh(part);
  return part;
}

/// How far a trestle reaches to both sides.
struct Measures {
  double beam_length = 0.0;
  double leg_aside = 0.0;  ///< of a leg's middle from the plane of the track
};

Measures measures_of(const Shell& shell, const Saddles& saddles) {
  constexpr double kBeyondSaddle = 20e-3;  // of the beam [m]
  constexpr double kLeastSpread = 0.7;     // of the section's width, that it may not tip over
  const SupportOptions& supports = *shell.options.supports;
  double widest = 0.0;
  for (const Vec2 point : flattened(shell.outside(0.5 * shell.track.length()).line, 1e-4))
    widest = std::max(widest, std::fabs(point.x));
  const double aside = std::max(saddles.aside[0], -saddles.aside[1]);
  Measures measures;
  const double beyond_leg = 0.5 * supports.tube + 10e-3;
  // Base plates of both legs lie beside each other.
  const double least_aside = 0.5 * (base_side(supports) + kBaseGap);
  measures.beam_length = std::max({2.0 * (aside + kBeyondSaddle), 4.0 * supports.tube,
                                   2.0 * kLeastSpread * widest, 2.0 * (least_aside + beyond_leg)});
  measures.leg_aside = 0.5 * measures.beam_length - beyond_leg;
  return measures;
}

void add_saddles(const Shell& shell, const Trestle& trestle, const Saddles& saddles,
                 const std::string& number) {
  for (std::size_t side = 0; side < 2; ++side) {
    ArcPath outline = *seat_line(shell, trestle.at, saddles.half, saddles.height[side]);
    outline.closed = true;
    const Vec2 first = outline.vertices.front().at;
    const Vec2 last = outline.vertices.back().at;
    outline.vertices.push_back({{last.x, trestle.beam}, 0.0});
    outline.vertices.push_back({{first.x, trestle.beam}, 0.0});
    const OwnPlane plane = own_plane(outline);
    const PlaneRegion region = moved(PlaneRegion{outline, {}, {}}, into(plane));
    const Frame place =
        plane_of_track(shell.placement, plane.origin, plane.angle, -saddles.aside[side] - 0.5 * kSaddle);
    add_part(shell.workshop, plate_part(shell, "saddle_" + number, region, kSaddle, {place}), kSupportColour);
  }
}

void add_legs(const Shell& shell, const Trestle& trestle, const Measures& measures,
              const std::string& number) {
  const SupportOptions& supports = *shell.options.supports;
  const Vec3 left = across(shell.placement);
  const Vec3 run = along(shell.placement);
  const auto at = [&](double aside, double height) {
    return in_space(shell.placement, {trestle.x, height}) + aside * left;
  };
  // Tubes run along z of their frames.
  const double half = 0.5 * measures.beam_length;
  ShopPart beam = bought_tube(shell, "beam", measures.beam_length,
                              {at(-half, trestle.beam - 0.5 * supports.tube), kUp, run, left});
  add_tube(beam, shell.options, kSupportColour, shell.workshop);
  const double foot = trestle.ground + supports.grout + kBasePlate;
  ShopPart leg = bought_tube(shell, "leg_" + number, trestle.leg(supports),
                             {at(measures.leg_aside, foot), run, left, kUp});
  leg.places.push_back({at(-measures.leg_aside, foot), run, left, kUp});
  add_tube(leg, shell.options, kSupportColour, shell.workshop);

  const double side = 0.5 * base_side(supports);
  const double hole = 0.5 * clearance_hole(supports.anchor, HoleFit::coarse);
  PlaneRegion region{rectangle({-side, -side}, {side, side}), {}, {}};
  const double inset = side - kAnchorInset;
  for (const Vec2 centre :
       {Vec2{-inset, -inset}, Vec2{inset, -inset}, Vec2{inset, inset}, Vec2{-inset, inset}})
    region.holes.push_back({centre, hole});
  std::vector<Frame> places;
  for (const double aside : {measures.leg_aside, -measures.leg_aside})
    places.push_back({at(aside, foot - kBasePlate), run, left, kUp});
  add_part(shell.workshop, plate_part(shell, "base_plate", region, kBasePlate, places), kSupportColour);
  add_item(shell.workshop,
           {"anchor M" + std::to_string(supports.anchor), "as the ground asks", 8, "base plates"});
}

/// What holds braces to the legs: one bolt through a leg wherever braces end. Of crosses one above the other the upper end of one and the
/// lower end of the next, on either side of a leg, share it.
void add_brace_bolts(const Shell& shell, std::size_t crosses) {
  constexpr std::size_t kEnds = 4;  // of a leg pair: at the lowest feet, and at the highest heads
  const SupportOptions& supports = *shell.options.supports;
  add_bolts(shell.workshop, supports.anchor, supports.tube + kBrace, kEnds, "braces");
  add_bolts(shell.workshop, supports.anchor, supports.tube + 2.0 * kBrace, 2 * (crosses - 1), "braces");
}

/// A flat bar across a plane from one leg's foot to the other's head.
void add_braces(const Shell& shell, const Trestle& trestle, const Measures& measures,
                const std::string& number) {
  const SupportOptions& supports = *shell.options.supports;
  if (trestle.leg(supports) < supports.braced_from) return;
  const double longest = shell.options.split.stock().room().x;
  const double width = 2.0 * measures.leg_aside;
  const double room = trestle.leg(supports) - 200e-3;
  // Crosses no steeper than 60 deg, one above the other.
  const double count = std::ceil(room / (1.7 * width) - 1e-9);
  const double rise = room / count;
  const double length = math::hypot(width, rise);
  const double edge = 2.0 * kBraceWidth / 3.0;
  PlaneRegion region{rectangle({-edge, -0.5 * kBraceWidth}, {length + edge, 0.5 * kBraceWidth}), {}, {}};
  const double hole = 0.5 * clearance_hole(supports.anchor, HoleFit::medium);
  region.holes = {{{0.0, 0.0}, hole}, {{length, 0.0}, hole}};
  const Vec3 left = across(shell.placement);
  const Vec3 run = along(shell.placement);
  const double foot = trestle.ground + supports.grout + kBasePlate + 100e-3;
  add_brace_bolts(shell, static_cast<std::size_t>(count));
  for (double k = 0.0; k < count; k += 1.0) {
    // One of each cross before the legs, one behind them.
    for (const double side : {1.0, -1.0}) {
      const double out = side * (0.5 * supports.tube) - (side < 0.0 ? kBrace : 0.0);
      const Vec3 origin = in_space(shell.placement, {trestle.x, foot + k * rise}) -
                          side * measures.leg_aside * left + out * run;
      const Vec3 x = (1.0 / length) * (side * width * left + rise * kUp);
      const Vec3 y = (1.0 / length) * (width * kUp - side * rise * left);
      // x, y and the outward normal are right-handed on one side, left-handed on the other.
      Frame place{origin, x, side > 0.0 ? y : -1.0 * y, run};
      ShopPart brace = plate_part(shell, "brace_" + number, region, kBrace, {place});
      // Flat bar where no sheet is as long, or where it has to be pieces.
      if (bounds(region.outline).width() > longest || is_too_heavy(brace, shell.options.split))
        add_flat_bar(std::move(brace), shell.options, kSupportColour, shell.workshop);
      else
        add_part(shell.workshop, std::move(brace), kSupportColour);
    }
  }
}

/// @throws InputError where the ground leaves no room
void require_room_for_legs(const Trestle& trestle, const SupportOptions& supports) {
  const double leg = trestle.leg(supports);
  if (leg >= kLeastLeg) return;
  const double under = trestle.beam + kSaddleLeast;
  throw InputError(
      {"supports.ground",
       "ground: at " + length_text(trestle.at, 3) + " along the track it lies " +
           length_text(std::fabs(under - trestle.ground), 3) +
           (under > trestle.ground ? " below" : " above") + " the underside of the track",
       "Saddle, beam, base plate and the least leg of " + length_text(kLeastLeg) + " take " +
           length_text(kSaddleLeast + supports.tube + kBasePlate + supports.grout + kLeastLeg, 3) + ".",
       "a lower ground, or a ground line that is lower there"});
}

/// The least slope angle along a stretch, which an arc has at one of its ends [rad].
double flattest_of(const ArcSpline& track, const Span& span) {
  double least = std::min(track.slope_angle(span.from), track.slope_angle(span.to));
  for (const TrackArc& arc : track.arcs()) {
    if (arc.start > span.from && arc.start < span.to) least = std::min(least, track.slope_angle(arc.start));
  }
  return least;
}

constexpr double kTold = 1e-3;  // taste: of what is wider than asked for [m]

/// Says where trestles are farther apart than is asked for.
void tell_wide_spans(const Trestles& all, const Shell& shell) {
  const double spacing = shell.options.supports->spacing;
  std::size_t widest = 0;
  std::size_t wide = 0;
  const auto span = [&](std::size_t i) { return all[i].place.at - all[i - 1].place.at; };
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (!(span(i) > spacing + kTold)) continue;
    ++wide;
    if (widest == 0 || span(i) > span(widest)) widest = i;
  }
  if (wide == 0) return;
  const std::string others =
      wide == 1 ? "" : ", the widest of " + std::to_string(wide) + " spans that are wider than that";
  add_shortfall(
      {"supports.spacing",
       "spacing: supports " + std::to_string(widest) + " and " + std::to_string(widest + 1) + " are " +
           length_text(span(widest), 3) + " apart along the track, at " +
           length_text(all[widest - 1].place.at, 4) + " and " + length_text(all[widest].place.at, 4) +
           ", for " + length_text(spacing) + others,
       "Frames, stiffeners, openings, bends or other trestles leave no place between them.",
       spacing_that_does(span(widest)) + ", or fewer of these there (split.longest, stiffeners.spacing)"},
      shell.workshop);
}

/// Says where track sticks out too far beyond an end of the row.
/// @param beyond  the stretch beyond it
/// @param where   "above support 1"
void tell_end(const Shell& shell, const Span& beyond, const std::string& where) {
  const SupportOptions& supports = *shell.options.supports;
  const double length = shell.track.length();
  const double out = beyond.to - beyond.from;
  const double most = 0.5 * supports.spacing;
  if (!(out > most + kTold)) return;
  const bool first = beyond.from == 0.0;
  // Where a trestle would have to stand.
  const Span room = first ? Span{0.0, most} : Span{length - most, length};
  const Angle flattest = Angle::from_radians(flattest_of(shell.track, room));
  const bool steep = flattest > supports.steepest;
  add_shortfall({"supports.spacing",
                 "spacing: the track sticks out by " + length_text(out, 3) + " " + where + ", at " +
                     length_text(first ? beyond.to : beyond.from, 4) + " along it, for " + length_text(most) +
                     ", half of " + length_text(supports.spacing),
                 steep ? "Nearer to its end it is " + angle_text(flattest, 3) +
                             " steep or steeper, and a trestle stands below no more than " +
                             angle_text(supports.steepest, 3) + " (steepest)."
                       : "Frames, stiffeners, openings, bends or other trestles leave no place nearer to its "
                         "end, or it is "
                         "steeper than " +
                             angle_text(supports.steepest, 3) + " (steepest) there.",
                 spacing_that_does(2.0 * out) + ", " + (steep ? "a larger steepest, " : "") +
                     "or a support of your own that holds the end"},
                shell.workshop);
}

/// Says where trestles are farther apart than is asked for, and where track sticks out too far beyond them.
void tell_spans(const Trestles& all, const Shell& shell) {
  if (all.empty()) return;
  tell_wide_spans(all, shell);
  tell_end(shell, {0.0, all.front().place.at}, "above support 1");
  tell_end(shell, {all.back().place.at, shell.track.length()}, "below support " + std::to_string(all.size()));
}

/// Says that there is no trestle at all.
/// @throws InputError where the track is too steep for one everywhere
void tell_none(const Shell& shell) {
  const SupportOptions& supports = *shell.options.supports;
  const Angle flattest = Angle::from_radians(flattest_of(shell.track, {0.0, shell.track.length()}));
  if (flattest > supports.steepest) {
    throw InputError(
        {"supports.steepest",
         "steepest: the track is nowhere flatter than " + angle_text(supports.steepest, 3),
         "A trestle under a steeper track would carry nothing.",
         "a steepest above its least slope angle, " + angle_text(flattest, 3) + ", or no supports"});
  }
  add_shortfall(
      {"supports",
       "supports: no trestle finds a place along the track, which is " +
           length_text(shell.track.length(), 4) + " long",
       "Its saddles take " + length_text(2.0 * kSaddleHalf) +
           " of it, on bent plates and tubes 40 mm of one flat, no steeper than " +
           angle_text(supports.steepest, 3) + " (steepest), clear of frames, stiffeners and openings.",
       "fewer of these (split.longest, stiffeners.spacing), fewer bends, a larger steepest, or no "
       "supports"},
      shell.workshop);
}

}  // namespace

void add_supports(const Shell& shell, std::vector<SettingOutPoint>& rows) {
  if (!shell.options.supports) return;
  const SupportOptions& supports = *shell.options.supports;
  const Trestles all = trestles_along(shell);
  std::vector<Foot> feet;
  for (const Standing& one : all) feet.push_back({one.trestle.x, frame_of(shell, one.place.at).at.x});
  require_on_ground(supports.ground, feet, "supports.ground", "a trestle");
  for (const Standing& one : all) require_room_for_legs(one.trestle, supports);
  std::vector<double> joints = {shell.units.front().from};
  for (const Span& unit : shell.units) joints.push_back(unit.to);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Standing& one = all[i];
    const Measures measures = measures_of(shell, one.saddles);
    const std::string text = std::to_string(i + 1);
    add_saddles(shell, one.trestle, one.saddles, text);
    add_legs(shell, one.trestle, measures, text);
    add_braces(shell, one.trestle, measures, text);
    shell.taken.add(one.place.at - one.clear, one.place.at + one.clear);
    rows.push_back(setting_out_point(
        shell.track, joints, shell.placement,
        {"support " + text, one.trestle.x, one.trestle.ground + supports.grout, one.place.at}));
  }
  tell_spans(all, shell);
  if (all.empty()) tell_none(shell);
}

}  // namespace glissade::parts
