// The job as a whole: units between joints, their strips, what is set on them, the ride over them.

#include "parts/strips/strips.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "core/plane_geometry.hpp"
#include "parts/bodies/as_built.hpp"
#include "parts/plates/angle_frames.hpp"
#include "parts/plates/plate_checks.hpp"
#include "parts/plates/plate_facts.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/shop/setting_out.hpp"
#include "parts/shop/shop_facts.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/strips/bent_strips.hpp"
#include "parts/strips/flats_line.hpp"
#include "parts/strips/joint_steps.hpp"
#include "parts/strips/strip_fittings.hpp"
#include "parts/strips/strip_frames.hpp"
#include "parts/strips/strip_notes.hpp"
#include "parts/strips/strip_proof.hpp"
#include "parts/strips/strip_shape.hpp"
#include "parts/strips/strip_shell.hpp"
#include "parts/strips/strip_works.hpp"
#include "parts/supports/supports.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

void list_strips(std::vector<Strip>& strips, Workshop& workshop) {
  for (Strip& strip : strips) {
    const std::size_t before = workshop.parts.size();
    const bool floor = strip.part.name.starts_with("floor");
    const int number = add_part(workshop, strip.part, floor ? kFloorColour : kWallColour);
    if (workshop.parts.size() == before) continue;
    for (BendStep step : strip.steps) {
      step.part = number;
      workshop.bends.push_back(step);
    }
  }
}

/// Whether a row of the schedule is a hit of the press: of rolled plates where the width begins or ends to change.
bool is_pressed(const BendStep& step) {
  return step.length == 0.0;
}

/// @throws InputError where the shop does not press as sharply as a rolled plate is folded
void require_folds(const StripJob& job, const std::vector<Strip>& strips) {
  const bool folded = std::any_of(strips.begin(), strips.end(), [](const Strip& strip) {
    return std::any_of(strip.steps.begin(), strip.steps.end(), is_pressed);
  });
  if (!folded) return;
  if (auto issue = too_tight_a_bend(job.section.thickness, job.options)) throw InputError(std::move(*issue));
}

void measure_strips(const std::vector<Strip>& strips, Workshop& workshop) {
  for (const Strip& strip : strips) {
    for (const BendStep& step : strip.steps) {
      if (is_pressed(step)) {
        ShopFacts(workshop).of(strip.part, "bend_radius_thicknesses", step.radius, strip.part.thickness);
        continue;
      }
      if (!std::isfinite(step.radius)) continue;
      measure_rolling(
          std::fabs(step.radius), strip.part,
          strip.part.name + " at " + length_text(strip.span.from + step.distance, 3) + " along the track",
          workshop);
    }
  }
}

AsBuiltRide ride_rolled(const StripJob& job, const std::vector<double>& joints, const Body& body,
                        double gravity, const Motion& design) {
  std::vector<std::shared_ptr<const ArcSpline>> lines;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i)
    lines.push_back(std::make_shared<ArcSpline>(rolled_face(job.track, {joints[i], joints[i + 1]}).line));
  return ride_units(lines, job.options.joint_step, design, body, gravity);
}

/// Strips of a bent job, as they lie along the line of its flats.
std::vector<Strip> on_line(const FlatsJob& flats, std::vector<Strip> strips) {
  for (Strip& strip : strips)
    strip.span = {flats.flats().on_line(strip.span.from), flats.flats().on_line(strip.span.to)};
  return strips;
}

/// Plates of a bent job get their laps, tabs, slots, holes and openings.
void work_bent(const FlatsJob& flats, const std::vector<UnitWork>& works, std::vector<Strip>& strips) {
  std::vector<Span> spans;
  for (const Strip& strip : on_line(flats, strips)) spans.push_back(strip.span);
  work_bent(flats.job(), spans, works, strips);
}

/// The largest bend that costs no more than is allowed.
double kink_of(const StripJob& job, const Body& body, double gravity, double exit_speed) {
  return kink_for_speed(
      job.track, job.options.bend,
      [&](double largest) {
        return bent_flats(job, {0.0, job.track.length()}, largest);
      },
      body, gravity, exit_speed);
}

