#include "glissade/core/arc_path.hpp"

#include "glissade/core/math.hpp"

#include "core/piece_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glissade {
namespace {

/// Below this sweep the differences of the closed forms would lose digits, and their series end soon.
constexpr double kSmallSweep = 0.3;

/// Area between an arc of this sweep and its chord, over the square of the chord:
/// (sweep - sin(sweep)) / (4 (1 - cos(sweep))).
double segment_area_factor(double sweep) {
  if (std::fabs(sweep) > kSmallSweep) {
    return (sweep - math::sin(sweep)) / (4.0 * (1.0 - math::cos(sweep)));
  }
  const double q = sweep * sweep;
  const double above = 1.0 / 6 - q * (1.0 / 120 - q * (1.0 / 5040 - q * (1.0 / 362880 - q / 39916800)));
  const double below = 2.0 - q * (1.0 / 6 - q * (1.0 / 180 - q * (1.0 / 10080 - q / 907200)));
  return sweep * above / below;
}

/// First moment of that area about the chord, over the cube of the chord: 1/12 (about the arc's centre) less the area
/// times the centre's distance from the chord.
double segment_moment_factor(double sweep, double area_factor, double to_centre) {
  if (std::fabs(sweep) > kSmallSweep) return 1.0 / 12 - area_factor * to_centre;
  const double q = sweep * sweep;
  return q * (1.0 / 240 + q * (1.0 / 4032 + q * (1.0 / 86400 + q * (1.0 / 2128896 + q * 691 / 39626496000))));
}

/// Area and first moment about `origin` of what lies between a piece, seen from `origin`, and `origin`.
struct SignedMoments {
  double area = 0.0;
  Vec2 first;
};

SignedMoments moments_of(const PathPiece& piece, Vec2 origin) {
  const Vec2 a = piece.from - origin;
  const Vec2 b = piece.to - origin;
  const double triangle = 0.5 * cross(a, b);
  SignedMoments sum{triangle, (triangle / 3.0) * (a + b)};
  if (piece.straight()) return sum;
  const Vec2 along = b - a;
  const double chord = norm(along);
  const double sweep = 4.0 * math::atan(piece.bulge);
  const double factor = segment_area_factor(sweep);
  const double area = chord * chord * factor;
  const double to_centre = (1.0 - piece.bulge * piece.bulge) / (4.0 * piece.bulge);
  // Towards the arc's middle it is to the right of a left turn; `outward` has the length of the chord.
  const double beyond_chord = chord * chord * segment_moment_factor(sweep, factor, to_centre);
  const Vec2 outward{along.y, -along.x};
  sum.area += area;
  sum.first = sum.first + area * (0.5 * (a + b)) + beyond_chord * outward;
  return sum;
}

SignedMoments moments_of(const ArcPath& path, Vec2 origin) {
  SignedMoments sum;
  for (const PathPiece& piece : pieces_of(path)) {
    const SignedMoments part = moments_of(piece, origin);
    sum.area += part.area;
    sum.first = sum.first + part.first;
  }
  return sum;
}

void widen(PlaneBox& box, Vec2 point) {
  box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
  box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
}

PlaneBox nothing() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
}

/// The circle of an arc, without its angles.
Circle circle_of(const PathPiece& piece) {
  const Vec2 along = piece.to - piece.from;
  const double b = piece.bulge;
  return {0.5 * (piece.from + piece.to) + ((1.0 - b * b) / (4.0 * b)) * Vec2{-along.y, along.x},
          norm(along) * (1.0 + b * b) / (4.0 * std::fabs(b))};
}

/// @param point  on the circle of an arc
bool on_arc(const PathPiece& arc, Vec2 point) {
  return cross(arc.to - arc.from, point - arc.from) * arc.bulge <= 0.0;
}

PlaneBox bounds_of(const PathPiece& piece) {
  PlaneBox box = nothing();
  widen(box, piece.from);
  widen(box, piece.to);
  if (piece.straight()) return box;
  const Circle arc = circle_of(piece);
  for (const Vec2 side : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
    const Vec2 point = arc.centre + arc.radius * side;
    if (on_arc(piece, point)) widen(box, point);
  }
  return box;
}

