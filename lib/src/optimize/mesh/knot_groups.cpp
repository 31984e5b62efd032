#include "optimize/mesh/knot_groups.hpp"

#include "optimize/mesh/switches.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

bool lies_at_change(const Mesh& mesh, const KnotGroup& group) {
  return std::any_of(mesh.change_knots.begin(), mesh.change_knots.end(), [&](const ChangeKnots& change) {
    return mesh.knots[group.first] <= change.to && mesh.knots[group.last] >= change.from;
  });
}

/// Whether curvature jumps or bends at a group: where it goes on in a line the place of a knot is nothing.
bool bends_at(const Found& found, const KnotGroup& group) {
  constexpr double kBend = 0.05;  // taste: of the greatest turning rate
  if (!group.is_bend()) return true;
  const Layout& layout = found.track->layout();
  const Vector& knots = found.track->mesh().knots;
  const std::size_t k = group.first;
  const auto rate = [&](std::size_t i) {
    return (found.z[layout.turn(i + 1)] - found.z[layout.turn(i)]) / (knots[i + 1] - knots[i]);
  };
  double greatest = 0.0;
  for (std::size_t i = 0; i < layout.knots; ++i) {
    greatest = std::max(greatest, std::fabs(found.z[layout.turn(i)]));
  }
  const double room = std::min(knots[k] - knots[k - 1], knots[k + 1] - knots[k]);
  return std::fabs(rate(k) - rate(k - 1)) * room > kBend * greatest;
}

/// Of knots close together those around the jump that they hold, where it is plain which piece that is.
KnotGroup around_jump(const Found& found, const KnotGroup& close) {
  constexpr double kMost = 0.6;  // taste: of all that curvature changes among them
  const Layout& layout = found.track->layout();
  double whole = 0.0;
  double most = 0.0;
  std::size_t piece = close.first;
  for (std::size_t i = close.first; i < close.last; ++i) {
    const double change = std::fabs(found.z[layout.turn(i + 1)] - found.z[layout.turn(i)]);
    whole += change;
    if (change <= most) continue;
    most = change;
    piece = i;
  }
  return most > kMost * whole ? KnotGroup{piece, piece + 1} : close;
}

}  // namespace

std::vector<KnotGroup> knot_groups_of(const Found& found) {
  const Mesh& mesh = found.track->mesh();
  const std::size_t count = mesh.knots.size();
  std::vector<KnotGroup> groups;
  for (std::size_t k = 0; k < count;) {
    KnotGroup group{k, k};
    while (group.last + 1 < count && mesh.knots[group.last + 1] - mesh.knots[group.last] < 2.0 * kPair)
      ++group.last;
    k = group.last + 1;
    if (group.last > group.first + 1) group = around_jump(found, group);
    if (group.first == 0 || group.last + 1 == count || lies_at_change(mesh, group)) continue;
    if (bends_at(found, group)) groups.push_back(group);
  }
  return groups;
}

}  // namespace glissade::optimizer
