#include "glissade/pipeline/json.hpp"

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/core/version.hpp"
#include "glissade/pipeline/probes.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "pipeline/build/fabricate.hpp"
#include "pipeline/rules/chute_rules.hpp"
#include "pipeline/task/body.hpp"
#include "pipeline/task/hood.hpp"
#include "pipeline/track_document.hpp"
#include "report/serial/parts.hpp"
#include "report/serial/stream.hpp"
#include "report/serial/vocabulary.hpp"

#include <cmath>
#include <optional>

namespace glissade {

using namespace report;

namespace {

Json task_document(const Design& design, const Endpoints& endpoints) {
  Json json;
  json["glissade"] = version();
  if (!design.name.empty()) json["name"] = design.name;
  json["run_m"] = endpoints.run;
  json["drop_m"] = endpoints.drop;
  add_body(json, design);
  return json;
}

Json profile_json(const FittedProfile& profile) {
  Json json = {{"points", profile.points().size()},
               {"max_deviation_m", profile.max_deviation()},
               {"max_deviation_at_point", profile.farthest_point() + 1},
               {"rms_deviation_m", profile.rms_deviation()},
               {"between_points_m", profile.between_points()}};
  json["min_radius_within_m"] = nullptr;
  if (const auto& range = profile.largest_curvature()) {
    json["min_radius_within_m"] = {1.0 / range->greatest, 1.0 / range->least};
  }
  return json;
}

Json constant_speed_json(const ConstantSpeedCurve& curve, const Body& body) {
  Json json = {
      {"p_m2_per_s2", curve.p()}, {"speed_m_per_s", nullptr}, {"travel_time_at_that_speed_s", nullptr}};
  if (const auto speed = kept_speed(curve, body)) {
    json["speed_m_per_s"] = *speed;
    json["travel_time_at_that_speed_s"] = curve.travel_time_at_constant_speed();
  }
  return json;
}

/// A place of an in-run by its letter.
Json letter_json(const InRun& in_run, const Placement& placement, double arc_length) {
  const CenterlinePoint point = in_run.at(arc_length);
  const Vec3 position = placement.to_space(point.x, point.drop, 0.0);
  return {{"arc_length_m", arc_length}, {"x_m", position.x}, {"y_m", position.y}, {"z_m", position.z}};
}

Json in_run_json(const InRun& in_run, const Placement& placement) {
  const auto letter = [&](double at) { return letter_json(in_run, placement, at); };
  return {{"transition_length_m", in_run.table_begins() - in_run.transition_begins()},
          {"straight_length_m", in_run.transition_begins()},
          {"table_length_m", in_run.length() - in_run.table_begins()},
          {"A", letter(0.0)},
          {"E1", letter(in_run.transition_begins())},
          {"E2", letter(in_run.table_begins())},
          {"T", letter(in_run.length())}};
}

void add_curve(Json& json, const Track& track) {
  const Centerline& centerline = *track.centerline;
  json["entry_slope_angle_deg"] = degrees(centerline.slope_angle(0.0));
  json["exit_slope_angle_deg"] = degrees(centerline.slope_angle(centerline.length()));
  json["steepest_slope_angle_deg"] = degrees(track.steepest_slope_angle);
  json["arc_length_m"] = centerline.length();
  json["min_radius_m"] = number(track.min_radius);
  if (const auto* const profile = dynamic_cast<const FittedProfile*>(&centerline)) {
    json["profile"] = profile_json(*profile);
  }
  if (const auto* const in_run = dynamic_cast<const InRun*>(&centerline)) {
    json["in_run"] = in_run_json(*in_run, track.placement);
  }
  if (const auto* const curve = dynamic_cast<const ConstantSpeedCurve*>(&centerline)) {
    json["constant_speed"] = constant_speed_json(*curve, track.motion.body());
  }
}

Json limits_json(const std::vector<LimitCheck>& checks, const OptimizeReport* search) {
  Json limits = Json::array();
  for (const LimitCheck& check : checks) {
    const ActiveLimit* active = nullptr;
    if (search != nullptr && check.kept()) {
      const auto found = std::find_if(search->active.begin(), search->active.end(),
                                      [&](const ActiveLimit& one) { return one.limit == check.limit; });
      if (found != search->active.end()) active = &*found;
    }
    limits.push_back(limit_json(check, active, search != nullptr ? search->objective : Objective{}));
  }
  return limits;
}

Json clearances_from_json(const Design& design) {
  if (!design.limits || !design.limits->has_clearances()) return nullptr;
  return envelope_of(design).is_line() ? "centerline" : "solid";
}

Json rides_of(const Track& track, pipeline::Told told) {
  const std::optional<Angle> stall_angle =
      told != pipeline::Told::figures ? stall_angle_of(track) : std::nullopt;
  Json rides = Json::array();
  for (const LevelRide& ride : track.rides()) {
    // The nominal ride is the track's own: without a margin it says nothing new.
    if (told == pipeline::Told::figures && ride.level == FrictionLevel::nominal) continue;
    rides.push_back(ride_json(ride.level, *ride.motion, stall_angle));
  }
  return rides;
}

Json fastest_within_json(const Track& track) {
  if (!track.fastest_within) return nullptr;
  return {{"travel_time_s", track.fastest_within->travel_time},
          {"friction_loss_j_per_kg", track.fastest_within->friction_loss},
          {"highest_floor_wear_w_per_m2",
           track.fastest_within->floor_wear ? Json(*track.fastest_within->floor_wear) : Json(nullptr)},
          {"price_s", track.motion.travel_time() - track.fastest_within->travel_time}};
}

Json wear_json(const Design& design, const Track& track) {
  const WearAtFrictions wear = wear_at_frictions(track);
  const WearFacts& facts = wear.facts;
  Json plates = Json::array();
  for (const WearStretch& plate : facts.plates)
    plates.push_back({{"from_m", plate.from}, {"to_m", plate.to}});
  Json json = {{"highest_floor_wear_w_per_m2", facts.floor.value},
               {"highest_floor_wear_at_m", facts.floor.arc_length},
               {"friction", to_text(wear.level)},
               {"mean_floor_wear_w_per_m2", facts.mean_floor},
               {"highest_wall_wear_w_per_m2", facts.wall.value},
               {"highest_wall_wear_at_m", facts.wall.arc_length},
               {"wear_plates", std::move(plates)}};
  json["loss_at_m"] = facts.pressed.arc_length;
  json["loss_friction"] = to_text(wear.pressed_level);
  const auto loss = liner_loss(design, facts);
  json["loss_mm_per_1000_h"] = loss ? Json(loss->per_1000_h * 1e3) : Json(nullptr);
  json["loss_mm_per_mt"] = loss ? Json(loss->per_megatonne * 1e3) : Json(nullptr);
  json["liner_life_h"] = loss ? Json(loss->life_hours) : Json(nullptr);
  return json;
}

/// @return null of a stream that never lands
Json discharge_json(const Design& design, const Motion& motion) {
  const BeltLanding landing = belt_landing(design, motion);
  return landing.lands() ? belt_landing_json(landing) : Json(nullptr);
}

/// Every friction with every flow, by what differs.
Json cases_json(const Design& design, const CenterlinePtr& centerline) {
  Json list = Json::array();
  for (const pipeline::ChuteCase& run : pipeline::chute_cases(design, centerline)) {
    Json entry;
    entry["friction"] = to_text(run.friction);
    entry["flow"] = run.flow;
    add_ride(entry, run.motion);
    Json kept = {{"friction", entry["friction"]},
                 {"flow", entry["flow"]},
                 {"status", entry["status"]},
                 {"travel_time_s", entry["travel_time_s"]},
                 {"exit_speed_m_per_s", entry["exit_speed_m_per_s"]},
                 {"highest_speed_m_per_s", entry["highest_speed_m_per_s"]},
                 {"stream", entry["stream"]}};
    if (run.hood) kept["hood"] = hood_passage_json(*run.hood);
    if (design.discharge && run.motion.arrived() && enters(run.motion))
      kept["discharge"] = discharge_json(design, run.motion);
    list.push_back(std::move(kept));
  }
  return list;
}

/// What a design adds to the keys of its track, of one that has none; tests/pipeline/json_keys_test.cpp holds that it is all.
void add_keys_of_design(Json& json, const Design& design) {
  Design track = design;
  track.hood.reset();  // the law on the track does not ask for it, and it may be still to be chosen
  if (body_of(track).law) {
    json["inertia_factor"] = nullptr;
    json["law_end"] = nullptr;
    json["law"] = Json::array();
  }
  if (design.feed) json["feed"] = nullptr;
  if (design.hood) json["hood"] = nullptr;
  if (design.discharge) json["discharge"] = nullptr;
  if (!design.stream) return;
  json["stream"] = nullptr;
  json["wear"] = nullptr;
  json["verdicts"] = Json::array();
  json["cases"] = Json::array();
}

/// Of the body on the straight line, where no track was found: it knows no limits. None to a finish that was to be chosen.
std::optional<double> straight_travel_time(const Design& design) {
  if (design.track.free_finish != FinishKind::point) return {};
  Design track = design;
  track.hood.reset();  // the ride does not ask for it, and it may be still to be chosen
  const auto ride = pipeline::straight_ride(endpoints_of(track), body_of(track), track.gravity);
  if (!ride) return {};
  return ride->travel_time();
}

Json conflict_document(const Design& design, const OptimizeReport& report) {
  Json json = task_document(design, endpoints_of(design));
  json["centerline"] = word(design.centerline.kind);
  json["status"] = to_text(report.status);
  // The keys of a track, so that a reader needs to ask only for their values.
  for (const char* key :
       {"travel_time_s", "exit_speed_m_per_s", "highest_speed_m_per_s", "highest_speed_at_m",
        "max_normal_load_m_per_s2", "max_normal_load_at_m", "min_normal_load_m_per_s2",
        "min_normal_load_at_m", "friction_loss_j_per_kg", "drag_loss_j_per_kg", "stall", "lift_off"}) {
    json[key] = nullptr;
  }
  json["straight_travel_time_s"] = number(straight_travel_time(design));
  json["optimum_travel_time_s"] = number(report.unlimited_travel_time);
  for (const char* key : {"entry_slope_angle_deg", "exit_slope_angle_deg", "steepest_slope_angle_deg",
                          "arc_length_m", "min_radius_m"}) {
    json[key] = nullptr;
  }
  json["rides"] = Json::array();
  json["clearances_from"] = clearances_from_json(design);
  json["limits"] = limits_json(report.checks, &report);
  json["search"] = search_json(report);
  json["fastest_within_limits"] = nullptr;
  json["probes"] = Json::array();
  json["gates"] = nullptr;
  json["rules"] = Json::array();
  add_keys_of_design(json, design);
  json["warnings"] = Json::array();
  return json;
}

/// The feed then falls on the hood; what comes down on the track is the hood's.
void add_hood(Json& json, const Design& design, const Track& track, const std::optional<Impact>& impact) {
  const HoodPassage passage = hood_passage(design, track.motion.body());
  json["feed"] = feed_json(feed_fall(design), passage.impact, passage.motion.body().entry_speed);
  json["hood"] = hood_json(pipeline::shape_of(*design.hood), passage, impact);
  const bool there = track.motion.arrived() && enters(track.motion);
  json["hood"]["transfer_time_s"] = there ? Json(transfer_time(design, track.motion)) : Json(nullptr);
  const Range spread = landing_spread(design, track);
  json["hood"]["landing_spread_m"] = {*spread.lowest, *spread.highest};
  json["hood"]["not_converged"] = track.early_hood ? Json(track.early_hood->message) : Json(nullptr);
}

}  // namespace

Json pipeline::track_document(const Design& given, const Track& track, Told told) {
  const Design design = as_solved(given, track);
  Json json = task_document(design, track.endpoints);
  json["centerline"] = word(design.centerline.kind);
  add_ride(json, track.motion);
  if (design.feed) {
    const std::optional<Impact> impact = impact_of(track.motion);
    const double entry_speed = enters(track.motion) ? track.motion.body().entry_speed : 0.0;
    json["entry_speed_m_per_s"] = impact ? Json(entry_speed) : Json(nullptr);
    json["feed"] = feed_json(feed_fall(design), impact, entry_speed);
    if (design.hood) add_hood(json, design, track, impact);
  }
  if (design.discharge) {
    json["discharge"] =
        track.motion.arrived() && enters(track.motion) ? discharge_json(design, track.motion) : Json(nullptr);
  }
  if (design.stream) {
    json["stream"]["choking_mass_flow_kg_per_s"] =
        enters(track.motion)
            ? number(choking_mass_flow(track.centerline, track.motion.body(), design.gravity))
            : Json(nullptr);
  }
  json["straight_travel_time_s"] = number(track.straight_travel_time());
  json["optimum_travel_time_s"] = number(track.optimum_travel_time);
  add_curve(json, track);
  json["rides"] = rides_of(track, told);
  json["clearances_from"] = clearances_from_json(design);
  json["limits"] = limits_json(track.limit_checks, track.search ? &*track.search : nullptr);
  json["search"] = track.search ? search_json(*track.search) : Json(nullptr);
  json["fastest_within_limits"] = fastest_within_json(track);
  json["probes"] = probes_json(probe_readings(design, track));
  json["gates"] = track.gates ? gates_json(*track.gates) : Json(nullptr);
  const bool everything = told == Told::everything;
  json["rules"] = everything ? report::rules_json(judge_rules(design, track)) : Json::array();
  if (design.stream) {
    json["wear"] = wear_json(design, track);
    // What flies over the start, or stands there, wears nothing; a reader finds the same keys.
    if (!enters(track.motion)) {
      for (auto& [key, value] : json["wear"].items()) value = nullptr;
    }
    json["verdicts"] = json["rules"];
    json["cases"] = everything ? cases_json(design, track.centerline) : Json::array();
  }
  json["warnings"] = everything ? issues_json(warnings(design, track)) : Json::array();
  return json;
}

std::string track_json(const Design& design, const Track& track) {
  return document_text(pipeline::track_document(design, track));
}

std::string conflict_json(const Design& design, const OptimizeReport& report) {
  return document_text(conflict_document(design, report));
}

namespace pipeline {
namespace {

Json solid_json(const ProvenSolid& swept) {
  Json json = report::mesh_json(swept.facts);
  // Of a mesh that is known to follow a solid, the volume is that solid's.
  json["volume_m3"] = swept.solid.exact_volume;
  json["mesh_volume_m3"] = swept.facts.volume;
  json["max_deviation_m"] = swept.max_deviation;
  const Vec3 offset = swept.offset.value_or(Vec3{});
  json["offset_m"] = {offset.x, offset.y, offset.z};
  json["trimmed"] = swept.solid.trimmed;
  return json;
}

}  // namespace
}  // namespace pipeline

std::string build_json(const Design& design, const Build& build) {
  Json json = pipeline::track_document(design, build.track);
  json["mesh"] = build.has_solid() ? pipeline::solid_json(build.swept()) : Json(nullptr);
  report::add_parts(json, build.fabrication.get());
  if (build.fabrication) {
    // After those of the track, as warnings() has them, which take their time.
    for (Json& one : issues_json(build.fabrication->workshop.shortfalls))
      json["warnings"].push_back(std::move(one));
  }
  json["files"] = Json::array();
  for (const WrittenFile& file : build.files) {
    json["files"].push_back({{"path", file.path.generic_string()}, {"bytes", file.bytes}});
  }
  json["removed_files"] = Json::array();
  for (const auto& file : build.removed) json["removed_files"].push_back(file.generic_string());
  json["set_aside_files"] = Json::array();
  for (const auto& file : build.set_aside) json["set_aside_files"].push_back(file.generic_string());
  return document_text(json);
}

std::string mesh_json(const MeshFacts& facts) {
  return document_text(report::mesh_json(facts));
}

namespace {

/// Gives every item the keys of all of them: null where there is nothing to tell.
void complete_keys(Json& items) {
  Json keys = Json::object();
  for (const Json& item : items) {
    for (const auto& [key, value] : item.items()) keys[key] = nullptr;
  }
  for (Json& item : items) {
    for (const auto& [key, null] : keys.items()) {
      if (!item.contains(key)) item[key] = null;
    }
  }
}

}  // namespace

std::string comparison_json(const Design* common, const std::vector<ComparedTrack>& tracks) {
  Json json =
      common != nullptr ? task_document(*common, endpoints_of(*common)) : Json{{"glissade", version()}};
  json["tracks"] = Json::array();
  for (const ComparedTrack& entry : tracks) {
    if (entry.track != nullptr) {
      json["tracks"].push_back(pipeline::track_document(entry.design, *entry.track));
      json["tracks"].back()["problem"] = nullptr;
      continue;
    }
    json["tracks"].push_back({{"centerline", word(entry.design.centerline.kind)},
                              {"friction_angle_deg", entry.design.body.friction.angle().degrees()},
                              {"problem", entry.problem}});
  }
  complete_keys(json["tracks"]);
  return document_text(json);
}

std::string rules_json(const std::vector<RuleSet>& sets) {
  Json list = Json::array();
  for (const RuleSet& set : sets) {
    // A rule that nothing was held against says all but its verdict.
    std::vector<Judgement> unjudged;
    for (const Rule& rule : set.rules) unjudged.emplace_back().rule = rule;
    Json rules = report::rules_json(unjudged);
    for (Json& rule : rules) {
      for (const char* const key :
           {"verdict", "value", "bound", "side", "margin", "where", "place", "reason"}) {
        rule.erase(key);
      }
    }
    list.push_back({{"name", set.name}, {"title", set.title}, {"rules", std::move(rules)}});
  }
  return document_text({{"glissade", version()}, {"sets", std::move(list)}});
}

std::string rule_quantities_json() {
  Json list = Json::array();
  for (const RuleQuantity& quantity : rule_quantities()) {
    list.push_back({{"quantity", quantity.key},
                    {"unit", unit_for_people(quantity.dimension)},
                    {"of", quantity.subject == RuleSubject::track ? "track" : "fabrication"},
                    {"meaning", quantity.label}});
  }
  return document_text({{"glissade", version()}, {"quantities", std::move(list)}});
}

std::string verdicts_json(const Design& design, const Track& track, const std::vector<Judgement>& judgements,
                          const WorkshopBuild* made) {
  Json json{{"glissade", version()}};
  if (!design.name.empty()) json["name"] = design.name;
  json["verdict"] = to_text(worst(judgements));
  json["rules"] = report::rules_json(judgements);
  json["shop_checks"] = made == nullptr ? Json(nullptr) : report::shop_checks_json(made->workshop.checks);
  json["warnings"] = issues_json(warnings(design, track, made));
  return document_text(json);
}

std::string redesign_json(const Design& design, const Redesign& found) {
  Json json{{"glissade", version()}};
  if (!design.name.empty()) json["name"] = design.name;
  json["goal"] = word(found.goal);
  json["take_off_speed_m_per_s"] = found.take_off.speed;
  json["start_area_m"] = found.start_area > 0.0 ? Json(found.start_area) : Json(nullptr);
  json["shapes"] = Json::array();
  const double drop = found.shapes.front().ends.drop;
  for (const RedesignShape& shape : found.shapes) {
    Json row{{"name", shape.name}};
    row["problem"] = shape.problem.empty() ? Json(nullptr) : Json(shape.problem);
    const bool there = shape.track != nullptr && shape.problem.empty();
    const auto add = [&](const char* key, double value) { row[key] = there ? number(value) : Json(nullptr); };
    add("drop_m", shape.ends.drop);
    add("saved_m", drop - shape.ends.drop);
    add("run_m", shape.ends.run);
    add("length_m", shape.length);
    add("take_off_speed_m_per_s", shape.take_off_speed);
    add("max_normal_load_m_per_s2", shape.highest_load);
    add("max_radial_acceleration_m_per_s2", shape.highest_radial);
    add("curvature_rate_per_m2", shape.curvature_rate);
    add("curvature_jump_per_m", shape.largest_jump);
    row["breaks"] = shape.breaks;
    row["short_straight_m"] = number(shape.short_straight);
    json["shapes"].push_back(std::move(row));
  }
  json["letters"] = Json::array();
  for (const LetterPrice& price : found.prices) {
    json["letters"].push_back({{"letter", price.letter},
                               {"value", price.value},
                               {"drop_m_per_unit", price.price},
                               {"drop_m_per_unit_with_rules",
                                price.price_with_rules ? Json(*price.price_with_rules) : Json(nullptr)},
                               {"rule", price.rule.empty() ? Json(nullptr) : Json(price.rule)},
                               {"certainty", price.certainty ? Json(word(*price.certainty)) : Json(nullptr)},
                               {"held_by_start_area", price.by_start_area},
                               {"needs_checking", price.certainty && needs_checking(*price.certainty)}});
  }
  json["search"] = found.search ? search_json(*found.search) : Json(nullptr);
  return document_text(json);
}

std::string fit_json(const std::vector<SpeedReading>& readings, const SpeedFit& fit,
                     const std::vector<SpeedResidual>& as_designed) {
  Json json{{"glissade", version()}};
  json["friction_coefficient"] = fit.friction;
  json["friction_coefficient_uncertainty"] = number(fit.friction_uncertainty);
  json["drag_per_m"] = fit.drag;
  json["drag_uncertainty_per_m"] = number(fit.drag_uncertainty);
  json["correlation"] = number(fit.correlation);
  json["rms_m_per_s"] = fit.rms;
  const CommonResistance designed = common_resistance(readings);
  json["design_friction_coefficient"] = number(designed.friction);
  json["design_drag_per_m"] = number(designed.drag);
  json["design_rms_m_per_s"] = rms_of(as_designed);
  json["speeds"] = Json::array();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const SpeedReading& reading = readings[i];
    json["speeds"].push_back({{"name", reading.name},
                              {"distance_to_edge_m", reading.track->length() - reading.from_start},
                              {"before_edge_m", reading.track->length() - reading.place},
                              {"count", reading.count},
                              {"measured_m_per_s", reading.speed},
                              {"design_m_per_s", as_designed[i].computed},
                              {"fitted_m_per_s", fit.residuals[i].computed}});
  }
  return document_text(json);
}

std::string rides_json(const Design& design, const Track& track, const std::vector<Track>& rides) {
  const std::optional<Angle> stall_angle = stall_angle_of(track);
  Json json = pipeline::track_document(design, track);
  json["at_frictions"] = Json::array();
  for (const Track& ride : rides) {
    Json entry = ride_json(FrictionLevel::nominal, ride.motion, stall_angle);
    entry.erase("friction");
    entry["limits"] = limits_json(ride.limit_checks, nullptr);
    json["at_frictions"].push_back(std::move(entry));
  }
  return document_text(json);
}

}  // namespace glissade
