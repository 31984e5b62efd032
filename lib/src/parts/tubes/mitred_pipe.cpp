#include "parts/tubes/mitred_pipe.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/as_built.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/clash.hpp"
#include "parts/plates/angle_frames.hpp"
#include "parts/plates/bar_pieces.hpp"
#include "parts/plates/fittings.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/frame_pieces.hpp"
#include "parts/plates/plate_facts.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/bolted.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/setting_out.hpp"
#include "parts/shop/shop_facts.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/strips/joint_steps.hpp"
#include "parts/strips/strip_shell.hpp"
#include "parts/supports/supports.hpp"
#include "parts/tubes/trough_tops.hpp"
#include "parts/tubes/tube_openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Angle kHalfTurn = Angle::from_radians(kPi);
constexpr Angle kWholeTurn = Angle::from_radians(2.0 * kPi);
constexpr double kLeastCrown = 15e-3;       // length of a tube where it is shortest: room for two welds [m]
constexpr double kSeam = 20.0 * kPi / 180;  // of a seam from the crown, to either side in turn

/// One tube, in the plane of the track.
struct Gore {
  Vec2 from;  ///< of its axis
  Vec2 along;
  TubeGore body;
  double floor_length = 0.0;  ///< of its lowest line [m]
  double begins = 0.0;        ///< of its axis, along all flats [m]
  bool odd = false;           ///< its seam lies on the other side
};

/// Tubes of a transport unit.
struct GoreUnit {
  std::vector<Gore> gores;
};

Vec2 up_of(Vec2 along) {
  return {-along.y, along.x};
}

/// Everything that the tubes of one pipe are made from, or the troughs of half a one.
struct PipeJob {
  const ArcSpline& track;
  const section::Pipe& pipe;
  std::optional<double> side;  ///< of half a pipe: height of its upright sides above the axis [m]
  const PlateOptions& options;
  const Placement& placement;

  /// Above the floor line.
  [[nodiscard]] double top() const { return side ? radius() + *side : pipe.inner_diameter + pipe.thickness; }
  [[nodiscard]] const char* word() const { return side ? "trough" : "tube"; }

  [[nodiscard]] double radius() const { return 0.5 * pipe.inner_diameter; }
  [[nodiscard]] double mean_radius() const { return radius() + 0.5 * pipe.thickness; }
  [[nodiscard]] double least_crown() const {
    return std::max(kLeastCrown, options.flanges.wanted ? options.flanges.along() + 9e-3 : 0.0);
  }
};

double tilt_before(const Facets& facets, std::size_t flat) {
  return flat == 0 ? 0.0 : 0.5 * facets.kinks[flat - 1];
}

double tilt_after(const Facets& facets, std::size_t flat) {
  return flat + 1 == facets.corners.size() - 1 ? 0.0 : 0.5 * facets.kinks[flat];
}

/// Length of a tube's line at a height above the floor line.
double length_at(const Facets& facets, std::size_t flat, double height) {
  const double whole = norm(facets.corners[flat + 1] - facets.corners[flat]);
  return whole - height * (math::tan(tilt_before(facets, flat)) + math::tan(tilt_after(facets, flat)));
}

double shortest_line(const PipeJob& job, const Facets& facets, std::size_t flat) {
  return std::min(length_at(facets, flat, job.top()), length_at(facets, flat, -job.pipe.thickness));
}

/// Flats whose tubes are nowhere shorter than they may be: those of the rule, fewer where the track turns too fast for them.
Facets flats_of(const PipeJob& job, double largest_kink) {
  const Span whole{0.0, job.track.length()};
  double least = 0.0;
  for (int round = 0; round < 80; ++round) {
    Facets facets = facets_by_rule(job.track, whole, job.options.bend, largest_kink, least);
    const auto is_short = [&](std::size_t flat) {
      return shortest_line(job, facets, flat) < job.least_crown();
    };
    std::size_t flat = 0;
    while (flat + 1 < facets.corners.size() && !is_short(flat)) ++flat;
    if (flat + 1 == facets.corners.size()) return facets;
    if (facets.bends() == 0) break;
    least = std::max(1.15 * least, 0.5 * job.least_crown());
  }
  const std::string key = job.side ? "width" : "inner_diameter";
  const std::string words = std::string(job.word()) + "s";
  throw InputError({"cross_section." + key,
                    key + ": " + length_text(job.pipe.inner_diameter) + " is too large for mitred " + words,
                    "Where this track turns fastest, " + words + " would be shorter than " +
                        length_text(job.least_crown()) + (job.side ? " at the rim." : " at the crown."),
                    "a smallest_radius limit of the track above " +
                        length_text(2.0 * job.pipe.inner_diameter, 2) +
                        ", a smaller pipe, or round: staves"});
}

/// A stretch of a flat; an end that is none of the flat is square, and so are those of the track.
struct Stretch {
  std::size_t flat = 0;
  std::optional<double> from;  ///< along the flat; none: its mitre [m]
  std::optional<double> to;
};

