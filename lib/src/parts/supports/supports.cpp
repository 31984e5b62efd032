// Trestles: two saddles that are cut to the underside, a cross beam, two legs on base plates, braces where legs are long.

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/plates/bar_pieces.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/section_outside.hpp"
#include "parts/plates/shell.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/setting_out.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/supports/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kSaddleHalf = 50e-3;   // of a saddle, along the track [m]
constexpr double kSaddleLeast = 30e-3;  // its height where it is lowest [m]
constexpr double kSaddle = 8e-3;        // its thickness [m]
constexpr double kPlate = 10e-3;        // thickness of a base plate [m]
constexpr double kOffLap = 1e-3;        // of a saddle that stands beside laps [m]
constexpr double kBaseGap = 10e-3;      // between two of them [m]
constexpr double kOffBeam = 2e-3;  // from the track above it: what a weld of the floor's corner takes [m]
constexpr double kAnchorInset = 25e-3;  // of anchor holes from the plate's edges [m]
constexpr double kBrace = 6e-3;         // flat bar 50 x 6
constexpr double kBraceWidth = 50e-3;
constexpr double kLeastLeg = 100e-3;
constexpr double kOffTaken = 10e-3;                      // taste: of what is taken [m]
constexpr double kLeastClear = kSaddleHalf + kOffTaken;  // of a trestle's middle from it [m]
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

/// Where the saddles of a trestle stand, and how high the section's outside is there.
struct Saddles {
  std::array<double, 2> aside{};   ///< to the left, of the left one and the right one
  std::array<double, 2> height{};  ///< of the outside above the floor line
  double half = kSaddleHalf;       ///< along the track
};

/// The lowest of the outside above a plate between two places across.
double underside_between(const ArcPath& line, double from, double to) {
  double lowest = std::numeric_limits<double>::infinity();
  const auto see = [&](double x) {
    if (const auto y = underside_at(line, x)) lowest = std::min(lowest, *y);
  };
  see(from);
  see(0.5 * (from + to));
  see(to);
  for (const PathVertex& vertex : line.vertices) {
    if (vertex.at.x > from && vertex.at.x < to) see(vertex.at.x);
  }
  return lowest;
}

/// As far out as the outside leans no more than so, clear of what laps below it.
double saddle_on_left(const SectionOutside& outside) {
  constexpr double kMostLean = 0.58;   // tan 30 deg
  constexpr double kFromEdge = 20e-3;  // of a saddle's middle [m]
  constexpr double kAtLeast = 0.25;    // of the section's half width, however it leans
  constexpr int kPlaces = 400;
  double widest = 0.0;
  for (const Vec2 point : flattened(outside.line, 1e-4)) widest = std::max(widest, point.x);
  double aside = 0.0;
  const double step = widest / kPlaces;
  std::optional<double> before = underside_at(outside.line, 0.0);
  for (int k = 1; k <= kPlaces && before; ++k) {
    // The outermost line itself is upright.
    const auto here = underside_at(outside.line, step * std::min(k + 0.0, kPlaces - 1e-6));
    if (!here || std::fabs(*here - *before) > kMostLean * step) break;
    aside = step * k;
    before = here;
  }
  for (const Vec2 tip : lap_tips(outside)) {
    // A whole saddle inside of walls that reach below the floor.
    if (tip.x > 0.0 && tip.x < aside + kSaddle) aside = std::min(aside, tip.x - 0.5 * kSaddle);
  }
  double seat = std::max(aside - kFromEdge, kAtLeast * widest);
  double thick = 0.0;
  for (const OutsideLap& lap : outside.laps) thick = std::max(thick, lap.thickness);
  for (const Vec2 tip : lap_tips(outside)) {
    // Below a narrow floor what walls reach inwards goes first.
    const double clear = tip.x - thick - 0.5 * kSaddle - kOffLap;
    if (clear > kSaddle && tip.x < seat + thick + kSaddle) seat = std::min(seat, clear);
  }
  return seat;
}

