#include "parts/strips/strip_fittings.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/curves/offset_line.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/plate_checks.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/seams.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

/// The top of an outer side, and the way down along its outside.
struct OuterSide {
  Vec2 top;
  Vec2 down;  ///< per height
};

constexpr double kSteepEnough = 0.2;  // height per length of a side that a rim lies against

std::optional<OuterSide> side_from(Vec2 top, Vec2 low) {
  const Vec2 way = low - top;
  if (!(norm(way) > 0.0) || !(-way.y > kSteepEnough * norm(way))) return std::nullopt;
  return OuterSide{top, (1.0 / -way.y) * way};
}

/// @param sign  +1 on the left, -1 on the right
std::optional<OuterSide> outer_side(const PlateSection& section, double sign) {
  const std::vector<Vec2>& outside = section.outside;
  if (section.ring || outside.size() < 2) return std::nullopt;
  return sign > 0.0 ? side_from(outside[0], outside[1])
                    : side_from(outside[outside.size() - 1], outside[outside.size() - 2]);
}

/// A level bar against the outside of a side, its upper face level with the top.
SectionPlate rim_against(const OuterSide& side, double sign, const RimOptions& rim) {
  const double top = side.top.y;
  const double low = top - rim.thickness;
  const double inner = side.top.x;
  const double under = inner + rim.thickness * side.down.x;
  const double outer = inner + sign * rim.width;
  // From left to right, so that its lower face is the far one.
  if (sign > 0.0) return {"left_rim", {outer, top}, {inner, top}, {outer, low}, {under, low}};
  return {"right_rim", {inner, top}, {outer, top}, {under, low}, {outer, low}};
}

std::vector<SectionPlate> rims_of(const StripJob& job) {
  std::vector<SectionPlate> rims;
  for (const double sign : {1.0, -1.0}) {
    if (const auto side = outer_side(job.section, sign))
      rims.push_back(rim_against(*side, sign, *job.options.rim));
  }
  return rims;
}

SectionPlate cover_on(const std::vector<SectionPlate>& rims, double thickness) {
  const double left = rims.front().face_from.x;
  const double right = rims.back().face_to.x;
  const double low = rims.front().face_from.y;
  return {"cover", {left, low + thickness}, {right, low + thickness}, {left, low}, {right, low}};
}

std::string suffix(const std::vector<double>& joints, std::size_t unit) {
  return joints.size() > 2 ? "_" + std::to_string(unit + 1) : "";
}

/// Places along a unit at which covers are bolted to rims, on one arc each.
std::vector<double> cover_bolts(const StripJob& job, const Span& span, const SectionPlate& cover) {
  const CoverOptions& options = *job.options.cover;
  const Span heights{cover.back_from.y - job.options.rim->thickness, cover.face_from.y};
  const OnOneArc arcs(job.track, 0.5 * clearance_hole(options.bolt, HoleFit::coarse), heights,
                      job.widens() ? job.pieces() : std::vector<double>(), job.rooms_at_bends(heights));
  std::vector<double> places;
  const CoverEnds ends = cover_ends(
      job.options, std::min(least_stretch(job.track, {span.from, span.from + kEndOfCover}, heights.to),
                            least_stretch(job.track, {span.to - kEndOfCover, span.to}, heights.to)));
  for (const Vec2 at : evenly({span.from + ends.usual, 0.0}, {span.to - ends.usual, 0.0}, options.pitch)) {
    const auto place = arcs.nearest(at.x, {span.from + ends.least, span.to - ends.least});
    if (place && (places.empty() || *place - places.back() > ends.usual)) places.push_back(*place);
  }
  return places;
}

