#include "solid/sweep_refusal.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <cmath>
#include <string>

namespace glissade::solid {
namespace {

std::string place_text(const Station& station) {
  return "arc length " + length_text(station.s) + " (" + length_text(station.point.x) + " along, " +
         length_text(-station.point.y) + " down)";
}

std::string radius_text(double curvature) {
  const double bend = std::fabs(curvature);
  if (bend == 0.0) return "the track is straight there";
  if (!std::isfinite(bend)) return "its radius is 0 there";
  return "its radius is " + length_text(1.0 / bend) + " there";
}

}  // namespace

Issue section_issue(const Centerline& centerline, const CrossSection& section, const LevelCurves& curves,
                    double height) {
  const Obstacle obstacle = *curves.trims(height).obstacle;
  const Station station = station_at(centerline, obstacle.s);
  const int side = height > 0.0 ? 1 : -1;
  const double reach = side > 0 ? section.highest() : -section.lowest();
  const std::string direction = side > 0 ? "above the floor" : "below the floor";
  double largest = curves.largest_height(side);
  const double unit = math::decade_of(largest) / 100.0;
  while (largest > 0.0 && curves.trims(side * largest).obstacle.has_value()) largest -= unit;
  largest = largest > 0.0 ? std::floor(0.999 * largest / unit) * unit : 0.0;

  Issue issue;
  issue.what = "cross_section: it reaches " + length_text(reach) + " " + direction +
               ", further than the track has room for at " + place_text(station) + "; " +
               radius_text(station.kappa);
  switch (obstacle.kind) {
    case Obstacle::Kind::start_face:
      issue.why = "That part of the section lies behind the start face, or bends back over it, all the way.";
      break;
    case Obstacle::Kind::finish_face:
      issue.why = "That part of the section lies beyond the finish face, or bends back over it, all the way.";
      break;
    case Obstacle::Kind::reach:
      issue.why = "Another part of the track comes within the section's reach there.";
      break;
  }
  issue.hint = largest > 0.0 ? "a section that reaches at most " + length_text(largest) + " " + direction
                             : "a track that does not meet itself";
  return issue;
}

void refuse_widening(double from, double to) {
  const std::string stretch = "from " + length_text(from) + " to " + length_text(to);
  throw InputError(
      {"", "cross_section: its width changes where the walls fold over, " + stretch + " along the track",
       "In a curve tighter than the walls are high its two branches meet, and must be of one width there.",
       "the same width " + stretch + ", or lower walls"});
}

void refuse_fine_widening(double tolerance) {
  throw InputError(
      {"", "tolerance: no mesh found departs by " + length_text(tolerance) + " at most",
       "The width changes where the track bends about as tightly as the walls are high; the place of a "
       "wall changes ever faster towards the centre of such a bend.",
       "a coarser tolerance, one width where the track bends most, or lower walls"});
}

}  // namespace glissade::solid
