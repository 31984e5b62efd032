#include "parts/strips/strip_shape.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/plates/plate_unit.hpp"
#include "parts/strips/flats_line.hpp"
#include "parts/strips/strip_folds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kMostSweep = 5.0 / 180.0 * std::numbers::pi;  // of an arc beside a width that changes
// Of the lean over such an arc, across per height: edges on the flat are arcs within 1e-10 m then.
constexpr double kMostGrowth = 0.005;
constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kMostLean = 0.1;   // across per height
constexpr double kMostTaper = 0.3;  // of one side, per length of track
constexpr double kNoFold = 1e-6;    // angle that nobody bends [rad]

// Gauss, four points.
constexpr std::array<double, 4> kNodes = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                          0.9305681557970263};
constexpr std::array<double, 4> kWeights = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                            0.1739274225687269};

/// The greatest change of half the width per length of track between two places.
double steepest_taper(const WidthLaw& widths, double from, double to) {
  double taper = 0.0;
  const auto& knots = widths.knots();
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    if (knots[i + 1].at <= from || knots[i].at >= to) continue;
    taper = std::max(taper,
                     0.5 * std::fabs(knots[i + 1].width - knots[i].width) / (knots[i + 1].at - knots[i].at));
  }
  return taper;
}

/// Places where arcs begin or the width begins to change, the end of the track included.
std::vector<double> breaks_of(const ArcSpline& track, const WidthLaw& widths) {
  std::vector<double> breaks;
  for (const TrackArc& arc : track.arcs()) {
    breaks.push_back(arc.start);
    const double taper = steepest_taper(widths, arc.start, arc.start + arc.length);
    // Where the width stays, faces are cones however far they turn.
    const double most = taper > 0.0 ? std::min(kMostSweep, kMostGrowth / taper) : kWholeTurn;
    const int parts = static_cast<int>(std::ceil(std::fabs(arc.curvature) * arc.length / most - 1e-9));
    for (int k = 1; k < parts; ++k) breaks.push_back(arc.start + arc.length * k / parts);
  }
  for (const WidthAt& knot : widths.knots()) {
    if (knot.at > 0.0 && knot.at < track.length()) breaks.push_back(knot.at);
  }
  breaks.push_back(track.length());
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> apart;
  constexpr double kSame = 1e-6;  // [m]
  for (const double place : breaks) {
    if (apart.empty() || place - apart.back() > kSame) apart.push_back(place);
  }
  apart.back() = track.length();
  return apart;
}

}  // namespace

StripJob::StripJob(const ArcSpline& on, const PlateSection& of, const PlateOptions& with,
                   const Placement& where)
    : track(on), section(of), options(with), placement(where) {
  if (!section.widths) {
    for (const TrackArc& arc : track.arcs()) arcs_.push_back({arc, 0.0, 0.0, 0.0, 0.0});
    return;
  }
  const WidthLaw& widths = *section.widths;
  const std::vector<double> breaks = breaks_of(track, widths);
  double lean = 0.0;
  double low = 0.0;
  double high = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    TrackArc arc = track.arcs()[track.arc_at(0.5 * (breaks[i] + breaks[i + 1]))];
    arc.start = breaks[i];
    arc.length = breaks[i + 1] - breaks[i];
    StripArc one{arc, 0.5 * (widths.at(breaks[i]) - widths.narrowest()),
                 0.5 * (widths.at(breaks[i + 1]) - widths.narrowest()), lean, lean};
    lean -= arc.curvature * (one.wide_to - one.wide_from);
    one.lean_to = lean;
    low = std::min(low, lean);
    high = std::max(high, lean);
    if (std::fabs(one.taper()) > kMostTaper) {
      throw InputError({"cross_section.width",
                        "the width changes by " + rounded_text(2.0 * std::fabs(one.taper()), 3) +
                            " m per metre at " + length_text(arc.start, 3) + " along the track",
                        "Walls of plates turn aside by at most " + rounded_text(2.0 * kMostTaper, 2) +
                            " m per metre of track, both together.",
                        "a longer stretch for the change"});
    }
    most_taper_ = std::max(most_taper_, std::fabs(one.taper()));
    arcs_.push_back(one);
  }
  const double middle = 0.5 * (low + high);
  for (StripArc& one : arcs_) {
    one.lean_from -= middle;
    one.lean_to -= middle;
  }
  most_lean_ = 0.5 * (high - low);
  if (most_lean_ <= kMostLean) return;
  throw InputError(
      {"cross_section.width",
       "walls of plates would lean " + angle_text(Angle::from_radians(math::atan(most_lean_)), 3) +
           " where the width changes",
       "A plate beside a width that changes in a bend is not strained only if it leans; at most by " +
           angle_text(Angle::from_radians(math::atan(kMostLean)), 2) + ".",
       "a smaller change, or one where the track bends less"});
}

