#include "optimize/algebra/dense.hpp"

#include "optimize/algebra/four.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace glissade::optimizer {
namespace {

/// Room that a thread's matrices gave back, the latest last.
class Spare {
 public:
  ~Spare() { clear(); }

  [[nodiscard]] void* take(std::size_t bytes) {
    ++lent_;
    for (std::size_t i = rooms_.size(); i-- > 0;) {
      if (rooms_[i].bytes != bytes) continue;
      void* const at = rooms_[i].at;
      rooms_.erase(rooms_.begin() + static_cast<std::ptrdiff_t>(i));
      return at;
    }
    return ::operator new(bytes);
  }
  void put(void* at, std::size_t bytes) noexcept {
    // Its own list has room for so many: nothing is allocated while a matrix ends.
    if (rooms_.size() == kMost) {
      ::operator delete(rooms_.front().at);
      rooms_.erase(rooms_.begin());
    }
    rooms_.push_back({at, bytes});
    if (--lent_ <= 0) clear();
  }
  Spare() { rooms_.reserve(kMost); }
  Spare(const Spare&) = delete;
  Spare& operator=(const Spare&) = delete;

 private:
  static constexpr std::size_t kMost = 24;  // budget: as many matrices as a point of the search has, twice
  struct Room {
    void* at;
    std::size_t bytes;
  };
  void clear() noexcept {
    for (const Room& room : rooms_) ::operator delete(room.at);
    rooms_.clear();
    lent_ = 0;
  }
  std::vector<Room> rooms_;
  std::ptrdiff_t lent_ = 0;
};

Spare& spare() {
  thread_local Spare spare;
  return spare;
}

// What is smaller the system has at hand itself.
constexpr std::size_t kLargeRoom = 32768;  // measured
// Sizes are rounded up to this, so that one fits the next.
constexpr std::size_t kRoomStep = 65536;  // taste

std::size_t rounded_up(std::size_t bytes) {
  return (bytes + kRoomStep - 1) / kRoomStep * kRoomStep;
}

}  // namespace

void* MatrixRoom::take(std::size_t bytes) {
  return bytes < kLargeRoom ? ::operator new(bytes) : spare().take(rounded_up(bytes));
}

void MatrixRoom::give_back(void* room, std::size_t bytes) noexcept {
  if (bytes < kLargeRoom) return ::operator delete(room);
  spare().put(room, rounded_up(bytes));
}

GLISSADE_WIDE_VARIANT double dot(const double* a, const double* b, std::size_t n) {
  // Four sums side by side: the order is fixed, and the processor need not wait for each addition.
  Four sum = {};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Four left, right;
    load(left, a + i);
    load(right, b + i);
    sum += left * right;
  }
  double first = sum[0];
  for (int left = 0; left < 3 && i < n; ++left, ++i) first += a[i] * b[i];
  return (first + sum[1]) + (sum[2] + sum[3]);
}

GLISSADE_WIDE_VARIANT void add_scaled(double* y, double k, const double* a, std::size_t n) {
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Four sum, right;
    load(sum, y + i);
    load(right, a + i);
    sum += k * right;
    store(sum, y + i);
  }
  for (int left = 0; left < 3 && i < n; ++left, ++i) y[i] += k * a[i];
}

namespace {

constexpr std::size_t kAtOnce = 4;  // budget: of the sixteen wide registers

/// As many rows as are worked on at once.
struct FourRows {
  explicit FourRows(const double* const* rows) : r0(rows[0]), r1(rows[1]), r2(rows[2]), r3(rows[3]) {}
  const double* r0;
  const double* r1;
  const double* r2;
  const double* r3;
};

/// Four numbers of each of them.
struct Tile {
  Tile(const FourRows& rows, std::size_t i) {
    load(a0, rows.r0 + i);
    load(a1, rows.r1 + i);
    load(a2, rows.r2 + i);
    load(a3, rows.r3 + i);
  }
  Four a0, a1, a2, a3;
};

GLISSADE_WIDE_VARIANT void four_dots(const double* const* given, const double* b, std::size_t n,
                                     double* out) {
  const FourRows rows(given);
  Four s0 = {}, s1 = {}, s2 = {}, s3 = {};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    const Tile tile(rows, i);
    Four right;
    load(right, b + i);
    s0 += tile.a0 * right;
    s1 += tile.a1 * right;
    s2 += tile.a2 * right;
    s3 += tile.a3 * right;
  }
  double f0 = s0[0], f1 = s1[0], f2 = s2[0], f3 = s3[0];
  for (int left = 0; left < 3 && i < n; ++left, ++i) {
    f0 += rows.r0[i] * b[i];
    f1 += rows.r1[i] * b[i];
    f2 += rows.r2[i] * b[i];
    f3 += rows.r3[i] * b[i];
  }
  out[0] = (f0 + s0[1]) + (s0[2] + s0[3]);
  out[1] = (f1 + s1[1]) + (s1[2] + s1[3]);
  out[2] = (f2 + s2[1]) + (s2[2] + s2[3]);
  out[3] = (f3 + s3[1]) + (s3[2] + s3[3]);
}

