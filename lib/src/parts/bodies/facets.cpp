#include "parts/bodies/facets.hpp"

#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/curves/nearest_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kSame = 1e-9;  // [m], [rad]
// What turns by less than this, a hundredth of what presses are set to, needs no bend [rad].
constexpr double kNoBend = 1e-4;

/// A stretch that turns one way only, or not at all, with its share of the turning.
struct Bow {
  double from = 0.0;
  double to = 0.0;
  double turned = 0.0;  // towards the upper side [rad]
};

/// Neighbouring arcs that turn the same way, as one; straight pieces, and what hardly turns, go with what is before them.
std::vector<Bow> bows(const ArcSpline& track, const Span& span) {
  std::vector<Bow> found;
  for (const TrackArc& arc : track.arcs()) {
    const double from = std::max(span.from, arc.start);
    const double to = std::min(span.to, arc.start + arc.length);
    if (!(to - from > kSame)) continue;
    const double turned = arc.curvature * (to - from);
    const auto hardly = [](double angle) { return std::fabs(angle) < kNoBend; };
    const bool same = !found.empty() &&
                      (turned * found.back().turned >= 0.0 || hardly(turned) || hardly(found.back().turned));
    if (same) {
      found.back().to = to;
      found.back().turned += turned;
    } else {
      found.push_back({from, to, turned});
    }
  }
  return found;
}

double slope_at(const ArcSpline& track, double s) {
  return track.direction(std::min(s, track.length())).slope_angle;
}

/// The place within a bow where it has turned through a share of its angle.
double place_at(const ArcSpline& track, const Bow& bow, double share) {
  if (share <= 0.0) return bow.from;
  if (share >= 1.0) return bow.to;
  double left = share * bow.turned;
  for (std::size_t i = track.arc_at(bow.from); i < track.arcs().size(); ++i) {
    const TrackArc& arc = track.arcs()[i];
    const double from = std::max(bow.from, arc.start);
    const double turned = arc.curvature * (std::min(bow.to, arc.start + arc.length) - from);
    if (std::fabs(left) <= std::fabs(turned) && left * turned > 0.0) return from + left / arc.curvature;
    left -= turned;
  }
  return bow.to;
}

/// Where the tangents at two places meet.
Vec2 corner_between(const ArcSpline& track, double a, double b) {
  const TrackFrame first = frame_at(track, a);
  const TrackFrame second = frame_at(track, b);
  const double sine = cross(first.along, second.along);
  const double along = cross(second.at - first.at, second.along) / sine;
  return first.at + along * first.along;
}

/// Corners of the flats that touch at given places.
Facets facets_at(const ArcSpline& track, std::vector<double> touches) {
  Facets facets;
  facets.corners.push_back(frame_at(track, touches.front()).at);
  for (std::size_t i = 0; i + 1 < touches.size(); ++i) {
    const double kink = slope_at(track, touches[i]) - slope_at(track, touches[i + 1]);
    if (std::fabs(kink) < kSame) continue;
    const Vec2 corner = corner_between(track, touches[i], touches[i + 1]);
    facets.corners.push_back(corner);
    facets.kinks.push_back(kink);
    facets.misses.push_back(nearest_place(track, {touches[i], touches[i + 1]}, corner).distance);
  }
  facets.corners.push_back(frame_at(track, touches.back()).at);
  facets.touches = std::move(touches);
  return facets;
}

void append(std::vector<double>& places, double place) {
  if (places.empty() || place > places.back() + kSame) places.push_back(place);
}

/// Leaves out places that follow another one too closely: flats that no press can hold become one, with a larger bend.
std::vector<double> spaced(const std::vector<double>& places, double least) {
  std::vector<double> kept = {places.front()};
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    // A flat at an end is half as long as its neighbours.
    const double before = kept.size() == 1 ? 2.0 * least : least;
    const bool close = places[i] - kept.back() < before || places.back() - places[i] < 2.0 * least;
    if (!close) kept.push_back(places[i]);
  }
  kept.push_back(places.back());
  return kept;
}

