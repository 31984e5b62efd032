// The centerline of every kind that a design may name, made of what it says of it.

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/cycloid.hpp"
#include "glissade/centerline/drawn_track.hpp"
#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/centerline/in_run.hpp"
#include "glissade/centerline/no_curvature_load.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/centerline/tabulated_curve.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/design/stream_channel.hpp"
#include "glissade/io/profile_csv.hpp"
#include "glissade/pipeline/solve.hpp"

#include "pipeline/task/body.hpp"
#include "pipeline/task/located.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade {

using namespace pipeline;

Endpoints endpoints_of(const Design& design) {
  const Vec3 way = design.track.finish - design.track.start;
  return {math::hypot(way.x, way.y), -way.z};
}

namespace {

/// The tracks on which a stream keeps the speed at which it enters, and with it its depth and its friction.
///
/// A faster stream is thinner and rubs less. At the speed at which its friction angle is that of the chord the track is
/// straight. Slower ones rub more: their tracks are crests, which start flatter the slower they are, in the end uphill, where
/// a stream takes off. Faster ones rub less: their tracks start steeper than the chord, and where the speed is not enough to
/// give off the energy steeper than vertical.
class EvenDepth {
 public:
  EvenDepth(const Design& design, const Endpoints& endpoints)
      : body_(body_of(design)), endpoints_(endpoints), gravity_(design.gravity) {}

  [[nodiscard]] double entry() const { return body_.entry_speed; }
  /// @return none where at that speed the stream chokes, or its track would start as none can
  [[nodiscard]] std::optional<ConstantSpeedCurve> track(double speed) const;
  [[nodiscard]] bool rubs_more_than_chord(double speed) const {
    return friction_at(speed).coefficient() * std::abs(endpoints_.run) > endpoints_.drop;
  }
  /// @return a speed from which on there is a track at every one, above all at which there is none [m/s]; none if there is
  ///         no such speed
  [[nodiscard]] std::optional<double> least_speed() const;

 private:
  [[nodiscard]] Friction friction_at(double speed) const {
    return Friction::from_coefficient(body_.law->resistance(0.0, speed * speed).factor *
                                      body_.friction.coefficient());
  }
  /// @return the speed at which a track with that friction starts upright [m/s]
  [[nodiscard]] double upright(const Friction& friction) const {
    return std::sqrt(ConstantSpeedCurve::smallest_p(endpoints_, friction, gravity_));
  }
  [[nodiscard]] double least_of_crests(double kept) const;

  Body body_;
  Endpoints endpoints_;
  double gravity_;
};

std::optional<ConstantSpeedCurve> EvenDepth::track(double speed) const {
  if (!(speed * speed > body_.law->least_v(0.0)) || speed < upright(friction_at(speed))) return {};
  ConstantSpeedCurve curve(endpoints_, friction_at(speed), gravity_, speed * speed);
  if (!curve.holds_body()) return {};
  return curve;
}

/// @param kept  a speed from which on there is a track at every one [m/s]
double EvenDepth::least_of_crests(double kept) const {
  constexpr int kHalvings = 100;  // rounding: more than it takes to the last digit of a speed
  double refused = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double tried = 0.5 * (refused + kept);
    (track(tried) ? kept : refused) = tried;
  }
  return kept;
}

std::optional<double> EvenDepth::least_speed() const {
  constexpr double kFastest = 1e6;  // budget: beyond all speeds of designs [m/s]
  if (!track(kFastest)) return {};
  if (body_.friction.coefficient() * std::abs(endpoints_.run) >= endpoints_.drop)
    return least_of_crests(kFastest);
  // What a speed needs falls with that speed, and most is needed by one without depth. From there every step ends above the
  // greatest speed that is just enough, and between two of them there is a track at every one. A step the other way, from a
  // speed that is too low, leads anywhere.
  constexpr int kSteps = 10'000;     // budget: of some microseconds each
  constexpr double kSettled = 1e-9;  // accuracy: relative, below what a message shows
  double kept = kFastest;
  double needed = upright(body_.friction);
  for (int i = 0; i < kSteps && needed < kept * (1.0 - kSettled); ++i) {
    if (rubs_more_than_chord(needed)) return least_of_crests(kept);
    kept = needed;
    needed = upright(friction_at(kept));
  }
  return std::max(kept, std::sqrt(body_.law->least_v(0.0)));
}

/// @return where a width begins to differ from that of the start [m]; infinite of one width
double narrows_or_widens_from(const WidthLaw& width) {
  const std::vector<WidthAt>& knots = width.knots();
  const auto other = std::find_if(knots.begin(), knots.end(),
                                  [&](const WidthAt& knot) { return knot.width != knots.front().width; });
  return other == knots.end() ? HUGE_VAL : std::prev(other)->at;
}

