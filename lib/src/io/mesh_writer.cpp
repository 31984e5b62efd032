#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/mesh_file.hpp"

#include "io/coordinates.hpp"
#include "io/printable_name.hpp"
#include "io/stl_layout.hpp"
#include "io/text_writer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
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

void append_float(char*& place, float value) {
  auto bits = std::bit_cast<std::uint32_t>(value);
  for (int i = 0; i < 4; ++i) {
    *place++ = static_cast<char>(bits & 0xFFU);
    bits >>= 8U;
  }
}

void append_position(char*& place, const FloatPosition& position) {
  for (const float coordinate : position) append_float(place, coordinate);
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
  constexpr std::size_t kFacetsPerBlock = 8192;
  const std::vector<FloatPosition> positions = single_precision(mesh, options.unit);
  const auto prefix = stl_prefix(mesh, options);
  file.write(prefix.data(), prefix.size());

  std::vector<char> block(kFacetsPerBlock * stl::kFacetBytes);
  for (std::size_t first = 0; first < mesh.triangles.size(); first += kFacetsPerBlock) {
    const std::size_t last = std::min(first + kFacetsPerBlock, mesh.triangles.size());
    char* place = block.data();
    for (std::size_t i = first; i < last; ++i) {
      const auto& [ia, ib, ic] = mesh.triangles[i];
      const FloatPosition& a = positions[ia];
      const FloatPosition& b = positions[ib];
      const FloatPosition& c = positions[ic];
      const Vec3 normal = normal_of(to_vec(a), to_vec(b), to_vec(c));
      append_position(place, {static_cast<float>(normal.x) + 0.0F, static_cast<float>(normal.y) + 0.0F,
                              static_cast<float>(normal.z) + 0.0F});
      append_position(place, a);
      append_position(place, b);
      append_position(place, c);
      *place++ = 0;
      *place++ = 0;
    }
    file.write(block.data(), static_cast<std::size_t>(place - block.data()));
  }
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
  text << "solid " << title << '\n';
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = vertices[triangle[0]];
    const Vec3 b = vertices[triangle[1]];
    const Vec3 c = vertices[triangle[2]];
    const Vec3 normal = normal_of(a, b, c);
    text << "facet normal " << static_cast<float>(normal.x) << ' ' << static_cast<float>(normal.y) << ' '
         << static_cast<float>(normal.z) << "\nouter loop\n";
    for (const Vec3 corner : {a, b, c}) {
      text << "vertex " << corner.x << ' ' << corner.y << ' ' << corner.z << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid " << title << '\n';
  text.flush();
}

void write_off(AtomicFile& file, const TriangleMesh& mesh, const MeshFileOptions& options) {
  constexpr std::size_t kLongestTitle = 240;
  const double per_metre = units_per_metre(options.unit);
  TextWriter text(file);
  text << "OFF\n# " << titled("Glissade; ", options, kLongestTitle) << '\n';
  text << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Vec3& p : mesh.vertices) {
    text << p.x * per_metre << ' ' << p.y * per_metre << ' ' << p.z * per_metre << '\n';
  }
  for (const auto& [a, b, c] : mesh.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
  text.flush();
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
