#include "parts/plates/plate_joints.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/least_rectangle.hpp"
#include "parts/plates/calm_joints.hpp"
#include "parts/plates/channel_strips.hpp"
#include "parts/plates/corners.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kBeyondFrame = 1e-3;  // of flats beyond the frames at their ends [m]
constexpr double kRoom = 0.1;          // of a unit, by which a joint may move to where the track bends less

/// @param face  of the unit's floor
std::string fold_text(const Job& job, const Span& span, const FloorFace& face) {
  ChannelMeasures lower = job.channel;
  do {
    lower.wall_height *= 0.95;
  } while (lower.wall_height > 1e-3 &&
           !wall_region({job.track, lower, job.options, job.placement}, span, face, {}));
  return "wall_height: " + length_text(lower.wall_height, 2);
}

Unit make_unit(const Job& job, const Span& span, std::size_t number, double largest_kink) {
  const bool bent = job.options.floor == FloorMake::bent;
  Unit unit{span,
            {},
            {},
            bent ? bent_floor_face(job, facets_of(job, span, largest_kink))
                 : rolled_face(job.track, span, floor_depth(job)),
            {}};
  if (bent) require_end_flats(span, *unit.face.facets, job.options.flanges);
  unit.tabs = tab_places(job, unit.face, number);
  unit.floor = floor_plate(job, unit.face, unit.tabs, unit.steps);
  if (job.channel.wall_height == 0.0) return unit;
  unit.wall = wall_plate(job, span, unit.face, unit.tabs);
  if (unit.wall) return unit;
  throw InputError({"",
                    "walls of " + length_text(job.channel.wall_height) + " fold over between " +
                        length_text(span.from) + " and " + length_text(span.to) + " along the track",
                    "Their tops are nearer to each other than the radius of the track there.",
                    fold_text(job, span, unit.face)});
}

std::vector<Unit> units_between(const Job& job, const std::vector<double>& joints, double largest_kink) {
  std::vector<Unit> units;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    units.push_back(make_unit(job, {joints[i], joints[i + 1]}, i + 1, largest_kink));
  }
  return units;
}

}  // namespace

Facets facets_by_rule(const ArcSpline& track, const Span& span, const BendOptions& bend, double largest_kink,
                      double least, double least_end) {
  switch (bend.rule) {
    case FacetRule::chord_tolerance:
      return facets_by_chord(track, span, bend.value, least, least_end);
    case FacetRule::segment_length:
      return facets_by_length(track, span, bend.value, least, least_end);
    case FacetRule::bends:
    case FacetRule::segment_angle:
    case FacetRule::speed_loss:
      break;
  }
  return facets_by_angle(track, span, largest_kink, least, least_end);
}

void require_frame_room(const ArcSpline& track, const std::vector<double>& joints, const FlangeOptions& frame,
                        double lowest, std::optional<double> highest) {
  if (!frame.wanted) return;
  double most = 0.0;
  double where = 0.0;
  for (const TrackArc& arc : track.arcs()) {
    const double height = arc.curvature < 0.0 ? lowest : highest.value_or(0.0);
    if (arc.curvature == 0.0 || (arc.curvature > 0.0 && !highest)) continue;
    const bool beside = std::any_of(joints.begin(), joints.end(), [&](double s) {
      return arc.start < s + frame.along() && arc.start + arc.length > s - frame.along();
    });
    if (!beside) continue;
    const double radius = std::fabs(1.0 / arc.curvature - height);
    const double out = radius - std::sqrt(std::max(0.0, radius * radius - frame.along() * frame.along()));
    if (out > most) where = arc.start;
    most = std::max(most, out);
  }
  if (most <= frame.gap + 5e-6) return;
  throw InputError({"flanges.gap",
                    "gap: " + length_text(frame.gap) + " is closed where the track bends, at " +
                        length_text(where, 3) + " along it",
                    "Within a frame of " + length_text(frame.along()) + " the section departs by " +
                        length_text(most, 3) + " from the straight.",
                    "gap: " + length_text(1e-4 * std::ceil(1.05e4 * most)) + ", or a " +
                        (frame.section == FlangeSection::angle ? "narrower angle" : "thinner frame")});
}

