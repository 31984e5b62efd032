#include "optimize/problem/envelope_rows.hpp"

#include "glissade/core/units.hpp"

#include "optimize/problem/feet.hpp"
#include "optimize/problem/round_rows.hpp"
#include "optimize/problem/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::optimizer {
namespace {

Vec2 point_of(const Shape& shape, std::size_t station) {
  return {shape.x[station], shape.y[station]};
}

Vec2 tangent_of(const Shape& shape, std::size_t station) {
  return {shape.cos[station], shape.sin[station]};
}

/// To the upper side.
Vec2 normal_of(const Shape& shape, std::size_t station) {
  return {shape.sin[station], -shape.cos[station]};
}

/// out += direction . (dx, dy) of a station
void add_position(const Transcription& track, const Shape& shape, std::size_t station, Vec2 direction,
                  double* out) {
  track.add(shape.dx, station, direction.x, out);
  track.add(shape.dy, station, direction.y, out);
}

}  // namespace

EnvelopeRows::Zones EnvelopeRows::zones(const Shape& shape) const {
  const std::size_t last = shape.zeta.size() - 1;
  Zones zones{last, 0};
  for (std::size_t i = 0; i <= last; ++i) {
    if (std::fabs(shape.zeta[i] - shape.zeta[0]) < kRightAngle) continue;
    zones.start = i;
    break;
  }
  for (std::size_t i = last + 1; i-- > 0;) {
    if (std::fabs(shape.zeta[i] - shape.zeta[last]) < kRightAngle) continue;
    zones.finish = i;
    break;
  }
  return zones;
}

EnvelopeRows::Face EnvelopeRows::face(const Shape& shape, bool finish) const {
  const std::size_t station = finish ? shape.zeta.size() - 1 : 0;
  return {station, point_of(shape, station), tangent_of(shape, station), normal_of(shape, station),
          finish ? 1.0 : -1.0};
}

// The height at which a normal meets an end plane, where that is below its level: ahead/approach, as in
// solid/level_curves.cpp.
EnvelopeRows::Cut EnvelopeRows::cut(const State& state, std::size_t base, Vec2 point, Vec2 normal,
                                    double height) const {
  Cut cut{false, false, height};
  const std::size_t last = state.shape.zeta.size() - 1;
  for (const bool finish : {false, true}) {
    if (finish ? base <= state.zones.finish : base >= state.zones.start) continue;
    const Face face = this->face(state.shape, finish);
    if (base == face.station && last > 0 && point == face.point) continue;
    const double ahead = face.outward * dot(face.point - point, face.tangent);
    const double approach = face.outward * dot(normal, face.tangent);
    if (!(approach * cut.height > 0.0 && ahead < cut.height * approach)) continue;
    cut = {true, !finish, std::max(ahead, 0.0) / approach};
  }
  // What slides leans through the planes.
  if (cut.is_cut && height > 0.0 && cut.height <= problem_.headroom) return {false, false, problem_.headroom};
  return cut;
}

EnvelopeRows::Cut EnvelopeRows::cut(const State& state, std::size_t station, double height) const {
  const std::size_t last = state.shape.zeta.size() - 1;
  if (height == 0.0 || station == 0 || station == last) return {false, false, height};
  return cut(state, station, point_of(state.shape, station), normal_of(state.shape, station), height);
}

// Where a level crosses an end plane between two stations, of which the first is cut: regula falsi, in the
// Illinois variant.
Foot EnvelopeRows::leaving(const State& state, const Face& face, double height, std::size_t from,
                           std::size_t to) const {
  const auto beyond = [&](const Foot& foot) {
    const Vec2 point{foot.x + height * foot.sin, foot.y - height * foot.cos};
    return face.outward * dot(point - face.point, face.tangent);
  };
  double low = 0.0;
  double high = 1.0;
  double at_low = beyond(track_.between(state.z, state.shape, from, to, low));
  double at_high = beyond(track_.between(state.z, state.shape, from, to, high));
  Foot foot = track_.between(state.z, state.shape, from, to, high);
  constexpr int kSteps = 60;           // budget: halvings of a station's way, or Newton's steps
  constexpr double kRounding = 1e-16;  // rounding
  for (int step = 0; step < kSteps && at_low > at_high; ++step) {
    const double share = std::clamp(low + (high - low) * at_low / (at_low - at_high), 0.0, 1.0);
    foot = track_.between(state.z, state.shape, from, to, share);
    const double here = beyond(foot);
    if (std::fabs(here) <= kRounding || high - low <= kRounding) break;
    if (here > 0.0) {
      low = share;
      at_low = here;
      at_high *= 0.5;
    } else {
      high = share;
      at_high = here;
      at_low *= 0.5;
    }
  }
  return foot;
}

