// A channel as plates: units between joints, parts of each, equal parts under one number, frames at the ends, lists,
// checks and proof.

#include "glissade/parts/plates.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/counted.hpp"
#include "parts/bodies/as_built.hpp"
#include "parts/plates/angle_frames.hpp"
#include "parts/plates/channel_shell.hpp"
#include "parts/plates/channel_strips.hpp"
#include "parts/plates/corners.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/plate_checks.hpp"
#include "parts/plates/plate_facts.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_proof.hpp"
#include "parts/plates/seams.hpp"
#include "parts/plates/section_corners.hpp"
#include "parts/plates/shell.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/setting_out.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/strips/joint_steps.hpp"
#include "parts/strips/section_seams.hpp"
#include "parts/strips/strip_fittings.hpp"
#include "parts/strips/strip_openings.hpp"
#include "parts/strips/strip_shape.hpp"
#include "parts/strips/strip_shell.hpp"
#include "parts/strips/strips.hpp"
#include "parts/supports/supports.hpp"
#include "parts/tubes/mitred_pipe.hpp"
#include "parts/tubes/tube_openings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

namespace glissade {

using namespace parts;

namespace {

void add_units(const Job& job, const std::vector<Unit>& units, Workshop& workshop) {
  const auto suffix = [&](std::size_t i) { return units.size() > 1 ? "_" + std::to_string(i + 1) : ""; };
  double seams = 0.0;
  for (std::size_t i = 0; i < units.size(); ++i) {
    seams += seam_length(job, units[i], i);
    for (ShopPart& floor : floor_strips(job, units[i], i)) {
      floor.name += suffix(i);
      const std::size_t before = workshop.parts.size();
      const int number = add_part(workshop, std::move(floor), kFloorColour);
      if (workshop.parts.size() == before) continue;  // as another one: its schedule stands already
      for (BendStep step : units[i].steps) {
        step.part = number;
        workshop.bends.push_back(step);
      }
    }
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    for (WallStrip& wall : wall_strips(job, units[i], i)) {
      wall.part.name += suffix(i);
      add_part(workshop, std::move(wall.part), kWallColour);
    }
  }
  note_seams(seams, workshop);
}

void add_angle_frames(const Job& job, Workshop& workshop, const std::vector<double>& joints) {
  const AngleSeat seat = channel_seat(job.channel, job.options);
  std::size_t bolts = 0;
  for (const FlangeSide side : {FlangeSide::upstream, FlangeSide::downstream}) {
    const std::size_t first = side == FlangeSide::upstream ? 1 : 0;
    std::vector<Frame> places;
    for (std::size_t i = first; i + 1 < joints.size() + first; ++i)
      places.push_back(frame_place(job, joints[i], true));
    AngleFrame frame = angle_frame(seat, job.options, side, places);
    bolts = frame.bolts;
    add_angle_frame(frame, side, job.options, workshop);
  }
  add_joint_bolts(workshop, job.options.flanges, bolts * (joints.size() - 2), joints.size() - 2);
}

void add_frames(const Job& job, Workshop& workshop, const std::vector<double>& joints) {
  if (!job.options.flanges.wanted) return;
  if (job.options.flanges.section == FlangeSection::angle) return add_angle_frames(job, workshop, joints);
  std::vector<Frame> upstream;    // at the upstream end of each unit
  std::vector<Frame> downstream;  // at its downstream end
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    upstream.push_back(frame_place(job, joints[i], true));
    downstream.push_back(frame_place(job, joints[i + 1], false));
  }
  std::size_t bolts = 0;
  for (const FlangeSide side : {FlangeSide::upstream, FlangeSide::downstream}) {
    // Upstream of a joint is the downstream end of a unit.
    const bool before = side == FlangeSide::upstream;
    const ShopPart frame = frame_plate(job, side, before ? downstream : upstream);
    bolts = std::max(frame.pattern->region.holes.size(), frame.pattern->region.cutouts.size());
    const ArcPath line = frame_line(job, job.options.flanges.width, job.channel.wall_height);
    measure_bolt_row(bolts_in_order(frame, line), line.closed, workshop);
    add_in_pieces(frame, line, !before, job.options, kFrameColour, workshop);
  }
  add_joint_bolts(workshop, job.options.flanges, bolts * (joints.size() - 2), joints.size() - 2);
}

/// What is set on the channel, in the order in which each leaves room for the next.
void add_fittings(const Job& job, const std::vector<Unit>& units, Workshop& workshop) {
  TakenUp below;
  const double frame = job.options.flanges.wanted ? job.options.flanges.along() : 0.0;
  for (const Unit& unit : units) {
    below.add(unit.span.from, unit.span.from + frame);
    below.add(unit.span.to - frame, unit.span.to);
  }
  const Fitting fitting{job, units, workshop, below};
  add_liner(fitting);
  add_rims(fitting);
  add_openings(fitting);
  add_channel_stiffeners(fitting);
  add_covers(fitting);
  const Shell shell = channel_shell(job, units, workshop, below);
  if (job.channel.wall_height > 0.0)
    add_channel_lugs(fitting);
  else
    add_lugs(shell, {});
  // What is lifted stands on none of them.
  add_supports(shell, workshop.setting_out);
  in_order(workshop.setting_out);
}

void add_corner_note(const Job& job, Workshop& workshop) {
  if (overlap(job) == 0.0) return;
  const bool beside = job.options.walls == WallSeat::beside_floor;
  std::string note = beside ? "Walls reach " : "The floor reaches ";
  note +=
      length_text(overlap(job)) + (beside ? " below the floor" : " beyond the walls") + ", frames excepted";
  if (has_tabs(job)) {
    const CornerOptions& corners = job.options.corners;
    note += std::string("; tabs of the ") + (beside ? "floor" : "walls") + ", " + length_text(corners.tab) +
            " wide, stand in slots that are " + length_text(corners.clearance) + " larger both ways";
  }
  workshop.notes.push_back(note + ".");
}

/// Tiles are bent as the floor is, and walls on a bent floor follow its flats: such channels are made of strips.
bool follows_flats(const ChannelMeasures& channel, const PlateOptions& options) {
  const bool curbs = channel.wall_height > 0.0 && channel.wall_thickness > 0.0;
  const bool on_floor = channel.wall_height > 0.0 && options.walls == WallSeat::on_floor;
  return options.floor == FloorMake::bent && !curbs && (options.liner || on_floor);
}

/// The options without what a channel's own plates do not have.
PlateOptions of_smooth_walls(PlateOptions options) {
  options.liner.reset();
  options.walls = WallSeat::beside_floor;
  return options;
}

section::Measures section_of(const ChannelMeasures& channel) {
  if (channel.wall_height > 0.0)
    return section::UChannel{WidthLaw(channel.width), channel.wall_height, channel.thickness};
  return section::Slab{WidthLaw(channel.width), channel.thickness};
}

/// What no shop can make of a section as strips, whatever the track is.
std::vector<Issue> section_problems(const PlateSection& section, const PlateOptions& options) {
  std::vector<Issue> issues;
  for (const auto& problems : {strip_problems, section_corner_problems, section_fitting_problems,
                               strip_shell_problems, strip_opening_problems}) {
    for (Issue& issue : problems(section, options)) issues.push_back(std::move(issue));
  }
  return issues;
}

AsBuiltRide ride_as_built(const Job& job, const std::vector<Unit>& units, const Motion& design,
                          const Body& body, double gravity) {
  if (job.options.floor == FloorMake::bent) {
    std::vector<Facets> facets;
    std::size_t bends = 0;
    for (const Unit& unit : units) {
      facets.push_back(*unit.face.facets);
      bends += unit.face.facets->bends();
    }
    return as_told(ride_facets(facets, body, gravity, job.options.joint_step), design, bends,
                   units.size() - 1);
  }
  std::vector<std::shared_ptr<const ArcSpline>> lines;
  // On the liner where there is one.
  for (const Unit& unit : units)
    lines.push_back(std::make_shared<ArcSpline>(rolled_face(job.track, unit.span).line));
  return ride_units(lines, job.options.joint_step, design, body, gravity);
}

}  // namespace

