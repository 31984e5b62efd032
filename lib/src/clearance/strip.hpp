#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/clearance/envelope.hpp"

#include "clearance/region.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::clearance {

/// How close an envelope comes to a region, at one station or anywhere.
struct Approach {
  double value = 0.0;       ///< Region's signed distance [m]
  double arc_length = 0.0;  ///< of the station whose normal carries the closest place [m]
  EnvelopePlace place;
};

/// What Strip::least() finds.
struct Least {
  Approach closest;
  std::size_t looks = 0;  ///< normals that it took beside those of the stations
};

/// The envelope of a centerline as a region of the plane, and its distance from what must be kept clear.
///
/// Shape: the union of the normals of all stations, each from the underside to the top, cut where it passes
///   behind an end plane; what slides is not cut. Where normals meet beyond a centre of curvature, nothing needs cutting: a point that
///   several normals pass lies in the solid all the same (docs/solid.md).
/// Method: between two stations a level at height n strays from the chord of its ends by no more than
///   sqrt(L^2 - l^2)/2, L its arc length and l that chord, nor, where it does not turn back, by more than L/4 times the angle
///   that it turns.
///   The cell between two stations lies within that of the hull of their normals: all that lies so near the hull has a value no
///   larger, and that is told as a normal's is. The cell that may hold the least value is halved until none may hold one that is smaller
///   by more than the accuracy; of cells that are points to rounding the normals count.
/// Accuracy: least() exceeds the true least distance by no more than `accuracy`, as long as that is positive,
///   and its sign is right; a negative one is the depth to a millionth, which is the value of its place. Where values jump (Region) the place
///   of the jump is known to 1e-12 of a station's distance. On each smooth piece curvature is taken to be monotone or of one sign.
/// Cost: some 20 looks, thousands where much of the track is all but equally close; after 200,000 the bound counts in place of what was found, which is below the true least distance.
class Strip {
 public:
  /// @param stations  points of the centerline from start to finish, its breaks among them
  Strip(const Centerline& centerline, const Envelope& envelope, const std::vector<CenterlinePoint>& stations);

  /// @return how close each station's normal comes, in their order
  [[nodiscard]] std::vector<Approach> along(const Region& region) const;

  /// @param stations  what along() found
  /// @return the closest place of all
  [[nodiscard]] Least least(const Region& region, const std::vector<Approach>& stations,
                            double accuracy) const;

  /// How far what stands right through the envelope, or through one of its edges, reaches beyond: a post a hair thin has
  /// a depth of half a hair, and still stands in the way. Of what an edge of the envelope cuts off the part that
  /// reaches less far counts; of what lies wholly between the edges, the way out past the nearer one.
  /// @return a value below 0, at the furthest corner of that part; nothing where no part has a corner
  [[nodiscard]] std::optional<Approach> pierced(const Region& region) const;

 private:
  struct Passage;
  [[nodiscard]] std::vector<Passage> passages(const Region& region, double level) const;
  [[nodiscard]] std::optional<Approach> furthest(const std::vector<Vec2>& corners, double level) const;
  [[nodiscard]] std::optional<Approach> enclosed(const std::vector<Vec2>& corners) const;
  [[nodiscard]] Approach from_foot(Vec2 corner) const;
  /// A station's normal, from the underside to the top.
  struct Rib {
    double s = 0.0;
    Vec2 point;
    Vec2 tangent;
    Vec2 normal;
    double slope = 0.0;
    double kappa = 0.0;
    double low = 0.0;
    double high = 0.0;
    bool cut_at_start = false;
    bool cut_at_finish = false;
  };
  struct Cell;
  struct Search;

  [[nodiscard]] Rib rib(const CenterlinePoint& point) const;
  void cut(Rib& rib) const;
  [[nodiscard]] Approach approach(const Rib& rib, const Region& region) const;
  [[nodiscard]] EnvelopePart part_of(const Rib& rib, double height) const;
  [[nodiscard]] double straying(const Rib& a, const Rib& b) const;
  [[nodiscard]] double lower_bound(const Rib& a, const Rib& b, const Region& region) const;
  [[nodiscard]] bool passes_by(const Cell& cell, const Search& search) const;
  void add(Cell cell, Search& search) const;

  const Centerline& centerline_;
  Envelope envelope_;
  std::vector<Rib> ribs_;
  Rib start_;
  Rib finish_;
  double start_zone_ = 0.0;   // up to here normals may pass behind the start's plane [m]; infinity: anywhere
  double finish_zone_ = 0.0;  // from here on behind that of the finish [m]; -infinity: anywhere
};

}  // namespace glissade::clearance
