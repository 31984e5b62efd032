#include "report/serial/vocabulary.hpp"

#include "glissade/core/quantity.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "report/serial/law.hpp"
#include "report/serial/stream.hpp"

#include <cmath>
#include <utility>

namespace glissade::report {
namespace {

Json stall_json(const std::optional<Stall>& stall) {
  if (!stall) return nullptr;
  return {{"arc_length_m", stall->arc_length}, {"missing_slope_deg", degrees(stall->missing_slope)}};
}

Json lift_off_json(const std::optional<LiftOff>& lift_off) {
  if (!lift_off) return nullptr;
  return {{"arc_length_m", lift_off->arc_length},
          {"speed_m_per_s", lift_off->speed},
          {"curvature_per_m", number(lift_off->curvature)}};
}

const char* side_name(Bound bound) {
  if (bound == Bound::exactly) return "exactly";
  return bound == Bound::highest ? "at most" : "at least";
}

/// A bound or a violation: angles in degrees, everything else in SI units.
Json in_unit(double value, const LimitName& limit) {
  return number(in_unit_for_people(value, limit.dimension()));
}

Json level_json(const std::optional<FrictionLevel>& level) {
  return level ? Json(to_text(*level)) : Json(nullptr);
}

Json conflict_json(const Conflict& conflict) {
  Json limits = Json::array();
  for (const StatedLimit& stated : conflict.limits) limits.push_back(stated.limit.key());
  return limits;
}

Json relaxations_json(const Conflict& conflict) {
  Json relaxations = Json::array();
  for (const Relaxation& relaxation : conflict.relaxations) {
    relaxations.push_back({{"limit", relaxation.limit.key()},
                           {"bound", in_unit(relaxation.value, relaxation.limit)},
                           {"needed", in_unit(relaxation.needed, relaxation.limit)},
                           {"unit", unit_for_people(relaxation.limit.dimension())}});
  }
  return relaxations;
}

}  // namespace

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json position_json(Vec3 position) {
  return Json::array({position.x, position.y, position.z});
}

void add_friction(Json& json, const Friction& friction) {
  json["friction_coefficient"] = friction.coefficient();
  json["friction_angle_deg"] = friction.angle().degrees();
}

void add_body(Json& json, const Design& design) {
  add_friction(json, design.body.friction);
  json["entry_speed_m_per_s"] = design.body.entry_speed;
  json["drag_per_m"] = design.body.drag_per_metre;
  json["gravity_m_per_s2"] = design.gravity;
  add_law_body(json, design.body);
  add_stream_body(json, design);
}

void add_ride(Json& json, const Motion& motion) {
  // Nothing follows from an impact that does not take place, or leaves nothing.
  const bool there = enters(motion);
  const auto told = [&](double value) { return there ? number(value) : Json(nullptr); };
  const auto at_finish = [&](double value) { return motion.arrived() ? told(value) : Json(nullptr); };
  const MotionState fastest = motion.highest_speed();
  const MotionState heaviest = motion.highest_load();
  const MotionState lightest = motion.lowest_load();
  const MotionState end = motion.at(motion.distance());
  json["status"] = status_of(motion);
  json["travel_time_s"] = at_finish(motion.travel_time());
  json["exit_speed_m_per_s"] = at_finish(motion.exit_speed());
  json["highest_speed_m_per_s"] = told(fastest.speed);
  json["highest_speed_at_m"] = told(fastest.arc_length);
  json["max_normal_load_m_per_s2"] = told(heaviest.normal_load);
  json["max_normal_load_at_m"] = told(heaviest.arc_length);
  json["min_normal_load_m_per_s2"] = told(lightest.normal_load);
  json["min_normal_load_at_m"] = told(lightest.arc_length);
  json["friction_loss_j_per_kg"] = told(end.friction_loss);
  json["drag_loss_j_per_kg"] = told(end.drag_loss);
  json["stall"] = there ? stall_json(motion.stall()) : Json(nullptr);
  json["lift_off"] = there ? lift_off_json(motion.lift_off()) : Json(nullptr);
  add_law(json, motion);
  add_stream(json, motion);
}

Json ride_json(FrictionLevel level, const Motion& motion, const std::optional<Angle>& stall_angle) {
  const Friction friction = motion.body().friction;
  Json json;
  json["friction"] = to_text(level);
  add_friction(json, friction);
  add_ride(json, motion);
  json["stall_friction_angle_deg"] = stall_angle ? Json(stall_angle->degrees()) : Json(nullptr);
  json["stall_margin_deg"] =
      stall_angle ? Json(stall_angle->degrees() - friction.angle().degrees()) : Json(nullptr);
  return json;
}

Json closest_json(const std::optional<EnvelopePlace>& closest) {
  if (!closest) return nullptr;
  return {{"part", to_text(closest->part)},
          {"height_m", closest->height},
          {"x_m", closest->point.x},
          {"z_m", closest->point.y}};
}

Json active_json(const ActiveLimit& active, const Objective& objective) {
  Json where = Json::array();
  for (const Stretch& stretch : active.where)
    where.push_back({{"from_m", stretch.from}, {"to_m", stretch.to}});
  return {{"limit", active.limit.key()},
          {"bound", in_unit(active.value, active.limit)},
          {"unit", unit_for_people(active.limit.dimension())},
          {"where", std::move(where)},
          {"price", number(price_for_people(active.price, active.limit))},
          {"tightening_price", number(price_for_people(active.tightening(), active.limit))},
          {"price_error", active.price_error},
          {"price_unit", price_unit(active.limit, objective)}};
}

Json limit_json(const LimitCheck& check, const ActiveLimit* active, const Objective& objective) {
  Json json = {{"limit", check.limit.key()},
               {"side", side_name(check.limit.bound)},
               {"bound", in_unit(check.value, check.limit)},
               {"reached", in_unit(check.reached, check.limit)},
               {"unit", unit_for_people(check.limit.dimension())},
               {"at_m", check.where},
               {"closest", closest_json(check.closest)},
               {"friction", level_json(check.friction)},
               {"kept", check.kept()},
               {"violation", in_unit(check.violation, check.limit)},
               {"violation_of_scale", number(check.violation / check.scale)}};
  const Json prices = active != nullptr ? active_json(*active, objective) : Json::object();
  for (const char* key : {"where", "price", "tightening_price", "price_error", "price_unit"})
    json[key] = prices.value(key, Json(nullptr));
  return json;
}

Json search_json(const OptimizeReport& report) {
  const bool found = report.travel_time > 0.0;
  const bool contradictory = report.status == OptimizeStatus::infeasible;
  const bool told = contradictory || !report.conflict.relaxations.empty();
  Json json;
  json["status"] = to_text(report.status);
  json["message"] = report.message;
  json["unlimited_travel_time_s"] = number(report.unlimited_travel_time);
  json["excess_over_unlimited"] = found && report.unlimited_travel_time
                                      ? number(report.travel_time / *report.unlimited_travel_time - 1.0)
                                      : Json(nullptr);
  json["first_order_residual"] = found ? number(report.first_order_residual) : Json(nullptr);
  json["finer_mesh_wins"] = found ? number(report.finer_mesh_wins) : Json(nullptr);
  json["active"] = Json::array();
  for (const ActiveLimit& active : report.active)
    json["active"].push_back(active_json(active, report.objective));
  json["rounds"] = report.iterations;
  json["evaluations"] = report.evaluations;
  json["seconds"] = report.seconds;
  json["conflict"] = contradictory ? conflict_json(report.conflict) : Json(nullptr);
  json["relaxations"] = told ? relaxations_json(report.conflict) : Json(nullptr);
  return json;
}

Json probes_json(const std::vector<ProbeReading>& probes) {
  Json list = Json::array();
  for (const ProbeReading& probe : probes) {
    Json states = Json::array();
    for (const ProbeState& state : probe.states) {
      const auto& motion = state.motion;
      states.push_back({{"friction", to_text(state.level)},
                        {"time_s", motion ? number(motion->time) : Json(nullptr)},
                        {"speed_m_per_s", motion ? number(motion->speed) : Json(nullptr)},
                        {"normal_load_m_per_s2", motion ? number(motion->normal_load) : Json(nullptr)}});
    }
    list.push_back({{"name", probe.name},
                    {"arc_length_m", probe.point.arc_length},
                    {"x_m", probe.point.x},
                    {"drop_m", probe.point.drop},
                    {"position_m", position_json(probe.position)},
                    {"slope_angle_deg", degrees(probe.point.slope_angle)},
                    {"curvature_per_m", number(probe.point.curvature)},
                    {"states", std::move(states)}});
  }
  return list;
}

namespace {

/// How a gate rides in one condition.
void add_gate_ride(Json& json, const GateRide& ride) {
  const auto told = [&](double value) { return ride.arrived ? number(value) : Json(nullptr); };
  json["travel_time_s"] = told(ride.travel_time);
  const auto measured = [&](auto value) {
    return ride.speed_at_measuring_place && ride.slopes ? number(value()) : Json(nullptr);
  };
  json["speed_at_measuring_place_m_per_s"] = measured([&] { return *ride.speed_at_measuring_place; });
  json["speed_at_edge_m_per_s"] = told(ride.speed_at_edge);
  json["max_normal_load_m_per_s2"] = number(ride.highest_load);
  json["max_normal_load_at_m"] = number(ride.highest_load_at);
  json["min_normal_load_m_per_s2"] = number(ride.lowest_load);
  json["max_radial_acceleration_m_per_s2"] = number(ride.highest_radial);
  json["speed_by_friction_m_per_s"] = measured([&] { return ride.slopes->by_friction; });
  json["speed_by_drag_m2_per_s"] = measured([&] { return ride.slopes->by_drag; });
  json["speed_by_length_per_s"] = measured([&] { return ride.slopes->by_length; });
}

}  // namespace

Json gates_json(const GateTable& table) {
  Json list = Json::array();
  for (std::size_t i = 0; i < table.gates.size(); ++i) {
    Json gate{{"gate", table.gates[i].number},
              {"distance_to_edge_m", table.gates[i].to_edge},
              {"x_m", table.positions[i].x},
              {"y_m", table.positions[i].y},
              {"z_m", table.positions[i].z}};
    add_gate_ride(gate, table.conditions.front().rides[i]);
    gate["conditions"] = Json::object();
    for (std::size_t k = 1; k < table.conditions.size(); ++k) {
      Json& ridden = gate["conditions"][table.conditions[k].name];
      add_friction(ridden, table.conditions[k].body.friction);
      ridden["drag_per_m"] = table.conditions[k].body.drag_per_metre;
      ridden["head_wind_m_per_s"] = table.conditions[k].body.head_wind;
      add_gate_ride(ridden, table.conditions[k].rides[i]);
    }
    list.push_back(std::move(gate));
  }
  return list;
}

Json rules_json(const std::vector<Judgement>& judgements) {
  Json list = Json::array();
  for (const Judgement& judgement : judgements) {
    const Rule& rule = judgement.rule;
    const Dimension dimension = rule_quantity(rule.quantity)->dimension;
    const auto in_unit = [&](const std::optional<double>& value) {
      return value ? number(in_unit_for_people(*value, dimension)) : Json(nullptr);
    };
    list.push_back({{"id", rule.id},
                    {"verdict", to_text(judgement.verdict)},
                    {"value", in_unit(judgement.value)},
                    {"bound", in_unit(judgement.bound)},
                    {"side", judgement.bound ? Json(judgement.bound_is_highest ? "at most" : "at least")
                                             : Json(nullptr)},
                    {"margin", in_unit(judgement.margin)},
                    {"unit", unit_for_people(dimension)},
                    {"where", number(judgement.arc_length)},
                    {"place", judgement.place},
                    {"quantity", rule.quantity},
                    {"lowest", in_unit(rule.bound.lowest)},
                    {"highest", in_unit(rule.bound.highest)},
                    {"advice", rule.advice},
                    {"sentence", rule.sentence},
                    {"source", rule.source},
                    {"certainty", word(rule.certainty)},
                    {"needs_checking", needs_checking(rule.certainty)},
                    {"reason", judgement.reason.empty() ? Json(nullptr) : Json(judgement.reason)}});
  }
  return list;
}

Json issues_json(const std::vector<Issue>& issues) {
  Json list = Json::array();
  for (const Issue& issue : issues) {
    list.push_back({{"where", issue.where}, {"what", issue.what}, {"why", issue.why}, {"hint", issue.hint}});
  }
  return list;
}

Json mesh_json(const MeshFacts& facts) {
  Json json;
  json["valid"] = facts.valid();
  json["watertight"] = facts.watertight();
  json["oriented_outward"] = facts.oriented_outward;
  json["triangles"] = facts.triangles;
  json["vertices"] = facts.vertices;
  json["components"] = facts.components;
  json["self_intersections"] = facts.self_intersections;
  json["boundary_edges"] = facts.boundary_edges;
  json["non_manifold_edges"] = facts.non_manifold_edges;
  json["non_manifold_vertices"] = facts.non_manifold_vertices;
  json["degenerate_facets"] = facts.degenerate_facets;
  json["inside_out_pieces"] = facts.inside_out_pieces;
  json["nested_pieces"] = facts.nested_pieces;
  json["duplicate_vertices"] = facts.duplicate_vertices;
  json["unused_vertices"] = facts.unused_vertices;
  json["euler_characteristic"] = facts.euler_characteristic;
  json["volume_m3"] = facts.volume;
  json["area_m2"] = facts.area;
  json["smallest_angle_deg"] = degrees(facts.smallest_angle);
  json["shortest_edge_m"] = facts.shortest_edge;
  json["lower_m"] = position_json(facts.lower);
  json["upper_m"] = position_json(facts.upper);
  json["faults"] = facts.faults();
  return json;
}

std::string document_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace glissade::report
