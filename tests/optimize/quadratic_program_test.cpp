// The dual active-set method, held against the conditions that a minimum of a convex program is known by.

#include "optimize/algebra/quadratic_program.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>

using namespace glissade;
using namespace glissade::optimizer;

namespace {

Matrix random_matrix(testing::Random& random, std::size_t rows, std::size_t columns) {
  Matrix matrix(rows, columns);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) matrix(i, j) = random.between(-1.0, 1.0);
  }
  return matrix;
}

Vector random_vector(testing::Random& random, std::size_t size) {
  Vector vector(size);
  for (double& entry : vector) entry = random.between(-1.0, 1.0);
  return vector;
}

/// Positive definite, with eigenvalues over some four orders of magnitude.
Matrix random_hessian(testing::Random& random, std::size_t n) {
  const Matrix root = random_matrix(random, n, n);
  Matrix hessian(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) hessian(i, j) = dot(root.row(i), root.row(j), n);
    hessian(i, i) += 1e-3;
  }
  return hessian;
}

Vector diagonal_of(const Matrix& matrix) {
  Vector diagonal(matrix.columns());
  for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] = matrix(i, i);
  return diagonal;
}

double along(const Matrix& rows, std::size_t i, const Vector& d) {
  return dot(rows.row(i), d.data(), d.size());
}

/// How far a solution is from a minimum: rows broken, multipliers of the wrong sign, multipliers of rows that
/// are not tight, gradient of the Lagrangian.
double distance_from_minimum(const QuadraticProgram& program, const Matrix& hessian,
                             const QuadraticSolution& solution) {
  double worst = 0.0;
  Vector gradient = program.gradient;
  const std::size_t n = gradient.size();
  for (std::size_t i = 0; i < n; ++i) gradient[i] += along(hessian, i, solution.step);
  for (std::size_t i = 0; i < program.equality.rows(); ++i) {
    worst = std::max(worst, std::fabs(along(program.equality, i, solution.step) + program.equality_value[i]));
    add_scaled(gradient.data(), solution.equality[i], program.equality.row(i), n);
  }
  for (std::size_t i = 0; i < program.inequality.rows(); ++i) {
    const double value = along(program.inequality, i, solution.step) + program.inequality_value[i];
    worst = std::max({worst, value, -solution.inequality[i], solution.inequality[i] * std::fabs(value)});
    add_scaled(gradient.data(), solution.inequality[i], program.inequality.row(i), n);
  }
  for (const double entry : gradient) worst = std::max(worst, std::fabs(entry));
  return worst;
}

// Rounding of some hundred rows in a metric of condition 1e4.
constexpr double kAccuracy = 1e-8;

/// Has a solution: the point `inside` keeps every row.
QuadraticProgram random_program(testing::Random& random, std::size_t n, std::size_t equalities,
                                std::size_t inequalities) {
  QuadraticProgram program;
  program.gradient = random_vector(random, n);
  program.equality = random_matrix(random, equalities, n);
  program.inequality = random_matrix(random, inequalities, n);
  const Vector inside = random_vector(random, n);
  for (std::size_t i = 0; i < equalities; ++i) {
    program.equality_value.push_back(-along(program.equality, i, inside));
  }
  for (std::size_t i = 0; i < inequalities; ++i) {
    program.inequality_value.push_back(-along(program.inequality, i, inside) - random.between(0.0, 0.2));
  }
  return program;
}

}  // namespace

TEST_CASE("quadratic program: solutions of random programs are minima, whatever rows they begin with") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 200; ++i) {
    const auto n = static_cast<std::size_t>(random.between(2.0, 30.0));
    const auto equalities = static_cast<std::size_t>(random.between(0.0, 0.5 * static_cast<double>(n)));
    const auto inequalities = static_cast<std::size_t>(random.between(0.0, 200.0));
    const QuadraticProgram program = random_program(random, n, equalities, inequalities);
    const Matrix hessian = random_hessian(random, n);
    const ShiftedCholesky metric(hessian, diagonal_of(hessian));
    const QuadraticSolution cold = solve(program, metric);
    CAPTURE(i, n, equalities, inequalities, cold.changes);
    REQUIRE(cold.status == QuadraticSolution::Status::solved);
    CHECK(distance_from_minimum(program, hessian, cold) < kAccuracy);

    const QuadraticSolution again = solve(program, metric, cold.active);
    CHECK(again.changes <= static_cast<int>(cold.active.size()));
    CHECK(distance_from_minimum(program, hessian, again) < kAccuracy);

    std::vector<std::size_t> any;
    for (std::size_t row = 0; row < inequalities; row += 3) any.push_back(row);
    const QuadraticSolution misled = solve(program, metric, any);
    REQUIRE(misled.status == QuadraticSolution::Status::solved);
    CHECK(distance_from_minimum(program, hessian, misled) < kAccuracy);
    for (std::size_t j = 0; j < n; ++j) CHECK(misled.step[j] == Approx(cold.step[j]).margin(1e-6));
  }
}

