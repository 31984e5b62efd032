#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/mesh_file.hpp"

#include "io/coordinates.hpp"
#include "io/parallel.hpp"
#include "io/printable_name.hpp"
#include "io/stl_facets.hpp"
#include "io/stl_layout.hpp"
#include "io/text_writer.hpp"
#include "solid/mesh_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace glissade {

using namespace io;

namespace {

// Of the comment in a text file.
constexpr std::size_t kLongestTitle = 240;

/// @return unit normal; (0, 0, 0) where the facet has no area
Vec3 normal_of(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const double length = std::sqrt(dot(normal, normal));
  return length > 0.0 && std::isfinite(length) ? (1.0 / length) * normal : Vec3{};
}

std::string titled(std::string_view title, const MeshFileOptions& options, std::size_t most_bytes) {
  std::string text(title);
  text += "unit: ";
  text += unit_symbol(options.unit);
  if (options.offset) {
    // The header of a binary file may be too short for coordinates of many digits.
    const std::string offset = "; " + offset_in_words(*options.offset);
    if (text.size() + offset.size() <= most_bytes) text += offset;
  }
  const std::string prefix = text + "; ";
  const std::string name =
      printable_name(options.name, most_bytes > prefix.size() ? most_bytes - prefix.size() : std::size_t{0});
  return name.empty() ? text : prefix + name;
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
  static_assert(kBytesBeyondFacets <= kBytesBeyondBlock);
  const double per_metre = units_per_metre(options.unit);
  const bool is_rounded = is_single_precision(mesh, options.unit, options.stop);
  if (!is_rounded) solid::require_existing_vertices(mesh, 0, mesh.triangles.size());
  const std::vector<Vec3> rounded =
      is_rounded ? std::vector<Vec3>() : single_precision(mesh, options.unit, options.stop);
  const std::vector<Vec3>& vertices = is_rounded ? mesh.vertices : rounded;

  const auto prefix = stl_prefix(mesh, options);
  file.expect(stl::file_bytes(static_cast<std::uint32_t>(mesh.triangles.size())));
  file.write(prefix.data(), prefix.size());
  write_in_order(file,
                 {mesh.triangles.size(), stl::kFacetBytes,
                  [&](std::size_t first, std::size_t last, char* block) {
                    // Here and not at first: the triangles of a block stay in the cache.
                    if (is_rounded) solid::require_existing_vertices(mesh, first, last);
                    return put_stl_facets(block, mesh.triangles.data() + first, mesh.triangles.data() + last,
                                          vertices, per_metre);
                  }},
                 options.stop);
}

std::vector<Vec3> in_unit(const std::vector<Vec3>& vertices, LengthUnit unit) {
  const double per_metre = units_per_metre(unit);
  std::vector<Vec3> scaled(vertices.size());
  std::transform(vertices.begin(), vertices.end(), scaled.begin(),
                 [per_metre](Vec3 p) { return per_metre * p; });
  return scaled;
}

void put_point(TextCursor& text, RecurringNumbers& coordinates, Vec3 p) {
  coordinates.put(text, p.x);
  text.put(' ');
  coordinates.put(text, p.y);
  text.put(' ');
  coordinates.put(text, p.z);
  text.put('\n');
}

void put_facet(TextCursor& text, RecurringNumbers& coordinates, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = normal_of(a, b, c);
  text.put("facet normal ", static_cast<float>(normal.x), ' ', static_cast<float>(normal.y), ' ',
           static_cast<float>(normal.z), "\nouter loop\n");
  for (const Vec3 corner : {a, b, c}) {
    text.put("vertex ");
    put_point(text, coordinates, corner);
  }
  text.put("endloop\nendfacet\n");
}

void write_stl_ascii(AtomicFile& file, const TriangleMesh& mesh, const MeshFileOptions& options) {
  constexpr std::size_t kWordsOfFacet = 80;
  constexpr std::size_t kLongestFacet = kWordsOfFacet + 12 * (TextCursor::kLongestNumber + 1);
  const std::vector<Vec3> vertices = in_unit(mesh.vertices, options.unit);
  const std::string title = titled("Glissade; ", options, kLongestTitle);
  TextWriter text(file);
  text.put("solid ", title, '\n');
  write_in_order(file,
                 {mesh.triangles.size(), kLongestFacet,
                  [&](std::size_t first, std::size_t last, char* block) {
                    TextCursor cursor(block);
                    RecurringNumbers coordinates;
                    for (std::size_t i = first; i < last; ++i) {
                      const auto& [a, b, c] = mesh.triangles[i];
                      put_facet(cursor, coordinates, vertices[a], vertices[b], vertices[c]);
                    }
                    return cursor.place();
                  }},
                 options.stop);
  text.put("endsolid ", title, '\n');
}

void write_off(AtomicFile& file, const TriangleMesh& mesh, const MeshFileOptions& options) {
  constexpr std::size_t kLongestLine = 2 + 3 * (TextCursor::kLongestNumber + 1);
  const double per_metre = units_per_metre(options.unit);
  TextWriter text(file);
  text.put("OFF\n# ", titled("Glissade; ", options, kLongestTitle), '\n');
  text.put(mesh.vertices.size(), ' ', mesh.triangles.size(), " 0\n");
  write_in_order(file,
                 {mesh.vertices.size(), kLongestLine,
                  [&](std::size_t first, std::size_t last, char* block) {
                    TextCursor cursor(block);
                    RecurringNumbers coordinates;
                    for (std::size_t i = first; i < last; ++i) {
                      put_point(cursor, coordinates, per_metre * mesh.vertices[i]);
                    }
                    return cursor.place();
                  }},
                 options.stop);
  write_in_order(file,
                 {mesh.triangles.size(), kLongestLine,
                  [&](std::size_t first, std::size_t last, char* block) {
                    TextCursor cursor(block);
                    for (std::size_t i = first; i < last; ++i) {
                      const auto& [a, b, c] = mesh.triangles[i];
                      cursor.put("3 ", a, ' ', b, ' ', c, '\n');
                    }
                    return cursor.place();
                  }},
                 options.stop);
}

}  // namespace

void write_mesh(const std::filesystem::path& file, MeshFormat format, const TriangleMesh& mesh,
                const MeshFileOptions& options) {
  require_facets(mesh);
  if (format != MeshFormat::stl_binary) require_writable(mesh, options.stop);
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
