#include "centerline/profile/profile_interpolant.hpp"

#include "glissade/core/math.hpp"

#include "centerline/profile/clothoids_between.hpp"
#include "centerline/profile/interpolating_spline.hpp"
#include "centerline/profile/profile_model.hpp"
#include "centerline/profile/smoothed_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::centerline {
namespace {

using Rule = boost::math::quadrature::gauss<double, 7>;

/// Points over a parameter, and what the splines through them say of the places between.
struct Parametrized {
  std::vector<double> parameters;
  SmoothedPoints smooth;
  double between = 0.0;

  [[nodiscard]] double uncertainty() const { return std::max(between, std::sqrt(smooth.cost.mean_square)); }
};

/// @return 0 to 1; none where neighbours lie too close together, or one behind the other
std::optional<std::vector<double>> normalized(std::vector<double> parameters) {
  constexpr double kLeastGap = 1e-3;  // of the mean
  const double first = parameters.front();
  const double reach = parameters.back() - first;
  const double least = kLeastGap / static_cast<double>(parameters.size() - 1);
  for (double& parameter : parameters) parameter = (parameter - first) / reach;
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    if (!(parameters[i] - parameters[i - 1] > least)) return {};
  }
  return parameters;
}

double arc_length(const InterpolatingSpline& spline, double from, double to) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = Rule::weights()[0] * norm(spline.at(middle).first);
  for (std::size_t i = 1; i < Rule::abscissa().size(); ++i) {
    const double away = half * Rule::abscissa()[i];
    sum += Rule::weights()[i] * (norm(spline.at(middle - away).first) + norm(spline.at(middle + away).first));
  }
  return half * sum;
}

/// How far cubics and quintics through the same points are apart: the error of the cubics, of which the quintics leave
/// some share.
double left_open(const std::vector<double>& parameters, const std::vector<Vec2>& points) {
  constexpr double kShare = 0.5;
  const InterpolatingSpline cubic(parameters, points, SplineDegree::cubic);
  const InterpolatingSpline quintic(parameters, points, SplineDegree::quintic);
  double most = 0.0;
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    const double middle = 0.5 * (parameters[i - 1] + parameters[i]);
    const InterpolatingSpline::Place here = quintic.at(middle);
    const Vec2 away = here.value - cubic.at(middle).value;
    most = std::max(most, std::fabs(cross(here.first, away)) / norm(here.first));
  }
  return kShare * most;
}

/// By how much a quintic through every second point misses the others, in the root of the mean square; none where those
/// are too few.
std::optional<double> missed_by_half(const std::vector<double>& parameters, const std::vector<Vec2>& points) {
  constexpr std::size_t kFewest = 8;
  std::vector<double> places;
  std::vector<Vec2> half;
  for (std::size_t i = 0; i < points.size(); i += 2) {
    places.push_back(parameters[i]);
    half.push_back(points[i]);
  }
  if (half.size() < kFewest) return {};
  const InterpolatingSpline spline(places, half, SplineDegree::quintic);
  double sum = 0.0;
  for (std::size_t i = 1; i < half.size(); ++i) {
    const InterpolatingSpline::Place here = spline.at(parameters[2 * i - 1]);
    const double away = cross(here.first, points[2 * i - 1] - here.value) / norm(here.first);
    sum += away * away;
  }
  return std::sqrt(sum / static_cast<double>(half.size() - 1));
}

std::optional<Parametrized> over(std::optional<std::vector<double>> parameters,
                                 const std::vector<Vec2>& points) {
  if (!parameters) return {};
  auto smooth = smoothed(*parameters, points);
  if (!smooth) return {};
  const double between = left_open(*parameters, smooth->points);
  if (!std::isfinite(between)) return {};
  return Parametrized{*std::move(parameters), *std::move(smooth), between};
}

/// The same over the arc length of the curve through the points.
std::optional<Parametrized> by_arc_length(Parametrized rough) {
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    const InterpolatingSpline spline(rough.parameters, rough.smooth.points, SplineDegree::quintic);
    std::vector<double> lengths = {0.0};
    for (std::size_t i = 1; i < rough.parameters.size(); ++i) {
      lengths.push_back(lengths.back() + arc_length(spline, rough.parameters[i - 1], rough.parameters[i]));
    }
    auto parameters = normalized(std::move(lengths));
    if (!parameters) return {};
    rough.parameters = *std::move(parameters);
  }
  rough.between = left_open(rough.parameters, rough.smooth.points);
  if (!std::isfinite(rough.between)) return {};
  return rough;
}

