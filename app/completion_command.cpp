#include "glissade/core/error.hpp"
#include "glissade/core/words.hpp"

#include "app/command_line.hpp"
#include "app/completion.hpp"
#include "app/console.hpp"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kCompletionDescription =
    "Print a script with which a shell completes commands, options, keys, kinds, formats and file names.\n"
    "\n"
    "'cmake --install' puts the scripts where bash, zsh and fish find them by themselves.";

constexpr const char* kCompletionFooter =
    "Examples:\n"
    "  glissade completion bash > glissade.bash   then, in ~/.bashrc: source .../glissade.bash\n"
    "  glissade completion zsh > _glissade        into a directory of your fpath\n"
    "  glissade completion fish > glissade.fish   into ~/.config/fish/completions";

ExitCode print_script(const std::string& shell) {
  const std::string script = completion_script(shell);
  if (script.empty()) {
    throw InputError(
        {"SHELL", "'" + shell + "' is no shell that Glissade knows", "", listed(completed_shells(), "or")});
  }
  print(script);
  return ExitCode::done;
}

}  // namespace

void add_completion(CLI::App& program, Action& action) {
  CLI::App& command =
      *program.add_subcommand("completion", kCompletionDescription)->footer(kCompletionFooter);
  const auto shell = std::make_shared<std::string>();
  command.add_option("shell", *shell, "bash, zsh or fish")->type_name("SHELL")->required();
  command.callback([shell, &action] { action = [shell] { return print_script(*shell); }; });
}

}  // namespace glissade::app
