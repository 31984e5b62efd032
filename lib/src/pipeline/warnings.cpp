// What a user should hear of beside the answer.

#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/materials.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline/solve.hpp"
#include "glissade/section/measures.hpp"
#include "glissade/solid/sweep.hpp"
#include "glissade/trades/chute/ends.hpp"

#include "pipeline/ride/probes.hpp"
#include "pipeline/task/cross_section.hpp"
#include "pipeline/task/friction_range.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace glissade {

using namespace pipeline;

namespace {

/// A lowest speed that begins to hold behind the end of the track asks for nothing.
std::optional<Issue> never_applies(const Design& design, const Track& track) {
  if (!design.limits || !design.limits->speed.lowest) return {};
  const double from = design.limits->lowest_speed_from;
  const double length = track.centerline->length();
  if (from < length) return {};
  const auto [start, end] = texts_apart(from, length, &length_text);
  return Issue{
      design.where("limits.speed.lowest_from"),
      "speed.lowest holds from " + start + " on, but the track ends after " + end + ": it never applies",
      "lowest_from is an arc length from the start.", "a place before the end, or exit_speed: {lowest: ...}"};
}

/// What the design says of places of the track that there are none of: they change nothing.
void add_places_beyond(const Design& design, const Track& track, std::vector<Issue>& found) {
  const double length = track.centerline->length();
  const auto tell = [&](const std::string& where, double at, const std::string& what) {
    if (!(at > length)) return;
    const auto [place, end] = texts_apart(at, length, &length_text);
    found.push_back({design.where(where), what + " at " + place + ", but the track ends after " + end,
                     "Places are arc lengths from the start.", "a place on the track"});
  };
  if (design.cross_section) {
    const std::optional<WidthLaw> law = section::width_law(*design.cross_section);
    for (const WidthAt& knot : law ? law->knots() : std::vector<WidthAt>{})
      tell("cross_section.width", knot.at, "a width is given");
    // One width holds everywhere, wherever it was said.
    if (law && law->knots().size() == 1)
      tell("cross_section.width", law->last_place(), "the only width is given");
  }
  for (const FrictionFrom& change : design.body.friction_changes)
    tell("body.friction", change.from, "friction changes");
}

/// Lines to stay above or below that leave out most of the track: they may be drawn in another unit, or elsewhere.
void add_lines_beside(const Design& design, const Track& track, std::vector<Issue>& found) {
  constexpr std::size_t kSurvey = 5;  // taste: a line of fewer points may be an obstacle's top
  constexpr double kMost = 0.5;       // taste: of the run
  const double whole = track.centerline->endpoints().run;
  if (!design.limits || !(whole > 0.0)) return;
  TrackDesign placed = design.track;
  placed.start = track.placement.start();
  const auto look = [&](const std::vector<Profile>& lines, const std::string& key) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double one = in_track_plane(placed, lines[i].line.front()).x;
      const double other = in_track_plane(placed, lines[i].line.back()).x;
      const double covered = std::min(std::max(one, other), whole) - std::max(std::min(one, other), 0.0);
      const bool is_survey = lines[i].line.size() >= kSurvey;
      if (covered > (is_survey ? kMost * whole : 0.0)) continue;
      found.push_back({design.where("limits." + key + "." + std::to_string(i)),
                       key + "[" + std::to_string(i) + "] covers " +
                           length_text(covered > 0.0 ? covered : 0.0, 3) + " of the " +
                           length_text(whole, 4) + " that the track runs",
                       "Nothing is asked for where a line has no points.",
                       "the unit and the columns of its points, or a line from start to finish"});
    }
  };
  look(design.limits->stay_above, "stay_above");
  look(design.limits->stay_below, "stay_below");
}

/// Points whose shape the fitted curve passes over.
std::optional<Issue> passed_over(const Design& design, const Track& track) {
  const auto* const profile = dynamic_cast<const FittedProfile*>(track.centerline.get());
  if (profile == nullptr) return {};
  const bool missed = profile->leaves_out_much() || profile->leaves_pattern();
  if (!missed && profile->leaves_gaps()) {
    return Issue{
        design.where("centerline"),
        "between the points the curve may be off by some " + length_text(profile->between_points(), 1),
        "The points are too few for their bends; speeds and loads are those of the curve.",
        "more points where the profile bends, some 12 to a wave"};
  }
  if (!missed) return {};
  const std::string amount = length_text(profile->rms_deviation(), 3) + " in the root of the mean square";
  const std::string hint =
      "a look at the profile in the report, and a max_deviation if the points are better than that";
  if (profile->leaves_out_much()) {
    return Issue{
        design.where("centerline"),
        "the curve misses the points by " + amount + ", much for the shape of this profile",
        "The points scatter, or they are too few for their bends; speeds and loads are those of the curve.",
        hint};
  }
  return Issue{design.where("centerline"),
               "the curve misses the points by " + amount + ", and neighbours to the same side",
               "Scatter has no such pattern: the points show bends that are not in the curve.", hint};
}