std::optional<Excess> worst_excess(const SplitOptions& split, const std::vector<Strip>& strips) {
  std::optional<Excess> worst;
  for (const Strip& strip : strips) keep_worse(excess(split, strip.part), "the " + strip.part.name, worst);
  return worst;
}

/// Of plates with nothing cut into them.
std::optional<Excess> excess_of_plain(const StripJob& job, const std::optional<BentStrips>& bent,
                                      const std::vector<double>& joints) {
  if (job.options.floor == FloorMake::bent)
    return bent ? worst_excess(job.options.split, bent->strips()) : std::nullopt;
  PlateOptions options = job.options;
  options.corners = CornerOptions();
  options.liner.reset();
  options.inspection.clear();
  const StripJob plain(job.track, job.section, options, job.placement);
  return worst_excess(options.split, strips_between(plain, joints, works_between(plain, joints)));
}

/// By what works make strips differ from mitred ones.
/// @param flats  of bent ones with works
std::vector<VolumeDifference> cut_from(const StripJob& job, bool bent, const FlatsJob* flats,
                                       const std::vector<Strip>& strips, const std::vector<UnitWork>& works) {
  if (flats != nullptr) return cut_differences(flats->job(), on_line(*flats, strips), works);
  return bent ? std::vector<VolumeDifference>() : cut_differences(job, strips, works);
}

/// Frames, rims, covers, liner, stiffeners, lugs and trestles, each with room for those before.
/// @param flats  of bent plates with works: along its line
void set_on_strips(const StripJob& job, const std::optional<BentStrips>& bent, const FlatsJob* flats,
                   const std::vector<double>& joints, const std::vector<Strip>& strips,
                   const std::vector<UnitWork>& works, Workshop& workshop) {
  PlateOptions framed = job.options;
  // Frames know how bent plates lean beside a width that changes.
  if (!bent || !job.widens()) framed.flanges = frames_that_clear(job, joints, strips);
  add_strip_frames({job.track, job.section, framed, job.placement}, bent, joints, workshop);
  const StripJob& along = flats != nullptr ? flats->job() : job;
  const std::vector<double>& ends = flats != nullptr ? flats->joints() : joints;
  if (bent && !job.options.cover)
    measure_bends(add_bent_rims(job, *bent, workshop), job.options, workshop);
  else
    add_strip_rims(along, ends, workshop);
  add_strip_covers(along, ends, workshop);
  if (job.options.liner) {
    std::vector<TilePlace> tiles;
    for (const UnitWork& work : works) tiles.insert(tiles.end(), work.tiles.begin(), work.tiles.end());
    add_strip_liner(along, tiles, workshop);
  }
  for (const UnitWork& work : works) add_strip_lids(along, work.windows, workshop);
  if (flats != nullptr) schedule_bends(*flats, workshop);
  workshop.setting_out = setting_out(job.track, joints, job.placement);
  TakenUp taken;
  const Shell shell = strip_shell(job, bent, flats, joints, works, workshop, taken);
  add_lugs(shell, add_stiffeners(shell));
  add_supports(shell, workshop.setting_out);
  in_order(workshop.setting_out);
}

}  // namespace

