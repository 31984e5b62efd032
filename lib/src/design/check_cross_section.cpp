#include "glissade/core/number_text.hpp"

#include "design/checks.hpp"
#include "design/outline.hpp"

#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

constexpr double kLargestMeasure = 1e4;    // [m]
constexpr double kSmallestMeasure = 1e-6;  // [m]

bool is_measure(double value) {
  return value >= kSmallestMeasure && value <= kLargestMeasure;
}

void check_measure(double value, const std::string& key, Collected& findings) {
  if (is_measure(value)) return;
  const std::string fault = value > 0.0 ? "out of range" : "not positive";
  report(findings, {"cross_section." + key},
         {"", key + ": " + length_text(value) + " is " + fault, "It lies between 0.001 mm and 10 km.", ""});
}

void check_optional_measure(double value, const std::string& key, Collected& findings) {
  if (value != 0.0) check_measure(value, key, findings);
}

void check_thickness(const CrossSectionDesign& section, const std::string& width_key, Collected& findings) {
  check_measure(section.thickness, "thickness", findings);
  if (!is_measure(section.width) || section.thickness <= section.width) return;
  report(findings, {"cross_section.thickness", "cross_section." + width_key},
         {"",
          "thickness: " + length_text(section.thickness) + " is wider than the channel, " +
              length_text(section.width),
          "A plate is thinner than the " + width_key + " that it encloses.", "the units of both"});
}

void check_curbs(const CrossSectionDesign& section, Collected& findings) {
  check_optional_measure(section.curb_height, "curb_height", findings);
  check_optional_measure(section.curb_width, "curb_width", findings);
  if ((section.curb_height > 0.0) != (section.curb_width > 0.0)) {
    const bool high = section.curb_height > 0.0;
    report(findings, {high ? "cross_section.curb_height" : "cross_section.curb_width"},
           {"", std::string(high ? "curb_height" : "curb_width") + " stands alone",
            "A curb has both a curb_height and a curb_width.", "both, or none"});
  }
  if (2.0 * section.curb_width < section.width || !is_measure(section.width)) return;
  report(findings, {"cross_section.curb_width", "cross_section.width"},
         {"",
          "curb_width: two curbs of " + length_text(section.curb_width) + " leave no floor in a width of " +
              length_text(section.width),
          "The curbs stand within the width.", "a curb_width below " + length_text(section.width / 2.0)});
}

void check_wall_angle(const CrossSectionDesign& section, Collected& findings) {
  constexpr double kSteepestLean = 80.0 / 180.0 * std::numbers::pi;
  const double angle = section.wall_angle.radians();
  if (angle >= 0.0 && angle <= kSteepestLean) return;
  report(findings, {"cross_section.wall_angle"},
         {"", "wall_angle: " + angle_text(angle) + " is out of range",
          "Walls lean outward by 0 to 80 deg from upright.", "20 deg"});
}

void check_outline(const std::vector<Vec2>& outline, Collected& findings) {
  std::optional<Issue> fault = outline_fault(outline, "outline");
  if (!fault && !touches_outline(outline, {0.0, 0.0})) {
    fault = Issue{"", "outline: does not pass through [0 mm, 0 mm]",
                  "That point is the centerline, on the floor's surface.",
                  "[0 mm, 0 mm] as a corner in the middle of the floor"};
  }
  if (fault) report(findings, {"cross_section.outline"}, *std::move(fault));
}

}  // namespace

void check_cross_section(const Design& design, Collected& findings) {
  if (!design.cross_section) return;
  const CrossSectionDesign& section = *design.cross_section;
  if (section.kind == CrossSectionKind::polygon) {
    check_outline(section.outline, findings);
    return;
  }
  const std::string width_key = section.kind == CrossSectionKind::pipe ? "inner_diameter" : "width";
  check_measure(section.width, width_key, findings);
  check_thickness(section, width_key, findings);
  if (section.kind == CrossSectionKind::slab) check_curbs(section, findings);
  if (section.kind == CrossSectionKind::half_pipe) {
    check_optional_measure(section.wall_height, "wall_height", findings);
  }
  const bool walled =
      section.kind == CrossSectionKind::u_channel || section.kind == CrossSectionKind::trapezoid;
  if (walled) check_measure(section.wall_height, "wall_height", findings);
  if (section.kind == CrossSectionKind::trapezoid) check_wall_angle(section, findings);
}

}  // namespace glissade::design_file
