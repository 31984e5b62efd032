#include "solid/level_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRightAngle = 0.5 * std::numbers::pi;
constexpr std::size_t kLeaf = 8;
// A ball counts as free of a point that it reaches by less than this share of its squared radius: rounding.
constexpr double kBallMargin = 1e-13;
// Nodes next to a trim are left out where they stand closer to it than this share of the step after them.
constexpr double kCrowded = 0.15;
// How many steps around the end of a cut the crossing of the two branches is looked for.
constexpr std::size_t kCrossingWindow = 6;

double root_between(auto&& function, double low, double high) {
  const double at_low = function(low);
  const double at_high = function(high);
  if (at_low == 0.0) return low;
  if (at_high == 0.0) return high;
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      function, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

double squared(Vec2 a) {
  return dot(a, a);
}

struct Crossing {
  double first = 0.0;  // share of the way along each segment
  double second = 0.0;
};

std::optional<Crossing> segment_crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 along = b - a;
  const Vec2 other = d - c;
  const double area = cross(along, other);
  if (area == 0.0) return std::nullopt;
  const Crossing crossing{cross(c - a, other) / area, cross(c - a, along) / area};
  const bool inside =
      crossing.first >= 0.0 && crossing.first <= 1.0 && crossing.second >= 0.0 && crossing.second <= 1.0;
  if (!inside) return std::nullopt;
  return crossing;
}

// Drops every node that is not a trim and stands too close to the one kept before it, or to a trim after it.
void thin_out(std::vector<LevelNode>& nodes, double shortest) {
  const auto spacing = [&nodes](std::size_t i, std::size_t j) {
    return norm(nodes[i].point - nodes[j].point);
  };
  const std::size_t count = nodes.size();
  std::vector<bool> drop(count, false);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    if (nodes[i].trim) continue;
    const bool after_trim = nodes[i - 1].trim && spacing(i - 1, i) < kCrowded * spacing(i, i + 1);
    const bool before_trim = nodes[i + 1].trim && spacing(i, i + 1) < kCrowded * spacing(i - 1, i);
    drop[i] = after_trim || before_trim;
  }
  std::size_t kept = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const bool last = i + 1 == count;
    if (drop[i]) continue;
    if (!last && !nodes[i].trim && norm(nodes[i].point - nodes[kept].point) < shortest) continue;
    // What precedes a node that has to stay makes room for it.
    while (kept > 0 && (last || nodes[i].trim) && !nodes[kept].trim &&
           norm(nodes[i].point - nodes[kept].point) < shortest) {
      --kept;
    }
    nodes[++kept] = nodes[i];
  }
  nodes.resize(kept + 1);
}

}  // namespace

LevelCurves::LevelCurves(const Centerline& centerline, std::vector<Station> stations, double below,
                         double above)
    : centerline_(centerline), stations_(std::move(stations)), below_(below), above_(above) {
  std::size_t leaves = 1;
  while (leaves * kLeaf < stations_.size()) leaves *= 2;
  boxes_.resize(2 * leaves);
  build_boxes(1, 0, stations_.size());

  const auto rooms_of = [this](int side, double reach) {
    std::vector<double> rooms = face_rooms(side, reach);
    if (reach > 0.0 && !faces_alone_trim()) shrink_to_free_balls(side, rooms);
    return rooms;
  };
  rooms_above_ = rooms_of(1, above);
  rooms_below_ = rooms_of(-1, below);
  const auto settle = [](std::vector<double>& rooms, double reach) {
    const double least = *std::min_element(rooms.begin(), rooms.end());
    if (least < reach) return least;
    rooms.clear();
    return kInfinity;
  };
  least_above_ = settle(rooms_above_, above);
  least_below_ = settle(rooms_below_, below);
}

