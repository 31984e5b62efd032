#include "centerline/optima/slope_table.hpp"

#include "glissade/core/math.hpp"

#include "centerline/numerics/chebyshev_series.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::centerline {

/// Cuts the turn into pieces, halving those whose length or series is not exact to rounding.
class SlopeTable::Builder {
 public:
  Builder(SlopeTable& table, const std::function<double(double)>& radius) : table_(table), radius_(radius) {}

  void append(double from, double to) { append(from, to, 0, {}); }

 private:
  [[nodiscard]] double radius_at(double turned) const { return radius_(table_.sign_ * turned); }

  [[nodiscard]] double arc_length(double from, double to) const {
    constexpr unsigned kPoints = 15;
    return boost::math::quadrature::gauss<double, kPoints>::integrate(
        [this](double turned) { return radius_at(turned); }, from, to);
  }

  /// What a piece misses: of its length, and of the last terms of its series.
  struct Miss {
    double arc = HUGE_VAL;
    double tail = HUGE_VAL;
  };

  /// Whether a miss is none, or rounding, which halving leaves as it is: beside a vertical slope the radius is known to fewer
  /// digits.
  [[nodiscard]] static bool is_fine(double miss, double of_parent, double exact, double noise) {
    constexpr double kNoShrink = 0.5;
    return miss <= exact || (miss <= noise && miss > kNoShrink * of_parent);
  }

  void append(double from, double to, int depth, const Miss& of_parent) {
    constexpr int kDeepest = 50;
    // Halving divides the error of 15-point quadrature by 2^30.
    constexpr double kHalvesAgree = 1e-9;
    constexpr double kArcNoise = 1e-5;
    // Angles, cosines and sines alike are held to the rounding of an angle.
    constexpr double kNegligible = 2e-16;
    constexpr double kTailNoise = 1e-12;
    const double middle = 0.5 * (from + to);
    const double halves = arc_length(from, middle) + arc_length(middle, to);
    Miss miss;
    miss.arc = std::fabs(arc_length(from, to) - halves) / halves;
    const bool deepest = depth >= kDeepest;
    if (deepest || is_fine(miss.arc, of_parent.arc, kHalvesAgree, kArcNoise)) {
      const Piece piece = piece_between(from, to, halves, miss.tail);
      if (deepest || is_fine(miss.tail, of_parent.tail, kNegligible, kTailNoise)) return append(piece);
    }
    append(from, middle, depth + 1, miss);
    append(middle, to, depth + 1, miss);
  }

  /// @return the angle turned `distance` beyond `from`, a part of the turn up to `to`
  [[nodiscard]] double turned_after(double from, double to, double distance) const {
    constexpr int kMostSteps = 100;
    constexpr double kQuadraticallyConverged = 1e-8;  // its square is below rounding
    double low = from;
    double high = to;
    double turned = std::clamp(from + distance / radius_at(from), from, to);
    for (int step = 0; step < kMostSteps; ++step) {
      const double left = distance - arc_length(from, turned);
      (left > 0.0 ? low : high) = turned;
      const double change = left / radius_at(turned);
      const double next = std::clamp(turned + change, from, to);
      const bool settled = std::fabs(next - turned) <= kQuadraticallyConverged * (next - from);
      // Beside a cusp the radius changes so fast that Newton's steps lead from one end to the other.
      turned = settled || (next > low && next < high) ? next : 0.5 * (low + high);
      if (settled) break;
    }
    return turned;
  }

  /// @param tail  of its series, the greatest
  [[nodiscard]] Piece piece_between(double from, double to, double length, double& tail) const {
    Piece piece;
    piece.begin = table_.length_;
    piece.end = table_.length_ + length;
    Series turned{};
    Series cosine{};
    Series sine{};
    double last = from;
    double covered = 0.0;
    for (std::size_t j = kTerms; j-- > 0;) {
      const double distance = 0.5 * length * (1.0 + node_cosines<kTerms>()[1][j]);
      last = turned_after(last, to, distance - covered);
      covered = distance;
      turned[j] = last;
      const double zeta = table_.begin_ + table_.sign_ * last;
      cosine[j] = math::cos(zeta);
      sine[j] = math::sin(zeta);
    }
    piece.turned = chebyshev_series(turned);
    const Series run_rate = chebyshev_series(cosine);
    const Series drop_rate = chebyshev_series(sine);
    tail = std::max({tail_of(piece.turned), tail_of(run_rate), tail_of(drop_rate)});
    piece.x = integral(run_rate, length);
    piece.drop = integral(drop_rate, length);
    return piece;
  }

  void append(Piece piece) {
    if (!(piece.begin < piece.end)) return;  // shorter than rounding
    piece.first_x = end_x_;
    piece.first_drop = end_drop_;
    end_x_ += chebyshev_value(piece.x, 1.0);
    end_drop_ += chebyshev_value(piece.drop, 1.0);
    table_.length_ = piece.end;
    table_.pieces_.push_back(piece);
  }

  [[nodiscard]] static Series integral(const Series& rate, double length) {
    Series sum = chebyshev_integral(rate);
    for (double& coefficient : sum) coefficient *= 0.5 * length;
    return sum;
  }

  [[nodiscard]] static double tail_of(const Series& series) {
    return std::max(std::fabs(series[kTerms - 1]), std::fabs(series[kTerms - 2]));
  }

  SlopeTable& table_;
  const std::function<double(double)>& radius_;
  double end_x_ = 0.0;
  double end_drop_ = 0.0;
};

SlopeTable::SlopeTable(double begin, double turn, const std::function<double(double)>& radius)
    : begin_(begin), sign_(turn < 0.0 ? -1.0 : 1.0) {
  Builder(*this, radius).append(0.0, std::fabs(turn));
}

double SlopeTable::Piece::position(double s) const {
  return std::clamp(((s - begin) - (end - s)) / (end - begin), -1.0, 1.0);
}

const SlopeTable::Piece& SlopeTable::piece_at(double s) const {
  return *std::lower_bound(pieces_.begin(), pieces_.end() - 1, s,
                           [](const Piece& piece, double value) { return piece.end < value; });
}

double SlopeTable::slope_angle(double s) const {
  const Piece& piece = piece_at(s);
  return begin_ + sign_ * chebyshev_value(piece.turned, piece.position(s));
}

SlopeTable::Point SlopeTable::at(double s) const {
  const Piece& piece = piece_at(s);
  const double position = piece.position(s);
  return {begin_ + sign_ * chebyshev_value(piece.turned, position),
          piece.first_x + chebyshev_value(piece.x, position),
          piece.first_drop + chebyshev_value(piece.drop, position)};
}

}  // namespace glissade::centerline
