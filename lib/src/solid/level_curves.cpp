#include "solid/level_curves.hpp"

#include "glissade/core/stop.hpp"
#include "glissade/core/units.hpp"

#include "core/float_limits.hpp"
#include "core/plane_geometry.hpp"
#include "solid/least_between.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace glissade::solid {
namespace {

// Whether the work is to end is asked once in so many stations.
constexpr std::size_t kStationsBetweenPauses = 256;
// A ball counts as free of a point that it reaches by less than this share of its squared radius: rounding.
constexpr double kBallMargin = 1e-13;
// How many steps around the end of a cut the crossing of the two branches is looked for.
constexpr std::size_t kCrossingWindow = 3;
// Distance of the probes as a share of the section's reach, and the most that a track gets.
constexpr double kProbeShare = 0.5;
constexpr double kMostProbes = 1e6;
// Places further apart along the track than this many times reach and step are different parts of it.
constexpr double kFar = 4.0;
constexpr int kNewtonSteps = 40;
// Newton's method stays within this many steps of the stations around its guess.
constexpr double kSlack = 4.0;
// Distances below this share of the track's length are rounding.
constexpr double kRounding = 1e-14;
// A level higher than the room of a station by no more than these shares, of itself and of the sharpness, just touches
// what bounds it, the centre of an arc: what folds back there is shorter than nodes are apart.
constexpr double kTouching = 1e-7;
constexpr double kTouchingOfSharpness = 0.1;
// How many pieces of a level may hide in one run of stations without room, as a power of two.
constexpr int kDeepestSplit = 4;

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

}  // namespace

LevelCurves::LevelCurves(const Centerline& centerline, std::vector<Station> stations, double below,
                         double above, double sharpness, std::stop_token stop)
    : centerline_(centerline),
      stations_(std::move(stations)),
      below_(below),
      above_(above),
      sharpness_(sharpness),
      stop_(std::move(stop)) {
  const bool faces_alone = faces_alone_trim();
  make_probes(!faces_alone);
  rooms_above_ = rooms_of(1, above, faces_alone);
  rooms_below_ = rooms_of(-1, below, faces_alone);
  const auto settle = [](std::vector<Room>& rooms) {
    double least = core::kInfinity;
    for (const Room& room : rooms) least = std::min(least, room.height);
    if (least == core::kInfinity) rooms.clear();
    return least;
  };
  least_above_ = settle(rooms_above_);
  least_below_ = settle(rooms_below_);
}

// Rooms are found up to somewhat more than the reach: contacts are seen at probes first, and then placed
// exactly.
std::vector<LevelCurves::Room> LevelCurves::rooms_of(int side, double reach, bool faces_alone) const {
  constexpr double kMargin = 1.25;
  std::vector<Room> rooms = face_rooms(side, kMargin * reach);
  if (reach > 0.0 && !faces_alone) shrink_to_free_balls(side, reach, rooms);
  for (Room& room : rooms) {
    if (room.height >= least_room_for(reach)) room.height = core::kInfinity;
  }
  return rooms;
}

// Another part of the track must not slip through between two stations: probes stand as close as half the
// reach.
void LevelCurves::make_probes(bool dense) {
  double spacing = core::kInfinity;
  if (dense) spacing = std::max(kProbeShare * std::max(above_, below_), centerline_.length() / kMostProbes);
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    probe_of_.push_back(probes_.size());
    probes_.push_back({stations_[i].point, stations_[i].normal, stations_[i].s});
    if (i + 1 == stations_.size()) break;
    const double step = stations_[i + 1].s - stations_[i].s;
    const double pieces = std::ceil(step / spacing);
    for (double piece = 1.0; piece < pieces; ++piece) {
      const Station between = station_at(centerline_, stations_[i].s + step * piece / pieces);
      probes_.push_back({between.point, between.normal, between.s});
    }
  }
  std::vector<Vec2> places;
  places.reserve(probes_.size());
  for (const Probe& probe : probes_) places.push_back(probe.point);
  tree_ = PlaceTree(std::move(places));
}

