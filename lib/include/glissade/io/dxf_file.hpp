#pragma once

#include "glissade/core/workshop_format.hpp"
#include "glissade/drawing/drawing.hpp"

#include <filesystem>
#include <string>

namespace glissade {

/// How a DXF file is written.
struct DxfOptions {
  DxfVersion version = DxfVersion::r2000;
};

/// A drawing as DXF: 1:1, millimetres declared, one entity a path in R2000, one a piece in R12; circles as CIRCLE,
/// texts as TEXT, dimensions as lines and TEXT. Nothing is flattened, nothing is a spline.
///
/// Bytes depend on the arguments alone. Numbers are the shortest decimals that read back as the same doubles; other
/// characters than ASCII become `\U+xxxx`; control characters become spaces.
/// @throws InputError if a coordinate is not finite, an entity names a layer that does not exist, two layers have one
///         name, or a layer's name has other characters than ASCII letters, digits, "_" and "-"
[[nodiscard]] std::string dxf_text(const Drawing& drawing, const DxfOptions& options = {});

/// Writes dxf_text() beside the target and renames it into place.
/// @throws FileError as AtomicFile; InputError as dxf_text()
void write_dxf(const std::filesystem::path& file, const Drawing& drawing, const DxfOptions& options = {});

/// Reads the entities LWPOLYLINE, LINE, ARC, CIRCLE and TEXT of a DXF file in millimetres; the rest is skipped. Layers are
/// those of its table with names, colours and line types.
/// @throws FileError if the file cannot be read, is no text DXF, is cut off, declares another unit than millimetres, or has
///         a number that is none; says the line
[[nodiscard]] Drawing read_dxf(const std::filesystem::path& file);

/// Holds a DXF file against the drawing that it was written from: every entity, every number.
/// @throws InternalError if anything differs; FileError as read_dxf()
void require_same_dxf(const std::filesystem::path& file, const Drawing& drawing,
                      const DxfOptions& options = {});

}  // namespace glissade
