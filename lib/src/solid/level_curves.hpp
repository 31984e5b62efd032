#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/vec.hpp"

#include "solid/level_nodes.hpp"
#include "solid/place_tree.hpp"
#include "solid/stations.hpp"

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

namespace glissade::solid {

/// A stretch of stations that a level curve leaves out, and the one point that takes its place.
struct Trim {
  enum class Kind { start_face, crease, finish_face };
  Kind kind;
  double from = 0.0;  ///< arc lengths between which no station carries the level [m]
  double to = 0.0;
  Vec2 point;  ///< (x, z): on the end face, or where the two branches of the level meet
};

/// Why a level curve does not lead from the start face to the finish face.
struct Obstacle {
  enum class Kind { start_face, finish_face, reach };
  Kind kind = Kind::reach;
  double s = 0.0;  ///< where along the track [m]
};

struct Trims {
  std::vector<Trim> cuts;  ///< in the order of the track
  std::optional<Obstacle> obstacle;
};

/// The level curves of the signed distance to a centerline, between its two end faces (docs/solid.md).
///
/// The level at height n is the offset curve c(s) + n N(s) without the parts whose true distance to the
/// centerline is less than |n| (they fold over), and without those behind the planes square to the track at
/// start and finish. A station's "room" is the height up to which its normal meets neither: level n is
/// carried by the stations whose room is at least |n|.
class LevelCurves {
 public:
  /// @param below,above  heights of interest on either side [m]; >= 0
  /// @param sharpness  a trim's point may be this much nearer to the centerline than its level [m]; > 0
  /// @throws Interrupted if `stop` asks for it while this is made
  LevelCurves(const Centerline& centerline, std::vector<Station> stations, double below, double above,
              double sharpness, std::stop_token stop = {});

  [[nodiscard]] const std::vector<Station>& stations() const { return stations_; }

  /// @return what the level at `height` leaves out; -below <= height <= above
  [[nodiscard]] Trims trims(double height) const;

  /// @param height  one whose trims meet no obstacle
  [[nodiscard]] LevelCurve level(double height, const NodeSpacing& spacing) const;

  /// @return the length by which the ideal level at `height` is shorter than the untrimmed offset curve [m]
  [[nodiscard]] double missing_length(double height) const;

  /// @return the greatest height up to which no level on that side meets an obstacle [m]
  /// @param side  +1 above the floor, -1 below
  [[nodiscard]] double largest_height(int side) const;

  /// @return the least room on that side [m]; infinite where nothing is trimmed
  [[nodiscard]] double least_room(int side) const { return side > 0 ? least_above_ : least_below_; }

  /// @return whether no station lies between the two arc lengths
  [[nodiscard]] bool are_neighbours(double from, double to) const;

  /// Where a point of the plane stands to the centerline.
  struct Foot {
    double s = 0.0;       ///< arc length of the nearest point [m]
    double height = 0.0;  ///< signed distance [m]
  };
  [[nodiscard]] Foot foot(Vec2 point) const;
  /// @return whether the level at `height` passes over this place of the track: it is neither nearer to another one nor
  ///         behind an end face, but for rounding
  [[nodiscard]] bool carries(const Station& place, double height) const;
  /// @return the signed distance of a point to the centerline: its height above the floor [m]
  [[nodiscard]] double height_of(Vec2 point) const;

 private:
  /// The room of a station and the place of the track that bounds it.
  struct Room {
    double height = 0.0;
    double partner =
        0.0;  // arc length; the station's own where the track bends too much or an end face bounds
  };

  struct Probe {
    Vec2 point;
    Vec2 normal;
    double s = 0.0;
  };

  void make_probes(bool dense);
  [[nodiscard]] std::vector<Room> face_rooms(int side, double reach) const;
  [[nodiscard]] std::vector<Room> rooms_of(int side, double reach, bool faces_alone) const;
  void shrink_to_free_balls(int side, double reach, std::vector<Room>& rooms) const;
  void shrink_ball(std::size_t probe, int side, bool exactly, Room& room) const;
  [[nodiscard]] bool faces_alone_trim() const;
  [[nodiscard]] double least_room_for(double height) const;
  [[nodiscard]] const std::vector<Room>& rooms(double height) const {
    return height >= 0.0 ? rooms_above_ : rooms_below_;
  }
  [[nodiscard]] std::size_t nearest_station(Vec2 point) const;
  [[nodiscard]] Station foot_of(Vec2 point) const;
  [[nodiscard]] bool sharp(const Trim& trim, double height) const;
  [[nodiscard]] double beyond_face(const Station& face, double s, double height) const;
  [[nodiscard]] Trim face_trim(Trim::Kind kind, double s, double height) const;
  [[nodiscard]] std::optional<Trim> start_trim(double height, std::size_t last_cut) const;
  [[nodiscard]] std::optional<Trim> finish_trim(double height, std::size_t first_cut) const;
  [[nodiscard]] std::vector<Trim> crease_trims(double height, std::size_t first_cut,
                                               std::size_t last_cut) const;
  [[nodiscard]] std::optional<Trim> face_near(Trim::Kind kind, double height, double guess) const;
  [[nodiscard]] std::optional<Trim> crease_near(double height, double from, double to) const;
  [[nodiscard]] std::vector<Trim> run_trims(double height, std::size_t first, std::size_t last) const;
  [[nodiscard]] std::vector<Trim> split_at(const Trim& trim, double height, double middle, int depth) const;
  [[nodiscard]] std::vector<Trim> settled(const Trim& trim, double height, int depth) const;
  [[nodiscard]] double step_at(double s) const;
  [[nodiscard]] std::size_t extreme_place(double height, std::size_t first, std::size_t last,
                                          bool widest) const;

  const Centerline& centerline_;
  std::vector<Station> stations_;
  std::vector<Probe> probes_;          // the stations, and further points between them
  std::vector<std::size_t> probe_of_;  // of each station
  PlaceTree tree_;                     // of the probes
  std::vector<Room> rooms_above_;      // empty: nothing is trimmed on that side
  std::vector<Room> rooms_below_;
  double below_ = 0.0;
  double above_ = 0.0;
  double sharpness_ = 0.0;
  std::stop_token stop_;
  double least_above_ = 0.0;
  double least_below_ = 0.0;
};

}  // namespace glissade::solid
