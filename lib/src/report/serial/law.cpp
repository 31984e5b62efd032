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

/// Tells each measure of a kind of body, its unit in its key.
class KindJson {
 public:
  KindJson(const BodyDesign& body, Json& json) : body_(body), json_(json) {}

  void resistance(const char* key, const char*) { json_[key] = body_.friction.coefficient(); }
  void length(const std::string& key, double value, double, double, const char*, const char*) {
    json_[key + "_m"] = value;
  }
  void angle(const std::string& key, Angle value, Angle, const char*, const char*) {
    json_[key + "_deg"] = value.degrees();
  }
  void grip(const std::optional<Friction>& value, const char*) {
    json_["grip_coefficient"] = value ? Json(value->coefficient()) : Json(nullptr);
  }

 private:
  const BodyDesign& body_;
  Json& json_;
};

}  // namespace

std::string_view status_of(const Motion& motion) {
  if (!lands(motion)) return "flies over the start";
  if (motion.arrived()) return "arrived";
  if (motion.stall()) return "stalled";
  if (motion.lift_off()) return "lifted off";
  return motion.law_end()->what == "valley_radius_m" ? "does not fit" : "choked";
}

void add_law_body(Json& json, const BodyDesign& body) {
  if (!body.slides()) {
    json["body"] = std::visit([](const auto& kind) { return kind.kKind; }, body.kind);
    visit_measures(body, KindJson(body, json));
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
