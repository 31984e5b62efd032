#pragma once

#include "parts/print_split.hpp"
#include "parts/print_unit.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// The rules of printing, held against the pieces.
[[nodiscard]] std::vector<ShopCheck> print_checks(const PrintJob& job, const std::vector<PrintUnit>& units,
                                                  const std::optional<Dowels>& dowels);

}  // namespace glissade::parts
