#include "centerline/profile/profile_model.hpp"

#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::centerline {
namespace {

constexpr std::size_t kCoarseChords = 24;
constexpr unsigned kModelGaussPoints =
    7;  // of those that Boost has as a table: computed nodes vary by processor

}  // namespace

std::vector<double> rough_arc_lengths(const std::vector<Vec2>& points) {
  constexpr double kLeastChord = 0.01;
  double reach = 0.0;
  for (const Vec2& point : points) reach = std::max(reach, norm(point - points.front()));
  std::vector<double> lengths(points.size(), 0.0);
  std::size_t from = 0;
  for (std::size_t to = 1; to < points.size(); ++to) {
    const Vec2 chord = points[to] - points[from];
    const bool last = to + 1 == points.size();
    if (norm(chord) < kLeastChord * reach && !last) continue;
    for (std::size_t i = from + 1; i <= to; ++i) {
      const double along = norm(chord) > 0.0 ? dot(points[i] - points[from], chord) / norm(chord) : 0.0;
      lengths[i] = lengths[from] + std::clamp(along, 0.0, norm(chord));
    }
    from = to;
  }
  return lengths;
}

ProfileModel::ProfileModel(std::vector<Vec2> points)
    : points_(std::move(points)), places_(rough_arc_lengths(points_)), scale_(places_.back()) {
  for (double& place : places_) place /= scale_;
  place_knots();
}

void ProfileModel::place_knots() {
  const std::size_t gaps = places_.size() - 1;
  const std::size_t count = std::min<std::size_t>(gaps, kMostProfileKnots - 1);
  // Points may cluster; knots nearer than this would only add rounding.
  const double least_width = 0.05 / static_cast<double>(count);
  knots_ = {0.0};
  for (std::size_t k = 1; k < count; ++k) {
    const double place = places_[k * gaps / count];
    if (place - knots_.back() >= least_width && 1.0 - place >= least_width) knots_.push_back(place);
  }
  knots_.push_back(1.0);
}

Shape ProfileModel::first_shape() const {
  const std::vector<Vec2>& points = points_;
  const std::size_t chords = std::min(kCoarseChords, points.size() - 1);
  std::vector<double> middles;
  std::vector<double> slopes;
  std::size_t from = 0;
  for (std::size_t k = 1; k <= chords; ++k) {
    const double goal = static_cast<double>(k) / static_cast<double>(chords);
    std::size_t to = from + 1;
    while (to + 1 < points.size() && places_[to] < goal) ++to;
    const Vec2 chord = points[to] - points[from];
    const double slope = math::atan2(chord.y, chord.x);
    const double before = slopes.empty() ? slope : slopes.back();
    slopes.push_back(before + std::remainder(slope - before, 2.0 * std::numbers::pi));
    middles.push_back(0.5 * (places_[from] + places_[to]));
    from = to;
    if (from + 1 == points.size()) break;
  }
  const auto slope_at_place = [&](double u) {
    if (slopes.size() == 1) return slopes.front();
    const auto next = std::upper_bound(middles.begin() + 1, middles.end() - 1, u);
    const auto i = static_cast<std::size_t>(next - middles.begin());
    const double share = (u - middles[i - 1]) / (middles[i] - middles[i - 1]);
    return slopes[i - 1] + share * (slopes[i] - slopes[i - 1]);
  };
  Shape shape;
  shape.entry = slope_at_place(0.0);
  shape.length = scale_;
  const double reach = 1.0 / static_cast<double>(chords);
  for (const double knot : knots_) {
    const double low = std::max(0.0, knot - reach);
    const double high = std::min(1.0, knot + reach);
    shape.bend.push_back((slope_at_place(low) - slope_at_place(high)) / (high - low));
  }
  return shape;
}

std::size_t ProfileModel::interval_of(double u) const {
  const auto next = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, u);
  return static_cast<std::size_t>(next - knots_.begin()) - 1;
}

