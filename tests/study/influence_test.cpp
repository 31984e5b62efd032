#include "study/influence.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <numbers>
#include <vector>

using namespace glissade::study;

namespace {

constexpr double kPi = std::numbers::pi;

/// Samples of Ishigami & Homma's function (1990), whose first-order indices are known by hand.
struct Ishigami {
  std::vector<std::vector<double>> inputs{3};
  std::vector<double> values;

  explicit Ishigami(std::uint64_t count, Sampling sampling) {
    const UnitCube cube{sampling, count, 3, 5};
    for (std::uint64_t sample = 0; sample < count; ++sample) {
      const std::vector<double> point = cube.at(sample);
      double x[3];
      for (std::size_t d = 0; d < 3; ++d) {
        x[d] = kPi * (2.0 * point[d] - 1.0);
        inputs[d].push_back(x[d]);
      }
      values.push_back(std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) +
                       0.1 * std::pow(x[2], 4) * std::sin(x[0]));
    }
  }
};

}  // namespace

TEST_CASE("first-order indices of Ishigami's function are those by hand, within their stated errors") {
  // a = 7, b = 0.1: V1 = (1 + b pi^4/5)^2/2, V2 = a^2/8, V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2.
  const double pi4 = std::pow(kPi, 4);
  const double variance = 49.0 / 8.0 + 0.1 * pi4 / 5.0 + 0.01 * pi4 * pi4 / 18.0 + 0.5;
  const double expected[3] = {0.5 * std::pow(1.0 + 0.1 * pi4 / 5.0, 2) / variance, 49.0 / 8.0 / variance,
                              0.0};
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    const Ishigami data(8192, sampling);
    for (std::size_t d = 0; d < 3; ++d) {
      const Influence influence = influence_of(data.inputs[d], data.values, true);
      REQUIRE(influence.first_order.has_value());
      INFO(word(sampling) << " " << d << ": " << *influence.first_order << " +- "
                          << influence.first_order_error);
      // What a class of finite width hides is of the order of its square: 2e-3 with 40 classes.
      CHECK(std::fabs(*influence.first_order - expected[d]) <= 4.0 * influence.first_order_error + 4e-3);
      CHECK(influence.first_order_error < 0.03);
    }
  }
}

TEST_CASE("an input of few values has them as its classes") {
  std::vector<double> input;
  std::vector<double> value;
  for (int i = 0; i < 300; ++i) {
    input.push_back(i % 3);
    value.push_back((i % 3) + ((i / 3) % 2 == 0 ? 0.5 : -0.5));
  }
  const Influence influence = influence_of(input, value, true);
  // Between: 2/3 of a unit squared; within: 1/4.
  CHECK(std::fabs(*influence.first_order - (2.0 / 3.0) / (2.0 / 3.0 + 0.25)) < 0.01);
}

TEST_CASE("rank correlation is 1 for whatever rises, -1 for whatever falls, and near 0 for neither") {
  std::vector<double> input;
  std::vector<double> rising;
  std::vector<double> falling;
  std::vector<double> symmetric;
  for (int i = 0; i < 201; ++i) {
    input.push_back(0.01 * i);
    rising.push_back(std::exp(0.03 * i));
    falling.push_back(-std::pow(i, 3));
    symmetric.push_back(std::fabs(i - 100.0));
  }
  CHECK(influence_of(input, rising, false).rank_correlation == Approx(1.0).margin(1e-12));
  CHECK(influence_of(input, falling, false).rank_correlation == Approx(-1.0).margin(1e-12));
  const Influence none = influence_of(input, symmetric, false);
  CHECK(std::fabs(none.rank_correlation) < 0.01);
  CHECK(none.rank_correlation_error == Approx(1.0 / std::sqrt(198.0)).epsilon(1e-3));
  CHECK_FALSE(none.first_order.has_value());
}

TEST_CASE("rows without a value are left out") {
  const double none = std::nan("");
  const Influence influence = influence_of({1, 2, 3, 4, 5}, {10, none, 30, none, 50}, true);
  CHECK(influence.rank_correlation == Approx(1.0));
  CHECK_FALSE(influence.first_order.has_value());  // too few
}

TEST_CASE("rows that are left out make inputs dependent where it takes several inputs to leave one out") {
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    CAPTURE(word(sampling));
    constexpr std::uint64_t kRows = 5000;
    const UnitCube cube{sampling, kRows, 3, 7};
    std::vector<std::vector<double>> inputs(3);
    for (std::uint64_t row = 0; row < kRows; ++row) {
      const std::vector<double> point = cube.at(row);
      for (std::size_t d = 0; d < 3; ++d) inputs[d].push_back(point[d]);
    }
    const auto used = [&](auto keeps) {
      std::vector<bool> rows;
      for (std::uint64_t row = 0; row < kRows; ++row) {
        rows.push_back(keeps(inputs[0][row], inputs[1][row], inputs[2][row]));
      }
      return rows;
    };
    using Verdicts = std::vector<bool>;
    CHECK(dependent_inputs(inputs, used([](double, double, double) { return true; })) ==
          Verdicts{false, false, false});
    // A bound of one input each, even of all three, leaves what is left independent.
    CHECK(dependent_inputs(inputs, used([](double a, double, double) { return a < 0.83; })) ==
          Verdicts{false, false, false});
    CHECK(dependent_inputs(inputs, used([](double a, double b, double c) {
                             return a < 0.83 && b > 0.1 && c < 0.57;
                           })) == Verdicts{false, false, false});
    // A corner is not, nor a hole that no correlation shows.
    CHECK(dependent_inputs(inputs, used([](double a, double b, double) { return a + b < 1.6; })) ==
          Verdicts{true, true, false});
    CHECK(dependent_inputs(inputs, used([](double, double b, double c) {
                             return std::hypot(b - 0.5, c - 0.5) > 0.2;
                           })) == Verdicts{false, true, true});
  }
}
