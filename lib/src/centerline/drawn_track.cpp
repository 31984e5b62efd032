#include "glissade/centerline/drawn_track.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {
namespace {

/// An angle brought to -pi to pi.
double wrapped(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::round(angle / kTurn);
}

CubicBend bend_of(const CubicSegment& segment) {
  return {Angle::from_radians(std::fabs(segment.turn.radians())), segment.radius};
}

}  // namespace

CubicBend::Place DrawnTrack::Bend::at(double s) const {
  if (!backwards) return curve.at(s);
  // Seen from its end: behind its last tangent, on the side to which it bends.
  const double turn = curve.turn().radians();
  const double cosine = math::cos(turn);
  const double sine = math::sin(turn);
  const CubicBend::Place place = curve.at(std::clamp(curve.length() - s, 0.0, curve.length()));
  const double along = place.along - curve.reach();
  const double across = place.across - curve.offset();
  return {-along * cosine - across * sine, across * cosine - along * sine, turn - place.turned,
          place.curvature};
}

double DrawnTrack::Part::length() const {
  if (const auto* const spline = std::get_if<ClothoidSpline>(&curve)) return spline->length();
  return std::get<Bend>(curve).curve.length();
}

CenterlinePoint DrawnTrack::Part::at(double s) const {
  if (const auto* const spline = std::get_if<ClothoidSpline>(&curve)) {
    CenterlinePoint point = spline->at(s);
    point.arc_length = start.arc_length + s;
    point.x += start.x;
    point.drop += start.drop;
    return point;
  }
  const Bend& bend = std::get<Bend>(curve);
  const CubicBend::Place place = bend.at(s);
  const double across = bend.side * place.across;
  const auto [sine, cosine] = math::sine_cosine(start.slope_angle);
  return {start.arc_length + s, start.x + place.along * cosine + across * sine,
          start.drop + place.along * sine - across * cosine, start.slope_angle - bend.side * place.turned,
          bend.side * place.curvature};
}

Direction DrawnTrack::Part::direction(double s) const {
  if (const auto* const spline = std::get_if<ClothoidSpline>(&curve)) return spline->direction(s);
  const Bend& bend = std::get<Bend>(curve);
  const CubicBend::Place place = bend.at(s);
  return {start.slope_angle - bend.side * place.turned, bend.side * place.curvature};
}

void DrawnTrack::append(Part part) {
  part.start = end_;
  if (const auto* const spline = std::get_if<ClothoidSpline>(&part.curve)) {
    for (const double joint : spline->breaks()) {
      if (joint > 0.0) joints_.push_back(end_.arc_length + joint);
    }
  } else {
    joints_.push_back(end_.arc_length + part.length());
  }
  end_ = part.at(part.length());
  if (!(std::isfinite(end_.arc_length) && std::isfinite(end_.x) && std::isfinite(end_.drop))) {
    throw InputError({"segments", "their length is beyond the range of numbers",
                      "Where a track ends follows from all that lies before.",
                      "lengths and radii in metres"});
  }
  parts_.push_back(std::move(part));
}

DrawnTrack::DrawnTrack(Angle entry_slope_angle, const std::vector<TrackSegment>& segments) : joints_{0.0} {
  if (segments.empty()) {
    throw InputError({"segments", "there are none", "A track needs at least one segment.", ""});
  }
  if (!std::isfinite(entry_slope_angle.radians())) {
    throw InputError(
        {"", "entry slope angle: " + exact_text(entry_slope_angle.degrees()) + " deg is not finite", "", ""});
  }
  end_.slope_angle = entry_slope_angle.radians();
  std::vector<ClothoidSegment> run;
  const auto end_run = [&] {
    if (run.empty()) return;
    append({end_, ClothoidSpline(Angle::from_radians(end_.slope_angle), std::exchange(run, {}))});
  };
  for (const TrackSegment& segment : segments) {
    if (const auto* const clothoid = std::get_if<ClothoidSegment>(&segment)) {
      run.push_back(*clothoid);
      continue;
    }
    end_run();
    const auto& cubic = std::get<CubicSegment>(segment);
    append({end_, Bend{bend_of(cubic), cubic.turn.radians() < 0.0 ? -1.0 : 1.0, cubic.begins_bent}});
  }
  end_run();
}

