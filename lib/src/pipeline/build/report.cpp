#include "pipeline/build/report.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/pipeline/flights.hpp"
#include "glissade/pipeline/probes.hpp"
#include "glissade/pipeline/rules.hpp"

#include "core/grouped.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

/// Closed form and referee agree better than this, relative: ten times the stated accuracy of either.
constexpr double kAgreement = 10.0 * kMotionAccuracy;

Verdict verdict(bool holds) {
  return holds ? Verdict::pass : Verdict::fail;
}

ReportPiece words(std::string text) {
  ReportPiece piece;
  piece.words = std::move(text);
  return piece;
}

ReportPiece metres(double value, int digits = 4) {
  return {"", value, "m", digits};
}

ReportPiece load(double value) {
  // The cosine of a right angle is not quite 0 in a computer.
  constexpr double kRounding = 1e-12;  // rounding, of g
  return {"", std::fabs(value) < kRounding * kStandardGravity ? 0.0 : value, "m/s^2", 4};
}

std::string text_of(const ReportPiece& piece) {
  if (!piece.value) return piece.words;
  if (piece.unit == "m") return length_text(*piece.value, piece.digits);
  return rounded_text(*piece.value / kStandardGravity, piece.digits) + " g";
}

/// A check whose values follow the units that a reader chooses.
ReportCheck check_of(std::string name, Verdict verdict, std::vector<ReportPiece> pieces) {
  ReportCheck check{std::move(name), verdict, ""};
  for (const ReportPiece& piece : pieces) check.detail += text_of(piece);
  check.pieces = std::move(pieces);
  return check;
}

ReportCheck arrival(const Motion& motion) {
  return check_of(
      "The body arrives", verdict(motion.arrived()),
      {words("rode "), metres(motion.distance()), words(" of "), metres(motion.centerline().length())});
}

ReportCheck contact(const Motion& motion) {
  const MotionState lowest = motion.lowest_load();
  return check_of(
      "It never leaves the track", verdict(!motion.lift_off() && motion.arrived()),
      {words("lowest normal load "), load(lowest.normal_load), words(" at s = "), metres(lowest.arc_length)});
}

/// Kinetic energy and losses at the finish against the height lost.
ReportCheck energy(const Motion& motion, double gravity) {
  const Centerline& centerline = motion.centerline();
  const MotionState end = motion.at(motion.distance());
  const LawPtr& law = motion.body().law;
  const double inertia = law ? law->inertia() : 1.0;
  const double rise = law ? law->centre_height() * (math::cos(centerline.slope_angle(motion.distance())) -
                                                    math::cos(centerline.slope_angle(0.0)))
                          : 0.0;
  const double drop = centerline.at(motion.distance()).drop - rise;
  const double entry = motion.body().entry_speed;
  const double given = gravity * drop + 0.5 * inertia * entry * entry;
  const double found = 0.5 * inertia * end.speed * end.speed + end.friction_loss + end.drag_loss;
  const double scale = std::fabs(given) + end.friction_loss + end.drag_loss;
  const double error = std::fabs(found - given) / scale;
  return {"Energy is accounted for", verdict(error <= kAgreement),
          "kinetic energy and losses at the finish against the height lost: " + rounded_text(error, 2) +
              " relative difference"};
}

ReportCheck optimality(const Track& track) {
  const std::string name = "No faster than the exact optimum";
  if (!track.optimum_travel_time) {
    return {name, Verdict::not_checked,
            "the exact optimum is known for a sliding point, from rest and without drag only"};
  }
  const double excess = track.motion.travel_time() / *track.optimum_travel_time - 1.0;
  if (track.centerline->kind() == "fastest") {
    return {"Travel time by two routes", verdict(std::fabs(excess) <= kAgreement),
            "ride integrated along the track against the closed form: " + rounded_text(std::fabs(excess), 2) +
                " relative difference"};
  }
  return {name, verdict(excess >= -kAgreement),
          "travel time is " + rounded_text(100.0 * excess, 3) + " % above the closed form of the optimum"};
}

