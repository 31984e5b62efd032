#include "centerline/profile/rounded_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace glissade::centerline {
namespace {

constexpr std::size_t kFewest = 20;
constexpr std::size_t kWindow = 9;  // neighbours that are looked at together

/// The coarsest decimal place that all of the numbers keep; 0 where none does.
double last_place(const std::vector<Vec2>& points, double Vec2::*coordinate) {
  constexpr std::array kPlaces = {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
  constexpr double kRounding = 1e-4;  // of a place
  for (const double places : kPlaces) {
    const bool keep = std::all_of(points.begin(), points.end(), [&](const Vec2& point) {
      const double scaled = (point.*coordinate - points.front().*coordinate) * places;
      return std::fabs(scaled - std::nearbyint(scaled)) <= kRounding;
    });
    if (keep) return 1.0 / places;
  }
  return 0.0;
}

/// What a polynomial of third degree leaves of the middle one of five neighbours: with binomial weights of sixth
/// order, of seven.
double left_by_neighbours(const std::vector<Vec2>& points, std::size_t first) {
  const Vec2 chord = points[first + kWindow - 1] - points[first];
  const double length = norm(chord);
  // Newton's divided differences over the chord: the one of highest order, over the root of its weights' squares.
  std::array<double, kWindow> along{};
  std::array<double, kWindow> weight{};
  for (std::size_t i = 0; i < kWindow; ++i)
    along[i] = dot(points[first + i] - points[first], chord) / (length * length);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < kWindow; ++i) {
    double product = 1.0;
    for (std::size_t j = 0; j < kWindow; ++j) {
      if (j != i) product *= along[i] - along[j];
    }
    weight[i] = 1.0 / product;
    sum += weight[i] * cross(chord, points[first + i] - points[first]) / length;
    squares += weight[i] * weight[i];
  }
  return std::fabs(sum) / std::sqrt(squares);
}

/// Whether a good part of the points scatter as rounding to this place makes them.
bool scatter_by(double place, const std::vector<Vec2>& points) {
  constexpr double kLeast = 0.1;
  constexpr double kMost = 3.0;
  constexpr double kPart = 0.25;
  std::size_t windows = 0;
  std::size_t rounded = 0;
  for (std::size_t first = 0; first + kWindow <= points.size(); ++first, ++windows) {
    const double left = left_by_neighbours(points, first);
    if (left > kLeast * place && left < kMost * place) ++rounded;
  }
  return static_cast<double>(rounded) > kPart * static_cast<double>(windows);
}

/// From -1/2 to 1/2, the same on every machine (splitmix64).
double chance(std::uint64_t count) {
  std::uint64_t bits = count * 0x9E3779B97F4A7C15U;
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
  bits ^= bits >> 31U;
  return static_cast<double>(bits >> 11U) * 0x1p-53 - 0.5;
}

}  // namespace

std::optional<LastPlaces> last_places(const std::vector<Vec2>& points) {
  if (points.size() < kFewest) return {};
  LastPlaces places{last_place(points, &Vec2::x), last_place(points, &Vec2::y)};
  // Round numbers beside fine ones were chosen: they are exact.
  constexpr double kFiner = 0.5;
  const double x = places.x;
  if (places.y < kFiner * places.x) places.x = 0.0;
  if (x > 0.0 && x < kFiner * places.y) places.y = 0.0;
  const double place = std::max(places.x, places.y);
  if (place == 0.0 || !scatter_by(place, points)) return {};
  return places;
}

std::vector<Vec2> dithered(std::vector<Vec2> points, const LastPlaces& places) {
  std::uint64_t count = 0;
  for (Vec2& point : points) {
    point.x += places.x * chance(++count);
    point.y += places.y * chance(++count);
  }
  return points;
}

double noise_of_rounding(const std::vector<Vec2>& points, const LastPlaces& places) {
  double by_x = 0.0;
  double by_y = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec2 chord = points[i] - points[i - 1];
    const double square = dot(chord, chord);
    by_x += chord.y * chord.y / square;
    by_y += chord.x * chord.x / square;
  }
  const auto chords = static_cast<double>(points.size() - 1);
  return (places.x * places.x * by_x + places.y * places.y * by_y) / (12.0 * chords);
}

std::optional<NeighbourScatter> scatter_beside_neighbours(const std::vector<Vec2>& points) {
  if (points.size() < kFewest) return {};
  std::vector<double> left;
  double squares = 0.0;
  for (std::size_t first = 0; first + kWindow <= points.size(); ++first) {
    left.push_back(left_by_neighbours(points, first));
    squares += left.back() * left.back();
  }
  const auto quarter = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 4);
  std::nth_element(left.begin(), quarter, left.end());
  // theory: a quarter of what is normally distributed lies within so many standard deviations
  constexpr double kQuarter = 0.3186;
  return NeighbourScatter{std::sqrt(squares / static_cast<double>(left.size())), *quarter / kQuarter};
}

}  // namespace glissade::centerline
