// Sums that are compiled anew for wider processors, against the same sums one number at a time: to the last bit. A variant
// that fused, reordered or widened anything would show.

#include "optimize/algebra/dense.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace glissade;
using optimizer::Vector;

namespace {

/// Numbers of many sizes, so that the order of additions shows in the last bits.
Vector drawn(testing::Random& random, std::size_t n) {
  Vector result;
  for (std::size_t i = 0; i < n; ++i) {
    result.push_back(random.between(-1.0, 1.0) * std::ldexp(1.0, random.integer(-20, 20)));
  }
  return result;
}

/// Four sums, of every fourth element each; what is left over goes to the first.
double one_by_one(const Vector& a, const Vector& b) {
  std::array<double, 4> sum{};
  const std::size_t whole = a.size() / 4 * 4;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const volatile double product = a[i] * b[i];
    sum[i < whole ? i % 4 : 0] += product;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace

TEST_CASE("sums of products have the same bits on whatever processor they are") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (std::size_t n = 0; n < 70; ++n) {
    CAPTURE(n);
    constexpr std::size_t kRows = 7;  // four at once, and the rest
    const Vector b = drawn(random, n);
    const Vector factors = drawn(random, kRows);
    std::vector<Vector> rows;
    std::vector<const double*> pointers;
    for (std::size_t k = 0; k < kRows; ++k) rows.push_back(drawn(random, n));
    for (const Vector& row : rows) pointers.push_back(row.data());
    Vector sums(kRows);
    optimizer::dots(pointers, b.data(), n, sums.data());
    for (std::size_t k = 0; k < kRows; ++k) {
      CHECK(optimizer::dot(rows[k].data(), b.data(), n) == one_by_one(rows[k], b));
      CHECK(sums[k] == one_by_one(rows[k], b));
    }
    Vector together = b;
    optimizer::add_scaled_rows(together.data(), factors, pointers, n);
    Vector single = b;
    Vector expected = b;
    for (std::size_t k = 0; k < kRows; ++k) {
      optimizer::add_scaled(single.data(), factors[k], rows[k].data(), n);
      for (std::size_t i = 0; i < n; ++i) {
        const volatile double product = factors[k] * rows[k][i];
        expected[i] += product;
      }
    }
    CHECK(together == expected);
    CHECK(single == expected);
  }
}

TEST_CASE("sums pass over what is nothing in a row, with the same bits") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr std::size_t kRows = 11;
  for (std::size_t n = 1; n < 70; ++n) {
    CAPTURE(n);
    const Vector b = drawn(random, n);
    optimizer::Matrix matrix(kRows, n);
    std::vector<optimizer::Extent> extents;
    std::vector<std::size_t> some;
    for (std::size_t k = 0; k < kRows; ++k) {
      // Between two places, and at the end: as the rows of a track have it. Nothing may be below nothing, too.
      const Vector entries = drawn(random, n);
      const auto last = static_cast<std::size_t>(random.integer(0, static_cast<int>(n) - 1));
      const auto first = static_cast<std::size_t>(random.integer(0, static_cast<int>(last)));
      for (std::size_t i = 0; i < n; ++i) {
        const bool is_something = (i >= first && i <= last) || (i + 2 >= n && k % 3 != 0);
        matrix(k, i) = is_something ? entries[i] : std::copysign(0.0, entries[i]);
      }
      extents.push_back(optimizer::extent_of(matrix.row(k), n));
      CHECK(extents.back().from % 4 == 0);
      CHECK(extents.back().to <= n);
      // No four more than needed.
      if (extents.back().from < extents.back().to) {
        CHECK(extents.back().from + 4 > first);
        CHECK(extents.back().to < last + 5);
      }
      if (k != 4) some.push_back(k);
    }
    Vector sums(some.size());
    optimizer::dots(matrix, some, extents, b.data(), sums.data());
    for (std::size_t at = 0; at < some.size(); ++at)
      CHECK(sums[at] == optimizer::dot(matrix.row(some[at]), b.data(), n));
  }
}

TEST_CASE("a matrix takes the room of one before it, and is clear") {
  constexpr std::size_t kRows = 200;
  const optimizer::Matrix stays(kRows, kRows);
  const double* room = nullptr;
  {
    optimizer::Matrix first(kRows, kRows);
    first(7, 9) = 1.0;
    room = first.row(0);
  }
  const optimizer::Matrix second(kRows, kRows);
  CHECK(second.row(0) == room);
  CHECK(second(7, 9) == 0.0);
  CHECK(stays.row(0) != room);
}

TEST_CASE("rows turn into each other with the same bits on whatever processor they are") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const double cosine = 0.8;
  const double sine = 0.6;
  for (std::size_t n = 0; n < 20; ++n) {
    CAPTURE(n);
    const Vector a = drawn(random, n);
    const Vector b = drawn(random, n);
    Vector first = a;
    Vector second = b;
    optimizer::rotate_rows(first.data(), second.data(), cosine, sine, n);
    for (std::size_t i = 0; i < n; ++i) {
      const volatile double products[] = {cosine * a[i], sine * b[i], cosine * b[i], sine * a[i]};
      CHECK(first[i] == products[0] + products[1]);
      CHECK(second[i] == products[2] - products[3]);
    }
  }
}
