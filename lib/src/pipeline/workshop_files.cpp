// The files that a workshop gets of the parts of a build.

#include "pipeline/workshop_files.hpp"

#include "glissade/drawing/nest.hpp"
#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/io/three_mf_file.hpp"
#include "glissade/io/workshop_tables.hpp"

#include "parts/plate_joints.hpp"
#include "pipeline/fabricate.hpp"
#include "pipeline/formats.hpp"

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

PendingFile dxf_file(std::string name, Drawing meant, const DxfOptions& options) {
  const auto drawing = std::make_shared<const Drawing>(std::move(meant));
  PendingFile file;
  file.name = std::move(name);
  file.cost = kSmallFile;
  file.write = [drawing, options](const fs::path& path, const std::stop_token&) {
    write_dxf(path, *drawing, options);
  };
  file.read_back = [drawing, options](const fs::path& path, const std::stop_token&) {
    require_same_dxf(path, *drawing, options);
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

/// Sheets as a PDF; read back by its pages.
PendingFile pdf_of(std::string name, const std::shared_ptr<const WorkshopBuild>& build,
                   std::function<std::vector<Sheet>(const Workshop&)> sheets_of) {
  PendingFile file;
  file.name = std::move(name);
  file.cost = 0.5;
  const auto text = std::make_shared<std::string>();
  file.write = [build, text, sheets_of = std::move(sheets_of)](const fs::path& path, const std::stop_token&) {
    *text = pdf_text(sheets_of(build->workshop), build->workshop.name);
    write_text(path, *text);
  };
  file.read_back = [text](const fs::path& path, const std::stop_token&) { require_same_text(path, *text); };
  return file;
}

/// Every piece that is cut from a sheet, laid out on the stock of the design.
std::vector<PendingFile> nests_of(const std::string& stem, const Workshop& workshop, const NestStock& stock,
                                  const DxfOptions& options) {
  std::vector<PendingFile> files;
  const std::vector<NestedSheet> sheets = nest(workshop, stock);
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    files.push_back(dxf_file(stem + ".nests/" + nest_stem(sheets, i) + ".dxf",
                             nest_drawing(workshop, sheets[i]), options));
  }
  if (!sheets.empty()) files.push_back(table(stem + ".nests.csv", nests_csv(workshop, sheets)));
  return files;
}

/// Every piece of a print on its bed.
PendingFile three_mf_of(std::string name, std::vector<PrintPiece> laid, const std::string& title) {
  const auto pieces = std::make_shared<const std::vector<PrintPiece>>(std::move(laid));
  PendingFile file;
  file.name = std::move(name);
  file.cost = 0.2;
  file.write = [pieces, title](const fs::path& path, const std::stop_token&) {
    write_three_mf(path, *pieces, title);
  };
  file.read_back = [pieces](const fs::path& path, const std::stop_token&) {
    require_same_three_mf(path, *pieces);
  };
  return file;
}

/// One piece as it lies on a bed, in binary STL.
PendingFile stl_of(std::string name, const TriangleMesh& mesh, LengthUnit unit) {
  const auto rounded = std::make_shared<const TriangleMesh>(as_written(mesh, MeshFormat::stl_binary, unit));
  PendingFile file;
  file.name = std::move(name);
  file.cost = kSmallFile;
  file.write = [rounded, unit, name = file.name](const fs::path& path, const std::stop_token& stop) {
    write_mesh(path, MeshFormat::stl_binary, *rounded, {unit, {}, name, stop});
  };
  file.read_back = [rounded, unit](const fs::path& path, const std::stop_token& stop) {
    require_same_on_disk(path, *rounded, unit, stop);
  };
  return file;
}

/// Stock of the design's sheets; of a process that names none, what a sheet is by default.
NestStock stock_of(const FabricationDesign& fabrication) {
  constexpr double kSpacing = 10e-3;
  constexpr double kSawCut = 4e-3;
  // Sheets of a deck keep the stock's size: no margin, and no saw between two of them.
  if (const auto* const timber = std::get_if<TimberOptions>(&fabrication.process)) {
    const Vec2 sheet = timber->split.sheet;
    return {std::max(sheet.x, sheet.y), std::min(sheet.x, sheet.y), 0.0, kSawCut};
  }
  const auto* const plate = std::get_if<PlateOptions>(&fabrication.process);
  const Vec2 sheet = plate != nullptr ? plate->split.sheet : SplitOptions{}.sheet;
  return {std::max(sheet.x, sheet.y), std::min(sheet.x, sheet.y), parts::kSheetMargin, kSpacing};
}

/// Whether a shape is worth a template: rectangles without holes are marked with a rule.
bool wants_template(const ShopPart& part) {
  if (!part.pattern) return false;
  const PlaneRegion& region = part.pattern->region;
  if (!region.holes.empty() || !region.cutouts.empty() || region.outline.vertices.size() != 4) return true;
  const PlaneBox box = bounds(region.outline);
  const double area = moments(region).area;
  return std::fabs(area - box.width() * box.height()) > 1e-9 * area;
}

std::vector<Sheet> templates(const Workshop& workshop, TemplatePaper paper) {
  std::vector<Sheet> sheets;
  for (const ShopPart& part : workshop.parts) {
    if (!wants_template(part)) continue;
    for (Sheet& sheet : part_template(workshop, part, paper)) sheets.push_back(std::move(sheet));
  }
  return sheets;
}

bool has_templates(const Workshop& workshop) {
  return std::any_of(workshop.parts.begin(), workshop.parts.end(), wants_template);
}

/// Whether meshes of single pieces are written: they are on request alone.
bool wants_single_meshes(const Design& design) {
  return design.exports.whole_workshop || !design.exports.workshop.empty();
}

std::string part_stem(const std::string& stem, const ShopPart& part) {
  return stem + ".parts/" + file_stem(part);
}

/// Which files a build of a design writes.
class Choice {
 public:
  explicit Choice(const Design& design) : design_(design) {}
  [[nodiscard]] bool operator()(WorkshopFormat format) const {
    return design_.exports.asks_for(format) && fits(format, *design_.fabrication);
  }

 private:
  const Design& design_;
};

void add_part_files(const Design& design, const std::shared_ptr<const WorkshopBuild>& build,
                    std::vector<PendingFile>& files) {
  const Choice wanted(design);
  const std::string stem = stem_of(design);
  const ExportDesign& exports = design.exports;
  for (const ShopPart& part : build->workshop.parts) {
    if (part.pattern && wanted(WorkshopFormat::dxf)) {
      files.push_back(
          dxf_file(part_stem(stem, part) + ".dxf", cut_drawing(part, exports.layers), {exports.dxf_version}));
    }
    if (wanted(WorkshopFormat::step)) {
      files.push_back(
          step_of(part_stem(stem, part) + ".step", std::shared_ptr<const ShopPart>(build, &part)));
    }
  }
}

void add_sheets(const Design& design, const std::shared_ptr<const WorkshopBuild>& build,
                std::vector<PendingFile>& files) {
  const Choice wanted(design);
  const std::string stem = stem_of(design);
  if (wanted(WorkshopFormat::pdf)) files.push_back(pdf_of(stem + ".drawings.pdf", build, drawing_set));
  if (wanted(WorkshopFormat::svg) && !design.exports.workshop.empty()) {
    const std::vector<Sheet> sheets = drawing_set(build->workshop);
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      const std::string number = (i < 9 ? "0" : "") + std::to_string(i + 1);
      files.push_back(table(stem + ".drawings/" + number + ".svg", svg_text(sheets[i])));
    }
  }
  if (wanted(WorkshopFormat::templates) && has_templates(build->workshop)) {
    files.push_back(
        pdf_of(stem + ".templates.pdf", build,
               [paper = design.exports.paper](const Workshop& shop) { return templates(shop, paper); }));
  }
}