namespace {

/// Of a line at a height above a stretch of track, nothing where it folds.
double offset_length(const ArcSpline& track, const Span& span, double height) {
  double length = 0.0;
  for (const TrackArc& arc : track.arcs()) {
    const double from = std::max(span.from, arc.start);
    const double to = std::min(span.to, arc.start + arc.length);
    if (to > from) length += (to - from) * std::max(0.0, 1.0 - arc.curvature * height);
  }
  return length;
}

}  // namespace

void require_units_longer(const ArcSpline& track, const std::vector<double>& joints,
                          const PlateOptions& options, double lowest, double highest) {
  const FlangeOptions& frame = options.flanges;
  if (!frame.wanted) return;
  const double taken = 2.0 * (frame.along() + kBeyondFrame);
  double least = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const Span span{joints[i], joints[i + 1]};
    // Frames stand out of the section as far as they are wide.
    const double room = std::min({span.to - span.from, offset_length(track, span, highest + frame.width),
                                  offset_length(track, span, lowest - frame.width)});
    if (room < least) at = i;
    least = std::min(least, room);
  }
  if (!(least < taken)) return;
  const SplitOptions& split = options.split;
  const std::string key = split.longest ? "longest" : split.heaviest ? "heaviest" : "sheet";
  // Twice, as units are not even.
  const std::string longer =
      split.longest ? "longest: " + length_text(1e-3 * std::ceil(2e3 * taken / least * *split.longest))
                    : "a larger " + key;
  throw InputError({"split." + key,
                    key + ": unit " + std::to_string(at + 1) + ", " +
                        length_text(joints[at + 1] - joints[at], 3) +
                        " long, has no room for the frames at its ends",
                    "Where it is shortest " + length_text(least, 3) + " are left, the frames take " +
                        length_text(taken, 3) + ".",
                    longer + ", or flanges: none"});
}

void require_end_flats(const Span& unit, const Facets& facets, const FlangeOptions& frame) {
  if (!frame.wanted || frame.section != FlangeSection::angle || facets.bends() == 0) return;
  const std::size_t last = facets.corners.size() - 1;
  for (const bool first : {true, false}) {
    const double flat = first ? norm(facets.corners[1] - facets.corners[0])
                              : norm(facets.corners[last] - facets.corners[last - 1]);
    const double kink = std::fabs(first ? facets.kinks.front() : facets.kinks.back());
    if ((frame.along() - flat) * math::tan(kink) <= frame.gap) continue;
    throw InputError(
        {"flanges.section",
         "section: angle stands across a bend, at " + length_text(first ? unit.from : unit.to, 4) +
             " along the track",
         "The flat there is " + length_text(flat, 3) + " long, the leg " + length_text(frame.along()) + ".",
         "a narrower angle, section: flat, or floor: rolled"});
  }
}

double least_end_flat(const PlateOptions& options, double more) {
  const FlangeOptions& frame = options.flanges;
  if (!frame.wanted || frame.section != FlangeSection::angle) return 0.0;
  return frame.along() + kBeyondFrame + more;
}

double least_flat(double thickness, const PlateOptions& options, double more) {
  const FlangeOptions& frame = options.flanges;
  const double pressed = std::max(options.shop.flat_thicknesses * thickness, options.shop.flat);
  return frame.wanted ? std::max(pressed, frame.thickness + kBeyondFrame + more) : pressed;
}

Facets facets_of(const Job& job, const Span& span, double largest_kink) {
  return facets_by_rule(job.track, span, job.options.bend, largest_kink,
                        least_flat(job.channel.thickness, job.options, 0.0),
                        least_end_flat(job.options, 0.0));
}

double kink_for_speed(const ArcSpline& track, const BendOptions& bend,
                      const std::function<Facets(double)>& facets, const Body& body, double gravity,
                      double design_speed) {
  double turning = 0.0;
  for (const TrackArc& arc : track.arcs()) turning += std::fabs(arc.curvature) * arc.length;
  if (bend.rule == FacetRule::segment_angle) return bend.value;
  if (bend.rule == FacetRule::bends) return std::max(turning, 1e-9) / bend.value;
  if (bend.rule != FacetRule::speed_loss || !(turning > 0.0)) return 1.0;
  const auto cost = [&](double kink) {
    const FacetRide ride = ride_facets({facets(kink)}, body, gravity, 0.0);
    return ride.arrives ? 1.0 - ride.speed / design_speed : 1.0;
  };
  // (1 + mu^2) turning^2 / (2 n) of the speed: the count that this asks for, then as many as the ride takes.
  const double mu = body.friction.coefficient();
  double count = std::ceil((1.0 + mu * mu) * turning * turning / (2.0 * bend.value));
  constexpr int kTries = 60;
  for (int k = 0; k < kTries && cost(turning / count) > bend.value; ++k) count = std::ceil(1.05 * count);
  for (int k = 0; k < kTries && count > 1.0 && cost(turning / (count - 1.0)) <= bend.value; ++k) count -= 1.0;
  return turning / count;
}

