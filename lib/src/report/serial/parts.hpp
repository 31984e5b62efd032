#pragma once

#include "glissade/parts/workshop_build.hpp"

#include "report/serial/vocabulary.hpp"

#include <string>
#include <vector>

namespace glissade::report {

/// What rules of the shop say of parts.
[[nodiscard]] Json shop_checks_json(const std::vector<ShopCheck>& checks);

/// Adds master_curve, parts, as_built, shop_checks and parts_volume_m3; null each where nothing is fabricated.
void add_parts(Json& json, const WorkshopBuild* build);

}  // namespace glissade::report
