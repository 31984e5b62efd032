#include "solid/sweep_plan.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace glissade::solid {
namespace {

using Polygon = CrossSection::Polygon;

// A plate is never meshed coarser than this share of its thickness, whatever the tolerance: its two faces
// must not meet.
constexpr double kShareOfPlate = 0.25;
// Facets at the narrowest side of a section are at most about this many times longer than wide.
constexpr double kLongestAspect = 8.0;
// Facets smaller than this share of the coordinates' size lose their shape when those are rounded.
constexpr double kCoordinateShare = 4096.0 * std::numeric_limits<double>::epsilon();
// A side of more pieces than this, were they as wide as long, is wide: its facets may be longer across.
constexpr double kWidePieces = 64.0;
constexpr double kMostWidePieces = 256.0;
// Steps turn by this share of the largest kink: neighbours may be somewhat unequal.
constexpr double kKinkShare = 0.9;
constexpr double kBytesPerVertex = sizeof(Vec3);
constexpr double kBytesPerTriangle = sizeof(std::array<std::uint32_t, 3>);

double coordinate_size(const Centerline& centerline, const CrossSection& section,
                       const Placement& placement) {
  const Vec3 start = placement.start();
  return std::max({std::fabs(start.x), std::fabs(start.y), std::fabs(start.z)}) + centerline.length() +
         section.highest() - section.lowest();
}

struct Sides {
  std::vector<double> lengths;
  double total = 0.0;
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;
};

Sides sides_of(const CrossSection& section, double tolerance) {
  Sides sides;
  for (const Polygon& loop : {section.outline(tolerance), section.bore(tolerance)}) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double side = norm(loop[(i + 1) % loop.size()] - loop[i]);
      sides.lengths.push_back(side);
      sides.total += side;
      sides.shortest = std::min(sides.shortest, side);
      sides.longest = std::max(sides.longest, side);
    }
  }
  return sides;
}

std::string count_text(double count) {
  if (count >= 1e9) return rounded_text(count * 1e-9, 3) + " billion";
  if (count >= 1e6) return rounded_text(count * 1e-6, 3) + " million";
  return rounded_text(count, 3);
}

}  // namespace

double Fineness::pieces(double side) const {
  const double square = side / side_piece;
  if (square <= kWidePieces) return std::max(1.0, std::round(square));
  return std::clamp(std::round(square / kLongestAspect), kWidePieces, kMostWidePieces);
}

Fineness Planner::fineness(double tolerance) const {
  Fineness fineness;
  fineness.largest_turn = StationLimits::kLargestTurn;
  if (options_.largest_kink) {
    fineness.largest_turn = std::min(fineness.largest_turn, kKinkShare * options_.largest_kink->radians());
  }
  const double finest = std::min(tolerance, kShareOfPlate * section_.narrowest());
  const bool round = section_.chord_error(finest) > 0.0;
  const double track_share = round ? 0.5 * finest : finest;
  fineness.outline_tolerance = 0.5 * finest;
  if (options_.largest_kink && section_.widest_radius() > 0.0) {
    // The sagitta of a chord that turns so far.
    const double half_turn = math::sin(0.25 * fineness.largest_turn);
    fineness.outline_tolerance =
        std::min(fineness.outline_tolerance, 2.0 * section_.widest_radius() * half_turn * half_turn);
  }
  fineness.chord_tolerance = kPlannedShare * track_share;
  const double corners = section_.vertex_count(fineness.outline_tolerance);
  fineness.section_vertices = corners;
  fineness.steps = 1.0;
  if (fineness.triangles() > limit()) return fineness;

  const Sides sides = sides_of(section_.at_widest(), fineness.outline_tolerance);
  const double length = centerline_.length();
  const double budget = std::min(static_cast<double>(options_.shape_triangles), 0.5 * limit());
  fineness.longest_step =
      std::max({std::min(kLongestAspect * sides.shortest, sides.longest),
                std::sqrt(2.0 * length * sides.total / budget), 2.0 * length * corners / budget});
  fineness.steps = StationPlan(centerline_, limits(fineness)).steps();
  const double spare = 0.5 * budget / fineness.steps - corners;
  const double step = length / fineness.steps;
  fineness.side_piece =
      spare > 0.0 ? std::max(step, sides.total / spare) : std::numeric_limits<double>::infinity();
  fineness.section_vertices = corners;
  for (const double side : sides.lengths) fineness.section_vertices += fineness.pieces(side) - 1.0;
  return fineness;
}

