// The files that a workshop gets of the parts of a build.

#include "pipeline/build/workshop_files.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/drawing/workshop_drawings.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/dxf_file.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/io/three_mf_file.hpp"
#include "glissade/io/workshop_tables.hpp"

#include "pipeline/build/fabricate.hpp"
#include "pipeline/files/formats.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr double kSmallFile = 0.02;  // of what a mesh file costs

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
  file.write = [shared](const fs::path& path, const std::stop_token&) { write_atomically(path, *shared); };
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
    write_atomically(path, *text);
  };
  file.read_back = [text](const fs::path& path, const std::stop_token&) { require_same_text(path, *text); };
  return file;
}

/// Every sheet of stock with what is cut from it, and their table.
void add_nests(const Design& design, const WorkshopBuild& build, std::vector<PendingFile>& files) {
  for (const NestedSheet& sheet : build.nests) {
    files.push_back(dxf_file(sheet.file, nest_drawing(build.workshop, sheet, design.exports.layers),
                             {design.exports.dxf_version}));
  }
  if (!build.nests.empty())
    files.push_back(table(stem_of(design) + ".nests.csv", nests_csv(build.workshop, build.nests)));
}

/// Every piece of a print on its bed.
PendingFile three_mf_of(std::string name, std::vector<PrintPiece> laid, const std::string& title) {
  const auto pieces = std::make_shared<const std::vector<PrintPiece>>(std::move(laid));
  PendingFile file;
  file.name = std::move(name);
  file.cost = 0.2;
  file.write = [pieces, title](const fs::path& path, const std::stop_token& stop) {
    write_three_mf(path, *pieces, title, stop);
  };
  file.read_back = [pieces](const fs::path& path, const std::stop_token&) {
    require_same_three_mf(path, *pieces);
  };
  return file;
}

/// One piece as it lies on a bed, in binary STL.
PendingFile stl_of(std::string name, const TriangleMesh& mesh, LengthUnit unit,
                   const std::stop_token& asked) {
  const auto rounded =
      std::make_shared<const TriangleMesh>(as_written(mesh, MeshFormat::stl_binary, unit, asked));
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

/// @return the sheets that a process cuts its parts from; none of prints
std::optional<NestStock> stock_of(const FabricationDesign& fabrication) {
  if (const auto* const plate = std::get_if<PlateOptions>(&fabrication.process)) return plate->split.stock();
  if (const auto* const timber = std::get_if<TimberOptions>(&fabrication.process))
    return timber->split.stock();
  return std::nullopt;
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
  if (build->template_pages.roll > 0) {
    files.push_back(
        pdf_of(stem + ".templates.pdf", build,
               [paper = design.exports.paper](const Workshop& shop) { return templates(shop, paper); }));
  }
}

void add_prints(const Design& design, const std::shared_ptr<const WorkshopBuild>& build,
                const std::stop_token& stop, std::vector<PendingFile>& files) {
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
    files.push_back(
        stl_of(part_stem(stem_of(design), part) + ".stl", piece->mesh, design.exports.unit, stop));
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

namespace {

constexpr std::size_t kManySheets = 3;  // taste: of one stock; what is left over of fewer is no matter
constexpr double kLittleUsed = 0.25;    // taste: of a sheet

/// Whether a part is a frame, ring or stiffener that is whole: of pieces the name ends with a letter.
bool is_whole_frame(const ShopPart& part) {
  const std::size_t digits = part.name.find_last_not_of("_0123456789") + 1;
  const std::string family = part.name.substr(0, digits);
  return family == "end_frame" || family == "end_frame_loose" || family == "pipe_flange" ||
         family == "pipe_flange_loose" || family == "trough_flange" || family == "trough_flange_loose" ||
         family == "stiffener";
}

/// Says of which stock less would be left over of frames in pieces.
void note_left_over(WorkshopBuild& build) {
  for (const StockGroup& group : by_stock(build.nests)) {
    const NestedSheet& first = group.sheets.front();
    const bool whole = std::any_of(group.sheets.begin(), group.sheets.end(), [&](const NestedSheet& sheet) {
      return std::any_of(sheet.pieces.begin(), sheet.pieces.end(), [&](const NestedPiece& piece) {
        return is_whole_frame(build.workshop.parts[piece.part]);
      });
    });
    if (group.sheets.size() < kManySheets || group.utilisation >= kLittleUsed || !whole) continue;
    build.workshop.notes.push_back(
        std::to_string(group.sheets.size()) + " sheets of " + first.material + ", " +
        length_text(first.thickness) + ", are " + rounded_text(100.0 * group.utilisation, 2) +
        " % used: less would be left over of frames in pieces, split: {frames: 3}.");
  }
}

}  // namespace

void lay_on_sheets(const Design& design, WorkshopBuild& build) {
  const auto stock = stock_of(*design.fabrication);
  if (!stock || !Choice(design)(WorkshopFormat::nests)) return;
  build.nests = nest(build.workshop, *stock);
  note_left_over(build);
  for (NestedSheet& sheet : build.nests) sheet.file = stem_of(design) + ".nests/" + sheet.name + ".dxf";
}

void count_templates(const Design& design, WorkshopBuild& build) {
  if (!Choice(design)(WorkshopFormat::templates)) return;
  for (const ShopPart& part : build.workshop.parts) {
    if (!wants_template(part)) continue;
    const TemplatePages pages = template_pages(part);
    build.template_pages.a4 += pages.a4;
    build.template_pages.a3 += pages.a3;
    build.template_pages.roll += pages.roll;
  }
}

std::vector<PendingFile> workshop_files(const Design& design,
                                        const std::shared_ptr<const WorkshopBuild>& build,
                                        const std::stop_token& stop) {
  const Choice wanted(design);
  const std::string stem = stem_of(design);
  const Workshop& workshop = build->workshop;
  std::vector<PendingFile> files;
  add_part_files(design, build, files);
  if (wanted(WorkshopFormat::step))
    files.push_back(step_of(stem + ".step", std::shared_ptr<const Workshop>(build, &workshop)));
  add_prints(design, build, stop, files);
  add_sheets(design, build, files);
  if (wanted(WorkshopFormat::nests)) add_nests(design, *build, files);
  if (wanted(WorkshopFormat::tables)) add_tables(stem, workshop, files);
  return files;
}

}  // namespace glissade::pipeline
