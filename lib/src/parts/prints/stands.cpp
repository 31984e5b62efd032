// Stands of prints: a trapezoid below the run with the shape of its underside on top, and a cheek on either side. Three
// prisms beside one another across the run that share their corners: no boolean operation.

#include "parts/prints/stands.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/piece_mesh.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/supports/ground.hpp"
#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kSpreadOfBed = 0.25;  // the most of it
constexpr double kSpread = 0.15;       // of the foot on both sides, over the height
constexpr int kTopPieces = 12;         // chords of the top edge
constexpr double kCheeks = 2.4e-3;     // thickness: six lines of a 0.4 mm nozzle [m]

/// The run's underside as a line in the plane of the track.
class Underside {
 public:
  explicit Underside(const PrintJob& job) : job_(job), height_(std::min(job.section.lowest(), 0.0)) {}

  [[nodiscard]] Vec2 at(double s) const {
    const TrackFrame frame = frame_at(job_.track, std::clamp(s, 0.0, job_.track.length()));
    return frame.at + height_ * frame.up;
  }
  /// @return the arc length below which the underside has an x; between 0 and the length of the track
  [[nodiscard]] double above(double x) const {
    double low = 0.0;
    double high = job_.track.length();
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (at(middle).x < x ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  [[nodiscard]] double lowest() const {
    double least = 0.0;
    constexpr int kPlaces = 400;
    for (int k = 0; k <= kPlaces; ++k) least = std::min(least, at(job_.track.length() * k / kPlaces).y);
    return least;
  }

 private:
  const PrintJob& job_;
  double height_;
};

struct Place {
  double x = 0.0;
  std::string what;
};

/// Where stands are asked for.
struct Places {
  std::vector<Place> free;
  std::vector<Place> steep;  ///< where the run is too steep for one
  double steepest = 0.0;     ///< slope angle of the run above those [rad]
};

/// Puts a place where it belongs.
void add_place(const PrintJob& job, const Underside& underside, Place place, Places& places) {
  const double slope = std::fabs(job.track.slope_angle(underside.above(place.x)));
  if (slope <= job.options.stands->steepest.radians()) {
    places.free.push_back(std::move(place));
    return;
  }
  places.steep.push_back(std::move(place));
  places.steepest = std::max(places.steepest, slope);
}

/// Says where the run is too steep for the stands that are asked for.
void tell_steep(const PrintJob& job, const Places& places, Workshop& workshop) {
  if (places.steep.empty()) return;
  constexpr std::size_t kTold = 6;  // taste: of places
  std::vector<std::string> words;
  for (std::size_t i = 0; i < places.steep.size() && i < kTold; ++i)
    words.push_back(places.steep[i].what + ", " + length_text(places.steep[i].x, 3) + " out");
  if (places.steep.size() > kTold) words.push_back(std::to_string(places.steep.size() - kTold) + " more");
  std::string listed;
  for (const std::string& word : words) listed += (listed.empty() ? "" : "; ") + word;
  const Angle steepest = Angle::from_radians(places.steepest);
  const Angle enough = Angle::from_degrees(std::ceil(steepest.degrees()));
  add_shortfall({"stands.steepest",
                 "steepest: " + std::to_string(places.steep.size()) + " of " +
                     std::to_string(places.steep.size() + places.free.size()) + " stands find no place (" +
                     listed + "), where the run is up to " + angle_text(steepest, 3) + " steep",
                 "None stands below a run steeper than " + angle_text(job.options.stands->steepest, 3) + ".",
                 "steepest: " + angle_text(enough) + ", or a stand of your own there"},
                workshop);
}

/// Joints, both ends, and places between.
Places places_of(const PrintJob& job, const Underside& underside, const std::vector<double>& joints) {
  const StandOptions& options = *job.options.stands;
  const double inset = 0.5 * options.thickness + 2e-3;
  if (underside.at(job.track.length()).x - underside.at(0.0).x < 2.0 * inset) {
    throw InputError({"stands.thickness",
                      "thickness: stands of " + length_text(options.thickness) +
                          " along the run find no place below a run of " +
                          length_text(underside.at(job.track.length()).x - underside.at(0.0).x, 3),
                      "One stands below it at least.", "a smaller thickness, or stands: none"});
  }
  Places fixed;
  const double start = underside.at(0.0).x + inset;
  const double finish = underside.at(job.track.length()).x - inset;
  add_place(job, underside, {start, "start"}, fixed);
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const double x = underside.at(joints[i]).x;
    if (x > start + inset && x < finish - inset)
      add_place(job, underside, {x, "joint " + std::to_string(i)}, fixed);
  }
  if (finish > start + inset) add_place(job, underside, {finish, "finish"}, fixed);
  Places places;
  places.steep = std::move(fixed.steep);
  places.steepest = fixed.steepest;
  for (const Place& place : fixed.free) {
    if (!places.free.empty()) {
      const double from = places.free.back().x;
      const double count = std::ceil((place.x - from) / options.spacing - 1e-9);
      for (double k = 1.0; k < count; k += 1.0)
        add_place(job, underside, {from + (place.x - from) * k / count, "stretch"}, places);
    }
    places.free.push_back(place);
  }
  return places;
}

/// Corners of a stand in its plane: two of the foot, right and left end of the top, the same of the cheeks; the top from
/// left to right.
struct Shape {
  std::array<Vec2, 2> foot;
  std::vector<Vec2> top;
  double cheek = 0.0;
};

Shape shape_of(const PrintJob& job, const Underside& underside, double x, double ground) {
  const StandOptions& options = *job.options.stands;
  Shape shape;
  shape.cheek = std::min(options.cheek, 0.8 * (job.face.high().y - job.face.low().y)) + options.fit;
  const double from = underside.above(x - 0.5 * options.thickness);
  const double to = underside.above(x + 0.5 * options.thickness);
  for (int k = 0; k <= kTopPieces; ++k) {
    const TrackFrame frame = frame_at(job.track, from + (to - from) * k / kTopPieces);
    const Vec2 point = underside.at(from + (to - from) * k / kTopPieces) - options.fit * frame.up;
    shape.top.push_back(point - Vec2{x, 0.0});
  }
  const double height = std::max(shape.top.front().y, shape.top.back().y) - ground;
  const PrintBed& bed = job.options.split.bed;
  const double spread = std::min(kSpread * height, kSpreadOfBed * (std::min(bed.x, bed.y) - 2.0 * bed.gap));
  shape.foot = {Vec2{shape.top.front().x - spread, ground}, Vec2{shape.top.back().x + spread, ground}};
  return shape;
}

/// The highest ground below the foot of a stand, which is level.
double ground_below(const PrintJob& job, const Underside& underside, double x) {
  const std::vector<Vec2>& ground = job.options.stands->ground;
  // The higher it stands, the narrower is its foot.
  constexpr int kRounds = 20;  // accuracy: each leaves a fifth of the last, however steep the ground
  double level = ground_at(ground, x);
  for (int k = 0; k < kRounds; ++k) {
    const Shape shape = shape_of(job, underside, x, level);
    level = highest_ground(ground, x + shape.foot[0].x, x + shape.foot[1].x);
  }
  return level;
}

/// The mesh of a stand, by layers across the run: outside and inside of the right cheek, of the left one.
class StandMesh {
 public:
  StandMesh(const Shape& shape, const std::array<double, 4>& across) : across_(across) {
    const Vec2 up{0.0, shape.cheek};
    // Counter-clockwise round the outside: foot, right end of the top, cheek, left end of the top.
    outer_ = {shape.foot[0],         shape.foot[1],          shape.top.back(),
              shape.top.back() + up, shape.top.front() + up, shape.top.front()};
    inner_.assign(shape.top.rbegin() + 1, shape.top.rend() - 1);
    for (std::size_t layer = 0; layer < 4; ++layer) add_layer(layer);
    for (std::size_t layer = 0; layer < 3; ++layer) join(layer);
    cap(outer(0), false);
    cap(outer(3), true);
    cap(notch(1), true);
    cap(notch(2), false);
  }

