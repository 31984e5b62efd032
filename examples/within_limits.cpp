// The fastest track that keeps what a job asks for, and what each of its limits costs.

#include <iostream>

#include <glissade/optimize/optimize.hpp>

int main() {
  using namespace glissade;
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body = {Friction::from_angle(Angle::from_degrees(11.0))};
  problem.limits.slope_angle.highest = Angle::from_degrees(40.0).radians();
  problem.limits.smallest_valley_radius = 4.0;
  problem.limits.exit_slope_angle = Range::fixed(0.0);

  const Optimum best = optimize(problem);
  if (!best.centerline) {
    std::cout << best.report.message << '\n' << best.report.conflict.text << '\n';
    return 1;
  }
  std::cout << "travel time " << best.report.travel_time << " s\n";
  for (const ActiveLimit& active : best.report.active) {
    std::cout << "held back by " << active.limit.label() << ", " << price_text(active, problem.objective)
              << '\n';
  }
}
