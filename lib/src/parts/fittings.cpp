#include "parts/fittings.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bolts.hpp"
#include "parts/channel_strips.hpp"
#include "parts/corners.hpp"
#include "parts/nearest_place.hpp"
#include "parts/seams.hpp"
#include "parts/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kLap = 30e-3;         // of a lid beyond its opening, all round [m]
constexpr double kLeastWeb = 20e-3;    // of a wall above and below an opening [m]
constexpr double kLeastRound = 20e-3;  // of a stiffener, beyond a corner that laps [m]
constexpr double kLugHalf = 40e-3;     // of a lug, along the track [m]
constexpr double kLugHigh = 60e-3;     // above the wall's top [m]
constexpr double kLugLow = 60e-3;      // below it, on a wall without a rim [m]

/// Half the width of the channel outside.
double outside(const Job& job) {
  return 0.5 * job.channel.width + job.channel.wall();
}

/// What frames leave of a unit.
Span between_frames(const Job& job, const Span& unit) {
  if (!job.options.flanges.wanted) return unit;
  const double high = job.channel.wall_height + (job.options.cover ? job.options.cover->thickness : 0.0);
  const double taken = job.options.flanges.thickness + kAsideOfFrame;
  return {beyond_frame(job.track, taken, unit.from, 1.0, high),
          beyond_frame(job.track, taken, unit.to, -1.0, high)};
}

std::string suffix(const Fitting& fitting, std::size_t unit) {
  return fitting.units.size() > 1 ? "_" + std::to_string(unit + 1) : "";
}

ShopPart in_material(const Job& job, std::string name, double thickness) {
  ShopPart part;
  part.name = std::move(name);
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = thickness;
  return part;
}

[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string hint) {
  throw InputError({std::move(where), std::move(what), std::move(why), std::move(hint)});
}

/// What of a stretch is left for a cover: clear of arcs at its ends over which the walls' tops fold.
Span under_cover(const Job& job, const Span& span) {
  const double high = job.channel.wall_height + job.options.cover->thickness;
  constexpr double kRoomAtFold = 1.02;  // radius over height from which nothing folds
  constexpr double kMostOpen = 0.2;     // of the stretch, at either end
  const double most = kMostOpen * (span.to - span.from);
  Span left = span;
  for (const TrackArc& arc : job.track.arcs()) {
    const double end = arc.start + arc.length;
    if (arc.curvature * high * kRoomAtFold <= 1.0 || end <= left.from || arc.start >= left.to) continue;
    if (end - span.from <= most) {
      left.from = end;
    } else if (span.to - arc.start <= most) {
      left.to = arc.start;
    } else {
      refuse("cover", "cover: the walls' tops fold over at " + length_text(arc.start, 3) + " along the track",
             "They are " + length_text(high, 3) + " above the floor line, the radius there is " +
                 length_text(1.0 / arc.curvature, 3) + ".",
             "wall_height: " + length_text(0.95 / arc.curvature, 2) + ", or no cover");
    }
  }
  return left;
}

/// What a rim has of a unit.
Span rim_room(const Job& job, const Span& unit) {
  const Span room = between_frames(job, unit);
  return job.options.cover ? under_cover(job, room) : room;
}

/// A plate or bar between two heights that follows the track, flat across: its pattern is a rectangle.
/// @param shifts  of the pieces' left edges to the right [m]
std::optional<ShopPart> along_track(const Job& job, const Span& span, const Span& heights, double width,
                                    const std::vector<double>& shifts) {
  const auto outline = band(job.track, span, heights.from, heights.to);
  const auto middle = offset_line(job.track, span, 0.5 * (heights.from + heights.to));
  if (!outline || !middle) return std::nullopt;
  ShopPart part = upright_plate(job, {*outline, {}, {}}, width, shifts);
  part.thickness = heights.to - heights.from;
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {length(*middle), width});
  set_number_place(pattern, bounds(pattern.region.outline));
  part.pattern = std::move(pattern);
  return part;
}