/// Whether flats that touch at two places are one, or meet between them.
bool meet_between(const ArcSpline& track, double a, double b) {
  const TrackFrame first = frame_at(track, a);
  const TrackFrame second = frame_at(track, b);
  if (std::fabs(slope_at(track, a) - slope_at(track, b)) < kSame)
    return std::fabs(cross(first.along, second.at - first.at)) < kSame;
  const Vec2 corner = corner_between(track, a, b);
  return dot(corner - first.at, first.along) > 0.0 && dot(second.at - corner, second.along) > 0.0;
}

/// Leaves out places until flats lie one behind the other: beside a turning point that is left out they could meet behind where
/// they touch.
/// @return false where no choice does it
bool in_order(const ArcSpline& track, std::vector<double>& kept) {
  for (std::size_t i = 0; i + 1 < kept.size();) {
    if (meet_between(track, kept[i], kept[i + 1])) {
      ++i;
      continue;
    }
    if (kept.size() == 2) return false;
    const bool at_end = i + 2 == kept.size();
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(at_end ? i : i + 1));
    if (i > 0) --i;
  }
  return true;
}

/// The flat at an end of a stretch, up to where it meets the one beside it.
double end_flat(const ArcSpline& track, double end, double beside) {
  if (std::fabs(slope_at(track, end) - slope_at(track, beside)) < kSame) return std::fabs(beside - end);
  return norm(corner_between(track, end, beside) - frame_at(track, end).at);
}

/// As many of the places as leave flats long enough, and one behind the other. All of them where no choice does both: what flats are
/// too short for is refused elsewhere.
std::vector<double> chosen(const ArcSpline& track, const std::vector<double>& places, double least,
                           double least_end) {
  std::vector<double> kept = spaced(places, least);
  if (!in_order(track, kept)) return places;
  // Where the radius changes, a flat at an end is shorter than half the way to the next one.
  while (kept.size() > 2) {
    const std::size_t last = kept.size() - 1;
    const bool first_short = end_flat(track, kept[0], kept[1]) < least_end;
    if (!first_short && !(end_flat(track, kept[last], kept[last - 1]) < least_end)) break;
    std::vector<double> fewer = kept;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(first_short ? 1 : last - 1));
    if (!in_order(track, fewer)) break;
    kept = std::move(fewer);
  }
  return kept;
}

std::string flat_text(std::size_t flat) {
  return "flat " + std::to_string(flat + 1);
}

}  // namespace

Facets facets_by_angle(const ArcSpline& track, const Span& span, double largest_kink, double least_flat,
                       double least_end) {
  std::vector<double> touches = {span.from};
  for (const Bow& bow : bows(track, span)) {
    const double count = std::max(1.0, std::ceil(std::fabs(bow.turned) / largest_kink - kSame));
    for (double k = 1.0; k <= count; k += 1.0) append(touches, place_at(track, bow, k / count));
  }
  touches.back() = span.to;
  return facets_at(track, chosen(track, touches, least_flat, least_end));
}

Facets facets_by_length(const ArcSpline& track, const Span& span, double longest, double least_flat,
                        double least_end) {
  std::vector<double> touches = {span.from};
  for (const Bow& bow : bows(track, span)) {
    const double count = std::max(1.0, std::ceil((bow.to - bow.from) / longest - kSame));
    for (double k = 1.0; k <= count; k += 1.0) append(touches, bow.from + (bow.to - bow.from) * k / count);
  }
  touches.back() = span.to;
  return facets_at(track, chosen(track, touches, least_flat, least_end));
}

