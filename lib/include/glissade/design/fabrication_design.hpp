#pragma once

#include "glissade/core/workshop_format.hpp"
#include "glissade/design/rules_design.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/parts/print_options.hpp"
#include "glissade/parts/timber_options.hpp"

#include <string_view>
#include <variant>

namespace glissade {

/// How a workshop makes the track: `fabrication` of a design file. Each process names itself (`kProcess`) and the arc
/// tolerance that suits it (`kArcTolerance` [m]).
struct FabricationDesign {
  double arc_tolerance =
      PlateOptions::kArcTolerance;  ///< greatest distance between the track and its arcs [m]; > 0
  std::variant<PlateOptions, PrintOptions, TimberOptions> process;
  RulesDesign rules;  ///< of the shop: without `sets` the set that is named "shop-" and the process

  friend bool operator==(const FabricationDesign&, const FabricationDesign&) = default;
};

/// @return the word of its process: "plate"
[[nodiscard]] std::string_view process_word(const FabricationDesign& design);

/// @return whether a process has such files at all: patterns are of plates, meshes of prints
[[nodiscard]] bool fits(WorkshopFormat format, const FabricationDesign& design);

}  // namespace glissade