double gap(const PlaneBox& a, const PlaneBox& b) {
  const double beside = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
  const double above = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
  return math::hypot(beside, above);
}

bool on_piece(const PathPiece& piece, Vec2 point) {
  if (!piece.straight()) return on_arc(piece, point);
  const Vec2 along = piece.to - piece.from;
  const double share = dot(point - piece.from, along);
  return share >= 0.0 && share <= dot(along, along);
}

double distance(const PathPiece& piece, Vec2 point) {
  double least = std::min(norm(point - piece.from), norm(point - piece.to));
  if (piece.straight()) {
    const Vec2 along = piece.to - piece.from;
    const double square = dot(along, along);
    if (square > 0.0 && on_piece(piece, point)) {
      least = std::min(least, std::fabs(cross(along, point - piece.from)) / std::sqrt(square));
    }
    return least;
  }
  const Circle arc = circle_of(piece);
  const Vec2 outward = point - arc.centre;
  const double far = norm(outward);
  if (far > 0.0 && on_arc(piece, arc.centre + (arc.radius / far) * outward)) {
    least = std::min(least, std::fabs(far - arc.radius));
  }
  return least;
}

void add_meetings_of_lines(const PathPiece& a, const PathPiece& b, std::vector<Vec2>& found) {
  const Vec2 u = a.to - a.from;
  const Vec2 v = b.to - b.from;
  const double turn = cross(u, v);
  if (turn == 0.0) return;  // parallel: where they touch, an end of one lies on the other
  const double share = cross(b.from - a.from, v) / turn;
  const double other = cross(b.from - a.from, u) / turn;
  if (share >= 0.0 && share <= 1.0 && other >= 0.0 && other <= 1.0) found.push_back(a.from + share * u);
}

void add_meetings(const PathPiece& line, const PathPiece& piece, const CircularArc& arc,
                  std::vector<Vec2>& found) {
  const Vec2 u = line.to - line.from;
  const double size = norm(u);
  if (size == 0.0) return;
  const Vec2 along = (1.0 / size) * u;
  const double beside = cross(along, arc.centre - line.from);
  if (std::fabs(beside) > arc.radius) return;
  const double half = std::sqrt((arc.radius - beside) * (arc.radius + beside));
  const double foot = dot(along, arc.centre - line.from);
  for (const double place : {foot - half, foot + half}) {
    const Vec2 point = line.from + place * along;
    if (place >= 0.0 && place <= size && on_arc(piece, point)) found.push_back(point);
  }
}

void add_meetings_of_arcs(const PathPiece& a, const PathPiece& b, std::vector<Vec2>& found) {
  const CircularArc first = arc_of(a);
  const CircularArc second = arc_of(b);
  const Vec2 apart = second.centre - first.centre;
  const double d = norm(apart);
  if (d == 0.0 || d > first.radius + second.radius || d < std::fabs(first.radius - second.radius)) return;
  const Vec2 along = (1.0 / d) * apart;
  const double foot = 0.5 * (d + (first.radius - second.radius) * (first.radius + second.radius) / d);
  const double square = (first.radius - foot) * (first.radius + foot);
  const double half = square > 0.0 ? std::sqrt(square) : 0.0;
  for (const double side : {-half, half}) {
    const Vec2 point = first.centre + foot * along + side * Vec2{-along.y, along.x};
    if (on_arc(a, point) && on_arc(b, point)) found.push_back(point);
  }
}

/// Where two pieces cross or touch, other than along each other.
std::vector<Vec2> meetings(const PathPiece& a, const PathPiece& b) {
  std::vector<Vec2> found;
  if (a.straight() && b.straight()) {
    add_meetings_of_lines(a, b, found);
  } else if (a.straight()) {
    add_meetings(a, b, arc_of(b), found);
  } else if (b.straight()) {
    add_meetings(b, a, arc_of(a), found);
  } else {
    add_meetings_of_arcs(a, b, found);
  }
  return found;
}