EnvelopeRows::FaceCorner EnvelopeRows::face_corner(const State& state, bool finish, std::size_t level) const {
  const Face face = this->face(state.shape, finish);
  const double height = this->height(level);
  FaceCorner corner{face.point + height * face.normal, height, false, {}};
  const std::size_t last = state.shape.zeta.size() - 1;
  const auto is_cut = [&](std::size_t station) {
    const Cut here = cut(state, station, height);
    return here.is_cut && here.at_start != finish;
  };
  // The innermost station that the plane cuts, and the next one, which it does not.
  std::size_t inner = 0;
  if (!finish) {
    for (std::size_t i = 1; i < std::min(state.zones.start, last); ++i) {
      if (is_cut(i)) inner = i;
    }
  } else {
    for (std::size_t i = last; i-- > state.zones.finish + 1;) {
      if (is_cut(i)) inner = i;
    }
  }
  if (inner == 0) return corner;
  corner.is_cut = true;
  corner.at = leaving(state, face, height, inner, finish ? inner - 1 : inner + 1);
  const Vec2 point{corner.at.x + height * corner.at.sin, corner.at.y - height * corner.at.cos};
  corner.along = dot(point - face.point, face.normal);
  corner.point = face.point + corner.along * face.normal;
  return corner;
}

// The corner is face.point + along normal. Of a cut level, along follows from where the level crosses the
// plane: moving the track moves the level across it, and the crossing slides along the level.
void EnvelopeRows::add_corner_gradient(const State& state, const Face& face, const FaceCorner& corner,
                                       double height, Vec2 direction, double* out) const {
  const std::size_t n = track_.layout().size();
  add_position(track_, state.shape, face.station, direction, out);
  track_.add_dzeta(face.station, corner.along * dot(direction, face.tangent), out);
  if (!corner.is_cut) return;
  Vector dx;
  Vector dy;
  track_.foot_derivatives(state.z, state.shape, corner.at, dx, dy);
  Vector turned_there(n);
  track_.turning_row(corner.at.at, turned_there.data());
  const Vec2 tangent{corner.at.cos, corner.at.sin};
  const double slide = dot(tangent, face.normal) / dot(tangent, face.tangent);
  const Vec2 moved = face.normal - slide * face.tangent;
  const double share = dot(direction, face.normal);
  add_scaled(out, share * moved.x, dx.data(), n);
  add_scaled(out, share * moved.y, dy.data(), n);
  add_scaled(out, share * height * dot(tangent, moved), turned_there.data(), n);
  add_position(track_, state.shape, face.station, -share * moved, out);
  track_.add_dzeta(face.station, share * slide * corner.along, out);
}