/// Places along a unit at which covers are bolted to rims, on one arc each: the same for both.
std::vector<double> cover_bolts(const Job& job, const Span& span) {
  const CoverOptions& cover = *job.options.cover;
  constexpr double kFromEnds = 40e-3;
  const double top = job.channel.wall_height;
  const OnOneArc arcs(job.track, 0.5 * clearance_hole(cover.bolt, HoleFit::coarse),
                      {top - job.options.rim->thickness, top + cover.thickness});
  const Span within{span.from + 0.5 * kFromEnds, span.to - 0.5 * kFromEnds};
  std::vector<double> places;
  for (const Vec2 at : evenly({span.from + kFromEnds, 0.0}, {span.to - kFromEnds, 0.0}, cover.pitch)) {
    const auto place = arcs.nearest(at.x, within);
    if (place && (places.empty() || *place - places.back() > kFromEnds)) places.push_back(*place);
  }
  return places;
}

}  // namespace

std::optional<double> TakenUp::free_place(double about, double half, const Span& within) const {
  const auto is_free = [&](double s) {
    if (s - half < within.from || s + half > within.to) return false;
    return std::all_of(spans_.begin(), spans_.end(),
                       [&](const Span& span) { return s + half < span.from || s - half > span.to; });
  };
  constexpr int kPlaces = 400;
  const double step = (within.to - within.from) / kPlaces;
  for (int k = 0; k <= kPlaces; ++k) {
    for (const double side : {-1.0, 1.0}) {
      if (is_free(about + side * step * k)) return about + side * step * k;
    }
  }
  return std::nullopt;
}

double beyond_frame(const ArcSpline& track, double taken, double end, double sense, double high) {
  const TrackFrame frame = frame_at(track, end);
  constexpr double kStep = 0.5e-3;
  double s = end + sense * taken;
  for (int k = 0; k < 400; ++k, s += sense * kStep) {
    const TrackFrame here = frame_at(track, s);
    const double floor = sense * dot(here.at - frame.at, frame.along);
    const double top = sense * dot(here.at + high * here.up - frame.at, frame.along);
    // Where the wall folds its top is cut off at the frame's plane, whatever s is.
    if (std::min(floor, top) >= taken - 1e-9) break;
  }
  return s;
}

void drill_plate(const Job& job, const Span& span, double upper, double width,
                 const std::vector<Circle>& holes, ShopPart& part) {
  const OwnPlane plane = own_plane(*band(job.track, span, upper - part.thickness, upper));
  RolledSheet sheet;
  sheet.path = moved(*offset_line(job.track, span, 0.0), into(plane));
  sheet.thickness = part.thickness;
  sheet.region.outline = rectangle({}, {span.to - span.from, width});
  for (const Circle& hole : holes)
    sheet.region.holes.push_back({hole.centre - Vec2{span.from, 0.0}, hole.radius});
  sheet.foot = {upper, 0.0};
  part.body = std::move(sheet);
  weigh(part);
}

double flat_from_end(const ArcSpline& track, const Span& span, double height, double s) {
  double sum = 0.0;
  for (const TrackArc& arc : track.arcs()) {
    const double from = std::max(s, arc.start);
    const double to = std::min(span.to, arc.start + arc.length);
    if (to > from) sum += (to - from) * (1.0 - arc.curvature * height);
  }
  return sum;
}

Span lid_heights(const Job& job, const InspectionOptions& opening) {
  const double rim = job.options.rim ? job.options.rim->thickness + 2e-3 : 0.0;
  const double middle = 0.5 * (job.channel.wall_height - rim);
  const double half = 0.5 * opening.height + kLap;
  return {middle - half, middle + half};
}

