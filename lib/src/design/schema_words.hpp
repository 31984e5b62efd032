#pragma once

#include "glissade/design/design.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {

template <typename Meaning>
using Words = std::vector<std::pair<std::string_view, Meaning>>;

[[nodiscard]] const Words<CenterlineKind>& centerline_words();
/// Each kind without its measures.
[[nodiscard]] const Words<CrossSectionDesign>& cross_section_words();
[[nodiscard]] const Words<ExportFormat>& export_words();
[[nodiscard]] const Words<LengthUnit>& length_unit_words();
[[nodiscard]] const Words<MeshFrame>& mesh_frame_words();

}  // namespace glissade::design_file