EnvelopeRows::Distance EnvelopeRows::distance(const Obstacle& obstacle, Vec2 point) {
  if (obstacle.endless) {
    return {dot(obstacle.corners[0] - point, obstacle.forbidden), -1.0 * obstacle.forbidden, false};
  }
  const std::vector<Vec2>& chain = obstacle.corners;
  bool behind = false;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Vec2 a = chain[i];
    const Vec2 b = chain[i + 1];
    if (!(a.x < b.x) || point.x < a.x || point.x > b.x) continue;
    const double drop = a.y + (b.y - a.y) * (point.x - a.x) / (b.x - a.x);
    behind = behind || obstacle.side * (point.y - drop) > 0.0;
  }
  // In front of it all sides count, behind it those through which it is left.
  const bool whole = !behind && !obstacle.outline.empty();
  const std::vector<Vec2>& corners = whole ? obstacle.outline : chain;
  double least = std::numeric_limits<double>::infinity();
  Distance distance;
  for (std::size_t i = 0; i + (whole ? 0 : 1) < corners.size(); ++i) {
    const Vec2 from = corners[i];
    const Vec2 to = corners[(i + 1) % corners.size()];
    const Vec2 along = to - from;
    const double share = dot(point - from, along) / dot(along, along);
    const Vec2 away = point - (from + std::clamp(share, 0.0, 1.0) * along);
    const double size = norm(away);
    if (size >= least) continue;
    least = size;
    const double sign = behind ? -1.0 : 1.0;
    distance.value = sign * size;
    distance.away = size > 0.0 ? (sign / size) * away : -1.0 * edge_normal(from, to, obstacle.side);
    distance.at_corner = share < 0.0 || share > 1.0;
  }
  return distance;
}

Foot EnvelopeRows::exact_foot(const State& state, const Obstacle& obstacle, std::size_t index) const {
  const auto among = static_cast<std::size_t>(&obstacle - problem_.obstacles.data());
  std::optional<Foot>& known = state.corner_foot(problem_, among, index);
  if (!known) known = looked_for(state, obstacle.corner(index));
  return *known;
}

// Newton's method for the foot, along the normal of which the corner lies: near the centre of curvature, where
// walls are, the steps of Transcription::foot() hardly get there.
Foot EnvelopeRows::looked_for(const State& state, Vec2 corner) const {
  constexpr int kSteps = 20;             // budget: halvings of a station's way, or Newton's steps
  constexpr double kSettled = 1e-15;     // rounding
  constexpr double kLeastSpread = 0.05;  // taste
  Foot foot = track_.foot(state.z, state.shape, corner.x, corner.y);
  if (foot.end) return foot;
  const std::vector<Station>& stations = track_.stations();
  const double gap =
      track_.arc_length(state.z, stations[foot.towards]) - track_.arc_length(state.z, stations[foot.base]);
  for (int step = 0; step < kSteps; ++step) {
    const Vec2 way = corner - Vec2{foot.x, foot.y};
    const double rest = dot(way, {foot.cos, foot.sin});
    if (std::fabs(rest) <= kSettled) break;
    const double spread = 1.0 - curvature_at(track_, state.z, foot) * dot(way, {foot.sin, -foot.cos});
    const double share = std::clamp(foot.share + rest / (gap * std::max(spread, kLeastSpread)), 0.0, 1.0);
    if (share == foot.share) break;
    foot = track_.between(state.z, state.shape, foot.base, foot.towards, share);
  }
  return foot;
}

EnvelopeRows::CornerView EnvelopeRows::view(const State& state, const Obstacle& obstacle,
                                            const Row& row) const {
  const Vec2 corner = obstacle.corner(row.place);
  CornerView view;
  view.foot = exact_foot(state, obstacle, row.place);
  view.beyond = view.foot.end;
  view.at_finish = view.foot.base != 0;
  view.side = obstacle.side;
  if (!view.beyond) {
    const bool passed = corner.x >= state.shape.x.front() && corner.x <= state.shape.x.back();
    if (!passed) view.side = corner_distance(view.foot, corner, 1.0) >= 0.0 ? 1.0 : -1.0;
    const double level = height(level_towards(view.side));
    const Cut here =
        cut(state, view.foot.base, {view.foot.x, view.foot.y}, {view.foot.sin, -view.foot.cos}, level);
    view.beyond = here.is_cut;
    view.at_finish = !here.at_start;
  }
  if (!view.beyond) return view;
  const Face face = this->face(state.shape, view.at_finish);
  const double along = dot(corner - face.point, face.normal);
  view.between = along >= face_corner(state, view.at_finish, 0).along &&
                 along <= face_corner(state, view.at_finish, 1).along;
  return view;
}