void add_rims(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.rim) return;
  const RimOptions& rim = *job.options.rim;
  const double top = job.channel.wall_height;
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const Span span = rim_room(job, fitting.units[i].span);
    auto part = along_track(job, span, {top - rim.thickness, top}, rim.width,
                            {-outside(job) - rim.width, outside(job)});
    if (!part) continue;
    part->name = "rim" + suffix(fitting, i);
    if (job.options.cover) {
      const double whole = bounds(part->pattern->region.outline).width();
      const double radius = 0.5 * clearance_hole(job.options.cover->bolt, HoleFit::medium);
      std::vector<Circle> holes;
      for (const double s : cover_bolts(job, span)) {
        holes.push_back({{s, 0.5 * rim.width}, radius});
        const double at = whole - flat_from_end(job.track, span, top - 0.5 * rim.thickness, s);
        part->pattern->region.holes.push_back({{at, 0.5 * rim.width}, radius});
      }
      drill_plate(job, span, top, rim.width, holes, *part);
    }
    add_part(fitting.workshop, *part, kFittingColour);
  }
}

namespace {

/// The free place nearest to `about`; below a bent floor one where a flat touches the track, since elsewhere it lies off it.
std::optional<double> stiffener_place(const Fitting& fitting, const Unit& unit, double about, double half) {
  const Span room = between_frames(fitting.job, unit.span);
  if (!unit.face.facets) return fitting.below.free_place(about, half, room);
  std::vector<double> touches = unit.face.facets->touches;
  std::sort(touches.begin(), touches.end(), [&](double a, double b) {
    return std::pair(std::fabs(a - about), a) < std::pair(std::fabs(b - about), b);
  });
  for (const double touch : touches) {
    const auto place = fitting.below.free_place(touch, half, room);
    if (place && *place == touch) return place;
  }
  return std::nullopt;
}

}  // namespace

void add_stiffeners(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.stiffeners) return;
  const StiffenerOptions& stiffener = *job.options.stiffeners;
  const bool rim = job.options.rim.has_value();
  const double gap = job.options.flanges.gap;
  const double top = job.channel.wall_height - (rim ? job.options.rim->thickness + gap : 0.0);
  ShopPart part = in_material(job, "stiffener", stiffener.thickness);
  FlatPattern pattern;
  pattern.region = frame_region(job, stiffener.width, top, true);
  part.body = Prism{pattern.region, stiffener.thickness};
  part.pattern = std::move(pattern);
  for (const Unit& unit : fitting.units) {
    const double room = unit.span.to - unit.span.from;
    const double count = std::ceil(room / stiffener.spacing - 1e-9);
    for (double k = 1.0; k < count; k += 1.0) {
      const double about = unit.span.from + room * k / count;
      const double half = 0.5 * stiffener.thickness + 15e-3;
      const auto at = stiffener_place(fitting, unit, about, half);
      // Where the floor bends within the plate's thickness, the gap would close.
      if (!at || std::fabs(job.track.at(*at).curvature) * stiffener.thickness * stiffener.thickness > gap)
        continue;
      Frame place = frame_place(job, *at, true);
      place.origin = place.origin - 0.5 * stiffener.thickness * place.z;
      part.places.push_back(place);
      fitting.below.add(*at - 0.5 * stiffener.thickness, *at + 0.5 * stiffener.thickness);
    }
  }
  if (part.places.empty()) return;
  weigh(part);
  for (ShopPart& piece : pieces_across(part, false, job.options.split))
    add_part(fitting.workshop, std::move(piece), kFittingColour);
}