Saddles saddles_at(const Shell& shell, double s, double half) {
  Saddles saddles;
  saddles.half = half;
  for (std::size_t side = 0; side < 2; ++side) {
    double aside = std::numeric_limits<double>::infinity();
    double height = std::numeric_limits<double>::infinity();
    for (const bool placed : {false, true}) {
      for (const double at : {s - half, s, s + half}) {
        const SectionOutside outside = side == 0 ? shell.outside(at) : mirrored(shell.outside(at));
        if (placed) {
          const Span across{aside - 0.5 * kSaddle, aside + 0.5 * kSaddle};
          height = std::min(height, underside_between(outside.line, across.from, across.to));
          // Where a narrow floor leaves no place beside what laps, it carries the laps.
          if (const auto laps = underside_of_laps(outside, across.from - kOffLap, across.to + kOffLap))
            height = std::min(height, *laps);
        } else {
          aside = std::min(aside, saddle_on_left(outside));
        }
      }
    }
    saddles.aside[side] = side == 0 ? aside : -aside;
    saddles.height[side] = height;
  }
  return saddles;
}

/// Of a square base plate.
double base_side(const SupportOptions& supports) {
  return std::max(150e-3, supports.tube + 90e-3);
}

/// The lowest of the outside's lowest line within so much of an x.
/// @param s       of the track, about there
/// @param height  of the outside at that x, above the floor line
double lowest_about(const Shell& shell, double s, double height, double x, double within) {
  // Lines that are lower than the saddles' lie above the beam from another stretch of the track.
  constexpr double kLeastLevel = 0.2;  // cosine of the steepest slope that is looked at
  const TrackFrame frame = frame_of(shell, s);
  const double reach = kSaddleHalf + (std::fabs((height - shell.lowest) * frame.along.y) + within) /
                                         std::max(kLeastLevel, frame.along.x);
  double low = std::numeric_limits<double>::infinity();
  constexpr int kPlaces = 100;
  for (int k = -kPlaces; k <= kPlaces; ++k) {
    const TrackFrame here = frame_of(shell, std::clamp(s + reach * k / kPlaces, 0.0, shell.track.length()));
    const Vec2 point = here.at + shell.lowest * here.up;
    // Between two of them the line is no lower than at the one beyond.
    const double step = reach / kPlaces * here.along.x;
    if (std::fabs(point.x - x) <= within + step) low = std::min(low, point.y);
  }
  return low;
}

Trestle trestle_at(const Shell& shell, double at, const Saddles& saddles) {
  const SupportOptions& supports = *shell.options.supports;
  Trestle trestle;
  trestle.at = at;
  const double height = 0.5 * (saddles.height[0] + saddles.height[1]);
  const auto below = [&](double s) {
    const TrackFrame frame = frame_of(shell, s);
    return frame.at + shell.lowest * frame.up;
  };
  const TrackFrame frame = frame_of(shell, at);
  trestle.x = (frame.at + height * frame.up).x;
  double low = std::min({below(at - saddles.half).y, below(at).y, below(at + saddles.half).y});
  if (height > shell.lowest)
    low = std::min(low, lowest_about(shell, at, height, trestle.x, kSaddleHalf + supports.tube));
  // Below a slope the beam's edge downstream is nearer to the track than the saddles, where it is wider than they are long.
  trestle.beam = std::min(low - kSaddleLeast,
                          lowest_about(shell, at, height, trestle.x, 0.5 * supports.tube) - kOffBeam);
  // The highest below the base plate: grout fills the rest.
  const double half = 0.5 * base_side(supports);
  trestle.ground = highest_ground(supports.ground, trestle.x - half, trestle.x + half);
  return trestle;
}

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

