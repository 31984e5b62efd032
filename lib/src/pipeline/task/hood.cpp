// The hood of a transfer: what a stream does below it, whether it is in the way, and the search for hood and track together.

#include "pipeline/task/hood.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/referee/referee.hpp"
#include "glissade/trades/chute/wear.hpp"

#include "core/processor_time.hpp"
#include "optimize/box_search.hpp"
#include "pipeline/task/friction_range.hpp"
#include "pipeline/task/limits.hpp"
#include "pipeline/task/located.hpp"
#include "pipeline/task/search_goes_on.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace glissade {

using namespace pipeline;

HoodShape pipeline::shape_of(const HoodDesign& hood) {
  if (!hood.settled()) {
    throw InputError({"", "hood: something of it is still to be chosen",
                      "The search for the track chooses it: as_solved() has what it chose.", ""});
  }
  return {*hood.radius.lowest, Angle::from_radians(*hood.impact_angle.lowest),
          Angle::from_radians(*hood.exit_angle.lowest), hood.drop};
}

Design as_solved(Design design, const Track& track) {
  if (track.hood) design.hood = track.hood;
  if (design.track.free_start) design.track.start = track.placement.start();
  return design;
}

HoodPassage hood_passage(const Design& design, const Body& body) {
  return at_place(design.where("hood"), [&] {
    return pass_hood(shape_of(design.hood.value()), first_fall(design).landing, body, design.gravity);
  });
}

Range landing_spread(const Design& design, const Track& track) {
  const double nominal = hood_passage(design, track.motion.body()).start.x;
  Range spread = Range::fixed(0.0);
  for (const LevelRide& ride : track.rides()) {
    const double off = hood_passage(design, ride.motion->body()).start.x - nominal;
    spread = {std::min(*spread.lowest, off), std::max(*spread.highest, off)};
  }
  return spread;
}

double transfer_time(const Design& design, const Motion& motion) {
  return first_fall(design).time + hood_passage(design, motion.body()).time() + motion.travel_time();
}

FeedFall feed_fall(const Design& design) {
  FeedFall fall = first_fall(design);
  if (!design.hood) return fall;
  const HoodPassage passage = hood_passage(design, body_of(design));
  fall.pulley.x -= passage.start.x;
  fall.pulley.y += passage.start.y;
  return fall;
}

CenterlinePtr pipeline::turned_over(const HoodShape& hood, const Landing& feed) {
  const CenterlinePtr arc = hood_arc(hood, feed);
  const double curvature = 1.0 / hood.radius;
  return std::make_shared<const ClothoidSpline>(
      Angle::from_radians(-arc->slope_angle(0.0)),
      std::vector<ClothoidSegment>{{arc->length(), curvature, curvature}});
}

PlacedHood pipeline::placed_hood(const Design& design, const HoodPassage& passage) {
  return {hood_arc(shape_of(design.hood.value()), first_fall(design).landing),
          {-passage.start.x, -passage.start.y}};
}

