// What a row of a sweep costs beside solve() of the same design in the same process.

#include "glissade/design/design_source.hpp"
#include "glissade/study/study.hpp"

#include "study/evaluation.hpp"

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace glissade;

const std::string kDesign = GLISSADE_DESIGNS "/grain_chute.yaml";

study::Study angles() {
  return {DesignSource::read(kDesign),
          {},
          study::Plan({study::vary("body.friction_angle=10deg:25deg:151")}),
          false,
          {}};
}

/// The design alone, read before: what no sweep can do without.
void solve_alone(benchmark::State& state) {
  const study::Study study = angles();
  std::vector<Design> designs;
  for (std::uint64_t index = 0; index < study.plan.count(); ++index) {
    designs.push_back(study.source.with(study.plan.point(index)));
  }
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solve(designs[next++ % designs.size()]).motion.travel_time());
}

/// The same points from key and value to the text of their rows.
void row_of_a_sweep(benchmark::State& state) {
  const study::Study study = angles();
  const study::Evaluation evaluation(study, {});
  std::uint64_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(evaluation.row(next++ % study.plan.count()));
}

BENCHMARK(solve_alone)->Unit(benchmark::kMicrosecond);
BENCHMARK(row_of_a_sweep)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
