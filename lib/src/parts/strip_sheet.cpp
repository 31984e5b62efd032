#include "parts/strip_sheet.hpp"

#include "glissade/core/math.hpp"

#include "parts/body_geometry.hpp"
#include "parts/offset_line.hpp"
#include "parts/plate_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace glissade::parts {
namespace {

using Meeting = CornerEdge::Meeting;

double sine_over(double half) {
  return std::fabs(half) < 1e-9 ? 1.0 : math::sin(half) / half;
}

}  // namespace

StripFlat::StripFlat(const StripJob& job, const SectionPlate& plate, const Span& span) {
  const Vec2 way = plate.way();
  rise_ = way.y;
  const Vec2 back{-way.y, way.x};
  foot_ = plate.face_from.y + 0.5 * dot(back, plate.back_from - plate.face_from) * back.y;
  for (const StripArc& one : job.arcs_in(span)) arcs_.push_back(one.arc);
  Vec2 at;
  double heading = 0.0;
  for (const TrackArc& arc : arcs_) {
    starts_.push_back(at);
    headings_.push_back(heading);
    // The development of strip_shape.cpp, from its other edge: lines along the plate turn by -rise of what the track does.
    const double turn = -rise_ * arc.curvature * arc.length;
    const double chord = arc.length * (1.0 - arc.curvature * foot_) * sine_over(0.5 * turn);
    const auto [sine, cosine] = math::sine_cosine(heading + 0.5 * turn);
    at = at + chord * Vec2{cosine, sine};
    heading += turn;
  }
}

Vec2 StripFlat::at(double s, double y) const {
  std::size_t i = 0;
  while (i + 1 < arcs_.size() && s > arcs_[i].start + arcs_[i].length) ++i;
  const TrackArc& arc = arcs_[i];
  const double along = s - arc.start;
  const double turn = -rise_ * arc.curvature * along;
  const double chord = along * (1.0 - arc.curvature * foot_) * sine_over(0.5 * turn);
  const auto [sine, cosine] = math::sine_cosine(headings_[i] + 0.5 * turn);
  const auto [up_sine, up_cosine] = math::sine_cosine(headings_[i] + turn);
  return starts_[i] + chord * Vec2{cosine, sine} - y * Vec2{-up_sine, up_cosine};
}

void StripFlat::append_edge(double from, double to, double y, ArcPath& path) const {
  const bool ahead = to > from;
  std::vector<double> places = {from};
  for (const TrackArc& arc : arcs_) {
    constexpr double kSame = 1e-9;  // [m]
    if (arc.start > std::min(from, to) + kSame && arc.start < std::max(from, to) - kSame)
      places.push_back(arc.start);
  }
  if (!ahead) std::reverse(places.begin() + 1, places.end());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double next = i + 1 < places.size() ? places[i + 1] : to;
    const double middle = 0.5 * (places[i] + next);
    std::size_t k = 0;
    while (k + 1 < arcs_.size() && middle > arcs_[k].start + arcs_[k].length) ++k;
    const double turn = -rise_ * arcs_[k].curvature * (next - places[i]);
    path.vertices.push_back({at(places[i], y), std::fabs(turn) < 1e-12 ? 0.0 : math::tan(0.25 * turn)});
  }
}

double StripFlat::finished_length(double from, double to, double y) const {
  double sum = 0.0;
  for (const TrackArc& arc : arcs_) {
    const double low = std::max(std::min(from, to), arc.start);
    const double high = std::min(std::max(from, to), arc.start + arc.length);
    if (high > low) sum += (high - low) * (1.0 - arc.curvature * height(y));
  }
  return sum;
}

