// Trestles: two saddles that are cut to the underside, a cross beam, two legs on base plates, braces where legs are long.

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bolts.hpp"
#include "parts/corners.hpp"
#include "parts/fittings.hpp"
#include "parts/ground.hpp"
#include "parts/setting_out.hpp"
#include "parts/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace glissade::parts {
namespace {

constexpr double kSaddleHalf = 50e-3;   // of a saddle, along the track [m]
constexpr double kSaddleLeast = 30e-3;  // its height where it is lowest [m]
constexpr double kSaddle = 8e-3;        // its thickness [m]
constexpr double kPlate = 10e-3;        // thickness of a base plate [m]
constexpr double kAnchorInset = 25e-3;  // of anchor holes from the plate's edges [m]
constexpr double kBrace = 6e-3;         // flat bar 50 x 6
constexpr double kBraceWidth = 50e-3;
constexpr double kLeastLeg = 100e-3;
constexpr double kApart = 300e-3;  // of the first and last trestle from the ends, about [m]

constexpr Vec3 kUp{0.0, 0.0, 1.0};

/// One trestle, in the plane (x, height).
struct Trestle {
  double at = 0.0;      ///< along the track [m]
  double x = 0.0;       ///< of its middle
  double beam = 0.0;    ///< height of the cross beam's upper face
  double ground = 0.0;  ///< below its feet

