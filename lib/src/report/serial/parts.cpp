#include "report/serial/parts.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace glissade::report {
namespace {

Json master_json(const MasterCurve& master) {
  return {{"arcs", master.arcs},
          {"lower_bound", master.lower_bound},
          {"tolerance_m", master.tolerance},
          {"max_deviation_m", master.max_deviation},
          {"straight", master.lines},
          {"kept", master.kept}};
}

Json part_json(const ShopPart& part) {
  const Vec3 centre = part.centre_of_gravity;
  return {{"number", part.number},       {"name", part.name},
          {"material", part.material},   {"thickness_m", part.thickness},
          {"quantity", part.quantity()}, {"mass_kg", part.mass},
          {"volume_m3", part.volume},    {"centre_of_gravity_m", {centre.x, centre.y, centre.z}},
          {"files", part.files}};
}

Json nest_json(const NestedSheet& sheet, const Workshop& workshop) {
  std::map<int, std::size_t> counts;
  for (const NestedPiece& piece : sheet.pieces) ++counts[workshop.parts[piece.part].number];
  Json parts = Json::array();
  for (const auto& [number, count] : counts) parts.push_back({{"number", number}, {"quantity", count}});
  const NestStock& stock = sheet.stock;
  return {{"name", sheet.name},
          {"material", sheet.material},
          {"thickness_m", sheet.thickness},
          {"sheet_m", {stock.width, stock.height}},
          {"margin_m", stock.margin},
          {"spacing_m", stock.spacing},
          {"pieces", sheet.pieces.size()},
          {"parts", std::move(parts)},
          {"parts_area_m2", sheet.utilisation * stock.width * stock.height},
          {"utilisation", sheet.utilisation},
          {"file", sheet.file}};
}

Json ride_json(const AsBuiltRide& ride) {
  Json json = {{"arrives", ride.arrives},
               {"travel_time_s", nullptr},
               {"exit_speed_m_per_s", nullptr},
               {"exit_speed_change", nullptr},
               {"bends", ride.bends},
               {"joints", ride.joints},
               {"joint_step_m", ride.joint_step},
               {"highest_step_m", ride.highest_step},
               {"joint_play_m", ride.joint_play},
               {"highest_load_m_per_s2", nullptr},
               {"hops", ride.hops},
               {"highest_hop_m", ride.highest_hop},
               {"stopped", nullptr}};
  if (!ride.arrives) json["stopped"] = ride.stopped;
  if (!ride.arrives) return json;
  json["travel_time_s"] = ride.travel_time;
  json["exit_speed_m_per_s"] = ride.exit_speed;
  if (ride.design_exit_speed > 0.0)
    json["exit_speed_change"] = ride.exit_speed / ride.design_exit_speed - 1.0;
  if (std::isfinite(ride.highest_load)) json["highest_load_m_per_s2"] = ride.highest_load;
  return json;
}

}  // namespace

Json shop_checks_json(const std::vector<ShopCheck>& checks) {
  Json rows = Json::array();
  for (const ShopCheck& check : checks) {
    rows.push_back({{"rule", check.rule},
                    {"verdict", to_text(check.verdict)},
                    {"value", check.value},
                    {"bound", check.bound},
                    {"where", check.where},
                    {"source", check.source},
                    {"sentence", check.sentence},
                    {"certainty", check.certainty},
                    {"needs_checking", check.needs_checking}});
  }
  return rows;
}

void add_parts(Json& json, const WorkshopBuild* build) {
  for (const char* const key :
       {"master_curve", "parts", "items", "nests", "template_pages", "as_built", "shop_checks", "shortfalls",
        "notes", "parts_volume_m3", "channel_volume_m3", "bolted_holes", "joints_m"}) {
    json[key] = nullptr;
  }
  if (build == nullptr) return;
  const Workshop& workshop = build->workshop;
  json["master_curve"] = master_json(build->master);
  json["parts"] = Json::array();
  for (const ShopPart& part : workshop.parts) json["parts"].push_back(part_json(part));
  json["items"] = Json::array();
  for (const BoughtInItem& item : workshop.items) {
    json["items"].push_back({{"quantity", item.quantity},
                             {"name", item.name},
                             {"standard", item.standard},
                             {"where", item.where}});
  }
  json["nests"] = Json::array();
  for (const NestedSheet& sheet : build->nests) json["nests"].push_back(nest_json(sheet, workshop));
  const TemplatePages& pages = build->template_pages;
  json["template_pages"] = {{"a4", pages.a4}, {"a3", pages.a3}, {"roll", pages.roll}};
  json["as_built"] = ride_json(build->ride);
  json["shop_checks"] = shop_checks_json(workshop.checks);
  json["shortfalls"] = issues_json(workshop.shortfalls);
  json["notes"] = workshop.notes;
  json["parts_volume_m3"] = build->proof.volume + build->proof.added_volume;
  json["channel_volume_m3"] = build->proof.volume;
  json["bolted_holes"] = build->proof.bolted;
  json["joints_m"] = build->joints;
}

}  // namespace glissade::report
