#include "parts/plates/fittings.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "core/millimetres.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/plates/channel_strips.hpp"
#include "parts/plates/corners.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/seams.hpp"
#include "parts/plates/shell.hpp"
#include "parts/plates/shortfalls.hpp"
#include "parts/plates/stiffener_row.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kLugHalf = 40e-3;            // of a lug, along the track [m]
constexpr double kLugHigh = 60e-3;            // above the wall's top [m]
constexpr double kLugLow = 60e-3;             // below it, on a wall without a rim [m]
constexpr double kEyeHigh = 0.55 * kLugHigh;  // of the middle of its eye above the wall's top [m]

std::vector<Span> spans_of(const std::vector<Unit>& units) {
  std::vector<Span> spans;
  for (const Unit& unit : units) spans.push_back(unit.span);
  return spans;
}

/// Half the width of the channel outside.
double outside(const Job& job) {
  return 0.5 * job.channel.width + job.channel.wall();
}

/// What frames leave of a unit.
Span between_frames(const Job& job, const Span& unit) {
  if (!job.options.flanges.wanted) return unit;
  const double high = job.channel.wall_height + (job.options.cover ? job.options.cover->thickness : 0.0);
  const double taken = job.options.flanges.along() + kAsideOfFrame;
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
  part.pattern = std::move(pattern);
  return part;
}

}  // namespace

CoverEnds cover_ends(const PlateOptions& options, double stretch) {
  CoverEnds ends;
  const double edge =
      hole_edge_diameters(options.shop) * clearance_hole(options.cover->bolt, HoleFit::coarse);
  // Pieces of a cover are a gap shorter than their stretch of the unit.
  ends.least = std::max(ends.least, (edge + kLidGap) / stretch);
  ends.usual = std::max(ends.usual, ends.least);
  return ends;
}

namespace {

/// Places along a unit at which covers are bolted to rims, on one arc each: the same for both.
std::vector<double> cover_bolts(const Job& job, const Span& span) {
  const CoverOptions& cover = *job.options.cover;
  const double top = job.channel.wall_height;
  const OnOneArc arcs(job.track, 0.5 * clearance_hole(cover.bolt, HoleFit::coarse),
                      {top - job.options.rim->thickness, top + cover.thickness});
  const CoverEnds ends = cover_ends(
      job.options,
      std::min(least_stretch(job.track, {span.from, span.from + kEndOfCover}, top + cover.thickness),
               least_stretch(job.track, {span.to - kEndOfCover, span.to}, top + cover.thickness)));
  const Span within{span.from + ends.least, span.to - ends.least};
  std::vector<double> places;
  for (const Vec2 at : evenly({span.from + ends.usual, 0.0}, {span.to - ends.usual, 0.0}, cover.pitch)) {
    const auto place = arcs.nearest(at.x, within);
    if (place && (places.empty() || *place - places.back() > ends.usual)) places.push_back(*place);
  }
  return places;
}

/// The pieces of a unit's cover: as the sheet and the heaviest part ask.
std::vector<Span> cover_pieces(const Job& job, const Span& span) {
  const Span heights{job.channel.wall_height, job.channel.wall_height + job.options.cover->thickness};
  const double width = 2.0 * (outside(job) + job.options.rim->width);
  const auto made = [&](const Span& piece) {
    auto part = along_track(job, piece, heights, width, {-0.5 * width});
    if (part) weigh(*part);
    return part;
  };
  std::vector<Span> pieces{span};
  if (job.options.split.allowed) {
    pieces = pieces_that_fit(span, {job.track, 0.5 * kLidGap, heights}, [&](const Span& piece) {
      const auto part = made(piece);
      return !part || !excess(job.options.split, *part);
    });
  }
  for (const Span& piece : pieces) {
    if (const auto part = made(piece)) require_cover_fits(*part, job.options);
  }
  return pieces;
}

/// Places along a unit at which the pieces of its cover are bolted to rims.
std::vector<double> rim_bolts(const Job& job, const Span& span) {
  std::vector<double> places;
  for (const Span& piece : cover_pieces(job, span)) {
    const std::vector<double> own = cover_bolts(job, piece);
    places.insert(places.end(), own.begin(), own.end());
  }
  return places;
}

}  // namespace