Facets facets_by_chord(const ArcSpline& track, const Span& span, double tolerance, double least_flat,
                       double least_end) {
  std::vector<double> touches = {span.from};
  for (const Bow& bow : bows(track, span)) {
    double from = bow.from;
    const auto keeps = [&](double to) {
      if (std::fabs(slope_at(track, from) - slope_at(track, to)) < kSame) return true;
      return nearest_place(track, {from, to}, corner_between(track, from, to)).distance <= tolerance;
    };
    while (from < bow.to - kSame) {
      double low = from;
      double high = bow.to;
      for (int round = 0; round < 40 && !keeps(high); ++round) {
        // The farthest place that keeps the tolerance, by bisection: the miss grows with the angle.
        const double middle = 0.5 * (low + high);
        if (keeps(middle)) {
          low = middle;
          if (high - low < 1e-6 * (bow.to - bow.from)) break;
        } else {
          high = middle;
        }
      }
      from = keeps(high) ? high : std::max(low, from + 1e-6 * (bow.to - bow.from));
      append(touches, std::min(from, bow.to));
    }
  }
  touches.back() = span.to;
  return facets_at(track, chosen(track, touches, least_flat, least_end));
}

namespace {

/// Linear between values that ascend.
double linear_between(const std::vector<double>& from, const std::vector<double>& to, double value) {
  const auto after = std::upper_bound(from.begin() + 1, from.end() - 1, value);
  const auto i = static_cast<std::size_t>(after - from.begin());
  if (value == from[i - 1]) return to[i - 1];
  if (value == from[i]) return to[i];
  return to[i - 1] + (value - from[i - 1]) / (from[i] - from[i - 1]) * (to[i] - to[i - 1]);
}

/// Pairs places as they come along the track.
class PlacePairs {
 public:
  PlacePairs(const ArcSpline& track, const Facets& facets) : track_(track), facets_(facets) {
    found_.on_track = {facets.touches.front()};
    found_.on_flats = {0.0};
    found_.corners = {facets.touches.front()};
  }

  /// The feet of where arcs of the track meet within a stretch of it.
  void add_feet_of_joints(double from, double to) {
    for (std::size_t i = track_.arc_at(from); i < track_.arcs().size(); ++i) {
      const double start = track_.arcs()[i].start;
      if (start >= to) return;
      if (start > from) add_foot(start);
    }
  }
  /// The foot of a place on the flat that goes on here, where that leads on from what is there.
  void add_foot(double s) {
    const double along = dot(frame_at(track_, s).at - facets_.corners[flat_], way());
    if (!(along < length() - kSame)) return;
    if (s > found_.on_track.back() + kSame && begins_ + along > found_.on_flats.back() + kSame)
      add(s, begins_ + along);
  }
  /// The end of the flat, whatever it leaves of places before it.
  void end_flat(double s) {
    begins_ += length();
    while (found_.on_track.size() > 1 &&
           !(s > found_.on_track.back() + kSame && begins_ > found_.on_flats.back() + kSame)) {
      found_.on_track.pop_back();
      found_.on_flats.pop_back();
    }
    add(s, begins_);
    found_.corners.push_back(s);
    ++flat_;
  }

  [[nodiscard]] Vec2 corner() const { return facets_.corners[flat_ + 1]; }
  [[nodiscard]] FlatPlaces all() && { return std::move(found_); }

 private:
  [[nodiscard]] double length() const { return norm(corner() - facets_.corners[flat_]); }
  [[nodiscard]] Vec2 way() const { return (1.0 / length()) * (corner() - facets_.corners[flat_]); }
  void add(double s, double place) {
    found_.on_track.push_back(s);
    found_.on_flats.push_back(place);
  }

  const ArcSpline& track_;
  const Facets& facets_;
  FlatPlaces found_;
  std::size_t flat_ = 0;
  double begins_ = 0.0;  ///< of the flat, along all of them
};

}  // namespace

