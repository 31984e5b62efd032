// Points along a polygon. A curve whose curvature is continuous rings where straights meet at an angle, and whatever is cut
// beside it has crests that are none: so straights are looked for in the points themselves.
#include "centerline/profile/profile_straights.hpp"

#include "glissade/core/math.hpp"

#include "centerline/profile/profile_cost.hpp"
#include "centerline/profile/profile_partition.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glissade::centerline {
namespace {

constexpr std::size_t kFewestOnStraight = 3;                    // theory: two lie on any
constexpr std::size_t kMostStraights = kMostProfilePieces / 2;  // theory: an arc between any two

/// The line of least squares.
struct Line {
  Vec2 middle;
  Vec2 along;  // of length 1, from the first point to the last

  [[nodiscard]] double place(Vec2 point) const { return dot(point - middle, along); }
  [[nodiscard]] double away(Vec2 point) const { return cross(along, point - middle); }
  [[nodiscard]] double slope() const { return math::atan2(along.y, along.x); }
};

/// Points [from, to) on a straight.
struct Run {
  std::size_t from = 0;
  std::size_t to = 0;
};

Line line_through(const std::vector<Vec2>& points, const Run& run) {
  Line line;
  const double share = 1.0 / static_cast<double>(run.to - run.from);
  for (std::size_t i = run.from; i < run.to; ++i)
    line.middle = line.middle + share * (points[i] - points[run.from]);
  line.middle = line.middle + points[run.from];
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = run.from; i < run.to; ++i) {
    const Vec2 away = points[i] - line.middle;
    xx += away.x * away.x;
    xy += away.x * away.y;
    yy += away.y * away.y;
  }
  const auto [sine, cosine] = math::sine_cosine(0.5 * math::atan2(2.0 * xy, xx - yy));
  line.along = {cosine, sine};
  if (dot(line.along, points[run.to - 1] - points[run.from]) < 0.0) line.along = -1.0 * line.along;
  return line;
}

bool lie_straight(const std::vector<Vec2>& points, const Run& run, double tolerance) {
  const Line line = line_through(points, run);
  return std::all_of(points.begin() + static_cast<std::ptrdiff_t>(run.from),
                     points.begin() + static_cast<std::ptrdiff_t>(run.to),
                     [&](Vec2 point) { return std::fabs(line.away(point)) <= tolerance; });
}

/// The longest run from there on, by doubling and halving: every length is looked at few times.
Run longest_run(const std::vector<Vec2>& points, std::size_t from, double tolerance) {
  const auto straight = [&](std::size_t to) { return lie_straight(points, {from, to}, tolerance); };
  std::size_t good = std::min(from + 2, points.size());
  std::size_t step = 1;
  while (good < points.size() && straight(std::min(good + step, points.size()))) {
    good = std::min(good + step, points.size());
    step *= 2;
  }
  std::size_t bad = std::min(good + step, points.size() + 1);
  while (good + 1 < bad) {
    const std::size_t middle = good + (bad - good) / 2;
    (straight(middle) ? good : bad) = middle;
  }
  return {from, good};
}

/// @return none where a run is too short to be one, or runs are too many
std::optional<std::vector<Run>> runs_along(const std::vector<Vec2>& points, double tolerance) {
  std::vector<Run> runs;
  for (std::size_t from = 0; from < points.size(); from = runs.back().to) {
    runs.push_back(longest_run(points, from, tolerance));
    const bool few = runs.back().to - runs.back().from < kFewestOnStraight;
    if (few || runs.size() > kMostStraights) return {};
  }
  return runs;
}

Vec2 meeting_place(const Line& a, const Line& b) {
  const double sine = cross(a.along, b.along);
  return a.middle + (cross(b.middle - a.middle, b.along) / sine) * a.along;
}

/// Straights, and where they meet.
struct Polygon {
  std::vector<Run> runs;
  std::vector<Line> lines;
  std::vector<Vec2> kinks;  // one fewer
};

