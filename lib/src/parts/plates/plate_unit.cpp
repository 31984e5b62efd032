#include "parts/plates/plate_unit.hpp"

#include "glissade/core/math.hpp"

#include "core/least_rectangle.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/plates/corners.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/shop/bolts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

constexpr Vec3 kUp{0.0, 0.0, 1.0};

constexpr double kRolledFibre = 0.5;  // of the thickness: radii are large

/// A level line across a flat pattern.
struct Across {
  Vec2 from;
  Vec2 to;
};
Across across_at(double distance, const Span& base) {
  return {{distance, base.from}, {distance, base.to}};
}

double radius_of(double curvature) {
  return curvature == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / curvature;
}

}  // namespace

PlaneMotion into(const OwnPlane& plane) {
  const Vec2 back = PlaneMotion::turn(-plane.angle)(plane.origin);
  return PlaneMotion::turn(-plane.angle, -1.0 * back);
}

Vec3 across(const Placement& placement) {
  return placement.to_space(0.0, 0.0, 1.0) - placement.to_space(0.0, 0.0, 0.0);
}

Vec3 along(const Placement& placement) {
  return placement.to_space(1.0, 0.0, 0.0) - placement.to_space(0.0, 0.0, 0.0);
}

Vec3 in_space(const Placement& placement, Vec2 point) {
  return placement.to_space(point.x, -point.y, 0.0);
}

Vec3 direction_in_space(const Placement& placement, Vec2 direction) {
  return direction.x * along(placement) + direction.y * kUp;
}

OwnPlane own_plane(const ArcPath& outline) {
  constexpr double kSagitta =
      20e-6;  // of chords that stand for arcs; corners, which chords lie on, are exact
  const Vec2 first = outline.vertices.front().at;
  Vec2 far = first;
  for (const PathVertex& vertex : outline.vertices) {
    if (norm(vertex.at - first) > norm(far - first)) far = vertex.at;
  }
  // Of its four attitudes the one whose x runs along the plate.
  const double quarter = 0.5 * std::numbers::pi;
  const double lying = -core::lying_angle(flattened(outline, kSagitta));
  const double heading = math::atan2(far.y - first.y, far.x - first.x);
  OwnPlane plane;
  plane.angle = lying + quarter * std::nearbyint((heading - lying) / quarter);
  const ArcPath turned = moved(outline, PlaneMotion::turn(-plane.angle));
  const PlaneBox box = bounds(turned);
  plane.origin = PlaneMotion::turn(plane.angle)(box.low);
  return plane;
}

Frame moved_into(const Frame& place, const OwnPlane& own) {
  const auto [sine, cosine] = math::sine_cosine(own.angle);
  return {place.to_space({own.origin.x, own.origin.y, 0.0}), cosine * place.x + sine * place.y,
          cosine * place.y - sine * place.x, place.z};
}

double bend_radius(const Job& job) {
  return job.options.bend.inner_radius.value_or(job.channel.thickness);
}

double neutral_fibre(const Job& job) {
  if (job.options.floor == FloorMake::rolled) return job.options.bend.k_factor.value_or(kRolledFibre);
  return job.options.bend.k_factor.value_or(k_factor(bend_radius(job), job.channel.thickness));
}

Span wall_heights(const Job& job) {
  const bool beside = job.options.walls == WallSeat::beside_floor;
  return {-floor_depth(job) - (beside ? job.channel.thickness + overlap(job) : 0.0), job.channel.wall_height};
}

double floor_depth(const Job& job) {
  return job.options.liner ? job.options.liner->thickness : 0.0;
}

Frame plane_of_track(const Placement& placement, Vec2 origin, double angle, double shift) {
  const auto [sine, cosine] = math::sine_cosine(angle);
  const Vec3 run = along(placement);
  const Vec3 left = across(placement);
  return {in_space(placement, origin) - shift * left, cosine * run + sine * kUp, cosine * kUp - sine * run,
          -1.0 * left};
}

ShopPart upright_plate(const Job& job, const PlaneRegion& region, double depth,
                       const std::vector<double>& shifts) {
  const OwnPlane plane = own_plane(region.outline);
  ShopPart part;
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = depth;
  part.body = Prism{moved(region, into(plane)), depth};
  for (const double shift : shifts) {
    part.places.push_back(plane_of_track(job.placement, plane.origin, plane.angle, shift));
  }
  weigh(part);
  return part;
}