StripJob::StripJob(const FlatsLine& flats, const PlateSection& of, const PlateOptions& with,
                   const Placement& where)
    : track(flats.line()), section(of), options(with), placement(where), flats_(&flats) {
  for (const TrackArc& arc : track.arcs()) {
    StripArc one{arc, 0.0, 0.0, 0.0, 0.0};
    if (!arcs_.empty()) {
      const double half = 0.5 * (arcs_.back().arc.slope_angle - arc.slope_angle);
      constexpr double kStraight = 1e-9;  // [rad]
      one.mitre_from = std::fabs(half) < kStraight ? 0.0 : math::tan(half);
      arcs_.back().mitre_to = one.mitre_from;
    }
    arcs_.push_back(one);
  }
}

double StripJob::on_track(double place) const {
  return flats_ == nullptr ? place : flats_->on_track(place);
}

std::vector<double> StripJob::rooms_at_bends(const Span& heights) const {
  if (flats_ == nullptr) return {};
  constexpr double kOffBend = 2.0;  // thicknesses from where a bend begins
  // Of the thickest plate that they may go through.
  const double t = std::max({section.thickness, options.rim ? options.rim->thickness : 0.0,
                             options.cover ? options.cover->thickness : 0.0,
                             options.liner ? options.liner->thickness : 0.0});
  const double radius = inner_radius_of(*this, t);
  std::vector<double> rooms;
  const auto add = [&](double mitre) {
    const double mitred = std::max({0.0, mitre * heights.from, mitre * heights.to});
    rooms.push_back(mitre == 0.0 ? 0.0 : mitred + (radius + t) * std::fabs(mitre) + kOffBend * t);
  };
  for (const StripArc& one : arcs_) add(one.mitre_from);
  add(0.0);
  return rooms;
}

double StripJob::off_bends(double place, double sense, const Span& heights) const {
  const std::vector<double> rooms = rooms_at_bends(heights);
  for (std::size_t k = 1; k + 1 < rooms.size(); ++k) {
    const std::size_t i = sense > 0.0 ? k : rooms.size() - 1 - k;
    if (std::fabs(place - arcs_[i].arc.start) < rooms[i]) place = arcs_[i].arc.start + sense * rooms[i];
  }
  return place;
}

std::vector<StripArc> StripJob::arcs_in(const Span& span) const {
  std::vector<StripArc> found;
  for (const StripArc& whole : arcs_) {
    const double from = std::max(span.from, whole.arc.start);
    const double to = std::min(span.to, whole.arc.start + whole.arc.length);
    if (!(to - from > 1e-9)) continue;
    StripArc one = whole;
    const auto between = [&](double a, double b, double s) {
      return a + (b - a) * ((s - whole.arc.start) / whole.arc.length);
    };
    one.wide_from = between(whole.wide_from, whole.wide_to, from);
    one.wide_to = between(whole.wide_from, whole.wide_to, to);
    one.lean_from = between(whole.lean_from, whole.lean_to, from);
    one.lean_to = between(whole.lean_from, whole.lean_to, to);
    constexpr double kOnJoint = 1e-9;  // [m]
    if (from > whole.arc.start + kOnJoint) one.mitre_from = 0.0;
    if (to < whole.arc.start + whole.arc.length - kOnJoint) one.mitre_to = 0.0;
    one.arc.start = from;
    one.arc.length = to - from;
    found.push_back(one);
  }
  return found;
}

