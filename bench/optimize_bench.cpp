// How long the search for the fastest track takes: without limits and with five. Where IPOPT is installed, a plain
// collocation of the same problem is solved beside it; the counters tell each one's relative excess over the exact
// optimum.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/ore.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>
#ifdef GLISSADE_HAS_IPOPT
#include <IpStdCInterface.h>
#endif

namespace {

using namespace glissade;

Problem ramp() {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  return problem;
}

double exact_time(const Problem& problem) {
  return solve_coulomb_brachistochrone(problem.endpoints, problem.body.friction, problem.gravity).travel_time;
}

void unlimited(benchmark::State& state) {
  const Problem problem = ramp();
  double time = 0.0;
  for (auto _ : state) time = optimize(problem).report.travel_time;
  state.counters["excess"] = time / exact_time(problem) - 1.0;
}
BENCHMARK(unlimited)->Unit(benchmark::kMillisecond);

void five_limits(benchmark::State& state) {
  Problem problem = ramp();
  problem.limits.slope_angle.highest = 0.8;
  problem.limits.exit_slope_angle = Range::fixed(0.2);
  problem.limits.smallest_valley_radius = 6.0;
  problem.limits.highest_normal_load = 14.0;
  problem.limits.lead_out = 1.0;
  for (auto _ : state) benchmark::DoNotOptimize(optimize(problem).report.travel_time);
}
BENCHMARK(five_limits)->Unit(benchmark::kMillisecond);

/// Ore down 4.3 m and 5.9 m at 24 to 31 deg of friction: law, range and limits of a chute.
void stream(benchmark::State& state) {
  Problem problem = testing_problems::ore(4.3, 5.9, 2.5);
  problem.body.friction = Friction::from_angle(Angle::from_degrees(27.0));
  problem.low_friction = Friction::from_angle(Angle::from_degrees(24.0));
  problem.high_friction = Friction::from_angle(Angle::from_degrees(31.0));
  problem.limits.lowest_slope_margin = Angle::from_degrees(5.0).radians();
  problem.limits.smallest_valley_radius = 1.5;
  problem.limits.smallest_crest_radius = 1.5;
  for (auto _ : state) benchmark::DoNotOptimize(optimize(problem).report.travel_time);
}
BENCHMARK(stream)->Unit(benchmark::kMillisecond);

#ifdef GLISSADE_HAS_IPOPT
/// The w-form on a polygon: unknown slope angles of its sides, w at its corners, length; sides even in
/// sqrt(s).
struct Collocation {
  int sides = 0;
  double mu = 0.0;
  double run = 0.0;
  double drop = 0.0;

