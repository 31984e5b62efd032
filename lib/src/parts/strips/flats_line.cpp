#include "parts/strips/flats_line.hpp"

#include "parts/plates/plate_unit.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

/// The options, with what they say of places along the track as places along the flats.
PlateOptions along(const FlatsLine& flats, PlateOptions options) {
  for (FloorWear& wear : options.floor_wear) wear.at = flats.on_line(wear.at);
  for (InspectionOptions& opening : options.inspection) {
    // One that is not on the track stays so: it is refused with the track's length.
    if (opening.at > 0.0 && opening.at < flats.track_end()) opening.at = flats.on_line(opening.at);
  }
  return options;
}

}  // namespace

std::vector<FlatsLine::Corner> FlatsLine::corners_of(const std::vector<Facets>& units) {
  std::vector<Corner> all{{units.front().corners.front()}};
  for (const Facets& unit : units) {
    for (std::size_t i = 1; i < unit.corners.size(); ++i)
      all.push_back({unit.corners[i], i <= unit.bends() ? unit.misses[i - 1] : 0.0});
  }
  return all;
}

ArcSpline FlatsLine::line_through(const std::vector<Corner>& corners) {
  ArcPath path;
  for (const Corner& corner : corners) path.vertices.push_back({corner.at, 0.0});
  return ArcSpline(std::move(path), std::numbers::pi);
}

FlatsLine::FlatsLine(const ArcSpline& track, const std::vector<Facets>& units)
    : corners_(corners_of(units)), line_(line_through(corners_)) {
  const std::vector<TrackArc>& flats = line_.arcs();
  std::size_t flat = 0;
  for (const Facets& unit : units) {
    const FlatPlaces own = flat_places(track, unit);
    const std::size_t first = places_.on_track.empty() ? 0 : 1;  // the last of a unit begins the next one
    for (std::size_t i = first; i < own.on_track.size(); ++i) {
      places_.on_track.push_back(own.on_track[i]);
      places_.on_flats.push_back(flats[flat].start + own.on_flats[i]);
    }
    flat += unit.bends() + 1;
    places_.on_flats.back() = flat < flats.size() ? flats[flat].start : line_.length();
  }
}

double FlatsLine::on_line(double s) const {
  return places_.flats_at(s);
}

double FlatsLine::on_track(double place) const {
  return places_.track_at(place);
}

double FlatsLine::miss_at(Vec2 point) const {
  const auto nearest = std::min_element(
      corners_.begin(), corners_.end(),
      [&](const Corner& a, const Corner& b) { return norm(a.at - point) < norm(b.at - point); });
  return nearest->miss;
}

FlatsJob::FlatsJob(const StripJob& job, const BentStrips& bent, const std::vector<double>& joints)
    : flats_(job.track, bent.facets()),
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