/// Distance along the flats to each corner.
std::vector<double> reached(const Facets& facets) {
  std::vector<double> sums = {0.0};
  for (std::size_t i = 0; i + 1 < facets.corners.size(); ++i) {
    sums.push_back(sums.back() + norm(facets.corners[i + 1] - facets.corners[i]));
  }
  return sums;
}

Gore gore_of(const PipeJob& job, const Facets& facets, const Stretch& stretch) {
  const std::size_t flat = stretch.flat;
  const Vec2 along = facets.corners[flat + 1] - facets.corners[flat];
  const double whole = norm(along);
  const Vec2 unit = (1.0 / whole) * along;
  const double radius = job.radius();
  const double before = stretch.from ? 0.0 : tilt_before(facets, flat);
  const double after = stretch.to ? 0.0 : tilt_after(facets, flat);
  const double start = stretch.from.value_or(0.0) + radius * math::tan(before);
  const double end = stretch.to.value_or(whole) - radius * math::tan(after);
  Gore gore;
  gore.from = facets.corners[flat] + start * unit + radius * up_of(unit);
  gore.along = unit;
  gore.body = {radius, job.pipe.thickness, end - start, Angle::from_radians(before),
               Angle::from_radians(-after)};
  gore.floor_length = stretch.to.value_or(whole) - stretch.from.value_or(0.0);
  gore.begins = reached(facets)[flat] + start;
  return gore;
}

/// Joints stand square in a tube, far enough from its mitres for the flange: the nearest such places to even ones.
std::vector<double> joints_along(const PipeJob& job, const Facets& facets, std::size_t count) {
  const std::vector<double> corners = reached(facets);
  const double high = job.top();
  std::vector<double> joints = {0.0};
  for (std::size_t k = 1; k < count; ++k) {
    const double about = corners.back() * static_cast<double>(k) / static_cast<double>(count);
    double best = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const auto room = [&](double tilt) {
        return std::max(high * math::tan(tilt), -job.pipe.thickness * math::tan(tilt)) + job.least_crown();
      };
      // Units have room for the rings at both of their ends.
      const double unit = 2.0 * job.least_crown();
      const double low = std::max(corners[i] + room(tilt_before(facets, i)), joints.back() + unit);
      const double top = std::min(corners[i + 1] - room(tilt_after(facets, i)), corners.back() - unit);
      if (!(top > low)) continue;
      const double place = std::clamp(about, low, top);
      if (!(std::fabs(place - about) >= std::fabs(best - about))) best = place;
    }
    if (best > joints.back()) joints.push_back(best);
  }
  joints.push_back(corners.back());
  return joints;
}

std::vector<GoreUnit> units_between(const PipeJob& job, const Facets& facets,
                                    const std::vector<double>& joints) {
  const std::vector<double> corners = reached(facets);
  std::vector<GoreUnit> units;
  bool odd = false;
  for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
    GoreUnit unit;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const double from = std::max(joints[j], corners[i]);
      const double to = std::min(joints[j + 1], corners[i + 1]);
      if (!(to - from > 1e-9)) continue;
      Stretch stretch{i, {}, {}};
      if (joints[j] > corners[i]) stretch.from = joints[j] - corners[i];
      if (joints[j + 1] < corners[i + 1]) stretch.to = joints[j + 1] - corners[i];
      unit.gores.push_back(gore_of(job, facets, stretch));
      unit.gores.back().odd = odd;
      odd = !odd;
    }
    units.push_back(std::move(unit));
  }
  return units;
}

// --- patterns

/// A sine line over the unrolled circumference.
struct SineLine {
  double amplitude = 0.0;  ///< [m]
  double radius = 0.0;     ///< mean of the tube [m]
  double phase = 0.0;      ///< angle from the crown where it begins [rad]
  double level = 0.0;      ///< [m]

  [[nodiscard]] Vec2 at(double angle) const {
    return {radius * angle, level + amplitude * math::cos(phase - angle)};
  }
  /// Unit tangent.
  [[nodiscard]] Vec2 along(double angle) const {
    const double slope = amplitude / radius * math::sin(phase - angle);
    const double stretch = math::hypot(1.0, slope);
    return {1.0 / stretch, slope / stretch};
  }
};

/// Two arcs with a common tangent between two places, of equal tangent lengths.
void add_biarc(std::vector<PathVertex>& vertices, Vec2 from, Vec2 from_along, Vec2 to, Vec2 to_along) {
  const Vec2 chord = to - from;
  const Vec2 sum = from_along + to_along;
  const double a = 2.0 * (1.0 - dot(from_along, to_along));
  const double b = 2.0 * dot(chord, sum);
  const double c = -dot(chord, chord);
  // a d^2 + b d + c = 0, its positive root without cancellation.
  const double reach = -2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c));
  const Vec2 middle = 0.5 * (from + to + reach * (from_along - to_along));
  const auto bulge = [](Vec2 along, Vec2 way) {
    return math::tan(0.5 * math::atan2(cross(along, way), dot(along, way)));
  };
  const double first = bulge(from_along, middle - from);
  const double second = -bulge(-1.0 * to_along, middle - to);
  vertices.push_back({from, std::fabs(first) < 1e-9 ? 0.0 : first});
  vertices.push_back({middle, std::fabs(second) < 1e-9 ? 0.0 : second});
}

