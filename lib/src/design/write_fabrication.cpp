#include "design/write_fabrication.hpp"

#include "design/schema_words.hpp"
#include "design/write_rules.hpp"

#include <type_traits>
#include <variant>

namespace glissade::design_file {

std::string written_material(const StockMaterial& material) {
  Group group;
  group.add("name", in_quotes(material.name));
  group.add("density", material.density, Dimension::density);
  return group.inlined();
}

std::string written_ground(const std::vector<Vec2>& ground) {
  if (ground.size() == 1) return written_quantity(ground.front().y, Dimension::length);
  return list_of(ground, point);
}

std::string written_fabrication(const FabricationDesign& design) {
  Group group;
  std::visit(
      [&](const auto& process) {
        group.add("process", std::string(std::decay_t<decltype(process)>::kProcess));
        group.add("material", written_material(process.material));
        group.add("arc_tolerance", design.arc_tolerance, Dimension::length);
        if (are_given(design.rules)) group.add("rules", written_rules(design.rules).inlined());
        add_process(group, process);
      },
      design.process);
  return group.lines();
}

std::string written_exports(const ExportDesign& design) {
  Group group;
  std::vector<std::string_view> formats;
  for (const ExportFormat format : design.formats) formats.push_back(word(format));
  if (design.whole_workshop) formats.emplace_back("workshop");
  for (const WorkshopFormat format : design.workshop) formats.push_back(word(format));
  group.add("formats", list_of(formats, [](std::string_view text) { return text; }));
  group.add("unit", std::string(unit_symbol(design.unit)));
  if (design.frame != ExportDesign{}.frame) {
    group.add("frame", design.frame == MeshFrame::local ? "local" : "site");
  }
  if (design.dxf_version != ExportDesign{}.dxf_version)
    group.add("dxf_version", std::string(word_of(design.dxf_version, dxf_version_words())));
  if (design.layers != ExportDesign{}.layers)
    group.add("layers", std::string(word_of(design.layers, layer_words())));
  if (design.paper != ExportDesign{}.paper)
    group.add("paper", std::string(word_of(design.paper, paper_words())));
  return group.lines();
}

}  // namespace glissade::design_file
