#include "parts/supports/ground.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace glissade::parts {

double ground_at(const std::vector<Vec2>& ground, double x) {
  if (ground.size() == 1) return ground.front().y;
  std::size_t i = 0;
  while (i + 2 < ground.size() && x > ground[i + 1].x) ++i;
  const double share = (x - ground[i].x) / (ground[i + 1].x - ground[i].x);
  return ground[i].y + share * (ground[i + 1].y - ground[i].y);
}

double highest_ground(const std::vector<Vec2>& ground, double from, double to) {
  double highest = std::max(ground_at(ground, from), ground_at(ground, to));
  for (const Vec2 corner : ground) {
    if (corner.x > from && corner.x < to) highest = std::max(highest, corner.y);
  }
  return highest;
}

void require_on_ground(const std::vector<Vec2>& ground, const std::vector<Foot>& feet,
                       const std::string& where, const std::string& what) {
  if (ground.size() < 2) return;
  double first = ground.front().x;
  double last = ground.back().x;
  for (const Foot& foot : feet) {
    if (std::max(foot.x, foot.above) < ground.front().x) first = std::min(first, foot.x);
    if (std::min(foot.x, foot.above) > ground.back().x) last = std::max(last, foot.x);
  }
  std::vector<Issue> issues;
  const auto refuse = [&](double end, const char* verb, double foot) {
    if (foot == end) return;
    constexpr double kWhole = 10e-3;  // rounding, outwards: of the x that would do [m]
    const double enough = kWhole * (foot < end ? std::floor(foot / kWhole) : std::ceil(foot / kWhole));
    issues.push_back(
        {where,
         "ground: its line " + std::string(verb) + " " + length_text(end + 0.0, 4) +
             " from the start along the run, and " + what + " stands at " + length_text(foot, 4),
         "How high the ground is beyond the line's own x is not known.",
         "a line as far as " + length_text(enough, 6) + " from the start along the run, or farther"});
  };
  refuse(ground.front().x, "begins", first);
  refuse(ground.back().x, "ends", last);
  if (!issues.empty()) throw InputError(std::move(issues));
}

}  // namespace glissade::parts
