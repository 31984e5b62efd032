#pragma once

#include "glissade/core/error.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace glissade::app {

/// Writes to standard output and flushes. A reader that went away (a pipe that is closed) is no error.
/// @param kept  what is done and stays where this text is lost: "The files are written, into out/chute."; may be empty
/// @throws FileError if the bytes cannot be written: a full disk, a stream that was closed from the start
void print(std::string_view text, std::string_view kept = {});

/// Gives closed standard streams a file that refuses every byte, so that no file that is opened later takes
/// their number, and with it what is printed. To be called before any file is opened.
void reserve_standard_streams();

/// Writes to standard error; what cannot be written there is lost. Control characters are shown (`<U+001B>`), not obeyed.
void print_error(std::string_view text);

/// The same, over the line that the cursor is in: standard error is a terminal.
void print_over_line(std::string_view text);

/// Writes each of an error's issues as "glissade: error: ..." to standard error.
void print_problem(const Error& error);

/// Prints where an error is on its way: if nothing takes what is printed, that is told before that error, not in its place.
/// To be called from the handler that throws the error on.
void print_before_error(std::string_view text, std::string_view kept = {});

/// Writes each as "glissade: warning: ..." to standard error.
void print_warnings(const std::vector<Issue>& warnings);

[[nodiscard]] bool output_is_terminal();
[[nodiscard]] bool error_is_terminal();

/// How a word stands out on a terminal.
enum class Emphasis { heading, good, bad };

/// @return `text` in colour or bold where standard output is a terminal and NO_COLOR is not set, else as it
/// is
[[nodiscard]] std::string emphasised(std::string_view text, Emphasis emphasis);

}  // namespace glissade::app
