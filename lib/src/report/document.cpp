#include "report/document.hpp"

#include "glissade/core/version.hpp"

#include "report/ride_stations.hpp"
#include "report/view_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include <openssl/evp.h>

namespace glissade::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// JSON has no infinity: null stands for a value that does not exist or is unbounded.
Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json vector_of(Vec3 v) {
  return Json::array({v.x, v.y, v.z});
}

Json ride_line(const Motion& motion, double start_height) {
  Json line;
  for (const char* key :
       {"arc_length_m", "x_m", "z_m", "drop_m", "slope_angle_deg", "curvature_per_m", "time_s",
        "speed_m_per_s", "normal_load_m_per_s2", "friction_loss_j_per_kg", "drag_loss_j_per_kg"}) {
    line[key] = Json::array();
  }
  for (const double s : ride_stations(motion)) {
    const CenterlinePoint point = motion.centerline().at(s);
    const MotionState state = motion.at(s);
    line["arc_length_m"].push_back(s);
    line["x_m"].push_back(point.x);
    line["z_m"].push_back(start_height - point.drop);
    line["drop_m"].push_back(point.drop);
    line["slope_angle_deg"].push_back(point.slope_angle * kDegrees);
    line["curvature_per_m"].push_back(finite(point.curvature));
    line["time_s"].push_back(finite(state.time));
    line["speed_m_per_s"].push_back(state.speed);
    line["normal_load_m_per_s2"].push_back(state.normal_load);
    line["friction_loss_j_per_kg"].push_back(state.friction_loss);
    line["drag_loss_j_per_kg"].push_back(state.drag_loss);
  }
  return line;
}

struct Radius {
  double value;
  double arc_length;
};

/// The smallest radius at the stations of the ride and just beside the breaks.
Radius smallest_radius(const Motion& motion) {
  Radius least{std::numeric_limits<double>::infinity(), 0.0};
  for (const double s : ride_stations(motion)) {
    const double curvature = std::fabs(motion.centerline().at(s).curvature);
    const double radius = std::isinf(curvature) ? 0.0 : 1.0 / curvature;
    if (curvature > 0.0 && radius < least.value) least = {radius, s};
  }
  return least;
}

double steepest_slope_angle(const Motion& motion) {
  double steepest = -std::numeric_limits<double>::infinity();
  for (const double s : ride_stations(motion)) {
    steepest = std::max(steepest, motion.centerline().slope_angle(s));
  }
  return steepest;
}

Json optimum_travel_time(const ReportInput& input) {
  if (input.optimum_travel_time) return finite(*input.optimum_travel_time);
  return input.optimum ? finite(input.optimum->travel_time()) : Json(nullptr);
}

Json ride_facts(const ReportInput& input) {
  const Motion& motion = *input.motion;
  const Centerline& centerline = motion.centerline();
  const MotionState highest = motion.highest_load();
  const Radius radius = smallest_radius(motion);
  Json facts;
  facts["arrived"] = motion.arrived();
  facts["travel_time_s"] = finite(motion.travel_time());
  facts["straight_travel_time_s"] = input.straight ? finite(input.straight->travel_time()) : Json(nullptr);
  facts["optimum_travel_time_s"] = optimum_travel_time(input);
  facts["exit_speed_m_per_s"] = motion.exit_speed();
  facts["entry_slope_angle_deg"] = centerline.slope_angle(0.0) * kDegrees;
  facts["exit_slope_angle_deg"] = centerline.slope_angle(centerline.length()) * kDegrees;
  facts["arc_length_m"] = centerline.length();
  const double steepest =
      input.steepest_slope_angle ? *input.steepest_slope_angle : steepest_slope_angle(motion);
  facts["steepest_slope_angle_deg"] = steepest * kDegrees;
  facts["max_normal_load_m_per_s2"] = highest.normal_load;
  facts["max_normal_load_at_m"] = highest.arc_length;
  facts["min_radius_m"] = finite(input.min_radius.value_or(radius.value));
  facts["min_radius_at_m"] = radius.arc_length;
  facts["stall"] = nullptr;
  if (motion.stall()) {
    facts["stall"] = {{"arc_length_m", motion.stall()->arc_length},
                      {"missing_slope_deg", motion.stall()->missing_slope * kDegrees}};
  }
  facts["lift_off"] = nullptr;
  if (motion.lift_off()) {
    facts["lift_off"] = {{"arc_length_m", motion.lift_off()->arc_length},
                         {"speed_m_per_s", motion.lift_off()->speed},
                         {"curvature_per_m", finite(motion.lift_off()->curvature)}};
  }
  return facts;
}

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::not_checked:
      return "not-checked";
  }
  return "not-checked";
}