/// @param turn  a whole one, or half a one
/// @return arcs within kSineTolerance of a turn of the line, from left to right, its last point included
ArcPath arcs_of(const SineLine& line, double turn = 2.0 * kPi) {
  ArcPath path;
  if (line.amplitude == 0.0) {
    path.vertices = {{line.at(0.0), 0.0}, {line.at(turn), 0.0}};
    return path;
  }
  // Places every 20 deg or a part of it: seams lie at one, and edges that meet are the same arcs in another order.
  const int least = static_cast<int>(std::nearbyint(turn / kPi)) * 9;
  for (int pieces = least; pieces <= 20 * least; pieces += least) {
    path.vertices.clear();
    for (int k = 0; k < pieces; ++k) {
      const double a = turn * k / pieces;
      const double b = turn * (k + 1) / pieces;
      add_biarc(path.vertices, line.at(a), line.along(a), line.at(b), line.along(b));
    }
    path.vertices.push_back({line.at(turn), 0.0});
    double worst = 0.0;
    for (const PathPiece& piece : pieces_of(path)) {
      for (const double share : {0.25, 0.5, 0.75}) {
        const Vec2 point = point_on(piece, share);
        const Vec2 there = line.at(point.x / line.radius);
        worst = std::max(worst, std::fabs(there.y - point.y));
      }
    }
    if (worst <= kSineTolerance) return path;
  }
  throw InternalError({"", "the edge of a tube does not become arcs", "", ""});
}

/// An edge of a trough on the flat, from its left rim to the right one: x of the finished edge times the slope of its plane.
ArcPath trough_edge(const PipeJob& job, Angle tilt, double level) {
  const double mean = job.mean_radius();
  const double slope = math::tan(tilt.radians());
  // Angles count from where the round begins on the left: x = -mean sin(angle).
  ArcPath path = arcs_of({mean * slope, mean, -0.5 * kPi, level}, kPi);
  const double side = *job.side;
  for (PathVertex& vertex : path.vertices) vertex.at.x += side;
  if (side == 0.0) return path;
  path.vertices.insert(path.vertices.begin(), {{0.0, level + slope * side}, 0.0});
  path.vertices.push_back({{2.0 * side + kPi * mean, level + slope * side}, 0.0});
  return path;
}

/// Seen from inside, the seam at the left and right edges; of a trough the rims.
FlatPattern pattern_of(const PipeJob& job, const Gore& gore) {
  const double mean = job.mean_radius();
  const double phase = gore.odd ? -kSeam : kSeam;
  const ArcPath low = job.side
                          ? trough_edge(job, gore.body.start_tilt, 0.0)
                          : arcs_of({mean * math::tan(gore.body.start_tilt.radians()), mean, phase, 0.0});
  const ArcPath high =
      job.side ? trough_edge(job, gore.body.end_tilt, gore.body.length)
               : arcs_of({mean * math::tan(gore.body.end_tilt.radians()), mean, phase, gore.body.length});
  FlatPattern pattern;
  pattern.region.outline = low;
  for (const PathVertex& vertex : reversed(high).vertices) pattern.region.outline.vertices.push_back(vertex);
  pattern.region.outline.closed = true;
  pattern.region.outline.vertices.back().bulge = 0.0;
  pattern.region.outline.vertices[low.vertices.size() - 1].bulge = 0.0;
  // Seen from inside, angles about the axis run to the left; of a trough from where its round begins.
  const double first = job.side ? *job.side / mean - 0.5 * kPi : phase;
  for (const TubeWindow& window : gore.body.windows) {
    pattern.region.cutouts.push_back(rectangle({mean * (first - window.high.radians()), window.from},
                                               {mean * (first - window.low.radians()), window.to}));
  }
  for (const TubeHole& hole : gore.body.holes)
    pattern.region.holes.push_back({{mean * (first - hole.about.radians()), hole.along}, hole.radius});
  const PlaneBox box = bounds(pattern.region.outline);
  pattern.region = moved(pattern.region, PlaneMotion::turn(0.0, -1.0 * box.low));
  return pattern;
}

ShopPart part_of(const PipeJob& job, const Gore& gore) {
  ShopPart part;
  part.name = job.word();
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = job.pipe.thickness;
  if (job.side) {
    part.body = TroughGore{gore.body.inner_radius, gore.body.thickness, *job.side,         gore.body.length,
                           gore.body.start_tilt,   gore.body.end_tilt,  gore.body.windows, gore.body.holes};
  } else {
    part.body = gore.body;
  }
  const Vec3 up = direction_in_space(job.placement, up_of(gore.along));
  const Vec3 axis = direction_in_space(job.placement, gore.along);
  part.places = {{in_space(job.placement, gore.from), up, -1.0 * across(job.placement), axis}};
  weigh(part);
  part.pattern = pattern_of(job, gore);
  return part;
}

