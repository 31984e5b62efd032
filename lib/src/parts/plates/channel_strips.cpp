#include "parts/plates/channel_strips.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/corners.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/liner_tiles.hpp"
#include "parts/plates/seams.hpp"
#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kOffEdge = 2.0;   // thicknesses from slots and the ends of tabs to a seam
constexpr double kOffHole = 1.5;   // diameters from the middle of a hole to a seam
constexpr double kOffRim = 10e-3;  // [m]

/// What of a sheet lies between two lines along it, whose ends alone they cross.
PlaneRegion between(const PlaneRegion& region, const Span& strip) {
  PlaneRegion part;
  part.outline = part_beyond(part_beyond(region.outline, {0.0, 1.0}, strip.from), {0.0, -1.0}, -strip.to);
  const auto inside = [&](double y) { return y > strip.from && y < strip.to; };
  for (const ArcPath& cutout : region.cutouts) {
    if (inside(cutout.vertices.front().at.y)) part.cutouts.push_back(cutout);
  }
  for (const Circle& hole : region.holes) {
    if (inside(hole.centre.y)) part.holes.push_back(hole);
  }
  return part;
}

/// The part of a pattern's lines across that lies on a strip.
template <typename Line>
std::vector<Line> between(std::vector<Line> lines, const Span& strip) {
  for (Line& line : lines) {
    line.from.y = std::clamp(line.from.y, strip.from, strip.to);
    line.to.y = std::clamp(line.to.y, strip.from, strip.to);
  }
  return lines;
}

FlatPattern between(const FlatPattern& whole, const Span& strip) {
  FlatPattern pattern;
  pattern.region = between(whole.region, strip);
  pattern.bends = between(whole.bends, strip);
  pattern.rolls = between(whole.rolls, strip);
  const PlaneMotion down = PlaneMotion::turn(0.0, {0.0, -strip.from});
  pattern.region = moved(pattern.region, down);
  const auto move_lines = [&](auto& lines) {
    for (auto& line : lines) {
      line.from = down(line.from);
      line.to = down(line.to);
    }
  };
  move_lines(pattern.bends);
  move_lines(pattern.rolls);
  return pattern;
}

/// Stretches across a floor that no seam may lie in.
std::vector<Span> taken_of_floor(const Job& job) {
  const double width = floor_width(job);
  const bool beside = job.options.walls == WallSeat::beside_floor;
  const double wall = job.channel.wall_height > 0.0 ? job.channel.wall() : 0.0;
  const double edge =
      (beside ? 0.0 : overlap(job) + job.options.corners.clearance) + wall + kOffEdge * job.channel.thickness;
  std::vector<Span> taken = {{0.0, edge}, {width - edge, width}};
  if (!job.options.liner) return taken;
  const double off = kOffHole * clearance_hole(job.options.liner->bolt, HoleFit::coarse);
  const double lane = 0.5 * (width - job.channel.width);
  for (const double y : bolts_across(job.options, job.channel.width))
    taken.push_back({lane + y - off, lane + y + off});
  return taken;
}

/// Heights of a wall that no seam may lie at.
std::vector<Span> taken_of_wall(const Job& job) {
  const Span heights = wall_heights(job);
  const double floor = -floor_depth(job);
  const double off = kOffEdge * job.channel.wall();
  std::vector<Span> taken = {{heights.from, floor + job.options.corners.clearance + off}};
  const double rim = job.options.rim ? job.options.rim->thickness : 0.0;
  taken.push_back({heights.to - rim - kOffRim, heights.to});
  for (const InspectionOptions& opening : job.options.inspection) taken.push_back(lid_heights(job, opening));
  return taken;
}

}  // namespace

std::vector<double> floor_seams(const Job& job, std::size_t index) {
  return seams_across("floor", {0.0, floor_width(job)}, true, taken_of_floor(job), job.options.split,
                      !job.options.flanges.wanted)
      .of_unit(index);
}

std::vector<ShopPart> floor_strips(const Job& job, const Unit& unit, std::size_t index) {
  const std::vector<double> seams = floor_seams(job, index);
  if (seams.empty()) return {unit.floor};
  std::vector<ShopPart> parts;
  for (const Span& strip : strips_between_seams({0.0, floor_width(job)}, seams)) {
    ShopPart part = unit.floor;
    part.name += strip_letter(parts.size(), seams.size() + 1);
    if (auto* const prism = std::get_if<Prism>(&part.body)) {
      prism->depth = strip.to - strip.from;
      for (Frame& place : part.places) place.origin = place.origin + strip.from * place.z;
    } else {
      auto& sheet = std::get<RolledSheet>(part.body);
      sheet.region = between(sheet.region, strip);
    }
    part.pattern = between(*unit.floor.pattern, strip);
    weigh(part);
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<WallStrip> wall_strips(const Job& job, const Unit& unit, std::size_t index) {
  if (!unit.wall) return {};
  const Span heights = wall_heights(job);
  const std::vector<double> seams =
      seams_across("wall", heights, false, taken_of_wall(job), job.options.split, !job.options.flanges.wanted)
          .of_unit(index);
  if (seams.empty()) return {{*unit.wall, heights, *wall_region(job, unit.span, unit.face, unit.tabs)}};
  std::vector<WallStrip> strips;
  for (const Span& strip : strips_between_seams(heights, seams)) {
    ChannelMeasures lower = job.channel;
    lower.wall_height = strip.to;
    PlaneRegion region =
        strips.empty()
            ? *wall_region({job.track, lower, job.options, job.placement}, unit.span, unit.face, unit.tabs)
            : PlaneRegion{*band(job.track, unit.span, strip.from, strip.to), {}, {}};
    ShopPart part = wall_of(job, region);
    part.name += strip_letter(strips.size(), seams.size() + 1);
    strips.push_back({std::move(part), strip, std::move(region)});
  }
  return strips;
}

double seam_length(const Job& job, const Unit& unit, std::size_t index) {
  double sum = static_cast<double>(floor_seams(job, index).size()) * unit.face.line.length();
  const std::vector<WallStrip> walls = wall_strips(job, unit, index);
  for (std::size_t i = 1; i < walls.size(); ++i)
    sum += 2.0 * length(*offset_line(job.track, unit.span, walls[i].heights.from));
  return sum;
}

}  // namespace glissade::parts
