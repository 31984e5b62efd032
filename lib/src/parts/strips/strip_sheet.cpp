#include "parts/strips/strip_sheet.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/body_places.hpp"
#include "parts/curves/offset_line.hpp"
#include "parts/plates/plate_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace glissade::parts {
namespace {

using Meeting = CornerEdge::Meeting;

double sine_over(double half) {
  return std::fabs(half) < 1e-9 ? 1.0 : math::sin(half) / half;
}

}  // namespace

StripFlat::StripFlat(const StripJob& job, const SectionPlate& plate, const Span& span, double thickness)
    : bent_(job.bent()) {
  const Vec2 way = plate.way();
  rise_ = way.y;
  const Vec2 back{-way.y, way.x};
  foot_ = plate.face_from.y + 0.5 * dot(back, plate.back_from - plate.face_from) * back.y;
  for (const StripArc& one : job.arcs_in(span)) {
    arcs_.push_back(one.arc);
    mitres_.push_back(one.mitre_from);
  }
  mitres_.push_back(job.arcs_in(span).back().mitre_to);
  if (bent_) {
    fold(job, plate, thickness);
    return;
  }
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

void StripFlat::fold(const StripJob& job, const SectionPlate& plate, double thickness) {
  const Vec2 way = plate.way();
  bends_.resize(arcs_.size());
  double tightest = std::numeric_limits<double>::infinity();
  const auto run = [&](std::size_t i) {
    return arcs_[i].length - plate.middle_to().y * (mitres_[i] + mitres_[i + 1]);
  };
  for (std::size_t i = 1; i < arcs_.size(); ++i) {
    // A leaning side is bent by what its lean leaves of the line's bend.
    const double sine = std::fabs(way.x) * mitres_[i] / math::hypot(1.0, mitres_[i]);
    bends_[i].angle = (way.x > 0.0 ? -2.0 : 2.0) * math::asin(sine);
    if (bends_[i].angle != 0.0)
      tightest = std::min(tightest, 0.5 * (run(i) + run(i - 1)) / std::fabs(bends_[i].angle));
  }
  for (FlatBend& bend : bends_) {
    if (springs(plate, tightest, thickness) || std::fabs(bend.angle) <= kNoBend) continue;
    bend.pressed = true;
    bend.cut = bend_cut(job, thickness, std::fabs(bend.angle));
  }
  Vec2 at;
  double heading = 0.0;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    if (i > 0) {
      // Both flats share the line of their bend; it turns the lines along the plate.
      const double slant = rise_ * mitres_[i];
      const auto [sine, cosine] = math::sine_cosine(heading);
      const Vec2 along{cosine, sine};
      const Vec2 square = (1.0 / math::hypot(1.0, slant)) * (along - slant * Vec2{-sine, cosine});
      const Vec2 corner = at + (arcs_[i - 1].length - foot_ * mitres_[i]) * along - bends_[i].cut * square;
      heading -= 2.0 * math::atan(slant);
      const auto [next_sine, next_cosine] = math::sine_cosine(heading);
      at = corner - foot_ * mitres_[i] * Vec2{next_cosine, next_sine};
    }
    starts_.push_back(at);
    headings_.push_back(heading);
  }
}

Span StripFlat::reach(std::size_t i, double y) const {
  const auto taken = [&](std::size_t k) {
    const double cut = k < bends_.size() ? bends_[k].cut : 0.0;
    return height(y) * mitres_[k] + 0.5 * cut * math::hypot(1.0, rise_ * mitres_[k]);
  };
  return {taken(i), arcs_[i].length - taken(i + 1)};
}

Vec2 StripFlat::on_flat(std::size_t i, double along, double y) const {
  const auto [sine, cosine] = math::sine_cosine(headings_[i]);
  return starts_[i] + along * Vec2{cosine, sine} - y * Vec2{-sine, cosine};
}

Vec2 StripFlat::at_bends(double s, double y) const {
  constexpr double kOnBend = 1e-9;  // [m]
  std::size_t i = 0;
  while (i + 1 < arcs_.size() && s > arcs_[i].start + arcs_[i].length + kOnBend) ++i;
  const double along = s - arcs_[i].start;
  // Ends of the plate lean as their planes do.
  if (along < kOnBend) return on_flat(i, reach(i, y).from, y);
  if (along > arcs_[i].length - kOnBend) return on_flat(i, reach(i, y).to, y);
  return on_flat(i, along, y);
}

