// Two figures are laid upon each other by their first corner and the one farthest from it, onto every corner of the other in
// turn; then everything else has to lie where it should.

#include "parts/shop/equal_parts.hpp"

#include "parts/bodies/angle_bar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kSameAngle = 1e-6;  // of bends and tilts [rad]
constexpr double kSameRatio = 1e-6;  // of radii and volumes

bool near(double a, double b) {
  return std::fabs(a - b) <= kSamePart;
}
bool near(Vec2 a, Vec2 b) {
  return norm(a - b) <= kSamePart;
}
bool near(Angle a, Angle b) {
  return std::fabs(a.radians() - b.radians()) <= kSameAngle;
}
bool in_ratio(double a, double b) {
  return a == b || std::fabs(a - b) <= kSameRatio * std::max(std::fabs(a), std::fabs(b));
}

using Accepts = std::function<bool(const PlaneMotion&)>;

/// Corners of a path with its pieces, from any corner on and either way round.
class Walk {
 public:
  Walk(const ArcPath& path, std::size_t first, bool backward)
      : path_(path), first_(first), backward_(backward) {}

  [[nodiscard]] std::size_t index(std::size_t i) const {
    const std::size_t n = path_.vertices.size();
    return (backward_ ? first_ + n - i : first_ + i) % n;
  }
  [[nodiscard]] Vec2 corner(std::size_t i) const { return path_.vertices[index(i)].at; }
  /// The bulge of the piece after a corner.
  [[nodiscard]] double bulge(std::size_t i) const {
    return backward_ ? -path_.vertices[index(i + 1)].bulge : path_.vertices[index(i)].bulge;
  }

 private:
  const ArcPath& path_;
  std::size_t first_;
  bool backward_;
};

/// Whether a motion brings a path onto a walk along another one.
bool lies_on(const ArcPath& path, const Walk& walk, const PlaneMotion& motion) {
  const std::size_t count = path.vertices.size();
  const double sense = motion.mirrored ? -1.0 : 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!near(motion(path.vertices[i].at), walk.corner(i))) return false;
    if (!path.closed && i + 1 == count) break;
    // Bulges, as distances at the middle of the piece.
    const double chord = norm(path.vertices[(i + 1) % count].at - path.vertices[i].at);
    if (!near(0.5 * chord * sense * path.vertices[i].bulge, 0.5 * chord * walk.bulge(i))) return false;
  }
  return true;
}

/// The motion that brings two points onto two others, as well as they fit.
PlaneMotion onto(Vec2 from, Vec2 to, Vec2 new_from, Vec2 new_to, bool mirrored) {
  const auto seen = [&](Vec2 point) { return Vec2{point.x, mirrored ? -point.y : point.y}; };
  const Vec2 old_way = seen(to) - seen(from);
  const Vec2 new_way = new_to - new_from;
  const double scale = 1.0 / (norm(old_way) * norm(new_way));
  PlaneMotion motion;
  motion.mirrored = mirrored;
  motion.cosine = scale * dot(old_way, new_way);
  motion.sine = scale * cross(old_way, new_way);
  const double unit = std::sqrt(motion.cosine * motion.cosine + motion.sine * motion.sine);
  motion.cosine /= unit;
  motion.sine /= unit;
  motion.shift = 0.5 * (new_from + new_to) - motion(0.5 * (from + to));
  return motion;
}

std::size_t farthest_from_first(const ArcPath& path) {
  std::size_t far = 0;
  const auto away = [&](std::size_t i) { return norm(path.vertices[i].at - path.vertices.front().at); };
  for (std::size_t i = 1; i < path.vertices.size(); ++i) {
    if (away(i) > away(far)) far = i;
  }
  return far;
}

