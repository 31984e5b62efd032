#include "parts/timber/timber_braces.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "parts/bodies/body_moments.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/supports/ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kSteepestBay = 1.2;  // height of one board over the width of its bay
constexpr double kBeside = 1e-3;      // between boards that end on one leg [m]
constexpr double kClear = 5e-3;       // below the bearers [m]
constexpr double kMostBoards = 12.0;  // in one bay

/// Heights between which boards are fixed to a leg.
struct Reach {
  double low = 0.0;
  double high = 0.0;
};

/// A board between two plumb cuts, from the lower left to the upper right or from the upper left to the lower right.
/// @param run     distance of the cuts
/// @param from,to heights of its middle line at the left and at the right cut
ArcPath board(double run, double from, double to, double width) {
  const double half = 0.5 * width * std::sqrt(1.0 + (to - from) * (to - from) / (run * run));
  ArcPath outline;
  outline.closed = true;
  for (const Vec2 corner :
       {Vec2{0.0, from - half}, Vec2{run, to - half}, Vec2{run, to + half}, Vec2{0.0, from + half}}) {
    outline.vertices.push_back({corner, 0.0});
  }
  return outline;
}

ShopPart board_part(const TimberJob& job, const ArcPath& outline, std::string name) {
  ShopPart part;
  part.name = std::move(name);
  part.material = job.options.lumber.name;
  part.density = job.options.lumber.density;
  part.thickness = job.options.legs->brace_thickness;
  part.body = Prism{{outline, {}, {}}, part.thickness};
  part.stands = true;
  part.bought_in = true;
  FlatPattern pattern;
  pattern.region.outline = outline;
  part.pattern = std::move(pattern);
  return part;
}

/// @return heights at which boards of a bay begin and end, from below
std::vector<double> levels(double low, double high, double run) {
  const double count = std::clamp(std::ceil((high - low) / (kSteepestBay * run) - 1e-9), 1.0, kMostBoards);
  std::vector<double> heights;
  for (double k = 0.0; k <= count; k += 1.0) heights.push_back(low + (high - low) * k / count);
  return heights;
}

/// Height of the bearers' underside at x.
double underside_at(const TimberJob& job, double x) {
  const auto point = [&](double s) {
    const TrackFrame at = frame_at(job.track, s);
    return at.at + job.bearer_bottom() * at.up;
  };
  double low = 0.0;
  double high = job.track.length();
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (point(middle).x < x ? low : high) = middle;
  }
  return point(0.5 * (low + high)).y;
}

/// Height of a board above its middle line: greater the steeper it stands.
double half_height(const TimberJob& job, double rise_per_run) {
  return 0.5 * job.options.legs->brace_width * std::sqrt(1.0 + rise_per_run * rise_per_run);
}

/// @param run  of the bay
/// @return 1.5 board widths below the slanted top, one above the ground; more where steep boards ask for it
Reach reach_of(const TimberJob& job, const Leg& leg, double run) {
  const LegOptions& options = *job.options.legs;
  const double width = options.brace_width;
  // Boards lie on the faces of the leg.
  const double far = 0.5 * options.side + options.brace_thickness;
  const double ground = highest_ground(options.ground, leg.x - far, leg.x + far);
  Reach reach{ground + width, std::min(leg.top_left.y, leg.top_right.y) - 1.5 * width};
  const double steepest = std::max(kSteepestBay, (reach.high - reach.low) / (kMostBoards * run));
  reach.low = std::max(reach.low, ground + half_height(job, steepest) + kClear);
  return reach;
}

/// Distance of the outer legs' middles, less what boards keep off their outer faces.
double row_run(const TimberJob& job, const BearerPlan& plan) {
  return plan.across.front() - plan.across.back() + 0.9 * job.options.legs->side;
}