/// As the sheet and the heaviest part ask.
std::vector<Span> cover_pieces(const StripJob& job, const Span& span, const SectionPlate& cover) {
  const Span heights{cover.back_from.y, cover.face_from.y};
  const OnOneArc seams(job.track, 0.5 * kLidGap, heights, job.widens() ? job.pieces() : std::vector<double>(),
                       job.rooms_at_bends(heights));
  const auto made = [&](const Span& piece) {
    return set_plate(job, cover, job.options.cover->thickness, piece, job.options.material, {});
  };
  std::vector<Span> pieces{span};
  if (job.options.split.allowed) {
    pieces = pieces_that_fit(span, seams,
                             [&](const Span& piece) { return !excess(job.options.split, made(piece)); });
  }
  for (const Span& piece : pieces) require_cover_fits(made(piece), job.options);
  return pieces;
}

/// Where rims and cover of a unit lie, and are bolted.
struct Covered {
  Span span;
  std::vector<double> bolts;
  std::vector<Span> pieces;                    ///< of the cover
  std::vector<std::vector<double>> of_pieces;  ///< their bolts
};

/// How far out the tops of the sides stand at a place, beyond where they are narrowest.
double out_at(const StripJob& job, double s) {
  if (!job.widens()) return 0.0;
  return job.wider_at(s) + job.section.outside.front().y * job.lean_at(s);
}

Covered covered(const StripJob& job, const Span& unit, const std::vector<SectionPlate>& rims) {
  if (!job.options.cover) return {room_of(job, unit, rims.front()), {}, {}, {}};
  const SectionPlate cover = cover_on(rims, job.options.cover->thickness);
  Covered all{room_of(job, unit, cover), {}, {}, {}};
  all.pieces = cover_pieces(job, all.span, cover);
  for (const Span& piece : all.pieces) {
    all.of_pieces.push_back(cover_bolts(job, piece, cover));
    all.bolts.insert(all.bolts.end(), all.of_pieces.back().begin(), all.of_pieces.back().end());
  }
  return all;
}

}  // namespace

namespace {

/// Where a plate on flats begins, square to one of them, off bends and beyond a frame at the end of its unit.
/// @param taken  by the frame
double square_beyond(const StripJob& job, double taken, double end, double sense, const Span& heights) {
  const TrackFrame frame = frame_at(job.track, end);
  const auto clear = [&](double place) {
    const TrackFrame here = frame_at(job.track, place);
    const auto at = [&](double height) {
      return sense * dot(here.at + height * here.up - frame.at, frame.along);
    };
    return std::min({at(0.0), at(heights.from), at(heights.to)}) >= taken - 1e-9;
  };
  constexpr double kStep = 0.5e-3;  // [m]
  double place = job.off_bends(end + sense * taken, sense, heights);
  while (!clear(place)) {
    place += sense * kStep;
    if (place <= 0.0 || place >= job.track.length()) return std::clamp(place, 0.0, job.track.length());
    place = job.off_bends(place, sense, heights);
  }
  return place;
}

}  // namespace

Span room_of(const StripJob& job, const Span& unit, const SectionPlate& plate) {
  if (job.bent()) {
    const bool frames = job.options.flanges.wanted && job.section.convex;
    const double taken = frames ? job.options.flanges.along() + kAsideOfFrame : 0.0;
    const Span heights{std::min(plate.face_from.y, plate.back_from.y),
                       std::max(plate.face_from.y, plate.back_from.y)};
    const Span whole = unfolded(job, plate);
    const Span room{square_beyond(job, taken, unit.from, 1.0, heights),
                    square_beyond(job, taken, unit.to, -1.0, heights)};
    return {std::max(room.from, job.off_bends(whole.from, 1.0, heights)),
            std::min(room.to, job.off_bends(whole.to, -1.0, heights))};
  }
  Span room = unit;
  const double high = std::max(plate.face_from.y, plate.back_from.y);
  if (job.options.flanges.wanted && job.section.convex) {
    const double taken = job.options.flanges.along() + kAsideOfFrame;
    room = {beyond_frame(job.track, taken, unit.from, 1.0, high),
            beyond_frame(job.track, taken, unit.to, -1.0, high)};
  }
  const Span whole = unfolded(job, plate);
  return {std::max(room.from, whole.from), std::min(room.to, whole.to)};
}