/// @return the first motion that brings a path onto another one and is accepted
std::optional<PlaneMotion> path_motion(const ArcPath& path, const ArcPath& other, bool mirrored,
                                       const Accepts& accepts) {
  const std::size_t count = path.vertices.size();
  if (path.closed != other.closed || count != other.vertices.size() || count < 2) return std::nullopt;
  if (!mirrored && path == other && accepts({})) return PlaneMotion();
  const std::size_t far = farthest_from_first(path);
  const double size = norm(path.vertices[far].at - path.vertices.front().at);
  if (!(size > 0.0)) return std::nullopt;
  for (const bool backward : {false, true}) {
    for (std::size_t first = 0; first < count; ++first) {
      // An open path has two ends.
      if (!path.closed && first != (backward ? count - 1 : 0)) continue;
      const Walk walk(other, first, backward);
      if (std::fabs(norm(walk.corner(far) - walk.corner(0)) - size) > 2.0 * kSamePart) continue;
      const PlaneMotion motion =
          onto(path.vertices.front().at, path.vertices[far].at, walk.corner(0), walk.corner(far), mirrored);
      if (lies_on(path, walk, motion) && accepts(motion)) return motion;
    }
  }
  return std::nullopt;
}

/// Whether each of some figures lies on one of others, none of which is taken twice.
template <typename Figure, typename Same>
bool all_found(const std::vector<Figure>& figures, const std::vector<Figure>& others, Same same) {
  if (figures.size() != others.size()) return false;
  std::vector<bool> taken(others.size(), false);
  for (const Figure& figure : figures) {
    std::size_t i = 0;
    while (i < others.size() && (taken[i] || !same(figure, others[i]))) ++i;
    if (i == others.size()) return false;
    taken[i] = true;
  }
  return true;
}

bool same_cutouts(const PlaneRegion& region, const PlaneRegion& other, const PlaneMotion& motion) {
  const auto lies = [&](const ArcPath& cutout, const ArcPath& there) {
    if (cutout.vertices.size() != there.vertices.size()) return false;
    for (const bool backward : {false, true}) {
      for (std::size_t first = 0; first < there.vertices.size(); ++first) {
        if (lies_on(cutout, Walk(there, first, backward), motion)) return true;
      }
    }
    return false;
  };
  return all_found(region.cutouts, other.cutouts, lies) &&
         all_found(region.holes, other.holes, [&](const Circle& hole, const Circle& there) {
           return near(motion(hole.centre), there.centre) && near(hole.radius, there.radius);
         });
}

std::optional<PlaneMotion> region_motion(const PlaneRegion& region, const PlaneRegion& other, bool mirrored,
                                         const Accepts& accepts) {
  if (region.cutouts.size() != other.cutouts.size() || region.holes.size() != other.holes.size())
    return std::nullopt;
  return path_motion(region.outline, other.outline, mirrored, [&](const PlaneMotion& motion) {
    return same_cutouts(region, other, motion) && accepts(motion);
  });
}

bool turns_half_round(const PlaneMotion& motion) {
  return motion.cosine < 0.0;
}

bool same_lines(Vec2 from, Vec2 to, Vec2 other_from, Vec2 other_to) {
  return (near(from, other_from) && near(to, other_to)) || (near(from, other_to) && near(to, other_from));
}

/// What is bent, rolled or marked, as a pattern's region moves.
bool same_work(const FlatPattern& pattern, const FlatPattern& other, const PlaneMotion& motion) {
  const bool bends = all_found(pattern.bends, other.bends, [&](const BendLine& bend, const BendLine& there) {
    return same_lines(motion(bend.from), motion(bend.to), there.from, there.to) &&
           near(bend.angle, there.angle) && near(bend.inner_radius, there.inner_radius) &&
           bend.up == there.up;
  });
  const auto rolled = [&](const RollLine& roll, const RollLine& there) {
    // A line is where a radius begins; of one that holds all along it does not matter which end that is.
    const bool at = same_lines(motion(roll.from), motion(roll.to), there.from, there.to);
    return (at || pattern.rolls.size() == 1) && in_ratio(roll.radius, there.radius);
  };
  if (turns_half_round(motion) && pattern.rolls.size() > 1) return false;
  if (!bends || !all_found(pattern.rolls, other.rolls, rolled)) return false;
  return all_found(pattern.marks, other.marks, [&](const ArcPath& mark, const ArcPath& there) {
    return mark.vertices.size() == there.vertices.size() && lies_on(mark, Walk(there, 0, false), motion);
  });
}

bool stays_flat(const ShopPart& part) {
  const auto* const prism = std::get_if<Prism>(&part.body);
  return prism != nullptr && part.pattern && part.pattern->bends.empty() && part.pattern->rolls.empty() &&
         part.pattern->marks.empty() && prism->region.outline == part.pattern->region.outline;
}

