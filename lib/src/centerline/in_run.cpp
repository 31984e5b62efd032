#include "glissade/centerline/in_run.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/cubic_bend.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace glissade {
namespace {

void check_angles(const InRunShape& shape, std::vector<Issue>& problems) {
  constexpr Angle kUpright = Angle::from_radians(kRightAngle);
  const Angle gamma = shape.gamma;
  const Angle alpha = shape.alpha;
  const std::size_t before = problems.size();
  if (!(gamma > Angle() && gamma < kUpright)) {
    problems.push_back({"gamma",
                        "gamma: " + quantity_beyond(gamma.radians(), Dimension::angle, {0.0, kRightAngle}) +
                            " is out of range",
                        "The straight of an in-run falls by more than 0 and less than 90 deg.", "35 deg"});
  }
  if (!(alpha > -kUpright && alpha < kUpright)) {
    problems.push_back(
        {"alpha",
         "alpha: " + quantity_beyond(alpha.radians(), Dimension::angle, {-kRightAngle, kRightAngle}) +
             " is out of range",
         "A table lies between -90 and 90 deg.", "11 deg"});
  }
  if (problems.size() != before) return;
  const Angle turn = gamma - alpha;
  if (!(gamma > alpha)) {
    const auto [straight, table] = texts_apart(gamma, alpha);
    problems.push_back({"gamma", "gamma: " + straight + " is not above alpha, " + table,
                        "The in-run bends upwards from its straight, gamma, to its table, alpha.",
                        "the two exchanged: a straight is some 35 deg steep, a table 11 deg"});
  } else if (shape.transition == InRunTransition::cubic && turn > CubicBend::kMostTurn) {
    problems.push_back({"gamma",
                        "gamma - alpha: " + texts_apart(turn, CubicBend::kMostTurn).first +
                            " is too much for a cubic transition",
                        "A cubic transition turns by at most " + angle_text(CubicBend::kMostTurn) +
                            ": up to there its shape is told accurately. Its curvature grows up to its end "
                            "where it turns by " +
                            angle_text(CubicBend::kGrowingTurn, 3) + " at most.",
                        "transition: clothoid, or circle"});
  }
}

void check_length(const char* key, double value, const std::string& what, std::vector<Issue>& problems) {
  if (value > 0.0 && std::isfinite(value)) return;
  problems.push_back({key, std::string(key) + ": " + length_text(value) + " is not positive and finite", what,
                      std::string(key) + ": a length above 0 mm"});
}

std::vector<Issue> bend_problems(const InRunShape& shape) {
  std::vector<Issue> problems;
  check_angles(shape, problems);
  check_length("r1", shape.r1, "It is the radius of the transition where it meets the table.", problems);
  if (shape.transition == InRunTransition::two_radii) {
    check_length("first_radius", shape.first_radius, "It is the radius where the transition begins.",
                 problems);
  }
  return problems;
}

/// What the problems say names the letter already.
void refuse(std::vector<Issue> problems) {
  for (Issue& problem : problems) problem.where.clear();
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// A transition of linear curvature.
ClothoidSegment segment_of(const InRunShape& shape) {
  const double turn = shape.gamma.radians() - shape.alpha.radians();
  const double end = 1.0 / shape.r1;
  double begin = 0.0;
  if (shape.transition == InRunTransition::circle) begin = end;
  if (shape.transition == InRunTransition::two_radii) begin = 1.0 / shape.first_radius;
  return {2.0 * turn / (begin + end), begin, end};
}

}  // namespace

/// The transition in a frame of its own: arc length from E1, x and drop from there.
class InRun::Bend {
 public:
  explicit Bend(const InRunShape& shape)
      : gamma_(shape.gamma.radians()),
        cos_(math::cos(gamma_)),
        sin_(math::sin(gamma_)),
        curve_(shape.transition == InRunTransition::cubic
                   ? Curve(CubicBend(Angle::from_radians(gamma_ - shape.alpha.radians()), shape.r1))
                   : Curve(ClothoidSpline(shape.gamma, {segment_of(shape)}))) {}

  [[nodiscard]] double length() const {
    return std::visit([](const auto& curve) { return curve.length(); }, curve_);
  }