ShopPart set_plate(const StripJob& job, const SectionPlate& plate, double thickness, const Span& span,
                   const StockMaterial& material, const std::vector<Circle>& holes) {
  SheetCut cut = plain_cut(plate, thickness, span, material);
  cut.holes = holes;
  if (!job.widens()) {
    double mismatch = 0.0;
    ShopPart part = sheet_part(job, cut, {}, mismatch);
    constexpr double kSameEdge = 1e-9;  // [m]
    if (mismatch <= kSameEdge) return part;
    throw InternalError(
        {"", "edges of the " + plate.name + " differ by " + length_text(mismatch, 3), "", ""});
  }
  ShopPart part;
  part.name = plate.name;
  part.material = material.name;
  part.density = material.density;
  part.thickness = cut.thickness;
  Vec2 origin;
  SweptBody body = strip_body(job, plate, span, origin);
  Development flat = developed(job, plate, span);
  cut_through(job, plate, span, holes, {}, body, flat);
  part.body = std::move(body);
  part.places = {plane_of_track(job.placement, origin, 0.0, -0.5 * (plate.face_from.x + plate.face_to.x))};
  part.pattern = pattern_of(flat, {});
  weigh(part);
  if (job.widens() && plate.middle_from().y != plate.middle_to().y) weigh_sheet(part);
  return part;
}

std::vector<Strip> add_bent_rims(const StripJob& job, const BentStrips& bent, Workshop& workshop) {
  std::vector<Strip> listed;
  if (!job.options.rim) return listed;
  const bool frames = job.options.flanges.wanted && job.section.convex;
  const double taken = frames ? job.options.flanges.along() + kAsideOfFrame : 0.0;
  for (const SectionPlate& rim : rims_of(job)) {
    BentStrips own = bent;
    for (Strip& strip : own.set(rim, job.options.rim->thickness, taken)) {
      const std::size_t before = workshop.parts.size();
      const int number = add_part(workshop, strip.part, kFittingColour);
      if (workshop.parts.size() == before) continue;
      for (BendStep step : strip.steps) {
        step.part = number;
        workshop.bends.push_back(step);
      }
      listed.push_back(std::move(strip));
    }
  }
  return listed;
}

void add_strip_rims(const StripJob& job, const std::vector<double>& joints, Workshop& workshop) {
  if (!job.options.rim) return;
  const std::vector<SectionPlate> rims = rims_of(job);
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const Covered unit = covered(job, {joints[i], joints[i + 1]}, rims);
    for (const SectionPlate& rim : rims) {
      std::vector<Circle> holes;
      const double width = rim.face_from.x - rim.face_to.x;
      const double middle = 0.5 * job.options.rim->width;
      for (const double s : unit.bolts) {
        const double out = out_at(job, s);
        holes.push_back({{s, rim.face_from.x > 0.0 ? middle - out : width - middle + out},
                         0.5 * clearance_hole(job.options.cover->bolt, HoleFit::medium)});
      }
      ShopPart part = set_plate(job, rim, job.options.rim->thickness, unit.span, job.options.material, holes);
      part.name += suffix(joints, i);
      add_part(workshop, std::move(part), kFittingColour);
    }
  }
}

void add_strip_covers(const StripJob& job, const std::vector<double>& joints, Workshop& workshop) {
  if (!job.options.cover) return;
  const CoverOptions& options = *job.options.cover;
  const std::vector<SectionPlate> rims = rims_of(job);
  const SectionPlate cover = cover_on(rims, options.thickness);
  const double width = cover.face_from.x - cover.face_to.x;
  const double middle = 0.5 * job.options.rim->width;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const Covered unit = covered(job, {joints[i], joints[i + 1]}, rims);
    for (std::size_t k = 0; k < unit.pieces.size(); ++k) {
      std::vector<Circle> holes;
      for (const double s : unit.of_pieces[k]) {
        const double out = out_at(job, s);
        for (const double y : {middle - out, width - middle + out})
          holes.push_back({{s, y}, 0.5 * clearance_hole(options.bolt, HoleFit::coarse)});
      }
      ShopPart part = set_plate(job, cover, options.thickness, unit.pieces[k], job.options.material, holes);
      part.name += suffix(joints, i) + strip_letter(k, unit.pieces.size());
      add_part(workshop, std::move(part), kFittingColour);
      add_bolts(workshop, options.bolt, job.options.rim->thickness + options.thickness, holes.size(),
                "covers to rims");
    }
  }
}