double k_factor(double inner_radius, double thickness) {
  const double ratio = inner_radius / thickness;
  const double factor = 0.325 + 0.25 * math::log(ratio) / std::numbers::ln10;
  return std::clamp(factor, 0.0, 0.5);
}

namespace {

/// Of a bent floor that costs more speed than is asked for.
void tell_missed_bends(const Job& job, const std::vector<Unit>& units, const Motion& design, const Body& body,
                       double gravity, Workshop& workshop) {
  if (job.options.floor != FloorMake::bent) return;
  std::vector<Facets> facets;
  for (const Unit& unit : units) facets.push_back(*unit.face.facets);
  tell_missed_speed(job.options.bend, facets, least_flat(job.channel.thickness, job.options, 0.0),
                    ", or floor: rolled", body, gravity, design.exit_speed(), workshop);
}

WorkshopBuild make_channel(const Centerline& track, const ChannelMeasures& channel,
                           const MasterCurveOptions& fit, const PlateOptions& options,
                           const Placement& placement, const Body& body, double gravity) {
  WorkshopBuild build;
  build.master = fit_arcs(track, fit);
  const Job job{*build.master.spline, channel, options, placement};
  const Motion smooth(CenterlinePtr(CenterlinePtr(), &track), body,
                      gravity);  // of the design, which outlives it
  const double kink = options.floor == FloorMake::bent
                          ? kink_for_speed(
                                job.track, options.bend,
                                [&](double largest) {
                                  return facets_of(job, {0.0, job.track.length()}, largest);
                                },
                                body, gravity, smooth.exit_speed())
                          : 1.0;
  std::vector<Unit> units = split_units(job, kink);
  drill_floors(job, units);
  build.joints.push_back(0.0);
  for (const Unit& unit : units) build.joints.push_back(unit.span.to);
  require_units_longer(job.track, build.joints, options, -floor_depth(job) - channel.thickness,
                       channel.wall_height);
  if (options.floor == FloorMake::rolled)
    require_frame_room(job.track, build.joints, options.flanges, -floor_depth(job) - channel.thickness,
                       std::nullopt);
  Workshop& workshop = build.workshop;
  add_units(job, units, workshop);
  add_frames(job, workshop, build.joints);
  workshop.setting_out = setting_out(job.track, build.joints, placement);
  add_fittings(job, units, workshop);
  build.ride = ride_as_built(job, units, smooth, body, gravity);
  measure_plates(options, workshop);
  measure_floor(job, units, workshop);
  measure_corners(job, units, workshop);
  measure_steps(channel_places(job, build.joints), options, build);
  build.proof = prove(job, units, workshop);
  add_corner_note(job, workshop);
  note_differences(build.proof, "the plain channel", workshop);
  tell_missed_bends(job, units, smooth, body, gravity, workshop);
  return build;
}

}  // namespace