void add_covers(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.cover) return;
  const CoverOptions& cover = *job.options.cover;
  const RimOptions& rim = *job.options.rim;
  const double top = job.channel.wall_height;
  const double half = outside(job) + rim.width;
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const Span span = rim_room(job, fitting.units[i].span);
    auto part = along_track(job, span, {top, top + cover.thickness}, 2.0 * half, {-half});
    if (!part) continue;
    part->name = "cover" + suffix(fitting, i);
    const double whole = bounds(part->pattern->region.outline).width();
    const double radius = 0.5 * clearance_hole(cover.bolt, HoleFit::coarse);
    std::vector<Circle> holes;
    for (const double s : cover_bolts(job, span)) {
      const double at = whole - flat_from_end(job.track, span, top + 0.5 * cover.thickness, s);
      for (const double y : {0.5 * rim.width, 2.0 * half - 0.5 * rim.width}) {
        holes.push_back({{s, y}, radius});
        part->pattern->region.holes.push_back({{at, y}, radius});
      }
    }
    const std::size_t bolts = holes.size();
    drill_plate(job, span, top + cover.thickness, 2.0 * half, holes, *part);
    add_part(fitting.workshop, *part, kFittingColour);
    add_bolts(fitting.workshop, cover.bolt, rim.thickness + cover.thickness, bolts, "covers to rims");
  }
}

namespace {

/// A rectangle square to the track round a place, in the plane (x, height).
ArcPath window(const ArcSpline& track, double at, double half_length, const Span& heights) {
  const TrackFrame frame = frame_at(track, at);
  ArcPath path{{}, true};
  for (const Vec2 corner : {Vec2{-half_length, heights.from}, Vec2{half_length, heights.from},
                            Vec2{half_length, heights.to}, Vec2{-half_length, heights.to}}) {
    path.vertices.push_back({frame.at + corner.x * frame.along + corner.y * frame.up, 0.0});
  }
  return path;
}

/// Bolts round an opening, in the middle of the lid's lap.
std::vector<Vec2> lid_bolts(const ArcSpline& track, const InspectionOptions& opening, const Span& heights) {
  const TrackFrame frame = frame_at(track, opening.at);
  const double along = 0.5 * opening.length + 0.5 * kLap;
  const double low = heights.from - 0.5 * kLap;
  const double high = heights.to + 0.5 * kLap;
  std::vector<Vec2> places;
  for (const double level : {low, high}) {
    for (const Vec2 at : evenly({-along, level}, {along, level}, 150e-3))
      places.push_back(frame.at + at.x * frame.along + at.y * frame.up);
  }
  return places;
}

/// An opening in a wall with the holes of its lid's bolts, in the plane (x, height).
struct Opening {
  Span heights;  ///< of its lid
  ArcPath outline;
  std::vector<Circle> holes;
};

/// Cuts openings out of the left wall of a unit, whose strips with openings become parts of their own.
void cut_wall(const Fitting& fitting, const Unit& unit, const std::vector<Opening>& openings) {
  const Job& job = fitting.job;
  for (const WallStrip& strip : wall_strips(job, unit)) {
    PlaneRegion region = strip.region;
    for (const Opening& opening : openings) {
      const double middle = 0.5 * (opening.heights.from + opening.heights.to);
      if (!(middle > strip.heights.from && middle < strip.heights.to)) continue;
      region.cutouts.push_back(opening.outline);
      region.holes.insert(region.holes.end(), opening.holes.begin(), opening.holes.end());
    }
    if (region.holes.empty()) continue;
    ShopPart part = wall_of(job, region);
    part.places.resize(1);
    weigh(part);
    part.name = "left_" + strip.part.name;
    // Of the plain wall the right one is left.
    take_back(fitting.workshop, strip.part, strip.part.places.front());
    add_part(fitting.workshop, std::move(part), kWallColour);
  }
}

void add_lid(const Fitting& fitting, const InspectionOptions& opening, const Span& heights,
             const std::vector<Vec2>& bolts) {
  const Job& job = fitting.job;
  PlaneRegion region{
      window(job.track, opening.at, 0.5 * opening.length + kLap, {heights.from - kLap, heights.to + kLap}),
      {},
      {}};
  for (const Vec2 bolt : bolts)
    region.holes.push_back({bolt, 0.5 * clearance_hole(opening.bolt, HoleFit::coarse)});
  const double thickness = job.channel.wall();
  ShopPart part = upright_plate(job, region, thickness, {-outside(job) - thickness});
  part.name = "lid";
  FlatPattern pattern;
  pattern.region = std::get<Prism>(part.body).region;
  part.pattern = std::move(pattern);
  add_part(fitting.workshop, part, kFittingColour);
  add_bolts(fitting.workshop, opening.bolt, 2.0 * thickness, bolts.size(), "lids");
}

}  // namespace

