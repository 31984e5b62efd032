#include "clearance/strip.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include "clearance/convex.hpp"
#include "core/float_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace glissade::clearance {
namespace {

constexpr int kDeepest = 40;                // rounding: a cell of a station's distance by 2^40 is a point
constexpr std::size_t kMostLooks = 200000;  // budget: the most that was measured is 40,950
// Halvings that find the foot of a point on the track.
constexpr int kFootSteps = 50;
// Depths are known to this share of themselves.
constexpr double kDepthAccuracy = 1e-6;  // accuracy: of a depth, below that of a limit
// Heights that differ by less than this share of the envelope's are the same.
constexpr double kSameHeight = 1e-9;

}  // namespace

/// What lies between two normals, and how close these come.
struct Strip::Cell {
  Rib from;
  double at_from = 0.0;
  Rib to;
  double at_to = 0.0;
  int halvings = 0;
  double bound = -core::kInfinity;  // nothing of it comes closer
};

/// The closest place found so far, and the cells that may hold a closer one, that of the least bound on top of the heap.
struct Strip::Search {
  const Region& region;
  double accuracy;
  Approach best;
  std::vector<Cell> cells;

  /// An envelope that reaches into the region at one place, be it by a rounding, may run through a post at another: the search
  /// goes on, and depths are settled to a share of themselves.
  [[nodiscard]] bool settled(double bound) const {
    return bound >= best.value - std::max(accuracy, -kDepthAccuracy * best.value);
  }
  static bool later(const Cell& a, const Cell& b) {
    return a.bound != b.bound ? a.bound > b.bound : a.from.s > b.from.s;
  }
};

Strip::Strip(const Centerline& centerline, const Envelope& envelope,
             const std::vector<CenterlinePoint>& stations)
    : centerline_(centerline), envelope_(envelope) {
  start_ = rib(stations.front());
  finish_ = rib(stations.back());
  // A plane cuts only normals of stations whose direction is within a right angle of its own.
  start_zone_ = core::kInfinity;
  finish_zone_ = -core::kInfinity;
  for (const CenterlinePoint& station : stations) {
    if (std::fabs(station.slope_angle - start_.slope) < kRightAngle) continue;
    start_zone_ = station.arc_length;
    break;
  }
  for (auto station = stations.rbegin(); station != stations.rend(); ++station) {
    if (std::fabs(station->slope_angle - finish_.slope) < kRightAngle) continue;
    finish_zone_ = station->arc_length;
    break;
  }
  ribs_.reserve(stations.size());
  for (const CenterlinePoint& station : stations) {
    ribs_.push_back(rib(station));
    cut(ribs_.back());
  }
}

Strip::Rib Strip::rib(const CenterlinePoint& point) const {
  Rib rib;
  rib.s = point.arc_length;
  rib.point = {point.x, point.drop};
  const double sine = math::sin(point.slope_angle);
  const double cosine = math::cos(point.slope_angle);
  rib.tangent = {cosine, sine};
  rib.normal = {sine, -cosine};
  rib.slope = point.slope_angle;
  rib.kappa = point.curvature;
  rib.low = -envelope_.below;
  rib.high = envelope_.top();
  return rib;
}

void Strip::cut(Rib& rib) const {
  const auto meet = [&](double ahead, double approach, bool& at_top, bool& at_bottom) {
    if (approach > 0.0 && ahead < rib.high * approach) {
      // What slides passes through an end plane as it leans.
      const double high = std::max(envelope_.headroom, ahead / approach);
      if (!(high < rib.high)) return;
      rib.high = std::max(0.0, high);
      at_top = true;
    } else if (approach < 0.0 && ahead < rib.low * approach) {
      rib.low = std::min(0.0, ahead / approach);
      at_bottom = true;
    }
  };
  if (rib.s > 0.0 && rib.s < start_zone_) {
    meet(dot(rib.point - start_.point, start_.tangent), -dot(rib.normal, start_.tangent), rib.cut_at_start,
         rib.cut_at_start);
  }
  if (rib.s < finish_.s && rib.s > finish_zone_) {
    meet(dot(finish_.point - rib.point, finish_.tangent), dot(rib.normal, finish_.tangent), rib.cut_at_finish,
         rib.cut_at_finish);
  }
}

