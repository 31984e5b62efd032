// The least value of an envelope over random given tracks and obstacles of every kind: that of a place of the envelope, no larger
// than at any of many places, found in a bounded number of looks.

#include "glissade/centerline/clothoid_spline.hpp"

#include "clearance/random_section.hpp"
#include "clearance/stations.hpp"
#include "clearance/strip.hpp"
#include "support/catch.hpp"
#include "support/mesh_clearance.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace least_test {

using namespace glissade;
using clearance::Approach;
using clearance::Least;
using clearance::Pass;
using clearance::Region;
using clearance::Strip;

namespace {

// measured: the most of 12,000 random cases is 8075
constexpr std::size_t kMostLooks = 20000;
constexpr double kAccuracy = 1e-9;
// A depth is told to a millionth of itself, its place by Region to 1e-8.
constexpr double kDepth = 1.1e-6;

/// An obstacle, and its value at a point by its definition alone.
struct Obstacle {
  enum class Kind { area, line, half_plane } kind = Kind::area;
  std::vector<Vec2> corners;  // of a half-plane: a point of the line, and the way to the forbidden side
  double side = 0.0;          // +1: forbidden below, -1: above; 0: passed on either side

  [[nodiscard]] Region region() const {
    if (kind == Kind::half_plane) return Region::half_plane(corners[0], corners[1]);
    if (kind == Kind::line) return Region::line(corners, side > 0.0);
    return Region::area(corners, side == 0.0 ? Pass::either : side > 0.0 ? Pass::above : Pass::below);
  }

  [[nodiscard]] double value(Vec2 point) const {
    if (kind == Kind::half_plane) return dot(corners[0] - point, corners[1]) / norm(corners[1]);
    const bool closed = kind == Kind::area;
    double away = INFINITY;
    double behind = -INFINITY;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < corners.size(); ++i) {
      const Vec2 a = corners[i];
      const Vec2 b = corners[(i + 1) % corners.size()];
      away = std::min(away, testing::segment_distance(point, point, a, b));
      if (std::min(a.x, b.x) > point.x || std::max(a.x, b.x) < point.x || a.x == b.x) continue;
      behind = std::max(behind, side * (point.y - a.y - (b.y - a.y) * (point.x - a.x) / (b.x - a.x)));
    }
    if (side == 0.0) return testing::inside_polygon(point, corners) ? -away : away;
    if (!(behind > 0.0)) return away;
    return closed ? -behind : -away;
  }
};

Obstacle random_obstacle(testing::Random& random, Vec2 near, std::ostream& words) {
  Obstacle made;
  const double size = random.between(0.02, 1.5);
  const double away = random.between(0.0, 1.5);
  const double towards = random.between(0.0, 6.283);
  const Vec2 middle = near + away * Vec2{std::cos(towards), std::sin(towards)};
  const int kind = random.integer(0, 5);
  if (kind == 0) {
    made.kind = Obstacle::Kind::half_plane;
    made.corners = {middle, {std::cos(away * 9.0), std::sin(away * 9.0)}};
  } else if (kind <= 2) {
    made.kind = Obstacle::Kind::line;
    made.side = kind == 1 ? 1.0 : -1.0;
    double run = middle.x - 1.5 * size;
    for (int k = random.integer(2, 12); k > 0; --k) {
      made.corners.push_back({run, middle.y + size * random.between(-1.0, 1.0)});
      run += size * random.between(0.02, 1.0);
    }
  } else {
    const Pass passes[] = {Pass::either, Pass::above, Pass::below};
    made.side = passes[kind - 3] == Pass::either ? 0.0 : passes[kind - 3] == Pass::above ? 1.0 : -1.0;
    const int corners = random.integer(3, 12);
    // Some are as thin as a sheet.
    const double thin = random.integer(0, 3) == 0 ? random.between(1e-3, 0.1) : 1.0;
    const double turn = random.between(0.0, 6.283);
    const Vec2 along{std::cos(turn), std::sin(turn)};
    for (int k = 0; k < corners; ++k) {
      const double angle = 6.283185307179586 * k / corners;
      const double radius = size * random.between(0.2, 1.0);
      made.corners.push_back(middle + radius * std::cos(angle) * along +
                             thin * radius * std::sin(angle) * Vec2{-along.y, along.x});
    }
  }
  words << " obstacle " << kind << ":";
  for (const Vec2 corner : made.corners) words << " " << corner.x << " " << corner.y << ",";
  return made;
}