  [[nodiscard]] TriangleMesh take() && { return std::move(mesh_); }
  [[nodiscard]] double volume() const {
    std::vector<Vec2> middle(outer_.begin(), outer_.begin() + 3);
    middle.insert(middle.end(), inner_.begin(), inner_.end());
    middle.push_back(outer_[5]);
    return area_of(outer_) * (across_[1] - across_[0] + across_[3] - across_[2]) +
           area_of(middle) * (across_[2] - across_[1]);
  }

 private:
  using Corners = std::vector<std::uint32_t>;

  void add_layer(std::size_t layer) {
    first_[layer] = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Vec2 point : outer_) mesh_.vertices.push_back({point.x, across_[layer], point.y});
    if (layer == 1 || layer == 2) {
      for (const Vec2 point : inner_) mesh_.vertices.push_back({point.x, across_[layer], point.y});
    }
  }
  [[nodiscard]] Corners outer(std::size_t layer) const {
    Corners corners(outer_.size());
    std::iota(corners.begin(), corners.end(), first_[layer]);
    return corners;
  }
  /// The top from right to left, both ends included.
  [[nodiscard]] Corners top(std::size_t layer) const {
    Corners corners = {first_[layer] + 2};
    for (std::uint32_t i = 0; i < inner_.size(); ++i)
      corners.push_back(first_[layer] + static_cast<std::uint32_t>(outer_.size()) + i);
    corners.push_back(first_[layer] + 5);
    return corners;
  }
  /// The inside of a cheek, counter-clockwise: the top from left to right, then back over the cheek.
  [[nodiscard]] Corners notch(std::size_t layer) const {
    Corners corners = top(layer);
    std::reverse(corners.begin(), corners.end());
    corners.push_back(first_[layer] + 3);
    corners.push_back(first_[layer] + 4);
    return corners;
  }
  void strip(const Corners& here, const Corners& next) {
    for (std::size_t i = 0; i + 1 < here.size(); ++i) {
      mesh_.triangles.push_back({here[i], next[i], next[i + 1]});
      mesh_.triangles.push_back({here[i], next[i + 1], here[i + 1]});
    }
  }
  void join(std::size_t layer) {
    const std::uint32_t a = first_[layer];
    const std::uint32_t b = first_[layer + 1];
    strip({a + 5, a, a + 1, a + 2}, {b + 5, b, b + 1, b + 2});
    if (layer == 1) {
      strip(top(1), top(2));
    } else {
      strip({a + 2, a + 3, a + 4, a + 5}, {b + 2, b + 3, b + 4, b + 5});
    }
  }
  void cap(const Corners& corners, bool to_left) {
    std::vector<Vec2> seen;
    for (const std::uint32_t corner : corners)
      seen.push_back({mesh_.vertices[corner].x, mesh_.vertices[corner].z});
    for (const auto& triangle : solid::triangulate_loops({seen})) {
      std::array<std::uint32_t, 3> put = {corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]};
      if (to_left) std::swap(put[1], put[2]);
      mesh_.triangles.push_back(put);
    }
  }

  std::array<double, 4> across_;
  std::vector<Vec2> outer_;
  std::vector<Vec2> inner_;
  std::array<std::uint32_t, 4> first_{};
  TriangleMesh mesh_;
};

