#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/referee/referee.hpp"

#include <optional>
#include <vector>

namespace glissade::referee {

/// A stretch along which a limit is broken.
struct Broken {
  LimitName limit;
  double where = 0.0;      ///< arc length at which it is broken the most [m]
  double violation = 0.0;  ///< there, in scales; > 0
};

/// What the independent integration says of a track.
struct Judgement {
  bool arrived = false;            ///< at every friction of the range
  std::optional<double> stall;     ///< arc length at which the body stalls, at some friction [m]
  std::optional<double> lift_off;  ///< arc length at which the body leaves the track, at some friction [m]
  double travel_time = 0.0;
  double exit_speed = 0.0;
  std::vector<LimitCheck> checks;
  std::vector<Broken> broken;  ///< of every limit
  double worst = 0.0;          ///< greatest violation in scales

  [[nodiscard]] const LimitCheck* find(const LimitName& limit) const;
};

/// Whether limits on motion are held against a ride that ends before the finish.
enum class BrokenRides { left_out, judged };

/// Points on each smooth piece: three times as many as the stations of the search, of which a piece has some seven. What is
/// greatest between them is found by parabolas.
inline constexpr int kRefereeSamples = 24;

/// Rides the track with Motion and compares it with the problem as given, in SI, sharing no code with the
/// search.
/// @param samples  points on each smooth piece of the centerline
[[nodiscard]] Judgement judge_track(const Problem& problem, const CenterlinePtr& track, int samples,
                                    BrokenRides broken_rides = BrokenRides::left_out);

}  // namespace glissade::referee
