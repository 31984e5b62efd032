#pragma once

#include "glissade/parts/workshop_build.hpp"

#include "report/serial/vocabulary.hpp"

#include <string>
#include <vector>

namespace glissade::report {

/// What rules of the shop say of parts.
[[nodiscard]] Json shop_checks_json(const std::vector<ShopCheck>& checks);

/// Adds what a workshop makes, from master_curve to joints_m; null each where nothing is fabricated.
void add_parts(Json& json, const WorkshopBuild* build);

}  // namespace glissade::report
