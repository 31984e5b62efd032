// (R5) of docs/theory.md, solved for one or the other of its quantities: a hyperbola with a focus at the start.
#include "glissade/centerline/reach.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "centerline/optima/endpoint_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace glissade {
namespace {

void require_finite_length(const char* name, double value) {
  if (std::isfinite(value)) return;
  throw InputError({"", std::string(name) + ": " + exact_text(value) + " m is not a finite length", "", ""});
}

}  // namespace

double least_entry_speed(const Endpoints& endpoints, Friction friction, double gravity) {
  require_finite_length("run", endpoints.run);
  require_finite_length("drop", endpoints.drop);
  centerline::require_gravity(gravity);
  const double mu = friction.coefficient();
  const double sine = mu / std::sqrt(1.0 + mu * mu);
  const double missing = sine * math::hypot(endpoints.run, endpoints.drop) - endpoints.drop;
  const double square = 2.0 * gravity * std::max(0.0, missing) / (1.0 + sine);
  if (std::isfinite(square)) return std::sqrt(square);
  // So far apart that only the root is a number.
  const double quarter =
      sine * math::hypot(0.25 * endpoints.run, 0.25 * endpoints.drop) - 0.25 * endpoints.drop;
  return std::sqrt(8.0 * gravity / (1.0 + sine)) * std::sqrt(quarter);
}

double least_drop(double run, Friction friction, double entry_speed, double gravity) {
  require_finite_length("run", run);
  if (!(std::isfinite(entry_speed) && entry_speed >= 0.0)) {
    throw InputError({"",
                      "entry_speed: " + exact_text(entry_speed) + " m/s is not a finite speed, 0 or larger",
                      "The body starts from rest or moves towards the finish.", ""});
  }
  centerline::require_gravity(gravity);
  const double mu = friction.coefficient();
  const double norm = 1.0 + mu * mu;
  const double more = 1.0 + mu / std::sqrt(norm);  // 1 + sin(delta); norm * more = 1/(1 - sin(delta))
  const double height = 0.5 * entry_speed / gravity * entry_speed;
  // So fast that the height it could climb to is no number.
  if (!std::isfinite(norm * more * height)) return -std::numeric_limits<double>::infinity();
  return mu * math::hypot(run, std::sqrt(norm) * more * height) - norm * more * height;
}

bool can_arrive(const Endpoints& endpoints, Friction friction, double entry_speed, double gravity) {
  require_finite_length("drop", endpoints.drop);
  return endpoints.drop > least_drop(endpoints.run, friction, entry_speed, gravity);
}

}  // namespace glissade
