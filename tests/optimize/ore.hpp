#pragma once

#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/task/problem.hpp"

#include <memory>

namespace glissade::testing_problems {

/// 650 t/h of crushed ore in a chute of 800 mm.
inline Problem ore(double run, double drop, double entry_speed) {
  StreamShape shape;
  shape.mass_flow = 650.0 / 3.6;
  shape.bulk_density = 1600.0;
  shape.width = 0.8;
  shape.wall_height = 0.5;
  Problem problem;
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(0.5);
  problem.body.entry_speed = entry_speed;
  problem.body.law = std::make_shared<const BulkStream>(shape);
  return problem;
}

}  // namespace glissade::testing_problems
