// Parts of a design's track, by the process that it asks for.

#include "pipeline/fabricate.hpp"

#include "glissade/parts/plates.hpp"

#include "pipeline/located.hpp"
#include "pipeline/workshop_files.hpp"

#include <utility>
#include <variant>

namespace glissade::pipeline {
namespace {

/// Calls `make`; what it throws has keys below `fabrication` for places, and gets those of the file.
template <typename Make>
auto at_keys(const Design& design, Make&& make) {
  try {
    return at_place(design.where("fabrication"), std::forward<Make>(make));
  } catch (const InputError& error) {
    std::vector<Issue> issues = error.issues();
    for (Issue& issue : issues) {
      if (issue.where.find(':') == std::string::npos)
        issue.where = design.where("fabrication." + issue.where);
    }
    throw InputError(std::move(issues));
  }
}

WorkshopBuild make(const Design& design, const Track& track, const Placement& frame,
                   const PlateOptions& options) {
  return make_plates(*track.centerline, *design.cross_section, {design.fabrication->arc_tolerance}, options,
                     frame, body_of(design), design.gravity);
}

}  // namespace

std::shared_ptr<const WorkshopBuild> fabricate(const Design& design, const Track& track,
                                               const Placement& frame) {
  WorkshopBuild build = at_keys(design, [&] {
    return std::visit([&](const auto& options) { return make(design, track, frame, options); },
                      design.fabrication->process);
  });
  build.workshop.name = design.name;
  // Parts lie in the frame of the mesh files, what is set out on site in that of the site.
  const Vec3 offset = track.placement.start() - frame.start();
  for (SettingOutPoint& point : build.workshop.setting_out) point.site = point.site + offset;
  name_part_files(design, build.workshop);
  return std::make_shared<const WorkshopBuild>(std::move(build));
}

}  // namespace glissade::pipeline
