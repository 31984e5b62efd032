#include "io/mesh_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <vector>

namespace glissade::io {
namespace {

template <typename Part>
std::uint64_t read_count(Reading& reading, const Part& part, std::string_view meaning) {
  const std::string_view word = reading.text().word();
  std::uint64_t value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure == std::errc() && end == word.data() + word.size()) return value;
  throw reading.unexpected(part(), word, std::string(meaning));
}

struct OffCounts {
  std::uint64_t vertices = 0;
  std::uint64_t facets = 0;
};

/// @throws FileError if the rest of the file cannot hold what it claims: checked before memory is taken
void require_room(const Reading& reading, const OffCounts& counts, std::uint64_t bytes_left) {
  constexpr std::uint64_t kLeastVertexBytes = 6;  // "0 0 0" and a line feed
  constexpr std::uint64_t kLeastFacetBytes = 8;   // "3 0 1 2" and a line feed
  // The last line feed may be missing.
  const std::uint64_t room = bytes_left + 1;
  if (counts.vertices <= room / kLeastVertexBytes && counts.facets <= room / kLeastFacetBytes &&
      counts.vertices * kLeastVertexBytes + counts.facets * kLeastFacetBytes <= room) {
    return;
  }
  throw reading.error("claims " + std::to_string(counts.vertices) + " vertices and " +
                          std::to_string(counts.facets) + " facets, more than its size can hold",
                      std::to_string(bytes_left) + " bytes follow. It is truncated or damaged.");
}

OffCounts read_off_counts(Reading& reading) {
  const auto part = [] { return "counts"; };
  OffCounts counts;
  counts.vertices = read_count(reading, part, "the number of vertices");
  counts.facets = read_count(reading, part, "the number of facets");
  // The number of edges is of no use to anyone, and often left out.
  reading.text().skip_line();
  require_countable(reading, counts.vertices, counts.facets);
  require_room(reading, counts, reading.text().bytes_left());
  return counts;
}

/// Cuts a polygon into the triangles of a fan, without folds.
class PolygonFan {
 public:
  PolygonFan(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& corners)
      : vertices_(vertices), corners_(corners) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) normal_ = normal_ + doubled_area(0, i, i + 1);
  }

  /// @return the first corner from which every triangle faces the way of the polygon; none if there is none
  [[nodiscard]] std::optional<std::size_t> apex() const {
    for (std::size_t first = 0; first < corners_.size(); ++first) {
      if (is_fan_from(first)) return first;
    }
    return std::nullopt;
  }

  void add_to(std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t apex) const {
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
      triangles.push_back({corner(apex), corner(apex + i), corner(apex + i + 1)});
    }
  }

 private:
  [[nodiscard]] std::uint32_t corner(std::size_t i) const { return corners_[i % corners_.size()]; }

  [[nodiscard]] Vec3 doubled_area(std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3 origin = vertices_[corner(a)];
    return cross(vertices_[corner(b)] - origin, vertices_[corner(c)] - origin);
  }

  [[nodiscard]] bool is_fan_from(std::size_t first) const {
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
      if (!(dot(normal_, doubled_area(first, first + i, first + i + 1)) > 0.0)) return false;
    }
    return true;
  }

  const std::vector<Vec3>& vertices_;
  const std::vector<std::uint32_t>& corners_;
  Vec3 normal_;
};

void add_facet(const Reading& reading, std::size_t facet, const std::vector<std::uint32_t>& corners,
               TriangleMesh& mesh) {
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const PolygonFan fan(mesh.vertices, corners);
  const std::optional<std::size_t> apex = fan.apex();
  if (!apex) {
    throw reading.error_at_line(
        "facet " + std::to_string(facet),
        "a polygon of " + std::to_string(corners.size()) + " corners that no fan covers",
        "Glissade cuts a polygon into triangles from one corner; this one has none "
        "that sees all others.",
        "to cut it into triangles with the program that made it");
  }
  fan.add_to(mesh.triangles, *apex);
}

void read_off_facet(Reading& reading, std::size_t facet, std::vector<std::uint32_t>& corners,
                    TriangleMesh& mesh) {
  constexpr std::uint64_t kMostCorners = 1000;
  const auto part = [facet] { return "facet " + std::to_string(facet); };
  const std::uint64_t count = read_count(reading, part, "a number of corners");
  if (count < 3 || count > kMostCorners) {
    throw reading.error_at_line(part(), "has " + std::to_string(count) + " corners",
                                "Facets of 3 to " + std::to_string(kMostCorners) + " corners can be read.");
  }
  corners.clear();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t vertex = read_count(reading, part, "the number of a vertex");
    if (vertex >= mesh.vertices.size()) {
      throw reading.error_at_line(
          part(), "vertex " + std::to_string(vertex) + " does not exist",
          "The file has " + std::to_string(mesh.vertices.size()) + " vertices, counted from 0.");
    }
    corners.push_back(static_cast<std::uint32_t>(vertex));
  }
  add_facet(reading, facet, corners, mesh);
  // A colour may follow.
  reading.text().skip_line();
}

/// Reads the keyword: OFF, before it ST, C, N for what follows each position.
/// @return whether more than a position stands on each vertex line
bool read_off_keyword(Reading& reading) {
  constexpr std::array<std::string_view, 7> kWithExtras = {"COFF",   "NOFF",   "CNOFF",  "STOFF",
                                                           "STCOFF", "STNOFF", "STCNOFF"};
  const std::string keyword(reading.text().word());
  const bool has_extras = std::find(kWithExtras.begin(), kWithExtras.end(), keyword) != kWithExtras.end();
  const std::string_view next = reading.text().peek(16);
  const std::size_t start = next.find_first_not_of(" \t");
  const bool is_binary = start != next.npos && equals_ignoring_case(next.substr(start, 6), "binary");
  if (is_binary || !(has_extras || equals_ignoring_case(keyword, "off"))) {
    throw reading.error_at_line(
        "header",
        in_quotes(is_binary ? keyword + " BINARY" : keyword) + " is a kind of OFF that cannot be read",
        "Glissade reads text in three dimensions: OFF, with ST, C and N before it.",
        "to save it as plain OFF or STL");
  }
  return has_extras;
}

}  // namespace

TriangleMesh read_off(Reading& reading) {
  reading.text().set_comment('#');
  const bool has_extras = read_off_keyword(reading);
  const OffCounts counts = read_off_counts(reading);
  TriangleMesh mesh;
  mesh.vertices.reserve(counts.vertices);
  mesh.triangles.reserve(counts.facets);
  for (std::uint64_t i = 0; i < counts.vertices; ++i) {
    mesh.vertices.push_back(read_position(reading, [i] { return "vertex " + std::to_string(i); }));
    if (has_extras) reading.text().skip_line();
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < counts.facets; ++i) read_off_facet(reading, i, corners, mesh);
  const std::string_view rest = reading.text().word();
  if (!rest.empty()) {
    throw reading.unexpected("after the last facet", rest, "the end");
  }
  return mesh;
}

}  // namespace glissade::io
