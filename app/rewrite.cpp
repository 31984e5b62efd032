#include "glissade/design/write.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/new_file.hpp"
#include "app/output_files.hpp"
#include "app/track_input.hpp"
#include "app/usage_problem.hpp"

#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kRewriteDescription =
    "Write a design as it is read, with what --set replaces, as a design file that reads as the same "
    "design.\n"
    "\n"
    "Each number is the shortest decimal, in a metric unit, that reads as the same value. Comments are not "
    "kept.";

constexpr const char* kRewriteFooter =
    "Examples:\n"
    "  glissade rewrite designs/grain_chute.yaml --set body.friction_angle=19deg -o rough.yaml\n"
    "  glissade rewrite --run 10 --drop 5 --friction-angle 11deg          options become a design file";

struct RewriteArguments {
  TrackInput input{TrackInput::Scope::one_kind};
  std::string output;
  bool force = false;
};

ExitCode rewrite(const CLI::App& command, const RewriteArguments& options) {
  if (options.output.empty()) {
    refuse_ignored(command, {"--force"}, "without -o", "The design goes to standard output.",
                   "-o chute.yaml --force");
  }
  const Design design = options.input.design();
  if (options.output.empty()) {
    print(design_text(design));
    return ExitCode::done;
  }
  if (!options.force) require_new(options.output);
  OutputFiles files;
  files.set().put(options.output, design_text(moved_to(design, options.output)));
  files.put_in_place();
  return ExitCode::done;
}

}  // namespace

void add_rewrite(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("rewrite", kRewriteDescription)->footer(kRewriteFooter);
  const auto options = std::make_shared<RewriteArguments>();
  options->input.add_to(command);
  command.add_option("-o,--output", options->output, "File to write; one that exists is kept")
      ->type_name("FILE")
      ->group("Options");
  command.add_flag("--force", options->force, "Replace a file that exists")->group("Options");
  command.callback(
      [options, &action, &command] { action = [options, &command] { return rewrite(command, *options); }; });
}

}  // namespace glissade::app
