#include "glissade/solid/level_line.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "solid/level_curves.hpp"
#include "solid/stations.hpp"

#include <algorithm>
#include <cmath>

namespace glissade {

using namespace solid;

namespace {

LevelCurves curves_of(const Centerline& centerline, double height, double tolerance) {
  // Trims are placed this much more closely than the line follows the curve.
  constexpr double kTrimShare = 0.1;
  constexpr double kFewestSteps = 64.0;
  constexpr double kFinest = 1e-12;  // rounding: of the length, finer than its coordinates are told to
  if (!(std::isfinite(tolerance) && tolerance >= kFinest * centerline.length() && std::isfinite(height))) {
    throw InputError({"",
                      "level line: a tolerance of " + exact_text(tolerance) + " m at a height of " +
                          exact_text(height) + " m",
                      "Both are finite, and the tolerance at least " +
                          length_text(kFinest * centerline.length()) +
                          ", what a track of that length is told to.",
                      "1 mm to draw it"});
  }
  const double below = std::max(0.0, -height);
  const double above = std::max(0.0, height);
  const StationLimits limits{tolerance, below, above, centerline.length() / kFewestSteps};
  return LevelCurves(centerline, StationPlan(centerline, limits).stations(), below, above,
                     kTrimShare * tolerance);
}

std::vector<Vec2> uncut(const LevelCurves& curves, double height) {
  std::vector<Vec2> line;
  for (const Station& station : curves.stations()) line.push_back(offset(station, height));
  return line;
}

}  // namespace

std::vector<Vec2> level_line(const Centerline& centerline, double height, double tolerance) {
  const LevelCurves curves = curves_of(centerline, height, tolerance);
  if (curves.trims(height).obstacle) return uncut(curves, height);
  std::vector<Vec2> line;
  for (const LevelNode& node : curves.level(height, {}).nodes) line.push_back(node.point);
  return line;
}

std::vector<Vec2> offset_line(const Centerline& centerline, double height, double tolerance) {
  return uncut(curves_of(centerline, height, tolerance), height);
}

}  // namespace glissade
