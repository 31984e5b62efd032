// A channel as what stiffeners, lugs and trestles are set on.

#include "parts/plates/channel_shell.hpp"

#include "glissade/core/math.hpp"

#include "parts/plates/corners.hpp"
#include "parts/plates/flat_straights.hpp"

namespace glissade::parts {

SectionOutside channel_outside(const ChannelMeasures& channel, const PlateOptions& options) {
  const double outer = 0.5 * channel.width + channel.wall();
  const double depth = options.liner ? options.liner->thickness : 0.0;
  const double low = -depth - channel.thickness;
  SectionOutside outside;
  if (channel.wall_height <= 0.0) {
    outside.line.vertices = {{{outer, low}, 0.0}, {{-outer, low}, 0.0}};
    return outside;
  }
  outside.line.vertices = {{{outer, channel.wall_height}, 0.0},
                           {{outer, low}, 0.0},
                           {{-outer, low}, 0.0},
                           {{-outer, channel.wall_height}, 0.0}};
  if (options.corners.kind == CornerJoint::butt) return outside;
  const bool beside = options.walls == WallSeat::beside_floor;
  const double thickness = beside ? channel.wall() : channel.thickness;
  outside.laps = {{1, beside, options.corners.overlap, thickness},
                  {2, !beside, options.corners.overlap, thickness}};
  return outside;
}

Shell channel_shell(const Job& job, const std::vector<Unit>& units, Workshop& workshop, TakenUp& taken) {
  Shell shell{job.track, job.options, job.placement, {}, {},       {0.0, job.track.length()},
              0.0,       0.0,         false,         {}, workshop, taken};
  const SectionOutside outside = channel_outside(job.channel, job.options);
  shell.outside = [outside](double) { return outside; };
  shell.lowest = -floor_depth(job) - job.channel.thickness;
  for (const Vec2 tip : lap_tips(outside)) shell.lowest = std::min(shell.lowest, tip.y);
  // Walls do not bend with the floor: what is set on their tops follows the track.
  shell.highest = std::max(0.0, job.channel.wall_height);
  for (const Unit& unit : units) {
    shell.units.push_back(unit.span);
    if (unit.face.facets) add_straights(job.track, *unit.face.facets, {shell.lowest, 0.0}, shell.straights);
  }
  return shell;
}

}  // namespace glissade::parts