/// Least distance between points inside two pieces where both are square to the line that joins them.
double inner_distance(const PathPiece& a, const PathPiece& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto hold = [&](Vec2 p, Vec2 q) {
    if (on_piece(a, p) && on_piece(b, q)) least = std::min(least, norm(p - q));
  };
  if (a.straight() && b.straight()) return least;
  if (a.straight()) return inner_distance(b, a);
  const CircularArc first = arc_of(a);
  if (b.straight()) {
    const Vec2 along = b.to - b.from;
    const double square = dot(along, along);
    if (square == 0.0) return least;
    const Vec2 foot = b.from + (dot(first.centre - b.from, along) / square) * along;
    const Vec2 out = foot - first.centre;
    if (norm(out) > 0.0) hold(first.centre + (first.radius / norm(out)) * out, foot);
    return least;
  }
  const CircularArc second = arc_of(b);
  const Vec2 apart = second.centre - first.centre;
  if (norm(apart) == 0.0) return least;
  const Vec2 along = (1.0 / norm(apart)) * apart;
  for (const double side : {-1.0, 1.0}) {
    for (const double other : {-1.0, 1.0}) {
      hold(first.centre + (side * first.radius) * along, second.centre + (other * second.radius) * along);
    }
  }
  return least;
}

}  // namespace

PlaneMotion PlaneMotion::turn(double angle, Vec2 shift) {
  const auto [sine, cosine] = math::sine_cosine(angle);
  return {cosine, sine, shift, false};
}

Vec2 PlaneMotion::operator()(Vec2 point) const {
  const Vec2 p{point.x, mirrored ? -point.y : point.y};
  return Vec2{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y} + shift;
}

double bulge_of_sweep(double sweep) {
  return math::tan(0.25 * sweep);
}

CircularArc arc_of(const PathPiece& piece) {
  const Circle circle = circle_of(piece);
  CircularArc arc;
  arc.radius = circle.radius;
  arc.centre = circle.centre;
  arc.start_angle = math::atan2(piece.from.y - arc.centre.y, piece.from.x - arc.centre.x);
  arc.sweep = 4.0 * math::atan(piece.bulge);
  return arc;
}

std::vector<PathPiece> pieces_of(const ArcPath& path) {
  std::vector<PathPiece> pieces;
  const std::size_t count = path.vertices.size();
  if (count < 2) return pieces;
  const std::size_t last = path.closed ? count : count - 1;
  pieces.reserve(last);
  for (std::size_t i = 0; i < last; ++i) {
    const PathVertex& vertex = path.vertices[i];
    pieces.push_back({vertex.at, path.vertices[(i + 1) % count].at, vertex.bulge});
  }
  return pieces;
}

Vec2 point_on(const PathPiece& piece, double share) {
  if (piece.straight()) return piece.from + share * (piece.to - piece.from);
  // From the chord, so that nearly straight arcs lose nothing to their far centre.
  const double half = 2.0 * math::atan(piece.bulge);
  const double first = half * share;
  const double size = math::sin(first) / math::sin(half);
  const auto [sine, cosine] = math::sine_cosine(first - half);
  const Vec2 along = piece.to - piece.from;
  return piece.from + size * Vec2{cosine * along.x - sine * along.y, sine * along.x + cosine * along.y};
}

double length(const PathPiece& piece) {
  const double chord = norm(piece.to - piece.from);
  if (piece.straight()) return chord;
  const double b = std::fabs(piece.bulge);
  return chord * (1.0 + b * b) * (math::atan(b) / b);
}

double length(const ArcPath& path) {
  double sum = 0.0;
  for (const PathPiece& piece : pieces_of(path)) sum += length(piece);
  return sum;
}

double signed_area(const ArcPath& path) {
  return path.vertices.empty() ? 0.0 : moments_of(path, path.vertices.front().at).area;
}

AreaMoments moments(const PlaneRegion& region) {
  if (region.outline.vertices.empty()) return {};
  const Vec2 origin = region.outline.vertices.front().at;
  SignedMoments sum;
  const auto add = [&](const SignedMoments& part, double sign) {
    const double outward = part.area < 0.0 ? -sign : sign;
    sum.area += outward * part.area;
    sum.first = sum.first + outward * part.first;
  };
  add(moments_of(region.outline, origin), 1.0);
  for (const ArcPath& cutout : region.cutouts) add(moments_of(cutout, origin), -1.0);
  for (const Circle& hole : region.holes) {
    const double area = std::numbers::pi * hole.radius * hole.radius;
    add({area, area * (hole.centre - origin)}, -1.0);
  }
  return {sum.area, origin + (sum.area != 0.0 ? 1.0 / sum.area : 0.0) * sum.first};
}

