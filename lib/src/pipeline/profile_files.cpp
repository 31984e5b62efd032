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
  write_dxf(staging.path_for(stem + ".section.dxf"), drawing);
  write_pdf(staging.path_for(stem + ".section.pdf"), sheets, design.name.empty() ? stem : design.name);
  write_coordinates_csv(staging.path_for(stem + ".coordinates.csv"), stations, options);
  if (const std::optional<Drawing> section = cross_section_drawing(design))
    write_dxf(staging.path_for(stem + ".cross-section.dxf"), *section);
  return staging.publish().files;
}

}  // namespace glissade
