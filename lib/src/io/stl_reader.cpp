#include "io/mesh_reader.hpp"
#include "io/stl_layout.hpp"
#include "solid/position_index.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace glissade::io {
namespace {

/// Facets whose corners are given as positions; equal positions become one vertex.
class WeldingMesh {
 public:
  explicit WeldingMesh(std::size_t facets) : index_(mesh_.vertices, facets / 2) {
    mesh_.triangles.reserve(facets);
    mesh_.vertices.reserve(facets / 2);
  }

  void add(const std::array<Vec3, 3>& corners) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex_at(corners[i]);
    mesh_.triangles.push_back(triangle);
  }

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] std::uint32_t vertex_at(Vec3 position) {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const std::uint32_t vertex = index_.enter(position, next);
    if (vertex == next) mesh_.vertices.push_back(position);
    return vertex;
  }

  TriangleMesh mesh_;
  solid::PositionIndex index_;
};

Vec3 position_at(const char* bytes, double per_metre) {
  const auto coordinate = [bytes, per_metre](std::size_t axis) {
    return std::bit_cast<float>(stl::little_endian(bytes + 4 * axis)) / per_metre + 0.0;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

template <typename Part>
void expect_keyword(Reading& reading, const Part& part, std::string_view keyword) {
  const std::string_view word = reading.text().word();
  if (!equals_ignoring_case(word, keyword)) {
    throw reading.unexpected(part(), word, '"' + std::string(keyword) + '"');
  }
}

std::array<Vec3, 3> read_stl_facet(Reading& reading, std::size_t facet) {
  const auto part = [facet] { return "facet " + std::to_string(facet); };
  expect_keyword(reading, part, "normal");
  // The corners say it all: normals are often wrong or missing and mean nothing here.
  for (int i = 0; i < 3; ++i) (void)reading.text().word();
  expect_keyword(reading, part, "outer");
  expect_keyword(reading, part, "loop");
  std::array<Vec3, 3> corners{};
  for (Vec3& corner : corners) {
    expect_keyword(reading, part, "vertex");
    corner = read_position(reading, part);
  }
  expect_keyword(reading, part, "endloop");
  expect_keyword(reading, part, "endfacet");
  return corners;
}

}  // namespace

TriangleMesh read_stl_binary(Reading& reading) {
  constexpr std::size_t kFacetsPerBlock = 4096;
  std::array<char, stl::kPrefixBytes> prefix{};
  (void)reading.text().read(prefix.data(), prefix.size());
  const std::uint32_t facets = stl::little_endian(prefix.data() + stl::kHeaderBytes);
  require_countable(reading, 3 * std::uint64_t{facets}, facets);

  WeldingMesh result(facets);
  std::vector<char> block(kFacetsPerBlock * stl::kFacetBytes);
  for (std::size_t first = 0; first < facets; first += kFacetsPerBlock) {
    const std::size_t count = std::min<std::size_t>(kFacetsPerBlock, facets - first);
    if (reading.text().read(block.data(), count * stl::kFacetBytes) != count * stl::kFacetBytes) {
      throw reading.error("ended while it was read", "Another program seems to be writing it.");
    }
    for (std::size_t i = 0; i < count; ++i) {
      constexpr std::size_t kPositionBytes = 12;
      const char* corner = block.data() + i * stl::kFacetBytes + kPositionBytes;
      std::array<Vec3, 3> corners{};
      for (Vec3& position : corners) {
        position = position_at(corner, reading.per_metre());
        corner += kPositionBytes;
        if (!std::isfinite(position.x + position.y + position.z)) {
          throw reading.error_in("facet " + std::to_string(first + i + 1),
                                 "a coordinate is not a finite number");
        }
      }
      result.add(corners);
    }
  }
  return result.take();
}

TriangleMesh read_stl_ascii(Reading& reading) {
  WeldingMesh result(0);
  TextScanner& text = reading.text();
  for (std::string_view solid = text.word(); !solid.empty(); solid = text.word()) {
    if (!equals_ignoring_case(solid, "solid")) {
      throw reading.unexpected("after facet " + std::to_string(result.mesh().triangles.size()), solid,
                               "\"solid\" or the end");
    }
    text.skip_line();
    for (;;) {
      const std::size_t facet = result.mesh().triangles.size() + 1;
      const std::string_view word = text.word();
      if (equals_ignoring_case(word, "endsolid")) break;
      if (!equals_ignoring_case(word, "facet")) {
        throw reading.unexpected("after facet " + std::to_string(facet - 1), word,
                                 R"("facet" or "endsolid")");
      }
      require_countable(reading, 3 * std::uint64_t{facet}, facet);
      result.add(read_stl_facet(reading, facet));
    }
    text.skip_line();
  }
  return result.take();
}

}  // namespace glissade::io