PlaneBox bounds(const ArcPath& path) {
  PlaneBox box = nothing();
  for (const PathVertex& vertex : path.vertices) widen(box, vertex.at);
  for (const PathPiece& piece : pieces_of(path)) {
    if (piece.straight()) continue;
    const PlaneBox part = bounds_of(piece);
    widen(box, part.low);
    widen(box, part.high);
  }
  return box;
}

ArcPath reversed(const ArcPath& path) {
  ArcPath result{{}, path.closed};
  const std::size_t count = path.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    // The piece after vertex k, run backwards, is the one that led to it.
    const std::size_t k = count - 1 - i;
    const std::size_t before = (k + count - 1) % count;
    result.vertices.push_back({path.vertices[k].at, -path.vertices[before].bulge + 0.0});
  }
  return result;
}

ArcPath moved(const ArcPath& path, const PlaneMotion& motion) {
  ArcPath result{{}, path.closed};
  result.vertices.reserve(path.vertices.size());
  for (const PathVertex& vertex : path.vertices) {
    result.vertices.push_back({motion(vertex.at), motion.mirrored ? -vertex.bulge + 0.0 : vertex.bulge});
  }
  return result;
}

PlaneRegion moved(const PlaneRegion& region, const PlaneMotion& motion) {
  PlaneRegion result{moved(region.outline, motion), {}, {}};
  for (const ArcPath& cutout : region.cutouts) result.cutouts.push_back(moved(cutout, motion));
  for (const Circle& hole : region.holes) result.holes.push_back({motion(hole.centre), hole.radius});
  return result;
}

ArcPath scaled(const ArcPath& path, double factor) {
  ArcPath result = path;
  for (PathVertex& vertex : result.vertices) vertex.at = factor * vertex.at;
  return result;
}

PlaneRegion scaled(const PlaneRegion& region, double factor) {
  PlaneRegion result{scaled(region.outline, factor), {}, region.holes};
  for (const ArcPath& cutout : region.cutouts) result.cutouts.push_back(scaled(cutout, factor));
  for (Circle& hole : result.holes) hole = {factor * hole.centre, factor * hole.radius};
  return result;
}

ArcPath path_of(const Circle& circle) {
  const Vec2 across{circle.radius, 0.0};
  return {{{circle.centre - across, 1.0}, {circle.centre + across, 1.0}}, true};
}

ArcPath rectangle(Vec2 low, Vec2 high) {
  return {{{low}, {{high.x, low.y}}, {high}, {{low.x, high.y}}}, true};
}

std::vector<Vec2> flattened(const ArcPath& path, double sagitta) {
  std::vector<Vec2> points;
  const std::vector<PathPiece> pieces = pieces_of(path);
  if (pieces.empty()) return points;
  points.push_back(pieces.front().from);
  for (const PathPiece& piece : pieces) {
    std::size_t steps = 1;
    if (!piece.straight()) {
      const CircularArc arc = arc_of(piece);
      const double share = std::clamp(1.0 - sagitta / arc.radius, 0.0, 1.0);
      // Whatever is asked for, no arc becomes more than a few thousand chords.
      const double largest_step = std::max(2.0 * math::acos(share), 1e-3);
      steps = static_cast<std::size_t>(std::ceil(std::fabs(arc.sweep) / largest_step));
      steps = std::max<std::size_t>(steps, 1);
    }
    for (std::size_t i = 1; i < steps; ++i) {
      points.push_back(point_on(piece, static_cast<double>(i) / static_cast<double>(steps)));
    }
    points.push_back(piece.to);
  }
  return points;
}

