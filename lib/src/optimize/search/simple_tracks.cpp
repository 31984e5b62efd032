#include "optimize/search/simple_tracks.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/motion/motion.hpp"

#include "optimize/search/straight_fan.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

// By so much the lines' slopes differ from the mean one.
constexpr double kBends[] = {0.05, 0.15, 0.3, 0.5, 0.8};  // taste: [rad]
// Slopes stay as far off the vertical: what stands upright weighs nothing.
constexpr double kOffUpright = 0.02;  // taste: [rad]

/// The slopes that limits leave to one end.
struct SlopesOfEnd {
  double flattest = -kRightAngle + kOffUpright;
  double steepest = kRightAngle - kOffUpright;

  SlopesOfEnd(const Range& all, const Range& end) {
    for (const Range* range : {&all, &end}) {
      if (range->lowest) flattest = std::max(flattest, *range->lowest);
      if (range->highest) steepest = std::min(steepest, *range->highest);
    }
  }
  /// Those next to a slope, each once; the same one where nothing else is left.
  [[nodiscard]] std::vector<double> around(double middle) const {
    std::vector<double> slopes;
    if (flattest > steepest) return slopes;
    const auto add = [&](double slope) {
      slope = std::clamp(slope, flattest, steepest);
      if (std::find(slopes.begin(), slopes.end(), slope) == slopes.end()) slopes.push_back(slope);
    };
    for (const double bend : kBends) {
      add(middle + bend);
      add(middle - bend);
    }
    return slopes;
  }
};

/// A bend of a turn; its lines meet where it would be a corner, so far from either end of it.
struct Bend {
  std::vector<ClothoidSegment> segments;
  double from_corner = 0.0;
};

/// @param turn  by which the slope angle falls, as curvature counts [rad]; not 0
/// @param fades  whether curvature grows and fades, instead of an arc
Bend bend_of(double turn, bool fades, double from_corner) {
  Bend bend;
  if (fades) {
    bend.segments = {{1.0, 0.0, turn}, {1.0, turn, 0.0}};
  } else {
    bend.segments = {{1.0, turn, turn}};
  }
  const ClothoidSpline unit(Angle::from_radians(0.0), bend.segments);
  const CenterlinePoint end = unit.at(unit.length());
  const double corner = math::hypot(end.x, end.drop) / (2.0 * math::cos(0.5 * turn));
  const double size = from_corner / corner;
  for (ClothoidSegment& segment : bend.segments) {
    segment.length *= size;
    segment.entry_curvature /= size;
    segment.exit_curvature /= size;
  }
  bend.from_corner = from_corner;
  return bend;
}

CenterlinePtr line_bend_line(double slope, double first, const Bend& bend, double last) {
  std::vector<ClothoidSegment> segments{{first - bend.from_corner, 0.0, 0.0}};
  segments.insert(segments.end(), bend.segments.begin(), bend.segments.end());
  segments.push_back({last - bend.from_corner, 0.0, 0.0});
  std::erase_if(segments, [](const ClothoidSegment& segment) { return !(segment.length > 0.0); });
  return std::make_shared<const ClothoidSpline>(Angle::from_radians(slope), std::move(segments));
}

/// Looks at one simple track after the other.
class SimpleTracks {
 public:
  SimpleTracks(const Problem& problem, double tolerance)
      : problem_(problem),
        tolerance_(tolerance),
        entry_(problem.limits.slope_angle, problem.limits.entry_slope_angle),
        exit_(problem.limits.slope_angle, problem.limits.exit_slope_angle) {}

  [[nodiscard]] std::optional<KeptTrack> best() {
    if (problem_.finish.kind == FinishKind::anywhere) {
      from_free_start();
      for (const Vec2& finish : corners()) to(finish);
    } else {
      for (const Vec2& finish : finishes()) to(finish);
      along_fan();
    }
    return std::move(best_);
  }

