// (R5) of docs/theory.md, solved for one or the other of its quantities: a hyperbola with a focus at the start.
#include "glissade/centerline/reach.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>

namespace glissade {

double least_entry_speed(const Endpoints& endpoints, Friction friction, double gravity) {
  const double mu = friction.coefficient();
  const double sine = mu / std::sqrt(1.0 + mu * mu);
  const double missing = sine * math::hypot(endpoints.run, endpoints.drop) - endpoints.drop;
  return std::sqrt(2.0 * gravity * std::max(0.0, missing) / (1.0 + sine));
}

double least_drop(double run, Friction friction, double entry_speed, double gravity) {
  const double mu = friction.coefficient();
  const double norm = 1.0 + mu * mu;
  const double more = 1.0 + mu / std::sqrt(norm);  // 1 + sin(delta); norm * more = 1/(1 - sin(delta))
  const double height = 0.5 * entry_speed / gravity * entry_speed;
  return mu * math::hypot(run, std::sqrt(norm) * more * height) - norm * more * height;
}

bool can_arrive(const Endpoints& endpoints, Friction friction, double entry_speed, double gravity) {
  return endpoints.drop > least_drop(endpoints.run, friction, entry_speed, gravity);
}

}  // namespace glissade
