#include "parts/strips/bent_strips.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/plane_geometry.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/shop_facts.hpp"
#include "parts/strips/strip_folds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kSteep = 0.05;  // half the tangent of usual bends
constexpr double kApart = 1e-4;  // of a change of width from a bend, along the track [m]

double tan_half(double angle) {
  return math::tan(0.5 * angle);
}

Vec3 unit_of(Vec3 v) {
  return (1.0 / norm(v)) * v;
}

/// Rulings of a plate lie level: a floor.
bool level(const SectionPlate& plate) {
  return std::fabs(plate.middle_from().y - plate.middle_to().y) < 1e-12;
}

/// Of one that is not: to which side a change of width moves it, and how it leans across per height.
double half_of(const SectionPlate& plate) {
  return plate.middle_from().x + plate.middle_to().x > 0.0 ? 1.0 : -1.0;
}
double leaning(const SectionPlate& plate) {
  const Vec2 across = plate.middle_from() - plate.middle_to();
  return across.x / across.y;
}

}  // namespace

bool springs(const SectionPlate& plate, double tightest, double thickness) {
  constexpr double kUpright = 0.1;     // theory: sine of the most lean that widths give upright walls
  constexpr double kElastic = 1000.0;  // theory: thicknesses of radius; structural steel yields at half
  return std::fabs(plate.way().x) <= kUpright && !(tightest < kElastic * thickness);
}

double inner_radius_of(const StripJob& job, double thickness) {
  return job.options.bend.inner_radius.value_or(thickness);
}

double bend_cut(const StripJob& job, double thickness, double angle) {
  const double radius = inner_radius_of(job, thickness);
  const double neutral = job.options.bend.k_factor.value_or(k_factor(radius, thickness));
  return 2.0 * (radius + 0.5 * thickness) * tan_half(angle) - (radius + neutral * thickness) * angle;
}

namespace {

/// Within the frames at its ends a unit is straight, down to its lowest corner beside bends of some degrees.
double below_frames(const StripJob& job) {
  return kSteep * std::max(job.section.highest, -job.section.lowest);
}

}  // namespace

double least_bent_flat(const StripJob& job) {
  return least_flat(job.section.thickness, job.options, below_frames(job));
}

Facets bent_flats(const StripJob& job, const Span& span, double largest_kink) {
  return facets_by_rule(job.track, span, job.options.bend, largest_kink, least_bent_flat(job),
                        least_end_flat(job.options, below_frames(job)));
}

BentStrips::BentStrips(const StripJob& job, double largest_kink, const std::vector<double>& joints)
    : job_(job) {
  for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
    const Span span{joints[j], joints[j + 1]};
    facets_.push_back(bent_flats(job, span, largest_kink));
    if (job.section.convex) require_end_flats(span, facets_.back(), job.options.flanges);
    add_unit(facets_.back());
  }
  lean_facets();
}

std::size_t BentStrips::bends() const {
  std::size_t count = 0;
  for (const Facets& facets : facets_) count += facets.bends();
  return count;
}

void BentStrips::add_unit(const Facets& facets) {
  const FlatPlaces places = flat_places(job_.track, facets);
  const std::size_t first = stations_.size();
  const std::size_t flats = facets.corners.size() - 1;
  const auto way = [&](std::size_t i) {
    const Vec2 along = facets.corners[i + 1] - facets.corners[i];
    return (1.0 / norm(along)) * along;
  };
  for (std::size_t i = 0; i <= flats; ++i) {
    const Vec2 before = way(i == 0 ? 0 : i - 1);
    const Vec2 after = way(i == flats ? flats - 1 : i);
    const bool bend = i > 0 && i < flats;
    Station station{places.corners[i],
                    facets.corners[i],
                    {},
                    bend ? facets.kinks[i - 1] : 0.0,
                    bend ? facets.misses[i - 1] : 0.0,
                    job_.wider_at(places.corners[i]),
                    0.0};
    const Vec2 mean{0.5 * (before.x + after.x), 0.5 * (before.y + after.y)};
    // Of length 1 / cos(kink / 2): one per height above either flat.
    station.rise = (1.0 / dot(mean, mean)) * Vec2{-mean.y, mean.x};
    stations_.push_back(station);
    if (i == flats || !job_.section.widths) continue;
    add_knots(facets, i, places);
  }
  units_.push_back({first, stations_.size() - 1});
}

