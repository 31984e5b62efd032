// An offset of an arc is an arc round the same centre, of another radius and the same angle: bulges stay. Where the
// height exceeds the radius of a hollow the arc would turn over; it is left out, and the neighbours end where they meet
// the end plane or each other.

#include "parts/curves/offset_line.hpp"

#include "glissade/core/math.hpp"

#include "core/arc_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kSame = 1e-12;  // [m]

/// One arc of an offset line, with what it stems from.
struct Piece {
  Vec2 from;
  Vec2 to;
  double bulge = 0.0;
};

PathPiece path_piece(const Piece& piece) {
  return {piece.from, piece.to, piece.bulge};
}

/// The arcs that stand upright at a height, in their order; `gap` tells that some are missing before the piece.
struct Raw {
  std::vector<Piece> pieces;
  std::vector<bool> gap_before;
  bool gap_at_end = false;
};

Raw raw_pieces(const ArcSpline& track, const Span& span, double height) {
  Raw raw;
  bool gap = false;
  for (const TrackArc& arc : track.arcs()) {
    const double from = std::max(span.from, arc.start);
    const double to = std::min(span.to, arc.start + arc.length);
    if (!(to - from > kSame)) continue;
    if (!(1.0 - arc.curvature * height > 1e-9)) {
      gap = true;
      continue;
    }
    const TrackFrame first = frame_at(track, from);
    const TrackFrame last = frame_at(track, to);
    raw.pieces.push_back({first.at + height * first.up, last.at + height * last.up,
                          math::tan(0.25 * arc.curvature * (to - from))});
    // Joints are the same numbers on both sides.
    if (raw.pieces.size() > 1 && !gap) raw.pieces.back().from = raw.pieces[raw.pieces.size() - 2].to;
    raw.gap_before.push_back(gap);
    gap = false;
  }
  raw.gap_at_end = gap;
  return raw;
}

/// Where a ray from a point meets a piece, as the share of the piece; the farthest along the piece or the first.
std::optional<double> meeting(const Piece& piece, Vec2 origin, Vec2 ray) {
  const auto on_ray = [&](Vec2 point) { return dot(point - origin, ray) > kSame; };
  if (piece.bulge == 0.0) {
    const Vec2 chord = piece.to - piece.from;
    const double area = cross(chord, ray);
    if (area == 0.0) return std::nullopt;
    const double share = cross(origin - piece.from, ray) / area;
    const bool on = share >= 0.0 && share <= 1.0 && on_ray(piece.from + share * chord);
    return on ? std::optional(share) : std::nullopt;
  }
  const CircularArc arc = arc_of(path_piece(piece));
  const Vec2 away = origin - arc.centre;
  const double along = dot(away, ray);
  const double across = cross(ray, away);
  const double square = arc.radius * arc.radius - across * across;
  if (square < 0.0) return std::nullopt;
  for (const double sign : {1.0, -1.0}) {
    const Vec2 point = origin + (-along + sign * std::sqrt(square)) * ray;
    const Vec2 from_centre = point - arc.centre;
    double turned = math::atan2(from_centre.y, from_centre.x) - arc.start_angle;
    const double turn = 2.0 * std::numbers::pi;
    turned -= turn * std::nearbyint((turned - 0.5 * arc.sweep) / turn);
    const double share = turned / arc.sweep;
    if (share >= 0.0 && share <= 1.0 && on_ray(point)) return share;
  }
  return std::nullopt;
}

/// Where two pieces cross, as shares of each; by bisecting the second along the distance from the first's circle.
struct Cut {
  double first = 0.0;
  double second = 0.0;
};

Piece part_of(const Piece& piece, double from, double to) {
  const double quarter = math::atan(piece.bulge);
  return {from <= 0.0 ? piece.from : point_on(path_piece(piece), from),
          to >= 1.0 ? piece.to : point_on(path_piece(piece), to), math::tan(quarter * (to - from))};
}

