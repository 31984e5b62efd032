#pragma once

#include "glissade/core/file_format.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/stations_csv.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// What the files of one solid are written from. Shared by them: a mesh is held once.
struct SolidForFiles {
  std::string name;     ///< of the design, for headers
  std::string section;  ///< the cross-section in words, for a comment
  LengthUnit unit = LengthUnit::millimetre;
  std::optional<Vec3> offset;    ///< of the files' origin in the frame of the site [m]
  TriangleMesh exact;            ///< in double precision
  std::vector<Vec3> centerline;  ///< in the frame of the mesh [m]
  StationTable stations;
};

/// How one format gets its bytes, and how they are proven. A new format is a row here, a row of kFileFormats and a
/// writer in io/.
struct FormatWriter {
  ExportFormat format;
  /// How the file rounds the mesh that it holds; none where it holds none.
  std::optional<MeshFormat> rounding;
  /// @param mesh  as rounded for this format
  void (*write)(const std::filesystem::path& file, const SolidForFiles& solid, const TriangleMesh& mesh,
                const std::stop_token& stop);
  /// Whether read_mesh() reads it: the file is then held against the mesh facet by facet.
  bool read_back;
  double cost;  ///< of writing and reading back, for progress
};

/// @return the table's row of a format
[[nodiscard]] const FormatWriter& format_writer(ExportFormat format);

/// Name of a file of a set.
/// @param formats  of the whole set: where two have the same ending, the later row of kFileFormats gets another
[[nodiscard]] std::string file_name(const std::string& stem, ExportFormat format,
                                    const std::vector<ExportFormat>& formats);

/// Reads a file again and holds it against the mesh that was measured: the same facets at the same positions,
/// in the same order, so that every fact of the one is a fact of the other.
/// @throws InternalError if anything differs
void require_same_on_disk(const std::filesystem::path& file, const TriangleMesh& expected, LengthUnit unit,
                          const std::stop_token& stop);

}  // namespace glissade::pipeline
