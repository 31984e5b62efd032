// Parts of a design, and the files that a workshop gets of them.

#include "pipeline/fabricate.hpp"

#include "glissade/drawing/nest.hpp"
#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/io/workshop_tables.hpp"

#include "parts/plate_joints.hpp"
#include "pipeline/located.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr double kSmallFile = 0.02;  // of what a mesh file costs

void write_text(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void require_same_text(const fs::path& path, const std::string& text) {
  std::ifstream stream(path, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(stream), {}};
  if (found != text) {
    throw InternalError(
        {path.filename().string(), "the file read back differs from what was written", "", ""});
  }
}

/// A table as a file.
PendingFile table(std::string name, std::string text) {
  const auto shared = std::make_shared<const std::string>(std::move(text));
  PendingFile file;
  file.name = std::move(name);
  file.cost = kSmallFile;
  file.write = [shared](const fs::path& path, const std::stop_token&) { write_text(path, *shared); };
  file.read_back = [shared](const fs::path& path, const std::stop_token&) {
    require_same_text(path, *shared);
  };
  return file;
}

PendingFile dxf_file(std::string name, Drawing meant) {
  const auto drawing = std::make_shared<const Drawing>(std::move(meant));
  PendingFile file;
  file.name = std::move(name);
  file.cost = kSmallFile;
  file.write = [drawing](const fs::path& path, const std::stop_token&) { write_dxf(path, *drawing); };
  file.read_back = [drawing](const fs::path& path, const std::stop_token&) {
    require_same_dxf(path, *drawing);
  };
  return file;
}

template <typename Thing>
PendingFile step_of(std::string name, std::shared_ptr<const Thing> thing) {
  PendingFile file;
  file.name = std::move(name);
  file.cost = kSmallFile;
  file.write = [thing](const fs::path& path, const std::stop_token&) { write_step(path, *thing); };
  file.read_back = [thing](const fs::path& path, const std::stop_token&) { require_same_step(path, *thing); };
  return file;
}

PendingFile drawings_of(std::string name, const std::shared_ptr<const PlateBuild>& build) {
  PendingFile file;
  file.name = std::move(name);
  file.cost = 0.5;
  file.write = [build](const fs::path& path, const std::stop_token&) {
    write_pdf(path, drawing_set(build->workshop), build->workshop.name);
  };
  return file;
}

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

/// Every piece that is cut from a sheet, laid out on the stock of the design.
std::vector<PendingFile> nests_of(const std::string& stem, const Workshop& workshop,
                                  const SplitOptions& split) {
  constexpr double kSpacing = 10e-3;
  std::vector<PendingFile> files;
  const std::vector<NestedSheet> sheets =
      nest(workshop, {std::max(split.sheet.x, split.sheet.y), std::min(split.sheet.x, split.sheet.y),
                      parts::kSheetMargin, kSpacing});
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    files.push_back(
        dxf_file(stem + ".nests/" + nest_stem(sheets, i) + ".dxf", nest_drawing(workshop, sheets[i])));
  }
  return files;
}

std::string part_stem(const std::string& stem, const ShopPart& part) {
  return stem + ".parts/" + file_stem(part);
}

}  // namespace

std::string stem_of(const Design& design) {
  std::string stem = design.file.stem().string();
  return stem.empty() ? "track" : stem;
}

std::shared_ptr<const PlateBuild> fabricate(const Design& design, const Track& track,
                                            const Placement& frame) {
  const FabricationDesign& fabrication = *design.fabrication;
  const auto channel = channel_of(*design.cross_section);
  if (!channel) {
    throw InputError({design.where("fabrication"), "fabrication: this cross-section cannot be made of plates",
                      "", "kind: u-channel"});
  }
  PlateBuild build = at_keys(design, [&] {
    return make_plates(*track.centerline, *channel, {fabrication.arc_tolerance}, fabrication.plate, frame,
                       body_of(design), design.gravity);
  });
  build.workshop.name = design.name;
  // Parts lie in the frame of the mesh files, what is set out on site in that of the site.
  const Vec3 offset = track.placement.start() - frame.start();
  for (SettingOutPoint& point : build.workshop.setting_out) point.site = point.site + offset;
  return std::make_shared<const PlateBuild>(std::move(build));
}

std::vector<PendingFile> workshop_files(const std::string& stem, const SplitOptions& split,
                                        const std::shared_ptr<const PlateBuild>& build) {
  const Workshop& workshop = build->workshop;
  std::vector<PendingFile> files;
  for (const ShopPart& part : workshop.parts) {
    if (part.pattern) files.push_back(dxf_file(part_stem(stem, part) + ".dxf", cut_drawing(part)));
    files.push_back(step_of(part_stem(stem, part) + ".step", std::shared_ptr<const ShopPart>(build, &part)));
  }
  files.push_back(step_of(stem + ".step", std::shared_ptr<const Workshop>(build, &workshop)));
  files.push_back(drawings_of(stem + ".drawings.pdf", build));
  for (PendingFile& file : nests_of(stem, workshop, split)) files.push_back(std::move(file));
  files.push_back(table(stem + ".cut_list.csv", cut_list_csv(workshop)));
  if (!workshop.items.empty()) files.push_back(table(stem + ".bought_in.csv", bought_in_csv(workshop)));
  if (!workshop.bends.empty())
    files.push_back(table(stem + ".bend_schedule.csv", bend_schedule_csv(workshop)));
  files.push_back(table(stem + ".setting_out.csv", setting_out_csv(workshop)));
  files.push_back(table(stem + ".shop_checks.csv", shop_checks_csv(workshop)));
  return files;
}

}  // namespace glissade::pipeline
