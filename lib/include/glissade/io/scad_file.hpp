#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// How an OpenSCAD program is written: unit, name, frame.
struct ScadFileOptions {
  LengthUnit unit = LengthUnit::millimetre;
  std::string name;  ///< of the design, for a comment; control characters become spaces
  /// As of MeshFileOptions; the program also tells it, as glissade_offset().
  std::optional<Vec3> offset = {};
  std::string section;        ///< the cross-section in words, for a comment likewise; may be empty
  std::stop_token stop = {};  ///< as of MeshFileOptions
};

/// Writes an OpenSCAD program that renders the solid as it is, and that others `use`.
///
/// It offers the modules `glissade_solid()` and `glissade_centerline(diameter)`, a bar along the centerline
/// that is so wide and high, and the functions `glissade_centerline_points()` and `glissade_direction()`, the
/// level unit vector from start to finish. Numbers are the shortest decimals that read back as the same
/// double; bytes depend on the arguments alone.
/// @param centerline  points along it from start to finish [m]; 2 or more, in one vertical plane
/// @throws InputError as write_mesh(), or if there are fewer than two centerline points, one is not finite or
///         lies beside their plane by more than 1e-9 of the size of the coordinates
/// @throws FileError as AtomicFile
/// @throws Interrupted if options.stop asks for it
void write_scad(const std::filesystem::path& file, const TriangleMesh& mesh,
                const std::vector<Vec3>& centerline, const ScadFileOptions& options = {});

}  // namespace glissade
