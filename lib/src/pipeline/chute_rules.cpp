// What the checklist of chute designers asks of a stream: the worst over every friction and flow, with the case.

#include "pipeline/chute_rules.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"
#include "glissade/design/materials.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline/flights.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "pipeline/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace glissade::pipeline {
namespace {

std::string case_text(const ChuteCase& of) {
  return std::string(to_text(of.friction)) + " friction, " + of.flow + " flow";
}

/// Keeps the worst of several cases, with the case that it is of.
class WorstCase {
 public:
  /// @param sign  1: the highest is the worst, -1: the lowest
  explicit WorstCase(double sign) : sign_(sign) {}

  /// @param part  where, if not along the track
  void see(double value, std::optional<double> arc_length, const ChuteCase& of,
           const std::string& part = "") {
    // Of equals the last, which is the largest flow: at the start all are as fast as they enter.
    if (value_ && sign_ * value < sign_ * *value_) return;
    value_ = value;
    arc_length_ = arc_length;
    place_ = part + case_text(of);
  }
  void set_in(Measurements& measurements, std::string_view key) const {
    if (value_) measurements.set(key, *value_, arc_length_, place_);
  }

 private:
  double sign_;
  std::optional<double> value_;
  std::optional<double> arc_length_;
  std::string place_;
};

constexpr const char* kAtHood = "hood, ";

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
    measurements.set_missing("stall_margin", "a feed that lands: it flies over the start");
    return;
  }
  const StreamDesign& stream = *design.stream;
  const bool surges = stream.surge > 1.0;
  const Body body = surges ? surging(stream, body_of(design)) : body_of(design);
  if (const auto stops = stall_friction_angle(track.centerline, body, design.gravity))
    // That angle is the start's, and so is the one that it is held against: all along friction changes with it.
    measurements.set("stall_margin", stops->radians() - highest_friction_angle(design.body, 0.0), {},
                     surges ? "surge flow" : "nominal flow");
}

/// Where friction changes along the track each floor is held against what rubs there.
void measure_slope_margin(const BodyDesign& body, const Centerline& centerline, Measurements& measurements) {
  std::vector<double> changes;
  for (const FrictionFrom& change : body.friction_changes) changes.push_back(change.from);
  const std::vector<double> breaks = breaks_with(centerline, changes);
  const Extreme flattest = highest_along(
      breaks, [&](double s) { return highest_friction_angle(body, s) - centerline.slope_angle(s); });
  measurements.set("slope_margin", -flattest.value, flattest.at);
  double roughest = 0.0;
  for (const double s : breaks) {
    // What begins where the track ends rubs nothing.
    if (s < centerline.length()) roughest = std::max(roughest, highest_friction_angle(body, s));
  }
  measurements.set("highest_friction_angle", roughest);
  // How far it is known at one place: that it changes along the track is no range.
  measurements.set("friction_spread", body.high_friction.value_or(body.friction).angle().radians() -
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
  measurements.set("valley_angle", -valley.value, valley.at);
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
    // Of equals the last, as the other rules have it.
    if (first == nullptr || way(run) <= way(*first)) first = &run;
  }
  if (first == nullptr) {
    measurements.set("cases_not_arriving", 0.0);
    return;
  }
  const bool below_hood = way(*first) < 0.0;
  const std::string_view how = !below_hood                      ? to_text(ride_end(first->motion))
                               : first->hood->motion.lift_off() ? "leaves it before its lower edge"
                                                                : "comes to a stand";
  measurements.set("cases_not_arriving", count, below_hood ? std::nullopt : std::optional(way(*first)),
                   (below_hood ? kAtHood : "") + case_text(*first) + ": " + std::string(how));
}

/// What the stream does on the track and below a hood before it: the worst of all cases.
class WorstRides {
 public:
  void see(const ChuteCase& run, double wall);
  void see_hood(const ChuteCase& run, double wall);
  void set_in(Measurements& measurements) const;

 private:
  WorstCase slowest_{-1.0};
  WorstCase lightest_{-1.0};
  WorstCase deepest_{1.0};
  WorstCase thickest_{1.0};
  WorstCase peak_{1.0};
  WorstCase held_{-1.0};
};