/// What a law asks for without ending the ride: a ball that is not to slip.
void add_law_checks(const Motion& motion, std::vector<ReportCheck>& checks) {
  const std::vector<LawQuantity> quantities = motion.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const LawQuantity& quantity = quantities[i];
    if (!quantity.verdict) continue;
    const QuantityPeak peak = motion.highest(i);
    const std::string most = std::isinf(peak.value) ? "has no bound" : "is " + rounded_text(peak.value, 3);
    const std::string there = quantity.highest ? ", there is " + rounded_text(*quantity.highest, 3)
                                               : "; the design does not say what there is";
    checks.push_back(check_of(std::string(quantity.verdict->check),
                              quantity.highest ? verdict(!peak.beyond_from) : Verdict::not_checked,
                              {words("the " + std::string(quantity.name) + " " + most + " at s = "),
                               metres(peak.arc_length), words(there)}));
  }
}

/// What is checked of a ride, whatever its friction.
std::vector<ReportCheck> ride_checks(const Motion& motion, double gravity) {
  std::vector<ReportCheck> checks = {arrival(motion), contact(motion), energy(motion, gravity)};
  add_law_checks(motion, checks);
  return checks;
}

ReportCheck watertight(const MeshFacts& facts, const Solid& solid) {
  const bool one_piece = facts.components == 1 && facts.euler_characteristic == solid.expected_euler;
  return {"The solid is watertight", verdict(facts.watertight() && facts.oriented_outward && one_piece),
          "closed, manifold, one piece, oriented outward; " + core::grouped(facts.triangles) + " facets"};
}

ReportCheck self_intersections(const MeshFacts& facts) {
  const bool none = facts.self_intersections == 0 && facts.self_intersections_complete;
  return {"It does not intersect itself", verdict(none && facts.degenerate_facets == 0),
          core::grouped(facts.self_intersections) + " pairs of facets meet where they must not, " +
              core::grouped(facts.degenerate_facets) + " facets without area"};
}

ReportCheck deviation(const Design& design, double max_deviation) {
  return check_of("The facets follow the track", verdict(max_deviation <= design.mesh.tolerance),
                  {words("largest deviation "), metres(max_deviation, 3), words(", tolerance "),
                   metres(design.mesh.tolerance, 3)});
}

ReportCheck read_back(const std::vector<fs::path>& files) {
  ReportCheck check{"Files hold this solid", Verdict::not_checked,
                    "no mesh file was written that can be read back"};
  if (files.empty()) return check;
  // A difference would have ended the build: a faulty file is never published.
  check.verdict = Verdict::pass;
  check.detail = "read back and compared with what was meant:";
  constexpr std::size_t kMostNamed = 6;
  const std::size_t named = files.size() > kMostNamed ? kMostNamed - 1 : files.size();
  for (std::size_t i = 0; i < named; ++i) check.detail += " " + files[i].filename().string() + ",";
  check.detail.pop_back();
  if (files.size() > named) check.detail += " and " + std::to_string(files.size() - named) + " more";
  return check;
}

ReportCheck limits(const std::vector<ReportLimit>& limits) {
  if (limits.empty()) return {"Limits", Verdict::not_checked, "the design has none"};
  const auto violated = std::count_if(limits.begin(), limits.end(),
                                      [](const ReportLimit& limit) { return limit.status == "violated"; });
  return {"Limits", verdict(violated == 0),
          std::to_string(static_cast<std::ptrdiff_t>(limits.size()) - violated) + " of " +
              std::to_string(limits.size()) + " kept, each asked of the finished track"};
}

ReportCheck search(const Design& design, const OptimizeReport& search) {
  const bool optimal = search.status == OptimizeStatus::optimal;
  std::string name = searched_name(design);
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return {std::move(name), verdict(optimal),
          std::string(to_text(search.status)) + ": " + (optimal ? "" : search.message + "; ") +
              search.convergence_text()};
}

