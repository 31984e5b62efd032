#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/option_value.hpp"
#include "app/progress_line.hpp"
#include "app/summary.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"
#include "app/watch.hpp"

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kBuildDescription =
    "Build a design: centerline, motion, solid, files, and a summary.\n"
    "\n"
    "Either every file appears or none: a build that fails leaves the directory as it was. A search within\n"
    "limits that ends early (--time-budget, Ctrl-C) still builds the best track so far; the exit code is 4.\n"
    "\n"
    "Files of an earlier build that this one does not make are removed, unless they were changed since; a "
    "file\n"
    "in the way that no build wrote is kept as FILE.kept. Designs of other names may share the directory.";

constexpr const char* kBuildFooter =
    "Examples:\n"
    "  glissade build designs/grain_chute.yaml                     into out/grain_chute/\n"
    "  glissade build designs/grain_chute.yaml -o chute --json\n"
    "  glissade build designs/grain_chute.yaml --set mesh.tolerance=0.1mm --set export=[stl]\n"
    "  glissade build designs/grain_chute.yaml --watch             again at each save, until Ctrl-C";

struct BuildArguments {
  std::string design;
  std::string directory;
  Overrides overrides;
  TimeBudget time_budget;
  bool no_report = false;
  bool json = false;
  bool watch = false;
  Verbosity verbosity;
};

std::filesystem::path directory_of(const BuildArguments& options) {
  if (!options.directory.empty()) return options.directory;
  return std::filesystem::path("out") / std::filesystem::path(options.design).stem();
}

Build built(const Design& design, const BuildArguments& options, RunContext context) {
  ProgressLine progress(options.verbosity);
  context.progress = progress.callback();
  context.time_budget = options.time_budget.seconds();
  return into_directory_of(
      "-o", [&] { return build(design, directory_of(options), context, {.report = !options.no_report}); });
}

ExitCode build_once(const BuildArguments& options) {
  const Design design = read_design(options.design, options.overrides.values());
  const Interrupt interrupt;
  const Build made = [&] {
    try {
      return built(design, options, interrupt.context({}));
    } catch (const LimitsConflict& conflict) {
      if (options.json) print_before_error(conflict_json(design, conflict.report()));
      throw;
    } catch (const NoTrackFound& none) {
      if (options.json) print_before_error(conflict_json(design, none.report()));
      throw;
    }
  }();
  const std::string kept = "All files are written, into " + directory_of(options).string() + ".";
  if (options.json) {
    print(build_json(design, made), kept);
  } else if (!options.verbosity.quiet()) {
    print(build_summary(design, made), kept);
  }
  print_warnings(warnings(design, made.track, made.fabrication.get()));
  if (const auto problem = search_problem(design, made.track)) throw ConvergenceError(*problem);
  return ExitCode::done;
}

/// @return one line about what was built
std::string rebuilt(const BuildArguments& options, const RunContext& context) {
  const Design design = read_design(options.design, options.overrides.values());
  const Build made = built(design, options, context);
  print_warnings(warnings(design, made.track, made.fabrication.get()));
  if (const auto problem = search_problem(design, made.track)) print_problem(ConvergenceError(*problem));
  return "travel time " + time_text(made.track.motion.travel_time()) + ", exit speed " +
         speed_text(made.track.motion.exit_speed()) + ", " + std::to_string(made.files.size()) +
         " files in " + directory_of(options).string();
}

ExitCode build_design(const BuildArguments& options) {
  if (!options.watch) return build_once(options);
  return watch({options.design, options.overrides,
                [&](const RunContext& context) { return rebuilt(options, context); },
                options.verbosity.quiet()});
}

}  // namespace

void add_build(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("build", kBuildDescription)->footer(kBuildFooter);
  const auto options = std::make_shared<BuildArguments>();
  command.add_option("design", options->design, "Design file")->type_name("DESIGN.yaml")->required();
  command
      .add_option("-o,--output", options->directory,
                  "Directory for the files, made if missing [default: out/NAME-OF-THE-DESIGN]")
      ->type_name("DIR");
  options->overrides.add_to(command);
  options->time_budget.add_to(command);
  command.add_flag("--no-report", options->no_report, "Write no report page");
  CLI::Option* const json = command.add_flag("--json", options->json,
                                             "Print one JSON object with SI values instead of the summary");
  command
      .add_flag("--watch", options->watch,
                "Build again whenever the design or a file that it names changes, until Ctrl-C")
      ->excludes(json);
  options->verbosity.add_to(command, "Print nothing but errors (and what --json asks for)");
  command.callback([options, &action] { action = [options] { return build_design(*options); }; });
}

}  // namespace glissade::app
