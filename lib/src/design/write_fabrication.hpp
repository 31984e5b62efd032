#pragma once

#include "glissade/design/design.hpp"

#include "design/written_text.hpp"

#include <string>
#include <vector>

namespace glissade::design_file {

/// @return what follows `fabrication:` and `export:` in a design file
[[nodiscard]] std::string written_fabrication(const FabricationDesign& design);
[[nodiscard]] std::string written_exports(const ExportDesign& design);

/// Adds the keys of one process, those that every process has excepted.
void add_process(Group& group, const PlateOptions& plate);
void add_process(Group& group, const PrintOptions& print);
void add_process(Group& group, const TimberOptions& timber);

/// Of what several processes have.
[[nodiscard]] std::string written_material(const StockMaterial& material);
/// @param ground  (x, z); one point: level
[[nodiscard]] std::string written_ground(const std::vector<Vec2>& ground);

}  // namespace glissade::design_file
