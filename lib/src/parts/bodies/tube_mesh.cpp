#include "parts/bodies/tube_mesh.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/drilled_faces.hpp"
#include "parts/bodies/tube_windows.hpp"
#include "parts/curves/offset_line.hpp"
#include "solid/cap_triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::parts {
namespace {

TriangleMesh whole_tube(const TubeGore& gore, const Fineness& fineness) {
  const double outer = gore.inner_radius + gore.thickness;
  const auto corners = static_cast<Index>(std::max(chords_of(kTurn, outer, fineness), 3));
  TriangleMesh mesh;
  const auto add_ring = [&](double radius, double height, Angle tilt) {
    const double rise = math::tan(tilt.radians());
    for (Index i = 0; i < corners; ++i) {
      const auto [sine, cosine] = math::sine_cosine(kTurn * i / corners);
      const double x = radius * cosine;
      mesh.vertices.push_back({x, radius * sine, height + rise * x});
    }
  };
  add_ring(outer, 0.0, gore.start_tilt);
  add_ring(gore.inner_radius, 0.0, gore.start_tilt);
  add_ring(outer, gore.length, gore.end_tilt);
  add_ring(gore.inner_radius, gore.length, gore.end_tilt);
  for (Index i = 0; i < corners; ++i) {
    const Index next = (i + 1) % corners;
    const auto at = [corners](Index ring, Index corner) { return ring * corners + corner; };
    add_quad(mesh, at(0, i), at(0, next), at(2, next), at(2, i));
    add_quad(mesh, at(1, next), at(1, i), at(3, i), at(3, next));
    add_quad(mesh, at(0, next), at(0, i), at(1, i), at(1, next));
    add_quad(mesh, at(2, i), at(2, next), at(3, next), at(3, i));
  }
  return mesh;
}

/// A tube with windows and holes, in zones along its axis: those that overlap there are one, with a grid of its own of angles and of
/// places along the axis, and facets between one zone's last row and the next one's first join their angles, so that no line beside
/// one opening runs through another. The first and the last row lie on the end planes. Of a trough, half of it with sides that
/// stand on its ends.
class TubeMesh {
 public:
  /// @param side  of a trough, their height
  TubeMesh(const TubeGore& gore, const Fineness& fineness, std::optional<double> side = std::nullopt)
      : gore_(gore), fineness_(fineness), bores_(bores_of(gore)), side_(side) {
    for (const TubeHole& hole : gore.holes) {
      const double room = kRoomOfHole * hole.radius;
      zones_.push_back({{hole.along - room, hole.along + room}, {}});
    }
    for (const TubeWindow& window : gore.windows) zones_.push_back({{window.from, window.to}, {}});
    join_zones();
    for (std::size_t k = 0; k < zones_.size(); ++k) add_lines(k);
    first_ = side_.value_or(0.0) > 0.0 ? 1 : 0;
  }

  TriangleMesh whole() {
    for (std::size_t j = 0; j + 1 < rows_.size(); ++j) {
      if (rows_[j].zone != rows_[j + 1].zone) {
        join_rows(j);
        continue;
      }
      for (std::size_t i = 0; i < columns(j); ++i) {
        if (filled(i, j)) add_cell(i, j);
      }
    }
    return std::move(mesh_);
  }

 private:
  using Place = std::array<std::size_t, 2>;  ///< angle, row

  struct Zone {
    Span along;
    std::vector<double> angles;
  };
  struct Row {
    double z = 0.0;
    std::size_t zone = 0;
  };

  static double in_turn(double angle) { return angle - kTurn * std::floor(angle / kTurn); }

  void join_zones() {
    std::sort(zones_.begin(), zones_.end(),
              [](const Zone& a, const Zone& b) { return a.along.from < b.along.from; });
    std::vector<Zone> joined;
    for (const Zone& zone : zones_) {
      if (joined.empty() || zone.along.from > joined.back().along.to + kLeastGap)
        joined.push_back(zone);
      else
        joined.back().along.to = std::max(joined.back().along.to, zone.along.to);
    }
    zones_ = std::move(joined);
  }