// How far each normal goes before it passes behind an end plane. A plane cuts only stations whose direction
// is within a right angle of its own: up to there the height grows steadily along the end face.
std::vector<LevelCurves::Room> LevelCurves::face_rooms(int side, double reach) const {
  std::vector<Room> rooms;
  rooms.reserve(stations_.size());
  for (const Station& station : stations_) rooms.push_back({reach, station.s});
  const Station& start = stations_.front();
  const Station& finish = stations_.back();
  const auto pass = [&](std::size_t i, double ahead, double approach) {
    if (approach > 0.0) rooms[i].height = std::min(rooms[i].height, ahead / approach);
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

// The ball that touches the centerline at a probe from one side and holds no other: found by shrinking it to
// the nearest probe inside until there is none; `exactly`: to the curve around that probe.
void LevelCurves::shrink_ball(std::size_t probe, int side, bool exactly, Room& room) const {
  const Probe& at = probes_[probe];
  const auto room_to = [&](Vec2 point) {
    const Vec2 chord = point - at.point;
    const double rise = side * dot(chord, at.normal);
    return rise > 0.0 ? 0.5 * squared(chord) / rise : core::kInfinity;
  };
  while (room.height > 0.0) {
    double best = room.height * room.height * (1.0 - kBallMargin);
    std::size_t nearest = probe;
    tree_.search(at.point + side * room.height * at.normal, best, nearest);
    if (nearest == probe) return;
    Room smaller{room_to(probes_[nearest].point), probes_[nearest].s};
    const bool elsewhere = nearest > probe + 1 || nearest + 1 < probe;
    if (exactly && elsewhere) {
      const double low = probes_[nearest - std::min<std::size_t>(nearest, 1)].s;
      const double high = probes_[std::min(nearest + 1, probes_.size() - 1)].s;
      constexpr int kBits = 20;
      constexpr std::uintmax_t kIterations = 30;
      const auto [s, height] = least_between(low, high, kBits, kIterations, [&](double there) {
        return std::min(room_to(station_at(centerline_, there).point), 2.0 * smaller.height);
      });
      if (height < smaller.height) smaller = {height, s};
    }
    if (!(smaller.height < room.height)) return;
    room = smaller;
  }
}

void LevelCurves::shrink_to_free_balls(int side, double reach, std::vector<Room>& rooms) const {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (i % kStationsBetweenPauses == 0) require_going(stop_);
    shrink_ball(probe_of_[i], side, true, rooms[i]);
  }
  // A far part of the track may come near between two stations: their room is then that of the probe between.
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
    if (i % kStationsBetweenPauses == 0) require_going(stop_);
    const double far = kFar * (reach + stations_[i + 1].s - stations_[i].s);
    for (std::size_t probe = probe_of_[i] + 1; probe < probe_of_[i + 1]; ++probe) {
      Room room{reach, probes_[probe].s};
      shrink_ball(probe, side, false, room);
      if (std::fabs(room.partner - probes_[probe].s) < far) continue;
      if (room.height < rooms[i].height) rooms[i] = room;
      if (room.height < rooms[i + 1].height) rooms[i + 1] = room;
    }
  }
}

// How far the level's point lies towards the finish from an end face.
double LevelCurves::beyond_face(const Station& face, double s, double height) const {
  return dot(offset(station_at(centerline_, s), height) - face.point, face.tangent);
}

// The trim by an end face where the level meets its plane at s.
Trim LevelCurves::face_trim(Trim::Kind kind, double s, double height) const {
  const bool at_start = kind == Trim::Kind::start_face;
  const Station& face = at_start ? stations_.front() : stations_.back();
  const double along = dot(offset(station_at(centerline_, s), height) - face.point, face.normal);
  return {kind, at_start ? 0.0 : s, at_start ? s : stations_.back().s, offset(face, along)};
}

std::optional<Trim> LevelCurves::start_trim(double height, std::size_t last_cut) const {
  const auto ahead = [&](double s) { return beyond_face(stations_.front(), s, height); };
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
  return face_trim(Trim::Kind::start_face, low > 0.0 ? root_between(ahead, low, high) : 0.0, height);
}

std::optional<Trim> LevelCurves::finish_trim(double height, std::size_t first_cut) const {
  const auto short_of = [&](double s) { return -beyond_face(stations_.back(), s, height); };
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
  return face_trim(Trim::Kind::finish_face, high < length ? root_between(short_of, low, high) : length,
                   height);
}