/// Refuses a ground that is in the way.
void require_room(const PrintJob& job, const Place& place, double s, double clear) {
  if (clear >= kLeastStand) return;
  const std::string where =
      "at x = " + length_text(place.x, 3) + " from the start, " + length_text(s, 3) + " along the track";
  throw InputError(
      {"stands.ground",
       "ground: it leaves " + length_text(std::max(clear, 0.0), 3) + " below the run " + where +
           (clear < 0.0 ? ", where it lies " + length_text(-clear, 3) + " too high" : ""),
       "A stand is at least " + length_text(kLeastStand) + " high.",
       "a lower ground, or none: then it is " + length_text(job.options.stands->clear) + " below the run"});
}

/// The corners of a stand at a height, on its left and right edge.
std::array<Vec2, 2> edges_at(const Shape& shape, double height) {
  const auto between = [&](Vec2 foot, Vec2 top) {
    return foot + ((height - foot.y) / (top.y - foot.y)) * (top - foot);
  };
  return {between(shape.foot[0], shape.top.front()), between(shape.foot[1], shape.top.back())};
}

/// A block below the uppermost one: a trapezoid.
StandBlock lower_block(const Shape& shape, const std::array<double, 4>& across, double from, double to) {
  const std::array<Vec2, 2> low = edges_at(shape, from);
  const std::array<Vec2, 2> high = edges_at(shape, to);
  const std::vector<Vec2> corners = {low[0], low[1], high[1], high[0]};
  StandBlock block;
  for (const double y : {across.front(), across.back()}) {
    for (const Vec2 corner : corners) block.mesh.vertices.push_back({corner.x, y, corner.y});
  }
  block.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    block.mesh.triangles.push_back({i, i + 4, next + 4});
    block.mesh.triangles.push_back({i, next + 4, next});
  }
  block.volume = area_of(corners) * (across.back() - across.front());
  return block;
}