/// One point that the curve misses by far more than the others.
std::optional<Issue> missed_alone(const Design& design, const Track& track) {
  const auto* const profile = dynamic_cast<const FittedProfile*>(track.centerline.get());
  if (profile == nullptr || !profile->farthest_stands_out()) return {};
  const std::size_t index = profile->farthest_point();
  return Issue{design.where("centerline"),
               "the curve misses point " + std::to_string(index + 1) + " of " +
                   std::to_string(profile->points().size()) + ", at " +
                   length_text(profile->deviations()[index].arc_length) + " of the track, by " +
                   length_text(profile->max_deviation(), 2) + ", " +
                   rounded_text(*profile->farthest_stands_out(), 2) + " times as much as the others",
               "One point that lies so far off is mostly a slip, or it alone shows a bend; speeds and loads "
               "are those of the curve.",
               "that point looked at again, and left out if it is a slip"};
}

/// Points whose scatter, or whose number, leaves open how sharply they bend.
std::optional<Issue> radius_open(const Design& design, const Track& track) {
  const auto* const profile = dynamic_cast<const FittedProfile*>(track.centerline.get());
  if (profile == nullptr || !profile->leaves_radius_open()) return {};
  const CurvatureRange range = *profile->largest_curvature();
  constexpr double kMet = 1e-9;  // rounding: of curves through points
  const bool met = profile->rms_deviation() <= kMet * profile->length();
  const std::string why =
      met ? "The curve meets them, but they are few for its bends"
          : "They scatter by " + length_text(profile->rms_deviation(), 2) + " in the root of the mean square";
  return Issue{design.where("centerline"),
               "the points leave the smallest radius open: the curve has " + length_text(track.min_radius) +
                   ", and " + radius_range_text(range) + " would describe them about as well",
               why + "; speeds and loads are those of the curve.",
               "more points where the profile bends most, or more exact ones; the kind segments where its "
               "drawing is known"};
}

/// What the library says of the stream's material, and what nobody measured of it.
void add_material_warnings(const Design& design, std::vector<Issue>& found) {
  if (!design.stream || !design.stream->material) return;
  const MaterialChoice& choice = *design.stream->material;
  const MaterialLibrary& library = shipped_materials();
  const Material* material = library.material(choice.material);
  for (const Material& own : design.materials) {
    if (own.word == choice.material) material = &own;
  }
  if (material == nullptr) return;
  const std::string where = design.where("stream.material");
  for (const std::string& warning : material->warnings)
    found.push_back({where, choice.material, warning, ""});
  const Liner* const known = library.liner(choice.liner);
  const Liner own{choice.liner, choice.liner, ""};
  const auto friction = friction_on(*material, known == nullptr ? own : *known, choice.moisture);
  if (!friction || design.body.friction_given) return;
  for (const std::string& warning : friction->warnings) found.push_back({where, warning, "", ""});
  if (!needs_checking(friction->certainty())) return;
  found.push_back({where,
                   "wall friction of " + choice.material + " on " + choice.liner + ": " +
                       angle_text(friction->low, 3) + " to " + angle_text(friction->high, 3) +
                       " from the library, not measured for this chute",
                   "The least sure of its sources is \"" + std::string(word(friction->certainty())) +
                       "\"; 'glissade materials " + choice.material + "' names them.",
                   "a wall friction test of this material on this liner, as friction_angle below body:"});
}

/// A bend so sharp that nothing is led round it.
std::optional<Issue> kink(const Design& design, const Track& track) {
  constexpr double kLoad = 50.0;  // times gravity: machines and riders end far below
  const MotionState hardest = track.motion.highest_load();
  if (!(hardest.normal_load > kLoad * design.gravity)) return {};
  const std::string load =
      std::isinf(hardest.normal_load)
          ? "has no bound"
          : "reaches " + rounded_text(hardest.normal_load / design.gravity, 3) + " times gravity";
  const bool searched = track.search.has_value();
  return Issue{
      design.where("centerline"),
      "the track has a kink after " + length_text(hardest.arc_length) + ": the normal load " + load,
      "The track bends there with a radius of " + length_text(track.min_radius) +
          ": a body is not led round, it hits it.",
      searched ? "a smallest_radius or a highest_normal_load among the limits" : "a larger radius there"};
}

