#include "glissade/solid/sweep.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/stop.hpp"

#include "core/plane_geometry.hpp"
#include "solid/cap_triangulation.hpp"
#include "solid/chord_sagitta.hpp"
#include "solid/least_between.hpp"
#include "solid/level_curves.hpp"
#include "solid/stations.hpp"
#include "solid/sweep_plan.hpp"
#include "solid/sweep_refusal.hpp"
#include "solid/swept_volume.hpp"
#include "solid/widening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace glissade {

using namespace solid;

namespace {

using Polygon = CrossSection::Polygon;

// Distances below this share of the track's size are lost in the single precision of a binary STL.
constexpr double kShortestShare = 1e-6;
// The point that a level has on a crease is within this share of the chord tolerance of its place.
constexpr double kTrimShare = 0.1;
// Facets beside a trim are at least this share of the others high, where no node has to be left out for it
// that the level would pass by more than the other share of the chord tolerance.
constexpr double kRoomAtTrims = 0.25;
constexpr double kSagittaAtTrims = 0.9;
constexpr int kMostRefinements = 12;
// Where that many halvings in a row leave more than this share of the deviation, it lies along the track, which finer
// steps mend and narrower sides do not.
constexpr int kMostVainRefinements = 5;
constexpr double kVainShare = 0.9;
// Halvings of a side that moves as the width changes: its facets depart in proportion to its pieces.
constexpr int kMostRefinementsOfMoving = 6;
// An edge that moves by no more than this share of the chord tolerance is looked at no closer.
constexpr double kMovedShare = 0.25;
// Whether the work is to end is asked once in so many steps of it.
constexpr std::size_t kStepsBetweenPauses = 256;

struct CheckedStations {
  std::vector<Station> stations;
  double deviation = 0.0;
};

// Greatest distance between the level curves of `heights` and their chords between two stations; exact where it
// is more than `enough`.
double step_deviation(const Centerline& centerline, const Station& a, const Station& b,
                      const std::array<double, 3>& heights, double enough) {
  const ChordSagitta sagitta(centerline, a.s, b.s);
  double worst = 0.0;
  for (const double height : heights) {
    if (sagitta.folds(height)) continue;
    worst = std::max(worst,
                     sagitta.of_level(height, offset(a, height), offset(b, height), std::max(worst, enough)));
  }
  return worst;
}

struct StepBounds {
  double tolerance = 0.0;
  double turn = 0.0;  // [rad]
};

// Measures every step and halves those that miss the tolerance: the plan only estimates.
CheckedStations check_steps(const Centerline& centerline, std::vector<Station> planned,
                            const StepBounds& bounds, const std::array<double, 3>& heights,
                            const Planner& planner) {
  CheckedStations checked;
  checked.stations.reserve(planned.size());
  std::vector<Station> ahead(planned.rbegin(), planned.rend());
  checked.stations.push_back(ahead.back());
  ahead.pop_back();
  for (std::size_t measured = 0; !ahead.empty(); ++measured) {
    if (measured % kStepsBetweenPauses == 0) require_going(planner.stop());
    const Station& from = checked.stations.back();
    const Station middle = station_at(centerline, 0.5 * (from.s + ahead.back().s));
    const double deviation = step_deviation(centerline, from, ahead.back(), heights, checked.deviation);
    const bool splits = middle.s > from.s && middle.s < ahead.back().s;
    const bool misses =
        deviation > bounds.tolerance || std::fabs(from.slope - ahead.back().slope) > bounds.turn;
    if (misses && splits && static_cast<double>(checked.stations.size()) < planner.limit()) {
      ahead.push_back(middle);
      continue;
    }
    checked.deviation = std::max(checked.deviation, deviation);
    checked.stations.push_back(ahead.back());
    ahead.pop_back();
  }
  return checked;
}

struct Level {
  LevelCurve curve;
  bool checked = false;
};

using Levels = std::map<double, Level>;

/// A corner of the section where it is narrowest, and how far it moves across until it is widest.
struct SectionCorner {
  Vec2 at;  // (across, height)
  double spread = 0.0;
};

struct SectionVertex {
  SectionCorner corner;
  Levels::iterator level;

