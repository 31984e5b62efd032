#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace glissade::centerline {

/// A dense symmetric positive definite matrix, lower triangle, row by row.
class SymmetricMatrix {
 public:
  explicit SymmetricMatrix(std::size_t size) : size_(size), values_(size * size, 0.0) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return values_[row * size_ + column]; }

  /// Adds to the element of this row and column, and so to that of this column and row.
  void add(std::size_t row, std::size_t column, double value) {
    at(std::max(row, column), std::min(row, column)) += value;
  }

  /// Replaces the matrix by its Cholesky factor.
  /// @return false if it is not positive definite
  [[nodiscard]] bool factorize() {
    constexpr std::size_t kRows = 4;  // budget: sums that do not wait for each other
    for (std::size_t column = 0; column < size_; ++column) {
      const double* const own = &values_[column * size_];
      double diagonal = own[column];
      for (std::size_t k = 0; k < column; ++k) diagonal -= own[k] * own[k];
      if (!(diagonal > 0.0)) return false;
      diagonal = at(column, column) = std::sqrt(diagonal);
      std::size_t row = column + 1;
      for (; row + kRows <= size_; row += kRows) {
        double* const first = &values_[row * size_];
        double* const second = first + size_;
        double* const third = second + size_;
        double* const fourth = third + size_;
        double sums[kRows] = {first[column], second[column], third[column], fourth[column]};
        for (std::size_t k = 0; k < column; ++k) {
          sums[0] -= first[k] * own[k];
          sums[1] -= second[k] * own[k];
          sums[2] -= third[k] * own[k];
          sums[3] -= fourth[k] * own[k];
        }
        for (std::size_t i = 0; i < kRows; ++i) at(row + i, column) = sums[i] / diagonal;
      }
      for (; row < size_; ++row) {
        double sum = at(row, column);
        for (std::size_t k = 0; k < column; ++k) sum -= at(row, k) * own[k];
        at(row, column) = sum / diagonal;
      }
    }
    return true;
  }

  /// Solves factor * x = b in place, for a factorized matrix.
  void solve_forward(std::vector<double>& b) const {
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t k = 0; k < row; ++k) b[row] -= at(row, k) * b[k];
      b[row] /= at(row, row);
    }
  }

  /// Solves transposed factor * x = b in place.
  void solve_backward(std::vector<double>& b) const {
    for (std::size_t row = size_; row-- > 0;) {
      for (std::size_t k = row + 1; k < size_; ++k) b[row] -= at(k, row) * b[k];
      b[row] /= at(row, row);
    }
  }

 private:
  std::size_t size_;
  std::vector<double> values_;
};

}  // namespace glissade::centerline
