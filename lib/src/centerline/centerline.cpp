#include "glissade/centerline/centerline.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace {

/// Panels per smooth piece that are looked at for the first crossing of a run. A piece that never overhangs
/// needs but one; the others let a track that doubles back still give its first crossing.
constexpr int kPanelsPerPiece = 32;

}  // namespace

std::vector<double> Centerline::breaks() const {
  return {0.0, length()};
}

double Centerline::arc_length_at_run(double x) const {
  const auto missing = [&](double s) { return at(s).x - x; };
  const auto crossing = [&](double low, double missing_low, double high, double missing_high) {
    std::uintmax_t iterations = 200;
    const auto bracket =
        boost::math::tools::toms748_solve(missing, low, high, missing_low, missing_high,
                                          boost::math::tools::eps_tolerance<double>(52), iterations);
    return std::min(bracket.first, bracket.second);
  };

  double low = 0.0;
  double missing_low = missing(low);
  if (missing_low == 0.0) return low;
  const std::vector<double> pieces = breaks();
  for (std::size_t piece = 1; piece < pieces.size() && missing_low < 0.0; ++piece) {
    const double start = pieces[piece - 1];
    const double end = pieces[piece];
    for (int panel = 1; panel <= kPanelsPerPiece; ++panel) {
      const double high = panel == kPanelsPerPiece ? end : start + (end - start) * panel / kPanelsPerPiece;
      const double missing_high = missing(high);
      if (missing_high == 0.0) return high;
      if (missing_high > 0.0) return crossing(low, missing_low, high, missing_high);
      low = high;
      missing_low = missing_high;
    }
  }
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * length();
  if (missing_low < 0.0 && missing_low >= -rounding) return length();
  if (missing_low > 0.0 && missing_low <= rounding) return 0.0;
  throw InputError(Issue{"", "x: no point of the track has a run of " + exact_text(x) + " m",
                         "The track leads from 0 m to " + exact_text(at(length()).x) + " m.", ""});
}

}  // namespace glissade
