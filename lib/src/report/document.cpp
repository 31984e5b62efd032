#include "report/document.hpp"

#include "glissade/core/version.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "report/body_energy.hpp"
#include "report/parts_view.hpp"
#include "report/ride_stations.hpp"
#include "report/serial/packed.hpp"
#include "report/serial/parts.hpp"
#include "report/serial/pattern.hpp"
#include "report/serial/stream.hpp"
#include "report/serial/vocabulary.hpp"
#include "report/station_table.hpp"
#include "report/view_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace glissade::report {
namespace {

constexpr std::array kTrackColumns = {"arc_length_m",   "x_m", "z_m", "drop_m", "slope_angle_deg",
                                      "curvature_per_m"};
constexpr std::array kRideColumns = {"time_s", "speed_m_per_s", "normal_load_m_per_s2",
                                     "friction_loss_j_per_kg", "drag_loss_j_per_kg"};

constexpr std::array kStreamColumns = {"burden_depth_m",      "equivalent_friction", "floor_pressure_pa",
                                       "floor_wear_w_per_m2", "wall_wear_w_per_m2",  "channel_width_m"};

/// The columns of a ride, more of them where a stream flows.
std::vector<std::string> ride_columns_of(const Motion& motion) {
  std::vector<std::string> keys(kRideColumns.begin(), kRideColumns.end());
  if (stream_of(motion.body()) != nullptr)
    keys.insert(keys.end(), kStreamColumns.begin(), kStreamColumns.end());
  return keys;
}

void add_stream_state(Json& columns, const Motion& motion, double s) {
  if (stream_of(motion.body()) == nullptr) return;
  const StreamState state = stream_state(motion, s);
  columns["burden_depth_m"].push_back(state.depth);
  columns["equivalent_friction"].push_back(state.equivalent_friction);
  columns["floor_pressure_pa"].push_back(state.floor_pressure);
  columns["floor_wear_w_per_m2"].push_back(state.floor_wear);
  columns["wall_wear_w_per_m2"].push_back(state.wall_wear);
  columns["channel_width_m"].push_back(stream_of(motion.body())->width(s));
}

void add_state(Json& columns, const MotionState& state) {
  columns["time_s"].push_back(number(state.time));
  columns["speed_m_per_s"].push_back(state.speed);
  columns["normal_load_m_per_s2"].push_back(number(state.normal_load));
  columns["friction_loss_j_per_kg"].push_back(state.friction_loss);
  columns["drag_loss_j_per_kg"].push_back(state.drag_loss);
}

Json ride_line(const Motion& motion, double start_height) {
  Json line;
  for (const char* key : kTrackColumns) line[key] = Json::array();
  for (const std::string& key : ride_columns_of(motion)) line[key] = Json::array();
  for (const double s : ride_stations(motion)) {
    const CenterlinePoint point = motion.centerline().at(s);
    line["arc_length_m"].push_back(s);
    line["x_m"].push_back(point.x);
    line["z_m"].push_back(start_height - point.drop);
    line["drop_m"].push_back(point.drop);
    line["slope_angle_deg"].push_back(degrees(point.slope_angle));
    line["curvature_per_m"].push_back(number(point.curvature));
    add_state(line, motion.at(s));
    add_stream_state(line, motion, s);
  }
  return line;
}

struct Radius {
  double value;
  double arc_length;
};

/// The smallest radius of what is ridden.
Radius smallest_radius(const Motion& motion) {
  const QuantityPeak sharpest = motion.highest([](const LawState& at) { return std::fabs(at.curvature); });
  return {1.0 / sharpest.value, sharpest.value > 0.0 ? sharpest.arc_length : 0.0};
}

Angle steepest_slope_angle(const Motion& motion) {
  return Angle::from_radians(motion.highest([](const LawState& at) { return at.slope_angle; }).value);
}

Json optimum_travel_time(const ReportInput& input) {
  if (input.optimum_travel_time) return number(*input.optimum_travel_time);
  return input.optimum ? number(input.optimum->travel_time()) : Json(nullptr);
}

Json ride_facts(const ReportInput& input) {
  const Motion& motion = *input.motion;
  const Centerline& centerline = motion.centerline();
  const Radius radius = smallest_radius(motion);
  const Angle steepest =
      input.steepest_slope_angle ? *input.steepest_slope_angle : steepest_slope_angle(motion);
  Json facts;
  add_ride(facts, motion);
  facts["straight_travel_time_s"] = input.straight ? number(input.straight->travel_time()) : Json(nullptr);
  facts["optimum_travel_time_s"] = optimum_travel_time(input);
  facts["entry_slope_angle_deg"] = degrees(centerline.slope_angle(0.0));
  facts["exit_slope_angle_deg"] = degrees(centerline.slope_angle(centerline.length()));
  facts["steepest_slope_angle_deg"] = degrees(steepest);
  facts["arc_length_m"] = centerline.length();
  facts["min_radius_m"] = number(input.min_radius.value_or(radius.value));
  facts["min_radius_at_m"] = radius.arc_length;
  return facts;
}

/// A ride at the stations of the nominal one, null from where it ends.
Json ride_columns(const Motion& motion, const std::vector<double>& stations) {
  const std::vector<std::string> keys = ride_columns_of(motion);
  Json columns;
  for (const std::string& key : keys) columns[key] = Json::array();
  for (const double s : stations) {
    if (s > motion.distance()) {
      for (const std::string& key : keys) columns[key].push_back(nullptr);
      continue;
    }
    add_state(columns, motion.at(s));
    add_stream_state(columns, motion, s);
  }
  return columns;
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

/// Null where a sentence has no values with units.
Json pieces_of(const ReportCheck& check) {
  if (check.pieces.empty()) return nullptr;
  Json pieces = Json::array();
  for (const ReportPiece& piece : check.pieces) {
    if (piece.value) {
      pieces.push_back({{"value", number(*piece.value)}, {"unit", piece.unit}, {"digits", piece.digits}});
    } else {
      pieces.push_back(piece.words);
    }
  }
  return pieces;
}

Json checks_of(const std::vector<ReportCheck>& list) {
  Json checks = Json::array();
  for (const ReportCheck& check : list) {
    checks.push_back({{"name", check.name},
                      {"verdict", word(check.verdict)},
                      {"detail", check.detail},
                      {"detail_pieces", pieces_of(check)},
                      {"of_nominal", check.of_nominal}});
  }
  return checks;
}

Json flights_of(const std::vector<ReportFlight>& flights) {
  Json list = Json::array();
  for (const ReportFlight& flight : flights) {
    Json xs = Json::array();
    Json zs = Json::array();
    for (const Vec2& point : flight.points) {
      xs.push_back(point.x);
      zs.push_back(point.y);
    }
    list.push_back({{"name", flight.name}, {"x_m", std::move(xs)}, {"z_m", std::move(zs)}});
  }
  return list;
}

Json rides_of(const ReportInput& input) {
  const std::vector<ReportRide> rides =
      input.rides.empty()
          ? std::vector<ReportRide>{{FrictionLevel::nominal, input.motion, input.checks, input.flights}}
          : input.rides;
  const std::vector<double> stations = ride_stations(*input.motion);
  const StationGrid grid = station_grid(*input.motion);
  Json list = Json::array();
  for (const ReportRide& ride : rides) {
    list.push_back(ride_json(ride.level, *ride.motion, input.stall_angle));
    // With a feed it follows from the friction.
    list.back()["entry_speed_m_per_s"] = ride.motion->body().entry_speed;
    list.back()["checks"] = checks_of(ride.checks);
    list.back()["flights"] = flights_of(ride.flights);
    list.back()["stations"] = ride_columns(*ride.motion, stations);
    list.back()["table"] = ride_table(*ride.motion, grid);
  }
  return list;
}

Json mesh_of(const ReportInput& input) {
  if (input.solid.facts == nullptr) return nullptr;
  Json mesh = mesh_json(*input.solid.facts);
  mesh["mesh_volume_m3"] = mesh["volume_m3"];
  mesh["volume_m3"] = input.solid.solid->exact_volume;
  mesh["max_deviation_m"] = input.solid.max_deviation;
  mesh["trimmed"] = input.solid.solid->trimmed;
  mesh["offset_m"] = position_json(input.placement.start() - input.solid.solid->placement.start());
  return mesh;
}

Json view_of(const ReportInput& input) {
  if (input.solid.solid == nullptr) return nullptr;
  const ViewMesh view = make_view(input);
  Json json;
  json["steps"] = ViewMesh::kSteps;
  json["length_m"] = input.motion->centerline().length();
  json["lower_m"] = position_json(view.lower);
  json["upper_m"] = position_json(view.upper);
  json["note"] = view.note;
  json["positions"] = packed("u16", view.positions);
  json["arc_length"] = packed("u16", view.arc_length);
  json["indices"] = packed("u32", view.indices);
  return json;
}

Json limits_of(const ReportInput& input) {
  Json limits = Json::array();
  for (const ReportLimit& limit : input.limits) {
    Json row{{"name", limit.name}, {"status", limit.status}};
    row.update(limit_json(limit.check, limit.active ? &*limit.active : nullptr, input.design->objective));
    limits.push_back(std::move(row));
  }
  return limits;
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
    areas.push_back({{"name", area.name},
                     {"open", area.open},
                     {"clearance_m", area.clearance},
                     {"points_m", std::move(points)}});
  }
  return areas;
}

/// The side view of the solid and its headroom: null where clearances are measured from the centerline.
Json envelope_of(const ReportInput& input) {
  if (input.envelope.is_line()) return nullptr;
  const double height = input.placement.start().z;
  Json edges = Json::array();
  for (const EnvelopeEdge& edge : envelope_edges(input.motion->centerline(), input.envelope)) {
    Json xs = Json::array();
    Json zs = Json::array();
    for (const Vec2 point : edge.points) {
      xs.push_back(point.x);
      zs.push_back(height + point.y);
    }
    edges.push_back(
        {{"name", edge.name}, {"dashed", edge.dashed}, {"x_m", std::move(xs)}, {"z_m", std::move(zs)}});
  }
  return {{"below_m", input.envelope.below},
          {"above_m", input.envelope.above},
          {"headroom_m", input.envelope.headroom},
          {"edges", std::move(edges)}};
}

/// As --json has it, each part with its flat pattern; null where nothing is made of parts.
Json fabrication_of(const ReportInput& input) {
  if (input.workshop == nullptr) return nullptr;
  Json json;
  add_parts(json, input.workshop);
  const std::vector<ShopPart>& parts = input.workshop->workshop.parts;
  for (std::size_t i = 0; i < parts.size(); ++i) json["parts"][i]["pattern"] = pattern_json(parts[i]);
  for (std::size_t i = 0; i < input.workshop->nests.size(); ++i) {
    Json& laid = json["nests"][i]["laid"] = Json::array();
    for (const NestedPiece& piece : input.workshop->nests[i].pieces) {
      const PlaneMotion& motion = piece.motion;
      laid.push_back({{"part", piece.part},
                      {"cosine", motion.cosine},
                      {"sine", motion.sine},
                      {"shift_m", {motion.shift.x, motion.shift.y}}});
    }
  }
  json["design_exit_speed_m_per_s"] = input.workshop->ride.design_exit_speed;
  json["view"] = parts_view_json(input);
  return json;
}

Json cases_of(const ReportInput& input) {
  Json list = Json::array();
  for (const ReportCase& one : input.cases) {
    Json ride;
    add_ride(ride, *one.motion);
    list.push_back({{"friction", to_text(one.friction)},
                    {"friction_angle_deg", one.motion->body().friction.angle().degrees()},
                    {"flow", one.flow},
                    {"status", ride["status"]},
                    {"travel_time_s", ride["travel_time_s"]},
                    {"exit_speed_m_per_s", ride["exit_speed_m_per_s"]},
                    {"highest_speed_m_per_s", ride["highest_speed_m_per_s"]},
                    {"stream", ride["stream"]}});
  }
  return list;
}

/// Null without gates; the first of the conditions is the design's own.
Json gates_of(const ReportInput& input) {
  if (input.gates == nullptr) return nullptr;
  Json conditions = Json::array();
  for (const GateCondition& condition : input.gates->conditions) conditions.push_back(condition.name);
  return {{"measuring_place_m", input.gates->measuring_place},
          {"conditions", std::move(conditions)},
          {"list", gates_json(*input.gates)}};
}

/// A finish that was free lies where the track ends.
Vec3 finish_of(const ReportInput& input) {
  const TrackDesign& track = input.design->track;
  if (track.free_finish == FinishKind::point || track.free_start) return track.finish;
  return input.placement.to_space(input.endpoints.run, input.endpoints.drop, 0.0);
}

/// A ride of the flows and frictions that a reader may go through: few stations, what is drawn and told.
Json what_if_ride(const ReportWhatIf& one) {
  constexpr int kPieces = 40;
  const Motion& motion = *one.motion;
  Json ride;
  add_ride(ride, motion);
  Json line = {{"x_m", Json::array()},
               {"z_m", Json::array()},
               {"slope_angle_deg", Json::array()},
               {"burden_depth_m", Json::array()},
               {"speed_m_per_s", Json::array()}};
  for (int i = 0; i <= kPieces; ++i) {
    const double s = std::min(motion.distance(), motion.distance() * i / kPieces);
    const CenterlinePoint at = motion.centerline().at(s);
    line["x_m"].push_back(at.x);
    line["z_m"].push_back(-at.drop);
    line["slope_angle_deg"].push_back(degrees(at.slope_angle));
    // What does not get onto its track is no stream there.
    line["burden_depth_m"].push_back(enters(motion) ? motion.quantity(BulkStream::kDepth, s) : 0.0);
    line["speed_m_per_s"].push_back(motion.at(s).speed);
  }
  Json flight = Json::array();
  for (const Vec2& point : one.flight) flight.push_back({point.x, point.y});
  return {{"mass_flow_kg_per_s", one.mass_flow},
          {"friction_angle_deg", one.friction.angle().degrees()},
          {"nominal", one.nominal},
          {"status", ride["status"]},
          {"travel_time_s", ride["travel_time_s"]},
          {"exit_speed_m_per_s", ride["exit_speed_m_per_s"]},
          {"max_depth_m", ride["stream"]["max_depth_m"]},
          {"highest_filling", ride["stream"]["highest_filling"]},
          {"choked", ride["stream"]["choked"]},
          {"discharge", one.landing ? belt_landing_json(*one.landing) : Json(nullptr)},
          {"line", std::move(line)},
          {"flight_m", std::move(flight)}};
}

Json what_if_of(const ReportInput& input) {
  Json list = Json::array();
  for (const ReportWhatIf& one : input.what_if) list.push_back(what_if_ride(one));
  return list;
}

/// The body of the ride: with a feed its entry speed follows from the track.
Json ridden_body(const ReportInput& input) {
  const BodyEnergy energy(*input.motion);
  Json body;
  add_body(body, *input.design);
  body["entry_speed_m_per_s"] = input.motion->body().entry_speed;
  body["inertia_factor"] = energy.inertia();
  body["centre_height_m"] = energy.centre_height();
  return body;
}

}  // namespace

