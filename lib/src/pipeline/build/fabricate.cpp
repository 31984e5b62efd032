// Parts of a design's track, by the process that it asks for.

#include "pipeline/build/fabricate.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/parts/prints.hpp"
#include "glissade/parts/timber.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/shop_rules.hpp"

#include "parts/shop/shop_facts.hpp"
#include "pipeline/build/hood_parts.hpp"
#include "pipeline/build/parts_clearance.hpp"
#include "pipeline/build/workshop_files.hpp"
#include "pipeline/task/body.hpp"
#include "pipeline/task/located.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace glissade::pipeline {
namespace {

/// Calls `make`; what it throws has keys below `fabrication` for places, and gets those of the file.
template <typename Make>
auto at_keys(const Design& design, Make&& make) {
  try {
    return at_place(design.where("fabrication"), std::forward<Make>(make));
  } catch (const InputError& error) {
    std::vector<Issue> issues = error.issues();
    for (Issue& issue : issues) {
      if (issue.where.find(':') == std::string::npos)
        issue.where = design.where("fabrication." + issue.where);
    }
    throw InputError(std::move(issues));
  }
}

/// A ground line in the plane of the track: horizontal distance from the start, height above it.
std::vector<Vec2> in_plane(const TrackDesign& track, const std::vector<Vec2>& ground) {
  if (ground.size() == 1) return {{0.0, ground.front().y - track.start.z}};
  std::vector<Vec2> line;
  for (const Vec2 point : ground) {
    const Vec2 plane = in_track_plane(track, point);
    line.push_back({plane.x, -plane.y});
  }
  if (line.size() > 1 && line.front().x > line.back().x) std::reverse(line.begin(), line.end());
  return line;
}

/// How closely arcs follow the track, and which of its own they keep.
MasterCurveOptions arcs_of(const Design& design, const Track& track) {
  return {design.fabrication->arc_tolerance, FitSide::both, track.search.has_value()};
}

/// What a liner is asked for that only a stream can tell.
void tell_wear(const Design& design, const Track& track, PlateOptions& options) {
  if (!options.liner) return;
  LinerOptions& liner = *options.liner;
  if (liner.tonnage) liner.life = *liner.tonnage / design.stream.value().mass_flow;
  if (liner.where == LinerPlaces::worn || liner.life) options.floor_wear = floor_wear(design, track);
}

WorkshopBuild make(const Design& design, const Track& track, const Placement& frame, PlateOptions options,
                   const std::stop_token&) {
  tell_wear(design, track, options);
  if (options.supports) options.supports->ground = in_plane(design.track, options.supports->ground);
  WorkshopBuild build = make_plates(*track.centerline, *design.cross_section, arcs_of(design, track), options,
                                    frame, body_of(design), design.gravity);
  if (design.hood && options.hood) add_hood_parts(design, track, frame, options, build);
  return build;
}

WorkshopBuild make(const Design& design, const Track& track, const Placement& frame, PrintOptions options,
                   const std::stop_token& stop) {
  if (options.stands && !options.stands->ground.empty())
    options.stands->ground = in_plane(design.track, options.stands->ground);
  return make_prints(*track.centerline, CrossSection(*design.cross_section), arcs_of(design, track), options,
                     design.mesh.tolerance, frame, body_of(design), design.gravity, stop);
}

WorkshopBuild make(const Design& design, const Track& track, const Placement& frame, TimberOptions options,
                   const std::stop_token&) {
  if (options.legs) options.legs->ground = in_plane(design.track, options.legs->ground);
  return make_timber(*track.centerline, *design.cross_section, arcs_of(design, track), options, frame,
                     body_of(design), design.gravity);
}

/// What rules of the shop may ask of parts that stand out of the channel, beside what the design keeps clear of.
void measure_clearances(const Design& design, const Placement& frame, Workshop& workshop) {
  parts::ShopFacts facts(workshop);
  for (const PartApproach& near : closest_parts(design, frame, workshop)) {
    const std::string where = near.name + " (part " + std::to_string(near.part) + "), " + near.limit + ": " +
                              length_text(near.reached) + " of " + length_text(near.asked) + ", " +
                              length_text(near.point.x) + " out and " + length_text(near.point.y) +
                              " below the start";
    facts.at(where, "part_clearance_margin", near.reached - near.asked + design.fabrication->arc_tolerance);
  }
}

}  // namespace

namespace {

/// A body that does not arrive on the floor as it is made, although it does on the track of the design.
void tell_of_ride(WorkshopBuild& build) {
  if (build.ride.arrives) return;
  build.workshop.shortfalls.push_back(
      {"", "the body does not arrive on the floor as it is built: " + build.ride.stopped,
       "It arrives on the track as it is designed; arcs, bends and joints in its place take more.",
       "a limit lowest_normal_load above 0, which keeps it on arcs, or one on speed or slope, which keeps it "
       "moving"});
}

/// Gives what is not made as it was asked for its place in the file.
void locate(const Design& design, std::vector<Issue>& shortfalls) {
  for (Issue& issue : shortfalls)
    issue.where = design.where(issue.where.empty() ? "fabrication" : "fabrication." + issue.where);
}

}  // namespace

std::shared_ptr<const WorkshopBuild> fabricate(const Design& design, const Track& track,
                                               const Placement& frame, const std::stop_token& stop) {
  WorkshopBuild build = at_keys(design, [&] {
    return std::visit([&](const auto& options) { return make(design, track, frame, options, stop); },
                      design.fabrication->process);
  });
  build.workshop.name = design.name;
  const auto* const plate = std::get_if<PlateOptions>(&design.fabrication->process);
  if (design.hood && (plate == nullptr || !plate->hood))
    build.workshop.notes.emplace_back("The hood is a solid alone: these are the parts of the track.");
  tell_of_ride(build);
  locate(design, build.workshop.shortfalls);
  measure_clearances(design, frame, build.workshop);
  build.workshop.checks = judge_shop(design.fabrication->rules.in_force, build.workshop);
  // Parts lie in the frame of the mesh files, what is set out on site in that of the site.
  const Vec3 offset = track.placement.start() - frame.start();
  for (SettingOutPoint& point : build.workshop.setting_out) point.site = point.site + offset;
  name_part_files(design, build.workshop);
  at_keys(design, [&] { lay_on_sheets(design, build); });
  count_templates(design, build);
  return std::make_shared<const WorkshopBuild>(std::move(build));
}

}  // namespace glissade::pipeline

namespace glissade {

std::vector<Issue> warnings(const Design& design, const Track& track, const WorkshopBuild* made) {
  std::vector<Issue> found = warnings(design, track);
  if (made == nullptr) return found;
  const std::vector<Issue>& shortfalls = made->workshop.shortfalls;
  found.insert(found.end(), shortfalls.begin(), shortfalls.end());
  return found;
}

}  // namespace glissade
