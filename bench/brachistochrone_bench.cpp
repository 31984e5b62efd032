// What the fastest track costs: solving it, building the curve, asking the curve. The plain solvers beside it
// are what one writes down first from docs/theory.md; all run in one program so that the ratios are measured
// together.
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/flying_start_brachistochrone.hpp"

#include "allocation_count.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using glissade::CoulombBrachistochrone;
using glissade::CoulombSolution;
using glissade::Endpoints;
using glissade::Friction;

struct Problem {
  Endpoints endpoints;
  Friction friction;
};

/// @param least_margin, most_margin  decimal exponents of eps = drop/(mu run) - 1
std::vector<Problem> spread(double least_friction, double most_friction, double least_margin,
                            double most_margin) {
  constexpr int kSteps = 32;
  std::vector<Problem> problems;
  for (int i = 0; i < kSteps; ++i) {
    const double mu = least_friction * std::pow(most_friction / least_friction, (i + 0.5) / kSteps);
    for (int j = 0; j < kSteps; ++j) {
      const double exponent = least_margin + (most_margin - least_margin) * (j + 0.5) / kSteps;
      const double run = std::pow(10.0, -3.0 + (i * 7 + j * 3) % kSteps * 0.25);
      problems.push_back(
          {{run, mu * run * (1.0 + std::pow(10.0, exponent))}, Friction::from_coefficient(mu)});
    }
  }
  return problems;
}

std::vector<Problem> frictionless() {
  std::vector<Problem> problems;
  for (int i = 0; i < 1000; ++i) problems.push_back({{10.0, std::pow(10.0, -3.0 + 0.008 * i)}, Friction{}});
  return problems;
}

/// The closed forms (B9) to (B12) of docs/theory.md as they stand, bisected over the exit slope angle.
namespace plain {

struct Finish {
  double x, y, time;  // in units of C and sqrt(C/g)
};

Finish closed_form(double mu, double exit_slope) {
  const double q = std::sqrt(1.0 - mu * mu + 2.0 * mu * exit_slope);
  const double tau = exit_slope - mu;
  const double a = -tau;
  const double e = tau * tau + q * q;
  const double i1 = std::atan2(q, tau) / q;
  const double i2 = i1 / (2.0 * q * q) - tau / (2.0 * q * q * e);
  const double i3 = 3.0 * i2 / (4.0 * q * q) - tau / (4.0 * q * q * e * e);
  const double j2 = 1.0 / (2.0 * e);
  const double j3 = 1.0 / (4.0 * e * e);
  return {i2 + 4.0 * mu * (j3 + a * i3),
          j2 + mu * i2 + 4.0 * mu * (i2 - q * q * i3 + a * j3) + 4.0 * mu * mu * (j3 + a * i3),
          i1 + 4.0 * mu * (j2 + a * i2)};
}

/// The integrals (B6) to (B8) by the midpoint rule over the phase, 64 points.
Finish quadrature(double mu, double exit_slope) {
  constexpr int kPoints = 64;
  const double q = std::sqrt(1.0 - mu * mu + 2.0 * mu * exit_slope);
  const double a = mu - exit_slope;
  const double phase = std::atan2(q, -a);
  Finish sum{0.0, 0.0, 0.0};
  for (int i = 0; i < kPoints; ++i) {
    const double angle = (i + 0.5) * phase / kPoints;
    const double sine = std::sin(angle);
    const double tau = q * std::cos(angle) / sine;
    const double inverse = sine * sine / (q * q);
    const double time = (1.0 + 4.0 * mu * (tau + a) * inverse) / q * phase / kPoints;
    sum.time += time;
    sum.x += time * inverse;
    sum.y += time * inverse * (tau + mu);
  }
  return sum;
}

template <class Forms>
double travel_time(const Problem& problem, double gravity, const Forms& forms) {
  const double mu = problem.friction.coefficient();
  const double mean = problem.endpoints.drop / problem.endpoints.run;
  double low = 2.0 * std::atan(mu) - std::numbers::pi / 2.0;
  double high = std::numbers::pi / 2.0;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (low + high);
    const Finish finish = forms(mu, std::tan(middle));
    (finish.y < mean * finish.x ? low : high) = middle;
  }
  const Finish finish = forms(mu, std::tan(0.5 * (low + high)));
  return finish.time * std::sqrt(problem.endpoints.run / (finish.x * gravity));
}

}  // namespace plain

template <class Solve>
void over(benchmark::State& state, const std::vector<Problem>& problems, const Solve& solve) {
  std::size_t next = 0;
  const std::size_t before = glissade::bench::allocation_count();
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve(problems[next]));
    if (++next == problems.size()) next = 0;
  }
  state.counters["allocations"] = static_cast<double>(glissade::bench::allocation_count() - before);
}