  [[nodiscard]] double leg(const SupportOptions& supports) const {
    return beam - supports.tube - ground - supports.grout - kPlate;
  }
};

double underside(const Job& job) {
  return -floor_depth(job) - job.channel.thickness;
}

Trestle trestle_at(const Job& job, double at) {
  const SupportOptions& supports = *job.options.supports;
  Trestle trestle;
  trestle.at = at;
  double low = 1e300;
  Vec2 middle;
  for (const double s : {at - kSaddleHalf, at, at + kSaddleHalf}) {
    const TrackFrame frame = frame_at(job.track, s);
    const Vec2 under = frame.at + underside(job) * frame.up;
    if (s == at) middle = under;
    low = std::min(low, under.y);
  }
  trestle.x = middle.x;
  // Below walls that lap the floor, too.
  const bool laps = job.options.walls == WallSeat::beside_floor;
  trestle.beam = low - kSaddleLeast - (laps ? overlap(job) / frame_at(job.track, at).up.y : 0.0);
  // The lower of the places of both edges of the base plate: grout fills the rest.
  const double half = 0.5 * base_side(supports);
  trestle.ground =
      std::max({ground_at(supports.ground, trestle.x - half), ground_at(supports.ground, trestle.x),
                ground_at(supports.ground, trestle.x + half)});
  return trestle;
}

ShopPart bought_tube(const Job& job, const std::string& name, double length, const Frame& place) {
  const SupportOptions& supports = *job.options.supports;
  const double half = 0.5 * supports.tube;
  const double inner = half - supports.wall;
  ShopPart part;
  part.name = name;
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = supports.wall;
  part.stands = true;
  part.bought_in = true;
  part.body = Prism{
      {rectangle({-half, -half}, {half, half}), {rectangle({-inner, -inner}, {inner, inner})}, {}}, length};
  part.places = {place};
  weigh(part);
  return part;
}

ShopPart plate_part(const Job& job, const std::string& name, const PlaneRegion& region, double thickness,
                    const std::vector<Frame>& places) {
  ShopPart part;
  part.name = name;
  part.material = job.options.material.name;
  part.density = job.options.material.density;
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

/// Everything about a trestle that depends on the job alone.
struct Measures {
  double beam_length = 0.0;
  double leg_aside = 0.0;     ///< of a leg's middle from the plane of the track
  double saddle_aside = 0.0;  ///< of a saddle's middle
};

Measures measures_of(const Job& job) {
  const SupportOptions& supports = *job.options.supports;
  const double width = job.channel.width + 2.0 * job.channel.wall();
  Measures measures;
  measures.beam_length = std::max(width, 4.0 * supports.tube);
  measures.leg_aside = 0.5 * measures.beam_length - 0.5 * supports.tube - 10e-3;
  // Inside of walls that reach below the floor.
  measures.saddle_aside = 0.5 * (overlap(job) > 0.0 ? job.channel.width - kSaddle : width) - 20e-3;
  return measures;
}

void add_saddles(const Fitting& fitting, const Trestle& trestle, const std::string& number) {
  const Job& job = fitting.job;
  const Measures measures = measures_of(job);
  const auto under =
      offset_line(job.track, {trestle.at - kSaddleHalf, trestle.at + kSaddleHalf}, underside(job));
  ArcPath outline = *under;
  outline.closed = true;
  const Vec2 first = outline.vertices.front().at;
  const Vec2 last = outline.vertices.back().at;
  outline.vertices.push_back({{last.x, trestle.beam}, 0.0});
  outline.vertices.push_back({{first.x, trestle.beam}, 0.0});
  ShopPart part =
      upright_plate(job, {outline, {}, {}}, kSaddle,
                    {-measures.saddle_aside - 0.5 * kSaddle, measures.saddle_aside - 0.5 * kSaddle});
  part.name = "saddle_" + number;
  FlatPattern pattern;
  pattern.region = std::get<Prism>(part.body).region;
  part.pattern = std::move(pattern);
  add_part(fitting.workshop, part, kSupportColour);
}

void add_legs(const Fitting& fitting, const Trestle& trestle, const std::string& number) {
  const Job& job = fitting.job;
  const SupportOptions& supports = *job.options.supports;
  const Measures measures = measures_of(job);
  const Vec3 left = across(job.placement);
  const Vec3 run = along(job.placement);
  const auto at = [&](double aside, double height) {
    return in_space(job.placement, {trestle.x, height}) + aside * left;
  };
  // Tubes run along z of their frames.
  const double half = 0.5 * measures.beam_length;
  ShopPart beam = bought_tube(job, "beam", measures.beam_length,
                              {at(-half, trestle.beam - 0.5 * supports.tube), kUp, run, left});
  add_part(fitting.workshop, beam, kSupportColour);
  const double foot = trestle.ground + supports.grout + kPlate;
  ShopPart leg = bought_tube(job, "leg_" + number, trestle.leg(supports),
                             {at(measures.leg_aside, foot), run, left, kUp});
  leg.places.push_back({at(-measures.leg_aside, foot), run, left, kUp});
  add_part(fitting.workshop, leg, kSupportColour);

  const double side = 0.5 * base_side(supports);
  const double hole = 0.5 * clearance_hole(supports.anchor, HoleFit::coarse);
  PlaneRegion region{rectangle({-side, -side}, {side, side}), {}, {}};
  const double inset = side - kAnchorInset;
  for (const Vec2 centre :
       {Vec2{-inset, -inset}, Vec2{inset, -inset}, Vec2{inset, inset}, Vec2{-inset, inset}})
    region.holes.push_back({centre, hole});
  std::vector<Frame> places;
  for (const double aside : {measures.leg_aside, -measures.leg_aside})
    places.push_back({at(aside, foot - kPlate), run, left, kUp});
  add_part(fitting.workshop, plate_part(job, "base_plate", region, kPlate, places), kSupportColour);
  add_item(fitting.workshop,
           {"anchor M" + std::to_string(supports.anchor), "as the ground asks", 8, "base plates"});
}

/// A flat bar across a plane from one leg's foot to the other's head.
void add_braces(const Fitting& fitting, const Trestle& trestle, const std::string& number) {
  const Job& job = fitting.job;
  const SupportOptions& supports = *job.options.supports;
  if (trestle.leg(supports) < supports.braced_from) return;
  const Measures measures = measures_of(job);
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
  const Vec3 left = across(job.placement);
  const Vec3 run = along(job.placement);
  const double foot = trestle.ground + supports.grout + kPlate + 100e-3;
  for (double k = 0.0; k < count; k += 1.0) {
    // One of each cross before the legs, one behind them.
    for (const double side : {1.0, -1.0}) {
      const double out = side * (0.5 * supports.tube) - (side < 0.0 ? kBrace : 0.0);
      const Vec3 origin = in_space(job.placement, {trestle.x, foot + k * rise}) -
                          side * measures.leg_aside * left + out * run;
      const Vec3 x = (1.0 / length) * (side * width * left + rise * kUp);
      const Vec3 y = (1.0 / length) * (width * kUp - side * rise * left);
      // x, y and the outward normal are right-handed on one side, left-handed on the other.
      Frame place{origin, x, side > 0.0 ? y : -1.0 * y, run};
      add_part(fitting.workshop, plate_part(job, "brace_" + number, region, kBrace, {place}), kSupportColour);
    }
  }
}

}  // namespace

double base_side(const SupportOptions& supports) {
  return std::max(150e-3, supports.tube + 90e-3);
}

namespace {

/// How far from a trestle along the track frames must stay: below a slope they lean back over its beam.
double clear_of(const Job& job, double at) {
  const PlateOptions& options = job.options;
  const double width = std::max(options.flanges.width, options.stiffeners ? options.stiffeners->width : 0.0);
  const double high = width + options.flanges.gap - underside(job);
  const auto [sine, cosine] = math::sine_cosine(job.track.at(at).slope_angle);
  const double reach = (0.5 * options.supports->tube + high * std::fabs(sine)) / std::max(0.1, cosine);
  return std::max(kSaddleHalf, reach) + 10e-3;
}

}  // namespace

void add_supports(const Fitting& fitting, std::vector<SettingOutPoint>& rows) {
  const Job& job = fitting.job;
  if (!job.options.supports) return;
  const SupportOptions& supports = *job.options.supports;
  const double whole = job.track.length();
  const double room = std::max(0.0, whole - 2.0 * kApart);
  const double gaps = std::max(1.0, std::ceil(room / supports.spacing - 1e-9));
  int number = 0;
  for (double k = 0.0; k <= gaps; k += 1.0) {
    const double about = kApart + room * k / gaps;
    const auto at = fitting.below.free_place(about, clear_of(job, about), {0.0, whole});
    if (!at || job.track.at(*at).slope_angle > supports.steepest.radians()) continue;
    const Trestle trestle = trestle_at(job, *at);
    const double leg = trestle.leg(supports);
    const double under = trestle.beam + kSaddleLeast;
    if (leg < kLeastLeg) {
      throw InputError(
          {"supports.ground",
           "ground: at " + length_text(*at, 3) + " along the track it lies " +
               length_text(std::fabs(under - trestle.ground), 3) +
               (under > trestle.ground ? " below" : " above") + " the underside of the track",
           "Saddle, beam, base plate and the least leg of " + length_text(kLeastLeg) + " take " +
               length_text(kSaddleLeast + supports.tube + kPlate + supports.grout + kLeastLeg, 3) + ".",
           "a lower ground, or a ground line that is lower there"});
    }
    const std::string text = std::to_string(++number);
    add_saddles(fitting, trestle, text);
    add_legs(fitting, trestle, text);
    add_braces(fitting, trestle, text);
    fitting.below.add(*at - clear_of(job, *at), *at + clear_of(job, *at));
    rows.push_back(setting_out_point(job.track, {0.0, whole}, job.placement, "support " + text, *at));
  }
  if (number == 0) {
    throw InputError({"supports.steepest",
                      "steepest: the track is nowhere flatter than " + angle_text(supports.steepest, 3),
                      "A trestle under a steeper track would carry nothing.",
                      "a steepest above its least slope angle, or no supports"});
  }
}

}  // namespace glissade::parts