FlatPlaces flat_places(const ArcSpline& track, const Facets& facets) {
  PlacePairs pairs(track, facets);
  const std::vector<double>& touches = facets.touches;
  for (std::size_t i = 0; i + 1 < touches.size(); ++i) {
    const Span stretch{touches[i], touches[i + 1]};
    const bool bends = std::fabs(slope_at(track, stretch.from) - slope_at(track, stretch.to)) >= kSame;
    const double corner = bends ? nearest_place(track, stretch, pairs.corner()).s : stretch.to;
    pairs.add_feet_of_joints(stretch.from, corner);
    if (bends) {
      pairs.end_flat(corner);
      pairs.add_feet_of_joints(corner, stretch.to);
    }
    if (i + 2 < touches.size()) pairs.add_foot(stretch.to);
  }
  pairs.end_flat(touches.back());
  return std::move(pairs).all();
}

double FlatPlaces::flats_at(double s) const {
  return linear_between(on_track, on_flats, s);
}

double FlatPlaces::track_at(double place) const {
  return linear_between(on_flats, on_track, place);
}

ArcSpline bent_face(const Facets& facets, double inner_radius, double thickness) {
  const Vec2 origin = facets.corners.front();
  const std::size_t flats = facets.corners.size() - 1;
  std::vector<double> taken(facets.corners.size(), 0.0);  // of the flats beside a corner, by its bend [m]
  for (std::size_t i = 0; i < facets.bends(); ++i) {
    const double radius = facets.kinks[i] > 0.0 ? inner_radius : inner_radius + thickness;
    taken[i + 1] = radius * math::tan(0.5 * std::fabs(facets.kinks[i]));
  }
  ArcPath path;
  path.vertices.push_back({{}, 0.0});
  for (std::size_t i = 0; i < flats; ++i) {
    const Vec2 along = facets.corners[i + 1] - facets.corners[i];
    const double length = norm(along);
    if (!(length - taken[i] - taken[i + 1] > 1e-6)) {
      throw InputError({"", flat_text(i) + " of the bent floor is " + length_text(length, 3) + " long",
                        "Its bends of radius " + length_text(inner_radius) + " take " +
                            length_text(taken[i] + taken[i + 1], 3) + " of it.",
                        "fewer bends, a smaller inner_radius, or floor: rolled"});
    }
    const Vec2 end = facets.corners[i + 1] - origin;
    if (i + 1 == flats) {
      path.vertices.push_back({end, 0.0});
      break;
    }
    const Vec2 next = facets.corners[i + 2] - facets.corners[i + 1];
    const double kink = math::atan2(cross(along, next), dot(along, next));
    path.vertices.push_back({end - (taken[i + 1] / length) * along, math::tan(0.25 * kink)});
    path.vertices.push_back({end + (taken[i + 1] / norm(next)) * next, 0.0});
  }
  // Of a bend by next to nothing the ends lie so close that rounding turns the line between them.
  double largest_kink = kArcSplineKink;
  for (std::size_t i = 1; i + 1 < path.vertices.size(); ++i) {
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * norm(path.vertices[i].at);
    for (const std::size_t other : {i - 1, i + 1})
      largest_kink = std::max(largest_kink, rounding / norm(path.vertices[other].at - path.vertices[i].at));
  }
  return ArcSpline(path, largest_kink);
}

namespace {

/// A flat of a bent floor.
struct Flat {
  Vec2 from;
  Vec2 to;
  double kink = 0.0;   ///< at its end, positive where the floor curls up; 0 at the end of a unit [rad]
  bool joint = false;  ///< whether its unit ends with it

  [[nodiscard]] double length() const { return norm(to - from); }
  [[nodiscard]] Vec2 along() const { return (1.0 / length()) * (to - from); }
  [[nodiscard]] Vec2 up() const { return {-along().y, along().x}; }
  [[nodiscard]] double distance(Vec2 point) const {
    const double s = std::clamp(dot(point - from, along()), 0.0, length());
    return norm(point - (from + s * along()));
  }
};

/// A place on a flat, of so many.
struct FlatPlace {
  std::size_t flat = 0;
  double distance = 0.0;  ///< from where it begins [m]
};

/// A body in the air.
struct Flight {
  Vec2 from;
  Vec2 way;  ///< its velocity there [m/s]
  double gravity = 0.0;