// Distance between the stations around s.
double LevelCurves::step_at(double s) const {
  const auto after = std::lower_bound(stations_.begin() + 1, stations_.end() - 1, s,
                                      [](const Station& station, double at) { return station.s < at; });
  return after->s - (after - 1)->s;
}

// Where the level meets an end plane, by Newton's method from a guess: o' = (1 - kappa n) t.
std::optional<Trim> LevelCurves::face_near(Trim::Kind kind, double height, double guess) const {
  const Station& face = kind == Trim::Kind::start_face ? stations_.front() : stations_.back();
  const double slack = kSlack * step_at(guess);
  double s = guess;
  for (int iteration = 0; iteration < kNewtonSteps; ++iteration) {
    const Station here = station_at(centerline_, s);
    const double beyond = dot(offset(here, height) - face.point, face.tangent);
    if (std::fabs(beyond) <= kRounding * centerline_.length()) return face_trim(kind, s, height);
    s -= beyond / ((1.0 - here.kappa * height) * dot(here.tangent, face.tangent));
    if (!(std::fabs(s - guess) <= slack && s >= 0.0 && s <= centerline_.length())) return std::nullopt;
  }
  return std::nullopt;
}

// Where two branches of the level cross, by Newton's method for both arc lengths.
std::optional<Trim> LevelCurves::crease_near(double height, double from_guess, double to_guess) const {
  const double from_slack = kSlack * step_at(from_guess);
  const double to_slack = kSlack * step_at(to_guess);
  double from = from_guess;
  double to = to_guess;
  for (int iteration = 0; iteration < kNewtonSteps; ++iteration) {
    const Station a = station_at(centerline_, from);
    const Station b = station_at(centerline_, to);
    const Vec2 gap = offset(b, height) - offset(a, height);
    if (norm(gap) <= kRounding * (centerline_.length() + std::fabs(height))) {
      // The branches of a fold also meet at its cusps, where the level turns back.
      if (!(a.kappa * height < 1.0 && b.kappa * height < 1.0)) return std::nullopt;
      return Trim{Trim::Kind::crease, from, to, offset(a, height) + 0.5 * gap};
    }
    const Vec2 along_a = (1.0 - a.kappa * height) * a.tangent;
    const Vec2 along_b = (1.0 - b.kappa * height) * b.tangent;
    const double area = cross(along_a, along_b);
    from += cross(gap, along_b) / area;
    to += cross(gap, along_a) / area;
    const bool near = std::fabs(from - from_guess) <= from_slack && std::fabs(to - to_guess) <= to_slack;
    if (!(near && from >= 0.0 && to <= centerline_.length() && from < to)) return std::nullopt;
  }
  return std::nullopt;
}

// The two branches of the level cross where the cut begins and ends: found on their chords, then solved.
// Beside the crossing itself, chords may cross at the cusps of the part that folds over; only the former is
// sharp.
std::vector<Trim> LevelCurves::crease_trims(double height, std::size_t first_cut,
                                            std::size_t last_cut) const {
  std::vector<Trim> trims;
  const auto point = [&](std::size_t i) { return offset(stations_[i], height); };
  const std::size_t last_station = stations_.size() - 1;
  const std::size_t left_begin = first_cut - std::min(first_cut, kCrossingWindow);
  const std::size_t left_end = std::min(first_cut + kCrossingWindow, last_cut + 1);
  const std::size_t right_begin = std::min(last_cut + kCrossingWindow, last_station);
  const std::size_t right_end = std::max(last_cut - std::min(last_cut, kCrossingWindow), first_cut - 1);
  for (std::size_t i = left_begin; i < left_end; ++i) {
    for (std::size_t j = right_begin; j > std::max(right_end, i + 2); --j) {
      const auto crossing = core::segment_crossing(point(i), point(i + 1), point(j - 1), point(j));
      if (!crossing) continue;
      const double from = stations_[i].s + crossing->first * (stations_[i + 1].s - stations_[i].s);
      const double to = stations_[j - 1].s + crossing->second * (stations_[j].s - stations_[j - 1].s);
      if (const auto trim = crease_near(height, from, to)) trims.push_back(*trim);
    }
  }
  const std::vector<Room>& room = rooms(height);
  for (const std::size_t i : {first_cut, last_cut}) {
    const auto [from, to] = std::minmax(stations_[i].s, room[i].partner);
    if (const auto trim = crease_near(height, from, to)) trims.push_back(*trim);
  }
  if (const auto trim = crease_near(height, stations_[first_cut - 1].s, stations_[last_cut + 1].s)) {
    trims.push_back(*trim);
  }
  // A fold smaller than the steps around it: its neighbours are joined as they are.
  const Vec2 gap = point(last_cut + 1) - point(first_cut - 1);
  trims.push_back({Trim::Kind::crease, stations_[first_cut - 1].s, stations_[last_cut + 1].s,
                   point(first_cut - 1) + 0.5 * gap});
  return trims;
}