/// All that a row may have but for its last whole four, and what is left behind that.
std::size_t last_four(std::size_t n) {
  return n < 4 ? 0 : n / 4 * 4 - 4;
}

/// four_dots() of rows that have nothing before `from`, nor from `to` up to their last whole four.
GLISSADE_WIDE_VARIANT void four_dots_within(const double* const* given, Extent extent, const double* b,
                                            std::size_t n, double* out) {
  const FourRows rows(given);
  Four s0 = {}, s1 = {}, s2 = {}, s3 = {};
  const auto add = [&](std::size_t i) __attribute__((always_inline)) {
    const Tile tile(rows, i);
    Four right;
    load(right, b + i);
    s0 += tile.a0 * right;
    s1 += tile.a1 * right;
    s2 += tile.a2 * right;
    s3 += tile.a3 * right;
  };
  for (std::size_t i = extent.from; i < extent.to; i += 4) add(i);
  std::size_t i = last_four(n);
  for (; i + 4 <= n; i += 4) add(i);
  double f0 = s0[0], f1 = s1[0], f2 = s2[0], f3 = s3[0];
  for (int left = 0; left < 3 && i < n; ++left, ++i) {
    f0 += rows.r0[i] * b[i];
    f1 += rows.r1[i] * b[i];
    f2 += rows.r2[i] * b[i];
    f3 += rows.r3[i] * b[i];
  }
  out[0] = (f0 + s0[1]) + (s0[2] + s0[3]);
  out[1] = (f1 + s1[1]) + (s1[2] + s1[3]);
  out[2] = (f2 + s2[1]) + (s2[2] + s2[3]);
  out[3] = (f3 + s3[1]) + (s3[2] + s3[3]);
}

/// The bits of four numbers, but for their signs.
using FourBits [[gnu::vector_size(4 * sizeof(std::uint64_t))]] = std::uint64_t;

/// @param count  of numbers, four or a multiple of it
inline bool are_nothing(const double* from, std::size_t count) {
  FourBits any = {};
  for (std::size_t i = 0; i < count; i += 4) {
    FourBits bits;
    std::memcpy(&bits, from + i, sizeof bits);
    any |= bits;
  }
  any <<= 1;
  return (any[0] | any[1] | any[2] | any[3]) == 0;
}

GLISSADE_WIDE_VARIANT void add_four_scaled(double* y, const double* k, const double* const* given,
                                           std::size_t n) {
  const FourRows rows(given);
  const double k0 = k[0], k1 = k[1], k2 = k[2], k3 = k[3];
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    const Tile tile(rows, i);
    Four sum;
    load(sum, y + i);
    sum += k0 * tile.a0;
    sum += k1 * tile.a1;
    sum += k2 * tile.a2;
    sum += k3 * tile.a3;
    store(sum, y + i);
  }
  for (int left = 0; left < 3 && i < n; ++left, ++i)
    y[i] = (((y[i] + k0 * rows.r0[i]) + k1 * rows.r1[i]) + k2 * rows.r2[i]) + k3 * rows.r3[i];
}

}  // namespace

void dots(std::span<const double* const> rows, const double* b, std::size_t n, double* out) {
  std::size_t row = 0;
  for (; row + kAtOnce <= rows.size(); row += kAtOnce) four_dots(&rows[row], b, n, out + row);
  for (; row < rows.size(); ++row) out[row] = dot(rows[row], b, n);
}

GLISSADE_WIDE_VARIANT Extent extent_of(const double* row, std::size_t n) {
  constexpr std::size_t kMany = 16;  // budget: of the wide registers
  Extent extent{0, last_four(n)};
  while (extent.to >= kMany && are_nothing(row + extent.to - kMany, kMany)) extent.to -= kMany;
  while (extent.to > 0 && are_nothing(row + extent.to - 4, 4)) extent.to -= 4;
  while (extent.from < extent.to && are_nothing(row + extent.from, 4)) extent.from += 4;
  return extent;
}

void dots(const Matrix& matrix, std::span<const std::size_t> rows, std::span<const Extent> extents,
          const double* b, double* out) {
  const std::size_t n = matrix.columns();
  std::size_t at = 0;
  for (; at + kAtOnce <= rows.size(); at += kAtOnce) {
    const double* four[kAtOnce];
    Extent all = extents[rows[at]];
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      const std::size_t row = rows[at + k];
      four[k] = matrix.row(row);
      all.from = std::min(all.from, extents[row].from);
      all.to = std::max(all.to, extents[row].to);
    }
    four_dots_within(four, all, b, n, out + at);
  }
  for (; at < rows.size(); ++at) out[at] = dot(matrix.row(rows[at]), b, n);
}

void add_scaled_rows(double* y, std::span<const double> k, std::span<const double* const> rows,
                     std::size_t n) {
  std::size_t row = 0;
  for (; row + kAtOnce <= rows.size(); row += kAtOnce) add_four_scaled(y, &k[row], &rows[row], n);
  for (; row < rows.size(); ++row) add_scaled(y, k[row], rows[row], n);
}