std::optional<ChannelMeasures> channel_of(const section::Measures& measures) {
  if (const auto* const channel = std::get_if<section::UChannel>(&measures)) {
    if (!channel->width.is_constant()) return std::nullopt;
    return ChannelMeasures{channel->width.narrowest(), channel->wall_height, channel->thickness};
  }
  if (const auto* const slab = std::get_if<section::Slab>(&measures)) {
    if (!slab->width.is_constant()) return std::nullopt;
    return ChannelMeasures{slab->width.narrowest(), slab->curb_height, slab->thickness, slab->curb_width};
  }
  return std::nullopt;
}

namespace {

/// A round section that becomes mitred tubes or troughs: the pipe, or the one of which it is half.
struct MitredRound {
  section::Pipe pipe;
  std::optional<double> side;  ///< of half a one [m]
};

std::optional<MitredRound> mitred_round(const section::Measures& measures, const PlateOptions& options) {
  if (options.round == RoundMake::staves) return std::nullopt;
  // What staves alone can have.
  std::optional<MitredRound> round;
  if (const auto* const pipe = std::get_if<section::Pipe>(&measures)) round = {*pipe, std::nullopt};
  if (const auto* const half = std::get_if<section::HalfPipe>(&measures))
    round = {{half->width, half->thickness}, half->wall_height};
  if (!round) return std::nullopt;
  const bool opened = tube_opening_problems(round->pipe, round->side, options).empty();
  const bool staves = options.liner || options.cover || (!options.inspection.empty() && !opened) ||
                      options.corners.kind != CornerJoint::butt ||
                      (options.rim && std::holds_alternative<section::Pipe>(measures));
  if (staves && options.round == RoundMake::as_fits) return std::nullopt;
  return round;
}

/// Mitred tubes or troughs of what is round; strips of everything else, and of what is round and does not go mitred.
WorkshopBuild make_round_or_strips(const ArcSpline& track, const section::Measures& measures,
                                   const PlateOptions& options, const Placement& placement, const Body& body,
                                   double gravity, const Motion& design) {
  const auto strips = [&] {
    const PlateSection whole = *plate_section(measures, options);
    // What a width that changes forbids, seams or none, is told first.
    if (whole.widths) (void)StripJob(track, whole, options, placement);
    const PlateSection section = with_seams(whole, options);
    return make_strips(track, section, options, placement, body, gravity, design);
  };
  const auto round = mitred_round(measures, options);
  if (!round) return strips();
  try {
    return make_mitred_pipe(track, round->pipe, round->side, options, placement, body, gravity, design);
  } catch (const InputError& error) {
    // Another pitch is the way out, not another make; or nor do staves go with what is asked for.
    if (options.round == RoundMake::mitred || error.issues().front().where == "flanges.pitch" ||
        !section_problems(*plate_section(measures, options), options).empty())
      throw;
    WorkshopBuild build = strips();
    build.workshop.notes.push_back(
        "Staves along the track, since it does not go mitred: " + error.issues().front().what + ".");
    return build;
  }
}

/// Of the usual frames and narrower ones the widest that fits; none where none does.
FlangeOptions fitted_flanges(const ChannelMeasures& channel, const PlateOptions& options) {
  constexpr std::array<FlangeOptions, 5> kFrames = {
      FlangeOptions(), FlangeOptions{true, 40e-3, 6e-3, 8, 120e-3},
      FlangeOptions{true, 30e-3, 5e-3, 6, 100e-3}, FlangeOptions{true, 20e-3, 4e-3, 5, 80e-3},
      FlangeOptions{true, 14e-3, 3e-3, 5, 60e-3}};
  for (const FlangeOptions& frame : kFrames) {
    PlateOptions with = of_smooth_walls(options);
    with.flanges = frame;
    const std::vector<Issue> issues = plate_problems(channel, with);
    const bool fits = std::none_of(issues.begin(), issues.end(),
                                   [](const Issue& issue) { return issue.where.starts_with("flanges."); });
    if (fits) return frame;
  }
  FlangeOptions none;
  none.wanted = false;
  return none;
}

/// Says which frames there are beside low walls, or that there are none.
void tell_frames(const FlangeOptions& frame, const ChannelMeasures& channel, Workshop& workshop) {
  const std::string walls = "walls of " + length_text(channel.wall_height, 3);
  if (frame.wanted) {
    workshop.notes.push_back("Frames are " + length_text(frame.width) + " wide, with M" +
                             std::to_string(frame.bolt) + ": the usual ones find no room beside " + walls +
                             ".");
    return;
  }
  add_shortfall({"flanges", "flanges: no frames at the ends of units, which are to be welded",
                 "None finds room beside " + walls + ": the narrowest are 14 mm wide, with M5.",
                 "flanges: none if that is meant, or higher walls"},
                workshop);
}

/// The thickest usual plate of which something is left between the mitres of every side.
std::optional<double> fitted_thickness(const section::Measures& measures, PlateOptions options) {
  constexpr std::array<double, 9> kStock = {4e-3, 3e-3, 2.5e-3, 2e-3, 1.5e-3, 1.2e-3, 1e-3, 0.8e-3, 0.5e-3};
  for (const double thickness : kStock) {
    options.polygon_thickness = thickness;
    const auto section = plate_section(measures, options);
    if (section && strip_problems(*section, options).empty()) return thickness;
  }
  return std::nullopt;
}

std::vector<Issue> width_changes() {
  return {{"cross_section.width",
           "fabrication: plates of curbs or a groove beside a width that changes are not made",
           "Widths change in plates of a u-channel, a trapezoid and a slab without curbs.",
           "one width, or another kind of cross_section"}};
}

}  // namespace

