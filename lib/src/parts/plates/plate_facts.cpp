// What rules of the shop (lib/data/rules/shop-plate.yaml) may bound of plates.

#include "parts/plates/plate_facts.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/slot.hpp"

#include "core/arc_pieces.hpp"
#include "core/least_rectangle.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/shop/shop_facts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace glissade::parts {
namespace {

double edge_distance(const ArcPath& path, Vec2 point) {
  double least = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : pieces_of(path))
    least = std::min(least, core::distance_to_piece(piece, point));
  return least;
}

void measure_holes(const ShopPart& part, ShopFacts& facts) {
  const std::vector<Circle>& holes = part.pattern->region.holes;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const double hole = 2.0 * holes[i].radius;
    double edge = edge_distance(part.pattern->region.outline, holes[i].centre);
    double nearest = std::numeric_limits<double>::infinity();
    double web = edge - holes[i].radius;
    for (const ArcPath& cutout : part.pattern->region.cutouts) {
      const double apart = edge_distance(cutout, holes[i].centre);
      web = std::min(web, apart - holes[i].radius);
      // Slots are holes; an opening has edges.
      if (!as_slot(cutout)) edge = std::min(edge, apart);
    }
    for (std::size_t k = 0; k < holes.size(); ++k) {
      if (k == i) continue;
      const double apart = norm(holes[k].centre - holes[i].centre);
      nearest = std::min(nearest, apart);
      web = std::min(web, apart - holes[i].radius - holes[k].radius);
    }
    facts.of(part, "hole_thicknesses", hole, part.thickness);
    facts.of(part, "hole_edge_diameters", edge, hole);
    facts.of(part, "web_thicknesses", web, part.thickness);
    if (holes.size() < 2) continue;
    facts.of(part, "hole_pitch_diameters", nearest, hole);
  }
}

/// How near holes and slots stand to where bends begin.
void measure_off_bends(const ShopPart& part, ShopFacts& facts) {
  constexpr double kOnEdge = 1e-6;  // of an opening, at which a bend ends that it parts [m]
  for (const BendLine& bend : part.pattern->bends) {
    const PathPiece line{bend.from, bend.to, 0.0};
    const double half = 0.5 * (bend.inner_radius + 0.5 * part.thickness) * bend.angle.radians();
    const auto tell = [&](double apart) {
      facts.of(part, "hole_bend_thicknesses", apart - half, part.thickness);
    };
    for (const Circle& hole : part.pattern->region.holes)
      tell(core::distance_to_piece(line, hole.centre) - hole.radius);
    for (const ArcPath& cutout : part.pattern->region.cutouts) {
      double apart = std::numeric_limits<double>::infinity();
      bool parted = false;
      for (const PathPiece& piece : pieces_of(cutout)) {
        apart = std::min(apart, distance(piece, line));
        for (const Vec2 end : {bend.from, bend.to})
          parted = parted || core::distance_to_piece(piece, end) < kOnEdge;
      }
      if (!parted) tell(apart);
    }
  }
}

void measure_frame_slots(const ShopPart& part, ShopFacts& facts) {
  const PlaneRegion& region = part.pattern->region;
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    const auto slot = as_slot(region.cutouts[i]);
    if (!slot) continue;
    const double width = 2.0 * slot->radius;
    double edge = std::numeric_limits<double>::infinity();
    for (const Vec2 end : {slot->middle - slot->reach, slot->middle + slot->reach})
      edge = std::min(edge, edge_distance(region.outline, end));
    double web = edge - slot->radius;
    for (std::size_t k = 0; k < region.cutouts.size(); ++k) {
      if (k == i) continue;
      const double apart = distance(region.cutouts[i], region.cutouts[k]);
      web = std::min(web, apart);
      // The opening of a closed frame is an edge of it.
      if (!as_slot(region.cutouts[k])) edge = std::min(edge, apart + slot->radius);
    }
    facts.of(part, "hole_thicknesses", width, part.thickness);
    facts.of(part, "slot_edge_diameters", edge, width);
    facts.of(part, "web_thicknesses", web, part.thickness);
  }
}