/// How far the curves over two parameters pass each other between the points.
double apart(const Parametrized& one, const Parametrized& other) {
  const InterpolatingSpline here(one.parameters, one.smooth.points, SplineDegree::quintic);
  const InterpolatingSpline there(other.parameters, other.smooth.points, SplineDegree::quintic);
  double most = 0.0;
  for (std::size_t i = 1; i < one.parameters.size(); ++i) {
    const InterpolatingSpline::Place place = here.at(0.5 * (one.parameters[i - 1] + one.parameters[i]));
    const Vec2 away = there.at(0.5 * (other.parameters[i - 1] + other.parameters[i])).value - place.value;
    most = std::max(most, std::fabs(cross(place.first, away)) / norm(place.first));
  }
  return most;
}

std::optional<Parametrized> parametrized(const std::vector<Vec2>& points) {
  std::vector<double> runs;
  runs.reserve(points.size());
  for (const Vec2& point : points) runs.push_back(point.x);
  auto best = over(normalized(std::move(runs)), points);
  auto rough = over(normalized(rough_arc_lengths(points)), points);
  if (!rough) return best;
  auto even = by_arc_length(*std::move(rough));
  if (!even) return best;
  if (!best) return even;
  if (!(even->uncertainty() < best->uncertainty())) return best;
  // Over arc length cubics and quintics agree by chance where points are few for their waves; over x they do not.
  const double passed = apart(*even, *best);
  if (std::isfinite(passed)) even->between = std::max(even->between, passed - best->between);
  return even;
}

/// A place on the curve that is led along.
struct Station {
  Vec2 position;
  double slope_angle = 0.0;
};

/// The curve by nodes between which its curvature is to be linear.
struct Nodes {
  std::vector<Station> stations;
  std::vector<double> curvatures;
  std::vector<double> lengths;  // one fewer
};

/// By how much something that is known at nodes bulges over the chord from node to node, twice in three parts: a chord
/// moved by as much holds the same area.
std::vector<double> bulges(const std::vector<double>& values, const std::vector<double>& lengths) {
  std::vector<double> found(values.size(), 0.0);
  for (std::size_t k = 1; k < lengths.size(); ++k) {
    const double before = lengths[k - 1];
    const double after = lengths[k];
    const double change = (values[k + 1] - values[k]) / after - (values[k] - values[k - 1]) / before;
    found[k] = change / (before + after) * (before * before + after * after) / 12.0;
  }
  found.front() = found[1];
  found.back() = found[lengths.size() - 1];
  return found;
}

Nodes nodes_along(const InterpolatingSpline& spline, const std::vector<double>& parameters,
                  std::size_t per_gap) {
  Nodes nodes;
  const auto add = [&](double t) {
    const InterpolatingSpline::Place here = spline.at(t);
    const double speed = norm(here.first);
    const double angle = math::atan2(here.first.y, here.first.x);
    const double before = nodes.stations.empty() ? angle : nodes.stations.back().slope_angle;
    nodes.stations.push_back({here.value, before + std::remainder(angle - before, 2.0 * std::numbers::pi)});
    nodes.curvatures.push_back(-cross(here.first, here.second) / (speed * speed * speed));
  };
  add(parameters.front());
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    double from = parameters[i - 1];
    for (std::size_t k = 1; k <= per_gap; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(per_gap);
      const double to =
          k == per_gap ? parameters[i] : parameters[i - 1] + share * (parameters[i] - parameters[i - 1]);
      nodes.lengths.push_back(arc_length(spline, from, to));
      add(to);
      from = to;
    }
  }
  return nodes;
}

/// So many nodes that chords leave little of the curvature, and with values that turn as the curve does.
Nodes nodes_for_clothoids(const InterpolatingSpline& spline, const std::vector<double>& parameters) {
  constexpr double kLittle = 2e-3;
  constexpr std::size_t kMostPerGap = 16;
  constexpr std::size_t kMostNodes = 4000;
  Nodes nodes = nodes_along(spline, parameters, 1);
  const auto largest = [](const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::fabs(value));
    return most;
  };
  const double most = largest(nodes.curvatures);
  const double bulge = largest(bulges(nodes.curvatures, nodes.lengths));
  std::size_t per_gap = 1;
  while (per_gap < kMostPerGap && 2 * per_gap * parameters.size() <= kMostNodes &&
         bulge > kLittle * most * static_cast<double>(per_gap * per_gap)) {
    per_gap *= 2;
  }
  if (per_gap > 1) nodes = nodes_along(spline, parameters, per_gap);
  const std::vector<double> over = bulges(nodes.curvatures, nodes.lengths);
  for (std::size_t k = 0; k < over.size(); ++k) nodes.curvatures[k] -= over[k];
  return nodes;
}