void BentStrips::add_knots(const Facets& facets, std::size_t flat, const FlatPlaces& places) {
  const Span span{places.corners[flat], places.corners[flat + 1]};
  const double begins = places.flats_at(span.from);
  const Vec2 along = facets.corners[flat + 1] - facets.corners[flat];
  const double length = norm(along);
  // The fold at a change of width and a bend may not meet below the plates' edges.
  const double high = std::max(job_.section.highest, -job_.section.lowest);
  const auto room = [&](std::size_t corner) {
    const bool bend = corner > 0 && corner + 1 < facets.corners.size();
    return kApart + (bend ? 1.1 * high * std::fabs(tan_half(facets.kinks[corner - 1])) : 0.0);
  };
  const double wide_from = job_.wider_at(span.from);
  const double wide_to = job_.wider_at(span.to);
  for (const WidthAt& knot : job_.section.widths->knots()) {
    if (!(knot.at > span.from && knot.at < span.to)) continue;
    const double share = (places.flats_at(knot.at) - begins) / length;
    const double wide = job_.wider_at(knot.at);
    if (share * length < room(flat) || (1.0 - share) * length < room(flat + 1)) {
      departure_ = std::max(departure_, std::fabs(wide - (1.0 - share) * wide_from - share * wide_to));
      continue;
    }
    stations_.push_back({knot.at, (1.0 - share) * facets.corners[flat] + share * facets.corners[flat + 1],
                         (1.0 / length) * Vec2{-along.y, along.x}, 0.0, 0.0, wide, 0.0});
  }
}

double BentStrips::taper(std::size_t i) const {
  return (stations_[i + 1].wide - stations_[i].wide) / flat(i);
}

double BentStrips::narrowing(std::size_t i) const {
  return tan_half(stations_[i].kink) + tan_half(stations_[i + 1].kink);
}

void BentStrips::lean_facets() {
  if (!job_.widens()) return;
  double lean = 0.0;
  double low = 0.0;
  double high = 0.0;
  for (const Stretch& unit : units_) {
    stations_[unit.first].lean = lean;
    for (std::size_t i = unit.first; i < unit.last; ++i) {
      Station& end = stations_[i + 1];
      const double before = taper(i);
      const double after = i + 1 < unit.last ? taper(i + 1) : before;
      end.lean = lean - before * tan_half(end.kink);
      lean -= (before + after) * tan_half(end.kink);
      low = std::min(low, lean);
      high = std::max(high, lean);
    }
  }
  for (Station& station : stations_) station.lean -= 0.5 * (low + high);
}

double BentStrips::lean_at(double s) const {
  const Station* nearest = &stations_.front();
  for (const Station& station : stations_) {
    if (std::fabs(station.s - s) < std::fabs(nearest->s - s)) nearest = &station;
  }
  return nearest->lean;
}

BentStrips::Half BentStrips::half_at(Vec2 at) const {
  double nearest = std::numeric_limits<double>::infinity();
  Half half;
  for (const Stretch& unit : units_) {
    for (std::size_t i = unit.first; i < unit.last; ++i) {
      const Station& from = stations_[i];
      const double off = core::distance_to_segment(at, from.at, stations_[i + 1].at);
      if (!(off < nearest)) continue;
      nearest = off;
      const double along = dot(at - from.at, stations_[i + 1].at - from.at) / flat(i);
      half = {from.wide + taper(i) * along, square_lean(i)};
    }
  }
  return half;
}

double BentStrips::square_lean(std::size_t i) const {
  return stations_[i].lean - taper(i) * tan_half(stations_[i].kink);
}

Vec3 BentStrips::place(const Station& station, Vec2 corner) const {
  const Vec2 at = station.at + corner.y * station.rise;
  return {at.x, at.y, -job_.at(corner, station.wide, station.lean).x};
}

