#include "glissade/core/number_text.hpp"
#include "glissade/core/stop.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/io/scad_file.hpp"
#include "glissade/io/stations_csv.hpp"
#include "glissade/pipeline.hpp"

#include "pipeline/located.hpp"
#include "pipeline/report.hpp"
#include "pipeline/staging.hpp"
#include "pipeline/stations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade {

using namespace pipeline;

namespace {

namespace fs = std::filesystem;

constexpr const char* kReportEnding = ".report.html";

/// A mesh as one or more of the formats hold it, and what was measured on it.
struct MeasuredMesh {
  std::vector<MeshFormat> formats;
  TriangleMesh mesh;
  MeshFacts facts;
  double moved = 0.0;  // farthest that rounding took a vertex [m]
};

// What the steps of a build cost, as shares of time measured on meshes of 0.25 and 1 million triangles.
constexpr double kSweepCost = 0.1;
constexpr double kCheckCost = 5.0;  // of one rounding of the mesh
constexpr double kMeshFileCost = 1.0;
constexpr double kTableCost = 0.1;
constexpr double kReportCost = 1.0;

/// Tells how far a build is, step by step.
class Steps {
 public:
  Steps(const RunContext& context, double total) : context_(context), total_(total) {}

  /// Tells what comes next and what it will have cost, unless the work is to end.
  void enter(const std::string& stage, double cost) {
    require_going(context_.stop);
    if (context_.progress) context_.progress(stage, done_ / total_);
    done_ += cost;
  }

  [[nodiscard]] const std::stop_token& stop() const { return context_.stop; }

 private:
  const RunContext& context_;
  double total_;
  double done_ = 0.0;
};

std::string stem_of(const Design& design) {
  const std::string stem = design.file.stem().string();
  return stem.empty() ? "track" : stem;
}

std::string file_name(const Design& design, ExportFormat format) {
  const std::string stem = stem_of(design);
  switch (format) {
    case ExportFormat::stl:
      return stem + ".stl";
    case ExportFormat::stl_ascii: {
      // Beside a binary one it needs a name of its own.
      const auto& formats = design.exports.formats;
      const bool both = std::find(formats.begin(), formats.end(), ExportFormat::stl) != formats.end();
      return stem + (both ? ".ascii.stl" : ".stl");
    }
    case ExportFormat::off:
      return stem + ".off";
    case ExportFormat::scad:
      return stem + ".scad";
    case ExportFormat::csv:
      return stem + ".csv";
  }
  throw InternalError({"", "a file format without a name", "", ""});
}

/// The precision in which a file holds the mesh; none for a file that holds no mesh.
std::optional<MeshFormat> mesh_format(ExportFormat format) {
  switch (format) {
    case ExportFormat::stl:
      return MeshFormat::stl_binary;
    case ExportFormat::stl_ascii:
      return MeshFormat::stl_ascii;
    case ExportFormat::off:
    case ExportFormat::scad:  // both hold every double exactly
      return MeshFormat::off;
    case ExportFormat::csv:
      return {};
  }
  return {};
}

double cost_of(ExportFormat format) {
  return mesh_format(format) ? kMeshFileCost : kTableCost;
}

/// The whole of a build after the centerline; a rounding that equals another one is checked once, and ends sooner.
double cost_of(const Design& design, const BuildOptions& options) {
  std::vector<MeshFormat> roundings;
  double cost = kSweepCost + (options.report ? kReportCost : 0.0);
  for (const ExportFormat exported : design.exports.formats) {
    cost += cost_of(exported);
    const auto format = mesh_format(exported);
    if (!format || std::find(roundings.begin(), roundings.end(), *format) != roundings.end()) continue;
    roundings.push_back(*format);
  }
  return cost + kCheckCost * static_cast<double>(std::max(roundings.size(), std::size_t{1}));
}

bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
}

void require_valid(const MeshFacts& facts, const Solid& solid) {
  std::vector<std::string> faults = facts.faults();
  if (facts.components != 1) faults.push_back(std::to_string(facts.components) + " separate pieces");
  if (facts.euler_characteristic != solid.expected_euler) {
    faults.push_back("Euler characteristic " + std::to_string(facts.euler_characteristic) + " instead of " +
                     std::to_string(solid.expected_euler));
  }
  if (faults.empty()) return;
  std::string what = "the mesh is faulty:";
  for (const std::string& fault : faults) what += " " + fault + ";";
  what.pop_back();
  throw InternalError({"", what, "A faulty mesh is never written.", "another mesh.tolerance"});
}

