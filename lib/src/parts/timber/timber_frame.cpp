// Where the members of a timber structure are: deck in layers, cross members below it, bearers, legs.

#include "parts/timber/timber_frame.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/calm_joints.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/supports/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>

namespace glissade::parts {
namespace {

constexpr double kLeastRemnant = 0.25;  // of a sheet: a shorter remnant is shared with the sheet before it
constexpr double kStagger = 0.3;        // least distance of seams of neighbouring layers [m]
constexpr double kSame = 1e-9;          // [m]
constexpr std::size_t kMostPieces = 400;
constexpr double kLeastPost = 50e-3;  // the structure lies on the ground below that [m]
constexpr double kSteepest = 1.2;     // slope angle beyond which no leg stands below a bearer [rad]

double turned_between(const ArcSpline& track, double from, double to) {
  return track.direction(from).slope_angle - track.direction(to).slope_angle;
}

double flat_length_of(const TimberJob& job, std::size_t layer, double from, double to) {
  const double depth = (static_cast<double>(layer) + 0.5) * job.layer();
  return to - from + depth * turned_between(job.track, from, to);
}

/// @return where a sheet of a flat length ends that begins at a place; the end of the track if it is longer
double end_of_sheet(const TimberJob& job, std::size_t layer, double from, double flat) {
  double low = from;
  double high = job.track.length();
  if (flat_length_of(job, layer, from, high) <= flat) return high;
  for (int round = 0; round < 100 && high - low > 0.0; ++round) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (flat_length_of(job, layer, from, middle) <= flat ? low : high) = middle;
  }
  return low;
}

/// Seams of the sets before one: those that it keeps away from, and those that may share a cross member with it.
struct OtherSeams {
  std::vector<double> beside;  ///< of the set above and of the one beside
  std::vector<double> apart;   ///< of the others
  double member = 0.0;         ///< least distance of two cross members

  /// Distances from the seams beside that are tried one after the other, where pieces are too short for the first.
  [[nodiscard]] std::array<double, 4> staggers() const {
    return {kStagger, 2.0 / 3.0 * kStagger, 1.0 / 3.0 * kStagger, member};
  }

  [[nodiscard]] bool allow(double seam, double stagger) const {
    return std::none_of(beside.begin(), beside.end(),
                        [&](double other) { return std::fabs(other - seam) < stagger - kSame; }) &&
           std::none_of(apart.begin(), apart.end(), [&](double other) {
             return std::fabs(other - seam) > kSame && std::fabs(other - seam) < member - kSame;
           });
  }