BentStrips::Stretch BentStrips::stretch_of(const SectionPlate& plate, const Stretch& unit) const {
  Stretch found = unit;
  const double whole = job_.track.length();
  for (std::size_t i = unit.first; i < unit.last; ++i) {
    const double taken = std::max(narrowing(i) * highest_of(plate), narrowing(i) * lowest_of(plate));
    if (flat(i) >= kRoomAtFold * taken) continue;
    if (stations_[i + 1].s <= kMostCutOff * whole) {
      found.first = i + 1;
    } else if (stations_[i].s >= (1.0 - kMostCutOff) * whole) {
      found.last = std::min(found.last, i);
    } else {
      const double radius = flat(i) / std::fabs(narrowing(i));
      throw InputError(
          {"cross_section",
           "the " + plate.name + " folds over at " + length_text(stations_[i].s, 3) + " along the track",
           "It is " + length_text(std::max(highest_of(plate), -lowest_of(plate)), 3) +
               " high above the floor line, a flat there " + length_text(flat(i), 3) + " long.",
           "a section of at most " + length_text(radius / kRoomAtFold, 3) +
               ", or a limit smallest_valley_radius above it"});
    }
  }
  return found;
}

std::vector<BentStrips::Bend> BentStrips::bends_of(const SectionPlate& plate, double thickness,
                                                   const Stretch& stretch) const {
  const auto middle = [&](std::size_t i, bool from) {
    return place(stations_[i], from ? plate.middle_from() : plate.middle_to());
  };
  const auto normal = [&](std::size_t i) {
    const Vec3 along = middle(i + 1, false) - middle(i, false);
    const Vec3 up = unit_of(cross(along, middle(i, true) - middle(i, false)));
    const Vec3 to_face = place(stations_[i], plate.face_to) - place(stations_[i], plate.back_to);
    return (dot(up, to_face) > 0.0 ? 1.0 : -1.0) * up;
  };
  std::vector<Bend> bends(stretch.last - stretch.first + 1);
  double tightest = std::numeric_limits<double>::infinity();
  for (std::size_t i = stretch.first + 1; i < stretch.last; ++i) {
    const Vec3 before = normal(i - 1);
    const double sine = norm(cross(before, normal(i)));
    const double towards = dot(middle(i + 1, false) - middle(i, false), before);
    Bend& bend = bends[i - stretch.first];
    bend.angle = (towards > 0.0 ? 1.0 : -1.0) * math::atan2(sine, dot(before, normal(i)));
    const double pitch =
        0.5 * (norm(middle(i + 1, false) - middle(i, false)) + norm(middle(i, false) - middle(i - 1, false)));
    if (stations_[i].kink != 0.0 && bend.angle != 0.0)
      tightest = std::min(tightest, pitch / std::fabs(bend.angle));
  }
  // Folds where the width begins or ends to change are pressed in what springs, too.
  const bool sprung = springs(plate, tightest, thickness);
  const auto at_bend = [&](std::size_t i) { return stations_[stretch.first + i].kink != 0.0; };
  for (std::size_t i = 1; i + 1 < bends.size(); ++i) {
    const double angle = std::fabs(bends[i].angle);
    if (angle <= kNoBend || (sprung && at_bend(i))) continue;
    const double half = 0.5 * bend_cut(job_, thickness, angle);
    bends[i] = {bends[i].angle, half, half, true};
  }
  for (std::size_t i = 1; i + 1 < bends.size(); ++i) {
    if (bends[i].pressed && !at_bend(i)) share_fold(plate, stretch, i, bends);
  }
  return bends;
}

void BentStrips::share_fold(const SectionPlate& plate, const Stretch& stretch, std::size_t fold,
                            std::vector<Bend>& bends) const {
  constexpr double kRoom = 0.5;  // taste: of a flat that is too short for its share, as of rolled plates
  const auto edge = [&](std::size_t k, Vec2 corner) {
    return norm(place(stations_[k + 1], corner) - place(stations_[k], corner));
  };
  // What a bend of the line takes at the flat's other end is its own.
  const auto room = [&](std::size_t k, double taken) {
    const double whole = std::min(edge(k, plate.middle_from()), edge(k, plate.middle_to()));
    return std::max(0.0, std::min(kRoom * whole, whole - taken));
  };
  const std::size_t i = stretch.first + fold;
  const double before = room(i - 1, stations_[i - 1].kink == 0.0 ? 0.0 : bends[fold - 1].after);
  const double after = room(i, stations_[i + 1].kink == 0.0 ? 0.0 : bends[fold + 1].before);
  const double whole = bends[fold].before + bends[fold].after;
  bends[fold].after = std::min(whole - std::min(bends[fold].before, before), after);
  bends[fold].before = std::min(whole - bends[fold].after, before);
}

