#include "glissade/core/capacity.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/section/cross_section.hpp"

#include "design/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade::design_file {
namespace {

/// A lower bound of the number of facets that a curved track needs: an edge of length h departs by h^2 kappa / 8 from an
/// arc of curvature kappa, so a track of length S that turns evenly by phi = kappa S has S / h = sqrt(S phi / (8 e))
/// steps, with two facets at each corner of the section. Every curved kind turns by more than 0.25, and none so
/// unevenly that half of those steps do.
double least_triangles(const Design& design, const CrossSection& section, double tolerance) {
  constexpr double kLeastTurn = 0.25;
  constexpr double kUneven = 0.5;
  const double chord = norm(design.track.finish - design.track.start);
  const double steps = kUneven * std::sqrt(kLeastTurn * chord / (8.0 * tolerance));
  return 2.0 * section.vertex_count(tolerance) * std::max(steps, 1.0);
}

// Ten times what a solved curve is exact to: a mesh that is held to less measures the curve's own rounding.
constexpr double kFinestShare = 1e-11;

void check_mesh_size(const Design& design, Collected& findings) {
  constexpr double kBytesPerTriangle = 60.0;  // facet, half of a vertex, and what checking them takes
  const bool curved = !is_drawn(design.centerline.kind) && design.centerline.kind != CenterlineKind::straight;
  if (!curved) return;
  const std::optional<CrossSection> section = sound_cross_section(design);
  if (!section) return;
  const double chord = norm(design.track.finish - design.track.start);
  if (design.mesh.tolerance < kFinestShare * chord) {
    report(findings, {"mesh.tolerance", "centerline"},
           {"", "tolerance: " + length_text(design.mesh.tolerance) + " is finer than the curve is known",
            "Its points are exact to some 1e-12 of the way from start to finish, " + length_text(chord) + ".",
            "a tolerance above " + length_text(kFinestShare * chord, 2) + "; 0.5 mm suits most workshops"});
    return;
  }
  const double triangles = least_triangles(design, *section, design.mesh.tolerance);
  constexpr auto kMost = static_cast<double>(kMostTriangles);
  if (!(triangles > kMost)) return;
  constexpr double kCoarser = 1.05;
  double smallest = design.mesh.tolerance;
  while (least_triangles(design, *section, smallest) > kMost) smallest *= kCoarser;
  report(findings, {"mesh.tolerance", "cross_section", "centerline"},
         {"",
          "tolerance: " + rounded_text(design.mesh.tolerance * 1e3, 4) + " mm needs more than " +
              rounded_text(triangles, 2) + " triangles, some " +
              rounded_text(triangles * kBytesPerTriangle * 1e-9, 2) + " GB",
          "A mesh has at most " + rounded_text(kMost, 2) + " triangles.",
          "a tolerance above " + rounded_text(smallest * 1e3, 2) + " mm; 0.5 mm suits most workshops"});
}

void check_kink(const Design& design, Collected& findings) {
  if (!design.mesh.largest_kink) return;
  constexpr Angle kSmallest = Angle::from_degrees(0.001);
  constexpr Angle kLargest = Angle::from_degrees(14.0);
  const Angle kink = *design.mesh.largest_kink;
  if (kink >= kSmallest && kink <= kLargest) return;
  report(findings, {"mesh.largest_kink"},
         out_of_range(
             "largest_kink", kink.radians(), Dimension::angle, {kSmallest.radians(), kLargest.radians()},
             "Facets that follow a curve meet at 0.001 to 14 deg; without the key, as the tolerance asks.",
             "0.25 deg for codes that move particles over the mesh"));
}

}  // namespace

void check_mesh(const Design& design, Collected& findings) {
  check_kink(design, findings);
  const double tolerance = design.mesh.tolerance;
  if (!(tolerance > 0.0 && std::isfinite(tolerance))) {
    report(findings, {"mesh.tolerance"},
           {"", "tolerance: " + rounded_text(tolerance * 1e3, 4) + " mm is not positive",
            "It is how far the mesh may depart from the exact shape.", "0.5 mm"});
    return;
  }
  const bool given = design.locations.contains("mesh.tolerance");
  if (!given && !design.cross_section) return;  // the default of a mesh that nobody asked for
  const double distance = norm(design.track.finish - design.track.start);
  if (distance > kLongestTrack) return;  // that is wrong itself
  if (distance > 0.0 && tolerance > distance) {
    constexpr double kFine = 1e-3;  // of the track: its shape is there, and the mesh small
    const auto [coarse, whole] = texts_apart(tolerance, distance, &length_text);
    report(
        findings, {"mesh.tolerance", "track"},
        {"", "tolerance: " + coarse + (given ? "" : ", the default,") + " is larger than the track, " + whole,
         "It is how far the mesh may depart from the exact shape.",
         (given ? "" : "mesh: {tolerance: ") + length_text(kFine * distance, 1) + (given ? "" : "}")});
  }
  check_mesh_size(design, findings);
}

namespace {

template <typename Format>
void refuse_repeated(const std::vector<Format>& formats, Collected& findings) {
  for (auto here = formats.begin(); here != formats.end(); ++here) {
    if (std::find(formats.begin(), here, *here) == here) continue;
    report(findings, {"export"},
           {"", "export: " + std::string(word(*here)) + " is named twice", "", "each format once"});
  }
}

void check_workshop_files(const Design& design, Collected& findings) {
  const ExportDesign& exports = design.exports;
  if (!design.fabrication) {
    if (!exports.whole_workshop && exports.workshop.empty()) return;
    const std::string_view asked = exports.whole_workshop ? "workshop" : word(exports.workshop.front());
    report(findings, {"export"},
           {"", "export: " + std::string(asked) + " is of parts, and nothing makes any",
            "Parts are made where the design has a fabrication.", "fabrication: {process: plate}"});
    return;
  }
  for (const WorkshopFormat format : exports.workshop) {
    if (fits(format, *design.fabrication)) continue;
    report(findings, {"export"},
           {"",
            "export: " + std::string(word(format)) +
                " does not fit process: " + std::string(process_word(*design.fabrication)),
            "It holds " + std::string(kWorkshopFiles[static_cast<std::size_t>(format)].holds) + ".",
            "export: workshop, which is all that fits"});
  }
}

}  // namespace

void check_export(const Design& design, Collected& findings) {
  const ExportDesign& exports = design.exports;
  if (exports.formats.empty() && exports.workshop.empty() && !exports.whole_workshop) {
    report(findings, {"export"},
           {"", "export: no format is named", "A build writes at least one file.", "[stl, off, scad]"});
  }
  refuse_repeated(exports.formats, findings);
  refuse_repeated(exports.workshop, findings);
  check_workshop_files(design, findings);
}

}  // namespace glissade::design_file
