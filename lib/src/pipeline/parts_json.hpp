#pragma once

#include "glissade/parts/plates.hpp"

#include "report/serial/vocabulary.hpp"

#include <string>

namespace glissade::pipeline {

/// Adds master_curve, parts, as_built, shop_checks and parts_volume_m3; null each where nothing is fabricated.
/// @param stem  of the files' names
void add_parts(report::Json& json, const PlateBuild* build, const std::string& stem);

}  // namespace glissade::pipeline
