#pragma once

#include "glissade/core/error.hpp"
#include "glissade/io/file_set.hpp"

#include "app/console.hpp"
#include "app/interrupt.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace glissade::app {

/// The files that a command was asked for: they take their places together or not at all, also where Ctrl-C or SIGTERM ends the
/// program meanwhile. Not to live beside another Interrupt.
class OutputFiles {
 public:
  /// @param target  as an option gave it; of an empty one nothing is made
  void make(const std::string& target, const std::function<void(const std::filesystem::path&)>& write) {
    if (!target.empty()) files_.make(target, write);
  }
  [[nodiscard]] FileSet& set() noexcept { return files_; }
  void put_in_place() { files_.commit(); }

 private:
  Interrupt interrupt_;  // before the files: it outlives them
  FileSet files_;
};

/// Of files that options name.
inline constexpr const char* kFilesWritten = "The files that were asked for are written.";

/// Writes files and then prints: they are there also where nothing takes what is printed, and that is printed also where a
/// file cannot be written. Where both fail both are told.
/// @param kept  what to say of the files where printing fails, as print() has it
template <typename Write>
void write_and_print(const Write& write, const std::string& text, const std::string& kept) {
  try {
    write();
  } catch (const Error&) {
    print_before_error(text);
    throw;
  }
  print(text, kept);
}

}  // namespace glissade::app