namespace {

/// Whether the level ray from `point` to the right crosses the part of a curve between two heights.
bool ray_crosses(Vec2 point, Vec2 from, Vec2 to, double crossing) {
  return (from.y <= point.y) != (to.y <= point.y) && crossing > point.x;
}

bool ray_crosses_line(Vec2 point, const PathPiece& line) {
  const Vec2 along = line.to - line.from;
  const double share = along.y == 0.0 ? 0.0 : (point.y - line.from.y) / along.y;
  return ray_crosses(point, line.from, line.to, line.from.x + share * along.x);
}

/// @return how often the ray crosses an arc: taken apart at the circle's top and bottom
int ray_crossings_of_arc(Vec2 point, const PathPiece& piece) {
  const Circle arc = circle_of(piece);
  std::vector<Vec2> stops{piece.from};
  const Vec2 top = arc.centre + Vec2{0.0, arc.radius};
  const Vec2 bottom = arc.centre - Vec2{0.0, arc.radius};
  if (on_arc(piece, top)) stops.push_back(top);
  if (on_arc(piece, bottom)) stops.push_back(bottom);
  const Vec2 along = piece.to - piece.from;
  const auto turned = [&](Vec2 p) {  // how far round the arc: grows from `from` to `to`
    const Vec2 a = piece.from - arc.centre;
    const Vec2 b = p - arc.centre;
    const double angle = math::atan2(cross(a, b), dot(a, b)) * (piece.bulge > 0.0 ? 1.0 : -1.0);
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
  };
  if (stops.size() == 3 && turned(stops[1]) > turned(stops[2])) std::swap(stops[1], stops[2]);
  stops.push_back(piece.from + along);
  stops.back() = piece.to;
  int crossings = 0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double up = point.y - arc.centre.y;
    const double square = (arc.radius - up) * (arc.radius + up);
    const double half = square > 0.0 ? std::sqrt(square) : 0.0;
    // A left turn that rises is on the right half of its circle.
    const bool right = (stops[i + 1].y > stops[i].y) == (piece.bulge > 0.0);
    const double crossing = arc.centre.x + (right ? half : -half);
    if (ray_crosses(point, stops[i], stops[i + 1], crossing)) ++crossings;
  }
  return crossings;
}

}  // namespace

bool contains(const ArcPath& path, Vec2 point) {
  int crossings = 0;
  for (const PathPiece& piece : pieces_of(path)) {
    // An arc of no more than half a turn stays within its rise of its chord.
    const double rise = 0.5 * std::fabs(piece.bulge) * norm(piece.to - piece.from);
    const bool beyond = point.y < std::min(piece.from.y, piece.to.y) - rise ||
                        point.y > std::max(piece.from.y, piece.to.y) + rise;
    if (std::fabs(piece.bulge) <= 1.0 && beyond) continue;
    crossings +=
        piece.straight() ? (ray_crosses_line(point, piece) ? 1 : 0) : ray_crossings_of_arc(point, piece);
  }
  return crossings % 2 == 1;
}

double core::distance_to_piece(const PathPiece& piece, Vec2 point) {
  return distance(piece, point);
}

double distance(const PathPiece& a, const PathPiece& b) {
  if (!meetings(a, b).empty()) return 0.0;
  const double ends =
      std::min({distance(a, b.from), distance(a, b.to), distance(b, a.from), distance(b, a.to)});
  return std::min(ends, inner_distance(a, b));
}

double distance(const ArcPath& a, const ArcPath& b) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<PathPiece> others = pieces_of(b);
  std::vector<PlaneBox> boxes;
  boxes.reserve(others.size());
  for (const PathPiece& piece : others) boxes.push_back(bounds_of(piece));
  for (const PathPiece& piece : pieces_of(a)) {
    const PlaneBox box = bounds_of(piece);
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (gap(box, boxes[i]) < least) least = std::min(least, distance(piece, others[i]));
    }
  }
  return least;
}

