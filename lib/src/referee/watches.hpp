#pragma once

#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/motion.hpp"

#include "clearance/strip.hpp"
#include "referee/judgement.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::referee {

/// Keeps the worst value of one limit while the track is sampled, and that of each stretch that breaks it.
class Watch {
 public:
  Watch(const LimitName& limit, double bound, double scale)
      : check_{limit, bound, 0.0, 0.0, scale, 0.0, {}} {}

  void see(double value, double where, std::optional<FrictionLevel> friction = {},
           const std::optional<EnvelopePlace>& closest = {});
  /// The body leaves the track, which a lowest load is to prevent.
  void see_lift_off() { check_.leaves_track = true; }
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] const LimitCheck& check() const { return check_; }
  [[nodiscard]] const std::vector<Broken>& broken() const { return broken_; }

 private:
  [[nodiscard]] double excess_of(double value) const;
  void see_broken(double violation, double where);

  LimitCheck check_;
  std::vector<Broken> broken_;
  bool breaking_ = false;
  double last_ = 0.0;
  bool seen_ = false;
  double worst_ = 0.0;
};

/// All watches of a problem, and how to feed them.
class Watches {
 public:
  /// What limits are held against wherever the body rides: normal load, load by curvature, speed, depth, wear of the floor.
  using Measures = std::array<double, 5>;
  static constexpr std::size_t kFirstOfLaw = 3;  // Measures: depth and wear are a law's

  /// @param chord  from the start of the track to its finish [m]
  Watches(const Problem& problem, double chord);

  void at_point(const CenterlinePoint& point);
  /// Clearances of the centerline, or of the solid and of what slides on it, wherever along the track they are the least.
  /// @param points  of the track, its breaks among them
  void at_obstacles(const Centerline& track, const std::vector<CenterlinePoint>& points);
  /// `curvature` and `load` count on each side of a joint.
  void at_curvature(double s, double curvature);
  void at_rate(double s, double rate);
  /// What is seen from here on is of the ride at this friction, or of none.
  void ride_at(std::optional<FrictionLevel> level, Friction friction = {});
  /// @return at the friction of the ride; 0 for what a problem has not
  [[nodiscard]] Measures measures(const MotionState& state, const CenterlinePoint& point) const;
  void at_measures(const Measures& measures, double s);
  void at_exit_speed(double exit_speed, const CenterlinePoint& end);
  /// The body comes to a stand there, before the finish, and gets no farther.
  void at_stall(double s);
  /// The body leaves the track before the finish: it has no load from there on, whatever the least was until then.
  void at_lift_off();
  void at_end(const Centerline& track);
  /// @param in,out  lengths of the straights that the track starts and ends with
  void at_leads(double in, double out, double length);
  /// How far the body comes at a friction that is not the nominal one.
  void at_arrival(LimitId limit, double distance, double length);
  void near(std::size_t waypoint, double distance, double s);

  [[nodiscard]] std::vector<Broken> broken() const;
  [[nodiscard]] std::vector<LimitCheck> checks() const;

 private:
  /// Holds a value against whatever the limit asks for, if anything.
  void see(LimitId id, double value, double s);
  void see_range(LimitId id, const Range& range, double value, double s);
  void see_item(LimitId id, std::size_t index, double bound, double value, double s);
  void see_side(const LimitName& limit, double bound, double value, double s);
  /// What a violation is measured against.
  [[nodiscard]] double scale_of(const LimitName& limit, double bound) const;
  Watch& watch(const LimitName& limit, double bound, double scale);
  /// @return the highest friction angle of the range at a place [rad]
  [[nodiscard]] double steepest_friction(double s) const;
  /// @param friction  before the first place where it changes
  [[nodiscard]] Friction friction_at(double s, Friction friction) const;

  const Problem& problem_;
  double chord_;
  const BulkStream* stream_ = nullptr;
  std::optional<FrictionLevel> friction_;
  Friction friction_of_ride_;
  std::vector<Watch> watches_;
};

}  // namespace glissade::referee