ClothoidSpline random_drawn(testing::Random& random, std::ostream& words) {
  std::vector<ClothoidSegment> segments;
  for (int i = random.integer(1, 4); i > 0; --i) {
    const double curvature = random.integer(0, 2) == 0 ? 0.0 : random.between(-1.5, 1.5);
    const double next = random.integer(0, 2) == 0 ? random.between(-1.5, 1.5) : curvature;
    segments.push_back({random.between(0.2, 2.5), curvature, next});
    words << " " << segments.back().length << " " << curvature << " " << next << ",";
  }
  const double entry = random.between(-60.0, 85.0);
  words << " from " << entry << " deg;";
  return {Angle::from_degrees(entry), segments};
}

/// The envelope by its definition: which heights of a station's normal belong to it.
class Solid {
 public:
  Solid(const ClothoidSpline& track, const Envelope& envelope)
      : track_(track), envelope_(envelope), start_(track.at(0.0)), finish_(track.at(track.length())) {
    constexpr int kPlaces = 2000;
    for (int i = 0; i <= kPlaces; ++i) {
      const double s = track.length() * i / kPlaces;
      const double slope = track.at(std::min(s, track.length())).slope_angle;
      if (std::fabs(slope - start_.slope_angle) >= kRightAngle) start_zone_ = std::min(start_zone_, s);
      if (std::fabs(slope - finish_.slope_angle) >= kRightAngle) finish_zone_ = s;
    }
  }

  [[nodiscard]] Vec2 place(double s, double height) const {
    const CenterlinePoint at = track_.at(s);
    return Vec2{at.x, at.drop} + height * Vec2{std::sin(at.slope_angle), -std::cos(at.slope_angle)};
  }

  /// @return whether a place is part of what slides or, where it may be told, in front of both end planes by more than `slack`
  [[nodiscard]] bool holds(double s, double height, double slack) const {
    const double rounding = std::max(0.0, -slack);
    if (height >= -rounding && height <= envelope_.headroom + rounding) return true;
    const auto beyond = [&](const CenterlinePoint& end, double sign) {
      const Vec2 tangent{std::cos(end.slope_angle), std::sin(end.slope_angle)};
      return sign * dot(place(s, height) - Vec2{end.x, end.drop}, tangent) < slack;
    };
    const double margin = track_.length() / 1000.0;
    if (s > 0.0 && s < start_zone_ + (slack < 0.0 ? -margin : margin) && beyond(start_, 1.0)) return false;
    const double zone = finish_zone_ + (slack < 0.0 ? margin : -margin);
    return !(s < track_.length() && s > zone && beyond(finish_, -1.0));
  }

  /// @return the least value at many places, closer to one another round the best of them
  [[nodiscard]] double least(const Obstacle& obstacle) const {
    double best = INFINITY;
    double at = 0.0;
    double level = 0.0;
    double half_s = 0.5 * track_.length();
    double half_n = 0.5 * (envelope_.top() + envelope_.below);
    double mid_s = half_s;
    double mid_n = half_n - envelope_.below;
    for (int round = 0; round < 6; ++round) {
      const int along = round == 0 ? 300 : 40;
      const int up = round == 0 ? 40 : 20;
      for (int i = 0; i <= along; ++i) {
        const double s = std::clamp(mid_s + half_s * (2.0 * i / along - 1.0), 0.0, track_.length());
        for (int k = 0; k <= up; ++k) {
          const double n =
              std::clamp(mid_n + half_n * (2.0 * k / up - 1.0), -envelope_.below, envelope_.top());
          if (!holds(s, n, 1e-9)) continue;
          const double value = obstacle.value(place(s, n));
          if (value >= best) continue;
          best = value;
          at = s;
          level = n;
        }
      }
      mid_s = at;
      mid_n = level;
      half_s *= round == 0 ? 0.02 : 0.2;
      half_n *= round == 0 ? 0.1 : 0.2;
    }
    return best;
  }

 private:
  static constexpr double kRightAngle = 1.5707963267948966;
  const ClothoidSpline& track_;
  Envelope envelope_;
  CenterlinePoint start_;
  CenterlinePoint finish_;
  double start_zone_ = INFINITY;
  double finish_zone_ = -INFINITY;
};

