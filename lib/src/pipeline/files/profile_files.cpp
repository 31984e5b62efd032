#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/pipeline/profile_drawing.hpp"

#include "pipeline/files/owned_files.hpp"
#include "pipeline/files/read_files.hpp"
#include "pipeline/files/staging.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

using namespace pipeline;

std::vector<std::filesystem::path> write_profile(const std::filesystem::path& directory, const Design& design,
                                                 const Track& track, const ProfileOptions& options) {
  const std::vector<ProfileStation> stations = coordinate_table(design, track, options);
  const Drawing drawing = longitudinal_section(design, track, options);
  const std::vector<Sheet> sheets = profile_sheets(design, track, options);
  const std::optional<Drawing> section = cross_section_drawing(design);
  const std::string stem = design.file.empty() ? std::string("design") : design.file.stem().string();
  // An owner of its own: a build into the same directory has other files.
  const std::string owner = stem + ".section";
  const std::string dxf = stem + ".section.dxf";
  const std::string pdf = stem + ".section.pdf";
  const std::string csv = stem + ".coordinates.csv";
  const std::string section_dxf = stem + ".cross-section.dxf";
  std::vector<std::string> names = {OwnedFiles::list_name(owner), dxf, pdf, csv};
  if (section) names.push_back(section_dxf);
  require_none_read(design, directory, names);
  Staging staging(directory, owner, design.file);
  using Path = std::filesystem::path;
  staging.keep([&](const Path& file) { return is_read_by(design, file); });
  staging.make(dxf, [&](const Path& file) { write_dxf(file, drawing); });
  const std::string title = design.name.empty() ? stem : design.name;
  staging.make(pdf, [&](const Path& file) { write_pdf(file, sheets, title); });
  staging.make(csv, [&](const Path& file) { write_coordinates_csv(file, stations, options); });
  if (section) staging.make(section_dxf, [&](const Path& file) { write_dxf(file, *section); });
  return staging.publish().files;
}

}  // namespace glissade
