#include "glissade/trades/chute/wear.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace glissade {
namespace {

// Wear follows load and width, which change slowly beside this many places.
constexpr int kPlaces = 400;
// Of its peak: where a floor wears less than this, a plate of its own pays little.
constexpr double kWorthAPlate = 0.5;

/// Places that a ride is looked at: evenly spread, that of its peak, and both sides of each where it changes.
std::vector<double> places_of(const Motion& motion) {
  const double end = motion.distance();
  std::vector<double> places;
  for (int i = 0; i <= kPlaces; ++i) places.push_back(std::min(end, end * i / kPlaces));
  places.push_back(stream_peak(motion, &StreamState::floor_wear).arc_length);
  for (const double at : motion.breaks()) {
    places.push_back(std::nextafter(at, 0.0));
    places.push_back(at);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
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

/// Where on a ride the floor wears at least so much: between two places found by halving, to the last side of them that does.
void add_stretches(const Motion& ride, double least, std::vector<WearStretch>& stretches) {
  constexpr double kClose = 1e-7;  // accuracy: a tenth of a micrometre [m]
  const auto worn_at = [&](double s) { return stream_state(ride, s).floor_wear >= least; };
  const auto edge = [&](double worn, double other) {
    while (std::fabs(worn - other) > kClose) {
      const double middle = 0.5 * (worn + other);
      (worn_at(middle) ? worn : other) = middle;
    }
    return worn;
  };
  const std::vector<double> places = places_of(ride);
  std::optional<double> from;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool worn = worn_at(places[i]);
    if (worn && !from) from = i == 0 ? places[i] : edge(places[i], places[i - 1]);
    if (worn && i + 1 < places.size()) continue;
    if (from) stretches.push_back({*from, worn ? places[i] : edge(places[i - 1], places[i])});
    from.reset();
  }
}

}  // namespace

WearFacts wear_of(const std::vector<const Motion*>& rides) {
  require_rides(rides);
  WearFacts facts;
  for (std::size_t i = 0; i < rides.size(); ++i) {
    const ValueAt floor = stream_peak(*rides[i], &StreamState::floor_wear);
    const ValueAt wall = stream_peak(*rides[i], &StreamState::wall_wear);
    const ValueAt pressed = stream_peak(*rides[i], &StreamState::pressed);
    if (wall.value > facts.wall.value) facts.wall = wall;
    if (floor.value > facts.floor.value) {
      facts.floor = floor;
      facts.ride = i;
    }
    if (pressed.value > facts.pressed.value) {
      facts.pressed = pressed;
      facts.pressed_ride = i;
    }
  }
  facts.mean_floor = mean_floor_wear(*rides[facts.ride]);
  for (const Motion* const ride : rides) add_stretches(*ride, kWorthAPlate * facts.floor.value, facts.plates);
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
      load.pressed = std::max(load.pressed, state.pressed);
    }
    loads.push_back(load);
  }
  return loads;
}

}  // namespace glissade