TEST_CASE("quadratic program: rows given twice, and rows that others imply, change nothing") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 50; ++i) {
    constexpr std::size_t kUnknowns = 8;
    const QuadraticProgram program = random_program(random, kUnknowns, 2, 30);
    QuadraticProgram repeated = program;
    repeated.equality = Matrix(4, kUnknowns);
    repeated.equality_value.clear();
    for (std::size_t row = 0; row < 4; ++row) {
      add_scaled(repeated.equality.row(row), 1.0 + static_cast<double>(row), program.equality.row(row % 2),
                 kUnknowns);
      repeated.equality_value.push_back((1.0 + static_cast<double>(row)) * program.equality_value[row % 2]);
    }
    repeated.inequality = Matrix(90, kUnknowns);
    repeated.inequality_value.clear();
    for (std::size_t row = 0; row < 90; ++row) {
      // Once as it is, once as the sum with its successor, once doubled.
      const std::size_t first = row % 30;
      const std::size_t second = row < 30 ? first : (row < 60 ? (first + 1) % 30 : first);
      add_scaled(repeated.inequality.row(row), 1.0, program.inequality.row(first), kUnknowns);
      add_scaled(repeated.inequality.row(row), row < 30 ? 0.0 : 1.0, program.inequality.row(second),
                 kUnknowns);
      repeated.inequality_value.push_back(program.inequality_value[first] +
                                          (row < 30 ? 0.0 : program.inequality_value[second]));
    }
    const Matrix hessian = random_hessian(random, kUnknowns);
    const ShiftedCholesky metric(hessian, diagonal_of(hessian));
    const QuadraticSolution once = solve(program, metric);
    const QuadraticSolution twice = solve(repeated, metric);
    CAPTURE(i);
    REQUIRE(once.status == QuadraticSolution::Status::solved);
    REQUIRE(twice.status == QuadraticSolution::Status::solved);
    CHECK(distance_from_minimum(repeated, hessian, twice) < kAccuracy);
    for (std::size_t j = 0; j < kUnknowns; ++j) CHECK(twice.step[j] == Approx(once.step[j]).margin(1e-7));
  }
}

TEST_CASE(
    "quadratic program: with other values of its rows, one begun once has the solution of one begun anew") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 50; ++i) {
    const auto n = static_cast<std::size_t>(random.between(4.0, 20.0));
    QuadraticProgram program = random_program(random, n, 2, 60);
    // An equality row that the first implies: other values may contradict it.
    Matrix equality(3, n);
    for (std::size_t row = 0; row < 3; ++row)
      add_scaled(equality.row(row), row == 2 ? 2.0 : 1.0, program.equality.row(row % 2), n);
    program.equality = equality;
    program.equality_value.push_back(2.0 * program.equality_value[0]);
    const Matrix hessian = random_hessian(random, n);
    const ShiftedCholesky metric(hessian, diagonal_of(hessian));
    const QuadraticSolution first = solve(program, metric);
    REQUIRE(first.status == QuadraticSolution::Status::solved);
    const BegunProgram begun(program, metric, first.active);
    for (int move = 0; move < 3; ++move) {
      for (double& value : program.inequality_value) value += random.between(-1e-3, 1e-4);
      program.equality_value[1] += random.between(-1e-3, 1e-3);
      if (move == 2) program.equality_value[2] += 1.0;
      const QuadraticSolution anew = solve(program, metric, first.active);
      const QuadraticSolution again = begun.solve(program.equality_value, program.inequality_value);
      CAPTURE(i, move, n);
      CHECK(again.status == anew.status);
      CHECK((again.status == QuadraticSolution::Status::contradictory) == (move == 2));
      CHECK(again.step == anew.step);
      CHECK(again.inequality == anew.inequality);
      CHECK(again.equality == anew.equality);
    }
  }
}