Vec2 EnvelopeRows::forbidden(const Obstacle& obstacle, std::size_t edge) {
  if (obstacle.endless) return obstacle.forbidden;
  const std::size_t chained = obstacle.corners.size() - 1;
  if (edge >= chained) {
    const auto& [from, to] = obstacle.other_sides[edge - chained];
    return edge_normal(from, to, 1.0);
  }
  return obstacle.normals[edge];
}

Vec2 EnvelopeRows::on_edge(const Obstacle& obstacle, std::size_t edge) {
  const std::size_t chained = obstacle.corners.size() - 1;
  return obstacle.endless || edge < chained ? obstacle.corners[edge]
                                            : obstacle.other_sides[edge - chained].first;
}

// The end faces' corners stand for the normals of the ends, and for those that the end planes cut.
bool EnvelopeRows::stands(const State& state, std::size_t station, std::size_t level) const {
  return track_.stations()[station].watched && !cut(state, station, height(level)).is_cut;
}

void EnvelopeRows::add_edge_rows(const State& state, const Obstacle& obstacle, Row row,
                                 std::vector<Row>& rows) const {
  const std::size_t last = state.shape.zeta.size() - 1;
  const auto nearer_level = [&](std::size_t station, Vec2 direction) {
    return dot(normal_of(state.shape, station), direction) > 0.0 ? std::size_t{1} : std::size_t{0};
  };
  if (obstacle.endless) {
    for (row.place = 1; row.place < last; ++row.place) {
      row.level = nearer_level(row.place, obstacle.forbidden);
      if (stands(state, row.place, row.level)) rows.push_back(row);
    }
    return;
  }
  row.level = level_towards(obstacle.side);
  std::vector<Vec2> points;
  for (std::size_t i = 1; i < last; ++i)
    points.push_back(point_of(state.shape, i) + height(row.level) * normal_of(state.shape, i));
  const ConcernedPoints level(std::move(points));
  std::vector<std::size_t> concerned;
  for (; row.edge + 1 < obstacle.corners.size(); ++row.edge) {
    if (!obstacle.is_touchable(row.edge) || !obstacle.is_touchable(row.edge + 1)) continue;
    level.of_edge(obstacle.corners[row.edge], obstacle.corners[row.edge + 1], obstacle.side, concerned);
    for (const std::size_t i : concerned) {
      row.place = i + 1;
      if (stands(state, row.place, row.level)) rows.push_back(row);
    }
  }
  for (const auto& [from, to] : obstacle.other_sides) {
    for (row.place = 1; row.place < last; ++row.place) {
      row.level = nearer_level(row.place, forbidden(obstacle, row.edge));
      const Vec2 point =
          point_of(state.shape, row.place) + height(row.level) * normal_of(state.shape, row.place);
      if (!concerns(point, from, to, 1.0) || !stands(state, row.place, row.level)) continue;
      // What lies behind another side lies behind the chain, or beside the area.
      if (dot(from - point, forbidden(obstacle, row.edge)) >= 0.0) rows.push_back(row);
    }
    ++row.edge;
  }
}

void EnvelopeRows::add_corner_rows(const State& state, const Obstacle& obstacle, const Row& row,
                                   std::vector<Row>& rows) const {
  Row round = row;
  round.level = level_towards(obstacle.side);
  const double nearest = problem_.limits[row.limit].bound + std::fabs(height(round.level));
  const auto stands_round = [&](std::size_t station) { return stands(state, station, round.level); };
  Row foot = row;
  foot.foot = true;
  for (foot.place = 0; foot.place < obstacle.corners.size() + obstacle.other_corners.size(); ++foot.place) {
    if (!obstacle.is_touchable(foot.place)) continue;
    const CornerView seen = view(state, obstacle, foot);
    if (seen.beyond && !seen.between) continue;
    round.edge = foot.place;
    const bool bends = !seen.beyond && foot.place < obstacle.corners.size() &&
                       add_round_rows(state, obstacle, round, nearest, stands_round, rows) &&
                       runs_round(track_, state, obstacle.corner(foot.place), seen.side, seen.foot, nearest);
    if (!bends) rows.push_back(foot);
  }
}