namespace {

Issue no_contact(const Design& design, const HoodPassage& passage, const std::string& when) {
  const Motion& ride = passage.motion;
  const double place = ride.distance();
  const double radius = *design.hood->radius.lowest;
  const double slope = ride.centerline().slope_angle(place);
  const double presses = ride.exit_speed() * ride.exit_speed() / (design.gravity * radius);
  const std::string how = "v^2/(g R) is " + rounded_text(presses, 3) + " there, at " +
                          quantity_text(ride.exit_speed(), Dimension::speed) +
                          ", and the cosine of its slope of " + angle_text(Angle::from_radians(slope), 3) +
                          " is " + rounded_text(math::cos(slope), 3) + ".";
  return {design.where("hood"),
          when + (place == 0.0 ? "no contact where the feed meets the hood"
                               : "the stream leaves the hood after " + length_text(place) +
                                     ", before its lower edge at " + length_text(ride.centerline().length())),
          how, "a smaller radius, a faster belt, or less impact_angle"};
}

Issue stands(const Design& design, const HoodPassage& passage, const Friction& friction,
             const std::string& when) {
  if (!(passage.impact.speed_ratio > 0.0)) {
    return {design.where("hood"), when + "the stream stands where it meets the hood",
            "Friction takes all of its speed: impact_angle, " + angle_text(passage.impact.angle, 3) +
                ", and the friction angle, " + angle_text(friction.angle(), 3) + ", make 90 deg or more.",
            "an impact_angle of at most " + angle_text(steepest_impact(kSpeedToKeep, friction), 2) +
                ", or less friction"};
  }
  return {
      design.where("hood"),
      when + "the stream comes to a stand below the hood, after " + length_text(passage.motion.distance()),
      "The impact leaves " + rounded_text(100.0 * std::max(0.0, passage.impact.speed_ratio), 3) +
          " % of its speed, and there it is as deep as its channel.",
      "a smaller impact_angle, a wider channel, or less flow or friction"};
}

std::optional<Issue> problem_at(const Design& design, FrictionLevel level, const Friction& friction) {
  Body body = body_of(design);
  body.friction = friction;
  const HoodPassage passage = hood_passage(design, body);
  if (passage.holds()) return {};
  const bool range = design.body.low_friction || design.body.high_friction;
  const std::string when =
      !range ? "" : "at " + std::string(to_text(level)) + " friction, " + angle_text(friction.angle()) + ", ";
  return passage.motion.lift_off() ? no_contact(design, passage, when)
                                   : stands(design, passage, friction, when);
}

/// Limits on where things may be, seen from where the feed meets the hood and turned over with it.
Limits turned_over_limits(const Limits& limits, Vec2 entry) {
  const auto turned = [&](Vec2 point) { return Vec2{point.x - entry.x, entry.y - point.y}; };
  const auto turn_all = [&](std::vector<Vec2> points) {
    for (Vec2& point : points) point = turned(point);
    return points;
  };
  Limits result;
  result.envelope = limits.envelope;
  result.half_planes = limits.half_planes;
  for (HalfPlane& plane : result.half_planes) {
    plane.point = turned(plane.point);
    plane.forbidden.y = -plane.forbidden.y;
  }
  result.keep_outs = limits.keep_outs;
  for (KeepOut& area : result.keep_outs) {
    area.outline = turn_all(std::move(area.outline));
    area.passage = Passage::either;
  }
  result.stay_above = limits.stay_below;
  result.stay_below = limits.stay_above;
  for (std::vector<Profile>* const lines : {&result.stay_above, &result.stay_below}) {
    for (Profile& profile : *lines) profile.line = turn_all(std::move(profile.line));
  }
  return result;
}

/// A hood that stands where the design wants nothing.
std::optional<Issue> in_the_way(const Design& design) {
  if (!design.limits || !design.limits->has_clearances()) return {};
  const HoodPassage passage = hood_passage(design, body_of(design));
  Problem problem = problem_of(design);
  problem.limits = turned_over_limits(problem.limits, placed_hood(design, passage).entry);
  problem.finish = {};
  problem.low_friction.reset();
  problem.high_friction.reset();
  problem.objective = {};
  const CenterlinePtr arc = turned_over(shape_of(*design.hood), first_fall(design).landing);
  problem.endpoints = arc->endpoints();
  // Only where it is counts: what runs up it without friction gets over it.
  problem.body = {};
  problem.body.entry_speed = 2.0 * std::sqrt(2.0 * design.gravity * arc->length()) + 1.0;
  for (const LimitCheck& check : check_limits(problem, arc)) {
    const LimitId id = check.limit.id;
    const bool clearance = id == LimitId::half_planes || id == LimitId::keep_outs ||
                           id == LimitId::stay_above || id == LimitId::stay_below;
    if (!clearance || check.kept()) continue;
    LimitName name = check.limit;
    if (id == LimitId::stay_above) name.id = LimitId::stay_below;
    if (id == LimitId::stay_below) name.id = LimitId::stay_above;
    return Issue{design.where("hood"),
                 "the hood breaks " + name.key() + ": " +
                     (check.reached < 0.0 ? "it reaches in by " + length_text(-check.reached)
                                          : "it comes as near as " + length_text(check.reached)) +
                     ", the limit is " + length_text(check.value),
                 "Its floor, walls and ends count as those of the track do.",
                 "another radius or drop, or the ends elsewhere"};
  }
  return {};
}

}  // namespace

