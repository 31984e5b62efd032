#pragma once

#include "optimize/algebra/dense.hpp"
#include "optimize/problem/rows.hpp"

#include <vector>

namespace glissade::optimizer {

/// Multipliers with the rows that they belong to.
struct Multipliers {
  Vector equality;
  std::vector<Row> active;
  Vector inequality;
};

/// What quadratic programs over the rows of a problem are made of.
[[nodiscard]] Matrix jacobian_of(const Rows& rows, const State& state, const std::vector<Row>& set,
                                 std::size_t n);
[[nodiscard]] Vector values_of(const Rows& rows, const State& state, const std::vector<Row>& set);
/// @return 0 if none is greater
[[nodiscard]] double greatest_of(const Vector& values);
[[nodiscard]] double greatest_size(const Vector& values);

/// A metric in which the Lagrangian's Hessian is the identity; convex by adding squares, of the equality rows
/// and where that is not enough of the rows that carry multipliers too, which changes no step that keeps
/// them; and by a shift if that will not do either.
/// @param bends_much  a row that carries bends the Lagrangian by far more than its objective does: so much larger squares of
///                    it are tried before any shift
[[nodiscard]] ShiftedCholesky metric_of(const Matrix& hessian, const Matrix& equality, const Matrix& carrying,
                                        bool bends_much = false);

/// Distances in the slope angle itself, and in the length: how much a shape changes.
[[nodiscard]] Matrix shape_metric(const Transcription& track);

}  // namespace glissade::optimizer