/// What of the outside a saddle is cut to.
std::optional<ArcPath> seat_line(const Shell& shell, double at, double half, double height) {
  if (shell.straights.empty()) return offset_line(shell.track, {at - half, at + half}, height);
  ArcPath line;
  // Along the flat or tube on which its middle stands.
  const TrackFrame frame = frame_of(shell, at);
  for (const double reach : {-half, half})
    line.vertices.push_back({frame.at + reach * frame.along + height * frame.up, 0.0});
  return line;
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
  const double foot = trestle.ground + supports.grout + kPlate;
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
    places.push_back({at(aside, foot - kPlate), run, left, kUp});
  add_part(shell.workshop, plate_part(shell, "base_plate", region, kPlate, places), kSupportColour);
  add_item(shell.workshop,
           {"anchor M" + std::to_string(supports.anchor), "as the ground asks", 8, "base plates"});
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
  const double foot = trestle.ground + supports.grout + kPlate + 100e-3;
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

/// How far from a trestle along the track frames must stay: below a slope they lean back over its beam.
double clear_of(const Shell& shell, double at, double saddle_height) {
  const PlateOptions& options = shell.options;
  const double width = std::max(options.flanges.width, options.stiffeners ? options.stiffeners->width : 0.0);
  const double high =
      width + options.flanges.gap + saddle_height - shell.lowest + std::max(0.0, -shell.lowest);
  const auto [sine, cosine] = math::sine_cosine(shell.track.at(at).slope_angle);
  const double reach = (0.5 * options.supports->tube + high * std::fabs(sine)) / std::max(0.1, cosine);
  return std::max(kLeastClear, reach + kOffTaken);
}

/// A place for a trestle near another one, and half of the length of its saddles.
struct TrestlePlace {
  double at = 0.0;
  double half = kSaddleHalf;
};

std::optional<TrestlePlace> free_place(const Shell& shell, const TakenUp& taken, double about, double clear) {
  const Span whole = shell.whole;
  if (shell.straights.empty()) {
    const auto at = taken.free_place(about, clear, whole);
    if (!at) return std::nullopt;
    return TrestlePlace{*at, kSaddleHalf};
  }
  // In the middle of what is straight, where that is shorter than a saddle.
  constexpr double kLeastHalf = 20e-3;
  constexpr double kOffBend = 1e-3;
  std::optional<TrestlePlace> best;
  for (const Straight& straight : shell.straights) {
    const double half = std::min(kSaddleHalf, 0.5 * (straight.span.to - straight.span.from) - kOffBend);
    if (half < kLeastHalf) continue;
    const Span room{straight.span.from + kOffBend + half, straight.span.to - kOffBend - half};
    constexpr int kPlaces = 20;
    for (int k = 0; k <= kPlaces; ++k) {
      const double s = room.from + (room.to - room.from) * k / kPlaces;
      if (best && std::fabs(best->at - about) <= std::fabs(s - about)) continue;
      if (taken.is_free(s, clear, whole)) best = TrestlePlace{s, half};
    }
  }
  return best;
}

/// @throws InputError where the ground leaves no room
void require_room_for_legs(const Trestle& trestle, const SupportOptions& supports) {
  const double leg = trestle.leg(supports);
  if (leg >= kLeastLeg) return;
  const double under = trestle.beam + kSaddleLeast;
  throw InputError({"supports.ground",
                    "ground: at " + length_text(trestle.at, 3) + " along the track it lies " +
                        length_text(std::fabs(under - trestle.ground), 3) +
                        (under > trestle.ground ? " below" : " above") + " the underside of the track",
                    "Saddle, beam, base plate and the least leg of " + length_text(kLeastLeg) + " take " +
                        length_text(kSaddleLeast + supports.tube + kPlate + supports.grout + kLeastLeg, 3) +
                        ".",
                    "a lower ground, or a ground line that is lower there"});
}

/// The unit that a place lies in, of two that meet there the one that begins.
Span unit_at(const Shell& shell, double s) {
  const auto next = std::upper_bound(shell.units.begin() + 1, shell.units.end(), s,
                                     [](double at, const Span& unit) { return at < unit.from; });
  return *(next - 1);
}

/// The least slope angle, which an arc has at one of its ends [rad].
double flattest_of(const ArcSpline& track) {
  double least = track.slope_angle(track.length());
  for (const TrackArc& arc : track.arcs()) least = std::min(least, track.slope_angle(arc.start));
  return least;
}

/// A trestle to be: where it stands, and what it takes up along the track.
struct Standing {
  TrestlePlace place;
  double clear = 0.0;
  Saddles saddles;
  Trestle trestle;
};

/// Frames, stiffeners and other plates square to the track, and angles, seen from the side: below a slope they lean over beams.
class SideView {
 public:
  explicit SideView(const Shell& shell) : placement_(shell.placement) {
    for (const ShopPart& part : shell.workshop.parts) {
      for (const Frame& place : part.places) {
        if (const auto* const prism = std::get_if<Prism>(&part.body)) add(*prism, place);
        if (!std::holds_alternative<AngleBar>(part.body)) continue;
        for (const EdgeLine& line : edge_lines(part.body, 0.0)) {
          const Vec3 from = place.to_space(line.from);
          const Vec3 to = place.to_space(line.to);
          lines_.push_back({seen(from), seen(to)});
          shapes_.push_back({{seen(from), seen(to)}, ordered(aside_of(from), aside_of(to))});
        }
      }
    }
  }

  /// @return whether nothing of it lies where beam and legs of a trestle stand
  [[nodiscard]] bool is_clear(const Trestle& trestle, double tube) const {
    constexpr double kAround = 1e-3;  // taste: of beams [m]
    const double half = 0.5 * tube + kAround;
    const Vec2 low{trestle.x - half, trestle.ground};
    const Vec2 high{trestle.x + half, trestle.beam + kAround};
    return std::none_of(lines_.begin(), lines_.end(),
                        [&](const auto& line) { return meets(line[0], line[1], low, high); });
  }

  /// @param seat  what the saddle is cut to
  /// @return whether a saddle stands beside all of it: stiffeners lean over what is upright
  [[nodiscard]] bool is_clear(const ArcPath& seat, double aside, double beam) const {
    constexpr double kAround = 1e-3;  // taste: of saddles [m]
    std::vector<Vec2> saddle;
    for (const PathVertex& vertex : seat.vertices) saddle.push_back(vertex.at);
    saddle.push_back({seat.vertices.back().at.x, beam});
    saddle.push_back({seat.vertices.front().at.x, beam});
    const double half = 0.5 * kSaddle + kAround;
    return std::none_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
      return shape.aside.from < aside + half && shape.aside.to > aside - half &&
             gap_between(shape.corners, saddle) < kAround;
    });
  }

 private:
  /// A convex figure, and from where to where it reaches across, to the left.
  struct Shape {
    std::vector<Vec2> corners;
    Span aside;
  };
  static Span ordered(double a, double b) { return {std::min(a, b), std::max(a, b)}; }
  [[nodiscard]] double aside_of(Vec3 point) const {
    return dot(point - in_space(placement_, {}), across(placement_));
  }
  /// The widest gap between two convex figures, square to an edge of either; negative where they meet.
  static double gap_between(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    double widest = -std::numeric_limits<double>::infinity();
    const auto reach = [](const std::vector<Vec2>& corners, Vec2 way) {
      Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      for (const Vec2 corner : corners)
        span = {std::min(span.from, dot(corner, way)), std::max(span.to, dot(corner, way))};
      return span;
    };
    for (const std::vector<Vec2>* const one : {&a, &b}) {
      for (std::size_t i = 0; i < one->size(); ++i) {
        const Vec2 edge = (*one)[(i + 1) % one->size()] - (*one)[i];
        if (!(norm(edge) > 0.0)) continue;
        const Vec2 way = (1.0 / norm(edge)) * Vec2{-edge.y, edge.x};
        const Span first = reach(a, way);
        const Span second = reach(b, way);
        widest = std::max({widest, second.from - first.to, first.from - second.to});
      }
    }
    return widest;
  }
  [[nodiscard]] Vec2 seen(Vec3 point) const {
    const Vec3 away = point - in_space(placement_, {});
    return {dot(away, along(placement_)), away.z};
  }
  void add(const Prism& prism, const Frame& place) {
    constexpr double kSquare = 1e-6;  // rounding
    const Vec3 aside = across(placement_);
    if (std::fabs(dot(place.z, aside)) > kSquare) return;
    const Vec3 up = cross(aside, place.z);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec2 corner : flattened(prism.region.outline, 1e-4)) {
      const double level = dot(corner.x * place.x + corner.y * place.y, up);
      low = std::min(low, level);
      high = std::max(high, level);
    }
    const Vec3 far = prism.depth * place.z;
    const std::array<Vec2, 4> corners = {seen(place.origin + low * up), seen(place.origin + high * up),
                                         seen(place.origin + high * up + far),
                                         seen(place.origin + low * up + far)};
    for (std::size_t i = 0; i < 4; ++i) lines_.push_back({corners[i], corners[(i + 1) % 4]});
    shapes_.push_back({{corners.begin(), corners.end()}, reach_of(prism, place)});
  }
  /// From where to where a plate square to the track reaches across.
  [[nodiscard]] Span reach_of(const Prism& prism, const Frame& place) const {
    Span reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Vec2 corner : flattened(prism.region.outline, 1e-4)) {
      const double aside = aside_of(place.to_space({corner.x, corner.y, 0.0}));
      reach = {std::min(reach.from, aside), std::max(reach.to, aside)};
    }
    return reach;
  }
  /// Whether some of a segment lies in a rectangle.
  static bool meets(Vec2 from, Vec2 to, Vec2 low, Vec2 high) {
    double first = 0.0;
    double last = 1.0;
    const auto cut = [&](double start, double way, double least, double most) {
      if (way == 0.0) return start >= least && start <= most;
      const double a = (least - start) / way;
      const double b = (most - start) / way;
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
      return first <= last;
    };
    return cut(from.x, to.x - from.x, low.x, high.x) && cut(from.y, to.y - from.y, low.y, high.y);
  }

  const Placement& placement_;
  std::vector<std::array<Vec2, 2>> lines_;
  std::vector<Shape> shapes_;
};

