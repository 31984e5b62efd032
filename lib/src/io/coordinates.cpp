#include "io/coordinates.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/stop.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "io/parallel.hpp"
#include "solid/mesh_check.hpp"
#include "solid/position_index.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace glissade::io {
namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();

/// Asks now and then of a loop over vertices or triangles.
void pause_at(std::size_t item, const std::stop_token& stop) {
  constexpr std::size_t kItemsBetweenPauses = std::size_t{1} << 16U;  // taste: some milliseconds
  if (item % kItemsBetweenPauses == 0) require_going(stop);
}

/// @param p  in metres
std::string place_text(Vec3 p) {
  constexpr int kDigits = 6;
  return "(" + length_text(p.x, kDigits) + ", " + length_text(p.y, kDigits) + ", " +
         length_text(p.z, kDigits) + ")";
}

Vec3 to_vec(const FloatPosition& position) {
  return {position[0], position[1], position[2]};
}

Vec3 to_metres(const FloatPosition& p, double per_metre) {
  return {p[0] / per_metre, p[1] / per_metre, p[2] / per_metre};
}

double largest_coordinate(Vec3 p) {
  return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}

/// @return the single-precision number next to the nearest, on the other side of `value`; the one above where
///         that is exact
float second_nearest(double value) {
  const auto close = static_cast<float>(value);
  const float towards =
      close > value ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
  return std::nextafter(close, towards) + 0.0F;
}

/// @return the other seven of the eight single-precision points around `p`, nearest first
std::array<FloatPosition, 7> alternatives(Vec3 p) {
  const FloatPosition first = nearest(p);
  const FloatPosition second{second_nearest(p.x), second_nearest(p.y), second_nearest(p.z)};
  std::array<FloatPosition, 7> points{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t choice = i + 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[i][axis] = ((choice >> axis) & 1U) != 0U ? second[axis] : first[axis];
    }
  }
  std::stable_sort(points.begin(), points.end(), [p](const FloatPosition& a, const FloatPosition& b) {
    const Vec3 to_a = to_vec(a) - p;
    const Vec3 to_b = to_vec(b) - p;
    return dot(to_a, to_a) < dot(to_b, to_b);
  });
  return points;
}

/// @param size  largest coordinate of the place in question, `feature` what must be told apart there; both in
///              the file's unit
InputError too_coarse(std::string what, double size, double feature, LengthUnit unit) {
  const double per_metre = units_per_metre(unit);
  // A float of size X steps by 2^-23 X at most: the feature is then four steps or more.
  const double size_that_works = feature * 0x1p21;
  const auto single = static_cast<float>(size);
  const double step = std::nextafter(single, std::numeric_limits<float>::infinity()) - single;
  return InputError(
      {"", std::move(what),
       "The format holds coordinates in single precision; at " + length_text(size / per_metre, 3) +
           " its steps are " + length_text(step / per_metre, 3) + ".",
       "an origin so close that coordinates stay below " + length_text(size_that_works / per_metre, 2) +
           ", or OFF or ASCII STL, which hold double precision"});
}

/// Positions in the file's unit and their roundings, one object for the steps of keeping them apart.
class DistinctRounding {
 public:
  DistinctRounding(const std::vector<Vec3>& exact, std::vector<FloatPosition>& rounded, LengthUnit unit,
                   const std::stop_token& stop)
      : exact_(exact), rounded_(rounded), unit_(unit), stop_(stop), positions_(exact.size()) {
    std::transform(rounded.begin(), rounded.end(), positions_.begin(), to_vec);
  }

  void keep_apart() {
    if (!has_merged()) return;
    solid::PositionIndex taken(positions_, positions_.size());
    solid::PositionIndex originals(exact_, exact_.size());
    std::vector<std::uint32_t> leader(exact_.size());
    std::vector<std::uint32_t> homeless;
    for (std::uint32_t i = 0; i < exact_.size(); ++i) {
      pause_at(i, stop_);
      leader[i] = originals.enter(exact_[i], i);
      if (leader[i] == i && taken.enter(positions_[i], i) != i) homeless.push_back(i);
    }
    for (std::size_t k = 0; k < homeless.size(); ++k) {
      pause_at(k, stop_);
      settle(homeless[k], taken);
    }
    for (std::uint32_t i = 0; i < exact_.size(); ++i) rounded_[i] = rounded_[leader[i]];
  }

 private:
  [[nodiscard]] bool has_merged() const {
    solid::PositionIndex index(positions_, positions_.size());
    for (std::uint32_t i = 0; i < positions_.size(); ++i) {
      pause_at(i, stop_);
      if (!(exact_[index.enter(positions_[i], i)] == exact_[i])) return true;
    }
    return false;
  }

  void settle(std::uint32_t vertex, solid::PositionIndex& taken) {
    const std::uint32_t rival = taken.enter(positions_[vertex], vertex);
    for (const FloatPosition& point : alternatives(exact_[vertex])) {
      positions_[vertex] = to_vec(point);
      if (taken.enter(positions_[vertex], vertex) != vertex) continue;
      rounded_[vertex] = point;
      return;
    }
    const double distance = norm(exact_[vertex] - exact_[rival]);
    const double metres = 1.0 / units_per_metre(unit_);
    throw too_coarse("binary STL cannot keep vertices " + std::to_string(vertex) + " and " +
                         std::to_string(rival) + " apart: they lie " + length_text(distance * metres, 3) +
                         " from each other at " + place_text(metres * exact_[vertex]),
                     largest_coordinate(exact_[vertex]), distance, unit_);
  }

  const std::vector<Vec3>& exact_;
  std::vector<FloatPosition>& rounded_;
  LengthUnit unit_;
  const std::stop_token& stop_;
  std::vector<Vec3> positions_;
};

