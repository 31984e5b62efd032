#include "app/json.hpp"

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/version.hpp"

#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

namespace glissade::app {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double radians) {
  return Angle::from_radians(radians).degrees();
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json point(const Vec3& position) {
  return Json::array({position.x, position.y, position.z});
}

Json profile_json(const FittedProfile& profile) {
  return {{"points", profile.points().size()},
          {"max_deviation_m", profile.max_deviation()},
          {"max_deviation_at_point", profile.farthest_point() + 1},
          {"rms_deviation_m", profile.rms_deviation()}};
}

Json constant_speed_json(const ConstantSpeedCurve& curve) {
  return {{"p_m2_per_s2", curve.p()},
          {"speed_m_per_s", std::sqrt(curve.p())},
          {"travel_time_at_that_speed_s", curve.travel_time_at_constant_speed()}};
}

Json stall_json(const std::optional<Stall>& stall) {
  if (!stall) return nullptr;
  return {{"arc_length_m", stall->arc_length}, {"missing_slope_deg", degrees(stall->missing_slope)}};
}

Json lift_off_json(const std::optional<LiftOff>& lift_off) {
  if (!lift_off) return nullptr;
  return {{"arc_length_m", lift_off->arc_length},
          {"speed_m_per_s", lift_off->speed},
          {"curvature_per_m", lift_off->curvature}};
}

/// A bound, a violation, a price: angles in degrees, everything else in SI units.
Json in_unit(double value, const std::string& unit) {
  return number(unit == "rad" ? degrees(value) : value);
}

std::string unit_name(const std::string& unit) {
  return unit == "rad" ? "deg" : unit;
}

const char* side_name(int side) {
  if (side == 0) return "exactly";
  return side > 0 ? "at most" : "at least";
}

Json check_json(const LimitCheck& check) {
  return {{"limit", check.limit},
          {"side", side_name(check.side)},
          {"bound", in_unit(check.value, check.unit)},
          {"reached", in_unit(check.reached, check.unit)},
          {"unit", unit_name(check.unit)},
          {"at_m", check.where},
          {"kept", check.kept()},
          {"violation", in_unit(check.violation, check.unit)},
          {"violation_of_scale", number(check.violation / check.scale)}};
}

Json active_json(const ActiveLimit& active, bool speed_counts) {
  Json where = Json::array();
  for (const Stretch& stretch : active.where)
    where.push_back({{"from_m", stretch.from}, {"to_m", stretch.to}});
  // A price is per unit: what is a value of one radian is a price of 57.3 times as much as one per degree.
  const double price = active.unit == "rad" ? active.price / degrees(1.0) : active.price;
  return {{"limit", active.limit},
          {"bound", in_unit(active.value, active.unit)},
          {"unit", unit_name(active.unit)},
          {"where", std::move(where)},
          {"price", number(price)},
          {"price_unit", (speed_counts ? "m/s per " : "s per ") + unit_name(active.unit)}};
}

Json search_json(const Design& design, const OptimizeReport& report) {
  const bool speed_counts = design.limits && design.limits->objective.kind == ObjectiveDesignKind::exit_speed;
  const bool found = report.travel_time > 0.0;
  Json json;
  json["status"] = to_text(report.status);
  json["message"] = report.message;
  json["unlimited_travel_time_s"] = number(report.unlimited_travel_time);
  json["excess_over_unlimited"] = found && report.unlimited_travel_time
                                      ? number(report.travel_time / *report.unlimited_travel_time - 1.0)
                                      : Json(nullptr);
  json["first_order_residual"] = found ? number(report.first_order_residual) : Json(nullptr);
  json["active"] = Json::array();
  for (const ActiveLimit& active : report.active) json["active"].push_back(active_json(active, speed_counts));
  json["rounds"] = report.iterations;
  json["evaluations"] = report.evaluations;
  json["seconds"] = report.seconds;
  return json;
}

std::string_view status(const Motion& motion) {
  if (motion.arrived()) return "arrived";
  return motion.stall() ? "stalled" : "lifted off";
}

}  // namespace

Json input_json(const Design& design) {
  const Endpoints endpoints = endpoints_of(design);
  Json json;
  json["glissade"] = version();
  if (!design.name.empty()) json["name"] = design.name;
  json["run_m"] = endpoints.run;
  json["drop_m"] = endpoints.drop;
  json["friction_coefficient"] = design.body.friction.coefficient();
  json["friction_angle_deg"] = design.body.friction.angle().degrees();
  json["entry_speed_m_per_s"] = design.body.entry_speed;
  json["drag_per_m"] = design.body.drag_per_metre;
  json["gravity_m_per_s2"] = design.gravity;
  return json;
}

