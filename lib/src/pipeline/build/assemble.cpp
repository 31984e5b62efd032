// Everything of a build in memory: solids swept, rounded as each file will hold them, measured, and the files that are
// to be made of them. Nothing here touches a disk.

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/gates_csv.hpp"
#include "glissade/io/sheet_file.hpp"
#include "glissade/pipeline.hpp"

#include "pipeline/build/data_sheet.hpp"
#include "pipeline/build/fabricate.hpp"
#include "pipeline/build/steps.hpp"
#include "pipeline/build/workshop_files.hpp"
#include "pipeline/files/formats.hpp"
#include "pipeline/ride/stations.hpp"
#include "pipeline/task/cross_section.hpp"
#include "pipeline/task/hood.hpp"
#include "pipeline/task/located.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace glissade {

using namespace pipeline;

namespace {

// As shares of time measured on meshes of 0.25 and 1 million triangles, writing one mesh file being 1.
constexpr double kSweepCost = 0.1;
constexpr double kCheckCost = 5.0;  // of one rounding of the mesh
constexpr double kReportCost = 1.0;
constexpr double kPartsCost = 1.0;
constexpr double kWorkshopFilesCost = 1.5;

/// A mesh as one or more of the formats hold it, and what was measured on it.
struct MeasuredMesh {
  std::vector<MeshFormat> formats;
  std::shared_ptr<const TriangleMesh> mesh;
  MeshFacts facts;
  double moved = 0.0;  // farthest that rounding took a vertex [m]