  [[nodiscard]] const std::vector<LevelNode>& nodes() const { return level->second.curve.nodes; }
};

using Loop = std::vector<SectionVertex>;

// Cuts a side into equal pieces, counted from its lower end: mirrored sides get the same heights.
std::vector<SectionCorner> subdivided(const Polygon& narrow, const Polygon& wide, const Fineness& fineness) {
  std::vector<SectionCorner> points;
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    const std::size_t next = (i + 1) % narrow.size();
    const auto pieces = static_cast<std::size_t>(fineness.pieces(norm(wide[next] - wide[i])));
    const bool rises = narrow[i].y <= narrow[next].y;
    const std::size_t low = rises ? i : next;
    const std::size_t high = rises ? next : i;
    points.push_back({narrow[i], wide[i].x - narrow[i].x});
    for (std::size_t k = 1; k < pieces; ++k) {
      const std::size_t from_low = rises ? k : pieces - k;
      const double part = static_cast<double>(from_low) / static_cast<double>(pieces);
      const Vec2 at = narrow[low] + part * (narrow[high] - narrow[low]);
      points.push_back({at, wide[low].x + part * (wide[high].x - wide[low].x) - at.x});
    }
  }
  return points;
}

/// @return the arc length at whose width a node stands: both feet of a crease have one width
double width_place(const std::vector<LevelNode>& nodes, std::size_t i) {
  return i == 0 ? nodes[i].to : nodes[i].from;
}

// Walks the band between two level curves from the start face to the finish face: at each step the branch
// goes on whose next node comes first along the track, at a tie the one that gives the shorter diagonal.
// `emit(i, k, on_first)`: a triangle of nodes i and k and the next node of the first or of the second curve.
template <typename Emit>
void zip(const std::vector<LevelNode>& first, const std::vector<LevelNode>& second, Emit emit) {
  std::size_t i = 0;
  std::size_t k = 0;
  while (i + 1 < first.size() || k + 1 < second.size()) {
    bool on_first = k + 1 >= second.size();
    if (!on_first && i + 1 < first.size()) {
      const double next_first = first[i + 1].from;
      const double next_second = second[k + 1].from;
      on_first = next_first < next_second;
      if (next_first == next_second) {
        const Vec2 forward = first[i + 1].point - second[k].point;
        const Vec2 backward = second[k + 1].point - first[i].point;
        on_first = dot(forward, forward) <= dot(backward, backward);
      }
    }
    emit(i, k, on_first);
    ++(on_first ? i : k);
  }
}

class Sweeper {
 public:
  Sweeper(const Centerline& centerline, const CrossSection& section, const Placement& placement,
          const Planner& planner, const Fineness& fineness)
      : centerline_(centerline),
        section_(section),
        widening_(section),
        placement_(placement),
        planner_(planner),
        fineness_(fineness),
        spacing_{
            std::max(std::min(kShortestShare * centerline.length(), 0.25 * fineness.chord_tolerance),
                     finest_length(centerline, section, placement)),
            planner.holds_kink() ? 0.0 : kRoomAtTrims * std::min(fineness.side_piece, fineness.longest_step),
            kSagittaAtTrims * fineness.chord_tolerance, section.varies()} {}

  /// Lays out the mesh without making it.
  /// @return false if some level of the section does not lead from start to finish: see refusal()
  [[nodiscard]] bool lay_out() {
    make_levels();
    make_loops();
    if (blocked_height_ == 0.0) require_one_width_at_creases();
    if (blocked_height_ == 0.0) refine_sides();
    if (blocked_height_ == 0.0) check_levels_at_trims();
    if (blocked_height_ == 0.0) check_moving_levels();
    return blocked_height_ == 0.0;
  }

  /// @return greatest distance between the mesh laid out and the ideal solid [m]
  [[nodiscard]] double deviation() const {
    return deviation_ + moved_ + section_.chord_error(fineness_.outline_tolerance);
  }

  /// Why a level does not.
  [[nodiscard]] Issue refusal() const {
    return section_issue(centerline_, section_, *curves_, blocked_height_);
  }

  [[nodiscard]] Solid make() const {
    Solid solid;
    solid.placement = placement_;
    emit(solid);
    solid.max_deviation = deviation();
    solid.expected_euler = loops_.size() == 1 ? 2 : 0;
    solid.exact_volume = swept_volume(centerline_, widening_, *curves_, planner_.stop());
    for (const Station& station : curves_->stations()) solid.stations.push_back(station.s);
    for (const auto& [height, level] : levels_) solid.trimmed = solid.trimmed || level.curve.trimmed;
    return solid;
  }