/// A closed figure round half a pipe, up to its rims, between two distances from the axis and from the plane of the track.
ArcPath half_round(double inner, double outer, double side) {
  ArcPath path{{{{-outer, 0.0}, 1.0}, {{outer, 0.0}, 0.0}}, true};
  if (side > 0.0) {
    path.vertices.push_back({{outer, side}, 0.0});
    path.vertices.push_back({{inner, side}, 0.0});
  }
  path.vertices.push_back({{inner, 0.0}, -1.0});
  path.vertices.push_back({{-inner, 0.0}, 0.0});
  if (side > 0.0) {
    path.vertices.push_back({{-inner, side}, 0.0});
    path.vertices.push_back({{-outer, side}, 0.0});
  }
  return path;
}

/// How far along the line of bolts, from its end, the uppermost one stands.
double half_round_edge(const PipeJob& job, const FlangeOptions& flange, double pitch_radius) {
  const double rim = bolts_below_rim(job.options);
  const double below = std::max(below_top(flange), rim);
  const double turned = below - *job.side;
  // Slots are upright and rims level, so that below the sides depth counts and not the way round.
  if (!(flange.slotted || below == rim) || !(turned > 0.0)) return below;
  return *job.side + pitch_radius * math::asin(std::min(1.0, turned / pitch_radius));
}

/// Bolts round half a pipe, evenly from below one rim to below the other.
std::vector<Vec2> round_half(const PipeJob& job, const FlangeOptions& flange, double pitch_radius) {
  const double edge = half_round_edge(job, flange, pitch_radius);
  const double whole = 2.0 * *job.side + kPi * pitch_radius;
  const double room = whole - 2.0 * edge;
  const double gaps = std::max(2.0, std::ceil(room / flange.pitch - 1e-9));
  std::vector<Vec2> middles;
  for (double k = 0.0; k <= gaps; k += 1.0) {
    const double along = edge + room * k / gaps - *job.side;  // from where the round begins on the left
    Vec2 at{pitch_radius, -along};
    if (along > kPi * pitch_radius) {
      at = {-pitch_radius, along - kPi * pitch_radius};
    } else if (along > 0.0) {
      const auto [sine, cosine] = math::sine_cosine(along / pitch_radius);
      at = {pitch_radius * cosine, -pitch_radius * sine};
    }
    middles.push_back(at);
  }
  return middles;
}

/// Bolts round a whole pipe: an even number, none in the plane of the track.
std::vector<Vec2> round_whole(double pitch_radius, double pitch) {
  const double count = 2.0 * std::max(2.0, std::ceil(kPi * pitch_radius / pitch - 1e-9));
  std::vector<Vec2> middles;
  for (double k = 0.5; k < count; k += 1.0) {
    const auto [sine, cosine] = math::sine_cosine(2.0 * kPi * k / count);
    middles.push_back({pitch_radius * sine, pitch_radius * cosine});
  }
  return middles;
}

/// Of a ring's bolts.
std::vector<Vec2> ring_bolts(const PipeJob& job, const FlangeOptions& with, double pitch_radius) {
  return job.side ? round_half(job, with, pitch_radius) : round_whole(pitch_radius, with.pitch);
}

/// The line round the end of a unit, from the left rim below it to the right one or all round, what is outside on its left.
ArcPath line_round(const PipeJob& job, double radius) {
  if (!job.side) return reversed(path_of(Circle{{}, radius}));
  ArcPath line;
  if (*job.side > 0.0) line.vertices.push_back({{radius, *job.side}, 0.0});
  line.vertices.push_back({{radius, 0.0}, -1.0});
  line.vertices.push_back({{-radius, 0.0}, 0.0});
  if (*job.side > 0.0) line.vertices.push_back({{-radius, *job.side}, 0.0});
  return line;
}

/// A ring rolled from an angle. Its other leg stands along the tubes, downstream of its plane as it is drawn.
ShopPart angle_ring(const PipeJob& job, FlangeSide of_joint) {
  const FlangeOptions& flange = job.options.flanges;
  const double inner = job.radius() + job.pipe.thickness + flange.gap;
  PlaneRegion drilled;
  drill_frame(
      job.options, of_joint,
      [&](const FlangeOptions& with) { return ring_bolts(job, with, inner + bolt_line(flange)); }, drilled);
  AngleBar bar = rolled_angle(line_round(job, inner), flange);
  bar.holes = drilled.holes;
  bar.slots = drilled.cutouts;
  return angle_part(job.options, frame_name(job.side ? "trough_flange" : "pipe_flange", flange, of_joint),
                    std::move(bar));
}