/// A stream keeps its speed and its depth where it rubs alike all along, and nothing else resists. What begins beyond the finish
/// changes nothing.
/// @throws InputError if on a track of that length it does not
void require_alike(const Design& design, double length) {
  const Body body = body_of(design);
  const std::vector<FrictionChange>& changes = body.friction_changes;
  const std::string hint = " all along, or kind: fastest with objective: even_speed, which keeps the speed ";
  if (body.drag_per_metre > 0.0) {
    const char* const key = design.body.drag ? "body.drag_area" : "body.drag";
    throw InputError(
        {design.where(key), "constant-speed without p, of a stream with drag",
         "The curve of even burden depth is that of friction alone; drag would slow the stream down "
         "on it.",
         "no drag, or kind: fastest with objective: even_speed, which keeps the speed and the depth "
         "as even as they can be"});
  }
  if (!changes.empty() && changes.front().from < length) {
    throw InputError({design.where("body.friction"),
                      "constant-speed without p, where friction changes along the track",
                      "The curve of even burden depth is that of one friction; this one changes at " +
                          length_text(changes.front().from) + ".",
                      "one friction" + hint + "and the depth as even as they can be"});
  }
  const double from = narrows_or_widens_from(stream_channel(design.cross_section.value()).value().width);
  if (from >= length) return;
  throw InputError({design.where("cross_section.width"),
                    "constant-speed without p, where the width changes along the track",
                    "The curve of even burden depth is that of one width; this one changes from " +
                        length_text(from) + " on.",
                    "one width" + hint + "as even as it can be"});
}

/// @throws InputError if at the entry speed there is no such track, with the speed from which on there is
CenterlinePtr make_even_depth(const Design& design, const Endpoints& endpoints) {
  require_alike(design, math::hypot(endpoints.run, endpoints.drop));  // whatever the track
  const EvenDepth even(design, endpoints);
  if (const auto curve = even.track(even.entry())) {
    require_alike(design, curve->length());
    return std::make_shared<ConstantSpeedCurve>(*curve);
  }
  constexpr double kBeyond = 1.0 + 1e-3;  // rounding: not rounded onto what is not enough
  constexpr int kDigits = 4;              // taste
  const auto text = [](double speed, int digits) { return rounded_text(speed, digits) + " m/s"; };
  const bool crest = even.rubs_more_than_chord(even.entry());
  std::string entry = text(even.entry(), kDigits);
  std::string least;
  std::string hint;
  if (const auto needed = even.least_speed()) {
    entry = text_beyond(even.entry(), {kBeyond * *needed}, text, kDigits);
    least = " From " + text(kBeyond * *needed, kDigits) + " on there is one at every speed.";
    hint = "an entry_speed of at least " + text(kBeyond * *needed, kDigits) + ", ";
  }
  throw InputError(
      {design.where("body.entry_speed"),
       "entry_speed: no track between these points keeps a stream at " + entry,
       std::string(crest ? "So deep it rubs more than the drop gives: it would have to start uphill, where a "
                           "stream takes off."
                         : "It would have to start steeper than vertical to give off enough energy.") +
           least + " Even burden depth is the constant-speed curve (docs/chutes.md).",
       hint + (crest ? "steeper ends, or kind: fastest" : "ends less steep, or kind: fastest")});
}

/// What resists beside the friction of a sliding point has no closed form: every P is ridden.
CenterlinePtr fastest_by_rides(const Design& design, const Endpoints& endpoints, const Body& body) {
  const auto travel_time = [&](const ConstantSpeedCurve& curve) {
    try {
      const Motion motion(std::make_shared<ConstantSpeedCurve>(curve), body, design.gravity);
      return motion.arrived() ? motion.travel_time() : HUGE_VAL;
    } catch (const ConvergenceError&) {
      return HUGE_VAL;  // so close to a stall that nothing resolves it: none that arrives first
    }
  };
  return std::make_shared<ConstantSpeedCurve>(
      ConstantSpeedCurve::fastest(endpoints, body.friction, design.gravity, travel_time));
}

CenterlinePtr make_constant_speed(const Design& design, const Endpoints& endpoints) {
  const Friction friction = design.body.friction;
  if (const auto p = design.centerline.constant_speed_p) {
    return std::make_shared<ConstantSpeedCurve>(endpoints, friction, design.gravity, *p);
  }
  if (design.stream) return make_even_depth(design, endpoints);
  const Body body = body_of(design);
  if (!is_sliding_point(body) || body.drag_per_metre > 0.0) return fastest_by_rides(design, endpoints, body);
  return std::make_shared<ConstantSpeedCurve>(
      ConstantSpeedCurve::fastest(endpoints, friction, design.gravity, design.body.entry_speed));
}

CenterlinePtr make_segments(const Design& design) {
  DrawnSegments drawn = drawn_segments(design.track, design.centerline);
  if (drawn.fault) throw InputError(std::move(drawn.fault->issue));
  return joined(design.centerline.entry_slope_angle, drawn.segments);
}

/// A fault of a file's points, at their line.
[[noreturn]] void refuse_point(const CenterlineDesign& design, const ProfilePoints& profile, Issue issue,
                               std::optional<std::size_t> point) {
  issue.where = design.points_file.string();
  if (point) issue.where += ":" + std::to_string(profile.lines[*point]);
  throw InputError(std::move(issue));
}

