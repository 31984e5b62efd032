// Arcs in place of shipped tracks at tolerances that are not their own, on both sides and on each: how many fits take more
// than ceil(1.16 bound) + 2 arcs, and how many more than 50 ms of processor time. Run from the root of the project.
//
//   fit_bench           the counts, and a line for each fit beyond either
//   fit_bench DESIGN    a line for each fit of one design, by its name below designs/

#include "glissade/core/error.hpp"
#include "glissade/parts/master_curve.hpp"
#include "glissade/pipeline.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <string>
#include <string_view>

namespace {

using namespace glissade;

constexpr std::array kDesigns{"grain_chute",
                              "grain_chute_with_limits",
                              "wood_chip_chute",
                              "ore_transfer",
                              "powder_chute",
                              "marble_run",
                              "sand_ski_ramp",
                              "ski_jump_inrun",
                              "ski_jump_inrun_with_limits",
                              "ski_jump_inrun_track",
                              "toboggan_run",
                              "toboggan_on_terrain",
                              "toboggan_run_with_mats",
                              "hills/klingenthal_hs140",
                              "pudasaini_figure_1"};
constexpr std::array kTolerances{1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 3e-3, 1e-2};
constexpr double kLong = 50.0;  // [ms]

struct Counts {
  int fits = 0;
  int beyond = 0;
  int slow = 0;
  int failed = 0;
  std::size_t arcs = 0;
  double time = 0.0;  // [ms]
};

double processor_time() {
  return 1e3 * static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

void fit(const std::string& design, const Track& track, const MasterCurveOptions& options, bool all,
         Counts& counts) {
  constexpr std::array kSides{"both", "away", "into flow"};
  const char* side = kSides.at(static_cast<std::size_t>(options.side));
  ++counts.fits;
  try {
    const double began = processor_time();
    const MasterCurve curve = fit_arcs(*track.centerline, options);
    const double time = processor_time() - began;
    const auto goal = static_cast<std::size_t>(std::ceil(1.16 * static_cast<double>(curve.lower_bound))) + 2;
    const bool beyond = curve.arcs > goal;
    const bool slow = time > kLong;
    counts.beyond += beyond ? 1 : 0;
    counts.slow += slow ? 1 : 0;
    counts.arcs += curve.arcs;
    counts.time += time;
    if (!all && !beyond && !slow) return;
    std::printf("%-28s %7.2f mm %-9s %3zu arcs, no fewer than %3zu, goal %3zu, %2zu kept, %6.1f ms\n",
                design.c_str(), 1e3 * options.tolerance, side, curve.arcs, curve.lower_bound, goal,
                curve.kept, time);
  } catch (const Error& error) {
    ++counts.failed;
    std::printf("%-28s %7.2f mm %-9s %s\n", design.c_str(), 1e3 * options.tolerance, side, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  Counts counts;
  for (const std::string design : kDesigns) {
    if (argc > 1 && design != argv[1]) continue;
    const Track track = solve(read_design("designs/" + design + ".yaml"));
    for (const double tolerance : kTolerances) {
      for (const FitSide side : {FitSide::both, FitSide::away, FitSide::into_flow})
        fit(design, track, {tolerance, side, track.search.has_value()}, argc > 1, counts);
    }
  }
  std::printf(
      "%d fits, %zu arcs, %.1f ms each in the mean: %d beyond the goal, %d above %.0f ms, %d failed\n",
      counts.fits, counts.arcs, counts.time / counts.fits, counts.beyond, counts.slow, kLong, counts.failed);
  return counts.failed == 0 ? 0 : 1;
}
