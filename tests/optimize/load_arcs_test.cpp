// Where a load limit binds over a stretch the curvature is that of constant load, which no clothoid follows: excess
// over exact optima with an entry speed (free flight, then the extremal), and over the same search on a mesh three
// times as fine where no exact optimum is known.

#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

namespace load_arcs_test {

using namespace glissade;

namespace {

// Of the objective, relative.
constexpr double kExcess = 1e-6;

double objective_of(const Problem& problem, const OptimizeReport& report) {
  return problem.objective.kind == ObjectiveKind::exit_speed ? -report.exit_speed : report.travel_time;
}

}  // namespace

TEST_CASE(
    "with an entry speed the search flies where that is fastest: at most 1e-6 above the exact optimum") {
  std::ifstream file(test_data_path("reference/entry_speed.json"));
  const nlohmann::json cases = nlohmann::json::parse(file);
  REQUIRE(cases.size() == 20);
  for (const auto& entry : cases) {
    const auto number = [&](const char* key) { return std::stod(entry.at(key).get<std::string>()); };
    Problem problem;
    problem.endpoints = {number("run"), number("drop")};
    problem.body.friction = Friction::from_coefficient(number("friction_coefficient"));
    problem.body.entry_speed = number("entry_speed");
    problem.gravity = number("gravity");
    const Optimum optimum = optimize(problem);
    const double exact = number("travel_time");
    CAPTURE(problem.endpoints.run, problem.endpoints.drop, problem.body.entry_speed, optimum.report.brief());
    CHECK(optimum.report.status == OptimizeStatus::optimal);
    CHECK(optimum.report.travel_time <= exact * (1.0 + kExcess));
    CHECK(optimum.report.travel_time >= exact * (1.0 - kOptimizeUndershoot));
  }
}

TEST_CASE("where a load is held a mesh three times as fine wins at most 1e-6") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr int kOfEach = 2;
  for (int i = 0; i < 3 * kOfEach; ++i) {
    Problem problem;
    const double mu = random.between(0.0, 0.5);
    const double ratio = std::max(1.3 * mu, random.between(0.2, 1.5));
    problem.endpoints = {10.0, 10.0 * ratio};
    problem.body.friction = Friction::from_coefficient(mu);
    problem.body.entry_speed = random.between(0.5, 6.0);
    if (i % 3 == 0) problem.limits.lowest_normal_load = 0.3 * problem.gravity;
    if (i % 3 == 1) problem.limits.highest_normal_load = random.between(1.2, 2.0) * problem.gravity;
    if (i % 3 == 2) problem.objective.kind = ObjectiveKind::exit_speed;
    const Optimum optimum = optimize(problem);
    OptimizeOptions finer;
    finer.pieces = 96;
    const double least = objective_of(problem, optimize(problem, finer).report);
    CAPTURE(i, mu, ratio, problem.body.entry_speed, optimum.report.brief());
    CHECK(optimum.report.status == OptimizeStatus::optimal);
    CHECK(objective_of(problem, optimum.report) - least <= kExcess * std::fabs(least));
  }
}

}  // namespace load_arcs_test
