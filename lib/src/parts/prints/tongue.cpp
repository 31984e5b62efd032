// Tongues and dovetails. The end face and both sides of a piece are flat; each gets new triangles between its edge, which
// follows the profile of the joint, and level strips go from side to side: no boolean operation.

#include "parts/prints/tongue.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kOnSide = 1e-9;       // [m]
constexpr double kShareOfBand = 0.5;   // height of a head over that of the band
constexpr double kDepthOfHead = 0.75;  // depth of a tongue over the height of its head

/// @return whether the section is full at a height, from its left end to its right end
bool full_at(const FaceOutline& face, double height) {
  std::vector<double> crossings;
  for (const auto& loop : face.loops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if ((a.y > height) == (b.y > height)) continue;
      crossings.push_back(a.x + (height - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  if (crossings.size() != 2) return false;
  const auto [left, right] = std::minmax(crossings[0], crossings[1]);
  return left - face.low().x < kOnSide && face.high().x - right < kOnSide;
}

/// What a layer of a notch's roof may bridge without support [m].
constexpr double kBridge = 1e-3;

bool tapers(const PrintOptions& options, PrintPose kind) {
  return options.joint == PrintJoint::tongue && kind != PrintPose::side;
}

/// Slope of the flanks of a strip that tapers: no steeper than hangs over by itself, and none that hides the strip.
double taper_of(const PrintOptions& options) {
  constexpr double kLeast = 0.2;
  constexpr double kMost = 1.0;
  return std::clamp(math::tan(std::min(options.overhang.radians(), 1.0)), kLeast, kMost);
}

double spread_of(const PrintOptions& options, PrintPose kind, double depth) {
  if (tapers(options, kind)) return -depth * taper_of(options);
  return options.joint == PrintJoint::dovetail ? depth * math::tan(options.tongue.flare.radians()) : 0.0;
}

/// What a tongue takes of a band beside its own height: fit and wall, below and above.
double beside_tongue(const PrintOptions& options) {
  return 2.0 * (options.wall + options.tongue.fit) + options.ease;
}

double head_height(const PrintOptions& options, const LevelBand& band) {
  const double height = band.high - band.low;
  return options.tongue.height.value_or(std::min(kShareOfBand * height, height - beside_tongue(options)));
}

/// The greatest height of a tongue: of its head, of one that tapers of its root.
Tongue tongue_of(const PrintOptions& options, PrintPose kind, const LevelBand& band, double depth) {
  Tongue tongue;
  const double spread = spread_of(options, kind, depth);
  const double head = head_height(options, band) + 2.0 * std::min(0.0, spread);
  const double middle = 0.5 * (band.low + band.high - options.ease);
  tongue.band = band;
  tongue.spread = spread;
  tongue.low = middle - 0.5 * head + tongue.spread;
  tongue.high = middle + 0.5 * head - tongue.spread;
  tongue.depth = depth;
  tongue.fit = options.tongue.fit;
  if (options.joint == PrintJoint::dovetail && kind == PrintPose::end) tongue.roof = taper_of(options);
  tongue.chamfer = std::min({options.tongue.chamfer, 0.25 * head, 0.25 * depth});
  return tongue;
}

/// The least wall below and above the notch of a joint: the track bends away from it.
double wall_at(const PrintJob& job, double s, const Tongue& tongue) {
  const TrackFrame joint = frame_at(job.track, s);
  double least = tongue.band.high - tongue.band.low;
  for (const Vec2 corner : tongue.notch()) {
    const Vec2 point = joint.at + corner.x * joint.along + corner.y * joint.up;
    double near = s + corner.x;
    double height = corner.y;
    for (int round = 0; round < 4; ++round) {
      near = std::clamp(near, 0.0, job.track.length());
      const TrackFrame at = frame_at(job.track, near);
      height = dot(point - at.at, at.up);
      const double stretch = 1.0 - job.track.at(near).curvature * height;
      if (stretch > 0.1) near += dot(point - at.at, at.along) / stretch;
    }
    const double eased = corner.x < job.options.ease ? job.options.ease : 0.0;
    least = std::min({least, height - tongue.band.low, tongue.band.high - eased - height});
  }
  return least;
}

std::string word_of(PrintJoint joint) {
  return joint == PrintJoint::dovetail ? "dovetail" : "tongue";
}

/// The edge round a flat face from one of its vertices to another and back, without what lay between them: corners of levels
/// of the sweep that the first way passes.
std::vector<std::uint32_t> without_between(const std::vector<std::uint32_t>& loop, std::uint32_t from,
                                           std::uint32_t to) {
  const auto first = std::find(loop.begin(), loop.end(), from);
  const auto last = std::find(loop.begin(), loop.end(), to);
  if (first == loop.end() || last == loop.end())
    throw InternalError({"", "a side of a piece is not flat to its end", "", ""});
  std::vector<std::uint32_t> rest;
  for (auto at = last; at != first;) {
    rest.push_back(*at);
    if (++at == loop.end()) at = loop.begin();
  }
  rest.push_back(from);
  return rest;
}

void fill(TriangleMesh& mesh, const FacePlane& plane, const std::vector<std::uint32_t>& loop) {
  std::vector<Vec2> seen;
  seen.reserve(loop.size());
  for (const std::uint32_t vertex : loop) seen.push_back(plane.see(mesh.vertices[vertex]));
  for (const auto& triangle : solid::triangulate_loops({seen}))
    mesh.triangles.push_back({loop[triangle[0]], loop[triangle[1]], loop[triangle[2]]});
}

/// Where the edge of an end face runs up its right side and down its left one, past the heights of a profile.
struct EndEdge {
  std::vector<std::uint32_t> loop;
  std::size_t right_low = 0;  ///< places in the loop: below the profile, and the next one above it
  std::size_t right_high = 0;
  std::size_t left_high = 0;
  std::size_t left_low = 0;
};

EndEdge end_edge(const TriangleMesh& mesh, const FacePlane& end, std::vector<std::uint32_t> loop, double low,
                 double high) {
  EndEdge edge{std::move(loop), 0, 0, 0, 0};
  double most = 0.0;
  double least = 0.0;
  for (const std::uint32_t vertex : edge.loop) {
    most = std::max(most, end.see(mesh.vertices[vertex]).x);
    least = std::min(least, end.see(mesh.vertices[vertex]).x);
  }
  const std::size_t count = edge.loop.size();
  const auto seen = [&](std::size_t i) { return end.see(mesh.vertices[edge.loop[i % count]]); };
  // From a corner on one side past the heights between; levels of the sweep may have corners there.
  const auto past = [&](std::size_t from, double x, double bottom, double top,
                        double sense) -> std::optional<std::size_t> {
    const auto on = [&](std::size_t i) { return std::fabs(seen(i).x - x) < kOnSide; };
    if (!on(from) || !(sense * seen(from).y < sense * bottom)) return std::nullopt;
    for (std::size_t k = from + 1; k < from + count && on(k); ++k) {
      if (sense * seen(k).y > sense * top) return k % count;
      if (sense * seen(k).y < sense * bottom) return std::nullopt;
    }
    return std::nullopt;
  };
  int found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto to = past(i, most, low, high, 1.0)) edge.right_low = i, edge.right_high = *to, ++found;
    if (const auto to = past(i, least, high, low, -1.0)) edge.left_high = i, edge.left_low = *to, ++found;
  }
  if (found != 2) throw InternalError({"", "an end face has no upright sides where its tongue is", "", ""});
  return edge;
}

/// The corners of a loop from one place to another, both included.
std::vector<std::uint32_t> stretch(const std::vector<std::uint32_t>& loop, std::size_t from, std::size_t to) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = from % loop.size();; i = (i + 1) % loop.size()) {
    corners.push_back(loop[i]);
    if (i == to % loop.size()) return corners;
  }
}