Json mesh_facts(const ReportInput& input) {
  if (input.solid.facts == nullptr) return nullptr;
  const MeshFacts& facts = *input.solid.facts;
  Json mesh;
  mesh["triangles"] = facts.triangles;
  mesh["vertices"] = facts.vertices;
  mesh["volume_m3"] = input.solid.solid->exact_volume;
  mesh["mesh_volume_m3"] = facts.volume;
  mesh["area_m2"] = facts.area;
  mesh["watertight"] = facts.watertight();
  mesh["self_intersections"] = facts.self_intersections;
  mesh["euler_characteristic"] = facts.euler_characteristic;
  mesh["smallest_angle_deg"] = facts.smallest_angle * kDegrees;
  mesh["max_deviation_m"] = input.solid.max_deviation;
  mesh["lower_m"] = vector_of(facts.lower);
  mesh["upper_m"] = vector_of(facts.upper);
  mesh["offset_m"] = vector_of(input.placement.start() - input.solid.solid->placement.start());
  return mesh;
}

/// Integers as base64 of their little-endian bytes; the target machines of the product are little-endian,
/// like base64 readers in browsers.
template <class Integer>
Json packed(const char* type, const std::vector<Integer>& values) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t bytes = values.size() * sizeof(Integer);
  std::string text(4 * ((bytes + 2) / 3) + 1, '\0');
  const int written =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(values.data()), static_cast<int>(bytes));
  text.resize(static_cast<std::size_t>(written));
  return {{"type", type}, {"data", std::move(text)}};
}

Json view_of(const ReportInput& input) {
  if (input.solid.solid == nullptr) return nullptr;
  const ViewMesh view = make_view(input);
  Json json;
  json["steps"] = ViewMesh::kSteps;
  json["length_m"] = input.motion->centerline().length();
  json["lower_m"] = vector_of(view.lower);
  json["upper_m"] = vector_of(view.upper);
  json["note"] = view.note;
  json["positions"] = packed("u16", view.positions);
  json["arc_length"] = packed("u16", view.arc_length);
  json["indices"] = packed("u32", view.indices);
  return json;
}

Json limits_of(const ReportInput& input) {
  Json limits = Json::array();
  for (const ReportLimit& limit : input.limits) {
    limits.push_back({{"name", limit.name},
                      {"bound", limit.bound},
                      {"reached", limit.reached},
                      {"where", limit.where},
                      {"status", limit.status},
                      {"price", limit.price ? finite(*limit.price) : Json(nullptr)},
                      {"price_unit", limit.price_unit}});
  }
  return limits;
}

Json checks_of(const ReportInput& input) {
  Json checks = Json::array();
  for (const ReportCheck& check : input.checks) {
    checks.push_back({{"name", check.name}, {"verdict", word(check.verdict)}, {"detail", check.detail}});
  }
  return checks;
}

Json files_of(const ReportInput& input) {
  Json files = Json::array();
  for (const ReportFile& file : input.files) {
    files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  return files;
}

Json keep_outs_of(const ReportInput& input) {
  Json areas = Json::array();
  for (const ReportKeepOut& area : input.keep_outs) {
    Json points = Json::array();
    for (const Vec2& point : area.points) points.push_back({point.x, point.y});
    areas.push_back({{"name", area.name}, {"open", area.open}, {"points_m", std::move(points)}});
  }
  return areas;
}

}  // namespace

nlohmann::ordered_json report_document(const ReportInput& input) {
  const Design& design = *input.design;
  const double height = design.track.start.z;
  Json document;
  document["schema"] = "glissade-report/1";
  document["generator"] = {{"name", "Glissade"}, {"version", version()}};
  document["design"] = {
      {"name", design.name.empty() ? "Untitled design" : design.name},
      {"stem", design.file.empty() ? "design" : design.file.stem().string()},
      {"centerline",
       input.centerline.empty() ? std::string(input.motion->centerline().kind()) : input.centerline},
      {"cross_section", input.solid.section ? std::string(input.solid.section->kind()) : "none"}};
  document["placement"] = {{"start_m", vector_of(design.track.start)},
                           {"finish_m", vector_of(design.track.finish)},
                           {"azimuth_deg", input.placement.azimuth().degrees()}};
  document["endpoints"] = {{"run_m", input.endpoints.run}, {"drop_m", input.endpoints.drop}};
  document["body"] = {{"friction_coefficient", design.body.friction.coefficient()},
                      {"friction_angle_deg", design.body.friction.angle().degrees()},
                      {"entry_speed_m_per_s", design.body.entry_speed},
                      {"drag_per_m", design.body.drag_per_metre},
                      {"gravity_m_per_s2", design.gravity}};
  document["ride"] = ride_facts(input);
  document["checks"] = checks_of(input);
  document["limits"] = limits_of(input);
  document["keep_outs"] = keep_outs_of(input);
  document["mesh"] = mesh_facts(input);
  document["files"] = files_of(input);
  document["stations"] = ride_line(*input.motion, height);
  document["straight"] = input.straight ? ride_line(*input.straight, height) : Json(nullptr);
  document["optimum"] = input.optimum ? ride_line(*input.optimum, height) : Json(nullptr);
  document["view"] = view_of(input);
  return document;
}

}  // namespace glissade::report

namespace glissade {

std::string report_json(const ReportInput& input) {
  // A name that is not UTF-8 must not stop a build: replaced bytes are visible, and harmless.
  return report::report_document(input).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace glissade
