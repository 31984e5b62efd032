#pragma once

#include "glissade/report/report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace glissade::report {

/// The solid as the page's 3-D view draws it: positions on a grid of kSteps steps along each side of the
/// bounding box, the arc length beside each vertex on as many steps of the track.
struct ViewMesh {
  static constexpr std::uint32_t kSteps = 65535;
  std::vector<std::uint16_t> positions;   ///< x, y, z of each vertex
  std::vector<std::uint32_t> indices;     ///< three of each facet
  std::vector<std::uint16_t> arc_length;  ///< of the nearest point of the centerline
  Vec3 lower;                             ///< bounding box [m]
  Vec3 upper;
  std::string note;  ///< what the reader must know where the view is not the solid to the facet; may be empty
};

/// @return where a value lies between two bounds, in steps of ViewMesh::kSteps
[[nodiscard]] std::uint16_t on_grid(double value, double low, double high);

[[nodiscard]] ViewMesh make_view(const ReportInput& input);

}  // namespace glissade::report