namespace {

bool finite(const ArcPath& path) {
  return std::all_of(path.vertices.begin(), path.vertices.end(), [](const PathVertex& vertex) {
    return std::isfinite(vertex.at.x) && std::isfinite(vertex.at.y) && std::isfinite(vertex.bulge);
  });
}

/// Neighbours share a corner; whether they meet anywhere else, or run back over each other.
bool neighbours_clash(const PathPiece& before, const PathPiece& after, double nearness) {
  const std::vector<Vec2> places = meetings(before, after);
  const bool elsewhere = std::any_of(places.begin(), places.end(), [&](Vec2 place) {
    return norm(place - before.to) > nearness && norm(place - after.to) > nearness;
  });
  const Vec2 back = before.from - before.to;
  const Vec2 on = after.to - after.from;
  const bool runs_back = before.straight() && after.straight() && dot(back, on) > 0.0 &&
                         std::fabs(cross(back, on)) <= nearness * std::max(norm(back), norm(on));
  return elsewhere || runs_back;
}

bool meets_itself(const ArcPath& path, double nearness) {
  std::vector<PathPiece> pieces = pieces_of(path);
  // Circles that are straight to far below the nearness have no middle to reckon with.
  for (PathPiece& piece : pieces) {
    if (std::fabs(piece.bulge) * norm(piece.to - piece.from) < 1e-3 * nearness) piece.bulge = 0.0;
  }
  std::vector<PlaneBox> boxes;
  boxes.reserve(pieces.size());
  for (const PathPiece& piece : pieces) boxes.push_back(bounds_of(piece));
  const std::size_t count = pieces.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      if (gap(boxes[i], boxes[k]) > nearness) continue;
      const bool next = k == i + 1;
      const bool first_and_last = i == 0 && k + 1 == count;
      if (next && first_and_last) continue;  // two pieces round the whole figure
      const bool clash = next             ? neighbours_clash(pieces[i], pieces[k], nearness)
                         : first_and_last ? neighbours_clash(pieces[k], pieces[i], nearness)
                                          : distance(pieces[i], pieces[k]) <= nearness;
      if (clash) return true;
    }
  }
  return false;
}

void add_faults_of_path(const ArcPath& path, const std::string& name, std::vector<std::string>& faults) {
  if (!path.closed) faults.push_back(name + " is open");
  if (path.vertices.size() < 2) {
    faults.push_back(name + " has " + std::to_string(path.vertices.size()) + " corners");
    return;
  }
  const PlaneBox box = bounds(path);
  const double nearness = 1e-9 * std::max(box.width(), box.height());
  const std::vector<PathPiece> pieces = pieces_of(path);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string where = name + ", piece " + std::to_string(i + 1) + ",";
    if (norm(pieces[i].to - pieces[i].from) <= nearness) faults.push_back(where + " has no length");
  }
  if (meets_itself(path, nearness)) faults.push_back(name + " meets itself");
  if (!(std::fabs(signed_area(path)) > nearness * nearness)) faults.push_back(name + " has no area");
}

}  // namespace

std::vector<std::string> faults_of(const PlaneRegion& region) {
  std::vector<std::string> faults;
  std::vector<std::pair<std::string, ArcPath>> inner;
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    inner.emplace_back("cutout " + std::to_string(i + 1), region.cutouts[i]);
  }
  bool all_finite = finite(region.outline);
  for (const auto& [name, path] : inner) all_finite = all_finite && finite(path);
  for (std::size_t i = 0; i < region.holes.size(); ++i) {
    const Circle& hole = region.holes[i];
    const std::string name = "hole " + std::to_string(i + 1);
    all_finite = all_finite && std::isfinite(hole.centre.x + hole.centre.y + hole.radius);
    if (!(hole.radius > 0.0)) faults.push_back(name + " has no radius");
    inner.emplace_back(name, path_of(hole));
  }
  if (!all_finite) return {"a coordinate is not a finite number"};
  add_faults_of_path(region.outline, "the outline", faults);
  for (std::size_t i = 0; i < region.cutouts.size(); ++i) {
    add_faults_of_path(region.cutouts[i], inner[i].first, faults);
  }
  if (!faults.empty()) return faults;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const auto& [name, path] = inner[i];
    if (distance(path, region.outline) == 0.0 || !contains(region.outline, path.vertices.front().at)) {
      faults.push_back(name + " reaches outside the outline");
    }
    for (std::size_t k = 0; k < i; ++k) {
      const auto& [other_name, other] = inner[k];
      if (distance(path, other) == 0.0 || contains(other, path.vertices.front().at) ||
          contains(path, other.vertices.front().at)) {
        faults.push_back(name + " touches " + other_name);
      }
    }
  }
  return faults;
}

}  // namespace glissade
