// Files for workshops: time and size of a DXF of a side plate, of STEP, the set of drawings and the nests of 40 parts.

#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/io/step_file.hpp"

#include "support/shop_parts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace glissade;

/// A side plate of the size of the grain chute's: 15 arcs an edge, 15 holes, its number in single strokes.
Drawing side_plate() {
  Drawing drawing;
  drawing.add(drawing.layer({"CUT", LineStyle::continuous, 0.25, 7}), testing::band(15, 3000.0, 250.0, 15));
  const std::size_t mark = drawing.layer({"MARK", LineStyle::continuous, 0.18, 5});
  for (const ArcPath& stroke : stroked_text("07", {40.0, -400.0}, 20.0)) drawing.add(mark, stroke);
  return drawing;
}

/// Forty parts: walls with holes, floors, leaning walls, gores; some 1000 faces.
Workshop forty_parts() {
  Workshop workshop;
  workshop.name = "bench";
  for (int i = 1; i <= 40; ++i) {
    const Frame place{{0.1 * i, 0.0, 0.0}};
    if (i % 4 == 0)
      workshop.parts.push_back(testing::shop_part(i, "wall", Prism{testing::metre_band(7, 9), 0.004}));
    if (i % 4 == 1)
      workshop.parts.push_back(testing::shop_part(i, "floor", Prism{testing::metre_band(6, 0), 0.5}));
    if (i % 4 == 2)
      workshop.parts.push_back(testing::shop_part(i, "flange", Prism{testing::metre_band(1, 12), 0.01}));
    if (i % 4 == 3)
      workshop.parts.push_back(testing::shop_part(
          i, "gore", TubeGore{0.1, 0.003, 0.3, Angle::from_radians(-0.1), Angle::from_radians(0.1)}));
    workshop.parts.back().places = {place};
    const Prism* const plate = std::get_if<Prism>(&workshop.parts.back().body);
    if (plate != nullptr) workshop.parts.back().pattern = FlatPattern{plate->region, {}, {}, {}, {}, 0.0};
  }
  return workshop;
}

void dxf_of_a_plate(benchmark::State& state) {
  const Drawing drawing = side_plate();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = dxf_text(drawing).size();
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(dxf_of_a_plate)->Unit(benchmark::kMillisecond);

void step_of_40_parts(benchmark::State& state) {
  const Workshop workshop = forty_parts();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = step_text(workshop).size();
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(step_of_40_parts)->Unit(benchmark::kMillisecond);

/// Something that everybody knows: the 17 digits of as many numbers as the file has, by the C library.
void printf_of_as_many_numbers(benchmark::State& state) {
  const std::string text = step_text(forty_parts());
  const auto numbers = std::count(text.begin(), text.end(), '.');
  std::array<char, 40> digits{};
  for (auto _ : state) {
    for (std::ptrdiff_t i = 0; i < numbers; ++i) {
      std::snprintf(digits.data(), digits.size(), "%.17g", 0.1 + 1.37 * static_cast<double>(i));
    }
    benchmark::DoNotOptimize(digits);
  }
  state.counters["numbers"] = static_cast<double>(numbers);
}
BENCHMARK(printf_of_as_many_numbers)->Unit(benchmark::kMillisecond);

void drawings_of_40_parts(benchmark::State& state) {
  const Workshop workshop = forty_parts();
  std::size_t bytes = 0;
  std::size_t sheets = 0;
  for (auto _ : state) {
    const std::vector<Sheet> set = drawing_set(workshop);
    sheets = set.size();
    bytes = pdf_text(set, workshop.name).size();
  }
  state.counters["bytes"] = static_cast<double>(bytes);
  state.counters["sheets"] = static_cast<double>(sheets);
}
BENCHMARK(drawings_of_40_parts)->Unit(benchmark::kMillisecond);

void nests_of_40_parts(benchmark::State& state) {
  const Workshop workshop = forty_parts();
  std::size_t sheets = 0;
  double used = 0.0;
  for (auto _ : state) {
    const std::vector<NestedSheet> nests = nest(workshop);
    sheets = nests.size();
    used = 0.0;
    for (const NestedSheet& sheet : nests) used += sheet.utilisation;
  }
  state.counters["sheets"] = static_cast<double>(sheets);
  state.counters["utilisation"] = used / static_cast<double>(sheets);
}
BENCHMARK(nests_of_40_parts)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
