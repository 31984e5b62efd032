#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

/// A program that runs beside the test.
class RunningProgram {
 public:
  /// @param directory  where it runs; its output goes to the files "output" and "errors" there,
  ///                   in place of those of an earlier one
  RunningProgram(const std::string& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& directory);
  /// Kills it, if it still runs.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  [[nodiscard]] std::string output() const;
  [[nodiscard]] std::string errors() const;
  /// @return the output as soon as it has so many lines, or as it is once that took too long
  [[nodiscard]] std::string output_of_lines(std::size_t count) const;
  /// @return time that it has spent on processors [s]
  [[nodiscard]] double processor_time() const;
  void send(int signal) const;
  /// Sends a signal and waits for the end.
  /// @return the exit code, 128 + signal where one ended it
  int end_by(int signal);

 private:
  std::filesystem::path directory_;
  pid_t child_ = -1;
};