 private:
  void make_levels() {
    const std::array<double, 3> heights{section_.lowest(), 0.0, section_.highest()};
    CheckedStations checked = check_steps(
        centerline_, StationPlan(centerline_, planner_.limits(fineness_)).stations(),
        {fineness_.chord_tolerance / kPlannedShare, 1.05 * fineness_.largest_turn}, heights, planner_);
    deviation_ = checked.deviation;
    curves_ = std::make_unique<LevelCurves>(centerline_, std::move(checked.stations), -section_.lowest(),
                                            section_.highest(), kTrimShare * fineness_.chord_tolerance,
                                            planner_.stop());
  }

  Levels::iterator level_at(double height) {
    require_going(planner_.stop());
    const auto found = levels_.find(height);
    if (found != levels_.end()) return found;
    if (curves_->trims(height).obstacle) {
      blocked_height_ = height;
      return levels_.end();
    }
    return levels_.emplace(height, Level{curves_->level(height, spacing_), false}).first;
  }

  void make_loops() {
    // The extremes first: what cannot work at all is found out before the rest is made.
    for (const double height : {section_.highest(), section_.lowest()}) {
      if (curves_->trims(height).obstacle) blocked_height_ = height;
    }
    if (blocked_height_ != 0.0) return;
    const double tolerance = fineness_.outline_tolerance;
    const CrossSection& narrow = widening_.narrow();
    const CrossSection& wide = widening_.wide();
    for (const auto& [from, to] : {std::pair{narrow.outline(tolerance), wide.outline(tolerance)},
                                   std::pair{narrow.bore(tolerance), wide.bore(tolerance)}}) {
      if (from.empty()) continue;
      Loop loop;
      for (const SectionCorner& corner : subdivided(from, to, fineness_)) {
        loop.push_back({corner, level_at(corner.at.y)});
        if (blocked_height_ != 0.0) return;
      }
      loops_.push_back(std::move(loop));
    }
  }

  /// @return where a corner stands at an arc length, (across, height)
  [[nodiscard]] Vec2 place_at(const SectionCorner& corner, double s) const {
    return {corner.at.x + corner.spread * widening_.share(s), corner.at.y};
  }
  [[nodiscard]] double across_at(const SectionVertex& vertex, std::size_t node) const {
    return place_at(vertex.corner, width_place(vertex.nodes(), node)).x;
  }

