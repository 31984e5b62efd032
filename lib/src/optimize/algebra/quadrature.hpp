#pragma once

#include <array>
#include <cstddef>

namespace glissade::optimizer {

inline constexpr std::size_t kNodes = 6;  // theory: exact to degree 11

/// Gauss-Legendre nodes on (0, 1), their weights, and the matrix that integrates the interpolating polynomial
/// from 0 to each node.
struct PanelRule {
  std::array<double, kNodes> node{};
  std::array<double, kNodes> weight{};
  std::array<std::array<double, kNodes>, kNodes> to_node{};  ///< [node][value]
};

[[nodiscard]] const PanelRule& panel_rule();

}  // namespace glissade::optimizer