/// Gives the flat side of a piece an edge that follows a profile from one of its corners to another.
/// @param corners  of the profile, in the order of the side's edge
void reshape_side(TriangleMesh& mesh, const FacePlane& side, std::uint32_t from, std::uint32_t to,
                  const std::vector<std::uint32_t>& corners) {
  const std::vector<std::vector<std::uint32_t>> loops = take_flat_face(mesh, side);
  for (std::vector<std::uint32_t> loop : loops) {
    if (std::find(loop.begin(), loop.end(), from) == loop.end()) {
      fill(mesh, side, loop);
      continue;
    }
    loop = without_between(loop, from, to);
    loop.insert(loop.end(), corners.begin(), corners.end());
    fill(mesh, side, loop);
  }
}

/// Of a dovetail whose flare leaves too little at its root.
InputError thin_neck(const PrintOptions& options, const Tongue& tongue) {
  const double head = tongue.high - tongue.low + 2.0 * tongue.spread;
  const double slope = tongue.spread / tongue.depth;
  const double deepest = std::floor(0.5 * (head - options.wall) / slope * 1e5) * 1e-5;
  const std::string key = options.tongue.depth ? "depth" : "flare";
  return InputError({"tongue." + key,
                     key + ": a " + word_of(options.joint) + " of " + length_text(tongue.depth, 3) +
                         " with a head of " + length_text(head, 3) + " has a neck of " +
                         length_text(std::max(0.0, tongue.high - tongue.low), 3),
                     "The printer's least wall is " + length_text(options.wall) + "; a flare of " +
                         angle_text(options.tongue.flare) + " takes from both sides.",
                     (deepest > 0.0 ? "depth: " + length_text(deepest) + ", " : "") +
                         "a smaller flare, a greater height, or joint: dowels"});
}

