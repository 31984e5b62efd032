#include "glissade/trades/chute/wear.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <string>

namespace glissade {
namespace {

// Wear follows load and width, which change slowly beside this many places.
constexpr int kPlaces = 400;
// Of its peak: where a floor wears less than this, a plate of its own pays little.
constexpr double kWorthAPlate = 0.5;

/// Places that a ride is looked at: evenly spread, and those of its extremes and of changes of width.
std::vector<double> places_of(const Motion& motion) {
  const double end = motion.distance();
  std::vector<double> places;
  for (int i = 0; i <= kPlaces; ++i) places.push_back(std::min(end, end * i / kPlaces));
  places.push_back(motion.highest_load().arc_length);
  for (const WidthAt& width : stream_of(motion.body())->shape().width.knots()) {
    if (width.at > 0.0 && width.at < end) places.push_back(width.at);
  }
  std::sort(places.begin(), places.end());
  return places;
}

void require_rides(const std::vector<const Motion*>& rides) {
  if (rides.empty()) throw InputError({"", "there is no ride to wear anything", "", ""});
  for (std::size_t i = 0; i < rides.size(); ++i) {
    if (rides[i] != nullptr && stream_of(rides[i]->body()) != nullptr) continue;
    const std::string which = "ride " + std::to_string(i + 1);
    throw InputError({"", which + (rides[i] == nullptr ? " is none" : " is of no stream"),
                      "What flows rubs on its floor; a point or a ball is not told to.",
                      "rides of a body whose law is BulkStream"});
  }
}

void join(std::vector<WearStretch>& stretches) {
  std::sort(stretches.begin(), stretches.end(),
            [](const WearStretch& a, const WearStretch& b) { return a.from < b.from; });
  std::vector<WearStretch> joined;
  for (const WearStretch& stretch : stretches) {
    if (!joined.empty() && stretch.from <= joined.back().to) {
      joined.back().to = std::max(joined.back().to, stretch.to);
    } else {
      joined.push_back(stretch);
    }
  }
  stretches = std::move(joined);
}

/// p v_slip, v_slip = K_c u.
double pressed_at(const Motion& motion, const StreamState& state, double s) {
  return state.floor_pressure * stream_of(motion.body())->shape().slip_ratio * motion.at(s).speed;
}

}  // namespace

WearFacts wear_of(const std::vector<const Motion*>& rides) {
  require_rides(rides);
  WearFacts facts;
  for (std::size_t i = 0; i < rides.size(); ++i) {
    const Motion& motion = *rides[i];
    for (const double s : places_of(motion)) {
      const StreamState state = stream_state(motion, s);
      if (state.wall_wear > facts.wall.value) facts.wall = {state.wall_wear, s};
      if (state.floor_wear > facts.floor.value) {
        facts.floor = {state.floor_wear, s};
        facts.ride = i;
      }
      const double pressed = pressed_at(motion, state, s);
      if (pressed > facts.pressed.value) {
        facts.pressed = {pressed, s};
        facts.pressed_ride = i;
      }
    }
  }
  const Motion& worst = *rides[facts.ride];
  for (int i = 0; i < kPlaces; ++i)
    facts.mean_floor += stream_state(worst, worst.distance() * (i + 0.5) / kPlaces).floor_wear / kPlaces;
  for (const Motion* const ride : rides) {
    const std::vector<double> places = places_of(*ride);
    std::optional<double> from;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool worn = stream_state(*ride, places[i]).floor_wear >= kWorthAPlate * facts.floor.value;
      if (worn && !from) from = i == 0 ? places[i] : places[i - 1];
      if (worn && i + 1 < places.size()) continue;
      if (from) facts.plates.push_back({*from, places[i]});
      from.reset();
    }
  }
  join(facts.plates);
  return facts;
}

double thickness_loss_rate(const LinerWear& liner, double pressed) {
  return liner.coefficient * pressed / liner.hardness;
}

std::vector<FloorLoad> floor_loads(const std::vector<const Motion*>& rides) {
  require_rides(rides);
  std::vector<double> places;
  for (const Motion* const ride : rides) {
    const std::vector<double> of_ride = places_of(*ride);
    places.insert(places.end(), of_ride.begin(), of_ride.end());
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<FloorLoad> loads;
  for (const double s : places) {
    FloorLoad load{s, 0.0, 0.0};
    for (const Motion* const ride : rides) {
      if (s > ride->distance()) continue;
      const StreamState state = stream_state(*ride, s);
      load.wear = std::max(load.wear, state.floor_wear);
      load.pressed = std::max(load.pressed, pressed_at(*ride, state, s));
    }
    loads.push_back(load);
  }
  return loads;
}

}  // namespace glissade
