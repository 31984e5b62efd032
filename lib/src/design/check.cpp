#include "design/check.hpp"

#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "design/checks.hpp"
#include "design/schema_words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// Adds the design with something in a group that could not be read.
template <typename Group>
void add_with(const Design& design, std::optional<Group> Design::*member, const std::vector<Group>& groups,
              const Findings& reading, std::string_view key, std::vector<Design>& designs) {
  if (design.*member || !reading.spoiled(key)) return;
  for (const Group& group : groups) {
    designs.push_back(design);
    designs.back().*member = group;
  }
}

std::vector<FeedDesign> all_feeds() {
  std::vector<FeedDesign> feeds(3);
  feeds[0].kind = FeedKind::belt;
  feeds[1].kind = FeedKind::hopper;
  feeds[2].kind = FeedKind::free_fall;
  return feeds;
}

std::vector<FabricationDesign> all_fabrications() {
  std::vector<FabricationDesign> all(3);
  all[0].process = PlateOptions{};
  all[1].process = PrintOptions{};
  all[2].process = TimberOptions{};
  return all;
}

/// A body that slides into the track, of a range of frictions, in air.
BodyDesign body_of_everything() {
  BodyDesign body;
  body.low_friction = Friction();
  body.high_friction = body.friction;
  body.entry_speed = 1.0;
  body.drag = DragDesign{};
  body.drag->drag_area = 1.0;
  body.drag->mass = 1.0;
  body.drag_per_metre = body.drag->drag_per_metre();
  return body;
}

/// The designs that a file may mean some of whose groups could not be read.
std::vector<Design> designs_meant(const Design& design, const Findings& reading) {
  std::vector<Design> designs;
  const section::UChannel channel{1.0, 1.0, 0.01};
  add_with(design, &Design::stream, {StreamDesign{}}, reading, "stream", designs);
  add_with(design, &Design::feed, all_feeds(), reading, "feed", designs);
  add_with(design, &Design::hood, {HoodDesign{}}, reading, "hood", designs);
  add_with(design, &Design::limits, {Limits{}}, reading, "limits", designs);
  add_with(design, &Design::cross_section, {CrossSectionDesign(channel)}, reading, "cross_section", designs);
  add_with(design, &Design::fabrication, all_fabrications(), reading, "fabrication", designs);
  if (reading.spoiled("body.kind")) {
    designs.push_back(design);
    designs.back().body = body_of_everything();
  }
  if (reading.spoiled("centerline.kind")) {
    for (const auto& [name, kind] : centerline_words()) {
      designs.push_back(design);
      designs.back().centerline.kind = kind;
    }
  }
  return designs;
}

void keep_common(std::vector<Finding>& findings, const std::vector<Finding>& others) {
  std::erase_if(findings, [&](const Finding& finding) {
    return std::none_of(others.begin(), others.end(), [&](const Finding& one) {
      return one.key_paths == finding.key_paths && one.issue.what == finding.issue.what;
    });
  });
}

/// Gives a length to every measure of a section that could not be read, and notes its key path.
class MeasureFill {
 public:
  MeasureFill(double length, const Findings& reading) : length_(length), reading_(reading) {}

  void width(const char* key, WidthLaw& law, const char*) {
    if (is_unread(key)) law = length_;
  }
  void length(const char* key, double& value, const char*) {
    if (is_unread(key)) value = length_;
  }
  void optional_length(const char*, double&) const {}
  void angle(const char*, Angle&, const char*) const {}
  void corners(const char*, std::vector<Vec2>&, const char*) const {}
  void misnomer(const char*, const char*) const {}

  [[nodiscard]] const std::vector<std::string>& filled() const { return filled_; }

 private:
  [[nodiscard]] bool is_unread(const char* key) {
    const std::string path = std::string("cross_section.") + key;
    if (!reading_.spoiled(path)) return false;
    filled_.push_back(path);
    return true;
  }

  double length_;
  const Findings& reading_;
  std::vector<std::string> filled_;
};

/// What is wrong with a section one of whose measures could not be read, whatever that measure is.
std::vector<Finding> findings_of_other_measures(const Design& design, const Findings& reading) {
  std::vector<Finding> sure;
  if (!design.cross_section || !reading.spoiled("cross_section")) return sure;
  for (const double length : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0}) {  // taste: what sections measure [m]
    CrossSectionDesign section = *design.cross_section;
    MeasureFill fill(length, reading);
    section::visit_measures(section, fill);
    if (fill.filled().empty()) return {};
    Design other;
    other.cross_section = section;
    Collected there;
    check_cross_section(other, there);
    // It does not hang on what was filled in.
    for (Finding& finding : there) {
      std::erase_if(finding.key_paths, [&](const std::string& path) {
        return std::find(fill.filled().begin(), fill.filled().end(), path) != fill.filled().end();
      });
    }
    std::erase_if(there, [](const Finding& finding) { return finding.key_paths.empty(); });
    if (length == 1e-3) sure = there;
    keep_common(sure, there);
  }
  return sure;
}

}  // namespace

std::vector<Finding> sure_findings(const Design& design, const Findings& reading) {
  std::vector<Finding> sure = check_values(design);
  if (reading.empty()) return sure;
  for (const Design& other : designs_meant(design, reading)) {
    if (sure.empty()) break;
    keep_common(sure, check_values(other));
  }
  for (Finding& finding : findings_of_other_measures(design, reading)) sure.push_back(std::move(finding));
  return sure;
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
  if (body.is_driven_by_wind()) return {};
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