  /// The lines of a zone both ways; the first and the last one have the tube's ends, too.
  void add_lines(std::size_t index) {
    Zone& zone = zones_[index];
    std::vector<double> rows;
    const auto within = [&](double z) {
      return z > zone.along.from - kLeastGap && z < zone.along.to + kLeastGap;
    };
    const int corners = std::max(chords_of(kTurn, gore_.inner_radius + gore_.thickness, fineness_), 3);
    for (int k = 0; k < corners; ++k) zone.angles.push_back(kTurn * k / corners);
    for (const TubeHole& hole : gore_.holes) {
      if (!within(hole.along)) continue;
      leave_out(hole, zone.angles);
      for (const double sense : {-1.0, 1.0}) rows.push_back(hole.along + sense * kRoomOfHole * hole.radius);
    }
    for (const TubeWindow& window : gore_.windows) {
      if (!within(window.from)) continue;
      for (const Angle edge : {window.low, window.high}) zone.angles.push_back(in_turn(edge.radians()));
      rows.insert(rows.end(), {window.from, window.to});
    }
    if (side_) {
      // Round the lowest line, which lies at half a turn.
      std::erase_if(zone.angles, [](double angle) { return angle < 0.25 * kTurn || angle > 0.75 * kTurn; });
      zone.angles.insert(zone.angles.end(), {0.25 * kTurn, 0.75 * kTurn});
    }
    sort_apart(zone.angles);
    sort_apart(rows);
    if (index == 0) rows_.push_back({0.0, index});
    for (const double row : rows) rows_.push_back({row, index});
    if (index + 1 == zones_.size()) rows_.push_back({gore_.length, index});
  }

  /// A hole lies between two angles and two rows of the grid.
  void leave_out(const TubeHole& hole, std::vector<double>& angles) const {
    const double middle = in_turn(hole.about.radians());
    const double half = kRoomOfHole * math::asin(hole.radius / gore_.inner_radius);
    const auto away = [&](double angle) {
      const double off = in_turn(angle - middle);
      return std::min(off, kTurn - off);
    };
    std::erase_if(angles, [&](double angle) { return away(angle) < half; });
    angles.insert(angles.end(), {in_turn(middle - half), in_turn(middle + half)});
  }

  [[nodiscard]] const std::vector<double>& angles(std::size_t row) const {
    return zones_[rows_[row].zone].angles;
  }

  [[nodiscard]] double next_angle(std::size_t i, std::size_t row) const {
    return i + 1 < angles(row).size() ? angles(row)[i + 1] : angles(row).front() + kTurn;
  }

  /// Of a trough with sides, their tops are the first and the last.
  [[nodiscard]] std::size_t columns(std::size_t row) const { return angles(row).size() + 2 * first_; }

  /// Where the columns of two rows stand beside each other: their angles, tops of sides before and after all of them.
  [[nodiscard]] double order_of(std::size_t column, std::size_t row) const {
    if (!side_) return column < columns(row) ? angles(row)[column] : angles(row).front() + kTurn;
    if (column < first_) return -kTurn;
    return column - first_ < angles(row).size() ? angles(row)[column - first_] : 2.0 * kTurn;
  }

  /// Between zones they all are.
  [[nodiscard]] bool filled(std::size_t column, std::size_t j) const {
    if (rows_[j].zone != rows_[j + 1].zone) return true;
    if (side_ && column + 1 >= columns(j)) return false;
    if (column < first_ || column - first_ + (side_ ? 1 : 0) >= angles(j).size()) return true;
    const std::size_t i = column - first_;
    const auto [sine, cosine] = math::sine_cosine(0.5 * (angles(j)[i] + next_angle(i, j)));
    const Vec3 middle{gore_.inner_radius * cosine, gore_.inner_radius * sine,
                      0.5 * (rows_[j].z + rows_[j + 1].z)};
    return std::none_of(gore_.windows.begin(), gore_.windows.end(),
                        [&](const TubeWindow& window) { return beside(window, middle) < 0.0; });
  }

