// Half a round tube with upright sides between two planes.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bodies/brep_building.hpp"
#include "parts/bodies/tube_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

/// Where one corner of the section meets both planes: the edge between, and the vertices.
struct Lengthwise {
  std::size_t low = 0;
  std::size_t high = 0;
  std::size_t edge = 0;
};

class TroughFaces {
 public:
  explicit TroughFaces(const TroughGore& gore)
      : gore_(round_of(gore)),
        inner_(gore.inner_radius * core::kMillimetres),
        outer_(inner_ + gore.thickness * core::kMillimetres),
        side_(gore.side * core::kMillimetres),
        length_(gore.length * core::kMillimetres),
        start_(math::tan(gore.start_tilt.radians())),
        end_(math::tan(gore.end_tilt.radians())) {}

  Brep whole() {
    for (const double sense : {1.0, -1.0}) {
      for (const bool outside : {false, true}) {
        round_.at(index(sense, outside)) = lengthwise(0.0, sense * radius(outside));
        rim_.at(index(sense, outside)) =
            side_ > 0.0 ? lengthwise(side_, sense * radius(outside)) : round_.at(index(sense, outside));
      }
    }
    rounds();
    if (side_ > 0.0) sides();
    rims();
    ends();
    TubeMouths mouths = add_openings(brep_, gore_);
    for (auto& loop : mouths.outside) brep_.faces[0].loops.push_back(std::move(loop));
    for (auto& loop : mouths.inside) brep_.faces[1].loops.push_back(std::move(loop));
    return std::move(brep_);
  }

 private:
  static std::size_t index(double sense, bool outside) {
    return (sense > 0.0 ? 0U : 2U) + (outside ? 1U : 0U);
  }
  [[nodiscard]] double radius(bool outside) const { return outside ? outer_ : inner_; }
  [[nodiscard]] const Lengthwise& round(double sense, bool outside) const {
    return round_.at(index(sense, outside));
  }
  [[nodiscard]] const Lengthwise& rim(double sense, bool outside) const {
    return rim_.at(index(sense, outside));
  }

  Lengthwise lengthwise(double x, double y) {
    Lengthwise made;
    made.low = add_vertex(brep_, {x, y, x * start_});
    made.high = add_vertex(brep_, {x, y, length_ + x * end_});
    made.edge = add_line(brep_, made.low, made.high);
    return made;
  }

  /// From the left end of a half ring round its lowest point to the right one.
  std::size_t half_ring(std::size_t from, std::size_t to, double radius, double height, double slope) {
    BrepEdge edge;
    edge.from = from;
    edge.to = to;
    edge.kind = slope == 0.0 ? CurveKind::circle : CurveKind::ellipse;
    edge.centre = {0.0, 0.0, height};
    const double stretch = math::hypot(1.0, slope);
    edge.reference = {1.0 / stretch, 0.0, slope / stretch};
    edge.axis = {-slope / stretch, 0.0, 1.0 / stretch};
    edge.radius = radius * stretch;
    edge.second_radius = radius;
    brep_.edges.push_back(edge);
    return brep_.edges.size() - 1;
  }

  void add_face(BrepFace face, std::vector<BrepUse> loop) {
    face.loops = {std::move(loop)};
    brep_.faces.push_back(std::move(face));
  }

  void rounds() {
    for (const bool outside : {true, false}) {
      const Lengthwise& left = round(1.0, outside);
      const Lengthwise& right = round(-1.0, outside);
      low_ring_.at(outside ? 1 : 0) = half_ring(left.low, right.low, radius(outside), 0.0, start_);
      high_ring_.at(outside ? 1 : 0) = half_ring(left.high, right.high, radius(outside), length_, end_);
      const std::size_t low = low_ring_.at(outside ? 1 : 0);
      const std::size_t high = high_ring_.at(outside ? 1 : 0);
      BrepFace face = upright_cylinder({}, kAcross, radius(outside), outside);
      if (outside) {
        add_face(std::move(face), {{low, true}, {right.edge, true}, {high, false}, {left.edge, false}});
      } else {
        add_face(std::move(face), {{low, false}, {left.edge, true}, {high, true}, {right.edge, false}});
      }
    }
  }

