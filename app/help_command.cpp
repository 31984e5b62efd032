#include "glissade/core/error.hpp"
#include "glissade/io/made_directories.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/help.hpp"
#include "app/man_page.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/usage_problem.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kHelpDescription =
    "Print the help of a command, as 'glissade COMMAND --help' does.\n"
    "\n"
    "--man-pages writes the same as pages for man(1), one a command.";

constexpr const char* kHelpFooter =
    "Examples:\n"
    "  glissade help build\n"
    "  glissade help --man-pages man && man -l man/glissade-build.1";

struct HelpArguments {
  std::string command;
  std::string directory;
};

void add_page(FileSet& files, const std::filesystem::path& directory, const HelpPage& page,
              const std::vector<std::string>& also) {
  files.put(directory / (man_name(page) + ".1"), man_page(page, also));
}

void write_man_pages(const CLI::App& program, const std::filesystem::path& directory) {
  MadeDirectories made;  // gone where the pages cannot be written
  made.make(directory);
  OutputFiles files;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    const HelpPage page = help_page(*command);
    names.push_back(man_name(page));
    add_page(files.set(), directory, page, {"glissade"});
  }
  add_page(files.set(), directory, help_page(program), names);
  files.put_in_place();
}

ExitCode help(const CLI::App& program, const HelpArguments& options) {
  if (!options.directory.empty()) {
    into_directory_of("--man-pages", [&] { write_man_pages(program, options.directory); });
    return ExitCode::done;
  }
  const CLI::App* asked = &program;
  if (!options.command.empty()) {
    const auto commands =
        program.get_subcommands([&](const CLI::App* one) { return one->get_name() == options.command; });
    if (commands.empty()) throw InputError(unknown_command(program, options.command));
    asked = commands.front();
  }
  print(help_text(*asked));
  return ExitCode::done;
}

}  // namespace

void add_help(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("help", kHelpDescription)->footer(kHelpFooter);
  const auto options = std::make_shared<HelpArguments>();
  command.add_option("command", options->command, "Of which command [default: of all]")->type_name("COMMAND");
  command
      .add_option("--man-pages", options->directory, "Write all of it for man(1) into a directory instead")
      ->type_name("DIR");
  command.callback(
      [&program, options, &action] { action = [&program, options] { return help(program, *options); }; });
}

}  // namespace glissade::app