namespace {

/// An edge of a sheet from its upstream end on, its corners (x along the path, y).
std::vector<Vec2> edge_line(const SheetCut& cut, const CornerEdge& edge) {
  const double whole = cut.span.to - cut.span.from;
  const auto x = [&](double s) { return s - cut.span.from; };
  const double y = edge.plain.at;
  std::vector<Vec2> line = {{0.0, y}};
  if (edge.meeting == Meeting::butts) {
    for (const Span& tab : cut.tabs)
      line.insert(line.end(),
                  {{x(tab.from), y}, {x(tab.from), edge.out.at}, {x(tab.to), edge.out.at}, {x(tab.to), y}});
  } else if (edge.meeting == Meeting::passes && cut.laps.to > cut.laps.from) {
    const double out = edge.out.at;
    const double from = x(cut.laps.from);
    const double to = x(cut.laps.to);
    if (from > 0.0)
      line.insert(line.end(), {{from, y}, {from, out}});
    else
      line = {{0.0, out}};
    if (to < whole) {
      line.insert(line.end(), {{to, out}, {to, y}});
    } else {
      line.push_back({whole, out});
      return line;
    }
  }
  line.push_back({whole, y});
  return line;
}

PlaneRegion sheet_region(const SheetCut& cut) {
  PlaneRegion region;
  region.outline.closed = true;
  const bool up = cut.edges.to.plain.at > cut.edges.from.plain.at;
  const std::vector<Vec2> low = edge_line(cut, up ? cut.edges.from : cut.edges.to);
  const std::vector<Vec2> high = edge_line(cut, up ? cut.edges.to : cut.edges.from);
  for (const Vec2 corner : low) region.outline.vertices.push_back({corner, 0.0});
  for (auto corner = high.rbegin(); corner != high.rend(); ++corner)
    region.outline.vertices.push_back({*corner, 0.0});
  for (const CornerEdge* const edge : {&cut.edges.from, &cut.edges.to}) {
    if (edge->meeting != Meeting::passes) continue;
    for (const Span& tab : cut.tabs) {
      const auto [below, above] = std::minmax(edge->slot_near.at, edge->slot_far.at);
      region.cutouts.push_back(rectangle({tab.from - cut.slack - cut.span.from, below},
                                         {tab.to + cut.slack - cut.span.from, above}));
    }
  }
  for (const SheetOpening& opening : cut.openings)
    region.cutouts.push_back(rectangle({opening.along.from - cut.span.from, opening.across.from},
                                       {opening.along.to - cut.span.from, opening.across.to}));
  for (const Circle& hole : cut.holes)
    region.holes.push_back({hole.centre - Vec2{cut.span.from, 0.0}, hole.radius});
  return region;
}

std::vector<Bevel> bevels_of(const SheetCut& cut) {
  std::vector<Bevel> all;
  for (const CornerEdge* const edge : {&cut.edges.from, &cut.edges.to}) {
    all.push_back(edge->plain);
    const bool laps = edge->meeting == Meeting::passes && cut.laps.to > cut.laps.from;
    if (laps || (edge->meeting == Meeting::butts && !cut.tabs.empty())) all.push_back(edge->out);
    if (edge->meeting != Meeting::passes || cut.tabs.empty()) continue;
    all.push_back(edge->slot_near);
    all.push_back(edge->slot_far);
  }
  for (const SheetOpening& opening : cut.openings) {
    all.push_back({opening.across.from, 0.0});
    all.push_back({opening.across.to, 0.0});
  }
  std::sort(all.begin(), all.end(), [](const Bevel& a, const Bevel& b) { return a.at < b.at; });
  all.erase(std::unique(all.begin(), all.end(), [](const Bevel& a, const Bevel& b) { return a.at == b.at; }),
            all.end());
  return all;
}

/// A loop of the finished sheet as it is in the middle of its thickness, on the flat.
ArcPath flat_loop(const StripFlat& flat, const RolledSheet& sheet, const Span& span, const ArcPath& loop,
                  double& edge_mismatch) {
  ArcPath path;
  path.closed = true;
  const std::vector<PathPiece> pieces = pieces_of(loop);
  for (const PathPiece& piece : pieces) {
    const double y = piece.from.y + 0.5 * bevel_at(sheet, piece.from.y);
    const double from = span.from + piece.from.x;
    if (piece.from.y != piece.to.y) {
      path.vertices.push_back({flat.at(from, y), 0.0});
      continue;
    }
    const double to = span.from + piece.to.x;
    const std::size_t first = path.vertices.size();
    flat.append_edge(from, to, y, path);
    double developed = 0.0;
    for (std::size_t i = first; i < path.vertices.size(); ++i) {
      const Vec2 end = i + 1 < path.vertices.size() ? path.vertices[i + 1].at : flat.at(to, y);
      developed += length(PathPiece{path.vertices[i].at, end, path.vertices[i].bulge});
    }
    edge_mismatch = std::max(edge_mismatch, std::fabs(developed - flat.finished_length(from, to, y)));
  }
  return path;
}

}  // namespace

