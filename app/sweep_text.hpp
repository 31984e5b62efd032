#pragma once

#include "glissade/study/summary.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace glissade::app {

/// @return how many points ended how, a line each
[[nodiscard]] std::string counts_text(const std::map<study::Status, std::uint64_t>& counts);

/// @return what a run did, and what comes next
[[nodiscard]] std::string run_text(const study::RunReport& report, const std::string& directory);

/// @return counts by status, then how the figures that vary are spread
[[nodiscard]] std::string summary_text(const study::Summary& summary);

/// @return a word as a shell takes it, in quotes where it needs them
[[nodiscard]] std::string for_shell(const std::string& word);

/// @param arguments  of the program, without the shard
/// @return a batch file for Slurm whose array has `tasks` shards
[[nodiscard]] std::string batch_text(const std::vector<std::string>& arguments, const std::string& directory,
                                     std::uint64_t tasks);

}  // namespace glissade::app
