#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/made_directories.hpp"
#include "glissade/study/study.hpp"
#include "glissade/study/summary.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/progress_line.hpp"
#include "app/sweep_text.hpp"
#include "app/table.hpp"
#include "app/track_input.hpp"
#include "app/usage_problem.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSweepDescription =
    "Compute many variants of a design: one row a point, in chunks that any number of processes share.\n"
    "\n"
    "Every combination of --vary, --points and --scatter is a point. It is designed anew, or, with "
    "--frozen,\n"
    "rides the track that was found for the design as it stands. A point that fails is a row that says why.\n"
    "The same command again computes what is missing, whatever ended the last one; nothing is computed "
    "twice.\n"
    "Once all is there, sweep.html beside the rows shows what it says.";

constexpr const char* kSweepFooter =
    "Examples:\n"
    "  glissade sweep designs/grain_chute.yaml --vary body.friction_angle=10deg:25deg:151 -o sweep\n"
    "  glissade sweep --merge sweep -o sweep.csv\n"
    "  glissade sweep designs/grain_chute.yaml --vary track.finish.z=0m:1m:2001 -o high --shard 0/5\n"
    "  glissade sweep designs/grain_chute.yaml --frozen --samples 512 \\\n"
    "      --scatter 'body.friction_angle=normal(17deg,1.5deg)'\n"
    "\n"
    "docs/sweeps.md tells more: the laws, the columns, GNU parallel, Slurm, several machines.";

struct SweepArguments {
  std::string design;
  Overrides overrides;
  std::vector<std::string> vary;
  std::string points;
  std::vector<std::string> scatter;
  std::string samples_text;
  std::uint64_t samples = 0;
  std::string sampling = "sobol";
  std::string seed_text;
  std::uint64_t seed = 1;
  bool frozen = false;
  std::vector<std::string> columns;
  std::string output;
  std::string jobs_text;
  unsigned jobs = 0;
  std::string shard;
  bool slurm = false;
  std::string tasks_text;
  std::uint64_t tasks = 0;
  std::string merge;
  Verbosity verbosity;
};

void require(bool holds, Issue issue) {
  if (!holds) throw InputError(std::move(issue));
}

/// More than any machine has processors.
constexpr unsigned kMostJobs = 65'536;  // taste

/// A whole number that an option names, kept as text until here: the parser would take -1 for the largest one there is.
std::uint64_t count_of(const std::string& option, const std::string& text, std::uint64_t least,
                       std::uint64_t most, const std::string& why, const std::string& hint) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  const bool whole = error == std::errc() && rest == end;
  if (whole && value >= least && value <= most) return value;
  throw InputError(
      {option, "'" + text + "' is " + (whole ? "out of range" : "no whole number of 0 or more"), why, hint});
}

study::Plan plan_of(const SweepArguments& options) {
  std::vector<study::Factor> factors;
  for (const std::string& text : options.vary) factors.push_back(study::vary(text));
  if (!options.points.empty()) factors.push_back(study::read_points(options.points));
  constexpr const char* kExample = "--scatter \"body.friction_angle=normal(17deg,1.5deg)\" --samples 1000";
  require(options.scatter.empty() || options.samples != 0,
          {"--scatter", "--samples is missing", "It is how many values are drawn.", kExample});
  require(
      !options.scatter.empty() || options.samples == 0,
      {"--samples", "nothing scatters", "--samples is how many values are drawn for --scatter.", kExample});
  if (!options.scatter.empty()) {
    factors.push_back(study::scatter(options.scatter, study::sampling_named(options.sampling),
                                     options.samples, options.seed));
  }
  return study::Plan(std::move(factors));
}

study::Study study_of(const SweepArguments& options) {
  return {DesignSource::read(options.design),
          options.overrides.values(),
          plan_of(options),
          options.frozen,
          options.columns,
          study::needs_stall_margins(options.columns) ? study::quantities_with_stall_margins
                                                      : study::quantities_of};
}

/// The command that a worker runs, without the shard.
std::vector<std::string> sweep_arguments(const SweepArguments& options, const fs::path& directory) {
  std::vector<std::string> words = {"sweep", options.design};
  const auto add = [&](const std::string& name, const std::string& value) {
    words.push_back(name);
    words.push_back(value);
  };
  for (const Override& change : options.overrides.values())
    add("--set", change.key_path + "=" + change.value);
  for (const std::string& text : options.vary) add("--vary", text);
  if (!options.points.empty()) add("--points", options.points);
  for (const std::string& text : options.scatter) add("--scatter", text);
  if (options.samples != 0) {
    add("--samples", std::to_string(options.samples));
    add("--sampling", options.sampling);
    add("--seed", std::to_string(options.seed));
  }
  if (options.frozen) words.emplace_back("--frozen");
  if (!options.columns.empty()) {
    std::string names;
    for (const std::string& name : options.columns) names += (names.empty() ? "" : ",") + name;
    add("--columns", names);
  }
  add("-o", directory.string());
  return words;
}