/// A ring round the end of a unit; of half a pipe, up to its rims.
/// @param of_joint  the side on which it lies
ShopPart ring_of(const PipeJob& job, FlangeSide of_joint) {
  const FlangeOptions& flange = job.options.flanges;
  if (flange.section == FlangeSection::angle) return angle_ring(job, of_joint);
  const double inner = job.radius() + job.pipe.thickness + flange.gap;
  const double pitch_radius = inner + 0.5 * flange.width;
  ShopPart part;
  part.name = frame_name(job.side ? "trough_flange" : "pipe_flange", flange, of_joint);
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = flange.thickness;
  FlatPattern pattern;
  if (job.side) {
    pattern.region.outline = half_round(inner, inner + flange.width, *job.side);
  } else {
    pattern.region.outline = path_of(Circle{{}, inner + flange.width});
    pattern.region.cutouts = {path_of(Circle{{}, inner})};
  }
  drill_frame(
      job.options, of_joint, [&](const FlangeOptions& with) { return ring_bolts(job, with, pitch_radius); },
      pattern.region);
  part.body = Prism{pattern.region, flange.thickness};
  part.pattern = std::move(pattern);
  return part;
}

/// @param shift  of the ring's first face along the axis [m]
Frame ring_place(const PipeJob& job, const Gore& gore, double at, double shift) {
  const Vec2 middle = gore.from + (at + shift) * gore.along;
  return {in_space(job.placement, middle), across(job.placement),
          direction_in_space(job.placement, up_of(gore.along)),
          direction_in_space(job.placement, gore.along)};
}

/// The row of the schedule that makes a ring, or a piece of one, of a straight angle: over the length at its centroid.
void add_rolling(const AngleBar& bar, int number, Workshop& workshop) {
  double straight = 0.0;
  double turn = 0.0;
  double inner = 0.0;
  for (const PathPiece& piece : pieces_of(bar.heel)) {
    if (piece.straight()) {
      if (turn == 0.0) straight += length(piece);
      continue;
    }
    const CircularArc arc = arc_of(piece);
    turn += std::fabs(arc.sweep);
    inner = arc.radius;
  }
  if (turn == 0.0) return;
  const Angle angle = Angle::from_radians(turn);
  const double rolled = turn * (inner + angle_centroid(bar.height, bar.thickness));
  workshop.bends.push_back({number, 1, straight, rolled, angle, angle, inner, 0.0});
}

void note_rings(const PipeJob& job, Workshop& workshop) {
  const FlangeOptions& flange = job.options.flanges;
  const double inner = job.radius() + job.pipe.thickness + flange.gap;
  workshop.notes.push_back("Flanges are angles rolled leg out to " + length_text(2.0 * inner, 5) +
                           " inside, drilled afterwards.");
}

void add_rings(const PipeJob& job, const std::vector<GoreUnit>& units, Workshop& workshop) {
  if (!job.options.flanges.wanted) return;
  const bool angles = job.options.flanges.section == FlangeSection::angle;
  ShopPart before = ring_of(job, FlangeSide::upstream);
  ShopPart after = ring_of(job, FlangeSide::downstream);
  for (const GoreUnit& unit : units) {
    const Gore& last = unit.gores.back();
    after.places.push_back(ring_place(job, unit.gores.front(), 0.0, 0.0));
    before.places.push_back(angles ? turned_about(ring_place(job, last, last.body.length, 0.0))
                                   : ring_place(job, last, last.body.length, -job.options.flanges.thickness));
  }
  const FlangeOptions& flange = job.options.flanges;
  const double inner = job.radius() + job.pipe.thickness + flange.gap;
  const ArcPath line = line_round(job, inner + (angles ? bolt_line(flange) : 0.5 * flange.width));
  // Those that are not slotted are round.
  const std::size_t bolts = std::max(before.pattern->region.holes.size(), after.pattern->region.holes.size());
  for (ShopPart* part : {&before, &after}) {
    weigh(*part);
    measure_bolt_row(bolts_in_order(*part, line), line.closed, workshop);
    if (!angles) {
      add_in_pieces(*part, line, part == &after, job.options, kFrameColour, workshop);
      continue;
    }
    std::vector<ShopPart> pieces = angle_pieces(*part, part == &after, job.options);
    if (pieces.size() > 1) note_bar_pieces(job.options, workshop);
    for (ShopPart& piece : pieces) {
      const std::size_t listed = workshop.parts.size();
      const AngleBar bar = std::get<AngleBar>(piece.body);
      const int number = add_part(workshop, std::move(piece), kFrameColour);
      if (workshop.parts.size() > listed) add_rolling(bar, number, workshop);
    }
  }
  if (angles) note_rings(job, workshop);
  add_joint_bolts(workshop, job.options.flanges, bolts * (units.size() - 1), units.size() - 1);
}

/// Rims along the troughs' tops, and covers on them.
void set_on_tops(const PipeJob& job, const std::vector<GoreUnit>& units, Workshop& workshop) {
  if (!job.side || !job.options.rim) return;
  const double taken = job.options.flanges.wanted ? job.options.flanges.along() + kAsideOfFrame : 0.0;
  std::vector<TroughTop> troughs;
  for (const GoreUnit& unit : units) {
    for (const Gore& gore : unit.gores) {
      troughs.push_back({gore.from, gore.along, gore.body.length, gore.body.start_tilt, gore.body.end_tilt,
                         &gore == &unit.gores.front() ? taken : 0.0,
                         &gore == &unit.gores.back() ? taken : 0.0});
    }
  }
  const TopMeasures tops{job.radius() + job.pipe.thickness, *job.side};
  add_trough_rims(troughs, tops, job.options, job.placement, workshop);
  if (job.options.cover) add_trough_covers(troughs, tops, job.options, job.placement, workshop);
}

