#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/trades/rules.hpp"

#include <string>
#include <vector>

namespace glissade::app {

/// What rules say of a track, for its summary: how many are kept, and every one that is not; empty without rules.
[[nodiscard]] std::string rules_lines(const std::vector<Judgement>& judgements);

/// Every rule with its verdict, value and place.
[[nodiscard]] std::string verdicts_table(const std::vector<Judgement>& judgements);

/// Every rule of the shop with its verdict, value and place.
[[nodiscard]] std::string shop_table(const std::vector<ShopCheck>& checks);

/// A rule as it stands in its file: bound, sentence, source and how sure that is.
[[nodiscard]] std::string rule_text(const Rule& rule);

/// Every quantity that a rule may bound, with its unit.
[[nodiscard]] std::string quantities_table();

}  // namespace glissade::app
