#include "parts/bodies/joint_face.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

constexpr int kHoleCorners = 48;

double distance_to(Vec2 a, Vec2 b, Vec2 point) {
  const Vec2 along = b - a;
  const double share = std::clamp(dot(point - a, along) / dot(along, along), 0.0, 1.0);
  return norm(point - (a + share * along));
}

double distance_between(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double side_c = cross(b - a, c - a);
  const double side_d = cross(b - a, d - a);
  const double side_a = cross(d - c, a - c);
  const double side_b = cross(d - c, b - c);
  if (side_c * side_d < 0.0 && side_a * side_b < 0.0) return 0.0;
  return std::min({distance_to(a, b, c), distance_to(a, b, d), distance_to(c, d, a), distance_to(c, d, b)});
}

std::vector<Vec2> rectangle_of(Vec2 low, Vec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

/// The bars of a digit: top, upper left, upper right, middle, lower left, lower right, bottom.
constexpr std::array<std::array<bool, 7>, 10> kBars = {{{true, true, true, false, true, true, true},
                                                        {false, false, true, false, false, true, false},
                                                        {true, false, true, true, true, false, true},
                                                        {true, false, true, true, false, true, true},
                                                        {false, true, true, true, false, true, false},
                                                        {true, true, false, true, false, true, true},
                                                        {true, true, false, true, true, true, true},
                                                        {true, false, true, false, false, true, false},
                                                        {true, true, true, true, true, true, true},
                                                        {true, true, true, true, false, true, true}}};
constexpr double kDigitWidth = 0.6;   // of the height
constexpr double kDigitSpace = 0.25;  // between digits
constexpr double kBarGap = 0.03;      // between bars

std::vector<std::vector<Vec2>> bars_of(int digit, Vec2 corner, double height) {
  const double bar = kBarWidth * height;
  const double gap = kBarGap * height;
  const double width = kDigitWidth * height;
  const auto level = [&](double middle) {
    return rectangle_of(corner + Vec2{bar + gap, middle - 0.5 * bar},
                        corner + Vec2{width - bar - gap, middle + 0.5 * bar});
  };
  const auto upright = [&](double left, double from, double to) {
    return rectangle_of(corner + Vec2{left, from + gap}, corner + Vec2{left + bar, to - gap});
  };
  const double half = 0.5 * height;
  const std::array<std::vector<Vec2>, 7> all = {level(height - 0.5 * bar),
                                                upright(0.0, half, height),
                                                upright(width - bar, half, height),
                                                level(half),
                                                upright(0.0, 0.0, half),
                                                upright(width - bar, 0.0, half),
                                                level(0.5 * bar)};
  std::vector<std::vector<Vec2>> bars;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kBars[static_cast<std::size_t>(digit)][i]) bars.push_back(all[i]);
  }
  return bars;
}

}  // namespace

double area_of(const std::vector<Vec2>& corners) {
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    twice += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  return 0.5 * twice;
}

FaceOutline::FaceOutline(const CrossSection& section, double chord_tolerance) {
  loops_.push_back(section.outline(chord_tolerance));
  if (auto bore = section.bore(chord_tolerance); !bore.empty()) loops_.push_back(std::move(bore));
  measure();
}

FaceOutline::FaceOutline(std::vector<std::vector<Vec2>> loops) : loops_(std::move(loops)) {
  measure();
}

void FaceOutline::measure() {
  low_ = high_ = loops_.front().front();
  for (const auto& loop : loops_) {
    for (const Vec2 corner : loop) {
      low_ = {std::min(low_.x, corner.x), std::min(low_.y, corner.y)};
      high_ = {std::max(high_.x, corner.x), std::max(high_.y, corner.y)};
    }
  }
}

double FaceOutline::clearance(Vec2 at) const {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (const auto& loop : loops_) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      nearest = std::min(nearest, distance_to(a, b, at));
      if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
        inside = !inside;
      }
    }
  }
  return inside ? nearest : -nearest;
}

double FaceOutline::room(Vec2 at) const {
  return std::min(clearance(at), std::fabs(at.x));
}

bool FaceOutline::holds(Vec2 low, Vec2 high, double margin) const {
  if (!(clearance(low) >= margin)) return false;
  const std::vector<Vec2> box = rectangle_of(low, high);
  for (const auto& loop : loops_) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if (a.x > low.x && a.x < high.x && a.y > low.y && a.y < high.y) return false;
      for (std::size_t k = 0; k < 4; ++k) {
        // A margin of nothing, too, is crossed by an outline that goes through the box.
        if (!(distance_between(box[k], box[(k + 1) % 4], a, b) > margin)) return false;
      }
    }
  }
  return true;
}