std::vector<Span> pieces_that_fit(const Span& span, const OnOneArc& seams,
                                  const std::function<bool(const Span&)>& fits) {
  constexpr int kMostPieces = 20;
  for (int count = 1; count <= kMostPieces; ++count) {
    std::vector<Span> pieces;
    double from = span.from;
    for (int k = 1; k < count; ++k) {
      const auto seam = seams.nearest(span.from + (span.to - span.from) * k / count, span);
      if (!seam || !(*seam - kLidGap > from)) break;
      pieces.push_back({from, *seam - 0.5 * kLidGap});
      from = *seam + 0.5 * kLidGap;
    }
    pieces.push_back({from, span.to});
    if (static_cast<int>(pieces.size()) == count && std::all_of(pieces.begin(), pieces.end(), fits))
      return pieces;
  }
  return {span};
}

void require_cover_fits(const ShopPart& piece, const PlateOptions& options) {
  const auto found = excess(options.split, piece);
  if (!found) return;
  throw InputError({"cover", "cover: a piece " + found->what,
                    (options.split.allowed ? "No shorter piece does, and " : "One piece is asked for, and ") +
                        found->bound + ".",
                    found->way_out + ", a narrower cross_section or rim, or no cover"});
}

bool TakenUp::is_free(double s, double half, const Span& within) const {
  if (s - half < within.from || s + half > within.to) return false;
  return std::all_of(spans_.begin(), spans_.end(),
                     [&](const Span& span) { return s + half < span.from || s - half > span.to; });
}

