#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/mesh_file.hpp"

#include "io/block_writer.hpp"
#include "io/coordinates.hpp"
#include "io/printable_name.hpp"
#include "io/stl_layout.hpp"
#include "io/text_writer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace glissade {
namespace {

/// @return unit normal; (0, 0, 0) where the facet has no area
Vec3 normal_of(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const double length = std::sqrt(dot(normal, normal));
  return length > 0.0 && std::isfinite(length) ? (1.0 / length) * normal : Vec3{};
}

Vec3 to_vec(const FloatPosition& position) {
  return {position[0], position[1], position[2]};
}

std::string titled(std::string_view title, const MeshFileOptions& options, std::size_t most_bytes) {
  std::string text(title);
  text += "unit: ";
  text += unit_symbol(options.unit);
  const std::string prefix = text + "; ";
  const std::string name =
      printable_name(options.name, most_bytes > prefix.size() ? most_bytes - prefix.size() : std::size_t{0});
  return name.empty() ? text : prefix + name;
}

/// The numbers of one facet as binary STL orders them: normal, then corners.
using FacetNumbers = std::array<float, 12>;

FacetNumbers facet_numbers(const FloatPosition& a, const FloatPosition& b, const FloatPosition& c) {
  const Vec3 normal = normal_of(to_vec(a), to_vec(b), to_vec(c));
  // Adding +0 turns -0 into +0.
  return {static_cast<float>(normal.x) + 0.0F,
          static_cast<float>(normal.y) + 0.0F,
          static_cast<float>(normal.z) + 0.0F,
          a[0],
          a[1],
          a[2],
          b[0],
          b[1],
          b[2],
          c[0],
          c[1],
          c[2]};
}

/// Puts numbers down with their lowest byte first.
void put_numbers(char* place, const FacetNumbers& numbers) {
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(place, numbers.data(), sizeof numbers);
  } else {
    for (const float number : numbers) {
      auto bits = std::bit_cast<std::uint32_t>(number);
      for (std::size_t i = 0; i < sizeof bits; ++i) {
        *place++ = static_cast<char>(bits & 0xFFU);
        bits >>= 8U;
      }
    }
  }
}

std::array<char, stl::kPrefixBytes> stl_prefix(const TriangleMesh& mesh, const MeshFileOptions& options) {
  std::array<char, stl::kPrefixBytes> prefix{};
  // It must not begin with "solid", and some readers look for "COLOR=" in it.
  std::string header = titled("Glissade binary STL; ", options, stl::kHeaderBytes);
  std::replace(header.begin(), header.end(), '=', '-');
  std::copy(header.begin(), header.end(), prefix.begin());
  auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  for (std::size_t i = stl::kHeaderBytes; i < stl::kPrefixBytes; ++i) {
    prefix[i] = static_cast<char>(count & 0xFFU);
    count >>= 8U;
  }
  return prefix;
}

void write_stl_binary(AtomicFile& file, const TriangleMesh& mesh, const MeshFileOptions& options) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError({"mesh", std::to_string(mesh.triangles.size()) + " triangles do not fit binary STL",
                      "The format counts to 4294967295.", "a coarser tolerance"});
  }
  constexpr std::size_t kFacetsPerBlock = BlockWriter::kBlockBytes / stl::kFacetBytes;
  const std::vector<FloatPosition> positions = single_precision(mesh, options.unit);
  const auto prefix = stl_prefix(mesh, options);
  file.write(prefix.data(), prefix.size());

  BlockWriter blocks(file);
  std::size_t used = 0;
  for (std::size_t first = 0; first < mesh.triangles.size(); first += kFacetsPerBlock) {
    if (first > 0) blocks.next(used);
    const std::size_t last = std::min(first + kFacetsPerBlock, mesh.triangles.size());
    char* place = blocks.block();
    for (std::size_t i = first; i < last; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      // The last two bytes of each facet stay 0 from the start.
      put_numbers(place, facet_numbers(positions[a], positions[b], positions[c]));
      place += stl::kFacetBytes;
    }
    used = (last - first) * stl::kFacetBytes;
  }
  blocks.finish(used);
}

std::vector<Vec3> in_unit(const std::vector<Vec3>& vertices, LengthUnit unit) {
  const double per_metre = units_per_metre(unit);
  std::vector<Vec3> scaled(vertices.size());
  std::transform(vertices.begin(), vertices.end(), scaled.begin(),
                 [per_metre](Vec3 p) { return per_metre * p; });
  return scaled;
}

void write_stl_ascii(AtomicFile& file, const TriangleMesh& mesh, const MeshFileOptions& options) {
  constexpr std::size_t kLongestTitle = 240;
  const std::vector<Vec3> vertices = in_unit(mesh.vertices, options.unit);
  const std::string title = titled("Glissade; ", options, kLongestTitle);
  TextWriter text(file);
  text.put("solid ", title, '\n');
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = vertices[triangle[0]];
    const Vec3 b = vertices[triangle[1]];
    const Vec3 c = vertices[triangle[2]];
    const Vec3 normal = normal_of(a, b, c);
    text.put("facet normal ", static_cast<float>(normal.x), ' ', static_cast<float>(normal.y), ' ',
             static_cast<float>(normal.z), "\nouter loop\n");
    for (const Vec3 corner : {a, b, c}) {
      text.put("vertex ", corner.x, ' ', corner.y, ' ', corner.z, '\n');
    }
    text.put("endloop\nendfacet\n");
  }
  text.put("endsolid ", title, '\n');
  text.finish();
}

void write_off(AtomicFile& file, const TriangleMesh& mesh, const MeshFileOptions& options) {
  constexpr std::size_t kLongestTitle = 240;
  const double per_metre = units_per_metre(options.unit);
  TextWriter text(file);
  text.put("OFF\n# ", titled("Glissade; ", options, kLongestTitle), '\n');
  text.put(mesh.vertices.size(), ' ', mesh.triangles.size(), " 0\n");
  for (const Vec3& p : mesh.vertices) {
    text.put(p.x * per_metre, ' ', p.y * per_metre, ' ', p.z * per_metre, '\n');
  }
  for (const auto& [a, b, c] : mesh.triangles) text.put("3 ", a, ' ', b, ' ', c, '\n');
  text.finish();
}

}  // namespace

void write_mesh(const std::filesystem::path& file, MeshFormat format, const TriangleMesh& mesh,
                const MeshFileOptions& options) {
  require_writable(mesh);
  AtomicFile output(file);
  switch (format) {
    case MeshFormat::stl_binary:
      write_stl_binary(output, mesh, options);
      break;
    case MeshFormat::stl_ascii:
      write_stl_ascii(output, mesh, options);
      break;
    case MeshFormat::off:
      write_off(output, mesh, options);
      break;
  }
  output.commit();
}

}  // namespace glissade