FloorFace rolled_face(const ArcSpline& track, const Span& span, double depth) {
  ArcPath line = *offset_line(track, span, -depth);
  const Vec2 origin = line.vertices.front().at;
  for (PathVertex& vertex : line.vertices) vertex.at = vertex.at - origin;
  return {ArcSpline(std::move(line)), origin, std::nullopt};
}

FloorFace bent_floor_face(const Job& job, Facets facets) {
  const Vec2 origin = facets.corners.front();
  return {bent_face(facets, bend_radius(job), job.channel.thickness), origin, std::move(facets)};
}

double flat_length(const TrackArc& arc, double thickness, double neutral, bool bent) {
  const double turned = arc.curvature * arc.length;
  if (!bent) return arc.length + neutral * thickness * turned;
  // The inside of a bend is the upper face in a hollow, the lower one on a crest.
  const double from_face = turned > 0.0 ? neutral : 1.0 - neutral;
  return arc.length + from_face * thickness * turned;
}

namespace {

/// What a floor looks like from its side, in the plane of the track.
ArcPath side_view(const Job& job, const FloorFace& face) {
  ArcPath outline = *band(face.line, {0.0, face.line.length()}, -job.channel.thickness, 0.0);
  for (PathVertex& vertex : outline.vertices) vertex.at = vertex.at + face.origin;
  return outline;
}

}  // namespace

void drill_floor(const Job& job, const FloorFace& face, const std::vector<Span>& tabs,
                 std::vector<Circle> holes, ShopPart& floor) {
  ArcPath path = face.line.path();
  for (PathVertex& vertex : path.vertices) vertex.at = vertex.at + face.origin;
  RolledSheet sheet;
  sheet.path = moved(path, into(own_plane(side_view(job, face))));
  sheet.thickness = job.channel.thickness;
  sheet.region = floor_sheet(job, face.line, tabs);
  sheet.region.holes = std::move(holes);
  floor.body = std::move(sheet);
  weigh(floor);
}

ShopPart floor_plate(const Job& job, const FloorFace& face, const std::vector<Span>& tabs,
                     std::vector<BendStep>& steps) {
  const double thickness = job.channel.thickness;
  const double width = floor_width(job);
  const ArcSpline& line = face.line;
  const PlaneRegion side{side_view(job, face), {}, {}};
  ShopPart part = upright_plate(job, side, width, {-0.5 * width});
  part.thickness = thickness;
  part.name = "floor";
  const PlaneRegion sheet = floor_sheet(job, line, tabs);
  if (sheet.outline.vertices.size() > 4 || !sheet.cutouts.empty()) drill_floor(job, face, tabs, {}, part);
  FlatPattern pattern;
  double reached = 0.0;
  double sum = 0.0;
  int hit = 0;
  const bool bent = face.facets.has_value();
  const Span base = floor_base(job);
  for (const TrackArc& arc : line.arcs()) {
    const double length = flat_length(arc, thickness, neutral_fibre(job), bent);
    const double turned = arc.curvature * arc.length;
    if (bent && turned != 0.0) {
      sum += turned;
      const Across at = across_at(reached + 0.5 * length, base);
      pattern.bends.push_back(
          {at.from, at.to, Angle::from_radians(std::fabs(turned)), bend_radius(job), turned > 0.0});
      const double miss = face.facets->misses[static_cast<std::size_t>(hit)];
      ++hit;
      steps.push_back({0, hit, reached + 0.5 * length, 0.0, Angle::from_radians(turned),
                       Angle::from_radians(sum), bend_radius(job), miss});
    } else if (!bent) {
      sum += turned;
      const Across at = across_at(reached, base);
      pattern.rolls.push_back({at.from, at.to, radius_of(arc.curvature)});
      ++hit;
      steps.push_back({0, hit, reached, length, Angle::from_radians(turned), Angle::from_radians(sum),
                       radius_of(arc.curvature), 0.0});
    }
    reached += length;
  }
  pattern.region = developed(job, face, sheet);
  part.pattern = std::move(pattern);
  return part;
}

std::optional<ShopPart> wall_plate(const Job& job, const Span& span, const FloorFace& face,
                                   const std::vector<Span>& tabs) {
  const auto region = wall_region(job, span, face, tabs);
  if (!region) return std::nullopt;
  return wall_of(job, *region);
}