/// The mesh as a format holds it; none if it has not been measured.
const MeasuredMesh* held_by(const std::vector<MeasuredMesh>& meshes, MeshFormat format) {
  for (const MeasuredMesh& mesh : meshes) {
    if (std::find(mesh.formats.begin(), mesh.formats.end(), format) != mesh.formats.end()) return &mesh;
  }
  return nullptr;
}

double farthest_move(const TriangleMesh& exact, const TriangleMesh& rounded) {
  double squared = 0.0;
  for (std::size_t i = 0; i < exact.vertices.size(); ++i) {
    const Vec3 move = rounded.vertices[i] - exact.vertices[i];
    squared = std::max(squared, dot(move, move));
  }
  return std::sqrt(squared);
}

/// Every rounding of the mesh that a file of this build holds, each measured once.
std::vector<MeasuredMesh> measured(const Design& design, const Solid& solid, Steps& steps) {
  std::vector<MeasuredMesh> meshes;
  for (const ExportFormat exported : design.exports.formats) {
    const auto format = mesh_format(exported);
    if (!format || held_by(meshes, *format) != nullptr) continue;
    steps.enter("checking the mesh", kCheckCost);
    TriangleMesh rounded = at_place(design.where("export"), [&] {
      return as_written(solid.mesh, *format, design.exports.unit, steps.stop());
    });
    const auto known = std::find_if(meshes.begin(), meshes.end(), [&](const MeasuredMesh& other) {
      return same_mesh(other.mesh, rounded);
    });
    if (known != meshes.end()) {
      known->formats.push_back(*format);
      continue;
    }
    const MeshFacts facts = measure(rounded, steps.stop());
    require_valid(facts, solid);
    const double moved = farthest_move(solid.mesh, rounded);
    meshes.push_back({{*format}, std::move(rounded), facts, moved});
  }
  return meshes;
}

const MeasuredMesh& as_held_by(const std::vector<MeasuredMesh>& meshes, MeshFormat format) {
  if (const MeasuredMesh* const mesh = held_by(meshes, format)) return *mesh;
  throw InternalError({"", "a mesh was not measured before it was written", "", ""});
}

/// Reads a file again and holds it against the mesh that was measured: the same facets at the same positions,
/// in the same order, so that every fact of the one is a fact of the other.
void require_same_on_disk(const fs::path& file, const TriangleMesh& expected, LengthUnit unit,
                          const std::stop_token& stop) {
  const TriangleMesh found = read_mesh(file, unit, stop);
  bool same = found.triangles.size() == expected.triangles.size() &&
              found.vertices.size() == expected.vertices.size();
  for (std::size_t facet = 0; same && facet < expected.triangles.size(); ++facet) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      same = same && found.vertices[found.triangles[facet][corner]] ==
                         expected.vertices[expected.triangles[facet][corner]];
    }
  }
  if (!same) {
    throw InternalError(
        {file.filename().string(), "the file read back differs from what was written", "", ""});
  }
}

std::string section_in_words(const CrossSectionDesign& section) {
  std::string text(word(section.kind));
  if (section.kind == CrossSectionKind::polygon) return text;
  text += section.kind == CrossSectionKind::pipe ? ", inner diameter " : ", width ";
  text += length_text(section.width);
  if (section.wall_height > 0.0) text += ", wall height " + length_text(section.wall_height);
  if (section.kind == CrossSectionKind::trapezoid) {
    text += ", walls " + angle_text(section.wall_angle.radians()) + " from upright";
  }
  if (section.curb_height > 0.0) {
    text += ", curbs " + length_text(section.curb_height) + " high and " + length_text(section.curb_width) +
            " wide";
  }
  return text + ", thickness " + length_text(section.thickness);
}

/// The centerline in the frame of the mesh.
std::vector<Vec3> positions(const Track& track, const Solid& solid) {
  std::vector<Vec3> positions;
  positions.reserve(solid.stations.size());
  for (const double s : solid.stations) {
    const CenterlinePoint point = track.centerline->at(s);
    positions.push_back(solid.placement.to_space(point.x, point.drop, 0.0));
  }
  return positions;
}