const DrawnTrack::Part& DrawnTrack::part_at(double s) const {
  require_on_track(s);
  const auto next = std::upper_bound(parts_.begin(), parts_.end(), s, [](double value, const Part& part) {
    return value < part.start.arc_length;
  });
  return *std::prev(next);
}

CenterlinePoint DrawnTrack::at(double s) const {
  const Part& part = part_at(s);
  CenterlinePoint point = part.at(std::min(s - part.start.arc_length, part.length()));
  point.arc_length = s;
  return point;
}

double DrawnTrack::slope_angle(double s) const {
  return direction(s).slope_angle;
}

Direction DrawnTrack::direction(double s) const {
  const Part& part = part_at(s);
  return part.direction(std::min(s - part.start.arc_length, part.length()));
}

CenterlinePtr joined(Angle entry_slope_angle, const std::vector<TrackSegment>& segments) {
  std::vector<ClothoidSegment> clothoids;
  for (const TrackSegment& segment : segments) {
    const auto* const clothoid = std::get_if<ClothoidSegment>(&segment);
    if (clothoid == nullptr) return std::make_shared<DrawnTrack>(entry_slope_angle, segments);
    clothoids.push_back(*clothoid);
  }
  return std::make_shared<ClothoidSpline>(entry_slope_angle, std::move(clothoids));
}

namespace {

void require_way(Vec2 way, Angle entry) {
  if (std::isfinite(way.x) && std::isfinite(way.y) && way != Vec2{} && std::isfinite(entry.radians())) return;
  throw InputError(
      {"", "way: " + exact_text(way.x) + " m by " + exact_text(way.y) + " m, entered at " + angle_text(entry),
       "It is finite, its slope angle too, and leads to another place.", ""});
}

}  // namespace

std::optional<ClothoidSegment> arc_to(Vec2 way, Angle entry) {
  require_way(way, entry);
  const double chord = math::hypot(way.x, way.y);
  // Between tangent and chord there is half the angle that an arc turns by.
  const double half_turn = wrapped(entry.radians() - math::atan2(way.y, way.x));
  constexpr double kBehind = 1e-9;
  if (std::fabs(half_turn) > std::numbers::pi - kBehind) return {};
  const double sine = math::sin(half_turn);
  if (sine == 0.0) return ClothoidSegment{chord, 0.0, 0.0};
  const double curvature = 2.0 * sine / chord;
  return ClothoidSegment{chord * (half_turn / sine), curvature, curvature};
}

// Along the chord, of length 1, with theta counted upwards from it: theta = theta_0 + (delta - A) s + A s^2 over the
// share s of the length, delta = theta_1 - theta_0. It ends on the chord where Int sin theta ds = 0, one equation for A;
// the chord over the length is Int cos theta ds.
std::optional<ClothoidSegment> clothoid_to(Vec2 way, Angle entry, Angle exit) {
  require_way(way, entry);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  constexpr double kFarthest = 0.75 * std::numbers::pi;
  const double chord = math::hypot(way.x, way.y);
  const double direction = math::atan2(way.y, way.x);
  const double begins = wrapped(direction - entry.radians());
  const double delta = wrapped(direction - exit.radians()) - begins;
  if (std::fabs(begins) > kFarthest || std::fabs(begins + delta) > kFarthest) return {};
  double a = 3.0 * (2.0 * begins + delta);
  const auto angle = [&](double s) { return begins + s * (delta - a * (1.0 - s)); };
  constexpr int kMostSteps = 30;
  for (int i = 0; i < kMostSteps; ++i) {
    const double off = Rule::integrate([&](double s) { return math::sin(angle(s)); }, 0.0, 1.0);
    const double slope =
        Rule::integrate([&](double s) { return s * (s - 1.0) * math::cos(angle(s)); }, 0.0, 1.0);
    const double step = off / slope;
    if (!std::isfinite(step)) return {};
    a -= step;
    if (std::fabs(step) > 1e-13 * (1.0 + std::fabs(a))) continue;
    const double share = Rule::integrate([&](double s) { return math::cos(angle(s)); }, 0.0, 1.0);
    if (!(share > 0.0)) return {};
    const double length = chord / share;
    return ClothoidSegment{length, (delta - a) / length, (delta + a) / length};
  }
  return {};
}

}  // namespace glissade
