// Random problems with limits of every kind, one line each: what it took and what was found. Linked with another commit's
// library it tells what that took for the same problems, in the same run of a script:
//
//   limited_bench PROBLEMS        index, processor time [ms], status, travel time [s] (0 where something else is to be
//                                 least, or nothing was found); then the sums
//
// GLISSADE_SEED draws other problems.

#include "glissade/optimize/optimize.hpp"

#include "optimize/random_limits.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

using namespace glissade;

const char* status_text(const Optimum& optimum) {
  if (optimum.report.status == OptimizeStatus::optimal) return "optimal";
  if (optimum.centerline) return "not converged";
  return optimum.report.status == OptimizeStatus::infeasible ? "infeasible" : "none found";
}

std::ptrdiff_t above(const std::vector<double>& sorted, double ms) {
  return sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), ms);
}

}  // namespace

int main(int count, char** arguments) {
  const int problems = count > 1 ? std::atoi(arguments[1]) : 300;
  testing::Random random = testing::seeded_random();
  std::vector<double> times;
  double sum = 0.0;
  for (int i = 0; i < problems; ++i) {
    const Problem problem = testing_problems::random_limited(random);
    // Processor time: what else the machine does is no part of the answer.
    const std::clock_t begin = std::clock();
    const Optimum optimum = optimize(problem);
    times.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    sum += times.back();
    const bool is_fastest =
        problem.objective.kind == ObjectiveKind::travel_time && !problem.objective.worst_case;
    const double travel_time = optimum.centerline && is_fastest ? optimum.report.travel_time : 0.0;
    std::printf("%d,%.2f,%s,%.12g\n", i, times.back(), status_text(optimum), travel_time);
    std::fflush(stdout);
  }
  if (times.empty()) return 1;
  std::sort(times.begin(), times.end());
  std::printf(
      "median %.1f ms, nine of ten below %.0f ms, all of them %.1f s, slowest %.0f ms, above 500 ms %td, "
      "above 1 s %td\n",
      times[times.size() / 2], times[times.size() * 9 / 10], 1e-3 * sum, times.back(), above(times, 500.0),
      above(times, 1000.0));
  return 0;
}