std::vector<Row> EnvelopeRows::rows(const State& state, std::size_t limit) const {
  const Obstacle& obstacle = problem_.obstacles[problem_.limits[limit].obstacle];
  std::vector<Row> rows;
  Row row;
  row.limit = limit;
  add_edge_rows(state, obstacle, row, rows);
  if (!obstacle.endless) add_corner_rows(state, obstacle, row, rows);
  row.face = true;
  for (const std::size_t station : {std::size_t{0}, state.shape.zeta.size() - 1}) {
    row.place = station;
    for (row.level = 0; row.level < 2; ++row.level) {
      // A line has one corner at each end.
      if (row.level == 0 || problem_.envelope_high > problem_.envelope_low) rows.push_back(row);
    }
  }
  return rows;
}

double EnvelopeRows::measure(const State& state, const Obstacle& obstacle, const Row& row) const {
  const Shape& shape = state.shape;
  if (row.face) return distance(obstacle, face_corner(state, row.place != 0, row.level).point).value;
  if (row.around) return round_distance(state, obstacle, row) - std::fabs(height(row.level));
  if (!row.foot) {
    const double height = cut(state, row.place, this->height(row.level)).height;
    const Vec2 point = point_of(shape, row.place) + height * normal_of(shape, row.place);
    return dot(on_edge(obstacle, row.edge) - point, forbidden(obstacle, row.edge));
  }
  const Vec2 corner = obstacle.corner(row.place);
  const CornerView seen = view(state, obstacle, row);
  if (!seen.beyond) {
    return corner_distance(seen.foot, corner, seen.side) - std::fabs(height(level_towards(seen.side)));
  }
  const Face face = this->face(shape, seen.at_finish);
  if (seen.between) return face.outward * dot(corner - face.point, face.tangent);
  return std::min(norm(corner - face_corner(state, seen.at_finish, 0).point),
                  norm(corner - face_corner(state, seen.at_finish, 1).point));
}

void EnvelopeRows::station_gradient(const State& state, const Obstacle& obstacle, const Row& row,
                                    double* out) const {
  const Shape& shape = state.shape;
  const Vec2 away = -1.0 * forbidden(obstacle, row.edge);
  const Cut here = cut(state, row.place, height(row.level));
  const Vec2 tangent = tangent_of(shape, row.place);
  const Vec2 normal = normal_of(shape, row.place);
  add_position(track_, shape, row.place, away, out);
  track_.add_dzeta(row.place, here.height * dot(away, tangent), out);
  if (!here.is_cut) return;
  // The height is ahead/approach: ahead = outward (face - point).t, approach = outward normal.t.
  const Face face = this->face(shape, !here.at_start);
  const double approach = face.outward * dot(normal, face.tangent);
  const double share = dot(away, normal) / approach;
  const Vec2 forward = face.outward * face.tangent;
  add_position(track_, shape, face.station, share * forward, out);
  add_position(track_, shape, row.place, -share * forward, out);
  const double over_face =
      -dot(face.point - point_of(shape, row.place), face.normal) + here.height * dot(normal, face.normal);
  track_.add_dzeta(face.station, share * face.outward * over_face, out);
  track_.add_dzeta(row.place, -share * here.height * dot(tangent, forward), out);
}

void EnvelopeRows::corner_gradient(const State& state, const Obstacle& obstacle, const Row& row,
                                   double* out) const {
  const std::size_t n = track_.layout().size();
  const Vec2 corner = obstacle.corner(row.place);
  const CornerView seen = view(state, obstacle, row);
  if (!seen.beyond) {
    Vector dx;
    Vector dy;
    track_.foot_derivatives(state.z, state.shape, seen.foot, dx, dy);
    add_scaled(out, seen.side * seen.foot.sin, dx.data(), n);
    add_scaled(out, -seen.side * seen.foot.cos, dy.data(), n);
    return;
  }
  const Face face = this->face(state.shape, seen.at_finish);
  if (seen.between) {
    add_position(track_, state.shape, face.station, -face.outward * face.tangent, out);
    track_.add_dzeta(face.station, -face.outward * dot(corner - face.point, face.normal), out);
    return;
  }
  const FaceCorner lower = face_corner(state, seen.at_finish, 0);
  const FaceCorner upper = face_corner(state, seen.at_finish, 1);
  const bool low = norm(corner - lower.point) < norm(corner - upper.point);
  const Vec2 way = (low ? lower : upper).point - corner;
  const double size = norm(way);
  if (size == 0.0) return;
  add_corner_gradient(state, face, low ? lower : upper, height(low ? 0 : 1), (1.0 / size) * way, out);
}

