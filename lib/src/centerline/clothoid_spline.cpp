#include "glissade/centerline/clothoid_spline.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/many_angles.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/vec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {
namespace {

// Gauss-Legendre with this many points integrates the tangent of a piece that turns by kPieceTurning with an
// error of some 1e-22 of its length: nothing but rounding is left.
constexpr unsigned kClothoidGaussPoints = 10;
constexpr double kPieceTurning = 0.5;

/// Neumaier's sum: thousands of segments must not pile up rounding.
class CompensatedSum {
 public:
  explicit CompensatedSum(double start) : sum_(start) {}
  void add(double term) {
    const double next = sum_ + term;
    rest_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  [[nodiscard]] double value() const { return sum_ + rest_; }

 private:
  double sum_;
  double rest_ = 0.0;
};

/// Slope angle after `distance` along a piece that starts with `zeta` and `kappa` and bends more by `rate`.
double slope_after(double zeta, double kappa, double rate, double distance) {
  return zeta - distance * (kappa + 0.5 * rate * distance);
}

/// Displacement along an arc: its chord, in the direction of its middle.
Vec2 arc_displacement(double zeta, double kappa, double distance) {
  const double half_turn = 0.5 * kappa * distance;
  const double chord = half_turn == 0.0 ? distance : distance * (math::sin(half_turn) / half_turn);
  return {chord * math::cos(zeta - half_turn), chord * math::sin(zeta - half_turn)};
}

Vec2 clothoid_displacement(double zeta, double kappa, double rate, double distance) {
  using Rule = boost::math::quadrature::gauss<double, kClothoidGaussPoints>;
  const double half = 0.5 * distance;
  const auto& abscissa = Rule::abscissa();
  constexpr std::size_t kPairs = (kClothoidGaussPoints + 1) / 2;
  std::array<double, 2 * kPairs> angle, sine, cosine;
  for (std::size_t i = 0; i < kPairs; ++i) {
    angle[2 * i] = slope_after(zeta, kappa, rate, half - half * abscissa[i]);
    angle[2 * i + 1] = slope_after(zeta, kappa, rate, half + half * abscissa[i]);
  }
  math::sines_cosines(angle, sine, cosine);
  Vec2 mean;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Vec2 pair{cosine[2 * i] + cosine[2 * i + 1], sine[2 * i] + sine[2 * i + 1]};
    mean = mean + Rule::weights()[i] * pair;
  }
  return half * mean;
}

/// (run, drop) covered in `distance` along a piece.
Vec2 displacement(double zeta, double kappa, double rate, double distance) {
  return rate == 0.0 ? arc_displacement(zeta, kappa, distance)
                     : clothoid_displacement(zeta, kappa, rate, distance);
}

std::string segment_name(std::size_t index) {
  return "segments[" + std::to_string(index) + "]";
}

/// @return a turning that is too much, with the digits that tell
std::string turning_text(double turning) {
  return text_beyond(turning, {kMostTurning}, &rounded_text, 3) + " rad";
}

double turning_of(const ClothoidSegment& segment) {
  return segment.length * std::max(std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature));
}

void require_usable(const ClothoidSegment& segment, std::size_t index) {
  if (!(segment.length > 0.0 && std::isfinite(segment.length))) {
    throw InputError({segment_name(index),
                      "length: " + exact_text(segment.length) + " m is not positive and finite",
                      "Every segment takes up some of the track.", "leave the segment out"});
  }
  for (const double curvature : {segment.entry_curvature, segment.exit_curvature}) {
    if (std::isfinite(curvature)) continue;
    throw InputError({segment_name(index), "curvature: " + exact_text(curvature) + " 1/m is not finite",
                      "Curvature is one over the radius; a straight has curvature 0.", ""});
  }
  if (turning_of(segment) > kMostTurning) {
    throw InputError({segment_name(index), "the segment turns by up to " + turning_text(turning_of(segment)),
                      "The segments of a track may turn by " + rounded_text(kMostTurning, 3) + " rad in all.",
                      "curvature in 1/m, not a radius"});
  }
}

