#include "app/verbosity.hpp"

#include <CLI/CLI.hpp>

namespace glissade::app {

void Verbosity::add_to(CLI::App& command, const char* quiet_help) {
  CLI::Option* const quiet = command.add_flag("-q,--quiet", quiet_, quiet_help)->group("Options");
  command.add_flag("-v,--verbose", verbose_, "Tell each step and when it began, on standard error")
      ->group("Options")
      ->excludes(quiet);
}

}  // namespace glissade::app
