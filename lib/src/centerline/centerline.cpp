#include "glissade/centerline/centerline.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace {

// A cell of the search for a run: in one of these per smooth stretch the run has at most one extremum.
constexpr int kCellsPerStretch = 8;

/// Root of `function` between a and b, where it has opposite signs or vanishes, to the last bit.
template <class Function>
double root_between(const Function& function, double a, double b) {
  const double at_a = function(a);
  const double at_b = function(b);
  if (at_a == 0.0) return a;
  if (at_b == 0.0) return b;
  std::uintmax_t iterations = 200;
  const auto same = [](double low, double high) { return std::nextafter(low, high) >= high; };
  const auto [low, high] = boost::math::tools::toms748_solve(function, a, b, at_a, at_b, same, iterations);
  return std::fabs(function(low)) <= std::fabs(function(high)) ? low : high;
}

bool changes_sign(double a, double b) {
  return (a < 0.0) != (b < 0.0);
}

}  // namespace

std::vector<double> Centerline::breaks() const {
  return {0.0, length()};
}

Direction Centerline::direction(double s) const {
  const CenterlinePoint point = at(s);
  return {point.slope_angle, point.curvature};
}

Endpoints Centerline::endpoints() const {
  const CenterlinePoint finish = at(length());
  return {finish.x, finish.drop};
}

void Centerline::require_on_track(double s) const {
  if (s >= 0.0 && s <= length()) return;
  throw InputError({"", "arc length " + exact_text(s) + " m is not on the track",
                    "The track is " + exact_text(length()) + " m long.", ""});
}

double Centerline::arc_length_at_run(double x) const {
  const auto excess = [&](double s) { return at(s).x - x; };
  const auto advance = [&](double s) { return math::cos(slope_angle(s)); };
  if (excess(0.0) == 0.0) return 0.0;

  const auto crossing = [&](double a, double b) -> std::optional<double> {
    if (excess(b) != 0.0 && !changes_sign(excess(a), excess(b))) return std::nullopt;
    return root_between(excess, a, b);
  };
  const std::vector<double> stretches = breaks();
  for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
    for (int cell = 0; cell < kCellsPerStretch; ++cell) {
      const double width = stretches[i + 1] - stretches[i];
      const double a = stretches[i] + width * cell / kCellsPerStretch;
      const double b = cell + 1 == kCellsPerStretch ? stretches[i + 1]
                                                    : stretches[i] + width * (cell + 1) / kCellsPerStretch;
      double from = a;
      if (changes_sign(advance(a), advance(b))) {
        const double turn = root_between(advance, a, b);
        if (const auto found = crossing(a, turn)) return *found;
        from = turn;
      }
      if (const auto found = crossing(from, b)) return *found;
    }
  }
  // A run that is the start's or the finish's but for rounding belongs to them.
  const double rounding = kRunAccuracy * length();
  if (std::fabs(excess(0.0)) <= rounding) return 0.0;
  if (std::fabs(excess(length())) <= rounding) return length();
  throw InputError({"", "x: no point of the track has a run of " + exact_text(x) + " m",
                    "The track leads from 0 m to " + exact_text(at(length()).x) + " m.", ""});
}

}  // namespace glissade