// --- liner

namespace {

constexpr double kSameEdge = 1e-9;  // [m]

Vec2 way_of(const LinedFace& face) {
  return (1.0 / norm(face.to - face.from)) * (face.to - face.from);
}

/// The strip of the plate below a lined face in which a place along the face of the first one lies.
std::size_t strip_below(const std::vector<SectionPlate>& plates, const LinedFace& face, double y) {
  const Vec2 origin = plates[face.plate].face_from;
  std::size_t strip = face.plate;
  for (std::size_t k = 1; k < face.strips; ++k) {
    if (y > dot(plates[face.plate + k].face_from - origin, way_of(face))) strip = face.plate + k;
  }
  return strip;
}

std::vector<double> widths_of(const PlateSection& section) {
  std::vector<double> widths;
  for (const LinedFace& face : section.lined) widths.push_back(lane_of(section, face).width);
  return widths;
}

/// A tile as a plate of the section.
SectionPlate tile_plate(const PlateSection& section, const TilePlace& tile, double thickness) {
  const LinedFace& face = section.lined[tile.lane];
  const Vec2 way = way_of(face);
  const Vec2 back = thickness * Vec2{-way.y, way.x};
  const Lane lane = lane_of(section, face);
  // Where its course is narrowest. Those at the sides take the change of width, others stay.
  const Vec2 from = face.from + (lane.low + tile.edge - 0.5 * tile.wider) * way;
  const Vec2 to = from + tile.width * way;
  const bool first = tile.edge <= tile.gap;
  const bool last = tile.edge + tile.width + tile.gap >= lane.width + tile.wider - kSameEdge;
  return {"tile", from, to, from + back, to + back, !first, !last, 0.5 * tile.wider};
}

/// By how much the lane of a level floor is wider over a course than where it is narrowest, at the least.
double wider_over(const StripJob& job, const Span& span, double lowest) {
  double least = std::numeric_limits<double>::infinity();
  for (const StripArc& one : job.arcs_in(span)) {
    for (const double height : {0.0, lowest}) {
      least = std::min({least, one.wide_from + height * one.lean_from, one.wide_to + height * one.lean_to});
    }
  }
  return 2.0 * least;
}

}  // namespace

Lane lane_of(const PlateSection& section, const LinedFace& face) {
  const SectionPlate& first = section.plates[face.plate];
  const SectionPlate& last = section.plates[face.plate + face.strips - 1];
  const Vec2 way = way_of(face);
  const double low = std::max(0.0, dot(first.face_from - face.from, way));
  const double high = std::min(norm(face.to - face.from), dot(last.face_to - face.from, way));
  return {low, high - low};
}

std::vector<TilePlace> strip_tiles(const StripJob& job, const Span& unit, std::size_t index,
                                   const std::vector<double>& breaks, int& row) {
  const LinerOptions& liner = *job.options.liner;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  Span room = unit;
  for (const LinedFace& face : job.section.lined) {
    for (std::size_t k = 0; k < face.strips; ++k) {
      const SectionPlate& plate = job.section.plates_of(index)[face.plate + k];
      for (const Vec2 corner : {face.from, face.to, plate.back_from, plate.back_to}) {
        low = std::min(low, corner.y);
        high = std::max(high, corner.y);
      }
      const Span whole = unfolded(job, plate);
      room = {std::max(room.from, whole.from), std::min(room.to, whole.to)};
    }
  }
  const std::vector<double> bends = job.rooms_at_bends({low, high});
  std::vector<double> ends = breaks;
  if (job.widens()) {
    for (const double place : job.pieces()) ends.push_back(place);
  }
  const OnOneArc arcs(job.track, 0.5 * clearance_hole(liner.bolt, HoleFit::coarse), {low, high}, ends, bends);
  if (job.widens()) {
    return tile_places(job.options, widths_of(job.section), room, arcs, row, nullptr,
                       [&](const Span& span) { return wider_over(job, span, low); });
  }
  if (!job.bent()) return tile_places(job.options, widths_of(job.section), room, arcs, row);
  // Seams between courses, and the ends of the liner, lie on one flat, too.
  room = {job.off_bends(room.from, 1.0, {low, high}), job.off_bends(room.to, -1.0, {low, high})};
  const OnOneArc seams(job.track, 0.5 * liner.gap, {low, high}, {}, bends);
  return tile_places(job.options, widths_of(job.section), room, arcs, row, &seams, {},
                     [&](double place) { return job.on_track(place); });
}

