#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace glissade {

/// What a design can ask for in `export` beside the files of the solid: files of the parts that its `fabrication` makes.
enum class WorkshopFormat { dxf, step, pdf, svg, tables, nests, templates, three_mf, stl_parts };

/// Every one of them with the word that a design file uses, in the order of the enumeration.
struct WorkshopFile {
  WorkshopFormat format = WorkshopFormat::dxf;
  std::string_view word;
  std::string_view holds;  ///< in words
};
inline constexpr std::array<WorkshopFile, 9> kWorkshopFiles = {{
    {WorkshopFormat::dxf, "dxf", "a flat pattern a part"},
    {WorkshopFormat::step, "step", "a solid a part, and the assembly"},
    {WorkshopFormat::pdf, "pdf", "the set of drawings"},
    {WorkshopFormat::svg, "svg", "the set of drawings, a file a sheet"},
    {WorkshopFormat::tables, "tables", "lists as CSV"},
    {WorkshopFormat::nests, "nests", "patterns laid out on stock sheets, as DXF"},
    {WorkshopFormat::templates, "templates", "patterns 1:1 on paper, as PDF"},
    {WorkshopFormat::three_mf, "3mf", "the pieces laid out on printer beds"},
    {WorkshopFormat::stl_parts, "stl-parts", "a mesh a piece"},
}};

/// @return the word that a design file uses, e.g. "stl-parts"
[[nodiscard]] constexpr std::string_view word(WorkshopFormat format) {
  return kWorkshopFiles[static_cast<std::size_t>(format)].word;
}

/// Which DXF: AutoCAD 2000 (AC1015), its paths closed LWPOLYLINEs with bulges; or release 12 (AC1009) for old cutters,
/// its paths LINE and ARC.
enum class DxfVersion { r2000, r12 };

/// How the layers of a cutting file are named. `own`: CUT, MARK, BEND_UP, BEND_DOWN, ROLL. `plain`: all on layer 0, told apart
/// by colour. `inventor`: IV_OUTER_PROFILE and its like. `sendcutsend`: one contour, bends dashed, nothing else, all on
/// layer 0.
enum class LayerPreset { own, plain, inventor, sendcutsend };

/// What 1:1 templates are printed on: tiled sheets, or one length of a roll a part.
enum class TemplatePaper { a4, a3, roll };

}  // namespace glissade