nlohmann::ordered_json report_document(const ReportInput& input) {
  const Design& design = *input.design;
  const double height = input.placement.start().z;
  Json document;
  document["schema"] = "glissade-report/2";
  document["generator"] = {{"name", "Glissade"}, {"version", version()}};
  document["design"] = {
      {"name", design.name.empty() ? "Untitled design" : design.name},
      {"stem", design.file.empty() ? "design" : design.file.stem().string()},
      {"centerline",
       input.centerline.empty() ? std::string(input.motion->centerline().kind()) : input.centerline},
      {"cross_section", input.solid.section ? std::string(input.solid.section->kind()) : "none"}};
  const Vec3 along = input.placement.at_origin().to_space(1.0, 0.0, 0.0);
  document["placement"] = {{"start_m", position_json(input.placement.start())},
                           {"finish_m", position_json(finish_of(input))},
                           {"direction", {along.x, along.y}},
                           {"azimuth_deg", input.placement.azimuth().degrees()}};
  document["endpoints"] = {{"run_m", input.endpoints.run}, {"drop_m", input.endpoints.drop}};
  document["body"] = ridden_body(input);
  document["ride"] = ride_facts(input);
  document["rides"] = rides_of(input);
  document["probes"] = probes_json(input.probes);
  document["gates"] = gates_of(input);
  document["rules"] = rules_json(input.rules);
  document["fabrication"] = fabrication_of(input);
  document["flights"] = flights_of(input.flights);
  document["cases"] = cases_of(input);
  document["what_if"] = what_if_of(input);
  document["warnings"] = issues_json(input.warnings);
  document["checks"] = checks_of(input.checks);
  document["limits"] = limits_of(input);
  document["keep_outs"] = keep_outs_of(input);
  document["envelope"] = envelope_of(input);
  document["mesh"] = mesh_of(input);
  document["files"] = files_of(input);
  document["stations"] = ride_line(*input.motion, height);
  document["table"] = track_table(*input.motion, station_grid(*input.motion), height);
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
