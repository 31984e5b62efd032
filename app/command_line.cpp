#include "app/command_line.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/version.hpp"

#include "app/completion.hpp"
#include "app/console.hpp"
#include "app/help.hpp"
#include "app/usage_problem.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kCommandLineDescription =
    "Gravity tracks: from a design file to the fastest centerline under friction, the ride down it,\n"
    "a watertight solid and the files a workshop needs.";

constexpr const char* kCommandLineFooter =
    "Examples:\n"
    "  glissade init > chute.yaml                                a design to start from\n"
    "  glissade build chute.yaml                                 everything, into out/chute/\n"
    "  glissade solve --run 10 --drop 5 --friction-angle 11deg   the numbers alone\n"
    "  glissade compare chute.yaml                               every kind of centerline side by side\n"
    "  glissade plot chute.yaml -o chute.svg                     profile, speed, load, ... as a picture\n"
    "\n"
    "Exit codes: 0 done; 1 what was looked at is faulty: a mesh, a survey, a rule; 2 wrong usage or design;\n"
    "3 infeasible, or the body does not arrive; 4 not converged; 5 a file cannot be read or written;\n"
    "70 a defect of Glissade; 130 interrupted.\n"
    "'glissade help COMMAND' tells more about a command.";

/// A misspelt command asks for no help of the program's own.
void refuse_unknown_command(const CLI::App& program) {
  const std::vector<std::string> rest = program.remaining();
  if (program.get_subcommands().empty() && !rest.empty() && !rest.front().starts_with('-'))
    throw InputError(unknown_command(program, rest.front()));
}

}  // namespace

ExitCode run(int argc, const char* const* argv) {
  CLI::App program(kCommandLineDescription, "glissade");
  program.footer(kCommandLineFooter);
  program.require_subcommand(0, 1);  // what follows a command is its own, also the name of another
  program.set_help_flag("-h,--help", "Print this help and end");
  program.set_version_flag("--version", "glissade " + std::string(version()), "Print the version and end");
  program.formatter(std::make_shared<CLI::FormatterLambda>(
      [](const CLI::App* command, const std::string&, CLI::AppFormatMode) { return help_text(*command); }));

  Action action;
  add_build(program, action);
  add_solve(program, action);
  add_ride(program, action);
  add_compare(program, action);
  add_plot(program, action);
  add_inspect(program, action);
  add_init(program, action);
  add_gates(program, action);
  add_fit(program, action);
  add_profile(program, action);
  add_redesign(program, action);
  add_survey(program, action);
  add_rules(program, action);
  add_materials(program, action);
  add_sweep(program, action);
  add_schema(program, action);
  add_rewrite(program, action);
  add_help(program, action);
  add_completion(program, action);

  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words.front() == kCompleteWord) {
    print(completions(program, {words.begin() + 1, words.end()}));
    return ExitCode::done;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    refuse_unknown_command(program);
    const auto given = program.get_subcommands();
    print(help_text(given.empty() ? program : *given.front()));
    return ExitCode::done;
  } catch (const CLI::CallForVersion& version) {
    refuse_unknown_command(program);
    print(std::string(version.what()) + "\n");
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    throw InputError(usage_issue(program, error.what()));
  }
  require_values(program);
  keep_what_is_read(program);
  if (!action)
    throw InputError(usage_issue(program, argc > 1 ? "no command is given" : "nothing is asked for"));
  return action();
}

}  // namespace glissade::app
