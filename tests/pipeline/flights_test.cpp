// Streams in the air: parabolas with a thickness, and how near they come to what the limits keep clear of.

#include "glissade/pipeline/flights.hpp"

#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

using namespace glissade;
using nlohmann::json;

namespace {

/// A straight chute from a belt to a belt; one obstacle, mirrored and moved on request.
struct Transfer {
  double sign = 1.0;
  double off = 0.0;
  std::string hood;
  std::string belt_drop = "1.2 m";
  std::vector<Vec2> beam;  ///< corners, run and height above the start [m]
  double clearance = 0.0;
  double flow = 400.0;

  [[nodiscard]] std::string x(double run) const { return std::to_string(off + sign * run) + " m"; }
  [[nodiscard]] std::string text() const {
    std::string outline;
    for (const Vec2 corner : beam)
      outline +=
          (outline.empty() ? "" : ", ") + ("[" + x(corner.x) + ", " + std::to_string(3.0 + corner.y) + " m]");
    const std::string limits = beam.empty() ? ""
                                            : "limits: {keep_outs: [{outline: [" + outline +
                                                  "], clearance: " + std::to_string(clearance) + " m}]}\n";
    return "glissade: 1\ntrack: {start: {x: " + x(0.0) + ", z: 3 m}, finish: {x: " + x(1.2) +
           ", z: 1.4 m}}\nbody: {friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}}\n"
           "stream: {mass_flow: " +
           std::to_string(flow) +
           " t/h, bulk_density: 1600 kg/m^3, surge: 1.5}\n"
           "feed: {kind: belt, belt_speed: 3.6 m/s, pulley_radius: 400 mm, drop: 600 mm}\n" +
           hood + "discharge: {belt_speed: 3 m/s, drop: " + belt_drop + "}\ncenterline: {kind: straight}\n" +
           limits + "cross_section: {kind: u-channel, width: 800 mm, wall_height: 400 mm, thickness: 8 mm}\n";
  }
  [[nodiscard]] Design design() const { return parse_design(text(), "d.yaml"); }
};

json verdict_of(const Design& design, const Track& track) {
  const json document = json::parse(track_json(design, track));
  for (const json& rule : document["verdicts"]) {
    if (rule["id"] == "chute.5.air") return rule;
  }
  return nullptr;
}

Vec2 seen(Vec2 point, Vec2 low, Vec2 high) {
  return {std::clamp(point.x, low.x, high.x), std::clamp(point.y, low.y, high.y)};
}

}  // namespace

TEST_CASE("streams in the air: parabolas as thick as continuity has it, each where the last thing left off") {
  const Transfer transfer;
  const Design design = transfer.design();
  const Track track = solve(design);
  const std::vector<StreamFlight> flights = stream_flights(design, track);
  REQUIRE(flights.size() == 2);
  const StreamFlight& feed = flights[0];
  CHECK(feed.kind == FlightKind::feed);
  CHECK(norm(feed.path.back()) == Approx(0.0).margin(1e-12));
  const FeedFall fall = feed_fall(design);
  CHECK(feed.path.front().x == Approx(-fall.reach).epsilon(1e-12));
  CHECK(feed.path.front().y == Approx(0.6).epsilon(1e-12));
  const StreamFlight& belt = flights[1];
  CHECK(belt.path.front().x == Approx(1.2).epsilon(1e-12));
  CHECK(belt.path.front().y == Approx(-1.6).epsilon(1e-12));
  CHECK(belt.path.back().y == Approx(-2.8).epsilon(1e-12));
  CHECK(belt.path.back().x == Approx(1.2 + belt_landing(design, track.motion).reach).epsilon(1e-12));
  const double rate = 400.0 / 3.6 / 1600.0 / 0.8;
  for (const StreamFlight& flight : flights) {
    for (std::size_t i = 0; i < flight.path.size(); ++i) {
      const double height = flight.path[i].y - flight.path.front().y;
      const bool fed = flight.kind == FlightKind::feed;
      const double first = fed ? fall.landing.speed * fall.landing.speed - 2.0 * design.gravity * 0.6
                               : std::pow(track.motion.exit_speed(), 2);
      const double speed = std::sqrt(first - 2.0 * design.gravity * height);
      CHECK(norm(flight.beyond[i] - flight.path[i]) == Approx(rate / speed).epsilon(1e-9));
      CHECK(flight.beyond[i].y >= flight.path[i].y);
    }
  }
}