/// Of a hood that was chosen with its track.
void add_hood_check(const Track& track, std::vector<ReportCheck>& checks) {
  if (track.early_hood)
    checks.push_back(
        {"Hood of the best transfer", Verdict::fail, "not converged: " + track.early_hood->message});
}

std::vector<ReportLimit> limits_of(const Track& track) {
  return report_limits(track.limit_checks, track.search ? track.search->active : std::vector<ActiveLimit>{});
}

/// In the heights of the site.
std::vector<Vec2> at_height(std::vector<Vec2> points, double height) {
  for (Vec2& point : points) point.y += height;
  return points;
}

}  // namespace

std::vector<Vec2> flight_to_belt(const Design& design, const Motion& motion) {
  for (const StreamFlight& flight : stream_flights(design, motion, nullptr, nullptr)) {
    if (flight.kind == FlightKind::to_belt) return at_height(flight.path, design.track.start.z);
  }
  return {};
}

std::vector<ReportFlight> flights_of(const Design& design, const Track& track) {
  return flights_of(design, track, track.motion);
}

std::vector<ReportFlight> flights_of(const Design& design, const Track& track, const Motion& motion) {
  const double height = track.placement.start().z;
  std::vector<ReportFlight> flights;
  for (const StreamFlight& flight : stream_flights(design, track, motion)) {
    const char* name = flight.kind == FlightKind::feed        ? "the feed falls"
                       : flight.kind == FlightKind::from_hood ? "from the hood to the track"
                                                              : "the stream falls on the belt";
    if (flight.kind == FlightKind::from_hood)
      flights.push_back({"the hood", at_height(hood_line(design, track), height)});
    flights.push_back({name, at_height(flight.path, height)});
  }
  return flights;
}

ReportInput report_input(const Design& design, const BuildForReport& build) {
  const Track& track = build.track;
  ReportInput input;
  input.stop = build.stop;
  input.design = &design;
  input.centerline = track.search ? searched_name(design) : std::string(word(design.centerline.kind));
  input.endpoints = track.endpoints;
  input.placement = track.placement;
  input.motion = &track.motion;
  input.straight = track.straight ? &*track.straight : nullptr;
  input.optimum = track.optimum ? &*track.optimum : nullptr;
  input.optimum_travel_time = track.optimum_travel_time;
  input.min_radius = track.min_radius;
  input.steepest_slope_angle = track.steepest_slope_angle;
  if (build.swept != nullptr) {
    input.solid = {&build.swept->solid, &build.swept->facts, build.section, build.swept->max_deviation};
  }
  for (const LevelRide& ride : track.rides()) {
    input.rides.push_back({ride.level, ride.motion, ride_checks(*ride.motion, design.gravity),
                           flights_of(design, track, *ride.motion)});
  }
  input.stall_angle = stall_angle_of(track);
  input.probes = probe_readings(design, track);
  input.warnings = warnings(design, track, build.workshop);
  if (track.gates) input.gates = &*track.gates;
  input.rules = judge_rules(design, track);
  input.workshop = build.workshop;
  input.flights = flights_of(design, track);
  input.keep_outs = report_keep_outs(design);
  if (design.limits) input.envelope = envelope_of(design);
  input.limits = limits_of(track);
  for (const fs::path& file : build.files) {
    input.files.push_back({file.filename().string(), fs::file_size(file), sha256_of_file(file, build.stop)});
  }
  input.checks = ride_checks(track.motion, design.gravity);
  input.checks.push_back(optimality(track));
  input.checks.back().of_nominal = true;
  if (track.search) input.checks.push_back(search(design, *track.search));
  add_hood_check(track, input.checks);
  input.checks.push_back(limits(input.limits));
  if (build.swept != nullptr) {
    input.checks.push_back(watertight(build.swept->facts, build.swept->solid));
    input.checks.push_back(self_intersections(build.swept->facts));
    input.checks.push_back(deviation(design, build.swept->max_deviation));
    input.checks.push_back(read_back(build.read_back_files));
  }
  return input;
}

}  // namespace glissade::pipeline