/// Looks for places at which a trestle can stand.
class TrestleSeats {
 public:
  TrestleSeats(const Shell& shell, const SideView& view) : shell_(shell), view_(view) {}

  /// @param clear  that it keeps off what is taken, at the least [m]
  /// @return the free place nearest to one, clear of what leans over it; none where that is none
  [[nodiscard]] std::optional<Standing> near(double about, const TakenUp& taken, double clear,
                                             int tries) const {
    constexpr double kFarther =
        10e-3;  // taste: that one keeps off more, where a frame stands over its beam [m]
    for (int k = 0; k < tries; ++k, clear += kFarther) {
      const auto place = free_place(shell_, taken, about, clear);
      if (!place) return std::nullopt;
      if (auto one = at(*place, clear)) return one;
    }
    return std::nullopt;
  }

  /// @return a trestle at a place; none where the track is too steep, or where it is steeper than where it was asked for, and frames
  ///         lean farther over it
  [[nodiscard]] std::optional<Standing> at(const TrestlePlace& place, double clear) const {
    if (shell_.track.at(place.at).slope_angle > shell_.options.supports->steepest.radians())
      return std::nullopt;
    const Saddles saddles = saddles_at(shell_, place.at, place.half);
    if (!seat_line(shell_, place.at, place.half, saddles.height[0]) ||
        !seat_line(shell_, place.at, place.half, saddles.height[1]))
      return std::nullopt;
    Standing one{place, clear, saddles, trestle_at(shell_, place.at, saddles)};
    if (!view_.is_clear(one.trestle, shell_.options.supports->tube) || !saddles_clear(one))
      return std::nullopt;
    return one;
  }