double StripJob::lost_at(const Span& span, double height) const {
  double lost = 0.0;
  for (const StripArc& one : arcs_) {
    const double from = std::max(span.from, one.arc.start);
    const double to = std::min(span.to, one.arc.start + one.arc.length);
    if (to > from) lost += (to - from) * one.arc.curvature * height;
    const bool across = one.arc.start > span.from && one.arc.start < span.to;
    if (across) lost += 2.0 * one.mitre_from * height;
  }
  return lost;
}

double StripJob::wider_at(double s) const {
  if (!section.widths) return 0.0;
  return 0.5 * (section.widths->at(std::clamp(s, 0.0, track.length())) - section.widths->narrowest());
}

double StripJob::lean_at(double s) const {
  if (!section.widths) return 0.0;
  for (const StripArc& one : arcs_) {
    const double share = (s - one.arc.start) / one.arc.length;
    if (share <= 1.0) return one.lean_from + std::max(0.0, share) * (one.lean_to - one.lean_from);
  }
  return arcs_.back().lean_to;
}

Vec2 StripJob::at(Vec2 corner, double wider, double lean) const {
  const double out = wider + corner.y * lean;
  return {corner.x + (corner.x > 0.0 ? out : -out), corner.y};
}

std::vector<double> StripJob::pieces() const {
  std::vector<double> places;
  for (const StripArc& one : arcs_) places.push_back(one.arc.start);
  return places;
}

double StripJob::departure() const {
  return most_lean_ * std::max(section.highest, -section.lowest);
}

namespace {

/// The angle from the edge of a strip, along the track, up to its ruling.
double angle_to_ruling(const Vec2 across, double aside) {
  // Edge T + aside Y, ruling across.x Y + across.y N.
  const double cosine = aside * across.x / (norm(across) * math::hypot(1.0, aside));
  return math::acos(std::clamp(cosine, -1.0, 1.0));
}

/// A plate of one half of the section along an arc: what its edges do on the flat.
struct StripSide {
  double height = 0.0;  ///< of the base
  double aside = 0.0;   ///< Y of the edges per length of track
  double sign = 0.0;    ///< of cos b
  double lean = 0.0;    ///< of the plate, across per height, where the arc begins
  double growth = 0.0;  ///< of that, over the arc
  double curvature = 0.0;
  double length = 0.0;

  /// How far the edges turn on the flat up to a share of the arc.
  [[nodiscard]] double turned(double share) const {
    // d heading = kappa / |n| ds, the plane's normal being n = Y - aside T - lean N.
    double sum = 0.0;
    for (std::size_t k = 0; k < kNodes.size(); ++k) {
      const double here = lean + growth * share * kNodes[k];
      sum += kWeights[k] / std::sqrt(1.0 + aside * aside + here * here);
    }
    return sign * curvature * length * share * sum;
  }

  [[nodiscard]] Vec2 step(double heading) const {
    const double stretch = length * (1.0 - curvature * height) * math::hypot(1.0, aside);
    // One lean all along: an arc, however far it turns.
    if (growth == 0.0) {
      const double half = 0.5 * turned(1.0);
      const double chord = std::fabs(half) < 1e-9 ? stretch : stretch * math::sin(half) / half;
      const auto [sine, cosine] = math::sine_cosine(heading + half);
      return chord * Vec2{cosine, sine};
    }
    Vec2 sum;
    for (std::size_t k = 0; k < kNodes.size(); ++k) {
      const auto [sine, cosine] = math::sine_cosine(heading + turned(kNodes[k]));
      sum = sum + kWeights[k] * stretch * Vec2{cosine, sine};
    }
    return sum;
  }
};

/// A floor, or any level plate: its edges stand where they stand.
Development developed_level(const StripJob& job, const SectionPlate& plate,
                            const std::vector<StripArc>& arcs) {
  Development strip;
  double reached = 0.0;
  const auto put = [&](double wider, double lean) {
    const Vec2 from =
        plate.from_stays ? plate.middle_from() : job.at(plate.middle_from(), wider - plate.out, lean);
    const Vec2 to = plate.to_stays ? plate.middle_to() : job.at(plate.middle_to(), wider - plate.out, lean);
    strip.base.push_back({reached, to.x});
    strip.upper.push_back({reached, from.x});
  };
  put(arcs.front().wide_from, arcs.front().lean_from);
  for (const StripArc& one : arcs) {
    reached += one.arc.length * (1.0 - one.arc.curvature * plate.middle_to().y);
    strip.turns.push_back(0.0);
    put(one.wide_to, one.lean_to);
  }
  return strip;
}

}  // namespace