  [[nodiscard]] CenterlinePoint at(double s) const {
    if (const auto* const spline = std::get_if<ClothoidSpline>(&curve_)) {
      return spline->at(std::min(s, spline->length()));
    }
    const CubicBend::Place place = std::get<CubicBend>(curve_).at(s);
    return {s, place.along * cos_ + place.across * sin_, place.along * sin_ - place.across * cos_,
            gamma_ - place.turned, place.curvature};
  }

  [[nodiscard]] Direction direction(double s) const {
    if (const auto* const spline = std::get_if<ClothoidSpline>(&curve_)) {
      return spline->direction(std::min(s, spline->length()));
    }
    const CubicBend::Place place = std::get<CubicBend>(curve_).at(s);
    return {gamma_ - place.turned, place.curvature};
  }

 private:
  using Curve = std::variant<CubicBend, ClothoidSpline>;

  double gamma_;
  double cos_;
  double sin_;
  Curve curve_;
};

std::vector<Issue> letter_problems(const InRunShape& shape) {
  std::vector<Issue> problems = bend_problems(shape);
  check_length("t", shape.t, "An in-run ends with a table.", problems);
  return problems;
}

double transition_length(const InRunShape& shape) {
  refuse(bend_problems(shape));
  if (shape.transition == InRunTransition::cubic) {
    return CubicBend(Angle::from_radians(shape.gamma.radians() - shape.alpha.radians()), shape.r1).length();
  }
  return segment_of(shape).length;
}

InRun::InRun(const InRunShape& shape) : shape_(shape) {
  std::vector<Issue> problems = letter_problems(shape);
  check_length("length", shape.length, "An in-run leads from its start to its edge.", problems);
  refuse(std::move(problems));
  bend_ = std::make_unique<const Bend>(shape);
  e2_ = shape.length - shape.t;
  e1_ = e2_ - bend_->length();
  if (!(e1_ >= 0.0)) {
    throw InputError(
        {"r1",
         "the transition, " + length_text(bend_->length()) + " with r1 " + length_text(shape.r1) +
             ", and the table, " + length_text(shape.t) + ", are longer than the in-run, " +
             length_text(shape.length),
         "The straight above them would be " + length_text(-e1_) + " too short.",
         "a longer in-run, a smaller r1, or transition: circle, of which r1 is the radius all along"});
  }
  const CenterlinePoint e1{e1_, e1_ * math::cos(shape.gamma.radians()),
                           e1_ * math::sin(shape.gamma.radians()), shape.gamma.radians(), 0.0};
  const CenterlinePoint bend = bend_->at(bend_->length());
  begin_of_table_ = {e2_, e1.x + bend.x, e1.drop + bend.drop, shape.alpha.radians(), 0.0};
}

InRun::~InRun() = default;

std::vector<double> InRun::breaks() const {
  if (e1_ == 0.0) return {0.0, e2_, shape_.length};
  return {0.0, e1_, e2_, shape_.length};
}

CenterlinePoint InRun::at(double s) const {
  require_on_track(s);
  const double gamma = shape_.gamma.radians();
  const double cos_gamma = math::cos(gamma);
  const double sin_gamma = math::sin(gamma);
  if (s < e1_) return {s, s * cos_gamma, s * sin_gamma, gamma, 0.0};
  if (s < e2_) {
    const CenterlinePoint bend = bend_->at(s - e1_);
    return {s, e1_ * cos_gamma + bend.x, e1_ * sin_gamma + bend.drop, bend.slope_angle, bend.curvature};
  }
  const double alpha = shape_.alpha.radians();
  const double along = s - e2_;
  return {s, begin_of_table_.x + along * math::cos(alpha), begin_of_table_.drop + along * math::sin(alpha),
          alpha, 0.0};
}

double InRun::slope_angle(double s) const {
  return direction(s).slope_angle;
}

Direction InRun::direction(double s) const {
  require_on_track(s);
  if (s < e1_) return {shape_.gamma.radians(), 0.0};
  if (s < e2_) return bend_->direction(s - e1_);
  return {shape_.alpha.radians(), 0.0};
}

}  // namespace glissade
