#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/scad_file.hpp"

#include "core/counted.hpp"
#include "io/coordinates.hpp"
#include "io/parallel.hpp"
#include "io/printable_name.hpp"
#include "io/text_writer.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace glissade {

using namespace io;

namespace {

// Modules hold their data themselves: OpenSCAD evaluates the variables of a used file anew at every call.
constexpr std::string_view kUsage =
    "// Renders the solid. From another file:\n"
    "//   use <this file>\n"
    "//   glissade_solid();\n"
    "//   glissade_centerline(diameter);          a bar along it, so wide and high\n"
    "//   points = glissade_centerline_points();  from start to finish\n"
    "//   translate(glissade_offset()) ...          into the frame of the site\n"
    "\n"
    "glissade_solid();\n"
    "\n";

// Joined in its plane, where OpenSCAD is fast and exact whatever the curvature; a chain of balls takes
// minutes.
constexpr std::string_view kCenterlineModule =
    "module glissade_centerline(diameter) {\n"
    "  points = glissade_centerline_points();\n"
    "  along = glissade_direction();\n"
    "  flat = [for (p = points) [(p - points[0]) * along, p[2] - points[0][2]]];\n"
    "  translate(points[0])\n"
    "    multmatrix([[along[0], 0, along[1], 0], [along[1], 0, -along[0], 0], [0, 1, 0, 0], [0, 0, 0, 1]])\n"
    "      linear_extrude(height = diameter, center = true, convexity = 10)\n"
    "        for (i = [1:len(flat) - 1]) hull() {\n"
    "          translate(flat[i - 1]) circle(d = diameter);\n"
    "          translate(flat[i]) circle(d = diameter);\n"
    "        }\n"
    "}\n";

/// @return level unit vector from start to finish; +x where the finish lies straight below the start
Vec3 direction_of(const std::vector<Vec3>& centerline) {
  const Vec3 chord = centerline.back() - centerline.front();
  const double run = math::hypot(chord.x, chord.y);
  return run > 0.0 ? Vec3{chord.x / run, chord.y / run, 0.0} : Vec3{1.0, 0.0, 0.0};
}

void require_centerline(const std::vector<Vec3>& centerline) {
  if (centerline.size() < 2) {
    throw InputError({"centerline", "has " + core::counted(centerline.size(), "point"),
                      "A line needs two points or more.", ""});
  }
  constexpr double kFlatness = 1e-9;
  const Vec3 along = direction_of(centerline);
  const Vec3 across{along.y, -along.x, 0.0};
  const double most_beside =
      kFlatness * (norm(centerline.front()) + norm(centerline.back() - centerline.front()));
  for (std::size_t i = 0; i < centerline.size(); ++i) {
    const Vec3& p = centerline[i];
    const std::string where = "centerline, point " + std::to_string(i);
    if (!std::isfinite(p.x + p.y + p.z)) {
      throw InputError({where, "a coordinate is not a finite number", "", ""});
    }
    const double beside = std::fabs(dot(p - centerline.front(), across));
    if (beside > most_beside) {
      throw InputError({where, "lies " + length_text(beside, 3) + " beside the plane of the track",
                        "A centerline stays in the vertical plane through its ends.", ""});
    }
  }
}

std::string_view before_item(std::size_t item) {
  return item == 0 ? "\n" : ",\n";
}

void write_points(AtomicFile& file, const std::vector<Vec3>& points, double per_metre,
                  const std::stop_token& stop) {
  constexpr std::size_t kLongestLine = 4 + 3 * (TextCursor::kLongestNumber + 1);
  file.write("[");
  write_in_order(file,
                 {points.size(), kLongestLine,
                  [&](std::size_t first, std::size_t last, char* block) {
                    TextCursor cursor(block);
                    for (std::size_t i = first; i < last; ++i) {
                      const Vec3 p = per_metre * points[i];
                      cursor.put(before_item(i), '[', p.x, ',', p.y, ',', p.z, ']');
                    }
                    return cursor.place();
                  }},
                 stop);
  file.write("\n]");
}

/// OpenSCAD winds facets clockwise as seen from outside, Glissade the other way.
void write_faces(AtomicFile& file, const TriangleMesh& mesh, const std::stop_token& stop) {
  constexpr std::size_t kLongestLine = 4 + 3 * (TextCursor::kLongestNumber + 1);
  file.write("[");
  write_in_order(file,
                 {mesh.triangles.size(), kLongestLine,
                  [&](std::size_t first, std::size_t last, char* block) {
                    TextCursor cursor(block);
                    for (std::size_t i = first; i < last; ++i) {
                      const auto& [a, b, c] = mesh.triangles[i];
                      cursor.put(before_item(i), '[', a, ',', c, ',', b, ']');
                    }
                    return cursor.place();
                  }},
                 stop);
  file.write("\n]");
}

}  // namespace

void write_scad(const std::filesystem::path& file, const TriangleMesh& mesh,
                const std::vector<Vec3>& centerline, const ScadFileOptions& options) {
  require_facets(mesh);
  require_writable(mesh, options.stop);
  require_centerline(centerline);
  const double per_metre = units_per_metre(options.unit);
  AtomicFile output(file);
  TextWriter text(output);
  text.put("// Glissade; unit: ", unit_symbol(options.unit), "; ", printable_name(options.name), '\n');
  if (options.offset) text.put("// ", offset_in_words(*options.offset), "; see glissade_offset()\n");
  if (!options.section.empty()) text.put("// Cross-section: ", printable_name(options.section), '\n');
  text.put(kUsage, "module glissade_solid() {\n  polyhedron(convexity = 10, points = ");
  write_points(output, mesh.vertices, per_metre, options.stop);
  text.put(", faces = ");
  write_faces(output, mesh, options.stop);
  text.put(");\n}\n\nfunction glissade_centerline_points() = ");
  write_points(output, centerline, per_metre, options.stop);
  const Vec3 along = direction_of(centerline);
  text.put(";\n\nfunction glissade_direction() = [", along.x, ',', along.y, ",0];\n\n");
  const Vec3 offset = per_metre * options.offset.value_or(Vec3{});
  text.put("function glissade_offset() = [", offset.x, ',', offset.y, ',', offset.z, "];\n\n",
           kCenterlineModule);
  output.commit();
}

}  // namespace glissade
