#pragma once

#include "app/exit_code.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace glissade::app {

/// What the command line asks for, to be done once all of it has been understood.
using Action = std::function<ExitCode()>;

/// Each adds one subcommand, which sets the action when it is given.
void add_build(CLI::App& program, Action& action);
void add_solve(CLI::App& program, Action& action);
void add_ride(CLI::App& program, Action& action);
void add_compare(CLI::App& program, Action& action);
void add_plot(CLI::App& program, Action& action);
void add_inspect(CLI::App& program, Action& action);
void add_fit(CLI::App& program, Action& action);
void add_gates(CLI::App& program, Action& action);
void add_init(CLI::App& program, Action& action);
void add_profile(CLI::App& program, Action& action);
void add_rules(CLI::App& program, Action& action);
void add_survey(CLI::App& program, Action& action);
void add_sweep(CLI::App& program, Action& action);
void add_schema(CLI::App& program, Action& action);
void add_redesign(CLI::App& program, Action& action);
void add_rewrite(CLI::App& program, Action& action);
void add_help(CLI::App& program, Action& action);
void add_completion(CLI::App& program, Action& action);
void add_materials(CLI::App& program, Action& action);

/// Understands the arguments and does what they ask for.
/// @return how it ended
/// @throws InputError if the arguments are wrong; else whatever the work throws
[[nodiscard]] ExitCode run(int argc, const char* const* argv);

}  // namespace glissade::app