Vec2 on_level(const StripJob& job, const SectionPlate& plate, const Span& span, Vec2 place) {
  double reached = 0.0;
  for (const StripArc& one : job.arcs_in(span)) {
    const double here = std::min(place.x - one.arc.start, one.arc.length);
    if (here > 0.0) reached += here * (1.0 - one.arc.curvature * plate.middle_to().y);
  }
  return {reached, plate.face_from.x + place.y * plate.way().x};
}

namespace {

/// Where the width begins or ends to change: a bend of the flat, pressed along its ruling.
struct WidthFold {
  std::size_t place = 0;  ///< of the edges, where it lies
  double angle = 0.0;
  bool up = true;
  double sine_before = 1.0;  ///< of the angles between the edges on both sides and the ruling
  double sine_after = 1.0;
};

/// Takes from the flat what a bend does not need of it: both edges get as much shorter on both sides, arcs turn as they did.
/// @param half  of what is taken, square to the fold [m]
void press(const WidthFold& fold, double half, Development& strip) {
  constexpr double kRoom =
      0.5;  // taste: of an arc that is too short for its share; the one beyond the fold gives the rest
  const std::size_t k = fold.place;
  const auto chord = [&](std::size_t i) { return strip.base[i + 1] - strip.base[i]; };
  const double whole = half / fold.sine_before + half / fold.sine_after;
  const double before = std::min(half / fold.sine_before, kRoom * norm(chord(k - 1)));
  const double after = std::min(whole - before, kRoom * norm(chord(k)));
  const std::array<double, 2> taken = {std::min(whole - after, kRoom * norm(chord(k - 1))), after};
  for (const std::size_t side : {0U, 1U}) {
    const std::size_t i = k - 1 + side;
    const double turned = 0.5 * strip.turns[i];
    const double share = std::fabs(turned) < 1e-9 ? 1.0 : math::sin(turned) / turned;
    const Vec2 shift = (-share * taken[side] / norm(chord(i))) * chord(i);
    for (std::size_t place = i + 1; place < strip.base.size(); ++place) {
      strip.base[place] = strip.base[place] + shift;
      strip.upper[place] = strip.upper[place] + shift;
    }
    strip.pressed += taken[side];
  }
}

void press_folds(const StripJob& job, const std::vector<WidthFold>& folds, Development& strip) {
  const double thickness = job.section.thickness;
  for (const WidthFold& fold : folds) press(fold, 0.5 * bend_cut(job, thickness, fold.angle), strip);
  for (const WidthFold& fold : folds) {
    strip.folds.push_back({strip.base[fold.place], strip.upper[fold.place], Angle::from_radians(fold.angle),
                           inner_radius_of(job, thickness), fold.up});
  }
}

Development developed_widening(const StripJob& job, const SectionPlate& plate,
                               const std::vector<StripArc>& arcs) {
  const Vec2 nominal = plate.middle_from() - plate.middle_to();
  const double half = plate.middle_from().x + plate.middle_to().x > 0.0 ? 1.0 : -1.0;
  Development strip;
  Vec2 at;
  double ruling = 0.0;  // heading of it on the flat
  double before = 0.0;  // taper of the arc before
  double psi_before = 0.0;
  std::vector<WidthFold> folds;
  const auto put = [&](double width) {
    const auto [sine, cosine] = math::sine_cosine(ruling);
    strip.base.push_back(at);
    strip.upper.push_back(at + width * Vec2{cosine, sine});
  };
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const StripArc& one = arcs[i];
    const auto across = [&](double lean) { return nominal + Vec2{half * nominal.y * lean, 0.0}; };
    const double aside = half * one.taper();
    StripSide side{plate.middle_to().y,
                   aside,
                   nominal.y > 0.0 ? 1.0 : -1.0,
                   across(one.lean_from).x / nominal.y,
                   half * (one.lean_to - one.lean_from),
                   one.arc.curvature,
                   one.arc.length};
    const double psi = angle_to_ruling(across(one.lean_from), aside);
    if (i == 0) {
      ruling = psi;
      put(norm(across(one.lean_from)));
    } else {
      // Planes of both sides: normals Y - aside T - lean N.
      const Vec2 one_side{before, side.lean};
      const Vec2 other{aside, side.lean};
      const double cosine =
          (1.0 + dot(one_side, other)) / (math::hypot(1.0, norm(one_side)) * math::hypot(1.0, norm(other)));
      const double angle = math::acos(std::clamp(cosine, -1.0, 1.0));
      if (angle > kNoFold && std::fabs(aside - before) > kNoFold) {
        folds.push_back({strip.turns.size(), angle, half * (aside - before) < 0.0, math::sin(psi_before),
                         math::sin(psi)});
      }
    }
    const double heading = ruling - psi;
    at = at + side.step(heading);
    const double turn = side.turned(1.0);
    strip.turns.push_back(turn);
    psi_before = angle_to_ruling(across(one.lean_to), aside);
    ruling = heading + turn + psi_before;
    before = aside;
    put(norm(across(one.lean_to)));
  }
  press_folds(job, folds, strip);
  return strip;
}

}  // namespace

