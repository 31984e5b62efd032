#pragma once

#include "glissade/parts/workshop_build.hpp"
#include "glissade/pipeline/solve.hpp"
#include "glissade/section/cross_section.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/sweep.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// The one way that data flow: design -> centerline -> motion -> solid -> files.

/// Writes a track and the ride down it by stations, as the format csv does: 400, closer together near the start, one at
/// each jump of curvature, and those between that TabulatedCurve needs to make the track of the table again, to
/// kTableAccuracy. No cross-section is needed.
/// @throws FileError as AtomicFile
void write_track_csv(const std::filesystem::path& file, const Track& track);

/// A solid with what was measured on it.
struct ProvenSolid {
  Solid solid;
  /// Of the mesh as the least precise of the files holds it, confirmed on each file read back.
  MeshFacts facts;
  /// The greatest distance between the ideal solid and the mesh as that file holds it, rounding included [m].
  double max_deviation = 0.0;
  /// Where the origin of the mesh files lies in the frame of the site [m]; none: they are in that frame.
  std::optional<Vec3> offset;
};

/// One thing that a build makes: the solid swept along the track is one, with its own facts and files.
struct Part {
  std::string name;                  ///< "track" of the swept solid
  std::optional<ProvenSolid> solid;  ///< none of a part that has no mesh
  std::vector<std::string> files;    ///< names of those that tell of it alone, relative to the directory
};

/// A file of a build that is not on a disk yet.
struct PendingFile {
  std::string name;   ///< relative to the directory of the build; may have folders
  double cost = 1.0;  ///< of writing and reading back, for progress: a mesh file is 1
  /// Writes it under a name that it keeps only for now. Throws as the writers of io/.
  std::function<void(const std::filesystem::path&, const std::stop_token&)> write;
  /// Reads it again and throws InternalError if it is not what was meant; empty of a file that is not read back.
  std::function<void(const std::filesystem::path&, const std::stop_token&)> read_back;
};

/// A build in memory: parts with their facts, and the files to be made of each part and of the whole set.
struct Assembly {
  std::string stem;  ///< of the files' names, and the owner of the files: that of the design file
  Track track;
  std::optional<CrossSection> section;  ///< none where only files of the track are asked for
  std::vector<Part> parts;              ///< the swept solid first, where there is one
  std::vector<PendingFile> files;       ///< in the order in which they are written and told
  std::shared_ptr<const WorkshopBuild>
      fabrication;          ///< what a workshop makes; null where the design asks for none
  double cost = 0.0;        ///< of what has been done, in units of PendingFile::cost
  double total_cost = 1.0;  ///< of that and all files

  /// @return false where only files of the track are made, for which no cross-section is needed
  [[nodiscard]] bool has_solid() const { return section.has_value(); }
  /// The swept solid, which there is if has_solid().
  [[nodiscard]] const ProvenSolid& swept() const { return *parts.front().solid; }
};

/// A file that was written.
struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};

/// A build on disk.
struct Build {
  Track track;
  std::optional<CrossSection> section;  ///< none where only files of the track were asked for
  std::vector<Part> parts;              ///< the swept solid first, where there is one
  std::shared_ptr<const WorkshopBuild>
      fabrication;                 ///< what a workshop makes; null where the design asks for none
  std::vector<WrittenFile> files;  ///< all of them, the report last
  /// Files of an earlier build of this design that this one does not make, unchanged since they were written.
  std::vector<std::filesystem::path> removed;
  /// Files in the way that no build of this design wrote, or that were changed since: by their new names.
  std::vector<std::filesystem::path> set_aside;

  /// @return false where only files of the track are made, for which no cross-section is needed
  [[nodiscard]] bool has_solid() const { return section.has_value(); }
  /// The swept solid, which there is if has_solid().
  [[nodiscard]] const ProvenSolid& swept() const { return *parts.front().solid; }
};

/// What a user should hear of beside a sound build: warnings() of its track, then what a workshop makes otherwise than asked for.
/// @param made  null where the design asks for no fabrication
[[nodiscard]] std::vector<Issue> warnings(const Design& design, const Track& track,
                                          const WorkshopBuild* made);

/// What a build writes beside the files that the design asks for.
struct BuildOptions {
  bool report = true;  ///< write NAME.report.html beside the meshes
};

/// Makes and proves everything of a build in memory; touches no disk.
/// @throws InputError if the design has no cross_section and asks for more than stations of the track (csv), or the
///         section cannot follow the track; InfeasibleError if the body does not arrive or a limit is broken; Interrupted if the context's stop token asks for it;
///         InternalError if a mesh turns out faulty
[[nodiscard]] Assembly assemble(const Design& design, Track track, const RunContext& context = {},
                                const BuildOptions& options = {});

/// Writes, reads back and reports an assembly: all of its files appear in `directory`, or none, as build() says.
/// @param options  those of assemble()
/// @throws FileError if a file cannot be written; Interrupted; InternalError if a file read back differs
[[nodiscard]] Build publish(const Design& design, Assembly assembly, const std::filesystem::path& directory,
                            const RunContext& context = {}, const BuildOptions& options = {});

/// solve(), assemble() and publish(): design to files in `directory` (made if missing), each named after the design file, and NAME.report.html, which
/// shows all of them to people. Either all of them appear, or the directory stays as it was, files of an
/// earlier build included.
///
/// A hidden list, .NAME.sha256, tells which files are the design's. Those that an earlier build wrote and this one
/// does not are removed, unless somebody changed them since; what is in the way and is not the design's keeps its
/// bytes as FILE.kept. Files of other designs are left alone.
/// @throws as solve(); InputError as assemble();
///         InfeasibleError if the body does not arrive or a limit is broken; FileError if a file cannot be
///         written; Interrupted if the context's stop token asks for it; InternalError if a mesh turns out
///         faulty
[[nodiscard]] Build build(const Design& design, const std::filesystem::path& directory,
                          const RunContext& context = {}, const BuildOptions& options = {});

}  // namespace glissade