/// Of boards on both faces of a row: they lie beside the leg, where the bearers may be lower than above it.
Reach reach_of_row(const TimberJob& job, const Leg& leg, const BearerPlan& plan) {
  const double run = row_run(job, plan);
  Reach reach = reach_of(job, leg, run);
  const double steepest = std::max(kSteepestBay, (reach.high - reach.low) / (kMostBoards * run));
  const double near = 0.5 * job.options.legs->side;
  const double far = near + job.options.legs->brace_thickness;
  for (const double along : {-far, -near, near, far})
    reach.high = std::min(reach.high, underside_at(job, leg.x + along) - kClear - half_height(job, steepest));
  return reach;
}

/// Crossed boards on both faces of a row of legs.
void brace_row(const TimberJob& job, const Leg& leg, const BearerPlan& plan, const std::string& number,
               std::vector<ShopPart>& parts) {
  const LegOptions& options = *job.options.legs;
  const double outer = 0.45 * options.side;
  const double left = plan.across.front() + outer;
  const double right = plan.across.back() - outer;
  const Reach reach = reach_of_row(job, leg, plan);
  const std::vector<double> heights = levels(reach.low, reach.high, left - right);
  const Vec3 to_left = across(job.placement);
  const Vec3 downstream = along(job.placement);
  const Vec3 up = cross(downstream, to_left);
  const double face = 0.5 * options.side;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const double rise = heights[k + 1] - heights[k];
    ShopPart part =
        board_part(job, board(left - right, 0.0, rise, options.brace_width),
                   "cross_brace_" + number + (heights.size() > 2 ? "_" + std::to_string(k + 1) : ""));
    // One on the downstream face, rising to the left; the same turned round on the upstream face.
    const Vec3 low_right = in_space(job.placement, {leg.x + face, heights[k]}) + right * to_left;
    const Vec3 low_left = in_space(job.placement, {leg.x - face, heights[k]}) + left * to_left;
    part.places.push_back({low_right, to_left, up, cross(to_left, up)});
    part.places.push_back({low_left, -1.0 * to_left, up, cross(-1.0 * to_left, up)});
    weigh(part);
    parts.push_back(std::move(part));
  }
}

/// A way to put boards into a bay.
struct Diagonal {
  bool rises = true;  ///< downstream
  std::vector<double> heights;
};

/// @return whether the uppermost board of a bay stays below the bearers
bool is_clear(const TimberJob& job, const Diagonal& diagonal, double from, double run) {
  const double top = diagonal.heights.back();
  const double below = diagonal.heights[diagonal.heights.size() - 2];
  const double rise = (diagonal.rises ? 1.0 : -1.0) * (top - below) / run;
  const double half = half_height(job, rise);
  constexpr int kPlaces = 24;
  for (int k = 0; k <= kPlaces; ++k) {
    const double along = run * k / kPlaces;
    const double upper = (diagonal.rises ? below : top) + rise * along + half;
    if (upper > underside_at(job, from + along) - kClear) return false;
  }
  return true;
}

/// @return how far the lowest board of a bay is too near to the ground; 0: nowhere [m]
double below_clear(const TimberJob& job, const Diagonal& diagonal, double from, double run) {
  const double low = diagonal.heights[0];
  const double rise = (diagonal.rises ? 1.0 : -1.0) * (diagonal.heights[1] - low) / run;
  const double start = (diagonal.rises ? low : diagonal.heights[1]) - half_height(job, rise);
  std::vector<double> places = {0.0, run};
  for (const Vec2 corner : job.options.legs->ground) places.push_back(std::clamp(corner.x - from, 0.0, run));
  double most = 0.0;
  for (const double along : places) {
    const double ground = ground_at(job.options.legs->ground, from + along);
    most = std::max(most, ground + kClear - (start + rise * along));
  }
  return most;
}

/// @return the way into a bay above a height, the lowest board lifted clear of the ground; none where that leaves no room
std::optional<Diagonal> above_ground(const TimberJob& job, bool rises, Reach reach, double from, double run) {
  constexpr double kSettled = 1e-9;  // rounding [m]
  constexpr int kTries = 20;         // budget: boards turn as they are lifted
  for (int k = 0; k < kTries; ++k) {
    if (!(reach.high - reach.low > 2.0 * job.options.legs->brace_width)) return std::nullopt;
    Diagonal diagonal{rises, levels(reach.low, reach.high, run)};
    const double lift = below_clear(job, diagonal, from, run);
    if (lift <= kSettled) return diagonal;
    reach.low += lift;
  }
  return std::nullopt;
}