std::optional<double> TakenUp::free_place(double about, double half, const Span& within) const {
  constexpr int kPlaces = 400;
  const double step = (within.to - within.from) / kPlaces;
  for (int k = 0; k <= kPlaces; ++k) {
    for (const double side : {-1.0, 1.0}) {
      const double s = about + side * step * k;
      if (is_free(s, half, within)) return s;
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

double lid_lap(const InspectionOptions& opening, const ShopLeast& shop) {
  constexpr double kUsual = 30e-3;
  if (!is_bolt_size(opening.bolt)) return kUsual;
  const double edges = 2.0 * hole_edge_diameters(shop) * clearance_hole(opening.bolt, HoleFit::coarse);
  return std::max(kUsual, std::ceil(core::kMillimetres * edges - 1e-6) / core::kMillimetres);
}

double least_stretch(const ArcSpline& track, const Span& span, double height) {
  constexpr double kLeast = 0.1;
  double least = 1.0;
  for (const TrackArc& arc : track.arcs()) {
    if (arc.start < span.to && arc.start + arc.length > span.from)
      least = std::min(least, 1.0 - arc.curvature * height);
  }
  return std::max(least, kLeast);
}

Span lid_heights(const Job& job, const InspectionOptions& opening) {
  const double rim = job.options.rim ? job.options.rim->thickness + 2e-3 : 0.0;
  const double middle = 0.5 * (job.channel.wall_height - rim);
  const double half = 0.5 * opening.height + lid_lap(opening, job.options.shop);
  return {middle - half, middle + half};
}

void add_rims(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.rim) return;
  const RimOptions& rim = *job.options.rim;
  const double top = job.channel.wall_height;
  std::vector<std::string> bare;
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const Span span = rim_room(job, fitting.units[i].span);
    auto part = along_track(job, span, {top - rim.thickness, top}, rim.width,
                            {-outside(job) - rim.width, outside(job)});
    if (!part) {
      bare.push_back(std::to_string(i + 1));
      continue;
    }
    part->thickness = rim.thickness;
    part->name = "rim" + suffix(fitting, i);
    if (job.options.cover) {
      const double whole = bounds(part->pattern->region.outline).width();
      const double radius = 0.5 * clearance_hole(job.options.cover->bolt, HoleFit::medium);
      std::vector<Circle> holes;
      for (const double s : rim_bolts(job, span)) {
        holes.push_back({{s, 0.5 * rim.width}, radius});
        const double at = whole - flat_from_end(job.track, span, top - 0.5 * rim.thickness, s);
        part->pattern->region.holes.push_back({{at, 0.5 * rim.width}, radius});
      }
      drill_plate(job, span, top, rim.width, holes, *part);
    }
    add_part(fitting.workshop, *part, kFittingColour);
  }
  if (bare.empty()) return;
  add_shortfall({"rim", "rim: none on unit" + std::string(bare.size() > 1 ? "s " : " ") + listed(bare),
                 "The tops of its walls, " + length_text(top, 3) +
                     " high, fold over where the track bends with a smaller radius.",
                 "lower walls, a larger radius there, or no rim"},
                fitting.workshop);
}

namespace {

constexpr double kOffStiffener = 15e-3;  // of stiffeners from what else stands there, for welding [m]

/// The ends of a unit's lids, seen from the side: flat, they keep their length up the wall, where a hollow leaves what is square to it
/// less room.
std::vector<StandingPlate> ends_of_lids(const Job& job, const Span& unit) {
  std::vector<StandingPlate> ends;
  for (const InspectionOptions& opening : job.options.inspection) {
    const double reach = 0.5 * opening.length + lid_lap(opening, job.options.shop);
    if (opening.at + reach <= unit.from || opening.at - reach >= unit.to) continue;
    for (const double sense : {-1.0, 1.0}) {
      TrackFrame end = frame_at(job.track, opening.at);
      end.at = end.at + sense * reach * end.along;
      ends.push_back({end, kOffStiffener, lid_heights(job, opening)});
    }
  }
  return ends;
}

/// Places below a unit where stiffeners may stand; below a bent floor those where a flat touches the track, since elsewhere it lies
/// off it.
StiffenerSeats seats_below(const Fitting& fitting, const Unit& unit) {
  const Job& job = fitting.job;
  const double thickness = job.options.stiffeners->thickness;
  const Span room = between_frames(job, unit.span);
  StiffenerSeats seats;
  if (unit.face.facets) {
    seats.places = unit.face.facets->touches;
    seats.anywhere = false;
  } else {
    for (int k = 0; k <= kSeats; ++k) seats.places.push_back(seat_place(room, k));
  }
  // Where the floor bends within the plate's thickness, the gap would close.
  seats.is_free = [&fitting, room, thickness, lids = ends_of_lids(job, unit.span)](double s) {
    const Job& of = fitting.job;
    const double out = of.options.flanges.gap + of.options.stiffeners->width;
    const Span heights{-floor_depth(of) - of.channel.thickness - out, of.channel.wall_height};
    return fitting.below.is_free(s, 0.5 * thickness + kOffStiffener, room) &&
           all_apart({frame_at(of.track, s), 0.5 * thickness, heights}, lids) &&
           std::fabs(of.track.at(s).curvature) * thickness * thickness <= of.options.flanges.gap;
  };
  const double apart = least_apart(*job.options.stiffeners);
  seats.beside = [apart](double a, double b) { return b - a >= apart; };
  return seats;
}

}  // namespace

void add_channel_stiffeners(const Fitting& fitting) {
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
  WideGaps gaps;
  for (const Unit& unit : fitting.units) {
    const std::vector<double> row = stiffener_row(unit.span, stiffener.spacing, seats_below(fitting, unit));
    gaps.add(unit.span, row, stiffener.spacing);
    for (const double at : row) {
      Frame place = frame_place(job, at, true);
      place.origin = place.origin - 0.5 * stiffener.thickness * place.z;
      part.places.push_back(place);
      fitting.below.add(at - 0.5 * stiffener.thickness, at + 0.5 * stiffener.thickness);
    }
  }
  gaps.tell(job.options, fitting.workshop);
  if (part.places.empty()) return;
  weigh(part);
  add_in_pieces(part, frame_line(job, stiffener.width, top), false, job.options, kFittingColour,
                fitting.workshop);
}

namespace {

/// One piece of a unit's cover, bolted to the rims.
void add_cover(const Fitting& fitting, const Span& span, const std::string& name) {
  const Job& job = fitting.job;
  const CoverOptions& cover = *job.options.cover;
  const RimOptions& rim = *job.options.rim;
  const double top = job.channel.wall_height;
  const double half = outside(job) + rim.width;
  auto part = along_track(job, span, {top, top + cover.thickness}, 2.0 * half, {-half});
  if (!part) return;
  part->thickness = cover.thickness;
  part->name = name;
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

}  // namespace

void add_covers(const Fitting& fitting) {
  if (!fitting.job.options.cover) return;
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const std::vector<Span> pieces = cover_pieces(fitting.job, rim_room(fitting.job, fitting.units[i].span));
    for (std::size_t k = 0; k < pieces.size(); ++k)
      add_cover(fitting, pieces[k], "cover" + suffix(fitting, i) + strip_letter(k, pieces.size()));
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
std::vector<Vec2> lid_bolts(const ArcSpline& track, const InspectionOptions& opening, const Span& heights,
                            double lap) {
  const TrackFrame frame = frame_at(track, opening.at);
  const double along = 0.5 * opening.length + 0.5 * lap;
  const double low = heights.from - 0.5 * lap;
  const double high = heights.to + 0.5 * lap;
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
void cut_wall(const Fitting& fitting, std::size_t unit, const std::vector<Opening>& openings) {
  const Job& job = fitting.job;
  for (const WallStrip& strip : wall_strips(job, fitting.units[unit], unit)) {
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
  const double lap = lid_lap(opening, job.options.shop);
  PlaneRegion region{
      window(job.track, opening.at, 0.5 * opening.length + lap, {heights.from - lap, heights.to + lap}),
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

namespace {

/// Whether a lid, which is straight, keeps off the frames at both ends of its unit.
bool lid_keeps_off(const Job& job, const Span& unit, double at, double reach, const Span& heights) {
  const double taken = (job.options.flanges.wanted ? job.options.flanges.along() : 0.0) + kAsideOfFrame;
  for (const PathVertex& corner : window(job.track, at, reach, heights).vertices) {
    for (const double sense : {1.0, -1.0}) {
      const TrackFrame end = frame_at(job.track, sense > 0.0 ? unit.from : unit.to);
      if (sense * dot(corner.at - end.at, end.along) < taken) return false;
    }
  }
  return true;
}

/// The place nearest to one that is asked for at which a lid does so; none if there is none.
std::optional<double> place_of_lid(const Job& job, const Span& unit, double about, double reach,
                                   const Span& heights) {
  std::optional<double> best;
  constexpr int kPlaces = 200;
  for (int k = 0; k <= kPlaces; ++k) {
    const double at = unit.from + (unit.to - unit.from) * k / kPlaces;
    if (best && std::fabs(at - about) >= std::fabs(*best - about)) continue;
    if (lid_keeps_off(job, unit, at, reach, heights)) best = at;
  }
  return best;
}

Issue misplaced(std::string what, std::string why, std::string hint) {
  return {"inspection", "at: " + std::move(what), std::move(why), std::move(hint)};
}

bool is_on_track(const Job& job, const InspectionOptions& opening) {
  return opening.at > 0.0 && opening.at < job.track.length();
}

/// What is wrong with two openings whose lids do not lie beside each other.
std::optional<Issue> too_close(const Job& job, const InspectionOptions& opening, double reach,
                               const Span& lid) {
  constexpr double kBeside = 5e-3;    // [m]
  constexpr double kRounding = 1e-6;  // of a place that is told [m]
  for (const InspectionOptions& other : job.options.inspection) {
    if (&other == &opening) break;
    if (!is_on_track(job, other)) continue;
    const double other_reach = 0.5 * other.length + lid_lap(other, job.options.shop);
    const double curvature = std::max(job.track.at(opening.at).curvature, job.track.at(other.at).curvature);
    // In a valley lids come together above the floor.
    const double shrunk = std::max(0.1, 1.0 - std::max(0.0, curvature) * lid.to);
    const double least = (reach + other_reach + kBeside) / shrunk;
    if (std::fabs(other.at - opening.at) >= least - kRounding) continue;
    const double at = opening.at < other.at ? 1e-3 * std::floor(1e3 * (other.at - least) + 1e-6)
                                            : 1e-3 * std::ceil(1e3 * (other.at + least) - 1e-6);
    return misplaced(
        "openings at " + length_text(other.at, 4) + " and " + length_text(opening.at, 4) + " are too close",
        "With their lids they take " + length_text(least, 3) + " from one's middle to the other's.",
        (at > reach && at < job.track.length() - reach ? "at: " + length_text(at, 4) + ", or "
                                                       : std::string()) +
            "one of them");
  }
  return std::nullopt;
}

/// What is wrong with the place of an opening in a unit that it lies in, at least in part.
std::optional<Issue> misplaced_in(const Job& job, const Span& unit, const InspectionOptions& opening,
                                  double reach) {
  const Span lid = lid_heights(job, opening);
  if (opening.at < unit.from + reach || opening.at > unit.to - reach ||
      !lid_keeps_off(job, unit, opening.at, reach, lid)) {
    const auto place = place_of_lid(job, unit, opening.at, reach, lid);
    return misplaced("an opening at " + length_text(opening.at, 4) + " reaches over the end of a unit",
                     "Units end at " + length_text(unit.from, 4) + " and " + length_text(unit.to, 4) +
                         "; with its lid it is " + length_text(2.0 * reach) + " long.",
                     place ? "at: " + length_text(*place, 4) : "a smaller length, or longer units");
  }
  if (job.track.at(opening.at).curvature * lid.to > 0.9) {
    return misplaced("the track bends too tightly at " + length_text(opening.at, 4), "", "another at");
  }
  return too_close(job, opening, reach, lid);
}

/// @throws InputError with everything that is wrong with places, of each opening the first
void require_places(const Fitting& fitting) {
  const Job& job = fitting.job;
  std::vector<Issue> issues;
  for (const InspectionOptions& opening : job.options.inspection) {
    if (!is_on_track(job, opening)) {
      issues.push_back(misplaced("an opening at " + length_text(opening.at, 4) + " is not on the track",
                                 "It is " + length_text(job.track.length(), 4) + " long.",
                                 "at: " + length_text(0.5 * job.track.length(), 2)));
      continue;
    }
    const double reach = 0.5 * opening.length + lid_lap(opening, job.options.shop);
    for (const Unit& unit : fitting.units) {
      if (opening.at + reach <= unit.span.from || opening.at - reach >= unit.span.to) continue;
      auto issue = misplaced_in(job, unit.span, opening, reach);
      if (!issue) continue;
      issues.push_back(*std::move(issue));
      break;
    }
  }
  if (!issues.empty()) throw InputError(std::move(issues));
}

}  // namespace

void add_openings(const Fitting& fitting) {
  const Job& job = fitting.job;
  require_places(fitting);
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const Unit& unit = fitting.units[i];
    std::vector<Opening> openings;
    for (const InspectionOptions& opening : job.options.inspection) {
      const double lap = lid_lap(opening, job.options.shop);
      const double reach = 0.5 * opening.length + lap;
      if (opening.at + reach <= unit.span.from || opening.at - reach >= unit.span.to) continue;
      const Span lid = lid_heights(job, opening);
      const Span heights{lid.from + lap, lid.to - lap};
      openings.push_back({lid, window(job.track, opening.at, 0.5 * opening.length, heights), {}});
      const std::vector<Vec2> bolts = lid_bolts(job.track, opening, heights, lap);
      for (const Vec2 bolt : bolts)
        openings.back().holes.push_back({bolt, 0.5 * clearance_hole(opening.bolt, HoleFit::medium)});
      add_lid(fitting, opening, heights, bolts);
      fitting.below.add(opening.at - reach, opening.at + reach);
    }
    if (!openings.empty()) cut_wall(fitting, i, openings);
  }
}

namespace {

/// Whether a lug stands off the frames at both ends of its unit: above a valley they lean towards it.
bool lug_keeps_off(const Job& job, const Span& unit, double s, const Span& heights) {
  constexpr double kOffFrame = 2e-3;
  if (!job.options.flanges.wanted) return true;
  const double taken = job.options.flanges.along() + kOffFrame;
  for (const double sense : {1.0, -1.0}) {
    const TrackFrame joint = frame_at(job.track, sense > 0.0 ? unit.from : unit.to);
    const TrackFrame end = frame_at(job.track, s - sense * kLugHalf);
    for (const double height : {heights.from, heights.to}) {
      if (sense * dot(end.at + height * end.up - joint.at, joint.along) < taken) return false;
    }
  }
  return true;
}

/// How far the eyes of lugs at a place are from plumb above a point, along the run [m].
double off_plumb(const Job& job, double s, Vec3 centre) {
  const TrackFrame frame = frame_at(job.track, s);
  const double x = dot(centre - in_space(job.placement, {}), along(job.placement));
  return std::fabs(frame.at.x + (job.channel.wall_height + kEyeHigh) * frame.up.x - x);
}

/// The free place at which the eyes of lugs stand plumb above a point, within a span of a unit; the nearest where they do so
/// nowhere.
/// @param heights  of a lug
std::optional<double> above(const Fitting& fitting, Vec3 centre, const Span& within, const Span& unit,
                            const Span& heights) {
  const Job& job = fitting.job;
  // On rims lugs stand beside whatever ends below them.
  const bool beside = job.options.rim.has_value();
  std::optional<double> best;
  double least = std::numeric_limits<double>::infinity();
  constexpr int kPlaces = 2000;
  for (int k = 0; k <= kPlaces; ++k) {
    const double s = within.from + (within.to - within.from) * k / kPlaces;
    const double miss = off_plumb(job, s, centre);
    constexpr double kAside = 10e-3;  // of a lug from a stiffener [m]
    if (miss >= least || !(beside || fitting.below.is_free(s, kLugHalf + kAside, within))) continue;
    if (!lug_keeps_off(job, unit, s, heights)) continue;
    least = miss;
    best = s;
  }
  return best;
}

}  // namespace

void add_channel_lugs(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.lifting) return;
  const LiftingOptions& lifting = *job.options.lifting;
  const double top = job.channel.wall_height;
  const double low = top - (job.options.rim ? job.options.rim->thickness : std::min(kLugLow, 0.5 * top));
  const double side = outside(job) + (job.options.rim ? job.options.rim->width : 0.0);
  const std::vector<UnitMass> masses =
      masses_of(fitting.workshop, job.track, job.placement, spans_of(fitting.units));
  UnitsWithoutLugs without;
  for (std::size_t i = 0; i < fitting.units.size(); ++i) {
    const Span room = between_frames(job, fitting.units[i].span);
    const Vec3 centre = (1.0 / masses[i].mass) * masses[i].moment;
    const Span within{room.from + 3.0 * kLugHalf, room.to - 3.0 * kLugHalf};
    // Of a unit shorter than that, and where others stand everywhere, there is none.
    const auto place = within.from <= within.to
                           ? above(fitting, centre, within, fitting.units[i].span, {low, top + kLugHigh})
                           : std::nullopt;
    if (!place) {
      without.no_place(i, masses[i].mass);
      continue;
    }
    const double at = *place;
    // Where the top folds, no lug follows it.
    const auto outline = band(job.track, {at - kLugHalf, at + kLugHalf}, low, top + kLugHigh);
    const TrackFrame frame = frame_at(job.track, at);
    PlaneRegion region{
        outline.value_or(ArcPath()), {}, {{frame.at + (top + kEyeHigh) * frame.up, 0.5 * lifting.hole}}};
    if (!outline || !faults_of(region).empty()) {
      without.no_room(i, masses[i].mass);
      continue;
    }
    ShopPart part = upright_plate(job, region, lifting.thickness, {-side - lifting.thickness, side});
    part.name = "lug" + suffix(fitting, i);
    FlatPattern pattern;
    pattern.region = std::get<Prism>(part.body).region;
    part.pattern = std::move(pattern);
    add_part(fitting.workshop, part, kFittingColour);
    note_lugs(i, masses[i].mass, at, off_plumb(job, at, centre), fitting.workshop);
  }
  without.tell(2.0 * kLugHalf, "The tops of the walls fold over where they would stand.", fitting.workshop);
}

}  // namespace glissade::parts