/// A motion of a body's plane, as one of the body: a mirrored one turns it over.
/// @param low  where z = 0 comes to lie
Frame frame_in_space(const PlaneMotion& motion, double low) {
  const auto way = [&](Vec2 unit) { return motion(unit) - motion.shift; };
  const Vec2 x = way({1.0, 0.0});
  const Vec2 y = way({0.0, 1.0});
  return {{motion.shift.x, motion.shift.y, low},
          {x.x, x.y, 0.0},
          {y.x, y.y, 0.0},
          {0.0, 0.0, motion.mirrored ? -1.0 : 1.0}};
}

/// A part's name without the numbers of its unit.
std::string family_of(const ShopPart& part) {
  return part.name.substr(0, part.name.find_last_not_of("_0123456789") + 1);
}

/// Where a body lies in another one's frame, turned end for end or not.
using BodyPlace = std::optional<Frame>;

BodyPlace place_of(const Prism& body, const Prism& other, bool end_for_end) {
  if (!near(body.depth, other.depth)) return std::nullopt;
  const auto motion =
      region_motion(body.region, other.region, end_for_end, [](const PlaneMotion&) { return true; });
  if (!motion) return std::nullopt;
  return frame_in_space(*motion, end_for_end ? body.depth : 0.0);
}

/// The least and the greatest of what lies across.
std::pair<double, double> breadth(const ArcPath& outline) {
  const PlaneBox box = bounds(outline);
  return {box.low.y, box.high.y};
}

bool same_bevels(const RolledSheet& body, const RolledSheet& other) {
  return std::equal(body.bevels.begin(), body.bevels.end(), other.bevels.begin(), other.bevels.end(),
                    [](const Bevel& one, const Bevel& there) {
                      return near(one.at, there.at) && near(one.below, there.below);
                    });
}

BodyPlace place_of(const RolledSheet& body, const RolledSheet& other, bool end_for_end) {
  if (!near(body.thickness, other.thickness) || !near(body.foot, other.foot) ||
      !near(body.across, other.across) || !same_bevels(body, other) ||
      !near(body.tilts[end_for_end ? 1 : 0], other.tilts[0]) ||
      !near(body.tilts[end_for_end ? 0 : 1], other.tilts[1]))
    return std::nullopt;
  // Ones that lean, or have another path, are not turned.
  if (end_for_end && (!body.bevels.empty() || body.foot.y != 0.0 || body.across.x != 0.0))
    return std::nullopt;
  const auto path = path_motion(body.path, other.path, end_for_end, [&](const PlaneMotion& motion) {
    // Forward as it is, backward end for end: its upper side stays above.
    return near(motion((end_for_end ? body.path.vertices.back() : body.path.vertices.front()).at),
                other.path.vertices.front().at);
  });
  if (!path) return std::nullopt;
  const auto [low, high] = breadth(body.region.outline);
  const auto [other_low, other_high] = breadth(other.region.outline);
  PlaneMotion sheet;
  if (end_for_end) sheet = PlaneMotion::turn(std::numbers::pi, {length(body.path), other_low + high});
  if (!near(high - low, other_high - other_low) ||
      !region_motion(body.region, other.region, false, [&](const PlaneMotion& motion) {
        return near(motion({}), sheet({})) && turns_half_round(motion) == end_for_end;
      }))
    return std::nullopt;
  return frame_in_space(*path, end_for_end ? other_low + high : 0.0);
}