EnvelopePart Strip::part_of(const Rib& rib, double height) const {
  const double same = kSameHeight * (envelope_.below + envelope_.top());
  // What slides is no part of the solid: above the walls, and where an end plane cuts those lower than it reaches.
  const bool leans = rib.high <= envelope_.headroom && height >= rib.high - same;
  if (envelope_.headroom > 0.0 && (leans || height > envelope_.above + same)) return EnvelopePart::headroom;
  if (height >= envelope_.top() - same)
    return envelope_.above > 0.0 ? EnvelopePart::rim : EnvelopePart::floor;
  if (height <= -envelope_.below + same) {
    return envelope_.below > 0.0 ? EnvelopePart::underside : EnvelopePart::floor;
  }
  if (rib.s == 0.0 || rib.cut_at_start) return EnvelopePart::start_face;
  if (rib.s == finish_.s || rib.cut_at_finish) return EnvelopePart::finish_face;
  return EnvelopePart::side;
}

Approach Strip::approach(const Rib& rib, const Region& region) const {
  const std::array<Vec2, 2> ends{rib.point + rib.low * rib.normal, rib.point + rib.high * rib.normal};
  const Nearest nearest = region.nearest(ends);
  const double height = dot(nearest.point - rib.point, rib.normal);
  return {nearest.value, rib.s, {part_of(rib, height), height, nearest.point}};
}

std::vector<Approach> Strip::along(const Region& region) const {
  std::vector<Approach> approaches;
  approaches.reserve(ribs_.size());
  for (const Rib& rib : ribs_) approaches.push_back(approach(rib, region));
  return approaches;
}

namespace {

/// What lies between two stations: at each height a level, its chord the line between its ends.
struct Levels {
  Vec2 floor;    ///< chord at height 0
  Vec2 leaning;  ///< by which it changes per height
  double turned = 0.0;
  double rounding = 0.0;  ///< of a difference of lengths, at height 0

  [[nodiscard]] Vec2 chord(double height) const { return floor + height * leaning; }

  /// How far a level of such a length strays from its chord.
  /// @param one_way  it does not go back
  [[nodiscard]] double straying(double height, double arc, bool one_way) const {
    const double chord = norm(this->chord(height));
    // The difference of two lengths that are all but equal is rounding.
    const double allowed = rounding + kRounding * std::fabs(height);
    const double straying = 0.5 * std::sqrt(std::max(0.0, arc - chord + allowed) * (arc + chord));
    return one_way ? std::min(straying, 0.25 * arc * turned) : straying;
  }

  /// The most that any level between two heights strays. Lengths are convex in the height: none is longer than on the line
  /// between those at the two.
  [[nodiscard]] double straying_between(double low, double low_arc, double high, double high_arc) const {
    const Vec2 from = chord(low);
    const Vec2 change = (high - low) * leaning;
    const double more = high_arc - low_arc;
    // arc^2 - chord^2 = constant + t (slope + t curvature)
    const double curvature = more * more - dot(change, change);
    const double slope = 2.0 * (low_arc * more - dot(from, change));
    if (!(curvature < 0.0)) return 0.0;  // then the ends have the most
    const double t = std::clamp(-0.5 * slope / curvature, 0.0, 1.0);
    return straying(low + t * (high - low), low_arc + t * more, false);
  }

  static constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
};

}  // namespace

// By how much the levels between two stations stray from the chords of their ends. Where none folds over, or all of each does,
// L^2 - l^2 is convex in the height, so that the ends of such heights tell. In between, past the centres of curvature of some
// stations and not yet of all, a level turns back and goes beyond both ends of its chord. Where the outermost one does, a
// length that grows evenly with the height bounds all of them.
double Strip::straying(const Rib& a, const Rib& b) const {
  const double length = b.s - a.s;
  const double turn = a.slope - b.slope;
  const double bend = std::max(std::fabs(a.kappa), std::fabs(b.kappa));
  const double turned = a.kappa * b.kappa >= 0.0 ? std::fabs(turn) : length * bend;
  const Levels levels{b.point - a.point, b.normal - a.normal, turned, Levels::kRounding * finish_.s};
  // On the floor nothing folds over, however tight the curve.
  double most = levels.straying(0.0, length, true);
  for (const double height : {-envelope_.below, envelope_.top()}) {
    if (height == 0.0) continue;
    const double least_fold = std::min(a.kappa * height, b.kappa * height);
    const double most_fold = std::max(a.kappa * height, b.kappa * height);
    if (most_fold <= 1.0) {
      most = std::max(most, levels.straying(height, length - height * turn, true));
    } else if (least_fold < 1.0) {
      most = std::max(most, levels.straying(height, length + std::fabs(height) * turned, false));
    } else {
      const double first = height / most_fold;
      const double last = height / least_fold;
      const double first_arc = std::max(0.0, length - first * turn);
      const double last_arc = std::max(0.0, last * turn - length);
      most = std::max({most, levels.straying(first, first_arc, true),
                       levels.straying_between(first, first_arc, last, last_arc),
                       levels.straying(last, last_arc, true),
                       levels.straying(height, height * turn - length, true)});
    }
  }
  return most;
}

