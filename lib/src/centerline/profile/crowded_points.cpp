#include "centerline/profile/crowded_points.hpp"

#include <algorithm>

namespace glissade::centerline {

bool lose_order(const std::vector<Vec2>& points) {
  constexpr int kFewest = 4;  // taste: a slip or two are none
  const double ahead = points.back().x - points.front().x;
  int back = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    back += (points[i + 1].x - points[i].x) * ahead <= 0.0 ? 1 : 0;
  return back >= kFewest;
}

std::size_t lost_from(const std::vector<Vec2>& points, std::size_t first, double reach) {
  constexpr std::size_t kFewest = 4;  // taste: the mean of fewer is hardly better than the first of them
  constexpr std::size_t kPart = 8;    // taste: of all points
  constexpr double kFar = 8.0;        // taste: reaches; from there on means of more lie farther still
  const auto mean = [&](std::size_t from, std::size_t to) {
    Vec2 sum;
    for (std::size_t i = from; i < to; ++i) sum = sum + (points[i] - points[first]);
    return (1.0 / static_cast<double>(to - from)) * sum;
  };
  std::size_t count = 1;
  for (std::size_t half = kFewest; half * kPart <= points.size(); half *= 2) {
    if (first + 2 * half > points.size()) break;
    const double way = norm(mean(first, first + half) - mean(first + half, first + 2 * half));
    if (way <= reach) count = half;
    if (way > kFar * reach) break;
  }
  return count;
}

std::vector<Vec2> with_order_told(const std::vector<Vec2>& points, double reach, bool all_along) {
  std::vector<Vec2> told;
  for (std::size_t from = 0; from < points.size();) {
    const std::size_t count = from == 0 || all_along ? lost_from(points, from, reach) : 1;
    Vec2 sum;
    for (std::size_t i = from; i < from + count; ++i) sum = sum + (points[i] - points[from]);
    told.push_back(points[from] + (1.0 / static_cast<double>(count)) * sum);
    from += count;
  }
  return told;
}

std::vector<Vec2> with_ends_told(const std::vector<Vec2>& points, double reach) {
  std::vector<Vec2> told = points;
  for (int end = 0; end < 2; ++end) {
    told = with_order_told(told, reach, false);
    std::reverse(told.begin(), told.end());
  }
  return told;
}

}  // namespace glissade::centerline
