#pragma once

#include "glissade/core/units.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "io/byte_source.hpp"
#include "io/reading.hpp"

#include <string>

namespace glissade::io {

/// read_mesh() for bytes from anywhere.
/// @param name  of the file, for messages
/// @throws FileError as read_mesh()
[[nodiscard]] TriangleMesh read_mesh_bytes(ByteSource& source, const std::string& name, LengthUnit unit);

/// One reader a format; each starts at the first byte of the file.
/// @throws FileError if the file is not of that format
[[nodiscard]] TriangleMesh read_stl_binary(Reading& reading);
[[nodiscard]] TriangleMesh read_stl_ascii(Reading& reading);
[[nodiscard]] TriangleMesh read_off(Reading& reading);

}  // namespace glissade::io