/// Boards between two rows, on the outsides of the outer legs; they rise towards the shorter leg where that can be, else
/// the other way.
/// @return whether there is room for one
bool brace_bay(const TimberJob& job, const Leg& before, const Leg& after, const BearerPlan& plan,
               const std::string& number, std::vector<ShopPart>& parts) {
  const LegOptions& options = *job.options.legs;
  const double from = before.x + kBeside;
  const double run = after.x - kBeside - from;
  const Reach a = reach_of(job, before, run);
  const Reach b = reach_of(job, after, run);
  const bool shorter_is_after = b.high <= a.high;
  for (const bool rises : {shorter_is_after, !shorter_is_after}) {
    const Reach reach{rises ? a.low : b.low, rises ? b.high : a.high};
    const auto diagonal = above_ground(job, rises, reach, from, run);
    if (!diagonal || !is_clear(job, *diagonal, from, run)) continue;
    const std::vector<double>& heights = diagonal->heights;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
      const double rise = heights[k + 1] - heights[k];
      ShopPart part =
          board_part(job, board(run, rises ? 0.0 : rise, rises ? rise : 0.0, options.brace_width),
                     "long_brace_" + number + (heights.size() > 2 ? "_" + std::to_string(k + 1) : ""));
      for (const double shift : {-plan.across.front() - 0.5 * options.side - options.brace_thickness,
                                 -plan.across.back() + 0.5 * options.side}) {
        part.places.push_back(plane_of_track(job.placement, {from, heights[k]}, 0.0, shift));
      }
      weigh(part);
      parts.push_back(std::move(part));
    }
    return true;
  }
  return false;
}

/// Says which bays no boards brace.
/// @param bays  "2 to 3"
/// @param asked  how many are to be braced
void tell_open_bays(const TimberJob& job, const std::vector<std::string>& bays, std::size_t asked,
                    Workshop& workshop) {
  if (bays.empty()) return;
  const LegOptions& options = *job.options.legs;
  add_shortfall(
      {"legs.braced_from",
       "braced_from: no boards brace " + std::to_string(bays.size()) + " of " + std::to_string(asked) +
           " bays along the run, legs " + listed(bays) + ", although a leg of each is " +
           length_text(options.braced_from) + " long or longer",
       "Between ground and bearers, " + length_text(kClear) + " clear of both, boards of " +
           length_text(options.brace_width) + " (brace_width) find no room there, whichever way they rise.",
       "another spacing of the legs, or bracing of your own"},
      workshop);
}

}  // namespace

bool is_braced(const TimberJob& job, const Leg& leg, const BearerPlan& plan) {
  const Reach reach = reach_of_row(job, leg, plan);
  return leg.length() >= job.options.legs->braced_from &&
         reach.high - reach.low > 2.0 * job.options.legs->brace_width;
}

std::vector<ShopPart> brace_parts(const TimberJob& job, const std::vector<Leg>& legs, const BearerPlan& plan,
                                  Workshop& workshop) {
  std::vector<ShopPart> parts;
  std::vector<std::string> open;
  std::size_t bays = 0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    if (is_braced(job, legs[i], plan)) brace_row(job, legs[i], plan, number, parts);
    if (i + 1 == legs.size() || !(is_braced(job, legs[i], plan) || is_braced(job, legs[i + 1], plan)))
      continue;
    ++bays;
    if (!brace_bay(job, legs[i], legs[i + 1], plan, number, parts))
      open.push_back(number + " to " + std::to_string(i + 2));
  }
  tell_open_bays(job, open, bays, workshop);
  return parts;
}

}  // namespace glissade::parts