std::vector<Issue> strip_problems(const PlateSection& section, const PlateOptions& options) {
  std::vector<Issue> issues;
  if (section.convex) {
    add_angle_seat_problems({line_of_frames(section.outside, section.ring, options.flanges), section.ring},
                            options, issues);
  }
  if (options.floor == FloorMake::bent) {
    if (too_tight_a_bend(section.thickness, options))
      issues.push_back(*too_tight_a_bend_of_any(section.thickness, options));
  }
  for (const SectionPlate& plate : section.plates) {
    if (dot(plate.back_to - plate.back_from, plate.face_to - plate.face_from) > 0.0) continue;
    issues.push_back({section.inside_outline ? "thickness" : "cross_section.thickness",
                      "thickness: " + length_text(section.thickness) + " leaves nothing of the " +
                          plate.name + ", which is " + length_text(norm(plate.face_to - plate.face_from), 3) +
                          " wide",
                      "Plates meet in mitres there.", "a thinner plate"});
    return issues;
  }
  if (section.inside_outline) {
    const std::size_t count = section.plates.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = i + 1; k < count; ++k) {
        const SectionPlate& a = section.plates[i];
        const SectionPlate& b = section.plates[k];
        const bool next = k == i + 1 || (i == 0 && k + 1 == count);
        const double apart = std::min({core::distance_to_segment(a.face_from, b.face_from, b.face_to),
                                       core::distance_to_segment(a.face_to, b.face_from, b.face_to),
                                       core::distance_to_segment(b.face_from, a.face_from, a.face_to),
                                       core::distance_to_segment(b.face_to, a.face_from, a.face_to)});
        if (next || apart >= 2.0 * section.thickness) continue;
        issues.push_back({"thickness",
                          "thickness: plates of " + length_text(section.thickness) + " inside " + a.name +
                              " and " + b.name + " would meet",
                          "The sides are " + length_text(apart, 3) + " apart.",
                          "thickness: " + length_text(0.45 * apart, 2)});
        return issues;
      }
    }
  }
  return issues;
}

WorkshopBuild make_strips(const ArcSpline& track, const PlateSection& section, const PlateOptions& options,
                          const Placement& placement, const Body& body, double gravity,
                          const Motion& design) {
  const StripJob job(track, section, options, placement);
  std::vector<Strip> strips;
  std::vector<UnitWork> works;
  std::optional<BentStrips> bent;
  std::unique_ptr<FlatsJob> flats;
  WorkshopBuild build;
  const double kink =
      options.floor == FloorMake::bent ? kink_of(job, body, gravity, design.exit_speed()) : 1.0;
  split_until_it_fits(options.split, track.length(), [&](std::size_t count) -> std::optional<Excess> {
    build.joints = joints_of(track, options.split, count);
    try {
      if (options.floor == FloorMake::bent) {
        bent.emplace(job, kink, build.joints);
        strips = bent->strips();
        if (has_works(options)) {
          flats = std::make_unique<FlatsJob>(job, *bent, build.joints);
          works = works_between(flats->job(), flats->joints());
          work_bent(*flats, works, strips);
        }
      } else {
        works = works_between(job, build.joints);
        strips = strips_between(job, build.joints, works);
      }
    } catch (const InputError&) {
      // What finds no place between these joints may between those of more units.
      auto found = excess_of_plain(job, bent, build.joints);
      if (!found || !options.split.allowed) throw;
      return found;
    }
    return worst_excess(options.split, strips);
  });
  require_units_longer(track, build.joints, options, section.lowest, section.highest);
  // Usual frames get the gap that they need (frames_that_clear()).
  if (!bent && section.convex && options.flanges != FlangeOptions()) {
    require_frame_room(track, build.joints, options.flanges, section.lowest,
                       section.ring ? std::optional(section.highest) : std::nullopt);
  }
  if (!bent) require_folds(job, strips);
  Workshop& workshop = build.workshop;
  list_strips(strips, workshop);
  set_on_strips(job, bent, flats.get(), build.joints, strips, works, workshop);
  build.ride = bent ? as_told(ride_facets(bent->facets(), body, gravity, options.joint_step), design,
                              bent->bends(), build.joints.size() - 2)
                    : ride_rolled(job, build.joints, body, gravity, design);
  measure_plates(options, workshop);
  if (bent)
    measure_bends(strips, options, workshop);
  else
    measure_strips(strips, workshop);
  measure_tabs(job, build.joints, works, workshop);
  measure_steps(section_places(job, build.joints), options, build);
  const std::vector<VolumeDifference> cut = cut_from(job, bent.has_value(), flats.get(), strips, works);
  build.proof = prove_strips(job, bent, strips, build.joints, cut, workshop);
  add_strip_notes(job, bent, build.proof, strips, workshop);
  if (bent) {
    tell_missed_speed(options.bend, bent->facets(), least_bent_flat(job), ", or floor: rolled", body, gravity,
                      design.exit_speed(), workshop);
  }
  if (!cut.empty()) note_differences(build.proof, "mitred plates", workshop);
  return build;
}

}  // namespace glissade::parts
