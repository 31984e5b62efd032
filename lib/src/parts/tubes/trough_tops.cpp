#include "parts/tubes/trough_tops.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/curves/offset_line.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/plates/seams.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

/// Where the planes of a trough's ends cut a height above its axis, frames aside, along the axis.
Span span_between_planes(const TroughTop& trough, double height) {
  return {trough.before + height * math::tan(trough.start_tilt.radians()),
          trough.length - trough.after + height * math::tan(trough.end_tilt.radians())};
}

/// Directions of a plate that lies on the tops, and where the axis begins.
Frame directions_of(const TroughTop& trough, const Placement& placement) {
  return {in_space(placement, trough.from), direction_in_space(placement, trough.along), across(placement),
          direction_in_space(placement, {-trough.along.y, trough.along.x})};
}

ShopPart part_named(std::string name, double thickness, const PlateOptions& options) {
  ShopPart part;
  part.name = std::move(name);
  part.material = options.material.name;
  part.density = options.material.density;
  part.thickness = thickness;
  return part;
}

/// A level plate, drawn from its own corner.
ShopPart level_plate(std::string name, double thickness, PlaneRegion region, const PlateOptions& options) {
  ShopPart part = part_named(std::move(name), thickness, options);
  FlatPattern pattern;
  pattern.region = region;
  part.pattern = std::move(pattern);
  part.body = Prism{std::move(region), thickness};
  return part;
}

/// A bar between the planes of a trough's ends: in the plane of the axis and the way up, its width the depth.
ShopPart mitred_rim(const TroughTop& trough, std::string name, const TopMeasures& measures,
                    const PlateOptions& options, const Placement& placement) {
  const RimOptions& rim = *options.rim;
  const double low = measures.high - rim.thickness;
  const Span below = span_between_planes(trough, low);
  const Span above = span_between_planes(trough, measures.high);
  const ArcPath outline{{{{below.from, low}, 0.0},
                         {{below.to, low}, 0.0},
                         {{above.to, measures.high}, 0.0},
                         {{above.from, measures.high}, 0.0}},
                        true};
  ShopPart part = part_named(std::move(name), rim.thickness, options);
  part.body = Prism{{outline, {}, {}}, rim.width};
  const auto [axis, along, left, up] = directions_of(trough, placement);
  part.places = {{axis + (-measures.outer) * left, along, up, -1.0 * left},
                 {axis + (measures.outer + rim.width) * left, along, up, -1.0 * left}};
  // Cut square from the bar through its upper edge, then to the planes.
  const PlaneBox box = bounds(outline);
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {box.width(), rim.width});
  part.pattern = std::move(pattern);
  return part;
}

/// Where rim and cover of a trough lie, square between the planes of its ends, and are bolted.
struct CoveredTop {
  Span span;
  std::vector<Span> pieces;                ///< of the cover
  std::vector<std::vector<double>> bolts;  ///< of each piece
};

double cover_width(const TopMeasures& measures, const PlateOptions& options) {
  return 2.0 * (measures.outer + options.rim->width);
}

std::vector<double> bolts_of_piece(const Span& piece, const PlateOptions& options) {
  const CoverEnds ends = cover_ends(options, 1.0);
  if (piece.to - piece.from < 2.0 * ends.usual + ends.least) return {0.5 * (piece.from + piece.to)};
  std::vector<double> places;
  for (const Vec2 at :
       evenly({piece.from + ends.usual, 0.0}, {piece.to - ends.usual, 0.0}, options.cover->pitch))
    places.push_back(at.x);
  return places;
}

ShopPart cover_piece(std::string name, const Span& piece, const std::vector<double>& bolts,
                     const TopMeasures& measures, const PlateOptions& options) {
  const double width = cover_width(measures, options);
  PlaneRegion region{rectangle({}, {piece.to - piece.from, width}), {}, {}};
  const double radius = 0.5 * clearance_hole(options.cover->bolt, HoleFit::coarse);
  const double edge = 0.5 * options.rim->width;
  for (const double at : bolts) {
    for (const double y : {edge, width - edge}) region.holes.push_back({{at - piece.from, y}, radius});
  }
  return level_plate(std::move(name), options.cover->thickness, std::move(region), options);
}