std::optional<Vec3> offset_in_files(const Design& design, const Track& track) {
  if (design.exports.frame == MeshFrame::site) return {};
  return track.placement.start();
}

/// By how much the least precise of the files may move a vertex, before there is a mesh to measure it on.
/// @throws InputError if that leaves nothing of the tolerance
double rounding_in_files(const Design& design, const Centerline& centerline, const CrossSection& section,
                         const Placement& placement) {
  const std::vector<ExportFormat>& formats = design.exports.formats;
  if (std::find(formats.begin(), formats.end(), ExportFormat::stl) == formats.end()) return 0.0;
  const Vec3 start = placement.start();
  const double farthest = std::max({std::fabs(start.x), std::fabs(start.y), std::fabs(start.z)}) +
                          centerline.length() + section.highest() - section.lowest();
  // Half a step of single precision on each axis; one whole step where two vertices would become one.
  const double step = 0x1p-23 * farthest;
  const double rounding = std::sqrt(3.0) * step;
  constexpr double kMostOfTolerance = 0.5;
  if (rounding <= kMostOfTolerance * design.mesh.tolerance) return rounding;
  const bool far_away = norm(start) > 2.0 * centerline.length();
  throw InputError(
      {design.where("mesh.tolerance"),
       "tolerance: " + length_text(design.mesh.tolerance) + " is finer than binary STL can hold",
       "It holds single precision: at " + length_text(farthest, 3) +
           " from the origin of the file, positions move by up to " + length_text(rounding, 2) + ".",
       far_away ? "frame: local in export, whose origin is the start of the track; or off or stl-ascii"
                : "off or stl-ascii, which hold double precision; or a tolerance of at least " +
                      length_text(rounding / kMostOfTolerance, 2)});
}

void require_within_tolerance(const Design& design, double max_deviation) {
  if (max_deviation <= design.mesh.tolerance) return;
  throw InternalError({"",
                       "the files depart by " + length_text(max_deviation, 3) + ", the tolerance is " +
                           length_text(design.mesh.tolerance, 3),
                       "", ""});
}

void write_file(const fs::path& path, ExportFormat format, const Design& design, const Track& track,
                const Solid& solid, const std::vector<MeasuredMesh>& meshes, const std::stop_token& stop) {
  switch (format) {
    case ExportFormat::stl:
    case ExportFormat::stl_ascii:
    case ExportFormat::off: {
      const MeshFormat mesh_file = *mesh_format(format);
      // Rounding the rounded mesh again changes nothing, and takes far less time.
      const TriangleMesh& rounded = as_held_by(meshes, mesh_file).mesh;
      write_mesh(path, mesh_file, rounded,
                 {design.exports.unit, offset_in_files(design, track), design.name, stop});
      require_same_on_disk(path, rounded, design.exports.unit, stop);
      return;
    }
    case ExportFormat::scad:
      write_scad(path, solid.mesh, positions(track, solid),
                 {design.exports.unit, design.name, offset_in_files(design, track),
                  section_in_words(*design.cross_section), stop});
      return;
    case ExportFormat::csv:
      write_stations_csv(path, stations_of(track, solid.stations));
      return;
  }
}

/// The mesh as the least precise of the files holds it: binary STL rounds to single precision.
const MeasuredMesh& least_precise(const std::vector<MeasuredMesh>& meshes) {
  const bool has_stl = std::any_of(meshes.begin(), meshes.end(), [](const MeasuredMesh& mesh) {
    return std::find(mesh.formats.begin(), mesh.formats.end(), MeshFormat::stl_binary) != mesh.formats.end();
  });
  return has_stl ? as_held_by(meshes, MeshFormat::stl_binary) : meshes.front();
}

bool is_read_back(ExportFormat format) {
  return format == ExportFormat::stl || format == ExportFormat::stl_ascii || format == ExportFormat::off;
}

void write_report(const fs::path& path, const Design& design, const BuildForReport& build) {
  AtomicFile file(path);
  file.write(report_html(report_input(design, build)));
  file.commit();
}

/// Writes a file that gets its own name later; in what goes wrong it has that name already.
template <typename Write>
void named_as(const fs::path& staged, const fs::path& file, Write&& write) {
  try {
    std::forward<Write>(write)();
  } catch (const FileError& error) {
    std::vector<Issue> issues = error.issues();
    for (Issue& issue : issues) {
      if (issue.where == staged.string()) issue.where = file.string();
    }
    throw FileError(std::move(issues));
  }
}