double ProfileModel::slope_at(const Shape& shape, std::size_t interval, double local) const {
  const double left = shape.bend[interval];
  const double change = shape.bend[interval + 1] - left;
  return knot_slopes_[interval] - local * (left + 0.5 * change * local / width(interval));
}

ProfileModel::Local ProfileModel::local_at(const Shape& shape, std::size_t interval, double u) const {
  using Rule = boost::math::quadrature::gauss<double, kModelGaussPoints>;
  const double local = u - knots_[interval];
  const double half = 0.5 * local;
  Local sum;
  const auto add = [&](double offset, double weight) {
    const double t = half + offset;
    const double slope = slope_at(shape, interval, t);
    const auto [sine, cosine] = math::sine_cosine(slope);
    const Vec2 tangent{cosine, sine};
    const double right_area = 0.5 * t * t / width(interval);
    const double left_area = area_before(interval) + t - right_area;
    const double weighted = half * weight * shape.length;
    sum.position = sum.position + weighted * tangent;
    sum.turned = sum.turned + weighted * perpendicular(tangent);
    sum.left_turned = sum.left_turned + (weighted * left_area) * perpendicular(tangent);
    sum.right_turned = sum.right_turned + (weighted * right_area) * perpendicular(tangent);
  };
  add(0.0, Rule::weights()[0]);
  for (std::size_t i = 1; i < Rule::abscissa().size(); ++i) {
    add(-half * Rule::abscissa()[i], Rule::weights()[i]);
    add(half * Rule::abscissa()[i], Rule::weights()[i]);
  }
  sum.position = knot_positions_[interval] + sum.position;
  const auto [sine, cosine] = math::sine_cosine(slope_at(shape, interval, local));
  sum.tangent = {cosine, sine};
  return sum;
}

/// Positions at the knots and how they change with each bend.
void ProfileModel::lay_out(const Shape& shape) {
  const std::size_t count = knots_.size();
  knot_positions_.assign(count, {});
  knot_slopes_.assign(count, shape.entry);
  knot_changes_.assign(count, std::vector<Vec2>(count));
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Local end = local_at(shape, k, knots_[k + 1]);
    knot_positions_[k + 1] = end.position;
    knot_slopes_[k + 1] = slope_at(shape, k, width(k));
    for (std::size_t j = 0; j < k; ++j) {
      const double area = area_before(j) + 0.5 * width(j);
      knot_changes_[k + 1][j] = knot_changes_[k][j] - area * end.turned;
    }
    knot_changes_[k + 1][k] = knot_changes_[k][k] - end.left_turned;
    knot_changes_[k + 1][k + 1] = Vec2{} - end.right_turned;
  }
}

/// Moves the points' places towards the nearest places on the curve laid out.
void ProfileModel::project(const Shape& shape) {
  constexpr int kNewtonSteps = 3;
  for (std::size_t i = 1; i < places_.size(); ++i) {
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Local here = local_at(shape, interval_of(places_[i]), places_[i]);
      const double ahead = dot(points_[i] - here.position, here.tangent) / shape.length;
      places_[i] = std::clamp(places_[i] + ahead, 0.0, 1.0);
      if (std::fabs(ahead) < 1e-10) break;
    }
  }
  // The finish is where the last point is nearest: there the curve ends.
  places_.back() = 1.0;
}

