#include "parts/shop_rule.hpp"

#include <cmath>

namespace glissade::parts {

void ShopCase::see(double value, double bound, const std::string& where, std::string (*text)(double)) {
  const double room = rule_.at_least ? value - bound : bound - value;
  if (seen_ && room >= room_) return;
  seen_ = true;
  room_ = room;
  const bool kept = room >= -1e-9 * std::fabs(bound);
  check_ = {rule_.name,  kept ? ShopVerdict::pass : rule_.broken,
            text(value), std::string(rule_.at_least ? "at least " : "at most ") + text(bound),
            where,       rule_.source};
}

void add_check(std::vector<ShopCheck>& checks, const ShopRule& rule, double value, double bound,
               const std::string& where, std::string (*text)(double)) {
  ShopCase one(rule);
  one.see(value, bound, where, text);
  one.add_to(checks);
}

}  // namespace glissade::parts