/// Gives every point to the straight on whose side of the kink it lies. @return false where one is left too short
bool settle(const std::vector<Vec2>& points, Polygon& polygon) {
  constexpr int kRounds = 4;  // measured: a run that reached over its kink by some points comes back in two
  for (int round = 0; round < kRounds; ++round) {
    polygon.lines.clear();
    polygon.kinks.clear();
    for (const Run& run : polygon.runs) polygon.lines.push_back(line_through(points, run));
    for (std::size_t k = 0; k + 1 < polygon.runs.size(); ++k) {
      const Line& before = polygon.lines[k];
      polygon.kinks.push_back(meeting_place(before, polygon.lines[k + 1]));
      const double kink = before.place(polygon.kinks.back());
      if (!std::isfinite(kink)) return false;
      std::size_t joint = polygon.runs[k].to;
      while (joint > polygon.runs[k].from && before.place(points[joint - 1]) > kink) --joint;
      while (joint < polygon.runs[k + 1].to && before.place(points[joint]) <= kink) ++joint;
      polygon.runs[k].to = joint;
      polygon.runs[k + 1].from = joint;
    }
    for (const Run& run : polygon.runs) {
      if (run.to < run.from + kFewestOnStraight) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<MeetingStraights> straights_through(const std::vector<Vec2>& points, double tolerance) {
  // An arc shorter than that is a kink: it passes a point in it by some 1e-8 of the length.
  constexpr double kShortest =
      1e-7;  // rounding: of the length; shorter ones would be lost in the places of others
  // What turns at once somewhere between points, as others have it who ask what those do not show.
  constexpr double kSharper = 20.0;  // taste: nobody draws a bend that is shorter than this part of the way
  auto runs = runs_along(points, tolerance);
  if (!runs || runs->size() < 2) return {};
  Polygon polygon{*std::move(runs), {}, {}};
  if (!settle(points, polygon)) return {};
  const std::vector<Line>& lines = polygon.lines;
  MeetingStraights found;
  const Vec2 start = points.front();
  found.profile.entry = lines.front().slope();
  found.profile.offset = -lines.front().away(start);
  const double shortest = kShortest * norm(points.back() - start);
  double from = lines.front().place(start);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    ProfilePiece straight;
    straight.shape = PieceShape::straight;
    if (k + 1 == lines.size()) {
      straight.length = lines[k].place(points.back()) - from;
      if (!(straight.length > 0.0)) return {};
      found.profile.pieces.push_back(straight);
      break;
    }
    const Vec2 kink = polygon.kinks[k];
    const double before = norm(kink - points[polygon.runs[k].to - 1]);
    const double after = norm(points[polygon.runs[k + 1].from] - kink);
    const double reach = std::max(std::min(before, after), shortest);
    const double turn =
        -math::atan2(cross(lines[k].along, lines[k + 1].along), dot(lines[k].along, lines[k + 1].along));
    straight.length = lines[k].place(kink) - reach - from;
    from = lines[k + 1].place(kink) + reach;
    ProfilePiece arc;
    arc.shape = PieceShape::arc;
    arc.length = reach * std::fabs(turn) / math::tan(0.5 * std::fabs(turn));
    arc.entry_curvature = arc.exit_curvature = turn / arc.length;
    if (!(straight.length > 0.0 && arc.length > 0.0)) return {};
    found.profile.pieces.push_back(straight);
    found.profile.pieces.push_back(arc);
    const double sharp = std::fabs(arc.entry_curvature);
    const bool seen = reach == shortest;
    found.largest.least = std::max(found.largest.least, seen ? sharp : std::fabs(turn) / (before + after));
    found.largest.greatest = std::max(found.largest.greatest, seen ? sharp : kSharper * sharp);
  }
  return found;
}

std::optional<MeetingStraights> straights_through(const std::vector<Vec2>& points) {
  constexpr double kRounding =
      1e-11;  // rounding: of the length, where coordinates are a thousand times as large
  if (points.size() < kFewestToValidate) return {};
  return straights_through(points, kRounding * norm(points.back() - points.front()));
}

}  // namespace glissade::centerline
