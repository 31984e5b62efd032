#pragma once

#include "glissade/parts/shop_part.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// One rule of a shop: a value must not be below (or above) a bound.
struct ShopRule {
  const char* name;
  bool at_least;       ///< else: at most
  ShopVerdict broken;  ///< what a breach is
  const char* source;
};

/// The worst value that a rule met.
class ShopCase {
 public:
  explicit ShopCase(const ShopRule& rule) : rule_(rule) {}

  /// @param text  writes a value or bound with its unit
  void see(double value, double bound, const std::string& where, std::string (*text)(double));
  void add_to(std::vector<ShopCheck>& checks) const {
    if (seen_) checks.push_back(check_);
  }

 private:
  ShopRule rule_;
  bool seen_ = false;
  double room_ = 0.0;
  ShopCheck check_;
};

/// A rule that met one value alone.
void add_check(std::vector<ShopCheck>& checks, const ShopRule& rule, double value, double bound,
               const std::string& where, std::string (*text)(double));

}  // namespace glissade::parts