PlateOptions fitted(const section::Measures& measures, PlateOptions options) {
  const auto channel = channel_of(measures);
  if (options.flanges == FlangeOptions() && channel) options.flanges = fitted_flanges(*channel, options);
  if (!options.polygon_thickness && !channel) options.polygon_thickness = fitted_thickness(measures, options);
  return options;
}

std::vector<Issue> plate_problems(const section::Measures& measures, const PlateOptions& told) {
  const PlateOptions options = fitted(measures, told);
  if (const auto channel = channel_of(measures)) {
    std::vector<Issue> issues = plate_problems(*channel, options);
    // Of a cross-section that is no good itself, its own check tells.
    std::erase_if(issues,
                  [](const Issue& issue) { return issue.where == "width" || issue.where == "thickness"; });
    return issues;
  }
  std::vector<Issue> issues = common_problems(options);
  if (!issues.empty()) return issues;
  if (const auto round = mitred_round(measures, options))
    return mitred_problems(round->pipe, round->side, options);
  const auto section = plate_section(measures, options);
  if (!section) return width_changes();
  return section_problems(*section, options);
}

std::vector<Issue> plate_problems(const ChannelMeasures& channel, const PlateOptions& options) {
  if (!follows_flats(channel, options)) return channel_problems(channel, options);
  std::vector<Issue> issues = channel_problems(channel, of_smooth_walls(options));
  for (Issue& issue : issues) {
    if (issue.where == "bend.inner_radius") issue = *too_tight_a_bend_of_any(channel.thickness, options);
  }
  if (!issues.empty()) return issues;
  return section_problems(*plate_section(section_of(channel), options), options);
}

