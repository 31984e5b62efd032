// From the design's frame (x, z up) to that of the optimiser (run, drop down) and back.

#include "pipeline/task/limits.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "pipeline/task/located.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade {

using namespace pipeline;

namespace {

/// The track leads towards smaller x, so that runs count the other way.
bool is_mirrored(const TrackDesign& track) {
  return in_track_plane(track, {track.start.x + 1.0, 0.0}).x < in_track_plane(track, {track.start.x, 0.0}).x;
}

/// Places count from the end of the track that is given.
Vec2 in_plane(const TrackDesign& track, Vec2 point) {
  return track.free_start ? in_edge_plane(track, point) : in_track_plane(track, point);
}

std::vector<Vec2> in_plane(const TrackDesign& track, const std::vector<Vec2>& points) {
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const Vec2 point : points) result.push_back(in_plane(track, point));
  return result;
}

/// The limits of a design as those of a problem: run and drop in place of x and z.
Limits in_plane(const TrackDesign& track, Limits limits) {
  for (HalfPlane& plane : limits.half_planes) {
    const Vec2 point = in_plane(track, plane.point);
    plane.forbidden = in_plane(track, plane.point + plane.forbidden) - point;
    plane.point = point;
  }
  for (KeepOut& area : limits.keep_outs) area.outline = in_plane(track, area.outline);
  for (std::vector<Profile>* const lines : {&limits.stay_above, &limits.stay_below}) {
    for (Profile& profile : *lines) {
      profile.line = in_plane(track, profile.line);
      if (is_mirrored(track)) std::reverse(profile.line.begin(), profile.line.end());
    }
  }
  limits.waypoints = in_plane(track, limits.waypoints);
  return limits;
}

/// Drop grows where z falls, run where x falls on a mirrored track: then the ends of a range change places.
Range turned(const Range& range, double at_zero, double sign) {
  const auto moved = [&](const std::optional<double>& value) {
    return value ? std::optional(sign * (*value - at_zero)) : std::nullopt;
  };
  return sign > 0.0 ? Range{moved(range.lowest), moved(range.highest)}
                    : Range{moved(range.highest), moved(range.lowest)};
}

Finish finish_of(const TrackDesign& track) {
  if (track.free_start) return {track.free_finish, {}, {}};
  switch (track.free_finish) {
    case FinishKind::point:
      return {};
    case FinishKind::vertical_line:
      return {FinishKind::vertical_line, turned(track.free_range, track.start.z, -1.0)};
    case FinishKind::level:
    case FinishKind::anywhere:
      break;
  }
  Range runs = turned(track.free_range, track.start.x, is_mirrored(track) ? -1.0 : 1.0);
  // Behind the start there is no track that leads to the finish.
  if (runs.lowest && *runs.lowest <= 0.0) runs.lowest.reset();
  return {track.free_finish, runs, turned(track.free_height, track.start.z, -1.0)};
}

/// The way back for the coordinates of a free finish: from run and drop to x and z.
class FinishNames {
 public:
  explicit FinishNames(const TrackDesign& track)
      : start_(track.start),
        origin_(track.free_start ? track.finish : track.start),
        mirrored_(is_mirrored(track)),
        level_(track.start.y == track.finish.y) {}

  /// Where an envelope comes closest, as the design's limits count.
  void place(LimitCheck& check) const {
    if (!check.closest) return;
    const Vec2 point = check.closest->point;
    check.closest->point = {(level_ ? origin_.x : 0.0) + (mirrored_ ? -point.x : point.x),
                            origin_.z - point.y};
  }
  /// @param values  coordinates that belong to the limit
  void rename(LimitName& limit, std::initializer_list<double*> values) const {
    const bool drop = limit.id == LimitId::finish_drop;
    if (!drop && limit.id != LimitId::finish_run) return;
    for (double* const value : values) {
      *value = drop ? start_.z - *value : (level_ ? start_.x : 0.0) + (mirrored_ ? -*value : *value);
    }
    limit.id = drop ? LimitId::finish_z : LimitId::finish_x;
    if (limit.bound == Bound::exactly || !(drop || mirrored_)) return;
    limit.bound = limit.bound == Bound::lowest ? Bound::highest : Bound::lowest;
  }

