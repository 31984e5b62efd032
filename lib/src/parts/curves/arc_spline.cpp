#include "glissade/parts/arc_spline.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace glissade {
namespace {

/// Pieces of a smaller bulge are straight: they rise by less than half of this share of their length. What fits leave of a
/// straight is rounding, 1e-16 to 1e-13, and its radius would be that of nothing.
constexpr double kNoBulge = 1e-10;  // rounding: a tenth of kArcSplineKink at each end

/// @return sin(x) / x
double sinc(double x) {
  return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : math::sin(x) / x;
}

/// @return the angle within half a turn of 0
double wrapped(double angle) {
  const double turn = 2.0 * std::numbers::pi;
  return angle - turn * std::nearbyint(angle / turn);
}

std::string joint_text(std::size_t joint) {
  return "joint " + std::to_string(joint);
}

}  // namespace

ArcSpline::ArcSpline(ArcPath path, double largest_kink) : path_(std::move(path)) {
  const std::vector<PathVertex>& vertices = path_.vertices;
  if (vertices.size() < 2) throw InputError({"", "arc spline: fewer than two vertices", "", ""});
  if (vertices.front().at != Vec2{})
    throw InputError({"", "arc spline: does not start at the origin", "", ""});
  path_.closed = false;
  for (PathVertex& vertex : path_.vertices) {
    if (std::fabs(vertex.bulge) < kNoBulge) vertex.bulge = 0.0;
  }
  double heading = 0.0;  // upwards of the run, so -zeta
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    const Vec2 chord = vertices[i + 1].at - vertices[i].at;
    const double distance = norm(chord);
    if (!(distance > 0.0)) {
      throw InputError({"", "arc spline: the piece after " + joint_text(i) + " has no length", "", ""});
    }
    if (!std::isfinite(distance) || !std::isfinite(vertices[i].bulge)) {
      throw InputError(
          {"",
           "arc spline: the piece after " + joint_text(i) + " is " + exact_text(distance) +
               " m long across, of bulge " + exact_text(vertices[i].bulge),
           "Both are finite; a bulge is the tangent of a quarter of the angle that its arc turns by.", ""});
    }
    const double half = 2.0 * math::atan(vertices[i].bulge);
    const double own = math::atan2(chord.y, chord.x) - half;
    const double kink = wrapped(own - heading);
    if (i > 0 && std::fabs(kink) > largest_kink) {
      throw InputError(
          {"", "arc spline: a kink of " + angle_text(Angle::from_radians(kink)) + " at " + joint_text(i),
           "Its pieces share a tangent to " + rounded_text(largest_kink, 3) + " rad.", ""});
    }
    heading = i == 0 ? own : heading + kink;
    const double length = distance / sinc(half);
    arcs_.push_back({length_, length, -heading, 2.0 * half / length});
    length_ += length;
    heading += 2.0 * half;
  }
}

std::size_t ArcSpline::arc_at(double s) const {
  const auto after = std::upper_bound(arcs_.begin() + 1, arcs_.end(), s,
                                      [](double value, const TrackArc& arc) { return value < arc.start; });
  return static_cast<std::size_t>(after - arcs_.begin()) - 1;
}

CenterlinePoint ArcSpline::at(double s) const {
  require_on_track(s);
  const std::size_t i = arc_at(s);
  const TrackArc& arc = arcs_[i];
  const double along = s - arc.start;
  const double half = 0.5 * arc.curvature * along;
  const double chord = along * sinc(half);
  const auto [sine, cosine] = math::sine_cosine(half - arc.slope_angle);
  const Vec2 from = path_.vertices[i].at;
  Vec2 point = from + Vec2{chord * cosine, chord * sine};
  if (s == length_) point = path_.vertices.back().at;
  return {s, point.x, -point.y, arc.slope_angle - arc.curvature * along, arc.curvature};
}

double ArcSpline::slope_angle(double s) const {
  return direction(s).slope_angle;
}

Direction ArcSpline::direction(double s) const {
  require_on_track(s);
  const TrackArc& arc = arcs_[arc_at(s)];
  return {arc.slope_angle - arc.curvature * (s - arc.start), arc.curvature};
}

std::vector<double> ArcSpline::breaks() const {
  std::vector<double> places;
  for (const TrackArc& arc : arcs_) places.push_back(arc.start);
  places.push_back(length_);
  return places;
}

}  // namespace glissade