/// Some clothoids one after the other that are to lead from one station to another: their lengths and the curvatures
/// inside may change a little.
class Leg {
 public:
  Leg(const Nodes& nodes, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      segments_.push_back({nodes.lengths[k], nodes.curvatures[k], nodes.curvatures[k + 1]});
      length_ += nodes.lengths[k];
    }
  }

  using Change =
      std::array<double, 3>;  // a share of the lengths; curvature over the length: a swelling, a slant

  [[nodiscard]] std::vector<ClothoidSegment> segments(const Change& change) const {
    std::vector<ClothoidSegment> changed = segments_;
    double s = 0.0;
    for (std::size_t k = 0; k < changed.size(); ++k) {
      s += segments_[k].length;
      changed[k].length *= 1.0 + change[0];
      if (k + 1 == changed.size()) break;
      const double u = s / length_;
      const double more = (change[1] + change[2] * (1.0 - 2.0 * u)) * u * (1.0 - u) / length_;
      changed[k].exit_curvature += more;
      changed[k + 1].entry_curvature += more;
    }
    return changed;
  }
  [[nodiscard]] Station end(const Station& start, const Change& change) const {
    const ClothoidSpline curve(Angle::from_radians(start.slope_angle), segments(change));
    const CenterlinePoint place = curve.at(curve.length());
    return {start.position + Vec2{place.x, place.drop}, place.slope_angle};
  }
  /// Newton's steps to the goal, their derivatives by differences. @return none where they leave what a curve can be
  [[nodiscard]] std::optional<Change> leading(const Station& start, const Station& goal) const {
    constexpr int kMostSteps = 12;
    constexpr double kStep = 1e-6;
    constexpr double kMostStretch = 0.5;
    constexpr double kMostMove = 100.0;
    Change change{};
    for (int step = 0; step < kMostSteps; ++step) {
      const Change missed = off(end(start, change), goal);
      std::array<Change, 3> columns{};
      for (std::size_t j = 0; j < columns.size(); ++j) {
        Change beside = change;
        beside[j] += kStep;
        const Change there = off(end(start, beside), goal);
        for (std::size_t i = 0; i < there.size(); ++i) columns[j][i] = (there[i] - missed[i]) / kStep;
      }
      const double whole = determinant(columns[0], columns[1], columns[2]);
      const Change move{determinant(missed, columns[1], columns[2]) / whole,
                        determinant(columns[0], missed, columns[2]) / whole,
                        determinant(columns[0], columns[1], missed) / whole};
      double most = 0.0;
      for (std::size_t j = 0; j < change.size(); ++j) {
        change[j] -= move[j];
        most = std::max(most, std::fabs(move[j]));
      }
      if (!(std::fabs(change[0]) < kMostStretch && most < kMostMove)) return {};
      if (most <= 1e-15) break;
    }
    return change;
  }
  /// Distances over the length, and an angle.
  [[nodiscard]] Change off(const Station& here, const Station& goal) const {
    const Vec2 away = here.position - goal.position;
    return {away.x / length_, away.y / length_, here.slope_angle - goal.slope_angle};
  }

 private:
  static double determinant(const Change& a, const Change& b, const Change& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }

  std::vector<ClothoidSegment> segments_;
  double length_ = 0.0;
};

/// Clothoids through the nodes, each few of them led to where the next begin: errors do not add up along the track.
/// @return none where a few cannot be led there by little changes
std::optional<ClothoidSpline> clothoids_through(const Nodes& nodes) {
  constexpr std::size_t kPieces = 4;
  constexpr double kMet = 1e-9;
  std::vector<ClothoidSegment> segments;
  Station here = nodes.stations.front();
  std::size_t first = 0;
  while (first < nodes.lengths.size()) {
    std::size_t last = first + kPieces;
    if (last + kPieces > nodes.lengths.size()) last = nodes.lengths.size();
    const Leg leg(nodes, first, last);
    const Station& goal = nodes.stations[last];
    const auto change = leg.leading(here, goal);
    if (!change) return {};
    const std::vector<ClothoidSegment> led = leg.segments(*change);
    here = leg.end(here, *change);
    for (const double off : leg.off(here, goal)) {
      if (!(std::fabs(off) <= kMet)) return {};
    }
    segments.insert(segments.end(), led.begin(), led.end());
    first = last;
  }
  return ClothoidSpline(Angle::from_radians(nodes.stations.front().slope_angle), std::move(segments));
}

}  // namespace

