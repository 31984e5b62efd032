#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/drawing/drawing.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace glissade {
namespace {

// On paper, in millimetres (ISO 129: arrows of 15 deg, extension lines 2 mm beyond the dimension line).
constexpr double kArrowLength = 2.5;
constexpr double kArrowHalfWidth = 0.33;
constexpr double kBeyond = 2.0;
constexpr double kClear = 1.0;
constexpr double kTextHeight = 2.5;
constexpr double kTextAbove = 0.8;

/// @return the unit vector along which a dimension measures
Vec2 direction_of(const DrawnDimension& dimension) {
  const Vec2 along = dimension.to - dimension.from;
  if (dimension.kind == DimensionKind::level) return {along.x < 0.0 ? -1.0 : 1.0, 0.0};
  if (dimension.kind == DimensionKind::upright) return {0.0, along.y < 0.0 ? -1.0 : 1.0};
  const double size = norm(along);
  return size > 0.0 ? (1.0 / size) * along : Vec2{1.0, 0.0};
}

ArcPath arrow(Vec2 tip, Vec2 inward, double per_paper) {
  const Vec2 back = tip + (kArrowLength * per_paper) * inward;
  const Vec2 side = (kArrowHalfWidth * per_paper) * Vec2{-inward.y, inward.x};
  return {{{tip}, {back + side}, {back - side}}, true};
}

/// @return the angle at which a text along a direction is read from below or from the right
double reading_angle(Vec2 along) {
  const double angle = math::atan2(along.y, along.x);
  constexpr double kLeeway = 1e-6;
  if (angle > kRightAngle + kLeeway) return angle - std::numbers::pi;
  return angle < -kRightAngle + kLeeway ? angle + std::numbers::pi : angle;
}

}  // namespace

DimensionLines lines_of(const DrawnDimension& dimension, double scale) {
  const double per_paper = 1.0 / scale;
  const Vec2 along = direction_of(dimension);
  const Vec2 left{-along.y, along.x};
  const double side = dimension.offset_mm < 0.0 ? -1.0 : 1.0;
  const double reach = dot(dimension.to - dimension.from, along);
  // The dimension line keeps its distance from whichever point lies further out.
  const double of_to = dot(dimension.to - dimension.from, left);
  const double base = side > 0.0 ? std::fmax(0.0, of_to) : std::fmin(0.0, of_to);
  const Vec2 start = dimension.from + (base + dimension.offset_mm * per_paper) * left;
  const Vec2 end = start + reach * along;

  DimensionLines drawn;
  for (const auto& [point, foot] : {std::pair{dimension.from, start}, std::pair{dimension.to, end}}) {
    if (dot(foot - point, left) * side <= kClear * per_paper) continue;
    const Vec2 from = point + (side * kClear * per_paper) * left;
    drawn.lines.push_back({{{from}, {foot + (side * kBeyond * per_paper) * left}}, false});
  }
  // To a tenth: what a tape or a folding rule shows; the files carry the exact numbers.
  drawn.text.text = dimension.text.empty() ? decimal_text(std::round(reach * 10.0) / 10.0) : dimension.text;
  const double width = stroked_width(drawn.text.text, kTextHeight);
  const bool fits = reach * scale > 2.5 * kArrowLength;
  const bool text_fits = reach * scale > width + 2.0 * kClear;
  // A number that is wider than what it measures stands beyond the end, on the line.
  const double before = fits ? 0.0 : 2.0 * kArrowLength;
  const double beyond = text_fits ? before : kArrowLength + width + 2.0 * kClear;
  drawn.lines.push_back(
      {{{start - (before * per_paper) * along}, {end + (beyond * per_paper) * along}}, false});
  const Vec2 inward = fits ? along : -1.0 * along;
  drawn.arrows = {arrow(start, inward, per_paper), arrow(end, -1.0 * inward, per_paper)};

  const double angle = reading_angle(along);
  const auto [sine, cosine] = math::sine_cosine(angle);
  drawn.text.layer = dimension.layer;
  drawn.text.height_mm = kTextHeight;
  drawn.text.anchor = TextAnchor::centre;
  drawn.text.angle = Angle::from_radians(angle);
  const Vec2 middle =
      text_fits ? 0.5 * (start + end) : end + ((kArrowLength + kClear + 0.5 * width) * per_paper) * along;
  drawn.text.at = middle + (kTextAbove * per_paper) * Vec2{-sine, cosine};
  return drawn;
}

Drawing without_dimensions(const Drawing& drawing) {
  Drawing flat = drawing;
  flat.dimensions.clear();
  for (const DrawnDimension& dimension : drawing.dimensions) {
    DimensionLines lines = lines_of(dimension, 1.0 / drawing.text_scale);
    for (ArcPath& path : lines.lines) flat.add(dimension.layer, std::move(path));
    for (ArcPath& path : lines.arrows) {
      flat.add(dimension.layer, std::move(path));
      flat.paths.back().filled = true;
    }
    flat.texts.push_back(std::move(lines.text));
  }
  return flat;
}

}  // namespace glissade
