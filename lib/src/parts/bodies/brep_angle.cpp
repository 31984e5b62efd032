// A bar of angle section, straight or rolled.

#include "glissade/core/number_text.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/brep_building.hpp"
#include "parts/bodies/brep_contour.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

using Loop = std::vector<BrepUse>;

Loop uses_of(const std::vector<std::size_t>& edges, bool forward) {
  Loop loop;
  for (const std::size_t edge : edges) loop.push_back({edge, forward});
  if (!forward) std::reverse(loop.begin(), loop.end());
  return loop;
}

Loop turned_over(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  for (BrepUse& use : loop) use.forward = !use.forward;
  return loop;
}

/// Faces over heel, root and toe; root and toe run backwards, the material on the left of all three.
class AngleFaces {
 public:
  explicit AngleFaces(const AngleBar& bar)
      : thickness_(bar.thickness * core::kMillimetres),
        height_(bar.height * core::kMillimetres),
        closed_(bar.heel.closed),
        heel_(add_upright(brep_, scaled(bar.heel, core::kMillimetres), 0.0, height_)),
        root_(add_upright(brep_, scaled(reversed(bar.root), core::kMillimetres), thickness_, height_)),
        toe_(add_upright(brep_, scaled(reversed(bar.toe), core::kMillimetres), 0.0, thickness_)) {
    // Outside of a closed one is the toe, or the heel where the bar stands inwards.
    outward_ = !closed_ || signed_area(bar.heel) < 0.0;
  }

  Brep whole(const AngleBar& bar) {
    ContourFaces holes(brep_, thickness_);
    for (const ArcPath& slot : bar.slots) holes.add(turning(scaled(slot, core::kMillimetres), false));
    for (const Circle& hole : bar.holes)
      holes.add(Circle{core::kMillimetres * hole.centre, core::kMillimetres * hole.radius});
    if (!closed_) join_ends();
    level(0.0, false, uses_of(heel_.low, true), uses_of(toe_.low, true), {below_end_, below_start_},
          holes.below());
    level(thickness_, true, uses_of(root_.low, false), uses_of(toe_.high, true), {lying_end_, lying_start_},
          holes.above());
    level(height_, true, uses_of(heel_.high, true), uses_of(root_.high, true), {top_end_, top_start_}, {});
    if (!closed_) add_ends();
    return std::move(brep_);
  }

 private:
  /// Lines of the level faces across the bar: those at its end lead to the left, those at its start back.
  void join_ends() {
    below_end_ = add_line(brep_, heel_.low_vertices.back(), toe_.low_vertices.front());
    below_start_ = add_line(brep_, toe_.low_vertices.back(), heel_.low_vertices.front());
    lying_end_ = add_line(brep_, root_.low_vertices.front(), toe_.high_vertices.front());
    lying_start_ = add_line(brep_, toe_.high_vertices.back(), root_.low_vertices.back());
    top_end_ = add_line(brep_, heel_.high_vertices.back(), root_.high_vertices.front());
    top_start_ = add_line(brep_, root_.high_vertices.back(), heel_.high_vertices.front());
  }

  /// @param ahead,back  counter-clockwise seen from above
  /// @param ends        the lines from the first to the second and back
  void level(double z, bool up, Loop ahead, Loop back, std::array<std::size_t, 2> ends,
             const std::vector<Loop>& holes) {
    BrepFace face = level_plane(z, up);
    if (closed_) {
      face.loops = outward_ ? std::vector<Loop>{std::move(back), std::move(ahead)}
                            : std::vector<Loop>{std::move(ahead), std::move(back)};
    } else {
      ahead.push_back({ends[0], true});
      ahead.insert(ahead.end(), back.begin(), back.end());
      ahead.push_back({ends[1], true});
      face.loops = {std::move(ahead)};
    }
    if (!up) {
      for (Loop& loop : face.loops) loop = turned_over(std::move(loop));
    }
    face.loops.insert(face.loops.end(), holes.begin(), holes.end());
    brep_.faces.push_back(std::move(face));
  }

  void add_ends() {
    end({{below_end_, true},
         {toe_.upright.front(), true},
         {lying_end_, false},
         {root_.upright.front(), true},
         {top_end_, false},
         {heel_.upright.back(), false}});
    end({{heel_.upright.front(), true},
         {top_start_, false},
         {root_.upright.back(), false},
         {lying_start_, false},
         {toe_.upright.back(), false},
         {below_start_, true}});
  }

  void end(Loop loop) {
    const auto start = [&](const BrepUse& use) {
      const BrepEdge& edge = brep_.edges[use.edge];
      return brep_.vertices[use.forward ? edge.from : edge.to];
    };
    BrepFace face;
    face.origin = start(loop[0]);
    face.reference = unit(start(loop[1]) - face.origin);
    face.axis = unit(cross(face.reference, start(loop[2]) - start(loop[1])));
    face.loops = {std::move(loop)};
    brep_.faces.push_back(std::move(face));
  }

  Brep brep_;
  double thickness_;
  double height_;
  bool closed_;
  bool outward_ = true;
  UprightEdges heel_;
  UprightEdges root_;
  UprightEdges toe_;
  std::size_t below_end_ = 0;
  std::size_t below_start_ = 0;
  std::size_t lying_end_ = 0;
  std::size_t lying_start_ = 0;
  std::size_t top_end_ = 0;
  std::size_t top_start_ = 0;
};

}  // namespace

Brep brep_of_angle(const AngleBar& bar, const ShopPart& part) {
  for (const PlaneRegion& leg : {lying_leg(bar), rising_leg(bar)}) {
    const std::vector<std::string> faults = faults_of(leg);
    if (!faults.empty()) throw bad_body(part, faults.front());
  }
  if (!(bar.thickness > 0.0) || !(bar.height > bar.thickness)) {
    throw bad_body(
        part, "its legs are " + length_text(bar.thickness) + " and " + length_text(bar.height) + " high");
  }
  return AngleFaces(bar).whole(bar);
}

}  // namespace glissade::parts