Json track_json(const Design& design, const Track& track) {
  const Centerline& centerline = *track.centerline;
  const Motion& motion = track.motion;
  const MotionState highest = motion.highest_load();
  Json json = input_json(design);
  json["run_m"] = track.endpoints.run;
  json["drop_m"] = track.endpoints.drop;
  json["centerline"] = word(design.centerline.kind);
  json["status"] = status(motion);
  json["travel_time_s"] = number(motion.arrived() ? std::optional(motion.travel_time()) : std::nullopt);
  json["straight_travel_time_s"] = number(track.straight_travel_time());
  json["optimum_travel_time_s"] = number(track.optimum_travel_time);
  json["exit_speed_m_per_s"] = number(motion.arrived() ? std::optional(motion.exit_speed()) : std::nullopt);
  json["highest_speed_m_per_s"] = motion.highest_speed().speed;
  json["entry_slope_angle_deg"] = degrees(centerline.slope_angle(0.0));
  json["exit_slope_angle_deg"] = degrees(centerline.slope_angle(centerline.length()));
  json["steepest_slope_angle_deg"] = degrees(track.steepest_slope_angle);
  json["arc_length_m"] = centerline.length();
  json["min_radius_m"] = number(track.min_radius);
  json["max_normal_load_m_per_s2"] = number(highest.normal_load);
  json["max_normal_load_at_m"] = highest.arc_length;
  json["min_normal_load_m_per_s2"] = number(motion.lowest_load().normal_load);
  const MotionState end = motion.at(motion.distance());
  json["friction_loss_j_per_kg"] = end.friction_loss;
  json["drag_loss_j_per_kg"] = end.drag_loss;
  json["stall"] = stall_json(motion.stall());
  json["lift_off"] = lift_off_json(motion.lift_off());
  if (const auto* const profile = dynamic_cast<const FittedProfile*>(&centerline)) {
    json["profile"] = profile_json(*profile);
  }
  if (const auto* const curve = dynamic_cast<const ConstantSpeedCurve*>(&centerline)) {
    json["constant_speed"] = constant_speed_json(*curve);
  }
  json["limits"] = Json::array();
  for (const LimitCheck& check : track.limit_checks) json["limits"].push_back(check_json(check));
  json["search"] = track.search ? search_json(design, *track.search) : Json(nullptr);
  return json;
}

Json conflict_json(const Design& design, const OptimizeReport& report) {
  Json json = input_json(design);
  json["centerline"] = word(design.centerline.kind);
  json["status"] = to_text(report.status);
  json["search"] = search_json(design, report);
  json["search"]["conflict"] = Json::array();
  for (const StatedLimit& stated : report.conflict.limits) json["search"]["conflict"].push_back(stated.limit);
  json["search"]["relaxations"] = Json::array();
  for (const Relaxation& relaxation : report.conflict.relaxations) {
    json["search"]["relaxations"].push_back({{"limit", relaxation.limit},
                                             {"bound", in_unit(relaxation.value, relaxation.unit)},
                                             {"needed", in_unit(relaxation.needed, relaxation.unit)},
                                             {"unit", unit_name(relaxation.unit)}});
  }
  return json;
}

Json facts_json(const MeshFacts& facts) {
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
  json["duplicate_vertices"] = facts.duplicate_vertices;
  json["unused_vertices"] = facts.unused_vertices;
  json["euler_characteristic"] = facts.euler_characteristic;
  json["volume_m3"] = facts.volume;
  json["area_m2"] = facts.area;
  json["smallest_angle_deg"] = degrees(facts.smallest_angle);
  json["shortest_edge_m"] = facts.shortest_edge;
  json["lower_m"] = point(facts.lower);
  json["upper_m"] = point(facts.upper);
  json["faults"] = facts.faults();
  return json;
}

Json build_json(const Design& design, const Build& build) {
  Json json = track_json(design, build.track);
  Json mesh = facts_json(build.facts);
  mesh["max_deviation_m"] = build.solid.max_deviation;
  mesh["trimmed"] = build.solid.trimmed;
  json["mesh"] = std::move(mesh);
  json["files"] = Json::array();
  for (const WrittenFile& file : build.files) {
    json["files"].push_back({{"path", file.path.generic_string()}, {"bytes", file.bytes}});
  }
  return json;
}

std::string document(const Json& json) {
  // A name may hold bytes that are no UTF-8: they are replaced rather than refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace glissade::app
