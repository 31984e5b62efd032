#include "report/view_mesh.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/grouped.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::report {
namespace {

struct Station {
  double x;
  double drop;
  double arc_length;
};

std::vector<Station> stations_of(const Centerline& centerline, int count) {
  std::vector<Station> stations;
  for (int i = 0; i <= count; ++i) {
    const CenterlinePoint point = centerline.at(centerline.length() * (static_cast<double>(i) / count));
    stations.push_back({point.x, point.drop, point.arc_length});
  }
  return stations;
}

double arc_length_beside(const std::vector<Station>& stations, double x, double drop) {
  double least = std::numeric_limits<double>::infinity();
  double arc_length = 0.0;
  for (const Station& station : stations) {
    const double dx = station.x - x;
    const double dy = station.drop - drop;
    const double distance = dx * dx + dy * dy;
    if (distance < least) {
      least = distance;
      arc_length = station.arc_length;
    }
  }
  return arc_length;
}

/// A sweep that the view can hold: fewer facets for their shape alone, then a tolerance that doubles until it
/// fits.
Solid coarser(const ReportInput& input, double& tolerance) {
  const Centerline& centerline = input.motion->centerline();
  const double largest = 0.02 * centerline.length();
  while (true) {
    Solid solid = sweep(centerline, *input.solid.section, input.solid.solid->placement,
                        {.tolerance = tolerance, .shape_triangles = kViewTriangles / 2, .stop = input.stop});
    if (solid.mesh.triangles.size() <= kViewTriangles || tolerance >= largest) return solid;
    tolerance = std::min(2.0 * tolerance, largest);
  }
}

void pack(const ReportInput& input, const TriangleMesh& mesh, ViewMesh& view) {
  const double infinity = std::numeric_limits<double>::infinity();
  view.lower = {infinity, infinity, infinity};
  view.upper = {-infinity, -infinity, -infinity};
  for (const Vec3& v : mesh.vertices) {
    view.lower = {std::min(view.lower.x, v.x), std::min(view.lower.y, v.y), std::min(view.lower.z, v.z)};
    view.upper = {std::max(view.upper.x, v.x), std::max(view.upper.y, v.y), std::max(view.upper.z, v.z)};
  }
  const Centerline& centerline = input.motion->centerline();
  const std::vector<Station> stations = stations_of(centerline, 300);
  const Vec3 start = input.solid.solid->placement.start();
  const double cosine = math::cos(input.placement.azimuth().radians());
  const double sine = math::sin(input.placement.azimuth().radians());
  view.positions.reserve(3 * mesh.vertices.size());
  view.arc_length.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    view.positions.push_back(on_grid(v.x, view.lower.x, view.upper.x));
    view.positions.push_back(on_grid(v.y, view.lower.y, view.upper.y));
    view.positions.push_back(on_grid(v.z, view.lower.z, view.upper.z));
    const double x = (v.x - start.x) * cosine + (v.y - start.y) * sine;
    view.arc_length.push_back(
        on_grid(arc_length_beside(stations, x, start.z - v.z), 0.0, centerline.length()));
  }
  view.indices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    view.indices.insert(view.indices.end(), triangle.begin(), triangle.end());
  }
}

}  // namespace

std::uint16_t on_grid(double value, double low, double high) {
  if (high <= low) return 0;
  return static_cast<std::uint16_t>(
      std::lround(std::clamp((value - low) / (high - low), 0.0, 1.0) * ViewMesh::kSteps));
}

ViewMesh make_view(const ReportInput& input) {
  ViewMesh view;
  const TriangleMesh& written = input.solid.solid->mesh;
  if (written.triangles.size() <= kViewTriangles) {
    pack(input, written, view);
  } else {
    double tolerance = input.design->mesh.tolerance;
    const Solid solid = coarser(input, tolerance);
    pack(input, solid.mesh, view);
    view.note = "The files hold " + core::grouped(written.triangles.size()) +
                " facets; this view shows the same solid with " + core::grouped(solid.mesh.triangles.size()) +
                " (tolerance " + length_text(tolerance, 3) + ").";
  }
  const Vec3 size = view.upper - view.lower;
  const double step = std::max({size.x, size.y, size.z}) / ViewMesh::kSteps;
  view.note += std::string(view.note.empty() ? "" : " ") + "Positions in this view are rounded to " +
               length_text(step, 2) + ".";
  return view;
}

}  // namespace glissade::report
