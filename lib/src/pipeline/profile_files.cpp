#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/pipeline/profile_drawing.hpp"

#include "pipeline/staging.hpp"

#include <optional>
#include <string>

namespace glissade {

using namespace pipeline;

std::vector<std::filesystem::path> write_profile(const std::filesystem::path& directory, const Design& design,
                                                 const Track& track, const ProfileOptions& options) {
  const std::vector<ProfileStation> stations = coordinate_table(design, track, options);
  const Drawing drawing = longitudinal_section(design, track, options);
  const std::vector<Sheet> sheets = profile_sheets(design, track, options);
  const std::string stem = design.file.empty() ? std::string("design") : design.file.stem().string();
  // An owner of its own: a build into the same directory has other files.
  Staging staging(directory, stem + ".section", design.file);
  using Path = std::filesystem::path;
  staging.make(stem + ".section.dxf", [&](const Path& file) { write_dxf(file, drawing); });
  const std::string title = design.name.empty() ? stem : design.name;
  staging.make(stem + ".section.pdf", [&](const Path& file) { write_pdf(file, sheets, title); });
  staging.make(stem + ".coordinates.csv",
               [&](const Path& file) { write_coordinates_csv(file, stations, options); });
  if (const std::optional<Drawing> section = cross_section_drawing(design)) {
    staging.make(stem + ".cross-section.dxf", [&](const Path& file) { write_dxf(file, *section); });
  }
  return staging.publish().files;
}

}  // namespace glissade