 private:
  static constexpr int kMost = 150;                  // budget
  static constexpr double kWidths[] = {0.999, 0.5};  // taste: of what the lines leave to a bend

  void look(CenterlinePtr track) {
    ++looked_;
    std::optional<KeptTrack> kept = kept_track(problem_, std::move(track), tolerance_);
    if (kept && (!best_ || value_of(*kept) < value_of(*best_))) best_ = std::move(kept);
  }

  /// What is made least, or what goes with it.
  [[nodiscard]] double value_of(const KeptTrack& kept) const {
    switch (problem_.objective.kind) {
      case ObjectiveKind::exit_speed:
      case ObjectiveKind::least_wear:
        return -kept.judgement.exit_speed;
      case ObjectiveKind::least_drop:
        return kept.track->endpoints().drop;
      case ObjectiveKind::least_length:
        return kept.track->length();
      case ObjectiveKind::blend:
        return kept.judgement.travel_time - problem_.objective.exit_speed_weight * kept.judgement.exit_speed;
      default:
        return kept.judgement.travel_time;
    }
  }

  /// Where a track may end: at one place, or at a few along a line.
  [[nodiscard]] std::vector<Vec2> finishes() const {
    const Vec2 given{std::fabs(problem_.endpoints.run), problem_.endpoints.drop};
    const bool level = problem_.finish.kind == FinishKind::level;
    if (problem_.finish.kind == FinishKind::point) return {given};
    constexpr double kMean[] = {0.5, 0.8, 0.3};  // taste: [rad]
    std::vector<Vec2> finishes;
    for (const double mean : kMean) {
      const double slope = math::tan(mean);
      double free = level ? given.y / slope : given.x * slope;
      const Range& range = problem_.finish.free_range;
      if (range.lowest) free = std::max(free, *range.lowest);
      if (range.highest) free = std::min(free, *range.highest);
      if (level && !(free > 0.0)) continue;
      finishes.push_back(level ? Vec2{free, given.y} : Vec2{given.x, free});
    }
    return finishes;
  }

  /// Where both coordinates of the finish are free: the corners of where it may be, those left out at which nothing bounds it.
  [[nodiscard]] std::vector<Vec2> corners() const {
    const Range& runs = problem_.finish.free_range;
    const Range& drops = problem_.finish.free_drop;
    std::vector<Vec2> corners;
    for (const std::optional<double>& run : {runs.lowest, runs.highest}) {
      for (const std::optional<double>& drop : {drops.lowest, drops.highest}) {
        if (run && drop && *run > 0.0) corners.push_back({*run, *drop});
      }
    }
    return corners;
  }

  /// Straight lines to wherever a free finish may be.
  void along_fan() {
    if (problem_.finish.kind == FinishKind::point) return;
    const StraightFan fan(problem_);
    for (const double slope : fan.slopes()) {
      const Endpoints ends = fan.ends_at(slope);
      const double length = math::hypot(ends.run, ends.drop);
      if (length < problem_.limits.lead_in + problem_.limits.lead_out) continue;
      const std::vector<ClothoidSegment> line{{length, 0.0, 0.0}};
      look(std::make_shared<const ClothoidSpline>(Angle::from_radians(slope), line));
    }
  }

  void to(Vec2 finish) {
    const double mean = math::atan2(finish.y, finish.x);
    const Limits& limits = problem_.limits;
    if (norm(finish) >= limits.lead_in + limits.lead_out) {
      const std::vector<ClothoidSegment> line{{norm(finish), 0.0, 0.0}};
      look(std::make_shared<const ClothoidSpline>(Angle::from_radians(mean), line));
    }
    for (const double first : entry_.around(mean)) {
      for (const double last : exit_.around(mean)) {
        // The corner lies ahead of the first line and behind the last one.
        const Vec2 along{math::cos(first), math::sin(first)};
        const Vec2 behind{math::cos(last), math::sin(last)};
        const double sine = cross(along, behind);
        const double before = cross(finish, behind) / sine;
        const double after = cross(along, finish) / sine;
        const double room = std::min(before - limits.lead_in, after - limits.lead_out);
        if (!std::isfinite(room) || !(room > 0.0)) continue;
        look_at_bends(first, last, before, after, room);
      }
    }
  }