/// @throws InputError if rounding turns a facet by more than 45 deg: the shape is lost there
void require_same_attitude(const TriangleMesh& mesh, const std::vector<FloatPosition>& rounded,
                           LengthUnit unit, const std::stop_token& stop) {
  constexpr double kCosineOf45Deg = 0.5 * std::numbers::sqrt2;
  const double per_metre = units_per_metre(unit);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    pause_at(i, stop);
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const Vec3 a = mesh.vertices[ia];
    const Vec3 ab = mesh.vertices[ib] - a;
    const Vec3 ac = mesh.vertices[ic] - a;
    const Vec3 before = cross(ab, ac);
    const Vec3 origin = to_vec(rounded[ia]);
    const Vec3 after = cross(to_vec(rounded[ib]) - origin, to_vec(rounded[ic]) - origin);
    if (dot(before, after) >= kCosineOf45Deg * norm(before) * norm(after) && !(after == Vec3{})) continue;
    if (before == Vec3{}) continue;
    const double longest = std::max({norm(ab), norm(ac), norm(ac - ab)});
    const double height = norm(before) / longest;
    throw too_coarse("binary STL turns triangle " + std::to_string(i) + " by more than 45 deg: it is " +
                         length_text(height, 3) + " high, at " + place_text(a),
                     per_metre * largest_coordinate(a), per_metre * height, unit);
  }
}

TriangleMesh as_double_precision(const TriangleMesh& mesh, LengthUnit unit) {
  const double per_metre = units_per_metre(unit);
  TriangleMesh result = mesh;
  for (Vec3& p : result.vertices) {
    p = {p.x * per_metre / per_metre + 0.0, p.y * per_metre / per_metre + 0.0,
         p.z * per_metre / per_metre + 0.0};
  }
  return result;
}

bool fits_single_precision(Vec3 p) {
  return std::fabs(p.x) <= kLargestFloat && std::fabs(p.y) <= kLargestFloat &&
         std::fabs(p.z) <= kLargestFloat;
}

void refuse_beyond_single_precision(const TriangleMesh& mesh, std::size_t first, std::size_t last,
                                    LengthUnit unit) {
  solid::require_usable_positions(mesh, first, last, "written");
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 p = units_per_metre(unit) * mesh.vertices[i];
    if (fits_single_precision(p)) continue;
    throw InputError({"",
                      "vertex " + std::to_string(i) + " of the mesh: a coordinate of " +
                          rounded_text(largest_coordinate(p), 3) + " " + std::string(unit_symbol(unit)) +
                          " does not fit binary STL",
                      "Single precision ends at 3.4e38.", "OFF or ASCII STL"});
  }
}

}  // namespace

std::string offset_in_words(Vec3 offset) {
  return "origin at (" + decimal_text(offset.x) + ", " + decimal_text(offset.y) + ", " +
         decimal_text(offset.z) + ") m of the site";
}

void require_writable(const TriangleMesh& mesh, const std::stop_token& stop) {
  const auto usable = [&](std::size_t first, std::size_t last) {
    solid::require_usable_positions(mesh, first, last, "written");
  };
  const auto existing = [&](std::size_t first, std::size_t last) {
    solid::require_existing_vertices(mesh, first, last);
  };
  in_ranges(mesh.vertices.size(), usable, stop);
  in_ranges(mesh.triangles.size(), existing, stop);
}

void require_facets(const TriangleMesh& mesh) {
  if (!mesh.triangles.empty()) return;
  throw InputError({"mesh", "the mesh has no facets",
                    "A file of a mesh has one or more: without any there is nothing to read back.", ""});
}

bool is_single_precision(const TriangleMesh& mesh, LengthUnit unit, const std::stop_token& stop) {
  const double per_metre = units_per_metre(unit);
  std::atomic<bool> is_exact = true;
  const auto look = [&](std::size_t first, std::size_t last) {
    bool all_fit = true;
    bool all_exact = true;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 p = per_metre * mesh.vertices[i];
      all_fit &= fits_single_precision(p);
      all_exact &= to_metres(nearest(p), per_metre) == mesh.vertices[i];
    }
    if (!all_fit) refuse_beyond_single_precision(mesh, first, last, unit);
    if (!all_exact) is_exact = false;
  };
  in_ranges(mesh.vertices.size(), look, stop);
  return is_exact;
}

std::vector<Vec3> single_precision(const TriangleMesh& mesh, LengthUnit unit, const std::stop_token& stop) {
  // What came out of as_written() rounds to itself: vertices that are apart stay so without a look.
  const bool is_exact = is_single_precision(mesh, unit, stop);
  const double per_metre = units_per_metre(unit);
  std::vector<Vec3> positions(mesh.vertices.size());
  std::vector<FloatPosition> rounded(mesh.vertices.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    pause_at(i, stop);
    positions[i] = per_metre * mesh.vertices[i];
    rounded[i] = nearest(positions[i]);
  }
  if (!is_exact) {
    DistinctRounding(positions, rounded, unit, stop).keep_apart();
    require_same_attitude(mesh, rounded, unit, stop);
  }
  std::transform(rounded.begin(), rounded.end(), positions.begin(),
                 [per_metre](const FloatPosition& p) { return to_metres(p, per_metre); });
  return positions;
}

}  // namespace glissade::io

namespace glissade {

TriangleMesh as_written(const TriangleMesh& mesh, MeshFormat format, LengthUnit unit,
                        const std::stop_token& stop) {
  io::require_writable(mesh, stop);
  if (format == MeshFormat::stl_binary) return {io::single_precision(mesh, unit, stop), mesh.triangles};
  return io::as_double_precision(mesh, unit);
}

}  // namespace glissade