ShopPart sheet_part(const StripJob& job, const SheetCut& cut, const std::vector<double>& radii,
                    double& edge_mismatch) {
  const SectionPlate& plate = *cut.plate;
  const Vec2 way = plate.way();
  const double middle = 0.5 * (plate.face_from.x + plate.face_to.x);
  RolledSheet sheet;
  sheet.path = *offset_line(job.track, cut.span, 0.0);
  const Vec2 origin = sheet.path.vertices.front().at;
  for (PathVertex& vertex : sheet.path.vertices) vertex.at = vertex.at - origin;
  sheet.thickness = cut.thickness;
  sheet.region = sheet_region(cut);
  sheet.foot = {plate.face_from.y, middle - plate.face_from.x};
  sheet.across = {way.y, -way.x};
  sheet.bevels = bevels_of(cut);

  const StripFlat flat(job, plate, cut.span);
  FlatPattern pattern;
  pattern.region.outline = flat_loop(flat, sheet, cut.span, sheet.region.outline, edge_mismatch);
  for (const ArcPath& cutout : sheet.region.cutouts)
    pattern.region.cutouts.push_back(flat_loop(flat, sheet, cut.span, cutout, edge_mismatch));
  for (const Circle& hole : cut.holes)
    pattern.region.holes.push_back({flat.at(hole.centre.x, hole.centre.y), hole.radius});
  const auto [low, high] = std::minmax(cut.edges.from.plain.at, cut.edges.to.plain.at);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (i > 0 && radii[i] == radii[i - 1]) continue;
    const double s = flat.arcs()[i].start;
    pattern.rolls.push_back({flat.at(s, high), flat.at(s, low), radii[i]});
  }
  const PlaneMotion motion = into(own_plane(pattern.region.outline));
  pattern.region = moved(pattern.region, motion);
  for (RollLine& roll : pattern.rolls) {
    roll.from = motion(roll.from);
    roll.to = motion(roll.to);
  }
  set_number_place(pattern, bounds(pattern.region.outline));

  ShopPart part;
  part.name = plate.name;
  part.material = cut.material.name;
  part.density = cut.material.density;
  part.thickness = cut.thickness;
  part.body = std::move(sheet);
  part.places = {plane_of_track(job.placement, origin, 0.0, -middle)};
  part.pattern = std::move(pattern);
  weigh(part);
  return part;
}

SheetCut plain_cut(const SectionPlate& plate, double thickness, const Span& span,
                   const StockMaterial& material) {
  const Vec2 way = plate.way();
  SheetCut cut;
  cut.plate = &plate;
  cut.thickness = thickness;
  cut.material = material;
  cut.edges.from.plain = {0.0, dot(plate.back_from - plate.face_from, way)};
  cut.edges.to.plain = {norm(plate.face_to - plate.face_from), dot(plate.back_to - plate.face_to, way)};
  cut.span = span;
  return cut;
}

Vec2 stretch_moments(const SectionPlate& plate, double thickness, const Bevel& from, const Bevel& to) {
  const Vec2 way = plate.way();
  const Vec2 back = thickness * Vec2{-way.y, way.x};
  const std::array<Vec2, 4> corners = {plate.face_from + from.at * way, plate.face_from + to.at * way,
                                       plate.face_from + (to.at + to.below) * way + back,
                                       plate.face_from + (from.at + from.below) * way + back};
  Vec2 sum;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i];
    const Vec2 b = corners[(i + 1) % corners.size()];
    sum = sum + Vec2{0.5 * cross(a, b), cross(a, b) * (a.y + b.y) / 6.0};
  }
  return sum.x < 0.0 ? -1.0 * sum : sum;
}

}  // namespace glissade::parts
