// Random problems, each solved and solved again with one thing changed: a limit that gives way or is left out, a
// narrower range of friction, a mirror, another place, another size, a bound that the report says would do. What that may
// do to the answer is known; this counts where it does more.
//
//   order_bench SEED PROBLEMS        a table, and a line for each answer out of order
//   order_bench SEED INDEX CHANGE    one change of one problem, as such a line names it, told in full

#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/variations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <map>
#include <optional>
#include <string>

namespace {

using namespace glissade;
using testing_problems::Order;
using testing_problems::Variation;

constexpr double kSame = 1e-5;  // relative, of the objective

struct Count {
  int changes = 0;
  int out_of_order = 0;
  double worst = 0.0;  ///< of those that were solved
};

/// A clock that never ends a search: answers do not depend on the machine. What is refused has no answer, and that is told.
Optimum solved(const Problem& problem) {
  OptimizeOptions options;
  options.time_budget = 1e6;
  try {
    return optimize(problem, options);
  } catch (const InputError& error) {
    std::printf("refused: %s\n", error.what());
    return {};
  }
}

bool is_solved(const Optimum& optimum) {
  return optimum.report.status == OptimizeStatus::optimal;
}

/// By how much a changed problem's answer is out of order; none where it is not solved.
std::optional<double> excess(const Variation& variation, const Optimum& before, const Optimum& after) {
  if (!is_solved(after)) return std::nullopt;
  if (variation.order == Order::solves) return 0.0;
  const double slower = testing_problems::slower_by(variation, before.report, after.report);
  return variation.order == Order::same ? std::fabs(slower) : std::max(slower, 0.0);
}

std::vector<Variation> variations_of(const Problem& problem, const Optimum& optimum) {
  if (!is_solved(optimum)) return testing_problems::as_advised(problem, optimum.report);
  std::vector<Variation> all = testing_problems::relaxations_of(problem);
  for (Variation& variation : testing_problems::same_again(problem)) all.push_back(std::move(variation));
  return all;
}

int run(std::uint64_t seed, int problems, int first) {
  std::map<std::string, Count> counts;
  std::array<std::array<int, 2>, testing_problems::kDraws.size()> drawn{};
  Count sum;
  const std::clock_t begin = std::clock();
  for (int i = first; i < first + problems; ++i) {
    std::size_t draw = 0;
    const Problem problem = testing_problems::problem_to_vary(seed, i, draw);
    const Optimum optimum = solved(problem);
    ++drawn[draw][is_solved(optimum) ? 1 : 0];
    for (const Variation& variation : variations_of(problem, optimum)) {
      const Optimum changed = solved(variation.problem);
      const std::optional<double> by = excess(variation, optimum, changed);
      for (Count* count : {&counts[variation.kind], &sum}) {
        ++count->changes;
        if (by) count->worst = std::max(count->worst, *by);
        if (!by || *by > kSame) ++count->out_of_order;
      }
      if (by && *by <= kSame) continue;
      std::printf("seed %llu, problem %d (%s), %s: ", static_cast<unsigned long long>(seed), i,
                  testing_problems::kDraws[draw].data(), variation.name().c_str());
      if (by) {
        std::printf("%.2e\n", *by);
      } else {
        std::printf("%s\n", std::string(to_text(changed.report.status)).c_str());
      }
      std::fflush(stdout);
    }
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    std::printf("%-20s %4d problems, %4d of them solved\n", testing_problems::kDraws[i].data(),
                drawn[i][0] + drawn[i][1], drawn[i][1]);
  }
  std::printf("%-20s %8s %14s %10s\n", "change", "solves", "out of order", "worst");
  counts["in all"] = sum;
  for (const auto& [kind, count] : counts) {
    std::printf("%-20s %8d %14d %10.1e\n", kind.c_str(), count.changes, count.out_of_order, count.worst);
  }
  std::printf("%.0f s of processor time\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return sum.out_of_order > 0 ? 1 : 0;
}

int tell(std::uint64_t seed, int index, const std::string& change) {
  std::size_t draw = 0;
  const Problem problem = testing_problems::problem_to_vary(seed, index, draw);
  const Optimum optimum = solved(problem);
  std::printf("%s\n", optimum.report.brief().c_str());
  for (const Variation& variation : variations_of(problem, optimum)) {
    if (variation.name() != change) continue;
    const Optimum changed = solved(variation.problem);
    std::printf("\n%s:\n%s\n", change.c_str(), changed.report.brief().c_str());
    if (const auto by = excess(variation, optimum, changed)) std::printf("out of order by %.3e\n", *by);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "order_bench SEED PROBLEMS [first N] | order_bench SEED INDEX CHANGE\n");
    return 2;
  }
  const std::uint64_t seed = std::stoull(arguments[1]);
  if (count == 4) return tell(seed, std::stoi(arguments[2]), arguments[3]);
  return run(seed, std::stoi(arguments[2]), count > 4 ? std::stoi(arguments[4]) : 0);
}