 private:
  Vec3 start_;
  Vec3 origin_;  ///< of places
  bool mirrored_;
  bool level_;
};

/// Where a limit stands in the design file: "keep_outs[0]" at limits.keep_outs.0.
std::string place_of(const Design& design, const LimitName& limit) {
  const LimitEntry& entry = entry_of(limit.id);
  switch (entry.form) {
    case LimitForm::of_task:
      return design.where(limit.id == LimitId::finish || entry.fixable ? "track." + limit.key() : "body");
    case LimitForm::list:
      return design.where("limits." + std::string(entry.key) + "." + std::to_string(limit.index));
    default:
      return design.where("limits." + limit.key());
  }
}

/// Straight pieces that are together no shorter than the way from start to finish: only detours have room for them.
class LongLeads {
 public:
  [[nodiscard]] static std::optional<LongLeads> of(const Design& design) {
    if (!design.limits || design.track.free_finish != FinishKind::point) return {};
    const LongLeads leads(design);
    if (leads.in_ + leads.out_ < leads.chord_) return {};
    return leads;
  }

  /// @return the key of the longer one
  [[nodiscard]] std::string key() const { return in_ >= out_ ? "lead_in" : "lead_out"; }

  [[nodiscard]] std::string none_found_text() const {
    const bool both = in_ > 0.0 && out_ > 0.0;
    const auto [together, straight] = texts_apart(in_ + out_, chord_, &length_text);
    std::string text = "no track was found with ";
    if (both) {
      text += "lead_in " + length_text(in_) + " and lead_out " + length_text(out_) + ", which are " +
              together + " together, no shorter than";
    } else {
      text += key() + " " + together + ", which is no shorter than";
    }
    return text + " the straight line from start to finish, " + straight;
  }

  /// What is certain: x grows all along a track, so that a long straight piece has to be steep.
  [[nodiscard]] std::string why_text() const {
    const double longer = std::max(in_, out_);
    const bool alone = longer > chord_ && rests_;
    const double height = std::sqrt(std::max(0.0, longer * longer - run_ * run_));
    if (alone && in_ > out_) {
      return "Such a track falls " + length_text(height, 3) + " or more within lead_in, at least " +
             length_text(height - drop_, 3) + " below the finish, and has to climb from there.";
    }
    if (alone) {
      return "Such a track begins its lead_out " + length_text(height, 3) +
             " or more below the finish, and has to climb from there.";
    }
    return "What is left for such a track is a detour.";
  }

  /// The longer one made shorter, the longest first: keys and values to try.
  struct Shorter {
    Limits limits;
    std::string text;
  };
  [[nodiscard]] std::vector<Shorter> shorter(const Limits& limits) const {
    constexpr std::array<double, 4> kShares = {0.99, 0.9, 0.7, 0.5};  // taste: of the room there is
    const double beside = std::min(in_, out_);
    std::vector<Shorter> all;
    for (const double share : kShares) {
      // Where the shorter one alone takes nearly all, neither has a length of its own.
      const bool fits = beside < 0.5 * chord_;
      const double room = fits ? chord_ - beside : 0.5 * chord_;
      const double length = parse_quantity(length_text(share * room, 3), Dimension::length, key());
      Shorter one{limits, {}};
      double& longer = in_ >= out_ ? one.limits.lead_in : one.limits.lead_out;
      longer = length;
      one.text = key() + ": " + length_text(length);
      if (!fits) {
        (in_ >= out_ ? one.limits.lead_out : one.limits.lead_in) = length;
        one.text = "lead_in: " + length_text(length) + " and lead_out: " + length_text(length);
      }
      all.push_back(std::move(one));
    }
    return all;
  }

 private:
  explicit LongLeads(const Design& design)
      : in_(design.limits->lead_in),
        out_(design.limits->lead_out),
        run_(std::fabs(endpoints_of(design).run)),
        drop_(endpoints_of(design).drop),
        chord_(std::sqrt(run_ * run_ + drop_ * drop_)),
        rests_(design.body.entry_speed == 0.0 && body_of(design).head_wind >= 0.0 &&
               !landing_of(body_of(design))) {}

  double in_;
  double out_;
  double run_;
  double drop_;
  double chord_;
  bool rests_;
};

