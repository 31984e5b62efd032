#include "parts/strips/flats_line.hpp"

#include "parts/plates/plate_unit.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

ArcSpline line_through(const std::vector<FlatCorner>& corners) {
  ArcPath path;
  for (const FlatCorner& corner : corners) path.vertices.push_back({corner.at, 0.0});
  return ArcSpline(std::move(path), std::numbers::pi);
}

/// Linear between values that ascend.
double between(const std::vector<double>& from, const std::vector<double>& to, double value) {
  const auto after = std::upper_bound(from.begin() + 1, from.end() - 1, value);
  const auto i = static_cast<std::size_t>(after - from.begin());
  if (value == from[i - 1]) return to[i - 1];
  if (value == from[i]) return to[i];
  return to[i - 1] + (value - from[i - 1]) / (from[i] - from[i - 1]) * (to[i] - to[i - 1]);
}

std::vector<double> on_track_of(const std::vector<FlatCorner>& corners) {
  std::vector<double> places;
  for (const FlatCorner& corner : corners) places.push_back(corner.s);
  return places;
}

/// The options, with what they say of places along the track as places along the flats.
PlateOptions along(const FlatsLine& flats, PlateOptions options) {
  for (FloorWear& wear : options.floor_wear) wear.at = flats.on_line(wear.at);
  for (InspectionOptions& opening : options.inspection) {
    // One that is not on the track stays so: it is refused with the track's length.
    if (opening.at > 0.0 && opening.at < on_track_of(flats.corners()).back())
      opening.at = flats.on_line(opening.at);
  }
  return options;
}

}  // namespace

FlatsLine::FlatsLine(const std::vector<FlatCorner>& corners)
    : corners_(corners), line_(line_through(corners)) {
  for (const TrackArc& flat : line_.arcs()) places_.push_back(flat.start);
  places_.push_back(line_.length());
}

double FlatsLine::on_line(double s) const {
  return between(on_track_of(corners_), places_, s);
}

double FlatsLine::on_track(double place) const {
  return between(places_, on_track_of(corners_), place);
}

double FlatsLine::miss_at(Vec2 point) const {
  const auto nearest = std::min_element(
      corners_.begin(), corners_.end(),
      [&](const FlatCorner& a, const FlatCorner& b) { return norm(a.at - point) < norm(b.at - point); });
  return nearest->miss;
}

FlatsJob::FlatsJob(const StripJob& job, const BentStrips& bent, const std::vector<double>& joints)
    : flats_(bent.corners()),
      options_(along(flats_, job.options)),
      job_(flats_, job.section, options_, job.placement) {
  for (const double joint : joints) joints_.push_back(flats_.on_line(joint));
}

bool has_works(const PlateOptions& options) {
  return options.corners.kind != CornerJoint::butt || options.liner || options.cover ||
         !options.inspection.empty();
}

namespace {

/// Whether the edge of a sheet at its lower y is that beside the floor, as SectionPlate::ends_at_floor() has it.
bool begins_at_floor(const RolledSheet& sheet) {
  constexpr double kLevel = 1e-9;  // rounding: of heights that are one [m]
  const PlaneBox box = bounds(sheet.region.outline);
  const auto height = [&](double y) { return std::fabs(sheet.foot.x + y * sheet.across.x); };
  return height(box.low.y) <= height(box.high.y) + kLevel;
}

}  // namespace

void schedule_bends(const FlatsJob& flats, Workshop& workshop) {
  for (const ShopPart& part : workshop.parts) {
    if (!part.pattern || part.pattern->bends.empty()) continue;
    const bool known = std::any_of(workshop.bends.begin(), workshop.bends.end(),
                                   [&](const BendStep& step) { return step.part == part.number; });
    const auto* const sheet = std::get_if<RolledSheet>(&part.body);
    if (known || sheet == nullptr) continue;
    // Their corners in the plane of the track.
    const Vec3 run = glissade::parts::along(flats.job().placement);
    const Vec3 base = in_space(flats.job().placement, {});
    std::vector<Vec2> corners;
    for (const PathVertex& vertex : sheet->path.vertices) {
      const Vec3 at = part.places.front().to_space({vertex.at.x, vertex.at.y, 0.0}) - base;
      corners.push_back({dot(at, run), at.z});
    }
    double reached = 0.0;
    double sum = 0.0;
    int hit = 0;
    // Outlines begin upstream at the lower y, bends end there.
    const bool lower = begins_at_floor(*sheet);
    const auto& outline = part.pattern->region.outline.vertices;
    Vec2 before = lower ? outline.front().at : outline.back().at;
    for (const BendLine& bend : part.pattern->bends) {
      const Vec2 at = lower ? bend.to : bend.from;
      reached += norm(at - before);
      before = at;
      const double angle = bend.up ? bend.angle.radians() : -bend.angle.radians();
      sum += angle;
      const std::size_t corner = std::min(corners.size() - 1, static_cast<std::size_t>(++hit));
      workshop.bends.push_back({part.number, hit, reached, 0.0, Angle::from_radians(angle),
                                Angle::from_radians(sum), bend.inner_radius,
                                flats.flats().miss_at(corners[corner])});
    }
  }
}

}  // namespace glissade::parts
