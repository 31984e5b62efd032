#include "parts/shop/bolts.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace glissade {
namespace parts {
namespace {

// Holes: ISO 273:1979, fine, medium, coarse; nuts ISO 4032, washers ISO 7089 and ISO 7093-1 (heights, largest);
// countersunk heads, largest heights k: ISO 10642:1997, which ends at M20: half of what the largest theoretical head diameter
// exceeds the thread by, (22.4 - 10) / 2 of M10 [mm].
constexpr std::array<Bolt, 8> kBolts = {{
    {5, 5.3e-3, 5.5e-3, 5.8e-3, 4.7e-3, 1.1e-3, 1.2e-3, 10e-3, 15e-3, 3.1e-3},
    {6, 6.4e-3, 6.6e-3, 7.0e-3, 5.2e-3, 1.8e-3, 1.8e-3, 12e-3, 18e-3, 3.72e-3},
    {8, 8.4e-3, 9.0e-3, 10.0e-3, 6.8e-3, 1.8e-3, 2.2e-3, 16e-3, 24e-3, 4.96e-3},
    {10, 10.5e-3, 11.0e-3, 12.0e-3, 8.4e-3, 2.2e-3, 2.7e-3, 20e-3, 30e-3, 6.2e-3},
    {12, 13.0e-3, 13.5e-3, 14.5e-3, 10.8e-3, 2.7e-3, 3.3e-3, 24e-3, 37e-3, 7.44e-3},
    {16, 17.0e-3, 17.5e-3, 18.5e-3, 14.8e-3, 3.3e-3, 3.3e-3, 30e-3, 50e-3, 8.8e-3},
    {20, 21.0e-3, 22.0e-3, 24.0e-3, 18.0e-3, 3.3e-3, 4.6e-3, 37e-3, 60e-3, 10.16e-3},
    {24, 25.0e-3, 26.0e-3, 28.0e-3, 21.5e-3, 4.3e-3, 5.6e-3, 44e-3, 72e-3, 0.0},
}};
// Nominal lengths, ISO 888, as ISO 4017 and ISO 10642 have them [mm].
constexpr std::array<int, 24> kLengths = {12, 16, 20, 25,  30,  35,  40,  45,  50,  55,  60,  65,
                                          70, 80, 90, 100, 110, 120, 130, 140, 150, 160, 180, 200};
constexpr double kThreads = 0.3;  // of the diameter: two threads of a coarse pitch

}  // namespace

const Bolt& bolt_of(int size) {
  const auto* const found =
      std::find_if(kBolts.begin(), kBolts.end(), [&](const Bolt& bolt) { return bolt.size == size; });
  if (found != kBolts.end()) return *found;
  std::string sizes;
  for (const Bolt& bolt : kBolts) sizes += (sizes.empty() ? "M" : ", M") + std::to_string(bolt.size);
  throw InputError({"", "bolt: M" + std::to_string(size) + " is no size whose holes are known", "", sizes});
}

double least_bolt_length(const Bolt& bolt, double grip) {
  return grip + 2.0 * bolt.washer_height + bolt.nut_height + kThreads * 1e-3 * bolt.size;
}

double bolt_length(const Bolt& bolt, double grip) {
  const double least = 1e3 * least_bolt_length(bolt, grip) - 1e-6;
  for (const int length : kLengths) {
    if (length >= least) return 1e-3 * length;
  }
  constexpr double kLongStep = 20.0;  // ISO 888 above 200 mm
  return 1e-3 * kLongStep * std::ceil(least / kLongStep);
}

std::vector<Vec2> evenly(Vec2 from, Vec2 to, double pitch) {
  const double length = norm(to - from);
  const double gaps = std::max(1.0, std::ceil(length / pitch - 1e-9));
  std::vector<Vec2> centres;
  for (double k = 0.0; k <= gaps; k += 1.0) centres.push_back(from + (k / gaps) * (to - from));
  return centres;
}

bool is_bolt_size(int size) {
  return std::any_of(kBolts.begin(), kBolts.end(), [&](const Bolt& bolt) { return bolt.size == size; });
}

}  // namespace parts

const std::vector<int>& bolt_sizes() {
  static const std::vector<int> sizes = [] {
    std::vector<int> all;
    for (const parts::Bolt& bolt : parts::kBolts) all.push_back(bolt.size);
    return all;
  }();
  return sizes;
}

double clearance_hole(int bolt, HoleFit fit) {
  const parts::Bolt& found = parts::bolt_of(bolt);
  switch (fit) {
    case HoleFit::fine:
      return found.fine;
    case HoleFit::coarse:
      return found.coarse;
    case HoleFit::medium:
      break;
  }
  return found.medium;
}

}  // namespace glissade