/// The bound that would do, as the design file says it.
std::string relaxation_text(const Design& design, const Relaxation& relaxation) {
  if (relaxation.limit.id == LimitId::match_belt) {
    const double off = std::fabs(relaxation.needed / design.limits->match_belt->speed - 1.0);
    return "match_belt.within: " + rounded_text(100.0 * off, 3) + " %";
  }
  const LimitId id = relaxation.limit.id;
  const bool place = id == LimitId::half_planes || id == LimitId::keep_outs || id == LimitId::stay_above ||
                     id == LimitId::stay_below;
  if (id == LimitId::waypoints) {
    return relaxation.limit.key() + " moved by " + length_text(std::fabs(relaxation.needed));
  }
  if (place && relaxation.needed < 0.0) {
    return relaxation.limit.key() + " moved away by " + length_text(relaxation.value - relaxation.needed);
  }
  return relaxation.limit.key() + ": " + quantity_text(relaxation.needed, relaxation.limit.dimension());
}

/// What would do, each bound alone; empty where nothing is known to.
std::string would_do_text(const Design& design, const Conflict& conflict) {
  std::string text;
  for (std::size_t index = 0; index < conflict.relaxations.size(); ++index) {
    if (index != 0) text += index + 1 == conflict.relaxations.size() ? " or " : ", ";
    text += relaxation_text(design, conflict.relaxations[index]);
  }
  if (conflict.relaxations.size() > 1) text += " (each alone would do)";
  return text;
}

Issue conflict_issue(const Design& design, const OptimizeReport& report) {
  const Conflict& conflict = report.conflict;
  const std::string place =
      conflict.limits.empty() ? design.where("limits") : place_of(design, conflict.limits.front().limit);
  std::string why = "Even the track that breaks them least still breaks them.";
  if (!conflict.why.empty()) why = conflict.why;
  return {place, conflict.text, std::move(why), would_do_text(design, conflict)};
}

void rename_finish(const Design& design, OptimizeReport& report) {
  const FinishNames names(design.track);
  for (LimitCheck& check : report.checks) {
    names.rename(check.limit, {&check.value, &check.reached});
    names.place(check);
  }
  for (ActiveLimit& active : report.active) names.rename(active.limit, {&active.value});
  for (StatedLimit& stated : report.conflict.limits) {
    double nothing = 0.0;
    names.rename(stated.limit, {stated.value ? &*stated.value : &nothing});
  }
  for (Relaxation& relaxation : report.conflict.relaxations) {
    names.rename(relaxation.limit, {&relaxation.value, &relaxation.needed});
  }
  // Out of reach is a sentence of its own, and knows no free finish.
  if (design.track.free_finish == FinishKind::point || report.conflict.limits.empty()) return;
  if (!report.conflict.why.empty()) return;
  report.conflict.text = conflict_text(report.conflict);
  report.message = report.conflict.text;
}

/// "at the wall rim, x 1.38 m, z 5.1 m"
std::string closest_text(const Design& design, const EnvelopePlace& place) {
  return "at the " + part_text(design, place.part) + ", x " + length_text(place.point.x) + ", z " +
         length_text(place.point.y);
}

std::string broken_text(const Design& design, const LimitCheck& check) {
  const Dimension dimension = check.limit.dimension();
  const auto [bound, reached] =
      texts_apart(check.value, check.reached,
                  [dimension](double value, int digits) { return quantity_text(value, dimension, digits); });
  std::string text = check.limit.key() + " " + bound + " is broken";
  // Where it does is told of the ride; the least load until then may lie elsewhere.
  if (check.leaves_track) return text + ": the body leaves the track";
  if (std::isfinite(check.violation)) text += " by " + quantity_text(check.violation, dimension);
  text += " (";
  // Less than nothing is no clearance: the solid reaches into the obstacle.
  if (check.closest && check.reached < 0.0) {
    text += "reaches in by " + quantity_text(-check.reached, dimension);
  } else {
    text += reached;
  }
  if (check.closest) text += " " + closest_text(design, *check.closest) + ",";
  return text + " after " + length_text(check.where) + ")";
}

}  // namespace