ShopPart wall_of(const Job& job, const PlaneRegion& region) {
  const double inner = 0.5 * job.channel.width;
  ShopPart part = upright_plate(job, region, job.channel.wall(), {-inner - job.channel.wall(), inner});
  part.name = "wall";
  FlatPattern pattern;
  pattern.region = std::get<Prism>(part.body).region;
  part.pattern = std::move(pattern);
  return part;
}

Frame frame_place(const Job& job, double s, bool downstream) {
  const TrackFrame at = frame_at(job.track, s);
  const Vec3 run = along(job.placement);
  const Vec3 tangent = at.along.x * run + at.along.y * kUp;
  const Vec3 up = at.up.x * run + at.up.y * kUp;
  const double shift = downstream ? 0.0 : -job.options.flanges.thickness;
  return {in_space(job.placement, at.at) + shift * tangent, across(job.placement), up, tangent};
}

PlaneRegion frame_region(const Job& job, double width, double top, bool over_laps) {
  const double gap = job.options.flanges.gap;
  const double inner = 0.5 * job.channel.width + job.channel.wall() + gap;
  const double low = -floor_depth(job) - job.channel.thickness - gap;
  const double outer = inner + width;
  const double bottom = low - width;
  PlaneRegion region;
  region.outline.closed = true;
  std::vector<Vec2> corners = {{-outer, bottom}, {outer, bottom}};
  if (job.channel.wall_height > 0.0) {
    // The right half of the opening, from the top down.
    std::vector<Vec2> right = {{inner, top}, {inner, low}};
    const double lap = over_laps ? overlap(job) : 0.0;
    if (lap > 0.0 && job.options.walls == WallSeat::beside_floor) {
      const double beside = 0.5 * job.channel.width - gap;
      right = {{inner, top}, {inner, low - lap}, {beside, low - lap}, {beside, low}};
    } else if (lap > 0.0) {
      const double over = -floor_depth(job) + gap;
      right = {{inner, top}, {inner, over}, {inner + lap, over}, {inner + lap, low}};
    }
    corners.push_back({outer, top});
    corners.insert(corners.end(), right.begin(), right.end());
    for (auto corner = right.rbegin(); corner != right.rend(); ++corner)
      corners.push_back({-corner->x, corner->y});
    corners.push_back({-outer, top});
  } else {
    corners.push_back({outer, low});
    corners.push_back({-outer, low});
  }
  for (const Vec2 corner : corners) region.outline.vertices.push_back({corner, 0.0});
  return region;
}

ArcPath frame_line(const Job& job, double width, double top) {
  const double in = line_in_band(width) + job.options.flanges.gap;
  const double side = 0.5 * job.channel.width + job.channel.wall() + in;
  const double level = -floor_depth(job) - job.channel.thickness - in;
  if (job.channel.wall_height == 0.0) return {{{{side, level}, 0.0}, {{-side, level}, 0.0}}, false};
  return {{{{side, top}, 0.0}, {{side, level}, 0.0}, {{-side, level}, 0.0}, {{-side, top}, 0.0}}, false};
}

ShopPart frame_plate(const Job& job, FlangeSide of_joint, const std::vector<Frame>& places) {
  const FlangeOptions& flange = job.options.flanges;
  const double inner = 0.5 * job.channel.width + job.channel.wall() + flange.gap;
  const double low = -floor_depth(job) - job.channel.thickness - flange.gap;
  const double top = job.channel.wall_height;
  const bool walls = top > 0.0;
  PlaneRegion region = frame_region(job, flange.width, top, false);

  const double side = inner + 0.5 * flange.width;
  const double level = low - 0.5 * flange.width;
  const double rim = bolts_below_rim(job.options);
  const auto bolts = [&](const FlangeOptions& with) {
    std::vector<Vec2> all = evenly({-side, level}, {side, level}, with.pitch);
    if (!walls) return all;
    for (const double x : {-side, side}) {
      const std::vector<Vec2> column =
          evenly({x, level}, {x, top - std::max(below_top(with), rim)}, with.pitch);
      all.insert(all.end(), column.begin() + 1, column.end());
    }
    return all;
  };
  drill_frame(job.options, of_joint, bolts, region);
  ShopPart part;
  part.name = frame_name("end_frame", flange, of_joint);
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = flange.thickness;
  part.body = Prism{region, flange.thickness};
  part.places = places;
  weigh(part);
  FlatPattern pattern;
  pattern.region = region;
  part.pattern = std::move(pattern);
  return part;
}

}  // namespace glissade::parts