void require_buildable(const Design& design) {
  if (design.cross_section) return;
  throw InputError(
      {design.where("cross_section"), "there is no cross_section to make a solid of",
       "A build sweeps a cross-section along the centerline.",
       "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}, or "
       "'glissade solve' for the track alone"});
}

}  // namespace

CrossSection make_cross_section(const CrossSectionDesign& design) {
  switch (design.kind) {
    case CrossSectionKind::slab:
      return CrossSection::slab(design.width, design.thickness, design.curb_height, design.curb_width);
    case CrossSectionKind::u_channel:
      return CrossSection::u_channel(design.width, design.wall_height, design.thickness);
    case CrossSectionKind::trapezoid:
      return CrossSection::trapezoid(design.width, design.wall_height, design.wall_angle, design.thickness);
    case CrossSectionKind::half_pipe:
      return CrossSection::half_pipe(design.width, design.thickness, design.wall_height);
    case CrossSectionKind::pipe:
      return CrossSection::pipe(design.width, design.thickness);
    case CrossSectionKind::polygon:
      return CrossSection::polygon(design.outline);
  }
  throw InternalError({"", "a kind of cross-section without a shape", "", ""});
}

Build build(const Design& design, const fs::path& directory, const RunContext& given_context,
            const BuildOptions& options) {
  require_buildable(design);
  RunContext context = given_context;
  Track track = solve(design, context);
  if (const auto problem = ride_problem(design, track)) throw InfeasibleError(*problem);
  if (const auto problem = limits_problem(design, track)) throw InfeasibleError(*problem);
  // The request to stop has been met: the search ended with the best track so far, which is built.
  if (track.search && context.stop.stop_requested()) context.stop = {};

  Steps steps(context, cost_of(design, options));
  steps.enter("making the mesh", kSweepCost);
  const std::string place = design.where("cross_section");
  CrossSection section = at_place(place, [&] { return make_cross_section(*design.cross_section); });
  const Placement placement =
      design.exports.frame == MeshFrame::local ? track.placement.at_origin() : track.placement;
  const double rounding = rounding_in_files(design, *track.centerline, section, placement);
  Solid solid = at_place(place, [&] {
    return sweep(*track.centerline, section, placement,
                 {.tolerance = design.mesh.tolerance - rounding,
                  .largest_kink = design.mesh.largest_kink,
                  .stop = context.stop});
  });

  std::vector<MeasuredMesh> meshes = measured(design, solid, steps);
  if (meshes.empty()) {
    steps.enter("checking the mesh", kCheckCost);
    const MeshFacts facts = measure(solid.mesh, context.stop);
    require_valid(facts, solid);
    meshes.push_back({{}, solid.mesh, facts, 0.0});
  }

  MeshFacts facts = least_precise(meshes).facts;
  const double max_deviation = solid.max_deviation + least_precise(meshes).moved;
  require_within_tolerance(design, max_deviation);
  Staging staging(directory, stem_of(design));
  std::vector<fs::path> made;
  std::vector<fs::path> read_back;
  for (const ExportFormat format : design.exports.formats) {
    const std::string name = file_name(design, format);
    steps.enter("writing " + name, cost_of(format));
    made.push_back(staging.path_for(name));
    named_as(made.back(), directory / name,
             [&] { write_file(made.back(), format, design, track, solid, meshes, context.stop); });
    if (is_read_back(format)) read_back.push_back(made.back());
  }
  if (options.report) {
    // Last of all: it lists the others.
    const std::string name = stem_of(design) + kReportEnding;
    steps.enter("writing " + name, kReportCost);
    const fs::path page = staging.path_for(name);
    named_as(page, directory / name, [&] {
      write_report(
          page, design,
          {track, section, solid, facts, max_deviation, std::move(made), std::move(read_back), context.stop});
    });
  }
  require_going(context.stop);

  Published published = staging.publish();
  std::vector<WrittenFile> files;
  for (const fs::path& path : published.files) files.push_back({path, fs::file_size(path)});
  return {std::move(track),
          std::move(section),
          std::move(solid),
          facts,
          max_deviation,
          offset_in_files(design, track),
          std::move(files),
          std::move(published.removed),
          std::move(published.set_aside)};
}

}  // namespace glissade