TEST_CASE(
    "a beam below the fall on the belt: its margin is that of the parabola, at the worst friction and flow") {
  Transfer transfer;
  const Vec2 low{1.75, -2.75};
  const Vec2 high{1.85, -2.65};
  transfer.beam = {low, {high.x, low.y}, high, {low.x, high.y}};
  transfer.clearance = 0.02;
  const Design design = transfer.design();
  const Track track = solve(design);
  // By hand: the underside of the stream at each friction, many points of it.
  double least = 1e9;
  for (const LevelRide& ride : track.rides()) {
    const double speed = ride.motion->exit_speed();
    const double slope = ride.motion->centerline().slope_angle(ride.motion->distance());
    const double rate = 400.0 / 3.6 / 1600.0 / 0.8;
    for (int i = 0; i <= 200000; ++i) {
      const double t = 1e-6 * i;
      const Vec2 velocity{speed * std::cos(slope), speed * std::sin(slope) + design.gravity * t};
      const Vec2 place{1.2 + velocity.x * t,
                       -1.6 - speed * std::sin(slope) * t - 0.5 * design.gravity * t * t};
      if (place.y < -2.8) break;
      least = std::min(least, norm(place - seen(place, low, high)));
      const Vec2 over = place + (rate / norm(velocity) / norm(velocity)) * Vec2{velocity.y, velocity.x};
      least = std::min(least, norm(over - seen(over, low, high)));
    }
  }
  std::vector<FlightApproach> worst;
  for (const LevelRide& ride : track.rides()) {
    const auto approaches = flight_approaches(design, stream_flights(design, *ride.motion, nullptr, nullptr));
    REQUIRE(approaches.size() == 1);
    CHECK(approaches[0].limit == "keep_outs[0]");
    CHECK(approaches[0].margin() == Approx(approaches[0].distance - 0.02).epsilon(1e-12));
    worst.push_back(approaches[0]);
  }
  const auto nearest = std::min_element(worst.begin(), worst.end(),
                                        [](const auto& a, const auto& b) { return a.distance < b.distance; });
  REQUIRE(least > 0.0);
  CHECK(nearest->distance == Approx(least).margin(2e-5));
  CHECK(nearest->kind == FlightKind::to_belt);
  const json verdict = verdict_of(design, track);
  INFO(verdict.dump());
  CHECK(verdict["value"].get<double>() <= nearest->margin() + 1e-9);
  CHECK(verdict["place"].get<std::string>().find("fall on the belt by keep_outs[0]") == 0);

  // Mirrored and moved: the same.
  Transfer mirrored = transfer;
  mirrored.sign = -1.0;
  mirrored.off = 5.0;
  const Design other = mirrored.design();
  CHECK(verdict_of(other, solve(other))["value"].get<double>() ==
        Approx(verdict["value"].get<double>()).margin(1e-6));
  // A larger clearance is missed by as much more.
  transfer.clearance = 0.05;
  const Design wider = transfer.design();
  CHECK(verdict_of(wider, solve(wider))["value"].get<double>() ==
        Approx(verdict["value"].get<double>() - 0.03).margin(1e-9));
}

TEST_CASE("a beam above the stream is met by its thickness, not by its path") {
  Transfer transfer;
  const Track thin = solve(transfer.design());
  const StreamFlight flight = stream_flights(transfer.design(), thin).back();
  const std::size_t i = flight.path.size() / 2;
  const Vec2 beside = flight.path[i] + 1.5 * (flight.beyond[i] - flight.path[i]);
  transfer.beam = {beside, beside + Vec2{0.1, 0.1}, beside + Vec2{0.0, 0.1}};
  const Design kept = transfer.design();
  // A surge of 1.5 times the flow reaches it; trickle and nominal flow do not.
  const json verdict = verdict_of(kept, solve(kept));
  CHECK(verdict["place"].get<std::string>().find("surge flow") != std::string::npos);
  transfer.flow = 800.0;
  const Design hit = transfer.design();
  const json failed = verdict_of(hit, solve(hit));
  CHECK(failed["verdict"] == "fail");
  CHECK(failed["value"].get<double>() < 0.0);
  CHECK(failed["value"].get<double>() < verdict["value"].get<double>());
}

TEST_CASE("a stream below a hood falls on the inner side of its path; without obstacles nothing is asked") {
  Transfer transfer;
  transfer.hood = "hood: {radius: 1 m, impact_angle: 12 deg, exit_angle: 78 deg, drop: 400 mm}\n";
  const Design design = transfer.design();
  const Track track = solve(design);
  const std::vector<StreamFlight> flights = stream_flights(design, track);
  REQUIRE(flights.size() == 3);
  const StreamFlight& fall = flights[1];
  CHECK(fall.kind == FlightKind::from_hood);
  CHECK(norm(fall.path.front() - hood_line(design, track).back()) < 1e-12);
  CHECK(norm(fall.path.back()) < 1e-9);
  for (std::size_t i = 0; i < fall.path.size(); ++i) CHECK(fall.beyond[i].x < fall.path[i].x);
  CHECK(verdict_of(design, track)["verdict"] != "fail");
  CHECK(flight_approaches(design, flights).empty());
}
