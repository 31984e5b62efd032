#include "design/schema_words.hpp"

#include <cstddef>
#include <utility>
#include <variant>

namespace glissade {
namespace design_file {

const Words<CenterlineKind>& centerline_words() {
  static const Words<CenterlineKind> words = {
      {"fastest", CenterlineKind::fastest},
      {"constant-speed", CenterlineKind::constant_speed},
      {"straight", CenterlineKind::straight},
      {"cycloid", CenterlineKind::cycloid},
      {"no-curvature-load", CenterlineKind::no_curvature_load},
      {"segments", CenterlineKind::segments},
      {"points", CenterlineKind::points},
      {"in-run", CenterlineKind::in_run},
  };
  return words;
}

namespace {

template <std::size_t... kIndices>
Words<CrossSectionDesign> words_of_sections(std::index_sequence<kIndices...>) {
  return {{std::variant_alternative_t<kIndices, CrossSectionDesign>::kKind,
           std::variant_alternative_t<kIndices, CrossSectionDesign>()}...};
}

}  // namespace

const Words<CrossSectionDesign>& cross_section_words() {
  static const Words<CrossSectionDesign> words =
      words_of_sections(std::make_index_sequence<std::variant_size_v<CrossSectionDesign>>());
  return words;
}

const Words<ExportWord>& export_words() {
  static const Words<ExportWord> words = [] {
    Words<ExportWord> all;
    for (const FileFormat& row : kFileFormats) all.emplace_back(row.word, ExportWord{row.format, {}});
    all.emplace_back("workshop", ExportWord{});
    for (const WorkshopFile& row : kWorkshopFiles) all.emplace_back(row.word, ExportWord{{}, row.format});
    return all;
  }();
  return words;
}

const Words<LengthUnit>& length_unit_words() {
  static const Words<LengthUnit> words = {{"mm", LengthUnit::millimetre}, {"m", LengthUnit::metre}};
  return words;
}

const Words<MeshFrame>& mesh_frame_words() {
  static const Words<MeshFrame> words = {{"local", MeshFrame::local}, {"site", MeshFrame::site}};
  return words;
}

const Words<DxfVersion>& dxf_version_words() {
  static const Words<DxfVersion> words = {{"r2000", DxfVersion::r2000}, {"r12", DxfVersion::r12}};
  return words;
}

const Words<LayerPreset>& layer_words() {
  static const Words<LayerPreset> words = {{"own", LayerPreset::own},
                                           {"plain", LayerPreset::plain},
                                           {"inventor", LayerPreset::inventor},
                                           {"sendcutsend", LayerPreset::sendcutsend}};
  return words;
}

const Words<TemplatePaper>& paper_words() {
  static const Words<TemplatePaper> words = {
      {"a4", TemplatePaper::a4}, {"a3", TemplatePaper::a3}, {"roll", TemplatePaper::roll}};
  return words;
}

}  // namespace design_file

std::string_view word(CenterlineKind kind) {
  return design_file::word_of(kind, design_file::centerline_words());
}

std::optional<CenterlineKind> centerline_kind(std::string_view word) {
  for (const auto& [text, kind] : design_file::centerline_words()) {
    if (text == word) return kind;
  }
  return {};
}

bool is_drawn(CenterlineKind kind) {
  return kind == CenterlineKind::segments || kind == CenterlineKind::points || kind == CenterlineKind::in_run;
}

const std::vector<CenterlineKind>& centerline_kinds() {
  static const std::vector<CenterlineKind> kinds = [] {
    std::vector<CenterlineKind> all;
    for (const auto& [text, kind] : design_file::centerline_words()) all.push_back(kind);
    return all;
  }();
  return kinds;
}

}  // namespace glissade