void tell_missed_speed(const BendOptions& bend, const std::vector<Facets>& units, double least,
                       const std::string& or_else, const Body& body, double gravity, double design_speed,
                       Workshop& workshop) {
  if (bend.rule != FacetRule::speed_loss) return;
  constexpr double kMissed = 1.05;  // rounding: of what is asked for; ends of units cost as much
  const auto cost = [&](const std::vector<Facets>& facets) -> std::optional<double> {
    const FacetRide ride = ride_facets(facets, body, gravity, 0.0);
    if (!ride.arrives) return std::nullopt;
    return 1.0 - ride.speed / design_speed;
  };
  const std::optional<double> reached = cost(units);
  if (!reached || !(*reached > kMissed * bend.value)) return;
  std::size_t bends = 0;
  for (const Facets& facets : units) bends += facets.bends();
  const auto share = [](double value, int digits) { return rounded_text(1e2 * value, digits) + " %"; };
  // Up to tenths of a percent, with room for the ends of units.
  constexpr double kTenth = 1e-3;  // taste: of a percent
  const double would_do = kTenth * std::ceil(kMissed * *reached / kTenth);
  add_shortfall({"bend.speed_loss",
                 "speed_loss: " + share(bend.value, 4) + " is not reached: " + std::to_string(bends) +
                     " bends cost " + share(*reached, 2) + " of the exit speed",
                 "Flats are as short as the shop makes them, " + length_text(least, 3) + ".",
                 "speed_loss: " + share(would_do, 4) + or_else},
                workshop);
}

std::vector<double> joints_of(const ArcSpline& track, const SplitOptions& split, std::size_t count) {
  const double even = track.length() / static_cast<double>(count);
  double room = kRoom * even;
  if (split.longest) room = std::min(room, 0.5 * std::max(0.0, *split.longest - even));
  return calm_joints(track, count, room);
}

namespace {

/// Rounded up to three digits.
std::string mass_up(double mass) {
  double digit = 1e-6;  // [kg]
  while (mass >= 1e3 * digit) digit *= 10.0;
  return rounded_text(digit * std::ceil(mass / digit), 3) + " kg";
}

/// Of a sheet, rounded up to 10 mm.
std::string length_up(double length) {
  return length_text(1e-2 * std::ceil(1e2 * length - 1e-6), 5);
}

}  // namespace

Vec2 laid_size(const ArcPath& outline, Vec2 sheet) {
  constexpr double kPlay = 1e-5;  // accuracy [m]: by which nests may turn it otherwise
  const PlaneBox box = bounds(outline);
  const Vec2 drawn{std::max(box.width(), box.height()), std::min(box.width(), box.height())};
  const auto share = [&](Vec2 size) { return std::max(size.x / sheet.x, size.y / sheet.y); };
  if (!(share(drawn) > 1.0)) return drawn;
  const Vec2 least = core::least_size(outline) + Vec2{kPlay, kPlay};
  return share(least) <= 1.0 ? least : drawn;
}

