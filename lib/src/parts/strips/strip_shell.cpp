// Strips, tubes and troughs as what stiffeners, lugs and trestles are set on.

#include "parts/strips/strip_shell.hpp"

#include "glissade/core/math.hpp"

#include "parts/plates/flat_straights.hpp"
#include "parts/plates/section_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

/// Lowest and highest of an outside, what laps included.
Span heights_of(const SectionOutside& outside) {
  const PlaneBox box = bounds(outside.line);
  Span heights{box.low.y, box.high.y};
  for (const Vec2 tip : lap_tips(outside)) heights.from = std::min(heights.from, tip.y);
  return heights;
}

std::vector<OutsideLap> laps_of(const PlateSection& section, const PlateOptions& options) {
  std::vector<OutsideLap> laps;
  // Plates inside an outline lap inwards.
  if (section.inside_outline) return laps;
  const std::vector<CorneredPlate> edges = cornered(section, options);
  // Where plates have seams there are more of them than sides.
  const auto corner_at = [&](Vec2 point) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < section.outside.size(); ++k) {
      if (norm(section.outside[k] - point) < norm(section.outside[nearest] - point)) nearest = k;
    }
    return nearest;
  };
  for (std::size_t i = 0; i < section.plates.size(); ++i) {
    const SectionPlate& plate = section.plates[i];
    const auto along = [&](Vec2 point) { return dot(point - plate.face_from, plate.way()); };
    const auto tip = [](const Bevel& out) { return out.at + out.below; };
    if (edges[i].to.meeting == CornerEdge::Meeting::passes)
      laps.push_back(
          {corner_at(plate.back_to), true, tip(edges[i].to.out) - along(plate.back_to), section.thickness});
    if (edges[i].from.meeting == CornerEdge::Meeting::passes)
      laps.push_back({corner_at(plate.back_from), false, along(plate.back_from) - tip(edges[i].from.out),
                      section.thickness});
  }
  return laps;
}

Shell empty_shell(const ArcSpline& track, const PlateOptions& options, const Placement& placement,
                  const std::vector<double>& joints, Workshop& workshop, TakenUp& taken) {
  Shell shell{track, options, placement, {}, {}, {0.0, track.length()}, 0.0, 0.0, false, {}, workshop, taken};
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) shell.units.push_back({joints[i], joints[i + 1]});
  return shell;
}

/// @return the place of a shell whose frame stands at one on the line of flats: shells and lines count along flats from where these
///         touch the track and from their corners
double place_of(const std::vector<Straight>& straights, const FlatsLine& flats, double on_line) {
  const Vec2 at = frame_at(flats.line(), on_line).at;
  double nearest = std::numeric_limits<double>::infinity();
  double place = flats.on_track(on_line);
  for (const Straight& one : straights) {
    const double along = dot(at - one.from.at, one.from.along);
    const double whole = (one.span.to - one.span.from) * one.stretch;
    const double beyond = std::max({0.0, -along, along - whole});
    const double off = math::hypot(beyond, cross(one.from.along, at - one.from.at));
    if (!(off < nearest)) continue;
    nearest = off;
    place = one.span.from + along / one.stretch;
  }
  return place;
}

}  // namespace

SectionOutside outside_of(const PlateSection& section, const PlateOptions& options) {
  SectionOutside outside;
  for (const Vec2 corner : section.outside) outside.line.vertices.push_back({corner, 0.0});
  outside.line.closed = section.ring;
  outside.laps = laps_of(section, options);
  return outside;
}