InputError thin_beside(const PrintOptions& options, double thinnest, double where, double wanted) {
  const std::string word = word_of(options.joint);
  const auto [wall, least] = texts_apart(std::max(0.0, thinnest), options.wall, &length_text, 3);
  return InputError(
      {options.tongue.depth ? "tongue.depth" : "joint",
       (options.tongue.depth ? "depth: a " + word + " of " + length_text(wanted, 3) : "joint: a " + word) +
           " leaves a wall of " + wall + " at the joint " + length_text(where, 3) + " along the track",
       "The printer's least wall is " + least + "; the track bends away from the notch, whose root is " +
           least + " thick at least.",
       "a smaller depth or height, a thicker section, or joint: dowels"});
}

}  // namespace

std::optional<LevelBand> level_band(const FaceOutline& face) {
  std::vector<double> heights;
  for (const auto& loop : face.loops()) {
    for (const Vec2 corner : loop) heights.push_back(corner.y);
  }
  std::sort(heights.begin(), heights.end());
  std::optional<LevelBand> thickest;
  std::optional<LevelBand> open;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (heights[i + 1] - heights[i] < kOnSide) continue;
    if (!full_at(face, 0.5 * (heights[i] + heights[i + 1]))) {
      open.reset();
      continue;
    }
    open = LevelBand{open ? open->low : heights[i], heights[i + 1]};
    if (!thickest || open->high - open->low > thickest->high - thickest->low) thickest = open;
  }
  return thickest;
}

std::vector<Vec2> Tongue::profile() const {
  std::vector<Vec2> points = {{0.0, low}};
  const double slope = spread / depth;
  if (chamfer > 0.0) points.push_back({depth - chamfer, low - slope * (depth - chamfer)});
  points.push_back({depth, low - spread + chamfer});
  points.push_back({depth, high + spread - chamfer});
  if (chamfer > 0.0) points.push_back({depth - chamfer, high + slope * (depth - chamfer)});
  points.push_back({0.0, high});
  return points;
}

double Tongue::reach() const {
  const double bottom = depth + fit;
  const double half = 0.5 * (high - low) + fit + spread / depth * bottom;
  return roof > 0.0 ? bottom + std::max(0.0, half - 0.5 * kBridge) / roof : bottom;
}

std::vector<Vec2> Tongue::notch() const {
  const double slope = spread / depth;
  const double bottom = depth + fit;
  std::vector<Vec2> points = {{0.0, low - fit}, {bottom, low - fit - slope * bottom}};
  if (reach() > bottom) {
    const double middle = 0.5 * (low + high);
    points.push_back({reach(), middle - 0.5 * kBridge});
    points.push_back({reach(), middle + 0.5 * kBridge});
  }
  points.push_back({bottom, high + fit + slope * bottom});
  points.push_back({0.0, high + fit});
  return points;
}