/// Holes for pins in a level face of a block.
void sink_pins(StandBlock& block, double height, bool in_top, const std::vector<Vec3>& pins,
               const DowelOptions& dowels) {
  const FacePlane face{{0.0, 0.0, height}, {1.0, 0.0, 0.0}, {0.0, in_top ? 1.0 : -1.0, 0.0}};
  std::vector<Recess> holes;
  for (const Vec3& pin : pins) {
    holes.push_back(round_hole({pin.x, in_top ? pin.y : -pin.y}, kStandPin + dowels.fit, kStandPinDepth,
                               std::min(dowels.chamfer, 1e-3)));
    block.volume -= holes.back().volume();
  }
  sink(block.mesh, face, holes);
}

/// Two pins across a level cut; none where it is too small for them.
std::vector<Vec3> pins_at(const Shape& shape, const std::array<double, 4>& across, double height) {
  const std::array<Vec2, 2> edges = edges_at(shape, height);
  const double wide = across.back() - across.front();
  if (edges[1].x - edges[0].x < 2.0 * kStandPin || wide < 5.0 * kStandPin) return {};
  const double middle = 0.5 * (edges[0].x + edges[1].x);
  const double centre = 0.5 * (across.front() + across.back());
  return {{middle, centre - 0.25 * wide, height}, {middle, centre + 0.25 * wide, height}};
}

/// Heights between which the blocks of a stand lie, from its ground up: of one height, but for an uppermost one whose top is so uneven that it
/// has to be higher.
std::vector<double> cuts_of(const Shape& shape, double ground, double height, double count) {
  const double lowest = std::min(shape.top.front().y, shape.top.back().y);
  const double last = ground + height - (lowest - kStandPinDepth - kLeastStand);
  const bool even = count == 1.0 || height / count >= last;
  std::vector<double> cuts = {ground};
  for (double k = 1.0; k < count; k += 1.0)
    cuts.push_back(ground + (even ? height * k / count : (height - last) * k / (count - 1.0)));
  cuts.push_back(ground + height);
  return cuts;
}

/// @return the heaviest block between cuts [kg], without the holes of its pins
double heaviest_block(const PrintJob& job, const Shape& shape, const std::array<double, 4>& across,
                      const std::vector<double>& cuts) {
  double most = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    Shape upper = shape;
    upper.foot = edges_at(shape, cuts[k]);
    const double volume = k + 2 == cuts.size() ? StandMesh(upper, across).volume()
                                               : lower_block(shape, across, cuts[k], cuts[k + 1]).volume;
    most = std::max(most, volume * job.options.material.density);
  }
  return most;
}

double highest_block(const std::vector<double>& cuts) {
  double most = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) most = std::max(most, cuts[k + 1] - cuts[k]);
  return most;
}