/// The share of a piece whose point is nearest to a given one; outside 0 to 1 where that lies beyond its ends.
double share_of(const Piece& piece, Vec2 point) {
  const Vec2 chord = piece.to - piece.from;
  if (piece.bulge == 0.0) return dot(point - piece.from, chord) / dot(chord, chord);
  const CircularArc arc = arc_of(path_piece(piece));
  const Vec2 away = point - arc.centre;
  double turned = math::atan2(away.y, away.x) - arc.start_angle;
  const double turn = 2.0 * std::numbers::pi;
  turned -= turn * std::nearbyint((turned - 0.5 * arc.sweep) / turn);
  return turned / arc.sweep;
}

/// @return signed distance of a point from the line or circle of a piece
double side_of(const Piece& piece, Vec2 point) {
  if (piece.bulge == 0.0) {
    const Vec2 chord = piece.to - piece.from;
    return cross(chord, point - piece.from) / norm(chord);
  }
  const Circle arc = core::circle_of(path_piece(piece));
  return (piece.bulge > 0.0 ? 1.0 : -1.0) * (arc.radius - norm(point - arc.centre));
}

std::optional<Cut> crossing(const Piece& first, const Piece& second) {
  constexpr int kSteps = 16;
  for (int k = 0; k < kSteps; ++k) {
    double low = static_cast<double>(k) / kSteps;
    double high = static_cast<double>(k + 1) / kSteps;
    const auto side = [&](double share) { return side_of(first, point_on(path_piece(second), share)); };
    const double at_low = side(low);
    if ((at_low > 0.0) == (side(high) > 0.0)) continue;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      ((side(middle) > 0.0) == (at_low > 0.0) ? low : high) = middle;
    }
    const double share = share_of(first, point_on(path_piece(second), low));
    if (share >= 0.0 && share <= 1.0) return Cut{share, low};
  }
  return std::nullopt;
}

/// Cuts a folded start away: the line begins where it leaves the plane of the start for good.
bool cut_start(Raw& raw, const TrackFrame& start) {
  for (std::size_t i = raw.pieces.size(); i-- > 0;) {
    const auto share = meeting(raw.pieces[i], start.at, start.up);
    if (!share) continue;
    raw.pieces[i] = part_of(raw.pieces[i], *share, 1.0);
    raw.pieces.erase(raw.pieces.begin(), raw.pieces.begin() + static_cast<std::ptrdiff_t>(i));
    raw.gap_before.erase(raw.gap_before.begin(), raw.gap_before.begin() + static_cast<std::ptrdiff_t>(i));
    raw.gap_before.front() = false;
    return true;
  }
  return false;
}

bool cut_end(Raw& raw, const TrackFrame& end) {
  for (std::size_t i = 0; i < raw.pieces.size(); ++i) {
    const auto share = meeting(raw.pieces[i], end.at, end.up);
    if (!share) continue;
    raw.pieces[i] = part_of(raw.pieces[i], 0.0, *share);
    raw.pieces.resize(i + 1);
    raw.gap_before.resize(i + 1);
    return true;
  }
  return false;
}

/// Joins the branches beside a gap where they cross.
bool cut_gap(Raw& raw, std::size_t gap) {
  for (std::size_t i = gap; i-- > 0;) {
    for (std::size_t j = gap; j < raw.pieces.size(); ++j) {
      const auto cut = crossing(raw.pieces[i], raw.pieces[j]);
      if (!cut) continue;
      raw.pieces[i] = part_of(raw.pieces[i], 0.0, cut->first);
      raw.pieces[j] = part_of(raw.pieces[j], cut->second, 1.0);
      raw.pieces[j].from = raw.pieces[i].to;
      const auto first = static_cast<std::ptrdiff_t>(i) + 1;
      const auto last = static_cast<std::ptrdiff_t>(j);
      raw.pieces.erase(raw.pieces.begin() + first, raw.pieces.begin() + last);
      raw.gap_before.erase(raw.gap_before.begin() + first, raw.gap_before.begin() + last);
      raw.gap_before[i + 1] = false;
      return true;
    }
  }
  return false;
}

}  // namespace