Development developed(const StripJob& job, const SectionPlate& plate, const Span& span) {
  const std::vector<StripArc> arcs = job.arcs_in(span);
  const Vec2 across = plate.middle_from() - plate.middle_to();
  if (job.widens()) {
    return std::fabs(across.y) < 1e-12 ? developed_level(job, plate, arcs)
                                       : developed_widening(job, plate, arcs);
  }
  const double width = norm(across);
  const double upright = across.y / width;  // cos b, with its sign
  Development strip;
  Vec2 at;
  double heading = 0.0;
  const auto put = [&] {
    const auto [sine, cosine] = math::sine_cosine(heading);
    strip.base.push_back(at);
    strip.upper.push_back(at + width * Vec2{-sine, cosine});
  };
  put();
  for (const StripArc& one : arcs) {
    const TrackArc& arc = one.arc;
    const double length = arc.length * (1.0 - arc.curvature * plate.middle_to().y);
    const double turn = arc.curvature * arc.length * upright;
    const double half = 0.5 * turn;
    const double chord = std::fabs(half) < 1e-9 ? length : length * math::sin(half) / half;
    const auto [sine, cosine] = math::sine_cosine(heading + half);
    at = at + chord * Vec2{cosine, sine};
    heading += turn;
    strip.turns.push_back(turn);
    put();
  }
  return strip;
}

FaceAt face_at(const StripJob& job, const SectionPlate& plate, double s) {
  const double wider = job.wider_at(s) - plate.out;
  const double lean = job.lean_at(s);
  const Vec2 from = plate.from_stays ? plate.face_from : job.at(plate.face_from, wider, lean);
  const Vec2 to = plate.to_stays ? plate.face_to : job.at(plate.face_to, wider, lean);
  return {from, (1.0 / norm(to - from)) * (to - from)};
}

std::vector<Span> even_stretches(const StripJob& job, const Span& span) {
  std::vector<Span> stretches;
  constexpr double kOneStretch = 1e-9;  // [m]
  for (const StripArc& one : job.arcs_in(span)) {
    if (one.wide_from != one.wide_to) continue;
    const double end = one.arc.start + one.arc.length;
    if (!stretches.empty() && one.arc.start - stretches.back().to < kOneStretch)
      stretches.back().to = end;
    else
      stretches.push_back({one.arc.start, end});
  }
  return stretches;
}

namespace {

/// A leaning plate where the width does not change, on the flat.
class EvenFlat {
 public:
  EvenFlat(const StripJob& job, const SectionPlate& plate, const Span& span, const Development& flat)
      : job_(job), plate_(plate), arcs_(job.arcs_in(span)), flat_(flat) {}

