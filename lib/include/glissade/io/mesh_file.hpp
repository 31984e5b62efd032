#pragma once

#include "glissade/core/units.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

namespace glissade {

enum class MeshFormat { stl_binary, stl_ascii, off };

/// How a mesh is written: unit, frame, name.
struct MeshFileOptions {
  LengthUnit unit = LengthUnit::millimetre;
  /// Where the file's origin lies in the frame of the site [m], for the header or comment that says so; none: the
  /// file's frame is that of the site.
  std::optional<Vec3> offset = {};
  /// Of the solid, for a header or comment; control characters become spaces, what does not fit is cut off.
  std::string name;
  std::stop_token stop = {};  ///< ends the writing within some milliseconds; the target stays untouched
};

/// Writes a mesh beside the target and renames it into place: the target is either complete or untouched.
///
/// Bytes depend on the arguments alone, never on locale or clock. Text holds every double exactly as its
/// shortest decimal; binary STL holds the coordinates of as_written(). Facet normals in STL are those of the
/// coordinates written, (0, 0, 0) where a facet has no area. docs/files.md describes each format.
/// @throws FileError as AtomicFile
/// @throws InputError if there are no triangles, one names a vertex that does not exist, a coordinate is not finite or
///         does not fit the format, and as as_written()
/// @throws Interrupted if options.stop asks for it
void write_mesh(const std::filesystem::path& file, MeshFormat format, const TriangleMesh& mesh,
                const MeshFileOptions& options = {});

/// The mesh exactly as a reader of the file will see it: coordinates rounded to what the format holds, in
/// metres again.
///
/// Binary STL: each coordinate becomes the nearest single-precision number; where that would put two vertices
/// that are apart at one position, the one of higher number goes to the nearest free of the eight
/// single-precision points around it, at most one step away on every axis. Text formats in millimetres:
/// within one unit in the last place of the double, in metres exactly. Rounding moves what is thinner than
/// some steps into itself: measure() the result. Identity: as_written(as_written(m)) == as_written(m).
/// @return same vertices and triangles in the same order
/// @throws InputError if single precision cannot keep two vertices apart or turns a facet by more than
///         45 deg (names the size at which it does not), or if a coordinate does not fit the format
/// @throws Interrupted if `stop` asks for it
[[nodiscard]] TriangleMesh as_written(const TriangleMesh& mesh, MeshFormat format, LengthUnit unit,
                                      const std::stop_token& stop = {});

/// Reads STL (binary or ASCII, told apart by content) or OFF.
///
/// STL: vertices at equal positions become one, in the order of their first appearance. OFF: vertices stay as
/// they are; polygons of more than three corners become triangles; colours and normals are skipped.
/// @throws FileError if the file cannot be read, is of neither format, is truncated, has coordinates that are
///         not finite or beyond kLargestMeshCoordinate, is smaller than kSmallestMeshSize, or counts that its size cannot hold; says where
/// @throws Interrupted if `stop` asks for it
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& file,
                                     LengthUnit unit = LengthUnit::millimetre,
                                     const std::stop_token& stop = {});

}  // namespace glissade
