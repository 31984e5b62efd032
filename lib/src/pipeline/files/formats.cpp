#include "pipeline/files/formats.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/scad_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

// As shares of time measured on meshes of 0.25 and 1 million triangles, one check of a mesh being 5.
constexpr double kMeshFileCost = 1.0;
constexpr double kTableCost = 0.1;

template <MeshFormat kFormat>
void write_facets(const fs::path& file, const SolidForFiles& solid, const TriangleMesh& mesh,
                  const std::stop_token& stop) {
  // Rounding the rounded mesh again changes nothing, and takes far less time.
  write_mesh(file, kFormat, mesh, {solid.unit, solid.offset, solid.name, stop});
}

void write_program(const fs::path& file, const SolidForFiles& solid, const TriangleMesh&,
                   const std::stop_token& stop) {
  write_scad(file, solid.exact, solid.centerline,
             {solid.unit, solid.name, solid.offset, solid.section, stop});
}

void write_stations(const fs::path& file, const SolidForFiles& solid, const TriangleMesh&,
                    const std::stop_token&) {
  write_stations_csv(file, solid.stations);
}

constexpr std::array<FormatWriter, kFileFormats.size()> kWriters = {{
    {ExportFormat::stl, MeshFormat::stl_binary, write_facets<MeshFormat::stl_binary>, true, kMeshFileCost},
    {ExportFormat::stl_ascii, MeshFormat::stl_ascii, write_facets<MeshFormat::stl_ascii>, true,
     kMeshFileCost},
    {ExportFormat::off, MeshFormat::off, write_facets<MeshFormat::off>, true, kMeshFileCost},
    // An OpenSCAD program holds every double exactly, as OFF does.
    {ExportFormat::scad, MeshFormat::off, write_program, false, kMeshFileCost},
    {ExportFormat::csv, std::nullopt, write_stations, false, kTableCost},
}};

constexpr bool tables_agree() {
  for (std::size_t i = 0; i < kFileFormats.size(); ++i) {
    const auto format = static_cast<ExportFormat>(i);
    if (kFileFormats[i].format != format || kWriters[i].format != format) return false;
    if ((kFileFormats[i].content == FileContent::stations) == kWriters[i].rounding.has_value()) return false;
    const bool rounds = kFileFormats[i].content == FileContent::rounded_mesh;
    if (rounds != (kWriters[i].rounding == MeshFormat::stl_binary)) return false;
  }
  return true;
}
static_assert(tables_agree(), "both tables have a row for each format, in the order of the enumeration");

}  // namespace

const FormatWriter& format_writer(ExportFormat format) {
  return kWriters[static_cast<std::size_t>(format)];
}

std::string file_name(const std::string& stem, ExportFormat format,
                      const std::vector<ExportFormat>& formats) {
  const FileFormat& row = file_format(format);
  const bool taken = std::any_of(formats.begin(), formats.end(), [&](ExportFormat other) {
    return other < format && file_format(other).ending == row.ending;
  });
  return stem + std::string(taken ? row.ending_beside : row.ending);
}

void require_same_on_disk(const fs::path& file, const TriangleMesh& expected, LengthUnit unit,
                          const std::stop_token& stop) {
  const TriangleMesh found = read_mesh(file, unit, stop);
  bool same = found.triangles.size() == expected.triangles.size() &&
              found.vertices.size() == expected.vertices.size();
  for (std::size_t facet = 0; same && facet < expected.triangles.size(); ++facet) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      same = same && found.vertices[found.triangles[facet][corner]] ==
                         expected.vertices[expected.triangles[facet][corner]];
    }
  }
  if (!same) {
    throw InternalError(
        {file.filename().string(), "the file read back differs from what was written", "", ""});
  }
}

}  // namespace glissade::pipeline
