// Prices of random problems beside what re-solves win: of each limit that holds a track back its price, the slope of six
// re-solves around its bound, and what they win on either side; of each that is told to cost nothing, but lies at its
// bound, the same.
//
//   price_bench SEED FIRST COUNT [drawn|limited] [KEY]
//
// Draws of test_optimize_prices (drawn) or of optimize_bench (limited); KEY: of this limit alone, with all of its steps.

#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/drawn_problems.hpp"
#include "optimize/price_differences.hpp"
#include "optimize/random_limits.hpp"
#include "optimize/variations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace glissade;
using testing_problems::Differences;

// Problems that take longer are left out: six re-solves of each limit would be minutes [s].
constexpr double kLongest = 0.25;

/// A limit at its bound, whatever it costs.
struct Bound {
  LimitName limit;
  double value = 0.0;
  double price = 0.0;
  double tightening = 0.0;
  double size = 0.0;   ///< of the bound
  double error = 0.0;  ///< as told: ActiveLimit::price_error
};

std::vector<Bound> bounds_of(const Problem& problem, const OptimizeReport& report) {
  constexpr double kAt = 1e-5;  // of a scale
  std::vector<Bound> bounds;
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  const auto size_of = [&](const LimitName& limit, double value) {
    const LimitCheck* known = nullptr;
    for (const LimitCheck& check : report.checks) {
      if (check.limit == limit) known = &check;
    }
    if (limit.id == LimitId::concave) return 1.0 / chord;
    return std::max(std::fabs(value), known != nullptr && value == 0.0 ? known->scale : 0.0);
  };
  for (const ActiveLimit& active : report.active)
    bounds.push_back({active.limit, active.value, active.price, active.tightening(),
                      size_of(active.limit, active.value), active.price_error});
  for (const LimitName& limit : testing_problems::limits_of(problem)) {
    const bool told =
        std::any_of(bounds.begin(), bounds.end(), [&](const Bound& bound) { return bound.limit == limit; });
    if (told) continue;
    for (const LimitCheck& check : report.checks) {
      if (check.limit != limit || std::fabs(check.reached - check.value) > kAt * check.scale) continue;
      bounds.push_back({limit, check.value, 0.0, 0.0, size_of(limit, check.value), 0.0});
    }
  }
  return bounds;
}

class Comparison {
 public:
  Comparison(std::string key, unsigned long long seed) : key_(std::move(key)), seed_(seed) {}

  void compare(int index, const Problem& problem) {
    OptimizeOptions options;
    options.time_budget = 1e6;
    const std::clock_t begin = std::clock();
    const Optimum optimum = optimize(problem, options);
    if (optimum.report.status != OptimizeStatus::optimal) return;
    if (static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC > kLongest && key_.empty()) {
      std::printf("%llu#%d slow\n", seed_, index);
      return;
    }
    for (const Bound& bound : bounds_of(problem, optimum.report)) {
      if (!key_.empty() && bound.limit.key() != key_) continue;
      try {
        compare(index, problem, optimum, bound);
      } catch (const InputError&) {
        ++counts_["refused"];  // a bound that no key takes
      }
    }
  }

  void tell() const {
    for (const auto& [verdict, count] : counts_) std::printf("%-8s %d\n", verdict.c_str(), count);
  }

 private:
  void compare(int index, const Problem& problem, const Optimum& optimum, const Bound& bound) {
    const double objective = std::fabs(testing_problems::objective_of(problem, optimum));
    // What is told to cost nothing is looked at as far as steps go.
    const double least = 0.01 * objective / bound.size;
    const double price = bound.price > 0.0              ? bound.price
                         : std::isinf(bound.tightening) ? least
                                                        : std::max(bound.tightening, least);
    const auto differences =
        testing_problems::differences_of(problem, optimum, bound.limit, bound.value, price, bound.size);
    std::string verdict = "untold";
    if (differences) verdict = verdict_of(bound, *differences);
    ++counts_[verdict];
    std::printf("%llu#%d %-8s %-26s %.6g", seed_, index, verdict.c_str(), bound.limit.key().c_str(),
                bound.price);
    if (bound.tightening > bound.price) std::printf("|%.6g", bound.tightening);
    if (differences) {
      std::printf("  central %.6g  tighter %.6g  looser %.6g  scatter %.2g", differences->central(),
                  differences->just_tighter(), differences->just_looser(), differences->scatter());
      if (verdict != "ok" || !key_.empty()) {
        std::printf("  noise %.2g steps", differences->noise);
        for (const double step : differences->steps) std::printf(" %.5g", step);
      }
    }
    std::printf("\n");
    std::fflush(stdout);
  }

  static std::string verdict_of(const Bound& bound, const Differences& differences) {
    using testing_problems::kPriceAccuracy;
    const auto close = [&](double price, double won) {
      return std::fabs(price - won) <= kPriceAccuracy * std::fabs(won) + 2.0 * differences.noise;
    };
    if (bound.limit.id == LimitId::concave)
      return close(bound.price, differences.just_looser()) ? "ok" : "OFF";
    if (bound.tightening > bound.price) {
      const bool both = close(bound.price, differences.just_looser()) &&
                        close(bound.tightening, differences.just_tighter());
      return both ? "kink" : "OFF-KINK";
    }
    if (close(bound.price, differences.central())) return "ok";
    const double missed = std::fabs(bound.price - differences.central());
    if (missed <= bound.error * std::fabs(differences.central())) return "loose";
    if (differences.scatter() > 0.1 * bound.price + 2.0 * differences.noise) return "unclear";
    return bound.price == 0.0 ? "MISSED" : differences.has_kink_at(bound.price) ? "untoldkink" : "OFF";
  }

  std::string key_;
  unsigned long long seed_;
  std::map<std::string, int> counts_;
};

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) {
    std::fprintf(stderr, "price_bench SEED FIRST COUNT [drawn|limited] [KEY]\n");
    return 2;
  }
  const unsigned long long seed = std::stoull(arguments[1]);
  const int first = std::stoi(arguments[2]);
  const int end = first + std::stoi(arguments[3]);
  const bool drawn = count > 4 && std::string(arguments[4]) == "drawn";
  Comparison comparison(count > 5 ? arguments[5] : "", seed);
  testing::Random random(seed);
  for (int i = 0; i < end; ++i) {
    const Problem problem =
        drawn ? testing_problems::drawn(random) : testing_problems::random_limited(random);
    if (i < first) continue;
    comparison.compare(i, testing_problems::with_room_to_give_way(problem));
  }
  comparison.tell();
  return 0;
}
