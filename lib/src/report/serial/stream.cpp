#include "report/serial/stream.hpp"

#include "glissade/trades/chute/stream.hpp"

#include <algorithm>
#include <optional>

namespace glissade::report {
namespace {

Json choke_json(const std::optional<Choke>& choke) {
  if (!choke) return nullptr;
  return {{"arc_length_m", choke->arc_length},
          {"speed_m_per_s", choke->speed},
          {"depth_m", choke->depth},
          {"bound_m", choke->bound},
          {"over_wall", choke->over_wall}};
}

/// V2/V1: friction takes no more than all of it.
double ratio_left(const Impact& impact) {
  return std::max(0.0, impact.speed_ratio);
}

}  // namespace

void add_stream_body(Json& json, const Design& design) {
  if (!design.stream) return;
  const StreamDesign& stream = *design.stream;
  json["body"] = "stream";
  json["mass_flow_kg_per_s"] = stream.mass_flow;
  json["bulk_density_kg_per_m3"] = stream.bulk_density;
  json["lump_size_m"] = number(stream.lump_size);
  json["lateral_pressure_ratio"] = stream.lateral_pressure_ratio;
  json["slip_ratio"] = stream.slip_ratio;
  json["surge"] = stream.surge;
  json["trickle"] = stream.trickle;
  if (!stream.material) return;
  json["material"] = stream.material->material;
  json["liner"] = stream.material->liner;
  json["moisture"] = number(stream.material->moisture);
}

Json feed_json(const FeedFall& fall, const std::optional<Impact>& impact, double entry_speed) {
  const auto if_it_lands = [&](double value) { return impact ? Json(value) : Json(nullptr); };
  return {{"speed_m_per_s", fall.landing.speed},
          {"angle_deg", degrees(fall.landing.angle)},
          {"impact_angle_deg", if_it_lands(impact ? degrees(impact->angle) : 0.0)},
          {"speed_ratio", if_it_lands(impact ? ratio_left(*impact) : 0.0)},
          {"entry_speed_m_per_s", if_it_lands(impact && ratio_left(*impact) > 0.0 ? entry_speed : 0.0)},
          {"impact_pressure_pa", if_it_lands(impact ? impact->pressure : 0.0)},
          {"reach_m", fall.reach},
          {"time_s", fall.time},
          {"leaves_pulley_at_deg", degrees(fall.leaves_at)},
          {"pulley_run_m", fall.pulley.x},
          {"pulley_height_m", fall.pulley.y}};
}

Json hood_passage_json(const HoodPassage& passage) {
  const Motion& motion = passage.motion;
  const ValueAt wear = stream_peak(motion, &StreamState::floor_wear);
  // What stands where it meets the hood is no stream below it.
  const bool there = passage.impact.speed_ratio > 0.0;
  const auto told = [&](double value) { return there ? number(value) : Json(nullptr); };
  return {{"holds", passage.holds()},
          {"contact_at_entry", told(passage.contact)},
          {"least_contact", told(passage.least_contact)},
          {"impact_angle_deg", passage.impact.angle.degrees()},
          {"impact_speed_ratio", ratio_left(passage.impact)},
          {"impact_pressure_pa", passage.impact.pressure},
          {"entry_speed_m_per_s", told(motion.body().entry_speed)},
          {"exit_speed_m_per_s", told(motion.exit_speed())},
          {"max_depth_m", told(motion.highest(BulkStream::kDepth).value)},
          {"highest_wear_w_per_m2", told(wear.value)},
          {"highest_wear_at_m", told(wear.arc_length)},
          {"friction_loss_j_per_kg", told(motion.at(motion.distance()).friction_loss)},
          {"travel_time_s", told(motion.travel_time())},
          {"fall_time_s", told(passage.fall_time)},
          {"reach_m", told(passage.reach)},
          {"landing_speed_m_per_s", told(passage.landing.speed)},
          {"landing_angle_deg", told(passage.landing.angle.degrees())}};
}

Json hood_json(const HoodShape& hood, const HoodPassage& passage, const std::optional<Impact>& impact) {
  Json json = hood_passage_json(passage);
  const Centerline& arc = passage.motion.centerline();
  json["radius_m"] = hood.radius;
  json["entry_slope_angle_deg"] = degrees(arc.slope_angle(0.0));
  json["exit_slope_angle_deg"] = hood.exit_slope.degrees();
  json["arc_length_m"] = arc.length();
  json["drop_m"] = hood.drop;
  // Seen from the start of the track, upwards positive.
  json["entry_run_m"] = -passage.start.x;
  json["entry_height_m"] = passage.start.y;
  const CenterlinePoint edge = arc.at(arc.length());
  json["edge_run_m"] = edge.x - passage.start.x;
  json["edge_height_m"] = passage.start.y - edge.drop;
  json["landing"] = {{"impact_angle_deg", impact ? Json(impact->angle.degrees()) : Json(nullptr)},
                     {"speed_ratio", impact ? Json(ratio_left(*impact)) : Json(nullptr)},
                     {"impact_pressure_pa", impact ? Json(impact->pressure) : Json(nullptr)}};
  return json;
}

Json belt_landing_json(const BeltLanding& landing) {
  return {{"speed_along_belt_m_per_s", landing.speed_along},
          {"speed_into_belt_m_per_s", landing.speed_into},
          {"speed_across_belt_m_per_s", landing.speed_across},
          {"landing_speed_m_per_s", landing.speed},
          {"speed_along_over_belt_speed", landing.match},
          {"belt_wear_factor", landing.wear_factor},
          {"belt_wear_w_per_m2", landing.wear},
          {"reach_m", landing.reach},
          {"off_centre_m", landing.off_centre},
          {"time_s", landing.time}};
}

void add_stream(Json& json, const Motion& motion) {
  const std::optional<StreamFacts> facts = stream_facts(motion);
  if (!facts) return;
  // What does not enter its track is no stream on it.
  const bool there = enters(motion);
  const auto told = [&](double value) { return there ? number(value) : Json(nullptr); };
  json["stream"] = {{"max_depth_m", told(facts->deepest.value)},
                    {"max_depth_at_m", told(facts->deepest.arc_length)},
                    {"exit_depth_m", there ? number(facts->exit_depth) : Json(nullptr)},
                    {"highest_equivalent_friction", told(facts->equivalent_friction.value)},
                    {"highest_equivalent_friction_at_m", told(facts->equivalent_friction.arc_length)},
                    {"highest_filling", told(facts->filling.value)},
                    {"highest_filling_at_m", told(facts->filling.arc_length)},
                    {"choked", there && facts->choke.has_value()},
                    {"choke", there ? choke_json(facts->choke) : Json(nullptr)}};
}

}  // namespace glissade::report