Shell strip_shell(const StripJob& job, const std::optional<BentStrips>& bent, const FlatsJob* flats,
                  const std::vector<double>& joints, const std::vector<UnitWork>& works, Workshop& workshop,
                  TakenUp& taken) {
  Shell shell = empty_shell(job.track, job.options, job.placement, joints, workshop, taken);
  const SectionOutside narrowest = outside_of(job.section, job.options);
  const Span heights = heights_of(narrowest);
  shell.lowest = heights.from;
  shell.highest = job.section.highest;
  shell.ring = job.section.ring;
  shell.whole = all_unfolded(job);
  // Over the thickness of what stands there it is as wide as anywhere.
  const double reach = std::max(job.options.lifting ? job.options.lifting->thickness : 0.0,
                                job.options.stiffeners ? job.options.stiffeners->thickness : 0.0);
  if (bent) {
    for (const Facets& facets : bent->facets())
      add_straights(job.track, facets, {shell.lowest, shell.highest}, shell.straights);
  }
  const std::vector<Straight>& straights = shell.straights;
  shell.outside = [&job, &bent, narrowest, reach, straights](double s) {
    if (!job.widens()) return narrowest;
    const TrackFrame frame = frame_on(straights, job.track, s);
    SectionOutside here = narrowest;
    double wider = 0.0;
    for (const double aside : {-reach, 0.0, reach})
      wider = std::max(wider,
                       bent ? bent->half_at(frame.at + aside * frame.along).wide : job.wider_at(s + aside));
    const double lean = bent ? bent->half_at(frame.at).lean : job.lean_at(s);
    for (PathVertex& vertex : here.line.vertices) vertex.at = job.at(vertex.at, wider, lean);
    return here;
  };
  take_frames(shell);
  constexpr double kBoltHead = 15e-3;  // round a bolt of the liner [m]
  const auto take = [&](double from, double to) {
    if (flats != nullptr)
      taken.add(place_of(shell.straights, flats->flats(), from),
                place_of(shell.straights, flats->flats(), to));
    else
      taken.add(from, to);
  };
  for (const UnitWork& work : works) {
    for (const TilePlace& tile : work.tiles) {
      for (const double s : tile.along) take(s - kBoltHead, s + kBoltHead);
    }
    for (const StripWindow& window : work.windows) take(window.lid_along.from, window.lid_along.to);
  }
  return shell;
}

SectionOutside outside_of(const section::Pipe& pipe, std::optional<double> side) {
  const double inner = 0.5 * pipe.inner_diameter;
  const double outer = inner + pipe.thickness;
  const double quarter = -bulge_of_sweep(0.5 * std::numbers::pi);
  SectionOutside outside;
  std::vector<PathVertex>& line = outside.line.vertices;
  if (side) {
    if (*side > 0.0) line.push_back({{outer, inner + *side}, 0.0});
    line.push_back({{outer, inner}, quarter});
    line.push_back({{0.0, inner - outer}, quarter});
    line.push_back({{-outer, inner}, 0.0});
    if (*side > 0.0) line.push_back({{-outer, inner + *side}, 0.0});
    return outside;
  }
  outside.line.closed = true;
  const double aside = outer * std::sqrt(0.5);
  // Clockwise, the outside to the left.
  for (const Vec2 corner :
       {Vec2{-aside, aside}, Vec2{aside, aside}, Vec2{aside, -aside}, Vec2{-aside, -aside}})
    line.push_back({{corner.x, inner + corner.y}, quarter});
  return outside;
}

Shell pipe_shell(const ArcSpline& track, const section::Pipe& pipe, std::optional<double> side,
                 const PlateOptions& options, const Placement& placement, const Facets& facets,
                 const std::vector<double>& joints, Workshop& workshop, TakenUp& taken) {
  Shell shell = empty_shell(track, options, placement, joints, workshop, taken);
  const SectionOutside outside = outside_of(pipe, side);
  const Span heights = heights_of(outside);
  shell.lowest = heights.from;
  shell.highest = heights.to;
  shell.ring = !side;
  shell.outside = [outside](double) { return outside; };
  add_straights(track, facets, heights, shell.straights);
  take_frames(shell);
  return shell;
}

std::vector<Issue> strip_shell_problems(const PlateSection& section, const PlateOptions& options) {
  std::vector<Issue> issues = set_on_problems(options);
  const auto refuse = [&](bool wanted, const char* key, const char* what, const char* why, const char* hint) {
    if (wanted) issues.push_back({key, std::string(key) + ": " + what, why, hint});
  };
  const char* const hollow = "the section is hollow below, or has no upright sides there";
  const char* const round = "They stand along its outside, from top to top.";
  refuse(options.stiffeners && !section.convex, "stiffeners", hollow, round, "another outline, or none");
  refuse(options.lifting && !section.convex, "lifting", hollow, round, "another outline, or none");
  const bool laps_round = section.ring && !outside_of(section, options).laps.empty();
  refuse(options.lifting && laps_round, "lifting", "plates that lap all round the section stand in its way",
         "It is welded to their outside from where that faces half upwards.", "corners: butt, or none");
  if (options.stiffeners && section.convex &&
      !round_laps(outside_of(section, options), options.flanges.gap)) {
    issues.push_back({"stiffeners", "stiffeners: laps of this section leave them no way round",
                      "A side is no longer than what laps over it.", "corners: butt, or a smaller overlap"});
  }
  return issues;
}

}  // namespace glissade::parts