std::vector<std::vector<Circle>> holes_below(const StripJob& job, std::size_t unit,
                                             const std::vector<TilePlace>& tiles) {
  const std::vector<SectionPlate>& plates = job.section.plates_of(unit);
  std::vector<std::vector<Circle>> holes(plates.size());
  const double radius = 0.5 * clearance_hole(job.options.liner->bolt, HoleFit::coarse);
  for (const TilePlace& tile : tiles) {
    const LinedFace& face = job.section.lined[tile.lane];
    const SectionPlate& plate = plates[face.plate];
    const double from = lane_of(job.section, face).low - dot(plate.face_from - face.from, way_of(face));
    for (const double across : tile.across) {
      const double y = from + tile.edge + across - 0.5 * tile.wider;
      const std::size_t strip = strip_below(plates, face, y);
      const double own = y - dot(plates[strip].face_from - plate.face_from, way_of(face));
      for (const double s : tile.along) holes[strip].push_back({{s, own}, radius});
    }
  }
  return holes;
}

void add_strip_liner(const StripJob& job, const std::vector<TilePlace>& tiles, Workshop& workshop) {
  const LinerOptions& liner = *job.options.liner;
  std::vector<std::string> names;
  for (const LinedFace& face : job.section.lined)
    names.push_back(job.section.lined.size() > 1 ? "_" + job.section.plates[face.plate].name : "");
  lay_tiles(
      job.options, names, tiles,
      [&](const TilePlace& tile, const StockMaterial& material) {
        const SectionPlate plate = tile_plate(job.section, tile, liner.thickness);
        std::vector<Circle> holes;
        for (const double s : tile.along) {
          for (const double y : tile.across)
            holes.push_back({{s, y}, 0.5 * clearance_hole(liner.bolt, HoleFit::medium)});
        }
        return set_plate(job, plate, liner.thickness, tile.span, material, holes);
      },
      job.section.thickness, workshop);
}

