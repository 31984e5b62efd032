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

/// @param peak  null of what does not enter its track
Json quantity_json(const LawQuantity& quantity, const QuantityPeak* peak) {
  return {{"quantity", quantity.key},
          {"highest", peak != nullptr ? number(peak->value) : Json(nullptr)},
          {"at_m", peak != nullptr ? Json(peak->arc_length) : Json(nullptr)},
          {"bound", number(quantity.highest)},
          {"kept", peak != nullptr ? Json(!peak->beyond_from) : Json(nullptr)},
          {"beyond_from_m", peak != nullptr ? number(peak->beyond_from) : Json(nullptr)}};
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
  return to_text(ride_end(motion));
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
  json["law_end"] = enters(motion) ? law_end_json(motion.law_end()) : Json(nullptr);
  json["law"] = Json::array();
  const std::vector<LawQuantity> quantities = motion.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const QuantityPeak peak = motion.highest(i);
    json["law"].push_back(quantity_json(quantities[i], enters(motion) ? &peak : nullptr));
  }
}

}  // namespace glissade::report