Envelope envelope_of(const Design& design) {
  if (!design.limits) return {};
  const Limits& limits = *design.limits;
  if (limits.clearances_from == ClearancesFrom::centerline || !limits.has_clearances()) return {};
  Envelope envelope;
  envelope.headroom = limits.envelope.headroom;
  if (!design.cross_section) return envelope;
  const CrossSection section(*design.cross_section);
  envelope.below = -section.lowest();
  envelope.above = section.highest();
  return envelope;
}

std::string part_text(const Design& design, EnvelopePart part) {
  if (part == EnvelopePart::side) return "side of the solid";
  if (part != EnvelopePart::rim || !design.cross_section) return std::string(to_text(part));
  return std::string(section::top(*design.cross_section));
}

Problem problem_of(const Design& design) {
  Problem problem;
  problem.endpoints = endpoints_of(design);
  problem.finish = finish_of(design.track);
  if (design.track.free_start) problem.places_from = PlacesFrom::finish;
  problem.body = body_of(design);
  problem.low_friction = design.body.low_friction;
  problem.high_friction = design.body.high_friction;
  problem.gravity = design.gravity;
  if (!design.limits) return problem;
  problem.limits = in_plane(design.track, *design.limits);
  problem.limits.envelope = envelope_of(design);
  problem.limits.clearances_from = ClearancesFrom::solid;
  problem.objective = design.objective;
  return problem;
}

namespace {

/// Where leads leave only detours, and none was found: there may be one, for what a search that starts from none says of
/// conflicts is no proof. Returns where there is one, or the search was not over.
void throw_none_with(const LongLeads& leads, const Design& design, OptimizeReport report,
                     OptimizeOptions options, const RunContext& context) {
  const bool proven = report.status == OptimizeStatus::infeasible && !report.conflict.why.empty();
  if (proven || report.ended_early || context.stop.stop_requested()) return;
  report.status = OptimizeStatus::no_track_found;
  report.message = leads.none_found_text();
  report.conflict.text.clear();
  const std::string would_do = would_do_text(design, report.conflict);
  std::string hint = would_do.empty() ? "shorter leads" : would_do;
  constexpr double kShare = 0.25;  // taste: of the time, for each length that may do
  options.time_budget *= kShare;
  Problem problem = problem_of(design);
  for (const LongLeads::Shorter& shorter : leads.shorter(problem.limits)) {
    problem.limits = shorter.limits;
    if (!optimize(problem, options, context.stop, context.progress).centerline) continue;
    hint = shorter.text + ", with which a track was found";
    break;
  }
  throw NoTrackFound(
      {design.where("limits." + leads.key()), report.message,
       leads.why_text() + " The search is local: there may be a track that none of its starts leads to.",
       hint},
      report);
}

}  // namespace

namespace {

/// @throws InputError if the finish lies straight below the start: all that is searched for has a run
void require_run(const Design& design) {
  if (!fixes_run(design.track.free_finish) || endpoints_of(design).run != 0.0) return;
  throw InputError(
      {design.where("track.finish.x"),
       "track.finish.x: " + quantity_text(design.track.finish.x, Dimension::length) +
           " is that of the start: there is no run",
       "From there to there it is a fall straight down, which leaves a search nothing to choose.",
       "a finish further out; or no limits, for the fall itself"});
}

}  // namespace

Optimum pipeline::search_within_limits(const Design& design, const RunContext& context, int pieces) {
  require_run(design);
  OptimizeOptions options;
  options.pieces = pieces;
  options.time_budget = context.time_budget;
  Optimum optimum = at_place(design.where("limits"), [&] {
    return optimize(problem_of(design), options, context.stop, context.progress);
  });
  rename_finish(design, optimum.report);
  if (optimum.centerline) return optimum;
  if (const auto leads = LongLeads::of(design))
    throw_none_with(*leads, design, optimum.report, options, context);
  if (optimum.report.status == OptimizeStatus::infeasible) {
    throw LimitsConflict(conflict_issue(design, optimum.report), optimum.report);
  }
  const std::string place = design.where("limits");
  if (context.stop.stop_requested()) {
    throw Interrupted({place, "interrupted before any track kept every limit", "", ""});
  }
  if (optimum.report.ended_early) {
    throw NoTrackFound({place, optimum.report.message, "", "a larger --time-budget, or wider limits"},
                       optimum.report);
  }
  const std::string would_do = would_do_text(design, optimum.report.conflict);
  throw NoTrackFound({place, optimum.report.message,
                      "The search is local: there may be a track that none of its starts leads to.",
                      would_do.empty() ? "wider limits" : would_do},
                     optimum.report);
}