  /// @throws InputError unless the branches of every level that meet in a crease are of one width
  void require_one_width_at_creases() const {
    if (!widening_.varies()) return;
    constexpr double kSame = 1e-9;
    for (const auto& [height, level] : levels_) {
      const std::vector<LevelNode>& nodes = level.curve.nodes;
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
        if (!nodes[i].trim) continue;
        const double change = widening_.share(nodes[i].from) - widening_.share(nodes[i].to);
        if (std::fabs(change) > kSame) refuse_widening(nodes[i].from, nodes[i].to);
      }
    }
  }

  /// A stretch of the track, by arc length [m].
  struct Feet {
    double from = 0.0;
    double to = 0.0;

    void take(const LevelNode& node) {
      from = std::min(from, node.from);
      to = std::max(to, node.to);
    }
  };

  /// The least distance of a point on a facet from a surface that is across(s, height) away from it where its foot is
  /// s: at its own foot, or, where that is more than `enough`, at any of `feet`. Beside a centre of curvature the
  /// normals of a whole stretch meet, each with the width of its own foot.
  template <typename Across>
  [[nodiscard]] double distance_over(Vec2 point, const Feet& feet, double enough,
                                     const Across& across) const {
    const LevelCurves::Foot foot = curves_->foot(point);
    const double alone = across(foot.s, foot.height);
    if (alone <= enough) return alone;
    double least = alone;
    double nearest = feet.from;
    const auto distance_at = [&](double s) {
      const Station here = station_at(centerline_, s);
      const Vec2 away = point - here.point;
      return norm(Vec2{dot(away, here.tangent), across(s, dot(away, here.normal))});
    };
    const auto take = [&](double s) {
      const double distance = distance_at(s);
      if (!(distance < least)) return;
      const Station here = station_at(centerline_, s);
      if (!curves_->carries(here, dot(point - here.point, here.normal))) return;
      least = distance;
      nearest = s;
    };
    constexpr int kPieces = 16;
    constexpr int kBits = 20;
    constexpr std::uintmax_t kIterations = 60;
    const double piece = (feet.to - feet.from) / kPieces;
    for (int k = 0; k <= kPieces && least > enough; ++k) take(feet.from + piece * k);
    if (least == alone || least <= enough) return least;
    take(least_between(std::max(feet.from, nearest - piece), std::min(feet.to, nearest + piece), kBits,
                       kIterations, distance_at)
             .first);
    return least;
  }

  /// @return distance of a point on the facets over one side of the section from the ideal surface [m]
  [[nodiscard]] double distance_from_side(Vec2 point, double across, const SectionVertex& a,
                                          const SectionVertex& b, const Feet& feet, double enough) const {
    return distance_over(point, feet, enough, [&](double s, double height) {
      return core::distance_to_segment({across, height}, place_at(a.corner, s), place_at(b.corner, s));
    });
  }

  // Distance of the facets over one side of the section from the ideal surface: of those beside trims, and of the edges
  // across all of them where the side moves as the width changes.
  [[nodiscard]] double deviation_over_side(const SectionVertex& a, const SectionVertex& b, bool moves,
                                           double allowed) const {
    const std::vector<LevelNode>& first = a.nodes();
    const std::vector<LevelNode>& second = b.nodes();
    double worst = 0.0;
    Feet feet;
    const auto measure = [&](Vec2 point, double across) {
      const double enough = moves ? std::max(worst, allowed) : std::numeric_limits<double>::infinity();
      worst = std::max(worst, distance_from_side(point, across, a, b, feet, enough));
    };
    zip(first, second, [&](std::size_t i, std::size_t k, bool on_first) {
      const LevelNode& next = on_first ? first[i + 1] : second[k + 1];
      feet = {next.from, next.to};
      feet.take(first[i]);
      feet.take(second[k]);
      const bool trimmed = first[i].trim || second[k].trim || next.trim;
      if (!trimmed && !moves) return;
      const double across_first = across_at(a, i);
      const double across_second = across_at(b, k);
      measure(0.5 * (first[i].point + second[k].point), 0.5 * (across_first + across_second));
      if (!trimmed) return;
      const Vec2 corner = next.point;
      const double across = on_first ? across_at(a, i + 1) : across_at(b, k + 1);
      measure(0.5 * (first[i].point + corner), 0.5 * (across_first + across));
      measure(0.5 * (second[k].point + corner), 0.5 * (across_second + across));
      measure((1.0 / 3.0) * (first[i].point + second[k].point + corner),
              (across_first + across_second + across) / 3.0);
    });
    return worst;
  }

  // Halves sides whose facets miss the tolerance: slanted ones beside a trim, and those that move as the width changes.
  void refine_sides() {
    const double allowed = fineness_.chord_tolerance / kPlannedShare;
    for (Loop& loop : loops_) {
      Loop refined;
      for (std::size_t j = 0; j < loop.size(); ++j) {
        require_going(planner_.stop());
        refined.push_back(loop[j]);
        refine_side(refined, loop[(j + 1) % loop.size()], allowed, {});
      }
      loop = std::move(refined);
    }
  }

  /// How a side came to be by halving.
  struct Halvings {
    int depth = 0;
    int vain = 0;  ///< the last ones, in a row, that took little of the deviation
    double deviation = std::numeric_limits<double>::infinity();  ///< of the side that was halved [m]
  };

  void refine_side(Loop& refined, const SectionVertex& end, double allowed, const Halvings& before) {
    const SectionVertex begin = refined.back();
    if (blocked_height_ != 0.0) return;
    const bool rises = begin.corner.at.y != end.corner.at.y;
    const bool moves = rises && (begin.corner.spread != 0.0 || end.corner.spread != 0.0);
    const bool slanted = rises && (moves || begin.corner.at.x != end.corner.at.x);
    const bool trimmed = begin.level->second.curve.trimmed || end.level->second.curve.trimmed;
    if (!moves && !(slanted && trimmed)) return;
    const double deviation = deviation_over_side(begin, end, moves, allowed);
    const int vain = deviation > kVainShare * before.deviation ? before.vain + 1 : 0;
    const bool helps = moves ? before.depth < kMostRefinementsOfMoving
                             : before.depth < kMostRefinements && vain < kMostVainRefinements;
    if (deviation <= allowed || !helps) {
      deviation_ = std::max(deviation_, deviation);
      return;
    }
    const bool upward = begin.corner.at.y <= end.corner.at.y;
    const SectionCorner low = upward ? begin.corner : end.corner;
    const SectionCorner high = upward ? end.corner : begin.corner;
    const SectionCorner middle{low.at + 0.5 * (high.at - low.at),
                               low.spread + 0.5 * (high.spread - low.spread)};
    const SectionVertex half{middle, level_at(middle.at.y)};
    if (blocked_height_ != 0.0) return;
    const Halvings halved{before.depth + 1, vain, deviation};
    refine_side(refined, half, allowed, halved);
    refined.push_back(half);
    refine_side(refined, end, allowed, halved);
  }

  // A corner that moves stands where it should at its nodes; between them its edge is straight.
  void check_moving_levels() {
    if (!widening_.varies()) return;
    double most = 0.0;
    for (const Loop& loop : loops_) {
      for (const SectionVertex& vertex : loop) most = std::max(most, std::fabs(vertex.corner.spread));
    }
    constexpr std::array<double, 3> kShares{0.25, 0.5, 0.75};
    const double enough = kMovedShare * fineness_.chord_tolerance;
    for (const auto& [height, level] : levels_) {
      require_going(planner_.stop());
      const std::vector<LevelNode>& nodes = level.curve.nodes;
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const double here = widening_.share(width_place(nodes, i));
        const double there = widening_.share(width_place(nodes, i + 1));
        if (here == 0.0 && there == 0.0) continue;
        for (const double part : kShares) {
          const Vec2 point = nodes[i].point + part * (nodes[i + 1].point - nodes[i].point);
          const double share = here + part * (there - here);
          const double off = distance_over(
              point, {nodes[i].to, nodes[i + 1].from}, std::max(moved_, enough),
              [&](double s, double /*height*/) { return most * std::fabs(widening_.share(s) - share); });
          moved_ = std::max(moved_, off);
        }
      }
    }
  }

  // The steps beside trims, and those over stations that a level leaves out, are not those that check_steps()
  // measured.
  void check_levels_at_trims() {
    for (const auto& [height, level] : levels_) {
      require_going(planner_.stop());
      if (level.curve.trimmed) check_level_at_trims(height, level.curve.nodes);
    }
  }

  void check_level_at_trims(double height, const std::vector<LevelNode>& nodes) {
    const auto note = [this](double deviation) { deviation_ = std::max(deviation_, deviation); };
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const LevelNode& node = nodes[i];
      const LevelNode& after = nodes[i + 1];
      if (node.trim) note(std::fabs(curves_->height_of(node.point) - height));
      if (!node.trim && !after.trim && curves_->are_neighbours(node.to, after.from)) continue;
      note(std::fabs(curves_->height_of(0.5 * (node.point + after.point)) - height));
      if (!(after.from > node.to)) continue;
      const ChordSagitta sagitta(centerline_, node.to, after.from);
      note(sagitta.of_level(height, node.point, after.point, deviation_));
    }
  }

  void emit(Solid& solid) const {
    std::vector<std::vector<std::size_t>> first_vertex;
    std::size_t vertices = 0;
    std::size_t corners = 0;
    for (const Loop& loop : loops_) {
      first_vertex.emplace_back();
      for (const SectionVertex& vertex : loop) {
        first_vertex.back().push_back(vertices);
        vertices += vertex.nodes().size();
      }
      corners += loop.size();
    }
    // Euler: a closed surface has two facets a vertex, but for the handles.
    const std::size_t triangles = 2 * vertices - (loops_.size() == 1 ? 4 : 0);
    planner_.require_room(static_cast<double>(triangles));

    TriangleMesh& mesh = solid.mesh;
    mesh.vertices.reserve(vertices);
    mesh.triangles.reserve(triangles);
    for (const Loop& loop : loops_) {
      for (const SectionVertex& vertex : loop) {
        const std::vector<LevelNode>& nodes = vertex.nodes();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          mesh.vertices.push_back(
              placement_.to_space(nodes[i].point.x, -nodes[i].point.y, across_at(vertex, i)));
        }
      }
    }
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      const Loop& loop = loops_[l];
      for (std::size_t j = 0; j < loop.size(); ++j) {
        const std::size_t next = (j + 1) % loop.size();
        require_going(planner_.stop());
        emit_band(loop[j], first_vertex[l][j], loop[next], first_vertex[l][next], mesh);
      }
    }
    emit_face(curves_->stations().front(), false, first_vertex, mesh);
    emit_face(curves_->stations().back(), true, first_vertex, mesh);
  }

  static void emit_band(const SectionVertex& a, std::size_t first_a, const SectionVertex& b,
                        std::size_t first_b, TriangleMesh& mesh) {
    zip(a.nodes(), b.nodes(), [&](std::size_t i, std::size_t k, bool on_first) {
      const auto at_a = static_cast<std::uint32_t>(first_a + i);
      const auto at_b = static_cast<std::uint32_t>(first_b + k);
      mesh.triangles.push_back({at_a, at_b, on_first ? at_a + 1 : at_b + 1});
    });
  }

  void emit_face(const Station& station, bool finish,
                 const std::vector<std::vector<std::size_t>>& first_vertex, TriangleMesh& mesh) const {
    std::vector<std::vector<Vec2>> outlines;
    std::vector<std::uint32_t> corners;
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      outlines.emplace_back();
      for (std::size_t j = 0; j < loops_[l].size(); ++j) {
        const SectionVertex& vertex = loops_[l][j];
        const std::vector<LevelNode>& nodes = vertex.nodes();
        const LevelNode& node = finish ? nodes.back() : nodes.front();
        const double along = node.trim ? dot(node.point - station.point, station.normal) : vertex.corner.at.y;
        outlines.back().push_back({across_at(vertex, finish ? nodes.size() - 1 : 0), along});
        corners.push_back(static_cast<std::uint32_t>(first_vertex[l][j] + (finish ? nodes.size() - 1 : 0)));
      }
    }
    for (const auto& [a, b, c] : triangulate_loops(outlines)) {
      if (finish) {
        mesh.triangles.push_back({corners[a], corners[b], corners[c]});
      } else {
        mesh.triangles.push_back({corners[a], corners[c], corners[b]});
      }
    }
  }

  const Centerline& centerline_;
  const CrossSection& section_;
  Widening widening_;
  const Placement& placement_;
  const Planner& planner_;
  Fineness fineness_;
  NodeSpacing spacing_;
  double deviation_ = 0.0;
  double moved_ = 0.0;  // farthest that an edge across which the width changes departs from its place [m]
  double blocked_height_ = 0.0;
  std::unique_ptr<LevelCurves> curves_;
  Levels levels_;
  std::vector<Loop> loops_;
};

