#include "report/serial/law.hpp"

#include <cstddef>
#include <vector>

namespace glissade::report {
namespace {

Json law_end_json(const std::optional<LawEnd>& end) {
  if (!end) return nullptr;
  return {{"what", end->what},
          {"arc_length_m", end->arc_length},
          {"speed_m_per_s", end->speed},
          {"value", number(end->value)},
          {"bound", end->bound}};
}

Json quantity_json(const LawQuantity& quantity, const QuantityPeak& peak) {
  return {{"quantity", quantity.key},  {"highest", number(peak.value)},
          {"at_m", peak.arc_length},   {"bound", number(quantity.highest)},
          {"kept", !peak.beyond_from}, {"beyond_from_m", number(peak.beyond_from)}};
}

}  // namespace

std::string_view status_of(const Motion& motion) {
  if (motion.arrived()) return "arrived";
  if (motion.stall()) return "stalled";
  if (motion.lift_off()) return "lifted off";
  return motion.law_end()->what == "valley_radius_m" ? "does not fit" : "choked";
}

void add_law_body(Json& json, const BodyDesign& body) {
  if (body.rolling) {
    const RollingDesign& ball = *body.rolling;
    json["body"] = "rolling";
    json["rolling_resistance"] = body.friction.coefficient();
    json["radius_m"] = ball.radius;
    json["groove_half_angle_deg"] = ball.groove_half_angle.degrees();
    json["grip_coefficient"] = ball.grip ? Json(ball.grip->coefficient()) : Json(nullptr);
  }
  if (body.centre_height) json["centre_height_m"] = *body.centre_height;
  if (body.head_wind != 0.0) json["head_wind_m_per_s"] = body.head_wind;
  if (body.friction_changes.empty()) return;
  json["friction_along_the_track"] = Json::array();
  for (const FrictionFrom& change : body.friction_changes) {
    Json entry = {{"from_m", change.from}};
    add_friction(entry, change.friction);
    json["friction_along_the_track"].push_back(std::move(entry));
  }
}

void add_law(Json& json, const Motion& motion) {
  if (!motion.body().law) return;
  json["inertia_factor"] = motion.body().law->inertia();
  json["law_end"] = law_end_json(motion.law_end());
  json["law"] = Json::array();
  const std::vector<LawQuantity> quantities = motion.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    json["law"].push_back(quantity_json(quantities[i], motion.highest(i)));
  }
}

}  // namespace glissade::report