void EnvelopeRows::gradient(const State& state, const Obstacle& obstacle, const Row& row, double* out) const {
  if (row.face) {
    const FaceCorner corner = face_corner(state, row.place != 0, row.level);
    add_corner_gradient(state, face(state.shape, row.place != 0), corner, height(row.level),
                        distance(obstacle, corner.point).away, out);
  } else if (row.foot) {
    corner_gradient(state, obstacle, row, out);
  } else if (row.around) {
    add_round_gradient(track_, state, obstacle, row, out);
  } else {
    station_gradient(state, obstacle, row, out);
  }
}

void EnvelopeRows::add_weights(const State& state, const Obstacle& obstacle, const Row& row, double factor,
                               StationWeights& weights) const {
  const Shape& shape = state.shape;
  // A point at a height over a station: its normal turns with the track.
  const auto add_point = [&](std::size_t station, double height, Vec2 away) {
    weights.x[station] += factor * away.x;
    weights.y[station] += factor * away.y;
    weights.zeta_zeta[station] -= factor * height * dot(away, normal_of(shape, station));
  };
  if (row.face) {
    const FaceCorner corner = face_corner(state, row.place != 0, row.level);
    add_point(row.place, corner.along, distance(obstacle, corner.point).away);
    return;
  }
  if (row.around) return add_round_weights(state, obstacle, row, factor, weights);
  if (!row.foot) {
    add_point(row.place, cut(state, row.place, height(row.level)).height,
              -1.0 * forbidden(obstacle, row.edge));
    return;
  }
  const CornerView seen = view(state, obstacle, row);
  if (!seen.beyond) {
    add_foot_weights(seen.foot, factor * seen.side, weights);
  } else if (seen.between) {
    const Face face = this->face(shape, seen.at_finish);
    weights.x[face.station] -= factor * face.outward * face.tangent.x;
    weights.y[face.station] -= factor * face.outward * face.tangent.y;
    weights.zeta_zeta[face.station] -=
        factor * face.outward * dot(obstacle.corner(row.place) - face.point, face.tangent);
  }
}

void EnvelopeRows::add_direct_terms(const State& state, const Obstacle& obstacle, const Row& row,
                                    double factor, Matrix& hessian) const {
  const std::size_t n = track_.layout().size();
  if (row.face) {
    const FaceCorner corner = face_corner(state, row.place != 0, row.level);
    const Distance apart = distance(obstacle, corner.point);
    if (!apart.at_corner || apart.value == 0.0) return;
    Vector across(n, 0.0);
    add_corner_gradient(state, face(state.shape, row.place != 0), corner, height(row.level),
                        {-apart.away.y, apart.away.x}, across.data());
    add_symmetric(hessian, 0.5 * factor / apart.value, across, across);
    return;
  }
  if (row.around) return add_round_terms(track_, state, obstacle, row, factor, hessian);
  if (!row.foot) return;
  const Vec2 corner = obstacle.corner(row.place);
  const CornerView seen = view(state, obstacle, row);
  if (!seen.beyond) {
    add_foot_terms(track_, state, seen.foot, corner_distance(seen.foot, corner, seen.side), seen.side, factor,
                   hessian);
  } else if (seen.between) {
    const Face face = this->face(state.shape, seen.at_finish);
    Vector across(n, 0.0);
    add_position(track_, state.shape, face.station, face.normal, across.data());
    Vector turned(n, 0.0);
    track_.add_dzeta(face.station, 1.0, turned.data());
    add_symmetric(hessian, factor * face.outward, across, turned);
  }
}

}  // namespace glissade::optimizer