// A tree over the stations in their order: neighbours along a curve are neighbours in space.
void LevelCurves::build_boxes(std::size_t node, std::size_t begin, std::size_t end) {
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  if (end - begin <= kLeaf || 2 * node + 1 >= boxes_.size()) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 p = stations_[i].point;
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    boxes_[node] = box;
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  build_boxes(2 * node, begin, middle);
  build_boxes(2 * node + 1, middle, end);
  const Box& a = boxes_[2 * node];
  const Box& b = boxes_[2 * node + 1];
  boxes_[node] = {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
                  {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

// Lowers `best`, a squared distance, to that of the nearest station below it.
void LevelCurves::search(std::size_t node, std::size_t begin, std::size_t end, Vec2 point, double& best,
                         std::size_t& nearest) const {
  const auto distance_to = [point](const Box& box) {
    return squared({std::max({box.low.x - point.x, 0.0, point.x - box.high.x}),
                    std::max({box.low.y - point.y, 0.0, point.y - box.high.y})});
  };
  if (end - begin <= kLeaf || 2 * node + 1 >= boxes_.size()) {
    for (std::size_t i = begin; i < end; ++i) {
      const double distance = squared(stations_[i].point - point);
      if (distance >= best) continue;
      best = distance;
      nearest = i;
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const double first = distance_to(boxes_[2 * node]);
  const double second = distance_to(boxes_[2 * node + 1]);
  const bool first_nearer = first <= second;
  for (const bool take_first : {first_nearer, !first_nearer}) {
    if ((take_first ? first : second) >= best) continue;
    if (take_first) {
      search(2 * node, begin, middle, point, best, nearest);
    } else {
      search(2 * node + 1, middle, end, point, best, nearest);
    }
  }
}

// How far each normal goes before it passes behind an end plane. A plane cuts only stations whose direction
// is within a right angle of its own: up to there the height grows steadily along the end face.
std::vector<double> LevelCurves::face_rooms(int side, double reach) const {
  std::vector<double> rooms(stations_.size(), reach);
  const Station& start = stations_.front();
  const Station& finish = stations_.back();
  const auto pass = [&](std::size_t i, double ahead, double approach) {
    if (approach > 0.0) rooms[i] = std::min(rooms[i], ahead / approach);
  };
  for (std::size_t i = 1; i < stations_.size(); ++i) {
    const Station& station = stations_[i];
    if (std::fabs(station.slope - start.slope) >= kRightAngle) break;
    pass(i, dot(station.point - start.point, start.tangent), -side * dot(station.normal, start.tangent));
  }
  for (std::size_t i = stations_.size() - 1; i-- > 0;) {
    const Station& station = stations_[i];
    if (std::fabs(station.slope - finish.slope) >= kRightAngle) break;
    pass(i, dot(finish.point - station.point, finish.tangent), side * dot(station.normal, finish.tangent));
  }
  pass(0, 1.0, side * start.kappa);
  pass(stations_.size() - 1, 1.0, side * finish.kappa);
  return rooms;
}

// Osculating circles of a curve with monotone curvature nest (Tait-Kneser). If it is convex besides and turns
// by no more than a right angle, no point between the end planes has two feet on it (docs/solid.md).
bool LevelCurves::faces_alone_trim() const {
  const double turn = stations_.front().slope - stations_.back().slope;
  if (std::fabs(turn) > kRightAngle) return false;
  const double sign = turn >= 0.0 ? 1.0 : -1.0;
  bool rising = true;
  bool falling = true;
  for (std::size_t i = 1; i < stations_.size(); ++i) {
    const double before = sign * stations_[i - 1].kappa;
    const double here = sign * stations_[i].kappa;
    if (before < 0.0 || here < 0.0) return false;
    rising = rising && here >= before;
    falling = falling && here <= before;
  }
  return rising || falling;
}

// The ball that touches the centerline at a station from one side and holds no other station: found by
// shrinking it to the nearest station inside until there is none.
void LevelCurves::shrink_to_free_balls(int side, std::vector<double>& rooms) const {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const Station& station = stations_[i];
    double room = rooms[i];
    while (room > 0.0) {
      const Vec2 centre = offset(station, side * room);
      double best = room * room * (1.0 - kBallMargin);
      std::size_t nearest = i;
      search(1, 0, stations_.size(), centre, best, nearest);
      if (nearest == i) break;
      const Vec2 chord = stations_[nearest].point - station.point;
      const double rise = side * dot(chord, station.normal);
      if (rise <= 0.0) break;
      const double smaller = 0.5 * squared(chord) / rise;
      if (!(smaller < room)) break;
      room = smaller;
    }
    rooms[i] = room;
  }
}

// Distance by which the level's point lies ahead of the start plane.
double LevelCurves::beyond_start(double s, double height) const {
  const Station& start = stations_.front();
  return dot(offset(station_at(centerline_, s), height) - start.point, start.tangent);
}

// Distance by which it lies short of the finish plane.
double LevelCurves::beyond_finish(double s, double height) const {
  const Station& finish = stations_.back();
  return dot(finish.point - offset(station_at(centerline_, s), height), finish.tangent);
}

std::optional<Trim> LevelCurves::start_trim(double height, std::size_t last_cut) const {
  const auto ahead = [&](double s) { return beyond_start(s, height); };
  const double high = stations_[last_cut + 1].s;
  if (ahead(high) < 0.0) return std::nullopt;
  double low = stations_[last_cut].s;
  if (last_cut == 0) {
    // The level starts on the plane, passes behind it, and comes back: look between.
    low = 0.5 * high;
    while (low > 0.0 && ahead(low) >= 0.0) low *= 0.5;
  } else {
    for (std::size_t i = last_cut; i > 0 && ahead(low) > 0.0; --i) low = stations_[i - 1].s;
    if (ahead(low) > 0.0) return std::nullopt;
  }
  const double s = low > 0.0 ? root_between(ahead, low, high) : 0.0;
  const Station& start = stations_.front();
  const double along = dot(offset(station_at(centerline_, s), height) - start.point, start.normal);
  return Trim{Trim::Kind::start_face, 0.0, s, offset(start, along)};
}

std::optional<Trim> LevelCurves::finish_trim(double height, std::size_t first_cut) const {
  const auto short_of = [&](double s) { return beyond_finish(s, height); };
  const double length = stations_.back().s;
  const double low = stations_[first_cut - 1].s;
  if (short_of(low) < 0.0) return std::nullopt;
  double high = stations_[first_cut].s;
  if (first_cut + 1 == stations_.size()) {
    double gap = 0.5 * (length - low);
    while (gap > 1e-15 * length && short_of(length - gap) >= 0.0) gap *= 0.5;
    high = length - gap;
    if (short_of(high) >= 0.0) high = length;
  } else {
    for (std::size_t i = first_cut; i + 1 < stations_.size() && short_of(high) > 0.0; ++i) {
      high = stations_[i + 1].s;
    }
    if (short_of(high) > 0.0) return std::nullopt;
  }
  const double s = high < length ? root_between(short_of, low, high) : length;
  const Station& finish = stations_.back();
  const double along = dot(offset(station_at(centerline_, s), height) - finish.point, finish.normal);
  return Trim{Trim::Kind::finish_face, s, length, offset(finish, along)};
}

// The two branches of the level cross where the cut begins and ends: bracketed on their chords, then solved
// for both arc lengths by Newton's method, o' = (1 - kappa n) t.
std::optional<Trim> LevelCurves::crease(double height, std::size_t first_cut, std::size_t last_cut) const {
  const auto point = [&](std::size_t i) { return offset(stations_[i], height); };
  const std::size_t left_begin = first_cut - std::min<std::size_t>(first_cut, 3);
  const std::size_t left_end = std::min(left_begin + kCrossingWindow, last_cut);
  const std::size_t right_begin = std::min(last_cut + 3, stations_.size() - 1);
  const std::size_t right_end = std::max(right_begin - std::min(right_begin, kCrossingWindow), first_cut);
  for (std::size_t i = left_begin; i < left_end; ++i) {
    for (std::size_t j = right_begin; j > right_end; --j) {
      if (j - 1 <= i + 1 && j <= i + 2) continue;
      const auto crossing = segment_crossing(point(i), point(i + 1), point(j - 1), point(j));
      if (!crossing) continue;
      double from = stations_[i].s + crossing->first * (stations_[i + 1].s - stations_[i].s);
      double to = stations_[j - 1].s + crossing->second * (stations_[j].s - stations_[j - 1].s);
      const Vec2 on_chords = point(i) + crossing->first * (point(i + 1) - point(i));
      const double widest = 2.0 * (stations_[j].s - stations_[i].s);
      double from_now = from;
      double to_now = to;
      for (int iteration = 0; iteration < 30; ++iteration) {
        const Station a = station_at(centerline_, from_now);
        const Station b = station_at(centerline_, to_now);
        const Vec2 gap = offset(b, height) - offset(a, height);
        const Vec2 along_a = (1.0 - a.kappa * height) * a.tangent;
        const Vec2 along_b = (1.0 - b.kappa * height) * b.tangent;
        const double area = cross(along_a, along_b);
        if (norm(gap) <= 1e-14 * (centerline_.length() + std::fabs(height))) {
          return Trim{Trim::Kind::crease, from_now, to_now, 0.5 * (offset(a, height) + offset(b, height))};
        }
        const double step_from = cross(gap, along_b) / area;
        const double step_to = cross(gap, along_a) / area;
        if (!(std::fabs(step_from) < widest && std::fabs(step_to) < widest)) break;
        from_now += step_from;
        to_now += step_to;
        if (!(from_now >= 0.0 && to_now <= centerline_.length() && from_now < to_now)) break;
      }
      return Trim{Trim::Kind::crease, from, to, on_chords};
    }
  }
  // A fold smaller than the steps around it: its neighbours are joined as they are.
  if (first_cut == 0 || last_cut + 1 >= stations_.size()) return std::nullopt;
  const double gap = norm(point(last_cut + 1) - point(first_cut - 1));
  const double step = std::max(stations_[first_cut].s - stations_[first_cut - 1].s,
                               stations_[last_cut + 1].s - stations_[last_cut].s);
  if (gap > 2.0 * step) return std::nullopt;
  const Vec2 middle = 0.5 * (point(last_cut + 1) + point(first_cut - 1));
  return Trim{Trim::Kind::crease, stations_[first_cut - 1].s, stations_[last_cut + 1].s, middle};
}

// Where the room is least within a run of stations.
double LevelCurves::room_place(double height, std::size_t first, std::size_t last) const {
  const std::vector<double>& room = rooms(height);
  const auto begin = room.begin();
  const auto least = std::min_element(begin + static_cast<std::ptrdiff_t>(first),
                                      begin + static_cast<std::ptrdiff_t>(last) + 1);
  return stations_[static_cast<std::size_t>(least - begin)].s;
}

Trims LevelCurves::trims(double height) const {
  Trims trims;
  const std::vector<double>& room = rooms(height);
  const double reach = std::fabs(height);
  if (room.empty() || reach == 0.0) return trims;
  const std::size_t count = stations_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (room[i] >= reach) continue;
    const std::size_t first = i;
    while (i + 1 < count && room[i + 1] < reach) ++i;
    const bool at_start = first == 0;
    const bool at_finish = i + 1 == count;
    std::optional<Trim> trim;
    if (at_start && !at_finish) trim = start_trim(height, i);
    if (at_finish && !at_start) trim = finish_trim(height, first);
    if (!at_start && !at_finish) trim = crease(height, first, i);
    const bool forward = trim && (trims.cuts.empty() || trims.cuts.back().to < trim->from);
    if (!forward) {
      const auto kind = at_start    ? Obstacle::Kind::start_face
                        : at_finish ? Obstacle::Kind::finish_face
                                    : Obstacle::Kind::reach;
      trims.obstacle = Obstacle{kind, room_place(height, first, i)};
      return trims;
    }
    trims.cuts.push_back(*trim);
  }
  return trims;
}

LevelCurve LevelCurves::level(double height, double shortest) const {
  const std::vector<Trim> cuts = trims(height).cuts;
  LevelCurve curve;
  curve.trimmed = !cuts.empty();
  curve.nodes.reserve(stations_.size() + cuts.size());
  auto cut = cuts.begin();
  for (const Station& station : stations_) {
    while (cut != cuts.end() && cut->to < station.s) {
      curve.nodes.push_back({cut->point, cut->from, cut->to, true});
      ++cut;
    }
    if (cut != cuts.end() && station.s >= cut->from) continue;
    curve.nodes.push_back({offset(station, height), station.s, station.s, false});
  }
  for (; cut != cuts.end(); ++cut) curve.nodes.push_back({cut->point, cut->from, cut->to, true});
  thin_out(curve.nodes, shortest);
  return curve;
}

double LevelCurves::missing_length(double height) const {
  double missing = 0.0;
  for (const Trim& cut : trims(height).cuts) {
    const double turn = centerline_.slope_angle(cut.from) - centerline_.slope_angle(cut.to);
    missing += cut.to - cut.from - height * turn;
  }
  return missing;
}

double LevelCurves::largest_height(int side) const {
  double fits = 0.0;
  double fails = side > 0 ? above_ : below_;
  if (!trims(side * fails).obstacle) return fails;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (fits + fails);
    (trims(side * middle).obstacle ? fails : fits) = middle;
  }
  return fits;
}

double LevelCurves::height_of(Vec2 point) const {
  double best = kInfinity;
  std::size_t nearest = 0;
  search(1, 0, stations_.size(), point, best, nearest);
  const auto ahead = [&](const Station& station) { return dot(point - station.point, station.tangent); };
  const double there = ahead(stations_[nearest]);
  Station foot = stations_[nearest];
  const std::size_t other =
      there > 0.0 ? std::min(nearest + 1, stations_.size() - 1) : nearest - std::min<std::size_t>(nearest, 1);
  if (there * ahead(stations_[other]) < 0.0) {
    const double low = std::min(foot.s, stations_[other].s);
    const double high = std::max(foot.s, stations_[other].s);
    foot = station_at(centerline_,
                      root_between([&](double s) { return ahead(station_at(centerline_, s)); }, low, high));
  }
  const Vec2 away = point - foot.point;
  return std::copysign(norm(away), dot(away, foot.normal));
}

}  // namespace glissade
