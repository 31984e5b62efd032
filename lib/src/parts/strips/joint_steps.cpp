#include "parts/strips/joint_steps.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/placed_piece.hpp"
#include "parts/plates/frame_holes.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/equal_parts.hpp"
#include "parts/shop/shop_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace glissade::parts {
namespace {

constexpr double kBeside = 0.5e-3;  // from a joint to where faces are felt for [m]
constexpr double kAbove = 5e-3;

/// The pieces about a place.
class Solid {
 public:
  Solid(const std::vector<PlacedPiece>& pieces, Vec3 about) {
    constexpr double kRoom = 60e-3;
    for (const PlacedPiece& piece : pieces) {
      if (piece.part->stands || piece.part->bought_in) continue;
      if (piece.near(in_own(piece.place, about), kRoom)) pieces_.push_back(&piece);
    }
  }

  [[nodiscard]] double depth(Vec3 point) const {
    double deepest = -std::numeric_limits<double>::infinity();
    for (const PlacedPiece* const piece : pieces_)
      deepest = std::max(deepest, depth_inside(piece->part->body, in_own(piece->place, point)));
    return deepest;
  }

 private:
  std::vector<const PlacedPiece*> pieces_;
};

/// How far out the uppermost face stands.
std::optional<double> face_of(const Solid& solid, Vec3 at, Vec3 out, double reach) {
  // As a rule it is where it should be: just below it the depth is the distance from it.
  constexpr double kBelow = 0.1e-3;
  constexpr double kOther = 0.9;  // of the distance to whatever else is near: the end of the piece
  const double just_below = solid.depth(at - kBelow * out);
  if (just_below > 0.0 && just_below < kOther * kBeside &&
      !(solid.depth(at + 1.1 * (just_below - kBelow) * out + 1e-6 * out) > 0.0))
    return just_below - kBelow;
  constexpr double kStep = 0.2e-3;
  double above = kAbove;
  double below = kAbove;
  while (below > -reach && !(solid.depth(at + below * out) > 0.0)) {
    above = below;
    below -= kStep;
  }
  if (!(below > -reach) || above == below) return std::nullopt;
  constexpr int kHalvings = 40;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (above + below);
    (solid.depth(at + middle * out) > 0.0 ? below : above) = middle;
  }
  return 0.5 * (above + below);
}

/// Where the face comes to the joint: a parabola through three places beside it.
std::optional<double> face_at_joint(const Solid& solid, const FacePlace& place, double sense) {
  std::array<double, 3> heights{};
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double beside = sense * (place.clear + kBeside * static_cast<double>(k + 1));
    const auto height = face_of(solid, place.at + beside * place.along, place.out, place.below);
    if (!height) return std::nullopt;
    heights[k] = *height;
  }
  const double t = 1.0 + place.clear / kBeside;
  return 0.5 * (t + 1.0) * (t + 2.0) * heights[0] - t * (t + 2.0) * heights[1] +
         0.5 * t * (t + 1.0) * heights[2];
}

/// By how much two frames may shift on each other, sideways: holes of a medium and a coarse fit about one bolt.
double play_of(const FlangeOptions& flanges) {
  if (!flanges.wanted) return 0.0;
  const double bolt = 1e-3 * flanges.bolt;
  return 0.5 * (clearance_hole(flanges.bolt, HoleFit::medium) - bolt) +
         0.5 * (clearance_hole(flanges.bolt, HoleFit::coarse) - bolt);
}

double deepest(const PlateOptions& options) {
  return options.liner ? 0.5 * options.liner->thickness : FacePlace().below;
}

std::string at_joint(const std::string& what, double s) {
  return what + " at the joint " + length_text(s, 3) + " along the track";
}

std::optional<double> step_between(const std::vector<PlacedPiece>& pieces, const FacePlace& place) {
  const Solid solid(pieces, place.at);
  const auto before = face_at_joint(solid, place, -1.0);
  const auto after = face_at_joint(solid, place, 1.0);
  if (!before || !after) return std::nullopt;
  return *after - *before;
}

}  // namespace

std::optional<double> step_at(const Workshop& workshop, const FacePlace& place) {
  return step_between(placed_pieces(workshop), place);
}