void solve(benchmark::State& state, const std::vector<Problem>& problems) {
  over(state, problems, [](const Problem& problem) {
    return glissade::solve_coulomb_brachistochrone(problem.endpoints, problem.friction, 9.81);
  });
}

BENCHMARK_CAPTURE(solve, usual, spread(0.02, 1.0, -1.0, 1.5));
BENCHMARK_CAPTURE(solve, near_reach_limit, spread(0.02, 3.0, -6.0, -1.0));
BENCHMARK_CAPTURE(solve, steep, spread(0.02, 3.0, 1.5, 4.0));
BENCHMARK_CAPTURE(solve, little_friction, spread(1e-8, 0.02, -3.0, 8.0));
BENCHMARK_CAPTURE(solve, no_friction, frictionless());

/// Endpoints that a body reaches that enters with 5 m/s.
std::vector<Problem> within_reach(double least_margin, double most_margin) {
  constexpr double kEntrySpeed = 5.0;
  std::vector<Problem> problems;
  for (int i = 0; i < 1000; ++i) {
    const double mu = 0.02 * std::pow(50.0, i % 32 / 32.0);
    const double run = std::pow(10.0, -0.5 + 2.0 * (i % 29) / 29.0);
    const double margin = std::pow(10.0, least_margin + (most_margin - least_margin) * (i % 23) / 23.0);
    const Friction friction = Friction::from_coefficient(mu);
    problems.push_back({{run, glissade::least_drop(run, friction, kEntrySpeed) + run * margin}, friction});
  }
  return problems;
}

void solve_flying_start(benchmark::State& state, const std::vector<Problem>& problems) {
  over(state, problems, [](const Problem& problem) {
    return glissade::solve_flying_start(problem.endpoints, problem.friction, 5.0, 9.81);
  });
}
BENCHMARK_CAPTURE(solve_flying_start, usual, within_reach(-1.0, 0.5));
BENCHMARK_CAPTURE(solve_flying_start, near_reach_limit, within_reach(-5.0, -1.0));

void plain_closed_form_bisected(benchmark::State& state) {
  over(state, spread(0.02, 1.0, -1.0, 1.5),
       [](const Problem& problem) { return plain::travel_time(problem, 9.81, plain::closed_form); });
}
BENCHMARK(plain_closed_form_bisected);

void plain_quadrature_bisected(benchmark::State& state) {
  over(state, spread(0.02, 1.0, -1.0, 1.5),
       [](const Problem& problem) { return plain::travel_time(problem, 9.81, plain::quadrature); });
}
BENCHMARK(plain_quadrature_bisected);

const Problem kChute{{5.4, 5.1}, Friction::from_coefficient(0.306)};
const Problem kTurnpike{{10.0, 2.0 + 2e-6}, Friction::from_coefficient(0.2)};

void build_curve(benchmark::State& state, const Problem& problem) {
  const std::size_t before = glissade::bench::allocation_count();
  for (auto _ : state) benchmark::DoNotOptimize(CoulombBrachistochrone(problem.endpoints, problem.friction));
  state.counters["allocations"] = benchmark::Counter(
      static_cast<double>(glissade::bench::allocation_count() - before), benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(build_curve, chute, kChute)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(build_curve, eps_1e_minus_6, kTurnpike)->Unit(benchmark::kMicrosecond);

void build_flying_start(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        glissade::FlyingStartBrachistochrone({10.0, 6.0}, Friction::from_coefficient(0.2), 5.0));
  }
}
BENCHMARK(build_flying_start)->Unit(benchmark::kMicrosecond);

template <class Ask>
void ask(benchmark::State& state, const Problem& problem, const Ask& question) {
  const CoulombBrachistochrone track(problem.endpoints, problem.friction);
  constexpr double kGoldenRatio = 0.6180339887498949;
  double part = 0.0;
  const std::size_t before = glissade::bench::allocation_count();
  for (auto _ : state) {
    part += kGoldenRatio;
    if (part >= 1.0) part -= 1.0;
    benchmark::DoNotOptimize(question(track, part * track.length()));
  }
  state.counters["allocations"] = static_cast<double>(glissade::bench::allocation_count() - before);
}

void point_by_arc_length(benchmark::State& state, const Problem& problem) {
  ask(state, problem, [](const CoulombBrachistochrone& track, double s) { return track.at(s); });
}
BENCHMARK_CAPTURE(point_by_arc_length, chute, kChute);
BENCHMARK_CAPTURE(point_by_arc_length, eps_1e_minus_6, kTurnpike);

void slope_angle_by_arc_length(benchmark::State& state, const Problem& problem) {
  ask(state, problem, [](const CoulombBrachistochrone& track, double s) { return track.slope_angle(s); });
}
BENCHMARK_CAPTURE(slope_angle_by_arc_length, chute, kChute);
BENCHMARK_CAPTURE(slope_angle_by_arc_length, eps_1e_minus_6, kTurnpike);

}  // namespace

BENCHMARK_MAIN();
