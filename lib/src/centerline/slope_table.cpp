#include "slope_table.hpp"

#include "glissade/core/math.hpp"

#include "chebyshev_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::centerline {

/// Cuts the turn into pieces, halving those whose length or series is not exact to rounding.
class SlopeTable::Builder {
 public:
  Builder(SlopeTable& table, const std::function<double(double)>& radius) : table_(table), radius_(radius) {}

  void append(double from, double to, int depth) {
    const double middle = 0.5 * (from + to);
    const double whole = arc_length(from, to);
    const double halves = arc_length(from, middle) + arc_length(middle, to);
    constexpr int kDeepest = 50;
    // Halving divides the error of 15-point quadrature by 2^30.
    constexpr double kHalvesAgree = 1e-9;
    const bool exact = std::fabs(whole - halves) <= kHalvesAgree * halves;
    if (depth < kDeepest && !(exact && append_piece(from, to, halves))) {
      append(from, middle, depth + 1);
      append(middle, to, depth + 1);
    }
  }

 private:
  [[nodiscard]] double radius_at(double turned) const {
    return radius_(table_.begin_ + table_.sign_ * turned);
  }

  [[nodiscard]] double arc_length(double from, double to) const {
    constexpr unsigned kPoints = 15;
    return boost::math::quadrature::gauss<double, kPoints>::integrate(
        [this](double turned) { return radius_at(turned); }, from, to);
  }

  /// @return the angle turned `distance` beyond `from`, a small part of the turn up to `to`
  [[nodiscard]] double turned_after(double from, double to, double distance) const {
    constexpr int kMostSteps = 8;
    constexpr double kQuadraticallyConverged = 1e-8;  // its square is below rounding
    double turned = std::clamp(from + distance / radius_at(from), from, to);
    for (int step = 0; step < kMostSteps; ++step) {
      const double change = (distance - arc_length(from, turned)) / radius_at(turned);
      turned = std::clamp(turned + change, from, to);
      if (std::fabs(change) <= kQuadraticallyConverged * (turned - from)) break;
    }
    return turned;
  }

  /// @return false, and nothing appended, where a series does not converge to rounding
  bool append_piece(double from, double to, double length) {
    Piece piece;
    piece.begin = table_.length_;
    piece.end = table_.length_ + length;
    if (!(piece.begin < piece.end)) return true;
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
    if (!resolved(piece.turned) || !resolved(run_rate) || !resolved(drop_rate)) return false;
    piece.x = integral(run_rate, length);
    piece.drop = integral(drop_rate, length);
    piece.first_x = end_x_;
    piece.first_drop = end_drop_;
    end_x_ += chebyshev_value(piece.x, 1.0);
    end_drop_ += chebyshev_value(piece.drop, 1.0);
    table_.length_ = piece.end;
    table_.pieces_.push_back(piece);
    return true;
  }

  [[nodiscard]] static Series integral(const Series& rate, double length) {
    Series sum = chebyshev_integral(rate);
    for (double& coefficient : sum) coefficient *= 0.5 * length;
    return sum;
  }

  /// Angles, cosines and sines alike are held to the rounding of an angle.
  [[nodiscard]] static bool resolved(const Series& series) {
    constexpr double kNegligible = 2e-16;
    return std::max(std::fabs(series[kTerms - 1]), std::fabs(series[kTerms - 2])) <= kNegligible;
  }

  SlopeTable& table_;
  const std::function<double(double)>& radius_;
  double end_x_ = 0.0;
  double end_drop_ = 0.0;
};

SlopeTable::SlopeTable(double begin, double turn, const std::function<double(double)>& radius)
    : begin_(begin), sign_(turn < 0.0 ? -1.0 : 1.0) {
  Builder(*this, radius).append(0.0, std::fabs(turn), 0);
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