  [[nodiscard]] Vec2 corner_at(const Place& place, double radius) const {
    const auto [column, row] = place;
    if (side_ && (column < first_ || column + 1 == columns(row)) && first_ > 0)
      return {*side_, column == 0 ? radius : -radius};
    // Where its sides begin to the last bit.
    if (side_ && column == first_) return {0.0, radius};
    if (side_ && column - first_ + 1 == angles(row).size()) return {0.0, -radius};
    const auto [sine, cosine] = math::sine_cosine(angles(row)[column - first_]);
    return {radius * cosine, radius * sine};
  }

  Index vertex(const Place& place, bool outer) {
    const auto [i, j] = place;
    const auto [entry, fresh] = vertices_.try_emplace({i, j, outer ? 1U : 0U}, count_of(mesh_));
    if (fresh) {
      const Vec2 at = corner_at(place, gore_.inner_radius + (outer ? gore_.thickness : 0.0));
      double z = rows_[j].z;
      if (j == 0) z = at.x * math::tan(gore_.start_tilt.radians());
      if (j + 1 == rows_.size()) z = gore_.length + at.x * math::tan(gore_.end_tilt.radians());
      mesh_.vertices.push_back({at.x, at.y, z});
    }
    return entry->second;
  }

  /// Both faces between the rows of two zones, and what walls they meet.
  void join_rows(std::size_t j) {
    const std::size_t low_end = side_ ? columns(j) - 1 : columns(j);
    const std::size_t high_end = side_ ? columns(j + 1) - 1 : columns(j + 1);
    const auto add = [&](const Place& a, const Place& b, const Place& c) {
      mesh_.triangles.push_back({vertex(a, true), vertex(b, true), vertex(c, true)});
      mesh_.triangles.push_back({vertex(c, false), vertex(b, false), vertex(a, false)});
    };
    const auto low = [&](std::size_t i) { return Place{i % columns(j), j}; };
    const auto high = [&](std::size_t i) { return Place{i % columns(j + 1), j + 1}; };
    std::size_t i = 0;
    std::size_t k = 0;
    while (i < low_end || k < high_end) {
      if (k == high_end || (i < low_end && order_of(i + 1, j) <= order_of(k + 1, j + 1))) {
        add(low(i), low(i + 1), high(k));
        ++i;
      } else {
        add(low(i), high(k + 1), high(k));
        ++k;
      }
    }
    // Of windows that begin or end here, and of a trough's tops.
    for (i = 0; i < low_end; ++i) {
      if (!filled(i, j - 1)) add_wall(low(i), low(i + 1));
    }
    for (k = 0; k < high_end; ++k) {
      if (!filled(k, j + 1)) add_wall(high(k + 1), high(k));
    }
    if (!side_) return;
    add_wall({0, j + 1}, {0, j});
    add_wall(low(low_end), high(high_end));
  }

  /// Between the two faces, along an edge of the outer one.
  void add_wall(const Place& from, const Place& to) {
    add_quad(mesh_, vertex(to, true), vertex(from, true), vertex(from, false), vertex(to, false));
  }

  void add_cell(std::size_t i, std::size_t j) {
    const std::size_t next = (i + 1) % columns(j);
    const std::size_t before = (i + columns(j) - 1) % columns(j);
    const std::array<Place, 4> corner = {Place{i, j}, {next, j}, {next, j + 1}, {i, j + 1}};
    std::array<Index, 4> outer{};
    std::array<Index, 4> inner{};
    for (std::size_t k = 0; k < 4; ++k) {
      outer[k] = vertex(corner[k], true);
      inner[k] = vertex(corner[3 - k], false);
    }
    const std::vector<const Bore*> holes = holes_in(i, j);
    if (holes.empty()) {
      add_quad(mesh_, outer[0], outer[1], outer[2], outer[3]);
      add_quad(mesh_, inner[0], inner[1], inner[2], inner[3]);
    } else {
      add_drilled(mesh_, {inner.begin(), inner.end()}, {outer.begin(), outer.end()}, holes, fineness_);
    }
    const std::array<bool, 4> edge = {j == 0 || !filled(i, j - 1), !filled(next, j),
                                      j + 2 == rows_.size() || !filled(i, j + 1), !filled(before, j)};
    for (std::size_t k = 0; k < 4; ++k) {
      if (edge[k]) add_wall(corner[k], corner[(k + 1) % 4]);
    }
  }