  [[nodiscard]] const Shell& shell() const { return shell_; }

 private:
  [[nodiscard]] bool saddles_clear(const Standing& one) const {
    for (std::size_t side = 0; side < 2; ++side) {
      const auto seat = seat_line(shell_, one.place.at, one.place.half, one.saddles.height[side]);
      if (!view_.is_clear(*seat, one.saddles.aside[side], one.trestle.beam)) return false;
    }
    return true;
  }

  const Shell& shell_;
  const SideView& view_;
};

/// Whether two trestles, one after the other, leave each other what they take up, and do not stand on each other's base plates.
bool stand_beside(const Standing& a, const Standing& b, const SupportOptions& supports) {
  constexpr double kSame = 1e-9;  // rounding [m]
  return b.place.at - a.place.at >= a.clear + b.clear - kSame &&
         std::fabs(b.trestle.x - a.trestle.x) >= base_side(supports) + kBaseGap;
}

using Trestles = std::vector<Standing>;  // from upstream to downstream

/// In so many gaps, as even as what is taken allows; those that find no place are left out.
Trestles evenly_standing(const TrestleSeats& seats, double gaps) {
  const Shell& shell = seats.shell();
  const double room = std::max(0.0, shell.track.length() - 2.0 * kApart);
  TakenUp taken = shell.taken;
  constexpr int kTries = 12;  // budget
  Trestles row;
  for (double k = 0.0; k <= gaps; k += 1.0) {
    const double about = kApart + room * k / gaps;
    const auto one =
        seats.near(about, taken, clear_of(shell, about, saddles_at(shell, about, 0.0).height[0]), kTries);
    if (!one) continue;
    const auto after = std::find_if(row.begin(), row.end(),
                                    [&](const Standing& other) { return other.place.at > one->place.at; });
    const SupportOptions& supports = *shell.options.supports;
    // Two of them on the only places that are free stand on each other's base plates.
    if (after != row.begin() && !stand_beside(*(after - 1), *one, supports)) continue;
    if (after != row.end() && !stand_beside(*one, *after, supports)) continue;
    taken.add(one->place.at - one->clear, one->place.at + one->clear);
    row.insert(after, *one);
  }
  return row;
}