TEST_CASE(
    "quadratic program: begun once, a gradient that counts more is that of a program with such a gradient") {
  testing::Random random = testing::seeded_random(20261125);
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 50; ++i) {
    const auto n = static_cast<std::size_t>(random.between(4.0, 20.0));
    QuadraticProgram program = random_program(random, n, 2, 60);
    const Matrix hessian = random_hessian(random, n);
    const ShiftedCholesky metric(hessian, diagonal_of(hessian));
    const BegunProgram begun(program, metric, {});
    const double factor = random.between(1.0, 50.0);
    const QuadraticSolution again = begun.solve(program.equality_value, program.inequality_value, factor);
    for (double& entry : program.gradient) entry *= factor;
    CAPTURE(i, n, factor);
    REQUIRE(again.status == QuadraticSolution::Status::solved);
    CHECK(distance_from_minimum(program, hessian, again) < factor * kAccuracy);
  }
}

TEST_CASE("quadratic program: more tight rows than unknowns at one corner") {
  // All edges of a pyramid with 40 sides meet at its top, the minimum of -z + (x^2 + y^2 + z^2)/2 within it.
  constexpr std::size_t kSides = 40;
  QuadraticProgram program;
  program.gradient = {0.0, 0.0, -1.0};
  program.inequality = Matrix(kSides, 3);
  for (std::size_t i = 0; i < kSides; ++i) {
    const double angle = 2.0 * 3.14159265358979 * static_cast<double>(i) / kSides;
    program.inequality(i, 0) = std::cos(angle);
    program.inequality(i, 1) = std::sin(angle);
    program.inequality(i, 2) = 1.0;
    program.inequality_value.push_back(-0.5);
  }
  Matrix identity(3, 3);
  for (std::size_t i = 0; i < 3; ++i) identity(i, i) = 1.0;
  const QuadraticSolution solution = solve(program, ShiftedCholesky(identity, diagonal_of(identity)));
  REQUIRE(solution.status == QuadraticSolution::Status::solved);
  CHECK(distance_from_minimum(program, identity, solution) < kAccuracy);
  CHECK(solution.step[2] == Approx(0.5));
}

TEST_CASE("quadratic program: rows that contradict each other are called so") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 50; ++i) {
    constexpr std::size_t kUnknowns = 6;
    QuadraticProgram program = random_program(random, kUnknowns, 2, 20);
    const Matrix hessian = random_hessian(random, kUnknowns);
    const ShiftedCholesky metric(hessian, diagonal_of(hessian));
    // The last two rows say that a + b is at most -1 and at least 1.
    for (std::size_t j = 0; j < kUnknowns; ++j) {
      const double sum = program.inequality(0, j) + program.inequality(1, j);
      program.inequality(18, j) = sum;
      program.inequality(19, j) = -sum;
    }
    program.inequality_value[18] = 1.0;
    program.inequality_value[19] = 1.0;
    CAPTURE(i);
    CHECK(solve(program, metric).status == QuadraticSolution::Status::contradictory);

    QuadraticProgram equalities = random_program(random, kUnknowns, 3, 0);
    std::copy_n(equalities.equality.row(0), kUnknowns, equalities.equality.row(2));
    equalities.equality_value[2] = equalities.equality_value[0] + 0.1;
    CHECK(solve(equalities, metric).status == QuadraticSolution::Status::contradictory);
  }
}

TEST_CASE("dense sums of several rows at once have the bits of one after the other") {
  testing::Random random = testing::seeded_random();
  for (std::size_t n = 0; n <= 13; ++n) {
    for (std::size_t count = 0; count <= 9; ++count) {
      std::vector<Vector> rows(count, Vector(n));
      Vector factors(count);
      Vector other(n);
      for (Vector& row : rows) {
        for (double& entry : row) entry = random.between(-1.0, 1.0);
      }
      for (double& factor : factors) factor = random.between(-1.0, 1.0);
      for (double& entry : other) entry = random.between(-1.0, 1.0);
      std::vector<const double*> places;
      for (const Vector& row : rows) places.push_back(row.data());
      Vector together(count);
      dots(places, other.data(), n, together.data());
      Vector alone(count);
      for (std::size_t i = 0; i < count; ++i) alone[i] = dot(rows[i].data(), other.data(), n);
      CHECK(together == alone);
      Vector one_by_one = other;
      for (std::size_t i = 0; i < count; ++i) add_scaled(one_by_one.data(), factors[i], rows[i].data(), n);
      add_scaled_rows(other.data(), factors, places, n);
      CHECK(other == one_by_one);
    }
  }
}