// Where the room is least, or widest, within a run of stations.
std::size_t LevelCurves::extreme_place(double height, std::size_t first, std::size_t last,
                                       bool widest) const {
  const std::vector<Room>& room = rooms(height);
  std::size_t place = first;
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (widest ? room[i].height > room[place].height : room[i].height < room[place].height) place = i;
  }
  return place;
}

bool LevelCurves::sharp(const Trim& trim, double height) const {
  return std::fabs(std::fabs(height_of(trim.point)) - std::fabs(height)) <= sharpness_;
}

// Two trims in place of one, with a piece of the level between them that lies around `middle`.
std::vector<Trim> LevelCurves::split_at(const Trim& trim, double height, double middle, int depth) const {
  if (depth >= kDeepestSplit || !(middle > trim.from && middle < trim.to)) return {};
  const auto left = trim.kind == Trim::Kind::start_face ? face_near(trim.kind, height, middle)
                                                        : crease_near(height, trim.from, middle);
  const auto right = trim.kind == Trim::Kind::finish_face ? face_near(trim.kind, height, middle)
                                                          : crease_near(height, middle, trim.to);
  if (!left || !right || !(left->to <= right->from)) return {};
  std::vector<Trim> trims = settled(*left, height, depth + 1);
  const std::vector<Trim> others = settled(*right, height, depth + 1);
  if (trims.empty() || others.empty()) return {};
  trims.insert(trims.end(), others.begin(), others.end());
  return trims;
}

// A trim whose point is nearer to a third place of the track than to its own branches hides a piece of the
// level that is shorter than the steps of the stations.
std::vector<Trim> LevelCurves::settled(const Trim& trim, double height, int depth) const {
  if (sharp(trim, height)) return {trim};
  return split_at(trim, height, foot_of(trim.point).s, depth);
}

// The trims that take the place of a run of stations without room; empty if none do.
std::vector<Trim> LevelCurves::run_trims(double height, std::size_t first, std::size_t last) const {
  const bool at_start = first == 0;
  const bool at_finish = last + 1 == stations_.size();
  if (at_start && at_finish) return {};
  std::vector<Trim> candidates;
  if (at_start || at_finish) {
    const auto trim = at_start ? start_trim(height, last) : finish_trim(height, first);
    if (trim) candidates.push_back(*trim);
  } else {
    candidates = crease_trims(height, first, last);
  }
  const double early = at_start ? 0.0 : 0.5 * (stations_[first].s - stations_[first - 1].s);
  const double late = at_finish ? 0.0 : 0.5 * (stations_[last + 1].s - stations_[last].s);
  std::erase_if(candidates, [&](const Trim& trim) {
    return trim.from > stations_[first].s + early || trim.to < stations_[last].s - late;
  });
  for (const Trim& trim : candidates) {
    if (sharp(trim, height)) return {trim};
  }
  const auto kind = at_start    ? Trim::Kind::start_face
                    : at_finish ? Trim::Kind::finish_face
                                : Trim::Kind::crease;
  candidates.push_back({kind, at_start ? 0.0 : stations_[first - 1].s,
                        at_finish ? stations_.back().s : stations_[last + 1].s,
                        offset(stations_[extreme_place(height, first, last, true)], height)});
  for (const Trim& trim : candidates) {
    std::vector<Trim> trims = split_at(trim, height, foot_of(trim.point).s, 0);
    if (!trims.empty()) return trims;
  }
  return {};
}

double LevelCurves::least_room_for(double height) const {
  return height - std::min(kTouching * height, kTouchingOfSharpness * sharpness_);
}