GLISSADE_WIDE_VARIANT void rotate_rows(double* a, double* b, double cosine, double sine, std::size_t n) {
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Four left, right;
    load(left, a + i);
    load(right, b + i);
    const Four first = cosine * left + sine * right;
    const Four second = cosine * right - sine * left;
    store(first, a + i);
    store(second, b + i);
  }
  for (int left = 0; left < 3 && i < n; ++left, ++i) {
    const double first = cosine * a[i] + sine * b[i];
    b[i] = cosine * b[i] - sine * a[i];
    a[i] = first;
  }
}

void add_symmetric(Matrix& matrix, double factor, const Vector& a, const Vector& b) {
  // Of most rows one of the two has nothing.
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != 0.0) add_scaled(matrix.row(i), factor * a[i], b.data(), b.size());
    if (b[i] != 0.0) add_scaled(matrix.row(i), factor * b[i], a.data(), a.size());
  }
}

double norm(const Vector& a) {
  return std::sqrt(dot(a.data(), a.data(), a.size()));
}

ShiftedCholesky::ShiftedCholesky(const Matrix& symmetric, const Vector& diagonal, double largest) {
  constexpr double kFirstShift = 1e-6;  // taste
  constexpr double kShiftGrowth = 8.0;  // taste
  const std::size_t n = diagonal.size();
  Matrix upper = Matrix::unset(n, n);
  while (shift_ <= largest && !factor(symmetric, diagonal, upper)) {
    shift_ = shift_ == 0.0 ? kFirstShift : shift_ * kShiftGrowth;
  }
}

bool ShiftedCholesky::factor(const Matrix& symmetric, const Vector& diagonal, Matrix& upper) {
  // A pivot that lost this much against its diagonal is rounding, not curvature.
  constexpr double kSmallestPivot = 1e-11;
  const std::size_t n = diagonal.size();
  // Row by row of the upper factor: of those above a row only sums are taken, many at once.
  inverse_.assign(n, 1.0);
  Vector shares;
  std::vector<const double*> above;
  shares.reserve(n);
  above.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = upper.row(i);
    std::copy(symmetric.row(i) + i, symmetric.row(i) + n, row + i);
    row[i] += shift_ * diagonal[i];
    shares.resize(i);
    above.resize(i);
    for (std::size_t j = 0; j < i; ++j) {
      shares[j] = -upper(j, i);
      above[j] = upper.row(j) + i;
    }
    add_scaled_rows(row + i, shares, above, n - i);
    if (!(row[i] > kSmallestPivot * diagonal[i])) return false;
    const double root = std::sqrt(row[i]);
    inverse_[i] = 1.0 / root;
    row[i] = root;
    for (std::size_t j = i + 1; j < n; ++j) row[j] *= inverse_[i];
  }
  lower_ = Matrix::unset(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) lower_(i, j) = upper(j, i);
  }
  return true;
}

ShiftedCholesky ShiftedCholesky::with_one_more(double curvature) const {
  const std::size_t n = lower_.columns();
  ShiftedCholesky larger;
  larger.lower_ = Matrix::unset(n + 1, n + 1);
  for (std::size_t i = 0; i < n; ++i) std::copy_n(lower_.row(i), i + 1, larger.lower_.row(i));
  std::fill_n(larger.lower_.row(n), n, 0.0);
  larger.lower_(n, n) = std::sqrt(curvature);
  larger.inverse_ = inverse_;
  larger.inverse_.push_back(1.0 / larger.lower_(n, n));
  larger.shift_ = shift_;
  return larger;
}

void ShiftedCholesky::backward(double* x) const {
  for (std::size_t i = lower_.columns(); i-- > 0;) {
    x[i] *= inverse_[i];
    add_scaled(x, -x[i], lower_.row(i), i);
  }
}

void ShiftedCholesky::forward(Matrix& rows) const {
  std::size_t first = 0;
  for (; first + kAtOnce <= rows.rows(); first += kAtOnce) {
    double* const x[kAtOnce] = {rows.row(first), rows.row(first + 1), rows.row(first + 2),
                                rows.row(first + 3)};
    const double* const given[kAtOnce] = {x[0], x[1], x[2], x[3]};
    for (std::size_t i = 0; i < lower_.columns(); ++i) {
      double sums[kAtOnce];
      four_dots(given, lower_.row(i), i, sums);
      for (std::size_t k = 0; k < kAtOnce; ++k) x[k][i] = (x[k][i] - sums[k]) * inverse_[i];
    }
  }
  for (; first < rows.rows(); ++first) forward(rows.row(first));
}

void ShiftedCholesky::forward(double* x) const {
  for (std::size_t i = 0; i < lower_.columns(); ++i) x[i] = (x[i] - dot(lower_.row(i), x, i)) * inverse_[i];
}

}  // namespace glissade::optimizer