void add_openings(const Fitting& fitting) {
  const Job& job = fitting.job;
  for (const InspectionOptions& opening : job.options.inspection) {
    if (opening.at > 0.0 && opening.at < job.track.length()) continue;
    refuse("inspection", "at: an opening at " + length_text(opening.at, 4) + " is not on the track",
           "It is " + length_text(job.track.length(), 4) + " long.",
           "at: " + length_text(0.5 * job.track.length(), 2));
  }
  for (const Unit& unit : fitting.units) {
    std::vector<Opening> openings;
    for (const InspectionOptions& opening : job.options.inspection) {
      const double reach = 0.5 * opening.length + kLap;
      if (opening.at + reach <= unit.span.from || opening.at - reach >= unit.span.to) continue;
      const Span room = between_frames(job, unit.span);
      if (opening.at - reach < room.from || opening.at + reach > room.to) {
        refuse("inspection",
               "at: an opening at " + length_text(opening.at, 4) + " reaches over the end of a unit",
               "Units end at " + length_text(unit.span.from, 4) + " and " + length_text(unit.span.to, 4) +
                   "; with its lid it is " + length_text(2.0 * reach) + " long.",
               "at: " + length_text(std::clamp(opening.at, room.from + reach, room.to - reach), 4));
      }
      const Span lid = lid_heights(job, opening);
      const Span heights{lid.from + kLap, lid.to - kLap};
      if (job.track.at(opening.at).curvature * (heights.to + kLap) > 0.9) {
        refuse("inspection", "at: the track bends too tightly at " + length_text(opening.at, 4), "",
               "another at");
      }
      openings.push_back({lid, window(job.track, opening.at, 0.5 * opening.length, heights), {}});
      const std::vector<Vec2> bolts = lid_bolts(job.track, opening, heights);
      for (const Vec2 bolt : bolts)
        openings.back().holes.push_back({bolt, 0.5 * clearance_hole(opening.bolt, HoleFit::medium)});
      add_lid(fitting, opening, heights, bolts);
      fitting.below.add(opening.at - reach, opening.at + reach);
    }
    if (!openings.empty()) cut_wall(fitting, unit, openings);
  }
}

namespace {

/// Mass and first moment of what belongs to a unit.
struct UnitMass {
  double mass = 0.0;
  Vec3 moment;
};

std::vector<UnitMass> masses_of(const Fitting& fitting) {
  const Job& job = fitting.job;
  std::vector<UnitMass> masses(fitting.units.size());
  const Span whole{0.0, job.track.length()};
  const Vec3 start = in_space(job.placement, {});
  for (const ShopPart& part : fitting.workshop.parts) {
    const BodyMoments body = moments(part.body);
    for (const Frame& place : part.places) {
      const Vec3 centre = place.to_space(body.centroid);
      const Vec3 away = centre - start;
      const double s = nearest_place(job.track, whole, {dot(away, along(job.placement)), away.z}).s;
      std::size_t unit = 0;
      while (unit + 1 < fitting.units.size() && s >= fitting.units[unit].span.to) ++unit;
      masses[unit].mass += part.mass;
      masses[unit].moment = masses[unit].moment + part.mass * centre;
    }
  }
  return masses;
}

/// Where the wall's top stands plumb above a place, within a span; its nearer end where it does so nowhere.
double above(const Job& job, Vec3 centre, const Span& within) {
  const Vec3 run = along(job.placement);
  const Vec3 start = in_space(job.placement, {});
  const double x = dot(centre - start, run);
  double best = within.from;
  double least = std::numeric_limits<double>::infinity();
  constexpr int kPlaces = 400;
  for (int k = 0; k <= kPlaces; ++k) {
    const double s = within.from + (within.to - within.from) * k / kPlaces;
    const TrackFrame frame = frame_at(job.track, s);
    const double miss = std::fabs(frame.at.x + job.channel.wall_height * frame.up.x - x);
    if (miss < least) {
      least = miss;
      best = s;
    }
  }
  return best;
}

}  // namespace