namespace {

/// Of parts that are not cut.
void require_light(const Workshop& workshop, const SplitOptions& split) {
  const ShopPart* worst = nullptr;
  for (const ShopPart& part : workshop.parts) {
    if (is_too_heavy(part, split) && (worst == nullptr || part.mass > worst->mass)) worst = &part;
  }
  if (worst != nullptr) throw_too_heavy(*worst, *split.heaviest, worst->mass, "It is made in one piece.");
}

/// Of plates that the sheet takes only across, units may be too short for something: then they are strips along it.
/// @param widest  of the plates, about [m]
WorkshopBuild across_or_lengthwise(double widest, const PlateOptions& options,
                                   const std::function<WorkshopBuild(const PlateOptions&)>& make) {
  try {
    return make(options);
  } catch (const InputError&) {
    constexpr double kLess = 0.8;  // budget: of the sheet's shorter side, from which strips are tried
    if (!options.split.allowed || widest < kLess * options.split.stock().room().y) throw;
    // As wide as straight ones may be, then as curved ones.
    for (const double share : {1.0, kCurvedOfSheet}) {
      PlateOptions strips = options;
      const double most = share * options.split.stock().room().y;
      if (options.split.widest && *options.split.widest <= most) continue;  // has been tried
      strips.split.widest = most;
      try {
        return make(strips);
      } catch (const InputError&) {
        continue;  // what the first try says is nearer to what was asked for
      }
    }
    throw;
  }
}

/// Of a channel's plates, about.
double widest_of(const ChannelMeasures& channel, const PlateOptions& options) {
  const double lap = options.corners.kind == CornerJoint::butt ? 0.0 : options.corners.overlap;
  return std::max(channel.width, channel.wall_height) + 2.0 * (channel.wall() + lap);
}

/// Of a section's, about; 0 where there are none, or tubes and troughs alone.
double widest_of(const section::Measures& measures, const PlateOptions& options) {
  if (options.round == RoundMake::mitred && mitred_round(measures, options)) return 0.0;
  const auto section = plate_section(measures, options);
  if (!section) return 0.0;
  double widest = 0.0;
  for (const SectionPlate& plate : section->plates)
    widest = std::max(widest, norm(plate.face_to - plate.face_from));
  return section->widths ? widest + section->widths->widest() - section->widths->narrowest() : widest;
}

/// Says how units are joined where no frames are.
void note_welded_joints(const PlateOptions& options, WorkshopBuild& build) {
  if (options.flanges.wanted || build.joints.size() < 3) return;
  build.workshop.notes.push_back("Without frames units are welded end to end, all round: " +
                                 core::counted(build.joints.size() - 2, "joint") + ".");
}

WorkshopBuild make_section(const Centerline& track, const section::Measures& measures,
                           const MasterCurveOptions& fit, const PlateOptions& options,
                           const Placement& placement, const Body& body, double gravity) {
  MasterCurve master = fit_arcs(track, fit);
  const Motion smooth(CenterlinePtr(CenterlinePtr(), &track), body, gravity);
  WorkshopBuild build =
      across_or_lengthwise(widest_of(measures, options), options, [&](const PlateOptions& with) {
        return make_round_or_strips(*master.spline, measures, with, placement, body, gravity, smooth);
      });
  build.master = std::move(master);
  require_light(build.workshop, options.split);
  note_welded_joints(options, build);
  return build;
}

}  // namespace