Vec2 FaceOutline::roomiest(bool left) const {
  constexpr int kSteps = 96;
  constexpr double kNearlyAsGood = 0.98;
  const double side = left ? 1.0 : -1.0;
  const double reach = left ? high_.x : -low_.x;
  struct Candidate {
    Vec2 at;
    double clearance;
  };
  std::vector<Candidate> candidates;
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 1; i < kSteps; ++i) {
    for (int k = 1; k < kSteps; ++k) {
      const Vec2 at{side * reach * i / kSteps, low_.y + (high_.y - low_.y) * k / kSteps};
      candidates.push_back({at, room(at)});
      most = std::max(most, candidates.back().clearance);
    }
  }
  Candidate best{{0.0, 0.0}, -1.0};
  for (const Candidate& candidate : candidates) {
    if (candidate.clearance < kNearlyAsGood * most) continue;
    const bool farther = side * candidate.at.x > side * best.at.x + 1e-12;
    const bool as_far = !(side * best.at.x > side * candidate.at.x + 1e-12);
    if (best.clearance < 0.0 || farther || (as_far && candidate.clearance > best.clearance)) best = candidate;
  }
  return best.at;
}

double Recess::volume() const {
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const double here = area_of(rings[i].corners);
    const double below = area_of(rings[i + 1].corners);
    const double height = rings[i + 1].depth - rings[i].depth;
    volume += height / 3.0 * (here + below + std::sqrt(here * below));  // of similar ends
  }
  return volume;
}

Recess round_hole(Vec2 centre, double diameter, double depth, double chamfer) {
  // Sides of the polygons touch the circle from outside.
  const double outward = 1.0 / math::cos(std::numbers::pi / kHoleCorners);
  const auto ring = [&](double radius, double at) {
    Recess::Ring made;
    made.depth = at;
    for (int i = 0; i < kHoleCorners; ++i) {
      const auto [sine, cosine] = math::sine_cosine(2.0 * std::numbers::pi * i / kHoleCorners);
      made.corners.push_back(centre + outward * radius * Vec2{cosine, sine});
    }
    return made;
  };
  Recess hole;
  if (chamfer > 0.0) hole.rings.push_back(ring(0.5 * diameter + chamfer, 0.0));
  hole.rings.push_back(ring(0.5 * diameter, chamfer));
  hole.rings.push_back(ring(0.5 * diameter, depth));
  return hole;
}

double width_of_digits(std::size_t count) {
  return kDigitWidth * static_cast<double>(count) +
         kDigitSpace * static_cast<double>(count > 0 ? count - 1 : 0);
}

std::vector<Recess> sunk_digits(const std::string& digits, Vec2 corner, double height, double depth) {
  std::vector<Recess> recesses;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') continue;
    for (std::vector<Vec2>& bar : bars_of(digit - '0', corner, height)) {
      recesses.push_back({{{bar, 0.0}, {bar, depth}}});
    }
    corner.x += (kDigitWidth + kDigitSpace) * height;
  }
  return recesses;
}

std::optional<NumberPlace> place_for_digits(const FaceOutline& face, std::size_t count,
                                            const std::vector<Vec2>& keep_off, double radius) {
  constexpr std::array<double, 9> kHeights = {8e-3, 7e-3, 6e-3, 5e-3, 4e-3, 3.5e-3, 3e-3, 2.5e-3, 2e-3};
  constexpr double kMargin = 0.6e-3;  // of the digits from edges and holes
  constexpr int kSteps = 48;
  for (const double height : kHeights) {
    const double width = width_of_digits(count) * height;
    std::optional<Vec2> best;
    for (int k = 0; k <= kSteps; ++k) {
      for (int i = 0; i <= kSteps; ++i) {
        const Vec2 middle{face.low().x + (face.high().x - face.low().x) * i / kSteps,
                          face.low().y + (face.high().y - face.low().y) * k / kSteps};
        const Vec2 low = middle - Vec2{0.5 * width, 0.5 * height};
        const Vec2 high = middle + Vec2{0.5 * width, 0.5 * height};
        if (best && std::fabs(middle.x) >= std::fabs(best->x + 0.5 * width) - 1e-12) continue;
        const bool free = std::all_of(keep_off.begin(), keep_off.end(), [&](Vec2 hole) {
          const Vec2 nearest{std::clamp(hole.x, low.x, high.x), std::clamp(hole.y, low.y, high.y)};
          return norm(hole - nearest) >= radius + kMargin;
        });
        if (free && face.holds(low, high, kMargin)) best = low;
      }
    }
    if (best) return NumberPlace{*best, height};
  }
  return std::nullopt;
}

}  // namespace glissade::parts