std::vector<LimitCheck> pipeline::checked_limits(const Design& design, const Endpoints& endpoints,
                                                 const CenterlinePtr& centerline) {
  if (!design.limits) return {};
  Problem problem = problem_of(design);
  problem.endpoints = endpoints;
  std::vector<LimitCheck> checks =
      at_place(design.where("limits"), [&] { return check_limits(problem, centerline); });
  const FinishNames names(design.track);
  for (LimitCheck& check : checks) {
    names.rename(check.limit, {&check.value, &check.reached});
    names.place(check);
  }
  return checks;
}

std::optional<Issue> limits_problem(const Design& design, const Track& track) {
  std::string broken;
  std::string place;
  for (const LimitCheck& check : track.limit_checks) {
    if (check.kept()) continue;
    if (place.empty()) place = place_of(design, check.limit);
    broken += (broken.empty() ? "" : "; ") + broken_text(design, check);
  }
  if (broken.empty()) return {};
  return Issue{place, "this track breaks limits of the design: " + broken,
               "A track of kind " + std::string(word(design.centerline.kind)) +
                   " is not shaped by limits, only held against them.",
               "kind: fastest, which is found within the limits, or other limits"};
}

namespace {

/// What a track is the most of, as an adjective of it.
const char* best_text(ObjectiveKind kind) {
  switch (kind) {
    case ObjectiveKind::exit_speed:
      return "of the highest exit speed";
    case ObjectiveKind::least_wear:
      return "of the least wear";
    case ObjectiveKind::least_peak_wear:
      return "of the least peak wear";
    case ObjectiveKind::even_speed:
      return "of the most even speed";
    case ObjectiveKind::least_drop:
      return "lowest";
    case ObjectiveKind::least_length:
      return "shortest";
    case ObjectiveKind::least_load:
      return "of the least load";
    case ObjectiveKind::least_curvature_rate:
      return "of the most gradual bends";
    case ObjectiveKind::blend:
      return "of the best blend of travel time and exit speed";
    case ObjectiveKind::travel_time:
      break;
  }
  return "fastest";
}

}  // namespace

std::string searched_name(const Design& design) {
  return std::string(best_text(design.objective.kind)) +
         (design.limits ? " within the limits" : ", searched for");
}

std::string hint_to_search_on(bool interrupted) {
  return interrupted ? "the same command, left to come to its end" : "a larger --time-budget";
}

std::optional<Issue> search_problem(const Design& design, const Track& track) {
  if (const auto& hood = track.early_hood) {
    return Issue{design.where("hood"),
                 std::string("the search for the hood ") +
                     (hood->ended_early ? "ended early: " : "did not converge: ") + hood->message,
                 "Another hood within its bounds may make a better transfer.",
                 hood->ended_early ? hint_to_search_on(hood->interrupted)
                                   : "narrower bounds of radius, impact_angle and exit_angle"};
  }
  if (!track.search || track.search->status == OptimizeStatus::optimal) return {};
  const bool ended_early = track.search->ended_early;
  const bool to_first_order = track.search->first_order_residual <= OptimizeOptions{}.tolerance;
  const std::string why =
      is_least_bound(design.objective.kind) ? "Every limit holds, but a tighter bound may do."
      : to_first_order ? "Every limit holds, and no track near is better to first order; farther ones were "
                         "not all looked at."
      : !std::isfinite(track.search->first_order_residual)
          ? "Every limit holds, but a better track may be near: how near an optimum this one is did not come "
            "out."
          : "Every limit holds, but a better track may be near: the first-order residual is " +
                rounded_text(track.search->first_order_residual, 2) + " instead of at most " +
                rounded_text(OptimizeOptions{}.tolerance, 2) + ".";
  return Issue{
      design.where("limits"),
      "the search for the track " + searched_name(design) +
          (ended_early ? " ended early: " : " did not converge: ") + track.search->message,
      why,
      ended_early ? hint_to_search_on(track.search->interrupted) : "other limits; more time would not help"};
}

}  // namespace glissade