/// A body that creeps along the track, so that next to no more friction stops it.
std::optional<Issue> all_but_stalls(const Design& design, const Track& track) {
  constexpr Angle kMore = Angle::from_degrees(0.02);  // taste: a tenth of what friction angles are known to
  constexpr Angle kSteepest = Angle::from_degrees(89.9);  // rounding: as stalls_at() has it
  // Of a friction range the highest one, which comes last.
  const Motion& slowest = *track.rides().back().motion;
  if (!slowest.arrived() || !enters(slowest)) return {};
  const Angle friction = slowest.body().friction.angle();
  if (friction + kMore > kSteepest) return {};
  if (!stalls_at(track.centerline, slowest.body(), friction + kMore, slowest.gravity())) return {};
  return Issue{
      design.where("centerline"),
      "a friction angle that is higher by less than " + angle_text(kMore) + " stops the body on this track",
      "It goes on with next to no speed somewhere; no friction is known, or stays, that closely.",
      track.search ? "limits: {lowest_slope_margin: 1 deg}, or a speed: {lowest: ..., lowest_from: ...}"
                   : "a steeper track where the body is slowest"};
}

/// A belt that no stream from that height keeps up with.
std::optional<Issue> belt_too_fast(const Design& design) {
  if (!design.discharge || !design.track.finish_given) return {};
  const DischargeDesign& belt = *design.discharge;
  const double most = speed_of_free_fall(design) * std::max(0.0, math::cos(belt.direction.radians()));
  if (belt.belt_speed <= most || belt.belt_angle.radians() < 0.0) return {};
  return Issue{
      design.where("discharge.belt_speed"),
      "the belt is faster than the stream can be: " + quantity_text(belt.belt_speed, Dimension::speed) +
          ", along it the stream has at most " + quantity_text(most, Dimension::speed),
      "That is the speed of free fall down to the finish; the belt has to bring the stream up to its own.",
      "a slower belt, or a longer drop"};
}

/// A stream that comes to the plane of its belt from below.
std::optional<Issue> misses_belt(const Design& design, const Track& track) {
  if (!design.discharge) return {};
  for (const LevelRide& ride : track.rides()) {
    const Motion& motion = *ride.motion;
    if (!motion.arrived() || !enters(motion)) continue;
    const BeltLanding landing = belt_landing(design, motion);
    if (landing.lands()) continue;
    const std::string when = ride.level == FrictionLevel::nominal ? "" : at_friction_text(ride) + ", ";
    return Issue{design.where("discharge"),
                 when + "the stream does not land on its belt: it moves away from it, at " +
                     quantity_text(-landing.speed_into, Dimension::speed) + ", where it comes to its plane",
                 "The belt falls more steeply there than the stream, which comes from below: there is no "
                 "impact to judge.",
                 "a belt_angle that falls less, a longer drop, or a steeper end of the track"};
  }
  return {};
}

/// A section that finds no room along the track: clearances are told of a solid that cannot be made.
std::optional<Issue> no_room_for_section(const Design& design, const Track& track) {
  constexpr double kCoarse = 1e-3;  // taste: of the section's height
  if (!design.cross_section || tells_of_track_alone(design)) return {};
  const CrossSection section(*design.cross_section);
  const double tolerance = std::max(design.mesh.tolerance, kCoarse * (section.highest() - section.lowest()));
  auto issue = obstacle_to_sweep(*track.centerline, section, tolerance);
  if (!issue) return {};
  issue->where = design.where("cross_section");
  issue->what += "; no solid can be built along this track";
  return issue;
}

}  // namespace

std::vector<Issue> warnings(const Design& design, const Track& track) {
  std::vector<Issue> found;
  if (auto issue = law_problem(design, track)) found.push_back(*std::move(issue));
  if (auto issue = never_applies(design, track)) found.push_back(*std::move(issue));
  add_places_beyond(design, track, found);
  add_lines_beside(design, track, found);
  if (auto issue = kink(design, track)) found.push_back(*std::move(issue));
  if (auto issue = all_but_stalls(design, track)) found.push_back(*std::move(issue));
  if (auto issue = passed_over(design, track)) found.push_back(*std::move(issue));
  if (auto issue = missed_alone(design, track)) found.push_back(*std::move(issue));
  if (auto issue = radius_open(design, track)) found.push_back(*std::move(issue));
  add_material_warnings(design, found);
  if (auto issue = misses_belt(design, track)) found.push_back(*std::move(issue));
  if (auto issue = belt_too_fast(design)) found.push_back(*std::move(issue));
  if (auto issue = no_room_for_section(design, track)) found.push_back(*std::move(issue));
  for (Issue& issue : probes_beside_track(design, track)) found.push_back(std::move(issue));
  return found;
}

}  // namespace glissade