  /// @param place  along the track, and along the face
  [[nodiscard]] Vec2 at(Vec2 place) const {
    const auto [i, share] = arc_at(place.x);
    const double half = 0.5 * share * flat_.turns[i];
    const Vec2 chord = flat_.base[i + 1] - flat_.base[i];
    const double heading = math::atan2(chord.y, chord.x) - 0.5 * flat_.turns[i];
    const double along = share * length(PathPiece{flat_.base[i], flat_.base[i + 1], bulge(i, 1.0)});
    const double reached = std::fabs(half) < 1e-9 ? along : along * math::sin(half) / half;
    const auto [sine, cosine] = math::sine_cosine(heading + half);
    const auto [up_sine, up_cosine] = math::sine_cosine(heading + 2.0 * half);
    // Along the ruling, from the middle line of the side of `face_to`.
    const double wider = job_.wider_at(place.x);
    const double lean = job_.lean_at(place.x);
    const FaceAt face = face_at(job_, plate_, place.x);
    const double up = dot(job_.at(plate_.middle_to(), wider, lean) - face.from, face.way) - place.y;
    return flat_.base[i] + reached * Vec2{cosine, sine} + up * Vec2{-up_sine, up_cosine};
  }

  [[nodiscard]] ArcPath around(const SheetOpening& opening) const {
    const auto [i, from] = arc_at(opening.along.from);
    const double turned = bulge(i, (opening.along.to - opening.along.from) / arcs_[i].arc.length);
    const auto corner = [&](double s, double y) { return at({s, y}); };
    return {{{corner(opening.along.from, opening.across.to), turned},
             {corner(opening.along.to, opening.across.to), 0.0},
             {corner(opening.along.to, opening.across.from), -turned},
             {corner(opening.along.from, opening.across.from), 0.0}},
            true};
  }

 private:
  [[nodiscard]] std::pair<std::size_t, double> arc_at(double s) const {
    std::size_t i = 0;
    while (i + 1 < arcs_.size() && s > arcs_[i].arc.start + arcs_[i].arc.length) ++i;
    return {i, (s - arcs_[i].arc.start) / arcs_[i].arc.length};
  }
  /// Of a share of an arc.
  [[nodiscard]] double bulge(std::size_t i, double share) const {
    constexpr double kStraight = 1e-12;  // [rad]
    return std::fabs(flat_.turns[i]) < kStraight ? 0.0 : math::tan(0.25 * share * flat_.turns[i]);
  }

  const StripJob& job_;
  const SectionPlate& plate_;
  std::vector<StripArc> arcs_;
  const Development& flat_;
};

}  // namespace

void cut_through(const StripJob& job, const SectionPlate& plate, const Span& span,
                 const std::vector<Circle>& holes, const std::vector<SheetOpening>& openings, SweptBody& body,
                 Development& flat) {
  const bool level = std::fabs((plate.face_to - plate.face_from).y) < 1e-12;
  const EvenFlat even(job, plate, span, flat);
  for (const Circle& hole : holes) {
    body.holes.push_back({hole.centre - Vec2{span.from, 0.0}, hole.radius});
    flat.holes.push_back(
        {level ? on_level(job, plate, span, hole.centre) : even.at(hole.centre), hole.radius});
  }
  for (const SheetOpening& opening : openings) {
    body.windows.push_back({opening.along.from - span.from, opening.along.to - span.from, opening.across.from,
                            opening.across.to});
    flat.cutouts.push_back(even.around(opening));
  }
}

double length_along(const std::vector<Vec2>& places, const std::vector<double>& turns) {
  double sum = 0.0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    sum += length(PathPiece{places[i], places[i + 1], math::tan(0.25 * turns[i])});
  }
  return sum;
}

FlatPattern pattern_of(const Development& strip, const std::vector<double>& radii) {
  FlatPattern pattern;
  ArcPath& outline = pattern.region.outline;
  outline.closed = true;
  const std::size_t count = strip.turns.size();
  const auto bulge = [&](std::size_t i) {
    return std::fabs(strip.turns[i]) < 1e-12 ? 0.0 : math::tan(0.25 * strip.turns[i]);
  };
  for (std::size_t i = 0; i <= count; ++i)
    outline.vertices.push_back({strip.base[i], i < count ? bulge(i) : 0.0});
  for (std::size_t i = count + 1; i-- > 0;)
    outline.vertices.push_back({strip.upper[i], i > 0 ? -bulge(i - 1) : 0.0});
  const OwnPlane plane = own_plane(outline);
  const Vec2 back = PlaneMotion::turn(-plane.angle)(plane.origin);
  const PlaneMotion motion = PlaneMotion::turn(-plane.angle, -1.0 * back);
  outline = moved(outline, motion);
  for (const Circle& hole : strip.holes) pattern.region.holes.push_back({motion(hole.centre), hole.radius});
  for (const ArcPath& cutout : strip.cutouts) pattern.region.cutouts.push_back(moved(cutout, motion));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (i > 0 && radii[i] == radii[i - 1]) continue;
    pattern.rolls.push_back({motion(strip.base[i]), motion(strip.upper[i]), radii[i]});
  }
  for (BendLine fold : strip.folds) {
    fold.from = motion(fold.from);
    fold.to = motion(fold.to);
    pattern.bends.push_back(fold);
  }
  return pattern;
}

