// What the sweep sweeps, as a drawing: lines and arcs of the outline, and the measures that a workshop asks for.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/profile_drawing.hpp"
#include "glissade/section/cross_section.hpp"

#include "core/millimetres.hpp"
#include "pipeline/drawings/sheet_lengths.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

namespace glissade {

using namespace pipeline;

namespace {

/// What the text of a DXF is sized for: a bed of some metres on an A3 sheet.
constexpr double kSectionTextScale = 10.0;  // taste

// What lettering and the cross at the centerline are sized for, along the greater side [mm].
constexpr double kSmallestSection = 400.0;  // taste: a chute
constexpr double kLargestSection = 4000.0;  // taste: the bed of a hill

/// The section's x counts to the left of a body that looks towards the finish; on paper left is left.
Vec2 on_paper(Vec2 point) {
  return {-core::kMillimetres * point.x, core::kMillimetres * point.y};
}

ArcPath path_of(const section::Outline& outline) {
  ArcPath path;
  path.closed = true;
  for (const section::Stroke& stroke : outline) {
    // Mirrored, an arc that turns left turns right.
    const double bulge = stroke.arc ? -math::tan(0.25 * (stroke.arc->to - stroke.arc->from)) : 0.0;
    path.vertices.push_back({on_paper(stroke.from), bulge});
  }
  return path;
}

class Dimensions {
 public:
  /// @param size  of the section [mm]
  Dimensions(Drawing& drawing, double size)
      : drawing_(drawing), layer_(drawing.layer({"dimensions", LineStyle::continuous, 0.18, 5})) {
    constexpr double kSteps = 200.0;  // taste: that a section's greater side has at least
    while (size * shares_ < kSteps) shares_ *= 10.0;
  }

  /// @param offset_mm  of the dimension line on paper, above where positive
  void level(double from_x, double to_x, double height, double offset_mm) {
    add({from_x, height}, {to_x, height}, offset_mm, DimensionKind::level);
  }
  void upright(double x, double low, double high, double offset_mm) {
    add({x, low}, {x, high}, offset_mm, DimensionKind::upright);
  }

 private:
  /// In metres of the paper's frame: x to the right.
  void add(Vec2 from, Vec2 to, double offset_mm, DimensionKind kind) {
    const double length = core::kMillimetres * (kind == DimensionKind::level ? to.x - from.x : to.y - from.y);
    const std::string text =
        shares_ == kTenths ? "" : decimal_text(std::round(shares_ * std::fabs(length)) / shares_);
    drawing_.dimensions.push_back(
        {layer_, core::kMillimetres * from, core::kMillimetres * to, offset_mm, kind, text});
  }

  static constexpr double kTenths = 10.0;  // what dimensions are told to

  Drawing& drawing_;
  std::size_t layer_;
  double shares_ = kTenths;  // of a millimetre
};

void add_grooves(const section::TrackGroove& track, Dimensions& dimensions) {
  const double middle = 0.5 * track.groove_spacing;
  const double half = 0.5 * track.groove_width;
  const double top = track.groove_depth;
  dimensions.level(-middle, middle, top, 22.0);
  dimensions.level(-middle - half, -middle + half, top, 12.0);
  dimensions.level(middle - half, middle + half, top, 12.0);
  dimensions.upright(middle + half, 0.0, top, -14.0);
}

}  // namespace

std::optional<Drawing> cross_section_drawing(const Design& design) {
  if (!design.cross_section) return {};
  const CrossSection section = CrossSection(*design.cross_section).at(0.0);
  Drawing drawing;
  drawing.name = design.name;
  const std::size_t outline = drawing.layer({"outline", LineStyle::continuous, 0.5, 7});
  Vec2 low{0.0, section.lowest()};
  Vec2 high{0.0, section.highest()};
  for (const section::Outline& loop : section.loops()) {
    drawing.add(outline, path_of(loop));
    for (const section::Stroke& stroke : loop) {
      // A round side may reach beyond its corners.
      constexpr int kPlaces = 64;
      for (int i = 0; i < (stroke.arc ? kPlaces : 1); ++i) {
        const Vec2 at =
            stroke.arc ? stroke.arc->at(stroke.arc->from + (stroke.arc->to - stroke.arc->from) * i / kPlaces)
                       : stroke.from;
        low.x = std::fmin(low.x, -at.x);
        high.x = std::fmax(high.x, -at.x);
      }
    }
  }
  const double size = core::kMillimetres * std::fmax(high.x - low.x, high.y - low.y);
  const double factor = lettering_factor(size, kSmallestSection, kLargestSection);
  drawing.text_scale = factor * kSectionTextScale;
  Dimensions dimensions(drawing, size);
  dimensions.level(low.x, high.x, low.y, -14.0);
  dimensions.upright(low.x, low.y, high.y, 14.0);
  if (low.y < 0.0 && high.y > 0.0) dimensions.upright(high.x, low.y, 0.0, -14.0);
  if (const auto* const grooves = std::get_if<section::TrackGroove>(&*design.cross_section))
    add_grooves(*grooves, dimensions);
  const std::size_t centre = drawing.layer({"centerline", LineStyle::chain, 0.18, 1});
  const double reach = 40.0 * factor;  // taste [mm]
  drawing.line(centre, {0.0, -reach}, {0.0, reach});
  drawing.line(centre, {-reach, 0.0}, {reach, 0.0});
  return drawing;
}

}  // namespace glissade
