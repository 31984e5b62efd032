// What the checklist of chute designers asks of a stream: the worst over every friction and flow, with the case.

#include "pipeline/rules/chute_rules.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/materials.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline/flights.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "pipeline/ride/extremes.hpp"
#include "pipeline/ride/ride_facts.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

namespace glissade::pipeline {
namespace {

std::string case_text(const ChuteCase& of) {
  return std::string(to_text(of.friction)) + " friction, " + of.flow + " flow";
}

constexpr const char* kAtHood = "hood, ";

/// Of a case that does not get onto its track, or not down to the finish.
std::string missing_end(const ChuteCase& of) {
  if (of.hood && !of.hood->holds())
    return "a stream that its hood leads on to the track (" + case_text(of) + ")";
  return missing_arrival(case_text(of), ride_end(of.motion), of.motion.distance());
}

void lack_all(Measurements& measurements, std::initializer_list<const char*> keys,
              const std::string& missing) {
  for (const char* const key : keys) measurements.lack(key, missing);
}

/// The greatest flow at the lowest density, at which it is deepest.
Body surging(const StreamDesign& stream, const Body& body) {
  return with_flow(with_density(body, stream.low_density.value_or(stream.bulk_density)), stream.surge);
}

/// The highest friction angle at a place: of a range its upper end, where it changes along the track that of the place [rad].
double highest_friction_angle(const BodyDesign& body, double s) {
  Friction friction = body.high_friction.value_or(body.friction);
  for (const FrictionFrom& change : body.friction_changes) {
    if (change.from <= s) friction = change.friction;
  }
  return friction.angle().radians();
}

/// Ascending arc lengths, those of a centerline and others as far as they lie within it [m].
std::vector<double> breaks_with(const Centerline& centerline, const std::vector<double>& others) {
  std::vector<double> breaks = centerline.breaks();
  for (const double at : others) {
    if (at > 0.0 && at < centerline.length()) breaks.push_back(at);
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

/// Of all flows the largest stops first: it is deeper at each speed, rubs more and is slower.
void measure_stall_margin(const Design& design, const Track& track, Measurements& measurements) {
  if (!lands(track.motion)) {
    measurements.lack("stall_margin", "a feed that lands: it flies over the start");
    return;
  }
  const StreamDesign& stream = *design.stream;
  const bool surges = stream.surge > 1.0;
  const Body body = surges ? surging(stream, body_of(design)) : body_of(design);
  if (const auto stops = stall_friction_angle(track.centerline, body, design.gravity))
    // That angle is the start's, and so is the one that it is held against: all along friction changes with it.
    measurements.see("stall_margin", stops->radians() - highest_friction_angle(design.body, 0.0), {},
                     surges ? "surge flow" : "nominal flow");
}

/// Where friction changes along the track each floor is held against what rubs there.
void measure_slope_margin(const BodyDesign& body, const Centerline& centerline, Measurements& measurements) {
  std::vector<double> changes;
  for (const FrictionFrom& change : body.friction_changes) changes.push_back(change.from);
  const std::vector<double> breaks = breaks_with(centerline, changes);
  const Extreme flattest = highest_along(
      breaks, [&](double s) { return highest_friction_angle(body, s) - centerline.slope_angle(s); });
  measurements.see("slope_margin", -flattest.value, flattest.at);
  const Extreme steepest = highest_along(
      breaks, [&](double s) { return centerline.slope_angle(s) - highest_friction_angle(body, s); });
  measurements.see("slope_margin", steepest.value, steepest.at);
  double roughest = 0.0;
  for (const double s : breaks) {
    // What begins where the track ends rubs nothing.
    if (s < centerline.length()) roughest = std::max(roughest, highest_friction_angle(body, s));
  }
  measurements.see("highest_friction_angle", roughest);
  // How far it is known at one place: that it changes along the track is no range.
  measurements.see("friction_spread", body.high_friction.value_or(body.friction).angle().radians() -
                                          body.low_friction.value_or(body.friction).angle().radians());
}

void measure_slopes(const Design& design, const Track& track, Measurements& measurements) {
  const Centerline& centerline = *track.centerline;
  measure_slope_margin(design.body, centerline, measurements);
  // The corner between floor and wall runs along the track; where the width changes, across it too.
  const BulkStream& stream = *stream_of(track.motion.body());
  std::vector<double> knots;
  for (const WidthAt& knot : stream.shape().width.knots()) knots.push_back(knot.at);
  const std::vector<double> breaks = breaks_with(centerline, knots);
  const Extreme valley = highest_along(breaks, [&](double s) {
    const double turned = math::atan(0.5 * stream.width_slope(s));
    return -math::asin(math::sin(centerline.slope_angle(s)) * math::cos(turned));
  });
  measurements.see("valley_angle", -valley.value, valley.at);
  measure_stall_margin(design, track, measurements);
}

/// Whether a case passes its hood, if it has one, gets onto its track and down to the finish.
bool arrives(const ChuteCase& run) {
  return (!run.hood || run.hood->holds()) && run.motion.arrived() && enters(run.motion);
}

/// How many cases do not arrive, and of that which ends first where and how.
void measure_arrivals(const std::vector<ChuteCase>& cases, Measurements& measurements) {
  const ChuteCase* first = nullptr;
  double count = 0.0;
  // What ends below its hood ends before what comes to the track, what does not get onto that before what does.
  const auto way = [](const ChuteCase& run) {
    if (run.hood && !run.hood->holds()) return -1.0;
    return enters(run.motion) ? run.motion.distance() : 0.0;
  };
  for (const ChuteCase& run : cases) {
    if (arrives(run)) continue;
    count += 1.0;
    if (first == nullptr || way(run) < way(*first)) first = &run;
  }
  if (first == nullptr) {
    measurements.see("cases_not_arriving", 0.0);
    return;
  }
  const bool below_hood = way(*first) < 0.0;
  const std::string_view how = !below_hood                      ? to_text(ride_end(first->motion))
                               : first->hood->motion.lift_off() ? "leaves it before its lower edge"
                                                                : "comes to a stand";
  measurements.see("cases_not_arriving", count, below_hood ? std::nullopt : std::optional(way(*first)),
                   (below_hood ? kAtHood : "") + case_text(*first) + ": " + std::string(how));
}

/// Of a quantity along a ride both extremes.
void see_along(const Motion& motion, const Motion::Quantity& quantity, std::string_view key,
               const ChuteCase& run, Measurements& measurements) {
  const QuantityPeak most = motion.highest(quantity);
  measurements.see(key, most.value, most.arc_length, case_text(run));
  // The reciprocal stays finite where a stream that comes to a stand is deep without bound.
  const QuantityPeak least = motion.highest([&](const LawState& at) { return 1.0 / quantity(at); });
  measurements.see(key, 1.0 / least.value, least.arc_length, case_text(run));
}

/// What the stream of a case does on its track.
/// @param slowest  gets its lowest speed there
void measure_on_track(const ChuteCase& run, double wall, Extremes& slowest, Measurements& measurements) {
  const Motion& motion = run.motion;
  const std::string place = case_text(run);
  // What flies over the start is no ride, and what stands there only slow.
  if (stands_where_it_lands(motion)) slowest.see({0.0, 0.0, place});
  if (!enters(motion)) {
    lack_all(measurements,
             {"lowest_stream_speed", "contact_reserve", "depth_over_wall", "depth_over_width", "wear_peak"},
             missing_end(run));
    return;
  }
  const BulkStream& stream = *stream_of(motion.body());
  const QuantityPeak slow = motion.highest([](const LawState& at) { return -std::sqrt(at.v); });
  slowest.see({-slow.value, slow.arc_length, place});
  const QuantityPeak light = motion.highest(
      [&](const LawState& at) { return -at.normal_load / (motion.gravity() * math::cos(at.slope_angle)); });
  measurements.see("contact_reserve", -light.value, light.arc_length, place);
  const auto depth = [&](const LawState& at) { return stream.depth(at.arc_length, std::sqrt(at.v)); };
  see_along(
      motion, [&](const LawState& at) { return depth(at) / wall; }, "depth_over_wall", run, measurements);
  see_along(
      motion, [&](const LawState& at) { return depth(at) / stream.width(at.arc_length); }, "depth_over_width",
      run, measurements);
  if (!arrives(run)) {
    measurements.lack("wear_peak", missing_end(run));
    return;
  }
  const ValueAt most = stream_peak(motion, &StreamState::floor_wear);
  const double mean = mean_floor_wear(motion);
  if (mean > 0.0) measurements.see("wear_peak", most.value / mean, most.arc_length, place);
}

/// What it does below its hood.
/// @param slowest  gets its lowest speed there
void measure_hood(const ChuteCase& run, double wall, Extremes& slowest, Measurements& measurements) {
  const Motion& motion = run.hood->motion;
  const std::string place = kAtHood + case_text(run);
  if (!(run.hood->impact.speed_ratio > 0.0)) {
    slowest.see({0.0, {}, place});
    lack_all(measurements, {"hood_contact", "depth_over_wall", "depth_over_width"}, missing_end(run));
    return;
  }
  const BulkStream& stream = *stream_of(motion.body());
  const double width = stream.width(0.0);
  const double deepest = motion.highest(BulkStream::kDepth).value;
  const double shallowest =
      stream.depth(0.0, motion.highest([](const LawState& at) { return std::sqrt(at.v); }).value);
  for (const double depth : {deepest, shallowest}) {
    measurements.see("depth_over_wall", depth / wall, {}, place);
    measurements.see("depth_over_width", depth / width, {}, place);
  }
  // With one width it is slowest where it is deepest.
  slowest.see({stream.depth(0.0, 1.0) / deepest, {}, place});
  measurements.see("hood_contact", run.hood->least_contact, {}, place);
}

void measure_motion(const Design& design, const std::vector<ChuteCase>& cases, Measurements& measurements) {
  const double wall = stream_channel(design.cross_section.value()).value().wall_height;
  for (const ChuteCase& run : cases) {
    Extremes slowest;
    measure_on_track(run, wall, slowest, measurements);
    if (run.hood) measure_hood(run, wall, slowest, measurements);
    if (slowest.least()) measurements.see("lowest_stream_speed", *slowest.least());
  }
  measurements.see("hoods", design.hood ? 1.0 : 0.0);
}

void measure_feed(const Design& design, const std::vector<ChuteCase>& cases, Measurements& measurements) {
  if (!design.feed) {
    lack_all(measurements, {"landing_margin", "impact_speed_ratio", "impact_angle", "feed_drop"},
             "feed: {kind: belt, ...}, how the stream comes down");
    return;
  }
  measurements.see("feed_drop", design.feed->drop);
  if (design.hood) measurements.see("feed_drop", design.hood->drop);
  const auto see = [&](const char* key, double value, std::optional<double> at, const ChuteCase& run,
                       const char* part = "") { measurements.see(key, value, at, part + case_text(run)); };
  for (const ChuteCase& run : cases) {
    const std::optional<Impact> impact = impact_of(run.motion);
    const double slope = run.motion.centerline().slope_angle(0.0);
    // What lands within the rounding of a search lands.
    const double steeper = run.motion.body().landing.value().angle.radians() - slope;
    see("landing_margin", impact ? std::max(0.0, steeper) : steeper, 0.0, run);
    if (!impact) {
      lack_all(measurements, {"impact_speed_ratio", "impact_angle"}, missing_end(run));
      continue;
    }
    // Friction takes no more than all of the speed; what stands below its hood has none to lose.
    if (!run.hood || run.hood->holds() || run.hood->motion.lift_off()) {
      see("impact_speed_ratio", std::max(0.0, impact->speed_ratio), 0.0, run);
      see("impact_angle", impact->angle.radians(), 0.0, run);
    }
    if (!run.hood) continue;
    see("impact_speed_ratio", std::max(0.0, run.hood->impact.speed_ratio), {}, run, kAtHood);
    see("impact_angle", run.hood->impact.angle.radians(), {}, run, kAtHood);
  }
}

void measure_discharge(const Design& design, const std::vector<ChuteCase>& cases,
                       Measurements& measurements) {
  if (!design.discharge) {
    lack_all(measurements, {"belt_match", "speed_into_belt"},
             "discharge: {belt_speed: 2.5 m/s}, the belt that takes the stream");
    return;
  }
  for (const ChuteCase& run : cases) {
    const std::string place = case_text(run);
    if (!arrives(run)) {
      lack_all(measurements, {"belt_match", "speed_into_belt"}, missing_end(run));
      continue;
    }
    const BeltLanding landing = belt_landing(design, run.motion);
    if (!landing.lands()) {
      lack_all(measurements, {"belt_match", "speed_into_belt"},
               "a stream that lands: with " + place + " it moves away from its belt");
      continue;
    }
    measurements.see("belt_match", landing.match, run.motion.distance(), place);
    measurements.see("speed_into_belt", landing.speed_into, run.motion.distance(), place);
  }
}

/// Streams in the air are no track: no search keeps them clear of anything.
void measure_air(const Design& design, const Track& track, const std::vector<ChuteCase>& cases,
                 Measurements& measurements) {
  std::optional<HoodPassage> nominal;
  if (design.hood) nominal.emplace(hood_passage(design, track.motion.body()));
  std::size_t obstacles = 0;
  for (const ChuteCase& run : cases) {
    const auto flights =
        stream_flights(design, run.motion, nominal ? &*nominal : nullptr, run.hood ? &*run.hood : nullptr);
    const auto approaches = flight_approaches(design, flights);
    obstacles = std::max(obstacles, approaches.size());
    for (const FlightApproach& near : approaches) {
      measurements.see("air_clearance", near.margin(), {},
                       std::string(to_text(near.kind)) + " by " + near.limit + ", " + length_text(near.at.x) +
                           " out and " + length_text(-near.at.y) + " below the start, " + case_text(run));
    }
  }
  measurements.see("obstacles_by_flights", static_cast<double>(obstacles));
}

/// The speed that the material or its liner stands; none if nothing is known.
std::optional<double> speed_cap(const Design& design) {
  if (!design.stream->material) return {};
  const MaterialChoice& choice = *design.stream->material;
  std::optional<double> cap;
  const auto lower_to = [&](double speed) { cap = std::min(cap.value_or(speed), speed); };
  const Material* found = shipped_materials().material(choice.material);
  for (const Material& own : design.materials) {
    if (own.word == choice.material) found = &own;
  }
  if (found != nullptr && found->highest_speed) lower_to(found->highest_speed->value);
  constexpr double kOfPolyethylene = 6.0;  // [m/s], rule of thumb of the trade
  if (choice.liner == "uhmwpe") lower_to(kOfPolyethylene);
  return cap;
}

void measure_speed(const Design& design, const std::vector<ChuteCase>& cases, Measurements& measurements) {
  const std::optional<double> cap = speed_cap(design);
  if (!cap) {
    measurements.lack("speed_over_cap",
                      "stream: {material: ...} of the library, or one of your own with highest_speed");
    return;
  }
  for (const ChuteCase& run : cases) {
    Extremes fastest;
    if (enters(run.motion)) {
      const MotionState state = run.motion.highest_speed();
      fastest.see({state.speed / *cap, state.arc_length, case_text(run)});
    } else {
      measurements.lack("speed_over_cap", missing_end(run));
    }
    if (run.hood) fastest.see({run.hood->motion.highest_speed().speed / *cap, {}, kAtHood + case_text(run)});
    if (fastest.most()) measurements.see("speed_over_cap", *fastest.most());
  }
}

/// Ascending places of a track between which its width is linear: its start, the knots and its finish [m].
std::vector<double> width_places(const BulkStream& stream, double length) {
  std::vector<double> places{0.0};
  for (const WidthAt& knot : stream.shape().width.knots()) {
    if (knot.at > 0.0 && knot.at < length) places.push_back(knot.at);
  }
  places.push_back(length);
  return places;
}

/// Faces converge where the channel is narrower than somewhere before; between its knots a width does not turn.
void measure_narrowing(const BulkStream& stream, double length, Measurements& measurements) {
  double widest = stream.width(0.0);
  double least = 1.0;
  std::optional<double> where;
  for (const double at : width_places(stream, length)) {
    const double share = stream.width(at) / widest;
    widest = std::max(widest, stream.width(at));
    if (share >= least) continue;
    least = share;
    where = at;
  }
  measurements.see("narrowing", least, where);
}

void measure_channel(const Design& design, const Track& track, Measurements& measurements) {
  const BulkStream& stream = *stream_of(track.motion.body());
  const double length = track.centerline->length();
  measure_narrowing(stream, length, measurements);
  if (design.stream->lump_size) {
    const double lump = *design.stream->lump_size;
    measurements.see("width_over_lump", stream.shape().width.narrowest() / lump);
    for (const double at : width_places(stream, length))
      measurements.see("width_over_lump", stream.width(at) / lump, at);
  } else {
    measurements.lack("width_over_lump", "stream: {lump_size: 150 mm}");
  }
  const StreamChannel channel = stream_channel(design.cross_section.value()).value();
  const double density = design.stream->high_density.value_or(design.stream->bulk_density);
  const double full = density * design.gravity * channel.full_area();
  measurements.lack("plugged_load", "to be shown by its designer: full of material it carries " +
                                        rounded_text(full / 1e3, 3) + " kN on each metre");
  measurements.lack("corner_radius", "to be looked at: the section has sharp inner corners");
  measurements.lack("inspection_doors", "to be looked at");
  measurements.lack("earthing_and_finish", "to be looked at");
  measurements.lack("trim_allowance", "to be looked at: the model ends where the track ends");
}

}  // namespace

std::vector<ChuteCase> chute_cases(const Design& design, const CenterlinePtr& centerline) {
  const StreamDesign& stream = design.stream.value();
  std::vector<std::pair<FrictionLevel, Friction>> frictions;
  if (design.body.low_friction) frictions.emplace_back(FrictionLevel::low, *design.body.low_friction);
  frictions.emplace_back(FrictionLevel::nominal, design.body.friction);
  if (design.body.high_friction) frictions.emplace_back(FrictionLevel::high, *design.body.high_friction);
  std::vector<ChuteCase> cases;
  for (const auto& [level, friction] : frictions) {
    Body body = body_of(design);
    body.friction = friction;
    const auto add = [&](const char* flow, const Body& with) {
      cases.push_back({level, flow, Motion(centerline, with, design.gravity)});
      if (design.hood) cases.back().hood.emplace(hood_passage(design, with));
    };
    if (stream.trickle < 1.0) add("trickle", with_flow(body, stream.trickle));
    add("nominal", body);
    if (stream.surge > 1.0) add("surge", surging(stream, body));
  }
  return cases;
}

namespace {

/// Evenly spread, with the nominal one in place of the one next to it.
std::vector<double> spread_with(double low, double nominal, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  const auto nearest = std::min_element(values.begin(), values.end(), [&](double a, double b) {
    return std::fabs(a - nominal) < std::fabs(b - nominal);
  });
  *nearest = nominal;
  return values;
}

/// The friction angles of the start to look at: those of a range, else some degrees to either side, as far as all along the track
/// may change with it [rad].
std::pair<double, double> frictions_around(const BodyDesign& body) {
  const double nominal = body.friction.angle().radians();
  if (body.low_friction || body.high_friction) {
    return {body.low_friction.value_or(body.friction).angle().radians(),
            body.high_friction.value_or(body.friction).angle().radians()};
  }
  constexpr double kBeside = Angle::from_degrees(3.0).radians();     // taste
  constexpr double kSteepest = Angle::from_degrees(89.9).radians();  // taste: below all that frictions may be
  double least = nominal;
  double most = nominal;
  for (const FrictionFrom& change : body.friction_changes) {
    least = std::min(least, change.friction.angle().radians());
    most = std::max(most, change.friction.angle().radians());
  }
  return {nominal - std::min(kBeside, least), nominal + std::clamp(kSteepest - most, 0.0, kBeside)};
}

}  // namespace

std::vector<WhatIfRide> what_if_rides(const Design& design, const CenterlinePtr& centerline) {
  const BodyDesign& body = design.body;
  const StreamDesign& stream = design.stream.value();
  constexpr int kFrictions = 5;
  constexpr int kFlows = 7;
  constexpr double kBeyondSurge = 4.0 / 3.0;
  const double nominal = body.friction.angle().radians();
  const auto [low, high] = frictions_around(body);
  std::vector<WhatIfRide> rides;
  for (const double angle : spread_with(low, nominal, high, kFrictions)) {
    // The design's own friction may be a coefficient: its angle and back is not the same double.
    const Friction friction =
        angle == nominal ? body.friction : Friction::from_angle(Angle::from_radians(angle));
    const Body rubbed = body_of(with_friction(design, friction, centerline->length()));
    for (const double factor : spread_with(stream.trickle, 1.0, kBeyondSurge * stream.surge, kFlows)) {
      const Body one = factor != 1.0 ? with_flow(rubbed, factor) : rubbed;
      rides.push_back({factor * stream.mass_flow, factor == 1.0 && angle == nominal,
                       Motion(centerline, one, design.gravity)});
    }
  }
  return rides;
}

void measure_chute(const Design& design, const Track& track, Measurements& measurements) {
  if (!design.stream) return;
  std::vector<ChuteCase> cases = chute_cases(design, track.centerline);
  // Of equals the first is told. Let that be the largest flow: at the start all are as fast as they enter.
  std::reverse(cases.begin(), cases.end());
  measure_slopes(design, track, measurements);
  measure_arrivals(cases, measurements);
  measure_motion(design, cases, measurements);
  measure_feed(design, cases, measurements);
  measure_discharge(design, cases, measurements);
  measure_air(design, track, cases, measurements);
  measure_speed(design, cases, measurements);
  measure_channel(design, track, measurements);
}

}  // namespace glissade::pipeline
