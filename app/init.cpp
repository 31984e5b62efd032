#include "glissade/core/error.hpp"
#include "glissade/core/odd_characters.hpp"
#include "glissade/design/schema.hpp"
#include "glissade/design/template.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/new_file.hpp"
#include "app/option_value.hpp"
#include "app/output_files.hpp"
#include "app/usage_problem.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kInitDescription =
    "Write a commented design file to start from, to standard output or to a file.";

struct InitArguments {
  std::string kind;
  std::string output;
  std::string hill_size;
  bool force = false;
};

std::string footer() {
  constexpr std::size_t kColumn = 18;
  std::string text = "Kinds:\n";
  for (const DesignTemplate& entry : design_templates()) {
    std::string line = "  " + std::string(entry.kind);
    line.resize(kColumn, ' ');
    text += line + std::string(entry.summary) + "\n";
  }
  return text +
         "\n"
         "Examples:\n"
         "  glissade init > chute.yaml\n"
         "  glissade init in-run --hill-size 106 -o hill.yaml\n"
         "  glissade init points -o wall.yaml                 with the profile that it reads beside it\n"
         "\n"
         "Beside a file goes its schema, glissade.schema.json, for editors that check and complete YAML;\n"
         "'glissade schema' prints it.";
}

std::string profile_note() {
  const std::string name(kTemplateProfileName);
  return "glissade: note: this design reads " + name +
         " beside it, which is not written here.\n"
         "      'glissade init points -o FILE' writes both.\n";
}

std::string template_of(const std::string& kind, const InitArguments& options) {
  if (options.hill_size.empty()) return design_template(kind);
  if (kind != "in-run") {
    throw InputError({"--hill-size", "a design of kind " + kind + " has no hill", "",
                      "glissade init in-run --hill-size 106"});
  }
  return in_run_template(option_value(options.hill_size, Dimension::length, "--hill-size"));
}

ExitCode write_template(const CLI::App& command, const InitArguments& options) {
  if (options.output.empty()) {
    refuse_ignored(command, {"--force"}, "without -o", "The design goes to standard output.",
                   "-o chute.yaml --force");
  }
  const std::string kind = options.kind.empty() ? std::string(design_templates().front().kind) : options.kind;
  const std::string text = template_of(kind, options);
  const bool needs_profile = kind == "points";
  if (options.output.empty()) {
    print(text);
    if (needs_profile) print_error(profile_note());
    return ExitCode::done;
  }
  const std::filesystem::path path = options.output;
  const std::filesystem::path profile = path.parent_path() / kTemplateProfileName;
  if (needs_profile && path.lexically_normal() == profile.lexically_normal()) {
    throw InputError(
        {"--output",
         with_visible_characters(options.output) + " is what the profile beside the design is called",
         "One of the two would be lost.", "another name"});
  }
  if (!options.force) {
    require_new(path);
    if (needs_profile) require_new(profile);
  }
  OutputFiles files;
  files.set().put(path, text);
  // What the first line of the design names; one that is there may be of a newer Glissade.
  const std::filesystem::path schema = path.parent_path() / kSchemaName;
  if (!std::filesystem::exists(schema)) files.set().put(schema, design_schema());
  if (needs_profile) files.set().put(profile, design_template_profile());
  files.put_in_place();
  return ExitCode::done;
}

}  // namespace

void add_init(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("init", kInitDescription)->footer(footer());
  const auto options = std::make_shared<InitArguments>();
  command.add_option("kind", options->kind, "What to start from, see below")->type_name("KIND");
  command.add_option("-o,--output", options->output, "File to write; one that exists is kept")
      ->type_name("FILE");
  command
      .add_option("--hill-size", options->hill_size,
                  "Of in-run: HS in metres, whose sizes it takes [default: 140]")
      ->type_name("LENGTH");
  command.add_flag("--force", options->force, "Replace a file that exists");
  command.callback([options, &action, &command] {
    action = [options, &command] { return write_template(command, *options); };
  });
}

}  // namespace glissade::app