std::optional<Issue> flare_problem(const PrintOptions& options) {
  const Angle flare = options.tongue.flare;
  if (flare.radians() <= options.overhang.radians() + 1e-9) return std::nullopt;
  return Issue{"tongue.flare",
               "flare: " + angle_text(flare) + " overhangs in pieces that stand on a joint face",
               "No more than " + angle_text(options.overhang) + " from upright prints without supports.",
               "flare: " + angle_text(options.overhang) + ", or pose: side"};
}

std::vector<Issue> tongue_problems(const CrossSection& section, const PrintOptions& options) {
  if (options.joint == PrintJoint::dowels) return {};
  const std::string word = word_of(options.joint);
  if (options.joint == PrintJoint::dovetail && options.pose == PrintPose::flat) {
    return {
        {"pose", "pose: a dovetail would overhang in pieces that lie as they are used",
         "It goes from side to side, wider at its head: the lower edge of the head would begin in the air.",
         "pose: side or end, or joint: tongue, which tapers then"}};
  }
  if (options.joint == PrintJoint::dovetail && options.pose == PrintPose::end) {
    if (auto issue = flare_problem(options)) return {std::move(*issue)};
  }
  const auto band = level_band(FaceOutline(section));
  if (!band) {
    return {{"joint", "joint: this section has no place for a " + word,
             "It takes a strip of material from one upright side to the other.", "joint: dowels"}};
  }
  const double height = band->high - band->low;
  const double head = head_height(options, *band);
  const double least = 2.0 * options.wall;
  if (head < least || head + beside_tongue(options) > height * (1.0 + 1e-12)) {
    const double needed = std::max(head, least) + beside_tongue(options);
    // That of tongues whose height is not asked for: it leaves room for a track that bends away.
    const double usual = std::min(kShareOfBand * height, height - beside_tongue(options));
    const double highest = std::floor(usual * 1e5) * 1e-5;
    const std::string lower =
        options.tongue.height && highest >= least ? "height: " + length_text(highest) + ", or " : "";
    return {{options.tongue.height ? "tongue.height" : "joint",
             (options.tongue.height ? "height: a " + word + " of " + length_text(head) : "joint: a " + word) +
                 " does not fit a section that is full from side to side over " + length_text(height, 3),
             "With walls of " + length_text(options.wall) + " and its fit it takes " +
                 length_text(needed, 3) + ".",
             lower + "a section as thick as that, or joint: dowels"}};
  }
  return {};
}

double tongue_reach(const PrintJob& job, PrintPose kind) {
  const PrintOptions& options = job.options;
  if (options.joint == PrintJoint::dowels) return 0.0;
  const auto band = level_band(job.face);
  if (!band) return 0.0;
  const double height = head_height(options, *band);
  if (!tapers(options, kind)) return options.tongue.depth.value_or(kDepthOfHead * height);
  // As deep as leaves a head that the roof of the notch bridges.
  const double deepest = 0.5 * (height - kBridge) / taper_of(options);
  return std::min(options.tongue.depth.value_or(deepest), std::max(deepest, 0.5 * kBridge));
}

