#pragma once

#include "glissade/design/design.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace glissade {

enum class MeshFormat { stl_binary, stl_ascii, off };

struct MeshFileOptions {
  LengthUnit unit = LengthUnit::millimetre;
  std::string name;  ///< of the solid, for a header or comment; control characters become spaces
};

/// Writes a mesh beside the target and renames it into place: the target is either complete or untouched.
/// Bytes depend on the arguments alone.
/// @throws FileError if the directory cannot be written, the disk is full, or the target is a directory
void write_mesh(const std::filesystem::path& file, MeshFormat format, const TriangleMesh& mesh,
                const MeshFileOptions& options = {});

/// @return `mesh` exactly as a reader of the file will see it: coordinates rounded to what the format holds,
/// in
///         metres again, vertices that are distinct kept distinct
/// @throws InputError if rounding cannot keep two vertices apart (names the size at which it can)
[[nodiscard]] TriangleMesh as_written(const TriangleMesh& mesh, MeshFormat format, LengthUnit unit);

/// Reads STL (binary or ASCII, told apart by content) or OFF; vertices at equal positions become one.
/// @throws FileError if the file cannot be read, is of neither format, is truncated, has coordinates that are
/// not
///         finite, or counts that its size cannot hold; says where
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& file,
                                     LengthUnit unit = LengthUnit::millimetre);

}  // namespace glissade