  [[nodiscard]] Vec2 at(double t) const { return from + t * way - Vec2{0.0, 0.5 * gravity * t * t}; }
  [[nodiscard]] Vec2 velocity(double t) const { return way - Vec2{0.0, gravity * t}; }
  /// @return when it comes down on the line of a flat, from above [s]; none on one that it never meets so
  [[nodiscard]] std::optional<double> meets(const Flat& flat) const {
    const Vec2 up = flat.up();
    const double falls = gravity * up.y;
    const double rises = dot(up, way);
    const double square = rises * rises + 2.0 * falls * dot(up, from - flat.from);
    if (!(falls > 0.0) || !(square >= 0.0)) return std::nullopt;
    const double t = (rises + std::sqrt(square)) / falls;
    return t > 0.0 ? std::optional(t) : std::nullopt;
  }
  /// @return when it passes the end of a flat, square to that [s]; none if it does not
  [[nodiscard]] std::optional<double> passes(const Flat& flat) const {
    const Vec2 along = flat.along();
    const double left = dot(flat.to - from, along);
    const double speed = dot(way, along);
    const double square = speed * speed - 2.0 * gravity * along.y * left;
    const double sum = speed + std::sqrt(std::max(0.0, square));
    if (!(left > 0.0) || !(square >= 0.0) || !(sum > 0.0)) return std::nullopt;
    return 2.0 * left / sum;
  }
};

/// A body from piece to piece of a floor.
class Rider {
 public:
  Rider(const Body& body, double gravity) : body_(body), gravity_(gravity), speed_(body.entry_speed) {}

  /// @return false if it does not come to the end of the piece
  bool down(CenterlinePtr piece) {
    constexpr std::size_t kMostHops = 1000;  // budget: of one piece
    for (std::size_t hops = 0; hops <= kMostHops; ++hops) {
      Body body = body_;
      body.entry_speed = speed_;
      // What came down on the first piece runs along the others.
      if (passed_ > 0.0) {
        body.landing.reset();
        body.approach = nullptr;
      }
      if (passed_ > 0.0) go_on_from(passed_, body);
      const Motion motion(piece, body, gravity_);
      const auto lifted = motion.lift_off();
      if (motion.arrived() || lifted) {
        ride_.time += motion.travel_time();
        ride_.highest_load = std::max(ride_.highest_load, motion.highest_load().normal_load);
        speed_ = motion.exit_speed();
        passed_ += motion.distance();
        if (motion.arrived()) return true;
        piece = landed(piece, lifted->arc_length);
        if (piece) continue;
        ride_.stopped = "it leaves the floor " + length_text(passed_, 4) + " along it at " +
                        rounded_text(speed_, 4) + " m/s and does not come down on its unit";
        return false;
      }
      const double at = passed_ + motion.distance();
      ride_.stopped =
          (motion.stall() ? "it stalls " : "it does not run on ") + length_text(at, 4) + " along the floor";
      return false;
    }
    ride_.stopped = "it leaves the floor again and again";
    return false;
  }
  /// Whether it goes on through the air where the floor falls away: what is held does not, nor what its speed alone holds on.
  [[nodiscard]] bool flies() const { return !body_.held && gravity_ > 0.0 && speed_ > 0.0; }
  void over_kink(double kink) {
    const auto [sine, cosine] = math::sine_cosine(std::fabs(kink));
    speed_ *= kink > 0.0 ? std::max(0.0, cosine - friction() * sine) : cosine;
  }
  /// Flies from the end of a flat until it comes down on one behind it, and loses there what it carries into the floor.
  /// @return where; beyond the last one it has flown past the end of the floor, the speed there known. None where no flat meets it
  [[nodiscard]] std::optional<FlatPlace> fly_from(const std::vector<Flat>& flats, std::size_t leaves) {
    const Flight flight{flats[leaves].to, speed_ * flats[leaves].along(), gravity_};
    double before = 0.0;  // length of the flats that it passes
    for (std::size_t k = leaves + 1; k < flats.size(); ++k) {
      const Flat& flat = flats[k];
      const double length = flat.length();
      const std::optional<double> lands = flight.meets(flat);
      if (lands && dot(flight.at(*lands) - flat.from, flat.along()) <= length) {
        const double s = std::max(0.0, dot(flight.at(*lands) - flat.from, flat.along()));
        const Vec2 arriving = flight.velocity(*lands);
        speed_ =
            std::max(0.0, dot(arriving, flat.along()) + friction() * std::min(0.0, dot(arriving, flat.up())));
        hopped(flight, flats, {leaves + 1, k + 1}, *lands, before + s);
        return FlatPlace{k, s};
      }
      before += length;
    }
    const std::optional<double> ends = flight.passes(flats.back());
    if (!ends) {
      ride_.stopped = "it leaves the floor " + length_text(passed_, 4) + " along it at " +
                      rounded_text(speed_, 4) + " m/s and does not come down on it";
      return std::nullopt;
    }
    speed_ = dot(flight.velocity(*ends), flats.back().along());
    hopped(flight, flats, {leaves + 1, flats.size()}, *ends, before);
    return FlatPlace{flats.size(), 0.0};
  }
  void down_step(double step) {
    speed_ = std::max(0.0, speed_ - friction() * std::sqrt(2.0 * gravity_ * step));
  }

