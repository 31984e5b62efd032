#include "design/check.hpp"

#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "design/checks.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace glissade::design_file {

std::string metres(double value) {
  return rounded_text(value, 4) + " m";
}

std::string percent_beyond(double share, std::initializer_list<double> bounds) {
  const auto text = [](double value, int digits) { return rounded_text(100.0 * value, digits) + " %"; };
  return text_beyond(share, bounds, text);
}

double run_of(const TrackDesign& track) {
  return math::hypot(track.finish.x - track.start.x, track.finish.y - track.start.y);
}

double drop_of(const TrackDesign& track) {
  return track.start.z - track.finish.z;
}

std::string drop_over_run(const TrackDesign& track) {
  return "drop " + metres(drop_of(track)) + " over " + metres(run_of(track));
}

std::string friction_key(const Design& design) {
  if (!design.body.slides())
    return std::string(std::visit([](const auto& kind) { return kind.kResistance; }, design.body.kind));
  if (!design.body.friction_changes.empty()) return "friction";
  return design.locations.contains("body.friction_coefficient") ? "friction_coefficient" : "friction_angle";
}

std::vector<Finding> check_values(const Design& design) {
  Collected findings;
  check_track(design, findings);
  check_body(design, findings);
  check_stream(design, findings);
  check_ends(design, findings);
  check_centerline(design, findings);
  check_hill(design, findings);
  check_gates(design, findings);
  check_cross_section(design, findings);
  check_mesh(design, findings);
  check_fabrication(design, findings);
  check_export(design, findings);
  check_limits(design, findings);
  return findings;
}

namespace {

/// Whether a free finish can come as near to the start's vertical, or as deep, as reach may need.
bool finish_is_unbounded(const TrackDesign& track) {
  if (track.free_start || track.free_finish == FinishKind::anywhere)
    return track.free_finish != FinishKind::point;
  if (track.free_finish == FinishKind::vertical_line) return !track.free_range.lowest;
  if (track.free_finish != FinishKind::level) return false;
  const bool to_the_right = track.free_range.lowest && *track.free_range.lowest > track.start.x;
  const bool to_the_left = track.free_range.highest && *track.free_range.highest < track.start.x;
  return !to_the_right && !to_the_left;
}

}  // namespace

namespace {

Finding too_slow(const Design& design, Friction friction) {
  const TrackDesign& track = design.track;
  const double speed = design.body.entry_speed;
  const double needed = least_entry_speed({run_of(track), drop_of(track)}, friction, design.gravity);
  const double drop = least_drop(run_of(track), friction, speed, design.gravity);
  constexpr double kAbove = 1.0 + 1e-3;
  Issue issue;
  issue.what = "entry_speed: " + rounded_text(speed, 6) + " m/s is not more than the " +
               rounded_text(needed, 6) + " m/s that bring a body to rest at the finish (" +
               drop_over_run(track) + ", friction angle " + angle_text(friction.angle()) + ")";
  issue.why =
      "At that speed no track between these points reaches the finish, whatever its shape (docs/theory.md, "
      "reach theorem).";
  issue.hint = "an entry_speed of at least " + rounded_text(kAbove * needed, 4) + " m/s, a finish " +
               (drop < 0.0 ? "less than " : "more than ") + metres(std::fabs(drop)) +
               (drop < 0.0 ? " above" : " below") + " the start, or less friction";
  return Finding{{"body.entry_speed", "body", "track", "centerline.kind"}, std::move(issue)};
}

}  // namespace

std::optional<Finding> find_unreachable(const Design& design) {
  const TrackDesign& track = design.track;
  const BodyDesign& body = design.body;
  const double run = run_of(track);
  const double drop = drop_of(track);
  // What is out of range is told by other checks.
  if (design.feed || !(design.gravity > 0.0) || !(body.entry_speed >= 0.0)) return {};
  const Friction friction = least_friction(body);
  const double mu = friction.coefficient();
  if (finish_is_unbounded(track) || is_drawn(design.centerline.kind)) return {};
  // A wind from behind can blow a body where no slope takes it; with speed, the theorem is told of the sliding point.
  if (body.head_wind < 0.0 && body.drag_per_metre > 0.0) return {};
  if (body.entry_speed > 0.0 && (design.stream || !is_sliding_point(body))) return {};
  // It is about the centre of mass, whose ends lie up to this much more favourably than the track's.
  const double height = centre_height(body);
  const double favour = height == 0.0 ? 0.0 : height * (std::sqrt(1.0 + mu * mu) + mu);
  if (can_arrive({run, drop + favour}, friction, body.entry_speed, design.gravity)) return {};
  if (body.entry_speed > 0.0) return too_slow(design, friction);
  if (!(drop > 0.0)) return {};

  // Hints are rounded to the side on which they hold.
  constexpr double kBelow = 1.0 - 1e-3;
  constexpr double kAbove = 1.0 + 1e-3;
  const std::string key = friction_key(design);
  const bool by_coefficient = key == "friction_coefficient" || !design.body.slides();
  const Angle mean_slope = Angle::from_radians(math::atan2(drop, run));
  const auto [angle, slope] = texts_apart(Angle::from_radians(math::atan(mu)), mean_slope);
  const std::string value = by_coefficient ? rounded_text(mu, 4) + " (" + angle + ")" : angle;
  const std::string better =
      by_coefficient ? rounded_text(kBelow * drop / run, 4) : angle_text(kBelow * mean_slope);
  Issue issue;
  issue.what = key + ": " + value + (key == "friction" ? " at least" : "") +
               (angle == slope ? " is as steep as" : " is steeper than") +
               " the mean slope from start to finish, " + slope + " (" + drop_over_run(track) + ")";
  issue.why =
      "From rest, no track between these points reaches the finish, whatever its shape (docs/theory.md, "
      "reach theorem).";
  issue.hint = "a " + key + " of at most " + better + ", a drop of at least " + metres(kAbove * mu * run) +
               ", or an entry_speed of at least " +
               rounded_text(kAbove * least_entry_speed({run, drop}, friction, design.gravity), 4) + " m/s";
  return Finding{{"body." + key, "body", "track", "centerline.kind"}, std::move(issue)};
}

}  // namespace glissade::design_file
