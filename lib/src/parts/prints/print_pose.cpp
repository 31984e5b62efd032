#include "parts/prints/print_pose.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::parts {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 in_plane(Vec2 direction) {
  return {direction.x, 0.0, direction.y};
}

/// Steepest underside of a section that lies on one side.
double overhang_on_side(const FaceOutline& face, double up) {
  const double lowest = up > 0.0 ? face.low().x : face.high().x;
  double steepest = 0.0;
  for (const auto& loop : face.loops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if (a.x == lowest && b.x == lowest) continue;  // on the bed
      const Vec2 along = b - a;
      const double down = -up * along.y / norm(along);  // of the normal (along.y, -along.x)
      steepest = std::max(steepest, math::asin(std::clamp(down, 0.0, 1.0)));
    }
  }
  return steepest;
}

/// How far the track turns from one direction, at most.
double largest_turn(const ArcSpline& track, const Span& span, Vec2 from) {
  double most = 0.0;
  const auto see = [&](double s) {
    const TrackFrame at = frame_at(track, s);
    most = std::max(most, std::fabs(math::atan2(cross(from, at.along), dot(from, at.along))));
  };
  see(span.from);
  see(span.to);
  for (const TrackArc& arc : track.arcs()) {
    if (arc.start > span.from && arc.start < span.to) see(arc.start);
  }
  return most;
}

std::vector<Pose> on_side(const FaceOutline& face) {
  const Pose left{PrintPose::side, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, overhang_on_side(face, 1.0), 0.0};
  const Pose right{PrintPose::side, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, overhang_on_side(face, -1.0), 0.0};
  if (right.overhang < left.overhang) return {right, left};
  return {left, right};
}

std::vector<Pose> on_end(const ArcSpline& track, const Span& span, double layer) {
  std::vector<Pose> poses;
  for (const bool downstream : {true, false}) {
    const TrackFrame at = frame_at(track, downstream ? span.to : span.from);
    Pose pose;
    pose.kind = PrintPose::end;
    pose.up = (downstream ? -1.0 : 1.0) * in_plane(at.along);
    pose.right = {0.0, 1.0, 0.0};
    pose.deep = cross(pose.up, pose.right);
    pose.overhang = largest_turn(track, span, at.along);
    pose.step = layer * math::sin(std::min(pose.overhang, kRightAngle));
    poses.push_back(pose);
  }
  if (poses[1].overhang < poses[0].overhang) std::swap(poses[0], poses[1]);
  return poses;
}

std::vector<Pose> as_used(const ArcSpline& track, const Span& span, double layer) {
  const Vec2 chord = frame_at(track, span.to).at - frame_at(track, span.from).at;
  const Vec2 along = (1.0 / norm(chord)) * chord;
  Pose pose;
  pose.kind = PrintPose::flat;
  pose.right = in_plane(along);
  pose.up = in_plane({-along.y, along.x});
  pose.deep = cross(pose.up, pose.right);
  pose.overhang = kRightAngle;  // its underside stands on one line
  pose.step = layer;
  return {pose};
}

}  // namespace

std::vector<Pose> poses_of(PrintPose kind, const ArcSpline& track, const Span& span, const FaceOutline& face,
                           double layer) {
  if (kind == PrintPose::side) return on_side(face);
  return kind == PrintPose::end ? on_end(track, span, layer) : as_used(track, span, layer);
}

Vec3 size_on_bed(const Pose& pose, const std::vector<Vec3>& points) {
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3& point : points) {
    const Vec3 at{dot(point, pose.right), dot(point, pose.deep), dot(point, pose.up)};
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  return high - low;
}

std::optional<Pose> turned_to_fit(Pose pose, const std::vector<Vec3>& points, const PrintBed& bed) {
  const double wide = bed.x - 2.0 * bed.gap;
  const double deep = bed.y - 2.0 * bed.gap;
  if (!(size_on_bed(pose, points).z <= bed.z)) return std::nullopt;
  std::optional<Pose> best;
  double least = 1.0;  // of the room
  for (int degrees = 0; degrees < 180; ++degrees) {
    const auto [sine, cosine] = math::sine_cosine(Angle::from_degrees(degrees).radians());
    Pose turned = pose;
    turned.right = cosine * pose.right + sine * pose.deep;
    turned.deep = cosine * pose.deep - sine * pose.right;
    const Vec3 size = size_on_bed(turned, points);
    const double taken = std::max(size.x / wide, size.y / deep);
    if (taken > least - 1e-9) continue;
    least = taken;
    best = turned;
  }
  return best;
}

std::vector<Vec3> outline_points(const ArcSpline& track, const Span& span, const FaceOutline& face) {
  std::vector<double> places;
  constexpr int kPlaces = 48;
  for (int k = 0; k <= kPlaces; ++k) places.push_back(span.from + (span.to - span.from) * k / kPlaces);
  std::vector<Vec3> points;
  for (const double s : places) {
    const TrackFrame at = frame_at(track, std::clamp(s, span.from, span.to));
    for (const double height : {face.low().y, face.high().y}) {
      const Vec2 point = at.at + height * at.up;
      points.push_back({point.x, face.low().x, point.y});
      points.push_back({point.x, face.high().x, point.y});
    }
  }
  return points;
}

TriangleMesh posed(const TriangleMesh& mesh, const Pose& pose) {
  TriangleMesh turned = mesh;
  Vec3 low{kInfinity, kInfinity, kInfinity};
  for (Vec3& vertex : turned.vertices) {
    vertex = {dot(vertex, pose.right), dot(vertex, pose.deep), dot(vertex, pose.up)};
    low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y), std::min(low.z, vertex.z)};
  }
  for (Vec3& vertex : turned.vertices) vertex = vertex - low;
  return turned;
}

}  // namespace glissade::parts