void measure_steps(const std::vector<FacePlace>& places, const PlateOptions& options, WorkshopBuild& build) {
  ShopFacts facts(build.workshop);
  const std::vector<PlacedPiece> pieces =
      places.empty() ? std::vector<PlacedPiece>() : placed_pieces(build.workshop);
  for (const FacePlace& place : places) {
    auto step = step_between(pieces, place);
    if (!step) continue;
    // What no gauge sees is rounding of places.
    if (std::fabs(*step) < kSamePart) step = 0.0;
    facts.at(place.where, "step_up", *step - options.joint_step);
    build.ride.highest_step = std::max(build.ride.highest_step, *step);
  }
  if (build.joints.size() < 3) return;
  build.ride.joint_step = options.joint_step;
  const double sideways = play_of(options.flanges);
  build.ride.joint_play = sideways + slot_reach(options.flanges);
  if (!(build.ride.joint_play > 0.0)) return;
  const std::string flush =
      "Faces are held flush at joints, downstream never higher, before bolts are tightened: their ";
  build.workshop.notes.push_back(
      options.flanges.slotted
          ? flush + "slots let units shift by " + length_text(build.ride.joint_play) + " up or down, by " +
                length_text(sideways) + " to either side."
          : flush + "holes let units shift by " + length_text(build.ride.joint_play) + " either way.");
}

std::vector<FacePlace> channel_places(const Job& job, const std::vector<double>& joints) {
  std::vector<FacePlace> places;
  const ChannelMeasures& channel = job.channel;
  const Vec3 left = across(job.placement);
  const double lowest = deepest(job.options);
  const double clear = job.options.liner ? 0.5 * job.options.liner->gap : 0.0;
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const TrackFrame frame = frame_at(job.track, joints[i]);
    const Vec3 at = in_space(job.placement, frame.at);
    const Vec3 along = direction_in_space(job.placement, frame.along);
    const Vec3 up = direction_in_space(job.placement, frame.up);
    for (const double aside : {-0.31, 0.29})
      places.push_back(
          {at_joint("floor", joints[i]), at + aside * channel.width * left, along, up, lowest, clear});
    if (!(channel.wall_height > 0.0)) continue;
    for (const double side : {1.0, -1.0}) {
      const Vec3 wall = at + 0.5 * side * channel.width * left + 0.5 * channel.wall_height * up;
      places.push_back(
          {at_joint(side > 0.0 ? "left wall" : "right wall", joints[i]), wall, along, -side * left});
    }
  }
  return places;
}

std::vector<FacePlace> section_places(const StripJob& job, const std::vector<double>& joints) {
  std::vector<FacePlace> places;
  const Vec3 left = across(job.placement);
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const TrackFrame frame = frame_at(job.track, joints[i]);
    const Vec3 along = direction_in_space(job.placement, frame.along);
    const Vec3 up = direction_in_space(job.placement, frame.up);
    const auto in_section = [&](Vec2 corner) { return corner.x * left + corner.y * up; };
    const auto placed = [&](Vec2 corner) {
      return job.widens() ? job.at(corner, job.wider_at(joints[i]), job.lean_at(joints[i])) : corner;
    };
    for (std::size_t p = 0; p < job.section.plates.size(); ++p) {
      const SectionPlate& plate = job.section.plates[p];
      const auto lined = std::find_if(job.section.lined.begin(), job.section.lined.end(),
                                      [&](const LinedFace& face) { return face.plate == p; });
      const bool tiles = lined != job.section.lined.end();
      const Vec2 from = placed(tiles ? lined->from : plate.face_from);
      const Vec2 to = placed(tiles ? lined->to : plate.face_to);
      const Vec2 square = plate.middle_from() + plate.middle_to() - plate.face_from - plate.face_to;
      const Vec2 way = to - from;
      if (!(norm(way) > 0.0)) continue;
      // Off the middle, where a floor may have a seam.
      const Vec2 at = from + 0.37 * way;
      Vec2 out = (1.0 / norm(way)) * Vec2{-way.y, way.x};
      if (dot(out, square) > 0.0) out = -1.0 * out;
      places.push_back({at_joint(plate.name, joints[i]), in_space(job.placement, frame.at) + in_section(at),
                        along, in_section(out), tiles ? deepest(job.options) : FacePlace().below,
                        tiles ? 0.5 * job.options.liner->gap : 0.0});
    }
  }
  return places;
}

}  // namespace glissade::parts
