#include "optimize/conflicts/reach_conflict.hpp"

#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

Conflict too_slow(const Problem& problem, Friction friction) {
  const Endpoints& ends = problem.endpoints;
  const double speed = problem.body.entry_speed;
  const double needed = least_entry_speed(ends, friction, problem.gravity);
  const double drop = least_drop(ends.run, friction, speed, problem.gravity);
  Conflict conflict;
  conflict.limits = {{{LimitId::friction}, {}}, {{LimitId::finish}, {}}};
  conflict.relaxations.push_back({{LimitId::finish_drop}, ends.drop, drop});
  conflict.text = "at an entry speed of " + rounded_text(speed, 4) +
                  " m/s no track reaches the finish at a friction angle of " + angle_text(friction.angle()) +
                  ", whatever the shape (reach theorem); an entry speed above " + rounded_text(needed, 4) +
                  " m/s or a drop above " + length_text(drop) + " would do";
  return conflict;
}

}  // namespace

std::optional<Conflict> beyond_reach(const Problem& problem) {
  if (problem.finish.kind != FinishKind::point) return std::nullopt;
  // Where friction changes along the track its least one tells what no track can do.
  Friction friction = problem.high_friction.value_or(problem.body.friction);
  for (const FrictionChange& change : problem.body.friction_changes)
    friction = std::min(friction, change.friction);
  if (problem.body.entry_speed > 0.0) {
    // With speed, the theorem is told of the sliding point.
    if (!is_sliding_point(problem.body)) return std::nullopt;
    const bool arrives = can_arrive(problem.endpoints, friction, problem.body.entry_speed, problem.gravity);
    return arrives ? std::nullopt : std::optional(too_slow(problem, friction));
  }
  const double run = std::fabs(problem.endpoints.run);
  const double mu = friction.coefficient();
  // The theorem is about the centre of mass, whose ends lie up to this much more favourably than the track's.
  const double height = problem.body.law ? problem.body.law->centre_height() : 0.0;
  const double favour = height == 0.0 ? 0.0 : height * (std::sqrt(1.0 + mu * mu) + mu);
  if (problem.endpoints.drop + favour > mu * run) return std::nullopt;
  if (is_driven_by_wind(problem.body)) return std::nullopt;
  Conflict conflict;
  conflict.limits = {{{LimitId::friction}, {}}, {{LimitId::finish}, {}}};
  conflict.relaxations.push_back(
      {{LimitId::finish_drop}, problem.endpoints.drop, friction.coefficient() * run});
  conflict.text = "from rest, no track reaches the finish at a friction angle of " +
                  angle_text(friction.angle()) + ": the mean slope is " +
                  angle_text(Angle::from_radians(math::atan2(problem.endpoints.drop, run))) +
                  ", whatever the shape (reach theorem); a drop above " +
                  length_text(friction.coefficient() * run) + " would do";
  return conflict;
}

}  // namespace glissade::optimizer