Trims LevelCurves::trims(double height) const {
  Trims trims;
  const std::vector<Room>& room = rooms(height);
  const double least = least_room_for(std::fabs(height));
  if (room.empty() || least == 0.0) return trims;
  const std::size_t count = stations_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (room[i].height >= least) continue;
    const std::size_t first = i;
    while (i + 1 < count && room[i + 1].height < least) ++i;
    const std::vector<Trim> run = run_trims(height, first, i);
    const bool forward = !run.empty() && (trims.cuts.empty() || trims.cuts.back().to < run.front().from);
    if (!forward) {
      const auto kind = first == 0       ? Obstacle::Kind::start_face
                        : i + 1 == count ? Obstacle::Kind::finish_face
                                         : Obstacle::Kind::reach;
      trims.obstacle = Obstacle{kind, stations_[extreme_place(height, first, i, false)].s};
      return trims;
    }
    trims.cuts.insert(trims.cuts.end(), run.begin(), run.end());
  }
  return trims;
}

LevelCurve LevelCurves::level(double height, const NodeSpacing& spacing) const {
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
  thin_out(curve.nodes, spacing);
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
    require_going(stop_);
    const double middle = 0.5 * (fits + fails);
    (trims(side * middle).obstacle ? fails : fits) = middle;
  }
  return fits;
}

std::size_t LevelCurves::nearest_station(Vec2 point) const {
  double best = core::kInfinity;
  std::size_t nearest = 0;
  tree_.search(point, best, nearest);
  const auto after = std::upper_bound(probe_of_.begin(), probe_of_.end(), nearest);
  return static_cast<std::size_t>(after - probe_of_.begin()) - 1;
}

// The nearest station may be some steps from the foot where the point is near the centre of curvature: its
// neighbourhood is searched in finer steps first.
Station LevelCurves::foot_of(Vec2 point) const {
  constexpr std::size_t kNeighbours = 2;
  constexpr std::size_t kFiner = 4;
  const std::size_t nearest = nearest_station(point);
  const std::size_t first = nearest - std::min(nearest, kNeighbours);
  const std::size_t last = std::min(nearest + kNeighbours, stations_.size() - 1);
  const auto distance_at = [&](double s) { return squared(point - station_at(centerline_, s).point); };
  const auto place = [&](std::size_t i) {
    const std::size_t station = std::min(first + i / kFiner, last - 1);
    const double part = static_cast<double>(i - (station - first) * kFiner) / kFiner;
    return stations_[station].s + part * (stations_[station + 1].s - stations_[station].s);
  };
  const std::size_t places = (last - first) * kFiner;
  std::size_t best = 0;
  double least = core::kInfinity;
  for (std::size_t i = 0; i <= places; ++i) {
    const double distance = distance_at(place(i));
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  // Half the digits of the arc length are all the digits of the distance, which is least there.
  constexpr int kBits = std::numeric_limits<double>::digits / 2;
  std::uintmax_t iterations = 60;
  const double low = place(best - std::min<std::size_t>(best, 1));
  const double high = place(std::min(best + 1, places));
  const auto [s, distance] = boost::math::tools::brent_find_minima(distance_at, low, high, kBits, iterations);
  return station_at(centerline_, least <= distance ? place(best) : s);
}

bool LevelCurves::are_neighbours(double from, double to) const {
  const auto after = std::upper_bound(stations_.begin(), stations_.end(), from,
                                      [](double s, const Station& station) { return s < station.s; });
  return after == stations_.end() || after->s >= to;
}

LevelCurves::Foot LevelCurves::foot(Vec2 point) const {
  const Station station = foot_of(point);
  const Vec2 away = point - station.point;
  return {station.s, std::copysign(norm(away), dot(away, station.normal))};
}

bool LevelCurves::carries(const Station& place, double height) const {
  constexpr double kNothing = 1e-9;  // of the length
  const double nothing = kNothing * centerline_.length();
  if (beyond_face(stations_.front(), place.s, height) < -nothing) return false;
  if (beyond_face(stations_.back(), place.s, height) > nothing) return false;
  return std::fabs(height_of(offset(place, height)) - height) <= nothing;
}

double LevelCurves::height_of(Vec2 point) const {
  return foot(point).height;
}

}  // namespace glissade::solid