BodyPlace place_of(const SweptBody& body, const SweptBody& other, bool end_for_end) {
  const std::size_t corners = body.section.size();
  const std::size_t stations = body.shifts.size();
  if (corners != other.section.size() || stations != other.shifts.size()) return std::nullopt;
  // Of drilled ones, only the same as it is.
  const bool drilled_alike = all_found(body.holes, other.holes, [](const Circle& hole, const Circle& there) {
    return near(hole.centre, there.centre) && near(hole.radius, there.radius);
  });
  const bool cut_alike =
      std::equal(body.windows.begin(), body.windows.end(), other.windows.begin(), other.windows.end(),
                 [](const SweptWindow& window, const SweptWindow& there) {
                   return near(window.from, there.from) && near(window.to, there.to) &&
                          near(window.low, there.low) && near(window.high, there.high);
                 });
  const bool plain = body.holes.empty() && body.windows.empty();
  if (!drilled_alike || !cut_alike || (end_for_end && !plain)) return std::nullopt;
  const auto path = path_motion(body.path, other.path, end_for_end, [&](const PlaneMotion& motion) {
    return near(motion((end_for_end ? body.path.vertices.back() : body.path.vertices.front()).at),
                other.path.vertices.front().at);
  });
  if (!path) return std::nullopt;
  // Corner by corner from one that fits; what lies across is turned with a body that is turned end for end.
  const double sense = end_for_end ? -1.0 : 1.0;
  for (std::size_t first = 0; first < corners; ++first) {
    const auto there = [&](std::size_t j) {
      return (end_for_end ? first + corners - j : first + j) % corners;
    };
    const double shift = other.section[there(0)].y - sense * body.section[0].y;
    const auto moved_across = [&](std::size_t station, std::size_t j) {
      return stations == 0 ? 0.0 : body.shifts[station][j];
    };
    bool same = true;
    for (std::size_t j = 0; j < corners && same; ++j) {
      const Vec2 at = body.section[j];
      same = near({at.x, sense * at.y + shift}, other.section[there(j)]);
      for (std::size_t i = 0; i < stations && same; ++i) {
        const double beyond = other.shifts[end_for_end ? stations - 1 - i : i][there(j)];
        same = near(sense * moved_across(i, j), beyond);
      }
    }
    if (same) return frame_in_space(*path, shift);
  }
  return std::nullopt;
}

/// By three corners far from one another; every corner has to lie on one of the other's.
BodyPlace place_of(const FoldedPlate& body, const FoldedPlate& other, bool end_for_end) {
  const std::size_t rings = body.corners.size();
  if (rings != other.corners.size()) return std::nullopt;
  const auto there = [&](std::size_t i) -> const std::array<Vec3, 4>& {
    return other.corners[end_for_end ? rings - 1 - i : i];
  };
  for (std::size_t turn = 0; turn < 4; ++turn) {
    // Seen from its other end the corners of a plate run the other way round.
    const auto index = [&](std::size_t j) { return (end_for_end ? turn + 4 - j : turn + j) % 4; };
    const auto basis = [](Vec3 along, Vec3 across) {
      const Vec3 x = (1.0 / norm(along)) * along;
      const Vec3 side = across - dot(across, x) * x;
      const Vec3 y = (1.0 / norm(side)) * side;
      return Frame{{}, x, y, cross(x, y)};
    };
    const Frame here =
        basis(body.corners.back()[0] - body.corners[0][0], body.corners[0][1] - body.corners[0][0]);
    const Frame new_one =
        basis(there(rings - 1)[index(0)] - there(0)[index(0)], there(0)[index(1)] - there(0)[index(0)]);
    const auto turned = [&](Vec3 v) {
      return dot(v, here.x) * new_one.x + dot(v, here.y) * new_one.y + dot(v, here.z) * new_one.z;
    };
    Frame place{{}, turned({1.0, 0.0, 0.0}), turned({0.0, 1.0, 0.0}), turned({0.0, 0.0, 1.0})};
    place.origin = there(0)[index(0)] - turned(body.corners[0][0]);
    bool same = true;
    for (std::size_t i = 0; i < rings && same; ++i) {
      for (std::size_t j = 0; j < 4 && same; ++j)
        same = norm(place.to_space(body.corners[i][j]) - there(i)[index(j)]) <= kSamePart;
    }
    if (same) return place;
  }
  return std::nullopt;
}

/// Gores: z turns to -z + length about x.
template <typename Gore>
BodyPlace place_of_gore(const Gore& body, const Gore& other, bool end_for_end) {
  if (!near(body.inner_radius, other.inner_radius) || !near(body.thickness, other.thickness) ||
      !near(body.length, other.length))
    return std::nullopt;
  const auto turned = [](Angle tilt) { return Angle::from_radians(-tilt.radians()); };
  const Angle start = end_for_end ? turned(body.end_tilt) : body.start_tilt;
  const Angle end = end_for_end ? turned(body.start_tilt) : body.end_tilt;
  if (!near(start, other.start_tilt) || !near(end, other.end_tilt)) return std::nullopt;
  if (!end_for_end) return Frame{};
  return Frame{{0.0, 0.0, body.length}, {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}};
}

