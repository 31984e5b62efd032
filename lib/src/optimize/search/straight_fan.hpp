#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/task/problem.hpp"

#include <vector>

namespace glissade::optimizer {

/// The straight lines that the ends of a problem leave: the one between two points, or those to a free finish, by their slope.
/// Not of a finish that is free both ways.
class StraightFan {
 public:
  explicit StraightFan(const Problem& problem);

  /// Slope angles [rad] from the flattest that the limits leave to the steepest, in even steps of some 0.35 deg at most; none where
  /// they leave none.
  [[nodiscard]] std::vector<double> slopes() const;
  [[nodiscard]] Endpoints ends_at(double slope) const;
  /// Whether nothing but this fan bounds how steep a line to a free height may be, and so how high.
  [[nodiscard]] bool is_open_above() const { return is_open_above_; }

 private:
  FinishKind finish_;
  Endpoints given_;
  double flattest_;
  double steepest_;
  bool is_open_above_ = false;
};

}  // namespace glissade::optimizer