Vec2 StripFlat::at(double s, double y) const {
  if (bent_) return at_bends(s, y);
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
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const TrackArc& arc = arcs_[i];
    const double low = std::max(std::min(from, to), arc.start);
    const double high = std::min(std::max(from, to), arc.start + arc.length);
    if (bent_) {
      constexpr double kOnBend = 1e-9;  // [m]
      if (!(high - low > kOnBend)) continue;
      const Span whole = reach(i, y);
      sum += (high > arc.start + arc.length - kOnBend ? whole.to : high - arc.start) -
             (low < arc.start + kOnBend ? whole.from : low - arc.start);
      continue;
    }
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

/// The line of flats within a span, and how the planes of its ends lean.
ArcPath path_of_flats(const StripJob& job, const Span& span, std::array<double, 2>& tilts) {
  ArcPath path;
  const std::vector<StripArc> flats = job.arcs_in(span);
  for (const StripArc& flat : flats) path.vertices.push_back({frame_at(job.track, flat.arc.start).at, 0.0});
  path.vertices.push_back({frame_at(job.track, span.to).at, 0.0});
  tilts = {flats.front().mitre_from, flats.back().mitre_to};
  return path;
}

/// Stretches of a sheet across a place along its path, ascending.
std::vector<Span> across_at(const PlaneRegion& region, double x) {
  std::vector<double> edges;
  const auto see = [&](const ArcPath& loop) {
    for (const PathPiece& edge : pieces_of(loop)) {
      if (std::min(edge.from.x, edge.to.x) < x && x < std::max(edge.from.x, edge.to.x))
        edges.push_back(edge.from.y);
    }
  };
  see(region.outline);
  for (const ArcPath& cutout : region.cutouts) see(cutout);
  std::sort(edges.begin(), edges.end());
  std::vector<Span> stretches;
  for (std::size_t k = 0; k + 1 < edges.size(); k += 2) stretches.push_back({edges[k], edges[k + 1]});
  return stretches;
}

/// The lines of bends on the pattern, parted where the sheet is.
void add_bends(const StripJob& job, const StripFlat& flat, const RolledSheet& sheet, const SheetCut& cut,
               FlatPattern& pattern) {
  for (std::size_t i = 1; i < flat.bends().size(); ++i) {
    const FlatBend& bend = flat.bends()[i];
    if (!bend.pressed) continue;
    const double s = flat.arcs()[i].start;
    const auto on_pattern = [&](double y) { return flat.at(s, y + 0.5 * bevel_at(sheet, y)); };
    for (const Span& stretch : across_at(sheet.region, s - cut.span.from)) {
      pattern.bends.push_back({on_pattern(stretch.to), on_pattern(stretch.from),
                               Angle::from_radians(std::fabs(bend.angle)),
                               inner_radius_of(job, cut.thickness), bend.angle > 0.0});
    }
  }
}

}  // namespace

ShopPart sheet_part(const StripJob& job, const SheetCut& cut, const std::vector<double>& radii,
                    double& edge_mismatch) {
  const SectionPlate& plate = *cut.plate;
  const Vec2 way = plate.way();
  const double middle = 0.5 * (plate.face_from.x + plate.face_to.x);
  RolledSheet sheet;
  sheet.path =
      job.bent() ? path_of_flats(job, cut.span, sheet.tilts) : *offset_line(job.track, cut.span, 0.0);
  const Vec2 origin = sheet.path.vertices.front().at;
  for (PathVertex& vertex : sheet.path.vertices) vertex.at = vertex.at - origin;
  sheet.thickness = cut.thickness;
  sheet.region = sheet_region(cut);
  sheet.foot = {plate.face_from.y, middle - plate.face_from.x};
  sheet.across = {way.y, -way.x};
  sheet.bevels = bevels_of(cut);

  const StripFlat flat(job, plate, cut.span, cut.thickness);
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
  add_bends(job, flat, sheet, cut, pattern);
  const PlaneMotion motion = into(own_plane(pattern.region.outline));
  pattern.region = moved(pattern.region, motion);
  for (RollLine& roll : pattern.rolls) {
    roll.from = motion(roll.from);
    roll.to = motion(roll.to);
  }
  for (BendLine& bend : pattern.bends) {
    bend.from = motion(bend.from);
    bend.to = motion(bend.to);
  }

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
