#include "glissade/motion/laws/most_wear.hpp"

#include "glissade/core/error.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <boost/math/tools/minima.hpp>

namespace glissade {
namespace {

/// @return the greatest W_c along a ride [W/m^2]; 0 of one that does not land
double peak_wear(const CenterlinePtr& centerline, Body body, double gravity, Friction friction) {
  const auto* const stream = dynamic_cast<const BulkStream*>(body.law.get());
  if (stream == nullptr)
    throw InputError({"body", "it is no stream of bulk solid", "What wears a floor is a stream.", ""});
  body.friction = friction;
  const Motion motion(centerline, body, gravity);
  if (!lands(motion)) return 0.0;
  return motion
      .highest([&](const LawState& at) {
        return stream->floor_wear(at.arc_length, Friction::from_coefficient(at.friction), at.normal_load);
      })
      .value;
}

}  // namespace

std::optional<Friction> friction_of_most_wear(const CenterlinePtr& centerline, const Body& body,
                                              double gravity, Friction low, Friction high) {
  const double from = low.coefficient();
  const double to = high.coefficient();
  if (!(from < to)) return {};
  const auto friction_at = [&](double share) {
    return Friction::from_coefficient(std::clamp(from + share * (to - from), from, to));
  };
  const auto peak = [&](double share) { return peak_wear(centerline, body, gravity, friction_at(share)); };
  std::array<double, 12> peaks{};
  const double step = 1.0 / static_cast<double>(peaks.size() - 1);
  for (std::size_t i = 0; i < peaks.size(); ++i) peaks[i] = peak(static_cast<double>(i) * step);
  const double best = *std::max_element(peaks.begin(), peaks.end());
  double most = 0.0;
  double at_share = 0.0;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    // A track that was searched for within such a limit is worn about alike at many frictions: every peak that may be the highest.
    constexpr double kNear = 0.98;  // taste: of the highest
    const bool is_peak = (i == 0 || peaks[i] >= peaks[i - 1]) &&
                         (i + 1 == peaks.size() || peaks[i] >= peaks[i + 1]) && peaks[i] >= kNear * best;
    if (!is_peak) continue;
    const double share = static_cast<double>(i) * step;
    constexpr int kBits = 17;  // accuracy: 1e-5 of the range
    std::uintmax_t rounds = 30;
    const auto [found, negative] = boost::math::tools::brent_find_minima(
        [&](double at) { return -peak(at); }, std::max(0.0, share - step), std::min(1.0, share + step), kBits,
        rounds);
    if (-negative <= most) continue;
    most = -negative;
    at_share = found;
  }
  constexpr double kMore = 1e-9;  // accuracy: that of a peak
  if (!(most > (1.0 + kMore) * std::max(peaks.front(), peaks.back()))) return {};
  return friction_at(at_share);
}

}  // namespace glissade
