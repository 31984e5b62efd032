// Plates made and proven and their files written, of shipped designs with a fabrication; tracks as arcs: time of a fit with its certificate, arcs found and the bound that none beat, of every shipped design at
// the tolerance of its process. Run from the root of the project.
//   parts_bench --benchmark_counters_tabular=true

#include "glissade/parts/master_curve.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/pipeline.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>

#include <benchmark/benchmark.h>

namespace {

using namespace glissade;

void fit(benchmark::State& state, const std::string& design, double tolerance) {
  const Track track = solve(read_design("designs/" + design + ".yaml"));
  MasterCurve curve;
  for (auto _ : state) {
    curve = fit_arcs(*track.centerline, {tolerance, FitSide::both, track.search.has_value()});
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
BENCHMARK_CAPTURE(fit, wood_chip_chute, std::string("wood_chip_chute"), 1e-4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, ore_transfer, std::string("ore_transfer"), 1e-4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, powder_chute, std::string("powder_chute"), 1e-4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, marble_run, std::string("marble_run"), 2e-5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, sand_ski_ramp, std::string("sand_ski_ramp"), 1e-3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, ski_jump_inrun, std::string("ski_jump_inrun"), 1e-3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, ski_jump_inrun_with_limits, std::string("ski_jump_inrun_with_limits"), 1e-3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, toboggan_run, std::string("toboggan_run"), 1e-3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, toboggan_on_terrain, std::string("toboggan_on_terrain"), 1e-3)
    ->Unit(benchmark::kMillisecond);
// At tolerances not its own, docs/fabrication.md.
BENCHMARK_CAPTURE(fit, toboggan_on_terrain_0p1mm, std::string("toboggan_on_terrain"), 1e-4)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, toboggan_on_terrain_0p3mm, std::string("toboggan_on_terrain"), 3e-4)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, toboggan_on_terrain_10mm, std::string("toboggan_on_terrain"), 1e-2)
    ->Unit(benchmark::kMillisecond);

/// Plates made and proven.
void plates(benchmark::State& state, const std::string& name) {
  const Design design = read_design("designs/" + name + ".yaml");
  const Track track = solve(design);
  PlateOptions options = std::get<PlateOptions>(design.fabrication->process);
  if (options.supports) options.supports->ground = {{0.0, -track.endpoints.drop - 1.1}};
  std::size_t parts = 0;
  for (auto _ : state) {
    const WorkshopBuild made =
        make_plates(*track.centerline, *design.cross_section, {design.fabrication->arc_tolerance}, options,
                    track.placement, body_of(design), design.gravity);
    parts = made.workshop.parts.size();
  }
  state.counters["parts"] = static_cast<double>(parts);
}

/// Every file of a workshop written, beside the table of stations alone.
void files(benchmark::State& state, const std::string& name) {
  const Design design = read_design("designs/" + name + ".yaml", {{"export", "{formats: [csv, workshop]}"}});
  const Assembly assembly = assemble(design, solve(design), {}, {.report = false});
  const std::filesystem::path place = std::filesystem::temp_directory_path() / ("glissade_bench_" + name);
  for (const PendingFile& file : assembly.files)
    std::filesystem::create_directories((place / file.name).parent_path());
  for (auto _ : state) {
    for (const PendingFile& file : assembly.files) file.write(place / file.name, {});
  }
  std::filesystem::remove_all(place);
  state.counters["files"] = static_cast<double>(assembly.files.size());
}

BENCHMARK_CAPTURE(plates, grain_chute_fabricated, std::string("grain_chute_fabricated"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plates, grain_chute_with_limits_bent, std::string("grain_chute_with_limits_bent"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plates, powder_chute_mitred, std::string("powder_chute_mitred"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(files, grain_chute_fabricated, std::string("grain_chute_fabricated"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(files, grain_chute_with_limits_bent, std::string("grain_chute_with_limits_bent"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(files, powder_chute_mitred, std::string("powder_chute_mitred"))
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