std::optional<Issue> pipeline::hood_problem(const Design& design) {
  if (!design.hood) return {};
  const BodyDesign& body = design.body;
  if (auto problem = problem_at(design, FrictionLevel::nominal, body.friction)) return problem;
  if (body.high_friction) {
    if (auto problem = problem_at(design, FrictionLevel::high, *body.high_friction)) return problem;
  }
  if (body.low_friction) {
    if (auto problem = problem_at(design, FrictionLevel::low, *body.low_friction)) return problem;
  }
  return in_the_way(design);
}

namespace {

/// The measures of a hood that a search may choose, as places in a unit box.
class Choices {
 public:
  explicit Choices(const HoodDesign& hood) : hood_(hood) {
    for (Range HoodDesign::*const range :
         {&HoodDesign::radius, &HoodDesign::impact_angle, &HoodDesign::exit_angle}) {
      if (!(hood.*range).is_fixed()) free_.push_back(range);
    }
  }
  [[nodiscard]] std::size_t size() const { return free_.size(); }
  [[nodiscard]] HoodDesign at(const std::vector<double>& place) const {
    HoodDesign hood = hood_;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Range& bounds = hood_.*free_[i];
      hood.*free_[i] = Range::fixed(*bounds.lowest + place[i] * (*bounds.highest - *bounds.lowest));
    }
    return hood;
  }

 private:
  HoodDesign hood_;
  std::vector<Range HoodDesign::*> free_;
};

/// The greatest wear below a hood and on the floor of its track, over the frictions of a design [W/m^2].
double highest_wear(const Design& design, const CenterlinePtr& centerline) {
  std::vector<Friction> frictions{design.body.friction};
  for (const auto& friction : {design.body.low_friction, design.body.high_friction}) {
    if (friction) frictions.push_back(*friction);
  }
  double highest = 0.0;
  for (const Friction& friction : frictions) {
    Body body = body_of(design);
    body.friction = friction;
    const Motion track(centerline, body, design.gravity);
    const HoodPassage passage = hood_passage(design, body);
    highest = std::max(highest, wear_of({&track, &passage.motion}).floor.value);
  }
  return highest;
}

/// What a transfer is judged by: the objective of its design over feed, hood and track. Less is better.
double cost_of(const Design& design, const CenterlinePtr& centerline) {
  Body body = body_of(design);
  if (design.objective.worst_case && design.body.high_friction) body.friction = *design.body.high_friction;
  const Motion motion(centerline, body, design.gravity);
  if (!motion.arrived() || !enters(motion)) return std::numeric_limits<double>::infinity();
  const double time = transfer_time(design, motion);
  switch (design.objective.kind) {
    case ObjectiveKind::exit_speed:
      return -motion.exit_speed();
    case ObjectiveKind::blend:
      return time - design.objective.exit_speed_weight * motion.exit_speed();
    case ObjectiveKind::least_wear: {
      const Motion below = hood_passage(design, motion.body()).motion;
      return motion.at(motion.distance()).friction_loss + below.at(below.distance()).friction_loss;
    }
    case ObjectiveKind::least_peak_wear:
      return highest_wear(design, centerline);
    default:
      return time;
  }
}

/// Looks for the choice of a hood that makes the best transfer.
class HoodSearch {
 public:
  HoodSearch(const Design& design, const RunContext& context)
      : design_(design), context_(context), choices_(*design.hood) {}

