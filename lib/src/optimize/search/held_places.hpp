#pragma once

#include "optimize/algebra/dense.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <utility>

namespace glissade::optimizer {

/// Places at which limits are held beside the stations of a mesh, of the core's length.
class HeldPlaces {
 public:
  /// @param places  held already
  explicit HeldPlaces(Vector places) : places_(std::move(places)) {}

  /// A place close to one that is held already takes its part: limits are touched there now.
  /// @param sigma  left out where it lies outside the knots
  /// @param knots  of the mesh, whose pieces tell what is close
  void add(double sigma, const Vector& knots);
  [[nodiscard]] const Vector& places() const { return places_; }

 private:
  Vector places_;
};

/// A track that follows such a limit breaks it a little in every piece, between any places where it is
/// held, since a linear curvature does not follow it. Tightening takes less than that already leaves.
[[nodiscard]] bool is_highest_load(const LimitSpec& limit);

}  // namespace glissade::optimizer