void add_lugs(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.lifting) return;
  const LiftingOptions& lifting = *job.options.lifting;
  const double top = job.channel.wall_height;
  const double low = top - (job.options.rim ? job.options.rim->thickness : std::min(kLugLow, 0.5 * top));
  const double side = outside(job) + (job.options.rim ? job.options.rim->width : 0.0);
  const std::vector<UnitMass> masses = masses_of(fitting);
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const Span room = between_frames(job, fitting.units[i].span);
    const Vec3 centre = (1.0 / masses[i].mass) * masses[i].moment;
    const double at = above(job, centre, {room.from + 3.0 * kLugHalf, room.to - 3.0 * kLugHalf});
    // Where the top folds, no lug follows it.
    const auto outline = band(job.track, {at - kLugHalf, at + kLugHalf}, low, top + kLugHigh);
    if (!outline) continue;
    const TrackFrame frame = frame_at(job.track, at);
    PlaneRegion region{*outline, {}, {{frame.at + (top + 0.55 * kLugHigh) * frame.up, 0.5 * lifting.hole}}};
    ShopPart part = upright_plate(job, region, lifting.thickness, {-side - lifting.thickness, side});
    part.name = "lug" + suffix(fitting, i);
    FlatPattern pattern;
    pattern.region = std::get<Prism>(part.body).region;
    part.pattern = std::move(pattern);
    add_part(fitting.workshop, part, kFittingColour);
    fitting.workshop.notes.push_back("Unit " + std::to_string(i + 1) + ": " +
                                     rounded_text(masses[i].mass, 4) + " kg, lugs at " + length_text(at, 4) +
                                     " along the track, beside its centre of gravity.");
  }
}

namespace {

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
    if (std::find(bolt_sizes().begin(), bolt_sizes().end(), size) != bolt_sizes().end()) return;
    add(where, std::string(key) + ": M" + std::to_string(size) + " is no size whose holes are known", "",
        "M5, M6, M8, M10, M12, M16, M20 or M24");
  }
  [[nodiscard]] std::vector<Issue> all() && { return std::move(issues_); }

 private:
  std::vector<Issue> issues_;
};

/// Tiles hold their bolts: half ones 1.2 hole diameters from both edges.
void object_to_tiles(const ChannelMeasures& channel, const LinerOptions& liner, Refusals& refusals) {
  const bool known = std::find(bolt_sizes().begin(), bolt_sizes().end(), liner.bolt) != bolt_sizes().end();
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

void object_to_liner(const ChannelMeasures& channel, const PlateOptions& options, Refusals& refusals) {
  const LinerOptions& liner = *options.liner;
  refusals.positive(liner.thickness, "liner.thickness", "thickness");
  refusals.positive(liner.tile_length, "liner.tile_length", "tile_length");
  refusals.positive(liner.tile_width, "liner.tile_width", "tile_width");
  refusals.bolt(liner.bolt, "liner.bolt", "bolt");
  if (!(liner.heaviest > 0.0)) {
    refusals.add("liner.heaviest", "heaviest: " + rounded_text(liner.heaviest, 4) + " kg is not positive", "",
                 "25 kg");
  }
  if (!(liner.worn_from > 0.0 && liner.worn_from <= 1.0)) {
    refusals.add("liner.worn_from",
                 "worn_from: " + rounded_text(100.0 * liner.worn_from, 6) + " % is out of range",
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
        "liner.gap", "gap: " + length_text(liner.gap) + " is out of range",
        "Gaps between tiles are 0 to a tenth of the floor's width, " + length_text(0.1 * channel.width) + ".",
        "gap: 2 mm");
  }
  object_to_tiles(channel, liner, refusals);
  if (options.floor == FloorMake::bent) {
    refusals.add("liner", "liner: tiles would lie on the bends of a bent floor",
                 "They are rolled as the floor is.", "floor: rolled");
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
                 "The rim would stand out farther than the channel is deep.", "a smaller width");
  }
}