  [[nodiscard]] FacetRide arrived() {
    ride_.arrives = true;
    ride_.speed = speed_;
    return ride_;
  }
  [[nodiscard]] FacetRide stopped() const { return ride_; }

 private:
  [[nodiscard]] double friction() const { return body_.friction.coefficient(); }

  /// @param below  first and one past the last of the flats that it flies over
  void hopped(const Flight& flight, const std::vector<Flat>& flats, std::array<std::size_t, 2> below,
              double time, double way) {
    constexpr int kLooks = 16;  // taste: a parabola over a few flats
    for (int i = 1; i < kLooks; ++i) {
      const Vec2 there = flight.at(time * i / kLooks);
      double clear = std::numeric_limits<double>::infinity();
      for (std::size_t k = below[0]; k < below[1]; ++k) clear = std::min(clear, flats[k].distance(there));
      ride_.highest_hop = std::max(ride_.highest_hop, clear);
    }
    ++ride_.hops;
    ride_.time += time;
    passed_ += way;
  }

  /// What changes along the track, as it is on the rest of it.
  static void go_on_from(double s, Body& body) {
    if (body.law) {
      if (LawPtr rest = body.law->from(s)) body.law = std::move(rest);
    }
    std::vector<FrictionChange>& changes = body.friction_changes;
    while (changes.size() > 1 && changes[1].from <= s) changes.erase(changes.begin());
    for (FrictionChange& change : changes) change.from = std::max(0.0, change.from - s);
  }

