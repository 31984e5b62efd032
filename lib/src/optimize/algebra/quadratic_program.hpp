#pragma once

#include "optimize/algebra/dense.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace glissade::optimizer {

/// min g.d + 1/2 d^T H d over d, where E d + e = 0 and A d + a <= 0; H = L L^T is given by its factor.
struct QuadraticProgram {
  Vector gradient;           ///< g
  Matrix equality;           ///< E
  Vector equality_value;     ///< e
  Matrix inequality;         ///< A
  Vector inequality_value;   ///< a
  double tolerance = 1e-11;  ///< a row counts as kept up to this
};

struct QuadraticSolution {
  enum class Status {
    solved,
    contradictory,  ///< no d keeps all rows
    unfinished      ///< rounding kept the active set changing until its allowance was used up
  };
  Status status = Status::unfinished;
  Vector step;                      ///< d
  Vector equality;                  ///< multipliers of E; g + H d + E^T lambda + A^T nu = 0
  Vector inequality;                ///< multipliers of A, nu >= 0
  std::vector<std::size_t> active;  ///< inequality rows that hold with equality
  double length = 0.0;              ///< sqrt(d^T H d)
  int changes = 0;                  ///< of the active set
};

/// Dual active-set method: from the minimum without rows, rows that are broken enter one by one, the
/// multipliers staying >= 0, until none is broken. No feasible beginning is needed, and each change of the
/// active set takes O(n^2).
///
/// Source: D. Goldfarb and A. Idnani, "A numerically stable dual method for solving strictly convex quadratic
/// programs", Mathematical Programming 27 (1983) 1-33. Different from there, the orthonormal basis of the
/// active rows is kept by Gram-Schmidt steps taken twice, in the metric of H.
///
/// Accuracy: no inequality row is broken by more than the program's tolerance.
/// @param likely  inequality rows to begin with, as from a similar program; those whose multipliers would be
///                negative are left out again
[[nodiscard]] QuadraticSolution solve(const QuadraticProgram& program, const ShiftedCholesky& metric,
                                      const std::vector<std::size_t>& likely = {});

/// The same program with other values of its rows, again and again: what depends on the rows alone is done once.
class BegunProgram {
 public:
  /// As solve(). `program` and `metric` are to outlive it.
  BegunProgram(const QuadraticProgram& program, const ShiftedCholesky& metric,
               const std::vector<std::size_t>& likely);
  BegunProgram(BegunProgram&&) noexcept;
  BegunProgram& operator=(BegunProgram&&) noexcept;
  ~BegunProgram();

  /// @param equality_value,inequality_value  in place of those of the program
  /// @param gradient  the program's counts so many times
  [[nodiscard]] QuadraticSolution solve(const Vector& equality_value, const Vector& inequality_value,
                                        double gradient = 1.0) const;

 private:
  struct Method;
  std::unique_ptr<Method> method_;
};

}  // namespace glissade::optimizer
