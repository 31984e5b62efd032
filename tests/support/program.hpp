#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// How a program ended and what it said.
struct Outcome {
  int exit_code = -1;  ///< 128 + signal where a signal ended it, as a shell says it
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// Where and under which limits a program runs.
struct RunLimits {
  std::filesystem::path directory;                 ///< empty: here
  std::optional<unsigned long long> largest_file;  ///< in bytes; writing more fails, as on a full disk
  std::filesystem::path output_to;                 ///< a device or file instead of Outcome::output
  bool closes_output = false;                      ///< standard output is closed from the start
  bool closes_errors = false;                      ///< so is standard error
};

/// Runs a program to its end, without a shell; standard input is empty.
/// @param program  a path, or a name that is looked up in PATH
[[nodiscard]] Outcome run_program(const std::filesystem::path& program,
                                  const std::vector<std::string>& arguments, const RunLimits& limits = {});