  [[nodiscard]] double share(int k) const { return (2.0 * k + 1.0) / (static_cast<double>(sides) * sides); }
  [[nodiscard]] int variables() const { return 2 * sides + 1; }
};

Bool objective(Index n, Number* z, Bool, Number* value, UserDataPtr data) {
  const auto& c = *static_cast<Collocation*>(data);
  double sum = 0.0;
  for (int k = 0; k < c.sides; ++k) {
    const double before = k == 0 ? 0.0 : z[c.sides + k - 1];
    const double roots = std::sqrt(std::max(before, 0.0)) + std::sqrt(std::max(z[c.sides + k], 1e-14));
    sum += 2.0 * z[n - 1] * c.share(k) * std::exp(-c.mu * z[k]) / roots;
  }
  *value = sum;
  return TRUE;
}

Bool gradient(Index n, Number* z, Bool, Number* out, UserDataPtr data) {
  const auto& c = *static_cast<Collocation*>(data);
  std::fill_n(out, n, 0.0);
  for (int k = 0; k < c.sides; ++k) {
    const double first = k == 0 ? 0.0 : std::sqrt(std::max(z[c.sides + k - 1], 0.0));
    const double second = std::sqrt(std::max(z[c.sides + k], 1e-14));
    const double part = 2.0 * z[n - 1] * c.share(k) * std::exp(-c.mu * z[k]) / (first + second);
    out[k] -= c.mu * part;
    if (k > 0) out[c.sides + k - 1] -= part / (first + second) * 0.5 / std::max(first, 1e-7);
    out[c.sides + k] -= part / (first + second) * 0.5 / second;
    out[n - 1] += part / z[n - 1];
  }
  return TRUE;
}

Bool constraints(Index n, Number* z, Bool, Index, Number* out, UserDataPtr data) {
  const auto& c = *static_cast<Collocation*>(data);
  double x = 0.0;
  double y = 0.0;
  for (int k = 0; k < c.sides; ++k) {
    const double ds = z[n - 1] * c.share(k);
    x += ds * std::cos(z[k]);
    y += ds * std::sin(z[k]);
    const double before = k == 0 ? 0.0 : z[c.sides + k - 1];
    out[2 + k] = z[c.sides + k] - before -
                 2.0 * ds * (std::sin(z[k]) - c.mu * std::cos(z[k])) * std::exp(-2.0 * c.mu * z[k]);
  }
  out[0] = x - c.run;
  out[1] = y - c.drop;
  return TRUE;
}

Bool jacobian(Index n, Number* z, Bool, Index, Index, Index* rows, Index* columns, Number* out,
              UserDataPtr data) {
  const auto& c = *static_cast<Collocation*>(data);
  int at = 0;
  const auto entry = [&](int row, int column, double value) {
    if (out == nullptr) {
      rows[at] = row;
      columns[at] = column;
    } else {
      out[at] = value;
    }
    ++at;
  };
  const bool values = out != nullptr;
  double x = 0.0;
  double y = 0.0;
  for (int k = 0; k < c.sides; ++k) {
    const double zeta = values ? z[k] : 0.0;
    const double ds = values ? z[n - 1] * c.share(k) : 0.0;
    const double weight = std::exp(-2.0 * c.mu * zeta);
    const double drive = 2.0 * (std::sin(zeta) - c.mu * std::cos(zeta));
    entry(0, k, -ds * std::sin(zeta));
    entry(1, k, ds * std::cos(zeta));
    entry(2 + k, k, -ds * weight * (2.0 * (std::cos(zeta) + c.mu * std::sin(zeta)) - 2.0 * c.mu * drive));
    if (k > 0) entry(2 + k, c.sides + k - 1, -1.0);
    entry(2 + k, c.sides + k, 1.0);
    entry(2 + k, n - 1, -c.share(k) * weight * drive);
    x += c.share(k) * std::cos(zeta);
    y += c.share(k) * std::sin(zeta);
  }
  entry(0, n - 1, x);
  entry(1, n - 1, y);
  return TRUE;
}

Bool hessian(Index, Number*, Bool, Number, Index, Number*, Bool, Index, Index*, Index*, Number*,
             UserDataPtr) {
  return FALSE;
}

void ipopt_collocation(benchmark::State& state) {
  const Problem problem = ramp();
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  Collocation c{static_cast<int>(state.range(0)), problem.body.friction.coefficient(),
                problem.endpoints.run / chord, problem.endpoints.drop / chord};
  const int n = c.variables();
  const int m = c.sides + 2;
  double value = 0.0;
  int status = 0;
  for (auto _ : state) {
    std::vector<double> lower(static_cast<std::size_t>(n), -1.6);
    std::vector<double> upper(static_cast<std::size_t>(n), 1.6);
    for (int k = c.sides; k < n; ++k) {
      lower[static_cast<std::size_t>(k)] = k + 1 == n ? 1.0 : 1e-12;
      upper[static_cast<std::size_t>(k)] = 10.0;
    }
    std::vector<double> zero(static_cast<std::size_t>(m), 0.0);
    // The straight ramp, which a user would start from.
    std::vector<double> z(static_cast<std::size_t>(n), std::atan2(c.drop, c.run));
    const double angle = z[0];
    double s = 0.0;
    for (int k = 0; k < c.sides; ++k) {
      s += c.share(k);
      z[static_cast<std::size_t>(c.sides + k)] =
          2.0 * s * (std::sin(angle) - c.mu * std::cos(angle)) * std::exp(-2.0 * c.mu * angle);
    }
    z.back() = 1.0;
    const int entries = 6 * c.sides - 1 + 2;
    IpoptProblem ipopt =
        CreateIpoptProblem(n, lower.data(), upper.data(), m, zero.data(), zero.data(), entries, 0, 0,
                           objective, constraints, gradient, jacobian, hessian);
    char hessian_key[] = "hessian_approximation";
    char hessian_value[] = "limited-memory";
    char print_key[] = "print_level";
    char banner_key[] = "sb";
    char banner_value[] = "yes";
    char tolerance_key[] = "tol";
    AddIpoptStrOption(ipopt, hessian_key, hessian_value);
    AddIpoptStrOption(ipopt, banner_key, banner_value);
    AddIpoptIntOption(ipopt, print_key, 0);
    AddIpoptNumOption(ipopt, tolerance_key, 1e-8);
    status = IpoptSolve(ipopt, z.data(), nullptr, &value, nullptr, nullptr, nullptr, &c);
    FreeIpoptProblem(ipopt);
  }
  state.counters["status"] = status;
  state.counters["excess"] = value * std::sqrt(chord / problem.gravity) / exact_time(problem) - 1.0;
}
BENCHMARK(ipopt_collocation)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);
#endif

}  // namespace

BENCHMARK_MAIN();