namespace {

bool folds_over(const TrackArc& arc, const SectionPlate& plate) {
  return arc.curvature * highest_of(plate) * kRoomAtFold > 1.0 ||
         -arc.curvature * -lowest_of(plate) * kRoomAtFold > 1.0;
}

/// Of a flat between two bends.
bool folds_over(const StripArc& flat, const SectionPlate& plate) {
  const double both = flat.mitre_from + flat.mitre_to;
  return flat.arc.length < kRoomAtFold * std::max(both * highest_of(plate), both * lowest_of(plate));
}

}  // namespace

Span unfolded(const StripJob& job, const SectionPlate& plate) {
  Span span{0.0, job.track.length()};
  std::vector<StripArc> arcs;
  if (job.bent())
    arcs = job.arcs_in(span);
  else
    for (const TrackArc& arc : job.track.arcs()) arcs.push_back({arc, 0.0, 0.0, 0.0, 0.0});
  for (const StripArc& one : arcs) {
    const TrackArc& arc = one.arc;
    if (job.bent() ? !folds_over(one, plate) : !folds_over(arc, plate)) continue;
    const double end = arc.start + arc.length;
    if (end <= kMostCutOff * job.track.length()) {
      span.from = std::max(span.from, end);
      continue;
    }
    if (arc.start >= (1.0 - kMostCutOff) * job.track.length()) {
      span.to = std::min(span.to, arc.start);
      continue;
    }
    const double radius =
        job.bent() ? arc.length / std::fabs(one.mitre_from + one.mitre_to) : 1.0 / std::fabs(arc.curvature);
    throw InputError({"cross_section",
                      "the " + plate.name + " folds over at " + length_text(job.on_track(arc.start), 3) +
                          " along the track",
                      "It is " + length_text(std::max(highest_of(plate), -lowest_of(plate)), 3) +
                          " high above the floor line, " +
                          (job.bent() ? "a flat there " + length_text(arc.length, 3) + " long."
                                      : "the radius there " + length_text(radius, 3) + "."),
                      "a section of at most " + length_text(radius / kRoomAtFold, 3) +
                          ", or a limit smallest_valley_radius above it"});
  }
  return span;
}

SweptBody strip_body(const StripJob& job, const SectionPlate& plate, const Span& span, Vec2& origin) {
  const double middle = 0.5 * (plate.face_from.x + plate.face_to.x);
  const std::array<Vec2, 4> corners = {plate.face_from, plate.face_to, plate.back_to, plate.back_from};
  SweptBody body;
  for (const Vec2 corner : corners) body.section.push_back({corner.y, middle - corner.x});
  if (!job.widens()) {
    body.path = *offset_line(job.track, span, 0.0);
  } else {
    const std::vector<StripArc> arcs = job.arcs_in(span);
    const auto put = [&](double s, double bulge, double wider, double lean) {
      body.path.vertices.push_back({frame_at(job.track, s).at, bulge});
      body.shifts.emplace_back();
      for (std::size_t j = 0; j < corners.size(); ++j) {
        const bool stays = j == 0 || j == 3 ? plate.from_stays : plate.to_stays;
        body.shifts.back().push_back(stays ? 0.0
                                           : corners[j].x - job.at(corners[j], wider - plate.out, lean).x);
      }
    };
    for (const StripArc& one : arcs) {
      put(one.arc.start, math::tan(0.25 * one.arc.curvature * one.arc.length), one.wide_from, one.lean_from);
    }
    put(span.to, 0.0, arcs.back().wide_to, arcs.back().lean_to);
  }
  origin = body.path.vertices.front().at;
  for (PathVertex& vertex : body.path.vertices) vertex.at = vertex.at - origin;
  return body;
}

}  // namespace glissade::parts