// --- openings

/// @throws InputError with all openings that are not on the track
void require_tubes_below(const PipeJob& job) {
  std::vector<Issue> issues;
  for (const InspectionOptions& opening : job.options.inspection) {
    if (opening.at > 0.0 && opening.at < job.track.length()) continue;
    issues.push_back({"inspection",
                      "at: an opening at " + length_text(opening.at, 4) + " is not on the track",
                      "It is " + length_text(job.track.length(), 4) + " long.",
                      "at: " + length_text(0.5 * job.track.length(), 2)});
  }
  if (!issues.empty()) throw InputError(std::move(issues));
}

/// Cuts openings into tubes, whose lids then keep what is set on them away.
std::vector<TubeOpening> cut_openings(const PipeJob& job, const Facets& facets, std::vector<GoreUnit>& units,
                                      std::vector<TubeRoom>& rooms) {
  require_tubes_below(job);
  if (job.options.inspection.empty()) return {};
  const double taken = job.options.flanges.wanted ? job.options.flanges.along() + kAsideOfFrame : 0.0;
  for (GoreUnit& unit : units) {
    for (Gore& gore : unit.gores) {
      const double from = &gore == &unit.gores.front() ? taken : 0.0;
      const double to = gore.body.length - (&gore == &unit.gores.back() ? taken : 0.0);
      rooms.push_back({gore.begins, from, to, &gore.body});
    }
  }
  const auto trough = job.side ? std::optional(TroughSide{*job.side, job.options.rim}) : std::nullopt;
  return cut_tubes(job.options.inspection, rooms, trough, flat_places(job.track, facets), job.options.shop);
}

void add_tube_lids(const PipeJob& job, const std::vector<GoreUnit>& units,
                   const std::vector<TubeOpening>& openings, Workshop& workshop, TakenUp& taken) {
  std::vector<const Gore*> gores;
  for (const GoreUnit& unit : units) {
    for (const Gore& gore : unit.gores) gores.push_back(&gore);
  }
  for (const TubeOpening& opening : openings) {
    const Gore& gore = *gores[opening.tube];
    ShopPart lid = tube_lid(opening, gore.body, job.options.material);
    lid.places = part_of(job, gore).places;
    lid.places.front().origin = lid.places.front().origin + opening.lid.from * lid.places.front().z;
    weigh(lid);
    const Angle turn = Angle::from_radians(opening.lid.high.radians() - opening.lid.low.radians());
    const double length = bounds(lid.pattern->region.outline).width();
    const std::size_t listed = workshop.parts.size();
    const int number = add_part(workshop, std::move(lid), kFittingColour);
    if (workshop.parts.size() > listed) {
      workshop.bends.push_back(
          {number, 1, 0.0, length, turn, turn, gore.body.inner_radius + job.pipe.thickness, 0.0});
    }
    add_bolts(workshop, opening.bolt, 2.0 * job.pipe.thickness, opening.bolts.size(), "lids");
    const double half = 0.5 * (opening.lid.to - opening.lid.from);
    taken.add(opening.at - half, opening.at + half);
    tell_moved_opening(
        opening.asked, opening.at,
        "With its lid it lies within one " + std::string(job.word()) + ", off its mitres and off flanges.",
        workshop);
  }
}

// --- proof

/// Area of the section, and its first moment about the floor line, by its figures.
struct RoundSection {
  double area = 0.0;
  double moment = 0.0;
};

RoundSection section_of(const PipeJob& job) {
  const double inner = job.radius();
  const double outer = inner + job.pipe.thickness;
  const double ring = kPi * (outer * outer - inner * inner);
  if (!job.side) return {ring, inner * ring};
  // Half discs with their centres 4 r / (3 pi) below the axis, and two rectangles.
  const double below = 2.0 / 3.0 * (outer * outer * outer - inner * inner * inner);
  const double sides = 2.0 * job.pipe.thickness * *job.side;
  return {0.5 * ring + sides, 0.5 * ring * inner - below + sides * (inner + 0.5 * *job.side)};
}

ArcPath edge_of(const PipeJob& job, Angle tilt, double phase) {
  const double mean = job.mean_radius();
  return job.side ? trough_edge(job, tilt, 0.0)
                  : arcs_of({mean * math::tan(tilt.radians()), mean, phase, 0.0});
}