fs::path directory_of(const SweepArguments& options) {
  if (!options.output.empty()) return options.output;
  return fs::path("out") / (fs::path(options.design).stem().string() + "_sweep");
}

ExitCode merge_chunks(const SweepArguments& options) {
  require(options.design.empty(),
          {"--merge", "a design is given as well", "The directory knows what was studied.",
           "glissade sweep --merge sweep -o sweep.csv"});
  require(!options.output.empty(), {"--merge", "-o is missing", "It names the table to write.",
                                    "glissade sweep --merge sweep -o sweep.csv"});
  const Interrupt interrupt;
  const study::Results results = study::Results::open(options.merge);
  const auto counts = [&] {
    ProgressLine progress(options.verbosity);
    return study::merge(results, options.output, progress.callback(), interrupt.token());
  }();
  if (!options.verbosity.quiet())
    print(counts_text(counts) + "\n  " + options.output + "\n",
          "The table is written, as " + options.output + ".");
  return ExitCode::done;
}

void write_whole(const fs::path& path, const std::string& text) {
  write_atomically(path, text);
}

/// The batch file for Slurm beside the rows that its tasks will write.
ExitCode write_batch(const SweepArguments& options, const study::Study& study, const fs::path& directory) {
  constexpr std::uint64_t kUsualTasks = 16;
  const std::uint64_t chunks = study::chunks_of(study.plan.count());
  const std::uint64_t tasks = options.tasks != 0 ? options.tasks : std::min(kUsualTasks, chunks);
  study::check(study);
  MadeDirectories made;  // gone where the file cannot be written
  made.make(directory);
  const fs::path file = directory / "sweep.sbatch";
  OutputFiles files;
  files.set().put(file, batch_text(sweep_arguments(options, directory), directory.string(), tasks));
  files.put_in_place();
  if (!options.verbosity.quiet()) {
    print(labelled("Batch file", file.string() + ", " + std::to_string(tasks) + " tasks") +
              labelled("Submit it", "sbatch " + for_shell(file.string()) + ", where this command was given"),
          "The file is written, as " + file.string() + ".");
  }
  return ExitCode::done;
}

/// Writes what the rows say on a page beside them.
/// @return it in a few lines
std::string write_summary(const SweepArguments& options, const fs::path& directory,
                          const std::stop_token& stop) {
  const study::Results results = study::Results::open(directory);
  const study::Summary summary = [&] {
    ProgressLine progress(options.verbosity);
    return study::summarise(results, progress.callback(), stop);
  }();
  const fs::path page = directory / "sweep.html";
  write_whole(page, study::summary_page(results, summary));
  return summary_text(summary) + "\n" + labelled("Page", page.string());
}

/// Prints what a run did, once all that it leaves is written.
void tell_run(const SweepArguments& options, const study::RunReport& report, const fs::path& directory,
              const std::stop_token& stop) {
  std::string text = run_text(report, directory.string());
  std::string kept = "The rows are written, into " + directory.string();
  const bool quiet = options.verbosity.quiet();
  if (report.complete) {
    try {
      text += write_summary(options, directory, stop);
    } catch (const Error&) {
      if (!quiet) print_before_error(text, kept + ".");
      throw;
    }
    kept += ", and what they say, as " + (directory / "sweep.html").string();
  }
  if (!quiet) print(text, kept + ".");
}

/// Options that are of no use together, or alone.
void refuse_unused(const CLI::App& command, const SweepArguments& options) {
  if (!options.merge.empty()) {
    refuse_ignored(command,
                   {"--set", "--vary", "--points", "--scatter", "--samples", "--sampling", "--seed",
                    "--frozen", "--columns", "--jobs", "--shard", "--slurm", "--tasks"},
                   "beside --merge",
                   "The directory knows what was studied; its rows are written as they are.",
                   "glissade sweep --merge sweep -o sweep.csv");
    return;
  }
  if (options.slurm) {
    refuse_ignored(command, {"--jobs", "--shard"}, "beside --slurm",
                   "Nothing is computed now; each task of the array gets a shard.", "--tasks 16");
  } else {
    refuse_ignored(command, {"--tasks"}, "without --slurm", "They are those of Slurm's array.",
                   "--slurm, or --jobs for threads");
  }
  if (options.scatter.empty()) {
    refuse_ignored(command, {"--sampling", "--seed"}, "without --scatter", "Only what scatters is drawn.",
                   "--scatter \"body.friction_angle=normal(17deg,1.5deg)\" --samples 1000");
  }
}