  [[nodiscard]] bool is_held_by(MeshFormat format) const {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  }
};

/// A rounding that equals another one is checked once, and ends sooner.
double cost_of_assembly(const std::vector<ExportFormat>& formats) {
  std::vector<MeshFormat> roundings;
  for (const ExportFormat exported : formats) {
    const auto rounding = format_writer(exported).rounding;
    if (rounding && std::find(roundings.begin(), roundings.end(), *rounding) == roundings.end()) {
      roundings.push_back(*rounding);
    }
  }
  return kSweepCost + kCheckCost * static_cast<double>(std::max(roundings.size(), std::size_t{1}));
}

double cost_of_files(const std::vector<ExportFormat>& formats, const BuildOptions& options) {
  double cost = options.report ? kReportCost : 0.0;
  for (const ExportFormat format : formats) cost += format_writer(format).cost;
  return cost;
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

double farthest_move(const TriangleMesh& exact, const TriangleMesh& rounded) {
  double squared = 0.0;
  for (std::size_t i = 0; i < exact.vertices.size(); ++i) {
    const Vec3 move = rounded.vertices[i] - exact.vertices[i];
    squared = std::max(squared, dot(move, move));
  }
  return std::sqrt(squared);
}

/// Every rounding of the mesh that a file of this build holds, each measured once; the mesh itself where none does.
std::vector<MeasuredMesh> measured(const Design& design, const Solid& solid, Steps& steps) {
  std::vector<MeasuredMesh> meshes;
  const auto add = [&](std::vector<MeshFormat> formats, TriangleMesh mesh, double moved) {
    const MeshFacts facts = measure(mesh, steps.stop());
    require_valid(facts, solid);
    meshes.push_back(
        {std::move(formats), std::make_shared<const TriangleMesh>(std::move(mesh)), facts, moved});
  };
  for (const ExportFormat exported : design.exports.formats) {
    const auto format = format_writer(exported).rounding;
    const bool known = format && std::any_of(meshes.begin(), meshes.end(), [&](const MeasuredMesh& mesh) {
                         return mesh.is_held_by(*format);
                       });
    if (!format || known) continue;
    steps.enter("checking the mesh", kCheckCost);
    TriangleMesh rounded = at_place(design.where("export"), [&] {
      return as_written(solid.mesh, *format, design.exports.unit, steps.stop());
    });
    const auto same = std::find_if(meshes.begin(), meshes.end(), [&](const MeasuredMesh& other) {
      return same_mesh(*other.mesh, rounded);
    });
    if (same != meshes.end()) {
      same->formats.push_back(*format);
      continue;
    }
    const double moved = farthest_move(solid.mesh, rounded);
    add({*format}, std::move(rounded), moved);
  }
  if (meshes.empty()) {
    steps.enter("checking the mesh", kCheckCost);
    add({}, solid.mesh, 0.0);
  }
  return meshes;
}

std::shared_ptr<const TriangleMesh> held_by(const std::vector<MeasuredMesh>& meshes,
                                            std::optional<MeshFormat> format) {
  if (!format) return std::make_shared<const TriangleMesh>();
  for (const MeasuredMesh& mesh : meshes) {
    if (mesh.is_held_by(*format)) return mesh.mesh;
  }
  throw InternalError({"", "a mesh was not measured before it was written", "", ""});
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

/// @return how far the section reaches to either side of the track at the most [m]
double half_width(const CrossSection& section) {
  // An arc may reach beyond its chords by this share of its radius.
  constexpr double kCoarse = 0.01;
  const CrossSection widest = section.at_widest();
  const double beyond = kCoarse * widest.widest_radius();
  double reach = 0.0;
  for (const Vec2 corner : widest.outline(beyond > 0.0 ? beyond : 1.0)) {
    reach = std::max(reach, std::fabs(corner.x));
  }
  return reach + beyond;
}

/// By how much the least precise of the files may move a vertex, before there is a mesh to measure it on [m].
struct FileRounding {
  double farthest = 0.0;  // coordinate
  double nearest = 0.0;   // to the nearest number on each axis
  double beside = 0.0;    // to the one next to it, where two vertices would become one
};

/// @param reach  how far the solid lies from there at the most [m]
FileRounding rounding_in_files(const Design& design, Vec3 start, double reach) {
  const std::vector<ExportFormat>& formats = design.exports.formats;
  const bool rounds = std::any_of(formats.begin(), formats.end(), [](ExportFormat format) {
    return file_format(format).content == FileContent::rounded_mesh;
  });
  if (!rounds) return {};
  const double per_metre = units_per_metre(design.exports.unit);
  FileRounding rounding;
  double squares = 0.0;
  for (const double middle : {start.x, start.y, start.z}) {
    const double farthest = std::fabs(middle) + reach;
    const auto single = static_cast<float>(per_metre * farthest);
    const double step = (std::nextafter(single, std::numeric_limits<float>::infinity()) - single) / per_metre;
    squares += step * step;
    rounding.farthest = std::max(rounding.farthest, farthest);
  }
  rounding.beside = std::sqrt(squares);
  rounding.nearest = 0.5 * rounding.beside;
  return rounding;
}

constexpr double kMostRounding =
    0.5;  // taste: of the tolerance; what is left makes facets larger than the file's steps

/// @param moved  by how much positions move [m]
InputError finer_than_files(const Design& design, const FileRounding& rounding, double moved, bool far_away) {
  // Numbers next to the nearest leave as much again to the deviation. Rounded up as it is shown.
  const double coarse = rounding.beside / kMostRounding;
  const double digit = 0.1 * math::decade_of(coarse);
  const std::string does = length_text(std::ceil(coarse / digit) * digit, 2);
  const std::string others = "off or stl-ascii, which hold double precision; or a tolerance of " + does;
  return InputError(
      {design.where("mesh.tolerance"),
       "tolerance: " + length_text(design.mesh.tolerance) + " is finer than binary STL can hold",
       "It holds single precision: at " + length_text(rounding.farthest, 3) +
           " from the origin of the file, positions move by up to " + length_text(moved, 2) +
           "; they may by half of the tolerance.",
       (far_away ? "frame: local in export, whose origin is the start of the track; or " : "") + others});
}

/// A solid, and the files' meshes of it, all within the tolerance.
struct SweptForFiles {
  Solid solid;
  std::vector<MeasuredMesh> meshes;
};

/// The mesh as the least precise of the files holds it: binary STL rounds to single precision.
const MeasuredMesh& least_precise(const std::vector<MeasuredMesh>& meshes) {
  const auto rounded = std::find_if(meshes.begin(), meshes.end(), [](const MeasuredMesh& mesh) {
    return mesh.is_held_by(MeshFormat::stl_binary);
  });
  return rounded == meshes.end() ? meshes.front() : *rounded;
}

/// Sweeps to what rounding leaves of the tolerance: that of the nearest numbers, and where two vertices would become one, and
/// numbers next to those take more, once again to what they leave.
/// @param swept  makes the solid to a tolerance
/// @throws InputError if rounding leaves too little
template <typename Swept>
SweptForFiles within_tolerance(const Design& design, const FileRounding& rounding, bool far_away,
                               const Swept& swept, Steps& steps) {
  const double tolerance = design.mesh.tolerance;
  double moved = rounding.nearest;
  constexpr int kMostSweeps =
      3;  // theory: to the nearest numbers, to what these took, and to the most that they take
  for (int sweeps = 0; sweeps < kMostSweeps && moved <= kMostRounding * tolerance; ++sweeps) {
    SweptForFiles result{swept(tolerance - moved), {}};
    result.meshes = measured(design, result.solid, steps);
    const double really = least_precise(result.meshes).moved;
    if (result.solid.max_deviation + really <= tolerance) return result;
    if (really <= moved) {
      const double departs = result.solid.max_deviation + really;
      throw InternalError({"",
                           "the files depart by " + length_text(departs, 3) + ", the tolerance is " +
                               length_text(tolerance, 3),
                           "", ""});
    }
    // A finer mesh may move others, and none by more than that.
    moved = sweeps == 0 ? really : rounding.beside;
  }
  throw finer_than_files(design, rounding, moved, far_away);
}

/// What the files of this build ask for and no more: a mesh may be large.
std::shared_ptr<const SolidForFiles> material_for_files(const Design& design, const Track& track,
                                                        const Solid& solid,
                                                        const std::optional<Vec3>& offset) {
  auto material = std::make_shared<SolidForFiles>();
  material->name = design.name;
  material->section = section_in_words(*design.cross_section);
  material->unit = design.exports.unit;
  material->offset = offset;
  for (const ExportFormat format : design.exports.formats) {
    if (file_format(format).content == FileContent::exact_model) {
      material->exact = solid.mesh;
      material->centerline = positions(track, solid);
    }
    if (file_format(format).content == FileContent::stations) {
      material->stations = stations_of(track, solid.stations);
    }
  }
  return material;
}

/// What is to be written of the swept solid, in the order of the design.
std::vector<PendingFile> files_of(const Design& design, const std::string& stem,
                                  const std::shared_ptr<const SolidForFiles>& solid,
                                  const std::vector<MeasuredMesh>& meshes) {
  std::vector<PendingFile> files;
  for (const ExportFormat format : design.exports.formats) {
    const FormatWriter& writer = format_writer(format);
    const auto mesh = held_by(meshes, writer.rounding);
    PendingFile file;
    file.name = file_name(stem, format, design.exports.formats);
    file.cost = writer.cost;
    file.write = [solid, mesh, write = writer.write](const std::filesystem::path& path,
                                                     const std::stop_token& stop) {
      write(path, *solid, *mesh, stop);
    };
    if (writer.read_back) {
      file.read_back = [solid, mesh](const std::filesystem::path& path, const std::stop_token& stop) {
        require_same_on_disk(path, *mesh, solid->unit, stop);
      };
    }
    files.push_back(std::move(file));
  }
  return files;
}

/// The solid of the track in the frame of the mesh files.
SweptForFiles track_solid(const Design& design, const Track& track, const CrossSection& section,
                          const Placement& placement, Steps& steps) {
  const double length = track.centerline->length();
  const double reach = math::hypot(length + section.highest() - section.lowest(), half_width(section));
  const auto swept = [&](double tolerance) {
    return at_place(design.where("cross_section"), [&] {
      return sweep(*track.centerline, section, placement,
                   {.tolerance = tolerance, .largest_kink = design.mesh.largest_kink, .stop = steps.stop()});
    });
  };
  const bool far_away = norm(placement.start()) > 2.0 * length;
  return within_tolerance(design, rounding_in_files(design, placement.start(), reach), far_away, swept,
                          steps);
}

/// The solid of a hood in the frame of the mesh files: swept as the valley that it is upside down, as wide as the track
/// at its start, and turned over.
SweptForFiles hood_solid(const Design& design, const Track& track, const CrossSection& section,
                         const Placement& frame, Steps& steps) {
  const HoodShape shape = shape_of(*design.hood);
  const HoodPassage passage = hood_passage(design, track.motion.body());
  const Vec3 entry = frame.to_space(-passage.start.x, -passage.start.y, 0.0);
  const double reach = 2.0 * shape.radius + section.highest() - section.lowest() + track.centerline->length();
  const CenterlinePtr arc = turned_over(shape, first_fall(design).landing);
  const auto swept = [&](double tolerance) {
    Solid solid =
        sweep(*arc, section.at(0.0), track.placement.at_origin(),
              {.tolerance = tolerance, .largest_kink = design.mesh.largest_kink, .stop = steps.stop()});
    for (Vec3& vertex : solid.mesh.vertices) vertex = Vec3{vertex.x, vertex.y, -vertex.z} + entry;
    for (auto& triangle : solid.mesh.triangles) std::swap(triangle[1], triangle[2]);
    solid.placement = Placement(entry, frame.azimuth());
    return solid;
  };
  return within_tolerance(design, rounding_in_files(design, entry, reach), norm(entry) > 2.0 * reach, swept,
                          steps);
}

/// The underside of a hood in the frame of its mesh.
std::vector<Vec3> hood_positions(const Design& design, const Solid& solid) {
  const CenterlinePtr arc = hood_arc(shape_of(*design.hood), first_fall(design).landing);
  std::vector<Vec3> positions;
  for (const double s : solid.stations) {
    const CenterlinePoint at = arc->at(std::min(s, arc->length()));
    positions.push_back(solid.placement.to_space(at.x, at.drop, 0.0));
  }
  return positions;
}

/// A hood is a part of its own, with the files of its own that hold facets.
void add_hood(const Design& given, const Track& track, const CrossSection& section, const Placement& frame,
              const std::string& stem, Steps& steps, std::vector<Part>& parts,
              std::vector<PendingFile>& files) {
  if (!given.hood) return;
  Design design = given;
  std::erase_if(design.exports.formats,
                [](ExportFormat format) { return file_format(format).content == FileContent::stations; });
  auto [solid, meshes] =
      at_place(given.where("hood"), [&] { return hood_solid(design, track, section, frame, steps); });
  const MeasuredMesh& reference = least_precise(meshes);
  const double max_deviation = solid.max_deviation + reference.moved;
  const std::optional<Vec3> offset = offset_in_files(design, track);
  auto material = std::make_shared<SolidForFiles>();
  material->name = design.name.empty() ? "hood" : design.name + ", hood";
  material->section = section_in_words(*design.cross_section) + ", upside down";
  material->unit = design.exports.unit;
  material->offset = offset;
  material->exact = solid.mesh;
  material->centerline = hood_positions(design, solid);
  Part part{.name = "hood",
            .solid = ProvenSolid{std::move(solid), reference.facts, max_deviation, offset},
            .files = {}};
  for (PendingFile& file : files_of(design, stem + ".hood", material, meshes)) {
    part.files.push_back(file.name);
    files.push_back(std::move(file));
  }
  parts.push_back(std::move(part));
}

/// The table of a hill's gates, beside the files of the solid.
void add_gates(const Track& track, const std::string& stem, std::vector<PendingFile>& files) {
  if (!track.gates) return;
  PendingFile file;
  file.name = stem + ".gates.csv";
  file.cost = 0.0;
  file.write = [table = *track.gates](const std::filesystem::path& path, const std::stop_token& /*stop*/) {
    write_gates_csv(path, table);
  };
  files.push_back(std::move(file));
}

/// One page on a chute, for the file.
void add_data_sheet(const Design& design, const Track& track, const std::string& stem,
                    std::vector<PendingFile>& files) {
  if (!design.stream) return;
  PendingFile file;
  file.name = stem + ".data-sheet.pdf";
  file.cost = 0.05;
  const auto sheet = std::make_shared<const Sheet>(chute_data_sheet(design, track));
  const std::string title = design.name.empty() ? stem : design.name;
  file.write = [sheet, title](const std::filesystem::path& path, const std::stop_token& /*stop*/) {
    write_pdf(path, {*sheet}, title);
  };
  files.push_back(std::move(file));
}

/// What the files of the track alone need: no section, no solid.
Assembly assemble_track(const Design& design, Track track, const BuildOptions& options) {
  std::string stem = stem_of(design);
  std::vector<PendingFile> files;
  const auto shared = std::make_shared<const Track>(track);
  for (const ExportFormat format : design.exports.formats) {
    PendingFile file;
    file.name = file_name(stem, format, design.exports.formats);
    file.cost = format_writer(format).cost;
    file.write = [shared](const std::filesystem::path& path, const std::stop_token& /*stop*/) {
      write_track_csv(path, *shared);
    };
    files.push_back(std::move(file));
  }
  add_gates(track, stem, files);
  const double total = cost_of_files(design.exports.formats, options);
  return {std::move(stem), std::move(track), {}, {}, std::move(files), nullptr, 0.0, total};
}

}  // namespace

Assembly assemble(const Design& given, Track track, const RunContext& context, const BuildOptions& options) {
  const Design design = as_solved(given, track);
  require_cross_section(design);
  if (const auto problem = ride_problem(design, track)) throw InfeasibleError(*problem);
  if (const auto problem = limits_problem(design, track)) throw InfeasibleError(*problem);
  if (tells_of_track_alone(design)) return assemble_track(design, std::move(track), options);

  const std::vector<ExportFormat>& formats = design.exports.formats;
  const double solids = design.hood ? 2.0 : 1.0;
  const double cost = solids * cost_of_assembly(formats) + (design.fabrication ? kPartsCost : 0.0);
  const double total =
      cost + cost_of_files(formats, options) + (design.fabrication ? kWorkshopFilesCost : 0.0);
  Steps steps(context, total);
  steps.enter("making the mesh", kSweepCost);
  const std::string place = design.where("cross_section");
  CrossSection section = at_place(place, [&] { return CrossSection(*design.cross_section); });
  const Placement placement =
      design.exports.frame == MeshFrame::local ? track.placement.at_origin() : track.placement;
  auto [solid, meshes] = track_solid(design, track, section, placement, steps);
  const MeasuredMesh& reference = least_precise(meshes);
  const double max_deviation = solid.max_deviation + reference.moved;
  const std::optional<Vec3> offset = offset_in_files(design, track);
  const auto for_files = material_for_files(design, track, solid, offset);

  std::string stem = stem_of(design);
  std::vector<PendingFile> files = files_of(design, stem, for_files, meshes);
  Part part{.name = "track",
            .solid = ProvenSolid{std::move(solid), reference.facts, max_deviation, offset},
            .files = {}};
  for (const PendingFile& file : files) part.files.push_back(file.name);
  add_gates(track, stem, files);
  add_data_sheet(design, track, stem, files);
  std::vector<Part> parts;
  parts.push_back(std::move(part));
  add_hood(design, track, section, placement, stem, steps, parts, files);
  std::shared_ptr<const WorkshopBuild> fabrication;
  if (design.fabrication) {
    steps.enter("making parts", kPartsCost);
    fabrication = fabricate(design, track, placement, steps.stop());
    for (PendingFile& file : workshop_files(design, fabrication, steps.stop()))
      files.push_back(std::move(file));
  }
  return {std::move(stem),
          std::move(track),
          std::move(section),
          std::move(parts),
          std::move(files),
          std::move(fabrication),
          cost,
          total};
}

}  // namespace glissade
