#include "glissade/pipeline.hpp"
#include "glissade/pipeline/frozen.hpp"
#include "glissade/pipeline/json.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/searched_track.hpp"
#include "app/summary.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"

#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kSolveDescription =
    "Find the centerline and the ride down it; write no files but those asked for.\n"
    "\n"
    "A body that stalls or leaves the track is reported with the place, and the exit code is 3; the same "
    "for\n"
    "a track that breaks a limit of its design, and for limits that no track keeps.";

constexpr const char* kSolveFooter =
    "Examples:\n"
    "  glissade solve designs/grain_chute.yaml\n"
    "  glissade solve designs/grain_chute.yaml --csv ride.csv           speed, load, ... by stations\n"
    "  glissade solve designs/grain_chute.yaml --frozen found.yaml      the track found, as a design\n"
    "  glissade solve designs/grain_chute.yaml --set body.friction_angle=19deg\n"
    "  glissade solve --run 10 --drop 5 --friction-angle 11deg\n"
    "  glissade solve --run 10 --drop 5 --friction-coefficient 0.2 --p 127 --json";

struct SolveArguments {
  TrackInput input{TrackInput::Scope::one_kind};
  TimeBudget time_budget;
  Verbosity verbosity;
  std::string csv;
  std::string frozen;
  bool json = false;
};

void require_sound(const Design& design, const Track& track) {
  if (const auto problem = ride_problem(design, track)) throw InfeasibleError(*problem);
  if (const auto problem = limits_problem(design, track)) throw InfeasibleError(*problem);
  require_searched_through(design, track);
}

void write_files(const SolveArguments& options, const Design& design, const Track& track) {
  OutputFiles files;
  files.make(options.csv, [&](const std::filesystem::path& csv) { write_track_csv(csv, track); });
  if (!options.frozen.empty()) add_frozen_design(files.set(), options.frozen, design, track);
  files.put_in_place();
}

ExitCode solve_track(const SolveArguments& options) {
  const Design design = options.input.design();
  try {
    const Track track = searched_track(design, options.verbosity, options.time_budget.seconds());
    const bool files = !(options.csv.empty() && options.frozen.empty());
    write_and_print([&] { write_files(options, design, track); },
                    options.json ? track_json(design, track) : track_summary(design, track),
                    files ? kFilesWritten : "");
    print_warnings(warnings(design, track));
    require_sound(design, track);
  } catch (const LimitsConflict& conflict) {
    if (options.json) print_before_error(conflict_json(design, conflict.report()));
    throw;
  } catch (const NoTrackFound& none) {
    if (options.json) print_before_error(conflict_json(design, none.report()));
    throw;
  }
  return ExitCode::done;
}

}  // namespace

void add_solve(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("solve", kSolveDescription)->footer(kSolveFooter);
  const auto options = std::make_shared<SolveArguments>();
  options->input.add_to(command);
  options->time_budget.add_to(command);
  command.add_option("--csv", options->csv, "Write the track and the ride by stations")->type_name("FILE");
  command
      .add_option(
          "--frozen", options->frozen,
          "Write the track found as a design in which nothing is searched for; a track that needs a table "
          "has it beside the design, as FILE.csv")
      ->type_name("FILE");
  add_json_flag(command, options->json, "the summary");
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action] { action = [options] { return solve_track(*options); }; });
}

}  // namespace glissade::app