std::string on_floor(const Unit& unit, double s) {
  return unit.floor.name + " at " + length_text(unit.span.from + s, 3) + " along the track";
}

void measure_arcs(const Unit& unit, double thickness, ShopFacts& facts, Workshop& workshop) {
  const bool bent = unit.face.facets.has_value();
  for (const TrackArc& arc : unit.face.line.arcs()) {
    const std::string where = on_floor(unit, arc.start);
    if (!bent && arc.curvature != 0.0)
      measure_rolling(1.0 / std::fabs(arc.curvature), unit.floor, where, workshop);
    if (bent && arc.curvature == 0.0) {
      facts.at(where, "flat", arc.length);
      facts.at(where, "flat_thicknesses", arc.length, thickness);
    }
  }
}

}  // namespace

void measure_plates(const PlateOptions& options, Workshop& workshop) {
  ShopFacts facts(workshop);
  facts.parts(options.split.heaviest);
  const Vec2 sheet = options.split.sheet;
  for (const ShopPart& part : workshop.parts) {
    if (!part.pattern) continue;
    measure_holes(part, facts);
    measure_off_bends(part, facts);
    measure_frame_slots(part, facts);
    if (part.bought_in) continue;  // cut from no sheet
    const Vec2 stock{std::max(sheet.x, sheet.y), std::min(sheet.x, sheet.y)};
    const Vec2 laid = laid_size(part.pattern->region.outline, stock);
    facts.of(part, "part_sheet_share", laid.x, stock.x);
    facts.of(part, "part_sheet_share", laid.y, stock.y);
    // Through the grate it falls however it is drawn.
    facts.of(part, "part_width", core::least_size(part.pattern->region.outline).y);
  }
}

std::vector<RowBolt> bolts_in_order(const ShopPart& frame, const ArcPath& line) {
  const BandLine along(line);
  std::vector<std::pair<double, Vec2>> places;
  const auto add = [&](Vec2 middle) { places.emplace_back(along.nearest(middle), middle); };
  for (const Circle& hole : frame.pattern->region.holes) add(hole.centre);
  for (const ArcPath& cutout : frame.pattern->region.cutouts) {
    if (const auto slot = as_slot(cutout)) add(slot->middle);
  }
  std::sort(places.begin(), places.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  std::vector<RowBolt> row;
  row.reserve(places.size());
  for (const auto& [s, middle] : places) row.push_back({middle, &frame});
  return row;
}

void measure_bolt_row(const std::vector<RowBolt>& row, bool closed, Workshop& workshop) {
  if (row.size() < 2) return;
  std::vector<std::pair<double, const ShopPart*>> gaps;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < row.size(); ++i)
    gaps.emplace_back(norm(row[(i + 1) % row.size()].middle - row[i].middle), row[i].part);
  const auto [least, most] = std::minmax_element(
      gaps.begin(), gaps.end(), [](const auto& one, const auto& other) { return one.first < other.first; });
  ShopFacts facts(workshop);
  for (const auto& gap : {least, most}) facts.of(*gap->second, "bolt_pitch", gap->first);
}

void measure_rolling(double radius, const ShopPart& part, const std::string& where, Workshop& workshop) {
  ShopFacts(workshop).of(part, "rolling_radius_thicknesses", radius, part.thickness);
  workshop.measured.back().where = where;
}

void measure_floor(const Job& job, const std::vector<Unit>& units, Workshop& workshop) {
  ShopFacts facts(workshop);
  for (const Unit& unit : units) {
    measure_arcs(unit, job.channel.thickness, facts, workshop);
    if (unit.face.facets && unit.face.facets->bends() > 0)
      facts.of(unit.floor, "bend_radius_thicknesses", bend_radius(job), job.channel.thickness);
  }
}

}  // namespace glissade::parts