void object_to_cover(const PlateOptions& options, Refusals& refusals) {
  refusals.positive(options.cover->thickness, "cover.thickness", "thickness");
  if (!(options.cover->pitch >= 40e-3)) {
    refusals.add("cover.pitch", "pitch: " + length_text(options.cover->pitch) + " is too close",
                 "Bolts of covers are at least 40 mm apart.", "pitch: 300 mm");
  }
  refusals.bolt(options.cover->bolt, "cover.bolt", "bolt");
  if (!options.rim)
    refusals.add("cover", "cover: it is bolted to a rim, and there is none", "", "rim: {width: 40 mm}");
}

void object_to_openings(const ChannelMeasures& channel, const PlateOptions& options, Refusals& refusals) {
  const double rim = options.rim ? options.rim->thickness + 2e-3 : 0.0;
  for (const InspectionOptions& opening : options.inspection) {
    refusals.positive(opening.length, "inspection", "length");
    refusals.positive(opening.height, "inspection", "height");
    refusals.bolt(opening.bolt, "inspection", "bolt");
    const double most = channel.wall_height - rim - 2.0 * std::max(kLap, kLeastWeb);
    if (opening.height <= most) continue;
    refusals.add("inspection",
                 "height: " + length_text(opening.height) + " leaves too little of the wall, " +
                     length_text(channel.wall_height),
                 "Its lid laps over by " + length_text(kLap) + " all round.",
                 most > 0.0 ? "height: " + length_text(most, 3)
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
  if (options.lifting && need_walls(true, "lifting")) {
    refusals.positive(options.lifting->thickness, "lifting.thickness", "thickness");
    if (!(options.lifting->hole > 0.0) || options.lifting->hole > 40e-3) {
      refusals.add("lifting.hole", "hole: " + length_text(options.lifting->hole) + " does not go into a lug",
                   "Lugs are 80 mm wide and reach 60 mm above the walls.", "hole: 22 mm");
    }
  }
  if (options.stiffeners) {
    if (!(options.stiffeners->spacing >= 10.0 * options.stiffeners->thickness)) {
      refusals.add("stiffeners.spacing",
                   "spacing: " + length_text(options.stiffeners->spacing) + " leaves no room to weld them",
                   "They are at least ten thicknesses apart, " +
                       length_text(10.0 * options.stiffeners->thickness) + ".",
                   "spacing: 800 mm");
    }
    refusals.positive(options.stiffeners->width, "stiffeners.width", "width");
    const double lap = options.corners.kind != CornerJoint::butt && walls ? options.corners.overlap : 0.0;
    if (lap > 0.0 && options.stiffeners->width < lap + kLeastRound) {
      refusals.add("stiffeners.width",
                   "width: " + length_text(options.stiffeners->width) +
                       " leaves nothing round corners that lap by " + length_text(lap),
                   "At least " + length_text(kLeastRound) + " of it go round them.",
                   "width: " + length_text(lap + 0.04));
    }
    refusals.positive(options.stiffeners->thickness, "stiffeners.thickness", "thickness");
  }
  if (options.liner) object_to_liner(channel, options, refusals);
  if (options.supports) object_to_supports(options, refusals);
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
