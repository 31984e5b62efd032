#include "glissade/design/schema.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"

#include <string>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kSchemaDescription =
    "Print the schema of design files, JSON Schema draft-07, for editors that check and complete YAML.";

constexpr const char* kSchemaFooter =
    "Examples:\n"
    "  glissade schema > glissade.schema.json   beside your designs, where those of 'glissade init' look for "
    "it\n"
    "\n"
    "A design names its schema in its first line, which editors with YAML support take up:\n"
    "  # yaml-language-server: $schema=glissade.schema.json";

}  // namespace

void add_schema(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("schema", kSchemaDescription)->footer(kSchemaFooter);
  command.callback([&action] {
    action = [] {
      print(design_schema());
      return ExitCode::done;
    };
  });
}

}  // namespace glissade::app