double Strip::lower_bound(const Rib& a, const Rib& b, const Region& region) const {
  const double straying = this->straying(a, b);
  const double low = -envelope_.below;
  const double high = envelope_.top();
  Convex shape = hull({a.point + low * a.normal, a.point + high * a.normal, b.point + low * b.normal,
                       b.point + high * b.normal});
  if (a.s < start_zone_) {
    shape = clipped(shape, start_.point - straying * start_.tangent, start_.tangent);
  }
  if (b.s > finish_zone_) {
    shape = clipped(shape, finish_.point + straying * finish_.tangent, -1.0 * finish_.tangent);
  }
  double least = shape.empty() ? core::kInfinity : region.lower_bound(shape, straying);
  const double headroom = envelope_.headroom;
  if (headroom > 0.0 && (a.s < start_zone_ || b.s > finish_zone_)) {
    const Convex uncut =
        hull({a.point, a.point + headroom * a.normal, b.point, b.point + headroom * b.normal});
    least = std::min(least, region.lower_bound(uncut, straying));
  }
  return least;
}

// Whether the values at the ends of a cell tell that nothing of it comes closer than what is found.
bool Strip::passes_by(const Cell& cell, const Search& search) const {
  const Rib& a = cell.from;
  const Rib& b = cell.to;
  if (a.cut_at_start || b.cut_at_start || a.cut_at_finish || b.cut_at_finish) return false;
  // No point of the cell is further from both normals than this.
  const double height = std::max(envelope_.below, envelope_.top());
  const double turned = a.kappa * b.kappa >= 0.0
                            ? std::fabs(a.slope - b.slope)
                            : (b.s - a.s) * std::max(std::fabs(a.kappa), std::fabs(b.kappa));
  const double across = b.s - a.s + height * turned;
  const double reach = across + height;
  if (search.region.jumps_within(std::min(a.point.x, b.point.x) - reach,
                                 std::max(a.point.x, b.point.x) + reach)) {
    return false;
  }
  const double least = std::min(cell.at_from, cell.at_to);
  return least - across > std::max(0.0, search.best.value) ||
         least - search.region.steepness() * across > search.best.value;
}

void Strip::add(Cell cell, Search& search) const {
  if (cell.halvings >= kDeepest || passes_by(cell, search)) return;
  cell.bound = std::max(cell.bound, lower_bound(cell.from, cell.to, search.region));
  if (search.settled(cell.bound)) return;
  search.cells.push_back(std::move(cell));
  std::push_heap(search.cells.begin(), search.cells.end(), Search::later);
}

// Halves the cell that may hold the closest place, until none holds one that is closer than what is found.
Least Strip::least(const Region& region, const std::vector<Approach>& stations, double accuracy) const {
  Search search{region,
                accuracy,
                *std::min_element(stations.begin(), stations.end(),
                                  [](const Approach& a, const Approach& b) { return a.value < b.value; }),
                {}};
  for (std::size_t i = 0; i + 1 < ribs_.size(); ++i) {
    add({ribs_[i], stations[i].value, ribs_[i + 1], stations[i + 1].value}, search);
  }
  std::size_t looks = 0;
  while (!search.cells.empty()) {
    std::pop_heap(search.cells.begin(), search.cells.end(), Search::later);
    const Cell cell = std::move(search.cells.back());
    search.cells.pop_back();
    if (search.settled(cell.bound)) break;
    const double middle = 0.5 * (cell.from.s + cell.to.s);
    if (!(middle > cell.from.s && middle < cell.to.s)) continue;
    Rib between = rib(centerline_.at(middle));
    cut(between);
    const Approach here = approach(between, region);
    if (here.value < search.best.value) search.best = here;
    if (++looks == kMostLooks) {
      // Nothing is closer than that: no clearance is called larger than it is.
      search.best = here;
      search.best.value = cell.bound;
      break;
    }
    add({cell.from, cell.at_from, between, here.value, cell.halvings + 1, cell.bound}, search);
    add({between, here.value, cell.to, cell.at_to, cell.halvings + 1, cell.bound}, search);
  }
  return {search.best, looks};
}