void WorstRides::see(const ChuteCase& run, double wall) {
  const Motion& motion = run.motion;
  // What flies over the start is no ride, and what stands there only slow.
  if (stands_where_it_lands(motion)) slowest_.see(0.0, 0.0, run);
  if (!enters(motion)) return;
  const BulkStream& stream = *stream_of(motion.body());
  const QuantityPeak slow = motion.highest([](const LawState& at) { return -std::sqrt(at.v); });
  slowest_.see(-slow.value, slow.arc_length, run);
  const QuantityPeak light = motion.highest(
      [&](const LawState& at) { return -at.normal_load / (motion.gravity() * math::cos(at.slope_angle)); });
  lightest_.see(-light.value, light.arc_length, run);
  const QuantityPeak depth = motion.highest(BulkStream::kDepth);
  deepest_.see(depth.value / wall, depth.arc_length, run);
  const QuantityPeak thick = motion.highest([&](const LawState& at) {
    return stream.depth(at.arc_length, std::sqrt(at.v)) / stream.width(at.arc_length);
  });
  thickest_.see(thick.value, thick.arc_length, run);
  if (!motion.arrived()) return;
  const ValueAt most = stream_peak(motion, &StreamState::floor_wear);
  const double mean = mean_floor_wear(motion);
  if (mean > 0.0) peak_.see(most.value / mean, most.arc_length, run);
}

void WorstRides::see_hood(const ChuteCase& run, double wall) {
  const Motion& motion = run.hood->motion;
  if (!(run.hood->impact.speed_ratio > 0.0)) {
    slowest_.see(0.0, {}, run, kAtHood);
    return;
  }
  const double width = stream_of(motion.body())->width(0.0);
  const double depth = motion.highest(BulkStream::kDepth).value;
  deepest_.see(depth / wall, {}, run, kAtHood);
  thickest_.see(depth / width, {}, run, kAtHood);
  // With one width it is slowest where it is deepest.
  slowest_.see(stream_of(motion.body())->depth(0.0, 1.0) / depth, {}, run, kAtHood);
  held_.see(run.hood->least_contact, {}, run, kAtHood);
}

void WorstRides::set_in(Measurements& measurements) const {
  slowest_.set_in(measurements, "lowest_stream_speed");
  lightest_.set_in(measurements, "contact_reserve");
  held_.set_in(measurements, "hood_contact");
  deepest_.set_in(measurements, "depth_over_wall");
  thickest_.set_in(measurements, "depth_over_width");
  peak_.set_in(measurements, "wear_peak");
}

void measure_motion(const Design& design, const std::vector<ChuteCase>& cases, Measurements& measurements) {
  WorstRides worst;
  const double wall = stream_channel(design.cross_section.value()).value().wall_height;
  for (const ChuteCase& run : cases) {
    worst.see(run, wall);
    if (run.hood) worst.see_hood(run, wall);
  }
  worst.set_in(measurements);
  measurements.set("hoods", design.hood ? 1.0 : 0.0);
}

void measure_feed(const Design& design, const std::vector<ChuteCase>& cases, Measurements& measurements) {
  if (!design.feed) {
    for (const char* const key : {"landing_margin", "impact_speed_ratio", "impact_angle", "feed_drop"})
      measurements.set_missing(key, "feed: {kind: belt, ...}, how the stream comes down");
    return;
  }
  measurements.set("feed_drop", std::max(design.feed->drop, design.hood ? design.hood->drop : 0.0));
  WorstCase margin(-1.0);
  WorstCase ratio(-1.0);
  WorstCase angle(1.0);
  bool all_land = true;
  for (const ChuteCase& run : cases) {
    const std::optional<Impact> impact = impact_of(run.motion);
    const double slope = run.motion.centerline().slope_angle(0.0);
    // What lands within the rounding of a search lands.
    const double steeper = run.motion.body().landing.value().angle.radians() - slope;
    margin.see(impact ? std::max(0.0, steeper) : steeper, 0.0, run);
    all_land = all_land && impact;
    if (!impact) continue;
    // Friction takes no more than all of the speed; what stands below its hood has none to lose.
    if (!run.hood || run.hood->holds() || run.hood->motion.lift_off()) {
      ratio.see(std::max(0.0, impact->speed_ratio), 0.0, run);
      angle.see(impact->angle.radians(), 0.0, run);
    }
    if (!run.hood) continue;
    ratio.see(std::max(0.0, run.hood->impact.speed_ratio), {}, run, kAtHood);
    angle.see(run.hood->impact.angle.radians(), {}, run, kAtHood);
  }
  margin.set_in(measurements, "landing_margin");
  if (all_land) {
    ratio.set_in(measurements, "impact_speed_ratio");
    angle.set_in(measurements, "impact_angle");
  } else {
    for (const char* const key : {"impact_speed_ratio", "impact_angle"})
      measurements.set_missing(key, "a feed that lands: it flies over the start");
  }
}