  /// The last place up to `end` that they allow; `end` where none is in its last three quarters.
  [[nodiscard]] double last_allowed(double from, double end) const {
    for (const double stagger : staggers()) {
      std::vector<double> places = {end};
      for (const double other : beside) places.push_back(other - stagger);
      for (const double other : apart) {
        places.push_back(other);
        places.push_back(other - member);
      }
      double best = 0.0;
      for (const double place : places) {
        if (place <= end && place > best && allow(place, stagger)) best = place;
      }
      if (best > from + kLeastRemnant * (end - from)) return best;
    }
    return end;
  }
};

/// Moves the last seam back so that no remnant is short and none of the other seams is near.
/// @param seams  of a set, both ends among them
void keep_apart(std::vector<double>& seams, double sheet, const OtherSeams& others) {
  const std::size_t last = seams.size() - 1;
  if (last < 2) return;
  constexpr int kSteps = 40;
  const double room = seams[last - 1] - seams[last - 2] - kLeastRemnant * sheet;
  for (const double stagger : others.staggers()) {
    for (int k = 0; k <= kSteps; ++k) {
      const double seam = seams[last - 1] - room * k / kSteps;
      if (seams[last] - seam < kLeastRemnant * sheet || !others.allow(seam, stagger)) continue;
      seams[last - 1] = seam;
      return;
    }
  }
}

/// Height, square to the track at s, of the line at a height over the point that lies `along` from there.
double height_over(const ArcSpline& track, double s, double along, double height) {
  const TrackFrame here = frame_at(track, s);
  double near = s + along;
  Vec2 away;
  for (int round = 0; round < 20; ++round) {
    near = std::clamp(near, 0.0, track.length());
    const TrackFrame at = frame_at(track, near);
    away = at.at + height * at.up - here.at;
    const double stretch = 1.0 - track.at(near).curvature * height;
    near += (along - dot(away, here.along)) / std::max(stretch, 0.1);
  }
  return dot(away, here.up);
}

/// Seams of all layers and both ends, moved so that a member lies within the track; ascending.
std::vector<double> supported_places(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows) {
  const double half = 0.5 * job.member_width();
  std::vector<double> places = {half, job.track.length() - half};
  for (const std::vector<DeckRow>& layer : rows) {
    for (std::size_t i = 1; i < layer.size(); ++i) {
      places.push_back(std::clamp(layer[i].span.from, half, job.track.length() - half));
    }
  }
  std::sort(places.begin(), places.end());
  std::vector<double> apart;
  for (const double place : places) {
    if (apart.empty() || place - apart.back() > 1.5 * job.member_width()) apart.push_back(place);
  }
  // The last one keeps the end.
  apart.back() = job.track.length() - half;
  return apart;
}

/// Where a cross member or template lies: as high as it can without reaching into what it carries.
CrossMember member_at(const TimberJob& job, double s) {
  std::vector<double> heights = {-job.channel.thickness};
  if (job.channel.trough) {
    for (const Vec2 corner : job.channel.trough->seat) heights.push_back(corner.y);
  }
  CrossMember member{s, 0.0, 0.0};
  double sinks = 0.0;
  for (const double middle : heights) {
    for (const double along : {-0.5, -0.25, 0.25, 0.5}) {
      const double height = height_over(job.track, s, along * job.member_width(), middle);
      sinks = std::max(sinks, middle - height);
      member.sagitta = std::max(member.sagitta, std::fabs(height - middle));
    }
  }
  member.top = -job.channel.thickness - sinks;
  return member;
}

/// Templates stand side by side up to their tops in a hollow, down to their feet on a crest.
void require_room(const TimberJob& job, const std::vector<CrossMember>& members) {
  if (!job.channel.trough) return;
  const double width = job.member_width();
  for (std::size_t i = 0; i + 1 < members.size(); ++i) {
    const CrossMember& member = members[i];
    const TrackFrame here = frame_at(job.track, member.at);
    const TrackFrame next = frame_at(job.track, members[i + 1].at);
    const double low = member.top - job.options.cross_members.height;
    for (const double height : {job.channel.trough->seat.front().y, low}) {
      const double apart = dot(next.at + height * next.up - here.at - height * here.up, here.along);
      if (apart >= 1.05 * width) continue;
      throw InputError(
          {"cross_members.spacing",
           "templates stand " + length_text(std::max(0.0, apart), 3) + " apart at their " +
               (height > 0.0 ? "tops " : "feet ") + length_text(member.at, 3) + " along the track",
           "They are square to the track, " + length_text(width) + " thick, and " +
               length_text(members[i + 1].at - member.at, 3) +
               " apart on the floor; one stands below every seam.",
           height > 0.0 ? "a limit smallest_valley_radius, cross_members.reach below the rim, or thinner ones"
                        : "cross_members of less height, or thinner ones"});
    }
  }
}

bool piece_fits(const TimberJob& job, const Span& span) {
  const auto outline = band(job.track, span, job.bearer_bottom(), job.bearer_top());
  if (!outline) return false;
  const PlaneBox box = bounds(moved(*outline, PlaneMotion::turn(-chord_angle(job, span))));
  const TimberSplit& split = job.options.split;
  const StockMaterial& stock =
      job.options.frame == TimberFrame::ribs ? job.options.material : job.options.lumber;
  const double area = glissade::moments(PlaneRegion{*outline, {}, {}}).area;
  if (split.heaviest && area * job.options.bearer_width() * stock.density > *split.heaviest) return false;
  if (job.options.frame == TimberFrame::beams) return std::max(box.width(), box.height()) <= split.longest;
  const auto [longer, shorter] = split.sawn().room();
  return std::max(box.width(), box.height()) <= longer && std::min(box.width(), box.height()) <= shorter;
}

bool all_fit(const TimberJob& job, const std::vector<double>& joints) {
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    if (!piece_fits(job, {joints[i], joints[i + 1]})) return false;
  }
  return true;
}

std::vector<double> half_shifted(const std::vector<double>& joints) {
  std::vector<double> shifted = {joints.front()};
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) shifted.push_back(0.5 * (joints[i] + joints[i + 1]));
  shifted.push_back(joints.back());
  return shifted;
}