ClothoidSpline without_chords(const ClothoidSpline& curve) {
  constexpr double kLittle = 2e-3;  // taste: of the largest curvature, as for a curve through points
  constexpr std::size_t kMostPerGap =
      4;  // theory: as many as are led to a place; 1/16 is left of what a chord passes over
  constexpr std::size_t kFewestKnots = 6;  // theory: those of a spline of third degree
  std::vector<double> places = {0.0};
  std::vector<double> lengths;
  std::vector<double> curvatures = {curve.segments().front().entry_curvature};
  for (const ClothoidSegment& segment : curve.segments()) {
    lengths.push_back(segment.length);
    places.push_back(places.back() + segment.length);
    curvatures.push_back(segment.exit_curvature);
  }
  if (places.size() < kFewestKnots) return curve;
  const std::vector<double> over = bulges(curvatures, lengths);
  double most = 0.0;
  double bulge = 0.0;
  std::vector<Vec2> smooth;
  for (std::size_t k = 0; k < curvatures.size(); ++k) {
    most = std::max(most, std::fabs(curvatures[k]));
    bulge = std::max(bulge, std::fabs(over[k]));
    const bool end = k == 0 || k + 1 == curvatures.size();
    smooth.push_back({curvatures[k] + (end ? 0.0 : over[k]), 0.0});
  }
  std::size_t per_gap = 1;
  while (per_gap < kMostPerGap && bulge > kLittle * most * static_cast<double>(per_gap * per_gap))
    per_gap *= 2;
  if (per_gap == 1) return curve;
  const InterpolatingSpline spline(places, smooth, SplineDegree::cubic);
  // Led to where the curve has its knots: errors of a direction would add up along the track.
  Nodes nodes;
  const auto add = [&](double s) {
    const CenterlinePoint here = curve.at(std::min(s, curve.length()));
    nodes.stations.push_back({{here.x, here.drop}, here.slope_angle});
    nodes.curvatures.push_back(spline.at(s).value.x);
  };
  add(0.0);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const double step = lengths[k] / static_cast<double>(per_gap);
    for (std::size_t i = 1; i <= per_gap; ++i) {
      nodes.lengths.push_back(step);
      add(i == per_gap ? places[k + 1] : places[k] + step * static_cast<double>(i));
    }
  }
  const std::vector<double> left = bulges(nodes.curvatures, nodes.lengths);
  for (std::size_t k = 1; k + 1 < left.size(); ++k) nodes.curvatures[k] -= left[k];
  return clothoids_through(nodes).value_or(curve);
}

std::optional<FollowedProfile> follow_points(const std::vector<Vec2>& points) {
  auto found = parametrized(points);
  if (!found) return {};
  std::vector<Vec2> through = std::move(found->smooth.points);
  const Vec2 start = through.front();
  for (Vec2& point : through) point = point - start;
  const InterpolatingSpline spline(found->parameters, through, SplineDegree::quintic);
  if (found->smooth.exact) {
    std::vector<double> angles;
    for (const double parameter : found->parameters) {
      const Vec2 along = spline.at(parameter).first;
      const double angle = math::atan2(along.y, along.x);
      const double before = angles.empty() ? angle : angles.back();
      angles.push_back(before + std::remainder(angle - before, 2.0 * std::numbers::pi));
    }
    if (auto curve = clothoids_between(through, std::move(angles))) {
      return FollowedProfile{*std::move(curve), start, {}, true, true, 0.0};
    }
  }
  auto curve = clothoids_through(nodes_for_clothoids(spline, found->parameters));
  if (!curve) return {};
  Cost cost = found->smooth.cost;
  cost.mean_square /= curve->length() * curve->length();
  return FollowedProfile{*std::move(curve),
                         start,
                         cost,
                         found->smooth.exact,
                         false,
                         found->between,
                         missed_by_half(found->parameters, through)};
}

}  // namespace glissade::centerline
