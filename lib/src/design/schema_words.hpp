#pragma once

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {

template <typename Meaning>
using Words = std::vector<std::pair<std::string_view, Meaning>>;

[[nodiscard]] const Words<CenterlineKind>& centerline_words();
/// Each kind without its measures.
[[nodiscard]] const Words<CrossSectionDesign>& cross_section_words();
[[nodiscard]] const Words<LengthUnit>& length_unit_words();
[[nodiscard]] const Words<MeshFrame>& mesh_frame_words();
[[nodiscard]] const Words<DxfVersion>& dxf_version_words();
[[nodiscard]] const Words<LayerPreset>& layer_words();
[[nodiscard]] const Words<TemplatePaper>& paper_words();

/// What a word of `export` asks for: a file of the solid, one of the parts, or all of the parts.
struct ExportWord {
  std::optional<ExportFormat> solid;
  std::optional<WorkshopFormat> parts;  ///< with `solid` none: all of them
};
[[nodiscard]] const Words<ExportWord>& export_words();

/// @throws InternalError if no word means that
template <typename Meaning>
[[nodiscard]] std::string_view word_of(Meaning meaning, const Words<Meaning>& words) {
  for (const auto& [text, value] : words) {
    if (value == meaning) return text;
  }
  throw InternalError({"", "a value of the design schema without a word", "", ""});
}

}  // namespace glissade::design_file