PartsProof prove(const PipeJob& job, const std::vector<GoreUnit>& units, const std::vector<TubeRoom>& rooms,
                 const Workshop& workshop) {
  PartsProof proof;
  const RoundSection section = section_of(job);
  const Gore* before = nullptr;
  for (const GoreUnit& unit : units) {
    for (const Gore& gore : unit.gores) {
      proof.volume += part_of(job, gore).volume;
      // By the lowest line and the mitres.
      proof.exact_volume +=
          section.area * gore.floor_length - section.moment * (math::tan(gore.body.start_tilt.radians()) -
                                                               math::tan(gore.body.end_tilt.radians()));
      if (before != nullptr) {
        const double one = length(edge_of(job, before->body.end_tilt, kSeam));
        const double other = length(edge_of(job, gore.body.start_tilt, -kSeam));
        const Vec2 gap = before->from + before->body.length * before->along - gore.from;
        proof.edge_mismatch = std::max({proof.edge_mismatch, std::fabs(one - other), norm(gap)});
      }
      before = &gore;
    }
  }
  double listed = 0.0;
  for (const ShopPart& part : workshop.parts) listed += part.volume * static_cast<double>(part.quantity());
  proof.added_volume = listed - proof.volume;
  const double cut = openings_volume(rooms);
  if (cut != 0.0) proof.differences.push_back({"openings", cut});
  const double wanted = proof.exact_volume + cut;
  if (!(std::fabs(proof.volume - wanted) <= kPartsVolumeAccuracy * wanted)) {
    throw InternalError({"",
                         "the " + std::string(job.word()) + "s hold " + rounded_text(proof.volume, 12) +
                             " m^3, the pipe " + rounded_text(wanted, 12) + " m^3",
                         "", ""});
  }
  constexpr double kSameEdge = 1e-9;  // [m]
  if (!(proof.edge_mismatch <= kSameEdge)) {
    throw InternalError({"", "edges of tubes differ by " + length_text(proof.edge_mismatch, 3), "", ""});
  }
  proof.pairs = require_no_clash(workshop);
  proof.bolted = require_bolts_meet(workshop).joined;
  if (job.options.flanges.wanted) proof.smallest_gap = job.options.flanges.gap;
  return proof;
}

std::vector<SettingOutPoint> mitres(const PipeJob& job, const Facets& facets,
                                    const std::vector<double>& joints) {
  const FlatPlaces places = flat_places(job.track, facets);
  std::vector<SettingOutPoint> rows;
  for (std::size_t i = 0; i < facets.bends(); ++i) {
    const double s = places.corners[i + 1];
    rows.push_back(setting_out_point(job.track, segment_at(joints, s), job.placement,
                                     "mitre " + std::to_string(i + 1) + ", " +
                                         angle_text(Angle::from_radians(std::fabs(facets.kinks[i])), 4),
                                     s));
  }
  return rows;
}

void list_tubes(const PipeJob& job, const std::vector<GoreUnit>& units, Workshop& workshop) {
  int count = 0;
  for (const GoreUnit& unit : units) {
    for (const Gore& gore : unit.gores) {
      ShopPart part = part_of(job, gore);
      part.name += "_" + std::to_string(++count);
      const std::size_t before = workshop.parts.size();
      const int number = add_part(workshop, std::move(part), kWallColour);
      if (workshop.parts.size() == before) continue;
      const Angle turn = job.side ? kHalfTurn : kWholeTurn;
      workshop.bends.push_back({number, 1, job.side.value_or(0.0), turn.radians() * job.mean_radius(), turn,
                                turn, job.radius(), 0.0});
    }
  }
}

/// Track places of distances along the flats.
std::vector<double> on_track(const FlatPlaces& flats, const std::vector<double>& joints) {
  std::vector<double> places;
  for (const double joint : joints) places.push_back(flats.track_at(joint));
  return places;
}

/// The flats of each unit.
std::vector<Facets> cut_at(const Facets& facets, const std::vector<double>& joints) {
  const std::vector<double> at = reached(facets);
  std::vector<Facets> units;
  for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
    Facets unit;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const double from = std::max(joints[j], at[i]);
      const double to = std::min(joints[j + 1], at[i + 1]);
      if (!(to - from > 1e-9)) continue;
      const Vec2 way = (1.0 / (at[i + 1] - at[i])) * (facets.corners[i + 1] - facets.corners[i]);
      if (unit.corners.empty())
        unit.corners.push_back(facets.corners[i] + (from - at[i]) * way);
      else
        unit.kinks.push_back(facets.kinks[i - 1]);
      unit.corners.push_back(facets.corners[i] + (to - at[i]) * way);
    }
    units.push_back(std::move(unit));
  }
  return units;
}

/// On the lowest lines of the tubes that meet at joints.
std::vector<FacePlace> places_of(const PipeJob& job, const std::vector<GoreUnit>& units,
                                 const std::vector<double>& joints) {
  std::vector<FacePlace> places;
  for (std::size_t i = 1; i < units.size(); ++i) {
    const Gore& gore = units[i].gores.front();
    const Vec2 up = up_of(gore.along);
    places.push_back(
        {std::string(job.word()) + " at the joint " + length_text(joints[i], 3) + " along the track",
         in_space(job.placement, gore.from - job.radius() * up),
         direction_in_space(job.placement, gore.along), direction_in_space(job.placement, up)});
  }
  return places;
}

}  // namespace