std::optional<Tongue> place_tongue(const PrintJob& job, const PrintPlan& plan) {
  const PrintOptions& options = job.options;
  const std::vector<double>& joints = plan.joints;
  if (options.joint == PrintJoint::dowels || joints.size() < 3) return std::nullopt;
  const LevelBand band = *level_band(job.face);
  const double wanted = tongue_reach(job, plan.kind);
  double shortest = job.track.length();
  for (std::size_t i = 0; i + 1 < joints.size(); ++i)
    shortest = std::min(shortest, joints[i + 1] - joints[i]);
  double thinnest = 0.0;
  double where = joints[1];
  for (const double share : {1.0, 0.8, 0.6, 0.5}) {
    Tongue tongue = tongue_of(options, plan.kind, band, share * wanted);
    tongue.wall = band.high - band.low;
    for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
      const double wall = wall_at(job, joints[i], tongue);
      if (wall < tongue.wall) tongue.wall = wall, where = joints[i];
    }
    const bool neck = tongue.high - tongue.low >= options.wall;
    const bool room = tongue.depth + tongue.reach() - tongue.fit < shortest - options.wall;
    thinnest = tongue.wall;
    if (neck && room && tongue.wall >= options.wall * (1.0 - 1e-9)) return tongue;
    if (options.tongue.depth) break;
  }
  const Tongue tongue = tongue_of(options, plan.kind, band, wanted);
  if (tongue.high - tongue.low < options.wall) throw thin_neck(options, tongue);
  if (thinnest >= options.wall) {
    const std::string what = options.tongue.depth ? "depth" : "joint";
    throw InputError({options.tongue.depth ? "tongue.depth" : "joint",
                      what + ": a " + word_of(options.joint) + " of " + length_text(wanted, 3) +
                          " finds no room in pieces of " + length_text(shortest, 3),
                      "Tongue and notch leave the printer's least wall between them, " +
                          length_text(options.wall) + ", and a root as thick.",
                      "a larger overhang or bed, another pose, a smaller depth, or joint: dowels"});
  }
  throw thin_beside(options, thinnest, where, wanted);
}

std::array<std::vector<Vec2>, 2> shape_end(TriangleMesh& mesh, const FacePlane& end, Vec3 along,
                                           const std::vector<Vec2>& profile) {
  std::vector<std::vector<std::uint32_t>> loops = take_flat_face(mesh, end);
  if (loops.size() != 1) throw InternalError({"", "an end face with a tongue has a hole", "", ""});
  const EndEdge edge = end_edge(mesh, end, std::move(loops.front()), profile.front().y, profile.back().y);
  const auto corners_at = [&](std::uint32_t on_side) {
    const double x = end.see(mesh.vertices[on_side]).x;
    std::vector<std::uint32_t> corners;
    for (const Vec2 point : profile) {
      corners.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back(end.to_space({x, point.y}, 0.0) + point.x * along);
    }
    return corners;
  };
  const std::uint32_t right_low = edge.loop[edge.right_low];
  const std::uint32_t right_high = edge.loop[edge.right_high];
  const std::uint32_t left_high = edge.loop[edge.left_high];
  const std::uint32_t left_low = edge.loop[edge.left_low];
  std::vector<std::uint32_t> right = corners_at(right_low);
  const std::vector<std::uint32_t> left = corners_at(left_low);
  std::vector<std::uint32_t> lower = stretch(edge.loop, edge.left_low, edge.right_low);
  lower.push_back(right.front());
  lower.push_back(left.front());
  std::vector<std::uint32_t> upper = stretch(edge.loop, edge.right_high, edge.left_high);
  upper.push_back(left.back());
  upper.push_back(right.back());
  fill(mesh, end, lower);
  fill(mesh, end, upper);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    mesh.triangles.push_back({left[i], right[i], right[i + 1]});
    mesh.triangles.push_back({left[i], right[i + 1], left[i + 1]});
  }
  const auto side = [&](std::uint32_t vertex, double sense) {
    const Vec3 out = sense * end.right;
    return FacePlane{mesh.vertices[vertex], cross(end.up, out), end.up};
  };
  const FacePlane left_side = side(left_low, -1.0);
  const FacePlane right_side = side(right_low, 1.0);
  reshape_side(mesh, left_side, left_low, left_high, left);
  std::reverse(right.begin(), right.end());
  reshape_side(mesh, right_side, right_high, right_low, right);
  std::array<std::vector<Vec2>, 2> faces;
  for (const std::uint32_t vertex : lower) faces[0].push_back(end.see(mesh.vertices[vertex]));
  for (const std::uint32_t vertex : upper) faces[1].push_back(end.see(mesh.vertices[vertex]));
  return faces;
}

double most_tongue_volume(const PrintJob& job, PrintPose kind) {
  const double reach = tongue_reach(job, kind);
  const auto band = level_band(job.face);
  if (!(reach > 0.0) || !band) return 0.0;
  return profile_volume(tongue_of(job.options, kind, *band, reach).profile(),
                        job.face.high().x - job.face.low().x);
}

double profile_volume(const std::vector<Vec2>& profile, double width) {
  return std::fabs(area_of(profile)) * width;
}

}  // namespace glissade::parts
