// Tiles on the floor of a channel, their faces the track.

#include "parts/plates/corners.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/liner_tiles.hpp"
#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

/// @return the place on the track of one along the face of a floor below it
double on_track(const Job& job, const Unit& unit, double along_face) {
  double left = along_face;
  for (const TrackArc& arc : job.track.arcs()) {
    const double from = std::max(unit.span.from, arc.start);
    const double to = std::min(unit.span.to, arc.start + arc.length);
    if (!(to > from)) continue;
    const double stretch = 1.0 + arc.curvature * floor_depth(job);
    if (left <= (to - from) * stretch) return from + left / stretch;
    left -= (to - from) * stretch;
  }
  return unit.span.to;
}

/// Places at which bolts go through liner and floor of a unit: on one arc each, beside tabs and slots.
OnOneArc bolt_arcs(const Job& job, const Unit& unit) {
  const LinerOptions& liner = *job.options.liner;
  std::vector<double> breaks;
  const double slack = 0.5 * job.options.corners.clearance;
  for (const Span& tab : unit.tabs) {
    for (const double along_face : OnOneArc::ends_of_tab(tab, slack))
      breaks.push_back(on_track(job, unit, along_face));
  }
  return {job.track,
          0.5 * clearance_hole(liner.bolt, HoleFit::coarse),
          {-liner.thickness - job.channel.thickness, 0.0},
          breaks};
}

/// The tiles of a unit.
/// @param row  courses before it; counts on
std::vector<TilePlace> tiles_of(const Job& job, const Unit& unit, int& row) {
  return tile_places(job.options, {job.channel.width}, unit.span, bolt_arcs(job, unit), row);
}

/// A tile with its holes.
ShopPart tile_of(const Job& job, const TilePlace& tile, const StockMaterial& material) {
  const LinerOptions& liner = *job.options.liner;
  const auto outline = band(job.track, tile.span, -liner.thickness, 0.0);
  ShopPart part = upright_plate(job, {*outline, {}, {}}, tile.width, {-0.5 * job.channel.width + tile.edge});
  part.material = material.name;
  part.density = material.density;
  part.thickness = liner.thickness;
  const double middle = -0.5 * liner.thickness;
  const double whole = flat_from_end(job.track, tile.span, middle, tile.span.from);
  const double radius = 0.5 * clearance_hole(liner.bolt, HoleFit::medium);
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {whole, tile.width});
  std::vector<Circle> holes;
  for (const double s : tile.along) {
    for (const double y : tile.across) {
      holes.push_back({{s, y}, radius});
      pattern.region.holes.push_back({{whole - flat_from_end(job.track, tile.span, middle, s), y}, radius});
    }
  }
  part.pattern = std::move(pattern);
  drill_plate(job, tile.span, 0.0, tile.width, holes, part);
  return part;
}

/// The floor of a unit gets the holes of a tile.
/// @param holes  of the finished floor: along its face and across
void drill(const Job& job, const Unit& unit, const TilePlace& tile, FlatPattern& pattern,
           std::vector<Circle>& holes) {
  const LinerOptions& liner = *job.options.liner;
  const double middle = -liner.thickness - neutral_fibre(job) * job.channel.thickness;
  const double whole = flat_from_end(job.track, unit.span, middle, unit.span.from);
  const double face = flat_from_end(job.track, unit.span, -liner.thickness, unit.span.from);
  const double beside = 0.5 * (floor_width(job) - job.channel.width);
  const double radius = 0.5 * clearance_hole(liner.bolt, HoleFit::coarse);
  for (const double s : tile.along) {
    for (const double y : tile.across) {
      const double across = beside + tile.edge + y;
      pattern.region.holes.push_back(
          {{whole - flat_from_end(job.track, unit.span, middle, s), across}, radius});
      holes.push_back({{face - flat_from_end(job.track, unit.span, -liner.thickness, s), across}, radius});
    }
  }
}

}  // namespace

void drill_floors(const Job& job, std::vector<Unit>& units) {
  if (!job.options.liner) return;
  int row = 0;
  for (Unit& unit : units) {
    std::vector<Circle> holes;
    for (const TilePlace& tile : tiles_of(job, unit, row)) drill(job, unit, tile, *unit.floor.pattern, holes);
    drill_floor(job, unit.face, unit.tabs, std::move(holes), unit.floor);
  }
}

void add_liner(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.liner) return;
  int row = 0;
  std::vector<TilePlace> tiles;
  for (const Unit& unit : fitting.units) {
    for (TilePlace& tile : tiles_of(job, unit, row)) {
      for (const double s : tile.along) fitting.below.add(s - 0.015, s + 0.015);
      tiles.push_back(std::move(tile));
    }
  }
  lay_tiles(
      job.options, {""}, tiles,
      [&](const TilePlace& tile, const StockMaterial& material) { return tile_of(job, tile, material); },
      job.channel.thickness, fitting.workshop);
}

}  // namespace glissade::parts
