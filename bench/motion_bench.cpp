// What the referee costs: a ride down a given track, and the table of its stations. The plain integrator
// beside it is what one writes down first, the fourth-order Runge-Kutta rule in arc length with 1000 steps;
// all run in one program so that the ratios are measured together.
#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/motion.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace glissade;

constexpr int kStations = 1000;
const Body kBody{Friction::from_coefficient(0.2), 2.0, 1e-3};

CenterlinePtr eased_track() {
  return std::make_shared<const ClothoidSpline>(
      Angle::from_degrees(60.0),
      std::vector<ClothoidSegment>{
          {2.0, 0.0, 0.0}, {1.0, 0.0, 0.4}, {2.0, 0.4, 0.4}, {1.0, 0.4, -0.1}, {2.0, -0.1, -0.1}});
}

CenterlinePtr fastest_track() {
  return std::make_shared<const CoulombBrachistochrone>(Endpoints{10.0, 5.0}, kBody.friction);
}

std::vector<double> stations_of(const Centerline& track) {
  std::vector<double> stations;
  for (int i = 0; i < kStations; ++i) {
    stations.push_back(track.length() * (static_cast<double>(i) / (kStations - 1)));
  }
  return stations;
}

void table_of(benchmark::State& state, const CenterlinePtr& track) {
  const std::vector<double> stations = stations_of(*track);
  for (auto _ : state) {
    const Motion ride(track, kBody);
    for (const double station : stations) benchmark::DoNotOptimize(ride.at(station));
  }
}

void ride_of(benchmark::State& state, const CenterlinePtr& track) {
  for (auto _ : state) {
    const Motion ride(track, kBody);
    benchmark::DoNotOptimize(ride.travel_time());
  }
}

/// 650 t/h of ore in a chute of 800 mm.
void ride_of_stream(benchmark::State& state, const CenterlinePtr& track) {
  StreamShape shape;
  shape.mass_flow = 650.0 / 3.6;
  shape.bulk_density = 1600.0;
  shape.width = 0.8;
  shape.wall_height = 0.5;
  Body body = kBody;
  body.law = std::make_shared<const BulkStream>(shape);
  for (auto _ : state) {
    const Motion ride(track, body);
    benchmark::DoNotOptimize(ride.travel_time());
  }
}

/// (v, t) after 1000 steps of the plain rule.
void runge_kutta(benchmark::State& state, const CenterlinePtr& track) {
  const double mu = kBody.friction.coefficient();
  const auto rate = [&](double s, double v) {
    const Direction here = track->direction(s);
    const double load = kDefaultGravity * std::cos(here.slope_angle) + here.curvature * v;
    return 2.0 * (kDefaultGravity * std::sin(here.slope_angle) - mu * load - kBody.drag_per_metre * v);
  };
  const double step = track->length() / kStations;
  for (auto _ : state) {
    double v = kBody.entry_speed * kBody.entry_speed;
    double time = 0.0;
    for (int i = 0; i < kStations; ++i) {
      const double s = step * i;
      const double end = std::fmin(s + step, track->length());
      const double first = rate(s, v);
      const double second = rate(s + 0.5 * step, v + 0.5 * step * first);
      const double third = rate(s + 0.5 * step, v + 0.5 * step * second);
      const double fourth = rate(end, v + step * third);
      const double next = v + step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth);
      time += 2.0 * step / (std::sqrt(v) + std::sqrt(next));
      v = next;
    }
    benchmark::DoNotOptimize(time);
  }
}

}  // namespace

BENCHMARK_CAPTURE(ride_of, eased_track, eased_track());
BENCHMARK_CAPTURE(ride_of_stream, eased_track, eased_track());
BENCHMARK_CAPTURE(table_of, eased_track_1000_stations, eased_track());
BENCHMARK_CAPTURE(runge_kutta, eased_track_1000_steps, eased_track());
BENCHMARK_CAPTURE(ride_of, fastest_track, fastest_track());
BENCHMARK_CAPTURE(table_of, fastest_track_1000_stations, fastest_track());

BENCHMARK_MAIN();
