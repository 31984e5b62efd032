#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/clearance/envelope.hpp"
#include "glissade/core/friction_level.hpp"
#include "glissade/core/progress.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/solid/cross_section.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/placement.hpp"
#include "glissade/solid/sweep.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace glissade {

/// The one way that data flow: design -> centerline -> motion -> solid -> files.

/// How long work tells how far it is, and is asked to end.
struct RunContext {
  Progress progress;
  std::stop_token stop;  ///< a search within limits ends with the best track so far
  double time_budget = OptimizeOptions{}.time_budget;  ///< of a search within limits [s]; > 0
};

/// The ride at one end of a friction range.
struct RangeRide {
  FrictionLevel level = FrictionLevel::low;
  Motion motion;  ///< its body has that friction
};

/// One of a track's rides by its friction.
struct LevelRide {
  FrictionLevel level = FrictionLevel::nominal;
  const Motion* motion = nullptr;
};

/// A centerline with the ride down it and the two rides that it is measured by.
struct Track {
  Endpoints endpoints;
  Placement placement;
  CenterlinePtr centerline;
  Motion motion;  ///< at the nominal friction
  /// The same body on the straight line between the endpoints; none if it does not arrive there.
  std::optional<Motion> straight;
  /// The ride on the fastest track there is, which the theory gives from rest and without drag
  /// (docs/theory.md, fastest track); none where it does not apply.
  std::optional<Motion> optimum;
  /// Travel time of `optimum` by its closed form, which shares nothing with Motion [s].
  std::optional<double> optimum_travel_time;
  /// Smallest radius of curvature [m]: 0 where the curvature is unbounded at the start, infinity on a
  /// straight.
  double min_radius = 0.0;
  double steepest_slope_angle = 0.0;  ///< largest slope angle anywhere [rad]
  /// How the search within the limits ended, of the kind fastest with limits; none otherwise. Limits have the
  /// names and the frame of the design file: finish.x, finish.z.
  std::optional<OptimizeReport> search;
  /// Every limit of the design, whatever the kind, as the referee finds it on this track; empty without
  /// limits. Places of an envelope are (x, z) as the design's limits give them.
  std::vector<LimitCheck> limit_checks;
  /// The same body at the ends of the design's friction range; empty where it has none.
  std::vector<RangeRide> range;

  /// @return the rides at every friction that the design names, from low to high; the nominal one is always
  ///         among them. They live as long as the track.
  [[nodiscard]] std::vector<LevelRide> rides() const;
  /// @return travel time on the straight line [s]; none if the body does not arrive there
  [[nodiscard]] std::optional<double> straight_travel_time() const;
};

/// No track keeps the limits of a design, or none was found. Its issue names those that contradict each other
/// and the smallest relaxations that would do.
class LimitsConflict : public InfeasibleError {
 public:
  LimitsConflict(Issue issue, OptimizeReport report)
      : InfeasibleError(std::move(issue)), report_(std::move(report)) {}
  [[nodiscard]] const OptimizeReport& report() const noexcept { return report_; }

 private:
  OptimizeReport report_;
};

/// Where a design's track leads, in the plane of its centerline. Of a free finish it is some place within its
/// range.
[[nodiscard]] Endpoints endpoints_of(const Design& design);

/// What slides or rolls, as Motion takes it.
/// @throws InputError if a measure of the body breaks its bound
[[nodiscard]] Body body_of(const Design& design);

/// A design as the optimiser takes it: run and drop from the start.
[[nodiscard]] Problem problem_of(const Design& design);

/// What the clearances of a design are measured from: the solid of its cross_section and the headroom; all 0
/// where that is the centerline, or where nothing is kept clear of.
/// @throws InputError if the measures do not make a cross-section
[[nodiscard]] Envelope envelope_of(const Design& design);

/// A part of a design's envelope in words: "wall rim", "underside", "finish face".
[[nodiscard]] std::string part_text(const Design& design, EnvelopePart part);

/// A design whose finish is where its centerline ends, for those that leave it to `segments` or `points`;
/// with it, other kinds of centerline can be put in its place.
/// @throws as make_centerline()
[[nodiscard]] Design with_finish(Design design);

/// The curve that a design asks for, its limits left aside.
/// @throws InputError, InfeasibleError, ConvergenceError, FileError with the location in the design
[[nodiscard]] CenterlinePtr make_centerline(const Design& design);

/// The ride of the design's body down a given centerline, what it is measured by, and its limits checked.
[[nodiscard]] Track ride(const Design& design, CenterlinePtr centerline);