FoldedPlate BentStrips::body_of(const SectionPlate& plate, const Stretch& stretch) const {
  // Counter-clockwise seen against the way: in (up, right).
  std::array<Vec2, 4> corners = {plate.face_from, plate.face_to, plate.back_to, plate.back_from};
  double twice = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const Vec2 a{corners[j].y, -corners[j].x};
    const Vec2 b{corners[(j + 1) % 4].y, -corners[(j + 1) % 4].x};
    twice += cross(a, b);
  }
  if (twice < 0.0) std::reverse(corners.begin(), corners.end());
  FoldedPlate body;
  const Vec3 origin{stations_[stretch.first].at.x, stations_[stretch.first].at.y,
                    -0.5 * (plate.face_from.x + plate.face_to.x)};
  for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
    body.corners.emplace_back();
    for (std::size_t j = 0; j < 4; ++j) body.corners.back()[j] = place(stations_[i], corners[j]) - origin;
  }
  return body;
}

BentStrips::Quad BentStrips::quad(const SectionPlate& plate, std::size_t i, double cut_from,
                                  double cut_to) const {
  const Vec3 from = place(stations_[i], plate.middle_to());
  const Vec3 to = place(stations_[i + 1], plate.middle_to());
  const Vec3 across_from = place(stations_[i], plate.middle_from()) - from;
  const Vec3 across_to = place(stations_[i + 1], plate.middle_from()) - to;
  const Vec3 along = to - from;
  const auto heading = [&](Vec3 across) {
    return math::atan2(norm(cross(along, across)), dot(along, across));
  };
  Quad quad;
  const double from_angle = heading(across_from);
  const double to_angle = heading(across_to);
  if (level(plate)) {
    // Bends are level lines: the flat between them gets shorter, and keeps its widths.
    const double run = norm(along - along.z * Vec3{0.0, 0.0, 1.0}) - cut_from - cut_to;
    // On the pattern the way from `face_to` to `face_from` is up, whichever it is in space.
    const double up = across_from.z > 0.0 ? 1.0 : -1.0;
    quad.base = {run, up * along.z};
    quad.upper = {run, up * (along.z + across_to.z - across_from.z)};
    return quad;
  }
  // The edges of a facet are parallel; both are shorter by what bends take, along them.
  const double cut = cut_from / math::sin(from_angle) + cut_to / math::sin(to_angle);
  return {{norm(along) - cut, 0.0}, {norm(along + across_to - across_from) - cut, 0.0}, from_angle, to_angle};
}

void BentStrips::develop(const SectionPlate& plate, double thickness, const Stretch& stretch,
                         Strip& strip) const {
  const std::vector<Bend> bends = bends_of(plate, thickness, stretch);
  const double radius = inner_radius_of(job_, thickness);
  Development flat;
  Vec2 at;
  double ruling = 0.0;  // heading of it on the flat
  double sum = 0.0;
  for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
    const Bend& bend = bends[i - stretch.first];
    const double width =
        norm(place(stations_[i], plate.middle_from()) - place(stations_[i], plate.middle_to()));
    if (i == stretch.first) {
      ruling = quad(plate, i, 0.0, 0.0).from;
    } else {
      const Quad facet = quad(plate, i - 1, bends[i - 1 - stretch.first].after, bend.before);
      const auto [sine, cosine] = math::sine_cosine(ruling - facet.from);
      at =
          at + Vec2{facet.base.x * cosine - facet.base.y * sine, facet.base.x * sine + facet.base.y * cosine};
      ruling += facet.to - facet.from;
      strip.edge_to += norm(facet.base);
      strip.edge_from += norm(facet.upper);
      flat.turns.push_back(0.0);
    }
    const auto [sine, cosine] = math::sine_cosine(ruling);
    flat.base.push_back(at);
    flat.upper.push_back(at + width * Vec2{cosine, sine});
    if (!bend.pressed) {
      strip.sprung = std::max(strip.sprung, std::fabs(bend.angle));
      continue;
    }
    sum += bend.angle;
    flat.folds.push_back({flat.base.back(), flat.upper.back(), Angle::from_radians(std::fabs(bend.angle)),
                          radius, bend.angle > 0.0});
    strip.steps.push_back(
        {0, static_cast<int>(strip.steps.size()) + 1, plate.ends_at_floor() ? strip.edge_to : strip.edge_from,
         0.0, Angle::from_radians(bend.angle), Angle::from_radians(sum), radius, stations_[i].miss});
  }
  strip.part.pattern = pattern_of(flat, {});
}

