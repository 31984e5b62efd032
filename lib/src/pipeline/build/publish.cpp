// From memory to a directory: every file is made and read back beside the others before any of them appears.

#include "glissade/io/atomic_file.hpp"
#include "glissade/pipeline.hpp"

#include "io/parallel.hpp"
#include "pipeline/build/fabricate.hpp"
#include "pipeline/build/report.hpp"
#include "pipeline/build/steps.hpp"
#include "pipeline/files/formats.hpp"
#include "pipeline/files/owned_files.hpp"
#include "pipeline/files/read_files.hpp"
#include "pipeline/files/staging.hpp"
#include "pipeline/rules/chute_rules.hpp"
#include "pipeline/task/cross_section.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace glissade {

using namespace pipeline;

namespace {

namespace fs = std::filesystem;

constexpr const char* kReportEnding = ".report.html";

ReportWhatIf as_reported(const Design& design, const WhatIfRide& one) {
  ReportWhatIf reported{one.mass_flow, one.motion.body().friction, one.nominal, &one.motion, {}, {}};
  if (design.discharge && one.motion.arrived() && enters(one.motion))
    reported.landing = belt_landing(design, one.motion);
  if (reported.landing && !reported.landing->lands()) reported.landing.reset();
  reported.flight = flight_to_belt(design, one.motion);
  return reported;
}

void write_report(const fs::path& path, const Design& design, const BuildForReport& build) {
  AtomicFile file(path);
  const std::vector<ChuteCase> cases =
      design.stream ? chute_cases(design, build.track.centerline) : std::vector<ChuteCase>{};
  ReportInput input = report_input(design, build);
  for (const ChuteCase& run : cases) input.cases.push_back({run.friction, run.flow, &run.motion});
  const std::vector<WhatIfRide> what_if =
      design.stream ? what_if_rides(design, build.track.centerline) : std::vector<WhatIfRide>{};
  for (const WhatIfRide& one : what_if) input.what_if.push_back(as_reported(design, one));
  file.write(report_html(input));
  file.commit();
}

/// What there is beside the files that a design asks for.
std::vector<std::string> names_beside(const std::string& stem, const BuildOptions& options) {
  std::vector<std::string> names = {OwnedFiles::list_name(stem)};
  if (options.report) names.push_back(stem + kReportEnding);
  return names;
}

std::vector<std::string> names_of(const Assembly& assembly, const BuildOptions& options) {
  std::vector<std::string> names = names_beside(assembly.stem, options);
  for (const PendingFile& file : assembly.files) names.push_back(file.name);
  return names;
}

/// The names that are known before there is a track; a search may take long.
std::vector<std::string> names_known(const Design& design, const BuildOptions& options) {
  const std::string stem = stem_of(design);
  std::vector<std::string> names = names_beside(stem, options);
  for (const ExportFormat format : design.exports.formats)
    names.push_back(file_name(stem, format, design.exports.formats));
  return names;
}

}  // namespace

Build publish(const Design& given, Assembly assembly, const fs::path& directory, const RunContext& context,
              const BuildOptions& options) {
  const Design design = as_solved(given, assembly.track);
  Steps steps(context, assembly.total_cost, assembly.cost);
  require_none_read(given, directory, names_of(assembly, options));
  Staging staging(directory, assembly.stem, given.file);
  // What an earlier build wrote may be what the design reads by now.
  staging.keep([&](const fs::path& file) { return is_read_by(given, file); });
  std::vector<fs::path> made;
  std::vector<fs::path> read_back;
  for (const PendingFile& file : assembly.files) {
    made.push_back(staging.path_for(file.name));
    if (file.read_back) read_back.push_back(made.back());
  }
  io::each_in_turn(
      made.size(),
      [&](std::size_t i) { steps.enter("writing " + assembly.files[i].name, assembly.files[i].cost); },
      [&](std::size_t i) {
        const PendingFile& file = assembly.files[i];
        io::named_as(made[i], directory / file.name, [&] {
          file.write(made[i], context.stop);
          if (file.read_back) file.read_back(made[i], context.stop);
        });
      });
  const ProvenSolid* const swept = assembly.has_solid() ? &assembly.swept() : nullptr;
  if (options.report) {
    // Last of all: it lists the others.
    const std::string name = assembly.stem + kReportEnding;
    steps.enter("writing " + name, assembly.total_cost - assembly.cost);
    const fs::path page = staging.path_for(name);
    io::named_as(page, directory / name, [&] {
      write_report(page, design,
                   {assembly.track, assembly.section ? &*assembly.section : nullptr, swept, std::move(made),
                    std::move(read_back), context.stop, assembly.fabrication.get()});
    });
  }
  require_going(context.stop);

  Published published = staging.publish();
  std::vector<WrittenFile> files;
  for (const fs::path& path : published.files) files.push_back({path, fs::file_size(path)});
  return {std::move(assembly.track),
          std::move(assembly.section),
          std::move(assembly.parts),
          std::move(assembly.fabrication),
          std::move(files),
          std::move(published.removed),
          std::move(published.set_aside)};
}

namespace {

/// One work of two: where the search tells how far it is, what comes after it goes on from there.
class WholeProgress {
 public:
  explicit WholeProgress(const Progress& told) : told_(told) {}

  [[nodiscard]] Progress of_search() {
    if (!told_) return {};
    return [this](std::string_view stage, std::optional<double> fraction) {
      // Of another try the fraction begins anew: the whole is as far as it was.
      if (fraction) reached_ = std::max(reached_, kShareOfSearch * *fraction);
      searched_ = searched_ || fraction;
      told_(stage, fraction ? std::optional(reached_) : std::nullopt);
    };
  }
  [[nodiscard]] Progress of_the_rest() {
    if (!told_) return {};
    const double before = searched_ ? kShareOfSearch : 0.0;
    return [this, before](std::string_view stage, std::optional<double> fraction) {
      if (fraction) fraction = before + (1.0 - before) * *fraction;
      told_(stage, fraction);
    };
  }

 private:
  static constexpr double kShareOfSearch = 0.5;

  const Progress& told_;
  double reached_ = 0.0;
  bool searched_ = false;
};

}  // namespace

Build build(const Design& design, const fs::path& directory, const RunContext& given_context,
            const BuildOptions& options) {
  RunContext context = given_context;
  require_cross_section(design);
  require_same_design(directory, stem_of(design), design.file);
  require_none_read(design, directory, names_known(design, options));
  WholeProgress progress(given_context.progress);
  context.progress = progress.of_search();
  Track track = solve(design, context);
  context.progress = progress.of_the_rest();
  // The request to stop has been met: the search ended with the best track so far, which is built.
  if (track.search && context.stop.stop_requested()) context.stop = {};
  return publish(design, assemble(design, std::move(track), context, options), directory, context, options);
}

}  // namespace glissade
