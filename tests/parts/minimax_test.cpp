// The linear programme against best approximations that are known.

#include "parts/curves/minimax.hpp"

#include "support/catch.hpp"

#include <cmath>

namespace {

using glissade::parts::minimax;
using glissade::parts::MinimaxRow;

std::vector<MinimaxRow> cubic_rows(double above, double below) {
  std::vector<MinimaxRow> rows;
  for (int i = 0; i <= 400; ++i) {
    const double v = i / 400.0;
    rows.push_back({0, {(1.0 - v) * (1.0 - v), 2.0 * v * (1.0 - v), v * v}, v * v * v, above, below, 0.0});
  }
  return rows;
}

}  // namespace

TEST_CASE("minimax: the best quadratic misses a cubic by a 32nd, Chebyshev's polynomial") {
  const auto found = minimax(cubic_rows(1.0, 1.0), {false, false, false});
  CHECK(std::fabs(found.t - 1.0 / 32.0) < 1e-6 / 32.0);
}

TEST_CASE("minimax: from one side it is twice that") {
  CHECK(std::fabs(minimax(cubic_rows(1.0, 0.0), {false, false, false}).t - 1.0 / 16.0) < 1e-6 / 16.0);
  CHECK(std::fabs(minimax(cubic_rows(0.0, 1.0), {false, false, false}).t - 1.0 / 16.0) < 1e-6 / 16.0);
}

TEST_CASE("minimax: a dropped column stays 0 and a row of constant room is kept") {
  // With both ends' values fixed the middle one alone is free: v^3 - 2 x v (1 - v) is least at a known place.
  auto rows = cubic_rows(1.0, 1.0);
  for (auto& row : rows) row.base -= row.value[2];
  const auto free = minimax(rows, {true, false, true});
  CHECK(free.x[0] == 0.0);
  CHECK(free.x[2] == 0.0);
  // v^3 - v^2 = -v^2 (1 - v); adding 2 x v (1 - v) gives v (1 - v)(2 x - v), with levelled extremes at x = 1/4.
  CHECK(std::fabs(free.x[1] - 0.25) < 1e-3);
  CHECK(std::fabs(free.t - std::sqrt(3.0) / 36.0) < 1e-4);
  rows.push_back({0, {0.0, 1.0, 0.0}, 0.0, 0.0, 0.0, 0.1});
  const auto held = minimax(rows, {true, false, true});
  CHECK(held.x[1] < 0.1 + 1e-6);
  CHECK(held.x[1] > 0.1 - 1e-6);
  CHECK(held.t > free.t);
}