/// Every place at which one could stand, in steps.
Trestles all_standing(const TrestleSeats& seats) {
  constexpr double kStep = 10e-3;  // taste: in which places are looked for, no finer [m]
  constexpr double kMost = 400.0;  // budget: of steps
  constexpr int kTries = 3;        // budget: places farther off are those of other steps
  const Shell& shell = seats.shell();
  const double length = shell.track.length();
  const double steps = std::clamp(std::ceil(length / kStep), 1.0, kMost);
  Trestles all;
  for (double k = 0.0; k <= steps; k += 1.0) {
    // What leans over it is looked at from the side; of the rest it keeps off as a trestle below a level track.
    if (auto one = seats.near(length * k / steps, shell.taken, kLeastClear, kTries))
      all.push_back(*std::move(one));
  }
  std::stable_sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) {
    return std::pair(a.place.at, a.clear) < std::pair(b.place.at, b.clear);
  });
  const auto same = [](const Standing& a, const Standing& b) { return a.place.at == b.place.at; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

/// What a row falls short of what is asked for, and what it takes.
struct RowCost {
  double excess = 0.0;    ///< sum of squares of what spans are wider than asked for
  std::size_t count = 0;  ///< of trestles
  double uneven = 0.0;    ///< sum of squares of spans

  /// @param span  one more; an end that sticks out counts twice: the moment of its weight, w a^2/2, is that of a span, w l^2/8
  [[nodiscard]] RowCost with(double span, double spacing) const {
    constexpr double kSame = 1e-9;  // rounding [m]
    const double more = span > spacing + kSame ? span - spacing : 0.0;
    return {excess + more * more, count, uneven + span * span};
  }
  /// Two of them at least, where they have places.
  [[nodiscard]] bool operator<(const RowCost& other) const {
    return std::pair(count < 2, std::tuple(excess, count, uneven)) <
           std::pair(other.count < 2, std::tuple(other.excess, other.count, other.uneven));
  }
};

RowCost cost_of(const Trestles& row, double spacing, double length) {
  RowCost cost = RowCost().with(2.0 * row.front().place.at, spacing);
  for (std::size_t i = 1; i < row.size(); ++i)
    cost = cost.with(row[i].place.at - row[i - 1].place.at, spacing);
  return cost.with(2.0 * (length - row.back().place.at), spacing);
}

/// Of all rows from these places that of the least cost.
Trestles cheapest(const Trestles& all, const SupportOptions& supports, double length) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  // Of the rows that end with a trestle the cheapest one of one, and of more.
  struct Way {
    RowCost cost;
    std::size_t from = kNone;
  };
  std::vector<Way> ways(all.size());
  std::optional<Way> best;
  std::size_t last = kNone;
  const auto end_with = [&](std::size_t i, Way way) {
    way.cost = way.cost.with(2.0 * (length - all[i].place.at), supports.spacing);
    if (best && !(way.cost < best->cost)) return;
    best = way;
    last = i;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double at = all[i].place.at;
    Way first{RowCost().with(2.0 * at, supports.spacing), kNone};
    first.cost.count = 1;
    std::optional<Way> joined;
    for (std::size_t k = 0; k < i; ++k) {
      if (!stand_beside(all[k], all[i], supports)) continue;
      Way one{ways[k].cost.with(at - all[k].place.at, supports.spacing), k};
      ++one.cost.count;
      if (!joined || one.cost < joined->cost) joined = one;
    }
    end_with(i, first);
    if (joined) end_with(i, *joined);
    // What goes on from here has two or more, either way.
    const auto as_part = [](const Way& way) {
      return std::tuple(way.cost.excess, way.cost.count, way.cost.uneven);
    };
    ways[i] = joined && as_part(*joined) < as_part(first) ? *joined : first;
  }
  Trestles row;
  std::size_t from = best ? best->from : kNone;
  if (last != kNone) row.push_back(all[last]);
  for (; from != kNone; from = ways[from].from) row.insert(row.begin(), all[from]);
  return row;
}

