#pragma once

#include <cstddef>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace glissade::optimizer {

using Vector = std::vector<double>;

/// Room for matrices. What one of them gives back the next one takes, as searches make thousands of a size: the system
/// would have to clear it each time. All of it is given back once a thread has no matrix left.
class MatrixRoom {
 public:
  [[nodiscard]] static void* take(std::size_t bytes);
  static void give_back(void* room, std::size_t bytes) noexcept;

  template <typename T>
  struct Allocator {
    using value_type = T;
    Allocator() = default;
    template <typename U>
    Allocator(const Allocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): as the standard has it
    [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(take(count * sizeof(T))); }
    void deallocate(T* room, std::size_t count) noexcept { give_back(room, count * sizeof(T)); }
    /// What has no value is left as it is.
    template <typename U, typename... Values>
    void construct(U* at, Values&&... values) {
      if constexpr (sizeof...(Values) == 0) {
        ::new (static_cast<void*>(at)) U;
      } else {
        ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
      }
    }
    friend bool operator==(const Allocator&, const Allocator&) { return true; }
  };
};

/// A dense matrix by rows.
class Matrix {
 public:
  Matrix() = default;
  Matrix(std::size_t rows, std::size_t columns) : columns_(columns), data_(rows * columns, 0.0) {}
  /// One whose entries are all written before they are read.
  [[nodiscard]] static Matrix unset(std::size_t rows, std::size_t columns) {
    Matrix matrix;
    matrix.columns_ = columns;
    matrix.data_.resize(rows * columns);
    return matrix;
  }

  [[nodiscard]] std::size_t rows() const { return columns_ == 0 ? 0 : data_.size() / columns_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] double* row(std::size_t i) { return data_.data() + i * columns_; }
  [[nodiscard]] const double* row(std::size_t i) const { return data_.data() + i * columns_; }
  [[nodiscard]] double& operator()(std::size_t i, std::size_t j) { return data_[i * columns_ + j]; }
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const { return data_[i * columns_ + j]; }

 private:
  std::size_t columns_ = 0;
  std::vector<double, MatrixRoom::Allocator<double>> data_;
};

[[nodiscard]] double dot(const double* a, const double* b, std::size_t n);
/// y += k a
void add_scaled(double* y, double k, const double* a, std::size_t n);
/// Several at once, which share what they load: out[i] = dot(rows[i], b), to the same bits.
void dots(std::span<const double* const> rows, const double* b, std::size_t n, double* out);
/// Where a row has entries other than 0: between two multiples of four, and from the last whole four on.
struct Extent {
  std::size_t from = 0;
  std::size_t to = 0;
};
[[nodiscard]] Extent extent_of(const double* row, std::size_t n);
/// dot() of b and some rows of a matrix whose extents are known, to the same bits: what is 0 is passed over.
/// @param extents  of all of its rows
void dots(const Matrix& matrix, std::span<const std::size_t> rows, std::span<const Extent> extents,
          const double* b, double* out);
/// y += sum of k[i] rows[i], in their order
void add_scaled_rows(double* y, std::span<const double> k, std::span<const double* const> rows,
                     std::size_t n);
/// (a, b) := (cosine a + sine b, cosine b - sine a)
void rotate_rows(double* a, double* b, double cosine, double sine, std::size_t n);
/// matrix += factor (a b^T + b a^T)
void add_symmetric(Matrix& matrix, double factor, const Vector& a, const Vector& b);
[[nodiscard]] double norm(const Vector& a);

/// Lower triangular L with L L^T = H + shift D, D the diagonal given, shift the least of a geometric sequence
/// from 0 that makes it positive definite.
class ShiftedCholesky {
 public:
  static constexpr double kLargestShift = 1e9;  // taste

  ShiftedCholesky() = default;
  /// @param largest  shifts beyond it are not tried: the factor is then of no use
  ShiftedCholesky(const Matrix& symmetric, const Vector& diagonal, double largest = kLargestShift);

  [[nodiscard]] double shift() const { return shift_; }
  /// The factor with one more unknown, which has this curvature and none in common with the others.
  [[nodiscard]] ShiftedCholesky with_one_more(double curvature) const;
  /// x := L^-T x: from scaled to original variables
  void backward(double* x) const;
  /// x := L^-1 x: a gradient from original to scaled variables
  void forward(double* x) const;
  /// The same of each row of a matrix, to the same bits.
  void forward(Matrix& rows) const;

 private:
  [[nodiscard]] bool factor(const Matrix& symmetric, const Vector& diagonal, Matrix& upper);
  Matrix lower_;
  Vector inverse_;  ///< of the diagonal
  double shift_ = 0.0;
};

}  // namespace glissade::optimizer