/// The point of a line below the track at a given x; none where the track does not pass it.
std::optional<double> place_below(const ArcSpline& track, double height, double x) {
  const auto run = [&](double s) {
    const TrackFrame at = frame_at(track, s);
    return at.at.x + height * at.up.x;
  };
  double low = 0.0;
  double high = track.length();
  if (!(run(low) <= x && run(high) >= x)) return std::nullopt;
  for (int round = 0; round < 80; ++round) {
    const double middle = 0.5 * (low + high);
    (run(middle) <= x ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Leg below a point of the underside; its slanted end below the bearer throughout.
Leg leg_below(const TimberJob& job, double s) {
  const double height = job.bearer_bottom();
  const TrackFrame at = frame_at(job.track, s);
  const Vec2 point = at.at + height * at.up;
  const double half = 0.5 * job.options.legs->side;
  Leg leg;
  leg.at = s;
  leg.x = point.x;
  // A level foot touches the highest of it; what a slope leaves below is the footing's.
  leg.ground = highest_ground(job.options.legs->ground, point.x - half, point.x + half);
  const double slope = at.along.y / at.along.x;
  // The line touches the underside in a hollow; on a crest it lies as far below as that bends away.
  double below = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const auto place = place_below(job.track, height, point.x + side * half);
    if (!place) continue;
    const TrackFrame there = frame_at(job.track, *place);
    const double level = there.at.y + height * there.up.y;
    below = std::max(below, point.y + side * half * slope - level);
  }
  leg.top_left = {point.x - half, point.y - half * slope - below};
  leg.top_right = {point.x + half, point.y + half * slope - below};
  return leg;
}

/// Length of a sheet of the deck: that of the stock, or what its mass allows.
double sheet_length(const TimberJob& job) {
  const auto& boards = job.options.deck.boards;
  const double stock = boards ? boards->length : job.options.split.stock().room().x;
  if (!job.options.split.heaviest) return stock;
  const double per_metre = job.layer() * job.strip_width() * job.deck_material().density;
  const double allowed = *job.options.split.heaviest / per_metre;
  const double least = 2.0 * kStagger;
  if (allowed >= std::min(least, stock)) return std::min(stock, allowed);
  throw InputError({"split.heaviest",
                    "heaviest: " + rounded_text(*job.options.split.heaviest, 4) +
                        " kg is a sheet of the deck of " + length_text(allowed, 3) + " x " +
                        length_text(job.strip_width(), 3),
                    "One of " + length_text(least) + ", whose seams are apart from those below, has " +
                        rounded_text(least * per_metre, 3) + " kg.",
                    "a larger mass, more layers, or a narrower sheet"});
}

}  // namespace

int TimberJob::strips() const {
  if (const auto& boards = options.deck.boards) {
    const double count = std::ceil((channel.overall() + boards->gap) / (boards->width + boards->gap) - 1e-9);
    return std::max(1, static_cast<int>(count));
  }
  const double sheet = options.split.stock().room().y;
  return std::max(1, static_cast<int>(std::ceil(channel.overall() / sheet - 1e-9)));
}

std::vector<double> seams_of_set(const TimberJob& job, const std::vector<std::vector<DeckRow>>& done,
                                 const std::function<double(double from, double share)>& end_of) {
  const std::size_t per_layer = job.sets_per_layer();
  const std::size_t sets = per_layer * static_cast<std::size_t>(job.options.deck.layers);
  const double length = job.track.length();
  // Seams of a set are a share of a sheet from those of the one before.
  double share = 1.0 - static_cast<double>(done.size()) / static_cast<double>(sets);
  OtherSeams others{{}, {}, 1.5 * job.member_width() + 1e-6};
  for (std::size_t set = 0; set < done.size(); ++set) {
    const bool beside = set + 1 == done.size() || set + per_layer == done.size();
    for (std::size_t i = 1; i < done[set].size(); ++i)
      (beside ? others.beside : others.apart).push_back(done[set][i].span.from);
  }
  std::vector<double> seams = {0.0};
  double longest = 0.0;
  while (seams.back() < length) {
    const double end = end_of(seams.back(), share);
    longest = std::max(longest, end - seams.back());
    seams.push_back(end < length ? others.last_allowed(seams.back(), end) : end);
    share = 1.0;
  }
  keep_apart(seams, longest, others);
  return seams;
}

std::vector<std::vector<DeckRow>> deck_rows(const TimberJob& job) {
  const double sheet = sheet_length(job);
  const std::size_t per_layer = job.sets_per_layer();
  const std::size_t sets = per_layer * static_cast<std::size_t>(job.options.deck.layers);
  std::vector<std::vector<DeckRow>> all;
  for (std::size_t set = 0; set < sets; ++set) {
    const std::size_t depth = set / per_layer;
    const std::vector<double> seams = seams_of_set(
        job, all, [&](double from, double share) { return end_of_sheet(job, depth, from, share * sheet); });
    std::vector<DeckRow> rows;
    for (std::size_t i = 0; i + 1 < seams.size(); ++i) {
      rows.push_back({{seams[i], seams[i + 1]}, flat_length_of(job, depth, seams[i], seams[i + 1])});
    }
    all.push_back(std::move(rows));
  }
  return all;
}

std::vector<CrossMember> cross_members(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows) {
  const CrossMemberOptions& options = job.options.cross_members;
  const std::vector<double> supported = supported_places(job, rows);
  std::vector<double> places;
  for (std::size_t i = 0; i + 1 < supported.size(); ++i) {
    const double room = supported[i + 1] - supported[i];
    const int count = std::max(1, static_cast<int>(std::ceil(room / options.spacing - 1e-9)));
    for (int k = 0; k < count; ++k) places.push_back(supported[i] + room * k / count);
  }
  places.push_back(supported.back());
  std::vector<CrossMember> members;
  const double width = job.member_width();
  for (const double s : places) {
    const CrossMember member = member_at(job, s);
    if (member.sagitta > job.options.fit) {
      throw InputError({"cross_members.width",
                        "width: " + std::string(job.channel.trough ? "templates" : "cross members") + " of " +
                            length_text(width) + " leave gaps of " + length_text(member.sagitta, 3) + " at " +
                            length_text(s) + " along the track",
                        "The track bends there with a radius of " +
                            length_text(std::fabs(1.0 / job.track.at(s).curvature), 3) + "; the fit is " +
                            length_text(job.options.fit) + ".",
                        std::string(job.channel.trough ? "thinner templates" : "narrower cross members") +
                            ", a larger fit, or a limit on the track's radius"});
    }
    members.push_back(member);
  }
  require_room(job, members);
  return members;
}

BearerPlan plan_bearers(const TimberJob& job) {
  const BearerOptions& options = job.options.bearers;
  BearerPlan plan;
  const double outer = job.channel.overall() - job.options.bearer_width();
  const int by_spacing = static_cast<int>(std::ceil(outer / options.spacing - 1e-9)) + 1;
  const int count = options.count.value_or(std::max(2, by_spacing));
  for (int i = 0; i < count; ++i) plan.across.push_back(0.5 * outer - outer * i / std::max(1, count - 1));
  for (std::size_t pieces = 1; pieces <= kMostPieces; ++pieces) {
    const double even = job.track.length() / static_cast<double>(pieces);
    for (const double room : {0.1 * even, 0.0}) {
      plan.joints = calm_joints(job.track, pieces, room);
      plan.shifted = pieces > 1 ? half_shifted(plan.joints) : plan.joints;
      if (all_fit(job, plan.joints) && all_fit(job, plan.shifted)) return plan;
    }
  }
  const TimberSplit& split = job.options.split;
  throw InputError(
      {"bearers.depth", "depth: bearers of " + length_text(job.options.bearer_depth()) + " fit no stock",
       job.options.frame == TimberFrame::ribs
           ? "A sheet is " + length_text(split.sheet.x) + " x " + length_text(split.sheet.y) + "."
           : "The longest beam is " + length_text(split.longest) + ".",
       "a smaller depth, a larger sheet, or frame: beams"});
}

namespace {

/// Rows of legs that are asked for and not made, by their places along the run.
struct LeftOut {
  std::vector<double> no_place;
  std::vector<double> on_ground;
  int asked = 0;
};

std::string places_text(const std::vector<double>& places) {
  constexpr std::size_t kTold = 6;  // taste
  std::vector<std::string> words;
  for (std::size_t i = 0; i < places.size() && i < kTold; ++i) words.push_back(length_text(places[i], 3));
  if (places.size() > kTold) words.push_back(std::to_string(places.size() - kTold) + " more");
  return listed(words);
}

void tell_left_out(const LeftOut& rows, Workshop& workshop) {
  if (!rows.on_ground.empty()) {
    workshop.notes.push_back("No legs at " + places_text(rows.on_ground) +
                             " from the start along the run: bearers lie on the ground there, or less than " +
                             length_text(kLeastPost) + " above it.");
  }
  if (rows.no_place.empty()) return;
  add_shortfall({"legs",
                 "legs: " + std::to_string(rows.no_place.size()) + " of " + std::to_string(rows.asked) +
                     " rows " + (rows.no_place.size() == 1 ? "finds" : "find") + " no place, at " +
                     places_text(rows.no_place) + " from the start along the run",
                 "None stands below bearers steeper than " + angle_text(Angle::from_radians(kSteepest), 3) +
                     ": it would carry nothing.",
                 "a track that is less steep there, or a support of your own"},
                workshop);
}

}  // namespace

std::vector<Leg> plan_legs(const TimberJob& job, Workshop& workshop) {
  std::vector<Leg> legs;
  if (!job.options.legs) return legs;
  const double half = 0.5 * job.options.legs->side;
  const double height = job.bearer_bottom();
  const auto run = [&](double s) {
    const TrackFrame at = frame_at(job.track, s);
    return at.at.x + height * at.up.x;
  };
  const double from = run(0.0) + half + 1e-3;
  const double to = run(job.track.length()) - half - 1e-3;
  if (!(to > from)) {
    add_shortfall({"legs", "legs: none finds room",
                   "The underside of the bearers is " + length_text(to - from + 2.0 * half, 3) +
                       " long along the run, a leg " + length_text(job.options.legs->side) + ".",
                   "thinner legs (side), or none"},
                  workshop);
    return legs;
  }
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / job.options.legs->spacing)));
  std::vector<Issue> issues;
  std::vector<Foot> feet;
  LeftOut left_out;
  left_out.asked = steps + 1;
  for (int k = 0; k <= steps; ++k) {
    const double x = from + (to - from) * k / steps;
    const auto place = place_below(job.track, height, x);
    if (!place || std::fabs(job.track.at(*place).slope_angle) > kSteepest) {
      left_out.no_place.push_back(x);
      continue;
    }
    const Leg leg = leg_below(job, *place);
    feet.push_back({leg.x, frame_at(job.track, leg.at).at.x});
    if (leg.length() < -kLeastPost) {
      issues.push_back({"legs.ground",
                        "ground: it lies " + length_text(-leg.length(), 3) +
                            " above the underside of the bearers, " + length_text(leg.x) + " from the start",
                        "They reach " + length_text(-height, 3) + " below the floor.",
                        "a lower ground there, or bearers of less depth"});
    }
    if (std::min(leg.top_left.y, leg.top_right.y) - leg.ground >= kLeastPost)
      legs.push_back(leg);
    else
      left_out.on_ground.push_back(x);
  }
  require_on_ground(job.options.legs->ground, feet, "legs.ground", "a leg");
  if (!issues.empty()) throw InputError(std::move(issues));
  tell_left_out(left_out, workshop);
  return legs;
}

double chord_angle(const TimberJob& job, const Span& span) {
  const Vec2 chord = frame_at(job.track, span.to).at - frame_at(job.track, span.from).at;
  return math::atan2(chord.y, chord.x);
}

ShopPart upright_part(const TimberJob& job, const ArcPath& outline, double angle, double depth,
                      const std::vector<double>& middles, const StockMaterial& material) {
  const Vec2 low = bounds(moved(outline, PlaneMotion::turn(-angle))).low;
  const Vec2 origin = PlaneMotion::turn(angle)(low);
  ShopPart part;
  part.material = material.name;
  part.density = material.density;
  part.thickness = depth;
  part.body = Prism{{moved(outline, PlaneMotion::turn(-angle, -1.0 * low)), {}, {}}, depth};
  for (const double middle : middles) {
    part.places.push_back(plane_of_track(job.placement, origin, angle, -middle - 0.5 * depth));
  }
  weigh(part);
  return part;
}

}  // namespace glissade::parts