CoveredTop covered_top(const TroughTop& trough, const TopMeasures& measures, const PlateOptions& options) {
  CoveredTop all;
  all.span = span_between_planes(trough, measures.high);
  for (const double height :
       {measures.high - options.rim->thickness, measures.high + options.cover->thickness}) {
    const Span at = span_between_planes(trough, height);
    all.span = {std::max(all.span.from, at.from), std::min(all.span.to, at.to)};
  }
  const Span whole{all.span.from + 0.5 * kLidGap, all.span.to - 0.5 * kLidGap};
  const double length = whole.to - whole.from;
  const double least = 2.0 * cover_ends(options, 1.0).least;
  // Left open: a trough so short at its top holds no bolts.
  if (!(length >= least)) return all;
  constexpr int kMostPieces = 20;
  for (int count = 1; count <= kMostPieces; ++count) {
    all.pieces.clear();
    all.bolts.clear();
    const double one = (length - (count - 1) * kLidGap) / count;
    for (int k = 0; k < count; ++k) {
      const double from = whole.from + k * (one + kLidGap);
      all.pieces.push_back({from, from + one});
      all.bolts.push_back(bolts_of_piece(all.pieces.back(), options));
    }
    ShopPart piece = cover_piece("cover", all.pieces.front(), all.bolts.front(), measures, options);
    piece.places.emplace_back();
    weigh(piece);
    if (!excess(options.split, piece)) return all;
    const bool last = count == kMostPieces || (length - count * kLidGap) / (count + 1) < least;
    if (!options.split.allowed || last) require_cover_fits(piece, options);
  }
  return all;
}

ShopPart square_rim(std::string name, const CoveredTop& on, const TopMeasures& measures,
                    const PlateOptions& options, const TroughTop& trough, const Placement& placement) {
  const RimOptions& rim = *options.rim;
  PlaneRegion region{rectangle({}, {on.span.to - on.span.from, rim.width}), {}, {}};
  const double radius = 0.5 * clearance_hole(options.cover->bolt, HoleFit::medium);
  for (const std::vector<double>& bolts : on.bolts) {
    for (const double at : bolts) region.holes.push_back({{at - on.span.from, 0.5 * rim.width}, radius});
  }
  ShopPart part = level_plate(std::move(name), rim.thickness, std::move(region), options);
  const auto [axis, along, left, up] = directions_of(trough, placement);
  const Vec3 corner = axis + on.span.from * along + (measures.high - rim.thickness) * up;
  part.places = {{corner + measures.outer * left, along, left, up},
                 {corner - (measures.outer + rim.width) * left, along, left, up}};
  return part;
}

}  // namespace

void add_trough_rims(const std::vector<TroughTop>& troughs, const TopMeasures& measures,
                     const PlateOptions& options, const Placement& placement, Workshop& workshop) {
  for (std::size_t i = 0; i < troughs.size(); ++i) {
    const std::string name = "rim_" + std::to_string(i + 1);
    ShopPart part = options.cover ? square_rim(name, covered_top(troughs[i], measures, options), measures,
                                               options, troughs[i], placement)
                                  : mitred_rim(troughs[i], name, measures, options, placement);
    weigh(part);
    add_part(workshop, std::move(part), kFittingColour);
  }
  workshop.notes.emplace_back(
      options.cover
          ? "Bars of the rim are cut square, short of the planes between troughs."
          : "Bars of the rim are cut to the planes between troughs; their lengths are the greatest.");
}

void add_trough_covers(const std::vector<TroughTop>& troughs, const TopMeasures& measures,
                       const PlateOptions& options, const Placement& placement, Workshop& workshop) {
  const CoverOptions& cover = *options.cover;
  std::vector<std::string> open;
  for (std::size_t i = 0; i < troughs.size(); ++i) {
    const CoveredTop on = covered_top(troughs[i], measures, options);
    if (on.pieces.empty()) {
      open.push_back(std::to_string(i + 1));
    }
    const auto [axis, along, left, up] = directions_of(troughs[i], placement);
    for (std::size_t k = 0; k < on.pieces.size(); ++k) {
      ShopPart part = cover_piece("cover_" + std::to_string(i + 1) + strip_letter(k, on.pieces.size()),
                                  on.pieces[k], on.bolts[k], measures, options);
      part.places = {{axis + on.pieces[k].from * along - 0.5 * cover_width(measures, options) * left +
                          measures.high * up,
                      along, left, up}};
      weigh(part);
      add_part(workshop, std::move(part), kFittingColour);
      add_bolts(workshop, cover.bolt, options.rim->thickness + cover.thickness, 2 * on.bolts[k].size(),
                "covers to rims");
    }
  }
  if (open.empty()) return;
  const std::string least = length_text(2.0 * cover_ends(options, 1.0).least, 3);
  if (open.size() == troughs.size()) {
    throw InputError({"cover", "cover: every trough is shorter at its top than its bolts take",
                      "They take " + least + ".",
                      "longer troughs (bend), a smaller bolt, round: staves, or no cover"});
  }
  add_shortfall({"cover",
                 "cover: " + std::to_string(open.size()) + " of " + std::to_string(troughs.size()) +
                     " troughs stay open, trough" + (open.size() > 1 ? "s " : " ") + listed(open),
                 "At their tops they are shorter than the " + least + " that a cover's bolts take.",
                 "longer troughs (bend), a smaller bolt, or round: staves"},
                workshop);
}

}  // namespace glissade::parts