void add_prints(const Design& design, const std::shared_ptr<const WorkshopBuild>& build,
                std::vector<PendingFile>& files) {
  const auto* const print = std::get_if<PrintOptions>(&design.fabrication->process);
  if (print == nullptr) return;
  const Choice wanted(design);
  if (wanted(WorkshopFormat::three_mf)) {
    files.push_back(three_mf_of(stem_of(design) + ".3mf", laid_on_beds(build->prints, print->split.bed),
                                build->workshop.name));
  }
  if (!wanted(WorkshopFormat::stl_parts) || !wants_single_meshes(design)) return;
  for (const ShopPart& part : build->workshop.parts) {
    const auto piece = std::find_if(build->prints.begin(), build->prints.end(), [&](const PrintPiece& one) {
      return one.number == std::to_string(part.number);
    });
    if (piece == build->prints.end()) continue;
    files.push_back(stl_of(part_stem(stem_of(design), part) + ".stl", piece->mesh, design.exports.unit));
  }
}

void add_tables(const std::string& stem, const Workshop& workshop, std::vector<PendingFile>& files) {
  files.push_back(table(stem + ".cut_list.csv", cut_list_csv(workshop)));
  if (!workshop.items.empty()) files.push_back(table(stem + ".bought_in.csv", bought_in_csv(workshop)));
  if (!workshop.bends.empty())
    files.push_back(table(stem + ".bend_schedule.csv", bend_schedule_csv(workshop)));
  files.push_back(table(stem + ".setting_out.csv", setting_out_csv(workshop)));
  files.push_back(table(stem + ".shop_checks.csv", shop_checks_csv(workshop)));
}

}  // namespace

std::string stem_of(const Design& design) {
  std::string stem = design.file.stem().string();
  return stem.empty() ? "track" : stem;
}

void name_part_files(const Design& design, Workshop& workshop) {
  const Choice wanted(design);
  for (ShopPart& part : workshop.parts) {
    const std::string name = part_stem(stem_of(design), part);
    if (part.pattern && wanted(WorkshopFormat::dxf)) part.files.push_back(name + ".dxf");
    if (wanted(WorkshopFormat::step)) part.files.push_back(name + ".step");
    if (wanted(WorkshopFormat::three_mf)) part.files.push_back(stem_of(design) + ".3mf");
    if (wanted(WorkshopFormat::stl_parts) && wants_single_meshes(design)) part.files.push_back(name + ".stl");
  }
}

std::vector<PendingFile> workshop_files(const Design& design,
                                        const std::shared_ptr<const WorkshopBuild>& build) {
  const Choice wanted(design);
  const std::string stem = stem_of(design);
  const Workshop& workshop = build->workshop;
  std::vector<PendingFile> files;
  add_part_files(design, build, files);
  if (wanted(WorkshopFormat::step))
    files.push_back(step_of(stem + ".step", std::shared_ptr<const Workshop>(build, &workshop)));
  add_prints(design, build, files);
  add_sheets(design, build, files);
  if (wanted(WorkshopFormat::nests)) {
    for (PendingFile& file :
         nests_of(stem, workshop, stock_of(*design.fabrication), {design.exports.dxf_version})) {
      files.push_back(std::move(file));
    }
  }
  if (wanted(WorkshopFormat::tables)) add_tables(stem, workshop, files);
  return files;
}

}  // namespace glissade::pipeline