  [[nodiscard]] std::vector<const Bore*> holes_in(std::size_t column, std::size_t j) const {
    std::vector<const Bore*> found;
    if (column < first_ || column - first_ >= angles(j).size()) return found;
    const std::size_t i = column - first_;
    for (std::size_t k = 0; k < gore_.holes.size(); ++k) {
      const TubeHole& hole = gore_.holes[k];
      const double off = in_turn(hole.about.radians() - angles(j)[i]);
      if (off < next_angle(i, j) - angles(j)[i] && hole.along > rows_[j].z && hole.along < rows_[j + 1].z)
        found.push_back(&bores_[k]);
    }
    return found;
  }

  static constexpr double kLeastGap = 1e-6;  // between zones [m]

  const TubeGore& gore_;
  Fineness fineness_;
  std::vector<Bore> bores_;
  std::optional<double> side_;
  std::size_t first_ = 0;  ///< columns before the round
  std::vector<Zone> zones_;
  std::vector<Row> rows_;
  TriangleMesh mesh_;
  std::map<std::array<std::size_t, 3>, Index> vertices_;
};

/// The section of a trough, counter-clockwise seen against its axis.
std::vector<Vec2> trough_section(const TroughGore& gore, const Fineness& fineness) {
  const double outer = gore.inner_radius + gore.thickness;
  const int chords = std::max(2, chords_of(0.5 * kTurn, outer, fineness));
  std::vector<Vec2> section;
  const auto add_round = [&](double radius, bool from_left) {
    if (from_left && gore.side > 0.0) section.push_back({gore.side, radius});
    for (int k = 0; k <= chords; ++k) {
      const auto [sine, cosine] = math::sine_cosine(0.5 * kTurn * k / chords);
      section.push_back({-radius * sine, (from_left ? radius : -radius) * cosine});
    }
    section.push_back({gore.side, from_left ? -radius : radius});
    if (gore.side == 0.0) section.pop_back();
  };
  add_round(outer, true);
  if (gore.side > 0.0) section.push_back({gore.side, -gore.inner_radius});
  add_round(gore.inner_radius, false);
  return section;
}

}  // namespace

TriangleMesh mesh_of(const TubeGore& gore, const Fineness& fineness) {
  if (gore.windows.empty() && gore.holes.empty()) return whole_tube(gore, fineness);
  return TubeMesh(gore, fineness).whole();
}

TriangleMesh mesh_of(const TroughGore& gore, const Fineness& fineness) {
  if (!gore.windows.empty() || !gore.holes.empty()) {
    const TubeGore round = round_of(gore);
    return TubeMesh(round, fineness, gore.side).whole();
  }
  const std::vector<Vec2> section = trough_section(gore, fineness);
  TriangleMesh mesh;
  for (const bool top : {false, true}) {
    const double rise = math::tan((top ? gore.end_tilt : gore.start_tilt).radians());
    for (const Vec2 corner : section)
      mesh.vertices.push_back({corner.x, corner.y, (top ? gore.length : 0.0) + rise * corner.x});
  }
  const auto size = static_cast<Index>(section.size());
  for (Index i = 0; i < size; ++i) {
    const Index next = (i + 1) % size;
    add_quad(mesh, i, next, size + next, size + i);
  }
  for (const auto& [a, b, c] : solid::triangulate_loops({section})) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({size + a, size + b, size + c});
  }
  return mesh;
}

}  // namespace glissade::parts