  /// Flies from a place of a line until it meets it again, and loses there what it carries into the floor.
  /// @return what is left of the line; none where it does not come down on it
  CenterlinePtr landed(const CenterlinePtr& piece, double from) {
    const auto line = std::dynamic_pointer_cast<const ArcSpline>(piece);
    if (!line) return nullptr;
    const TrackFrame start = frame_at(*line, from);
    const Vec2 way = speed_ * start.along;
    // Off a floor that is all but upright, as where a vertical start leans over by a hair, it is met by height, not by place.
    constexpr double kUpright = 0.1;  // of the way, level
    const bool upright = start.along.x < kUpright && start.along.y < 0.0;
    if (!upright && !(way.x > 0.0)) return nullptr;
    const auto flown = [&](double s) {
      const Vec2 there = frame_at(*line, s).at - start.at;
      if (!upright) return there.x / way.x;
      return (way.y + std::sqrt(std::max(0.0, way.y * way.y - 2.0 * gravity_ * there.y))) / gravity_;
    };
    const auto above = [&](double s) {
      const double t = flown(s);
      const Vec2 there = frame_at(*line, s).at - start.at;
      return upright ? t * way.x - there.x : t * (way.y - 0.5 * gravity_ * t) - there.y;
    };
    constexpr double kStep = 2e-3;  // [m]
    constexpr double kOff = 1e-5;   // from where it takes off: rounding apart, it has risen
    double low = from + kOff;
    double high = low;
    double rise = 0.0;
    while (high < line->length() && (high == low || above(high) > 0.0)) {
      rise = std::max(rise, above(high));
      low = high;
      high = std::min(high + kStep, line->length());
    }
    if (above(high) > 0.0) return nullptr;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      (above(middle) > 0.0 ? low : high) = middle;
    }
    if (!(line->length() - high > 1e-6)) return nullptr;
    const double t = flown(high);
    const TrackFrame end = frame_at(*line, high);
    const Vec2 arriving{way.x, way.y - gravity_ * t};
    speed_ = std::max(0.0, dot(arriving, end.along) + friction() * std::min(0.0, dot(arriving, end.up)));
    ride_.time += t;
    passed_ += high - from;
    ++ride_.hops;
    ride_.highest_hop = std::max(ride_.highest_hop, rise);
    ArcPath rest = *offset_line(*line, {high, line->length()}, 0.0);
    const Vec2 origin = rest.vertices.front().at;
    for (PathVertex& vertex : rest.vertices) vertex.at = vertex.at - origin;
    return std::make_shared<ArcSpline>(std::move(rest));
  }

  const Body& body_;
  double gravity_;
  double speed_;
  double passed_ = 0.0;
  FacetRide ride_;
};

std::vector<Flat> flats_of(const std::vector<Facets>& units) {
  std::vector<Flat> flats;
  for (const Facets& facets : units) {
    for (std::size_t i = 0; i + 1 < facets.corners.size(); ++i) {
      const bool bends = i < facets.bends();
      flats.push_back({facets.corners[i], facets.corners[i + 1], bends ? facets.kinks[i] : 0.0, !bends});
    }
  }
  return flats;
}

}  // namespace

FacetRide ride_facets(const std::vector<Facets>& units, const Body& body, double gravity, double joint_step) {
  const std::vector<Flat> flats = flats_of(units);
  Rider rider(body, gravity);
  FlatPlace place;
  while (place.flat < flats.size()) {
    const Flat& flat = flats[place.flat];
    const Vec2 left = flat.to - (flat.from + place.distance * flat.along());
    const bool somewhat = flat.length() - place.distance > kSame;
    if (somewhat && !rider.down(std::make_shared<StraightLine>(Endpoints{left.x, -left.y})))
      return rider.stopped();
    if (flat.kink < 0.0 && rider.flies()) {
      const std::optional<FlatPlace> next = rider.fly_from(flats, place.flat);
      if (!next) return rider.stopped();
      place = *next;
      continue;
    }
    if (flat.kink != 0.0) rider.over_kink(flat.kink);
    if (flat.joint && place.flat + 1 < flats.size()) rider.down_step(joint_step);
    place = {place.flat + 1, 0.0};
  }
  return rider.arrived();
}

FacetRide ride_lines(const std::vector<std::shared_ptr<const ArcSpline>>& units, const Body& body,
                     double gravity, double joint_step) {
  Rider rider(body, gravity);
  for (std::size_t u = 0; u < units.size(); ++u) {
    if (u > 0) rider.down_step(joint_step);
    if (!rider.down(units[u])) return rider.stopped();
  }
  return rider.arrived();
}

}  // namespace glissade::parts