Least least_of(const ClothoidSpline& track, const Envelope& envelope, const Region& region, int samples) {
  const Strip strip(track, envelope, testing::stations_of(track, samples));
  return strip.least(region, strip.along(region), kAccuracy);
}

double accuracy_of(double value) {
  return std::max(2.0 * kAccuracy, -kDepth * value);
}

}  // namespace

TEST_CASE(
    "least clearances of random given tracks are places of the envelope, the closest, found in few looks") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int cases = testing::thorough() ? 2000 : 300;
  std::size_t most = 0;
  int met = 0;
  for (int i = 0; i < cases; ++i) {
    std::ostringstream words;
    words.precision(17);
    const ClothoidSpline track = random_drawn(random, words);
    const CrossSection section = random_section(random, words);
    const double headrooms[] = {0.0, 0.2, 0.7, 1.9};
    const Envelope envelope{-section.lowest(), section.highest(),
                            headrooms[random.integer(0, 3)] * random.between(0.5, 1.0)};
    words << "; headroom " << envelope.headroom << ";";
    const CenterlinePoint near = track.at(random.between(0.0, 1.0) * track.length());
    const Obstacle obstacle = random_obstacle(random, {near.x, near.drop}, words);
    INFO("case " << i << ": " << words.str());
    const Least found = least_of(track, envelope, obstacle.region(), random.integer(2, 40));
    const Approach& closest = found.closest;
    const Solid solid(track, envelope);
    const double brute = solid.least(obstacle);
    CAPTURE(found.looks, closest.value, brute, closest.arc_length, closest.place.height);
    most = std::max(most, found.looks);
    CHECK(found.looks <= kMostLooks);
    // No place that was tried is closer, and the one that is told is as close as it says.
    CHECK(closest.value <= brute + accuracy_of(closest.value));
    const Vec2 place = solid.place(closest.arc_length, closest.place.height);
    CHECK(norm(place - closest.place.point) < 1e-9);
    CHECK(solid.holds(closest.arc_length, closest.place.height, -1e-9));
    CHECK(closest.place.height >= -envelope.below - 1e-9);
    CHECK(closest.place.height <= envelope.top() + 1e-9);
    if (closest.value < 0.0) ++met;
    // Where a value jumps a rounding decides whether a point is behind.
    const auto nudged = [&](double by) { return obstacle.value(closest.place.point + Vec2{by, 0.0}); };
    const double told = std::min({nudged(0.0), nudged(1e-12), nudged(-1e-12)});
    CHECK(told == Approx(closest.value).margin(1e-8));
  }
  CAPTURE(most, met);
  CHECK(met > cases / 4);
}

TEST_CASE("walls exactly as high as a valley's radius take few looks, and so do those higher by a rounding") {
  for (const double radius : {0.5, 0.7, 1.4}) {
    const double kappa = 1.0 / radius;
    const ClothoidSpline track(Angle::from_degrees(60.0),
                               {{0.3, 0.0, 0.0}, {1.7 * radius, kappa, kappa}, {0.5, 0.0, 0.0}});
    const CenterlinePoint joint = track.at(0.3);
    const Vec2 centre =
        Vec2{joint.x, joint.drop} + radius * Vec2{std::sin(joint.slope_angle), -std::cos(joint.slope_angle)};
    for (const double off : {-0.2, -1e-3, 0.0, 1e-3, 0.1}) {
      // A beam above the centre, which every normal of the valley ends in, or reaches beyond it.
      const Vec2 corner = centre - Vec2{0.0, off};
      const Region beam =
          Region::area({corner, corner + Vec2{0.1, -3.0}, corner + Vec2{-0.1, -3.0}}, Pass::either);
      double lower = 0.0;
      for (const double share : {1.0 - 1e-9, 1.0 - 2e-16, 1.0, 1.0 + 2e-16, 1.0 + 1e-9}) {
        const Least found = least_of(track, {0.02, share * radius, 0.0}, beam, 10);
        CAPTURE(radius, share, off, found.looks, found.closest.value);
        // A corner in the centre is as close to each normal of the valley: measured, 40,950.
        CHECK(found.looks <= 3 * kMostLooks);
        if (share == 1.0 - 1e-9) lower = found.closest.value;
        CHECK(found.closest.value == Approx(lower).margin(1e-6));
      }
    }
  }
}

}  // namespace least_test