void require_usable(Angle entry_slope_angle, const std::vector<ClothoidSegment>& segments) {
  if (!std::isfinite(entry_slope_angle.radians())) {
    throw InputError(
        {"", "entry slope angle: " + exact_text(entry_slope_angle.degrees()) + " deg is not finite", "", ""});
  }
  if (segments.empty()) {
    throw InputError({"segments", "there are none", "A track needs at least one segment.", ""});
  }
  double turning = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    require_usable(segments[i], i);
    length += segments[i].length;
    turning += turning_of(segments[i]);
  }
  if (!std::isfinite(length)) {
    throw InputError({"segments", "their length is beyond the range of numbers",
                      "Where a track ends follows from all that lies before.", "lengths in metres"});
  }
  if (turning > kMostTurning) {
    throw InputError({"segments", "they turn by up to " + turning_text(turning) + " in all",
                      "The segments of a track may turn by " + rounded_text(kMostTurning, 3) + " rad in all.",
                      "curvature in 1/m, not a radius"});
  }
}

}  // namespace

ClothoidSpline::ClothoidSpline(Angle entry_slope_angle, std::vector<ClothoidSegment> segments)
    : entry_slope_angle_(entry_slope_angle), segments_(std::move(segments)) {
  require_usable(entry_slope_angle_, segments_);
  CompensatedSum arc_length(0.0);
  CompensatedSum zeta(entry_slope_angle_.radians());
  CompensatedSum x(0.0);
  CompensatedSum drop(0.0);
  joints_.reserve(segments_.size() + 1);
  pieces_.reserve(segments_.size());
  joints_.push_back(0.0);
  for (const ClothoidSegment& segment : segments_) {
    const auto pieces = static_cast<int>(std::max(1.0, std::ceil(turning_of(segment) / kPieceTurning)));
    const double piece_length = segment.length / pieces;
    const double change = segment.exit_curvature - segment.entry_curvature;
    const double rate = change / segment.length;
    for (int i = 0; i < pieces; ++i) {
      const double kappa = segment.entry_curvature + change * (static_cast<double>(i) / pieces);
      pieces_.push_back({{arc_length.value(), x.value(), drop.value(), zeta.value(), kappa}, rate});
      const Vec2 step = displacement(zeta.value(), kappa, rate, piece_length);
      x.add(step.x);
      drop.add(step.y);
      zeta.add(-piece_length * (kappa + 0.5 * rate * piece_length));
      arc_length.add(piece_length);
    }
    joints_.push_back(arc_length.value());
  }
  length_ = arc_length.value();
}

const ClothoidSpline::Piece& ClothoidSpline::piece_at(double s) const {
  require_on_track(s);
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), s, [](double value, const Piece& piece) {
    return value < piece.start.arc_length;
  });
  return *std::prev(next);
}

CenterlinePoint ClothoidSpline::at(double s) const {
  const Piece& piece = piece_at(s);
  const auto& [start_s, x, drop, zeta, kappa] = piece.start;
  const double distance = s - start_s;
  const Vec2 step = displacement(zeta, kappa, piece.curvature_rate, distance);
  return {s, x + step.x, drop + step.y, slope_after(zeta, kappa, piece.curvature_rate, distance),
          kappa + piece.curvature_rate * distance};
}

double ClothoidSpline::slope_angle(double s) const {
  return direction(s).slope_angle;
}

Direction ClothoidSpline::direction(double s) const {
  const Piece& piece = piece_at(s);
  const double distance = s - piece.start.arc_length;
  return {slope_after(piece.start.slope_angle, piece.start.curvature, piece.curvature_rate, distance),
          piece.start.curvature + piece.curvature_rate * distance};
}

}  // namespace glissade