void measure_discharge(const Design& design, const std::vector<ChuteCase>& cases,
                       Measurements& measurements) {
  if (!design.discharge) {
    for (const char* const key : {"belt_match", "speed_into_belt"})
      measurements.set_missing(key, "discharge: {belt_speed: 2.5 m/s}, the belt that takes the stream");
    return;
  }
  WorstCase into(1.0);
  const BeltLanding* worst = nullptr;
  std::vector<std::pair<BeltLanding, const ChuteCase*>> landings;
  for (const ChuteCase& run : cases) {
    if (run.motion.arrived() && enters(run.motion))
      landings.emplace_back(belt_landing(design, run.motion), &run);
  }
  const ChuteCase* of = nullptr;
  for (const auto& [landing, run] : landings) {
    if (!landing.lands()) {
      for (const char* const key : {"belt_match", "speed_into_belt"})
        measurements.set_missing(
            key, "a stream that lands: with " + case_text(*run) + " it moves away from its belt");
      return;
    }
    into.see(landing.speed_into, run->motion.distance(), *run);
    if (worst != nullptr && std::fabs(landing.match - 1.0) <= std::fabs(worst->match - 1.0)) continue;
    worst = &landing;
    of = run;
  }
  into.set_in(measurements, "speed_into_belt");
  if (worst == nullptr) return;
  WorstCase match(1.0);
  match.see(worst->match, of->motion.distance(), *of);
  match.set_in(measurements, "belt_match");
}

/// Streams in the air are no track: no search keeps them clear of anything.
void measure_air(const Design& design, const Track& track, const std::vector<ChuteCase>& cases,
                 Measurements& measurements) {
  std::optional<HoodPassage> nominal;
  if (design.hood) nominal.emplace(hood_passage(design, track.motion.body()));
  WorstCase closest(-1.0);
  std::size_t obstacles = 0;
  for (const ChuteCase& run : cases) {
    const auto flights =
        stream_flights(design, run.motion, nominal ? &*nominal : nullptr, run.hood ? &*run.hood : nullptr);
    const auto approaches = flight_approaches(design, flights);
    obstacles = std::max(obstacles, approaches.size());
    for (const FlightApproach& near : approaches) {
      closest.see(near.margin(), {}, run,
                  std::string(to_text(near.kind)) + " by " + near.limit + ", " + length_text(near.at.x) +
                      " out and " + length_text(-near.at.y) + " below the start, ");
    }
  }
  measurements.set("obstacles_by_flights", static_cast<double>(obstacles));
  closest.set_in(measurements, "air_clearance");
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
    measurements.set_missing("speed_over_cap",
                             "stream: {material: ...} of the library, or one of your own with highest_speed");
    return;
  }
  WorstCase fastest(1.0);
  for (const ChuteCase& run : cases) {
    const MotionState state = run.motion.highest_speed();
    if (enters(run.motion)) fastest.see(state.speed / *cap, state.arc_length, run);
    if (run.hood) fastest.see(run.hood->motion.highest_speed().speed / *cap, {}, run, kAtHood);
  }
  fastest.set_in(measurements, "speed_over_cap");
}

/// Faces converge where the channel is narrower than somewhere before; between its knots a width does not turn.
void measure_narrowing(const BulkStream& stream, double length, Measurements& measurements) {
  std::vector<double> places;
  for (const WidthAt& knot : stream.shape().width.knots()) {
    if (knot.at > 0.0 && knot.at < length) places.push_back(knot.at);
  }
  places.push_back(length);
  double widest = stream.width(0.0);
  double least = 1.0;
  std::optional<double> where;
  for (const double at : places) {
    const double share = stream.width(at) / widest;
    widest = std::max(widest, stream.width(at));
    if (share >= least) continue;
    least = share;
    where = at;
  }
  measurements.set("narrowing", least, where);
}

void measure_channel(const Design& design, const Track& track, Measurements& measurements) {
  const BulkStream& stream = *stream_of(track.motion.body());
  const double narrowest = stream.shape().width.narrowest();
  measure_narrowing(stream, track.centerline->length(), measurements);
  if (design.stream->lump_size) {
    measurements.set("width_over_lump", narrowest / *design.stream->lump_size);
  } else {
    measurements.set_missing("width_over_lump", "stream: {lump_size: 150 mm}");
  }
  const StreamChannel channel = stream_channel(design.cross_section.value()).value();
  const double density = design.stream->high_density.value_or(design.stream->bulk_density);
  const double full = density * design.gravity * channel.full_area();
  measurements.set_missing("plugged_load", "to be shown by its designer: full of material it carries " +
                                               rounded_text(full / 1e3, 3) + " kN on each metre");
  measurements.set_missing("corner_radius", "to be looked at: the section has sharp inner corners");
  measurements.set_missing("inspection_doors", "to be looked at");
  measurements.set_missing("earthing_and_finish", "to be looked at");
  measurements.set_missing("trim_allowance", "to be looked at: the model ends where the track ends");
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
  const std::vector<ChuteCase> cases = chute_cases(design, track.centerline);
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
