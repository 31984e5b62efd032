#include "solid/swept_volume.hpp"

#include "glissade/core/stop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace glissade::solid {
namespace {

using Polygon = CrossSection::Polygon;

// How much of a line at `height` lies inside the loops.
double width_at(const std::vector<Polygon>& loops, double height) {
  double width = 0.0;
  for (const Polygon& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if ((a.y <= height) == (b.y <= height)) continue;
      const double across = a.x + (height - a.y) / (b.y - a.y) * (b.x - a.x);
      width += b.y > a.y ? across : -across;
    }
  }
  return width;
}

}  // namespace

// V = A S - M dphi, less the integral of width(n) times the length that level n loses (coarea formula, |grad
// d| = 1).
double swept_volume(const Centerline& centerline, const CrossSection& section, const LevelCurves& curves,
                    const std::stop_token& stop) {
  const double turn = curves.stations().front().slope - curves.stations().back().slope;
  double volume = section.area() * centerline.length() - section.first_moment() * turn;
  constexpr double kOutlineShare = 1e-6;
  constexpr double kPanels = 64.0;
  constexpr std::array<double, 3> kNodes{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const double size = section.highest() - section.lowest();
  const std::vector<Polygon> outlines{section.outline(kOutlineShare * size),
                                      section.bore(kOutlineShare * size)};
  for (const int side : {1, -1}) {
    const double least = curves.least_room(side);
    const double reach = side > 0 ? section.highest() : -section.lowest();
    if (!(least < reach)) continue;
    std::vector<double> heights{least, reach};
    for (const Polygon& outline : outlines) {
      for (const Vec2 corner : outline) {
        if (side * corner.y > least && side * corner.y < reach) heights.push_back(side * corner.y);
      }
    }
    std::sort(heights.begin(), heights.end());
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
      const double span = heights[i + 1] - heights[i];
      const double panels = std::ceil(kPanels * span / (reach - least));
      for (double panel = 0.0; panel < panels; ++panel) {
        require_going(stop);
        const double half = 0.5 * span / panels;
        const double centre = heights[i] + (2.0 * panel + 1.0) * half;
        for (std::size_t k = 0; k < kNodes.size(); ++k) {
          const double height = side * (centre + kNodes[k] * half);
          volume -= kWeights[k] * half * width_at(outlines, height) * curves.missing_length(height);
        }
      }
    }
  }
  return volume;
}

}  // namespace glissade::solid