// A piece of a level that is shorter than the steps may have been missed: so often finer steps look again.
constexpr int kFinerForRoom = 3;  // budget
constexpr double kFiner = 0.2;    // taste
// Of larger meshes nothing is looked at before they are made.
constexpr double kMostToLookAt = 5e5;  // budget: triangles

}  // namespace

std::optional<Issue> obstacle_to_sweep(const Centerline& track, const CrossSection& section,
                                       double tolerance) {
  solid::require_distance(tolerance);
  const WithBreaks centerline(track, Widening(section).knots_between(0.0, track.length()));
  const Placement placement;
  SweepOptions options;
  options.tolerance = tolerance;
  const Planner planner(centerline, section, options);
  for (int attempt = 1;; ++attempt, tolerance *= kFiner) {
    const Fineness fineness = planner.fineness(tolerance);
    const bool is_quick =
        tolerance >= finest_length(centerline, section, placement) && fineness.triangles() <= kMostToLookAt;
    if (!is_quick) return std::nullopt;
    Sweeper sweeper(centerline, section, placement, planner, fineness);
    try {
      if (sweeper.lay_out()) return std::nullopt;
    } catch (const InputError& error) {
      return error.issues().front();  // of widths that do not fit a crease
    }
    if (attempt == kFinerForRoom) return sweeper.refusal();
  }
}

Solid sweep(const Centerline& track, const CrossSection& section, const Placement& placement,
            const SweepOptions& options) {
  const WithBreaks centerline(track, Widening(section).knots_between(0.0, track.length()));
  check_options(centerline, section, placement, options);
  const Planner planner(centerline, section, options);
  constexpr int kAttempts = 6;
  double tolerance = options.tolerance;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Fineness fineness = planner.fineness(tolerance);
    planner.require_room(fineness.triangles());
    Sweeper sweeper(centerline, section, placement, planner, fineness);
    const bool leads_through = sweeper.lay_out();
    if (leads_through && sweeper.deviation() <= options.tolerance) return sweeper.make();
    if (!leads_through && attempt + 1 >= kFinerForRoom) throw InputError(sweeper.refusal());
    tolerance *= leads_through ? 0.6 : kFiner;
  }
  if (section.varies()) refuse_fine_widening(options.tolerance);
  throw InternalError({"", "the sweep misses its tolerance of " + length_text(options.tolerance), "", ""});
}

}  // namespace glissade