TrackFrame frame_at(const ArcSpline& track, double s) {
  const CenterlinePoint at = track.at(std::clamp(s, 0.0, track.length()));
  const auto [sine, cosine] = math::sine_cosine(at.slope_angle);
  return {{at.x, -at.drop}, {cosine, -sine}, {sine, cosine}};
}

bool folds(const ArcSpline& track, const Span& span, double height) {
  return std::any_of(track.arcs().begin(), track.arcs().end(), [&](const TrackArc& arc) {
    const bool within = arc.start + arc.length > span.from + kSame && arc.start < span.to - kSame;
    return within && !(1.0 - arc.curvature * height > 1e-9);
  });
}

std::optional<ArcPath> offset_line(const ArcSpline& track, const Span& span, double height) {
  Raw raw = raw_pieces(track, span, height);
  if (raw.pieces.empty()) return std::nullopt;
  if (raw.gap_before.front() && !cut_start(raw, frame_at(track, span.from))) return std::nullopt;
  if (raw.gap_at_end && !cut_end(raw, frame_at(track, span.to))) return std::nullopt;
  for (std::size_t i = 1; i < raw.pieces.size(); ++i) {
    if (!raw.gap_before[i]) continue;
    if (!cut_gap(raw, i)) return std::nullopt;
    i = 0;
  }
  ArcPath line;
  for (const Piece& piece : raw.pieces) line.vertices.push_back({piece.from, piece.bulge});
  line.vertices.push_back({raw.pieces.back().to, 0.0});
  return line;
}

std::optional<ArcPath> band(const ArcSpline& track, const Span& span, double low, double high) {
  const auto lower = offset_line(track, span, low);
  const auto upper = offset_line(track, span, high);
  if (!lower || !upper) return std::nullopt;
  ArcPath outline = *lower;
  const ArcPath back = reversed(*upper);
  outline.vertices.insert(outline.vertices.end(), back.vertices.begin(), back.vertices.end());
  outline.vertices.back().bulge = 0.0;
  outline.closed = true;
  return outline;
}

OnOneArc::OnOneArc(const ArcSpline& track, double radius, const Span& heights,
                   const std::vector<double>& breaks, const std::vector<double>& bends) {
  for (std::size_t k = 0; k < track.arcs().size(); ++k) {
    const TrackArc& arc = track.arcs()[k];
    const double shrunk = std::min(1.0 - arc.curvature * heights.from, 1.0 - arc.curvature * heights.to);
    if (!(shrunk > 0.0)) continue;
    const double half = (radius + kAside) / shrunk;
    std::vector<double> ends = {arc.start, arc.start + arc.length};
    if (!bends.empty()) ends = {arc.start + bends.at(k), arc.start + arc.length - bends.at(k + 1)};
    if (!(ends[1] > ends[0])) continue;
    const Span between{ends[0], ends[1]};
    for (const double place : breaks) {
      if (place > between.from && place < between.to) ends.push_back(place);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (ends[i + 1] - ends[i] >= 2.0 * half) rooms_.push_back({ends[i] + half, ends[i + 1] - half});
    }
  }
}

std::vector<double> OnOneArc::ends_of_tab(const Span& tab, double slack) {
  // What keeps off the ends of a slot is off those of its tab, unless the slot is much longer.
  if (slack <= 0.5 * kAside) return {tab.from - slack, tab.to + slack};
  return {tab.from - slack, tab.from, tab.to, tab.to + slack};
}

std::optional<double> OnOneArc::nearest(double about, const Span& within) const {
  std::optional<double> best;
  for (const Span& room : rooms_) {
    const double from = std::max(room.from, within.from);
    const double to = std::min(room.to, within.to);
    if (from > to) continue;
    const double place = std::clamp(about, from, to);
    if (!best || std::fabs(place - about) < std::fabs(*best - about)) best = place;
  }
  return best;
}

}  // namespace glissade::parts
