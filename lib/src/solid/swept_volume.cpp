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

/// @return the length that a level loses, each piece of it weighted by the share of the way to the widest section
double missing_share(const Centerline& centerline, const Widening& widening, const LevelCurves& curves,
                     double height) {
  double missing = 0.0;
  for (const Trim& cut : curves.trims(height).cuts) {
    missing +=
        widening.over_length(cut.from, cut.to) + height * widening.over_slope(centerline, cut.from, cut.to);
  }
  return missing;
}

}  // namespace

// V = A S - M dphi, less the integral of width(n) times the length that level n loses (coarea formula, |grad
// d| = 1). Where the width changes, A and M are linear in the share t of the way to the widest section, and so are the
// widths of levels: the parts beside the narrowest section are integrals of t over arc length and slope angle.
double swept_volume(const Centerline& centerline, const Widening& widening, const LevelCurves& curves,
                    const std::stop_token& stop) {
  const CrossSection& section = widening.narrow();
  const double turn = curves.stations().front().slope - curves.stations().back().slope;
  double volume = section.area() * centerline.length() - section.first_moment() * turn;
  if (widening.varies()) {
    const CrossSection& wide = widening.wide();
    volume += (wide.area() - section.area()) * widening.over_length(0.0, centerline.length()) +
              (wide.first_moment() - section.first_moment()) *
                  widening.over_slope(centerline, 0.0, centerline.length());
  }
  constexpr double kOutlineShare = 1e-6;
  constexpr double kPanels = 64.0;
  constexpr std::array<double, 3> kNodes{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const double size = section.highest() - section.lowest();
  const std::vector<Polygon> outlines{section.outline(kOutlineShare * size),
                                      section.bore(kOutlineShare * size)};
  const std::vector<Polygon> wide_outlines{widening.wide().outline(kOutlineShare * size),
                                           widening.wide().bore(kOutlineShare * size)};
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
          if (!widening.varies()) continue;
          const double spread = width_at(wide_outlines, height) - width_at(outlines, height);
          volume -= kWeights[k] * half * spread * missing_share(centerline, widening, curves, height);
        }
      }
    }
  }
  return volume;
}

}  // namespace glissade::solid