  SettledDesign found() {
    const auto best = optimizer::least_in_box(
        choices_.size(), [this](const std::vector<double>& place) { return cost(place); },
        [this] { return ends(); });
    if (!best) throw_none();
    SettledDesign settled{design_, {}, std::move(best_track_)};
    settled.design.hood = choices_.at(best->at);
    if (cut_ || !best->to_the_end) settled.hood_search = why();
    return settled;
  }

 private:
  [[nodiscard]] double spent() const { return core::processor_seconds() - before_; }

  bool ends() {
    out_of_time_ = out_of_time_ || spent() > context_.time_budget;
    const bool ends = context_.stop.stop_requested() || out_of_time_;
    cut_ = cut_ || ends;
    return ends;
  }

  /// What the best track below a hood makes of it.
  double cost(const std::vector<double>& place) {
    Design one = design_;
    one.hood = choices_.at(place);
    if (context_.progress) context_.progress("choosing the hood, try " + std::to_string(++tried_), {});
    try {
      if (auto problem = hood_problem(one)) throw InfeasibleError(*problem);
      Optimum track = track_of(one);
      const double cost = cost_of(one, track.centerline);
      if (cost < least_) {
        least_ = cost;
        if (one.centerline.kind == CenterlineKind::fastest) best_track_ = std::move(track);
      }
      return cost;
    } catch (const Interrupted&) {
      ends();
      failure_ = std::current_exception();
    } catch (const Error&) {
      ends();
      if (!failure_) failure_ = std::current_exception();
    }
    return std::numeric_limits<double>::infinity();
  }

  Optimum track_of(const Design& one) {
    // A rough track tells hoods apart: by some 1e-5 of its time it is slower than the one that is made below the best.
    constexpr int kRoughPieces = 12;  // taste
    if (one.centerline.kind != CenterlineKind::fastest) return {make_centerline(one), {}};
    RunContext inner = context_;
    inner.progress = {};
    inner.time_budget = std::max(1e-3, context_.time_budget - spent());
    Optimum optimum = search_within_limits(one, inner, kRoughPieces);
    if (optimum.report.ended_early) {
      cut_ = true;
      out_of_time_ = out_of_time_ || !context_.stop.stop_requested();
    }
    return optimum;
  }

  [[nodiscard]] EarlyHood why() const {
    if (context_.stop.stop_requested()) return {"stopped: the best hood and track so far", true, true};
    if (out_of_time_) return {"the time budget ran out: the best hood and track so far", true, false};
    return {"the hood is not known to a thousandth of its bounds after " +
                std::to_string(optimizer::kMostBoxValues) + " tries: the best one so far",
            false, false};
  }

  [[noreturn]] void throw_none() const {
    const std::string where = design_.where("hood");
    if (cut_ && context_.stop.stop_requested())
      throw Interrupted({where, "interrupted before any hood led the stream to the finish", "", ""});
    // What is wrong with the hoods that were looked at says nothing of the others.
    if (cut_) {
      OptimizeReport report;
      report.status = OptimizeStatus::no_track_found;
      report.message = "ended early, before any hood led the stream to the finish";
      report.objective = design_.objective;
      report.ended_early = true;
      throw NoTrackFound({where, report.message, "", "a larger --time-budget, or narrower bounds"}, report);
    }
    if (failure_) std::rethrow_exception(failure_);
    throw InfeasibleError(
        {where, "no hood within these bounds leads the stream to the finish", "", "wider bounds"});
  }

  const Design& design_;
  const RunContext& context_;
  Choices choices_;
  double before_ = core::processor_seconds();
  int tried_ = 0;
  bool out_of_time_ = false;
  bool cut_ = false;  ///< it, or a search for a track in it, was to end before it came to its end
  double least_ = std::numeric_limits<double>::infinity();
  std::optional<Optimum> best_track_;  ///< of the least cost
  std::exception_ptr failure_;
};

}  // namespace

SettledDesign pipeline::settled(const Design& design, const RunContext& context) {
  if (!design.hood || design.hood->settled()) return {design};
  const SearchGoesOn goes_on(context);
  return HoodSearch(design, context).found();
}

}  // namespace glissade
