#pragma once

#include "glissade/centerline/in_run.hpp"
#include "glissade/pipeline.hpp"

#include "app/table.hpp"

#include <string>

namespace glissade::app {

/// The kind of an in-run: its transition and where that lies.
[[nodiscard]] std::string in_run_text(const InRun& in_run);

/// Gates for a summary: how many, how far apart, and the speeds from the lowest and the highest; empty without gates.
[[nodiscard]] std::string gates_lines(const Track& track);

/// Which gates lie at the measuring place or below it, a sentence; empty where none does.
[[nodiscard]] std::string gates_below_place(const GateTable& table);

/// How the speed from every gate answers to friction, drag and length, in steps that one meets.
[[nodiscard]] Table slopes_table(const GateTable& table);

/// Every gate with its place and its rides, for people.
[[nodiscard]] Table gates_table(const GateTable& table);

}  // namespace glissade::app
