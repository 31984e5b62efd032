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
    for (std::size_t column = 0; column < size_; ++column) {
      for (std::size_t row = column; row < size_; ++row) {
        double sum = at(row, column);
        for (std::size_t k = 0; k < column; ++k) sum -= at(row, k) * at(column, k);
        if (row > column) {
          at(row, column) = sum / at(column, column);
        } else if (sum > 0.0) {
          at(row, row) = std::sqrt(sum);
        } else {
          return false;
        }
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
