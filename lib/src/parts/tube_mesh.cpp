#include "parts/tube_mesh.hpp"

#include "glissade/core/math.hpp"

#include "parts/drilled_faces.hpp"
#include "parts/tube_windows.hpp"
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

/// A tube with windows and holes on a grid of angles and of places along its axis, the first and last of which lie on its end planes.
/// Of a trough, half of it with sides that stand on its ends.
class TubeMesh {
 public:
  /// @param side  of a trough, their height
  TubeMesh(const TubeGore& gore, const Fineness& fineness, std::optional<double> side = std::nullopt)
      : gore_(gore), fineness_(fineness), bores_(bores_of(gore)), side_(side) {
    const int corners = std::max(chords_of(kTurn, gore.inner_radius + gore.thickness, fineness), 3);
    for (int k = 0; k < corners; ++k) angles_.push_back(kTurn * k / corners);
    rows_ = {0.0, gore.length};
    for (const TubeHole& hole : gore.holes) leave_out(hole);
    for (const TubeWindow& window : gore.windows) {
      for (const Angle edge : {window.low, window.high}) angles_.push_back(in_turn(edge.radians()));
      rows_.insert(rows_.end(), {window.from, window.to});
    }
    if (side_) {
      // Round the lowest line, which lies at half a turn.
      std::erase_if(angles_, [](double angle) { return angle < 0.25 * kTurn || angle > 0.75 * kTurn; });
      angles_.insert(angles_.end(), {0.25 * kTurn, 0.75 * kTurn});
    }
    sort_apart(angles_);
    sort_apart(rows_);
    first_ = side_.value_or(0.0) > 0.0 ? 1 : 0;
  }

  TriangleMesh whole() {
    for (std::size_t i = 0; i < columns(); ++i) {
      for (std::size_t j = 0; j + 1 < rows_.size(); ++j) {
        if (filled(i, j)) add_cell(i, j);
      }
    }
    return std::move(mesh_);
  }

 private:
  using Place = std::array<std::size_t, 2>;  ///< angle, row

  static double in_turn(double angle) { return angle - kTurn * std::floor(angle / kTurn); }

  /// A hole lies between two angles and two rows of the grid.
  void leave_out(const TubeHole& hole) {
    const double middle = in_turn(hole.about.radians());
    const double half = kRoomOfHole * math::asin(hole.radius / gore_.inner_radius);
    const auto away = [&](double angle) {
      const double off = in_turn(angle - middle);
      return std::min(off, kTurn - off);
    };
    std::erase_if(angles_, [&](double angle) { return away(angle) < half; });
    angles_.insert(angles_.end(), {in_turn(middle - half), in_turn(middle + half)});
    rows_.insert(rows_.end(),
                 {hole.along - kRoomOfHole * hole.radius, hole.along + kRoomOfHole * hole.radius});
  }

  [[nodiscard]] double next_angle(std::size_t i) const {
    return i + 1 < angles_.size() ? angles_[i + 1] : angles_.front() + kTurn;
  }

  /// Of a trough with sides, their tops are the first and the last.
  [[nodiscard]] std::size_t columns() const { return angles_.size() + 2 * first_; }

  [[nodiscard]] bool filled(std::size_t column, std::size_t j) const {
    if (side_ && column + 1 >= columns()) return false;
    if (column < first_ || column - first_ + (side_ ? 1 : 0) >= angles_.size()) return true;
    const std::size_t i = column - first_;
    const auto [sine, cosine] = math::sine_cosine(0.5 * (angles_[i] + next_angle(i)));
    const Vec3 middle{gore_.inner_radius * cosine, gore_.inner_radius * sine,
                      0.5 * (rows_[j] + rows_[j + 1])};
    return std::none_of(gore_.windows.begin(), gore_.windows.end(),
                        [&](const TubeWindow& window) { return beside(window, middle) < 0.0; });
  }

  [[nodiscard]] Vec2 corner_at(std::size_t column, double radius) const {
    if (side_ && (column < first_ || column + 1 == columns()) && first_ > 0)
      return {*side_, column == 0 ? radius : -radius};
    // Where its sides begin to the last bit.
    if (side_ && column == first_) return {0.0, radius};
    if (side_ && column - first_ + 1 == angles_.size()) return {0.0, -radius};
    const auto [sine, cosine] = math::sine_cosine(angles_[column - first_]);
    return {radius * cosine, radius * sine};
  }

  Index vertex(const Place& place, bool outer) {
    const auto [i, j] = place;
    const auto [entry, fresh] = vertices_.try_emplace({i, j, outer ? 1U : 0U}, count_of(mesh_));
    if (fresh) {
      const Vec2 at = corner_at(i, gore_.inner_radius + (outer ? gore_.thickness : 0.0));
      double z = rows_[j];
      if (j == 0) z = at.x * math::tan(gore_.start_tilt.radians());
      if (j + 1 == rows_.size()) z = gore_.length + at.x * math::tan(gore_.end_tilt.radians());
      mesh_.vertices.push_back({at.x, at.y, z});
    }
    return entry->second;
  }

  void add_cell(std::size_t i, std::size_t j) {
    const std::size_t next = (i + 1) % columns();
    const std::size_t before = (i + columns() - 1) % columns();
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
      if (!edge[k]) continue;
      const Place& to = corner[(k + 1) % 4];
      add_quad(mesh_, vertex(to, true), vertex(corner[k], true), vertex(corner[k], false), vertex(to, false));
    }
  }

  [[nodiscard]] std::vector<const Bore*> holes_in(std::size_t column, std::size_t j) const {
    std::vector<const Bore*> found;
    if (column < first_ || column - first_ >= angles_.size()) return found;
    const std::size_t i = column - first_;
    for (std::size_t k = 0; k < gore_.holes.size(); ++k) {
      const TubeHole& hole = gore_.holes[k];
      const double off = in_turn(hole.about.radians() - angles_[i]);
      if (off < next_angle(i) - angles_[i] && hole.along > rows_[j] && hole.along < rows_[j + 1])
        found.push_back(&bores_[k]);
    }
    return found;
  }

  const TubeGore& gore_;
  Fineness fineness_;
  std::vector<Bore> bores_;
  std::optional<double> side_;
  std::size_t first_ = 0;  ///< columns before the round
  std::vector<double> angles_;
  std::vector<double> rows_;
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
