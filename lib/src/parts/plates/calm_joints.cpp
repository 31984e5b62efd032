#include "parts/plates/calm_joints.hpp"

#include <cmath>

namespace glissade::parts {

double calm_place(const ArcSpline& track, double about, double room) {
  const auto bent = [&](double s) { return std::fabs(track.at(s).curvature); };
  double best = about;
  constexpr int kPlaces = 40;
  for (int k = 1; k <= kPlaces; ++k) {
    for (const double side : {-1.0, 1.0}) {
      const double s = about + side * room * k / kPlaces;
      if (bent(s) < (1.0 - 1e-6) * bent(best) - 1e-9) best = s;
    }
  }
  // Where arcs of the floor join, so that no sliver of one is left beside the joint.
  for (const TrackArc& arc : track.arcs()) {
    if (std::fabs(arc.start - best) < 0.1 * room) return arc.start;
  }
  return best;
}

std::vector<double> calm_joints(const ArcSpline& track, std::size_t count, double room) {
  const double even = track.length() / static_cast<double>(count);
  std::vector<double> joints = {0.0};
  for (std::size_t k = 1; k < count; ++k) {
    joints.push_back(calm_place(track, even * static_cast<double>(k), room));
  }
  joints.push_back(track.length());
  return joints;
}

}  // namespace glissade::parts