std::optional<Excess> excess(const SplitOptions& split, const ShopPart& part) {
  const NestStock stock = split.stock();
  const Vec2 laid = laid_size(part.pattern->region.outline, stock.room());
  const double longer = laid.x + 2.0 * split.margin;
  const double shorter = laid.y + 2.0 * split.margin;
  const double mass = split.heaviest ? part.mass / *split.heaviest : 0.0;
  if (longer > stock.width || shorter > stock.height) {
    return Excess{"takes " + length_text(longer) + " x " + length_text(shorter) + " with a margin of " +
                      length_text(split.margin),
                  "the sheet is " + length_text(stock.width) + " x " + length_text(stock.height),
                  std::max({longer / stock.width, shorter / stock.height, mass}),
                  "sheet: [" + length_up(std::max(longer, stock.width)) + ", " +
                      length_up(std::max(shorter, stock.height)) + "]" +
                      (mass > 1.0 ? ", heaviest: " + mass_up(part.mass) : std::string()),
                  shorter > stock.height && shorter <= stock.width};
  }
  if (mass > 1.0) {
    return Excess{"weighs " + rounded_text(part.mass, 4) + " kg",
                  "the heaviest part may weigh " + rounded_text(*split.heaviest, 4) + " kg", mass,
                  "heaviest: " + mass_up(part.mass)};
  }
  return std::nullopt;
}

bool is_too_heavy(const ShopPart& part, const SplitOptions& split) {
  constexpr double kRounding = 1e-9;  // of a mass
  return split.heaviest && part.mass > *split.heaviest * (1.0 + kRounding);
}

void throw_too_heavy(const ShopPart& part, double heaviest, double lightest, const std::string& why) {
  throw InputError({"split.heaviest",
                    "heaviest: " + rounded_text(heaviest, 4) + " kg, and " + part.name + " weighs " +
                        rounded_text(part.mass, 4) + " kg",
                    why, "heaviest: " + mass_up(lightest)});
}

void keep_worse(std::optional<Excess> found, const std::string& part, std::optional<Excess>& worst) {
  if (!found || (worst && !(found->times > worst->times))) return;
  found->what = part + " " + found->what;
  worst = std::move(found);
}

void split_until_it_fits(const SplitOptions& split, double length,
                         const std::function<std::optional<Excess>(std::size_t)>& make) {
  std::size_t count = 1;
  if (split.longest && split.allowed)
    count = static_cast<std::size_t>(std::ceil(length / *split.longest - 1e-9));
  if (count > kMostUnits) {
    throw InputError({"split.longest",
                      "longest: " + length_text(*split.longest) + " makes " + std::to_string(count) +
                          " units of a track of " + length_text(length, 4),
                      "There are at most " + std::to_string(kMostUnits) + ".",
                      "longest: " + length_text(length / 3.0, 2)});
  }
  std::string last;
  // Where twice as many units have not made what exceeds smaller, no number of them will; but for what they may turn.
  double least = std::numeric_limits<double>::infinity();
  double least_at = static_cast<double>(count);
  constexpr double kSafe = 0.8;  // of the count that lengths ask for: ends of units are not even
  double next = static_cast<double>(count);
  for (; count <= kMostUnits; count = static_cast<std::size_t>(next)) {
    const std::optional<Excess> found = make(count);
    if (!found) return;
    const double whole = static_cast<double>(count);
    next = std::max(whole + 1.0, std::floor(kSafe * whole * found->times));
    if (!split.allowed) {
      throw InputError({"split", found->what, "One piece is asked for, and " + found->bound + ".",
                        "split without allowed: false, or " + found->way_out});
    }
    last = found->what + "; " + found->bound;
    if (found->times < 0.98 * least) {
      least = found->times;
      least_at = whole;
    } else if (!found->turns && whole >= 2.0 * least_at + 2.0) {
      throw InputError({"split", found->what,
                        "Shorter units do not make it smaller, and " + found->bound + ".",
                        found->way_out + ", or a smaller cross_section"});
    }
  }
  throw InputError({"split", "no " + std::to_string(kMostUnits) + " units are small enough: " + last, "",
                    "a larger sheet or heaviest"});
}

std::vector<Unit> split_units(const Job& job, double largest_kink) {
  std::vector<Unit> units;
  split_until_it_fits(job.options.split, job.track.length(), [&](std::size_t count) {
    units = units_between(job, joints_of(job.track, job.options.split, count), largest_kink);
    std::optional<Excess> worst;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const std::string number = " of unit " + std::to_string(i + 1);
      for (const ShopPart& floor : floor_strips(job, units[i], i))
        keep_worse(excess(job.options.split, floor), "the floor" + number, worst);
      for (const WallStrip& wall : wall_strips(job, units[i], i))
        keep_worse(excess(job.options.split, wall.part), "a wall" + number, worst);
    }
    return worst;
  });
  return units;
}

}  // namespace glissade::parts