/// As few blocks as the printer's room and the heaviest part ask for.
/// @throws InputError where the uppermost one is too high or too heavy
std::vector<double> cuts_for(const PrintJob& job, const Shape& shape, const std::array<double, 4>& across,
                             const Stand& stand, double height) {
  const auto& heaviest = job.options.split.heaviest;
  const double room = job.options.split.bed.z - 1e-6;
  double count = std::ceil(height / room);
  std::vector<double> cuts = cuts_of(shape, stand.ground, height, count);
  if (count > 1.0 && !(cuts[1] > cuts[0] + kLeastStand && highest_block(cuts) <= room)) {
    throw InputError(
        {"stands.thickness",
         "thickness: " + length_text(job.options.stands->thickness) +
             " along the run makes the stand below " + stand.what + " " +
             length_text(std::fabs(shape.top.front().y - shape.top.back().y), 3) +
             " higher on one side than on the other",
         "No cut may pass its top, and the bed takes blocks of " + length_text(job.options.split.bed.z) + ".",
         "a smaller thickness, or a higher bed"});
  }
  while (heaviest && heaviest_block(job, shape, across, cuts) > *heaviest) {
    count += 1.0;
    std::vector<double> more = cuts_of(shape, stand.ground, height, count);
    // Pins of two cuts keep clear of one another.
    if (more[1] - more[0] >= 2.0 * kStandPinDepth + kLeastStand) {
      cuts = std::move(more);
      continue;
    }
    throw InputError({"split.heaviest",
                      "heaviest: " + quantity_text(*heaviest, Dimension::mass) +
                          " is less than a block of the stand below " + stand.what + " weighs, " +
                          quantity_text(heaviest_block(job, shape, across, cuts), Dimension::mass),
                      "It comes in blocks of " + length_text(highest_block(cuts), 3) +
                          " and less; lower ones have no room for pins, and no cut may pass its top.",
                      "a larger mass, or stands of a smaller thickness"});
  }
  return cuts;
}

/// A stand in blocks that the printer holds, pinned together.
void make_blocks(const PrintJob& job, const Shape& shape, const std::array<double, 4>& across, Stand& stand) {
  const double height = std::max(shape.top.front().y, shape.top.back().y) + shape.cheek - stand.ground;
  const std::vector<double> cuts = cuts_for(job, shape, across, stand, height);
  std::vector<Vec3> below;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const bool last = k + 2 == cuts.size();
    StandBlock block;
    if (last) {
      Shape upper = shape;
      upper.foot = edges_at(shape, cuts[k]);
      StandMesh mesh(upper, across);
      block.volume = mesh.volume();
      block.mesh = std::move(mesh).take();
    } else {
      block = lower_block(shape, across, cuts[k], cuts[k + 1]);
    }
    sink_pins(block, cuts[k], false, below, job.options.dowels);
    if (!last) {
      below = pins_at(shape, across, cuts[k + 1]);
      sink_pins(block, cuts[k + 1], true, below, job.options.dowels);
      stand.pins.insert(stand.pins.end(), below.begin(), below.end());
    }
    stand.blocks.push_back(std::move(block));
  }
}

void require_sound(const PrintJob& job, const Stand& stand) {
  for (const StandBlock& block : stand.blocks) {
    const MeshFacts facts = measure(block.mesh, job.stop);
    const double found = mesh_moments(block.mesh).volume;
    const bool as_meant = std::fabs(found - block.volume) <= 1e-9 * block.volume;
    if (facts.valid() && facts.components == 1 && as_meant) continue;
    throw InternalError({"", "the mesh of the stand below " + stand.what + " is faulty", "", ""});
  }
}

}  // namespace

std::vector<Stand> make_stands(const PrintJob& job, const std::vector<double>& joints, Workshop& workshop) {
  if (!job.options.stands) return {};
  const StandOptions& options = *job.options.stands;
  const Underside underside(job);
  const double level = underside.lowest() - options.clear;
  const std::array<double, 4> across = {job.face.low().x - options.fit - kCheeks,
                                        job.face.low().x - options.fit, job.face.high().x + options.fit,
                                        job.face.high().x + options.fit + kCheeks};
  Places found = places_of(job, underside, joints);
  tell_steep(job, found, workshop);
  const std::vector<Place> places = std::move(found.free);
  std::vector<Foot> feet;
  for (const Place& place : places)
    feet.push_back({place.x, frame_at(job.track, underside.above(place.x)).at.x});
  require_on_ground(options.ground, feet, "stands.ground", "a foot");
  std::vector<Stand> stands;
  for (const Place& place : places) {
    Stand stand;
    stand.at = underside.above(place.x);
    stand.what = place.what;
    stand.x = place.x;
    stand.ground = options.ground.empty() ? level : ground_below(job, underside, place.x);
    const Shape shape = shape_of(job, underside, place.x, stand.ground);
    require_room(job, place, stand.at, std::min(shape.top.front().y, shape.top.back().y) - stand.ground);
    make_blocks(job, shape, across, stand);
    require_sound(job, stand);
    stands.push_back(std::move(stand));
  }
  return stands;
}

}  // namespace glissade::parts