Strip BentStrips::strip_of(const SectionPlate& plate, double thickness, const Stretch& stretch) const {
  Strip strip;
  strip.first = stretch.first;
  strip.last = stretch.last;
  strip.span = {stations_[stretch.first].s, stations_[stretch.last].s};
  ShopPart& part = strip.part;
  part.name = plate.name;
  part.material = job_.options.material.name;
  part.density = job_.options.material.density;
  part.thickness = thickness;
  part.body = body_of(plate, stretch);
  part.places = {plane_of_track(job_.placement, stations_[stretch.first].at, 0.0,
                                -0.5 * (plate.face_from.x + plate.face_to.x))};
  weigh(part);
  develop(plate, thickness, stretch, strip);
  if (!level(plate)) weigh_sheet(part);
  return strip;
}

std::vector<Strip> BentStrips::strips() const {
  std::vector<Strip> strips;
  for (std::size_t p = 0; p < job_.section.plates.size(); ++p) {
    for (std::size_t u = 0; u < units_.size(); ++u) {
      const SectionPlate& plate = job_.section.plates_of(u)[p];
      const Stretch stretch = stretch_of(plate, units_[u]);
      if (stretch.first >= stretch.last) continue;
      strips.push_back(strip_of(plate, job_.section.thickness, stretch));
      strips.back().plate = p;
      strips.back().unit = u;
      if (units_.size() > 1) strips.back().part.name += "_" + std::to_string(u + 1);
    }
  }
  return strips;
}

std::optional<BentStrips::SquareEnd> BentStrips::square_end(const SectionPlate& plate, double taken,
                                                            const SideOfUnit& side) const {
  constexpr double kShort = 5e-3;  // of what is left of a flat [m]
  const auto next = [&](std::size_t i) { return side.downstream ? i + 1 : i - 1; };
  const Station& joint = stations_[side.joint];
  const Vec2 in = stations_[next(side.joint)].at - joint.at;
  const Vec2 inwards = (1.0 / norm(in)) * in;
  for (std::size_t i = side.from; i != side.to; i = next(i)) {
    const Station& a = stations_[i];
    const Station& b = stations_[next(i)];
    const double whole = norm(b.at - a.at);
    const Vec2 way = (1.0 / whole) * (b.at - a.at);
    const Vec2 up = side.downstream ? Vec2{-way.y, way.x} : Vec2{way.y, -way.x};
    if (!(dot(way, inwards) > 0.0)) continue;
    double move = 0.0;
    double room = whole;
    for (const double height : {lowest_of(plate), highest_of(plate)}) {
      const double beyond = dot(a.at + height * up - joint.at, inwards);
      move = std::max({move, (taken - beyond) / dot(way, inwards), height * dot(a.rise, way)});
      room = std::min(room, dot(b.at + height * b.rise - a.at, way));
    }
    if (room - move < kShort) continue;
    const double share = move / whole;
    return SquareEnd{{a.s + share * (b.s - a.s), a.at + move * way, up, 0.0, 0.0,
                      a.wide + share * (b.wide - a.wide), square_lean(side.downstream ? i : i - 1)},
                     i};
  }
  return std::nullopt;
}

std::optional<BentStrips::Stretch> BentStrips::trimmed(const SectionPlate& plate, const Stretch& unit,
                                                       double taken) {
  // Where the plates below it begin, beyond a hollow that is tighter than they are high.
  const Stretch whole = stretch_of(plate, unit);
  if (whole.first >= whole.last) return std::nullopt;
  if (!(taken > 0.0)) return whole;
  const auto from = square_end(plate, taken, {unit.first, whole.first, whole.last, true});
  if (!from) return std::nullopt;
  const auto to = square_end(plate, taken, {unit.last, whole.last, from->flat, false});
  if (!to || !(to->station.s > from->station.s)) return std::nullopt;
  std::vector<Station> own = {from->station};
  for (std::size_t i = from->flat + 1; i < to->flat; ++i) own.push_back(stations_[i]);
  own.push_back(to->station);
  const std::size_t first = stations_.size();
  stations_.insert(stations_.end(), own.begin(), own.end());
  return Stretch{first, stations_.size() - 1};
}

