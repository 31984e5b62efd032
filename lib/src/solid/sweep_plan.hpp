#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/section/cross_section.hpp"
#include "glissade/solid/sweep.hpp"

#include "solid/stations.hpp"
#include "solid/widening.hpp"

namespace glissade::solid {

/// Steps are planned for this share of the tolerance: one step beside a trim may be that much longer.
inline constexpr double kPlannedShare = 0.75;

/// How fine a mesh is to be, decided before anything of its size is made.
struct Fineness {
  double outline_tolerance = 0.0;  // of round outlines
  double chord_tolerance = 0.0;    // of the level curves
  double longest_step = 0.0;       // between stations
  double steps = 0.0;              // how many of them
  double side_piece = 0.0;         // length that the sides of the section are cut into, wide ones aside
  double largest_turn = 0.0;       // of the track from station to station [rad]
  double section_vertices = 0.0;   // how many that gives

  /// @return how many pieces a side is cut into. A wide one asks for none across: it gets facets that are up to
  ///         some eight times as wide as long, and wider ones where those would be too many.
  [[nodiscard]] double pieces(double side) const;

  [[nodiscard]] double triangles() const { return 2.0 * section_vertices * (steps + 1.0); }
};

/// Finds the fineness that a tolerance asks for, and what is left of the budget for the shape of facets.
class Planner {
 public:
  Planner(const Centerline& centerline, const CrossSection& section, const SweepOptions& options)
      : centerline_(centerline), section_(section), options_(options) {}

  [[nodiscard]] Fineness fineness(double tolerance) const;

  [[nodiscard]] StationLimits limits(const Fineness& fineness) const {
    return {fineness.chord_tolerance, -section_.lowest(),
            section_.highest(),       fineness.longest_step,
            fineness.largest_turn,    Widening(section_).knots_between(0.0, centerline_.length())};
  }

  /// @throws InputError if the mesh would be larger than the options allow; names a tolerance that fits
  void require_room(double triangles) const;

  /// @return whether facets must not meet at more than a given angle
  [[nodiscard]] bool holds_kink() const { return options_.largest_kink.has_value(); }
  [[nodiscard]] const std::stop_token& stop() const { return options_.stop; }
  [[nodiscard]] double limit() const { return static_cast<double>(options_.max_triangles); }

 private:
  [[nodiscard]] double fitting_tolerance() const;

  const Centerline& centerline_;
  const CrossSection& section_;
  const SweepOptions& options_;
};

/// @return the smallest length that means something in a mesh there [m]
[[nodiscard]] double finest_length(const Centerline& centerline, const CrossSection& section,
                                   const Placement& placement);

/// @throws InputError if it is not finite and positive
void require_distance(double tolerance);

/// @throws InputError if the options, or the section's thinnest place, are out of range (see sweep())
void check_options(const Centerline& centerline, const CrossSection& section, const Placement& placement,
                   const SweepOptions& options);

}  // namespace glissade::solid
