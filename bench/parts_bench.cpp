// Tracks as arcs: time of a fit with its certificate, arcs found and the bound that none beat, of every shipped design at
// the tolerance of its process. Run from the root of the project.
//   parts_bench --benchmark_counters_tabular=true

#include "glissade/parts/master_curve.hpp"
#include "glissade/pipeline.hpp"

#include <string>

#include <benchmark/benchmark.h>

namespace {

using namespace glissade;

void fit(benchmark::State& state, const std::string& design, double tolerance) {
  const Track track = solve(read_design("designs/" + design + ".yaml"));
  MasterCurve curve;
  for (auto _ : state) {
    curve = fit_arcs(*track.centerline, {tolerance});
    benchmark::DoNotOptimize(curve.arcs);
  }
  state.counters["arcs"] = static_cast<double>(curve.arcs);
  state.counters["bound"] = static_cast<double>(curve.lower_bound);
  state.counters["kept"] = static_cast<double>(curve.kept);
  state.counters["deviation_mm"] = 1e3 * curve.max_deviation;
}

BENCHMARK_CAPTURE(fit, grain_chute, std::string("grain_chute"), 1e-4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, grain_chute_with_limits, std::string("grain_chute_with_limits"), 1e-4)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, powder_chute, std::string("powder_chute"), 1e-4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, marble_run, std::string("marble_run"), 2e-5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, sand_ski_ramp, std::string("sand_ski_ramp"), 1e-3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, ski_jump_inrun, std::string("ski_jump_inrun"), 1e-3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, ski_jump_inrun_with_limits, std::string("ski_jump_inrun_with_limits"), 1e-3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, toboggan_run, std::string("toboggan_run"), 1e-3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, toboggan_on_terrain, std::string("toboggan_on_terrain"), 1e-3)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
