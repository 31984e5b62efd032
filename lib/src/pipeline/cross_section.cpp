#include "pipeline/cross_section.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/pipeline/solve.hpp"

namespace glissade {

namespace pipeline {

std::string section_in_words(const CrossSectionDesign& section) {
  std::string text(word(section.kind));
  if (section.kind == CrossSectionKind::polygon) return text;
  text += section.kind == CrossSectionKind::pipe ? ", inner diameter " : ", width ";
  text += length_text(section.width);
  if (section.wall_height > 0.0) text += ", wall height " + length_text(section.wall_height);
  if (section.kind == CrossSectionKind::trapezoid) {
    text += ", walls " + angle_text(section.wall_angle.radians()) + " from upright";
  }
  if (section.curb_height > 0.0) {
    text += ", curbs " + length_text(section.curb_height) + " high and " + length_text(section.curb_width) +
            " wide";
  }
  return text + ", thickness " + length_text(section.thickness);
}

void require_cross_section(const Design& design) {
  if (design.cross_section) return;
  throw InputError(
      {design.where("cross_section"), "there is no cross_section to make a solid of",
       "A build sweeps a cross-section along the centerline.",
       "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}, or "
       "'glissade solve' for the track alone"});
}

}  // namespace pipeline

CrossSection make_cross_section(const CrossSectionDesign& design) {
  switch (design.kind) {
    case CrossSectionKind::slab:
      return CrossSection::slab(design.width, design.thickness, design.curb_height, design.curb_width);
    case CrossSectionKind::u_channel:
      return CrossSection::u_channel(design.width, design.wall_height, design.thickness);
    case CrossSectionKind::trapezoid:
      return CrossSection::trapezoid(design.width, design.wall_height, design.wall_angle, design.thickness);
    case CrossSectionKind::half_pipe:
      return CrossSection::half_pipe(design.width, design.thickness, design.wall_height);
    case CrossSectionKind::pipe:
      return CrossSection::pipe(design.width, design.thickness);
    case CrossSectionKind::polygon:
      return CrossSection::polygon(design.outline);
  }
  throw InternalError({"", "a kind of cross-section without a shape", "", ""});
}

}  // namespace glissade