WorkshopBuild make_mitred_pipe(const ArcSpline& track, const section::Pipe& pipe, std::optional<double> side,
                               const PlateOptions& options, const Placement& placement, const Body& body,
                               double gravity, const Motion& design) {
  const PipeJob job{track, pipe, side, options, placement};
  const double kink = kink_for_speed(
      track, options.bend, [&](double largest) { return flats_of(job, largest); }, body, gravity,
      design.exit_speed());
  const Facets facets = flats_of(job, kink);
  std::vector<GoreUnit> units;
  std::vector<double> joints;
  WorkshopBuild build;
  split_until_it_fits(options.split, track.length(), [&](std::size_t count) -> std::optional<Excess> {
    joints = joints_along(job, facets, count);
    units = units_between(job, facets, joints);
    for (const GoreUnit& unit : units) {
      for (const Gore& gore : unit.gores) {
        std::optional<Excess> found = excess(options.split, part_of(job, gore));
        if (found) found->what = "a " + std::string(job.word()) + " " + found->what;
        if (found) return found;
      }
    }
    return std::nullopt;
  });
  Workshop& workshop = build.workshop;
  std::vector<TubeRoom> rooms;
  const std::vector<TubeOpening> openings = cut_openings(job, facets, units, rooms);
  list_tubes(job, units, workshop);
  add_rings(job, units, workshop);
  set_on_tops(job, units, workshop);
  build.joints = on_track(flat_places(track, facets), joints);
  workshop.setting_out = setting_out(track, build.joints, placement);
  TakenUp taken;
  add_tube_lids(job, units, openings, workshop, taken);
  const Shell shell =
      pipe_shell(track, pipe, side, options, placement, facets, build.joints, workshop, taken);
  add_lugs(shell, add_stiffeners(shell));
  add_supports(shell, workshop.setting_out);
  for (SettingOutPoint& row : mitres(job, facets, build.joints))
    workshop.setting_out.push_back(std::move(row));
  in_order(workshop.setting_out);
  build.ride = as_told(ride_facets(cut_at(facets, joints), body, gravity, options.joint_step), design,
                       facets.bends(), units.size() - 1);
  measure_plates(options, workshop);
  measure_rolling(job.radius(), workshop.parts.front(), "every " + std::string(job.word()), workshop);
  if (options.flanges.wanted && options.flanges.section == FlangeSection::angle) {
    const double inner = job.radius() + pipe.thickness + options.flanges.gap;
    ShopFacts(workshop).at("every flange", "angle_elongation", elongation_of(options.flanges, inner), 1.0,
                           Dimension::number);
  }
  workshop.notes.insert(
      workshop.notes.begin(),
      side ? "Troughs are rolled to an inside diameter of " + length_text(pipe.inner_diameter) +
                 " over half a turn; their sides stay flat."
           : "Tubes are rolled to an inside diameter of " + length_text(pipe.inner_diameter) +
                 " and welded along their seams, which lie 20 deg from the crown, to either side in turn.");
  measure_steps(places_of(job, units, build.joints), options, build);
  build.proof = prove(job, units, rooms, workshop);
  note_differences(build.proof, "the plain pipe", workshop);
  tell_missed_speed(options.bend, {facets}, job.least_crown(), "", body, gravity, design.exit_speed(),
                    workshop);
  return build;
}

std::vector<Issue> mitred_problems(const section::Pipe& pipe, std::optional<double> side,
                                   const PlateOptions& options) {
  std::vector<Issue> issues;
  const auto add = [&](const char* where, std::string what, std::string why, std::string hint) {
    issues.push_back({where, std::move(what), std::move(why), std::move(hint)});
  };
  const std::string word = side ? "troughs" : "tubes";
  for (Issue& issue : set_on_problems(options)) issues.push_back(std::move(issue));
  for (Issue& issue : tube_opening_problems(pipe, side, options)) issues.push_back(std::move(issue));
  if (options.liner)
    add("liner", "liner: tiles are flat, mitred " + word + " are round inside",
        "They would touch along two lines.", "round: staves");
  if (options.corners.kind != CornerJoint::butt)
    add("corners", "corners: mitred " + word + " have no corners along the track", "", "round: staves");
  if (options.rim && !side)
    add("rim", "rim: a closed section has no tops that it could lie along", "", "no rim");
  if (options.cover && !side)
    add("cover", "cover: a closed section has no tops that it could lie on", "", "no cover");
  if (side) {
    for (Issue& issue : cover_problems(options)) issues.push_back(std::move(issue));
  }
  if (!options.rim || !side) return issues;
  if (!(options.rim->width > 0.0))
    add("rim.width", "width: " + length_text(options.rim->width) + " is not positive", "",
        "a positive length");
  if (!(options.rim->thickness > 0.0))
    add("rim.thickness", "thickness: " + length_text(options.rim->thickness) + " is not positive", "",
        "a positive length");
  return issues;
}

}  // namespace glissade::parts