/// A track that stays as it is, ridden at another friction: nothing is searched or chosen anew. Its limits are
/// held against that friction alone.
/// @param design      where the track and the rest of the body come from
/// @param centerline  a track of that design
[[nodiscard]] Track ride_at(Design design, const CenterlinePtr& centerline, const Friction& friction);

/// The friction angle from which on a track's body stalls on it: stall_friction_angle() of the nominal ride.
[[nodiscard]] std::optional<Angle> stall_angle_of(const Track& track);

/// Design to centerline and motion. With limits, the kind fastest is searched for within them, and so it is for a
/// body that is not a sliding point; on other kinds
/// they are checked. A body that stalls or leaves the track is a result, not an error, and so is a broken
/// limit, or a search that ends early with a track (Track::search).
/// @throws InputError with everything that check() finds; LimitsConflict if no track keeps the limits;
///         ConvergenceError or Interrupted if the search ended before it found a track that does; else as
///         make_centerline()
[[nodiscard]] Track solve(const Design& design, const RunContext& context = {});

/// @return what to call a track that was searched for: "fastest within the limits", or "fastest, searched for"
///         where the search had another reason (drag, a free finish)
[[nodiscard]] std::string searched_name(const Design& design);

/// Why a ride is not what was wanted: the body stalls or leaves the track, or its law ends.
/// @return the problem with the place and what is missing there; none if the body arrives
[[nodiscard]] std::optional<Issue> ride_problem(const Design& design, const Track& track);

/// Where a law holds no longer although the ride goes on: a ball that slips.
/// @return the problem with the place and what is missing; none where the law holds all along
[[nodiscard]] std::optional<Issue> law_problem(const Design& design, const Track& track);

/// Why a track is not what its limits ask for.
/// @return the problem, every broken limit with the place and by how much; none if all are kept
[[nodiscard]] std::optional<Issue> limits_problem(const Design& design, const Track& track);

/// Whether a search within limits ended before it converged.
/// @return how it ended and what that means; none if it converged, or there was none
[[nodiscard]] std::optional<Issue> search_problem(const Design& design, const Track& track);

/// Writes a track and the ride down it by stations, as the format csv does: some 400, closer together near the
/// start, and one at each jump of curvature. No cross-section is needed.
/// @throws FileError as AtomicFile
void write_track_csv(const std::filesystem::path& file, const Track& track);

/// What a user should hear of beside a sound answer: something asked for that had no effect, or data that may
/// not say what they seem to.
[[nodiscard]] std::vector<Issue> warnings(const Design& design, const Track& track);

/// The outline that a design asks for.
/// @throws InputError if the measures do not make a cross-section
[[nodiscard]] CrossSection make_cross_section(const CrossSectionDesign& design);

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
  CrossSection section;
  std::vector<Part> parts;         ///< the swept solid first
  std::vector<PendingFile> files;  ///< in the order in which they are written and told
  double cost = 0.0;               ///< of what has been done, in units of PendingFile::cost
  double total_cost = 1.0;         ///< of that and all files

  [[nodiscard]] const ProvenSolid& swept() const { return *parts.front().solid; }
};

struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};

/// A build on disk.
struct Build {
  Track track;
  CrossSection section;
  std::vector<Part> parts;         ///< the swept solid first
  std::vector<WrittenFile> files;  ///< all of them, the report last
  /// Files of an earlier build of this design that this one does not make, unchanged since they were written.
  std::vector<std::filesystem::path> removed;
  /// Files in the way that no build of this design wrote, or that were changed since: by their new names.
  std::vector<std::filesystem::path> set_aside;

  [[nodiscard]] const ProvenSolid& swept() const { return *parts.front().solid; }
};

struct BuildOptions {
  bool report = true;  ///< write NAME.report.html beside the meshes
};

/// Makes and proves everything of a build in memory; touches no disk.
/// @throws InputError if the design has no cross_section or the section cannot follow the track; InfeasibleError if
///         the body does not arrive or a limit is broken; Interrupted if the context's stop token asks for it;
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
/// @throws as solve(); InputError if the design has no cross_section or the section cannot follow the track;
///         InfeasibleError if the body does not arrive or a limit is broken; FileError if a file cannot be
///         written; Interrupted if the context's stop token asks for it; InternalError if a mesh turns out
///         faulty
[[nodiscard]] Build build(const Design& design, const std::filesystem::path& directory,
                          const RunContext& context = {}, const BuildOptions& options = {});

}  // namespace glissade