std::vector<Strip> BentStrips::set(const SectionPlate& plate, double thickness, double taken) {
  std::vector<Strip> strips;
  for (std::size_t u = 0; u < units_.size(); ++u) {
    const auto stretch = trimmed(plate, units_[u], taken);
    if (!stretch) continue;
    strips.push_back(strip_of(plate, thickness, *stretch));
    if (units_.size() > 1) strips.back().part.name += "_" + std::to_string(u + 1);
  }
  return strips;
}

BentStrips::Expected BentStrips::expected(const Strip& strip) const {
  const SectionPlate& plate = job_.section.plates_of(strip.unit)[strip.plate];
  const std::array<Vec2, 4> corners = {plate.face_from, plate.face_to, plate.back_to, plate.back_from};
  double area = 0.0;
  double moment = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const Vec2 a = corners[j];
    const Vec2 b = corners[(j + 1) % 4];
    area += 0.5 * cross(a, b);
    moment += cross(a, b) * (a.y + b.y) / 6.0;
  }
  const double sense = area < 0.0 ? -1.0 : 1.0;
  const std::vector<Bend> bends = bends_of(plate, job_.section.thickness, {strip.first, strip.last});
  Expected all;
  for (std::size_t i = strip.first; i < strip.last; ++i) {
    all.volume += sense * (area * flat(i) - moment * narrowing(i)) + widened_volume(plate, i);
    const double cut_from = bends[i - strip.first].after;
    const double cut_to = bends[i + 1 - strip.first].before;
    const auto edge = [&](double height) {
      const double run = flat(i) - height * narrowing(i);
      if (level(plate)) {
        const auto wide = [&](std::size_t k) { return stations_[k].wide + height * stations_[k].lean; };
        return math::hypot(run - cut_from - cut_to, wide(i + 1) - wide(i));
      }
      const auto taken = [&](std::size_t k, double cut) {
        if (cut == 0.0) return 0.0;
        // The angle between edge and ruling by their components along the flat, across it and up.
        const double lean = leaning(plate) + half_of(plate) * (stations_[k].lean);
        const double turned = (k == i ? 1.0 : -1.0) * tan_half(stations_[k].kink);
        const Vec3 ruling{turned, lean, 1.0};
        const Vec3 along{1.0, half_of(plate) * taper(i), 0.0};
        return cut * norm(ruling) * norm(along) / norm(cross(ruling, along));
      };
      return math::hypot(1.0, taper(i)) * run - taken(i, cut_from) - taken(i + 1, cut_to);
    };
    all.edge_from += edge(plate.middle_from().y);
    all.edge_to += edge(plate.middle_to().y);
  }
  return all;
}

double BentStrips::widened_volume(const SectionPlate& plate, std::size_t i) const {
  if (!(plate.middle_from().x * plate.middle_to().x < 0.0)) return 0.0;
  // What both halves are wider, over the plate's heights: a cubic, by Gauss with two points.
  const double half = 0.5 * (highest_of(plate) - lowest_of(plate));
  const double middle = 0.5 * (highest_of(plate) + lowest_of(plate));
  double volume = 0.0;
  for (const double node : {-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}) {
    const double height = middle + half * node;
    const auto wide = [&](std::size_t k) { return stations_[k].wide + height * stations_[k].lean; };
    volume += half * (wide(i) + wide(i + 1)) * (flat(i) - height * narrowing(i));
  }
  return volume;
}

void measure_bends(const std::vector<Strip>& strips, const PlateOptions& options, Workshop& workshop) {
  ShopFacts facts(workshop);
  for (const Strip& strip : strips) {
    const double thickness = strip.part.thickness;
    const BendStep* before = nullptr;
    for (const BendStep& step : strip.steps) {
      facts.of(strip.part, "bend_radius_thicknesses", options.bend.inner_radius.value_or(thickness),
               thickness);
      if (before != nullptr) {
        const double taken = (step.radius + thickness) * (tan_half(std::fabs(step.angle.radians())) +
                                                          tan_half(std::fabs(before->angle.radians())));
        const std::string where = strip.part.name + " at " +
                                  length_text(strip.span.from + before->distance, 3) + " along the track";
        const double flat = step.distance - before->distance - taken;
        facts.at(where, "flat", flat);
        facts.at(where, "flat_thicknesses", flat, thickness);
      }
      before = &step;
    }
  }
}

}  // namespace glissade::parts