namespace {

class Issues {
 public:
  void add(const char* where, std::string what, std::string why, std::string hint) {
    all.push_back({where, std::move(what), std::move(why), std::move(hint)});
  }
  void add(std::vector<Issue> more) {
    for (Issue& issue : more) all.push_back(std::move(issue));
  }
  std::vector<Issue> all;
};

void object_to_rims(const PlateSection& section, const RimOptions& rim, Issues& issues) {
  for (const auto& [value, where, key] : {std::tuple(rim.width, "rim.width", "width"),
                                          std::tuple(rim.thickness, "rim.thickness", "thickness")}) {
    if (!(value > 0.0))
      issues.add(where, std::string(key) + ": " + length_text(value) + " is not positive", "",
                 "a positive length");
  }
  for (const double sign : {1.0, -1.0}) {
    const auto side = outer_side(section, sign);
    if (!side) {
      const bool round = section.ring;
      issues.add("rim",
                 round ? "rim: a closed section has no tops that it could lie along"
                       : "rim: this section has no side that it could lie against",
                 round ? "" : "It lies along the outside of a side that goes down from the section's top.",
                 "no rim, or a cross_section with walls");
      return;
    }
    const double high = side->top.y - section.lowest;
    if (rim.thickness > 0.5 * high) {
      issues.add("rim.thickness",
                 "thickness: " + length_text(rim.thickness) + " is more than half the section, " +
                     length_text(high, 3),
                 "The rim lies against its sides.", "thickness: " + length_text(0.4 * high, 2));
      return;
    }
  }
}

void object_to_tiles(const PlateSection& section, const PlateOptions& options, Issues& issues) {
  // Tiles of strips are bent as the plates below them.
  PlateOptions wide = options;
  wide.floor = FloorMake::rolled;
  const LinerOptions& liner = *options.liner;
  if (section.lined.empty()) {
    issues.add("liner", "liner: this section has no floor that tiles could lie on", "Tiles are flat.",
               "no liner, or a cross_section of kind: u-channel or trapezoid");
    return;
  }
  if (section.widths && options.floor == FloorMake::bent) {
    issues.add("liner", "liner: tiles on a bent floor have one width",
               "Their edges would be bent with the floor's.", "no liner, floor: rolled, or one width");
    return;
  }
  const bool known = is_bolt_size(liner.bolt);
  for (const LinedFace& face : section.lined) {
    const double width = lane_of(section, face).width;
    const double least =
        known ? kLeastTile * clearance_hole(liner.bolt, HoleFit::medium) + 2.0 * liner.gap : 0.0;
    if (width >= least && width > 2.0 * liner.gap) continue;
    issues.add("liner.bolt",
               "bolt: tiles on the " + section.plates[face.plate].name + " have " +
                   length_text(std::max(width, 0.0), 3) + " of room",
               "Holes for M" + std::to_string(liner.bolt) + " take " + length_text(least, 3) +
                   " with their edges and gaps.",
               section.departure > 0.0 ? "a smaller bolt, a larger stave_tolerance, or a larger radius"
                                       : "a smaller bolt, or a wider floor");
    return;
  }
  if (liner.tile_width > 0.0 && !(liner.gap < 0.0)) {
    // Its own measures are those of a channel's; half tiles are left out where they would be too narrow.
    double widest = 0.0;
    for (const double width : widths_of(section)) widest = std::max(widest, width);
    if (section.lined.size() > 1) wide.liner->tile_width = 4.0 * widest;
    issues.add(liner_problems({std::max(widest, 1.0), 1.0, section.thickness}, wide));
    return;
  }
  issues.add(liner_problems({1.0, 1.0, section.thickness}, wide));
}

}  // namespace

std::optional<Issue> too_tight_a_bend_of_any(double plate, const PlateOptions& options) {
  std::pair<double, std::string> thickest{plate, "plate"};
  const auto beside = [&](double thickness, const char* part) {
    if (thickness > thickest.first) thickest = {thickness, part};
  };
  if (options.rim) beside(options.rim->thickness, "rim");
  if (options.cover) beside(options.cover->thickness, "cover");
  if (options.liner) beside(options.liner->thickness, "liner");
  return too_tight_a_bend(thickest.first, options, thickest.second);
}

std::vector<Issue> section_fitting_problems(const PlateSection& section, const PlateOptions& options) {
  Issues issues;
  const bool bent = options.floor == FloorMake::bent;
  // Where the plates are too thick themselves, that is told of them, with what is thickest.
  if (bent && !too_tight_a_bend(section.thickness, options)) {
    if (auto tight = too_tight_a_bend_of_any(section.thickness, options)) issues.add({std::move(*tight)});
  }
  if (options.rim) object_to_rims(section, *options.rim, issues);
  if (options.cover) {
    issues.add(cover_problems(options));
    const auto side = outer_side(section, 1.0);
    if (side && !(side->top.y > 0.0))
      issues.add("cover", "cover: it would lie on the floor",
                 "The tops of this section are no higher than that.",
                 "no cover, or a cross_section with sides above the floor");
    if (section.widths && bent)
      issues.add("cover",
                 "cover: sides of bent plates lean otherwise from flat to flat where the width changes", "",
                 "no cover, floor: rolled, or one width");
  }
  if (options.liner) object_to_tiles(section, options, issues);
  return std::move(issues.all);
}

}  // namespace glissade::parts