/// A stretch of an edge of the envelope within a region, and the region's edges at its ends.
struct Strip::Passage {
  std::size_t entered;
  std::size_t left;
};

std::vector<Strip::Passage> Strip::passages(const Region& region, double level) const {
  struct Met {
    std::size_t cell;
    Vec2 at;
    Vec2 next;  // station
    std::size_t edge;
  };
  const auto on_level = [&](const Rib& rib) {
    return rib.point + std::clamp(level, rib.low, rib.high) * rib.normal;
  };
  std::vector<Met> met;
  for (std::size_t i = 0; i + 1 < ribs_.size(); ++i) {
    const Vec2 from = on_level(ribs_[i]);
    const Vec2 to = on_level(ribs_[i + 1]);
    for (const Region::Crossing& crossing : region.crossings(from, to)) {
      met.push_back({i, from + crossing.share * (to - from), to, crossing.edge});
    }
  }
  std::vector<Passage> found;
  for (std::size_t k = 0; k + 1 < met.size(); ++k) {
    // From one crossing to the next nothing changes: any point between tells on which side it is.
    const Vec2 beyond = met[k].cell == met[k + 1].cell ? met[k + 1].at : met[k].next;
    const Vec2 between = 0.5 * (met[k].at + beyond);
    if (region.nearest({&between, 1}).value < 0.0) found.push_back({met[k].edge, met[k + 1].edge});
  }
  return found;
}

// A point as the track sees it: its height above the floor, at the foot of its perpendicular; the value tells how far beside that
// it lies, where it has no perpendicular.
Approach Strip::from_foot(Vec2 point) const {
  const auto near = std::min_element(ribs_.begin(), ribs_.end(), [&](const Rib& a, const Rib& b) {
    return norm(a.point - point) < norm(b.point - point);
  });
  double low = near == ribs_.begin() ? near->s : std::prev(near)->s;
  double high = std::next(near) == ribs_.end() ? near->s : std::next(near)->s;
  for (int step = 0; step < kFootSteps && high > low; ++step) {
    const double middle = 0.5 * (low + high);
    const Rib here = rib(centerline_.at(middle));
    (dot(point - here.point, here.tangent) > 0.0 ? low : high) = middle;
  }
  const Rib foot = rib(centerline_.at(0.5 * (low + high)));
  const double height = dot(point - foot.point, foot.normal);
  return {dot(point - foot.point, foot.tangent), foot.s, {part_of(foot, height), height, point}};
}

// Of corners, the one that is furthest from an edge of the envelope.
std::optional<Approach> Strip::furthest(const std::vector<Vec2>& corners, double level) const {
  std::optional<Approach> furthest;
  for (const Vec2 corner : corners) {
    Approach reach = from_foot(corner);
    reach.value = -math::hypot(reach.place.height - level, reach.value);
    if (!furthest || reach.value < furthest->value) furthest = reach;
  }
  return furthest;
}

// How far what lies between the edges of the envelope would have to move to be out of it.
std::optional<Approach> Strip::enclosed(const std::vector<Vec2>& corners) const {
  std::optional<Approach> deepest;
  for (const Vec2 corner : corners) {
    Approach inside = from_foot(corner);
    inside.value = -std::min(envelope_.top() - inside.place.height, inside.place.height + envelope_.below);
    if (inside.value < 0.0 && (!deepest || inside.value < deepest->value)) deepest = inside;
  }
  return deepest;
}

std::optional<Approach> Strip::pierced(const Region& region) const {
  std::vector<double> levels{-envelope_.below};
  if (!envelope_.is_line()) levels.push_back(envelope_.top());
  std::optional<Approach> worst;
  bool crossed = false;
  for (const double level : levels) {
    for (const Passage& passage : passages(region, level)) {
      crossed = true;
      // A part without corners is a sliver along one edge: the distance of the edge from what it cuts tells its depth.
      std::optional<Approach> least;
      for (const std::vector<Vec2>& part : region.cut_off(passage.entered, passage.left)) {
        const std::optional<Approach> reach = furthest(part, level);
        if (!reach) {
          least.reset();
          break;
        }
        if (!least || reach->value > least->value) least = reach;
      }
      if (least && (!worst || least->value < worst->value)) worst = least;
    }
  }
  return crossed ? worst : enclosed(region.corners());
}

}  // namespace glissade::clearance