  void sides() {
    for (const double sense : {1.0, -1.0}) {
      for (const bool outside : {false, true}) {
        const Lengthwise& foot = round(sense, outside);
        const Lengthwise& top = rim(sense, outside);
        const std::size_t i = index(sense, outside);
        low_side_.at(i) = add_line(brep_, foot.low, top.low);
        high_side_.at(i) = add_line(brep_, foot.high, top.high);
        const bool to_left = (sense > 0.0) == outside;
        BrepFace face;
        face.origin = brep_.vertices[foot.low];
        face.axis = {0.0, to_left ? 1.0 : -1.0, 0.0};
        face.reference = kUp;
        if (to_left) {
          add_face(
              face,
              {{foot.edge, true}, {high_side_.at(i), true}, {top.edge, false}, {low_side_.at(i), false}});
        } else {
          add_face(
              face,
              {{low_side_.at(i), true}, {top.edge, true}, {high_side_.at(i), false}, {foot.edge, false}});
        }
      }
    }
  }

  void rims() {
    for (const double sense : {1.0, -1.0}) {
      // From the right edge of a rim to the left one.
      const Lengthwise& right = rim(sense, sense < 0.0);
      const Lengthwise& left = rim(sense, sense > 0.0);
      low_rim_.at(sense > 0.0 ? 0 : 1) = add_line(brep_, right.low, left.low);
      high_rim_.at(sense > 0.0 ? 0 : 1) = add_line(brep_, right.high, left.high);
      BrepFace face;
      face.origin = brep_.vertices[right.low];
      face.axis = kAcross;
      face.reference = kUp;
      add_face(std::move(face), {{low_rim_.at(sense > 0.0 ? 0 : 1), true},
                                 {left.edge, true},
                                 {high_rim_.at(sense > 0.0 ? 0 : 1), false},
                                 {right.edge, false}});
    }
  }

  void ends() {
    for (const bool top : {false, true}) {
      const auto& ring = top ? high_ring_ : low_ring_;
      const auto& side = top ? high_side_ : low_side_;
      const auto& rims = top ? high_rim_ : low_rim_;
      // Counter-clockwise seen against the axis: round outside, up the right side, back inside, down the left side.
      std::vector<BrepUse> loop = {{ring.at(1), true}};
      const auto climb = [&](double sense, bool outside, bool up) {
        if (side_ > 0.0) loop.push_back({side.at(index(sense, outside)), up});
      };
      climb(-1.0, true, true);
      loop.push_back({rims.at(1), true});
      climb(-1.0, false, false);
      loop.push_back({ring.at(0), false});
      climb(1.0, false, true);
      loop.push_back({rims.at(0), true});
      climb(1.0, true, false);
      if (!top) {
        std::reverse(loop.begin(), loop.end());
        for (BrepUse& use : loop) use.forward = !use.forward;
      }
      add_face(ring_plane(top ? length_ : 0.0, top ? end_ : start_, top), std::move(loop));
    }
  }

  TubeGore gore_;
  double inner_;
  double outer_;
  double side_;
  double length_;
  double start_;
  double end_;
  Brep brep_;
  std::array<Lengthwise, 4> round_{};
  std::array<Lengthwise, 4> rim_{};
  std::array<std::size_t, 2> low_ring_{};  ///< inner, outer
  std::array<std::size_t, 2> high_ring_{};
  std::array<std::size_t, 4> low_side_{};
  std::array<std::size_t, 4> high_side_{};
  std::array<std::size_t, 2> low_rim_{};  ///< left, right
  std::array<std::size_t, 2> high_rim_{};
};

}  // namespace

Brep brep_of_trough(const TroughGore& gore, const ShopPart& part) {
  if (!(gore.inner_radius > 0.0) || !(gore.thickness > 0.0) || !(gore.side >= 0.0))
    throw bad_body(part, "its radius, thickness or side is not positive");
  const double outer = gore.inner_radius + gore.thickness;
  const double turn = math::tan(gore.end_tilt.radians()) - math::tan(gore.start_tilt.radians());
  if (!(gore.length - outer * turn > 0.0) || !(gore.length + gore.side * turn > 0.0))
    throw bad_body(part, "its end planes meet inside the trough: length " + length_text(gore.length));
  return TroughFaces(gore).whole();
}

}  // namespace glissade::parts