/// The fewest that are no farther apart than is asked for; where none are, those that come nearest to it.
Trestles standing(const Shell& shell) {
  const SupportOptions& supports = *shell.options.supports;
  const double length = shell.track.length();
  const double gaps = std::max(1.0, std::ceil((length - 2.0 * kApart) / supports.spacing - 1e-9));
  const SideView view(shell);
  const TrestleSeats seats(shell, view);
  const Trestles even = evenly_standing(seats, gaps);
  if (!even.empty() && cost_of(even, supports.spacing, length).excess == 0.0) return even;
  Trestles all = all_standing(seats);
  all.insert(all.end(), even.begin(), even.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Standing& a, const Standing& b) { return a.place.at < b.place.at; });
  return cheapest(all, supports, length);
}

/// Says where trestles are farther apart than is asked for, and where track sticks out too far beyond them.
void note_wide_spans(const Trestles& all, const Shell& shell) {
  constexpr double kTold = 1e-3;  // [m]
  if (all.empty()) return;
  const double spacing = shell.options.supports->spacing;
  const char* const why = ": frames, stiffeners, bends or other trestles leave no place ";
  std::size_t widest = 0;
  const auto span = [&](std::size_t i) { return all[i].place.at - all[i - 1].place.at; };
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (widest == 0 || span(i) > span(widest)) widest = i;
  }
  if (widest > 0 && span(widest) > spacing + kTold) {
    shell.workshop.notes.push_back(
        "Trestles are up to " + length_text(span(widest), 3) + " apart along the track, from " +
        length_text(all[widest - 1].place.at, 4) + " to " + length_text(all[widest].place.at, 4) +
        ", for spacing: " + length_text(spacing) + why + "between.");
  }
  const double length = shell.track.length();
  const auto tell = [&](double out, double at, const char* way) {
    if (!(out > 0.5 * spacing + kTold)) return;
    shell.workshop.notes.push_back("The track sticks out by " + length_text(out, 3) + " along it " + way +
                                   " trestle, at " + length_text(at, 4) + ", for " +
                                   length_text(0.5 * spacing) + ", half of spacing: " + length_text(spacing) +
                                   why + "nearer to its end, or it is steeper there than " +
                                   angle_text(shell.options.supports->steepest, 3) + ".");
  };
  tell(all.front().place.at, all.front().place.at, "above the first");
  tell(length - all.back().place.at, all.back().place.at, "below the last");
}

}  // namespace

void add_supports(const Shell& shell, std::vector<SettingOutPoint>& rows) {
  if (!shell.options.supports) return;
  const SupportOptions& supports = *shell.options.supports;
  const Trestles all = standing(shell);
  std::vector<Foot> feet;
  for (const Standing& one : all) feet.push_back({one.trestle.x, frame_of(shell, one.place.at).at.x});
  require_on_ground(supports.ground, feet, "supports.ground", "a trestle");
  for (const Standing& one : all) require_room_for_legs(one.trestle, supports);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Standing& one = all[i];
    const Measures measures = measures_of(shell, one.saddles);
    const std::string text = std::to_string(i + 1);
    add_saddles(shell, one.trestle, one.saddles, text);
    add_legs(shell, one.trestle, measures, text);
    add_braces(shell, one.trestle, measures, text);
    shell.taken.add(one.place.at - one.clear, one.place.at + one.clear);
    rows.push_back(setting_out_point(shell.track, unit_at(shell, one.place.at), shell.placement,
                                     "support " + text, one.place.at));
  }
  note_wide_spans(all, shell);
  if (!all.empty()) return;
  if (flattest_of(shell.track) <= supports.steepest.radians()) {
    shell.workshop.notes.emplace_back(
        "No trestle finds a place that is flat and straight enough for its saddles.");
    return;
  }
  throw InputError({"supports.steepest",
                    "steepest: the track is nowhere flatter than " + angle_text(supports.steepest, 3),
                    "A trestle under a steeper track would carry nothing.",
                    "a steepest above its least slope angle, or no supports"});
}

}  // namespace glissade::parts