void Planner::require_room(double triangles) const {
  if (triangles <= limit()) return;
  const double bytes = triangles * (kBytesPerTriangle + 0.5 * kBytesPerVertex);
  const double fitting = fitting_tolerance();
  const bool kink_asks = options_.largest_kink && !(fitting > 0.0);
  Issue issue;
  issue.what = (kink_asks ? "largest_kink: " + angle_text(*options_.largest_kink)
                          : "tolerance: " + length_text(options_.tolerance)) +
               " needs " + count_text(triangles) + " triangles, " + size_text(bytes) + " of memory";
  issue.why = "A mesh may have at most " + count_text(limit()) + " triangles.";
  if (fitting > 0.0) {
    issue.hint = "a tolerance of " + length_text(fitting) + " or coarser";
  } else if (kink_asks) {
    issue.hint = "a larger largest_kink than " + angle_text(*options_.largest_kink);
  } else {
    issue.hint = "a higher limit: no tolerance makes this section and track fit";
  }
  throw InputError(issue);
}

// The finest tolerance with two digits that leaves the limit some air, 0 if there is none.
double Planner::fitting_tolerance() const {
  constexpr double kAir = 0.8;
  const auto fits = [this](double tolerance) { return fineness(tolerance).triangles() <= kAir * limit(); };
  double coarse = options_.tolerance;
  do {
    coarse *= 4.0;
    if (coarse > 1e3 * centerline_.length()) return 0.0;
  } while (!fits(coarse));
  double fine = 0.25 * coarse;
  while (coarse > 1.02 * fine) {
    const double middle = std::sqrt(fine * coarse);
    (fits(middle) ? coarse : fine) = middle;
  }
  const double unit = math::decade_of(coarse) / 10.0;
  return std::ceil(coarse / unit) * unit;
}

double finest_length(const Centerline& centerline, const CrossSection& section, const Placement& placement) {
  return kCoordinateShare * coordinate_size(centerline, section, placement);
}

void require_distance(double tolerance) {
  if (std::isfinite(tolerance) && tolerance > 0.0) return;
  throw InputError({"", "tolerance: " + length_text(tolerance) + " is not a distance",
                    "The mesh stays within the tolerance of the ideal solid; it is finite and above zero.",
                    "0.5 mm for a sheet-metal chute"});
}

void check_options(const Centerline& centerline, const CrossSection& section, const Placement& placement,
                   const SweepOptions& options) {
  require_distance(options.tolerance);
  if (options.largest_kink && !(options.largest_kink->radians() > 0.0)) {
    throw InputError({"", "largest_kink: " + angle_text(*options.largest_kink) + " is not an angle",
                      "Facets that follow a curve meet at an angle above zero.", "0.25 deg"});
  }
  if (options.max_triangles < 1000) {
    throw InputError({"", "max_triangles: " + std::to_string(options.max_triangles) + " is too few",
                      "The limit is at least 1000.", ""});
  }
  const double size = coordinate_size(centerline, section, placement);
  const double finest = finest_length(centerline, section, placement);
  if (options.tolerance >= finest && kShareOfPlate * section.narrowest() >= finest) return;
  const bool plate = options.tolerance >= finest;
  throw InputError(
      {"",
       plate ? "cross_section: its narrowest place, " + length_text(section.narrowest()) + ", is too thin"
             : "tolerance: " + length_text(options.tolerance) + " is finer than the coordinates can carry",
       "Coordinates as large as " + length_text(size) + " are rounded to about " + length_text(finest) + ".",
       plate ? "a thicker section, or a start nearer the origin"
             : "a tolerance of " + length_text(2.0 * finest, 1)});
}

}  // namespace glissade::solid