WorkshopBuild make_plates(const Centerline& track, const ChannelMeasures& channel,
                          const MasterCurveOptions& fit, const PlateOptions& options,
                          const Placement& placement, const Body& body, double gravity) {
  std::vector<Issue> problems = plate_problems(channel, options);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (follows_flats(channel, options))
    return make_section(track, section_of(channel), fit, options, placement, body, gravity);
  WorkshopBuild build =
      across_or_lengthwise(widest_of(channel, options), options, [&](const PlateOptions& with) {
        return make_channel(track, channel, fit, with, placement, body, gravity);
      });
  require_light(build.workshop, options.split);
  note_welded_joints(options, build);
  return build;
}

WorkshopBuild make_plates(const Centerline& track, const section::Measures& measures,
                          const MasterCurveOptions& fit, const PlateOptions& told, const Placement& placement,
                          const Body& body, double gravity) {
  const PlateOptions options = fitted(measures, told);
  std::vector<Issue> problems = plate_problems(measures, options);
  if (!problems.empty()) throw InputError(std::move(problems));
  if (const auto channel = channel_of(measures)) {
    WorkshopBuild build = make_plates(track, *channel, fit, options, placement, body, gravity);
    if (options.flanges != told.flanges) tell_frames(options.flanges, *channel, build.workshop);
    return build;
  }
  return make_section(track, measures, fit, options, placement, body, gravity);
}

}  // namespace glissade