/// Points that say how the track leads on from each: nothing is fitted.
CenterlinePtr make_tabulated(const CenterlineDesign& design, const ProfilePoints& profile) {
  std::vector<TabulatedPoint> rows;
  rows.reserve(profile.points.size());
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const Vec2 place = profile.points[i];
    rows.push_back({place.x, place.y, profile.slope_angles[i], profile.curvatures[i]});
  }
  if (const auto fault = table_fault(rows)) refuse_point(design, profile, fault->issue, fault->row);
  return std::make_shared<TabulatedCurve>(std::move(rows));
}

ProfilePoints read_points(const CenterlineDesign& design) {
  const ProfileCsvOptions options{design.points_distance_column, design.points_height_column,
                                  design.points_unit, design.points_slope_angle_column,
                                  design.points_curvature_column};
  ProfilePoints profile = read_profile_csv(design.points_file, options);
  if (auto fault = distance_fault(profile, options)) {
    fault->where = design.points_file.string();
    throw InputError(*std::move(fault));
  }
  return profile;
}

std::shared_ptr<const FittedProfile> fit_points(const CenterlineDesign& design, ProfilePoints profile) {
  if (const auto fault = profile_fault(profile.points)) {
    refuse_point(design, profile, fault->issue, fault->point);
  }
  return std::make_shared<FittedProfile>(std::move(profile.points), ProfileFit{design.points_max_deviation});
}

CenterlinePtr make_points(const Design& design) {
  ProfilePoints points = read_points(design.centerline);
  if (points.points.size() > 1) {
    auto fault = ends_fault("the points", norm(points.points.back() - points.points.front()));
    if (fault) refuse_point(design.centerline, points, *std::move(fault), points.points.size() - 1);
  }
  CenterlinePtr track;
  double deviation = 0.0;
  if (points.curvatures.empty()) {
    const auto profile = fit_points(design.centerline, std::move(points));
    deviation = profile->max_deviation();
    track = profile;
  } else {
    track = make_tabulated(design.centerline, points);
  }
  if (!design.track.finish_given) return track;
  const Endpoints end = track->endpoints();
  auto missed = missed_finish(design.track, "the points", {end.run, end.drop}, deviation);
  if (!missed) return track;
  missed->where = design.where("track.finish");
  throw InputError(*std::move(missed));
}

CenterlinePtr make_of_kind(const Design& design) {
  const Endpoints endpoints = endpoints_of(design);
  const Friction friction = design.body.friction;
  switch (design.centerline.kind) {
    case CenterlineKind::fastest:
      return fastest_track(endpoints, friction, design.body.entry_speed, design.gravity).centerline;
    case CenterlineKind::constant_speed:
      return make_constant_speed(design, endpoints);
    case CenterlineKind::straight:
      return std::make_shared<StraightLine>(endpoints);
    case CenterlineKind::cycloid:
      return std::make_shared<Cycloid>(endpoints);
    case CenterlineKind::no_curvature_load:
      return std::make_shared<NoCurvatureLoadCurve>(endpoints, friction);
    case CenterlineKind::segments:
      return make_segments(design);
    case CenterlineKind::points:
      return make_points(design);
    case CenterlineKind::in_run:
      return std::make_shared<InRun>(design.centerline.in_run.shape());
  }
  throw InternalError({"", "a centerline of this kind cannot be made", "", ""});
}

/// Looks that the body can be on the start of a track whose radius is 0 there.
/// @throws InfeasibleError if it cannot
void require_start(const Design& design, const Centerline& centerline) {
  if (!centerline.unbounded_curvature_at_start()) return;
  const LawPtr law = body_of(design).law;
  if (!law) return;
  const std::string kind(word(design.centerline.kind));
  const std::string place = design.where("centerline.kind");
  const std::string hint = "kind: fastest, or straight";
  if (law->depends_on_speed()) {
    throw InfeasibleError(
        {place,
         kind + ": the " + std::string(law->kind()) + " cannot enter a track whose radius is 0 at its start",
         "The load of what moves has no bound there, and what resists in proportion to it is stopped.",
         hint});
  }
  if (law->centre_height() > 0.0) {
    throw InfeasibleError(
        {place, kind + ": the body does not fit on the start of the track, where its radius is 0",
         "Its centre of mass runs " + length_text(law->centre_height()) +
             " above the track: it fits on what bends upwards with a larger radius than that.",
         hint + "; or a body that slides, without centre_height"});
  }
}

}  // namespace

CenterlinePtr make_centerline(const Design& design) {
  return at_place(design.where("centerline"), [&] {
    CenterlinePtr centerline = make_of_kind(design);
    require_start(design, *centerline);
    return centerline;
  });
}

Design with_finish(Design design) {
  if (design.track.finish_given) return design;
  const Endpoints end = make_centerline(design)->endpoints();
  design.track.finish = design.track.start + Vec3{end.run, 0.0, -end.drop};
  design.track.finish_given = true;
  return design;
}

}  // namespace glissade