BodyPlace place_of(const TubeGore& body, const TubeGore& other, bool end_for_end) {
  // With an opening, only as it is.
  const bool whole = body.windows.empty() && body.holes.empty();
  if (body.windows != other.windows || body.holes != other.holes || (end_for_end && !whole))
    return std::nullopt;
  return place_of_gore(body, other, end_for_end);
}

BodyPlace place_of(const TroughGore& body, const TroughGore& other, bool end_for_end) {
  const bool whole = body.windows.empty() && body.holes.empty();
  if (!near(body.side, other.side) || body.windows != other.windows || body.holes != other.holes ||
      (end_for_end && !whole))
    return std::nullopt;
  return place_of_gore(body, other, end_for_end);
}

BodyPlace place_of(const AngleBar& body, const AngleBar& other, bool /*end_for_end*/) {
  if (!near(body.thickness, other.thickness) || !near(body.height, other.height)) return std::nullopt;
  const PlaneRegion rising = rising_leg(body);
  const PlaneRegion there = rising_leg(other);
  const auto motion = region_motion(lying_leg(body), lying_leg(other), false, [&](const PlaneMotion& way) {
    return same_cutouts({{}, {rising.outline}, {}}, {{}, {there.outline}, {}}, way) &&
           same_cutouts(rising, there, way);
  });
  if (!motion) return std::nullopt;
  return frame_in_space(*motion, 0.0);
}

BodyPlace place_of(const MeshBody& /*body*/, const MeshBody& /*other*/, bool end_for_end) {
  if (end_for_end) return std::nullopt;
  return Frame{};
}

BodyPlace place_of(const PartBody& body, const PartBody& other, bool end_for_end) {
  if (body.index() != other.index()) return std::nullopt;
  return std::visit(
      [&](const auto& one) {
        return place_of(one, std::get<std::decay_t<decltype(one)>>(other), end_for_end);
      },
      body);
}

}  // namespace

bool mirror_images(const ShopPart& part, const ShopPart& other) {
  if (part.thickness != other.thickness || part.material != other.material ||
      !in_ratio(part.volume, other.volume) || !part.pattern || !other.pattern)
    return false;
  // Turned over, an angle has its other leg on the wrong side.
  if (std::holds_alternative<AngleBar>(part.body)) return false;
  return region_motion(part.pattern->region, other.pattern->region, true,
                       [](const PlaneMotion&) { return true; })
      .has_value();
}

Frame placed(const Frame& outer, const Frame& inner) {
  const auto way = [&](Vec3 v) { return v.x * outer.x + v.y * outer.y + v.z * outer.z; };
  return {outer.to_space(inner.origin), way(inner.x), way(inner.y), way(inner.z)};
}

std::optional<Frame> place_in(const ShopPart& part, const ShopPart& other) {
  if (part.thickness != other.thickness || part.material != other.material || part.density != other.density ||
      part.bought_in != other.bought_in || part.stands != other.stands ||
      !in_ratio(part.volume, other.volume) || part.pattern.has_value() != other.pattern.has_value())
    return std::nullopt;
  if (!part.pattern) {
    if (family_of(part) != family_of(other)) return std::nullopt;
    return place_of(part.body, other.body, false);
  }
  if (stays_flat(part) && stays_flat(other)) {
    for (const bool over : {false, true}) {
      if (const auto place = place_of(part.body, other.body, over)) return place;
    }
    return std::nullopt;
  }
  for (const bool end_for_end : {false, true}) {
    const auto pattern =
        region_motion(part.pattern->region, other.pattern->region, false, [&](const PlaneMotion& motion) {
          return turns_half_round(motion) == end_for_end && same_work(*part.pattern, *other.pattern, motion);
        });
    if (!pattern) continue;
    if (const auto place = place_of(part.body, other.body, end_for_end)) return place;
  }
  return std::nullopt;
}

}  // namespace glissade::parts
