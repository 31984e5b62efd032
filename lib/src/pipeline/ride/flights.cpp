// Streams in the air as bodies with a thickness, and what they come near to.

#include "glissade/pipeline/flights.hpp"

#include "glissade/core/math.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "pipeline/task/hood.hpp"
#include "task/obstacles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace glissade {
namespace {

/// What flies: where it leaves, downwards positive velocity, how long, and on which side of its path it is.
struct Launch {
  FlightKind kind = FlightKind::feed;
  Vec2 from;      ///< run and height above the start of the track [m]
  Vec2 velocity;  ///< ahead and down [m/s]
  double time = 0.0;
  double area_rate = 0.0;  ///< Q/(rho B) [m^2/s]
  double thickest =
      0.0;  ///< a jet that hardly moves is as wide as its outlet, which nobody told: the channel [m]
  double side = 1.0;  ///< 1: above its path, -1: below
};

StreamFlight flown(const Launch& launch, double gravity) {
  // Chords lie off the parabola by g dt^2/8: a hundredth of a millimetre.
  constexpr double kStep = 3e-3;  // [s]
  constexpr double kFewest = 8.0;
  constexpr double kMost = 2000.0;
  const double pieces = std::clamp(std::ceil(launch.time / kStep), kFewest, kMost);
  StreamFlight flight{launch.kind, {}, {}};
  for (double i = 0.0; i <= pieces; i += 1.0) {
    const double t = launch.time * i / pieces;
    const Vec2 place{launch.from.x + launch.velocity.x * t,
                     launch.from.y - launch.velocity.y * t - 0.5 * gravity * t * t};
    const double down = launch.velocity.y + gravity * t;
    const double speed = math::hypot(launch.velocity.x, down);
    const bool moves = launch.area_rate < launch.thickest * speed;
    const double depth = moves ? launch.area_rate / speed : launch.thickest;
    const Vec2 ahead = speed > 0.0 ? Vec2{launch.velocity.x / speed, down / speed} : Vec2{0.0, 1.0};
    const Vec2 across = launch.side * depth * Vec2{ahead.y, ahead.x};
    // What falls straight down lay on nothing.
    const Vec2 back = launch.velocity.x == 0.0 ? 0.5 * across : Vec2{};
    flight.path.push_back(place - back);
    flight.beyond.push_back(place - back + across);
  }
  return flight;
}

Launch launched(FlightKind kind, const Motion& motion, double s) {
  const BulkStream& stream = *stream_of(motion.body());
  Launch launch;
  launch.kind = kind;
  launch.thickest = stream.width(s);
  launch.area_rate = stream.depth(s, 1.0);
  return launch;
}

void leave(Launch& launch, const CenterlinePoint& edge, double speed) {
  launch.velocity = {speed * math::cos(edge.slope_angle), speed * math::sin(edge.slope_angle)};
}

/// From the pulley or outlet down to where the track, or the hood, meets it.
Launch feed_launch(const Design& design, const Motion& motion, Vec2 met) {
  const FeedFall fall = pipeline::first_fall(design);
  Launch launch = launched(FlightKind::feed, motion, 0.0);
  launch.time = fall.time;
  launch.from = {met.x - fall.reach, met.y + fall.height};
  if (fall.time > 0.0)
    launch.velocity = {fall.reach / fall.time, fall.height / fall.time - 0.5 * design.gravity * fall.time};
  return launch;
}

}  // namespace

std::string_view to_text(FlightKind kind) {
  switch (kind) {
    case FlightKind::feed:
      return "feed";
    case FlightKind::from_hood:
      return "fall from the hood";
    case FlightKind::to_belt:
      break;
  }
  return "fall on the belt";
}

std::vector<StreamFlight> stream_flights(const Design& design, const Motion& motion,
                                         const HoodPassage* nominal, const HoodPassage* hood) {
  std::vector<StreamFlight> flights;
  const double gravity = design.gravity;
  const Vec2 met = nominal != nullptr ? Vec2{-nominal->start.x, nominal->start.y} : Vec2{};
  if (design.feed) flights.push_back(flown(feed_launch(design, motion, met), gravity));
  if (hood != nullptr && hood->motion.exit_speed() > 0.0) {
    const CenterlinePoint edge = hood->motion.centerline().at(hood->motion.distance());
    Launch launch = launched(FlightKind::from_hood, hood->motion, 0.0);
    launch.from = {met.x + edge.x, met.y - edge.drop};
    leave(launch, edge, hood->motion.exit_speed());
    launch.time = hood->fall_time;
    launch.side = -1.0;
    flights.push_back(flown(launch, gravity));
  }
  if (design.discharge && motion.arrived()) {
    const Centerline& track = motion.centerline();
    const CenterlinePoint end = track.at(track.length());
    Launch launch = launched(FlightKind::to_belt, motion, track.length());
    launch.from = {end.x, -end.drop};
    leave(launch, end, motion.exit_speed());
    launch.time = belt_landing(design, motion).time;
    flights.push_back(flown(launch, gravity));
  }
  return flights;
}

std::vector<StreamFlight> stream_flights(const Design& design, const Track& track) {
  return stream_flights(design, track, track.motion);
}

std::vector<StreamFlight> stream_flights(const Design& design, const Track& track, const Motion& motion) {
  if (!design.stream) return {};
  if (!design.hood) return stream_flights(design, motion, nullptr, nullptr);
  const HoodPassage nominal = hood_passage(design, track.motion.body());
  const HoodPassage hood = hood_passage(design, motion.body());
  return stream_flights(design, motion, &nominal, &hood);
}

std::vector<Vec2> hood_line(const Design& design, const Track& track) {
  if (!design.hood) return {};
  const HoodPassage hood = hood_passage(design, track.motion.body());
  const Centerline& arc = hood.motion.centerline();
  constexpr int kPieces = 48;
  std::vector<Vec2> line;
  for (int i = 0; i <= kPieces; ++i) {
    const CenterlinePoint at = arc.at(std::min(arc.length(), arc.length() * i / kPieces));
    line.push_back({at.x - hood.start.x, hood.start.y - at.drop});
  }
  return line;
}

std::vector<FlightApproach> flight_approaches(const Design& design,
                                              const std::vector<StreamFlight>& flights) {
  if (!design.limits || !design.limits->has_clearances()) return {};
  Limits limits = problem_of(design).limits;
  for (KeepOut& area : limits.keep_outs) area.passage = Passage::either;
  std::vector<FlightApproach> approaches;
  for (const task::Obstacle& obstacle : task::obstacles_of(limits)) {
    std::optional<FlightApproach> closest;
    for (const StreamFlight& flight : flights) {
      for (std::size_t i = 0; i + 1 < flight.path.size(); ++i) {
        std::array<Vec2, 4> piece{flight.path[i], flight.path[i + 1], flight.beyond[i + 1], flight.beyond[i]};
        for (Vec2& corner : piece) corner.y = -corner.y;
        const clearance::Nearest near = obstacle.region.nearest(piece);
        if (closest && near.value >= closest->distance) continue;
        closest = FlightApproach{
            obstacle.limit.key(), obstacle.clearance, near.value, flight.kind, {near.point.x, -near.point.y}};
      }
    }
    if (closest) approaches.push_back(std::move(*closest));
  }
  return approaches;
}

}  // namespace glissade
