#pragma once

#include "glissade/parts/plates.hpp"

#include "report/serial/vocabulary.hpp"

#include <string>
#include <vector>

namespace glissade::report {

/// @return names of the files of one part, relative to the directory of the build
[[nodiscard]] std::vector<std::string> part_files(const std::string& stem, const ShopPart& part);

/// Adds master_curve, parts, as_built, shop_checks and parts_volume_m3; null each where nothing is fabricated.
/// @param stem  of the files' names
void add_parts(Json& json, const PlateBuild* build, const std::string& stem);

}  // namespace glissade::report