Linearized ProfileModel::linearized(const Shape& shape) {
  lay_out(shape);
  project(shape);
  Linearized sum(unknowns());
  std::vector<std::array<Sight, kSight>> grams(knots_.size() - 1);
  std::vector<Sight> moments(knots_.size() - 1);
  for (auto& gram : grams) {
    for (Sight& row : gram) row.fill(0.0);
  }
  for (Sight& moment : moments) moment.fill(0.0);

  const double weight = 1.0 / (static_cast<double>(points_.size()) * scale_ * scale_);
  const auto add = [&](std::size_t k, const Local& here, Vec2 away, Vec2 direction) {
    const Vec2 left = knot_changes_[k][k] - here.left_turned;
    const Sight sight{direction.x,
                      direction.y,
                      -dot(here.turned, direction),
                      dot(left, direction),
                      -dot(here.right_turned, direction),
                      dot(perpendicular(here.position), direction),
                      dot(here.position, direction) / shape.length};
    const double distance = dot(away, direction);
    for (std::size_t a = 0; a < kSight; ++a) {
      moments[k][a] -= weight * distance * sight[a];
      for (std::size_t b = 0; b <= a; ++b) grams[k][a][b] += weight * sight[a] * sight[b];
    }
    sum.mean_square += weight * distance * distance;
  };
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const std::size_t k = interval_of(places_[i]);
    const Local here = local_at(shape, k, places_[i]);
    const Vec2 away = points_[i] - here.position;
    const bool last = i + 1 == points_.size();
    if (last) {
      add(k, here, away, {1.0, 0.0});
      add(k, here, away, {0.0, 1.0});
    } else {
      add(k, here, away, perpendicular(here.tangent));
    }
  }
  for (std::size_t k = 0; k < grams.size(); ++k) add_interval(k, grams[k], moments[k], sum);
  return sum;
}

/// Spreads what the points of one knot interval see over the unknowns.
void ProfileModel::add_interval(std::size_t interval, const std::array<Sight, kSight>& gram,
                                const Sight& moment, Linearized& sum) const {
  const std::size_t complete = interval;
  const std::size_t own[] = {kFirstBend + interval, kFirstBend + interval + 1, kEntry, kLength};
  const auto symmetric = [&](std::size_t a, std::size_t b) { return a >= b ? gram[a][b] : gram[b][a]; };
  const auto seen = [&](std::size_t j) {
    const Vec2 change = knot_changes_[interval][j];
    return std::array<double, 3>{change.x, change.y, area_before(j) + 0.5 * width(j)};
  };
  for (std::size_t i = 0; i < complete; ++i) {
    const auto row = seen(i);
    std::array<double, kSight> mixed{};
    for (std::size_t b = 0; b < kSight; ++b) {
      for (std::size_t a = 0; a < 3; ++a) mixed[b] += row[a] * symmetric(a, b);
    }
    for (std::size_t j = 0; j <= i; ++j) {
      const auto column = seen(j);
      sum.matrix.at(kFirstBend + i, kFirstBend + j) +=
          mixed[kByX] * column[0] + mixed[kByDrop] * column[1] + mixed[kByArea] * column[2];
    }
    for (std::size_t b = 0; b < 4; ++b) {
      sum.matrix.add(kFirstBend + i, own[b], mixed[kOwnLeft + b]);
    }
    sum.gradient[kFirstBend + i] +=
        row[0] * moment[kByX] + row[1] * moment[kByDrop] + row[2] * moment[kByArea];
  }
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      sum.matrix.add(own[a], own[b], symmetric(kOwnLeft + a, kOwnLeft + b));
    }
    sum.gradient[own[a]] += moment[kOwnLeft + a];
  }
}

double ProfileModel::roughness(const Shape& shape) const {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    const double change = shape.bend[k + 1] - shape.bend[k];
    sum += change * change / width(k);
  }
  return sum;
}

void ProfileModel::add_roughness(const Shape& shape, double smoothing, Linearized& sum) const {
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    const double stiffness = smoothing / width(k);
    const double change = shape.bend[k + 1] - shape.bend[k];
    const std::size_t left = kFirstBend + k;
    sum.matrix.at(left, left) += stiffness;
    sum.matrix.at(left + 1, left + 1) += stiffness;
    sum.matrix.at(left + 1, left) -= stiffness;
    sum.gradient[left] -= stiffness * change;
    sum.gradient[left + 1] += stiffness * change;
  }
}

ClothoidSpline ProfileModel::spline(const Shape& shape) const {
  std::vector<ClothoidSegment> segments;
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
    segments.push_back(
        {shape.length * width(k), shape.bend[k] / shape.length, shape.bend[k + 1] / shape.length});
  }
  return {Angle::from_radians(shape.entry), std::move(segments)};
}

}  // namespace glissade::centerline