  void look_at_bends(double first, double last, double before, double after, double room) {
    for (const bool fades : {false, true}) {
      // An arc's curvature jumps.
      if (!fades && problem_.limits.highest_curvature_rate) continue;
      for (const double width : kWidths) {
        if (looked_ >= kMost) return;
        look(line_bend_line(first, before, bend_of(first - last, fades, width * room), after));
      }
    }
  }

  /// A line as long as the lowest exit speed asks for, and a bend behind it where the end is to be flatter.
  void from_free_start() {
    if (!problem_.limits.exit_speed.lowest) return;
    constexpr double kSlopes[] = {1.4, 1.1, 0.8, 0.6, 0.45, 0.3, 0.2};  // taste: [rad]
    constexpr double kWide[] = {0.1, 0.3, 1.0};                         // taste: of the drop of free fall
    const double speed = *problem_.limits.exit_speed.lowest;
    const double fall = speed * speed / (2.0 * problem_.gravity);
    std::vector<double> tried;
    for (const double slope : kSlopes) {
      const double first = std::clamp(slope, entry_.flattest, std::max(entry_.flattest, entry_.steepest));
      if (entry_.flattest > entry_.steepest || exit_.flattest > exit_.steepest) return;
      if (std::find(tried.begin(), tried.end(), first) != tried.end()) continue;
      tried.push_back(first);
      const double last = std::clamp(first, exit_.flattest, exit_.steepest);
      if (first == last) {
        reach(first, {}, fall);
        continue;
      }
      for (const double wide : kWide) {
        for (const bool fades : {false, true}) {
          if (!fades && problem_.limits.highest_curvature_rate) continue;
          if (looked_ < kMost) reach(first, bend_of(first - last, fades, wide * fall), fall);
        }
      }
    }
  }

  /// The track of that bend whose first line is just long enough for the speed.
  void reach(double slope, const Bend& bend, double fall) {
    constexpr double kLongest = 100.0;  // taste: drops of free fall
    constexpr int kHalvings = 40;       // rounding: far below the accuracy of a limit
    const Limits& limits = problem_.limits;
    const auto track_of = [&](double straight) {
      const double first = limits.lead_in + straight + bend.from_corner;
      return line_bend_line(slope, first, bend, limits.lead_out + bend.from_corner);
    };
    Body body = problem_.body;
    body.friction = problem_.high_friction.value_or(body.friction);
    const auto reaches = [&](double straight) {
      const Motion ride(track_of(straight), body, problem_.gravity);
      return ride.arrived() && ride.exit_speed() >= *limits.exit_speed.lowest;
    };
    double enough = fall;
    while (!reaches(enough)) {
      enough *= 2.0;
      if (enough > kLongest * fall) return;
    }
    double too_short = 0.0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (too_short + enough);
      (reaches(middle) ? enough : too_short) = middle;
    }
    look(track_of(enough));
  }

  const Problem& problem_;
  double tolerance_;
  SlopesOfEnd entry_;
  SlopesOfEnd exit_;
  std::optional<KeptTrack> best_;
  int looked_ = 0;
};

}  // namespace

std::optional<KeptTrack> kept_track(const Problem& problem, CenterlinePtr track, double tolerance) {
  referee::Judgement judgement = referee::judge_track(problem, track, referee::kRefereeSamples);
  if (!judgement.arrived || judgement.worst > tolerance) return std::nullopt;
  return KeptTrack{std::move(track), std::move(judgement)};
}

std::optional<KeptTrack> simple_track(const Problem& problem, double tolerance) {
  return SimpleTracks(problem, tolerance).best();
}

}  // namespace glissade::optimizer