SweepArguments counted(SweepArguments options) {
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  if (!options.jobs_text.empty()) {
    options.jobs = static_cast<unsigned>(
        count_of("--jobs", options.jobs_text, 0, kMostJobs,
                 "It lies between 0 and 65536 threads; 0 is one a processor.", "--jobs 4"));
  }
  if (!options.seed_text.empty()) {
    options.seed =
        count_of("--seed", options.seed_text, 0, kAll,
                 "It lies between 0 and 18446744073709551615, and stands for its samples.", "--seed 2");
  }
  if (!options.samples_text.empty()) {
    options.samples = count_of("--samples", options.samples_text, 1, study::Plan::kMostPoints,
                               "It lies between 1 and 1000000000.", "--samples 1000");
  }
  if (!options.tasks_text.empty()) {
    options.tasks =
        count_of("--tasks", options.tasks_text, 1, study::Plan::kMostPoints,
                 "An array has a task at least, and no more than there are points.", "--tasks 16");
  }
  return options;
}

ExitCode sweep_design(const CLI::App& command, const SweepArguments& given) {
  refuse_unused(command, given);
  const SweepArguments options = counted(given);
  if (!options.merge.empty()) return merge_chunks(options);
  require(!options.design.empty(), {"", "a design file is missing", "", "glissade sweep --help"});
  const study::Study study = study_of(options);
  const fs::path directory = directory_of(options);
  if (options.slurm) return into_directory_of("-o", [&] { return write_batch(options, study, directory); });
  study::RunOptions run_options;
  run_options.directory = directory;
  if (!options.shard.empty()) run_options.shard = study::Shard::parse(options.shard);
  run_options.jobs = options.jobs;
  const Interrupt interrupt;
  run_options.stop = interrupt.token();
  const study::RunReport report = [&] {
    ProgressLine progress(options.verbosity);
    run_options.progress = progress.callback();
    return into_directory_of("-o", [&] { return study::run(study, run_options); });
  }();
  tell_run(options, report, directory, interrupt.token());
  return ExitCode::done;
}

}  // namespace

void add_sweep(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("sweep", kSweepDescription)->footer(kSweepFooter);
  const auto options = std::make_shared<SweepArguments>();
  const auto several = [&](const std::string& name, std::vector<std::string>& values, const std::string& type,
                           const std::string& description) {
    command.add_option(name, values, description)->type_name(type)->take_all()->allow_extra_args(false);
  };
  command.add_option("design", options->design, "Design file")->type_name("DESIGN.yaml");
  options->overrides.add_to(command);
  several("--vary", options->vary, "KEY=VALUES",
          "FROM:TO:NUMBER, a grid, or a list A,B,C; may be repeated, the last one varies fastest");
  command.add_option("--points", options->points, "Table of points: a line of keys, then a line a point")
      ->type_name("FILE.csv");
  several("--scatter", options->scatter, "KEY=LAW",
          "uniform(LOW,HIGH), normal(MEAN,DEVIATION), truncated-normal(MEAN,DEVIATION,LOW,HIGH), "
          "lognormal(MEDIAN,SIGMA) or triangular(LOW,MODE,HIGH); may be repeated");
  command.add_option("--samples", options->samples_text, "How many values are drawn for --scatter")
      ->type_name("NUMBER");
  command
      .add_option("--sampling", options->sampling,
                  "sobol, latin-hypercube or random [default: sobol, the evenest; best with a power of 2]")
      ->type_name("WAY");
  command.add_option("--seed", options->seed_text, "Another seed draws other samples [default: 1]")
      ->type_name("NUMBER");
  command.add_flag("--frozen", options->frozen, "Find the track of the design once; every point rides it");
  command
      .add_option("--columns", options->columns,
                  "Quantities of a row, by their names in --json, separated by commas [default: all]")
      ->type_name("NAMES")
      ->delimiter(',');
  command
      .add_option(
          "-o,--output", options->output,
          "Directory for the rows, made if missing [default: out/NAME-OF-THE-DESIGN_sweep]; with --merge "
          "the table to write")
      ->type_name("PATH");
  command.add_option("--jobs", options->jobs_text, "Threads; 0: one a processor [default: 0]")
      ->type_name("NUMBER");
  command
      .add_option("--shard", options->shard, "Compute only part i of n, counted from 0; for engines outside")
      ->type_name("i/n");
  command.add_flag("--slurm", options->slurm,
                   "Compute nothing; write a batch file for Slurm, an array of shards");
  command
      .add_option("--tasks", options->tasks_text,
                  "Of --slurm: tasks of the array [default: 16, or one a chunk]")
      ->type_name("NUMBER");
  command.add_option("--merge", options->merge, "Write all rows of a directory as one table instead")
      ->type_name("DIR");
  options->verbosity.add_to(command, "Print nothing but errors");
  command.callback([options, &action, &command] {
    action = [options, &command] { return sweep_design(command, *options); };
  });
}

}  // namespace glissade::app
